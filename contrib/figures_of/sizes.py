"""The figure and the table of chains in benchmarks/sizes.md: time and memory against unknowns.

Runs bench_sizes, some minutes."""

from figures_of.common import BLUE, GREEN, SMALL, doc, into_page, np, plt, program, read, save, table


COLORS = {"KLU": BLUE, "MUMPS": GREEN}
TITLES = {"beam": "Beam of cubic elements", "garland": "Bodies with ball joints"}

KEPT = "benchmarks/sizes.csv"


def curve(rows, model, library, column):
    """Unknowns and a quantity."""
    chosen = [row for row in rows if row["model"] == model and row["library"] == library]
    return np.array([(float(row["unknowns"]), float(row[column])) for row in chosen]).T


def make(parts, drawn):
    output = None if drawn or SMALL else program("benchmarks/bench_sizes")
    if output:
        doc(KEPT).write_text(output)
    rows = read(KEPT)
    figure, axes = plt.subplots(2, 2, figsize=(10, 7), sharex=True, layout="constrained")
    for (model, title), (top, bottom) in zip(TITLES.items(), axes.T):
        for library, color in COLORS.items():
            unknowns, step = curve(rows, model, library, "step [ms]")
            top.plot(unknowns, step, color=color, ls="-", marker="o", ms=4, label=library)
            unknowns, memory = curve(rows, model, library, "memory [MB]")
            bottom.plot(unknowns, memory, color=color, ls="-", marker="o", ms=4)
        unknowns, step = curve(rows, model, "KLU", "step [ms]")
        top.plot(unknowns, unknowns * step[2] / unknowns[2], color="0.6", ls="--", lw=0.8, label="proportional")
        top.set_title(title, loc="left", fontsize=11)
        for ax in (top, bottom):
            ax.set_xscale("log")
            ax.set_yscale("log")
        bottom.set_xlabel("unknowns")
    axes[0, 0].set_ylabel("processor time of a step [ms]")
    axes[1, 0].set_ylabel("memory [MB]")
    axes[0, 0].legend(loc="upper left")
    save(figure, "sizes.svg")

    lines = []
    for model in TITLES:
        for number in dict.fromkeys(row["unknowns"] for row in rows if row["model"] == model):
            of = {row["library"]: row for row in rows if row["model"] == model and row["unknowns"] == number}
            cells = [f"{float(of[l]['step [ms]']):.3g} | {float(of[l]['memory [MB]']):.0f}" if l in of else "– | –" for l in COLORS]
            lines.append([model, number, f"{float(of['KLU']['set up [s]']):.2g}", *cells])
    into_page("benchmarks/sizes.md", "chains", table(
        " | unknowns | set up [s] | " + " | ".join(f"{library}, step [ms] | memory [MB]" for library in COLORS), lines))
