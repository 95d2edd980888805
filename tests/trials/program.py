"""Runs the program on a text and reads what it writes."""

import os
import pathlib
import re
import resource
import subprocess
import tempfile

import numpy as np

SANITIZED = "SAMARA_SANITIZED" in os.environ  # contrib/sanitize: slow, and with terabytes of addresses
LIMIT = 200 if SANITIZED else 20  # seconds of the processor a run may take
MEMORY = 4 << 30


def limits():
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 2))
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def number(text):
    """nan for an empty cell or a name."""
    try:
        return float(text)
    except ValueError:
        return np.nan


class Table:
    """A CSV file: names without units, and numbers (rows, columns)."""

    def __init__(self, path):
        head, *rows = path.read_text().splitlines()
        self.names = [re.sub(r" \[[^]]*\]$", "", name) for name in head.split(",")]
        self.numbers = np.array([[number(x) for x in row.split(",")] for row in rows]).reshape(-1, len(self.names))
        self.column = {name: k for k, name in enumerate(self.names)}

    def __getitem__(self, names):
        """One column, or several side by side."""
        if isinstance(names, str):
            return self.numbers[:, self.column[names]]
        return self.numbers[:, [self.column[name] for name in names]]

    def vector(self, path):
        return self[[f"{path} {axis}" for axis in "xyz"]]


class Run:
    """Exit code, output (both streams), tables and reports by the names of their files, and how long it took [s of the
    processor]. Files that the model reads are `files`, their texts by name. What is in a `folder` is kept, and may be gone on with;
    otherwise nothing is."""

    def __init__(self, program, text, *arguments, name="model.prm", files=None, folder=None):
        if folder is None:
            with tempfile.TemporaryDirectory() as scratch:
                self.run(program, text, arguments, name, files, pathlib.Path(scratch))
        else:
            self.run(program, text, arguments, name, files, pathlib.Path(folder))

    def run(self, program, text, arguments, name, files, folder):
        (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        for other, content in (files or {}).items():
            (folder / other).write_text(content)
        command = [program, name, "--output", "results", *arguments]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(command, cwd=folder, capture_output=True, preexec_fn=limits, env=environment(), stdin=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.code, self.output = done.returncode, (done.stdout + done.stderr).decode(errors="replace")
        self.tables = {}
        for path in (folder / "results").glob("*.csv"):
            if path.stem in ("assembly", "dynamic_stops", "sections"):
                continue  # with names
            self.tables[path.stem] = Table(path)
        self.texts = {path.stem: path.read_text() for path in (folder / "results").glob("section_*.txt")}
        self.linear = linear_system(folder / "results/linear_system.h5")

    def has_halved_steps(self):
        """Steps that find no solution are halved, which round-off may decide."""
        return bool(re.search("[1-9][0-9]* without solution", self.output))


def environment():
    return dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")


def linear_system(path):
    """Datasets by name, texts as lists; None if there is no such file."""
    if not path.exists():
        return None
    import h5py  # takes a while, and few need it

    with h5py.File(path) as file:
        return {name: [x.decode() for x in data] if data.dtype.kind == "S" else data[...] for name, data in file.items()}
