"""What the programs of the figures share: runs of samara, numbers that are kept, tables in pages, pictures.

A module of this folder has make(parts, drawn): it makes the figures and tables of its page, those of the named parts alone if there
are any. With drawn it runs nothing: what was measured before, a .csv file beside the page, is drawn again. Where a page has a line
<!-- table: title -->, into_page replaces the table that follows it.

With --small, few() gives the first of many cases, and all that is written goes to a scratch folder.
"""

import contextlib
import csv
import io
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(TOP / "contrib"))
from plot_style import STYLE

BUILD = TOP / "build/release"
SAMARA = os.path.abspath(os.environ.get("SAMARA", BUILD / "samara"))
SMALL = os.environ.get("FIGURES_SMALL") == "1"  # contrib/figures sets it
BLUE, RED, GREEN, ORANGE, PURPLE, CYAN, BROWN, GREY = (
    "#1f5fa8", "#d1495b", "#2a9d5c", "#e08e1b", "#7b4fa3", "#17a2b8", "#8c564b", "#666666")
TIME_COLORS = ["#b9cbe0", BLUE, PURPLE, "#cf3a4b"]  # from the start to the end of a motion
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}

plt.rcParams.update(STYLE)
scratch = tempfile.TemporaryDirectory(prefix="figures") if SMALL else None


def few(cases, n=1):
    """The first n of the cases if the figures are small ones, all of them otherwise."""
    return type(cases)(list(cases.items())[:n]) if SMALL and isinstance(cases, dict) else list(cases)[:n] if SMALL else cases


def doc(name):
    """Where a file of doc/ is written."""
    if not SMALL:
        return TOP / "doc" / name
    path = pathlib.Path(scratch.name, "doc", name)
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() and (TOP / "doc" / name).is_file():
        shutil.copy(TOP / "doc" / name, path)
    return path


def results(name):
    """Where results are kept from one call to the next."""
    path = pathlib.Path(scratch.name if SMALL else TOP / "results", name)
    path.mkdir(parents=True, exist_ok=True)
    return path


def columns(path):
    """Columns of a table by name, without units; what is no number is nan. A last row that is half, of a run that was killed, is not
    there."""
    if not path.exists():
        return {}
    with open(path) as file:
        rows = [row for row in csv.reader(file)]
    rows = [row for row in rows if len(row) == len(rows[0])]

    def number(text):
        try:
            return float(text)
        except ValueError:
            return math.nan

    result = {}
    for i, name in enumerate(rows[0]):  # the first one counts of a frequency in rad/s, Hz and /rev
        result.setdefault(name.split(" [")[0], np.array([number(row[i]) for row in rows[1:]]))
    return result


class Run:
    """A run of a model of prm/ (or a path) with entries that are set: exit code, words of the log, tables, seconds.

    keep: a folder in which results stay; they are not computed again. limit: seconds of the processor after which it is killed.
    more: lines that the model has besides. see: what is called with the folder while it is there, for pictures. study: the model is that of a study."""

    def __init__(self, model, *entries, keep=None, limit=None, more="", may_fail=False, pictures=False, see=None,
                 study=False):
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(keep or temporary)
            if not (folder / "log").exists():
                quiet = [] if study else ["Output/Report = false"] + ["Output/Pictures = false"] * (not pictures)
                self.compute(folder, model, [*quiet, *entries], limit, more)
            lines = (folder / "log").read_text().splitlines()
            self.code, self.user, self.whole = int(lines[0]), float(lines[1]), float(lines[2])
            self.text = "\n".join(lines[3:])
            if self.code and not may_fail:
                sys.exit(f"{model} {entries}\n{self.text[-2000:]}")
            self.tables = {path.stem: columns(path) for path in folder.glob("*.csv")}
            self.seen = see(folder) if see else None

    def compute(self, folder, model, entries, limit, more):
        folder.mkdir(parents=True, exist_ok=True)
        path = TOP / "prm" / model if (TOP / "prm" / model).exists() else TOP / model
        if more:
            file = folder / "with_more.prm"
            file.write_text(f"include {path}\n{more}")
            path = file
        command = [*(["prlimit", f"--cpu={limit}:{limit + 5}"] if limit else []), SAMARA, str(path), "--output", str(folder)]
        for entry in entries:
            command += ["--set", entry]
        before = os.times()
        run = subprocess.run(command, capture_output=True, text=True, cwd=TOP, env={**os.environ, **ONE_THREAD})
        after = os.times()
        if run.returncode == 2:
            sys.exit(" ".join(command) + "\n" + run.stderr)
        user = after.children_user - before.children_user
        whole = user + after.children_system - before.children_system
        (folder / "log").write_text(f"{run.returncode}\n{user}\n{whole}\n" + run.stdout + run.stderr)

    def __getattr__(self, name):
        """run.dynamic is the table dynamic.csv, {} if there is none."""
        return self.__dict__["tables"].get(name, {})

    def number(self, pattern, default=math.nan):
        found = re.search(pattern, self.text)
        return float(found[1]) if found else default

    @property
    def processor(self):
        """Seconds of the processor of the last analysis."""
        found = re.findall(r"([\d.e+-]+) s of the processor", self.text)
        return float(found[-1]) if found else math.nan

    @property
    def why(self):
        """Why it failed, in two words."""
        return {0: "", 3: "no convergence", 4: "singular matrix"}.get(self.code, "out of time")


def program(name):
    """Standard output of a program of the build, build/release/benchmarks/bench_sizes; None if it is not built."""
    path = BUILD / name
    if not path.exists():
        return None
    return subprocess.run([path], capture_output=True, text=True, check=True, env={**os.environ, **ONE_THREAD}).stdout


def read(name):
    """Rows of a file of doc/, of texts."""
    path = doc(name)
    if not path.exists():
        return []
    with open(path) as file:
        return list(csv.DictReader(file))


def write(name, rows, names=None):
    with open(doc(name), "w", newline="") as file:
        writer = csv.DictWriter(file, names or list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def update(name, rows, keys):
    """Rows of a file of doc/ anew; in their place if rows with the same keys are there. All rows, in the order of the new ones first."""
    key = lambda row: [str(row[k]) for k in keys]
    new = [{k: str(v) for k, v in row.items()} for row in rows]
    old = [row for row in read(name) if key(row) not in [key(r) for r in new]] if SMALL else []
    write(name, new + old)
    return new + old


def measured(name, runs=None):
    """Rows of a file of tests/reference, without its comments; of some runs alone if it has several."""
    with open(TOP / "tests/reference" / name) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [row for row in rows if runs is None or row["run"] in runs]


def table(head, rows):
    """Markdown of a table; the words of the head are between bars."""
    return "\n".join([f"| {head} |", "|---" * len(head.split(" | ")) + "|"]
                     + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def into_page(page, title, text):
    """Prints a table (or some) and puts it in place of the one that follows <!-- table: title --> in a page, if there is such a line."""
    text = re.sub(r"(?<=[|,] )-(?=\d)", "−", text)
    print(f"### {title}\n\n{text}", flush=True)
    path, mark = doc(page), f"<!-- table: {title} -->\n"
    before, found, after = path.read_text().partition(mark)
    if found:
        path.write_text(before + mark + text.rstrip() + "\n" + re.sub(r"^(\|.*\n|\n(?=\|))*", "", after))


def printed(function, *arguments):
    """What a function prints."""
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        function(*arguments)
    return text.getvalue()


def save(figure, name, dpi=110, colours=128):
    """Into doc/pictures, with as many colours as lines need."""
    path = doc("pictures/" + name)
    if path.suffix == ".svg":
        figure.savefig(path, metadata={"Date": None})
        path.write_text("\n".join(line.rstrip() for line in path.read_text().splitlines()) + "\n")
    else:
        from PIL import Image

        figure.savefig(path, dpi=dpi)
        with Image.open(path) as image:
            image.convert("RGB").quantize(colours).save(path, optimize=True)
    plt.close(figure)
    print(path if SMALL else path.relative_to(TOP), flush=True)


def short(number):
    """4.1e-06 as 4.1e-6, 0.41 as 0.41, 200 as 200."""
    return f"{number:.0f}" if number >= 100 else f"{number:.2g}" if number >= 0.01 else re.sub("e-0", "e-", f"{number:.1e}")


def scheme(stages, radius, *step):
    return [f"Dynamic/Stages = {stages}", f"Dynamic/Spectral radius = {radius}"] + [f"Dynamic/Step = {s}" for s in step]


def on_mesh(bodies, degree, elements=1):
    return [entry for body in bodies for entry in (f"Bodies/{body}/Degree = {degree}", f"Bodies/{body}/Elements = {elements}")]


def interpolated(times, values, at, n=8):
    """Values at other times, by the polynomials through the n nearest rows."""
    first = np.clip(np.searchsorted(times, at) - n // 2, 0, len(times) - n)
    nodes = times[first[:, None] + np.arange(n)]
    result = np.zeros((len(at),) + values.shape[1:])
    for i in range(n):
        weight = np.ones(len(at))
        for j in range(n):
            if j != i:
                weight *= (at - nodes[:, j]) / (nodes[:, i] - nodes[:, j])
        result += weight.reshape(-1, *[1] * (values.ndim - 1)) * values[first + i]
    return result


def runge_kutta(rate, state, start, end, n):
    """The state at the end of n steps of the classical rule."""
    h = (end - start) / n if n else 0
    for i in range(n):
        t = start + i * h
        a = rate(t, state)
        b = rate(t + h / 2, state + h / 2 * a)
        c = rate(t + h / 2, state + h / 2 * b)
        state = state + h / 6 * (a + 2 * b + 2 * c + rate(t + h, state + h * c))
    return state
