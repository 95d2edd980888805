"""Judges of a run. Each yields complaints, texts; none trusts what the program says of itself: constraints are computed from the
places and rotations of bodies that are written, energies from their velocities."""

import math
import re

import numpy as np

import further_judges
import touch_judges
from mechanism import MOTIONS, RigidBody
from world import ENERGY, rotation

EXITS = 0, 2, 3


def outcome(run, name="model.prm"):
    """Numbers that are finite, or a refusal that says where, or a failure that says what to try."""
    if run.code not in EXITS:
        yield f"ends with code {run.code} after {run.seconds:.0f} s: {run.output[-300:]}"
    elif run.code == 2 and not re.search(rf"{re.escape(name)}:\d+: ", run.output):
        yield f"refuses without file and line: {run.output[-300:]}"
    elif run.code == 3 and len(run.output.split()) < 5:
        yield "does not say what failed"
    elif run.code == 0:
        yield from finite(run)


def finite(run):
    for name, table in run.tables.items():
        for column in table.names:
            if column not in ("family", "pattern", "estimate", "second estimate", "factorizations") and not np.isfinite(table[column]).all():
                yield f"{name}.csv has a number that is not finite: {column}"


def readable(run):
    """What is printed is for people: not endless, no control characters, no programmer's words."""
    if len(run.output) > 20000:
        yield f"prints {len(run.output)} characters"
    if re.search(r"[\x00-\x08\x0b-\x1f\x7f]", run.output.replace("\r", "")):
        yield "prints control characters"
    if run.code == 2 and re.search("internal error|exception|dealii|Aborted|violated condition", run.output):
        yield f"speaks of the program's inside: {run.output[-300:]}"


# ------------------------------------------------------------------ constraints


def assembled(model, run):
    """The points of joints that hold them together are at one place, at all times, in a drawing with gaps, too."""
    if run.code != 0 or "dynamic" not in run.tables:
        return
    table = run.tables["dynamic"]
    bound = 1e-5 if "are left, as little as places are rounded to" in run.output else 1e-7  # of the size
    for joint in model.joints:
        if joint.kind not in ("revolute", "spherical", "universal", "rigid") or joint.arm or joint.a == "ground":
            continue
        if "centre" in (joint.a.split(".")[1], joint.b.split(".")[1]):
            continue  # held with an arm
        gap = np.linalg.norm(table.vector(joint.b + ".position") - table.vector(joint.a + ".position"), axis=1).max()
        if gap > bound * model.size():
            yield f"{joint.name}: its points are {gap:.2g} m apart"


class Frame:
    """A joint's frame on a body as the tables have it: x (n, 3), D (n, 3, 3), joint axes as columns."""

    def __init__(self, model, point, joint, table, world):
        n = len(table.numbers)
        place, axes = world.turn @ joint.place + world.shift, world.turn @ joint.axes
        if point == "ground":
            self.x, self.D = np.tile(world.units[0] * place, (n, 1)), np.tile(axes, (n, 1, 1))
            return
        start = world.turn @ model.place(point) + world.shift
        turned = [rotation(math.pi / 180 * v) for v in table.vector(point + ".rotation")]
        arm = place - start if joint.kind not in ("distance", "spring") else np.zeros(3)
        self.x = table.vector(point + ".position") + world.units[0] * np.array([R @ arm for R in turned])
        self.D = np.array([R @ axes for R in turned])


def whole_turns(angle):
    return angle - 2 * np.pi * np.round(angle / (2 * np.pi))


def rows(model, joint, table, world):
    """Constraints of a joint by name: (is an angle?, values, one a row of the table)."""
    if joint.kind.startswith("sliding"):
        yield from touch_judges.slider_rows(model, joint, table, world)
        return
    if joint.kind in further_judges.ROWS:
        yield from further_judges.ROWS[joint.kind](model, joint, table, world)
        return
    if joint.kind in ("distributing", "support"):
        return  # of nodes that are not in the tables
    a, b = Frame(model, joint.a, joint, table, world), Frame(model, joint.b, joint, table, world)
    gap = b.x - a.x
    d = np.einsum("nki,nk->ni", a.D, gap)  # in axes of A
    c = np.einsum("nki,nkj->nij", a.D, b.D)
    kind = joint.kind
    if kind in ("distance", "spring"):
        length = np.linalg.norm(gap, axis=1)
        if kind == "spring":
            yield "length", False, length - table[joint.name + ".length"]
        else:
            target = world.units[0] * np.linalg.norm(model.place(joint.b) - model.place(joint.a))
            yield "length", False, length - target
        return
    if kind == "flexible joint":
        return
    if kind == "rolling ball":
        yield "height", False, d[:, 2]
        return
    if kind == "knife edge":
        return
    locked = {"prismatic": (0, 1), "screw": (0, 1), "cylindrical": (0, 1), "planar": (2,), "in line": (0, 1),
              "in plane": (2,)}.get(kind, (0, 1, 2))
    for i in locked:
        yield f"displacement {i + 1}", False, d[:, i]
    cosines = {"prismatic": ((2, 0), (2, 1), (0, 1)), "rigid": ((2, 0), (2, 1), (0, 1)), "spherical": (), "constant velocity": (), "in line": (),
               "in plane": (),
               "universal": ((0, 1),)}
    for i, j in cosines.get(kind, ((2, 0), (2, 1))):
        yield f"angle between axes {i + 1} and {j + 1}", True, c[:, i, j]
    if kind == "constant velocity":
        yield "turn about both shafts", True, c[:, 0, 1] - c[:, 1, 0]
    held = cosines.get(kind, ((2, 0), (2, 1)))
    # axes that are normal to two others may have gone over to the reverse
    for i in [2] * ((2, 1) in held) + [0] * ((0, 1) in held and (2, 0) in held):
        yield f"axis {i + 1} reversed", True, np.where(c[:, i, i] < 0, 1.0, 0.0)
    for name, (angle, axis) in MOTIONS[kind].items():
        probed = table[f"{joint.name}.{name}"]
        if not angle:
            yield name, False, probed - d[:, axis]
        elif kind == "universal":
            measured = np.arctan2(c[:, 2, 1], c[:, 1, 1]) if axis == 0 else np.arctan2(c[:, 0, 2], c[:, 0, 0])
            yield name, True, whole_turns(np.radians(probed) - measured)
        else:
            yield name, True, whole_turns(np.radians(probed) - np.arctan2(c[:, 1, 0], c[:, 0, 0]))
        if angle and len(probed) > 1:
            yield name + ", whole turns", True, np.where(abs(np.diff(np.radians(probed))) > 3, 1.0, 0.0)
    if kind == "screw":
        turned = np.radians(table[joint.name + ".rotation"])
        yield "pitch", False, d[:, 2] - world.units[0] * joint.entries["Pitch"] * turned


def drives(model, table, world, times):
    for joint in model.joints:
        for name, entries in joint.motions.items():
            if "Prescribed" in entries:
                angle = MOTIONS[joint.kind][name][0]
                probed = table[f"{joint.name}.{name}"]
                wanted = entries["Prescribed"](times / world.units[2]) * (1 if angle else world.units[0])
                yield joint.name, "prescribed " + name, angle, (np.radians(probed) if angle else probed) - wanted
    for gear in model.gears:
        if getattr(gear, "backlash", 0):
            continue  # judged by further_judges
        a, b = (np.radians(table[joint.name + ".rotation"]) for joint in (gear.a, gear.b))
        play = np.radians(table[gear.name + ".play"]) if gear.mesh else 0.0
        yield gear.name, "play" if gear.mesh else "ratio", True, b - gear.ratio * a - play


def constraints(model, run, world, tolerance=1e-8):
    """Files of trials have all digits, so that no rounding of the input excuses a gap: of rows left out, too, the program allows
    1e-9 of the size or ten times the gap of the others (doc/theory/redundant.md), and must refuse what is above."""
    size = model.size() * world.units[0]
    for name in "static", "dynamic":
        table = run.tables.get(name)
        if table is None or not len(table.numbers):
            continue
        found = [(joint.name, *row) for joint in model.joints for row in rows(model, joint, table, world)]
        if name == "dynamic":
            found += list(drives(model, table, world, table["t"]))
        for joint, what, angle, values in found:
            worst = abs(values).max(initial=0) / (1 if angle else size)
            if worst > tolerance:
                yield f"{name}: {joint}, {what}: off by {worst:.1e} {'rad' if angle else 'of the size'}"


# --------------------------------------------------------------------- energies


def energies(model, run, world):
    """The largest energy that moved [J], and what the budget does not close but for round-off, relative to it. What is at rest has
    the energy it would have with a thousandth of its size in the time of the run, and a millionth of what is stored counts.

    Round-off as in the program: a step adds energies that are known to 2 ε of each, so that n steps close to 2 n ε Σ|E|. Of a
    spring wound to 1 J at rest, 50 steps may miss 2e-14 J, and do miss up to 9e-15 J."""
    table = run.tables["dynamic_energy"]
    columns = terms(table)
    speed = 1e-3 * model.size() / (model.step * model.steps)
    rest = model.mass() * speed**2 * world.factor(ENERGY)
    scale = max(table["kinetic"].max(), abs(columns - columns[0]).max(), 1e-6 * abs(columns).max(), rest)
    return scale, max(0, abs(table["balance"]).max() - len(columns) * round_off(columns)) / scale


def terms(table):
    """Energies that the balance is made of [J], (rows, energies)."""
    return table[[n for n in table.names if n not in ("t", "balance")]]


def round_off(columns):
    """Of the account of a step [J]; columns as of terms()."""
    return 2 * np.finfo(float).eps * abs(columns).sum(axis=1).max()


def budget(model, run, world, tolerance=1e-9):
    table = run.tables.get("dynamic_energy")
    if table is None:
        return
    scale, balance = energies(model, run, world)
    if any(getattr(contact, "beams", None) for contact in model.contacts):
        tolerance *= 10  # work at nearest places is exact to ten times the Newton tolerance a step alone
    if balance > tolerance:
        yield f"the energy balance is off by {balance:.1e} of the largest energy"
    losses = {name: np.diff(table[name]) for name in ("numerical dissipation", "damper loss", "friction loss")}
    # where something leaves its beam velocities are projected, which is counted as numerical dissipation (doc/theory/sliding.md)
    attached = [run.tables["dynamic"][f"{joint.name}.attached"] for joint in model.joints
                if getattr(joint, "leaves", False) or joint.entries.get("At the ends") == "leave"]
    for column in attached:
        if len(column) == len(table.numbers):
            losses["numerical dissipation"] = np.where(np.diff(column) != 0, 0, losses["numerical dissipation"])
    total = abs(np.cumsum(losses["numerical dissipation"])).max(initial=0)
    if model.radius == 1 and total > 1e-8 * scale:
        yield f"a scheme that preserves energy dissipates {total / scale:.1e} of it"
    for name, loss in losses.items():
        if loss.min(initial=0) < -1e-9 * scale:
            yield f"{name} falls, by {-loss.min() / scale:.1e} of the largest energy"


def worst_step(model, run, world):
    """Energy that the worst step misses, relative to the largest of the run; nan if there was no motion."""
    table = run.tables.get("dynamic_energy")
    if run.code != 0 or table is None or len(table.numbers) < 2:
        return math.nan
    scale, _ = energies(model, run, world)
    columns = terms(table)
    return max(0, abs(np.diff(table["balance"])).max() - round_off(columns)) / scale


def kinetic(model, run, world):
    """Of models of rigid bodies: ½ m v² + ½ ω·J ω from velocities, against the table. Those of the integrator and those that are
    written differ by the order h^s: this finds gross errors only."""
    if "dynamic" not in run.tables or not all(isinstance(body, RigidBody) for body in model.bodies):
        return
    table, energy = run.tables["dynamic"], run.tables["dynamic_energy"]
    total = np.zeros(len(table.numbers))
    for body in model.bodies:
        v, w = table.vector(body.name + ".centre.velocity"), table.vector(body.name + ".centre.angular velocity")
        for k, turned in enumerate(table.vector(body.name + ".centre.rotation")):
            D = rotation(math.pi / 180 * turned) @ world.turn @ body.orientation
            centre = v[k] + np.cross(w[k], D @ body.centre_of_mass) * world.units[0]
            J = D @ np.diag(body.inertia) @ D.T * world.units[0] ** 2
            total[k] += world.units[1] * 0.5 * (body.mass * centre @ centre + w[k] @ J @ w[k])
    scale, _ = energies(model, run, world)
    error = abs(total - energy["kinetic"]).max() / scale
    if error > (0.2 if model.stages == 1 else 1e-2):
        yield f"the kinetic energy of the table is not that of the velocities, {error:.1e} of the largest"


def all_of(model, run, world):
    complaints = list(outcome(run))
    slides = any(joint.kind.startswith("sliding") for joint in model.joints)  # beyond the end of a beam nothing is a number
    if run.code == 3 and not slides and re.search(r"is not a finite number \(", run.output):
        complaints.append(f"a sound model gives what is no number: {run.output[-300:]}")
    if run.code == 0:
        complaints += [*constraints(model, run, world), *budget(model, run, world), *kinetic(model, run, world)]
        complaints += further_judges.meshes(model, run.tables["dynamic"], world) if "dynamic" in run.tables else []
        complaints += [*touch_judges.contact_complaints(model, run, world), *touch_judges.momenta(model, run, world)]
    return complaints
