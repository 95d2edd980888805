"""Wings in even air and rotors in hover or climb, beside what blade elements and momentum theory say of them: forces, power and
inflow. Numbers are exact but for the stations, whose share is found by doing the sum here with as many."""

import math
import random
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

import judges
from outline import render
from program import Run
from world import axes

EXACT = 1e-8  # of the largest component, beside what the stations miss
MANY = 60  # stations of the exact sum


def comma(vector):
    return ", ".join(repr(float(x)) for x in vector)


@dataclass
class Foil:
    """The analytic airfoil."""

    chance: random.Random

    def __post_init__(self):
        draw = self.chance.uniform
        self.form, self.slope, self.zero = self.chance.choice(("periodic", "linear")), draw(5, 6.5), draw(-0.05, 0.05)
        self.drag, self.moment = (draw(0.005, 0.02), draw(-0.02, 0.02), draw(0.1, 0.5)), (draw(-0.05, 0.05), draw(-0.05, 0.05))
        self.compressible = self.chance.random() < 0.5

    def entries(self):
        return [("Type", "analytic"), ("Form", self.form), ("Lift slope", repr(self.slope)), ("Zero-lift angle", repr(self.zero)),
                ("Drag", comma(self.drag)), ("Moment", comma(self.moment)), ("Compressible", str(self.compressible).lower())]

    def coefficients(self, alpha, mach):
        """Lift, drag, moment."""
        x = alpha - self.zero
        u, shape = (x, x) if self.form == "linear" else (math.sin(x), math.sin(x) * math.cos(x))
        growth = 1 / math.sqrt(1 - mach**2) if self.compressible else 1
        return self.slope * growth * shape, self.drag[0] + self.drag[1] * u + self.drag[2] * u**2, self.moment[0] + self.moment[1] * u


@dataclass
class Air:
    density: float
    sound: float

    def entries(self, wind):
        return [("Type", "air"), ("Density", repr(self.density)), ("Speed of sound", repr(self.sound)), ("Wind", comma(wind))]

    def loads(self, foil, chord, frame, flow):
        """Force and moment about the quarter chord per length in a flow, inertial components; columns of the frame lie along the line, to
        the nose, up. Drag goes along the flow, its part along the line, too."""
        V = frame.T @ flow
        U = math.hypot(V[1], V[2])
        lift, drag, moment = foil.coefficients(math.atan2(V[2], -V[1]), U / self.sound)
        q = 0.5 * self.density * chord
        force = np.array((q * U * drag * V[0], q * U * (lift * V[2] + drag * V[1]), q * U * (-lift * V[1] + drag * V[2])))
        return frame @ force, frame[:, 0] * q * chord * U**2 * moment


@dataclass
class Blade:
    """A straight surface: where it starts, the directions along it, to the leading edge and up, length, and what is linear along it."""

    start: np.ndarray
    along: np.ndarray
    ahead: np.ndarray
    up: np.ndarray
    length: float
    chord: tuple
    twist: tuple
    quarter: float

    def entries(self, body, stations):
        table = lambda ends: f"table: 0, {ends[0]!r}; {self.length!r}, {ends[1]!r}"
        return [("Type", "lifting line"), ("Body", body), ("Line", comma(self.start) + "; " + comma(self.start + self.length * self.along)),
                ("Leading edge", comma(self.ahead + 0.2 * self.along)), ("Upper side", comma(self.up)), ("Chord", table(self.chord)),
                ("Twist", table(self.twist)), ("Quarter chord", repr(self.quarter)), ("Airfoils", "foil"), ("Stations", str(stations))]

    def stations(self, n):
        """Weight, chord, place on the line, frame of the section."""
        sides = np.column_stack((np.cross(self.ahead, self.up), self.ahead, self.up))
        for x, weight in zip(*np.polynomial.legendre.leggauss(n)):
            part = (x + 1) / 2
            at = lambda ends: (1 - part) * ends[0] + part * ends[1]
            c, s = math.cos(at(self.twist)), math.sin(at(self.twist))
            place = self.start + part * self.length * self.along
            yield 0.5 * self.length * weight, at(self.chord), place, sides @ np.array(((1, 0, 0), (0, c, -s), (0, s, c)))


@dataclass
class Wing:
    """A rigid wing that is held in a wind: the forces of strips, each as in the flow of all."""

    seed: int

    def __post_init__(self):
        chance = self.chance = random.Random(f"wing {self.seed}")
        draw = chance.uniform
        self.foil, self.air, self.stations = Foil(chance), Air(draw(0.5, 1.3), draw(200, 400)), chance.randint(2, 8)
        turn, length, chord = axes([chance.gauss(0, 1) for _ in range(3)]), draw(1, 10), draw(0.1, 1)
        is_plain = chance.random() < 0.5  # rectangular, without twist: any number of stations is exact
        chords = (chord, chord if is_plain else chord * draw(0.3, 1))
        twists = (draw(-0.1, 0.2),) * 2 if is_plain else (draw(-0.1, 0.2), draw(-0.1, 0.2))
        start = np.array([draw(-2, 2) for _ in range(3)])
        self.blade = Blade(start, turn[:, 0], turn[:, 1], turn[:, 2], length, chords, twists, draw(-0.3, 0.3) * chord)
        speed, alpha, beta = draw(10, 100), draw(-0.2, 0.2), draw(-0.5, 0.5)
        self.wind = speed * turn @ np.array((math.sin(beta), -math.cos(beta) * math.cos(alpha), math.cos(beta) * math.sin(alpha)))
        self.unsteady, self.virtual = chance.choice(("two lags", "quasi-steady", "dynamic stall")), chance.choice(("true", "false"))

    def text(self):
        return render([
            ["Analyses", "static"],
            ["Bodies", [["wing", [("Type", "rigid body"), ("Mass", "3"), ("Inertia", "1, 1, 1")]]]],
            ["Joints", [["clamp", [("Type", "rigid"), ("Body A", "ground"), ("Body B", "wing.centre"), ("Reaction", "true")]]]],
            ["Airfoils", [["foil", self.foil.entries()]]],
            ["Aerodynamics", [["air", self.air.entries(self.wind)]]],
            ["Surfaces", [["w", self.blade.entries("wing", self.stations) + [("Unsteady", self.unsteady), ("Virtual mass", self.virtual)]]]],
            ["Output", [("Probes", ", ".join(f"w.{what} {axis}" for what in ("force", "moment") for axis in "xyz")), ("Pictures", "false")]]])

    def of_strips(self, n):
        force, moment = np.zeros(3), np.zeros(3)
        for weight, chord, place, frame in self.blade.stations(n):
            f, m = self.air.loads(self.foil, chord, frame, self.wind)
            force += weight * f
            moment += weight * (m + np.cross(place + self.blade.quarter * frame[:, 1], f))
        return {"force": force, "moment": moment}

    def complaints(self, program):
        run = Run(program, self.text())
        said = list(judges.outcome(run))
        if run.code != 0:
            return [run], said + [f"a wing in even air ends with {run.code}: {run.output[-300:]}"]
        exact, here = self.of_strips(MANY), self.of_strips(self.stations)
        for name in exact:
            found = run.tables["static"].vector("w." + name)[-1]
            said += compare("w." + name, found, exact[name], here[name])
        return [run], said


def compare(name, found, exact, with_stations, tolerance=EXACT):
    """Twice what as many stations miss here is allowed, too."""
    scale = max(abs(np.atleast_1d(exact)).max(), 1e-12)
    by_stations = 2 * abs(np.subtract(with_stations, exact)).max()
    error = abs(np.subtract(found, exact)).max()
    if not error <= tolerance * scale + by_stations:
        yield f"{name} is {found}, and should be {exact}: off by {error / scale:.1e}, of which stations may be {by_stations / scale:.1e}"


@dataclass
class Divergent:
    """A wing that lift twists: θ'' + κ²(θ + α) = 0 with κ² = ½ρU² c e a/GJ, clamped at its root, so that at its tip
    θ = α (1/cos κL − 1). e is from the elastic axis to the quarter chord; α is so small that all is linear."""

    seed: int
    alpha = 1e-5

    def __post_init__(self):
        draw = random.Random(f"divergent {self.seed}").uniform
        self.length, self.chord, self.density, self.speed, self.slope = draw(1, 10), draw(0.2, 1), draw(0.5, 1.3), draw(10, 80), draw(5, 6.5)
        self.e, self.kl = draw(0.05, 0.25) * self.chord, draw(0.2, 1.3)
        self.GJ = 0.5 * self.density * self.speed**2 * self.chord * self.e * self.slope * (self.length / self.kl) ** 2
        self.turn = axes([random.Random(f"divergent axes {self.seed}").gauss(0, 1) for _ in range(3)])

    def text(self):
        along, ahead, up = self.turn.T
        # so stiff in bending that the bent line does not turn the forces
        section = [("Type", "engineering constants"), ("EA", repr(1e4 * self.GJ)), ("GA2", repr(1e4 * self.GJ)), ("GA3", repr(1e4 * self.GJ)),
                   ("GJ", repr(self.GJ)), ("EI2", repr(1e3 * self.GJ)), ("EI3", repr(1e3 * self.GJ)), ("Mass", "1"), ("I2", "1"), ("I3", "1")]
        return render([
            ["Analyses", "static"],
            ["Sections", [["s", section]]],
            ["Bodies", [["wing", [("Type", "beam"), ("Points", "0, 0, 0; " + comma(self.length * along)), ("Axis 2", comma(ahead)), ("Section", "s"),
                                  ("Elements", "4"), ("Degree", "4")]]]],
            ["Joints", [["clamp", [("Type", "rigid"), ("Body A", "ground"), ("Body B", "wing.start")]]]],
            ["Airfoils", [["foil", [("Type", "analytic"), ("Form", "linear"), ("Lift slope", repr(self.slope))]]]],
            ["Aerodynamics", [["air", Air(self.density, 340.0).entries(-self.speed * ahead)]]],
            ["Surfaces", [["w", [("Type", "lifting line"), ("Body", "wing"), ("Chord", repr(self.chord)), ("Quarter chord", repr(self.e)),
                                 ("Airfoils", "foil"), ("Twist", repr(self.alpha))]]]],
            ["Static", [("Tolerance", "1e-14")]],
            ["Output", [("Probes", ", ".join(f"wing.end.rotation {axis}" for axis in "xyz")), ("Pictures", "false")]]])

    def complaints(self, program):
        run = Run(program, self.text())
        said = list(judges.outcome(run))
        if run.code != 0:
            return [run], said + [f"a wing below its divergence ends with {run.code}: {run.output[-300:]}"]
        twist = math.radians(run.tables["static"].vector("wing.end.rotation")[-1] @ self.turn[:, 0]) / self.alpha
        exact = 1 / math.cos(self.kl) - 1
        return [run], said + list(compare("twist at the tip over the angle of attack", twist, exact, exact, 1e-6))


@dataclass
class Hover:
    """A rigid rotor in hover or climb: blade elements with the flow that momentum theory gives to their thrust, of the whole disk or of
    each annulus."""

    seed: int

    def __post_init__(self):
        chance = self.chance = random.Random(f"hover {self.seed}")
        draw = chance.uniform
        self.foil, self.air, self.stations = Foil(chance), Air(draw(0.5, 1.3), draw(300, 400)), chance.randint(4, 8)
        self.inflow, self.blades, self.radius = chance.choice(("uniform", "uniform", "annular")), chance.randint(1, 5), draw(0.3, 8)
        self.speed = draw(50, 220) / self.radius
        tip = self.speed * self.radius
        self.climb = chance.choice((0.0, draw(0, 0.05) * tip))
        self.turn, self.sense = axes([chance.gauss(0, 1) for _ in range(3)]), chance.choice((-1, 1))
        root, chord, pitch = draw(0.1, 0.3) * self.radius, draw(0.03, 0.1) * self.radius, draw(0.1, 0.25) + math.atan(self.climb / (0.7 * tip))
        is_plain = chance.random() < 0.5
        chords, twists = (chord, chord), (pitch, pitch)
        if not is_plain:
            chords, twists = (chord, draw(0.5, 1) * chord), (pitch + draw(0, 0.1), pitch - draw(0, 0.05))
        self.list, quarter = [], draw(-0.2, 0.2) * chord
        for k in range(self.blades):
            angle = 2 * math.pi * k / self.blades + 0.3
            along = self.turn @ np.array((math.cos(angle), math.sin(angle), 0))
            ahead = self.sense * np.cross(self.turn[:, 2], along)
            self.list.append(Blade(root * along, along, ahead, self.turn[:, 2], self.radius - root, chords, twists, quarter))

    def text(self):
        up = self.turn[:, 2]
        flow = [("Type", f"{self.inflow} inflow"), ("Hub", "rotor.centre"), ("Axis", comma(up)), ("Radius", repr(self.radius)), ("Initial", "3"),
                ("Tip loss", "none")]
        flow += [("Swirl", "false")] if self.inflow == "annular" else []
        probes = ["flow.thrust", "flow.torque", "flow.power"] + (["flow.mean"] if self.inflow == "uniform" else [])
        return render([
            ["Analyses", "static"],
            ["Bodies", [["rotor", [("Type", "rigid body"), ("Mass", "3"), ("Inertia", "1, 1, 1")]]]],
            ["Joints", [["shaft", [("Type", "revolute"), ("Body A", "ground"), ("Body B", "rotor.centre"), ("Axis", comma(up))]]]],
            ["Airfoils", [["foil", self.foil.entries()]]],
            ["Aerodynamics", [["air", self.air.entries(-self.climb * up)], ["flow", flow]]],
            ["Surfaces", [[f"w{k}", blade.entries("rotor", self.stations) + [("Inflow", "flow")]] for k, blade in enumerate(self.list)]],
            ["Loads", [["turning", [("Type", "steady rotation"), ("Joint", "shaft"), ("Speed", repr(self.sense * self.speed))]]]],
            ["Static", [("Tolerance", "1e-12")]],
            ["Output", [("Probes", ", ".join(probes)), ("Pictures", "false")]]])

    def loads(self, station, flow):
        """Per length of a blade with that flow against the axis: thrust, and torque about the axis against the sense of rotation."""
        _, chord, place, frame = station
        up = self.turn[:, 2]
        behind = place + (self.list[0].quarter - 0.5 * chord) * frame[:, 1]
        f, m = self.air.loads(self.foil, chord, frame, -(self.climb + flow) * up - np.cross(self.sense * self.speed * up, behind))
        return f @ up, -self.sense * (np.cross(place + self.list[0].quarter * frame[:, 1], f) + m) @ up

    def of_elements(self, n):
        """Thrust, torque, mean flow."""
        stations, area, rho = list(self.list[0].stations(n)), math.pi * self.radius**2, self.air.density
        sums = lambda flows: self.blades * sum(station[0] * np.array(self.loads(station, flow)) for station, flow in zip(stations, flows))
        most = 0.5 * self.speed * self.radius
        if self.inflow == "uniform":
            w = brentq(lambda w: sums([w] * n)[0] - 2 * rho * area * (self.climb + w) * w, 0, most, xtol=1e-13, rtol=1e-14)
            return *sums([w] * n), w
        flows = []
        for station in stations:
            r = np.linalg.norm(station[2])
            missing = lambda w: self.blades * self.loads(station, w)[0] - 4 * math.pi * rho * r * (self.climb + w) * w
            flows.append(brentq(missing, 0, most, xtol=1e-13, rtol=1e-14) if missing(0) > 0 else math.nan)
        return *sums(flows), math.nan

    def complaints(self, program):
        run = Run(program, self.text())
        said = list(judges.outcome(run))
        if run.code != 0:
            return [run], said + [f"a rotor in hover ends with {run.code}: {run.output[-300:]}"]
        table = run.tables["static"]
        exact, here = self.of_elements(MANY), self.of_elements(self.stations)
        if not np.isfinite(exact[0]):
            return [run], said  # a part of the blade pushes down: that has no flow of hover
        tolerance = EXACT if self.inflow == "uniform" else 1e-4  # annuli keep a little away from still air
        for k, name in enumerate(("thrust", "torque", "mean")):
            if np.isfinite(exact[k]):
                said += compare("flow." + name, abs(table["flow." + name][-1]), exact[k], here[k], tolerance)
        said += compare("flow.power", table["flow.power"][-1], exact[1] * self.speed, here[1] * self.speed, tolerance)
        return [run], said


@dataclass
class Slight(Hover):
    """Small angles: C_T = σa/2 [θ(1 − x³)/3 − λ(1 − x²)/2] of blades without twist from x R to R, λ = √(C_T/2), and
    C_P = λ C_T + σ c_d (1 − x⁴)/8, as in every book on helicopters."""

    def __post_init__(self):
        super().__post_init__()
        pitch, blade = 1e-4, self.list[0]
        self.inflow, self.climb, self.foil.zero, self.foil.drag, self.foil.compressible = "uniform", 0.0, 0.0, (1e-9, 0, 0), False
        for one in self.list:
            one.chord, one.twist, one.quarter = (blade.chord[0],) * 2, (pitch,) * 2, 0.0
        self.x = np.linalg.norm(blade.start) / self.radius

    def complaints(self, program):
        run = Run(program, self.text())
        said = list(judges.outcome(run))
        if run.code != 0:
            return [run], said + [f"a rotor in hover ends with {run.code}: {run.output[-300:]}"]
        a, x, blade = self.foil.slope, self.x, self.list[0]
        sigma = self.blades * blade.chord[0] / (math.pi * self.radius)
        pull, through = sigma * a / 2 * blade.twist[0] * (1 - x**3) / 3, sigma * a / 2 * (1 - x**2) / 2
        flow = (-through + math.sqrt(through**2 + 8 * pull)) / 4  # 2 λ² + through λ = pull
        thrust = 2 * flow**2
        power = flow * thrust + sigma * self.foil.drag[0] * (1 - x**4) / 8
        tip, disk = self.speed * self.radius, self.air.density * math.pi * self.radius**2
        table = run.tables["static"]
        for name, value in ("thrust", thrust * disk * tip**2), ("power", power * disk * tip**3), ("mean", flow * tip):
            said += compare("flow." + name, table["flow." + name][-1], value, value, 1e-5)
        return [run], said


def closed_forms(seed):
    return {"wing": Wing(seed), "divergent": Divergent(seed), "hover": Hover(seed), "slight-hover": Slight(seed)}
