"""Figures of cross-sections: materials, axes and centres, and maps of stresses; drawn by contrib/plot."""

import csv
import re

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

MAX_SECTIONS = 6
MAX_MAPS = 4
MATERIALS = ["#9fb8d3", "#e3c088", "#a8c8a0", "#d8a8b0", "#b9a9d0", "#c8c8c8"]
CENTRES = {
    "tension centre": ("o", "#1f5fa8"),
    "shear centre": ("s", "#d1495b"),
    "mass centre": ("^", "#2a9d5c"),
}


class NoSection(Exception):
    """There is nothing to draw; says why."""


def numbers_of(path):
    """The lines <name [unit] number> of a section's text as a dictionary."""
    found = {}
    if path.exists():
        for line in path.read_text(encoding="utf-8").splitlines():
            if match := re.fullmatch(r"  (\S.*?)(?: \[[^]]*\])?\s+([-+.\deE]+)", line):
                found[match[1]] = float(match[2])
    return found


def polygons(picture, places):
    return places[np.array([cell for cell in picture.cells if len(cell) == 4])]


def outlines(picture, places):
    """The edges of the small cells that are not between two of them of one element: those of the elements."""
    cells = np.array([cell for cell in picture.cells if len(cell) == 4])
    edges = np.sort(np.concatenate([np.roll(cells, -k, axis=1)[:, :2] for k in range(4)]), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    return places[unique[count == 1]]


def at_cells(picture, values):
    """Means over the corners of the cells."""
    return np.array([values[cell].mean(axis=0) for cell in picture.cells if len(cell) == 4])


def draw_one(ax, folder, path, read_picture):
    picture = read_picture(path)
    places = picture.points[:, 1:3]
    materials = at_cells(picture, picture.fields["material"])
    colors = [MATERIALS[int(round(m)) % len(MATERIALS)] for m in materials]
    ax.add_collection(PolyCollection(polygons(picture, places), facecolors=colors, edgecolors="none", snap=False))
    ax.add_collection(LineCollection(outlines(picture, places), colors="0.45", linewidths=0.3))

    numbers = numbers_of(path.with_suffix(".txt"))
    for name, (marker, color) in CENTRES.items():
        if f"{name} 2" in numbers and f"{name} 3" in numbers:
            ax.plot(numbers[f"{name} 2"], numbers[f"{name} 3"], marker, color=color, ms=7, mew=1.5, mfc="none", label=name)
    if "angle of larger EI" in numbers:
        angle = np.radians(numbers["angle of larger EI"])
        centre = np.array([numbers.get("tension centre 2", 0), numbers.get("tension centre 3", 0)])
        half = 0.55 * np.ptp(places, axis=0)
        for k, label in ((0, "axis of larger EI"), (1, "axis of smaller EI")):
            direction = np.array([np.cos(angle + k * np.pi / 2), np.sin(angle + k * np.pi / 2)])
            length = 1 / np.hypot(*(direction / half))
            ends = np.array([centre - length * direction, centre + length * direction])
            ax.plot(*ends.T, color="#d1495b" if k == 0 else "#1f5fa8", lw=1, ls="-" if k == 0 else (0, (4, 2)), label=label)
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.margins(0.05)
    ax.grid(False)
    title = path.stem.removeprefix("section_")
    if "GJ" in numbers:
        title += f": EA {numbers['EA']:.3g} N, GJ {numbers['GJ']:.3g}, EI {numbers['larger EI']:.3g}, {numbers['smaller EI']:.3g} N m²"
    ax.set_title(title, fontsize=10)
    ax.set_ylabel("axis 3 [m]")


def draw_sections(folder, read_picture):
    paths = sorted(folder.glob("section_*.vtu"))[:MAX_SECTIONS]
    if not paths:
        raise NoSection("no section_<name>.vtu")
    figure, axes = plt.subplots(len(paths), 1, figsize=(9, 0.7 + 2.6 * len(paths)), squeeze=False, layout="constrained")
    for ax, path in zip(axes[:, 0], paths):
        draw_one(ax, folder, path, read_picture)
    axes[-1, 0].set_xlabel("axis 2 [m]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    if handles:
        figure.legend(handles, labels, loc="lower center", ncol=5, bbox_to_anchor=(0.5, -0.04), fontsize=9)
    figure.suptitle("Sections: materials, elements, centres and principal axes of bending")
    return figure


def draw_map(figure, ax, picture, places, values, label, is_signed):
    largest = np.nanmax(np.abs(values)) or 1
    cells = PolyCollection(
        polygons(picture, places),
        array=at_cells(picture, values),
        cmap="RdBu_r" if is_signed else "viridis",
        edgecolors="face",
        linewidths=0.1,
        snap=False,  # or cells thinner than a pixel, where they are upright rectangles, grow over their neighbours
    )
    cells.set_clim(-largest if is_signed else 0, largest)
    ax.add_collection(cells)
    ax.add_collection(LineCollection(outlines(picture, places), colors="0.5", linewidths=0.2))
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.margins(0.03)
    ax.grid(False)
    ax.set_ylabel("axis 3 [m]")
    bar = figure.colorbar(cells, ax=ax, label=label, aspect=12)
    bar.outline.set_visible(False)


def draw_stresses(folder, read_picture):
    paths = sorted(folder.glob("stresses_*.vtu"))[:MAX_MAPS]
    if not paths:
        raise NoSection("no stresses_<place>.vtu")
    maps = [("stress_11_in_material", "along the fibres [MPa]", 1e-6), ("stress_12_in_material", "shear 12 [MPa]", 1e-6)]
    indices = ["index_Tsai_Wu", "index_max_stress", "index_von_Mises"]
    figure, axes = plt.subplots(
        3 * len(paths), 1, figsize=(9, 0.7 + 7.2 * len(paths)), squeeze=False, layout="constrained"
    )
    for k, path in enumerate(paths):
        picture = read_picture(path)
        if "place_in_section" not in picture.fields:
            raise NoSection(f"{path.name} is of an older version")
        places = picture.fields["place_in_section"][:, 1:3]
        for ax, (name, label, factor) in zip(axes[3 * k :, 0], maps):
            draw_map(figure, ax, picture, places, factor * picture.fields[name], label, True)
        known = [name for name in indices if np.max(picture.fields[name]) >= 0]
        ax = axes[3 * k + 2, 0]
        if known:
            draw_map(figure, ax, picture, places, np.maximum(picture.fields[known[0]], 0), known[0].replace("_", " "), False)
        else:
            ax.set_axis_off()
        axes[3 * k, 0].set_title(path.stem.removeprefix("stresses_").replace("_", " "))
    axes[-1, 0].set_xlabel("axis 2 [m]")
    figure.suptitle("Stresses in the axes of the plies, and index of failure")
    return figure


def draw_plies(folder):
    """Index of failure of each layer of each wall, a panel for each place."""
    path = folder / "stresses_of_plies.csv"
    if not path.exists():
        raise NoSection("no stresses_of_plies.csv")
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    places = list(dict.fromkeys((row["place"], row["time [s]"]) for row in rows))[:MAX_MAPS]
    materials = list(dict.fromkeys(row["material"] for row in rows))
    known = [
        name
        for name in ("index of Tsai-Wu", "index of Hashin", "index of max stress", "index of von Mises")
        if any(np.isfinite(float(row[name] or "nan")) for row in rows)
    ]
    if not known:
        raise NoSection("no strengths are known")
    figure, axes = plt.subplots(len(places), 1, figsize=(10, 0.8 + 3.4 * len(places)), squeeze=False, layout="constrained")
    for ax, (place, time) in zip(axes[:, 0], places):
        here = [row for row in rows if (row["place"], row["time [s]"]) == (place, time)]
        x, wall = 0, None
        for row in here:
            if wall is not None and row["wall"] != wall:
                x += 1
            if row["wall"] != wall:
                ax.text(x - 0.4, 0.99, f"wall {row['wall']}" if row["wall"].isdigit() else row["wall"], transform=ax.get_xaxis_transform(), va="top", fontsize=10)
            wall = row["wall"]
            color = MATERIALS[materials.index(row["material"]) % len(MATERIALS)]
            value = float(row[known[0]] or "nan")
            ax.bar(x, value, 0.85, color=color, label=row["material"])
            ax.text(x, 0, f"{float(row['angle [deg]']):.3g}°", ha="center", va="bottom", fontsize=8, rotation=90)
            x += 1
        ax.set_xticks([])
        ax.margins(y=0.18)
        ax.set_ylabel(known[0])
        ax.set_title(f"{place}, t = {float(time):.4g} s: layers from outside to inside")
        unique = dict(zip(*reversed(ax.get_legend_handles_labels())))
        ax.legend(unique.values(), unique.keys(), loc="upper right")
    return figure
