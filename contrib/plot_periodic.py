"""Multipliers and harmonics of periodic motions; drawn by contrib/plot."""

import matplotlib.pyplot as plt
import numpy as np

from plot_style import COLORS, MARKERS, MM, Skip, finish, panels
from plot_tables import numbers, texts

SMALL = 1e-3  # of the largest of its unit: no harmonic
MAX_BARS = 6  # in a panel
MAX_NAMED = 7  # multipliers, least damped first


def draw_multipliers(runs, options):
    """One run: the least damped ones with their frequencies. Several: a colour a run."""
    tables = [run.table("floquet.csv") for run in runs]
    side = min(options.width, 80 * MM)
    figure, ax = plt.subplots(figsize=(options.width, side * (1 if options.width > 110 * MM else 1.3)), layout="constrained")
    ax.add_patch(plt.Circle((0, 0), 1, facecolor="#2e8b57", alpha=0.07, lw=0))
    ax.add_patch(plt.Circle((0, 0), 1, fill=False, color="0.4", lw=0.8))
    reach = 1.08
    for r, (run, table) in enumerate(zip(runs, tables)):
        names = ("multiplier real", "multiplier imaginary", "multiplier", "frequency", "growth rate")
        rows = list(zip(*(table.column(name) for name in names)))
        for k, (x, y, size, frequency, growth) in enumerate(rows):
            if len(runs) > 1:
                look, label = r, None if k else run.name
            elif k < MAX_NAMED:
                look, label = k, f"{frequency:.4g} rad/s, {growth:+.3g} 1/s".replace("-", "−")
            else:
                look, label = 7, "others" if k == MAX_NAMED else None
            ax.plot([x, x], [y, -y], MARKERS[look], color=COLORS[look % 8], ms=4, mew=0.8, mfc="none" if size <= 1 + 1e-6 else None, label=label)
            reach = max(reach, 1.08 * size)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", xlabel="Re μ [–]", ylabel="Im μ [–]")
    ax.axhline(0, color="0.85", lw=0.6, zorder=0)
    ax.axvline(0, color="0.85", lw=0.6, zorder=0)
    place = {"loc": "center left", "bbox_to_anchor": (1.02, 0.5)} if options.width > 110 * MM else {"loc": "lower left", "bbox_to_anchor": (0, 1.01)}
    ax.legend(borderaxespad=0, **place)
    figure.suptitle("Multipliers of the periodic motion in the unit circle, filled if unstable")
    return figure


def draw_harmonics(runs, options):
    """A panel for the probes of a unit and for the loads of joints in each kind of axes; equal ones are one bar."""
    rows = texts(runs[0].folder / "harmonics.csv")
    rows = rows.assign(amplitude=numbers(rows["amplitude"]), harmonic=numbers(rows["harmonic"]).astype(int))
    rows = rows[rows["harmonic"] > 0]
    groups = []  # unit, axes, highest harmonic, bars: name and amplitudes
    for (unit, kind), of_group in rows.groupby(["unit", "axes"], sort=False):
        table = of_group.pivot(index="harmonic", columns="quantity", values="amplitude")[of_group["quantity"].unique()]
        largest = np.nanmax(table.to_numpy(), initial=0)
        bars = []
        for name in table.columns:
            y = table[name].to_numpy()
            same = next((bar for bar in bars if np.allclose(bar[1], y, rtol=0, atol=0.01 * largest)), None)
            if same:
                same[0].append(name)
            elif np.nanmax(y) > SMALL * largest > 0:
                bars.append(([name], y))
        if bars:
            groups.append((unit, kind, table.index.to_numpy(), bars[:MAX_BARS]))
    if not groups:
        raise Skip("harmonics.csv has no harmonics")
    last = max(n[np.max([y for _, y in bars], axis=0) > SMALL * np.max([y for _, y in bars])][-1] for _, _, n, bars in groups)
    figure, axes = panels(options, len(groups), "Harmonics of the periodic motion, without the means", 30)
    for ax, (unit, kind, n, bars) in zip(axes, groups):
        width = 0.8 / len(bars)
        for k, (names, y) in enumerate(bars):
            label = names[0] + (f" and {len(names) - 1} equal" if len(names) > 1 else "") + (f", {kind} axes" if kind else "")
            ax.bar(n - 0.4 + (k + 0.5) * width, y, width, color=COLORS[k], label=label)
        ax.set_ylabel(f"amplitude [{unit or '–'}]")
        ax.set_xlim(0.5, last + 0.5)
        ax.xaxis.set_major_locator(plt.MaxNLocator(integer=True))
        ax.grid(axis="x", visible=False)
    return finish(options, figure, axes, "harmonic of the period")
