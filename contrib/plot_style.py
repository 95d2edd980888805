"""How figures look: sizes and letters for print, panels above each other, legends, and measurements over curves."""

import difflib
import re
import textwrap

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.transforms import ScaledTranslation

COLORS = ["#1f5fa8", "#d1495b", "#2a9d5c", "#e08e1b", "#7b4fa3", "#17a2b8", "#8c564b", "#666666"]
DASHES = ["-", (0, (4, 1.2)), (0, (1, 1)), (0, (6, 1, 1, 1))]
MARKERS = "osD^vP*Xhd<>"
RED = "#d1495b"

STYLE = {  # of the figures of the pages
    "font.size": 11, "axes.titlesize": 12, "axes.grid": True, "axes.axisbelow": True, "grid.color": "0.9", "axes.edgecolor": "0.4",
    "axes.spines.top": False, "axes.spines.right": False, "axes.prop_cycle": plt.cycler(linestyle=DASHES[:2]) * plt.cycler(color=COLORS),
    "lines.linewidth": 1.6, "legend.frameon": False, "legend.fontsize": 10, "svg.hashsalt": "samara", "agg.path.chunksize": 20000,
}
PRINT = STYLE | {  # drawn as large as they are printed
    "font.size": 8, "axes.titlesize": 8, "axes.labelsize": 8, "figure.titlesize": 8, "xtick.labelsize": 7, "ytick.labelsize": 7,
    "legend.fontsize": 7, "lines.linewidth": 1, "lines.markersize": 3, "axes.linewidth": 0.6, "grid.linewidth": 0.5,
    "axes.formatter.useoffset": False, "axes.formatter.limits": (-3, 4), "axes.formatter.use_mathtext": True, "pdf.fonttype": 42,
}
MM = 1 / 25.4
NARROW = 110 * MM  # of figures: what is less is one column of a journal
HERTZ = (lambda w: w / (2 * np.pi), lambda f: 2 * np.pi * f)


class Skip(Exception):
    """There is nothing to draw; says why."""


class Wrong(Exception):
    """The command line asks for what cannot be; says what."""


def nearest(word, words):
    near = difflib.get_close_matches(word, words, 1, 0)
    return f"; the nearest is '{near[0]}'" if near else ""


def panels(options, heights, title, sharex=True):
    """Panels of these heights [mm] above each other, with one abscissa, and their figure."""
    figure, axes = plt.subplots(len(heights), 1, figsize=(options.width, (sum(heights) + 14) * MM), sharex=sharex, squeeze=False,
                                layout="constrained", gridspec_kw={"height_ratios": heights})
    figure.suptitle(title)
    return figure, axes[:, 0]


def look(r, n_runs, k=0):
    """Line k of run r. One run: a colour a line. Several: a colour a run, dashes a line; where they agree, the later and
    thinner ones lie within the first."""
    if n_runs == 1:
        return {"color": COLORS[k % 8], "ls": DASHES[k // 8 % 4]}
    return {"color": COLORS[r % 8], "ls": DASHES[k % 4], "lw": np.linspace(2.6, 0.7, n_runs)[r]}


def name_runs(ax, runs, names):
    """For the legend of several runs: the dashes of the lines, and in the first panel the colours of the runs."""
    for r, run in enumerate(runs if len(runs) > 1 and ax.get_subplotspec().is_first_row() else []):
        ax.plot([], [], **look(r, len(runs)), label=run.name)
    for k, name in enumerate(names if len(runs) > 1 else []):
        ax.plot([], [], color="0.3", ls=DASHES[k % 4], label=name)


def logarithmic(axis, values):
    """If they are positive and of different sizes; ticks of few decades are plain numbers."""
    low, high = np.nanmin(values, initial=np.inf), np.nanmax(values, initial=0)
    if high > 2 * low > 0:
        axis._set_axes_scale("log")
        axis.axes.set(**{f"{axis.axis_name}lim": (0.8 * low, 1.25 * high)})
        if high < 50 * low:
            axis.set_major_locator(plt.LogLocator(base=10, subs=(1, 3)) if high > 10 * low else plt.MaxNLocator(4))
            axis.set_major_formatter(plt.FuncFormatter(lambda x, _: f"{x:g}"))
            axis.set_minor_formatter(plt.NullFormatter())


def finish(options, figure, axes, abscissa, above=0):
    """Abscissa, measurements and legends; these stand `above` [mm] the panel."""
    axes[-1].set_xlabel(abscissa)
    draw_measured(options, axes, abscissa)
    for ax in axes:
        legend(ax, above=above if ax is axes[0] else 0)
    figure.align_ylabels(axes)
    return figure


def legend(ax, above=0):
    """Above the panel, in as many columns as there is room for; the figure grows by its rows."""
    handles, labels = ax.get_legend_handles_labels()
    if labels:
        columns = max(1, int((ax.figure.get_figwidth() - 0.8) * 72 / (3.6 * max(map(len, labels)) + 30)))
        ax.figure.set_figheight(ax.figure.get_figheight() + 3.1 * MM * (-(-len(labels) // columns) - 1))
        ax.legend(handles, labels, ncol=columns, loc="lower left", bbox_to_anchor=(0, 1.01), borderaxespad=0, handlelength=1.8,
                  columnspacing=1.2, labelspacing=0.25, bbox_transform=ax.transAxes + ScaledTranslation(0, above * MM, ax.figure.dpi_scale_trans))


def name_of(label):
    return re.sub(r"\s*\[[^\[\]]*\]$", "", label.strip())


def unit_of(label):
    return label.strip()[len(name_of(label)) :].strip(" []–")


def draw_measured(options, axes, abscissa):
    """Points of each measurement that has this abscissa in the panels of their units."""
    options.abscissae[abscissa] = None
    for path, rows in options.over.items():
        if rows.columns[0] != abscissa:
            continue
        options.shown.add(path)
        for k, label in enumerate(rows.columns[1:]):
            fitting = [ax for ax in axes if unit_of(ax.get_ylabel()) == unit_of(label)]
            if not fitting:
                known = ", ".join(f"'{unit_of(ax.get_ylabel())}'" for ax in axes)
                raise Wrong(f"{path.name}: no panel has the unit '{unit_of(label)}' of '{name_of(label)}'; there are: {known}")
            ax = next((ax for ax in fitting if name_of(ax.get_ylabel()) in label), fitting[0])
            ax.plot(rows[abscissa], rows[label], MARKERS[k % 12], mfc="none", ms=4, mew=0.8, color="0.1", zorder=4,
                    label=f"{path.stem}: {name_of(label)}")


def colour_bar(figure, drawn, ax, label, **more):
    bar = figure.colorbar(drawn, ax=ax, label=label, **more)
    bar.outline.set_visible(False)
    bar.locator = plt.MaxNLocator(4)


TITLE_LETTERS = 136  # that fit into an inch, times their size in points: letters are half as wide as high


def save(figure, path, options):
    """Powers of ten stand in the labels, not at the corners of the panels."""
    fitting = int(TITLE_LETTERS / figure._suptitle.get_fontsize() * options.width)
    title = [part for line in figure._suptitle.get_text().split("\n") for part in textwrap.wrap(line, fitting)]
    figure.suptitle("" if options.no_title else "\n".join(title))
    figure.draw_without_rendering()
    for axis in (axis for ax in figure.axes for axis in (ax.xaxis, ax.yaxis)):
        power = axis.get_offset_text().get_text().replace(r"\times", "")
        if power:
            name, bracket, unit = axis.get_label_text().partition("[")
            axis.get_offset_text().set_visible(False)
            axis.set_label_text(f"{name}[{power} {unit}" if bracket else f"{name} [{power}]")
    for kind, metadata in [("pdf", {"CreationDate": None})] if options.pdf else [("png", None), ("svg", {"Date": None})]:
        figure.savefig(path.with_name(f"{path.name}.{kind}"), dpi=200, metadata=metadata)
        print(path.with_name(f"{path.name}.{kind}"))
    plt.close(figure)
