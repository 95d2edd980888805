"""What a mechanism is made of, and its text as a .prm file in a world of one's choice."""

import dataclasses
from dataclasses import dataclass, field

import numpy as np

from world import (ACCELERATION, DAMPER, DENSITY, FORCE, FREQUENCY, HINGE_DAMPER, HINGE_SPRING, INERTIA, LENGTH, MASS, MOMENT,
                   NUMBER, PRESSURE, SPEED, SPRING, TIME, World)

# name of a motion -> (angle?, axis 0 to 2), by kind of joint; the axes are the columns of Joint.axes
MOTIONS = {
    "revolute": {"rotation": (True, 2)},
    "prismatic": {"displacement": (False, 2)},
    "screw": {"displacement": (False, 2), "rotation": (True, 2)},
    "cylindrical": {"displacement": (False, 2), "rotation": (True, 2)},
    "planar": {"displacement 1": (False, 0), "displacement 2": (False, 1), "rotation": (True, 2)},
    "spherical": {},
    "constant velocity": {},
    "in line": {"displacement": (False, 2)},
    "in plane": {"displacement 1": (False, 0), "displacement 2": (False, 1)},
    "universal": {"rotation 1": (True, 0), "rotation 2": (True, 1)},
    "rigid": {},
    "flexible joint": {},
    "distance": {},
    "spring": {"length": (False, None)},
    "rolling ball": {},
    "knife edge": {},
    "skew universal": {"rotation 1": (True, 0), "rotation 2": (True, 1)},
    "springs in fixed axes": {},
    "point on curve": {},
    "rolling disc": {},
    "distributing": {},
    "support": {},
    "sliding point": {"displacement": (False, None)},
    "sliding sleeve": {"displacement": (False, None)},
    "sliding prismatic": {"displacement": (False, None)},
    "sliding screw": {"displacement": (False, None)},
}
WITH_ROTATION = [kind for kind, motions in MOTIONS.items() if "rotation" in motions]


@dataclass
class Function:
    """amplitude f(t); kinds: one, sine, one minus cosine, pulse, decay."""

    kind: str
    amplitude: float
    rate: float = 1.0  # rad/s, 1/s, or 1/duration

    def text(self, world, dimension):
        rate = world.number(self.rate, FREQUENCY)
        shape = {"one": "1", "sine": f"sin({rate}*t)", "one minus cosine": f"(1 - cos({rate}*t))", "pulse": f"({rate}*t < 1 ? 1 : 0)",
                 "decay": f"exp(-({rate}*t))"}[self.kind]
        return f"{world.number(self.amplitude, dimension)}*{shape}"

    def __call__(self, t):
        x = self.rate * np.asarray(t, float)
        shape = {"one": np.ones_like, "sine": np.sin, "one minus cosine": lambda x: 1 - np.cos(x), "decay": lambda x: np.exp(-x),
                 "pulse": lambda x: np.where(x < 1, 1.0, 0.0)}[self.kind]
        return self.amplitude * shape(x)


@dataclass
class Body:
    name: str
    points: dict  # name -> place [m]

    def motion_entries(self, world):
        if not hasattr(self, "spin"):
            return
        yield "Velocity", world.vector(self.velocity, SPEED)
        yield "Angular velocity", world.vector(self.spin, FREQUENCY)


@dataclass
class RigidBody(Body):
    mass: float = 1.0
    position: np.ndarray = None
    orientation: np.ndarray = None
    inertia: tuple = ()
    centre_of_mass: np.ndarray = None

    def weight(self):
        return self.mass

    def text(self, world):
        yield "Type", "rigid body"
        yield "Mass", world.number(self.mass, MASS)
        yield "Position", world.place(self.position)
        yield "Rotation", world.orientation(self.orientation)
        yield "Inertia", world.body_vector(self.inertia, INERTIA)
        yield "Centre of mass", world.body_vector(self.centre_of_mass, LENGTH)
        frames = [f"{name} at {world.place(place, ' ')}" for name, place in self.points.items() if name != "centre"]
        yield "Frames", ", ".join(frames)
        yield from self.motion_entries(world)


@dataclass
class Beam(Body):
    line: list = None  # places: start, (middle,) end
    section: dict = None
    elements: int = 1
    degree: int = 3
    rigid: bool = False
    axis_2: np.ndarray = None
    damping: float = 0.0

    def weight(self):
        return self.section["Density"] * np.pi * self.section["Outer radius"] ** 2 * self.length()

    def arc(self):
        """Centre, two normal directions and the angle of an arc through three points, from the first direction on."""
        p, q, r = self.line
        u, v = q - p, r - p
        w = np.cross(u, v)
        centre = p + (np.cross(w, u) * (v @ v) + np.cross(v, w) * (u @ u)) / (2 * w @ w)
        first = p - centre
        second = np.cross(w / np.linalg.norm(w), first)
        angle = np.arctan2((r - centre) @ second, (r - centre) @ first)
        return centre, first, second, angle % (2 * np.pi)

    def length(self):
        if len(self.line) == 2:
            return float(np.linalg.norm(self.line[1] - self.line[0]))
        _, first, _, angle = self.arc()
        return float(np.linalg.norm(first) * angle)

    def place_at(self, part):
        """Of the reference line, at a part of its length."""
        if len(self.line) == 2:
            return (1 - part) * self.line[0] + part * self.line[1]
        centre, first, second, angle = self.arc()
        return centre + first * np.cos(part * angle) + second * np.sin(part * angle)

    def axes_at(self, part):
        """Those of the section of a straight beam (columns); of an arc any with the tangent as the first."""
        tangent = self.place_at(part + 1e-5) - self.place_at(part - 1e-5)
        tangent /= np.linalg.norm(tangent)
        second = self.axis_2 - tangent * (tangent @ self.axis_2)
        second /= np.linalg.norm(second)
        return np.column_stack((tangent, second, np.cross(tangent, second)))

    def nodes(self):
        """Parts of the length at which the nodes of each element are, (elements, degree + 1): Gauss–Lobatto points."""
        inner = np.polynomial.legendre.Legendre.basis(self.degree).deriv().roots() if self.degree > 1 else []
        unit = (np.array([-1, *np.real(np.sort(inner)), 1]) + 1) / 2
        return (np.arange(self.elements)[:, None] + unit) / self.elements

    def place_on_elements(self, part):
        """Where the elements have that place: on polynomials through their nodes."""
        nodes = self.nodes()[min(self.elements - 1, int(part * self.elements))]
        weights = [np.prod([(part - r) / (s - r) for r in nodes if r != s]) for s in nodes]
        return sum(weight * self.place_at(node) for weight, node in zip(weights, nodes))

    def node_points(self):
        """The same as points for probes, once each."""
        return list(dict.fromkeys(f"{self.name}.at {float(part)!r}" for part in self.nodes().ravel()))

    def text(self, world):
        yield "Type", "beam"
        yield "Section", "of " + self.name
        yield "Shape", "arc" if len(self.line) == 3 else "polyline"
        yield "Points", "; ".join(world.place(p) for p in self.line)
        yield "Axis 2", world.vector(self.axis_2)
        yield "Elements", str(self.elements)
        yield "Degree", str(self.degree)
        if self.rigid:
            yield "Rigid", "true"
        if self.damping:
            yield "Damping", world.number(self.damping, TIME)
        yield from self.motion_entries(world)

    def section_text(self, world):
        yield "Type", "tube"
        for key, dimension in ("E", PRESSURE), ("Density", DENSITY), ("Outer radius", LENGTH):
            yield key, world.number(self.section[key], dimension)


@dataclass
class Joint:
    name: str
    kind: str
    a: str  # body.point or ground
    b: str
    place: np.ndarray
    axes: np.ndarray  # columns E1 E2 E3
    motions: dict = field(default_factory=dict)  # name -> {entry: number or Function}
    entries: dict = field(default_factory=dict)  # pitch, radius, stiffness, ...
    arm: bool = False  # the place is at neither point: written out
    common: dict = field(default_factory=dict)  # friction against several motions, of a thread: name of the subsection -> entries

    DIMENSIONS = {  # of a displacement, of an angle
        "Spring": (SPRING, HINGE_SPRING), "Rest": (LENGTH, NUMBER), "Damper": (DAMPER, HINGE_DAMPER), "Force": (FORCE, None),
        "Lower stop": (LENGTH, NUMBER), "Upper stop": (LENGTH, NUMBER), "Stop stiffness": (SPRING, HINGE_SPRING),
        "Stop damping": (DAMPER, HINGE_DAMPER), "Moment": (None, MOMENT), "Prescribed": (LENGTH, NUMBER),
        "Friction": (NUMBER, NUMBER), "Static friction": (NUMBER, NUMBER), "Stribeck speed": (SPEED, SPEED),
        "Sticking speed": (SPEED, SPEED), "Bristle stiffness": (SPRING, SPRING), "Bristle damping": (DAMPER, DAMPER),
        "Friction radius": (LENGTH, LENGTH), "Friction preload": (FORCE, FORCE), "Radius": (LENGTH, LENGTH), "Flank angle": (NUMBER, NUMBER)}
    OWN = {"Bearing length": LENGTH, "Pitch": LENGTH, "Radius": LENGTH, "Stiffness": SPRING, "Rotational stiffness": HINGE_SPRING, "Damping": DAMPER,
           "Rotational damping": HINGE_DAMPER}

    def text(self, world):
        yield "Type", self.kind
        yield "Body A", self.a
        yield "Body B", self.b
        if self.kind in ("distance", "spring"):
            pass
        elif self.kind == "universal":
            yield "Axis", world.vector(self.axes[:, 0])
            yield "Second axis", world.vector(self.axes[:, 1])
        elif self.kind == "flexible joint":
            yield "Axis", world.vector(self.axes[:, 0])
            yield "Axis 2", world.vector(self.axes[:, 1])
        elif self.kind == "knife edge":
            yield "Axis", world.vector(self.axes[:, 0])
        else:
            yield "Axis", world.vector(self.axes[:, 2])
            yield "Axis 1", world.vector(self.axes[:, 0])
        if self.arm:
            yield "Position", world.place(self.place)
        for key, value in self.entries.items():
            if key not in self.OWN:
                yield key, str(value)
            elif np.ndim(value):
                yield key, world.body_vector(value, self.OWN[key])
            else:
                yield key, world.number(value, self.OWN[key])
        for name, entries in self.motions.items():
            angle = MOTIONS[self.kind][name][0]
            yield name, [(key, self.motion_value(world, key, value, angle)) for key, value in entries.items()]
        for name, entries in self.common.items():
            yield name, [(key, self.motion_value(world, key, value, name == "rotation")) for key, value in entries.items()]

    def motion_value(self, world, key, value, angle):
        dimension = self.DIMENSIONS[key][angle]
        return value.text(world, dimension) if isinstance(value, Function) else world.number(value, dimension)


@dataclass
class Gear:
    name: str
    a: Joint
    b: Joint
    ratio: float
    mesh: dict = field(default_factory=dict)  # of teeth with a play: {entry: number}

    MESH = {"Backlash": NUMBER, "Mesh stiffness": HINGE_SPRING, "Mesh damping": HINGE_DAMPER, "Mesh restitution": NUMBER,
            "Mesh speed": FREQUENCY}

    def text(self, world):
        yield "Type", "gear"
        yield "Joint A", self.a.name + ".rotation"
        yield "Joint B", self.b.name + ".rotation"
        yield "Ratio", repr(self.ratio)
        for key, value in self.mesh.items():
            yield key, world.number(value, self.MESH[key])


@dataclass
class PointLoad:
    name: str
    at: str
    forces: list  # (direction, Function) pairs
    moments: list
    body_axes: bool

    def text(self, world):
        yield "Type", "point load"
        yield "At", self.at
        for key, parts, dimension in ("Force", self.forces, FORCE), ("Moment", self.moments, MOMENT):
            if parts:
                yield key, self.components(world, parts, dimension)
        yield "Axes", "body" if self.body_axes else "inertial"

    def components(self, world, parts, dimension):
        turn = np.eye(3) if self.body_axes else world.turn
        vectors = [(turn @ direction, function) for direction, function in parts]
        return ", ".join(" + ".join(f"{float(v[i])!r}*{f.text(world, dimension)}" for v, f in vectors) for i in range(3))


@dataclass
class Mechanism:
    title: str
    bodies: list = field(default_factory=list)
    joints: list = field(default_factory=list)
    gears: list = field(default_factory=list)
    loads: list = field(default_factory=list)
    contacts: list = field(default_factory=list)
    gravity: np.ndarray = None
    analyses: tuple = ("dynamic",)
    step: float = 0.01
    steps: int = 50
    stages: int = 3
    radius: float = 0.5
    newton: float = 1e-10
    modes: int = 6
    is_rough: bool = False  # drawn with gaps that an assembly has to close

    def body(self, point):
        """The body and the name of the point in "body.point"."""
        name, _, place = point.partition(".")
        return next(body for body in self.bodies if body.name == name), place

    def place(self, point):
        if point == "ground":
            return None
        body, name = self.body(point)
        return body.points[name]

    def with_(self, **changes):
        return dataclasses.replace(self, **changes)

    def joint_points(self):
        """All points that joints or loads use, once each, and the centres of rigid bodies."""
        points = {p: None for joint in self.joints for p in (joint.a, joint.b) if p != "ground" and "." in p}
        points.update({p: None for contact in self.contacts if hasattr(contact, "place") for p in (contact.a, contact.b) if p != "ground"})
        points.update({p: None for contact in self.contacts if hasattr(contact, "balls") for p in contact.balls})
        if self.contacts or any(joint.kind.startswith("sliding") for joint in self.joints):
            points.update({p: None for body in self.bodies if isinstance(body, Beam) for p in body.node_points()})
        points.update({f"{body.name}.centre": None for body in self.bodies if isinstance(body, RigidBody)})
        return list(points)

    def probes(self):
        for point in self.joint_points():
            for quantity in "position", "rotation", "velocity", "angular velocity":
                for axis in "xyz":
                    yield f"{point}.{quantity} {axis}"
        for joint in self.joints:
            for motion in MOTIONS[joint.kind]:
                yield f"{joint.name}.{motion}"
            if joint.kind.startswith("sliding"):
                yield f"{joint.name}.arc length"
                if joint.entries.get("At the ends") == "leave" or getattr(joint, "leaves", False):
                    yield f"{joint.name}.attached"
        for gear in self.gears:
            if getattr(gear, "backlash", 0):
                yield f"{gear.name}.moment"
            elif gear.mesh:
                yield from (f"{gear.name}.{quantity}" for quantity in ("play", "moment"))
        for contact in self.contacts:
            if hasattr(contact, "balls"):
                yield from contact.probes()
            else:
                yield from (f"{contact.name}.{quantity}" for quantity in ("gap", "force"))
                if contact.law.friction():
                    yield from (f"{contact.name}.{quantity}" for quantity in ("slip", "friction"))

    def size(self):
        """Largest distance between points, at least 1 mm [m]."""
        places = [p for body in self.bodies for p in body.points.values()]
        return max([1e-3] + [float(np.linalg.norm(p - q)) for p in places for q in places])

    def mass(self):
        return sum(body.weight() for body in self.bodies)

    def tree(self, world):
        """The file as nested lists of (entry, value) and (subsection, list)."""
        yield "Title", self.title
        yield "Analyses", ", ".join(self.analyses)
        yield "Sections", [("of " + b.name, list(b.section_text(world))) for b in self.bodies if isinstance(b, Beam)]
        laminates = [body for body in self.bodies if getattr(body, "plies", None)]
        yield "Materials", [("of " + b.name, list(b.material_text(world))) for b in laminates]
        yield "Layups", [("of " + b.name, list(b.layup_text(world))) for b in laminates]
        yield "Bodies", [(body.name, list(body.text(world))) for body in self.bodies]
        if self.is_rough:
            yield "Assembly", [("Gaps", "closed")]
        yield "Joints", [(joint.name, list(joint.text(world))) for joint in (*self.joints, *self.gears, *self.contacts)]
        loads = [(load.name, list(load.text(world))) for load in self.loads]
        if self.gravity is not None:
            loads.append(("weight", [("Type", "gravity"), ("Acceleration", world.vector(self.gravity, ACCELERATION))]))
        yield "Loads", loads
        if "modal" in self.analyses:
            yield "Modal", [("Modes", str(self.modes)), ("Animations", "0"), ("Shift", world.number(1, FREQUENCY))]
        if "dynamic" in self.analyses:
            yield "Dynamic", [("Step", world.number(self.step, TIME)), ("End time", world.number(self.step * self.steps, TIME)),
                              ("Smallest step", world.number(1e-9 * self.step, TIME)), ("Stages", str(self.stages)),
                              ("Spectral radius", repr(self.radius)), ("Newton tolerance", repr(self.newton))]
        yield "Output", [("Pictures", "false"), ("Probes", ", \\\n    ".join(self.probes()))]

    def text(self, world):
        return render(self.tree(world))

    def text_here(self):
        return self.text(World())


def render(tree, indent=""):
    lines = []
    for key, value in tree:
        if isinstance(value, list):
            lines += [f"{indent}subsection {key}", render(value, indent + "  ").rstrip("\n"), f"{indent}end"] if value else []
        else:
            lines.append(f"{indent}set {key} = {value}")
    return "\n".join(line for line in lines if line.strip()) + "\n"
