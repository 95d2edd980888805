"""The charts and tables of applications/rotor_real_time.md: how exact steps are that keep pace with a rotor.

The SA 330 and the NREL 5 MW rotor with one, two and three stages and 24 to 240 steps a turn; three minutes."""

from figures_of.common import BLUE, ORANGE, RED, SMALL, Run, few, into_page, np, plt, read, save, table, update


MEMBERS = (1, (60, 120, 240)), (2, (36, 60, 120, 240)), (3, (24, 36, 60, 120))
FINEST = (2, 36) if SMALL else (3, 240)  # the reference
# the turn that is looked at is the last one; loads: columns of the history
ROTORS = {
    "SA 330": {"file": "rotorcraft/puma_real_time.prm", "end": "{turns}*T", "step": "T/{steps}", "turns": 4,
               "loads": ("flow.thrust", "flow.torque")},
    "NREL 5 MW": {"file": "rotorcraft/nrel_5mw_shear.prm", "end": "{turns}*2*pi/Omega", "step": "2*pi/Omega/{steps}", "turns": 3,
                  "loads": ("flow.thrust", "flow.power")}}
KEPT = "applications/rotor_real_time.csv"


def run(rotor, stages, steps):
    """Loads at twelve azimuths of the last turn, least processor time of three runs over the time that is followed, iterations a step."""
    what = ROTORS[rotor]
    entries = (f"Dynamic/Stages = {stages}", "Dynamic/Step = " + what["step"].format(steps=steps), "Dynamic/Newton tolerance = 1e-6",
               "Dynamic/End time = " + what["end"].format(turns=what["turns"]))
    runs = [Run(what["file"], *entries) for _ in few(range(3))]
    done = runs[-1]
    at = [-1 - k * steps // 12 for k in range(12)]
    loads = np.array([[done.dynamic[name][k] for name in what["loads"]] for k in at])
    seconds = min(run.number(r", ([\d.]+) s of the processor; the energy") for run in runs)
    return loads, seconds / done.dynamic["t"][-1], f"{done.number(r'([0-9.]+) Newton iterations'):g}"


def measure():
    for rotor in few(list(ROTORS)):
        exact, _, _ = run(rotor, *FINEST)
        for stages, numbers in few(MEMBERS):
            for steps in few(numbers):
                loads, seconds, iterations = run(rotor, stages, steps)
                errors = np.sqrt(np.mean((loads - exact)**2, axis=0)) / abs(exact.mean(axis=0))
                yield {"rotor": rotor, "stages": stages, "steps a turn": steps, "error of thrust": f"{errors[0]:.2g}",
                       "error of torque": f"{errors[1]:.2g}", "iterations": iterations, "processor over real time": f"{seconds:.3g}"}


def draw(rows):
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained", sharey=True)
    for ax, rotor in zip(axes, ROTORS):
        for stages, color in zip("123", (ORANGE, RED, BLUE)):
            chosen = [row for row in rows if row["rotor"] == rotor and row["stages"] == stages]
            time, error = np.array([(float(row["processor over real time"]), float(row["error of thrust"])) for row in chosen]).T
            ax.loglog(time, error, color=color, marker="o", ms=4, label=f"s = {stages}")
            for row, x, y in zip(chosen, time, error):
                ax.annotate(row["steps a turn"], (x, y), xytext=(4, 4), textcoords="offset points", fontsize=8, color=color)
        ax.set_title(rotor)
        ax.set_xlabel("processor time over the time followed")
    axes[0].axvline(1, color="0.6", ls="--", lw=0.8)
    axes[0].set_ylabel("error of thrust over its mean")
    axes[1].legend()
    save(figure, "rotor_real_time.png", 130)


def print_tables(rows):
    for rotor in ROTORS:
        into_page("applications/rotor_real_time.md", rotor, table(
            "stages | steps a turn | error of thrust | of torque | iterations a step | processor over real time",
            [[row["stages"], row["steps a turn"], f"{100 * float(row['error of thrust']):.2g} %", f"{100 * float(row['error of torque']):.2g} %",
              row["iterations"], row["processor over real time"]] for row in rows if row["rotor"] == rotor]))


def make(parts, drawn):
    rows = read(KEPT) if drawn else update(KEPT, measure(), ["rotor", "stages", "steps a turn"])
    draw(rows)
    print_tables(rows)
