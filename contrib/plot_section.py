"""Cross-sections: materials, axes and centres, and maps of stresses; drawn by contrib/plot."""

import re

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from plot_pictures import Picture
from plot_style import COLORS, DASHES, MM, Skip, legend, panels
from plot_tables import numbers, texts

MAX_PANELS = 4
MATERIALS = ["#9fb8d3", "#e3c088", "#a8c8a0", "#d8a8b0", "#b9a9d0", "#c8c8c8"]
CENTRES = {"tension centre": "o", "shear centre": "s", "mass centre": "^"}
INDICES = ["index of Tsai-Wu", "index of Hashin", "index of max stress", "index of von Mises"]


def numbers_of(path):
    """The lines <name [unit] number> of a section's text as a dictionary."""
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    found = (re.fullmatch(r"  (\S.*?)(?: \[[^]]*\])?\s+([-+.\deE]+)", line) for line in lines)
    return {match[1]: float(match[2]) for match in found if match}


def draw_cells(ax, picture, places, **colours):
    """The cells, and the edges of the small ones that are not between two of them of one element: those of the elements."""
    cells = np.array([cell for cell in picture.cells if len(cell) == 4])
    edges = np.sort(np.concatenate([np.roll(cells, -k, axis=1)[:, :2] for k in range(4)]), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    # without snap, or cells thinner than a pixel, where they are upright rectangles, grow over their neighbours
    drawn = ax.add_collection(PolyCollection(places[cells], snap=False, rasterized=True, **colours))
    ax.add_collection(LineCollection(places[unique[count == 1]], colors="0.45", linewidths=0.2))
    ax.autoscale_view()
    ax.set(aspect="equal", xlabel="axis 2 [m]", ylabel="axis 3 [m]")
    ax.locator_params(axis="y", nbins=4)
    ax.grid(False)
    return drawn


def at_cells(picture, values):
    """Means over the corners of the cells."""
    return np.array([values[cell].mean(axis=0) for cell in picture.cells if len(cell) == 4])


def pictures(runs, pattern):
    found = [(path, Picture(path)) for path in sorted(runs[0].folder.glob(pattern))[:MAX_PANELS]]
    if not found:
        raise Skip(f"no {pattern}")
    return found


def heights(all_places, options, share):
    """[mm] of panels as wide as the figure, of which the sections take a share."""
    return [np.clip(share * options.width / MM * np.ptp(p[:, 1]) / np.ptp(p[:, 0]), 10, 70) + 16 for p in all_places]


def draw_sections(runs, options):
    found = pictures(runs, "section_*.vtu")
    all_places = [picture.points[:, 1:3] for _, picture in found]
    tall = heights(all_places, options, 0.8)
    figure, axes = plt.subplots(len(found), 1, figsize=(options.width, (sum(tall) + 16) * MM), squeeze=False, layout="constrained",
                                gridspec_kw={"height_ratios": tall})
    for ax, (path, picture), places in zip(axes[:, 0], found, all_places):
        materials = at_cells(picture, picture.fields["material"]).round().astype(int)
        draw_cells(ax, picture, places, facecolors=[MATERIALS[m % len(MATERIALS)] for m in materials], edgecolors="none")
        known = numbers_of(path.with_suffix(".txt"))
        for color, (name, marker) in zip(COLORS, CENTRES.items()):
            if f"{name} 2" in known:
                ax.plot(known[f"{name} 2"], known[f"{name} 3"], marker, color=color, ms=5, mew=0.9, mfc="none", label=name)
        if "angle of larger EI" in known:
            centre = np.array([known.get("tension centre 2", 0), known.get("tension centre 3", 0)])
            for k, name in enumerate(("axis of larger EI", "axis of smaller EI")):
                angle = np.radians(known["angle of larger EI"] + 90 * k)
                direction = np.array([np.cos(angle), np.sin(angle)])
                half = direction / np.hypot(*(direction / (0.55 * np.ptp(places, axis=0))))
                ax.plot(*np.array([centre - half, centre + half]).T, color=COLORS[1 - k], lw=0.7, ls=DASHES[k], label=name)
        title = path.stem.removeprefix("section_")
        if "GJ" in known:
            title += f": GJ {known['GJ']:.3g}, EI {known['larger EI']:.3g}, {known['smaller EI']:.3g} N m²"
        ax.set_xlabel(f"axis 2 [m]\n{title}")
        ax.margins(0.05)
    legend(axes[0, 0])
    figure.suptitle("Sections: materials, elements, centres and principal axes of bending")
    return figure


def draw_stresses(runs, options):
    """At each place: stresses along and across the fibres, and the first index of failure that is known."""
    maps = []
    for path, picture in pictures(runs, "stresses_*.vtu"):
        if "place_in_section" not in picture.fields:
            raise Skip(f"{path.name} is of an older version")
        place = path.stem.removeprefix("stresses_").replace("_", " ")
        maps += [(picture, place, f"{label} [MPa]", 1e-6 * picture.fields[name], True)
                 for name, label in (("stress_11_in_material", "stress 11"), ("stress_12_in_material", "stress 12"))]
        known = [name for name in ("index_Tsai_Wu", "index_max_stress", "index_von_Mises") if np.max(picture.fields[name]) >= 0]
        maps += [(picture, place, f"{name.replace('_', ' ')} [–]", np.maximum(picture.fields[name], 0), False) for name in known[:1]]
    all_places = [picture.fields["place_in_section"][:, 1:3] for picture, *_ in maps]
    tall = [max(height, 26) for height in heights(all_places, options, 0.65)]
    figure, axes = plt.subplots(len(maps), 1, figsize=(options.width, (sum(tall) + 8) * MM), squeeze=False, layout="constrained",
                                gridspec_kw={"height_ratios": tall})
    for ax, places, (picture, place, label, values, signed) in zip(axes[:, 0], all_places, maps):
        largest = np.nanmax(np.abs(values)) or 1
        cells = draw_cells(ax, picture, places, array=at_cells(picture, values), cmap="RdBu_r" if signed else "viridis",
                           edgecolors="face", linewidths=0.1, clim=(-largest if signed else 0, largest))
        bar = figure.colorbar(cells, ax=ax, label=label, aspect=12)
        bar.outline.set_visible(False)
        bar.locator = plt.MaxNLocator(4)
        ax.set_title(place, fontsize=7)
    figure.suptitle("Stresses in the axes of the plies, and index of failure")
    return figure


def draw_plies(runs, options):
    """Index of failure of each layer of each wall, a panel for each place."""
    rows = texts(runs[0].folder / "stresses_of_plies.csv")
    index = next((name for name in INDICES if name in rows.columns and np.isfinite(numbers(rows[name])).any()), None)
    if index is None:
        raise Skip("no strengths are known")
    groups = list(rows.groupby(["place", "time [s]"], sort=False))[:MAX_PANELS]
    materials = list(rows["material"].unique())
    figure, axes = panels(options, len(groups), "Index of failure of layers from outside to inside", 45)
    for ax, ((place, time), here) in zip(axes, groups):
        walls = here["wall"].to_numpy()
        x = np.arange(len(here)) + np.cumsum(np.append(0, walls[1:] != walls[:-1]))
        values, angles = numbers(here[index]), numbers(here["angle [deg]"])
        for k, material in enumerate(materials):
            own = (here["material"] == material).to_numpy()
            ax.bar(x[own], values[own], 0.85, color=MATERIALS[k % len(MATERIALS)], label=material)
        for place_, angle in zip(x, angles):
            ax.text(place_, 0, f" {angle:.3g}°", ha="center", va="bottom", fontsize=6 if len(x) < 45 else 4, rotation=90)
        for wall in dict.fromkeys(walls):
            ax.text(x[walls == wall].mean(), 0.99, f"wall {wall}" if wall.isdigit() else wall, transform=ax.get_xaxis_transform(),
                    ha="center", va="top", fontsize=7)
        ax.set_xticks([])
        ax.margins(x=0.01, y=0.15)
        ax.set_ylabel(f"{index} [–]")
        ax.set_xlabel(f"{place}, t = {float(time):.4g} s")
        legend(ax)
    return figure
