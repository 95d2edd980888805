"""Random mechanisms: trees grown joint by joint, so that everything fits, and loops closed by joints put where two bodies
already are. A seed gives the same mechanism for ever: when the generator changes its choices, draw new seeds for new things last."""

import copy
import math
import random

import numpy as np

from mechanism import MOTIONS, WITH_ROTATION, Beam, Function, Gear, Joint, Mechanism, PointLoad, RigidBody
from world import axes, rotation

TREE_JOINTS = ["revolute"] * 4 + ["prismatic", "screw", "cylindrical", "planar", "spherical", "universal", "universal", "rigid",
                                  "distance", "flexible joint"]
SPRUNG_JOINTS = ["revolute"] * 3 + ["prismatic", "screw", "cylindrical", "planar", "universal", "rigid", "flexible joint"]
LOOP_JOINTS = ["spring"] * 3 + ["distance"] * 2 + ["spherical", "universal", "planar", "cylindrical", "revolute", "flexible joint"]
INTEGRATORS = [(stages, radius) for stages in (1, 2, 3) for radius in (0.0, 0.5, 1.0)]


class Generator:
    def __init__(self, seed):
        self.seed = seed
        self.random = random.Random(seed)
        self.planar = self.random.random() < 0.3  # all axes alike: loops that move
        self.sprung = self.random.random() < 0.5  # nothing moves freely: statics and modes
        self.stops = self.random.random() < 0.25
        self.drives = 0

    # ------------------------------------------------------------- numbers

    def chance(self, probability):
        return self.random.random() < probability

    def vector(self, size=1.0):
        v = np.array([self.random.uniform(-size, size) for _ in range(3)])
        return v * (1, 1, 0) if self.planar else v

    def direction(self):
        v = np.array([self.random.gauss(0, 1) for _ in range(3)])
        return v / np.linalg.norm(v)

    def axis(self):
        if self.planar or self.chance(0.2):
            return np.array([0.0, 0.0, 1.0])
        return self.direction()

    def power(self, low, high):
        """A number whose logarithm is evenly distributed."""
        return 10 ** self.random.uniform(low, high)

    def function(self, amplitude):
        kind = self.random.choice(["one", "sine", "pulse", "decay", "one minus cosine"])
        return Function(kind, self.random.uniform(-amplitude, amplitude), self.random.uniform(1, 12))

    # -------------------------------------------------------------- bodies

    def rigid_body(self, name, place):
        """With a point `j` at the place, its centre nearby, and a free point `f`."""
        mass, arm = self.power(-1.5, 1), self.vector(0.5)
        position = place + arm
        orientation = np.eye(3) if self.planar else rotation(self.direction() * self.random.uniform(0, 3))
        radius = self.random.uniform(0.05, 0.4)
        squares = [self.random.uniform(0.5, 1) * radius**2 for _ in range(3)]  # of a cloud of points
        inertia = tuple(mass * (sum(squares) - s) for s in squares)
        centre = self.vector(0.2) if self.chance(0.4) else np.zeros(3)
        points = {"j": place, "f": position + self.vector(0.8), "centre": position}
        return RigidBody(name, points, mass, position, orientation, inertia, centre)

    def beam(self, name, place):
        end = place + self.vector(0.3) + self.random.choice((-1, 1)) * np.array([self.random.uniform(0.4, 1.2), 0, 0])
        line = [place, end]
        if self.chance(0.2):
            side = np.cross(end - place, (0, 0, 1))
            line = [place, (place + end) / 2 + self.random.uniform(0.05, 0.3) * side, end]
        axis_2 = np.cross(end - place, self.direction())
        section = {"E": self.power(8, 11.3), "Density": self.random.uniform(800, 8000), "Outer radius": self.random.uniform(0.01, 0.06)}
        body = Beam(name, {"start": place, "end": end}, line, section, self.random.randint(1, 3), self.random.randint(1, 4),
                    self.chance(0.15), axis_2)
        if self.chance(0.3):
            body.damping = self.power(-5, -3)
        return body

    def body(self, name, place):
        make = self.rigid_body if self.chance(0.65) else self.beam
        body = make(name, place)
        if self.chance(0.4):
            body.velocity, body.spin = self.vector(1), self.random.uniform(0, 5) * self.axis()
        return body

    # -------------------------------------------------------------- joints

    def joint(self, name, kind, a, b, place):
        axis = self.axis()
        joint = Joint(name, kind, a, b, place, axes(axis, None if self.planar else self.direction()))
        if kind == "screw":
            joint.entries["Pitch"] = self.random.choice((-1, 1)) * self.power(-2, -0.5)
        if kind == "rigid" and self.chance(0.5):
            joint.entries["Reaction"] = "true"
        if kind == "flexible joint":
            for key, low in ("Stiffness", 2), ("Rotational stiffness", 1):
                joint.entries[key] = [self.power(low, low + 2) for _ in range(3)]
            for key in ("Damping", "Rotational damping") if self.chance(0.5) else ():
                joint.entries[key] = [self.power(-1, 0.5) for _ in range(3)]
        for motion, (angle, _) in MOTIONS[kind].items():
            entries = self.motion(kind, angle)
            if entries and not (kind == "screw" and joint.motions):  # a screw has one motion
                joint.motions[motion] = entries
        return joint

    def motion(self, kind, angle):
        if kind == "spring":
            return {"Spring": self.power(1, 3), "Rest": self.random.uniform(0.1, 1), "Damper": self.random.choice((0.0, 1.0, 10.0))}
        entries = {}
        if self.chance(0.12) and self.drives < 2:
            self.drives += 1
            return {"Prescribed": Function("one minus cosine", self.random.uniform(-0.4, 0.4) * (1 if angle else 0.3),
                                           self.random.uniform(2, 10))}
        if self.sprung or self.chance(0.4):
            entries["Spring"] = self.power(0, 2) if angle else self.power(1, 3)
            entries["Rest"] = self.random.uniform(-1, 1) * (1 if angle else 0.1)
        if self.chance(0.4):
            entries["Damper"] = self.random.choice((0.1, 1.0))
        if self.chance(0.15):
            entries["Moment" if angle else "Force"] = self.function(2)
        if self.stops and self.chance(0.6):
            reach = self.random.uniform(0.02, 0.3)
            entries["Lower stop"], entries["Upper stop"] = -reach, self.random.uniform(0.02, 0.3)
            entries["Stop stiffness"] = self.power(3, 5)
            entries["Stop damping"] = self.random.choice((0.0, self.power(-1, 1)))
        return entries

    def grow(self, model, number):
        """One more body, at the end of a joint from the ground or from a body that is there."""
        kind = self.random.choice(SPRUNG_JOINTS if self.sprung else TREE_JOINTS)
        parent = "ground"
        if model.bodies and self.chance(0.75):
            body = self.random.choice(model.bodies)
            parent = f"{body.name}.{self.random.choice(list(body.points))}"
        place = model.place(parent)
        place = self.vector(1) if place is None else place
        if kind == "distance" and parent == "ground":
            kind = "spherical"
        if kind == "distance":
            place = place + 0.3 * self.direction()
        body = self.body(f"b{number}", place)
        model.bodies.append(body)
        point = "j" if isinstance(body, RigidBody) else "start"
        model.joints.append(self.joint(f"j{number}", kind, parent, f"{body.name}.{point}", place))

    def close(self, model, number):
        """A loop: a joint between a body and the ground or another body, at a point of the first."""
        kind = self.random.choice(LOOP_JOINTS)
        if self.planar and kind != "spring":
            kind = "revolute"
        body = self.random.choice(model.bodies)
        b = f"{body.name}.{self.random.choice(list(body.points))}"
        others = [other for other in model.bodies if other is not body and isinstance(other, RigidBody)]
        if kind in ("spring", "distance"):
            points = [f"{other.name}.{point}" for other in others for point in other.points]
            points = [p for p in points if np.linalg.norm(model.place(p) - model.place(b)) > 0.05]
            if not points:
                return
            a, place = self.random.choice(points), model.place(b)
        elif others and self.chance(0.7):
            other, place = self.random.choice(others), model.place(b)
            other.points[f"l{number}"] = place
            a = f"{other.name}.l{number}"
        else:
            a, place = "ground", model.place(b)
        if kind == "rigid":
            kind = "spherical"
        model.joints.append(self.joint(f"loop{number}", kind, a, b, place))

    def on_the_plane(self, model):
        """A ball that rolls, or a blade that does not slip, on the ground, a free body."""
        radius, place = self.random.uniform(0.1, 0.5), self.vector(1)
        body = self.rigid_body("wheel", place)
        body.points["f"], body.points["j"] = place + 0.1 * self.direction(), place
        model.bodies.append(body)
        kind = self.random.choice(["rolling ball", "knife edge"])
        joint = Joint("contact", kind, "ground", "wheel.j", place, axes(self.axis()))
        if kind == "rolling ball":
            joint.entries["Radius"] = radius
        model.joints.append(joint)

    # ------------------------------------------------------------- the rest

    def gear(self, model):
        turning = [joint for joint in model.joints if joint.kind in WITH_ROTATION]
        if len(turning) >= 2:
            a, b = self.random.sample(turning, 2)
            model.gears.append(Gear("gr", a, b, self.random.choice((-2.0, -1.0, 0.5, 1.0, 3.0))))

    def load(self, model, number):
        body = self.random.choice(model.bodies)
        parts = lambda size: [(self.direction(), self.function(size)) for _ in range(self.random.randint(0, 2))]
        return PointLoad(f"f{number}", f"{body.name}.{self.random.choice(list(body.points))}", parts(5), parts(1), self.chance(0.5))

    def mechanism(self):
        model = Mechanism(f"random mechanism {self.seed}")
        for number in range(self.random.randint(1, 5)):
            self.grow(model, number)
        for number in range(self.random.choice((0, 0, 0, 1, 1, 2))):
            self.close(model, number)
        if self.chance(0.1):
            self.on_the_plane(model)
        if self.chance(0.15):
            self.gear(model)
        if self.chance(0.7):
            model.gravity = 9.80665 * (np.array([0, -1, 0]) if self.planar else self.direction())
        model.loads = [self.load(model, number) for number in range(self.random.choice((0, 0, 1, 2)))]
        model.loads = [load for load in model.loads if load.forces or load.moments]
        model.step = self.random.choice((0.002, 0.005, 0.01))
        model.stages, model.radius = self.random.choice(INTEGRATORS)
        model.analyses = ("static", "modal", "dynamic") if self.sprung or self.chance(0.05) else ("dynamic",)
        if self.chance(0.3):
            self.loosen(model)
        return model

    def loosen(self, model):
        """A joint that holds no rotation in place of one that does; gears keep theirs."""
        geared = [joint for gear in model.gears for joint in (gear.a, gear.b)]
        able = [joint for joint in model.joints if joint.kind in ("cylindrical", "prismatic", "planar", "spherical") and joint not in geared]
        if able:
            joint = self.random.choice(able)
            joint.kind = "in plane" if joint.kind == "planar" else "in line"
            if joint.kind == "in line" and self.chance(0.3):
                joint.kind = "constant velocity"
            joint.motions = {name: entries for name, entries in joint.motions.items() if name in MOTIONS[joint.kind]}


def mechanism(seed):
    return Generator(seed).mechanism()


def rough_mechanism(seed):
    """The same with wrong lengths: the points of bodies are elsewhere by up to a tenth of a metre, most of them by less."""
    model = copy.deepcopy(mechanism(seed))
    generator = Generator(f"rough {seed}")
    generator.planar = Generator(seed).planar
    size = generator.power(-6, -1)
    for body in model.bodies:
        for name in body.points:
            if name != "centre":
                body.points[name] = body.points[name] + generator.vector(size)
        if isinstance(body, Beam):
            body.line[0], body.line[-1] = body.points["start"], body.points["end"]
    return model.with_(is_rough=True)
