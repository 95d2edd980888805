"""Multipliers and harmonics of periodic motions; drawn by contrib/plot."""

import matplotlib.pyplot as plt
import numpy as np

from plot_style import COLORS, MARKERS, MM, NARROW, Skip, finish, name_of, panels
from plot_tables import numbers, read, texts

SMALL = 1e-3  # of the largest of its unit: no harmonic
MAX_BARS = 6  # in a panel
MAX_NAMED = 7  # multipliers, least damped first


def draw_multipliers(runs, options):
    """One run: the least damped ones with their frequencies, equal ones together. Several: a colour a run."""
    wide = options.width > NARROW
    figure, ax = plt.subplots(figsize=(options.width, min(options.width, 80 * MM) * (1 if wide else 1.5)), layout="constrained")
    ax.add_patch(plt.Circle((0, 0), 1, facecolor="#2e8b5712", edgecolor="0.4", lw=0.8))
    reach = 1.08
    for r, run in enumerate(runs):
        rows = read(run.folder / "floquet.csv").rename(columns=name_of)
        labels = [f"{w:.4g} rad/s, {growth:+.3g} 1/s".replace("-", "−") for w, growth in zip(rows["frequency"], rows["growth rate"])]
        order = {label: k for k, label in enumerate(dict.fromkeys(labels))}
        names = [label if order[label] < MAX_NAMED else "others" for label in labels] if len(runs) == 1 else [run.name] * len(labels)
        reach = max(reach, 1.08 * rows["multiplier"].max())
        for k, (name, own) in enumerate(rows.groupby(names, sort=False)):
            k = max(r, k)
            x, y, unstable = own["multiplier real"], own["multiplier imaginary"], own["multiplier"] > 1 + 1e-6
            label = name + f" ({len(own)})" * (len(runs) == 1 and len(own) > 1)
            look = {"color": COLORS[k % 8], "marker": MARKERS[k % 12], "ls": "", "ms": 4 + r, "mew": 0.8}
            ax.plot([*x, *x], [*y, *-y], mfc="none", label=label, **look)
            ax.plot([*x[unstable], *x[unstable]], [*y[unstable], *-y[unstable]], **look)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", xlabel="Re μ [–]", ylabel="Im μ [–]", xticks=(-1, -0.5, 0, 0.5, 1))
    ax.legend(borderaxespad=0, loc="center left" if wide else "lower left", bbox_to_anchor=(1.02, 0.5) if wide else (0, 1.01))
    figure.suptitle("Multipliers of the periodic motion in the unit circle, filled if unstable")
    return figure


def draw_harmonics(runs, options):
    """A panel for the probes of a unit and for the loads of joints in each kind of axes; equal ones are one bar."""
    rows = texts(runs[0].folder / "harmonics.csv")
    rows = rows.assign(amplitude=numbers(rows["amplitude"]), harmonic=numbers(rows["harmonic"]).astype(int))
    rows = rows[rows["harmonic"] > 0]
    groups = []  # unit, axes, numbers of harmonics, bars: names and amplitudes
    for (unit, kind), of_group in rows.groupby(["unit", "axes"], sort=False):
        table = of_group.pivot(index="harmonic", columns="quantity", values="amplitude")[of_group["quantity"].unique()]
        largest = np.nanmax(table.to_numpy(), initial=0)
        bars = []
        for name, y in table.items():
            same = next((names for names, other in bars if np.allclose(other, y, rtol=0, atol=0.01 * largest)), None)
            if same:
                same.append(name)
            elif np.nanmax(y) > SMALL * largest > 0:
                bars.append(([name], y))
        sizes = sorted(np.nanmax(y) for _, y in bars)[-MAX_BARS:]
        if len(bars) > MAX_BARS:
            options.say(f"the largest {MAX_BARS} of {len(bars)} quantities in [{unit}]")
        if bars:
            groups.append((unit, kind, table.index.to_numpy(), [bar for bar in bars if np.nanmax(bar[1]) >= sizes[0]]))
    if not groups:
        raise Skip("harmonics.csv has no harmonics")
    last = max(n[np.max([y for _, y in bars], axis=0) > SMALL * np.max([y for _, y in bars])][-1] for _, _, n, bars in groups)
    figure, axes = panels(options, [30] * len(groups), "Harmonics of the periodic motion, without the means")
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
