"""Kinds that neither trees nor touching bodies have, on random mechanisms: skew universal joints, springs in fixed axes, points on
curves, rolling discs, gears with backlash, sliders that leave their beams, points along curves of shells. A random stream of its own."""

import copy
from dataclasses import dataclass, field

import numpy as np

from generator import Generator, mechanism
from mechanism import Gear, Joint, RigidBody
from shells import Shell, shelled_mechanism
from touching import Slider, Toucher
from world import DAMPER, FORCE, HINGE_SPRING, LENGTH, SPRING, axes, rotation


@dataclass
class Skew(Joint):
    """Two hinges at any angle: about axis 1 of A and a second one on B, a unit vector."""

    second: np.ndarray = None

    def text(self, world):
        yield "Type", self.kind
        yield "Body A", self.a
        yield "Body B", self.b
        yield "Axis", world.vector(self.axes[:, 0])
        yield "Second axis", world.vector(self.second)
        for name, entries in self.motions.items():
            yield name, [(key, self.motion_value(world, key, value, True)) for key, value in entries.items()]


@dataclass
class FixedSprings(Joint):
    stiffness: tuple = ()
    damping: tuple = ()

    def text(self, world):
        yield "Type", self.kind
        yield "Body A", self.a
        yield "Body B", self.b
        yield "Axis", world.vector(self.axes[:, 0])
        yield "Axis 2", world.vector(self.axes[:, 1])
        yield "Stiffness", world.body_vector(self.stiffness, SPRING)
        yield "Damping", world.body_vector(self.damping, DAMPER)


@dataclass
class Wire(Joint):
    """x(s) = Σ c_k s^k, fixed to A; the point of B is at s = start."""

    curve: list = field(default_factory=list)
    start: float = 0.5

    def at(self, s):
        """Beyond its ends it goes on straight."""
        inner = min(1.0, max(0.0, s))
        value = sum(c * inner**k for k, c in enumerate(self.curve))
        return value + (s - inner) * self.slope(inner)

    def slope(self, s):
        return sum(k * c * s ** (k - 1) for k, c in enumerate(self.curve) if k)

    def text(self, world):
        yield "Type", self.kind
        yield "Body A", self.a
        yield "Body B", self.b
        places = [world.units[0] * (world.turn @ c) for c in self.curve]
        places[0] = places[0] + world.units[0] * world.shift
        yield "Expressions", ", ".join(" + ".join(f"({float(c[i])!r})*s^{k}" if k else f"{float(c[i])!r}" for k, c in enumerate(places))
                                       for i in range(3))


@dataclass
class Disc(Joint):
    """On the plane of the ground normal to axis 3."""

    axle: np.ndarray = None
    radius: float = 0.3

    def text(self, world):
        yield "Type", self.kind
        yield "Body A", self.a
        yield "Body B", self.b
        yield "Radius", world.number(self.radius, LENGTH)
        yield "Axis", world.vector(self.axes[:, 2])
        yield "Axis 1", world.vector(self.axes[:, 0])
        yield "Axle", world.vector(self.axle)


@dataclass
class Mesh(Gear):
    backlash: float = 0.01
    stiffness: float = 1e4
    restitution: float = 1.0

    def text(self, world):
        yield from super().text(world)
        yield "Backlash", repr(self.backlash)
        yield "Mesh stiffness", world.number(self.stiffness, HINGE_SPRING)
        if self.restitution < 1:
            yield "Mesh restitution", repr(self.restitution)
            yield "Mesh speed", world.number(1.0, (0, 0, -1))


@dataclass
class OnShell(Joint):
    """A point that slides along a straight line in u and v of the first patch of a shell, `a`."""

    ends: tuple = ()  # (u, v), (u, v)
    leaves: bool = False

    def text(self, world):
        (u, v), (p, q) = self.ends
        yield "Type", self.kind
        yield "Body A", f"{self.a}.from {u!r} {v!r} to {p!r} {q!r}"
        yield "Body B", self.b
        yield "At the ends", "leave" if self.leaves else "end the run"
        for name, entries in self.motions.items():
            yield name, [(key, self.motion_value(world, key, value, False)) for key, value in entries.items()]


class Further(Toucher):
    def __init__(self, seed):
        super().__init__(f"further {seed}")
        self.stops, self.drives = False, 2

    # -------------------------------------------------------------- kinds

    def skew(self, model):
        """In the place of a universal joint or a ball, or as a tree's next joint."""
        able = [k for k, joint in enumerate(model.joints) if joint.kind in ("universal", "spherical")]
        if able:
            k = self.random.choice(able)
            old = model.joints[k]
            model.joints[k] = self.skew_joint(old.name, old.a, old.b, old.place, old.arm)
            model.joints[k].motions.update(copy.deepcopy(old.motions))
            return
        place = self.vector(1)
        body = self.rigid_body("bent", place)
        model.bodies.append(body)
        model.joints.append(self.skew_joint("cross", "ground", "bent.j", place, False))

    def skew_joint(self, name, a, b, place, arm):
        first = axes(self.direction(), self.direction())
        angle = np.pi / 2 + self.random.uniform(-1.1, 1.1)
        second = np.cos(angle) * first[:, 0] + np.sin(angle) * first[:, 1]
        joint = Skew(name, "skew universal", a, b, place, first, arm=arm, second=second)
        for motion in "rotation 1", "rotation 2":
            if self.chance(0.7):
                joint.motions[motion] = {"Spring": self.power(0, 2), "Damper": self.random.choice((0.0, 0.1, 1.0))}
        return joint

    def fixed_springs(self, model, number):
        points = self.points(model)
        b = self.random.choice(points)
        others = [p for p in points if p.partition(".")[0] != b.partition(".")[0]]
        a = "ground" if self.chance(0.5) or not others else self.random.choice(others)
        stiffness = [self.random.choice((0.0, self.power(0, 3))) for _ in range(3)]
        damping = [self.random.choice((0.0, self.power(-1, 1))) for _ in range(3)]
        model.joints.append(FixedSprings(f"mount{number}", "springs in fixed axes", a, b, model.place(b), axes(self.direction()),
                                         stiffness=tuple(stiffness), damping=tuple(damping)))

    def wire(self, model, number):
        """A new body, or one that is there, on a wire fixed to the ground or to a rigid body."""
        rigid = [body for body in model.bodies if isinstance(body, RigidBody)]
        if rigid and self.chance(0.4):
            body = self.random.choice(rigid)
            b, place = f"{body.name}.f", body.points["f"]
        else:
            place = self.vector(1)
            body = self.rigid_body(f"wired{number}", place)
            if self.chance(0.5):
                body.velocity, body.spin = self.vector(1), self.random.uniform(0, 4) * self.axis()
            model.bodies.append(body)
            b = body.name + ".j"
        others = [other for other in rigid if other is not body]
        a = f"{self.random.choice(others).name}.centre" if others and self.chance(0.5) else "ground"
        start, wave = self.random.uniform(0.2, 0.8), 0.4 * self.vector(1)
        curve = [np.zeros(3), 2 * self.direction(), wave, -wave * self.random.uniform(0, 1)]
        joint = Wire(f"wire{number}", "point on curve", a, b, place, np.eye(3), curve=curve, start=start)
        curve[0] = place - joint.at(start)
        model.joints.append(joint)

    def disc(self, model):
        normal = -model.gravity / np.linalg.norm(model.gravity) if model.gravity is not None else self.axis()
        frame = axes(normal)
        tilt, radius, place = self.random.uniform(-0.8, 0.8), self.random.uniform(0.1, 0.5), self.vector(1)
        axle = np.cos(tilt) * frame[:, 0] + np.sin(tilt) * normal
        body = self.rigid_body("disc", place)
        body.position, body.centre_of_mass = place, np.zeros(3)
        body.points["f"], body.points["centre"] = place + 0.1 * self.direction(), place
        body.orientation = np.eye(3)
        spin = self.random.uniform(-8, 8) * axle + self.random.uniform(-2, 2) * normal
        across = frame[:, 0] * np.cos(tilt) - normal * 0  # the axle along the plane
        low = np.cross(np.cross(axle, normal), axle)
        arm = -radius * low / np.linalg.norm(low)  # from the centre to the contact
        body.velocity, body.spin = -np.cross(spin, arm), spin
        model.bodies.append(body)
        model.joints.append(Disc("edge", "rolling disc", "ground", "disc.j", place, frame, axle=axle, radius=radius))

    def mesh(self, model):
        turning = [joint for joint in model.joints if joint.kind in ("revolute", "cylindrical") and type(joint) is Joint]
        if len(turning) >= 2 and not model.gears:
            a, b = self.random.sample(turning, 2)
            model.gears.append(Mesh("teeth", a, b, self.random.choice((-2.0, -1.0, 0.5, 1.0, 3.0)), backlash=self.power(-3, -1),
                                    stiffness=self.power(2, 5), restitution=self.random.choice((1.0, 0.7))))

    def leaver(self, model, number):
        """A slider whose beam ends soon."""
        self.slider(model, number)
        joint = model.joints[-1]
        entries = joint.motions["displacement"]
        for key in [k for k in entries if k.startswith(("Spring", "Rest", "Lower", "Upper", "Stop", "Bristle", "Prescribed"))]:
            del entries[key]
        if "Friction" in entries:
            entries.setdefault("Sticking speed", entries.get("Stribeck speed", 1.0) / 50)
        joint.entries["At the ends"] = "leave"
        beam = next(body for body in model.bodies if body.name == joint.a)
        if joint.b != "ground" and self.chance(0.7):
            body, _ = model.body(joint.b)
            if hasattr(body, "spin") or body.name.startswith("sl"):
                body.velocity, body.spin = self.random.choice((-1, 1)) * self.random.uniform(1, 8) * joint.axes[:, 0], np.zeros(3)
        if self.chance(0.3):
            entries["Force"] = self.function(20)
        model.steps, model.step = 60, max(model.step, 0.005)
        return beam

    # ----------------------------------------------------------- the rest

    def put_on(self, model):
        model.title += ", with further kinds"
        kinds = [self.skew, lambda m: self.fixed_springs(m, 0), lambda m: self.wire(m, 0), self.disc, self.mesh,
                 lambda m: self.leaver(m, 8)]
        chosen = self.random.sample(range(len(kinds)), self.random.choice((1, 1, 2, 3)))
        for k in chosen:
            kinds[k](model)
        for joint in model.joints:  # a driven screw turns by hundreds of radians a second, with whatever hangs on it
            if joint.kind == "screw":
                joint.motions = {name: {k: v for k, v in entries.items() if k != "Prescribed"} for name, entries in joint.motions.items()}
        model.analyses, model.newton = ("dynamic",), 1e-12
        return model


def further_mechanism(seed):
    return Further(seed).put_on(copy.deepcopy(mechanism(seed)))


def rough_further(seed):
    """With wrong lengths: points that nothing but joints which close gaps uses are up to some centimetres off."""
    model, generator = further_mechanism(seed), Generator(f"rough further {seed}")
    generator.planar = Generator(seed).planar
    size = generator.power(-6, -1.5)
    closing = ("revolute", "spherical", "universal", "rigid", "skew universal")
    used = {p for joint in model.joints if joint.kind not in closing for p in (joint.a, joint.b)}
    for body in model.bodies:
        for name in body.points:
            if name != "centre" and isinstance(body, RigidBody) and f"{body.name}.{name}" not in used:
                body.points[name] = body.points[name] + generator.vector(size)
    return model.with_(is_rough=True)


def curved_mechanism(seed):
    """A shelled one with a body that slides along a line of a shell."""
    model, generator = shelled_mechanism(seed), Further(f"curved {seed}")
    shell = next(body for body in model.bodies if isinstance(body, Shell))
    u, v, p, q = (float(generator.random.uniform(low, low + 0.35)) for low in (0.05, 0.05, 0.6, 0.6))
    if generator.chance(0.5):
        v, q = q, v
    part = generator.random.uniform(0.2, 0.8)
    place = shell.patches[0].place(u + part * (p - u), v + part * (q - v))
    body = generator.rigid_body("onshell", place)
    body.mass, body.inertia = 0.05 * body.mass, tuple(0.05 * i for i in body.inertia)
    along = shell.patches[0].place(p, q) - shell.patches[0].place(u, v)
    body.velocity, body.spin = generator.random.uniform(-2, 2) * along, np.zeros(3)
    model.bodies.append(body)
    joint = OnShell("glide", "sliding point", shell.name, "onshell.j", place, np.eye(3), ends=((u, v), (p, q)), leaves=generator.chance(0.5))
    joint.motions["displacement"] = {}
    if generator.chance(0.4):
        joint.motions["displacement"]["Damper"] = generator.power(-1, 1)
    if generator.chance(0.4):
        joint.motions["displacement"].update({"Friction": generator.random.uniform(0.05, 0.5), "Sticking speed": generator.power(-3, -1)})
    if not joint.leaves and generator.chance(0.5):
        joint.motions["displacement"]["Spring"] = generator.power(1, 2.5)
    model.joints.append(joint)
    model.title += ", with a curve"
    return model
