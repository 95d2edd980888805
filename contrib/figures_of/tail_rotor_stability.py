"""Stability of the tail rotor transmission at constant speeds, two figures of applications/tail_rotor_transmission.md.

For each speed the model prm/rotorcraft/tail_rotor_stability.prm gets a light blow and runs for 20 s. The motion, sampled each
half turn, obeys x(n+1) = A x(n) with a constant A if the shaft is straight and balanced, because supports and shaft look the
same after half a turn (Floquet). Eigenvalues of A, found by least squares from the samples and their predecessors, give the
growth rates. Multipliers of prm/rotorcraft/tail_rotor_tongues.prm tell the same without runs and fits. For comparison: Floquet
theory of four modes, whose frequencies with the shaft at azimuths 0 and 90 degrees are from samara's modal analysis. A second
figure shows the run of the paper continued to 20 s. About twenty minutes; results are kept in results/tail_rotor_stability."""

from figures_of.common import BLUE, GREEN, ORANGE, RED, SMALL, Run, few, into_page, np, plt, results, runge_kutta, save, table


MODEL = "rotorcraft/tail_rotor_stability.prm"
TONGUES = "rotorcraft/tail_rotor_tongues.prm"
UNBALANCED = "rotorcraft/tail_rotor_transmission.prm"
END = 2 if SMALL else 20  # [s]
COARSE = ["Floquet/Steps = 8", "Floquet/Wanted = 2"] if SMALL else []
ZONE = (46.9, 49.1)
STEPS = 32  # a turn
SPEEDS = [45, 46, 47, 47.1, 47.2, 47.3, 47.4, 47.6, 47.75, 47.85, 47.94, 48, 48.05, 48.1, 48.2, 48.4, 48.5, 48.6, 48.7, 48.8]
SPEEDS += [48.9, 49, 49.25, 49.5, 49.55, 49.62, 49.7, 49.8, 50, 50.25, 50.3, 50.38, 50.45, 50.5, 50.6, 51, 51.5, 52, 52.04]
SPEEDS += [52.1, 52.2, 53]
SHOWN = ((45, BLUE), (48, ORANGE), (48.7, RED), (51, GREEN))
PROBES = ", ".join(
    f"{place}.{quantity} {i}"
    for place in ("shaft 1.middle", "tail.end", "shaft 1.at 0.25")
    for quantity in ("displacement", "velocity")
    for i in "yz"
)


def samara(folder, model, *entries):
    """A run whose results are kept."""
    return Run(model, *entries, keep=results("tail_rotor_stability") / folder)


def motion(speed):
    step = 2 * np.pi / speed / STEPS
    end = round(END / step / STEPS) * STEPS * step
    found = samara(
        f"speed_{speed:g}",
        MODEL,
        f"Constants/speed = {speed:.12g} rad/s",
        f"Dynamic/Step = {step:.15g}",
        f"Dynamic/End time = {end:.15g}",
        "Output/Probes = " + PROBES,
    )
    return np.column_stack(list(found.dynamic.values()))


def by_multipliers(speed):
    """The largest growth rate [1/s] by the multipliers of a turn of the rotor."""
    return max(samara(f"multipliers_{speed:g}", TONGUES, f"Constants/speed = {speed:.12g} rad/s", *COARSE).floquet["growth rate"])


def exponents(table, speed, after=0.5, delays=4, cut=1e-6):
    """Exponents [1/s] of the motion from its samples, the fastest growing first."""
    samples = table[:: STEPS // 2]
    samples = samples[samples[:, 0] > after, 1:]
    samples = samples / np.abs(samples).max(axis=0)
    n = len(samples) - delays
    states = np.hstack([samples[i : i + n] for i in range(delays + 1)])
    u, s, vt = np.linalg.svd(states[:-1], full_matrices=False)
    kept = s > cut * s[0]
    matrix = (u[:, kept].T @ states[1:] @ vt[kept].T) / s[kept][:, None]
    found = np.log(np.linalg.eigvals(matrix).astype(complex)) * speed / np.pi
    return found[np.argsort(-found.real)]


def four_modes():
    """Frequencies [rad/s] of the four modes at both azimuths, mean damping terms 2 d w."""
    frequencies, dampings = [], []
    for azimuth in (0, 90):
        modes = samara(
            f"azimuth_{azimuth}",
            UNBALANCED,
            "Sections/shaft/Mass centre = 0, 0",
            "Analyses = static, modal",
            f"Loads/drive/Azimuth = {azimuth} deg",
            "Modal/Axes = fixed",
            "Modal/Animations = 0",
        ).modes
        near = (45.5 < modes["frequency"]) & (modes["frequency"] < 75)
        frequencies.append(modes["frequency"][near])
        dampings.append(-2 * modes["real"][near])
    return np.array(frequencies), np.mean(dampings, axis=0)


def floquet(speed, frequencies, damping, n=60):
    """Largest growth rate of the four modes, coupled by the difference of the two bending stiffnesses that turns along.

    At azimuth phi the stiffness is mean + (v v' - s s') cos 2 phi + (v s' + s v') sin 2 phi, where v and s are how much each
    mode bends the shaft vertically and sideways; half the difference of the squared frequencies is v^2 or -s^2.
    """
    squares = frequencies**2
    half = 0.5 * (squares[0] - squares[1])
    v, s = (np.sqrt(np.maximum(sign * half, 0)) for sign in (1, -1))
    mean, cosine, sine = np.diag(squares.mean(axis=0)), np.outer(v, v) - np.outer(s, s), np.outer(v, s) + np.outer(s, v)
    size = len(mean)

    def rate(t, x):
        stiffness = mean + cosine * np.cos(2 * speed * t) + sine * np.sin(2 * speed * t)
        return np.vstack([x[size:], -stiffness @ x[:size] - damping[:, None] * x[size:]])

    x = runge_kutta(rate, np.eye(2 * size), 0, np.pi / speed, n)
    return np.log(np.abs(np.linalg.eigvals(x)).max()) * speed / np.pi


def draw(rates, multipliers, fine, curve, frequencies):
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(11, 4.4), layout="constrained", gridspec_kw={"width_ratios": [1, 1.5]}
    )
    for speed, color in few(SHOWN):
        table = motion(speed)
        t, distance = table[:, 0], 1e3 * np.hypot(table[:, 1], table[:, 2])
        turn = len(t) // STEPS
        top = distance[: turn * STEPS].reshape(turn, STEPS).max(axis=1)
        left.plot(t[: turn * STEPS : STEPS], np.where(top > 1e-4, top, np.nan), color=color, ls="-", label=f"{speed:g} rad/s: {rates[speed]:+.4f} 1/s".replace("-", "−"))
    left.set_yscale("log")
    left.set_ylim(0.02, 4)
    left.set_xlabel("t [s]")
    left.set_ylabel("distance of the middle of shaft 1 [mm]")
    left.legend(loc="upper left", title="growth rate")
    left.set_title("After a light blow, most in a turn", loc="left", fontsize=11)

    right.axvspan(*ZONE, color="#d1495b", alpha=0.10, lw=0, label="unstable in the paper")
    right.plot(fine, curve, color="0.45", ls="-", lw=1.1, label="Floquet theory, four modes")
    right.plot(list(multipliers), list(multipliers.values()), "o", ls="", ms=4, color="#1f5fa8", label="multipliers")
    right.plot(list(rates), list(rates.values()), "o", ls="", ms=7, mfc="none", mec="#e08e1b", mew=0.9, label="fits to runs in time")
    names = ["s₁", "v₁", "s₂", "v₂"]
    mean = np.sqrt((frequencies**2).mean(axis=0))
    for i in range(4):
        for j in range(i, 4):
            place = 0.5 * (mean[i] + mean[j])
            near = np.abs(fine - place) < 0.3
            if fine[0] < place < fine[-1] and near.any() and curve[near].max() > 0.02:
                right.text(place, curve[near].max() + 0.012, f"{names[i]}+{names[j]}", ha="center", fontsize=9, color="0.3")
    right.set_ylim(-0.02, 0.3)
    right.set_xlim(fine[0], fine[-1])
    right.set_xlabel("speed [rad/s]")
    right.set_ylabel("growth rate [1/s]")
    right.legend(loc="upper right")
    right.set_title("Largest growth rate; unstable where 2Ω is the sum of two frequencies", loc="left", fontsize=11)
    save(figure, "tail_rotor_stability.png")


def draw_continued(fine, curve):
    """The run of the paper, free to turn, for 20 s; shaded where a balanced shaft is unstable."""
    run = samara(
        "continued",
        UNBALANCED,
        "Analyses = static, dynamic",
        f"Dynamic/End time = {END} s",
        "Dynamic/Step = 2e-3",
        "Output/Probes = shaft 1.middle.displacement y, shaft 1.middle.displacement z, S.rotation rate",
    )
    t, y, z, speed = run.dynamic.values()
    figure, axes = plt.subplots(2, 1, figsize=(8.5, 4.6), sharex=True, layout="constrained")
    axes[0].plot(t, 1e3 * np.hypot(y, z), color="#1f5fa8", ls="-", lw=0.7)
    axes[0].set_ylabel("distance [mm]")
    axes[0].set_ylim(0, None)
    axes[0].set_title("Middle of shaft 1, the run of the paper continued", loc="left", fontsize=11)
    edges = np.flatnonzero(np.diff((curve > 0.001).astype(int)))
    for low, high in zip(fine[edges[::2]], fine[edges[1::2]]):
        axes[1].axhspan(low, high, color="#d1495b", alpha=0.15, lw=0)
    axes[1].plot(t, speed, color="#1f5fa8", ls="-", lw=0.9)
    axes[1].set_ylabel("speed [rad/s]")
    axes[1].set_ylim(46.5, 51)
    axes[1].set_title("Speed of shaft 1; shaded: unstable at constant speed", loc="left", fontsize=11)
    axes[1].set_xlabel("t [s]")
    axes[1].set_xlim(0, t[-1])
    figure.align_ylabels(axes)
    save(figure, "tail_rotor_continued.png")


def make(parts, drawn):
    frequencies, damping = four_modes()
    print("frequencies at azimuth 0, 90, and of the mean stiffness:", *frequencies, np.sqrt((frequencies**2).mean(axis=0)))
    rates, multipliers, rows = {}, {}, []
    for speed in few(SPEEDS):
        multipliers[speed] = by_multipliers(speed)
        rates[speed] = exponents(motion(speed), speed)[0].real
        rows.append([f"{speed:g}", f"{multipliers[speed]:+.4f}", f"{rates[speed]:+.4f}", f"{floquet(speed, frequencies, damping):+.4f}"])
    into_page("applications/tail_rotor_transmission.md", "growth rates", table("speed | multipliers | runs in time | four modes", rows))
    fine = np.arange(44.5, 53.5, 0.5 if SMALL else 0.01)
    curve = np.array([floquet(speed, frequencies, damping) for speed in fine])
    draw(rates, multipliers, fine, curve, frequencies)
    draw_continued(fine, curve)
