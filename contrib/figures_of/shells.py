"""The tables of benchmarks/shells.md.

Runs models of prm/ and, if contrib/build check test_shells has built it, the tests of shells, which record what they measure; two or
three minutes."""

import json
import subprocess
import tempfile

from figures_of.common import SMALL, TOP, Run, few, into_page, measured, np, printed


TESTS = TOP / "build/check/tests/test_shells"


def row(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |")


def head(*cells):
    print()
    row(*cells)
    print("|" + "---|" * len(cells))


def digits(x, n=2):
    return f"{x:.{n}g}"


def mindlin_plate():
    exact = [float(r["omega"]) for r in measured("shells/mindlin_plate_frequencies.csv")]
    head("degree", "elements", "(1, 1)", "(1, 2)", "(2, 2)", "orders")
    for p, numbers in few(((2, (2, 4, 8)), (3, (2, 4, 8)), (4, (1, 2, 4)))):
        before = None
        for n in few(numbers):
            found = Run("examples/shells/plate_modes.prm", f"Bodies/plate/Elements = {n}, {n}", f"Bodies/plate/Degree = {p}").modes["frequency"]
            errors = np.abs(np.array([found[0] / exact[0], found[1] / exact[1], found[3] / exact[2]]) - 1)
            orders = "" if before is None else ", ".join(f"{o:.1f}" if e > 1e-9 else "–" for o, e in zip(np.log2(before / errors), errors))
            row(p, f"{n} × {n}", *(digits(e) for e in errors), orders)
            before = errors


def thin_limit():
    limits = {"4e-3": 0.0936, "1e-3": 0.0921, "1e-4": 0.0909}
    meshes = few(((2, 12), (2, 24), (3, 4), (3, 8), (4, 3), (4, 6)))
    head("h/R", *(f"p = {p}, {n} × {n}" for p, n in meshes), "limit of design studies")
    for ratio, limit in few(limits).items():
        h = 10 * float(ratio)
        scale = (h / 0.04) ** 3
        values = []
        for p, n in meshes:
            found = Run("examples/shells/pinched_hemisphere.prm", f"Constants/P = {2e-4 * scale}", f"Bodies/shell/Thickness = {h}",
                       f"Bodies/shell/Elements = {n}, {n}", f"Bodies/shell/Degree = {p}", "Static/Load steps = 1").static
            x, y = (found[f"shell.{name}"][-1] for name in ("A.displacement x", "B.displacement y"))
            values.append(f"{0.5 * (x - y) / 1e-4:.4f}")
        row(ratio, *values, limit)


def roofs():
    head("thickness", "limit points", "iterations of the path, bound", "of all, with limit points and signs", "unknowns")
    for h, end, bound in few((("12.7", "1.3", 70), ("6.35", "1", 110))):
        run = Run("benchmarks/shells/hinged_roof.prm", f"Bodies/roof/Thickness = {h}", f"Static/End load factor = {end}")
        path = int(sum(run.static_path["iterations"]))
        limits = ", ".join(digits(x, 4) for x in run.static_limits["load factor"])
        row(h, limits, f"{path}, {bound}", int(run.summary["iterations"][0]), int(run.summary["unknowns"][0]))


def recorded():
    """What the tests record: test -> name -> number."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([TESTS, "--gtest_brief=1", f"--gtest_output=json:{folder}/tests.json",
                        "--gtest_filter=ShellsOfSze.*:LinearShells.*"], cwd=folder, check=True)
        suites = json.load(open(folder + "/tests.json"))["testsuites"]
    known = {"name", "file", "line", "status", "result", "timestamp", "time", "classname"}
    return {test["name"]: {k: v for k, v in test.items() if k not in known} for suite in suites for test in suite["testsuite"]}


def from_tests():
    tests = recorded()
    head("test", "column of the list", "largest distance, part of the end of the axis")
    for test in ("CantileverUnderAnEndForce", "CantileverUnderAnEndMomentIsRolledUp", "HemisphereWithAHole", "OpenCylinderPulledApart",
                 "HingedRoofSnapsThrough"):
        for name, value in tests[test].items():
            if "iterations" not in name:
                row(test, name, digits(float(value)))
    head("problem", "mesh", "value over that of the list")
    for test in tests.values():
        for name, value in test.items():
            if ", elements " in name:
                problem, mesh = name.split(", elements ")
                row(problem, mesh, f"{float(value):.4f}")


def make(parts, drawn):
    for title, function in ("thick plate", mindlin_plate), ("thin hemisphere", thin_limit), ("roofs", roofs), ("tests", from_tests):
        if function != from_tests or TESTS.exists() and not SMALL:
            into_page("benchmarks/shells.md", title, printed(function))
