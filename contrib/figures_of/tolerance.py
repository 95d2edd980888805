"""What a tolerance of adaptive steps means: tables and pictures of benchmarks/tolerance.md. Parts: names of problems, or fixed.

Runs the problems with each member of the integrator family and each tolerance, with the part `fixed` with fixed steps instead, and
compares with a fine fixed step. The error is the largest distance of a point from where it should be, in the last fifth of the run,
over the length that the tolerance is a part of. Every run is kept in benchmarks/tolerance.csv, references in results/tolerance. About
ten minutes."""

from figures_of import common
from figures_of.common import TOP, few, interpolated, into_page, np, on_mesh as mesh, plt, read, results, save, scheme, table


KEPT = "benchmarks/tolerance.csv"
COLUMNS = ["problem", "s", "rho", "control", "value", "error", "steps", "rejected", "unsolved", "iterations", "fails"]
MEMBERS = ["3,1", "3,0.5", "3,0", "2,1", "2,0.5", "2,0", "1,1"]
ORDER = ["3,1", "3,0.95", "3,0.8", "3,0.5", "3,0", "2,1", "2,0.95", "2,0.8", "2,0.5", "2,0", "1,1", "1,0.5", "1,0"]
IN_TABLE = ["3,1", "3,0.5", "2,0"]
TOLERANCES = ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6"]
DYNAMICS, PEERS = "benchmarks/dynamics/", "benchmarks/peers/"
LIMIT = 20  # seconds, after which a run is given up


def run(model, overrides):
    """A run and its counts; or the words of what went wrong."""
    done = common.Run(model, "Threads = 1", *overrides, limit=LIMIT, may_fail=True)
    if done.code:
        at = done.number(r"t = ([\d.e+-]+) s")
        return "refused" if "Stages" in done.text else "no end in %d s" % LIMIT if np.isnan(at) else "stuck at t = %.4g s" % at
    count = lambda pattern: done.number(pattern, 0)
    return done.dynamic, {"steps": int(count(r"dynamic: (\d+) steps")), "rejected": int(count(r"(\d+) rejected")),
                          "unsolved": int(count(r"(\d+) without solution")), "iterations": "%g" % count(r"([\d.]+) Newton")}


class Problem:
    """points: probes without axis; length: of the model; step: of the reference; steps: fixed ones that are compared."""

    def __init__(self, name, model, points, length, step, steps, *overrides, reference=(3, 1)):
        self.name, self.model, self.points, self.length, self.steps = name, model, points, length, steps
        self.overrides = ["Output/Probes = " + ", ".join("%s %s" % (p, c) for p in points for c in "xyz"),
                          "Dynamic/Pictures = 0", *overrides]
        self.fine = [*scheme(*reference), "Dynamic/Step = %s" % step, "Dynamic/Newton tolerance = 1e-12"]

    def vectors(self, motion):
        return motion["t"], np.array([[motion[f"{p} {c}"] for c in "xyz"] for p in self.points]).transpose(2, 0, 1)

    def reference(self):
        file = results("tolerance") / (self.name + ".npz")
        recipe = "\n".join([(TOP / "prm" / self.model).read_text(), *self.overrides, *self.fine])
        if file.exists() and str(np.load(file)["recipe"]) == recipe:
            kept = np.load(file)
            return kept["times"], kept["values"]
        done = run(self.model, self.overrides + self.fine)
        if isinstance(done, str):
            raise SystemExit("reference of %s: %s" % (self.name, done))
        times, values = self.vectors(done[0])
        np.savez(file, recipe=recipe, times=times, values=values)
        return times, values

    def measured(self, s, rho, control, value):
        overrides = [*self.overrides, *scheme(s, rho), "Dynamic/Step control = " + control, "Dynamic/Newton tolerance = 1e-10"]
        overrides.append("Dynamic/%s = %s" % ("Step" if control == "fixed" else "Tolerance", value))
        row = {"problem": self.name, "s": s, "rho": rho, "control": control, "value": value}
        done = run(self.model, overrides)
        if isinstance(done, str):
            return {**row, "fails": done}
        times, values = self.vectors(done[0])
        fine_times, fine = self.reference()
        late = times > times[-1] - 0.2 * (times[-1] - times[0])
        length = max(self.length, np.linalg.norm(fine - fine[0], axis=2).max())
        error = np.linalg.norm(values[late] - interpolated(fine_times, fine, times[late]), axis=2).max() / length
        return {**row, "error": "%.3e" % error, **done[1]}


SMOOTH = ["Loads/throw/Force = t < 2.5 ? 8*sin(pi*t/2.5)^4 : 0, 0, 0",
          "Loads/throw/Moment = 0, 0, t < 2.5 ? -80*sin(pi*t/2.5)^4 : 0"]
BARS = ["OF", "EF", "EBD", "GE", "AG", "HE", "AH"]

PROBLEMS = [
    Problem("pendulum", DYNAMICS + "simple_pendulum.prm", ["mass.position"], 1, "0.0125", ["0.1", "0.05", "0.025"]),
    Problem("governor", DYNAMICS + "governor.prm", ["rod 1.position", "slider.position"], 1, "5e-4", ["0.02", "0.01", "0.005"],
            reference=(3, 0.5)),
    Problem("slider-crank", DYNAMICS + "slider_crank.prm", ["crank.position", "rod.position", "slider.position"], 0.24, "0.00125",
            ["0.02", "0.01", "0.005"]),
    Problem("heavy top", DYNAMICS + "heavy_top.prm", ["top.position"], 1, "5e-4", ["1e-2", "5e-3", "2.5e-3"]),
    Problem("Bricard", PEERS + "bricard.prm", ["bar 3.end.displacement"], 1.9, "0.005", ["0.1", "0.05", "0.025"]),
    Problem("two parallelograms", DYNAMICS + "four_bar.prm", ["coupler 1.position", "coupler 2.position"], 2, "0.00125",
            ["0.02", "0.01", "0.005"], reference=(3, 0.5)),
    Problem("squeezer", DYNAMICS + "andrews_squeezer.prm", [b + ".position" for b in BARS], 0.09, "5e-5", ["4e-4", "2e-4", "1e-4"]),
    Problem("elbow", DYNAMICS + "elbow.prm", ["first.end.position", "second.end.position"], 14.1, "0.02", ["0.2", "0.1", "0.05"]),
    Problem("flying beam, smooth", DYNAMICS + "flying_beam.prm", ["beam.start.position", "beam.middle.position", "beam.end.position"], 10,
            "0.0125", ["0.2", "0.1", "0.05"], *SMOOTH, *mesh(["beam"], 3, 8)),
    Problem("flying beam", DYNAMICS + "flying_beam.prm", ["beam.start.position", "beam.middle.position", "beam.end.position"], 10,
            "0.003", ["0.1", "0.05", "0.025"], *mesh(["beam"], 3, 8)),
    Problem("spin-up", DYNAMICS + "spin_up.prm", ["beam.middle.position", "beam.end.position"], 10, "0.0125", ["0.5", "0.25", "0.1"],
            "Bodies/beam/Elements = 2"),
    Problem("four-bar, flexible", PEERS + "four_bar.prm", ["AB.end.displacement", "CD.start.displacement"], 0.27, "0.005",
            ["0.04", "0.02", "0.01"], reference=(3, 0.5)),
    Problem("shaft", PEERS + "shaft.prm", ["left.end.displacement"], 6, "1e-3", ["0.01", "5e-3", "2.5e-3"]),
    Problem("crank, flexible", "studies/flexible_slider_crank.prm", ["rod.middle.position", "rod.end.position"], 0.45, "5e-5",
            ["4e-4", "2e-4", "1e-4"]),
    Problem("tail rotor", "rotorcraft/tail_rotor_transmission.prm", ["shaft 1.middle.displacement"], 6, "1e-3",
            ["0.01", "5e-3", "2.5e-3"], "Analyses = static, dynamic", "Dynamic/End time = 1",
            *mesh(["fuselage", "tail", "shaft 1", "shaft 2"], 2, 1)),
]


def keep(row):
    row = {column: str(row.get(column, "")) for column in COLUMNS}
    key = lambda r: [r[c] for c in COLUMNS[:5]]
    kept = [r for r in read(KEPT) if key(r) != key(row)] + [row]
    names = [p.name for p in PROBLEMS]
    kept.sort(key=lambda r: (names.index(r["problem"]), r["control"], ORDER.index(r["s"] + "," + r["rho"]), -float(r["value"])))
    common.write(KEPT, kept, COLUMNS)


def short(number):
    return "%.0f" % number if number >= 10 else "%.2g" % number


def table_of(kept):
    """Error over tolerance and steps of three members."""
    lines = []
    for problem in PROBLEMS:
        name = problem.name
        for member in IN_TABLE:
            rows = {r["value"]: r for r in kept if r["problem"] == problem.name and r["control"] == "adaptive"
                    and r["s"] + "," + r["rho"] == member}
            if not rows:
                continue
            cells = []
            for value in TOLERANCES:
                row = rows.get(value)
                cells.append("–" if not row else row["fails"] or "%s (%s)" % (
                    short(float(row["error"]) / float(value)), row["steps"]))
            lines.append([name, member.replace(",", ", "), *cells])
            name = ""
    return table("problem | s, ρ∞ | " + " | ".join(TOLERANCES), lines)


COLOURS = dict(zip(ORDER, ["#1f5fa8", "#7fb0e6", "#9ccc65", "#2a9d5c", "#3aa6b9", "#d1495b", "#f28c9c", "#f4c542", "#e08e1b", "#7b4fa3",
                           "0.4", "0.6", "0.75"]))


def draw_errors(kept):
    """Error against tolerance, all problems and members; the band of 0.05 to 30 times the tolerance."""
    plt.rcParams.update({"font.size": 9})
    figure, axis = plt.subplots(figsize=(7.2, 5), layout="constrained")
    tolerances = np.array([3e-7, 3e-2])
    axis.fill_between(tolerances, 0.05 * tolerances, 30 * tolerances, color="0.93", zorder=0, label="0.05 to 30 times the tolerance")
    axis.loglog(tolerances, tolerances, color="k", lw=1)
    for i, (member, colour) in enumerate(COLOURS.items()):
        rows = [r for r in kept if r["control"] == "adaptive" and r["error"] and r["s"] + "," + r["rho"] == member]
        axis.loglog([float(r["value"]) * 1.09 ** (i - 6) for r in rows], [float(r["error"]) for r in rows], ls="", marker="o", ms=3.5,
                    color=colour, label="s = %s, ρ∞ = %s" % tuple(member.split(",")))
    axis.set(xlabel="tolerance", ylabel="error at the end / length", xlim=tolerances)
    axis.legend(fontsize=8, framealpha=0.9, loc="lower right", ncols=2)
    save(figure, "tolerance_errors.png", 100, 64)


def draw_costs(kept):
    """Steps, with those done again, against error: a panel for each problem; lines fixed steps, dashes and rings adaptive ones."""
    plt.rcParams.update({"font.size": 9})
    shown = ["3,1", "3,0.5", "2,0"]
    panels = [p for p in PROBLEMS if any(r["problem"] == p.name and r["control"] == "fixed" for r in kept)]
    figure, axes = plt.subplots(-(-len(panels) // 4), 4, figsize=(12, 2.7 * -(-len(panels) // 4)), layout="constrained", squeeze=False)
    for axis in axes.flat[len(panels):]:
        axis.axis("off")
    for axis, problem in zip(axes.flat, panels):
        for member in shown:
            for control in ("fixed", "adaptive"):
                rows = [r for r in kept if r["problem"] == problem.name and r["control"] == control and r["error"]
                        and r["s"] + "," + r["rho"] == member]
                axis.loglog([float(r["error"]) for r in rows],
                            [int(r["steps"]) + int(r["rejected"]) + int(r["unsolved"]) for r in rows], color=COLOURS[member],
                            ls="-" if control == "fixed" else "--", marker="." if control == "fixed" else "o", ms=4, mfc="none" if control != "fixed" else None,
                            lw=1.2, label="s = %s, ρ∞ = %s, %s" % (*member.split(","), control))
        axis.set_title(problem.name, fontsize=9, loc="left")
        axis.invert_xaxis()
    for axis in axes[:, 0]:
        axis.set_ylabel("steps")
    for axis in axes[-1]:
        axis.set_xlabel("error / length")
    handles, labels = axes.flat[0].get_legend_handles_labels()
    (axes.flat[len(panels)] if len(panels) < axes.size else axes.flat[0]).legend(handles, labels, fontsize=8, loc="center" if len(panels) < axes.size else "best")
    save(figure, "tolerance_costs.png", 100, 64)


def make(parts, drawn):
    fixed = "fixed" in parts
    for problem in [] if drawn else few([p for p in PROBLEMS if p.name in parts or not set(parts) - {"fixed"}]):
        problem.reference()
        for member in few(MEMBERS):
            for value in few(problem.steps if fixed else TOLERANCES):
                row = problem.measured(*member.split(","), "fixed" if fixed else "adaptive", value)
                keep(row)
                print(problem.name, *(row.get(c, "") for c in COLUMNS[1:]), flush=True)
    kept = read(KEPT)
    into_page("benchmarks/tolerance.md", "errors over tolerances", table_of(kept))
    draw_errors(kept)
    draw_costs(kept)
