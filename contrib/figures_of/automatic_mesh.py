"""The figure and the table of beams in benchmarks/automatic_mesh.md: automatic against uniform elements.

Half a minute."""

import re

from figures_of.common import BLUE, GREEN, ORANGE, RED, SMALL, Run, few, into_page, np, plt, save, table


T, F, LAYER, A, EA = 100, 0.1, 0.02, 0.4, 1e10  # as in the model
EI = T * LAYER**2
N = 60 if SMALL else 600
ROOTS = (np.arange(N) + 0.5) / N
X, WEIGHTS = ROOTS**2, 2 * ROOTS / N  # denser at the clamp
MOMENT = F * LAYER * (np.exp(-X / LAYER) - 0.5 * np.exp(-abs(X - A) / LAYER))
ENERGY = T**2 / EA + WEIGHTS @ MOMENT**2 / EI
PROBES = ", ".join(f"rope.at {x:.12g}.moment 3" for x in X)


def run(*entries):
    """Unknowns, error relative to the energy, moments, estimate, and the mesh: ends and degrees of elements."""
    done = Run("benchmarks/automatic_mesh.prm", *entries, "Output/Probes = " + PROBES,
               see=lambda folder: re.search(r"^ *set Mesh *= (.*)$", (folder / "used.prm").read_text(), re.M))
    moments = np.array([done.static[f"rope.at {x:.12g}.moment 3"][-1] for x in X])
    error = np.sqrt(WEIGHTS @ (moments - MOMENT) ** 2 / EI / ENERGY)
    elements = [(int(p), float(end)) for p, end in re.findall(r"(\d) to ([\d.e-]+)", done.seen[1])] if done.seen else []
    return int(done.number(r"(\d+) unknowns")), error, moments, done.number(r"estimated error ([\d.e+-]+)"), elements


def make(parts, drawn):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    rows = []
    automatic = []
    for wanted in few((1e-1, 1e-3, 3e-2, 1e-2, 3e-3, 3e-4, 1e-4, 1e-5)):
        unknowns, error, moments, estimate, elements = run(f"Constants/error = {wanted}")
        automatic.append((unknowns, error))
        degrees = [p for p, _ in elements]
        by_degree = ", ".join(f"{degrees.count(p)} of {p}" for p in (2, 3, 4) if p in degrees)
        rows.append([f"{wanted:g}", f"{estimate:.2g}", f"{error:.2g}", unknowns, len(elements), by_degree])
        if wanted == (1e-1 if SMALL else 1e-3):
            shown = moments, elements
    into_page("benchmarks/automatic_mesh.md", "beams", table("wanted | estimated | measured | unknowns | elements | by degree",
                                                             sorted(rows, key=lambda row: -float(row[0]))))
    left.loglog(*np.array(sorted(automatic)).T, color="k", ls="-", marker="o", ms=5, label="automatic")
    for p, color, sizes in ((2, BLUE, 8), (3, GREEN, 8), (4, RED, 7)):
        uniform = [run(f"Bodies/rope/Elements = {8 * 2**k}", f"Bodies/rope/Degree = {p}")[:2] for k in few(range(sizes - p))]
        left.loglog(*np.array(uniform).T, color=color, ls="-", marker=".", label=f"uniform, p = {p}")
        print(f"uniform, p = {p}:", ", ".join(f"{n}: {e:.2g}" for n, e in uniform))
    left.set_xlabel("unknowns")
    left.set_ylabel("error of the strains, energy norm, relative")
    left.legend(loc="lower left")

    moments, elements = shown
    right.plot(X, 1e3 * moments, color=BLUE, ls="-")
    right.set_xlabel("x")
    right.set_ylabel("bending moment · 1000", color=BLUE)
    degree = right.twinx()
    ends = np.array([0] + [end for _, end in elements])
    degree.stairs([p for p, _ in elements], ends, color=ORANGE, lw=1.3)
    degree.plot(ends, 0 * ends + 0.15, color="k", ls="", marker="|", ms=9)
    degree.set_ylim(0, 9)
    degree.set_yticks(range(1, 5))
    degree.grid(False)
    degree.set_ylabel("degree; ends of elements", color=ORANGE, loc="bottom")
    right.set_title("Mesh for an error of 1e-3", loc="left", fontsize=11)
    save(figure, "automatic_mesh.png")
