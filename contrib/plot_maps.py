"""Maps of what the air does to a blade over azimuth and radius, drawn by contrib/plot."""

import matplotlib.pyplot as plt
import numpy as np

FIELDS = {
    "angle of attack": "deg",
    "Mach": "",
    "lift coefficient": "",
    "normal force": "N/m",
    "chord force": "N/m",
    "inflow": "m/s",
}
LEAST_PICTURES = 8  # of a turn


class NoMap(Exception):
    """There is nothing to draw; says why."""


def stations_of(picture, number):
    """Numbers of points, one for each station of the surface, from the axis outwards."""
    radius, azimuth = picture.fields["radius"], picture.fields["azimuth"]
    own = np.flatnonzero((picture.fields["object"] == number) & np.isfinite(radius) & np.isfinite(azimuth))
    _, first = np.unique(radius[own], return_index=True)
    return own[first]


def surfaces_of(picture):
    """Numbers of the objects that move on a disk."""
    if "azimuth" not in picture.fields:
        return []
    return sorted(set(picture.fields["object"][np.isfinite(picture.fields["azimuth"])].astype(int)))


def last_turn(azimuth):
    """The first of the rows that make the last full turn; azimuth [deg] of one station in the order of time."""
    turned = np.rad2deg(np.unwrap(np.deg2rad(azimuth)))
    full = np.flatnonzero(np.abs(turned[-1] - turned) >= 360 * (1 - 1e-6))
    if not len(full):
        raise NoMap(f"the pictures show {np.ptp(turned):.0f} degrees of a turn, and a map is one of 360")
    return full[-1]


def maps_of(pictures, number):
    """azimuth [rad], radius [m] and fields of the last full turn of a surface, an array (pictures, stations) each."""
    stations = [stations_of(picture, number) for picture in pictures]
    if len({len(s) for s in stations}) != 1 or len(stations[0]) < 2:
        raise NoMap("stations at the same radius cannot be told from each other")

    def values(name):
        return np.stack([picture.fields[name][s] for picture, s in zip(pictures, stations)])

    azimuth = values("azimuth")
    begin = last_turn(azimuth[:, -1])
    if len(pictures) - begin <= LEAST_PICTURES:
        raise NoMap(f"there are {len(pictures) - begin - 1} pictures of a turn, and a map wants {LEAST_PICTURES} or more")
    fields = {name: values(name)[begin:] for name in FIELDS if name in pictures[0].fields}
    return np.deg2rad(azimuth[begin:]), values("radius")[begin:], fields


def limits(values):
    """Of the colours: all values, without the few that are far away, as in reversed flow."""
    low, high = np.percentile(values, [5, 95])
    far = high - low
    return max(values.min(), low - far), min(values.max(), high + far)


def draw_maps(pictures, number):
    """@p number of the surface; the first one if it is None."""
    numbers = surfaces_of(pictures[0]) if pictures else []
    if not numbers:
        raise NoMap("no pictures of surfaces in an inflow")
    if number is not None and number not in numbers:
        raise NoMap(f"object {number} is no surface in an inflow; these are: {', '.join(map(str, numbers))}")
    azimuth, radius, fields = maps_of(pictures, numbers[0] if number is None else number)
    figure, axes = plt.subplots(2, 3, figsize=(11, 7.6), subplot_kw={"projection": "polar"}, layout="constrained")
    for ax in axes.flat[len(fields) :]:
        ax.set_axis_off()
    for ax, (name, values) in zip(axes.flat, fields.items()):
        ax.set_theta_zero_location("S")
        ax.grid(False)
        low, high = limits(values)
        mesh = ax.pcolormesh(azimuth, radius, values, shading="gouraud", vmin=low, vmax=high, rasterized=True)
        if values.min() < 0 < values.max():
            ax.contour(azimuth, radius, values, levels=[0], colors="w", linewidths=0.8)
        ax.set_rlim(0, 1.02 * radius.max())
        ax.set_rticks([])
        ax.set_title(name + (f" [{FIELDS[name]}]" if FIELDS[name] else ""))
        beyond = (values.min() < low) + 2 * (values.max() > high)
        bar = figure.colorbar(mesh, ax=ax, shrink=0.7, pad=0.08, extend=("neither", "min", "max", "both")[beyond])
        bar.outline.set_visible(False)
    figure.suptitle("The last turn of a blade, azimuth 0 below; white: zero")
    return figure
