"""Runs that are stopped at a random moment, by kill -9, Ctrl-C or SIGTERM: motions, trims, Floquet analyses, studies. What is in the
folder can be read, nothing is left that runs or locks, and a run after it, with --restart where it is offered, has the tables of one
that nobody stopped, to the last byte."""

import csv
import pathlib
import random
import re
import signal
import subprocess
import tempfile
import time

import h5py

from generator import mechanism
from mechanism import Beam
from program import environment

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIGNALS = signal.SIGKILL, signal.SIGINT, signal.SIGTERM, None  # None: a second start in the same folder
LONGEST = 300  # s until somebody gives up
LINGER = 10  # s in which what a killed run has started has to end
LOCK, REFUSED = ".samara_lock", "another run writes its results"

NO_PICTURES = "Output/Pictures = false"
JOBS = {
    "trim": ("prm/examples/trim/shaken_mass.prm", NO_PICTURES),
    "trim of a rotor": ("prm/rotorcraft/flapping_rotor.prm", NO_PICTURES),
    "floquet": ("prm/examples/floquet/hammond_rotor.prm", NO_PICTURES),
    "floquet of a rotor": ("prm/examples/floquet/flap_lag_forward_flight.prm", NO_PICTURES),
    "study": ("prm/studies/pendulum.prm",),
    "study of statics": ("prm/studies/elastica.prm",),
}


class Killed:
    """One job and one signal; `seconds` of the processor are not told by killed ones, so they are of the clock."""

    def __init__(self, seed):
        chance = random.Random(f"kill {seed}")
        self.job = chance.choice(("motion", "motion", "motion", *JOBS))
        self.signal, self.part = chance.choice(SIGNALS), chance.random()
        self.seconds, self.code, self.text_of_model = 0.0, 0, None
        if self.job == "motion":
            # smooth and short of stops, 2000 steps: several checkpoints
            seeds = (chance.randrange(10**6) for _ in range(1000))
            models = (mechanism(k) for k in seeds)
            model = next(m for m in models if m.analyses == ("dynamic",) and not any("Upper stop" in e for j in m.joints for e in j.motions.values())
                         and sum(isinstance(b, Beam) for b in m.bodies) < 2)
            model = model.with_(steps=2000, step=model.step / 20)
            self.text_of_model = model.text_here().replace("subsection Dynamic\n", "subsection Dynamic\n  set Checkpoint interval = 0.05\n")

    def text(self):
        return self.text_of_model or f"{self.job}: {JOBS[self.job]}, {self.signal}\n"

    def command(self, program, folder, *arguments):
        if self.text_of_model:
            model = folder.parent / f"{folder.name}.prm"
            model.write_text(self.text_of_model)
            return [program, str(model), "--output", str(folder), *arguments]
        file, *overrides = JOBS[self.job]
        return [program, str(ROOT / file), "--output", str(folder), *(word for entry in overrides for word in ("--set", entry)), *arguments]

    def start(self, program, folder, *arguments):
        return subprocess.Popen(self.command(program, folder, *arguments), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, env=environment())

    def finish(self, run):
        """Exit code and output."""
        try:
            output, _ = run.communicate(timeout=LONGEST)
        except subprocess.TimeoutExpired:
            run.kill()
            return None, run.communicate()[0]
        return run.returncode, output

    def complaints(self, program):
        with tempfile.TemporaryDirectory() as scratch:
            began = time.monotonic()
            said = list(self.in_folders(program, pathlib.Path(scratch) / "whole", pathlib.Path(scratch) / "run"))
            self.seconds = time.monotonic() - began
            what = signal.Signals(self.signal).name if self.signal else "second start"
            return [f"{self.job}, {what} after {self.part:.2f} of the time: {text}" for text in said]

    def in_folders(self, program, whole, folder):
        began = time.monotonic()
        self.code, output = self.finish(self.start(program, whole))
        if self.code != 0:
            if not self.text_of_model or self.code not in (2, 3):
                yield f"a run that nobody stops ends with {self.code}: {output[-300:]}"
            return  # there is nothing to compare
        run, pause = self.start(program, folder), self.part * (time.monotonic() - began)
        time.sleep(pause)
        if self.signal is None:
            yield from self.second_start(program, folder, run)
        else:
            run.send_signal(self.signal)
        code, output = self.finish(run)
        allowed = {signal.SIGKILL: (-signal.SIGKILL, 0), None: (0,)}.get(self.signal, (130, 0))
        # before it has a folder, and behind its last word, a signal ends it as any program
        is_outside = code == -(self.signal or 0) and (not any(folder.glob("*.csv")) or "done in " in output)
        is_second = self.signal is None and REFUSED in output  # the other one was there before it
        if code not in allowed and not is_outside and not is_second:
            yield f"ends with exit code {code}: {output[-300:]}"
        yield from still_runs(folder)
        yield from unreadable(folder, self.signal == signal.SIGKILL)
        arguments = ["--restart"] if code != 0 and (folder / "dynamic.checkpoint").exists() else []
        code, output = self.finish(self.start(program, folder, *arguments))
        if code != 0:
            yield f"the run after it{' with --restart' if arguments else ''} ends with exit code {code}: {output[-500:]}"
            return
        yield from unreadable(folder, False)
        yield from differences(whole, folder)

    def second_start(self, program, folder, first):
        code, output = self.finish(self.start(program, folder))
        # the first may be done, or not have begun
        if code != 0 and REFUSED not in output:
            yield f"a second start ends with exit code {code}: {output[-300:]}"
        if code == 0 and first.poll() is None and (folder / LOCK).exists():
            yield "a second start goes on beside the first"


def still_runs(folder):
    """What a run has started ends with it."""
    end = time.monotonic() + LINGER
    while (left := processes_of(folder)) and time.monotonic() < end:
        time.sleep(0.05)
    if left:
        yield f"{len(left)} processes go on: {left}"


def processes_of(folder):
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = path.read_bytes().split(b"\0")
        except OSError:
            continue
        if any(str(folder).encode() in word for word in words):
            found.append(int(path.parent.name))
    return found


def unreadable(folder, may_be_cut):
    """Complaints about tables whose lines are not complete, and files of HDF5 that cannot be opened. The last line of a killed run may be
    cut, and files of HDF5 that it had not finished are not there or those of before."""
    for path in folder.rglob("*.csv"):
        text = path.read_text()
        lines = text.splitlines()
        if may_be_cut and not text.endswith("\n"):
            lines = lines[:-1]
        elif not text.endswith("\n"):
            yield f"{path.name} ends within a line"
        if len({len(row) for row in csv.reader(lines)}) > 1 and path.stem not in ("assembly", "sections"):
            yield f"{path.name} has lines of several lengths"
        if "\0" in text:
            yield f"{path.name} has bytes of zero"
    for path in folder.rglob("*.h5"):
        try:
            with h5py.File(path):
                pass
        except OSError as error:
            yield f"{path.name} cannot be opened: {error}"
    if not may_be_cut and (folder / LOCK).exists():
        yield "a lock is left"


TIMES = re.compile(r"time \[s\]$|^cost")  # columns of the clock


def without_times(path):
    """The lines of a table without what the clock says."""
    rows = list(csv.reader(path.read_text().splitlines())) or [[]]
    return [[cell for name, cell in zip(rows[0], row) if not TIMES.search(name)] for row in rows]


def differences(whole, folder):
    # of reports, as many parts as there was time for while the run went on
    names = lambda root: {str(path.relative_to(root)) for path in root.rglob("*") if path.is_file() and not path.name.startswith("report.")}
    if names(whole) != names(folder):
        yield f"files that are not there: {sorted(names(whole) - names(folder))}; that are too many: {sorted(names(folder) - names(whole))}"
    for name in sorted(names(whole) & names(folder)):
        if name.endswith(".csv") and without_times(whole / name) != without_times(folder / name):
            yield f"{name} is not that of a run that nobody stopped"
