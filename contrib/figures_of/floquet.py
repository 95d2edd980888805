"""The picture of theory/floquet.md: work and precision of multipliers and hub loads.

Multipliers: bench_multipliers (contrib/bench builds it). Hub loads: prm/rotorcraft/puma_one_blade.prm for 30
turns from the same start with each scheme; the error is that of the fourth harmonics of the three forces, the root of the sum of squares
over that of the reference: the family with three stages and 2304 steps, seen at the same instants. What the harmonics of all of its
instants differ by from those of these is the column "sampling". All numbers are kept in theory/floquet_work.csv. Seconds are those of
the processor. Takes some minutes."""

import csv
import sys

from figures_of.common import SMALL, Run, few, np, plt, program, read, save, update


KEPT = "theory/floquet_work.csv"
MODEL = "rotorcraft/puma_one_blade.prm"
TURNS = 1 if SMALL else 30
FINE = 144 if SMALL else 2304  # steps of the reference
COLUMNS = ["quantity", "scheme", "stages", "spectral radius", "tangent", "steps", "tolerance", "error", "sampling", "turns", "iterations", "seconds"]


def multipliers():
    output = None if SMALL else program("benchmarks/bench_multipliers")
    if output is None:
        return [row for row in read(KEPT) if row["quantity"] == "multiplier"]
    return [{**{name: row.get(name, "") for name in COLUMNS}, "quantity": "multiplier"} for row in csv.DictReader(output.splitlines())]


def hub_loads(scheme, stages, rho, steps, tolerance):
    """Forces of the hub in the last turn, iterations, seconds; nothing if the run fails."""
    entries = ["Analyses = static, dynamic", "Threads = 1", "Constants/turns = %d" % TURNS, "Dynamic/Step = T/%d" % steps,
               "Dynamic/Integrator = " + scheme, "Dynamic/Stages = %d" % stages, "Dynamic/Spectral radius = %g" % rho,
               "Dynamic/Newton tolerance = 1e-11", "Dynamic/Energy balance = warn"]
    if tolerance:
        entries.append("Dynamic/Tolerance = %g" % tolerance)
    done = Run(MODEL, *entries, may_fail=True)
    if done.code:
        print(f"{scheme}, {steps} steps: {done.text.strip().splitlines()[-1]}", file=sys.stderr)
        return None
    forces = np.array([next(values for name, values in done.dynamic.items() if name.startswith(f"hub:shaft.force {k}"))[-steps:] for k in (1, 2, 3)])
    count = done.number(r"([\d.]+) Newton") * done.number(r"(\d+) steps")
    return forces, round(count), done.processor


def fourth(forces):
    """Fourth harmonics."""
    steps = forces.shape[1]
    return 2 / steps * forces @ np.exp(-4j * 2 * np.pi * np.arange(1, steps + 1) / steps)


def loads():
    family = [("family", s, rho, n, 0) for rho in (1, 0.5) for s in (1, 2, 3) for n in (24, 36, 48, 72, 96, 144, 192, 384) if s < 3 or n <= 192]
    classical = [(name, 1, rho, n, 0) for name, rho in (("generalised alpha", 1), ("generalised alpha", 0.5), ("trapezoidal", 1),
                 ("energy decaying", 0)) for n in (48, 96, 192, 384, 768)]
    bdf = [("BDF index 2", 1, 0.5, 48, tolerance) for tolerance in (1e-4, 1e-5, 1e-6, 1e-7, 1e-8)]
    reference = hub_loads("family", 3, 1, FINE, 0)[0]
    size = np.linalg.norm(fourth(reference))
    rows = []
    for case in few(family + classical + bdf):
        found = hub_loads(*case)
        if found:
            part = FINE // case[3]
            seen = fourth(reference[:, part - 1::part])
            error, sampling = np.linalg.norm(fourth(found[0]) - seen) / size, np.linalg.norm(seen - fourth(reference)) / size
            rows.append(dict(zip(COLUMNS, ("hub loads", case[0], case[1], case[2], "", case[3], case[4], "%.3e" % error, "%.3e" % sampling,
                                           TURNS, found[1], "%.3f" % found[2]))))
            print(rows[-1], flush=True)
    return rows


def draw(rows):
    styles = [("family", "1", "1", "differences", "midpoint rule, s = 1", "#7fb2e5", "-o"),
              ("family", "2", "1", "differences", "s = 2", "#3b7fc4", "-o"), ("family", "3", "1", "differences", "s = 3", "#103f75", "-o"),
              ("family", "3", "0.5", "differences", "s = 3, ρ∞ = 0.5", "#103f75", "--s"),
              ("family", "3", "1", "exact", "s = 3, exact tangents", "#103f75", ":^"),
              ("generalised alpha", "1", "1", "differences", "generalised α, ρ∞ = 1 (and trapezoidal)", "#d1495b", "-v"),
              ("generalised alpha", "1", "0.5", "differences", "generalised α, ρ∞ = 0.5", "#e58e9a", "--v"),
              ("energy decaying", "1", "0", "differences", "energy decaying", "#e9a03b", "-d"),
              ("BDF index 2", "1", "0.5", "differences", "BDF, index 2", "#2a9d5c", "-x")]
    figure, axes = plt.subplots(2, 2, figsize=(10.5, 9), layout="constrained", sharey="row")
    for axes_of, quantity, label in zip(axes, ("multiplier", "hub loads"), ("error of a multiplier", "error of 4/rev hub loads, relative")):
        for scheme, stages, rho, tangent, name, color, style in styles:
            if quantity == "hub loads" and tangent == "exact":
                continue
            chosen = [r for r in rows if r["quantity"] == quantity and r["scheme"] == scheme and str(r["stages"]) == stages
                      and "%g" % float(r["spectral radius"]) == rho and r["tangent"] in (tangent, "")]
            for ax, column in zip(axes_of, ("seconds", "iterations")):
                pairs = [(float(r[column]), float(r["error"])) for r in chosen if float(r["error"]) < 1]
                if pairs:
                    ax.loglog(*zip(*pairs), style, color=color, ms=4, lw=1.3, label=name, markerfacecolor="none" if style[0] == ":" else color)
        if quantity == "hub loads":
            chosen = [r for r in rows if r["quantity"] == quantity and r["scheme"] == "family" and str(r["stages"]) == "2"
                      and float(r["spectral radius"]) == 1]
            for ax, column in zip(axes_of, ("seconds", "iterations")):
                ax.loglog([float(r[column]) for r in chosen], [float(r["sampling"]) for r in chosen], ":", color="0.5", lw=1.5,
                          label="sampling at the steps of s = 2")
        axes_of[0].set(ylabel=label, xlabel="time of the processor [s]")
        axes_of[1].set(xlabel="Newton iterations, each with one solution")
    handles, labels = axes[1, 1].get_legend_handles_labels()
    more, names = axes[0, 1].get_legend_handles_labels()
    handles += [h for h, name in zip(more, names) if name not in labels]
    labels += [name for name in names if name not in labels]
    figure.legend(handles, labels, fontsize=9, loc="lower center", ncols=4)
    figure.get_layout_engine().set(rect=(0, 0.09, 1, 0.91))
    axes[0, 0].set_title("Flap-lag blade in forward flight")
    axes[1, 0].set_title("One blade of the SA 330, %d turns" % TURNS)
    save(figure, "floquet_work_precision.png")


def make(parts, drawn):
    draw(read(KEPT) if drawn else update(KEPT, multipliers() + loads(), COLUMNS[:7]))
