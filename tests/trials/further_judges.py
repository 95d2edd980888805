"""Judges of the kinds of further.py, from places, rotations and velocities that are written. As in judges.rows: name, whether it is
an angle, values."""

import math

import numpy as np

from world import rotation


def turned(table, point, n):
    """Rotations of a body from the reference configuration, (n, 3, 3)."""
    if point == "ground":
        return np.tile(np.eye(3), (n, 1, 1))
    return np.array([rotation(math.pi / 180 * v) for v in table.vector(point + ".rotation")])


def place(model, joint, point, table, world):
    """Where the joint's place on a body is."""
    n = len(table.numbers)
    at = world.turn @ joint.place + world.shift
    if point == "ground":
        return np.tile(world.units[0] * at, (n, 1))
    arm = world.units[0] * (at - (world.turn @ model.place(point) + world.shift))
    return table.vector(point + ".position") + turned(table, point, n) @ arm


def skew_rows(model, joint, table, world):
    n = len(table.numbers)
    gap = place(model, joint, joint.b, table, world) - place(model, joint, joint.a, table, world)
    A, B = turned(table, joint.a, n), turned(table, joint.b, n)
    first, second = world.turn @ joint.axes[:, 0], world.turn @ joint.second
    for i in range(3):
        yield f"place {'xyz'[i]}", False, gap[:, i]
    yield "angle between both axes", True, np.einsum("ni,ni->n", A @ first, B @ second) - first @ second
    angles = [np.radians(table[f"{joint.name}.rotation {k}"]) for k in (1, 2)]
    built = np.array([rotation(a * first) @ rotation(b * second) for a, b in zip(*angles)])
    yield "both rotations make that of B", True, abs(np.swapaxes(A, 1, 2) @ B - built).max(axis=(1, 2), initial=0)


def wire_rows(model, joint, table, world):
    n, unit = len(table.numbers), world.units[0]
    A = turned(table, joint.a, n)
    if joint.a == "ground":
        start = at = np.zeros((n, 3))
    else:
        start = unit * (world.turn @ model.place(joint.a) + world.shift)
        at = table.vector(joint.a + ".position")
    # the point, in the axes of the description as they were on A
    seen = np.einsum("nki,nk->ni", A, table.vector(joint.b + ".position") - at) + start
    seen = (seen / unit - world.shift) @ world.turn
    samples = np.linspace(-3, 4, 1401)
    curve = np.array([joint.at(s) for s in samples])
    off = []
    for x in seen:
        s = samples[np.argmin(np.linalg.norm(curve - x, axis=1))]
        for _ in range(30):
            slope = joint.slope(min(1.0, max(0.0, s)))
            s += (x - joint.at(s)) @ slope / (slope @ slope)
        off.append(unit * np.linalg.norm(x - joint.at(s)))
    yield "distance from the wire", False, np.array(off)


def disc_rows(model, joint, table, world):
    n, unit = len(table.numbers), world.units[0]
    normal, axle = world.turn @ joint.axes[:, 2], turned(table, joint.b, n) @ (world.turn @ joint.axle)
    centre = place(model, joint, joint.b, table, world)
    slope = axle @ normal
    low = normal - axle * slope[:, None]
    arm = -unit * joint.radius * low / np.linalg.norm(low, axis=1)[:, None]
    touching = world.turn @ joint.place + world.shift
    height = unit * (normal @ touching) - unit * joint.radius * math.sqrt(1 - (joint.axle @ joint.axes[:, 2]) ** 2)
    yield "height of the edge", False, (centre + arm) @ normal - height
    spin = table.vector(joint.b + ".angular velocity")
    slip = table.vector(joint.b + ".velocity") + np.cross(spin, arm)
    fastest = max(1e-300, np.linalg.norm(spin, axis=1).max() * unit * joint.radius)
    yield "slip of the edge", True, np.linalg.norm(slip, axis=1) / fastest


ROWS = {"skew universal": skew_rows, "point on curve": wire_rows, "rolling disc": disc_rows, "springs in fixed axes": lambda *_: ()}


def meshes(model, table, world):
    """Complaints about gears with backlash: no moment within the play, that of the flank beyond."""
    for gear in model.gears:
        if not getattr(gear, "backlash", 0):
            continue
        a, b = (np.radians(table[joint.name + ".rotation"]) for joint in (gear.a, gear.b))
        pressed = abs(b - gear.ratio * a) - gear.backlash / 2
        moment = abs(table[gear.name + ".moment"])
        stiffness = gear.stiffness * world.factor((2, 1, -2))
        if moment[pressed < -1e-9].max(initial=0) > 1e-9 * stiffness:
            yield f"{gear.name}: a moment of {moment[pressed < -1e-9].max():.2g} within its play"
        if gear.restitution == 1:
            error = abs(moment - stiffness * np.maximum(0, pressed)).max(initial=0)
            if error > 1e-8 * stiffness:
                yield f"{gear.name}: its moment is {error:.2g} off the law of its flank"
