"""Pictures and numbers of benchmarks/stability.md: where integrators and elements fail. Parts: names of pictures.

A quarter of an hour."""

import math
import re

from figures_of import common
from figures_of.common import BLUE, BROWN, CYAN, GREEN, GREY, ORANGE, PURPLE, RED, few, np, plt, save, scheme as family


HERE = "stability/"

def rival(name, rho=1.0, tolerance=1e-4):
    return [f"Dynamic/Integrator = {name}", f"Dynamic/Spectral radius = {rho}", f"Dynamic/Tolerance = {tolerance}"]


# name: (entries, colour, marker); the family is drawn with full lines and filled markers
METHODS = {
    "family s = 1, ρ∞ = 1 (midpoint)": (family(1, 1), BLUE, "o"),
    "family s = 2, ρ∞ = 1": (family(2, 1), CYAN, "s"),
    "family s = 2, ρ∞ = 0": (family(2, 0), GREEN, "^"),
    "family s = 3, ρ∞ = 0.5": (family(3, 0.5), PURPLE, "D"),
    "trapezoidal": (rival("trapezoidal"), RED, "x"),
    "generalised α, ρ∞ = 1": (rival("generalised alpha", 1), BROWN, "1"),
    "generalised α, ρ∞ = 0.5": (rival("generalised alpha", 0.5), ORANGE, "+"),
    "generalised α, ρ∞ = 0": (rival("generalised alpha", 0), "#c9b037", "4"),
    "energy decaying, ρ∞ = 0": (rival("energy decaying", 0), "k", "2"),
    "BDF index 2, 1e-4": (rival("BDF index 2"), GREY, "3"),
    "BDF index 1, 1e-4": (rival("BDF index 1"), "#b07aa1", "|"),
}


def line(name):
    """How curves of a method look."""
    _, color, marker = METHODS[name]
    ours = name.startswith("family")
    return dict(color=color, marker=marker, ls="-" if ours else (0, (4, 1.2)), ms=6, mfc=color if ours else "none", label=name)


class Run(common.Run):
    """A run with a limit on its time: columns of the probes (`of`), energies (`energy`), the end, and what it took."""

    def __init__(self, model, *entries, seconds=60):
        super().__init__(f"benchmarks/{model}.prm", *entries, limit=3 if common.SMALL else seconds, may_fail=True)
        self.energies = self.dynamic_energy
        self.sizes, self.returncode = self.dynamic_steps, self.code

    def of(self, probe):
        return self.dynamic[probe]

    @property
    def energy(self):
        return sum(self.energies[what] for what in ("kinetic", "strain", "potential"))

    @property
    def end(self):
        return self.dynamic["t"][-1]

    @property
    def work(self):
        """Steps, iterations a step, seconds; of runs that ended."""
        return (self.number(r"dynamic: (\d+) steps"), self.number(r"([\d.]+) Newton iterations"), self.processor)


def vectors(run, probe):
    return np.stack([run.of(f"{probe} {c}") for c in "xyz"], 1)


def two_axes():
    """Two axes and, for `legend_beside`, room for one legend of both."""
    figure, axes = plt.subplots(1, 3, figsize=(12.5, 4.6), layout="constrained", gridspec_kw={"width_ratios": [1, 1, 0.5]})
    axes[2].axis("off")
    return figure, axes[:2]


def legend_beside(figure):
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.axes[2].legend(handles, labels, loc="center left", bbox_to_anchor=(-0.2, 0.5), fontsize=9, frameon=False)


# ------------------------------------------------------------------ the stories


def stiff_spring_pendulum():
    """Largest energy, error of the tension, against h omega."""
    model = HERE + "stiff_spring_pendulum"
    values = few([1000, 1, 3, 10, 30, 100, 1e4, 1e5])
    names = few([n for n in METHODS if not n.startswith("BDF index 1")])
    figure, (left, right) = two_axes()
    histories = {}
    for name in names:
        growth, tension, ends, work = [], [], [], []
        for fast in values:
            run = Run(model, *METHODS[name][0], f"Constants/fast = {fast}", "Dynamic/Smallest step = 1e-6", seconds=30)
            lowest = -9.81  # of the potential energy
            change = (run.energy - run.energy[0]) / (run.energy[0] - lowest)
            growth.append(change[np.argmax(abs(change))])
            x, y = run.of("bob.position x"), run.of("bob.position y")
            rigid = run.of("bob.velocity x") ** 2 + run.of("bob.velocity y") ** 2 - 9.81 * y
            half = run.of("t") > run.end / 2
            tension.append(np.sqrt(np.mean((run.of("coil.force") - rigid)[half] ** 2)) / np.sqrt(np.mean(rigid[half] ** 2)))
            ends.append(run.end if run.returncode else math.nan)
            work.append(run.work[1])
            if fast == 1000:
                histories[name] = run.of("t"), run.of("coil.force"), rigid
        left.plot(values, np.maximum(np.abs(growth), 1e-14), **line(name))
        failed = ~np.isnan(ends)
        left.plot(np.array(values)[failed], np.maximum(np.abs(growth), 1e-14)[failed], ls="", marker="X", ms=11, color=RED,
                  mec="w", zorder=9)
        print(f"{name:32}", "energy", *("%9.2g" % g for g in growth))
        print(f"{'':32}", "tension", *("%9.2g" % t for t in tension))
        print(f"{'':32}", "stops", *("%9.3g" % e for e in ends), " iterations", *("%.1f" % w for w in work))
    left.set_xscale("log")
    left.set_yscale("log")
    left.set_xlabel("hω, radians of the fast vibration a step")
    left.set_ylabel("largest change of the energy, relative")
    left.set_title("Energy in 10 s (thick crosses: the run stopped)", loc="left", fontsize=11)
    for name, color in few((("family s = 1, ρ∞ = 1 (midpoint)", BLUE), ("family s = 2, ρ∞ = 0", GREEN))):
        t, force, _ = histories[name]
        right.plot(t, force, color=color, lw=1, ls="-", label=name)
    t, _, rigid = histories[name]
    right.plot(t, rigid, color="k", lw=1, ls=(0, (1, 1.5)), label="rigid rod, from the motion of the second")
    right.set_xlim(0, 3)
    right.set_ylim(-150, 250)
    right.set_xlabel("t [s]")
    right.set_ylabel("force of the spring [N]")
    right.set_title("hω = 1000: what preserves energy rings", loc="left", fontsize=11)
    right.legend(loc="upper right", fontsize=8)
    legend_beside(figure)
    save(figure, "stability_stiff_spring_pendulum.png", colours=256)


def spinning_blade():
    """Energy over revolutions at 5 degrees a step, from the steady state and from the unstretched blade."""
    model = HERE + "spinning_blade"
    lengths = {name: 20 if common.SMALL or name.startswith("BDF") else 1000 for name in METHODS}
    figure, axes = two_axes()
    for ax, analyses, title in ((axes[0], "static, dynamic", "from the steady state"),
                                (axes[1], "dynamic", "from the unstretched blade")):
        print(title)
        for name, n in few(lengths).items():
            run = Run(model, *METHODS[name][0], f"Constants/revolutions = {n}", f"Dynamic/Output every = {max(1, n // 50)}",
                      f"Analyses = {analyses}", "Dynamic/Smallest step = 1e-6", seconds=90)
            E = run.energy / run.energy[0]
            revolutions = run.energies["t"] * 20 / (2 * math.pi)
            ax.plot(revolutions[1:], np.maximum(abs(E - 1), 1e-16)[1:], **{**line(name), "marker": None})
            if run.returncode:
                ax.plot(revolutions[-1], abs(E[-1] - 1), ls="", marker="X", ms=11, color=line(name)["color"], mec="w", zorder=9)
            print(f"{name:32} after {revolutions[-1]:7.4g} revolutions {1 - E[-1]:10.3g} lost, largest change {max(abs(1 - E)):.3g},"
                  f" after the first {1 - np.interp(1, revolutions, E):10.3g}, {run.work[1]:.1f} iterations a step,"
                  f" {run.work[2]:.3g} s {run.why}")
        z = 5 * math.pi / 180
        n = np.geomspace(1, 72000, 100)
        ax.plot(n / 72, 1 - 1 / (1 + n * z * z), color="0.5", lw=4, alpha=0.4, ls="-", label="1 − 1/(1 + N z²), z = 5°", zorder=0)
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlim(0.3, 1000)
        ax.set_ylim(1e-16, 1e3)
        ax.set_xlabel("revolutions")
        ax.set_ylabel("change of the energy, relative")
        ax.set_title(title, loc="left", fontsize=11)
    legend_beside(figure)
    save(figure, "stability_spinning_blade.png", colours=256)


def slider_crank():
    """Loss per revolution against the step."""
    model = "dynamics/slider_crank"
    steps = few([0.02, 0.01, 0.005, 0.0025])
    probes = "Output/Probes = crank.angular velocity x"
    names = few(list(METHODS))
    figure, ax = plt.subplots(figsize=(10, 5), layout="constrained")
    for name in names:
        losses = []
        for h in steps:
            run = Run(model, *METHODS[name][0], "Loads/weight/Acceleration = 0, 0, 0", probes, f"Dynamic/Step = {h}",
                      "Dynamic/Smallest step = 1e-6", "Dynamic/Newton tolerance = 1e-10", seconds=30)
            speed, t = run.of("crank.angular velocity x"), run.of("t")
            turns = np.concatenate(([0], np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(t)))) / (2 * math.pi)
            E = run.energy
            # of a revolution, as if each took the same part; what is gained counts negative
            losses.append(1 - (max(E[-1], 1e-9) / E[0]) ** (1 / turns[-1]) if turns[-1] > 0.5 else math.nan)
            if run.returncode:
                print(f"    {name}, h = {h}: stops at {run.end:.4g} s, {run.why}, energy {E[-1] / E[0]:.3g} of the start")
        print(f"{name:32}", *("%10.2g" % l for l in losses), f"  {turns[-1]:.1f} revolutions")
        losses = np.array(losses)
        ax.plot(steps, np.maximum(abs(losses), 1e-14), **line(name))
        ax.plot(np.array(steps)[losses < -1e-12], -losses[losses < -1e-12], ls="", marker="o", ms=13, mfc="none", mec=RED)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xticks(steps, [f"{h:g}" for h in steps])
    ax.minorticks_off()
    ax.set_xlabel("step [s]")
    ax.set_ylabel("part of the energy lost in a revolution")
    ax.set_title("Circles: gained", loc="left", fontsize=11)
    ax.legend(loc="center left", bbox_to_anchor=(1, 0.5), fontsize=8.5)
    save(figure, "stability_slider_crank.png", colours=256)


def drift():
    """Gap of the joints over time, and energy."""
    model = HERE + "double_pendulum"
    cases = {
        "family s = 2, ρ∞ = 1": METHODS["family s = 2, ρ∞ = 1"],
        "generalised α, ρ∞ = 0.5": METHODS["generalised α, ρ∞ = 0.5"],
        "BDF index 2, 1e-4": METHODS["BDF index 2, 1e-4"],
        "BDF index 2, 1e-6": (rival("BDF index 2", 1, 1e-6), "k", "3"),
        "BDF index 1, 1e-4": METHODS["BDF index 1, 1e-4"],
        "BDF index 1, 1e-6": (rival("BDF index 1", 1, 1e-6), RED, "|"),
        "BDF index 1, 1e-8": (rival("BDF index 1", 1, 1e-8), GREEN, "|"),
    }
    figure, (left, right) = two_axes()
    for name, (entries, color, _) in few(cases).items():
        run = Run(model, *entries, f"Dynamic/End time = {2 if common.SMALL else 60}", "Dynamic/Smallest step = 1e-6", seconds=20)
        gap = np.maximum(np.linalg.norm(vectors(run, "a.end.position") -
                                        vectors(run, "b.start.position"), axis=1),
                         np.linalg.norm(vectors(run, "a.start.position"), axis=1))
        t, E = run.of("t"), run.energy
        change = abs(E - E[0]) / 6.14
        at = lambda values, when: np.interp(when, t, np.maximum.accumulate(values)) if when <= t[-1] else math.nan
        print(f"{name:24} gap at 1, 5, 20, 60 s", *("%9.2g" % at(gap, w) for w in (1, 5, 20, 60)), " energy",
              *("%9.2g" % at(change, w) for w in (1, 5, 20, 60)), f" iterations {run.work[1]:.1f}, {run.work[2]:.3g} s, ends at"
              f" {t[-1]:.4g} s {run.why}")
        style = dict(color=color, ls="-" if name.startswith("family") else (0, (4, 1.2)), label=name)
        left.plot(t[1:], np.maximum(np.maximum.accumulate(gap)[1:], 1e-16), **style)
        right.plot(run.energies["t"][1:], np.maximum(np.maximum.accumulate(change)[1:], 1e-16), **style)
        if run.returncode:
            left.plot(t[-1], max(gap), ls="", marker="X", ms=11, color=color, mec="w", zorder=9)
            right.plot(t[-1], max(change), ls="", marker="X", ms=11, color=color, mec="w", zorder=9)
    for ax, title in ((left, "largest gap of a joint so far [m]"), (right, "largest change of the energy so far, relative")):
        ax.set_yscale("log")
        ax.set_xlabel("t [s]")
        ax.set_ylabel(title)
    legend_beside(figure)
    save(figure, "stability_drift.png", colours=256)


def solvability():
    """Steps that have no solution, and what comes out, against radians a step: a heavy top."""
    model = "dynamics/heavy_top"
    speed = 150.0
    radians = few([0.25, 0.5, 0.75, 1, 1.25, 1.5, 2, 2.5, 3])
    names = few([n for n in METHODS if not n.startswith("BDF")])
    half = ["Dynamic/End time = 0.5", "Dynamic/Smallest step = 1e-6"]
    exact = Run(model, *family(3, 1), *half, "Dynamic/Step = 2.5e-4")
    places = [name for name in exact.dynamic if "position" in name]
    figure, (left, right) = two_axes()
    for name in names:
        failures, errors, work = [], [], []
        for z in radians:
            run = Run(model, *METHODS[name][0], *half, f"Dynamic/Step = {z / speed}", "Dynamic/Newton tolerance = 1e-10", seconds=20)
            good = run.returncode == 0
            failures.append(sum(run.sizes["rejections"]) / round(0.5 / (z / speed)) if good else math.nan)
            errors.append(max(abs(run.of(p)[-1] - exact.of(p)[-1]) for p in places) if good else math.nan)
            work.append(run.work[0] * run.work[1])
            if not good:
                print(f"    {name}, {z} rad: stops at {run.end:.4g} s, {run.why}")
        print(f"{name:32} halvings a step", *("%6.2f" % f for f in failures), " error [m]", *("%8.2g" % e for e in errors),
              " iterations", *("%.0f" % w for w in work))
        left.plot(radians, failures, **line(name))
        right.plot(radians, errors, **line(name))
    adaptive = Run(model, *family(3, 0.5), "Dynamic/Step control = adaptive", "Dynamic/Tolerance = 1e-3",
                   f"Dynamic/Step = {6 / speed}", "Dynamic/End time = 0.5", "Dynamic/Newton tolerance = 1e-10")
    sizes = adaptive.sizes["step"] * speed
    print("adaptive, s = 3, begun with 6 rad:", "first steps", *("%.2f" % z for z in sizes[:6]), "mean %.2f" % np.mean(sizes), "largest",
          "%.2f" % max(sizes), "without solution or rejected", sum(adaptive.sizes["rejections"]), "steps", len(sizes))
    left.set_ylabel("halvings for each step asked for")
    right.set_ylabel("error of the centre of mass after 0.5 s [m]")
    right.set_yscale("log")
    for ax in (left, right):
        ax.set_xlabel("radians of rotation a step")
    legend_beside(figure)
    save(figure, "stability_solvability.png", colours=256)


def inconsistent_velocities():
    """What the projection takes, against the angle."""
    angles = few([0.01, 1, 5, 10, 20, 30, 45, 60, 75, 85, 89], 2)
    left_over, force = [], []
    for off in angles:
        run = Run(HERE + "inconsistent_velocities", f"Constants/off = {off} deg")
        left_over.append(run.energies["kinetic"][0] / 4.5)
        force.append(max(abs(run.of("rod.force") - 9 * math.cos(math.radians(off)) ** 2)))
    closed = np.cos(np.radians(angles)) ** 2
    print("projected energy, largest error", max(abs(np.array(left_over) - closed)), "force of the rod, largest error [N]", max(force))
    warned = [a for a in angles if "do not obey" in Run(HERE + "inconsistent_velocities", f"Constants/off = {a} deg").text]
    print("warned of", warned)
    figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
    fine = np.linspace(0, 90, 200)
    ax.plot(fine, np.cos(np.radians(fine)) ** 2, color="0.4", ls="-", label="cos²")
    ax.plot(angles, left_over, color=BLUE, ls="", marker="o", label="measured")
    ax.set_xlabel("angle of the velocity off what the rod allows [°]")
    ax.set_ylabel("energy after the projection, relative")
    ax.legend()
    save(figure, "stability_inconsistent_velocities.png", colours=256)


def stop_impact():
    """Energy after one second of rebounds against the step."""
    model = HERE + "stop_impact"
    steps = few([8e-3, 4e-3, 2e-3, 1e-3, 5e-4])
    names = few([n for n in METHODS if not n.startswith("BDF")])
    figure, (left, right) = two_axes()
    for name in names:
        losses = []
        for h in steps:
            run = Run(model, *METHODS[name][0], f"Dynamic/Step = {h}", "Dynamic/Smallest step = 1e-6", seconds=6)
            lost = -run.energy[-1] / 9.81  # of what it has at the stop
            losses.append(lost if not run.returncode else math.nan)
            if run.returncode:
                print(f"    {name}, h = {h}: stops at {run.end:.4g} s, {run.why}, has lost {lost:.3g}")
            if h == 1e-3:
                change = (run.energy - run.energy[0]) / 9.81
                right.plot(run.energies["t"], change, **{**line(name), "marker": None, "lw": 1.4})
        print(f"{name:32} loses", *("%9.2g" % l for l in losses), " the budget of the last closes to", run.number(r"closes to ([\d.e+-]+)"))
        left.plot(steps, np.maximum(np.abs(losses), 1e-12), **line(name))
    right.set_xlabel("t [s]")
    right.set_ylabel("change of the energy, relative")
    right.set_ylim(-0.3, 0.3)
    right.set_title("h = 1e-3 s", loc="left", fontsize=11)
    left.set_xscale("log")
    left.set_yscale("log")
    left.set_xticks(steps, [f"{h:g}" for h in steps])
    left.minorticks_off()
    left.set_xlabel("step [s]")
    left.set_ylabel("change of the energy in 1 s, relative")
    legend_beside(figure)
    save(figure, "stability_stop_impact.png", colours=256)


def locking():
    """Error of the end against the thickness."""
    figure, ax = plt.subplots(figsize=(8, 4.4), layout="constrained")
    thickness = few([0.3, 0.1, 0.03, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6])
    for p, n, color, marker in few([(1, 8, RED, "x"), (1, 32, ORANGE, "+"), (2, 8, GREEN, "^"), (3, 4, BLUE, "o"), (3, 8, PURPLE, "D")]):
        errors, iterations = [], []
        for t in thickness:
            entries = [f"Constants/thickness = {t} m", f"Bodies/beam/Degree = {p}"]
            run = Run(HERE + "thin_cantilever", *entries, f"Bodies/beam/Elements = {n}")
            if not run.static or run.returncode:
                errors.append(math.nan)
                print(f"    p = {p}, {n} elements, thickness {t}: {run.text[-400:]}")
                continue
            # against a fine mesh of the same thickness, so that shear and extension are in it
            fine = Run(HERE + "thin_cantilever", f"Constants/thickness = {t} m", "Bodies/beam/Degree = 4", "Bodies/beam/Elements = 16")
            errors.append(abs(run.static["beam.end.displacement z"][-1] / fine.static["beam.end.displacement z"][-1] - 1)
                          if fine.static and not fine.returncode else math.nan)
            iterations.append(sum(int(i) for i in re.findall(r"(\d+) iterations", run.text)))
        print(f"p = {p}, {n:2} elements", *("%9.2g" % e for e in errors), " iterations", *iterations)
        ax.plot(1 / np.array(thickness), errors, color=color, marker=marker, ls="-", label=f"p = {p}, {n} elements")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("length over thickness")
    ax.set_ylabel("error of the displacement of the end, relative")
    ax.legend(fontsize=9, loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, "stability_locking.png", colours=256)


def free_flight():
    """Energy and angular momentum in 1e5 steps."""
    model = HERE + "free_flight"
    inertia = {"a": (2, np.diag([0.1, 0.2, 0.25])), "b": (1, np.diag([0.05, 0.12, 0.15]))}

    def momenta(run):
        """Momentum, and moment of momentum about the centre of mass."""
        P = L = centre = 0
        for body, (m, J) in inertia.items():
            x, v, w, r = (vectors(run, f"{body}.{what}") for what in ("position", "velocity", "angular velocity", "rotation"))
            turn = []
            for vector, spin in zip(np.radians(r), w):
                angle = np.linalg.norm(vector)
                n = vector / angle if angle > 0 else np.zeros(3)
                N = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
                R = np.eye(3) + math.sin(angle) * N + (1 - math.cos(angle)) * N @ N
                turn.append(R @ J @ R.T @ spin)
            P, centre = P + m * v, centre + m * x / 3
            L = L + m * np.cross(x, v) + np.array(turn)
        return P, L - np.cross(centre, P)

    names = few([n for n in METHODS if n != "BDF index 1, 1e-4" and n != "generalised α, ρ∞ = 0"])
    figure, axes = plt.subplots(2, 2, figsize=(12.5, 8), layout="constrained")
    for row, (spring, title) in enumerate(few(((10, "spring of 10 N/m, resolved"), (1e4, "spring of 10 kN/m, not resolved")))):
        print(title)
        left, right = axes[row]
        for name in names:
            run = Run(model, *METHODS[name][0], f"Joints/tie/length/Spring = {spring}", "Dynamic/Smallest step = 1e-5", seconds=45)
            if "t" not in run.dynamic or len(run.of("t")) < 2:
                print(f"{name:32} {run.why}")
                continue
            P, L = momenta(run)
            E, t, steps = run.energy, run.energies["t"] / 0.05, run.of("t") / 0.05
            dE = abs(E / E[0] - 1)
            dL, dP = (np.linalg.norm(v - v[0], axis=1) / np.linalg.norm(v[0]) for v in (L, P))
            at = lambda v, s, when: np.interp(when, s, np.maximum.accumulate(v)) if when <= s[-1] * 1.001 else math.nan
            print(f"{name:32} after 1e3, 1e4, 1e5: energy", *("%8.2g" % at(dE, t, w) for w in (1e3, 1e4, 1e5)), " moment of momentum",
                  *("%8.2g" % at(dL, steps, w) for w in (1e3, 1e4, 1e5)), " momentum", *("%8.2g" % at(dP, steps, w) for w in (1e3, 1e5)),
                  f" {run.work[1]:.1f} iterations, {run.work[2]:.3g} s, ends after {steps[-1]:.0f} steps {run.why}")
            style = {**line(name), "marker": None}
            left.plot(t[1:], np.maximum(np.maximum.accumulate(dE)[1:], 1e-16), **style)
            right.plot(steps[1:], np.maximum(np.maximum.accumulate(dL)[1:], 1e-16), **style)
            if run.returncode:
                for ax, x, y in ((left, t[-1], max(dE)), (right, steps[-1], max(dL))):
                    ax.plot(x, y, ls="", marker="X", ms=11, color=style["color"], mec="w", zorder=9)
        for ax, what in ((left, "energy"), (right, "moment of momentum")):
            ax.set_xscale("log")
            ax.set_yscale("log")
            ax.set_xlim(90, 1.2e5)
            ax.set_xlabel("steps")
            ax.set_ylabel("largest change so far, relative")
            ax.set_title(f"{what}: {title}", loc="left", fontsize=11)
    axes[0, 1].legend(loc="center left", bbox_to_anchor=(1, 0.5), fontsize=9, frameon=False)
    save(figure, "stability_free_flight.png", colours=256)


def four_bar():
    """Time at which runs get stuck, by spectral radius and Newton tolerance."""
    tolerances = few([1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13])
    radii = few([1, 0.99, 0.9, 0.5, 0])
    steps = few([0.02, 0.01, 0.005, 0.0025])
    figure, (left, right) = two_axes()
    passed = np.zeros((len(radii), len(tolerances)))
    for i, rho in enumerate(radii):
        for j, tolerance in enumerate(tolerances):
            runs = [Run("dynamics/four_bar", *family(s, rho), f"Dynamic/Newton tolerance = {tolerance}", f"Dynamic/Step = {h}",
                        "Dynamic/Smallest step = 1e-6", seconds=15) for s in (2, 3) for h in steps]
            passed[i, j] = sum(run.returncode == 0 for run in runs)
        print(f"ρ∞ = {rho:4}", *("%d" % k for k in passed[i]), "of", len(runs))
    picture = left.imshow(passed, cmap="RdYlGn", vmin=0, vmax=8, aspect="auto")
    left.grid(False)
    for (i, j), k in np.ndenumerate(passed):
        left.text(j, i, f"{k:.0f}", ha="center", va="center", fontsize=11)
    left.set_xticks(range(len(tolerances)), [f"{t:.0e}" for t in tolerances])
    left.set_yticks(range(len(radii)), [f"{r:g}" for r in radii])
    left.set_xlabel("Newton tolerance")
    left.set_ylabel("ρ∞")
    left.set_title("Runs of 8 that pass (s = 2, 3; four steps)", loc="left", fontsize=11)
    for name in few(METHODS):
        ends = []
        for h in steps:
            run = Run("dynamics/four_bar", *METHODS[name][0], f"Dynamic/Step = {h}", "Dynamic/Smallest step = 1e-6", seconds=15)
            E0 = 35.3  # about, from the lowest place
            lost = (run.energy[0] - run.energy[-1]) / E0
            ends.append(run.end)
            error = abs(run.of("coupler 1.position x")[-1] - 0.828458111533) if run.end == 10 else math.nan
            print(f"    {name:32} h = {h:6} ends at {run.end:7.4g} s, error {error:8.2g} m, has lost {lost:9.2g} of the energy,"
                  f" budget closes to {run.number(r'closes to ([0-9.e+-]+)'):.1g} {run.why}")
        right.plot(steps, ends, **line(name))
    right.set_xscale("log")
    right.set_xticks(steps, [f"{h:g}" for h in steps])
    right.minorticks_off()
    right.set_xlabel("step [s]")
    right.set_ylabel("time that is reached [s]")
    handles, labels = right.get_legend_handles_labels()
    figure.axes[2].legend(handles, labels, loc="center left", bbox_to_anchor=(-0.2, 0.5), fontsize=9, frameon=False)
    save(figure, "stability_four_bar.png", colours=256)


STORIES = {f.__name__: f for f in (stiff_spring_pendulum, spinning_blade, slider_crank, drift, solvability, inconsistent_velocities,
                                   stop_impact, locking, free_flight, four_bar)}


def make(parts, drawn):
    for wanted in parts or STORIES:
        if wanted not in STORIES:
            raise SystemExit(f"no story {wanted}; there are " + ", ".join(STORIES))
        print("--", wanted, flush=True)
        STORIES[wanted]()
