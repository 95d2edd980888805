"""Damping of the lag modes of the SA 330 against damper, advance ratio, blades and inflow: applications/puma_trim.md.

Trims each case and finds its multipliers; those that applications/puma_lag_damping.csv has are not computed again. Seconds are those of
the processor for both analyses. All together take about half an hour."""

import csv
import math

from figures_of.common import Run, few, into_page, plt, read, save, table, write


KEPT = "applications/puma_lag_damping.csv"
COLUMNS = ["blades", "inflow", "mu", "damper [N m s/rad]", "family", "pattern", "growth rate [1/s]", "frequency [rad/s]",
           "collective [deg]", "seconds"]
MODELS = {"rigid": "rotorcraft/puma_flight.prm", "elastic": "rotorcraft/puma_elastic_flight.prm"}
INFLOWS = {"uniform": ("uniform inflow", []), "Pitt & Peters": ("Pitt-Peters inflow", []),
           "Peters & He (2, 4)": ("Peters-He inflow", ["Harmonics = 2", "Power = 4"]),
           "Peters & He (4, 8)": ("Peters-He inflow", ["Harmonics = 4", "Power = 8"])}
DAMPERS = (500, 2000, 4000, 7000, 14000)
CASES = [(blades, "Pitt & Peters", mu, damper) for blades in MODELS for mu in (0.15, 0.321) for damper in DAMPERS]
CASES += [(blades, inflow, 0.321, 7000) for blades in MODELS for inflow in INFLOWS if inflow != "Pitt & Peters"]


def run(blades, inflow, mu, damper):
    """Rows of the lag modes, least damped first."""
    kind, more = INFLOWS[inflow]
    entries = ["Analyses = trim, floquet", "Threads = 1", "Constants/mu = %g" % mu,
               "Subsystems/blade/Joints/lag/rotation/Damper = %g N*m*s/rad" % damper, "Aerodynamics/flow/Type = %s" % kind,
               "Floquet/Period = T", "Floquet/Steps = 60", "Floquet/Spectral radius = 0.5",
               "Floquet/Symmetry = blade 1, blade 2, blade 3, blade 4", "Floquet/Turning = hub, shaft"]
    entries += ["Aerodynamics/flow/" + entry for entry in more]
    if blades == "elastic":
        entries.append("Floquet/Highest frequency = %d rad/s" % (60 if "He" in inflow else 40))  # much of that inflow is as slow
    else:
        # all modes; a symmetry needs what is asked of one blade of all of them
        angles = ["blade %d:%s.rotation" % (k, hinge) for k in (1, 2, 3, 4) for hinge in ("flap", "lag")]
        entries += ["Floquet/Wanted = 60", "Output/Probes = flow.thrust, " + ", ".join(angles)]
    if damper < 1000:
        entries.append("Trim/Settle = 30")  # little damping: the start takes its time to come near
    done = Run(MODELS[blades], *entries, see=lambda folder: read_texts(folder))
    collective, modes = done.seen
    return [dict(zip(COLUMNS, (blades, inflow, mu, damper, mode["family"], mode["pattern"], "%.5g" % float(mode["growth rate [1/s]"]),
                               "%.5g" % float(mode["frequency [rad/s]"]), "%.4f" % math.degrees(collective), "%.1f" % done.user)))
            for mode in modes]


def read_texts(folder):
    with open(folder / "trim.csv") as file:
        collective = next(float(row["value"]) for row in csv.DictReader(file) if row["name"] == "collective")
    with open(folder / "floquet.csv") as file:
        return collective, [mode for mode in csv.DictReader(file) if mode["family"].startswith("lag")]


def case_of(row):
    return (row["blades"], row["inflow"], float(row["mu"]), float(row[COLUMNS[3]]))


def draw(rows):
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    for blades, fill, line in (("rigid", "none", "--"), ("elastic", None, "-")):
        for mu, color in ((0.15, "#1f5fa8"), (0.321, "#d1495b")):
            chosen = [r for r in rows if r["blades"] == blades and r["inflow"] == "Pitt & Peters" and float(r["mu"]) == mu]
            dampers = sorted({float(r[COLUMNS[3]]) for r in chosen})
            least = [max((r for r in chosen if float(r[COLUMNS[3]]) == d), key=lambda r: float(r["growth rate [1/s]"])) for d in dampers]
            for ax, name in zip(axes, ("growth rate [1/s]", "frequency [rad/s]")):
                ax.plot([d / 1000 for d in dampers], [float(r[name]) for r in least], line, color=color, label=f"{blades}, μ = {mu:g}")
                ax.plot([float(r[COLUMNS[3]]) / 1000 for r in chosen], [float(r[name]) for r in chosen], "o", ms=5, color=color,
                        markerfacecolor=fill or color, alpha=0.7)
    for ax, name in zip(axes, ("growth rate [1/s]", "frequency [rad/s]")):
        ax.set(xlabel="lag damper [kN m s/rad]", ylabel=name)
        ax.grid(alpha=0.3)
    axes[0].axhline(0, color="0.4", lw=0.8)
    axes[0].set_ylim(-10, 0.4)
    axes[0].legend()
    figure.suptitle("Lag modes of the trimmed rotor: all patterns (dots), the least damped one (lines)")
    save(figure, "puma_lag_damping.png")


def print_tables(rows):
    cases = {}
    for row in rows:
        cases.setdefault(case_of(row), []).append(row)

    def told(case):
        found = cases.get(case)
        if not found:
            return "not computed"
        least = max(found, key=lambda r: float(r["growth rate [1/s]"]))
        return "%.3f 1/s, %.2f rad/s, %s" % (float(least["growth rate [1/s]"]), float(least["frequency [rad/s]"]), least["pattern"])

    columns = [(blades, mu) for blades in MODELS for mu in (0.15, 0.321)]
    into_page("applications/puma_trim.md", "lag modes and dampers", table(
        "damper [N m s/rad] | " + " | ".join(f"{blades}, μ = {mu:g}" for blades, mu in columns),
        [[damper] + [told((blades, "Pitt & Peters", mu, damper)) for blades, mu in columns] for damper in DAMPERS]))
    into_page("applications/puma_trim.md", "lag modes and inflows", table(
        "inflow | " + " | ".join(MODELS), [[inflow] + [told((b, inflow, 0.321, 7000)) for b in MODELS] for inflow in INFLOWS]))


def make(parts, drawn):
    rows = read(KEPT)
    computed = {case_of(row) for row in rows}
    for case in [] if drawn else few([case for case in CASES if case not in computed] or CASES):
        if case not in computed:
            rows += run(*case)
            write(KEPT, rows, COLUMNS)
    print_tables(rows)
    draw(rows)
