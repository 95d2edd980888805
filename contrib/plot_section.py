"""Cross-sections: materials, axes and centres, and maps of stresses; drawn by contrib/plot."""

import re

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import ListedColormap

from plot_pictures import Picture
from plot_style import COLORS, DASHES, MM, Skip, colour_bar, legend, panels

MAX_FILES = 4
MATERIALS = ListedColormap(["#9fb8d3", "#e3c088", "#a8c8a0", "#d8a8b0", "#b9a9d0", "#c8c8c8"])
CENTRES = {"tension centre": "o", "shear centre": "s", "mass centre": "^"}
STRESSES = {"stress_11_in_material": "stress 11 [MPa]", "stress_12_in_material": "stress 12 [MPa]"}
INDICES = ("index_Tsai_Wu", "index_max_stress", "index_von_Mises")
LEAST_CELL = 0.35 * MM  # on paper: of smaller elements the edges would hide the colours


def pictures(runs, pattern, options):
    found = sorted(runs[0].folder.glob(pattern))
    if not found:
        raise Skip(f"no {pattern}")
    if len(found) > MAX_FILES:
        options.say(f"the first {MAX_FILES} of {len(found)} files {pattern}")
    return [(path, Picture(path)) for path in found[:MAX_FILES]]


def draw_maps(options, title, maps, share, least, **colours):
    """A panel for each map, of which the section takes a share of the width: places of points, cells, values, map of colours
    and range. Where there is room, also the edges that are not between two cells of one element: those of the elements."""
    tall = [max(least, np.clip(share * options.width / MM * np.ptp(p[:, 1]) / np.ptp(p[:, 0]), 10, 70) + 16) for p, *_ in maps]
    figure, axes = panels(options, tall, title, sharex=False)
    drawn = []
    for ax, (places, cells, values, colors, limits) in zip(axes, maps):
        cells = np.array([cell for cell in cells if len(cell) == 4])
        edges = np.sort(np.concatenate([np.roll(cells, -k, axis=1)[:, :2] for k in range(4)]), axis=1)
        unique, count = np.unique(edges, axis=0, return_counts=True)
        # without snap, or cells thinner than a pixel, where they are upright rectangles, grow over their neighbours
        drawn.append(ax.add_collection(PolyCollection(places[cells], snap=False, rasterized=True, array=values[cells].mean(axis=1),
                                                      cmap=colors, clim=limits, **colours)))
        outline = places[unique[count == 1]]
        if np.median(np.linalg.norm(outline[:, 1] - outline[:, 0], axis=1)) * options.width > LEAST_CELL * np.ptp(places[:, 0]):
            ax.add_collection(LineCollection(outline, colors="0.45", linewidths=0.2))
        ax.autoscale_view()
        ax.set(aspect="equal", xlabel="axis 2 [m]", ylabel="axis 3 [m]")
        ax.locator_params(axis="y", nbins=4)
        ax.grid(False)
    return figure, axes, drawn


def draw_sections(runs, options):
    found = pictures(runs, "section_*.vtu", options)
    maps = [(p.points[:, 1:3], p.cells, p.fields["material"].round() % MATERIALS.N, MATERIALS, (-0.5, MATERIALS.N - 0.5)) for _, p in found]
    figure, axes, _ = draw_maps(options, "Sections: materials, elements, centres and principal axes of bending", maps, 0.8, 0)
    for ax, (path, _), (places, *_) in zip(axes, found, maps):
        path, title = path.with_suffix(".txt"), path.stem.removeprefix("section_")
        lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
        matches = (re.fullmatch(r"  (\S.*?)(?: \[[^]]*\])?\s+([-+.\deE]+)", line) for line in lines)  # name [unit] number
        known = {match[1]: float(match[2]) for match in matches if match}
        for color, (name, marker) in zip(COLORS, CENTRES.items()):
            if f"{name} 2" in known:
                ax.plot(known[f"{name} 2"], known[f"{name} 3"], marker, color=color, ms=5, mew=0.9, mfc="none", label=name)
        for k, name in enumerate(("axis of larger EI", "axis of smaller EI") if "angle of larger EI" in known else ()):
            centre = np.array([known.get("tension centre 2", 0), known.get("tension centre 3", 0)])
            angle = np.radians(known["angle of larger EI"] + 90 * k)
            direction = np.array([np.cos(angle), np.sin(angle)])
            half = direction / np.hypot(*(direction / (0.55 * np.ptp(places, axis=0))))
            ax.plot(*np.array([centre - half, centre + half]).T, color=COLORS[1 - k], lw=0.7, ls=DASHES[k], label=name)
        if "GJ" in known:
            title += f": GJ {known['GJ']:.3g}, EI {known['larger EI']:.3g}, {known['smaller EI']:.3g} N m²"
        ax.set_xlabel(f"axis 2 [m]\n{title}")
        ax.margins(0.05)
    legend(axes[0])
    return figure


def draw_stresses(runs, options):
    """At each place: stresses along and across the fibres, and the first index of failure that is known."""
    maps, labels = [], []
    for path, picture in pictures(runs, "stresses_*.vtu", options):
        if "place_in_section" not in picture.fields:
            raise Skip(f"{path.name} is of an older version")
        shown = {label: (1e-6 * picture.fields[name], "RdBu_r", -1) for name, label in STRESSES.items()}
        known = [name for name in INDICES if np.max(picture.fields[name]) >= 0]
        shown |= {name.replace("_", " ") + " [–]": (np.maximum(picture.fields[name], 0), "viridis", 0) for name in known[:1]}
        for label, (values, colors, low) in shown.items():
            largest = np.nanmax(np.abs(values)) or 1
            maps.append((picture.fields["place_in_section"][:, 1:3], picture.cells, values, colors, (low * largest, largest)))
            labels.append((path.stem.removeprefix("stresses_").replace("_", " "), label))
    title = "Stresses in the axes of the plies, and index of failure"
    figure, axes, drawn = draw_maps(options, title, maps, 0.65, 26, edgecolors="face", linewidths=0.1)
    for ax, cells, (place, label) in zip(axes, drawn, labels):
        colour_bar(figure, cells, ax, label, aspect=12)
        ax.set_title(place, fontsize=7)
    return figure
