"""The table and the figure of benchmarks/laws.md: forces, springs and controllers as laws of the state, against what is known of them.

Runs four of prm/examples/laws with steps of 1, 1/2 and 1/4 of what they say, and compares the histories with the equations of
motion of one coordinate, written out here and integrated by Runge and Kutta's method of fourth order in 40 000 steps that end where
something jumps. Some ten seconds."""

from figures_of.common import BLUE, RED, SMALL, TOP, Run, few, into_page, np, plt, save, table


GREY, G = "0.45", 9.80665


def spring(t, u):  # m x" = -50 x - 2000 x^3
    return np.array([u[1], -(50 * u[0] + 2000 * u[0] ** 3) / 2])


def relay(t, u):  # between two switches the side is that of the middle
    return np.array([u[1], -1 if (t % 4) < 2 else 1])


def pendulum(t, u):  # angle from upright, its rate, the integral of -angle
    push = 2 if t >= 1 else 0
    moment = -20 * u[0] - 1.5 * u[1] + 30 * u[2]
    return np.array([u[1], (1.2 * G * 0.5 * np.sin(u[0]) + push * 0.5 * np.cos(u[0]) + moment) / 0.32, -u[0]])


def blade(t, u):  # lag, its rate, the filtered rate
    moment = 500 if 0.5 <= t < 0.6 else 0
    return np.array([u[1], (-0.3 * 40 * 900 * np.sin(u[0]) - 400 * u[2] + moment) / 140, (u[1] - u[2]) / 0.05])


def solution(f, start, ends, times):
    """u at the times, by steps within the pieces that end at @p ends."""
    u, result, n_steps = np.array(start, dtype=float), [], 400 if SMALL else 40000
    marks = sorted(set(np.round(list(times) + list(ends), 12)))
    wanted = {round(t, 12) for t in times}
    if 0 in wanted:
        result.append(u)
    for a, b in zip([0] + marks if marks[0] > 0 else marks, marks if marks[0] > 0 else marks[1:]):
        n = max(4, int(np.ceil(n_steps * (b - a) / marks[-1])))
        h = (b - a) / n
        for i in range(n):
            t, end = a + i * h, b - 1e-12  # the last evaluation is still on this side
            k1 = f(t + 1e-12, u)
            k2 = f(t + h / 2, u + h / 2 * k1)
            k3 = f(t + h / 2, u + h / 2 * k2)
            k4 = f(min(t + h, end), u + h * k3)
            u = u + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        if b in wanted:
            result.append(u)
    return np.array(result)


# file, title, equation, start, where it jumps, the columns and their factors to SI, what is drawn
SCENES = [
    ("hardening_spring", "a spring that hardens", spring, (0, 0.6), [], [("slide.displacement", 0, 1)], "x [m]"),
    ("relay", "a relay: two forces", relay, (0, 1), [2, 4, 6, 8], [("slide.displacement", 0, 1)], "x [m]"),
    ("pid_pendulum", "an inverted pendulum held by a PID controller", pendulum, (0, 0, 0), [1],
     [("hinge.rotation", 0, np.pi / 180), ("integral", 2, 1)], "angle [rad]"),
    ("lag_damper", "an active lag damper on a rotating blade", blade, (0, 0, 0), [0.5, 0.6],
     [("lag.rotation", 0, np.pi / 180), ("filtered", 2, 1)], "lag [rad]"),
]


def step_of(name):
    for line in open(TOP / f"prm/examples/laws/{name}.prm"):
        words = line.split()
        if words[:2] == ["set", "Step"]:
            return float(words[3])


def make(parts, drawn):
    figure, axes = plt.subplots(2, 2, figsize=(10, 6.4), layout="constrained")
    rows = []
    for ax, (name, title, f, start, jumps, columns, label) in zip(axes.flat, SCENES):
        h, errors = step_of(name), [[], []]
        for part in few((1, 2, 4)):
            found = Run(f"examples/laws/{name}.prm", f"Dynamic/Step = {h / part}").dynamic
            times = found["t"]
            exact = solution(f, start, [j for j in jumps if j < times[-1]], times)
            for k, (column, i, factor) in enumerate(columns):
                errors[k].append(np.abs(found[column] * factor - exact[:, i]).max() / np.abs(exact[:, i]).max())
            if part == 1:
                fine = np.linspace(0, times[-1], 801)
                curve = solution(f, start, [j for j in jumps if j < fine[-1]], fine)
                ax.plot(fine, curve[:, columns[0][1]], color=GREY, lw=1.2, ls="-", label="one equation, Runge-Kutta")
                shown = slice(None, None, max(1, len(times) // 60))
                ax.plot(times[shown], found[columns[0][0]][shown] * columns[0][2], "o", color=BLUE, ms=3.5, label="Samara")
        for (column, *_), error in zip(columns, errors):
            rows.append([f"[{name}](../../prm/examples/laws/{name}.prm), {column}", h] + [f"{e:.1e}" for e in error])
        ax.set(title=title, xlabel="t [s]", ylabel=label)
    into_page("benchmarks/laws.md", "differences", table("model | step [s] | largest difference, step | step/2 | step/4", rows))
    # what is known in closed form
    A = np.sqrt((-50 + np.sqrt(50**2 + 4 * 2000 * 0.36)) / 2000)
    axes[0, 0].axhline(A, color=RED, lw=0.8, ls="--")
    axes[0, 0].text(0.02, A * 1.04, f"turns at {A:.4f} m", color=RED, fontsize=8)
    axes[0, 0].set_ylim(-1.25 * A, 1.35 * A)
    axes[0, 1].axhline(0.5, color=RED, lw=0.8, ls="--")
    axes[0, 1].text(0.1, 0.53, "as far as v²/2 = 0.5 m, period 4 s", color=RED, fontsize=8)
    axes[0, 1].set_ylim(-0.65, 0.7)
    axes[1, 0].axvline(1, color=RED, lw=0.8, ls="--")
    axes[1, 0].text(0.95, 0.05, "2 N push\nfrom the side", color=RED, fontsize=8, ha="right")
    axes[1, 1].axvspan(0.5, 0.6, color=RED, alpha=0.15)
    axes[1, 1].text(0.48, 0.02, "500 N m\nfor 0.1 s", color=RED, fontsize=8, ha="right")
    axes[0, 0].legend(loc="lower right", fontsize=8)
    save(figure, "laws.png", 90)
