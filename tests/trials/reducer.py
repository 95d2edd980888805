"""Makes a failing model smaller while it still fails in the same way."""

import copy
import dataclasses
import itertools
import re

import numpy as np

from mechanism import Beam, Mechanism
from outline import leaves, parse, render, without


def kind_of(complaints):
    """What is said, without names and numbers."""
    return {re.sub(r"\W+", " ", re.sub(r"\b\w*\d[\w.+-]*", "", c))[:60] for c in complaints}


def reduce(thing, candidates, complaints_of, limit=200):
    """The smallest found in so many runs: candidates(thing) are smaller ones, complaints_of(thing) says what is wrong with one.
    After a success the candidates of the smaller thing are tried from the same place on; then all of them again."""
    kinds = kind_of(complaints_of(thing))
    runs, found = 0, True
    while found:
        found, k = False, 0
        while runs < limit and (smaller := next(itertools.islice(candidates(thing), k, None), None)) is not None:
            runs += 1
            if kinds & kind_of(complaints_of(smaller)):
                thing, found = smaller, True
            else:
                k += 1
    return thing


# ------------------------------------------------------------------- mechanisms


def rounded(thing, digits):
    """With all numbers rounded, those that were equal alike."""
    if isinstance(thing, (float, np.floating)):
        return float(f"{thing:.{digits}g}") if thing else 0.0
    if isinstance(thing, np.ndarray):
        return thing if thing.shape == (3, 3) else np.round(thing, digits)
    if isinstance(thing, (list, tuple)):
        return type(thing)(rounded(x, digits) for x in thing)
    if isinstance(thing, dict):
        return {key: rounded(value, digits) for key, value in thing.items()}
    if dataclasses.is_dataclass(thing):
        for key, value in vars(thing).items():
            setattr(thing, key, rounded(value, digits))
    return thing


def smaller_mechanisms(model):
    if model.steps > 3:
        yield model.with_(steps=model.steps // 2)
    for k in range(len(model.bodies)):
        name = model.bodies[k].name
        on_it = [j for j in model.joints if name in (j.a.partition(".")[0], j.b.partition(".")[0])]
        yield model.with_(bodies=model.bodies[:k] + model.bodies[k + 1 :], joints=[j for j in model.joints if j not in on_it],
                          loads=[load for load in model.loads if load.at.partition(".")[0] != name],
                          contacts=[c for c in (without_body(contact, name) for contact in model.contacts) if c],
                          gears=[g for g in model.gears if g.a not in on_it and g.b not in on_it])
    for k, joint in enumerate(model.joints):
        yield model.with_(joints=model.joints[:k] + model.joints[k + 1 :],
                          contacts=[c for c in model.contacts if joint.name not in (getattr(c, "a", ""), getattr(c, "b", ""))], gears=[g for g in model.gears if joint not in (g.a, g.b)])
    for name in "loads", "gears", "contacts":
        things = getattr(model, name)
        for k in range(len(things)):
            yield model.with_(**{name: things[:k] + things[k + 1 :]})
    if model.gravity is not None:
        yield model.with_(gravity=None)
    for analysis in model.analyses if len(model.analyses) > 1 else ():
        yield model.with_(analyses=tuple(a for a in model.analyses if a != analysis))
    yield from simpler_parts(model)


def without_body(contact, name):
    """None if the contact is one of the body; a group without it. A buffer goes with its joints."""
    if not hasattr(contact, "place") and not hasattr(contact, "balls"):
        return None
    if not hasattr(contact, "balls"):
        return None if name in (contact.a.partition(".")[0], contact.b.partition(".")[0]) else contact
    return dataclasses.replace(contact, balls={p: r for p, r in contact.balls.items() if p.partition(".")[0] != name},
                               beams={p: r for p, r in contact.beams.items() if p != name})


def simpler_parts(model):
    for k, contact in enumerate(model.contacts):
        for entry in contact.law.entries:
            new = copy.deepcopy(model)
            del new.contacts[k].law.entries[entry]
            yield new
    for k, joint in enumerate(model.joints):
        for motion, entries in joint.motions.items():
            for entry in entries:
                new = copy.deepcopy(model)
                del new.joints[k].motions[motion][entry]
                new.gears = []
                yield new
    for k, part in enumerate(model.bodies):
        if hasattr(part, "spin"):
            new = copy.deepcopy(model)
            del new.bodies[k].spin
            yield new
        if isinstance(part, Beam) and (part.elements, part.degree) != (1, 1):
            new = copy.deepcopy(model)
            new.bodies[k].elements = new.bodies[k].degree = 1
            yield new
    for digits in 1, 2, 3:
        new = rounded(copy.deepcopy(model), digits)
        if new.text_here() != model.text_here():
            yield new


# ------------------------------------------------------------------------ texts


def smaller_texts(text):
    """Without subsections, then without entries, if the file can be read; otherwise without lines."""
    tree = parse(text)
    if render(tree).split() == text.replace("\\\n", " ").split():
        for path in list(leaves(tree)):
            yield render(without(tree, path))
        return
    lines = text.splitlines()
    for size in (len(lines) // 2, len(lines) // 4, 1):
        for start in range(0, len(lines), max(1, size)):
            yield "\n".join(lines[:start] + lines[start + size :]) + "\n"


def smaller(thing):
    if isinstance(thing, str):
        return smaller_texts(thing)
    return smaller_mechanisms(thing) if isinstance(thing, Mechanism) else iter(())  # panels and sections are small
