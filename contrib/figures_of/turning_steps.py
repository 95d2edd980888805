"""Pictures and numbers of benchmarks/turning_steps.md: errors, iterations and times of steps that turn, over steps a turn.

Parts: names of models, multipliers, slow_multipliers, blow, trim; all without names, in half an hour. Numbers are kept in
benchmarks/turning_steps.csv. The environment variable SAMARA_BEFORE names a program to compare with; without it there is one set."""

import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from figures_of import common
from figures_of.common import SAMARA, TOP, doc, interpolated, np, plt

DRAWN, SHORT = False, common.SMALL
PROGRAMS = {"after": SAMARA}
if "SAMARA_BEFORE" in os.environ:
    PROGRAMS = {"before": os.environ["SAMARA_BEFORE"], **PROGRAMS}
NUMBERS = doc("benchmarks/turning_steps.csv")
COLUMNS = ["story", "program", "stages", "steps a turn", "probe", "error", "value", "range", "iterations a step", "factorisations a step",
           "halvings", "processor time [s]", "user time of the process [s]", "why"]
COLORS = {1: "#d1495b", 2: "#2a9d5c", 3: "#1f5fa8"}
MARKERS = {1: "o", 2: "s", 3: "^"}
SHOWN = [6, 12, 24, 60]  # in tables; the file has all
FEW = [6, 8, 12, 18, 24, 36, 60, 120]


def at_speed(speed):
    """Lines that make the angle of the shaft of a hub a function of time."""
    return f"subsection Subsystems\n subsection hub\n  set Drive = prescribed\n  set Angle = {speed}*t\n end\nend\n"


def as_gauss_turns(stages, steps):
    """The angle by which a step of Gauss turns at constant speed, over the exact one."""
    z = 2 * math.pi / steps
    above, below = {1: (z / 2, 1), 2: (z / 2, 1 - z ** 2 / 12), 3: (z / 2 - z ** 3 / 120, 1 - z ** 2 / 10)}[stages]
    return 2 * math.atan2(above, below) / z


class Model:
    """A model whose motion is measured: turns of a length from its start, errors of probes over the last turn."""

    def __init__(self, path, title, turn, turns, probes, *entries, stages=(1, 3), steps=FEW, reference=480, more=""):
        self.more = more  # lines of the model beside those of its file
        self.path, self.title, self.turn, self.turns, self.probes = path, title, turn, turns, probes
        self.entries, self.stages, self.steps, self.reference = entries, stages, steps, reference

    def lines(self, stages, steps):
        return self.more.replace("GAUSS", repr(as_gauss_turns(stages, steps)))

    def motion(self, stages, steps):
        return [*self.entries, "Analyses = static, dynamic", f"Dynamic/Stages = {stages}", f"Dynamic/Step = ({self.turn})/{steps}",
                f"Dynamic/End time = {self.turns}*({self.turn})", "Dynamic/Energy balance = warn"]


MODELS = {
    "rod": Model("tests/reference/rotation/turning_rod.prm", "An elastic rod turns, 30 rad/s", "2*pi/30", 10,
                 {"rod.start.force 1": "root force"}, "Dynamic/Spectral radius = 1", stages=(1, 2, 3)),
    "hover": Model("prm/rotorcraft/xv15_hover_elastic.prm", "XV-15 in hover, elastic blades", "2*pi/(tip/R)", 4,
                   {"hub:flow.thrust": "thrust", "hub:flow.torque": "torque", "blade 1:blade.end.displacement z": "displacement of the tip"},
                   more=at_speed("tip/R")),
    "air": Model("prm/rotorcraft/xv15_hover_elastic.prm", "XV-15, no inflow, speed as Gauss turns", "2*pi/(tip/R)", 4,
                 {"hub:shaft.moment 3": "torque", "blade 1:blade.start.force 1": "root force along the blade",
                  "blade 1:blade.start.force 3": "root force along the shaft"},
                 "Subsystems/blade/Surfaces/blade/Inflow =",
                 "Output/Probes = hub:shaft.moment 3, blade 1:blade.start.force 1, blade 1:blade.start.force 3", more=at_speed("GAUSS*tip/R")),
    "puma_in_vacuum": Model("prm/rotorcraft/puma.prm", "SA 330 in vacuum", "2*pi/Omega", 4,
                            {"blade 1:blade.start.force 1": "root force", "blade 1:pitch link.force": "force of a pitch link",
                             "blade 1:blade.end.displacement z": "displacement of the tip"}),
    "puma_hover": Model("prm/rotorcraft/puma_real_time.prm", "SA 330 in hover, free flap and lag", "T", 4,
                        {"flow.thrust": "thrust", "flow.torque": "torque", "blade 1:flap.rotation": "flap angle"},
                        "Constants/mu = 0", "States/cosine/Value = 0 deg", "States/sine/Value = 0 deg", "Dynamic/Newton tolerance = 1e-10"),
    "puma_flight": Model("prm/rotorcraft/puma_real_time.prm", "SA 330 in flight, μ = 0.321", "T", 4,
                         {"flow.thrust": "thrust", "flow.torque": "torque", "blade 1:flap.rotation": "flap angle"},
                         "Dynamic/Newton tolerance = 1e-10", steps=[12, 18, 24, 36, 60, 120]),
    "transmission": Model("prm/rotorcraft/tail_rotor_transmission.prm", "Tail rotor transmission, no torque", "2*pi/speed", 12,
                          {"fuselage.start.moment 2": "moment in the fuselage", "shaft 1.middle.moment 2": "moment in the shaft",
                           "tail.end.displacement z": "displacement of the tail"}, "Joints/S/rotation/Moment = 0"),
    "spin_up": Model("prm/rotorcraft/tail_rotor_transmission.prm", "Tail rotor transmission, 5 s with the torque", "2*pi/speed", 36,
                     {"fuselage.start.moment 2": "moment in the fuselage", "shaft 1.middle.moment 2": "moment in the shaft",
                      "H.rotation rate": "speed of the rotor"}, steps=[12, 18, 24, 36, 60, 120]),
    "turbine": Model("prm/rotorcraft/nrel_5mw.prm", "NREL 5 MW, steady wind", "2*pi/Omega", 4,
                     {"flow.thrust": "thrust", "flow.torque": "torque", "blade 1:blade.end.displacement x": "displacement of the tip"},
                     more=at_speed("Omega")),
    "turbine_in_shear": Model("prm/rotorcraft/nrel_5mw_shear.prm", "NREL 5 MW, sheared wind and weight", "2*pi/Omega", 3,
                              {"flow.thrust": "thrust", "flow.torque": "torque", "blade 1:blade.end.displacement x": "displacement of the tip"}),
    "tilting": Model("prm/examples/aero/tilting_rotors.prm", "Rotors that tilt, 5 s", "2*pi/Omega", 32,
                     {"flow left.thrust": "thrust", "flow left.torque": "torque"}, steps=[12, 18, 24, 30, 60, 120]),
}


class Run:
    """A run of a program: what it wrote and what it took."""

    def __init__(self, program, model, entries, more="", seconds=450):
        with tempfile.TemporaryDirectory() as folder:
            if more:
                file = pathlib.Path(folder) / "model.prm"
                file.write_text(f"include {TOP / model}\n{more}")
                model = str(file)
            command = ["timeout", str(seconds), PROGRAMS[program], model, "--output", folder]
            # programs of before have no report
            for entry in (*entries, "Output/Pictures = false", *(["Output/Report = false"] if program == "after" else [])):
                command += ["--set", entry]
            before = os.times().children_user
            run = subprocess.run(command, capture_output=True, text=True, cwd=TOP, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
            self.user = os.times().children_user - before
            if run.returncode == 2:
                sys.exit(" ".join(command) + "\n" + run.stderr)
            self.returncode, self.text = run.returncode, run.stdout + run.stderr
            self.dynamic, self.sizes, self.summary, self.floquet, self.trim = (
                self.table(pathlib.Path(folder) / f"{name}.csv") for name in ("dynamic", "dynamic_steps", "summary", "floquet", "trim"))

    @staticmethod
    def table(path):
        if not path.exists():
            return {}
        rows = list(csv.reader(path.open()))
        rows = [r for r in rows if len(r) == len(rows[0])]

        def number(text):
            try:
                return float(text)
            except ValueError:
                return math.nan

        return {head.split(" [")[0]: np.array([number(r[i]) for r in rows[1:]]) for i, head in enumerate(rows[0])}

    def number(self, pattern):
        return float((re.search(pattern, self.text) or [0, "nan"])[1])

    @property
    def processor(self):
        """Seconds of the processor of the motion."""
        return self.number(r"dynamic: .*; [\d.e+-]+ s, ([\d.e+-]+) s of the processor")

    @property
    def why(self):
        if self.returncode == 0 and "the energy budget" in self.text:
            return ""
        return {0: "", 3: "no convergence", 4: "singular matrix", 124: "out of time"}.get(self.returncode, f"exit code {self.returncode}")


def at_times(t, times, values):
    """By the polynomials through the six nearest rows of a fine run."""
    times, keep = np.unique(times, return_index=True)
    return interpolated(times, values[keep], t, 6)


def error(run, reference, probe):
    """Of the last turn of a run: rms of the error over rms of the value; rms; how much the reference varies, of that."""
    t, end = run.dynamic["t"], reference.dynamic["t"][-1]
    last = t > end - reference.turn * (1 - 1e-6)
    exact = at_times(t[last], reference.dynamic["t"], reference.dynamic[probe])
    size = math.sqrt(np.mean(exact ** 2))
    fine = reference.dynamic[probe][reference.dynamic["t"] > end - reference.turn]
    return math.sqrt(np.mean((run.dynamic[probe][last] - exact) ** 2)) / size, size, (max(fine) - min(fine)) / size


def measure(story):
    """Rows of the file, a run and a probe each."""
    model = MODELS[story]
    reference = Run("after", model.path, [*model.motion(3, model.reference), "Dynamic/Newton tolerance = 1e-10"],
                    model.lines(3, model.reference))
    if reference.why:
        sys.exit(f"{story}: the reference fails: {reference.why}\n{reference.text[-2000:]}")
    reference.turn = reference.dynamic["t"][-1] / model.turns
    cases = [(stages, steps) for stages in model.stages for steps in model.steps if not SHORT or steps in (12, 24)]
    rows = []
    for stages, steps in [*cases, (3, model.reference)]:
        runs = {program: [] for program in PROGRAMS}
        while True:
            for program in PROGRAMS:
                runs[program].append(reference if steps == model.reference and program == "after" and not runs[program]
                                     else Run(program, model.path, model.motion(stages, steps), model.lines(stages, steps)))
            count = len(runs["after"])
            longest = max(math.inf if r.why else r.processor for rs in runs.values() for r in rs)
            if count == (3 if longest < 0.1 else 2 if longest < 1 else 1) or SHORT or steps == model.reference:
                break
        for program, several in runs.items():
            run = several[-1]
            count = run.summary.get("steps", [math.nan])[0] if not run.why else math.nan
            for probe, name in model.probes.items():
                e, size, extent = error(run, reference, probe) if not run.why else (math.nan,) * 3
                rows.append([story, program, stages, steps, name, f"{e:.3g}", f"{size:.8g}", f"{extent:.2g}",
                             f"{run.number(r'([0-9.]+) Newton iterations'):.2f}", f"{run.number(r'and ([0-9.]+) factorizations'):.2f}",
                             f"{sum(run.sizes['rejections']):.0f}" if "rejections" in run.sizes else "",
                             f"{min(r.processor for r in several):.3g}", f"{min(r.user for r in several):.3g}", run.why])
            print(f"{story} {program:6} s = {stages} {steps:4} a turn {count:.0f} steps", *rows[-len(model.probes)][5:6], *rows[-1][8:],
                  flush=True)
    return rows


def kept():
    return [row for row in csv.DictReader(NUMBERS.open())] if NUMBERS.exists() else []


def keep(story, rows):
    others = [[row[c] for c in COLUMNS] for row in kept() if row["story"] != story]
    with NUMBERS.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        order = list(STORIES)
        writer.writerows(sorted([*others, *rows], key=lambda row: order.index(row[0])))


def save(figure, story):
    common.save(figure, f"turning_steps_{story}.png", colours=256)


def curve(rows, stages, program, column, probe=None):
    chosen = [r for r in rows if int(r["stages"]) == stages and r["program"] == program and (probe is None or r["probe"] == probe)]
    xs, ys = {}, {}
    for r in chosen:
        xs[int(r["steps a turn"])], ys[int(r["steps a turn"])] = int(r["steps a turn"]), float(r[column] or "nan")
    x = sorted(xs)
    return np.array(x), np.array([ys[n] for n in x])


def draw(story):
    """Error, iterations and time of the motion over steps a turn."""
    model, rows = MODELS[story], [r for r in kept() if r["story"] == story]
    if not rows:
        return
    fine = [r for r in rows if int(r["steps a turn"]) == model.reference]
    rows = [r for r in rows if int(r["steps a turn"]) != model.reference]
    probe = next(iter(model.probes.values()))
    programs = [p for p in ("before", "after") if any(r["program"] == p for r in rows)]
    figure, axes = plt.subplots(1, 4, figsize=(15.5, 4.4), layout="constrained", gridspec_kw={"width_ratios": [1, 1, 1, 0.3]})
    axes[3].axis("off")
    for stages in model.stages:
        for program in programs:
            new = program == "after"
            style = dict(color=COLORS[stages], marker=MARKERS[stages], ms=6, mfc=COLORS[stages] if new else "w",
                         ls="-" if new else (0, (4, 1.6)), lw=1.8 if new else 1.3, label=f"s = {stages}, {program}")
            for ax, column in zip(axes[:3], ("error", "iterations a step", "processor time [s]")):
                x, y = curve(rows, stages, program, column, probe)
                ax.plot(x, np.maximum(y, 1e-14) if column == "error" else y, **style)
                failed = [int(r["steps a turn"]) for r in rows if r["why"] and r["program"] == program and int(r["stages"]) == stages
                          and r["probe"] == probe]
                for n in failed if column == "error" else ():
                    ax.plot(n, 0.98, ls="", marker="X", ms=10, color=COLORS[stages], mec="k", mfc=COLORS[stages] if new else "w", zorder=9,
                            transform=ax.get_xaxis_transform(), clip_on=False)
    floor = [float(r["error"]) for r in fine if r["program"] == "before" and r["probe"] == probe]
    if floor and floor[0] > 0:
        axes[0].axhline(floor[0], color="0.55", lw=1, ls=":", zorder=0)
        axes[0].annotate("references before and after", (1, floor[0]), xycoords=("axes fraction", "data"), ha="right", va="top", fontsize=8,
                         xytext=(0, -6), textcoords="offset points", color="0.35")
    axes[0].set_yscale("log")
    axes[0].set_ylim(bottom=axes[0].get_ylim()[0] / 20)
    axes[2].set_yscale("log")
    axes[1].set_ylim(bottom=0)
    for ax, label, title in zip(axes[:3], (f"error of the {probe}, relative", "Newton iterations a step", "processor time of the motion [s]"),
                                (model.title, "iterations", f"time, {model.turns} turns")):
        ax.set_xscale("log")
        ax.set_xticks(model.steps, [str(n) for n in model.steps])
        ax.minorticks_off()
        if ax is axes[2]:
            ax.yaxis.set_major_locator(plt.matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
            ax.yaxis.set_major_formatter(plt.matplotlib.ticker.FormatStrFormatter("%g"))
        ax.set_xlabel("steps a turn")
        ax.set_ylabel(label)
        ax.set_title(title, loc="left", fontsize=11)
    handles, labels = axes[0].get_legend_handles_labels()
    axes[3].legend(handles, labels, loc="center left", bbox_to_anchor=(-0.3, 0.5), fontsize=9, frameon=False)
    save(figure, story)


def table(story):
    """Of the first probe, and of the errors of the others."""
    model, rows = MODELS[story], [r for r in kept() if r["story"] == story]
    if not rows:
        return
    programs = [p for p in ("before", "after") if any(r["program"] == p for r in rows)]
    names = list(model.probes.values())
    at = {(r["program"], int(r["stages"]), int(r["steps a turn"]), r["probe"]): r for r in rows}
    print("last turn of the reference:", "; ".join(
        f"{n} {at['after', 3, model.reference, n]['value']}, varies by {at['after', 3, model.reference, n]['range']} of that" for n in names))
    if "before" in programs:
        print("references, before against after:", *(at["before", 3, model.reference, n]["error"] for n in names))
    print("| s | steps a turn |", " | ".join(f"error of {n}, {' → '.join(programs)}" for n in names),
          "| iterations | factorisations | halvings | time [s] |")
    print("|---" * (6 + len(names)) + "|")
    short = lambda text: f"{float(text):.2g}" if text not in ("", "nan") and "." in text or "e" in text else text
    for stages in model.stages:
        for steps in (n for n in model.steps if n in SHOWN and (programs[0], stages, n, names[0]) in at):
            both = lambda column, name=names[0]: " → ".join(
                (short(at[p, stages, steps, name][column]) if not at[p, stages, steps, name]["why"] or column == "halvings"
                 else at[p, stages, steps, name]["why"]) for p in programs)
            print(f"| {stages} | {steps} |", " | ".join(both("error", n) for n in names), "|", both("iterations a step"), "|",
                  both("factorisations a step"), "|", both("halvings"), "|", both("processor time [s]"), "|")


def summary():
    """The two tables of all models: errors, and what steps take."""
    rows = [r for r in kept() if r["story"] in MODELS]
    at = {(r["story"], r["program"], int(r["stages"]), int(r["steps a turn"]), r["probe"]): r for r in rows}
    programs = [p for p in PROGRAMS if any(r["program"] == p for r in rows)] if not DRAWN else \
        [p for p in ("before", "after") if any(r["program"] == p for r in rows)]

    def cell(story, stages, steps, column):
        probe = next(iter(MODELS[story].probes.values()))
        found = [at.get((story, p, stages, steps, probe)) for p in programs]
        digits = "{:.1e}" if column == "error" else "{:.2g}"
        return " → ".join("–" if r is None else r["why"] or digits.format(float(r[column])).replace("e-0", "e-") for r in found)

    cases = [(story, stages) for story in MODELS if any(r["story"] == story for r in rows) for stages in MODELS[story].stages]
    print(f"| error of | s | 12 steps a turn, {' → '.join(programs)} | 24 | 60 |\n|---|---|---|---|---|")
    for story, stages in cases:
        print(f"| {story}, {next(iter(MODELS[story].probes.values()))} | {stages} |",
              " | ".join(cell(story, stages, n, "error") for n in (12, 24, 60)), "|")
    print("| | s | iterations a step: 12 | 24 | 60 | factorisations a step: 12 | 24 | 60 | seconds: 12 | 24 | 60 |\n" + "|---" * 11 + "|")
    for story, stages in cases:
        print(f"| {story} | {stages} |", " | ".join(cell(story, stages, n, c) for c in ("iterations a step", "factorisations a step",
                                                                                        "processor time [s]") for n in (12, 24, 60)), "|")


# ------------------------------------------------------------------ multipliers and trim

MULTIPLIERS = {  # model: (shipped steps, other steps, reference steps)
    "tests/reference/rotation/flap_floquet.prm": (12, [24, 36, 48], 96),
    "prm/examples/floquet/hammond_rotor.prm": (36, [20], 144),
    "prm/examples/floquet/elastic_rotor.prm": (36, [18], 144),
    "prm/examples/floquet/flap_lag_forward_flight.prm": (96, [48], 192),
    "prm/examples/floquet/unsymmetric_shaft.prm": (36, [18], 144),
    "prm/examples/floquet/mathieu_pendulum.prm": (36, [18], 144),
}
SLOW = {"prm/rotorcraft/puma_elastic_stability.prm": (120, [60], None)}  # without a reference: the larger number takes its place


def worst(run, reference):
    """Largest distance of a multiplier to the nearest of the reference, relative to the largest, as |multipliers| and as numbers."""
    ours = run.floquet["multiplier real"] + 1j * run.floquet["multiplier imaginary"]
    theirs = reference.floquet["multiplier real"] + 1j * reference.floquet["multiplier imaginary"]
    near = [min(abs(ours - m).min(), abs(ours - m.conjugate()).min()) for m in theirs]
    return max(near) / max(abs(theirs)), abs(abs(ours).max() / abs(theirs).max() - 1)


def measure_multipliers(models, story):
    rows = []
    for path, (shipped, others, finest) in models.items():
        kind = "Trim/Steps" if "puma" in path else None
        entries = lambda n: [f"Floquet/Steps = {n}", *([f"{kind} = {n}"] if kind else []),
                             *(["Floquet/Animations = 0"])]
        reference = Run("after", path, entries(finest)) if finest else None
        if reference is not None and not len(reference.floquet.get("multiplier", [])):
            sys.exit(f"{path}: the reference fails: {reference.text[-1000:]}")
        for steps in (shipped, *others):
            runs = {program: [] for program in PROGRAMS}
            for _ in range(1 if not finest else 3):
                for program in PROGRAMS:
                    runs[program].append(Run(program, path, entries(steps)))
            if reference is None:
                reference = runs["after"][-1]
            for program, several in runs.items():
                run = several[-1]
                found = len(run.floquet.get("multiplier", [])) > 0
                e, largest = worst(run, reference) if found else (math.nan, math.nan)
                same = np.argmin(abs(run.floquet["frequency"] - reference.floquet["frequency"][0])) if found else 0
                rows.append([story, program, 3, steps, pathlib.Path(path).name, f"{e:.3g}",
                             f"{run.floquet['growth rate'][same]:.9g}" if found else "", f"{largest:.3g}", "", "", "", "",
                             f"{min(r.user for r in several):.3g}", "" if found else run.why or "no multipliers"])
                print(*rows[-1][1:8], *rows[-1][12:], flush=True)
    return rows


def table_multipliers(story):
    rows = [r for r in kept() if r["story"] == story]
    print("| model | steps | program | growth rate of the first [1/s] | largest error of a multiplier | of the largest | user time [s] | |")
    print("|---|---|---|---|---|---|---|---|")
    for r in rows:
        print(f"| {r['probe']} | {r['steps a turn']} | {r['program']} | {r['value']} | {r['error']} | {r['range']} |"
              f" {r['user time of the process [s]']} | {r['why']} |")


def draw_multipliers(story):
    """Growth rate of the flap of flap_floquet.prm against the exact one."""
    rows = [r for r in kept() if r["story"] == story and r["probe"] == "flap_floquet.prm"]
    if not rows:
        return
    exact = -0.812205560415  # of <modal>
    figure, ax = plt.subplots(figsize=(7, 4.4), layout="constrained")
    for program in ("before", "after"):
        chosen = sorted((int(r["steps a turn"]), abs(float(r["value"]) / exact - 1)) for r in rows if r["program"] == program and r["value"])
        if chosen:
            new = program == "after"
            ax.plot(*zip(*chosen), color="#1f5fa8" if new else "#d1495b", marker="o", mfc=None if new else "w", ls="-" if new else (0, (4, 1.6)),
                    label=program)
        failed = [int(r["steps a turn"]) for r in rows if r["program"] == program and not r["value"]]
        for n in failed:
            ax.plot(n, 0.97, ls="", marker="X", ms=11, color="#d1495b", mec="k", transform=ax.get_xaxis_transform(), clip_on=False,
                    label=f"{program}: fails" if n == failed[0] else None)
    ax.set_yscale("log")
    ax.set_ylim(1e-9, 10)
    ax.set_xlim(10, 50)
    ax.set_xticks([12, 24, 36, 48])
    ax.set_xlabel("steps a turn")
    ax.set_ylabel("error of the growth rate of the flap, relative")
    ax.legend(fontsize=9, loc="upper right", bbox_to_anchor=(1, 0.93))
    save(figure, story)


BLOW = "prm/rotorcraft/tail_rotor_stability.prm"


def growth(run):
    """Growth rate of the middle of the shaft after a blow, from the rms of two windows of two seconds each [1/s]."""
    t = run.dynamic["t"]
    away = np.hypot(run.dynamic["shaft 1.middle.displacement y"], run.dynamic["shaft 1.middle.displacement z"])
    rms = [math.sqrt(np.mean(away[(t > start) & (t < start + 2)] ** 2)) for start in (8, 18)]
    return math.log(rms[1] / rms[0]) / 10


def measure_blow(story):
    rows, entries = [], lambda n: ["Analyses = static, dynamic", f"Dynamic/Step = 2*pi/speed/{n}", "Dynamic/Energy balance = warn"]
    reference = Run("after", BLOW, entries(240))
    for steps in (12, 16, 24, 33, 48):
        runs = {program: [] for program in PROGRAMS}
        for _ in range(2):
            for program in PROGRAMS:
                runs[program].append(Run(program, BLOW, entries(steps)))
        for program, several in runs.items():
            run = several[-1]
            rate = math.nan if run.why else growth(run)
            rows.append([story, program, 3, steps, pathlib.Path(BLOW).name, f"{abs(rate / growth(reference) - 1):.3g}", f"{rate:.6g}", "",
                         f"{run.number(r'([0-9.]+) Newton iterations'):.2f}", f"{run.number(r'and ([0-9.]+) factorizations'):.2f}",
                         f"{sum(run.sizes['rejections']):.0f}" if "rejections" in run.sizes else "",
                         f"{min(r.processor for r in several):.3g}", f"{min(r.user for r in several):.3g}", run.why])
            print(*rows[-1][1:4], *rows[-1][5:], flush=True)
    print("growth rate of the reference:", growth(reference))
    return rows


def table_blow(story):
    print("| steps a turn | program | growth rate [1/s] | error | iterations a step | factorisations a step | time [s] | |")
    print("|---|---|---|---|---|---|---|---|")
    for r in kept():
        if r["story"] == story:
            print(f"| {r['steps a turn']} | {r['program']} | {r['value']} | {r['error']} | {r['iterations a step']} |"
                  f" {r['factorisations a step']} | {r['processor time [s]']} | {r['why']} |")


TRIMS = {"prm/rotorcraft/puma_flight.prm": [24, 36, 60], "prm/rotorcraft/puma_elastic_flight.prm": [20, 24, 36, 60]}
FINEST = 120  # of trims


def measure_trim(story):
    rows = []
    for path, several in TRIMS.items():
        entries = lambda n: ["Analyses = trim", f"Trim/Steps = {n}"]
        reference = Run("after", path, entries(FINEST))
        for steps in (*several, FINEST):
            for program in PROGRAMS:
                run = reference if steps == FINEST and program == "after" else Run(program, path, entries(steps))
                found = not run.returncode and len(run.trim.get("value", [])) > 0
                e = np.degrees(max(abs(run.trim["value"][:3] - reference.trim["value"][:3]))) if found else math.nan
                rows.append([story, program, 3, steps, pathlib.Path(path).name, f"{e:.3g}", "", "",
                             f"{run.summary['iterations'][0] / run.summary['steps'][0]:.2f}" if found else "",
                             f"{run.summary['factorizations'][0] / run.summary['steps'][0]:.2f}" if found else "",
                             f"{run.summary['steps'][0]:.0f}" if found else "", "", f"{run.user:.3g}", "" if found else run.why or "no trim"])
                print(*rows[-1][1:6], *rows[-1][8:], flush=True)
    return rows


def table_trim(story):
    print("| model | steps a turn | program | largest error of a control [°] | iterations a step | factorisations a step | user time [s] | |")
    print("|---|---|---|---|---|---|---|---|")
    for r in kept():
        if r["story"] == story:
            print(f"| {r['probe']} | {r['steps a turn']} | {r['program']} | {r['error']} | {r['iterations a step']} |"
                  f" {r['factorisations a step']} | {r['user time of the process [s]']} | {r['why']} |")


STORIES = {name: (lambda name=name: measure(name), lambda name=name: draw(name), lambda name=name: table(name)) for name in MODELS}
STORIES["multipliers"] = (lambda: measure_multipliers(MULTIPLIERS, "multipliers"), lambda: draw_multipliers("multipliers"),
                          lambda: table_multipliers("multipliers"))
STORIES["slow_multipliers"] = (lambda: measure_multipliers(SLOW, "slow_multipliers"), lambda: None,
                               lambda: table_multipliers("slow_multipliers"))
STORIES["blow"] = (lambda: measure_blow("blow"), lambda: None, lambda: table_blow("blow"))
STORIES["trim"] = (lambda: measure_trim("trim"), lambda: None, lambda: table_trim("trim"))


def make(parts, drawn):
    global DRAWN
    DRAWN = drawn
    for wanted in parts or (["rod"] if SHORT else STORIES):
        if wanted not in STORIES:
            raise SystemExit(f"no story {wanted}; there are " + ", ".join(STORIES))
        take, paint, tell = STORIES[wanted]
        print("--", wanted, flush=True)
        rows = [] if drawn else take()
        if rows and not SHORT:
            keep(wanted, rows)
        paint()
        tell()
    if not parts and not SHORT:
        summary()
