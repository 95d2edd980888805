"""Work and precision beside other programs, benchmarks/peers.md. Parts: names of problems.

Runs the problems with several members of the integrator family, steps, tolerances and meshes, and draws error against time, the figures
of the peer beside ours. About ten minutes. Every run is kept in benchmarks/peers.csv and its reference in results/peers.

`seconds` are those of the processor that the lines `dynamic: ...` and `static: ...` tell: an analysis with its tables of results,
without start-up and input. `whole` is all that the process took, libraries, input and files with it. Each is the least of
several runs: three, of short ones nine. One thread, no pictures."""

import math

import matplotlib.ticker

from figures_of import common
from figures_of.common import SMALL, TOP, few, into_page, interpolated, np, on_mesh as mesh, plt, read, results, runge_kutta, save, scheme


KEPT, PAGE = "benchmarks/peers.csv", "benchmarks/peers.md"
COLUMNS = ["problem", "series", "value", "error", "seconds", "whole", "unknowns", "steps", "rejected", "iterations a step",
           "factorisations a step", "rows", "fails"]
WRONG = 0.1  # error of a run that took another branch; it is not drawn
LIMIT = 20  # seconds, after which a run is given up


class Run(common.Run):
    """The least of several runs of a model with overrides: its table of probes, and what it took."""

    def __init__(self, model, overrides, repeat=True):
        self.failure, times, wholes = "", [], []
        while not times or (repeat and not SMALL and len(times) < (9 if min(times) < 0.05 else 3)
                            and sum(wholes) < (6 if min(times) < 0.05 else 1.5)):
            super().__init__(model, "Threads = 1", *overrides, limit=LIMIT, may_fail=True)
            if self.code:
                at = self.number(r"t = ([\d.e+-]+) s")
                self.failure = "no end in %d s" % LIMIT if math.isnan(at) else "stuck at t = %.4g s" % at
                return
            times.append(self.processor)
            wholes.append(self.whole)
        self.seconds, self.whole = min(times), min(wholes)
        self.probes = self.dynamic or self.static
        count = lambda pattern: self.number(pattern, 0)
        self.unknowns, self.steps = int(count(r"(\d+) unknowns")), int(count(r"(\d+) steps")) or 1
        self.rejected = int(count(r"(\d+) rejected") + count(r"(\d+) without solution"))
        self.iterations = count(r"([\d.]+) Newton") or count(r"(\d+) iterations")
        self.factorizations = count(r"([\d.]+) factorizations")

    def vectors(self, points, axes):
        """Times, and the vectors (time, point, component) of the probes <point> x, y, z; components without a probe are left out."""
        columns = [[self.probes[p + " " + c] for c in axes if p + " " + c in self.probes] for p in points]
        return next(iter(self.probes.values())), np.array(columns).transpose(2, 0, 1)


def at_times(times, values, at):
    """Values at other times; those of the rows where these are the times."""
    return values if len(times) == len(at) and np.allclose(times, at, atol=1e-9, rtol=0) else interpolated(times, values, at)


class Series:
    """Runs that differ in one entry (or several, with ; between them)."""

    def __init__(self, name, vary, values, *overrides):
        self.name, self.vary, self.values, self.overrides = name, vary.split("; "), values, list(overrides)

    def members(self, duration, rows):
        """Value and overrides of each; of fixed steps about so many rows are written, of others every second step."""
        for value in few(self.values, 1):
            overrides = self.overrides + ["%s = %s" % (entry, value) for entry in self.vary]
            if duration:
                overrides.append("Dynamic/Output every = %d" % (max(1, round(duration / value / rows)) if self.vary == [STEP] else 2))
            yield str(value), overrides


def adaptive(s, rho, *more):
    return scheme(s, rho, "Dynamic/Step control = adaptive", *more)


NEWTON = "Dynamic/Newton tolerance = 1e-6"
STEP, TOLERANCE = "Dynamic/Step", "Dynamic/Tolerance"


class Figure:
    """A figure of another program: its error, its seconds without and with the start of the process (None: not known)."""

    def __init__(self, program, error, analysis=None, whole=None):
        self.program, self.error, self.analysis, self.whole = program, error, analysis, whole


OLDER = 0.006  # seconds that MBDyn took to start where the older figures were measured


def mbdyn(error, whole, start=0.0115):
    """MBDyn needs some milliseconds to start and to read its input."""
    return Figure("MBDyn", error, whole - start, whole)


def kynema(*figures):
    """Errors, seconds of the loop and of the whole process."""
    return [Figure("Kynema", *figure) for figure in figures]


def without_start(program, *figures):
    return [Figure(program, error, seconds) for seconds, error in figures]


class Problem:
    """What is run, what is measured, and what the peer needs.

    points: whose errors count; reference: overrides of the run that members are compared with; exact: in its place a
    function of time; norm: `largest` or `rms` over time; windows: times that count; scale: of the error, default: the largest
    displacement of a point in the reference; axes: the components that count.

    peers: figures of other programs, a Figure each; goals: seconds of the analysis to be reached at each of them, a fifth of
    the peer's where none are given."""

    def __init__(self, name, title, model, points, base, reference, series, peers, **more):
        self.name, self.title, self.model, self.points, self.base = name, title, model, points, base
        self.reference, self.series, self.peers = reference, series, peers
        self.goals = more.get("goals") or [f.analysis / 5 for f in peers]
        self.axes = more.get("axes", "xyz")
        self.exact, self.norm = more.get("exact"), more.get("norm", "largest")
        self.windows, self.scale = more.get("windows"), more.get("scale")
        self.label = more.get("label", "largest error / largest displacement")
        self.static, self.duration, self.rows = more.get("static", False), more.get("duration", 0), more.get("rows", 100)

    def reference_run(self):
        """Times and vectors; kept in a file from one call of this script to the next."""
        file = results("peers") / (self.name + ".npz")
        recipe = "\n".join([(TOP / "prm" / self.model).read_text(), *self.base, *self.reference, self.axes])
        if file.exists():
            kept = np.load(file)
            if str(kept["recipe"]) == recipe:
                return kept["times"], kept["values"]
        run = Run(self.model, self.base + self.reference, repeat=False)
        if run.failure:
            raise SystemExit("reference of %s: %s" % (self.name, run.failure))
        times, values = run.vectors(self.points, self.axes)
        np.savez(file, recipe=recipe, times=times, values=values)
        print("%s: reference with %d unknowns, %d steps, %.3g s" % (self.name, run.unknowns, run.steps, run.seconds), flush=True)
        return times, values

    def error(self, run, reference):
        times, values = run.vectors(self.points, self.axes)
        if self.static:
            return np.abs(np.linalg.norm(values - reference[1], axis=2)).max() / np.linalg.norm(reference[1], axis=2).max()
        true = self.exact(times) if self.exact else at_times(*reference, times)
        if self.scale:
            scale = self.scale(*reference) if callable(self.scale) else self.scale
        else:
            known = true if self.exact else reference[1]
            scale = np.linalg.norm(known - known[0], axis=2).max()
        distance = np.linalg.norm(values - true, axis=2).max(axis=1)
        if self.windows:
            distance = distance[np.any([(a <= times) & (times <= b) for a, b in self.windows], axis=0)]
        if self.norm == "rms":
            return math.sqrt(np.mean(distance**2)) / scale
        return distance.max() / scale

    def compute(self, kept):
        reference = None if self.exact else self.reference_run()
        rows = [r for r in kept if r["problem"] != self.name or SMALL]
        for series in few(self.series):
            for value, overrides in series.members(self.duration, self.rows):
                run = Run(self.model, self.base + overrides)
                row = {"problem": self.name, "series": series.name, "value": value, "fails": run.failure}
                if not run.failure:
                    row.update({"error": "%.3e" % self.error(run, reference), "seconds": "%.4g" % run.seconds,
                                "whole": "%.3g" % run.whole, "unknowns": run.unknowns, "steps": run.steps,
                                "rejected": run.rejected, "iterations a step": "%g" % run.iterations,
                                "factorisations a step": "%g" % run.factorizations, "rows": len(next(iter(run.probes.values())))})
                print("  %-34s %-10s" % (series.name, value),
                      run.failure or "%s  %s s  (%d unknowns, %d + %d steps, %g iterations, %g factorisations, %d rows)"
                      % (row["error"], row["seconds"], run.unknowns, run.steps, run.rejected, run.iterations,
                         run.factorizations, len(next(iter(run.probes.values())))), flush=True)
                rows.append(row)
        return rows

    def draw(self, kept):
        plt.rcParams.update({"font.size": 10})
        figure, axes = plt.subplots(1, 2, figsize=(11, 5.2), layout="constrained", sharey=True)
        colours = ["#1f5fa8", "#d1495b", "#2a9d5c", "#e08e1b", "#7b4fa3", "#3aa6b9", "#8c6d46", "#c65db7"]
        clocks = (("seconds", lambda f: f.analysis, "analysis"), ("whole", lambda f: f.whole, "whole process"))
        for axis, (column, clock, words) in zip(axes, clocks):
            for number, (series, colour) in enumerate(zip(self.series, colours * 2)):
                rows = [r for r in kept if r["problem"] == self.name and r["series"] == series.name and r["error"]
                        and float(r["error"]) < WRONG]
                if rows:
                    axis.loglog([float(r[column]) for r in rows], [float(r["error"]) for r in rows], color=colour, lw=1.4,
                                marker="o^"[number // len(colours)], ms=4, ls="--" if "adaptive" in series.name else "-", label=series.name)
            for program, marker in zip(dict.fromkeys(f.program for f in self.peers), "sD"):
                known = [f for f in self.peers if f.program == program and clock(f)]
                if known:
                    axis.loglog([clock(f) for f in known], [f.error for f in known], color="k", ls=":", marker=marker, ms=7, lw=1.2,
                                label=program)
            if column == "seconds":
                axis.loglog(self.goals, [f.error for f in self.peers], color="k", ls="", marker="s", ms=7, mfc="none", label="the goal")
                axis.set_ylabel(self.label)
            axis.set_xlabel("seconds of the processor, " + words)
            axis.xaxis.set_minor_locator(matplotlib.ticker.LogLocator(subs=[2, 5]))
            for formatter in (axis.xaxis.set_major_formatter, axis.xaxis.set_minor_formatter):
                formatter(matplotlib.ticker.FormatStrFormatter("%g"))
        figure.legend(*axes[0].get_legend_handles_labels(), fontsize=8, loc="lower center", ncols=3)
        lines = -(-len(axes[0].get_legend_handles_labels()[0]) // 3)
        figure.get_layout_engine().set(rect=(0, 0.02 + 0.036 * lines, 1, 0.98 - 0.036 * lines))
        axes[0].set_title(self.title, loc="left", fontsize=11)
        save(figure, f"peers_{self.name}.png", 100, 64)

    def table(self, kept):
        """Rows of Markdown: for each point of the peer the fastest member that is as exact, and whose finer ones are, too, with
        the largest of their errors, so that none counts that is small by chance; and the most exact one."""
        rows = [r for r in kept if r["problem"] == self.name and r["error"]]
        if not rows:
            return []
        later = lambda r: [o for o in rows[rows.index(r):] if o["series"] == r["series"]]
        error_of = lambda r: max(float(o["error"]) for o in later(r))
        power = lambda x: ("%.1e" % x).replace("e-0", "e-")
        seconds = lambda x: "–" if not x or not math.isfinite(float(x)) else "%.2g" % float(x)
        member = lambda r: "%s, %s" % (r["series"], ("step " if STEP in self.of(r).vary else "") + r["value"])
        ratio = lambda mine, peer: "–" if not peer else "%.1f" % (peer / float(mine))
        lines = []
        for figure, goal in zip(self.peers, self.goals):
            enough = [r for r in rows if error_of(r) <= figure.error]
            start = "| %s | %s: %s | %s, %s | " % (self.title if not lines else "", figure.program, power(figure.error),
                                                   seconds(figure.analysis), seconds(figure.whole))
            if not enough:
                lines.append(start + "– | – | – | no |")
                continue
            best = min(enough, key=lambda r: float(r["seconds"]))
            lines.append(start + "%s: %s | %s, %s | %s, %s | %s |" % (
                power(error_of(best)), member(best), seconds(best["seconds"]), seconds(best["whole"]),
                ratio(best["seconds"], figure.analysis), ratio(best["whole"], figure.whole),
                "yes" if float(best["seconds"]) <= goal else "no: %s" % seconds(goal)))
        best = min(rows, key=error_of)
        lines.append("| | the most exact | | %s: %s | %s, %s | | |" % (power(error_of(best)), member(best), seconds(best["seconds"]),
                                                                     seconds(best["whole"])))
        return lines

    def of(self, row):
        return next(s for s in self.series if s.name == row["series"])


PEERS = "benchmarks/peers/"
QUIET = ["Dynamic/Pictures = 0", "Output/Pictures = false"]


def swept_tip_scale(times, values):
    """Largest elastic displacement of the tip: from where it would be on a rigid blade."""
    x, y = 2.5 + 31.5 + 6 * math.cos(math.pi / 4), -6 * math.sin(math.pi / 4)
    angle = 78.5398163397448 * times
    rigid = np.stack([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle), 0 * times], axis=1)
    return np.linalg.norm(values[:, 0] - rigid, axis=1).max()


def spin_up_scale(times, values):
    """Largest elastic displacement of the end, 0.574 m: from where it would be on a rigid beam."""
    angle = np.where(times < 15, 0.4 * (times**2 / 2 + (7.5 / math.pi)**2 * (np.cos(2 * math.pi * times / 15) - 1)), 6 * times - 45)
    rigid = 10 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return np.linalg.norm(values[:, 0, :2] - rigid, axis=1).max()


def corner_of_forty(times):
    """Corner of the N-four-bar, N = 40, from its equation of motion: ((N+1)/3 + N) theta'' = -((N+1)/2 + N) g cos theta."""
    factor = -(41 / 2 + 40) * 9.81 / (41 / 3 + 40)
    state, where, result = np.array([math.pi / 2, -1.0]), 0.0, []
    rate = lambda _, y: np.array([y[1], factor * math.cos(y[0])])
    for time in times:
        state = runge_kutta(rate, state, where, time, math.ceil((time - where) / 5e-4))
        where = time
        result.append([[math.cos(state[0]), math.sin(state[0])]])
    return np.array(result)


def princeton_points():
    return ["P%d at %d.end.displacement" % (k, a) for k in (1, 2, 3) for a in range(0, 91, 15)]


BARS = ["OF", "EF", "EBD", "GE", "AG", "HE", "AH"]

PROBLEMS = [
    Problem("princeton", "Princeton beam, 21 loads together", PEERS + "princeton.prm", princeton_points(), [],
            mesh(["P1 at 0"], 4, 8) + ["Static/Tolerance = 1e-12"],
            [Series("1 element, p = 3, 4", "Bodies/P1 at 0/Degree", [3, 4]),
             Series("2 elements, p = 2, 3", "Bodies/P1 at 0/Degree", [2, 3], "Bodies/P1 at 0/Elements = 2"),
             Series("p = 4, 2 to 4 elements", "Bodies/P1 at 0/Elements", [2, 3, 4], "Bodies/P1 at 0/Degree = 4"),
             Series("1 element, p = 4, 5, 6, Newton 1e-3", "Bodies/P1 at 0/Degree", [4, 5, 6], "Static/Tolerance = 1e-3"),
             Series("p = 4, 2 elements, Newton 1e-3", "Bodies/P1 at 0/Elements", [2], "Bodies/P1 at 0/Degree = 4",
                    "Static/Tolerance = 1e-3")],
            kynema((2.5e-4, 8.6e-3, 0.016), (8.9e-6, 0.0111, 0.018), (1.8e-7, 0.0145, 0.022)), static=True,
            label="largest error of an end / largest displacement"),
    Problem("spin_up", "Spin-up of a beam", "benchmarks/dynamics/spin_up.prm", ["beam.end.position"], QUIET,
            scheme(3, 1) + mesh(["beam"], 4, 6) + ["Dynamic/Step = 0.0125", "Dynamic/Newton tolerance = 1e-13"],
            [Series("p = 4 × 1, s = 3, ρ∞ = 1", STEP, [0.2, 0.1, 0.05], *scheme(3, 1), *mesh(["beam"], 4, 1)),
             Series("p = 4 × 2, s = 3, ρ∞ = 1", STEP, [0.2, 0.15, 0.1, 0.05], *scheme(3, 1), *mesh(["beam"], 4, 2)),
             Series("p = 3 × 4, s = 3, ρ∞ = 1", STEP, [0.2, 0.1, 0.05], *scheme(3, 1), *mesh(["beam"], 3, 4)),
             Series("p = 4 × 2, s = 3, ρ∞ = 0.5", STEP, [0.2, 0.1, 0.05], *scheme(3, 0.5), *mesh(["beam"], 4, 2)),
             Series("p = 4 × 2, s = 2, ρ∞ = 1", STEP, [0.2, 0.1, 0.05, 0.025], *scheme(2, 1), *mesh(["beam"], 4, 2)),
             Series("p = 4 × 2, s = 2, ρ∞ = 0", STEP, [0.2, 0.1, 0.05, 0.025], *scheme(2, 0), *mesh(["beam"], 4, 2))],
            kynema((2.4e-3, 0.1125, 0.118), (5.4e-4, 0.214, 0.219), (9.8e-5, 0.737, 0.744), (2.2e-5, 1.484, 1.489))
            # measured with the norm of 20 m
            + [mbdyn(5.4e-5 * 20 / 0.574, 0.352), mbdyn(1.4e-5 * 20 / 0.574, 1.230)], duration=20, rows=200,
            scale=spin_up_scale, label="largest error of the end / largest elastic displacement"),
    Problem("four_bar", "Four-bar with a joint axis off", PEERS + "four_bar.prm", ["CD.start.displacement"],
            QUIET, scheme(3, 0) + mesh(["AB"], 4, 2) + ["Dynamic/Step = 0.0025", "Dynamic/Newton tolerance = 1e-12"],
            [Series("p = 2, s = 2, ρ∞ = 0, Newton 1e-6", STEP, [0.4, 0.2, 0.1], *scheme(2, 0), *mesh(["AB"], 2), NEWTON),
             Series("p = 4, s = 2, ρ∞ = 0", STEP, [0.1, 0.05, 0.02, 0.01], *scheme(2, 0), *mesh(["AB"], 4)),
             Series("p = 4, s = 3, ρ∞ = 0", STEP, [0.1, 0.05, 0.02], *scheme(3, 0), *mesh(["AB"], 4)),
             Series("p = 4 (CD) and 3, s = 3, Newton 1e-7", STEP, [0.1, 0.05, 0.025, 0.0125], *scheme(3, 0), *mesh(["AB", "BC"], 3),
                    *mesh(["CD"], 4), "Dynamic/Newton tolerance = 1e-7"),
             Series("p = 3 (CD) and 2, s = 2, Newton 1e-4", STEP, [0.2, 0.15, 0.1], *scheme(2, 0), *mesh(["AB", "BC"], 2),
                    *mesh(["CD"], 3), "Dynamic/Newton tolerance = 1e-4"),
             Series("p = 3, s = 2, ρ∞ = 0, Newton 1e-4", STEP, [0.2, 0.1, 0.05], *scheme(2, 0), *mesh(["AB"], 3),
                    "Dynamic/Newton tolerance = 1e-4"),
             Series("p = 4 (CD) and 3, s = 3, Newton 1e-5", STEP, [0.05, 0.04, 0.035, 0.025], *scheme(3, 0), *mesh(["AB", "BC"], 3),
                    *mesh(["CD"], 4), "Dynamic/Newton tolerance = 1e-5")]
            + [Series("p = 3 (CD) and 2, s = 2, ρ∞ = 0.6, Newton %s" % n, STEP, [0.05, 0.045, 0.035], *scheme(2, 0.6),
                      *mesh(["AB", "BC"], 2), *mesh(["CD"], 3), "Dynamic/Newton tolerance = " + n) for n in ("1e-3", "1e-4")]
            + [Series("p = 2, 3, 4, s = %d, ρ∞ = 0.5, Newton %s" % (s, n), STEP, steps, *scheme(s, 0.5), *mesh(["AB"], 2),
                      *mesh(["BC"], 3), *mesh(["CD"], 4), "Dynamic/Newton tolerance = " + n)
               for s, n, steps in ((2, "1e-4", [0.025, 0.02, 0.015]), (3, "1e-5", [0.1, 0.065, 0.06, 0.055, 0.05, 0.04]))]
            + [Series("p = 4, s = 3, ρ∞ = 0.5, Newton 1e-7", STEP, [0.025, 0.015, 0.01], *scheme(3, 0.5), *mesh(["AB"], 4),
                      "Dynamic/Newton tolerance = 1e-7"),
               Series("p = 3, 3, 4, s = 3, ρ∞ = 0.7, Newton 1e-6", STEP, [0.025, 0.018, 0.015, 0.01], *scheme(3, 0.7),
                      *mesh(["AB", "BC"], 3), *mesh(["CD"], 4), "Dynamic/Newton tolerance = 1e-6"),
               Series("p = 4, s = 3, ρ∞ = 0.7, Newton 1e-6", STEP, [0.024, 0.021, 0.018, 0.015, 0.012], *scheme(3, 0.7),
                      *mesh(["AB"], 4), "Dynamic/Newton tolerance = 1e-6")],
            kynema((5.4e-5, 0.0224, 0.027), (5.1e-6, 0.0383, 0.043), (4.7e-7, 0.0515, 0.056), (2.3e-7, 0.0682, 0.073), (5.9e-8, 0.146, 0.151),
                   (2.3e-8, 0.257, 0.262), (7.8e-9, 0.503, 0.508)),
            duration=12, rows=120, windows=[(0, 2.95), (4.05, 8.15), (9.05, 12)], axes="z",
            label="largest error of C across the plane / its largest distance"),
    Problem("swept_tip", "Rotating beam with a swept tip", "benchmarks/swept_tip_dynamics.prm", ["tip.end.position"],
            QUIET + ["Loads/pulse/Axes = body"], scheme(3, 1) + ["Dynamic/Step = 3.125e-5", "Dynamic/Newton tolerance = 1e-12"],
            [Series("s = %d, ρ∞ = %g" % (s, r), STEP, steps, *scheme(s, r)) for s, r, steps in
             ((1, 1, [2e-3, 1e-3, 5e-4, 2.5e-4]), (2, 1, [5e-3, 2.5e-3, 1.25e-3]), (2, 0, [5e-3, 2.5e-3, 1.25e-3]),
              (3, 1, [5e-3, 2.5e-3, 1.25e-3]), (3, 0.5, [5e-3, 2.5e-3, 1.25e-3, 6.25e-4, 3.125e-4, 1.5625e-4, 7.8125e-5]))]
            + [Series("s = 3, ρ∞ = 0.5, Newton 1e-6", STEP, [2.5e-3, 6.25e-4, 1.5625e-4, 1.25e-4, 1e-4], *scheme(3, 0.5),
                      "Dynamic/Newton tolerance = 1e-6")],
            [mbdyn(6.8e-3, 0.347, OLDER), mbdyn(2.2e-3, 1.28, OLDER)], norm="rms", duration=0.5, rows=200, scale=swept_tip_scale,
            label="rms error of the tip / largest elastic displacement"),
    Problem("shaft", "Flexible shaft through its critical speed", PEERS + "shaft.prm", ["left.end.displacement"], QUIET,
            scheme(3, 1) + mesh(["left"], 4, 2) + ["Dynamic/Step = 1e-3", "Dynamic/Newton tolerance = 1e-12"],
            [Series("p = 4, s = 3, ρ∞ = 1", STEP, [0.02, 0.01, 0.005, 0.0025], *scheme(3, 1), *mesh(["left"], 4)),
             Series("p = 4 × 2, s = 3, ρ∞ = 1", STEP, [0.02, 0.01, 0.005, 0.0025], *scheme(3, 1), *mesh(["left"], 4, 2)),
             Series("p = 3 × 2, s = 3, ρ∞ = 1", STEP, [0.02, 0.01, 0.005], *scheme(3, 1), *mesh(["left"], 3, 2)),
             Series("p = 4, s = 3, ρ∞ = 0.5", STEP, [0.02, 0.01, 0.005, 0.0025], *scheme(3, 0.5), *mesh(["left"], 4)),
             Series("p = 4, s = 2, ρ∞ = 1", STEP, [0.01, 0.005, 0.0025, 0.00125], *scheme(2, 1), *mesh(["left"], 4)),
             Series("p = 4, s = 2, ρ∞ = 0", STEP, [0.01, 0.005, 0.0025, 0.00125], *scheme(2, 0), *mesh(["left"], 4)),
             Series("p = 3, s = 3, ρ∞ = 1", STEP, [0.02, 0.01, 0.005], *scheme(3, 1), *mesh(["left"], 3)),
             Series("p = 4, s = 3, ρ∞ = 0.5, adaptive", TOLERANCE, [1e-3, 1e-4, 1e-5], *adaptive(3, 0.5), *mesh(["left"], 4))],
            [mbdyn(1.4e-2, 0.412), mbdyn(3.6e-3, 1.024), mbdyn(1.1e-3, 2.235), mbdyn(4.8e-4, 5.041)], duration=3.5, rows=200),
    Problem("tail_rotor", "Tail rotor transmission", "rotorcraft/tail_rotor_transmission.prm",
            ["shaft 1.middle.displacement", "tail.end.displacement"],
            QUIET + ["Analyses = static, dynamic",
                     "Output/Probes = " + ", ".join(p + " " + c for p in ("shaft 1.middle.displacement", "tail.end.displacement")
                                                    for c in "xyz")],
            scheme(3, 0.5) + ["Dynamic/Step = 1e-3"] + mesh(["fuselage", "shaft 1"], 4, 4) + mesh(["tail", "shaft 2"], 4, 2),
            [Series("shipped mesh, s = %d, ρ∞ = %g" % (s, r), STEP, steps, *scheme(s, r)) for s, r, steps in
             ((3, 0.5, [0.02, 0.01, 0.005]), (2, 1, [0.01, 0.005, 0.0025]))]
            + [Series("shipped mesh, s = 3, Newton 1e-6", STEP, [0.02, 0.01, 0.005, 0.0025, 0.00125], *scheme(3, 0.5), NEWTON),
               Series("shipped mesh, s = 2, Newton 1e-6", STEP, [0.005, 0.0025, 0.00125, 0.000625], *scheme(2, 1), NEWTON),
               Series("coarse mesh, s = 3, Newton 1e-6", STEP, [0.02, 0.0125, 0.01, 0.005], *scheme(3, 0.5), *mesh(["fuselage", "tail", "shaft 2"], 3, 1),
                      *mesh(["shaft 1"], 3, 2), "Dynamic/Newton tolerance = 1e-6"),
               Series("coarse mesh, s = 2, Newton 1e-6", STEP, [0.01, 0.0075, 0.005, 0.0025], *scheme(2, 1), *mesh(["fuselage", "tail", "shaft 2"], 3, 1),
                      *mesh(["shaft 1"], 3, 2), "Dynamic/Newton tolerance = 1e-6"),
               Series("p = 4, s = 3, ρ∞ = 1, Newton 1e-8", STEP, [0.005, 0.0025, 0.00125], *scheme(3, 1), "Dynamic/Newton tolerance = 1e-8",
                      *mesh(["fuselage", "shaft 1"], 4, 4), *mesh(["tail", "shaft 2"], 4, 2)),
               Series("shipped mesh, s = 3, adaptive", TOLERANCE, [1e-3, 1e-4, 1e-5], *adaptive(3, 0.5))],
            [mbdyn(8.1e-2, 1.25, OLDER), mbdyn(2.0e-2, 2.0, OLDER), mbdyn(5.3e-3, 3.8, OLDER)], duration=5, rows=300),
    Problem("bricard", "Bricard's mechanism, 10 s", PEERS + "bricard.prm", ["bar 3.end.displacement"], QUIET,
            scheme(3, 1) + ["Dynamic/Step = 0.002", "Dynamic/Newton tolerance = 1e-12"],
            [Series("s = %d, ρ∞ = %g" % (s, r), STEP, steps, *scheme(s, r)) for s, r, steps in
             ((2, 1, [0.1, 0.05, 0.025]), (3, 1, [0.2, 0.1, 0.05]), (3, 0.5, [0.2, 0.1, 0.05]))]
            + [Series("s = 2, ρ∞ = 1, Newton 1e-6", STEP, [0.2, 0.1, 0.05], *scheme(2, 1), "Dynamic/Newton tolerance = 1e-6"),
               Series("s = 3, ρ∞ = 1, Newton 1e-6", STEP, [0.5, 0.4, 0.25, 0.2], *scheme(3, 1), "Dynamic/Newton tolerance = 1e-6"),
               Series("s = 2, ρ∞ = 1, Newton 1e-4", STEP, [0.2, 0.125, 0.1], *scheme(2, 1), "Dynamic/Newton tolerance = 1e-4"),
               Series("s = 3, ρ∞ = 1, Newton 1e-4", STEP, [0.4, 0.25, 0.2], *scheme(3, 1), "Dynamic/Newton tolerance = 1e-4")],
            without_start("Exudyn", (0.045, 1.1e-3), (0.16, 5.1e-5)), duration=10, rows=50, scale=1.0, label="largest error of P3 [m]"),
    Problem("n_four_bar", "Forty parallelograms, 10 s", PEERS + "n_four_bar.prm", ["crank 0.B.position"], QUIET, [],
            [Series("s = 2, ρ∞ = 0.5", STEP, [0.05, 0.02, 0.01], *scheme(2, 0.5)),
             Series("s = 3, ρ∞ = 0.5", STEP, [0.05, 0.02], *scheme(3, 0.5)),
             Series("s = 2, ρ∞ = 0.5, Newton 1e-6", STEP, [0.1, 0.05, 0.02], *scheme(2, 0.5), "Dynamic/Newton tolerance = 1e-6"),
             Series("s = 3, ρ∞ = 0.5, Newton 1e-6", STEP, [0.1, 0.05, 0.02, 0.01], *scheme(3, 0.5), "Dynamic/Newton tolerance = 1e-6"),
             Series("s = 3, ρ∞ = 0.5, Newton 1e-8", STEP, [0.05, 0.03, 0.02, 0.01], *scheme(3, 0.5), "Dynamic/Newton tolerance = 1e-8"),
             Series("s = 2, ρ∞ = 1, Newton 1e-5", STEP, [0.12, 0.1, 0.09, 0.08, 0.07, 0.05, 0.04], *scheme(2, 1),
                    "Dynamic/Newton tolerance = 1e-5"),
             Series("s = 2, ρ∞ = 1, Newton 1e-6", STEP, [0.1, 0.08, 0.0625, 0.04, 0.03, 0.02], *scheme(2, 1),
                    "Dynamic/Newton tolerance = 1e-6")],
            without_start("Exudyn", (0.43, 2.3e-2), (1.25, 1.2e-3)), goals=[0.14, 0.4], duration=10, exact=corner_of_forty, scale=1.0, label="largest error of the corner [m]"),
    Problem("squeezer", "Andrews' squeezer, 0.05 s", "benchmarks/dynamics/andrews_squeezer.prm",
            [b + ".displacement" for b in BARS],
            QUIET + ["Dynamic/End time = 0.05", "Output/Probes = " + ", ".join("%s.displacement %s" % (b, c) for b in BARS for c in "xy")],
            scheme(3, 1) + ["Dynamic/Step = 2.5e-5"],
            [Series("s = %d, ρ∞ = %g" % (s, r), STEP, steps, *scheme(s, r)) for s, r, steps in
             ((2, 1, [4e-4, 2e-4, 1e-4]), (3, 1, [8e-4, 4e-4, 2e-4]), (3, 0.5, [4e-4, 2e-4, 1e-4]))]
            + [Series("s = %d, ρ∞ = 1, Newton 1e-7" % s, STEP, steps, *scheme(s, 1), "Dynamic/Newton tolerance = 1e-7")
               for s, steps in ((2, [5e-4, 3.5e-4, 2e-4, 1e-4]), (3, [6e-4, 5e-4, 4e-4, 3e-4, 2e-4]))]
            + [Series("s = 3, ρ∞ = 0.5, adaptive", TOLERANCE, [1e-5, 1e-6, 1e-7], *adaptive(3, 0.5))],
            [mbdyn(3.3e-4, 0.254), mbdyn(2.0e-5, 1.006), mbdyn(5.0e-6, 1.082)], duration=0.05),
]


def make(parts, drawn):
    unknown = set(parts) - {p.name for p in PROBLEMS}
    if unknown:
        raise SystemExit("no problem %s; there are: %s" % (", ".join(sorted(unknown)), ", ".join(p.name for p in PROBLEMS)))
    for problem in few([p for p in PROBLEMS if not parts or p.name in parts]):
        if not drawn:
            print(problem.title, flush=True)
            rows = problem.compute(read(KEPT))
            order = {(p.name, s.name): (i, j) for i, p in enumerate(PROBLEMS) for j, s in enumerate(p.series)}
            common.write(KEPT, sorted((r for r in rows if (r["problem"], r["series"]) in order),
                                      key=lambda r: order[r["problem"], r["series"]]), COLUMNS)
        problem.draw(read(KEPT))
    text = "| problem | peer: error | its seconds | Samara: error, member | seconds | times faster | goal reached |\n"
    text += "|---|---|---|---|---|---|---|\n"
    into_page(PAGE, "peers", text + "\n".join(line for p in PROBLEMS for line in p.table(read(KEPT))) + "\n")
