"""How figures look: sizes and letters for print, panels above each other, legends, and measurements over curves."""

import re
import textwrap

import matplotlib.pyplot as plt
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
MAX_VECTOR_POINTS = 20000  # longer lines become pixels in SVG and PDF
MM = 1 / 25.4


class Skip(Exception):
    """There is nothing to draw; says why."""


class Wrong(Exception):
    """The command line asks for what cannot be; says what."""


def panels(options, n, title, height=36, ratios=None):
    """n panels above each other, with one abscissa, and their figure; height [mm] of one."""
    figure, axes = plt.subplots(
        n, 1, figsize=(options.width, (height * n + 14) * MM), sharex=True, squeeze=False, layout="constrained",
        gridspec_kw={"height_ratios": ratios},
    )
    figure.suptitle(title)
    return figure, axes[:, 0]


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
        figure = ax.figure
        columns = max(1, int((figure.get_figwidth() - 0.8) * 72 / (3.6 * max(map(len, labels)) + 30)))
        figure.set_figheight(figure.get_figheight() + 3.1 * MM * (-(-len(labels) // columns) - 1))
        ax.legend(handles, labels, ncol=columns, loc="lower left", bbox_to_anchor=(0, 1.01), borderaxespad=0, handlelength=1.8,
                  columnspacing=1.2, labelspacing=0.25, bbox_transform=ax.transAxes + ScaledTranslation(0, above * MM, figure.dpi_scale_trans))


def unit_of(label):
    match = re.search(r"\[([^\[\]]*)\]$", label)
    return match[1].replace("–", "") if match else ""


def draw_measured(options, axes, abscissa):
    """Points of each measurement that has this abscissa in the panels of their units."""
    options.abscissae[abscissa] = None
    for table in options.measured:
        if table.labels[0] != abscissa:
            continue
        options.shown.add(table.path)
        for k, (name, unit, y) in enumerate(zip(table.names[1:], table.units[1:], table.values.T[1:])):
            fitting = [ax for ax in axes if unit_of(ax.get_ylabel()) == unit.replace("–", "")]
            if not fitting:
                known = ", ".join(f"'{unit_of(ax.get_ylabel())}'" for ax in axes)
                raise Wrong(f"{table.path.name}: no panel has the unit '{unit}' of '{name}'; there are: {known}")
            ax = next((ax for ax in fitting if ax.get_ylabel().split(" [")[0] in name), fitting[0])
            label = f"{table.path.stem}: {name}"
            ax.plot(table.values[:, 0], y, MARKERS[k % 12], mfc="none", ms=4, mew=0.8, color="0.1", zorder=4, label=label)


def style(x):
    """How to draw a line through so many points."""
    if len(x) <= 40:
        return {"marker": "o", "ms": 2}
    return {"rasterized": True, "lw": 0.6} if len(x) > MAX_VECTOR_POINTS else {}


def colour_bar(figure, cax, norm, map_, label, **more):
    bar = figure.colorbar(plt.cm.ScalarMappable(norm, map_), cax=cax, label=label, **more)
    bar.outline.set_visible(False)
    bar.locator = plt.MaxNLocator(5)


def save(figure, path, options):
    """Powers of ten stand in the labels, not at the corners of the panels."""
    if options.no_title and figure._suptitle:
        figure._suptitle.remove()
        figure._suptitle = None
    elif figure._suptitle:
        lines = figure._suptitle.get_text().split("\n")
        figure.suptitle("\n".join(part for line in lines for part in textwrap.wrap(line, int(17 * options.width))))
    figure.draw_without_rendering()
    for ax in figure.axes:
        for axis in (ax.xaxis, ax.yaxis):
            power = axis.get_offset_text().get_text().replace(r"\times", "")
            if power:
                label = axis.get_label_text()
                axis.get_offset_text().set_visible(False)
                unit = re.search(r"\[([^\[\]]*)\]$", label)
                axis.set_label_text(f"{label[: unit.start()]}[{power} {unit[1]}]" if unit else f"{label} [{power}]")
    for kind, metadata in [("pdf", {"CreationDate": None})] if options.pdf else [("png", None), ("svg", {"Date": None})]:
        figure.savefig(path.with_name(f"{path.name}.{kind}"), dpi=200, metadata=metadata)
        print(path.with_name(f"{path.name}.{kind}"))
    plt.close(figure)
