"""The page examples_gallery.md: a picture of each example of a joint or a contact. Parts: names of examples.

Runs the examples, in about a minute, and draws where they go: grey at first, then in colours until the end, blue where they come to
rest in statics."""

from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap
from PIL import Image
from plot_pictures import SCREEN, TO_EYE, Picture, fit, series, shaded

from figures_of import common
from figures_of.common import TOP, Run, doc, few, np, plt


WIDTH, HEIGHT, COLUMNS = 240, 180, 4

# what else is set, so that a run is short
SHORT = {"pile": ["Subsystems/layer/Copies = 5 about z by 0 deg", "Dynamic/End time = 0.6"],
         "ball_on_ball": ["Dynamic/Pictures = 40"], "crossing_beams": ["Dynamic/End time = 0.15"]}
GROUPS = [
    ("Hinges, slides, shafts", "revolute prismatic screw cylindrical planar spherical universal skew_universal constant_velocity in_line "
                               "in_plane point_on_curve rigid"),
    ("Springs, rods, gears", "flexible_joint distance spring springs_in_fixed_axes gear backlash"),
    ("Along beams and shells", "sliding_point sliding_sleeve sliding_prismatic sliding_screw sliding_friction buffer leaving cycloid"),
    ("Rolling", "rolling_ball rolling_disc knife_edge"),
    ("Contact and friction", "ball_on_plane ball_on_ball ball_on_cylinder ellipsoid_on_plane tippe_top contacts pile chain_on_drum "
                             "rope_on_drum crossing_beams beam_on_rod rod_impact friction group_bristles rolling_friction clutch thread "
                             "jamming_guide constant_velocity_friction wire_friction nut_friction worm_gear"),
    ("Edges of shells", "shells/plate_modes distributing"),
    ("Laws of the state", "laws/hardening_spring laws/relay laws/pid_pendulum laws/lag_damper"),
]
NAMES = [name for _, names in GROUPS for name in names.split()]

TIME_COLORS = LinearSegmentedColormap.from_list("samara time", common.TIME_COLORS)


def states(folder):
    """Places of the same points, first to last, their cells, and whether it is a motion."""
    for name, is_motion in (("dynamic.pvd", True), ("static.pvd", False), ("mode_1.pvd", True)):
        if (folder / name).exists():
            pictures = [Picture(file) for file in series(folder / name)]
            pictures = [p for p in pictures if len(p.points)]
            if pictures:
                first = pictures[0].points - pictures[0].displacement if name == "static.pvd" else pictures[0].points
                rows = [first] + [p.points for p in pictures[0 if name == "static.pvd" else 1:]]
                if name == "mode_1.pvd":  # a quarter of it, as far as it goes
                    rows = rows[:len(rows) // 4 + 1]
                return [r for r in rows if r.shape == first.shape], pictures[0].cells, is_motion
    raise SystemExit(f"nothing to draw in {folder}")


def draw(name, rows, cells, is_motion):
    shown = [rows[i] for i in np.unique(np.linspace(0, len(rows) - 1, 9 if is_motion else 2).round().astype(int))]
    figure = plt.figure(figsize=(WIDTH / 50, HEIGHT / 50), dpi=100)
    ax = figure.add_axes([0.02, 0.02, 0.96, 0.96])
    corners, faces, edges = [], [], []
    for i, points in enumerate(shown):
        part = i / max(1, len(shown) - 1)
        colour = np.array(TIME_COLORS(part)) if is_motion else np.array([0.25, 0.5, 0.78, 1])
        colour[3] = 0.25 + 0.75 * part**2
        if i == 0:
            colour = np.array([0.6, 0.6, 0.6, 0.35])
        mine = [points[c] for c in cells]
        corners += mine
        look = shaded(np.tile(colour, (len(mine), 1)), mine)
        faces.append(look)
        edges.append(np.column_stack([0.75 * look[:, :3], look[:, 3:]]))
    faces, edges = np.vstack(faces), np.vstack(edges)
    n = len(cells)
    order = sorted(range(len(corners)), key=lambda i: (i >= len(corners) - n, corners[i].mean(axis=0) @ TO_EYE))
    wide = [1.4 if len(corners[i]) < 3 else 0.2 for i in order]
    ax.add_collection(PolyCollection([corners[i] @ SCREEN for i in order], facecolors=faces[order], edgecolors=edges[order],
                                     linewidths=wide))
    # the axes of the ground
    places = np.vstack(shown + [np.zeros((1, 3))])
    length = 0.18 * (places.max(axis=0) - places.min(axis=0)).max()
    for name_of_axis, tip in zip("xyz", length * np.eye(3)):
        ax.plot(*np.column_stack([np.zeros(2), tip @ SCREEN]), color="0.25", lw=1.2, zorder=3)
        ax.text(*(1.25 * tip @ SCREEN), name_of_axis, ha="center", va="center", color="0.25", fontsize=13)
    fit(ax, np.vstack([places, 1.4 * length * np.eye(3)]) @ SCREEN)
    file = doc("pictures/gallery") / (name.replace("/", "_") + ".png")
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file)
    plt.close(figure)
    with Image.open(file) as image:
        small = image.convert("RGB").resize((WIDTH, HEIGHT), Image.LANCZOS)
        small.quantize(24).save(file, optimize=True)


def title_of(name):
    for line in (TOP / "prm/examples" / (name + ".prm")).read_text().splitlines():
        if line.split("=")[0].split() == ["set", "Title"]:
            return line.split("=", 1)[1].strip()
    return name


def write_page():
    """Tables of pictures, each with its file."""
    text = ["# The examples, drawn", "",
            "Every [joint and contact](joints_at_a_glance.md) has a short model in `prm/examples`. Its header says what it does, with a number in "
            "closed form.\nGrey is the model as given. Blue to red is the motion, blue alone an equilibrium; x, y, z is the ground.", ""]
    for heading, names in GROUPS:
        text += ["## " + heading, ""]
        names = names.split()
        for i in range(0, len(names), COLUMNS):
            row = names[i:i + COLUMNS]
            cells = [f"![{title_of(n)}](pictures/gallery/{n.replace('/', '_')}.png)" for n in row] + [""] * (COLUMNS - len(row))
            links = [f"[{n.split('/')[-1]}](../prm/examples/{n}.prm): {title_of(n)}" for n in row] + [""] * (COLUMNS - len(row))
            text += (["| | | | |", "|---|---|---|---|"] if i == 0 else []) + ["| " + " | ".join(cells) + " |", "| " + " | ".join(links) + " |"]
        text.append("")
    doc("examples_gallery.md").write_text("\n".join(text))


def make(parts, drawn):
    for name in [] if drawn else few(parts or NAMES, 2):
        run = Run(f"examples/{name}.prm", *SHORT.get(name, []), pictures=True, see=states)
        draw(name, *run.seen)
        print(name, flush=True)
    write_page()
