"""Motions that are run back: the checkpoint at the end of a conservative motion gets the opposite velocities, and `--restart` goes on
from there. With spectral radius 1 the steps are the same backwards, so each state comes again."""

import pathlib
import tempfile

import h5py
import numpy as np

import judges
from generator import Generator
from mechanism import Beam, Function
from program import Run
from world import rotation

STEPS = 500  # from one checkpoint to the next: source/analysis/dynamic_restart.cc, steps_between_fresh_starts()
HEAD = 512  # bytes before HDF5 (source/output/checkpoint.cc)
TOLERANCE = 1e-8  # of the size, rad; of the largest velocity a thousand times more, as what is left of places is divided by steps


def checksum(body):
    """FNV-1a of 64 bits."""
    total = 0xCBF29CE484222325
    for byte in body:
        total = (total ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return total


def reverse(path):
    """Write a checkpoint again with the opposite velocities."""
    whole = path.read_bytes()
    title = whole[:HEAD].decode().splitlines()[0]
    path.write_bytes(whole[HEAD:])
    with h5py.File(path, "r+") as file:
        for name in "y", "rates":
            if file[f"state/{name}"].size:
                file[f"state/{name}"][...] = -file[f"state/{name}"][...]
    body = path.read_bytes()
    head = f"{title}\n{len(body)} bytes of HDF5 from byte {HEAD} on, checksum {checksum(body)}\n"
    path.write_bytes(head.encode().ljust(HEAD, b"\n") + body)


def conservative_mechanism(seed):
    """One that nothing damps or drives, and whose loads stay."""
    generator = Generator(seed)
    generator.stops = False
    model = generator.mechanism()
    for joint in model.joints:
        joint.entries = {key: value for key, value in joint.entries.items() if "amping" not in key}
        for entries in joint.motions.values():
            for key in "Prescribed", "Damper":
                entries.pop(key, None)
            for key in "Force", "Moment":
                if key in entries:
                    entries[key] = Function("one", entries[key].amplitude)
    for load in model.loads:
        for parts in load.forces, load.moments:
            parts[:] = [(direction, Function("one", function.amplitude)) for direction, function in parts]
    for body in model.bodies:
        if isinstance(body, Beam):
            body.damping = 0.0
    return model.with_(step=model.step / 10, steps=STEPS + 2, newton=1e-13, radius=1.0, analyses=("dynamic",))


def complaints(program, model):
    """Runs, and what is wrong."""
    with tempfile.TemporaryDirectory() as folder:
        first = Run(program, model.text_here(), folder=folder)
        said = list(judges.outcome(first))
        if first.code != 0:
            return [first], said
        reverse(pathlib.Path(folder) / "results/dynamic.checkpoint")
        back = Run(program, model.with_(steps=2 * STEPS).text_here(), "--restart", folder=folder)
    said += judges.outcome(back)
    if back.code != 0:
        said.append(f"does not go back: exit code {back.code}: {back.output[-500:]}")
    elif not (first.has_halved_steps() or back.has_halved_steps()):
        said += compare(model, back.tables["dynamic"])
    return [first, back], said


def compare(model, table):
    """Each row and the one as far from the middle."""
    n = len(table.numbers)
    if n != 2 * STEPS + 1:
        yield f"there and back are {n} rows, and not {2 * STEPS + 1}"
        return
    size = max(1.0, model.size())
    for point in model.joint_points():
        x, v = table.vector(point + ".position"), table.vector(point + ".velocity")
        error = abs(x - x[::-1]).max() / size
        if error > TOLERANCE:
            yield f"{point} comes back {error:.1e} of the size away from where it was"
        turned = np.array([rotation(np.radians(r)) for r in table.vector(point + ".rotation")])
        error = abs(turned - turned[::-1]).max()
        if error > TOLERANCE:
            yield f"{point} comes back turned by {error:.1e} rad"
        # in the middle it has turned round
        before, behind = v[:STEPS], -v[:STEPS:-1]
        error = abs(before - behind).max() / max(abs(v).max(), 1e-3 * size / model.step)
        if error > 1e3 * TOLERANCE:
            yield f"{point} comes back with a velocity that differs by {error:.1e}"
