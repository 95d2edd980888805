"""What slides, touches and rubs in random mechanisms: joints along beams, friction in joints, contacts one by one and in groups.
A seed's mechanism of generator.py is taken, and these are put on it by a random stream of their own."""

import copy
from dataclasses import dataclass, field

import numpy as np

from generator import Generator, mechanism
from mechanism import Beam, Gear, Joint, RigidBody
from world import ACCELERATION, DAMPER, FORCE, LENGTH, NUMBER, SPEED, SPRING, axes

SLIDING = ["sliding point", "sliding sleeve", "sliding prismatic", "sliding screw"]
RUBBING = {"revolute": ["rotation"], "prismatic": ["displacement"], "cylindrical": ["displacement", "rotation"], "in line": ["displacement"],
           "universal": ["rotation 1", "rotation 2"]}
PER_LENGTH = (-1, 0, 0)


def per_power(dimension, n):
    """Of a factor of (length)^n with that dimension as a product."""
    return (dimension[0] - n, *dimension[1:])


@dataclass
class Slider(Joint):
    """`a` is a beam, without a point; `place` and `axes` those of its section there."""

    def text(self, world):
        yield "Type", self.kind
        yield "Body A", self.a
        yield "Body B", self.b
        if self.b == "ground":
            yield "Position", world.place(self.place)
        if "Turn per length" in self.entries:
            yield "Turn per length", world.number(self.entries["Turn per length"], PER_LENGTH)
        if "At the ends" in self.entries:
            yield "At the ends", self.entries["At the ends"]
        if "Bearing length" in self.entries:
            yield "Bearing length", world.number(self.entries["Bearing length"], LENGTH)
        for name, entries in self.motions.items():
            yield name, [(key, self.motion_value(world, key, value, False)) for key, value in entries.items()]


@dataclass
class Law:
    """Of a contact: k g^n, damping or restitution, friction; entries are numbers in the description's units."""

    stiffness: float
    exponent: float
    entries: dict = field(default_factory=dict)

    DIMENSIONS = {"Damping": DAMPER, "Restitution": NUMBER, "Impact speed": SPEED, "Friction": NUMBER, "Static friction": NUMBER,
                  "Stribeck speed": SPEED, "Sticking speed": SPEED, "Bristle stiffness": SPRING, "Bristle damping": DAMPER,
                  "Rolling friction": NUMBER, "Turning friction": NUMBER}

    def text(self, world):
        yield "Stiffness", world.number(self.stiffness, per_power(FORCE, self.exponent))
        if self.exponent != 1:
            yield "Exponent", repr(self.exponent)
        for key, value in self.entries.items():
            yield key, world.number(value, self.DIMENSIONS[key])

    def is_elastic(self):
        return not {"Damping", "Restitution"} & set(self.entries)

    def friction(self):
        return max(self.entries.get("Friction", 0.0), self.entries.get("Static friction", 0.0))


@dataclass
class Contact:
    """A ball (or an ellipsoid) of `b` on a plane, ball, cylinder of `a`; `place` and `axes` of that."""

    name: str
    kind: str
    a: str
    b: str
    place: np.ndarray
    axes: np.ndarray
    radius: float
    radius_a: float
    inside: bool
    law: Law
    semi_axes: tuple = ()

    def text(self, world):
        yield "Type", self.kind
        yield "Body A", self.a
        yield "Body B", self.b
        yield "Position", world.place(self.place)
        yield "Axis", world.vector(self.axes[:, 2])
        yield "Axis 1", world.vector(self.axes[:, 0])
        if self.semi_axes:
            yield "Semi-axes", world.body_vector(self.semi_axes, LENGTH)
        else:
            yield "Radius", world.number(self.radius, LENGTH)
        if self.kind in ("ball on ball", "ball on cylinder"):
            yield "Radius A", world.number(self.radius_a, LENGTH)
            yield "Side", "inside" if self.inside else "outside"
        yield from self.law.text(world)


@dataclass
class Group:
    """Balls at points of rigid bodies, beams, and planes of the ground: all of which may touch."""

    name: str
    balls: dict  # point -> radius
    planes: list  # (place, normal)
    beams: dict  # name -> radius
    law: Law
    line_stiffness: float = 0.0
    laws: list = field(default_factory=list)  # (body, body or ground, {word: number})

    WORDS = {"friction": NUMBER, "sticking": SPEED, "rolling": NUMBER, "turning": NUMBER, "restitution": NUMBER, "speed": SPEED}

    def law_text(self, world):
        for a, b, words in self.laws:
            numbers = (f"{word} {world.number(value, self.WORDS[word] if word in self.WORDS else per_power(FORCE, self.law.exponent))}"
                       for word, value in words.items())
            yield f"{a} with {b} {' '.join(numbers)}"

    def words_of(self, a, b):
        """What is said of two bodies: the first that fits."""
        return next((words for *pair, words in self.laws if sorted(pair) == sorted((a, b))), {})

    def text(self, world):
        yield "Type", "contacts"
        if self.balls:
            yield "Balls", ", ".join(f"{p} radius {world.number(r, LENGTH)}" for p, r in self.balls.items())
        if self.planes:
            yield "Planes", ", ".join(f"ground at {world.place(p, ' ')} normal {world.vector(n).replace(',', '')}" for p, n in self.planes)
        if self.beams:
            yield "Beams", ", ".join(f"{name} radius {world.number(r, LENGTH)}" for name, r in self.beams.items())
        if self.beams and self.planes:
            yield "Line stiffness", world.number(self.line_stiffness, (-1, 1, -2))
        yield "Overlap", "allowed"
        # where beams touch surfaces alone the law of points holds nowhere
        is_line_alone = self.planes and not self.balls and len(self.beams) < 2 and not self.laws
        yield from ((key, value) for key, value in self.law.text(world) if not (is_line_alone and key in ("Stiffness", "Exponent")))
        if self.laws:
            yield "Laws", ", ".join(self.law_text(world))

    def probes(self):
        for quantity in "touched", "depth", "energy":
            yield f"{self.name}.{quantity}"
        for name in self.bodies():
            for axis in "xyz":
                yield f"{self.name}.{name}.force {axis}"

    def bodies(self):
        names = {point.partition(".")[0] for point in self.balls} | set(self.beams)
        return sorted(names | ({"ground"} if self.planes else set()))


@dataclass
class Buffer:
    """Between two sliders, `a` and `b`, on one beam."""

    name: str
    a: str
    b: str
    length: float
    law: Law

    def text(self, world):
        yield "Type", "buffer"
        yield "Joint A", self.a
        yield "Joint B", self.b
        yield "Length", world.number(self.length, LENGTH)
        yield from self.law.text(world)


class Lawyer(Generator):
    """Laws of pairs in groups, and what resists rolling, by a stream of their own."""

    def __init__(self, seed):
        super().__init__(f"laws {seed}")

    def put_on(self, group):
        if self.chance(0.3):
            group.law.entries["Rolling friction"] = self.power(-3, -1)
        if self.chance(0.2):
            group.law.entries["Turning friction"] = self.power(-3, -1)
        names = group.bodies()
        for _ in range(self.random.choice((0, 1, 1, 2, 3)) if len(names) > 1 else 0):
            words = {}
            if self.chance(0.5):
                words["stiffness"] = self.power(2.5, 6.5)
            if self.chance(0.3):
                words["restitution"], words["speed"] = self.random.uniform(0.2, 0.95), self.power(-1, 0.5)
            if self.chance(0.5):
                words["friction"] = self.random.uniform(0, 0.8)
            if self.chance(0.3):
                words["rolling"] = self.power(-3, -1)
            if "friction" in words or "rolling" in words:
                words["sticking"] = self.power(-4, -1)
                if group.law.entries.get("Static friction") and "friction" not in words:
                    words["sticking"] = group.law.entries["Stribeck speed"] / 50
            if words:
                group.laws.append((*self.random.sample(names, 2), words))


class Player(Generator):
    """Backlash of gears, and friction against several motions at once, by a stream of their own."""

    SEVERAL = {"planar": ["displacement"], "spherical": ["rotation"], "in line": ["rotation"], "in plane": ["displacement", "rotation"]}

    def __init__(self, seed):
        super().__init__(f"play {seed}")

    def put_on(self, model, friction):
        turning = [joint for joint in model.joints if joint.kind in ("revolute", "cylindrical")]
        if not model.gears and len(turning) > 1 and self.chance(0.4):
            model.gears.append(Gear("gr", *self.random.sample(turning, 2), self.random.choice((-2.0, -1.0, 0.5, 1.0, 3.0))))
            chance = 1.0
        else:
            chance = 0.5
        for gear in model.gears:
            if self.chance(chance):
                gear.mesh = {"Backlash": self.power(-4, -1), "Mesh stiffness": self.power(2, 6)}
                if self.chance(0.3):
                    gear.mesh["Mesh damping"] = self.power(-2, 1)
                elif self.chance(0.3):
                    gear.mesh["Mesh restitution"], gear.mesh["Mesh speed"] = self.random.uniform(0.2, 0.95), self.power(-1, 1)
        for joint in model.joints:
            for motion in self.SEVERAL.get(joint.kind, []):
                if self.chance(0.2):
                    joint.common[motion] = friction(0.5)
                    if motion == "rotation":
                        joint.common[motion]["Friction radius"] = self.power(-2, -0.7)
                    if self.chance(0.4):
                        joint.common[motion]["Friction preload"] = self.power(-1, 2)


class Presser(Generator):
    """Friction of threads and of constant velocity joints, guides that are pressed at their ends, by a stream of their own."""

    GUIDES = ("revolute", "prismatic", "cylindrical", "sliding sleeve", "sliding prismatic", "sliding screw")

    def __init__(self, seed):
        super().__init__(f"presses {seed}")

    def put_on(self, model, friction):
        model.title += ", pressed"
        for joint in model.joints:
            rubs = any("Friction" in entries for entries in joint.motions.values())
            if joint.kind in self.GUIDES and not rubs and self.chance(0.3):
                name, entries = next(iter(joint.motions.items()), ("rotation" if joint.kind == "revolute" else "displacement", {}))
                if "Prescribed" not in entries:
                    joint.motions[name] = {**entries, **friction(0.5)}
                    if name == "rotation":
                        joint.motions[name]["Friction radius"] = self.power(-2, -0.7)
                    rubs = True
            if joint.kind in self.GUIDES and rubs and self.chance(0.7):
                joint.entries["Bearing length"] = self.power(-1.5, 0)
            elif joint.kind == "screw" and self.chance(0.8):
                joint.common["thread"] = {**friction(0.5), "Radius": self.power(-2, -0.5), "Flank angle": self.random.choice((0.0, 0.26, 0.5))}
            elif joint.kind == "constant velocity" and self.chance(0.8):
                joint.common["rotation"] = {**friction(0.5), "Friction radius": self.power(-2, -0.7)}
        return model


class Toucher(Generator):
    def __init__(self, seed):
        super().__init__(f"touching {seed}")
        self.seed = seed
        self.stops = self.chance(0.3)
        self.sprung = False

    # ---------------------------------------------------------------- laws

    def friction(self, most=0.8):
        entries = {"Friction": self.random.uniform(0.05, most)}
        if self.chance(0.4):
            entries["Static friction"] = entries["Friction"] * self.random.uniform(1.1, 2)
            entries["Stribeck speed"] = self.power(-2, -0.5)
        if self.chance(0.3):
            entries["Bristle stiffness"] = self.power(3, 6)
            entries["Bristle damping"] = self.power(0, 2)
        elif "Stribeck speed" in entries:
            entries["Sticking speed"] = entries["Stribeck speed"] / self.random.uniform(20, 200)
        else:
            entries["Sticking speed"] = self.power(-4, -1)
        return entries

    def law(self, single):
        law = Law(self.power(2.5, 6.5), self.random.choice((1.0, 1.5, 2.0)))
        if self.chance(0.3):
            law.entries["Restitution"], law.entries["Impact speed"] = self.random.uniform(0.2, 0.95), self.power(-1, 0.5)
        elif single and self.chance(0.3):
            law.entries["Damping"] = self.power(-1, 2)
        if self.chance(0.5):
            law.entries.update(self.friction())
            if not single:
                law.entries.pop("Bristle stiffness", None)
                law.entries.pop("Bristle damping", None)
                law.entries.setdefault("Sticking speed", law.entries.get("Stribeck speed", 1.0) / 50)
            elif self.chance(0.3):
                law.entries["Rolling friction"] = self.power(-3, -1)
                law.entries["Turning friction"] = self.power(-3, -1)
        return law

    # ------------------------------------------------------------- sliders

    def slider(self, model, number):
        beams = [body for body in model.bodies if isinstance(body, Beam)]
        if not beams or self.chance(0.2):
            beam = self.beam(f"rail{number}", self.vector(1))
            beams = [beam]
            model.bodies.append(beam)
            if self.chance(0.8):
                kind = self.random.choice(["rigid", "revolute", "spherical"])
                model.joints.append(self.joint(f"end{number}", kind, "ground", f"{beam.name}.start", beam.points["start"]))
        beam = self.random.choice(beams)
        at = self.random.uniform(0.05, 0.95)
        place, D = beam.place_on_elements(at), beam.axes_at(at)
        rigid = [body for body in model.bodies if isinstance(body, RigidBody)]
        kind = self.random.random()
        if kind < 0.15:
            b = "ground"
        elif rigid and kind < 0.3:
            other = self.random.choice(rigid)
            other.points[f"s{number}"] = place
            b = f"{other.name}.s{number}"
        else:
            body = self.rigid_body(f"sl{number}", place)
            if self.chance(0.4):
                body.velocity, body.spin = self.vector(1), self.random.uniform(0, 5) * self.axis()
            model.bodies.append(body)
            b = body.name + ".j"
        joint = Slider(f"slider{number}", self.random.choice(SLIDING), beam.name, b, place, D)
        joint.part = at
        if joint.kind == "sliding screw" and self.chance(0.9):
            joint.entries["Turn per length"] = self.random.choice((-1, 1)) * self.power(-1, 1.5)
        joint.motions["displacement"] = self.along(at * beam.length(), (1 - at) * beam.length())
        model.joints.append(joint)

    def along(self, before, behind):
        """Entries of a slider that has so much of the beam before and behind it."""
        entries = self.motion("sliding point", False)
        if "Prescribed" in entries:
            entries["Prescribed"].amplitude *= min(before, behind)
            return entries
        if self.chance(0.8):
            entries["Lower stop"], entries["Upper stop"] = -0.9 * before, 0.9 * behind
            entries["Stop stiffness"], entries["Stop damping"] = self.power(3, 6), self.random.choice((0.0, self.power(-1, 1)))
        if self.chance(0.3):
            entries.update(self.friction(), **{"Friction preload": self.power(-1, 1.5)})
        return entries

    # ------------------------------------------------------------ contacts

    def points(self, model):
        """Where balls may be."""
        return [f"{body.name}.{point}" for body in model.bodies for point in body.points]

    def gap(self):
        return self.random.choice((self.power(-3, -1), self.power(-5, -3), -self.power(-6, -4)))

    def contact(self, model, number):
        b = self.random.choice(self.points(model))
        others = ["ground"] + [p for p in self.points(model) if p.partition(".")[0] != b.partition(".")[0]]
        a = "ground" if self.chance(0.5) else self.random.choice(others)
        centre, radius, gap = model.place(b), self.random.uniform(0.03, 0.3), self.gap()
        if a == "ground" and getattr(self, "floating", False):
            return
        normal = -model.gravity / np.linalg.norm(model.gravity) if model.gravity is not None and self.chance(0.7) else self.direction()
        kind = self.random.choice(["ball on plane", "ball on plane", "ellipsoid on plane", "ball on ball", "ball on cylinder"])
        inside, radius_a, semi_axes, law = False, 0.0, (), self.law(True)
        triad = axes(normal)
        place = centre - normal * (radius + gap)
        if kind == "ellipsoid on plane":
            semi_axes = tuple(self.random.uniform(0.03, 0.3) for _ in range(3))
            place = centre - normal * (max(semi_axes) + gap)
        elif kind != "ball on plane":
            place = centre + self.vector(0.7) if a == "ground" else model.place(a)
            away = centre - place
            if kind == "ball on cylinder":
                away = away - normal * (normal @ away)
            distance = np.linalg.norm(away)
            if distance < 0.02:
                return
            inside = self.chance(0.4)
            radius = min(radius, 0.7 * distance)
            radius_a = distance + radius + gap if inside else distance - radius - gap
            if radius_a <= 0:
                return
        model.contacts.append(Contact(f"touch{number}", kind, a, b, place, triad, radius, radius_a, inside, law, semi_axes))

    def group(self, model):
        """Balls that are near each other, over a floor."""
        rigid = [body for body in model.bodies if isinstance(body, RigidBody)]
        beams = [body for body in model.bodies if isinstance(body, Beam) and len(body.line) == 2]
        points = [f"{body.name}.{self.random.choice(('centre', 'f'))}" for body in rigid]
        places = [model.place(p) for p in points]
        apart = [min([np.linalg.norm(p - q) for q in places if q is not p] + [0.3]) for p in places]
        balls = {point: max(0.01, self.random.uniform(0.2, 0.5) * d) for point, d in zip(points, apart)}
        planes = []
        if not getattr(self, "floating", False) and (self.chance(0.7) or len(balls) < 2):
            normal = -model.gravity / np.linalg.norm(model.gravity) if model.gravity is not None else self.direction()
            lowest = min([normal @ p - r for p, r in zip(places, balls.values())] +
                         [normal @ q - 0.02 for beam in beams for q in beam.points.values()] + [0.0])
            planes.append((normal * (lowest - self.gap()), normal))
        lines = {beam.name: 0.02 for beam in beams} if self.chance(0.4) else {}
        if len(balls) + len(lines) + len(planes) < 2 or not balls and not lines:
            return
        model.contacts.append(Group("pile", balls, planes, lines, self.law(False), self.power(4, 7)))
        Lawyer(self.seed).put_on(model.contacts[-1])

    def buffers(self, model):
        """Between neighbours on a beam, as long as they are apart but for a gap."""
        at = {}
        for joint in model.joints:
            if isinstance(joint, Slider) and "Prescribed" not in joint.motions["displacement"]:
                beam = next(body for body in model.bodies if body.name == joint.a)
                at.setdefault(joint.a, []).append((joint.part * beam.length(), joint.name))
        for places in at.values():
            places.sort()
            for (s, first), (r, second) in zip(places, places[1:]):
                gap = abs(self.gap()) * (r - s)
                pair = (first, second) if self.chance(0.5) else (second, first)
                law = self.law(True)
                law.entries = {key: value for key, value in law.entries.items() if key in ("Damping", "Restitution", "Impact speed")}
                model.contacts.append(Buffer(f"buffer{len(model.contacts)}", *pair, r - s - gap, law))

    # ------------------------------------------------------------- the rest

    def rub(self, joint):
        for motion in RUBBING.get(joint.kind, []):
            entries = joint.motions.setdefault(motion, {})
            if "Prescribed" in entries:
                continue
            entries.update(self.friction(0.5))
            if motion.startswith("rotation"):
                entries["Friction radius"] = self.power(-2, -0.7)
            if self.chance(0.4):
                entries["Friction preload"] = self.power(-1, 2)

    def float(self, model):
        """Without the ground, and what acts from outside: momenta stay."""
        self.floating = True
        model.joints = [joint for joint in model.joints if joint.a != "ground" and joint.b != "ground"]
        kept = [joint.name for joint in model.joints]
        model.gears = [gear for gear in model.gears if gear.a.name in kept and gear.b.name in kept]
        model.gravity, model.loads = None, []
        while sum(isinstance(body, RigidBody) for body in model.bodies) < 2:
            body = self.rigid_body(f"free{len(model.bodies)}", self.vector(0.7))
            body.velocity, body.spin = self.vector(2), self.random.uniform(0, 5) * self.axis()
            model.bodies.append(body)

    def put_on(self, model):
        model.title = f"{model.title}, touching"
        if self.chance(0.6):
            for number in range(self.random.choice((1, 1, 1, 2, 3))):
                self.slider(model, number)
        if self.chance(0.25):
            self.float(model)
        if self.chance(0.7):
            for number in range(self.random.choice((1, 1, 2, 3))):
                self.contact(model, number)
        if self.chance(0.4):
            self.group(model)
        if self.chance(0.5):
            for joint in model.joints:
                if self.chance(0.5):
                    self.rub(joint)
        if self.chance(0.7):
            model.analyses = ("dynamic",)  # what only touches is not held in statics
        if self.chance(0.5):
            self.buffers(model)
        for joint in model.joints:
            if isinstance(joint, Slider) and "Stop stiffness" in joint.motions["displacement"] and self.chance(0.3):
                joint.entries["At the ends"] = "stop"
                joint.motions["displacement"] = {key: value for key, value in joint.motions["displacement"].items()
                                                 if key not in ("Lower stop", "Upper stop")}
        Player(self.seed).put_on(model, self.friction)
        if not model.contacts and not any(isinstance(joint, Slider) for joint in model.joints):
            self.contact(model, 9)
        return model


def touching_mechanism(seed):
    model = copy.deepcopy(mechanism(seed))
    return Toucher(seed).put_on(model)


def rough_touching(seed):
    """With wrong lengths: points of rigid bodies that no slider or contact uses are up to some centimetres off."""
    model, generator = touching_mechanism(seed), Generator(f"rough touching {seed}")
    generator.planar = Generator(seed).planar
    size = generator.power(-6, -1.3)
    used = {p for thing in (*model.joints, *model.contacts) if isinstance(thing, (Slider, Contact)) for p in (thing.a, thing.b)}
    for body in model.bodies:
        for name in body.points:
            if name != "centre" and isinstance(body, RigidBody) and f"{body.name}.{name}" not in used:
                body.points[name] = body.points[name] + generator.vector(size)
    return model.with_(is_rough=True)


def pressed_mechanism(seed):
    return Presser(seed).put_on(touching_mechanism(seed), Toucher(f"pressed {seed}").friction)
