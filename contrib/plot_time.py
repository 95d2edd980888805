"""Histories and other columns against the first one, energies, steps and spectra; drawn by contrib/plot."""

import re

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from scipy.interpolate import Akima1DInterpolator
from scipy.signal import detrend, find_peaks, get_window, periodogram

from plot_pictures import azimuths
from plot_style import HERTZ, Skip, Wrong, finish, logarithmic, look, name_of, name_runs, panels, unit_of
from plot_tables import between, find, read

MAX_PANELS = 6
MAX_LINES = 8  # in a panel
FEW_POINTS = 40  # are marked
MAX_VECTOR_POINTS = 20000  # longer lines become pixels in SVG and PDF
MAX_STEPS = 150  # of more, bands
MAX_PEAKS = 5
SMALL = 1e-3  # of the largest amplitude: no line
WINDOW = ("kaiser", 9.0)  # side lobes below 0.6e-3 < SMALL, so that each top is a line; a line is 3 resolutions wide on each side
PERIODS = 3.98  # of the lowest line, at least: four, less the error of its frequency
DRIFT = 0.1  # of the largest line: what is slower than that and smaller is no line
ENERGIES = ["kinetic [J]", "strain [J]", "potential [J]", "sum [J]"]


def chosen(tables, wanted, where):
    """Labels of the columns with these names; of those that move if there are none."""
    rows = pd.concat(tables).iloc[:, 1:]
    found = find(wanted, rows.columns, where)
    moves = rows.max() - rows.min() > 1e-9 * rows.abs().max()
    return found if wanted else [label for label in found if moves[label]]


def grouped(labels, options, wanted):
    """Labels of each panel: those of one unit; of many those that differ in numbers and directions only."""
    groups, units = {}, list(map(unit_of, labels))
    for label in sorted(labels, key=lambda label: units.index(unit_of(label))):
        kind = re.sub(r"\d+| \w$", "", name_of(label)) if units.count(unit_of(label)) > 4 else ""
        groups.setdefault((unit_of(label), kind), []).append(label)
    found = list(groups.values())
    if not wanted and (len(found) > MAX_PANELS or max(map(len, found), default=0) > MAX_LINES):
        options.say(f"the first {MAX_PANELS} panels and {MAX_LINES} lines in each; --probe draws others")
        found = [panel[:MAX_LINES] for panel in found[:MAX_PANELS]]
    return found


def common_label(labels):
    """"displacement [m]" for two displacements, otherwise the unit alone."""
    found = {re.sub(r" \w$", "", name_of(label)).split(".")[-1] for label in labels}  # without directions
    return f"{found.pop() if len(found) == 1 else ''} [{unit_of(labels[0]) or '–'}]".strip()


def draw_lines(ax, runs, labels, curves):
    """curves: (number of the run, label) -> (x, y)."""
    for (r, label), (x, y) in curves.items():
        how = {"marker": "o", "ms": 2} if len(x) <= FEW_POINTS else {"rasterized": len(x) > MAX_VECTOR_POINTS}
        ax.plot(x, y, label=name_of(label) if len(runs) == 1 else None, **how | look(r, len(runs), labels.index(label)))
    name_runs(ax, runs, map(name_of, labels))
    ax.set_ylabel(common_label(labels))
    ax.margins(x=0.01)


def draw_groups(title, runs, tables, groups, options, places=None, height=36):
    """A panel for each group of labels against the first column, or against places of each run."""
    figure, axes = panels(options, [height] * len(groups), title)
    places = places or [table.iloc[:, 0] for table in tables]
    for ax, labels in zip(axes, groups):
        draw_lines(ax, runs, labels, {(r, label): (places[r], table[label]) for r, table in enumerate(tables) for label in labels if label in table})
    return figure, axes


def abscissa_of(run, table, wanted):
    """Label and values of what the history is drawn over."""
    try:
        label = find(["*azimuth*" if wanted == "azimuth" else wanted], table.columns, "dynamic.csv")[0]
        return label, table[label]
    except Wrong:
        if wanted != "azimuth":
            raise
    return "azimuth [deg]", np.interp(table.iloc[:, 0], *azimuths(run.folder), left=np.nan, right=np.nan)


def draw_columns(file, title, runs, options):
    """The chosen columns against the first one, or of a history against another: one displacement over another is an orbit."""
    is_history = file == "dynamic.csv"
    tables = [between(run.folder / file, options) if is_history else read(run.folder / file) for run in runs]
    abscissa = tables[0].columns[0]
    if max(table[abscissa].nunique() for table in tables) < 2:
        raise Skip(f"{file} has a single {name_of(abscissa)}")
    groups = grouped(chosen(tables, options.probe, file), options, options.probe)
    if not groups:
        raise Skip(f"{file} has no column that moves")
    if not is_history or not options.abscissa:
        return finish(options, *draw_groups(title, runs, tables, groups, options), abscissa)
    (abscissa, *_), places = zip(*(abscissa_of(run, table, options.abscissa) for run, table in zip(runs, tables)))
    is_orbit = [common_label(labels) for labels in groups] == [common_label([abscissa])]
    figure, axes = draw_groups(title, runs, tables, groups, options, places, 80 if is_orbit else 36)
    if is_orbit:
        axes[0].set_aspect("equal", adjustable="datalim")
    if abscissa == "azimuth [deg]":
        axes[-1].xaxis.set_major_locator(plt.MaxNLocator(8, steps=[1, 1.8, 3.6, 4.5, 9, 10]))  # quarters of turns
    return finish(options, figure, axes, abscissa)


def draw_energy(runs, options):
    """Changes since the first row: energies above, works and losses below, without what is less than a thousandth of the largest."""
    tables = []
    for run in runs:
        rows = between(run.folder / "dynamic_energy.csv", options).drop(columns="balance [J]", errors="ignore").set_index("t [s]")
        changes = rows - rows.iloc[0]
        tables.append(changes.assign(**{"sum [J]": changes[changes.columns.intersection(ENERGIES)].sum(axis=1)}).reset_index())
    sizes = pd.concat(tables).iloc[:, 1:].abs().max()
    shown = [label for label in sizes.index if sizes[label] > 1e-3 * sizes.max() > 0]
    groups = [labels for above in (True, False) if (labels := [label for label in shown if (label in ENERGIES) == above])]
    if not groups:
        raise Skip("no energy changes")
    figure, axes = draw_groups("Changes of energies; works and losses", runs, tables, groups, options)
    for ax, labels in zip(axes, groups):
        ax.set_ylabel("change of energy [J]" if labels[0] in ENERGIES else "work, loss [J]")
        for line in ax.lines:
            line.set(**{"color": "0.2", "ls": ":"} if line.get_label() == "sum" else {})
    return finish(options, figure, axes, "t [s]")


def draw_steps(runs, options):
    """Sizes of steps, crossed where one was rejected; numbers of iterations and factorizations; estimates of the error."""
    tables = [between(run.folder / "dynamic_steps.csv", options) for run in runs]
    rows = pd.concat(tables)
    kinds = {"step [s]": ["step [s]"], "number in a step [–]": ["iterations", "factorizations"], "estimate [–]": ["estimate", "second estimate"]}
    known = [name for name in rows.columns if (rows[name] > 0).any()]
    kinds = {label: shown for label, names in kinds.items() if (shown := [name for name in names if name in known])}
    in_bands = ", in bands from the least to the largest" * (max(map(len, tables)) > MAX_STEPS)
    figure, axes = panels(options, [30] * len(kinds), "Steps" + in_bands)
    for ax, (label, names) in zip(axes, kinds.items()):
        for r, (run, table) in enumerate(zip(runs, tables)):
            of_run, t = f"{run.name}: " * (len(runs) > 1), table["t [s]"]
            for k, name in enumerate(names):
                total = f", {table[name].sum():.0f} in all" * label.startswith("number")
                draw_band(ax, t, table[name], None if of_run else name_of(name) + total, look(r, len(runs), k))
            if names == ["step [s]"]:
                text = f"{of_run}{len(t)} steps, {table['rejections'].sum():.0f} rejections"
                ax.plot(t, table["step [s]"].where(table["rejections"] > 0), "x", ms=4, mew=0.8, zorder=3, color=look(r, len(runs), 1)["color"], label=text)
        name_runs(ax, runs, map(name_of, names))
        ax.set_ylabel(label)
        ax.margins(x=0.01)
        ax.set_ylim(0, 1.1 * rows[names].max().max())
        if not label.startswith("number"):
            logarithmic(ax.yaxis, rows[names].where(rows[names] > 0).to_numpy().ravel())
    return finish(options, figure, axes, "t [s]")


def draw_band(ax, t, y, label, how):
    """Means and bands of neighbours, so many that MAX_STEPS are left; of few steps each is drawn."""
    rows = pd.DataFrame({"t": t, "y": y}).dropna()
    groups = rows.groupby(np.arange(len(rows)) * MAX_STEPS // max(len(rows), MAX_STEPS))
    means, band = groups.mean(), groups["y"].agg(["min", "max"])
    ax.plot(means["t"], means["y"], label=label, **how)
    ax.fill_between(means["t"], band["min"], band["max"], color=how["color"], alpha=0.2, lw=0)


def at_equal_steps(t, x):
    """t and x as they are if the steps are equal, otherwise a new t and cubics through x."""
    t, kept = np.unique(t, return_index=True)
    if np.ptp(np.diff(t)) <= 1e-3 * np.diff(t).mean():
        return t, x[kept]
    n_steps = int(np.ceil(np.ptp(t) / np.quantile(np.diff(t), 0.05)))
    equal = np.linspace(t[0], t[-1], min(n_steps, 4 * len(t)) + 1)
    return equal, Akima1DInterpolator(t, x[kept])(equal)


def spectrum(t, x):
    """Frequencies [rad/s] and amplitudes of x(t): a sine of amplitude A has a peak of height A.

    Without the mean, nor the straight line of what grows steadily, as the angle of a shaft."""
    t, x = at_equal_steps(t, x)
    without_line = detrend(x)
    if np.var(without_line) < 0.01 * np.var(x):
        x = without_line
    x = x - np.average(x, weights=get_window(WINDOW, len(x)))
    size = 2 ** int(np.ceil(np.log2(8 * len(x))))  # with zeros: without them a peak between two frequencies would be too low
    f, power = periodogram(x, (len(t) - 1) / np.ptp(t), WINDOW, size, detrend=False, scaling="spectrum")  # power: A^2/2
    return 2 * np.pi * f, np.sqrt(2 * power)


def peaks(frequencies, amplitudes, least):
    """(frequency, amplitude) of the lines above a least frequency, largest first; below 1.5 2 pi / duration are slow drifts."""
    logs = np.log(np.maximum(amplitudes, 1e-300))
    tops = find_peaks(logs, height=logs.max() + np.log(SMALL), prominence=np.log(2))[0]
    left, top, right = logs[tops - 1], logs[tops], logs[tops + 1]
    shift = 0.5 * (left - right) / (left - 2 * top + right)  # to the top of the parabola through the logarithms
    found = zip(frequencies[tops] + shift * frequencies[1], np.exp(top - 0.25 * (left - right) * shift))
    return sorted((line for line in found if line[0] > least), key=lambda line: -line[1])


def of_column(t, x):
    """Spectrum of a column and its lines, or why there is none."""
    if len(np.unique(t)) < 8:
        raise Skip("fewer than eight times")
    resolution = 2 * np.pi / np.ptp(t)
    f, a = spectrum(t, x)
    found = peaks(f, a, 0)
    lowest = min((w for w, size in found if size > DRIFT * found[0][1]), default=0)
    if lowest < PERIODS * resolution:
        what = f"{lowest / resolution:.1f} periods of its lowest line, {lowest:.3g} rad/s" if lowest else "no line"
        raise Skip(f"{what}; a spectrum wants {np.ceil(PERIODS):g}")
    return f, a, [line for line in found if line[0] > PERIODS * resolution][:MAX_PEAKS]


def draw_spectrum(runs, options):
    tables = [between(run.folder / "dynamic.csv", options) for run in runs]
    labels = chosen(tables, options.probe, "dynamic.csv")
    found, reasons = {}, []
    for r, label in ((r, label) for label in labels for r, table in enumerate(tables) if label in table):
        try:
            found[r, label] = of_column(*tables[r][["t [s]", label]].dropna().to_numpy().T)
        except Skip as reason:
            reasons.append(f"'{name_of(label)}' has {reason}")
    if not found:
        raise Skip("; ".join(reasons[:1]) or "dynamic.csv has no probe that moves")
    for reason in reasons:
        options.say(reason)
    groups = grouped(list(dict.fromkeys(label for _, label in found)), options, options.probe)

    right = max(min(f[-1], 1.2 * f[np.flatnonzero(a > SMALL * a.max())[-1]]) for f, a, _ in found.values())  # where something is left
    figure, axes = panels(options, [36] * len(groups), "Amplitude spectra")
    for ax, labels in zip(axes, groups):
        of_panel = {key: (f[f <= right], a[f <= right], marks) for key, (f, a, marks) in found.items() if key[1] in labels}
        draw_lines(ax, runs, labels, {key: (f, a) for key, (f, a, _) in of_panel.items()})
        largest = [a.max() for _, a, _ in of_panel.values()]
        ax.set_yscale("log")
        ax.set_ylim(max(largest) * np.clip(1e-2 * min(largest) / max(largest), 1e-8, 1e-4), 20 * max(largest))
        ax.set_xlim(0, right)
        mark_peaks(ax, list(of_panel.values()), 0.35 / options.width * right)
    axes[0].spines["top"].set_visible(True)
    axes[0].secondary_xaxis("top", functions=HERTZ).set_xlabel("frequency [Hz]")
    return finish(options, figure, axes, "frequency [rad/s]", above=10)


def mark_peaks(ax, spectra, width):
    """The frequencies of the largest lines stand above all curves there, as far as there is room; `width` is that of a number."""
    tops = sorted(((a, w, line.get_color()) for line, (*_, marks) in zip(ax.lines, spectra) for w, a in marks), reverse=True)
    marked = []
    for _, w, color in tops:
        if len(marked) < MAX_PEAKS and all(abs(w - other) > width for other in marked):
            marked.append(w)
            above = max(a[np.abs(f - w) < 0.5 * width].max() for f, a, _ in spectra)
            ax.annotate(f"{w:.4g}", (w, above), (0, 2), textcoords="offset points", ha="center", fontsize=7, color=color)
