"""A rotor or a wing in its air: surfaces coloured by what the air does to them, the web of a disk by its inflow; drawn by contrib/plot."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap

from plot_maps import FIELDS, limits

DEFAULT = "lift coefficient"
LOAD_COLORS = LinearSegmentedColormap.from_list("samara loads", ["#1f5fa8", "#8fc1d9", "#f3efe6", "#f0b93a", "#cf3a4b"])
FLOW_COLORS = LinearSegmentedColormap.from_list("samara flow", ["#440f6b", "#2f5f9e", "#2f9e8f", "#7cc653", "#d9cf2f"])
BODY = np.array([0.75, 0.77, 0.79, 1])


class NoAir(Exception):
    """There is nothing to draw; says why."""


def cells_of(picture, name):
    """Numbers of the cells of surfaces, of disks and of all else, and the means of the field, or of the inflow, over them."""
    if name not in picture.fields or name not in FIELDS:
        known = ", ".join(field for field in FIELDS if field in picture.fields)
        raise NoAir(f"the picture has no field '{name}' of surfaces; there are: {known or 'none'}")
    # a disk has inflow alone
    load = picture.fields[name]
    on_surface = np.isfinite(picture.fields["Mach"])
    flow = np.where(on_surface, np.nan, picture.fields.get("inflow", np.full(len(load), np.nan)))
    means = {"surfaces": {}, "disks": {}, "others": {}}
    for k, points in enumerate(picture.cells):
        if len(points) > 2 and on_surface[points].all():
            means["surfaces"][k] = load[points].mean()
        elif np.isfinite(flow[points]).all():
            means["disks"][k] = flow[points].mean()
        else:
            means["others"][k] = np.nan
    if not means["surfaces"]:
        raise NoAir("no pictures of surfaces")
    return means


def norm_of(means):
    values = np.array(list(means.values()))
    return plt.Normalize(*limits(values))


def draw_air(picture, name, view):
    """@p view: the module with the eye, what it sees and how it is shaded."""
    name = name or DEFAULT
    means = cells_of(picture, name)
    bars = [(name, norm_of(means["surfaces"]), LOAD_COLORS)]
    colors = {k: LOAD_COLORS(bars[0][1](value)) for k, value in means["surfaces"].items()}
    if means["disks"]:
        bars.append(("inflow", norm_of(means["disks"]), FLOW_COLORS))
        colors.update({k: FLOW_COLORS(bars[1][1](value)) for k, value in means["disks"].items()})
    corners = [picture.points[p] for p in picture.cells]
    faces = view.shaded([colors.get(k, BODY) for k in range(len(corners))], corners)
    for k in means["disks"]:  # lines have no side
        faces[k] = colors[k]
    widths = [1.8 if k in means["disks"] else 0.2 for k in range(len(corners))]
    # surfaces over the bodies that they enclose, webs behind all
    layers = [0 if k in means["disks"] else 2 if k in means["surfaces"] else 1 for k in range(len(corners))]
    order = np.lexsort(([c.mean(axis=0) @ view.TO_EYE for c in corners], layers))
    figure = plt.figure(figsize=(10, 6.5))
    ax = figure.add_axes([0.03, 0.03, 0.8, 0.88])
    ax.add_collection(
        PolyCollection(
            [corners[k] @ view.SCREEN for k in order],
            facecolors=faces[order],
            edgecolors=faces[order],
            linewidths=[widths[k] for k in order],
            rasterized=True,
        )
    )
    view.fit(ax, picture.points @ view.SCREEN)
    view.draw_scale(ax)
    view.draw_directions(figure, [0.01, 0.01, 0.14, 0.2])
    for k, (label, norm, map_) in enumerate(bars):
        bar = figure.colorbar(plt.cm.ScalarMappable(norm, map_), cax=figure.add_axes([0.88, 0.54 - 0.42 * k, 0.02, 0.34]), extend="both")
        bar.set_label(label + (f" [{FIELDS[label]}]" if FIELDS[label] else ""))
        bar.outline.set_visible(False)
    figure.suptitle(f"Surfaces by their {name}" + (", disks by the inflow" if means["disks"] else ""))
    return figure
