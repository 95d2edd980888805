"""Tables and picture of benchmarks/dynamics.md: error and work of each member of the integrator family. Parts: titles of tables.

About twenty minutes; every run is kept in benchmarks/dynamics.csv."""

import math
import signal

from figures_of import common
from figures_of.common import SMALL, few, into_page, measured as table_of, np, on_mesh, plt, printed, read, save, scheme, short


KEPT, CLASSICAL = "benchmarks/dynamics.csv", ", classical schemes"
COLUMNS = ["table", "s", "rho", "control", "step or tolerance", "mesh", "errors", "steps", "rejected", "unsolved",
           "iterations a step", "factorisations a step", "seconds", "budget closes to"]


class Run(common.Run):
    """The best of three: what it took, and until when it went if it failed. Steps of a run that will not end become so short that the
    time of the processor is limited to more than the longest takes."""

    def __init__(self, model, overrides):
        seconds = []
        while not seconds or (sum(seconds) < 0.1 and len(seconds) < 3):
            super().__init__(f"benchmarks/dynamics/{model}.prm", *overrides, limit=10, may_fail=True)
            self.failure = None
            if self.code == -signal.SIGXCPU:
                self.failure = "%.4g" % self.dynamic_steps["t"][-1]
                return
            if self.code:
                self.failure = "%g" % self.number(r"t = ([\d.e+-]+) s")
                return
            seconds.append(self.processor)
        self.seconds = min(seconds)
        count = lambda pattern: self.number(pattern, 0)
        self.steps, self.rejected = count(r"dynamic: (\d+) steps"), count(r"(\d+) rejected")
        self.unsolved = count(r"(\d+) without solution")
        self.iterations, self.factorizations = count(r"([\d.]+) Newton"), count(r"([\d.]+) factorizations")
        self.balance = count(r"closes to ([\d.e+-]+)")

    def value(self, when, probe):
        times = self.dynamic["t"]
        row = np.argmin(abs(times - when))
        assert abs(times[row] - when) < 1e-9 * max(1, when), "no row at %g s" % when
        return self.dynamic[probe][row]


class Values:
    """Largest difference to the values of some probes at some times."""

    def __init__(self, probes, rows):
        self.probes, self.rows = probes.split(", "), rows

    def error(self, run):
        return max(abs(run.value(row[0], p) - v) for row in self.rows for p, v in zip(self.probes, row[1:]))


class Exact:
    """Largest difference to an exact motion at the ends of all steps."""

    def __init__(self, probes, motion):
        self.probes, self.motion = probes.split(", "), motion

    def error(self, run):
        values = np.column_stack([run.dynamic[p] for p in self.probes])
        return max(max(abs(v - e) for v, e in zip(row, self.motion(t)[1:])) for t, row in zip(run.dynamic["t"], values))


class Andrews:
    """At t = 0.03 s, from an extrapolated midpoint rule in quadruple precision: angles since the start, velocities. With a
    stop: from tests/reference/multibody/andrews_squeezer_stop.csv."""

    beta, theta, gamma, phi = 15.810771195153707097, -15.75637105841183947, 0.040822240119645804858, -0.53473011634207959377
    delta, epsilon = 0.52440996587995406937, 1.0480807410419378731
    bars = {
        "OF": (beta + 0.0617138900142764496, 1139.9203022591060642),
        "EF": (beta + theta + 0.0617138900142764496, 1139.9203022591060642 - 1424.3792951775400732),
        "EBD": (gamma - 0.455279819163070380, 11.032911910618593745),
        "GE": (phi + delta - 0.222668390165885885 - 0.487364979543842550, 19.293374105032040832 + 0.57356991482950245382),
        "AG": (delta - 0.487364979543842550, 0.57356991482950245382),
        "HE": (epsilon - phi - 1.23054744454982119 + 0.222668390165885885, -19.293374105032040832 + 0.32317914924913087499),
        "AH": (epsilon - 1.23054744454982119, 0.32317914924913087499),
    }
    probes = "Output/Probes = " + ", ".join("%s.rotation z, %s.angular velocity z" % (bar, bar) for bar in bars)

    def __init__(self, table=None):
        if table:
            rows = [list(row.values()) for row in table_of("multibody/" + table)]
            self.bars = {bar: (float(angle), float(velocity)) for bar, angle, velocity in rows}

    def error(self, run):
        """Largest relative error of an angular velocity; angles are nearer."""
        return max(abs(run.value(0.03, bar + ".angular velocity z") / velocity - 1) for bar, (_, velocity) in self.bars.items())

    def error_of_angles(self, run):
        """Largest error of an angle [rad]."""
        errors = [math.radians(run.value(0.03, bar + ".rotation z")) - angle for bar, (angle, _) in self.bars.items()]
        return max(abs(math.remainder(e, 2 * math.pi)) for e in errors)


def pendulum(t):
    """x, y of A01: sin(theta/2) = k cd(omega t, k), k^2 = 1/2, by the arithmetic-geometric mean."""
    a, b, c = [1.0], math.sqrt(0.5), [math.sqrt(0.5)]
    while c[-1] > 1e-15:
        a_next, c_next, b = (a[-1] + b) / 2, (a[-1] - b) / 2, math.sqrt(a[-1] * b)
        a.append(a_next)
        c.append(c_next)
    phi = 2 ** (len(a) - 1) * a[-1] * math.sqrt(9.81) * t
    for i in range(len(a) - 1, 0, -1):
        phi = (phi + math.asin(c[i] / a[i] * math.sin(phi))) / 2
    half = math.sqrt(0.5) * math.cos(phi) / math.sqrt(1 - 0.5 * math.sin(phi) ** 2)  # sine of half the angle
    return t, -2 * half * math.sqrt(1 - half * half), -(1 - 2 * half * half)


IN_TABLES = [(1, 1), (2, 1), (2, 0), (3, 1), (3, 0.5), "generalised alpha", "BDF index 2"]  # the file has all


class Steps:
    """A table of error against step, one row for each member of the family."""

    schemes = [(s, rho) for s in (1, 2, 3) for rho in (1, 0.5, 0)]

    def __init__(self, title, model, errors, steps, *overrides, mesh=None, finer=(), floor=1e-12, schemes=None):
        self.title, self.model, self.errors, self.steps, self.overrides = title, model, errors, steps.split(), list(overrides)
        self.mesh, self.finer, self.schemes = mesh, finer, schemes or self.schemes
        self.floor = floor  # errors below are round-off, and show no order

    def compute(self):
        if callable(self.errors):
            self.errors = self.errors()
        for s, rho in few(self.schemes):
            for step in few(self.steps + list(self.finer if s == 1 else ())):
                overrides = scheme(s, rho, step) + self.overrides + beam(self.mesh)
                yield measured(self.model, self.errors, overrides, s, rho, "fixed", step, self.mesh)

    def shown(self):
        """Three steps of the table; the file has all."""
        return [self.steps[i] for i in sorted({round(k * (len(self.steps) - 1) / 2) for k in range(3)})]

    def head(self):
        heads = ["s, ρ∞, or scheme", *("h = " + h for h in self.shown()), "order", "seconds"]
        return "| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|"

    def print(self, rows):
        """Of the first error, for each member of IN_TABLES."""
        for who in [w for w in self.schemes if w in IN_TABLES]:
            mine = [r for r in rows if (r["s"], float(r["rho"])) == (str(who[0]), who[1])]
            done = {r["step or tolerance"]: r for r in mine if r["steps"]}
            orders = [order(a, b) for a, b in zip(mine, mine[1:])
                      if a["steps"] and b["steps"] and float(b["errors"].split()[0]) > self.floor]
            print("| %d, %g | " % who + " | ".join([error_of(done[h], 0) if h in done else "stuck" for h in self.shown()]
                                                 + ["%.1f" % orders[-1] if orders else "–", seconds_of(done, self.shown())]) + " |")


class Meshes:
    """A table of error against mesh, with one member of the family and one step."""

    def __init__(self, title, model, errors, headings, meshes, s, rho, step, *overrides, floor=0):
        self.floor = floor
        self.title, self.model, self.errors, self.headings = title, model, errors, headings
        self.meshes, self.scheme, self.step, self.overrides = meshes, (s, rho), step, list(overrides)

    def compute(self):
        if callable(self.errors):
            self.errors = self.errors()
        for p, n, *own in few(self.meshes):
            step = own[0] if own else self.step
            overrides = scheme(*self.scheme, step) + self.overrides + beam((p, n))
            yield measured(self.model, self.errors, overrides, *self.scheme, "fixed", step, (p, n))

    def print(self, rows):
        has_steps = len({r["step or tolerance"] for r in rows}) > 1
        head = ["p × elements"] + ["h"] * has_steps + self.headings + ["seconds" if has_steps else "order | seconds"]
        print("| " + " | ".join(head) + " |\n" + "|---" * (len(self.headings) + 3) + "|")
        last = None
        for r in rows:
            p, n = map(int, r["mesh"].split("x"))
            error = float(r["errors"].split()[0])
            order = "%.1f" % (math.log(last[2] / error) / math.log(n / last[1])) if last and last[0] == p and last[1] != n and error > self.floor else "–"
            last = p, n, error
            cells = ["%d × %d" % (p, n)] + [r["step or tolerance"]] * has_steps + [error_of(r, i) for i in range(len(self.headings))]
            print("| " + " | ".join(cells + [order] * (not has_steps) + ["%.2g" % float(r["seconds"])]) + " |")
        print()


class Classical(Steps):
    """The same for integrators by name. What a step is to the others, the tolerance is to BDF, which chooses its own."""

    schemes = [("generalised alpha", 0.5), ("trapezoidal", 1), ("energy decaying", 0), ("BDF index 2", 0)]

    def __init__(self, title, model, errors, steps, tolerances, *overrides, floor=1e-12, call=None):
        super().__init__(title, model, errors, steps, *overrides, floor=floor)
        self.tolerances, self.call = tolerances.split(), call  # call: where steps of BDF have to end at the latest

    def sizes(self, name):
        return self.tolerances if name.startswith("BDF") else self.steps

    def compute(self):
        if callable(self.errors):
            self.errors = self.errors()
        for name, rho in few(self.schemes):
            for size in few(self.sizes(name)):
                overrides = ["Dynamic/Integrator = " + name, "Dynamic/Spectral radius = %g" % rho]
                overrides += ["Dynamic/Tolerance = " + size, "Dynamic/Step = " + self.call] if name.startswith("BDF") else \
                             ["Dynamic/Step = " + size]
                yield measured(self.model, self.errors, overrides + self.overrides, name, rho, "fixed", size, None)

    def print(self, rows):
        for name, rho in [s for s in self.schemes if s[0] in IN_TABLES]:
            mine = [r for r in rows if r["s"] == name]
            done = {r["step or tolerance"]: r for r in mine if r["steps"]}
            is_bdf = name.startswith("BDF")
            sizes = self.sizes(name)[:3] if is_bdf else self.shown()
            cells = [(size + ": " if is_bdf else "") + (error_of(done[size], 0) if size in done else "stuck") for size in sizes]
            cells += ["–"] * (len(self.shown()) - len(sizes))
            pairs = [(a, b) for a, b in zip(mine, mine[1:]) if a["steps"] and b["steps"]]
            cells += ["%.1f" % order(*pairs[-1]) if pairs and not is_bdf else "–", seconds_of(done, sizes)]
            print("| " + " | ".join([name + (", ρ∞ = %g" % rho if name == "generalised alpha" else ""), *cells]) + " |")


def order(a, b):
    """Of the errors of two runs with the steps."""
    return (math.log(float(a["errors"].split()[0]) / float(b["errors"].split()[0]))
            / math.log(float(a["step or tolerance"]) / float(b["step or tolerance"])))


def seconds_of(done, sizes):
    """Of the shortest step that has an end."""
    return next(("%.2g" % float(done[size]["seconds"]) for size in reversed(sizes) if size in done), "–")


def beam(mesh):
    return on_mesh(["beam"], *mesh) if mesh else []


def error_of(row, i):
    return short(float(row["errors"].split()[i]))


def measured(model, errors, overrides, s, rho, control, size, mesh):
    """A row of what is kept."""
    run = Run(model, overrides)
    row = dict.fromkeys(COLUMNS, "")
    row.update({"s": s, "rho": "%g" % rho, "control": control, "step or tolerance": size, "mesh": "%dx%d" % mesh if mesh else ""})
    if run.failure:
        row["errors"] = "stuck at %s s" % run.failure
    else:
        row.update({"errors": " ".join("%.3e" % e(run) for e in errors), "steps": "%d" % run.steps, "rejected": "%d" % run.rejected,
                    "unsolved": "%d" % run.unsolved, "iterations a step": "%g" % run.iterations,
                    "factorisations a step": "%g" % run.factorizations, "seconds": "%.3g" % run.seconds,
                    "budget closes to": "%.1e" % run.balance})
    return row


TIGHT = "Dynamic/Newton tolerance = 1e-13"
SMOOTH = ["Loads/throw/Force = t < 2.5 ? 8*sin(pi*t/2.5)^4 : 0, 0, 0",
          "Loads/throw/Moment = 0, 0, t < 2.5 ? -80*sin(pi*t/2.5)^4 : 0", "Dynamic/End time = 5", "Dynamic/Newton tolerance = 1e-12"]
FLYING = "beam.start.position x, beam.start.position y, beam.middle.position x, beam.middle.position y, " \
         "beam.end.position x, beam.end.position y"
SPIN = "beam.middle.position x, beam.middle.position y, beam.end.position x, beam.end.position y"


def against(model, probes, times, overrides):
    """Errors against another run: a finer step or mesh."""
    run = Run(model, overrides)
    return [Values(probes, [(t, *(run.value(t, p) for p in probes.split(", "))) for t in times]).error]


PENDULUM = Exact("mass.position x, mass.position y", pendulum).error
TOP = Values("top.position x, top.position y, top.position z",
             [(0.5, -0.70246829705658559, -0.021165184701923327, -0.71140025765173441),
              (1, 0.17334396409838604, 0.64008859207056878, -0.74849079113358131),
              (1.5, -0.96816571563818065, 0.25030606213260173, -0.0014220838511312953),
              (2, -0.15041682274564176, -0.72416559163689565, -0.6730222695604441)])
TOP_END = Values("top.position x, top.position y, top.position z", TOP.rows[-1:])
CRANK = Values("slider.position x",
               [(1, 0.20789584070643892), (2, 0.28983549566041151), (3, 0.23497243363276988), (4, 0.19434867160181973),
                (5, 0.22025265458673386)])
CRANK_END = Values("slider.position x", CRANK.rows[-1:])
CRANK_AT_HINGE = Values("slider.position x",
                        [(1, 0.22902508953375239), (2, 0.26389761106448644), (3, 0.20334536546802819), (4, 0.22189464679024389),
                         (5, 0.2695615821733366)])
FOUR_BAR = Values("coupler 1.position x, coupler 1.position y",
                  [(4, 0.617616102376, 0.993059138451), (10, 0.828458111533, 0.944518538181)])
FOUR_BAR_END = Values("coupler 1.position x, coupler 1.position y", FOUR_BAR.rows[-1:])
BEAM = [Values(FLYING, [row]) for row in
        [(1, 4.32682484, 0.40782683, 3.61012171, 3.99055903, 0.370244412, 7.79600289),
         (2.5, 4.96308719, 4.4760045, 6.90152774, 3.22738377, 3.58317907, 6.11187724),
         (5, 9.783636, 8.20378262, 11.7275649, 3.64901562, 8.0744244, 1.75884102),
         (7.5, 16.268165, -0.283276715, 14.5204822, 4.05677328, 17.2390916, 8.25345445),
         (10, 22.9706437, 6.41191557, 19.1119839, 3.79944904, 21.3248104, 3.60973516)]]
FIRST_SECOND = Values(FLYING,
                      [(0.25, 5.85625588, -0.0721501756, 3.02324826, 3.99832065, 0.0144349825, 7.99196105),
                       (0.5, 5.44973586, -0.111935162, 3.11397284, 3.99472338, 0.0687583604, 7.96399555),
                       (0.75, 4.89552849, 0.0364105286, 3.29999083, 3.99110462, 0.183538977, 7.90119163),
                       (1, 4.32682484, 0.40782683, 3.61012171, 3.99055903, 0.370244412, 7.79600289)])
SPUN = Values(SPIN, [(5, 0.113782175, 4.99809348, 0.372440492, 9.99138757), (10, -3.31568474, -3.74232371, -6.70287878, -7.42035403),
                     (15, 2.62638095, 4.25507433, 5.25238105, 8.51015717)])
STOPPED = Andrews("andrews_squeezer_stop.csv")
BUCKLED = "beam.middle.displacement y, beam.middle.displacement z"


def buckled():
    """Against another step on the same mesh."""
    fine = scheme(3, 1) + ["Dynamic/Step = 6.25e-5", "Dynamic/Newton tolerance = 1e-12"] + beam((3, 4))
    return against("lateral_buckling", BUCKLED, (0.2, 0.3, 0.4, 0.5), fine)


BRICARD = "../peers/bricard"


def bricard():
    """Against another step."""
    fine = scheme(3, 1) + ["Dynamic/Step = 0.002", "Dynamic/Newton tolerance = 1e-13"]
    return against(BRICARD, "bar 3.end.displacement x, bar 3.end.displacement y, bar 3.end.displacement z", (2, 4, 6, 8, 10), fine)


def flexible_four_bar():
    """Against another step on the same mesh, at times between those when it snaps through."""
    fine = scheme(3, 0) + ["Dynamic/Step = 0.0025", "Dynamic/Newton tolerance = 1e-12"]
    return against("../peers/four_bar", "CD.start.displacement z", (1, 2, 5, 7, 9.5, 12), fine)


def flexible_shaft():
    """Against another step on the same mesh."""
    fine = scheme(3, 1) + ["Dynamic/Step = 3.125e-4", "Dynamic/Newton tolerance = 1e-12"]
    return against("../peers/shaft", "left.end.displacement y, left.end.displacement z", (0.5, 1, 1.5, 2, 2.5), fine)


def governor():
    """Height of the slider, from tests/reference/multibody/flyball_governor.csv."""
    rows = [list(row.values()) for row in table_of("multibody/flyball_governor.csv")]
    return Values("slider.position z", [(float(t), float(z)) for t, z, *_ in rows])


GOVERNOR = governor()
SPUN_END = Values(SPIN, [(20, 4.60918837, -1.9387935, 9.21826992, -3.87734331)])

TABLES = [
    Steps("Simple pendulum", "simple_pendulum", [PENDULUM], "0.1 0.05 0.025 0.0125 0.00625 0.003125", TIGHT,
          finer=("7.8125e-4",), floor=2e-11),
    Classical("Simple pendulum" + CLASSICAL, "simple_pendulum", [PENDULUM], "0.1 0.05 0.025 0.0125 0.00625 0.003125",
              "1e-4 1e-5 1e-6 1e-7 1e-8", call="0.1"),
    Steps("Heavy top", "heavy_top", [TOP.error], "1e-2 5e-3 2.5e-3 1.25e-3 6.25e-4 3.125e-4", TIGHT, finer=("7.8125e-5",), floor=2e-11),
    Steps("Slider-crank", "slider_crank", [CRANK.error], "2e-2 1e-2 5e-3 2.5e-3 1.25e-3 6.25e-4", TIGHT, finer=("1.5625e-4",),
          floor=1e-10),
    Steps("Slider-crank, centre of mass of the crank at its hinge", "slider_crank", [CRANK_AT_HINGE.error],
          "1e-2 5e-3 2.5e-3 1.25e-3", TIGHT, "Constants/arm = 0", floor=1e-10, schemes=[(1, 1), (2, 1), (2, 0), (3, 1), (3, 0.5)]),
    Steps("Andrews' squeezer", "andrews_squeezer", [Andrews().error, Andrews().error_of_angles],
          "4e-4 2e-4 1e-4 5e-5 2.5e-5 1.25e-5", TIGHT, Andrews.probes, finer=("3.125e-6",), floor=5e-9),
    Classical("Andrews' squeezer" + CLASSICAL, "andrews_squeezer", [Andrews().error, Andrews().error_of_angles],
              "4e-4 2e-4 1e-4 5e-5 2.5e-5 1.25e-5", "1e-4 1e-5 1e-6 1e-7 1e-8", Andrews.probes, call="1e-3"),
    Steps("Andrews' squeezer with a stop", "andrews_squeezer_stop", [STOPPED.error_of_angles], "2e-4 1e-4 5e-5 2.5e-5 1.25e-5 6.25e-6",
          TIGHT, Andrews.probes, floor=1e-9),
    Classical("Andrews' squeezer with a stop" + CLASSICAL, "andrews_squeezer_stop", [STOPPED.error_of_angles],
              "2e-4 1e-4 5e-5 2.5e-5 1.25e-5 6.25e-6", "1e-4 1e-5 1e-6 1e-7 1e-8", Andrews.probes, call="1e-3"),
    Steps("Lateral buckling", "lateral_buckling", buckled, "4e-3 2e-3 1e-3 5e-4 2.5e-4", "Dynamic/Newton tolerance = 1e-11",
          mesh=(3, 4), floor=1e-9),
    Classical("Lateral buckling" + CLASSICAL, "lateral_buckling", buckled, "4e-3 2e-3 1e-3 5e-4 2.5e-4",
              "1e-4 1e-5 1e-6", call="0.02"),
    Meshes("Lateral buckling, mesh", "lateral_buckling",
           lambda: against("lateral_buckling", BUCKLED, (0.1, 0.2, 0.3, 0.4, 0.5), scheme(3, 1) + ["Dynamic/Step = 5e-4"] + beam((5, 8))),
           ["0.1 to 0.5 s"], [(1, 8), (1, 16), (1, 32), (2, 4), (2, 8), (2, 16), (3, 4), (3, 8), (4, 2), (4, 4), (5, 2)], 3, 1, "1e-3"),
    Steps("Four-bar", "four_bar", [FOUR_BAR.error], "0.02 0.01 0.005 0.0025", floor=1e-7),
    Classical("Four-bar" + CLASSICAL, "four_bar", [FOUR_BAR.error], "0.02 0.01 0.005 0.0025", "1e-4 1e-5 1e-6", call="0.1"),
    Steps("Bricard's mechanism", BRICARD, bricard, "0.1 0.05 0.025 0.0125 0.00625", TIGHT, floor=1e-9),
    Classical("Bricard's mechanism" + CLASSICAL, BRICARD, bricard, "0.1 0.05 0.025 0.0125 0.00625", "1e-4 1e-5 1e-6 1e-7 1e-8",
              call="0.1"),
    Steps("Stiff flyball governor", "flyball_governor", [GOVERNOR.error], "0.02 0.01 0.005 0.0025", floor=1e-10),
    Classical("Stiff flyball governor" + CLASSICAL, "flyball_governor", [GOVERNOR.error], "0.02 0.01 0.005 0.0025",
              "1e-4 1e-5 1e-6 1e-7", call="0.1"),
    Steps("Flexible four-bar", "../peers/four_bar", flexible_four_bar, "0.1 0.05 0.025 0.0125", "Dynamic/Newton tolerance = 1e-11",
          floor=1e-9),
    Classical("Flexible four-bar" + CLASSICAL, "../peers/four_bar", flexible_four_bar, "0.1 0.05 0.025 0.0125", "1e-4 1e-5",
              call="0.1"),
    Steps("Flexible shaft", "../peers/shaft", flexible_shaft, "0.02 0.01 0.005 0.0025 0.00125", "Dynamic/Newton tolerance = 1e-11",
          floor=1e-8),
    Classical("Flexible shaft" + CLASSICAL, "../peers/shaft", flexible_shaft, "0.02 0.01 0.005 0.0025 0.00125", "1e-4 1e-5",
              call="0.02"),
    Steps("Spin-up", "spin_up",
          lambda: against("spin_up", SPIN, (5, 10, 15, 20), scheme(3, 1) + ["Dynamic/Step = 0.0125", TIGHT] + beam((3, 4)))
          + [SPUN.error, SPUN_END.error], "0.5 0.25 0.1 0.05 0.025", TIGHT, mesh=(3, 4), finer=("0.00625",), floor=2e-9),
    Meshes("Spin-up, mesh", "spin_up", [SPUN.error, SPUN_END.error], ["5, 10, 15 s", "20 s"],
           [(1, 12), (1, 24), (2, 6), (2, 12), (3, 1), (3, 2), (3, 4), (3, 8), (4, 3)], 3, 1, "0.05", TIGHT, floor=1e-6),
    Steps("Flying beam, thrown smoothly", "flying_beam",
          lambda: against("flying_beam", FLYING, (5,), scheme(3, 1) + ["Dynamic/Step = 0.003125"] + SMOOTH + beam((3, 8))),
          "0.2 0.1 0.05 0.025 0.0125", *SMOOTH, mesh=(3, 8), finer=("0.003125",), floor=1e-8),
    Meshes("Flying beam, thrown smoothly, mesh", "flying_beam",
           lambda: against("flying_beam", FLYING, (5,), scheme(3, 1) + ["Dynamic/Step = 0.025"] + SMOOTH + beam((4, 24))),
           ["5 s"], [(1, 20), (1, 40), (1, 80), (2, 10), (2, 20), (2, 40), (3, 8), (3, 16), (3, 32), (4, 6), (4, 12)], 3, 1,
           "0.025", *SMOOTH),
    Steps("Flying beam", "flying_beam", [e.error for e in (BEAM[1], BEAM[4])], "0.1 0.05 0.025 0.0125", mesh=(3, 40),
          floor=1.4e-4),
    Meshes("Flying beam, mesh", "flying_beam", [e.error for e in BEAM], ["%g s" % e.rows[0][0] for e in BEAM],
           [(1, 120), (2, 60), (3, 5), (3, 10), (3, 20), (3, 40), (3, 64), (3, 128), (4, 30)], 3, 1, "0.025", floor=3e-4),
    Meshes("Flying beam, first second", "flying_beam", [FIRST_SECOND.error], ["0.25, 0.5, 0.75, 1 s"],
           [(3, 64, "0.025"), (3, 64, "0.0125"), (3, 64, "0.00625"), (3, 64, "0.003125"), (3, 128, "0.0015625")], 3, 1, "0.025",
           "Dynamic/End time = 1"),
]


def draw(kept):
    """Error against seconds: a panel for each problem, colour the stages, line the spectral radius."""
    panels = [("Simple pendulum", "error [m]"), ("Heavy top", "error [m]"), ("Slider-crank", "error [m]"),
              ("Andrews' squeezer", "error of velocities"), ("Four-bar", "error [m]"), ("Spin-up", "error [m]"),
              ("Flying beam, thrown smoothly", "error"), ("Flying beam", "error at t = 2.5"),
              ("Andrews' squeezer with a stop", "error [rad]"), ("Lateral buckling", "error [m]"),
              ("Bricard's mechanism", "error [m]"), ("Stiff flyball governor", "error [m]"),
              ("Flexible four-bar", "error across the plane [m]"), ("Flexible shaft", "error [m]")]
    colours, lines = {1: "#0072b2", 2: "#d55e00", 3: "#009e73"}, {1: "-", 0.5: "--", 0: ":"}
    marks = {"generalised alpha": "s", "trapezoidal": "^", "energy decaying": "v", "BDF index 2": "D"}
    plt.rcParams.update({"svg.fonttype": "none", "font.size": 9})
    figure, axes = plt.subplots(5, 3, figsize=(10, 15), layout="constrained")
    for axis, (title, label) in zip(axes.flat, panels):
        for s in colours:
            for rho in lines:
                rows = [r for r in kept if r["table"] == title and r["steps"] and (r["s"], float(r["rho"])) == (str(s), rho)]
                rows.sort(key=lambda r: -float(r["step or tolerance"]))
                axis.loglog([float(r["seconds"]) for r in rows], [float(r["errors"].split()[0]) for r in rows], lines[rho],
                            color=colours[s], marker=".", markersize=4, linewidth=1.2)
        for name, mark in marks.items():
            rows = [r for r in kept if r["table"] == title + "" + CLASSICAL and r["steps"] and r["s"] == name]
            axis.loglog([float(r["seconds"]) for r in rows], [float(r["errors"].split()[0]) for r in rows], "-", color="#777777",
                        marker=mark, markersize=4, linewidth=0.8)
        axis.set(title=title, xlabel="time of computing [s]", ylabel=label)
        axis.title.set_fontsize(10)
    key = axes.flat[14]
    key.axis("off")
    handles = [plt.Line2D([], [], color=colours[s], linestyle=lines[r], label="s = %d, ρ∞ = %g" % (s, r)) for s in colours for r in lines]
    handles += [plt.Line2D([], [], color="#777777", marker=mark, markersize=4, linewidth=0.8, label=name) for name, mark in marks.items()]
    key.legend(handles=handles, loc="center", frameon=False)
    save(figure, "dynamics_work_precision.svg")


def make(parts, drawn):
    unknown = set(parts) - {t.title for t in TABLES}
    if unknown:
        raise SystemExit("no table %s; there are:\n  %s" % (", ".join(sorted(unknown)), "\n  ".join(t.title for t in TABLES)))
    for table in few([t for t in TABLES if not parts or t.title in parts]):
        kept = read(KEPT)
        if not drawn:
            rows = [{**row, "table": table.title} for row in table.compute()]
            key = lambda r: [str(r[c]) for c in COLUMNS[:6]]
            others = [r for r in kept if r["table"] != table.title or SMALL and key(r) not in map(key, rows)]
            kept = [{c: str(r[c]) for c in COLUMNS} for r in sorted(rows + others, key=lambda r: [t.title for t in TABLES].index(r["table"]))]
            common.write(KEPT, kept, COLUMNS)
    kept = read(KEPT)
    of = lambda title: [r for r in kept if r["table"] == title]
    for table in TABLES:
        if isinstance(table, Classical) or not of(table.title):
            continue
        text = printed(table.print, of(table.title))
        classical = [c for c in TABLES if c.title == table.title + CLASSICAL]
        if isinstance(table, Steps):
            text = table.head() + "\n" + text + "".join(printed(c.print, of(c.title)) for c in classical)
        into_page("benchmarks/dynamics.md", table.title, text)
    draw(kept)
