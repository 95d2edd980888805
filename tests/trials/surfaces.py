"""Random shells, laminates and cross-sections by themselves: panels under loads, at rest and in their modes, and sections of all
shapes. What is the same thing written in another way must give the same numbers: turned in space, in other units, with the
normal on the other side and its layup read backwards, a section turned and moved across the beam. And files of meshes with mistakes."""

import copy
import math
import random
import re
from dataclasses import dataclass, field

import numpy as np

from shells import Patch, Shell, Sheller
from world import FREQUENCY, LENGTH, PRESSURE, World, cross_matrix, rotation

ANGLES = 0, 90, 45, -45, 30, 17.5


@dataclass
class Panel:
    """A shell of one patch, clamped along u = 0, under a dead load and a pressure."""

    shell: Shell
    force: np.ndarray  # per area [Pa]
    pressure: float
    modes: int = 3

    def text(self, world, backwards=False):
        shell, sign = self.shell, 1
        if backwards:
            shell, sign = reversed_shell(shell), -1
        material = shell.plies is not None
        lines = [f"set Analyses = static{', modal' if self.modes else ''}"]
        if material:
            lines += block("Materials", "of " + shell.name, shell.material_text(world)) + block("Layups", "of " + shell.name, shell.layup_text(world))
        lines += block("Bodies", shell.name, shell.text(world))
        lines += block("Joints", "clamp", [("Type", "support"), ("Along", shell.name + ".edge u0")])
        lines += ["subsection Loads"] + block("", "dead", [("Type", "area load"), ("Body", shell.name), ("Force", world.vector(self.force, PRESSURE))])
        lines += block("", "air", [("Type", "pressure"), ("Body", shell.name), ("Pressure", world.number(sign * self.pressure, PRESSURE))]) + ["end"]
        probes = [f"{shell.name}.{point}.displacement {axis}" for point in shell.points for axis in "xyz"]
        probes += [f"{shell.name}.layers.stress 11", f"{shell.name}.layers.von Mises stress"]
        lines += ["subsection Output", "set Probes = " + ", ".join(probes), "set Pictures = false", "end"]
        lines += ["subsection Modal", f"set Modes = {self.modes}", "set Animations = 0", "end"] if self.modes else []
        return "\n".join(lines) + "\n"


def block(room, name, entries):
    lines = [f"subsection {name}", *(f"set {key} = {value}" for key, value in entries), "end"]
    return [f"subsection {room}", *lines, "end"] if room else lines


def reversed_shell(shell):
    """The same with its normal on the other side: v runs backwards, plies are read from the other side, angles turn the other way."""
    shell = copy.deepcopy(shell)
    p = shell.patches[0]
    shell.patches = [Patch(p.p + p.b, p.a + p.c, -p.b, -p.c, p.d)]
    shell.plies = shell.plies and [-angle for angle in reversed(shell.plies)]
    shell.offset = -shell.offset
    return shell


def panel(seed):
    sheller = Sheller(f"panel {seed}")
    chance = sheller.random
    shell = sheller.shell("s", sheller.vector(1))
    while len(shell.patches) > 1 or shell.edges:
        shell = sheller.shell("s", sheller.vector(1))
    shell.__dict__.pop("spin", None)  # at rest
    shell.damping = 0.0
    shell.degree = chance.randint(2, 4)
    shell.elements = chance.randint(1, 3), chance.randint(1, 3)
    size = np.linalg.norm(shell.patches[0].a)
    shell.thickness = size * 10 ** chance.uniform(-3.5, -0.7)
    shell.offset = chance.choice((0, 0, 1, -0.5)) * shell.thickness
    if shell.plies is not None or sheller.chance(0.3):
        shell.plies = [chance.choice(ANGLES) for _ in range(chance.randint(1, 6))]
    # a deflection of a tenth of the size or the thickness
    load = 10 ** chance.uniform(-4, -1) * shell.E * (shell.thickness / size) ** 3
    return Panel(shell, load * sheller.direction(), 0.5 * load * chance.uniform(-1, 1), chance.choice((0, 3)))


def numbers_of(panel_, run, world):
    """Displacements in the description's axes and units (points, 3), stresses, frequencies."""
    table = run.tables["static"]
    moves = np.array([table.vector(f"s.{point}.displacement")[-1] for point in panel_.shell.points]) / world.units[0] @ world.turn
    stresses = np.array([table[f"s.layers.{name}"][-1] for name in ("stress 11", "von Mises stress")]) / world.factor(PRESSURE)
    modes = run.tables.get("modes")
    frequencies = np.hypot(modes["real"], modes["imaginary"])[:3] / world.factor(FREQUENCY) if modes else np.zeros(0)
    return moves, stresses, frequencies


def compare_panels(panel_, first, second, world, tolerance):
    if first.code != second.code:
        yield f"exit code {first.code} becomes {second.code}: {second.output[-300:]}"
    if first.code or second.code:
        return
    for name, a, b in zip(("displacements", "stresses", "frequencies"), numbers_of(panel_, first, World()), numbers_of(panel_, second, world)):
        if a.shape != b.shape:
            yield f"{a.shape} {name} become {b.shape}"
        elif a.size and abs(b - a).max() > tolerance * abs(a).max():
            yield f"{name} differ by {abs(b - a).max() / abs(a).max():.1e}: {a} and {b}"


# ---------------------------------------------------------------------- sections


@dataclass
class Section:
    """Entries with their dimensions, (entry, value, dimension) or (entry, text), and layups of its walls by name."""

    kind: str
    entries: list
    layups: dict = field(default_factory=dict)  # name -> [(material, angle, thickness)]
    E: float = 1e10
    angle: float = 0.0  # of the shape [rad]
    place: tuple = (0.0, 0.0)

    def text(self, world, angle=0.0, place=(0.0, 0.0)):
        """Turned by a further angle about the beam's axis, then moved."""
        lines = ["set Analyses = section", "subsection Materials"]
        for name, parts in ("ply", (1, 0.08, 0.04, 0.03)), ("core", (0.02, 0.01, 0.005, 0.004)):
            lines += block("", name, [("Type", "orthotropic"), ("nu12", "0.3"), ("Density", world.number(1500 * parts[0] ** 0.5, (-3, 1, 0)))]
                           + [(key, world.number(part * self.E, PRESSURE)) for key, part in zip(("E1", "E2", "G12", "G23"), parts)])
        lines += ["end", "subsection Layups"]
        for name, plies in self.layups.items():
            lines += block("", name, [("Plies", "; ".join(f"{material}, {a}, {world.number(t, LENGTH)}" for material, a, t in plies))])
        lines += ["end", "subsection Sections", "subsection s", f"set Type = {self.kind}"]
        for key, value, *dimension in self.entries:
            lines.append(f"set {key} = " + (world.number(value, *dimension) if dimension else value))
        c, s = math.cos(angle), math.sin(angle)
        x, y = self.place
        lines.append(f"set Rotation = {self.angle + angle!r}")
        lines.append("set Position = " + ", ".join(world.number(v, LENGTH) for v in (c * x - s * y + place[0], s * x + c * y + place[1])))
        return "\n".join(lines + ["end", "end"]) + "\n"


def layup(chance, size):
    plies = chance.randint(1, 4)
    total = size * 10 ** chance.uniform(-2, -0.9)
    return [(chance.choice(("ply", "ply", "core")), chance.choice(ANGLES), total / plies) for _ in range(plies)]


def section(seed):
    chance = random.Random(f"section {seed}")
    size = 10 ** chance.uniform(-2, 0.5)
    kind = chance.choice(("box", "box", "tube", "I", "C", "rectangle", "ellipse", "airfoil"))
    low, thin = chance.uniform(0.3, 1) * size, size * 10 ** chance.uniform(-2, -1)
    layups = {"l1": layup(chance, low), "l2": layup(chance, low)}
    of_walls = [("Layup", "l1")]
    if kind == "box":
        entries = [("Width 2", size, LENGTH), ("Width 3", low, LENGTH), *of_walls, ("Layup of " + chance.choice(("top", "left")), "l2")]
    elif kind == "tube":
        entries = [("Outer radius", size / 2, LENGTH), *of_walls]
    elif kind == "I":
        entries = [("Height", size, LENGTH), ("Lower width", low, LENGTH), ("Lower layup", "l1"), ("Upper layup", "l2"), ("Web layup", "l1")]
    elif kind == "C":
        entries = [("Height", size, LENGTH), ("Width", low, LENGTH), ("Upper layup", "l1"), ("Lower layup", "l2"), ("Web layup", "l1")]
    elif kind == "rectangle":
        entries = [("Width 2", size, LENGTH), ("Layup", "l1")] if chance.random() < 0.5 else [
            ("Width 2", size, LENGTH), ("Width 3", thin, LENGTH), ("Material", "ply")]
    elif kind == "ellipse":
        entries = [("Radius 2", size / 2, LENGTH), ("Radius 3", low / 2, LENGTH), ("Material", "ply")]
    else:
        layups = {name: [(m, a, t / 8) for m, a, t in plies] for name, plies in layups.items()}
        entries = [("NACA", chance.choice(("0012", "2418", "4415", "0021"))), ("Chord", size, LENGTH), *of_walls,
                   ("Trailing edge material", chance.choice(("ply", "core")))]
        if chance.random() < 0.6:
            entries.append(("Webs", f"{chance.uniform(0.15, 0.35):.3f}, l2" + chance.choice(("", f"; {chance.uniform(0.45, 0.6):.3f}, l1"))))
        if chance.random() < 0.5:
            entries.append(("Spar caps", f"{chance.choice(('both', 'upper'))}, {chance.uniform(0.1, 0.3):.3f}, {chance.uniform(0.4, 0.6):.3f}, l2"))
    entries += [("Degree", str(chance.choice((2, 2, 3)))), ("Elements", str(chance.randint(3, 8)))]
    return Section(kind, entries, layups, 10 ** chance.uniform(6, 11), chance.choice((0.0, chance.uniform(-3, 3))),
                   tuple(chance.uniform(-1, 1) * size for _ in range(2)))


def matrices(run):
    """Stiffness and inertia (6, 6) of the report; None if there is none."""
    found = []
    for head in r"Stiffness: .*", r"Inertia per length .*":
        match = re.search(head + r"\n((?:[ \d.e+-]+\n){6})", run.texts.get("section_s", ""))
        if match is None:
            return None
        found.append(np.array([[float(x) for x in row.split()] for row in match[1].splitlines()]))
    return found


def judge_section(run):
    """A stiffness is positive and symmetric, an inertia has one mass and I44 + I55 = I66."""
    if run.code:
        return
    found = matrices(run)
    if found is None:
        yield "the report of the section has no matrices"
        return
    K, M = found
    scale = np.sqrt(np.outer(np.diag(K), np.diag(K)))
    if not (np.diag(K) > 0).all() or np.linalg.eigvalsh(K / scale).min() <= 0:
        yield f"the stiffness is not positive: {np.diag(K)}"
    elif abs(K - K.T).max() > 1e-9 * K.max() or abs((K - K.T) / scale).max() > 1e-7:
        yield f"the stiffness is not symmetric: {abs((K - K.T) / scale).max():.1e}"
    if np.linalg.eigvalsh(M).min() < -1e-12 * M.max() or abs(M[3, 3] - M[4, 4] - M[5, 5]) > 1e-9 * M[3, 3]:
        yield "the inertia is none of a plane section"


def round_off(thing):
    """What a unit in the last place of the solid elements' stiffness is to their softest motion: an element as long as h and as thick
    as t bends (t/h)^4 times as easily as it is pressed together. Of plies 4000 times thinner than the chord this is 1e-5."""
    plies = [t for name, layup in thing.layups.items() for _, _, t in layup if any(name in str(value) for _, value, *_ in thing.entries)]
    lengths = [value for _, value, *dimension in thing.entries if dimension]
    elements = next(int(value) for key, value, *_ in thing.entries if key == "Elements")
    return np.finfo(float).eps * (max(lengths) / elements / min(plies + lengths)) ** 4


def compare_sections(first, second, world, angle, place, tolerance):
    """Twists at the old reference from those at the new: turned by the angle, which stands at the place."""
    if first.code != second.code:
        yield f"exit code {first.code} becomes {second.code}: {second.output[-300:]}"
    if first.code or second.code:
        return
    turn = np.eye(6)
    turn[:3, :3] = turn[3:, 3:] = rotation(np.array([angle, 0, 0])).T
    arm = np.eye(6)
    arm[:3, 3:] = -cross_matrix(np.array([0, *place]))  # strains at the place from those at the reference
    T = turn @ arm
    f = world.factor((1, 1, -2))  # N
    units = np.array([1, 1, 1, *3 * [world.units[0]]])
    for name, a, b, unit in zip(("stiffness", "inertia"), matrices(first), matrices(second), (f, world.factor((-1, 1, 0)))):
        expected = T.T @ a @ T
        found = b / np.outer(units, units) / unit
        scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
        error = abs((found - expected) / scale).max()
        if error > tolerance:
            yield f"{name} differs by {error:.1e}"


# ------------------------------------------------------------------------ meshes

MESH_MODEL = """subsection Bodies
subsection s
set Type = shell
set Mesh file = mesh{ending}
set E = 1e9
set Thickness = 0.01
set Density = 1000
set Degree = {degree}
set Refinements = {refinements}
end
end
subsection Joints
subsection clamp
set Type = support
set Along = s.edge root
end
end
subsection Loads
subsection air
set Type = pressure
set Body = s
set Region = skin
set Pressure = 1
end
end
set Analyses = static
subsection Output
set Probes = s.point tip.displacement x, s.point tip.displacement y, s.point tip.displacement z
set Pictures = false
end
"""


def mesh_text(chance, ending):
    """A bent plate of a few cells: lines of a file."""
    n, m = chance.randint(1, 4), chance.randint(1, 3)
    bend = chance.uniform(0, 2)
    number = lambda i, j: 1 + i + (n + 1) * j
    places = [(i / n, math.sin(bend * j / m), math.cos(bend * j / m)) for j in range(m + 1) for i in range(n + 1)]
    cells = [(number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)) for j in range(m) for i in range(n)]
    nodes = [(k + 1, *x) for k, x in enumerate(places)]
    if ending == ".inp":
        lines = ["*NODE", *(", ".join(map(repr, x)) for x in nodes), "*ELEMENT, TYPE=S4, ELSET=skin"]
        lines += [", ".join(map(str, (k + 1, *c))) for k, c in enumerate(cells)]
        return lines + ["*NSET, NSET=root", *(str(number(0, j)) for j in range(m + 1)), "*NSET, NSET=tip", str(number(n, m))]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", '0 1 "tip"', '1 1 "root"', '2 1 "skin"', "$EndPhysicalNames",
             "$Nodes", str(len(nodes)), *(" ".join(map(repr, x)) for x in nodes), "$EndNodes", "$Elements"]
    elements = [(15, 1, (number(n, m),))] + [(1, 1, (number(0, j), number(0, j + 1))) for j in range(m)] + [(3, 1, c) for c in cells]
    return lines + [str(len(elements)), *(f"{k + 1} {kind} 2 {group} 1 {' '.join(map(str, c))}" for k, (kind, group, c) in enumerate(elements)),
                    "$EndElements"]


def spoilt_mesh(seed):
    """The model, the name of its mesh and the mesh with mistakes; every fifth one has none."""
    chance = random.Random(f"mesh {seed}")
    ending = chance.choice((".msh", ".inp"))
    lines = mesh_text(chance, ending)
    for _ in range(chance.choice((0, 1, 1, 2, 3))):
        if not lines:
            break  # cut off at its first line
        k = chance.randrange(len(lines))
        words = re.findall(r"[^ ,]+", lines[k])
        if not words:
            continue
        how = chance.randrange(7)
        if how == 0:
            del lines[k]
        elif how == 1:
            lines.insert(chance.randrange(len(lines)), lines[k])
        elif how == 2:
            j = chance.randrange(len(lines))
            lines[j], lines[k] = lines[k], lines[j]
        elif how == 3 and len(words) > 3:  # corners in another order, nodes elsewhere
            a, b = chance.sample(range(1, len(words)), 2)
            words[a], words[b] = words[b], words[a]
            lines[k] = (", " if ending == ".inp" and lines[k][0] != "*" else " ").join(words)
        elif how == 4:
            del lines[k:]
        else:
            word = chance.choice(words)
            lines[k] = lines[k].replace(word, chance.choice(("0", "-1", "1", "2", "7", "nan", "1e300", "1e-300", "", "x", "99999999999", "0.5", "3")), 1)
    model = MESH_MODEL.format(ending=ending, degree=chance.randint(2, 3), refinements=chance.choice((0, 0, 1)))
    return model, "mesh" + ending, "\n".join(lines) + "\n"
