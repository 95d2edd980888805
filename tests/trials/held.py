"""Models that something holds, and that controls push: their modes are eigenvalues of the linear system, and what its gain foretells
is what statics find."""

import math
import random
from dataclasses import dataclass

import numpy as np

import judges
from flown import Rotor
from generator import Generator
from mechanism import Mechanism, PointLoad
from outline import changed, parse, render
from program import Run
from world import FORCE, MOMENT, World

SMALL = 1e-5  # deflections that are compared, parts of the size and rad: the next term is of third order
STIFF = 1e6  # N or N m for so little
TOLERANCE = 1e-6  # of gains, of the largest of each kind; of each pole


@dataclass
class Push(PointLoad):
    """Forces and moments that are a control each, along directions."""

    def text(self, world):
        yield "Type", "point load"
        yield "At", self.at
        for key, directions, dimension, control in ("Force", self.forces, FORCE, "force"), ("Moment", self.moments, MOMENT, "moment"):
            if directions:
                factor = float(world.number(1, dimension))
                yield key, ", ".join(f"{float(x) * factor!r}*({control}_{self.name})" for x in world.turn @ directions[0])
        yield "Axes", "inertial"

    def controls(self):
        return [f"{kind}_{self.name}" for kind, directions in (("force", self.forces), ("moment", self.moments)) if directions]


@dataclass
class Held(Mechanism):
    def controls(self):
        return [control for load in self.loads if isinstance(load, Push) for control in load.controls()]

    def tree(self, world):
        for key, value in super().tree(world):
            yield key, value
            if key == "Title":
                units = {"force": "N", "moment": "N*m"}
                yield "States", [(c, [("Type", "control"), ("Unit", units[c.partition("_")[0]])]) for c in self.controls()]
                yield "Static", [("Tolerance", "1e-10")]


def held_mechanism(seed):
    """A mechanism that springs hold everywhere, with one or two controls."""
    generator = next(g for g in (Generator(1000 * seed + k) for k in range(1000)) if g.sprung)
    generator.stops = False
    model = generator.mechanism()
    chance = random.Random(f"held {seed}")
    held = Held(**{name: getattr(model, name) for name in vars(model)})
    held.analyses, held.modes = ("static", "linear system", "modal"), 10
    points = [f"{body.name}.{point}" for body in held.bodies for point in body.points]
    for number in range(chance.randint(1, 2)):
        kinds = chance.choice(("f", "m", "fm"))
        held.loads.append(Push(f"u{number}", chance.choice(points), [generator.direction()] * ("f" in kinds),
                               [generator.direction()] * ("m" in kinds), False))
    return held


def complaints(program, model):
    """Runs, and what is wrong."""
    if not model.controls():
        return [], ["no control is left"]
    first = Run(program, model.text_here())
    runs, said = [first], list(judges.outcome(first))
    if first.code != 0:
        return runs, said
    if first.linear is None:
        return runs, said + ["no linear system is written"]
    A, B, C, D = (first.linear[name] for name in "ABCD")
    if len(A):
        said += compare_poles(A, first.tables["modes"], 1.0)
        statics = model.with_(analyses=("static",)).text_here()
        said += compare_gains(program, statics, model.size(), model.controls(), runs, D - C @ np.linalg.solve(A, B))
    return runs, said


class Flown:
    """A rotor in air, in hover or axial flow, at whose first blade a control pulls along with the blade. It is held at its speed."""

    def __init__(self, seed):
        chance = random.Random(f"held rotor {seed}")
        # inflow that is not even wants axes that turn
        able = lambda rotor: rotor.steady and (rotor.turning_hub or rotor.inflow not in ("prescribed", "Pitt-Peters", "Peters-He"))
        self.rotor = next(rotor for rotor in map(Rotor, range(1000 * seed, 1000 * seed + 1000)) if able(rotor))
        tree = parse(self.rotor.text(World()).replace("static, modal, dynamic", "static, linear system, modal"))
        force = ", ".join(f"{chance.uniform(-1, 1)!r}*(pull)" for _ in range(3))
        for path, value in ((["Static", "Tolerance"], "1e-11"), (["Modal", "Modes"], "10"), (["Modal", "Hold rotations"], "true"),
                            (["Modal", "Shift"], "1"), (["Linear system", "Hold rotations"], "true"), (["States", "pull", "Type"], "control"),
                            (["States", "pull", "Unit"], "N"), (["Loads", "pulling", "Type"], "point load"), (["Loads", "pulling", "At"], "b0.end"),
                            (["Loads", "pulling", "Force"], force), (["Loads", "pulling", "Axes"], "body")):
            tree = changed(tree, path, value)
        self.tree = tree

    def text(self):
        return render(self.tree)

    def complaints(self, program):
        first = Run(program, self.text())
        runs, said = [first], list(judges.outcome(first))
        if first.code != 0:
            return runs, said
        A, B, C, D = (first.linear[name] for name in "ABCD")
        said += compare_poles(A, first.tables["modes"], 1.0)
        statics = render(changed(self.tree, ["Analyses"], "static"))
        said += compare_gains(program, statics, self.rotor.radius, ["pull"], runs, D - C @ np.linalg.solve(A, B))
        return runs, said


def allowed(poles, pole):
    """Stiffness is part of A, and has the round-off of the largest one there: that of a slow pole is (largest/|pole|)² larger."""
    return TOLERANCE + 10 * np.finfo(float).eps * (abs(poles).max(initial=0) / abs(pole)) ** 2


def compare_poles(A, modes, shift):
    """Modes are those eigenvalues that are nearest to the shift."""
    poles = np.linalg.eigvals(A)
    poles = poles[poles.imag >= 0]
    found = modes["real"] + 1j * abs(modes["imaginary"])
    for mode in found:
        error = abs(poles - mode).min() / max(1.0, abs(mode))
        if error > allowed(poles, mode):
            yield f"the mode of {mode:.9g} 1/s is {error:.1e} away from the poles of the linear system"
    farthest = abs(found - shift).max(initial=0)
    for pole in poles[abs(poles - shift) < (1 - 1e-6) * farthest]:
        error = abs(found - pole).min() / max(1.0, abs(pole))
        if error > allowed(poles, pole):
            yield f"the pole of {pole:.9g} 1/s is {error:.1e} away from the modes, of which the farthest is {farthest:.3g} away from the shift"


def compare_gains(program, statics, size, controls, runs, gains):
    """`statics` is the text of a model that finds equilibria alone; what it runs comes to `runs`."""
    linear = runs[0].linear
    poles, units = np.linalg.eigvals(linear["A"]), np.array(linear["output units"])
    of_places, of_angles = np.isin(units, ("m",)), np.isin(units, ("deg",))
    scale = np.where(of_places, size, math.degrees(1))
    for k, name in enumerate(linear["inputs"]):
        if name not in controls:
            continue
        told = gains[:, k]
        largest = max(abs(told / scale)[of_places | of_angles].max(initial=0), 1e-12)
        push = SMALL / largest
        if push > STIFF:
            continue  # nothing gives way
        values = []
        for sign in 1, -1:
            run = Run(program, statics, "--set", f"States/{name}/Value = {sign * push!r}")
            runs.append(run)
            if run.code != 0:
                yield f"with {name} = {sign * push:.3g} statics end with exit code {run.code}: {run.output[-300:]}"
                return
            values.append(run.tables["static"].numbers[-1, -len(told):])
        found = (values[0] - values[1]) / (2 * push)
        for kind, what in (of_places, "places"), (of_angles, "angles"):
            # rotation vectors near half a turn are another one's
            kind = kind & (abs(values[0] - values[1]) < 90)
            error = abs(found - told)[kind] / (largest * scale[kind])
            if error.max(initial=0) > allowed(poles, abs(poles).min()):
                worst = np.flatnonzero(kind)[error.argmax()]
                yield (f"{name}: {linear['outputs'][worst]} per unit is {found[worst]:.9g} in statics, {told[worst]:.9g} by the linear system, "
                       f"{error.max():.1e} of the largest of {what}")
