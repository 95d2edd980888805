"""Relatives of a model that differ in names alone, or that have it twice: the numbers must be the same."""

import re

import numpy as np

from outline import parse, render

SETTINGS = ("Static", "Modal", "Dynamic", "Output", "Constants", "Floquet", "Trim", "Study")

# what the program says itself, of which one is the end of another
HOSTILE = ["1", "joint 1", "body 1", "2", "joint 2", "axis 2", "gear 1", "section 1", "rotation", "displacement", "spring", "weld of 1",
           "slide of 1", "rigid body", "steady rotation", "control", "end", "start of 1", "1 on 2", "a-b", "a b", "a_b", "row 1",
           "velocity x", "moment 3", "upper stop", "swash plate", "slide of swash plate", "reference", "load factor", "time",
           "inflow", "lag", "state", "model", "middle", "x", "axis 1", "friction", "load 1", "joint 1 1", "of"]


def objects(tree):
    """Names of all objects: subsections of those of the file that are no settings."""
    return [name for group, inner in tree if isinstance(inner, list) and group not in SETTINGS for name, value in inner
            if isinstance(value, list)]


def renamed(tree, names):
    """The tree with other names of objects, where they stand and where they are named; `names` is a dictionary."""
    word = re.compile(r"(?<!\w)(" + "|".join(map(re.escape, sorted(names, key=len, reverse=True))) + r")(?!\w)")

    def in_values(value):
        if isinstance(value, list):
            return [[key, in_values(inner)] for key, inner in value]
        return word.sub(lambda match: names[match[0]], value)

    result = []
    for group, inner in tree:
        if isinstance(inner, list) and group not in SETTINGS:
            inner = [[names.get(name, name), in_values(value)] for name, value in inner]
        elif isinstance(inner, list):
            inner = in_values(inner)
        result.append([group, inner])
    return result


def with_hostile_names(text, chance):
    """The text with names that are easily taken for something else."""
    tree = parse(text)
    old = objects(tree)
    new = HOSTILE[:]
    chance.shuffle(new)
    return render(renamed(tree, dict(zip(old, new)))) if len(old) <= len(new) else text


def with_a_second_copy(text):
    """The text with each object a second time, under another name, in the same places: neither knows of the other. What acts on
    all, as gravity does, stays alone."""
    tree = parse(text)
    names = {name: f"second {name}" for name in objects(tree)}
    second = dict(renamed(tree, names))
    result = []
    for group, inner in tree:
        if isinstance(inner, list) and group not in SETTINGS:
            inner = inner + [item for item in second[group] if not acts_on_all(item[1])]
        result.append([group, inner])
    return render(result)


def acts_on_all(entries):
    return ["Type", "gravity"] in entries or ["Type", "steady rotation"] in entries


def compare(first, second, tolerance):
    """Complaints about tables of two runs whose columns stand in the same order."""
    if first.code != second.code:
        yield f"exit code {first.code} becomes {second.code}: {second.output[-300:]}"
        return
    for name in "static", "dynamic":
        if name not in first.tables:
            continue
        a, b = first.tables[name].numbers, second.tables.get(name, first.tables[name]).numbers
        if name not in second.tables or a.shape != b.shape:
            yield f"{name}.csv: {a.shape} rows and columns become {b.shape}"
            continue
        # a column that rests has the round-off of the largest
        scale = np.maximum(np.nanmax(abs(a), axis=0, initial=0), 1e-3 * np.nanmax(abs(a), initial=1))
        error = np.nanmax(abs(b - a) / scale, initial=0)
        if error > tolerance:
            yield f"{name}: a column differs by {error:.1e}"
