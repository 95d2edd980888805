"""Relatives of a model: the same mechanism in other units, or turned and moved in space, must give the same numbers."""

import math

import numpy as np

from judges import energies
from mechanism import MOTIONS
from world import (ENERGY, FREQUENCY, LENGTH, SPEED, World, rotation)

UNITS = [dict(zip(("length", "mass", "time"), (factor if k == j else 1.0 for j in range(3)))) for k in range(3) for factor in (1e-6, 1e6)]
DIMENSIONS = {"position": LENGTH, "velocity": SPEED, "angular velocity": FREQUENCY}


def turned(generator):
    """A world that is turned by a random rotation and moved by some sizes."""
    return World(turn=rotation(generator.direction() * generator.random.uniform(0.5, 3)), shift=generator.vector(3))


def as_described(model, table, world):
    """The table's columns in the units and axes of the description: name -> (values, scale of angle or length or speed)."""
    columns = {}
    for point in model.joint_points():
        for quantity, dimension in DIMENSIONS.items():
            values = table.vector(f"{point}.{quantity}") / world.factor(dimension)
            if quantity == "position":
                values = values - world.shift
            columns[f"{point}.{quantity}"] = values @ world.turn
        vectors = table.vector(f"{point}.rotation")
        columns[f"{point}.rotation"] = np.array([world.turn.T @ rotation(np.radians(v)) @ world.turn for v in vectors])
    for joint in model.joints:
        for motion, (angle, _) in MOTIONS[joint.kind].items():
            values = table[f"{joint.name}.{motion}"]
            columns[f"{joint.name}.{motion}"] = np.radians(values) if angle else values / world.factor(LENGTH)
    return columns


def compare(model, first, second, world, tolerance):
    """Complaints about what differs between a run of the description and one in another world."""
    if first.code != second.code:
        yield f"exit code {first.code} becomes {second.code}: {second.output[-300:]}"
        return
    for name in "static", "dynamic":
        if name in first.tables:
            yield from compare_tables(model, name, first.tables[name], second.tables[name], world, tolerance)
    if "modes" in first.tables:
        yield from compare_modes(first.tables["modes"], second.tables["modes"], world, 100 * tolerance)
    if "dynamic_energy" in first.tables:
        a, b = first.tables["dynamic_energy"], second.tables["dynamic_energy"]
        scale, _ = energies(model, first, World())
        for column in "kinetic", "strain", "damper loss":
            if a.numbers.shape == b.numbers.shape:
                error = abs(b[column] / world.factor(ENERGY) - a[column]).max() / scale
                if error > 10 * tolerance:
                    yield f"energy, {column}: differs by {error:.1e}"


def compare_tables(model, name, first, second, world, tolerance):
    if first.numbers.shape != second.numbers.shape:
        yield f"{name}.csv: {first.numbers.shape} rows and columns become {second.numbers.shape}"
        return
    a, b = as_described(model, first, World()), as_described(model, second, world)
    size = model.size()
    # near rest, what is left of speeds is the round-off of places over the step
    still = 1e-3 * max(1.0, size) / model.step if name == "dynamic" else 1e-3
    speed = max([still] + [abs(v).max(initial=0) for key, v in a.items() if key.endswith("velocity")])
    for key in a:
        scale = speed if key.endswith("velocity") else max(1.0, size)
        error = abs(b[key] - a[key]).max(initial=0) / scale
        if error > tolerance:
            yield f"{name}: {key} differs by {error:.1e}"


def compare_modes(first, second, world, tolerance):
    a = np.hypot(first["real"], first["imaginary"])
    b = np.hypot(second["real"], second["imaginary"]) / world.factor(FREQUENCY)
    n = min(len(a), len(b))
    scale = max(1.0, a.min(initial=math.inf))
    error = (abs(b[:n] - a[:n]) / np.maximum(a[:n], scale)).max(initial=0)
    if error > tolerance or len(a) != len(b):
        yield f"frequencies differ by {error:.1e}, {len(a)} and {len(b)} of them"
