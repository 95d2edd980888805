"""The chart and the table of large shells in benchmarks/sizes.md.

Runs prm/benchmarks/shells/curved_plate.prm with 8 × 8 to 96 × 96 elements, two minutes and up to 4 GB."""

import os
import re
import subprocess
import tempfile

from figures_of.common import BLUE, RED, SAMARA, TOP, few, into_page, np, plt, read, save, table, update


NUMBERS = (8, 16, 24, 32, 48, 64, 80, 96)

KEPT = "benchmarks/shell_sizes.csv"


def measured(n, analysis):
    """Unknowns, processor time of the whole run, user's and system's [s], largest memory [MB]."""
    with tempfile.TemporaryDirectory() as folder:
        command = [SAMARA, TOP / "prm/benchmarks/shells/curved_plate.prm", "--output", folder, "--set", f"Analyses = {analysis}",
                   "--set", f"Bodies/plate/Elements = {n}, {n}"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        output = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(output)
    return {"analysis": analysis, "n": n, "unknowns": re.search(r"(\d+) unknowns", output)[1], "user [s]": f"{usage.ru_utime:.3g}",
            "system [s]": f"{usage.ru_stime:.3g}", "memory [MB]": round(usage.ru_maxrss / 1024)}


def make(parts, drawn):
    cases = [("static", n) for n in NUMBERS] + [("static, modal", n) for n in NUMBERS[:4]]
    rows = read(KEPT) if drawn else update(KEPT, [measured(n, analysis) for analysis, n in few(cases)], ["analysis", "n"])
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for analysis, label, color in ("static", "static, small load", BLUE), ("static, modal", "and 20 modes about it", RED):
        chosen = [row for row in rows if row["analysis"] == analysis]
        unknowns, time, memory = np.array([(float(row["unknowns"]), float(row["user [s]"]) + float(row["system [s]"]),
                                            float(row["memory [MB]"])) for row in chosen]).T
        left.plot(unknowns, time, color=color, marker="o", ms=4, label=label)
        right.plot(unknowns, memory, color=color, marker="o", ms=4)
        if analysis == "static":
            left.plot(unknowns, time[2] * unknowns / unknowns[2], color="0.6", ls="--", lw=0.8, label="proportional")
    for ax, name in (left, "processor time of the whole run [s]"), (right, "largest memory of the process [MB]"):
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlabel("unknowns")
        ax.set_ylabel(name)
    left.legend(loc="lower right")
    save(figure, "shell_sizes.svg")
    into_page("benchmarks/sizes.md", "shells", table("elements | unknowns | user [s] | system [s] | memory [MB]", [
        [f"{row['n']} × {row['n']}{', 20 modes' if row['analysis'] != 'static' else ''}", f"{int(row['unknowns']):,}".replace(",", " "),
         row["user [s]"], row["system [s]"], row["memory [MB]"]] for row in rows]))
