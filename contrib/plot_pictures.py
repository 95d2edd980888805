"""Pictures of models: shapes, modes, surfaces in their air and maps of rotors; drawn by contrib/plot.

Models are seen along parallel rays and painted from back to front into plain axes: these can be filled by the model,
which the 3D axes of matplotlib cannot.
"""

import xml.etree.ElementTree as xml

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap

from plot_style import MM, Skip, Wrong, colour_bar
from plot_tables import numbers, texts

# Quiet where nothing moves. Modes have no scale, two colours do.
COLORS = LinearSegmentedColormap.from_list("samara", ["#a9b8c6", "#4f8fc9", "#2a9d6c", "#f0b93a", "#cf3a4b"])
MODE_COLORS = LinearSegmentedColormap.from_list("samara modes", ["#a9b8c6", "#e6a04b", "#cf3a4b"])
LOAD_COLORS = LinearSegmentedColormap.from_list("samara loads", ["#1f5fa8", "#8fc1d9", "#f3efe6", "#f0b93a", "#cf3a4b"])
FLOW_COLORS = LinearSegmentedColormap.from_list("samara flow", ["#440f6b", "#2f5f9e", "#2f9e8f", "#7cc653", "#d9cf2f"])
BODY = np.array([0.75, 0.77, 0.79, 1])
FIELDS = {"angle of attack": "deg", "Mach": "–", "lift coefficient": "–", "normal force": "N/m", "chord force": "N/m", "inflow": "m/s"}
MAX_MODES = 8
LEAST_PICTURES = 8  # of a turn

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
    if not path.exists():
        raise Skip(f"no {path.name}")
    try:
        sets = xml.parse(path).getroot().findall("./Collection/DataSet")
    except xml.ParseError as error:
        raise Skip(f"cannot read {path.name}: {error}") from error
    if not sets:
        raise Skip(f"{path.name} has no pictures")
    return sorted(((float(s.get("timestep", 0)), path.parent / s.get("file")) for s in sets), key=lambda pair: pair[0])


def series(path):
    """The files of a .pvd file in the order of time."""
    return [file for _, file in series_in_time(path)]


# ----------------------------------------------------------------------------------------------------------- models


def shaded(colors, corners):
    """Colours of polygons, darker where they turn from the light; lines and points have no side."""
    normals = np.array([np.cross(c[2] - c[0], c[-1] - c[1]) if len(c) > 2 else np.zeros(3) for c in corners])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals /= np.where(lengths > 0, lengths, 1)
    normals *= np.where(normals @ TO_EYE < 0, -1, 1)[:, None]  # the side that is seen
    colors = np.array(colors)
    colors[:, :3] *= (0.72 + 0.28 * np.clip(normals @ LIGHT, -0.5, 1))[:, None]
    return np.clip(colors, 0, 1)


def paint(ax, corners, faces, edges, widths=0.2, layers=0):
    """Polygons from back to front, those of a higher layer over all others."""
    order = np.lexsort(([c.mean(axis=0) @ TO_EYE for c in corners], np.broadcast_to(layers, len(corners))))
    ax.add_collection(PolyCollection(
        [corners[i] @ SCREEN for i in order], facecolors=faces[order], edgecolors=edges[order],
        linewidths=np.broadcast_to(widths, len(corners))[order], rasterized=True,
    ))


def draw_model(ax, picture, undeformed, colors, ghost):
    """Draws the model and, lightly, where it was; returns the largest displacement."""
    sizes = np.linalg.norm(picture.points - undeformed, axis=1)
    largest = sizes.max()
    values = np.array([sizes[p].mean() for p in picture.cells])
    corners = [picture.points[p] for p in picture.cells]
    faces = shaded(colors(values / largest if largest > 0 else 0 * values), corners)
    edges = np.column_stack([0.8 * faces[:, :3], np.ones(len(faces))])
    moved = [undeformed[p] for p in picture.cells if sizes[p].max() > 1e-3 * largest > 0]
    if moved:
        corners += moved
        faces = np.vstack([faces, np.tile([0.55, 0.55, 0.55, 0.4 * ghost], (len(moved), 1))])
        edges = np.vstack([edges, np.tile([0.55, 0.55, 0.55, ghost], (len(moved), 1))])
    paint(ax, corners, faces, edges)
    fit(ax, np.vstack([picture.points, undeformed]) @ SCREEN)
    return largest


def fit(ax, places):
    low, high = places.min(axis=0), places.max(axis=0)
    margin = 0.02 * max((high - low).max(), 1e-9)
    ax.set_xlim(low[0] - margin, high[0] + margin)
    ax.set_ylim(low[1] - margin, high[1] + margin)
    ax.set_aspect("equal")
    ax.set_axis_off()


def slenderness(points):
    """Height over width of what is seen."""
    width, height = np.ptp(points @ SCREEN, axis=0)
    return height / max(width, 1e-9)


def model_figure(options, points, title, n_bars):
    """A figure with room for the model, a scale, the directions and bars at the right: it, the axes of the model and of the bars."""
    below, height = 14 * MM, max(0.76 * options.width * min(slenderness(points), 1.2), max(40, 28 * n_bars) * MM)
    total = below + height + (1 if options.no_title else 8) * MM
    figure = plt.figure(figsize=(options.width, total))
    figure.suptitle(title)
    ax = figure.add_axes([0.01, below / total, 0.76, height / total])
    tall = height / total / n_bars
    draw_directions(figure, [0.01, 0.01, 13 * MM / options.width, 13 * MM / total])
    return figure, ax, [figure.add_axes([0.8, below / total + tall * k, 0.02, 0.86 * tall]) for k in reversed(range(n_bars))]


def draw_directions(figure, place):
    """The directions of x, y and z in a corner of the figure."""
    ax = figure.add_axes(place)
    arrow = {"arrowstyle": "-|>,head_length=0.25,head_width=0.12", "color": "0.3", "lw": 0.8, "shrinkA": 0, "shrinkB": 0}
    for name, tip in zip("xyz", SCREEN):
        ax.annotate("", tip, (0, 0), arrowprops=arrow)
        ax.text(*(tip * (1 + 0.45 / np.linalg.norm(tip))), name, ha="center", va="center", color="0.3", fontsize=7)
    ax.set(xlim=(-1.5, 1.5), ylim=(-1.5, 1.5), aspect="equal")
    ax.set_axis_off()


def draw_scale(figure, ax):
    """A bar of a round length under the model."""
    about = 0.25 * np.ptp(ax.get_xlim())
    power = 10.0 ** np.floor(np.log10(about))
    length = max(m for m in (1, 2, 5) if m * power <= about * (1 + 1e-9)) * power
    figure.draw_without_rendering()
    half = 0.5 * length / np.ptp(ax.get_xlim()) * ax.get_position().width
    y = 9 * MM / figure.get_figheight()
    figure.add_artist(plt.Line2D([0.4 - half, 0.4 + half], [y, y], marker="|", ms=5, color="0.3", lw=0.8))
    figure.text(0.4, y - 1.5 * MM / figure.get_figheight(), f"{length:g} m", ha="center", va="top", color="0.3", fontsize=7)


def draw_shape(runs, options):
    picture = Picture(series(runs[0].folder / "static.pvd")[-1])
    if not len(picture.points):
        raise Skip("the last picture of static.pvd is empty")
    undeformed = picture.points - picture.displacement
    figure, ax, bars = model_figure(options, np.vstack([picture.points, undeformed]), "Deformed model, the undeformed one in grey", 1)
    largest = draw_model(ax, picture, undeformed, COLORS, ghost=0.25)
    draw_scale(figure, ax)
    if largest > 0:
        colour_bar(figure, bars[0], plt.Normalize(0, largest), COLORS, "displacement [m]")
    else:
        bars[0].remove()
    return figure


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
    """Mode number -> picture, middle, frequency and name; these are in modes.csv, or in the table of the last speed."""
    tables = [path for path in [run.folder / "modes.csv"] if path.exists()]
    tables += sorted(run.folder.glob("modes_*.csv"), key=lambda path: (len(path.stem), path.stem))[::-1]
    titles = {}
    if tables:
        rows = texts(tables[0])
        if {"mode", "frequency [Hz]"} <= set(rows.columns):
            names = [", ".join(filter(None, (row.get("family"), row.get("pattern")))) for _, row in rows.iterrows()]
            hertz = [f"{f:.4g} Hz" for f in numbers(rows["frequency [Hz]"])]
            titles = dict(zip(numbers(rows["mode"]).astype(int), zip(hertz, names)))
    found = {}
    paths = {int(path.stem[5:]): path for path in run.folder.glob("mode_*.pvd") if path.stem[5:].isdigit()}
    for number in sorted(paths)[:MAX_MODES]:
        try:
            found[number] = *largest_deflection(series(paths[number])), *titles.get(number, ("", ""))
        except Skip:
            pass
    return found


def draw_modes(runs, options):
    """One run: a grid of its modes. Several: a row a mode, a column a run."""
    modes = [modes_of(run) for run in runs]
    cells = [(number, run, of_run.get(number)) for number in sorted(set().union(*modes)) for run, of_run in zip(runs, modes)]
    if not cells:
        raise Skip("no mode_<k>.pvd that can be read")
    several = len(runs) > 1
    n_columns = len(runs) if several else min(len(cells), 2 if len(cells) in (2, 4) or options.width < 110 * MM else 3)
    n_rows = -(-len(cells) // n_columns)
    slender = max(slenderness(np.vstack([model[0].points, model[1]])) for *_, model in cells if model)
    row = 10 * MM + min(max(options.width / n_columns * slender, 5 * MM), 50 * MM)
    figure = plt.figure(figsize=(options.width, row * n_rows + 8 * MM), layout="constrained")
    for k, (number, run, model) in enumerate(cells):
        if not model:
            continue
        ax = figure.add_subplot(n_rows, n_columns, k + 1, anchor="N")
        picture, middle, hertz, name = model
        lines = [f"{run.name}, {number}: {hertz}" if several else f"{number}: {hertz}", name]
        ax.set_title("\n".join(filter(None, lines)), fontsize=7, linespacing=1.2)
        draw_model(ax, picture, middle, MODE_COLORS, ghost=0.3)
    figure.suptitle("Mode shapes at their largest deflection")
    return figure


# -------------------------------------------------------------------------------------------------------------- air


def limits(values):
    """Of the colours: all values, without the few that are far away, as in reversed flow."""
    low, high = np.percentile(values, [5, 95])
    far = high - low
    return max(values.min(), low - far), min(values.max(), high + far)


def cells_of(picture, name):
    """Numbers of the cells of surfaces, of disks and of all else, and the means of the field, or of the inflow, over them."""
    known = [field for field in FIELDS if field in picture.fields]
    if not known:
        raise Skip("no pictures of surfaces")
    if name not in known:
        raise Wrong(f"the picture has no field '{name}' of surfaces; there are: {', '.join(known)}")
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
        raise Skip("no pictures of surfaces")
    return means


def draw_air(runs, options):
    """The last picture of the motion up to the time that is asked for, or of statics where there is none."""
    folder = runs[0].folder
    path = folder / ("dynamic.pvd" if (folder / "dynamic.pvd").exists() else "static.pvd")
    files = [file for time, file in series_in_time(path) if time <= options.last or path.stem == "static"]
    if not files:
        raise Skip(f"{path.name} has no picture that early")
    return draw_surfaces(Picture(files[-1]), options)


def draw_surfaces(picture, options):
    """Surfaces coloured by what the air does to them, the web of a disk by its inflow."""
    name = options.field or "lift coefficient"
    means = cells_of(picture, name)
    title = f"Surfaces by their {name}" + (", disks by the inflow" if means["disks"] else "")
    figure, ax, bars = model_figure(options, picture.points, title, 1 + bool(means["disks"]))
    corners = [picture.points[p] for p in picture.cells]
    colors = {}
    for bar, kind, label, map_ in zip(bars, ("surfaces", "disks"), (name, "inflow"), (LOAD_COLORS, FLOW_COLORS)):
        norm = plt.Normalize(*limits(np.array(list(means[kind].values()))))
        colors |= {k: map_(norm(value)) for k, value in means[kind].items()}
        colour_bar(figure, bar, norm, map_, f"{label} [{FIELDS[label]}]", extend="both")
    faces = shaded([colors.get(k, BODY) for k in range(len(corners))], corners)
    for k in means["disks"]:  # lines have no side
        faces[k] = colors[k]
    kinds = np.array([0 if k in means["disks"] else 2 if k in means["surfaces"] else 1 for k in range(len(corners))])
    # surfaces over the bodies that they enclose, webs behind all
    paint(ax, corners, faces, faces, np.where(kinds == 0, 0.9, 0.2), kinds)
    fit(ax, picture.points @ SCREEN)
    draw_scale(figure, ax)
    return figure


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


def turned(degrees):
    return np.rad2deg(np.unwrap(np.deg2rad(degrees)))


def azimuths(folder):
    """Times and azimuth [deg], not set back after a turn, of the first blade in the pictures of the motion."""
    try:
        files = series_in_time(folder / "dynamic.pvd")
        pictures = [Picture(file) for _, file in files]
        number = surfaces_of(pictures[0])[0]
    except (Skip, IndexError):
        text = "no probe has an azimuth, nor has a blade in the pictures; --abscissa takes a probe of an angle"
        raise Wrong(f"{folder.name}: {text}") from None
    return np.array([time for time, _ in files]), turned([p.fields["azimuth"][stations_of(p, number)[-1]] for p in pictures])


def maps_of(pictures, number):
    """azimuth [rad], radius [m] and fields of the last full turn of a surface, an array (pictures, stations) each."""
    stations = [stations_of(picture, number) for picture in pictures]
    if len({len(s) for s in stations}) != 1 or len(stations[0]) < 2:
        raise Skip("stations at the same radius cannot be told from each other")

    def values(name):
        return np.stack([picture.fields[name][s] for picture, s in zip(pictures, stations)])

    azimuth = values("azimuth")
    angle = turned(azimuth[:, -1])
    full = np.flatnonzero(np.abs(angle[-1] - angle) >= 360 * (1 - 1e-6))
    if not len(full):
        raise Skip(f"the pictures show {np.ptp(angle):.0f} degrees of a turn, and a map is one of 360")
    begin = full[-1]
    if len(pictures) - begin <= LEAST_PICTURES:
        raise Skip(f"there are {len(pictures) - begin - 1} pictures of a turn, and a map wants {LEAST_PICTURES} or more")
    fields = {name: values(name)[begin:] for name in FIELDS if name in pictures[0].fields}
    return np.deg2rad(azimuth[begin:]), values("radius")[begin:], fields


def draw_maps(runs, options):
    files = series_in_time(runs[0].folder / "dynamic.pvd")
    if not surfaces_of(Picture(files[-1][1])):  # before all are read
        raise Skip("no pictures of surfaces in an inflow")
    return draw_turn([Picture(file) for time, file in files if options.first <= time <= options.last], options)


def draw_turn(pictures, options):
    """What the air does to a blade over azimuth and radius."""
    known = surfaces_of(pictures[0]) if pictures else []
    if not known:
        raise Skip("no pictures of surfaces in an inflow")
    if options.object is not None and options.object not in known:
        raise Wrong(f"object {options.object} is no surface in an inflow; these are: {', '.join(map(str, known))}")
    azimuth, radius, fields = maps_of(pictures, known[0] if options.object is None else options.object)
    columns = min(len(fields), 2 if options.width < 110 * MM else 3)
    rows = -(-len(fields) // columns)
    figure = plt.figure(figsize=(options.width, rows * (0.88 * options.width / columns + 0.1) + 0.2), layout="constrained")
    for k, (name, values) in enumerate(fields.items()):
        ax = figure.add_subplot(rows, columns, k + 1, projection="polar", theta_offset=-np.pi / 2)
        ax.grid(False)
        low, high = limits(values)
        mesh = ax.pcolormesh(azimuth, radius, values, shading="gouraud", vmin=low, vmax=high, rasterized=True)
        if values.min() < 0 < values.max():
            ax.contour(azimuth, radius, values, levels=[0], colors="w", linewidths=0.6)
        ax.set_rlim(0, 1.02 * radius.max())
        ax.set_rticks([])
        ax.set_thetagrids([0, 90, 180, 270])
        ax.tick_params(pad=-2)
        ax.set_title(f"{name} [{FIELDS[name]}]")
        beyond = (values.min() < low) + 2 * (values.max() > high)
        bar = figure.colorbar(mesh, ax=ax, shrink=0.7, pad=0.08, aspect=18, extend=("neither", "min", "max", "both")[beyond])
        bar.outline.set_visible(False)
        bar.locator = plt.MaxNLocator(5)
    figure.suptitle("The last turn of a blade, azimuth 0 below; white: zero")
    return figure
