"""Random rotors in air: blades, rigid on flap hinges or elastic, in every kind of inflow, in hover or in a wind from anywhere. The same
rotor in other units, turned in space, or in a mirror, where it turns the other way, must give the same numbers."""

import math
import random
from dataclasses import dataclass

import numpy as np

from surfaces import block
from world import (ACCELERATION, BENDING, DENSITY, FORCE, FREQUENCY, HINGE_DAMPER, HINGE_SPRING, INERTIA, LENGTH, LINE_FORCE, LINE_INERTIA,
                   LINE_MASS, LINE_MOMENT, MASS, MOMENT, POWER, SPEED, TIME, World)

KINDS = "prescribed", "uniform", "Pitt-Peters", "Peters-He", "annular", "helical wake", None
# what is compared: end of the name, dimension, and whether a mirror changes the sign
QUANTITIES = [("thrust", FORCE, False), ("torque", MOMENT, True), ("power", POWER, False), ("mean", SPEED, False), ("angle of attack", (0, 0, 0), False),
              ("normal force", LINE_FORCE, False), ("chord force", LINE_FORCE, False), (".moment", LINE_MOMENT, False),
              (".inflow", SPEED, False), ("rotation", (0, 0, 0), True)]


class Mirror(World):
    """A world in which what turned to the left turns to the right."""

    def __init__(self):
        super().__init__(turn=np.diag((1.0, -1.0, 1.0)))


def hand(world):
    return 1.0 if np.linalg.det(world.turn) > 0 else -1.0


@dataclass
class Rotor:
    seed: int

    def __post_init__(self):
        chance = self.chance = random.Random(f"rotor {self.seed}")
        self.blades, self.speed, self.radius = chance.randint(1, 4), chance.uniform(10, 60), chance.uniform(0.5, 6)
        self.root = chance.uniform(0.05, 0.3) * self.radius
        self.elastic, self.inflow = chance.random() < 0.4, chance.choice(KINDS)
        self.steady = chance.random() < 0.5  # hover or axial flow, from an equilibrium
        tip = self.speed * self.radius
        axial, across = chance.uniform(-0.1, 0.02) * tip, chance.uniform(-0.3, 0.3) * tip
        self.wind = np.array((0, 0, axial)) if self.steady else np.array((across, chance.uniform(-0.2, 0.2) * tip, axial))
        self.gravity = np.array((0, 0, chance.choice((0, -9.81)))) if self.steady else 9.81 * np.array([chance.uniform(-1, 1) for _ in range(3)])
        self.turning_hub = chance.random() < 0.4
        self.stages, self.damping = chance.randint(1, 3), chance.choice((0, 0.5, 1))
        self.steps = chance.choice((24, 48))
        self.tip = tip

    def number(self, low, high):
        return 10 ** self.draw.uniform(math.log10(low), math.log10(high))

    def text(self, world):
        self.draw = random.Random(f"numbers {self.seed}")  # the same numbers in each world
        sign = hand(world)
        period = 2 * math.pi / self.speed
        lines = [f"set Analyses = {'static, modal, dynamic' if self.steady else 'dynamic'}"]
        lines += self.bodies(world, sign) + self.joints(world, sign) + self.air(world, sign) + self.surfaces(world)
        lines += ["subsection Loads"]
        lines += block("", "weight", [("Type", "gravity"), ("Acceleration", world.vector(self.gravity, ACCELERATION))])
        if self.steady:
            lines += block("", "turning", [("Type", "steady rotation"), ("Joint", "shaft"), ("Speed", world.number(sign * self.speed, FREQUENCY))])
        lines += ["end"] + block("", "Modal", [("Modes", 4), ("Animations", 0)])
        lines += block("", "Dynamic", [("Step", world.number(period / self.steps, TIME)), ("End time", world.number(16 * period / self.steps, TIME)),
                                       ("Stages", self.stages), ("Spectral radius", self.damping), ("Length", world.number(self.radius, LENGTH))])
        return "\n".join(lines + block("", "Output", [("Probes", ", ".join(self.probes(world))), ("Pictures", "false")])) + "\n"

    def frames(self):
        for k in range(self.blades):
            c, s = math.cos(2 * math.pi * k / self.blades + 0.3), math.sin(2 * math.pi * k / self.blades + 0.3)
            yield k, np.array((c, s, 0)), np.array((-s, c, 0))

    def triad(self, first, second, sign):
        return np.column_stack((first, second, sign * np.array((0, 0, 1.0))))

    def bodies(self, world, sign):
        mass = self.number(1, 100)
        spin = sign * self.speed * np.array((0, 0, 1.0))
        start = lambda place: [] if self.steady else [("Velocity", world.vector(np.cross((0, 0, self.speed), place), SPEED)),
                                                      ("Angular velocity", world.vector(spin, FREQUENCY))]
        hinges = ", ".join(f"h{k} at {world.place(self.root * first, ' ')}" for k, first, _ in self.frames())
        lines = ["subsection Bodies"]
        fixed = [("Type", "rigid body"), ("Mass", world.number(mass, MASS)), ("Position", world.place(np.zeros(3)))]
        lines += block("", "mast", fixed + [("Inertia", world.body_vector((1, 1, 1), INERTIA)), ("Rotation", world.orientation(self.triad((1, 0, 0), (0, 1, 0), sign)))])
        lines += block("", "hub", fixed + [("Inertia", world.body_vector((3, 3, 5), INERTIA)), ("Frames", hinges),
                                           ("Rotation", world.orientation(self.triad((1, 0, 0), (0, 1, 0), sign)))] + start(np.zeros(3)))
        length, per_length = self.radius - self.root, self.number(0.5, 5)
        self.blade_inertia = per_length * length**3 / 3
        J = np.array((0.02 * length**3, length**3 / 12, length**3 / 12 * 1.02)) * per_length
        offset = self.draw.uniform(-0.02, 0.02) * length
        self.pretwist = self.draw.choice((0, self.draw.uniform(-0.3, 0.3)))
        for k, first, second in self.frames():
            root, tip = self.root * first, self.radius * first
            if self.elastic:
                twist = f"table: 0, {sign * self.pretwist!r}; {world.number(length, LENGTH)}, {-0.5 * sign * self.pretwist!r}"
                lines += block("", f"b{k}", [("Type", "beam"), ("Points", world.place(root) + "; " + world.place(tip)), ("Axis 2", world.vector(second)),
                                             ("Twist", twist), ("Section", "s"), ("Elements", 2), ("Degree", 3)] + start(root))
            else:
                lines += block("", f"b{k}", [("Type", "rigid body"), ("Mass", world.number(per_length * length, MASS)), ("Position", world.place(root)),
                                             ("Rotation", world.orientation(self.triad(first, second, sign))), ("Inertia", world.body_vector(J, INERTIA)),
                                             ("Centre of mass", world.body_vector((length / 2, offset, 0), LENGTH)),
                                             ("Frames", f"end at {world.place(tip, ' ')}")] + start(root))
        lines += ["end"]
        if self.elastic:
            EI = self.number(0.003, 0.1) * per_length * self.speed**2 * length**4
            lines += ["subsection Sections"]
            lines += block("", "s", [("Type", "engineering constants"), ("EA", world.number(EI * 1e4 / length**2, FORCE)), ("GA2", world.number(EI * 3e3 / length**2, FORCE)),
                                     ("GA3", world.number(EI * 2e3 / length**2, FORCE)), ("GJ", world.number(0.5 * EI, BENDING)), ("EI2", world.number(EI, BENDING)),
                                     ("EI3", world.number(9 * EI, BENDING)), ("Mass", world.number(per_length, LINE_MASS)),
                                     ("Mass centre", f"{world.number(offset, LENGTH)}, 0"), ("Tension centre", f"{world.number(offset / 2, LENGTH)}, 0"),
                                     ("I2", world.number(1e-4 * per_length * length**2, LINE_INERTIA)), ("I3", world.number(1e-3 * per_length * length**2, LINE_INERTIA))])
            lines += ["end"]
        return lines

    def joints(self, world, sign):
        axis = world.vector((0, 0, 1))
        shaft = [("Type", "revolute"), ("Body A", "mast.centre"), ("Body B", "hub.centre"), ("Axis", axis), ("Axis 1", world.vector((1, 0, 0)))]
        if not self.steady:
            shaft.append(("rotation / Prescribed", f"{world.number(sign * self.speed, FREQUENCY)}*t"))
        lines = ["subsection Joints"] + nested("shaft", shaft)
        lines += block("", "foot", [("Type", "rigid"), ("Body A", "ground"), ("Body B", "mast.centre")])
        spring = self.draw.choice((0, self.number(0.01, 1))) * self.speed**2 * self.blade_inertia
        damper = self.number(0.001, 0.1) * self.speed * self.blade_inertia
        delta = self.draw.choice((0, self.draw.uniform(-0.4, 0.4)))
        for k, first, second in self.frames():
            hinge = -math.cos(delta) * second + math.sin(delta) * first
            ends = [("Body A", f"hub.h{k}"), ("Body B", f"b{k}.{'start' if self.elastic else 'centre'}")]
            lines += nested(f"flap{k}", [("Type", "revolute"), *ends, ("Axis", world.vector(hinge)), ("Axis 1", world.vector((0, 0, 1))),
                                         ("rotation / Spring", world.number(spring, HINGE_SPRING)), ("rotation / Damper", world.number(damper, HINGE_DAMPER))])
        return lines + ["end"]

    def air(self, world, sign):
        draw = self.draw
        lines = ["subsection Airfoils"]
        lines += block("", "foil", [("Type", "analytic"), ("Lift slope", draw.uniform(5, 6.5)), ("Zero-lift angle", draw.uniform(-0.05, 0.05)),
                                    ("Drag", f"{draw.uniform(0.005, 0.02)!r}, {draw.uniform(-0.02, 0.02)!r}, {draw.uniform(0.1, 0.5)!r}"),
                                    ("Moment", f"{draw.uniform(-0.05, 0.05)!r}, {draw.uniform(-0.05, 0.05)!r}"),
                                    ("Compressible", draw.choice(("true", "false"))), ("Stall angle", draw.choice((0, 0.2)))])
        lines += ["end", "subsection Aerodynamics"]
        lines += block("", "air", [("Type", "air"), ("Density", world.number(draw.uniform(0.5, 1.3), DENSITY)),
                                   ("Speed of sound", world.number(self.tip / draw.uniform(0.1, 0.5), SPEED)), ("Wind", world.vector(self.wind, SPEED))])
        if self.inflow:
            through = draw.uniform(0.02, 0.06) * self.tip
            entries = [("Type", self.inflow + ("" if self.inflow == "helical wake" else " inflow")), ("Hub", "hub.centre" if self.turning_hub else "mast.centre"),
                       ("Axis", world.vector((0, 0, 1))), ("Direction", world.vector((1, 0, 0))), ("Radius", world.number(self.radius, LENGTH))]
            loss = draw.choice(([("Tip loss", "none")], [("Tip loss", "Prandtl")], [("Tip loss", "Prandtl"), ("Root", world.number(self.root, LENGTH))]))
            if self.inflow == "prescribed":
                w = through, draw.uniform(-0.5, 0.5) * through, sign * draw.uniform(-0.5, 0.5) * through
                entries += [("Velocity", world.body_vector(w, SPEED))] + loss
            elif self.inflow == "helical wake":
                entries += [("Speed", world.number(sign * self.speed, FREQUENCY)), ("Transport", world.number(through, SPEED)), ("Root", world.number(self.root, LENGTH)),
                            ("Nodes", 3), ("Turns", 3), ("Segments", 12), ("Time constant", world.number(0.1 / self.speed, TIME))]
            else:
                entries += [("Initial", world.number(through, SPEED))]
                entries += [("Harmonics", draw.randint(0, 3)), ("Power", draw.randint(3, 5))] if self.inflow == "Peters-He" else []
                entries += [("Swirl", draw.choice(("true", "false")))] + loss if self.inflow == "annular" else loss if self.inflow != "Peters-He" else []
            lines += block("", "flow", entries)
        return lines + ["end"]

    def surfaces(self, world):
        draw, length = self.draw, self.radius - self.root
        chord, taper = draw.uniform(0.03, 0.12) * self.radius, draw.uniform(0.4, 1)
        pitch, washout, ahead = draw.uniform(-0.05, 0.25), draw.uniform(-0.2, 0.1), draw.uniform(-0.2, 0.2) * chord
        kind = draw.choice(("two lags", "quasi-steady", "dynamic stall"))
        mass, stations = draw.choice(("true", "false")), 5 if self.inflow == "helical wake" else draw.randint(2, 4)
        at = lambda a, b, dimension=(0, 0, 0): f"table: 0, {world.number(a, dimension)}; {world.number(length, LENGTH)}, {world.number(b, dimension)}"
        lines = ["subsection Surfaces"]
        for k, first, second in self.frames():
            entries = [("Type", "lifting line"), ("Body", f"b{k}"), ("Chord", at(chord, taper * chord, LENGTH)), ("Twist", at(pitch, pitch + washout)),
                       ("Quarter chord", world.number(ahead, LENGTH)), ("Airfoils", "foil"), ("Stations", stations), ("Unsteady", kind), ("Virtual mass", mass),
                       ("Upper side", world.vector((0, 0, 1)))]
            if self.inflow:
                entries.append(("Inflow", "flow"))
            if not self.elastic:
                entries += [("Line", world.place(self.root * first) + "; " + world.place(self.radius * first)), ("Leading edge", world.vector(second))]
            lines += block("", f"w{k}", entries)
        return lines + ["end"]

    def probes(self, world):
        names = [f"flow.{quantity}" for quantity in ("thrust", "torque", "power", "mean")] if self.inflow else []
        for k in range(self.blades):
            names += [f"w{k}.at {world.number(0.7 * (self.radius - self.root), LENGTH)}.{q}" for q in ("angle of attack", "normal force", "chord force", "moment", "inflow")]
            names += [f"flap{k}.rotation", *(f"b{k}.end.position {axis}" for axis in "xyz")]
        return names


def nested(name, entries):
    """A joint; `rotation / Spring` stands in a subsection of its own."""
    lines = [f"subsection {name}"] + [f"set {key} = {value}" for key, value in entries if " / " not in key]
    inner = [(key.split(" / ")[1], value) for key, value in entries if " / " in key]
    return lines + (block("", "rotation", inner) if inner else []) + ["end"]


def compare_rotors(rotor, first, second, world, tolerance):
    """Complaints about what differs, relative to the largest value of its kind."""
    if first.code != second.code:
        yield f"exit code {first.code} becomes {second.code}: {second.output[-300:]}"
        return
    for name in "static", "dynamic":
        if name not in first.tables:
            continue
        a, b = first.tables[name], second.tables[name]
        if a.numbers.shape != b.numbers.shape:
            yield f"{name}.csv: {a.numbers.shape} becomes {b.numbers.shape}"
            continue
        if not len(a.numbers):
            continue  # both ended before their first row
        for k in range(rotor.blades):
            place = (b.vector(f"b{k}.end.position") / world.factor(LENGTH) - world.shift) @ world.turn
            error = abs(place - a.vector(f"b{k}.end.position")).max() / rotor.radius
            if not error < tolerance:
                yield f"{name}: the tip of blade {k} differs by {error:.1e} of the radius"
        for end, dimension, turns in QUANTITIES:
            # the table of another world names stations by its own lengths: columns are compared in their order
            columns = [j for j, column in enumerate(a.names) if column.endswith(end)]
            if not columns:
                continue
            x, y = a.numbers[:, columns], b.numbers[:, columns] / world.factor(dimension) * (hand(world) if turns else 1)
            error = abs(x - y).max() / max(abs(x).max(), 1e-9)
            if not error < tolerance:
                yield f"{name}: {end} differs by {error:.1e} of {abs(x).max():.3g}"
    if "modes" in first.tables:
        yield from compare_poles(first.tables["modes"], second.tables["modes"], world, tolerance)


def compare_poles(a, b, world, tolerance):
    names = [n for n in a.names if "requency" in n or "amping" in n or "real" in n]
    if a.numbers.shape != b.numbers.shape:
        yield f"modes.csv: {a.numbers.shape} becomes {b.numbers.shape}"
        return
    for n in names:
        factor = 1 if "ratio" in n else world.factor(FREQUENCY)
        error = np.nanmax(abs(a[n] - b[n] / factor)) / max(np.nanmax(abs(a[n])), 1e-9)
        if not error < 100 * tolerance:
            yield f"modes: {n} differs by {error:.1e}"
