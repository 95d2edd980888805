"""Mechanisms in which a beam is two that are welded, with the same nodes: statics, modes and motions must be those of the whole."""

import copy
import dataclasses
import math
import random
from dataclasses import dataclass

import numpy as np

import judges
import relatives
from generator import Generator
from mechanism import Beam, Joint
from program import Run
from world import BENDING, FORCE, LENGTH, LINE_INERTIA, LINE_MASS, World


@dataclass
class TwistedBeam(Beam):
    """A straight one with a section of everything: offsets, two bending stiffnesses, coupling by them, and twist along the arc length."""

    twist: tuple = (0.0, 0.0)  # at both ends [rad]
    numbers: dict = None

    def weight(self):
        return self.numbers["Mass"] * self.length()

    def text(self, world):
        yield from super().text(world)
        yield "Twist", f"table: 0, {self.twist[0]!r}; {world.number(self.length(), LENGTH)}, {self.twist[1]!r}"

    DIMENSIONS = {"EA": FORCE, "GA2": FORCE, "GA3": FORCE, "GJ": BENDING, "EI2": BENDING, "EI3": BENDING, "Mass": LINE_MASS, "I2": LINE_INERTIA,
                  "I3": LINE_INERTIA}

    def section_text(self, world):
        yield "Type", "engineering constants"
        for key, value in self.numbers.items():
            if key in self.DIMENSIONS:
                yield key, world.number(value, self.DIMENSIONS[key])
            else:
                yield key, world.body_vector(value, LENGTH)


def twisted(beam, chance):
    """The beam with another section, about as stiff."""
    E, rho, r = (beam.section[key] for key in ("E", "Density", "Outer radius"))
    A, I = math.pi * r**2, math.pi * r**4 / 4
    near = lambda value: value * chance.uniform(0.5, 2)
    offset = lambda: (chance.uniform(-r, r), chance.uniform(-r, r))
    numbers = {"EA": near(E * A), "GA2": near(0.3 * E * A), "GA3": near(0.2 * E * A), "GJ": near(0.7 * E * I), "EI2": near(E * I),
               "EI3": near(2 * E * I), "Mass": near(rho * A), "I2": near(rho * I), "I3": near(2 * rho * I), "Mass centre": offset(),
               "Tension centre": offset(), "Shear centre": offset()}
    own = {field.name: getattr(beam, field.name) for field in dataclasses.fields(Beam)}
    other = TwistedBeam(**own, twist=(chance.uniform(-1, 1), chance.uniform(-1, 1)), numbers=numbers)
    if hasattr(beam, "spin"):
        other.velocity, other.spin = beam.velocity, beam.spin
    return other


def whole_mechanism(seed):
    """One with a beam of two to four elements that is not rigid, and the beam's name."""
    chance = random.Random(f"split {seed}")
    for k in range(1000):
        generator = Generator(1000 * seed + k)
        generator.stops = False
        model = generator.mechanism()
        beams = [body for body in model.bodies if isinstance(body, Beam) and not body.rigid]
        if beams:
            break
    beam = beams[0]
    beam.elements = chance.randint(2, 4)
    if "static" in model.analyses and hasattr(beam, "spin"):
        del beam.spin  # the motion of a rigid body is not that of two where statics have bent them
    if len(beam.line) == 2 and chance.random() < 0.6:
        model.bodies[model.bodies.index(beam)] = twisted(beam, chance)
    return model.with_(steps=10, newton=1e-13, radius=0.5 if model.stages == 1 else model.radius)


def name_of_beam(model):
    """That of the first beam that can be cut."""
    return next((body.name for body in model.bodies if isinstance(body, Beam) and not body.rigid and body.elements > 1), None)


def axis_2_at(beam, part):
    """Axis 2 of the section, which along an arc turns with the tangent, and not about it."""
    if len(beam.line) == 2:
        return beam.axis_2
    _, first, second, angle = beam.arc()
    normal, radius = np.cross(first, second), np.linalg.norm(first)
    outward = lambda phi: (first * math.cos(phi) + second * math.sin(phi)) / radius
    return beam.axis_2 @ normal * normal / (normal @ normal) + beam.axis_2 @ outward(0) * outward(part * angle)


def cut(model, name, first):
    """The same model with a beam cut behind so many elements. Its second part is called "<name> b", its end is that of the whole."""
    model = copy.deepcopy(model)
    number, beam = next((k, body) for k, body in enumerate(model.bodies) if body.name == name)
    part, names = first / beam.elements, (name, name + " b")
    place = beam.place_at(part)
    sides = [copy.deepcopy(beam), copy.deepcopy(beam)]
    for side, own, n, (low, high) in zip(sides, names, (first, beam.elements - first), ((0, part), (part, 1))):
        ends = {"start": beam.place_at(low), "end": beam.place_at(high)}
        side.name, side.points, side.elements = own, ends, n
        side.line = [ends["start"], *([beam.place_at((low + high) / 2)] if len(beam.line) == 3 else []), ends["end"]]
        side.axis_2 = axis_2_at(beam, low)
        if isinstance(beam, TwistedBeam):
            side.twist = tuple((1 - s) * beam.twist[0] + s * beam.twist[1] for s in (low, high))
    if hasattr(beam, "spin"):
        sides[1].velocity = beam.velocity + np.cross(beam.spin, place - beam.place_at(0))
    model.bodies[number : number + 1] = sides
    renamed = lambda point: names[1] + ".end" if point == name + ".end" else point
    for joint in model.joints:
        joint.a, joint.b = renamed(joint.a), renamed(joint.b)
    for load in model.loads:
        load.at = renamed(load.at)
    model.joints.append(Joint("weld", "rigid", names[0] + ".end", names[1] + ".start", place, np.eye(3)))
    return model


def is_stuck(run):
    return run.code == 3 and "static analysis: no equilibrium found" in run.output


def complaints(program, model, seed):
    """Runs, and what is wrong."""
    name = name_of_beam(model)
    if name is None:
        return [], ["no beam is left that can be cut"]
    beam = model.body(name + ".start")[0]
    halves = cut(model, name, random.Random(f"cut {seed}").randint(1, beam.elements - 1))
    halves.probes = lambda: [probe.replace(f"{name}.end.", f"{name} b.end.") for probe in model.probes()]
    first, second = Run(program, model.text_here()), Run(program, halves.text_here())
    said = [*judges.outcome(first), *judges.outcome(second)]
    for run in first, second:
        if "static" in run.tables:
            run.tables["static"].numbers = run.tables["static"].numbers[-1:]  # the steps of the load are each run's own
    for table in "static", "dynamic":
        if table in first.tables and table in second.tables and len(first.tables[table].names) == len(second.tables[table].names):
            second.tables[table].names, second.tables[table].column = first.tables[table].names, first.tables[table].column
    if is_stuck(first) != is_stuck(second):
        return [first, second], said  # Newton's method has other iterates from one load to the next
    if not (first.has_halved_steps() or second.has_halved_steps()):
        said += relatives.compare(model, first, second, World(), 1e-8)
    return [first, second], said
