"""Random mechanisms with shells: patches that are flat, curved and warped, with a second one along an edge and a third that
branches off, isotropic or laminates, with offsets, hung up and connected by their corners and by rigid edges. A random stream of
their own: the mechanisms stay as they are."""

import copy
from dataclasses import dataclass, field

import numpy as np

from generator import INTEGRATORS, Generator, mechanism
from mechanism import Beam, Body, Joint
from world import DENSITY, LENGTH, PRESSURE, TIME, axes


@dataclass
class Patch:
    """x(u, v) = p + u a + v b + u v c + u (1 − u) d: sides u = 0 and 1 are straight, the others parabolas."""

    p: np.ndarray
    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray

    def place(self, u, v):
        return self.p + u * self.a + v * self.b + u * v * self.c + u * (1 - u) * self.d

    def area(self):
        """By Gauss' rule."""
        points, weights = np.polynomial.legendre.leggauss(8)
        total = 0.0
        for u, wu in zip((points + 1) / 2, weights / 2):
            for v, wv in zip((points + 1) / 2, weights / 2):
                total += wu * wv * np.linalg.norm(np.cross(self.a + v * self.c + (1 - 2 * u) * self.d, self.b + u * self.c))
        return total

    def text(self, world):
        vectors = [world.units[0] * (world.turn @ x) for x in (self.a, self.b, self.c, self.d)]
        start = world.units[0] * (world.turn @ self.p + world.shift)
        return ", ".join("{!r} + {!r}*u + {!r}*v + {!r}*u*v + {!r}*u*(1-u)".format(float(start[i]), *(float(x[i]) for x in vectors))
                         for i in range(3)).replace("+ -", "- ")


@dataclass
class Shell(Body):
    patches: list = field(default_factory=list)
    elements: tuple = (2, 1)
    degree: int = 2
    axis_1: np.ndarray = None
    thickness: float = 0.01
    density: float = 1000.0
    E: float = 1e9
    plies: list = None  # angles [degrees]; none: isotropic
    offset: float = 0.0
    damping: float = 0.0
    edges: dict = field(default_factory=dict)  # name of a frame -> edge

    def weight(self):
        return self.density * self.thickness * sum(patch.area() for patch in self.patches)

    def text(self, world):
        yield "Type", "shell"
        yield "Patches", "; ".join(patch.text(world) for patch in self.patches)
        yield "Elements", "{}, {}".format(*self.elements)
        yield "Degree", str(self.degree)
        yield "Axis 1", world.vector(self.axis_1)
        if self.plies:
            yield "Layup", "of " + self.name
        else:
            yield "E", world.number(self.E, PRESSURE)
            yield "Poisson ratio", "0.3"
            yield "Thickness", world.number(self.thickness, LENGTH)
            yield "Density", world.number(self.density, DENSITY)
        yield "Offset", world.number(self.offset, LENGTH)
        if self.damping:
            yield "Damping", world.number(self.damping, TIME)
        corners = [f"{name} at {world.place(place, ' ')}" for name, place in self.points.items() if name not in self.edges]
        yield "Frames", ", ".join(corners)
        if self.edges:
            yield "Rigid edges", ", ".join(f"{name} at {edge}" for name, edge in self.edges.items())
        yield from self.motion_entries(world)

    def material_text(self, world):
        yield "Type", "orthotropic"
        for key, part in ("E1", 1), ("E2", 0.1), ("G12", 0.05), ("G23", 0.04):
            yield key, world.number(part * self.E, PRESSURE)
        yield "nu12", "0.3"
        yield "Density", world.number(self.density, DENSITY)

    def layup_text(self, world):
        yield "Material", "of " + self.name
        yield "Angles", "/".join(str(angle) for angle in self.plies)
        yield "Ply thickness", world.number(self.thickness / len(self.plies), LENGTH)


class Sheller(Generator):
    def __init__(self, seed):
        super().__init__(f"shells {seed}")
        self.planar = False

    def shell(self, name, place):
        """With a corner `a` at the place; corners `a` to `d` of the first patch, `e` of a second one."""
        first = axes(self.direction())
        a, b = self.random.uniform(0.3, 0.8) * first[:, 0], self.random.uniform(0.2, 0.5) * first[:, 1]
        bend = self.random.choice((0.0, 0.3)) * first[:, 2] * self.random.uniform(0.2, 1)
        warp = 0.2 * self.vector(0.3) if self.chance(0.4) else np.zeros(3)
        patches = [Patch(place, a, b, warp, bend)]
        points = {name: patches[0].place(u, v) for name, u, v in (("a", 0, 0), ("b", 1, 0), ("c", 0, 1), ("d", 1, 1))}
        edges = {}
        if self.chance(0.5):  # along the edge u = 1: straight on, at an angle, and a third one there makes it a branch
            for k in range(self.random.choice((1, 2))):
                out = (0.3 - 0.1 * k) * first[:, 0] + (1, -1)[k] * self.random.uniform(0.1, 0.3) * first[:, 2]
                patches.append(Patch(points["b"], out, b + warp, np.zeros(3), np.zeros(3)))
            points["e"] = patches[1].place(1, 0)
        elif self.chance(0.4):
            edges = {"r": "edge u1"}
            del points["b"], points["d"]  # nodes of a rigid edge
            points["r"] = patches[0].place(1, 0.5)
        thickness = self.power(-2.3, -1.5)
        body = Shell(name, points, patches, (self.random.randint(1, 2), 1), self.random.randint(2, 3), first[:, 0] + 0.3 * first[:, 1],
                     thickness, self.random.uniform(500, 3000), self.power(7.5, 10), edges=edges)
        if self.chance(0.6):
            body.plies = [self.random.choice((0, 90, 45, -45, 30)) for _ in range(self.random.randint(1, 4))]
        if self.chance(0.3):
            body.offset = self.random.uniform(-1, 1) * thickness
        if self.chance(0.3):
            body.damping = self.power(-5, -3)
        if self.chance(0.4):
            body.velocity, body.spin = self.vector(1), self.random.uniform(0, 3) * self.direction()
        return body

    def put_on(self, model):
        model.title += ", with shells"
        for number in range(self.random.choice((1, 1, 2))):
            parent, place = "ground", self.vector(1)
            if self.chance(0.7):
                body = self.random.choice([b for b in model.bodies if not isinstance(b, Shell)])
                parent = f"{body.name}.{self.random.choice(list(body.points))}"
                place = model.place(parent)
            shell = self.shell(f"s{number}", place)
            model.bodies.append(shell)
            kind = self.random.choice(("spherical", "spherical", "universal", "rigid"))
            model.joints.append(Joint(f"sj{number}", kind, parent, f"{shell.name}.a", place, axes(self.direction(), self.direction())))
            if "r" in shell.points and self.chance(0.7):  # a body at the rigid edge
                end = self.rigid_body(f"sb{number}", shell.points["r"])
                model.bodies.append(end)
                model.joints.append(self.joint(f"se{number}", self.random.choice(("rigid", "revolute", "spherical")), f"{shell.name}.r",
                                               f"{end.name}.j", shell.points["r"]))
            elif self.chance(0.5):  # a spring from another corner
                corner = self.random.choice([p for p in shell.points if p != "a"])
                end = self.rigid_body(f"sb{number}", shell.points[corner] + 0.3 * self.direction())
                model.bodies.append(end)
                model.joints.append(self.joint(f"se{number}", "spring", f"{end.name}.j", f"{shell.name}.{corner}", shell.points[corner]))
        model.analyses = ("dynamic",)
        model.steps = min(model.steps, 20)
        model.stages, model.radius = self.random.choice(INTEGRATORS)
        return model


def shelled_mechanism(seed):
    return Sheller(seed).put_on(copy.deepcopy(mechanism(seed)))


@dataclass
class AlongEdge(Joint):
    """`distributing`, of the body `b` to an edge, or `support` of an edge by what is `Fixed`."""

    along: str = ""

    def text(self, world):
        yield "Type", self.kind
        yield "Along", self.along
        if self.kind == "distributing":
            yield "Body", self.b
        else:
            yield "Fixed", self.entries["Fixed"]
            yield "Axis", world.vector(self.axes[:, 2])
            yield "Axis 1", world.vector(self.axes[:, 0])


class Edger(Generator):
    """Bodies at the mean motion of edges, and edges that are held, by a stream of their own."""

    def __init__(self, seed):
        super().__init__(f"edges {seed}")
        self.planar = False

    def put_on(self, model):
        model.title += " at edges"
        for number, shell in enumerate([body for body in model.bodies if isinstance(body, Shell) and not body.edges]):
            last = len(shell.patches)
            place = shell.patches[-1].place(1, 0.5)
            if self.chance(0.7):
                end = self.rigid_body(f"eb{number}", place + (0 if self.chance(0.5) else 0.2) * self.direction())
                model.bodies.append(end)
                model.joints.append(AlongEdge(f"ed{number}", "distributing", f"{shell.name}.a", f"{end.name}.j", place, np.eye(3),
                                              along=f"{shell.name}.{f'patch {last} ' if last > 1 else ''}edge u1"))
            if self.chance(0.4):
                fixed = self.random.sample([f"{kind} {i}" for kind in ("displacement", "rotation") for i in (1, 2, 3)], self.random.randint(1, 3))
                corner = shell.points["c"]
                model.joints.append(AlongEdge(f"es{number}", "support", "ground", f"{shell.name}.c", corner, axes(self.direction()),
                                              entries={"Fixed": ", ".join(sorted(fixed))}, along=f"{shell.name}.patch 1 edge v1"
                                              if last > 1 else f"{shell.name}.edge v1"))
        return model


def edged_mechanism(seed):
    return Edger(seed).put_on(shelled_mechanism(seed))
