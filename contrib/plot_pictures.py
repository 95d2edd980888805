"""Pictures of models: shapes, modes and maps of rotors; drawn by contrib/plot.

Models are seen along parallel rays and painted from back to front into plain axes: these can be filled by the model,
which the 3D axes of matplotlib cannot.
"""

import xml.etree.ElementTree as xml

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap

from plot_style import MM, NARROW, Skip, Wrong, colour_bar
from plot_tables import texts

COLORS = LinearSegmentedColormap.from_list("samara", ["#a9b8c6", "#e6a04b", "#cf3a4b"])  # quiet where nothing moves
FIELDS = {"angle of attack": "deg", "Mach": "–", "lift coefficient": "–", "normal force": "N/m", "chord force": "N/m", "inflow": "m/s"}
LEAST_PICTURES = 8  # of a turn
ROUND_OFF = 1e-8  # of the model's size: less is no displacement
MAX_MODES = 8

AZIMUTH, ELEVATION = np.radians([-58, 24])  # where the eye is
TO_EYE = np.array([np.cos(ELEVATION) * np.cos(AZIMUTH), np.cos(ELEVATION) * np.sin(AZIMUTH), np.sin(ELEVATION)])
RIGHT = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0])
SCREEN = np.column_stack([RIGHT, np.cross(TO_EYE, RIGHT)])  # points @ SCREEN are (right, up)
LIGHT = np.array([0.1, -0.55, 0.83])


class Picture:
    """A .vtu file: points (n, 3), cells as lists of point numbers, one for a point, two for a line, and point data by name."""

    def __init__(self, path):
        import meshio  # late: it takes its time

        try:
            mesh = meshio.vtu.read(path)
        except (OSError, meshio.ReadError, xml.ParseError, AttributeError, ValueError, KeyError, IndexError) as error:
            raise Skip(f"cannot read {path.name}: {error}") from error
        self.points = np.asarray(mesh.points, float)
        self.cells = [cell for block in mesh.cells for cell in block.data]
        self.fields = mesh.point_data

    @property
    def displacement(self):
        return self.fields.get("displacement", np.zeros_like(self.points))


def series_in_time(path):
    """The times and files of a .pvd file."""
    try:
        sets = xml.parse(path).getroot().findall("./Collection/DataSet")
    except (OSError, xml.ParseError):
        sets = []
    if not sets:
        raise Skip(f"no {path.name} with pictures")
    return sorted(((float(s.get("timestep", 0)), path.parent / s.get("file")) for s in sets), key=lambda pair: pair[0])


def series(path):
    """The files of a .pvd file in the order of time."""
    return [file for _, file in series_in_time(path)]


def shaded(colors, corners):
    """Colours of polygons, darker where they turn from the light; lines and points have no side."""
    normals = np.array([np.cross(c[2] - c[0], c[-1] - c[1]) if len(c) > 2 else np.zeros(3) for c in corners])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals /= np.where(lengths > 0, lengths, 1)
    normals *= np.where(normals @ TO_EYE < 0, -1, 1)[:, None]  # the side that is seen
    colors = np.array(colors)
    colors[:, :3] *= (0.72 + 0.28 * np.clip(normals @ LIGHT, -0.5, 1))[:, None]
    return np.clip(colors, 0, 1)


def draw_model(ax, picture, undeformed):
    """Paints the cells by their displacement from back to front, and lightly where they were."""
    sizes = np.linalg.norm(picture.points - undeformed, axis=1)
    largest = max(sizes.max(), ROUND_OFF * np.ptp(picture.points, axis=0).max(), 1e-300)
    moved = [p for p in picture.cells if sizes[p].max() > 1e-3 * largest]
    corners = [picture.points[p] for p in picture.cells] + [undeformed[p] for p in moved]
    faces = shaded(COLORS([sizes[p].mean() / largest for p in picture.cells]), corners[: len(picture.cells)])
    grey = np.tile([0.55, 0.55, 0.55, 0.25], (len(moved), 1))
    faces, edges = np.vstack([faces, grey * [1, 1, 1, 0.4]]), np.vstack([faces * [0.8, 0.8, 0.8, 1], grey])
    order = np.argsort([c.mean(axis=0) @ TO_EYE for c in corners])
    ax.add_collection(PolyCollection([corners[i] @ SCREEN for i in order], facecolors=faces[order], edgecolors=edges[order],
                                     linewidths=0.2, rasterized=True))
    fit(ax, np.vstack([picture.points, undeformed]) @ SCREEN)


def fit(ax, places):
    low, high = places.min(axis=0), places.max(axis=0)
    margin = 0.02 * max((high - low).max(), 1e-9)
    ax.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin), aspect="equal")
    ax.set_axis_off()


def draw_grid(options, models, n_columns, title):
    """Models with their titles, pictures and the places of points from which displacements count, in grey; None stays empty."""
    n_rows = -(-len(models) // n_columns)
    width, height = np.max([np.ptp(np.vstack([picture.points, middle]) @ SCREEN, axis=0) for _, picture, middle in filter(None, models)], axis=0)
    row = 10 * MM + np.clip(options.width / n_columns * height / max(width, 1e-9), 5 * MM, 70 * MM)
    figure = plt.figure(figsize=(options.width, row * n_rows + 8 * MM), layout="constrained")
    for k, model in enumerate(models):
        if model:
            name, picture, middle = model
            ax = figure.add_subplot(n_rows, n_columns, k + 1, anchor="N")
            ax.set_title(name, fontsize=7, linespacing=1.2)
            draw_model(ax, picture, middle)
    figure.suptitle(title)
    return figure


def draw_shape(runs, options):
    picture = Picture(series(runs[0].folder / "static.pvd")[-1])
    if not len(picture.points):
        raise Skip("the last picture of static.pvd is empty")
    name = f"largest displacement {np.linalg.norm(picture.displacement, axis=1).max():.4g} m"
    return draw_grid(options, [(name, picture, picture.points - picture.displacement)], 1, "Deformed model, the undeformed one in grey")


def largest_deflection(files):
    """The picture that is farthest from the middle of the motion, and the points of the middle."""
    pictures = [Picture(file) for file in files]
    if not len(pictures[0].points) or any(p.points.shape != pictures[0].points.shape for p in pictures):
        raise Skip(f"the pictures of {files[0].name} are empty, or differ in their number of points")
    places = np.stack([p.points for p in pictures])
    middle = 0.5 * (places.min(axis=0) + places.max(axis=0))
    if len(pictures) == 1:
        middle = pictures[0].points - pictures[0].displacement
    sizes = np.linalg.norm(places - middle, axis=2).max(axis=1)
    return pictures[int(np.argmax(sizes))], middle


def modes_of(run):
    """Mode number -> its pictures and its frequency and name; these are in modes.csv."""
    found = {}
    for _, row in texts(run.folder / "modes.csv").iterrows():
        path = run.folder / f"mode_{row.get('mode')}.pvd"
        if path.exists():
            name = ", ".join(filter(None, (row.get("family"), row.get("pattern"))))
            found[int(row["mode"])] = path, f"{float(row.get('frequency [Hz]', 'nan')):.4g} Hz\n{name}".strip()
    return found


def draw_modes(runs, options):
    """One run: a grid of its modes. Several: a row a mode, a column a run."""
    modes = [modes_of(run) for run in runs]
    shown = sorted(set().union(*modes))
    if not shown:
        raise Skip("no mode_<k>.pvd")
    if len(shown) > MAX_MODES:
        options.say(f"the first {MAX_MODES} of {len(shown)} modes")
    cells = [(f"{run.name}, {k}: " if len(runs) > 1 else f"{k}: ", of_run.get(k)) for k in shown[:MAX_MODES] for run, of_run in zip(runs, modes)]
    models = [mode and (prefix + mode[1], *largest_deflection(series(mode[0]))) for prefix, mode in cells]
    columns = len(runs) if len(runs) > 1 else min(len(cells), 2 if len(cells) in (2, 4) or options.width < NARROW else 3)
    return draw_grid(options, models, columns, "Mode shapes at their largest deflection")


def stations_of(pictures, number=None):
    """Radius [m], azimuth [deg] and fields of a surface that moves on a disk, the first if no number is given: by name an array
    (pictures, stations) each, from the axis outwards."""
    names = ["object", "radius", "azimuth", *FIELDS]
    if not any(np.isfinite(p.fields.get("azimuth", np.nan)).any() for p in pictures):
        raise Skip("no pictures of surfaces in an inflow")
    columns = [{name: p.fields.get(name, np.nan * p.fields["object"]) for name in names} for p in pictures]
    rows = pd.concat([pd.DataFrame(points).assign(picture=k) for k, points in enumerate(columns)]).dropna(subset=["radius", "azimuth"])
    known = sorted(rows["object"].astype(int).unique())
    if number not in [None, *known]:
        raise Wrong(f"object {number} is no surface in an inflow; these are: {', '.join(map(str, known))}")
    rows = rows[rows["object"] == (known[0] if number is None else number)].sort_values(["picture", "radius"]).drop_duplicates(["picture", "radius"])
    if rows.groupby("picture").size().nunique() > 1 or len(rows) < 2 * len(pictures):
        raise Skip("stations at the same radius cannot be told from each other")
    return {name: rows[name].to_numpy().reshape(len(pictures), -1) for name in names if rows[name].notna().all()}


def azimuths(folder):
    """Times and azimuth [deg], not set back after a turn, of the first blade in the pictures of the motion."""
    try:
        times, files = zip(*series_in_time(folder / "dynamic.pvd"))
        return times, np.unwrap(stations_of([Picture(file) for file in files])["azimuth"][:, -1], period=360)
    except Skip:
        text = "no probe has an azimuth, nor has a blade in the pictures; --abscissa takes a probe of an angle"
        raise Wrong(f"{folder.name}: {text}") from None


def draw_maps(runs, options):
    files = [file for time, file in series_in_time(runs[0].folder / "dynamic.pvd") if options.first <= time <= options.last]
    stations_of([Picture(file) for file in files[-1:]])  # before all are read
    return draw_turn([Picture(file) for file in files], options)


def draw_turn(pictures, options):
    """What the air does to a blade over azimuth and radius, in the last full turn."""
    values = stations_of(pictures, options.object)
    angle = np.unwrap(values["azimuth"][:, -1], period=360)
    full = np.flatnonzero(np.abs(angle[-1] - angle) >= 360 * (1 - 1e-6))
    if not len(full):
        raise Skip(f"the pictures show {np.ptp(angle):.0f} degrees of a turn, and a map is one of 360")
    n_pictures = len(pictures) - full[-1] - 1
    if n_pictures < LEAST_PICTURES:
        raise Skip(f"there are {n_pictures} pictures of a turn, and a map wants {LEAST_PICTURES} or more")
    values = {name: value[full[-1] :] for name, value in values.items()}
    azimuth, radius, shown = np.deg2rad(values["azimuth"]), values["radius"], [name for name in FIELDS if name in values]
    columns = min(len(shown), 2 if options.width < NARROW else 3)
    rows = -(-len(shown) // columns)
    figure = plt.figure(figsize=(options.width, rows * 0.8 * options.width / columns + 0.2), layout="constrained")
    for k, name in enumerate(shown):
        ax, field = figure.add_subplot(rows, columns, k + 1, projection="polar", theta_offset=-np.pi / 2), values[name]
        ax.grid(False)
        # colours of all values, without the few that are far away, as in reversed flow
        low, high = np.percentile(field, [5, 95])
        low, high = max(field.min(), 2 * low - high), min(field.max(), 2 * high - low)
        mesh = ax.pcolormesh(azimuth, radius, field, shading="gouraud", vmin=low, vmax=high, rasterized=True)
        if field.min() < 0 < field.max():
            ax.contour(azimuth, radius, field, levels=[0], colors="w", linewidths=0.6)
        ax.set(rmin=0, rmax=1.02 * radius.max(), rticks=[], title=f"{name} [{FIELDS[name]}]")
        ax.set_thetagrids([0, 90, 180, 270])
        ax.tick_params(pad=-3)
        beyond = (field.min() < low) + 2 * (field.max() > high)
        colour_bar(figure, mesh, ax, None, shrink=0.75, pad=0.08, aspect=18, extend=("neither", "min", "max", "both")[beyond])
    figure.suptitle("The last turn of a blade, azimuth 0 below; white: zero")
    return figure
