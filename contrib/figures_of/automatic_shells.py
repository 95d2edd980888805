"""The figure and the tables of shells in benchmarks/automatic_mesh.md.

Runs bench_automatic_shells, some minutes, and keeps what it says in benchmarks/automatic_shells.csv."""

import csv
import re

from figures_of.common import BLUE, GREEN, ORANGE, RED, SMALL, Run, into_page, np, plt, program, read, save, table, write


COLORS = {"roof": BLUE, "tank": RED, "plate": GREEN, "hemisphere": ORANGE}
KEPT = "benchmarks/automatic_shells.csv"



def make(parts, drawn):
    output = None if drawn or SMALL else program("benchmarks/bench_automatic_shells")
    if output:
        write(KEPT, list(csv.DictReader(output.splitlines())))
    rows = [{**r, **{key: float(r[key]) for key in ("wanted", "estimated", "measured", "unknowns")}} for r in read(KEPT)]
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    for mesh in ("automatic", "uniform"):
        lines = []
        for problem, color in COLORS.items():
            own = [r for r in rows if r["problem"] == problem and r["mesh"] == mesh]
            if not own:
                continue
            before = None
            for r in own:
                order = ""
                if before and mesh == "uniform":
                    # unknowns go with the square of the number of elements
                    order = f"{2 * np.log(before['estimated'] / r['estimated']) / np.log((r['unknowns'] / before['unknowns']) ** 0.5):.1f}"
                lines.append([problem, f"{r['wanted']:.2g}", f"{r['estimated']:.2g}", f"{r['measured']:.2g}",
                              f"{r['estimated'] / r['measured']:.2f}", f"{r['unknowns']:.0f}", order])
                before = r
            left.loglog([r["unknowns"] for r in own], [r["measured"] for r in own], color=color, marker="o" if mesh == "automatic" else ".",
                        ms=5, ls="-" if mesh == "automatic" else ":", label=problem if mesh == "automatic" else None)
        into_page("benchmarks/automatic_mesh.md", f"shells, {mesh}",
                  table("problem | wanted | estimated | measured | effectivity | unknowns | order of the estimate", lines))
    left.set_xlabel("unknowns")
    left.set_ylabel("error of the strains, energy norm, relative")
    left.legend(loc="lower left", title="—  automatic,  ···  n × n")

    # the mesh of the tank and what it resolves
    mesh = Run("benchmarks/shells/clamped_tank.prm", "Constants/error = %s" % ("1e-1" if SMALL else "1e-3"),
               see=lambda folder: re.search(r"^ *set Mesh *= (.*) by ", (folder / "used.prm").read_text(), re.M)[1]).seen
    ends = np.array([0.0] + [float(end) for end in mesh.split()])
    x = np.linspace(0, 2, 1000)
    layer = np.sqrt(0.01) / 3**0.25
    right.plot(x, 1e6 * 1e-5 / (2 * np.sqrt(3)) * np.exp(-x / layer) * (np.cos(x / layer) - np.sin(x / layer)), color=COLORS["roof"], ls="-")
    right.plot(2 * ends, 0 * ends - 1.2, color="k", ls="", marker="|", ms=11)
    right.set_xlabel("along the tank")
    right.set_ylabel("bending moment · 10⁶, thin theory", color=COLORS["roof"])
    right.set_title("Ends of elements for an error of 1e-3", loc="left", fontsize=11)
    save(figure, "automatic_shells.png")
