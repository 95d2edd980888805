"""Histories, spectra, orbits and energies; drawn by contrib/plot."""

import re

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap
from scipy.interpolate import Akima1DInterpolator
from scipy.signal import find_peaks

import plot_pictures
from plot_style import COLORS, DASHES, MAX_VECTOR_POINTS, MM, Skip, Wrong, finish, panels, style
from plot_tables import find, split_unit

TIME_COLORS = LinearSegmentedColormap.from_list("samara time", ["#b9cbe0", "#1f5fa8", "#7b4fa3", "#cf3a4b"])
MAX_PANELS = 6
MAX_LINES = 8  # in a panel
MAX_ORBITS = 4
MAX_STEPS = 400  # points of a line
MAX_PEAKS = 5
FLAT = 0.05  # an orbit that is narrower is none
PERIODS = 4  # of the lowest line, at least
DRIFT = 0.1  # of the largest line: what is slower than that and smaller is no line

# ---------------------------------------------------------------------------------------------------------- columns


def chosen(tables, wanted):
    """Labels of the columns with these names; of those that move if there are none."""
    labels = list(dict.fromkeys(label for table in tables for label in table.labels[1:]))

    def moves(label):
        values = [t.values[:, t.labels.index(label)] for t in tables if label in t.labels]
        return any(np.nanmax(y, initial=-np.inf) - np.nanmin(y, initial=np.inf) > 1e-9 * np.nanmax(np.abs(y), initial=0) for y in values)

    found = find(wanted, labels, tables[0].path.name)
    return found if wanted else [label for label in found if moves(label)]


def grouped(labels, options, wanted):
    """Labels of each panel: those of one unit; of many those that differ in numbers and directions only."""
    groups = {}
    for label in labels:
        groups.setdefault(split_unit(label)[1], []).append(label)
    panels_ = []
    for of_unit in groups.values():
        kinds = {}
        for label in of_unit:
            kind = re.sub(r"\d+", "", quantity(split_unit(label)[0])) if len(of_unit) > 4 else ""
            kinds.setdefault(kind, []).append(label)
        panels_ += kinds.values()
    if wanted:
        return panels_
    if len(panels_) > MAX_PANELS or max(map(len, panels_), default=0) > MAX_LINES:
        options.say(f"the first {MAX_PANELS} panels and {MAX_LINES} lines in each; --probe draws others")
    return [panel[:MAX_LINES] for panel in panels_[:MAX_PANELS]]


def quantity(name):
    """Without its direction."""
    return re.sub(r" \w$", "", name)


def common_label(labels):
    """"displacement [m]" for two displacements, otherwise the unit alone."""
    unit = split_unit(labels[0])[1]
    found = {quantity(split_unit(label)[0].split(".")[-1]) for label in labels}
    return f"{found.pop() if len(found) == 1 else ''} [{unit or '–'}]".strip()


def draw_lines(ax, runs, labels, curves, first):
    """curves: (number of the run, label) -> (x, y). One run: a colour a column. Several: a colour a run, dashes a column."""
    several = len(runs) > 1
    for (r, label), (x, y) in curves.items():
        k = labels.index(label)
        color, dashes = (COLORS[r % 8], DASHES[k % 4]) if several else (COLORS[k % 8], DASHES[k // 8 % 4])
        ax.plot(x, y, color=color, ls=dashes, label=None if several else split_unit(label)[0], **style(x))
    if several:
        for r, run in enumerate(runs if first else []):
            ax.plot([], [], color=COLORS[r % 8], label=run.name)
        for k, label in enumerate(labels):
            ax.plot([], [], color="0.3", ls=DASHES[k % 4], label=split_unit(label)[0])
    ax.set_ylabel(common_label(labels))


def abscissa_of(run, table, options):
    """Label and values of what the history is drawn over."""
    if options is None or options.abscissa is None:
        return table.labels[0], table.values[:, 0]
    wanted = "*azimuth*" if options.abscissa == "azimuth" else options.abscissa
    try:
        label = find([wanted], table.labels, table.path.name)[0]
        return label, table.values[:, table.labels.index(label)]
    except Wrong:
        if options.abscissa != "azimuth":
            raise
    t, angle = plot_pictures.azimuths(run.folder)
    return "azimuth [deg]", np.interp(table.values[:, 0], t, angle, left=np.nan, right=np.nan)


def draw_columns(file, title, runs, options):
    """The chosen columns against the first one, a panel a unit; of many steps the means of a few."""
    in_time = file.startswith("dynamic")
    tables = [run.table(file).between(options) if in_time else run.table(file) for run in runs]
    if file == "dynamic_steps.csv":
        tables = [table.means(MAX_STEPS) for table in tables]
    if max(len(np.unique(table.values[:, 0])) for table in tables) < 2:
        raise Skip(f"{file} has a single {tables[0].names[0]}")
    wanted = [] if file == "dynamic_steps.csv" else options.probe
    groups = grouped(chosen(tables, wanted), options, wanted)
    if not groups:
        raise Skip(f"{file} has no column that moves")
    figure, axes = panels(options, len(groups), title)
    places = [abscissa_of(run, table, options if file == "dynamic.csv" else None) for run, table in zip(runs, tables)]
    for ax, labels in zip(axes, groups):
        curves = {(r, label): (places[r][1], table.values[:, table.labels.index(label)])
                  for r, table in enumerate(tables) for label in labels if label in table.labels}
        draw_lines(ax, runs, labels, curves, ax is axes[0])
        ax.margins(x=0.01)
    if places[0][0] == "azimuth [deg]":
        turns = np.ptp(axes[0].get_xlim()) / 360
        axes[-1].xaxis.set_major_locator(plt.MultipleLocator(90 * max(1, 2 ** int(np.ceil(np.log2(turns / 2))))))
    return finish(options, figure, axes, places[0][0])


# ---------------------------------------------------------------------------------------------------------- spectra


def at_equal_steps(t, x):
    """t and x as they are if the steps are equal, otherwise a new t and cubics through x."""
    t, kept = np.unique(t, return_index=True)
    equal = np.linspace(t[0], t[-1], len(t))
    if np.abs(t - equal).max() <= 1e-3 * (equal[1] - equal[0]):
        return equal, x[kept]
    n_steps = int(np.ceil(np.ptp(t) / np.quantile(np.diff(t), 0.05)))
    equal = np.linspace(t[0], t[-1], min(n_steps, 4 * len(t)) + 1)
    return equal, Akima1DInterpolator(t, x[kept])(equal)


def spectrum(t, x):
    """Frequencies [rad/s] and amplitudes of x(t): a sine of amplitude A has a peak of height A.

    Without the mean, nor the straight line of what grows steadily, as the angle of a shaft; behind a Hann window. Zeros
    are appended: without them a peak between two frequencies would be up to 15 % too low.
    """
    t, x = at_equal_steps(t, x)
    window = np.hanning(len(x) + 1)[:-1]
    x = x - x.mean()
    without_line = x - np.polyval(np.polyfit(t - t[0], x, 1), t - t[0])
    if np.var(without_line) < 0.01 * np.var(x):
        x = without_line
    x -= np.average(x, weights=window)
    size = 2 ** int(np.ceil(np.log2(8 * len(x))))
    amplitudes = 2 / window.sum() * np.abs(np.fft.rfft(window * x, size))
    return 2 * np.pi * np.fft.rfftfreq(size, t[1] - t[0]), amplitudes


def lines(frequencies, amplitudes, resolution):
    """(frequency, amplitude) of what stands above the side lobes of the window, largest first.

    `resolution` is 2 pi / duration, half as wide as a peak is at least. At d resolutions from a peak of height A the side
    lobes reach A / (pi d (d^2 - 1)).
    """
    found = []
    tops = find_peaks(amplitudes, height=1e-3 * amplitudes.max())[0]
    for i in tops[np.argsort(-amplitudes[tops])]:
        left, top, right = np.log(np.maximum(amplitudes[i - 1 : i + 2], 1e-300))
        shift = 0.5 * (left - right) / (left - 2 * top + right)  # to the top of the parabola through the logarithms
        frequency, amplitude = frequencies[i] + shift * frequencies[1], np.exp(top - 0.25 * (left - right) * shift)
        distances = [(abs(frequency - f) / resolution, a) for f, a in found]
        if all(d > 2 for d, _ in distances) and amplitude > 2 * sum(a / (np.pi * d * (d * d - 1)) for d, a in distances):
            found.append((frequency, amplitude))
    return found


def peaks(frequencies, amplitudes, resolution):
    """The largest lines; below 1.5 resolutions there are only slow drifts."""
    return [line for line in lines(frequencies, amplitudes, resolution) if line[0] > 1.5 * resolution][:MAX_PEAKS]


def lowest_line(found):
    """Of those that are no drift; 0 if there is none."""
    return min((w for w, a in found if a > DRIFT * found[0][1]), default=0)


def draw_spectrum(runs, options):
    tables = [run.table("dynamic.csv").between(options) for run in runs]
    wanted = options.spectrum or options.probe
    curves, marks, refused = {}, {}, []
    for label in chosen(tables, wanted):
        for r, table in enumerate(tables):
            rows = table.values[np.isfinite(table.values[:, table.labels.index(label)])] if label in table.labels else np.zeros((0, 1))
            if len(np.unique(rows[:, 0])) < 8:
                continue
            t, x = rows[:, 0], rows[:, table.labels.index(label)]
            resolution = 2 * np.pi / np.ptp(t)
            found = lines(*spectrum(t, x), resolution)
            lowest = lowest_line(found)
            if lowest < (PERIODS - 0.02) * resolution:
                what = f"{lowest / resolution:.1f} periods of its lowest line, {lowest:.3g} rad/s" if lowest else "no line"
                refused.append(f"'{split_unit(label)[0]}' has {what}; a spectrum wants {PERIODS}")
                continue
            curves[r, label] = spectrum(t, x)
            marks[r, label] = [line for line in found if line[0] > (PERIODS - 0.02) * resolution][:MAX_PEAKS]
    if not curves:
        raise Skip(refused[0] if refused else "dynamic.csv has too few times here, or no probe that moves")
    for text in refused:
        options.say(text)
    groups = grouped(list(dict.fromkeys(label for _, label in curves)), options, wanted)

    # up to where something is left
    right = max(f[np.flatnonzero(a > 1e-3 * a.max())[-1]] for f, a in curves.values())
    right = min(1.2 * right, max(f[-1] for f, _ in curves.values()))
    figure, axes = panels(options, len(groups), "Amplitude spectra")
    for ax, labels in zip(axes, groups):
        of_panel = {key: (f[f <= right], a[f <= right]) for key, (f, a) in curves.items() if key[1] in labels}
        draw_lines(ax, runs, labels, of_panel, ax is axes[0])
        largest = [a.max() for _, a in of_panel.values()]
        ax.set_yscale("log")
        ax.set_ylim(max(largest) * np.clip(1e-2 * min(largest) / max(largest), 1e-8, 1e-4), 20 * max(largest))
        ax.set_xlim(0, right)
        mark_peaks(ax, [(w, a, line.get_color()) for line, key in zip(ax.lines, of_panel) for w, a in marks[key]], right, options)
    axes[0].spines["top"].set_visible(True)
    hertz = axes[0].secondary_xaxis("top", functions=(lambda w: w / (2 * np.pi), lambda f: 2 * np.pi * f))
    hertz.set_xlabel("frequency [Hz]")
    return finish(options, figure, axes, "frequency [rad/s]", above=10)


def mark_peaks(ax, tops, right, options):
    """The frequencies of the largest lines stand over them, as far as there is room."""
    width = 0.35 / options.width * right  # of a number
    marked = []
    for w, a, color in sorted(tops, key=lambda top: -top[1]):
        if len(marked) < MAX_PEAKS and all(abs(w - other) > width for other in marked):
            marked.append(w)
            ax.annotate(f"{w:.4g}", (w, a), (0, 2), textcoords="offset points", ha="center", fontsize=7, color=color)


# ----------------------------------------------------------------------------------------- orbits, energies

def transverse_pairs(table):
    """Pairs of columns: one quantity of one point in two directions, those of three in which it moves most."""
    ranges = np.nan_to_num(np.ptp(table.values, axis=0))
    found = {}
    for a, name in enumerate(table.names):
        what, _, direction = name.rpartition(" ")
        for first, second in (("y", "z"), ("x", "y"), ("z", "x"), ("2", "3")):
            if direction == first and f"{what} {second}" in table.names:
                b = table.names.index(f"{what} {second}")
                found.setdefault(what, []).append((a, b))
    pairs = [max(of_point, key=lambda pair: min(ranges[list(pair)])) for of_point in found.values()]
    pairs = [pair for pair in pairs if min(ranges[list(pair)]) > FLAT * max(ranges[list(pair)])]
    return sorted(pairs, key=lambda pair: "displacement" not in table.names[pair[0]])


def draw_orbits(runs, options):
    table = runs[0].table("dynamic.csv").between(options)
    pairs = [[table.labels.index(find([name], table.labels, table.path.name)[0]) for name in pair] for pair in options.orbit]
    narrow = options.width < 110 * MM
    pairs = pairs or transverse_pairs(table)[: MAX_ORBITS // (1 + narrow)]
    if not pairs:
        raise Skip("dynamic.csv has no pair of probes in two transverse directions that move; see --orbit")
    columns = 1 if len(pairs) == 1 or narrow else 2
    rows, side = -(-len(pairs) // columns), (options.width - 0.6) / max(columns, options.width / 3.4)
    figure = plt.figure(figsize=(min(options.width, side * columns + 0.7), (side + 0.15) * rows + 0.2), layout="constrained")
    axes = [figure.add_subplot(rows, columns, k + 1) for k in range(len(pairs))]
    for ax, pair in zip(axes, pairs):
        drawn = draw_orbit(ax, table, *pair)
    figure.colorbar(drawn, ax=axes, label=table.labels[0], fraction=0.05, aspect=30).outline.set_visible(False)
    figure.suptitle("Orbits")
    return figure


def draw_orbit(ax, table, a, b):
    t, points = table.values[:, 0], table.values[:, [a, b]]
    cuts = np.unique(np.linspace(0, len(t) - 1, 401).astype(int))
    pieces = LineCollection([points[i : j + 1] for i, j in zip(cuts, cuts[1:])], cmap=TIME_COLORS, lw=0.8)
    pieces.set_rasterized(len(t) > MAX_VECTOR_POINTS)
    pieces.set_array(0.5 * (t[cuts[1:]] + t[cuts[:-1]]))
    pieces.set_clim(t[0], t[-1])
    ax.add_collection(pieces)
    ax.autoscale_view()
    if table.units[a] == table.units[b]:
        ax.set_aspect("equal", adjustable="datalim")
    places, _, labels = zip(*(table.labels[index].rpartition(".") for index in (a, b)))
    if places[0] == places[1]:
        ax.set_title(places[0])
    else:
        labels = [f"{place}\n{label}".strip() for place, label in zip(places, labels)]
    ax.set(xlabel=labels[0], ylabel=labels[1])
    ax.locator_params(nbins=5)
    return pieces


ENERGIES = ("kinetic", "strain", "potential")
PARTS = ("induced work", "profile work")  # of the work of air


def draw_energy(runs, options):
    """Changes of the energies above, works and losses below; what is less than a thousandth of the largest is left out."""
    table = runs[0].table("dynamic_energy.csv").between(options)
    columns = {name: y - y[0] for name, y in zip(table.names[1:], table.values.T[1:]) if name != "balance"}
    sizes = {name: np.nanmax(np.abs(y), initial=0) for name, y in columns.items()}
    shown = [name for name in columns if sizes[name] > 1e-3 * max(sizes.values()) > 0]
    groups = [[name for name in shown if (name in ENERGIES) == is_energy] for is_energy in (True, False)]
    groups = [names for names in groups if names]
    if not groups:
        raise Skip("no energy changes")
    figure, axes = panels(options, len(groups), "Changes of energies; works and losses"[: None if len(groups) > 1 else 19])
    t = table.values[:, 0]
    for ax, names in zip(axes, groups):
        for k, name in enumerate(names):
            dashes = DASHES[1] if name in PARTS else "-"
            ax.plot(t, columns[name], color=COLORS[k % 8], ls=dashes, label=name, **style(t))
        if names[0] in ENERGIES and len(names) > 1:
            ax.plot(t, sum(columns[name] for name in names), color="0.2", ls=DASHES[2], label="sum", **style(t))
        ax.set_ylabel("change of energy [J]" if names[0] in ENERGIES else "work, loss [J]")
        ax.margins(x=0.01)
    return finish(options, figure, axes, table.labels[0])
