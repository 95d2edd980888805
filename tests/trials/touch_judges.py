"""Judges of what slides, touches and rubs, from places, rotations and forces that are written: sliders are on their beams, gaps and
forces are those of the shapes and laws, friction is within its bound, groups act on nothing but each other, momenta stay."""

import math

import numpy as np

from mechanism import Beam, RigidBody
from touching import Buffer, Group
from world import FORCE, HINGE_SPRING, rotation

BENDS = 1.01e-4  # of an element, where the slope of a rail turns (doc/theory/sliding.md)


def triads(table, point):
    return np.array([rotation(math.pi / 180 * v) for v in table.vector(point + ".rotation")])


def lagrange(nodes, x):
    """Values and slopes at x of the polynomials through the nodes."""
    polynomials = [np.poly1d([1.0])] * len(nodes)
    for a, s in enumerate(nodes):
        for b, r in enumerate(nodes):
            if b != a:
                polynomials[a] = polynomials[a] * np.poly1d([1.0, -r]) / (s - r)
    return [p(x) for p in polynomials], [p.deriv()(x) for p in polynomials]


class Line:
    """Places and turns of a beam at abscissae S, one a row of a table, from those of its nodes."""

    def __init__(self, body, table, unit):
        self.body, self.length, self.nodes = body, body.length() * unit, body.nodes()
        self.x = {p: table.vector(p + ".position") for p in body.node_points()}
        self.turns = {p: triads(table, p) for p in body.node_points()}

    def at(self, S):
        """x (n, 3), turn (n, 3, 3), and whether S is where the slope is turned from one element to the next."""
        x, turns = np.zeros((len(S), 3)), np.zeros((len(S), 3, 3))
        parts = S / self.length
        for k, part in enumerate(parts):
            nodes = self.nodes[min(len(self.nodes) - 1, max(0, int(part * len(self.nodes))))]
            held = min(1.0, max(0.0, part))
            values, slopes = lagrange(nodes, held)
            for node, value, slope in zip(nodes, values, slopes):
                name = f"{self.body.name}.at {float(node)!r}"
                weight = value + slope * (part - held)
                x[k] += weight * self.x[name][k]
                turns[k] += weight * self.turns[name][k]
        ends = parts * len(self.nodes)
        near = (abs(ends - np.round(ends)) < BENDS) & (np.round(ends) > 0) & (np.round(ends) < len(self.nodes))
        return x, turns, near


def slider_rows(model, joint, table, world):
    """As judges.rows."""
    beam = next(body for body in model.bodies if body.name == joint.a)
    moved = table[joint.name + ".displacement"]
    yield "displacement", False, np.diff(table[joint.name + ".arc length"] - moved)
    if not isinstance(beam, Beam):
        return  # a shell, of which nodes are not written
    unit = world.units[0]
    line = Line(beam, table, unit)
    x, turn, near = line.at(table[joint.name + ".arc length"])
    if joint.entries.get("At the ends") == "leave":
        near = near | (table[joint.name + ".attached"] == 0)  # nothing holds it any more
    E0, n = world.turn @ joint.axes, len(x)
    if joint.b == "ground":
        at, E = np.tile(unit * (world.turn @ joint.place + world.shift), (n, 1)), np.tile(E0, (n, 1, 1))
    else:
        at, E = table.vector(joint.b + ".position"), triads(table, joint.b) @ E0
    d = turn @ E0
    apart = np.where(near[:, None], 0, at - x)
    for i in range(3):
        yield f"place {'xyz'[i]} on the beam", False, apart[:, i]
    if len(beam.line) > 2:
        return  # its directors turn along the line
    c = np.where(near[:, None, None], np.eye(3), np.einsum("nki,nkj->nij", E, d))
    if joint.kind != "sliding point":
        yield "axis 2 against the tangent", True, c[:, 1, 0]
        yield "axis 3 against the tangent", True, c[:, 2, 0]
        yield "axis 1 reversed", True, np.where(c[:, 0, 0] < 0, 1.0, 0.0)
    if joint.kind == "sliding prismatic":
        yield "turned against the section", True, c[:, 2, 1]
    if joint.kind == "sliding screw":
        angle = joint.entries.get("Turn per length", 0.0) * moved / unit
        yield "turned by its thread", True, np.where(near, 0, np.sin(angle) * c[:, 1, 1] + np.cos(angle) * c[:, 2, 1])


# --------------------------------------------------------------------- contacts


def distance(model, contact, table, world):
    """Between the surfaces of a contact [in the world's unit], negative where they are pressed; nan where it is of another kind."""
    unit = world.units[0]
    n = len(table.numbers)
    centre = table.vector(contact.b + ".position")
    place, E = world.turn @ contact.place + world.shift, world.turn @ contact.axes
    if contact.a == "ground":
        at, axes = np.tile(unit * place, (n, 1)), np.tile(E, (n, 1, 1))
    else:
        turned = triads(table, contact.a)
        start = world.turn @ model.place(contact.a) + world.shift
        at, axes = table.vector(contact.a + ".position") + unit * turned @ (place - start), turned @ E
    delta = centre - at
    along = np.einsum("nk,nk->n", axes[:, :, 2], delta)
    radius, radius_a = unit * contact.radius, unit * contact.radius_a
    if contact.kind == "ball on plane":
        return along - radius
    if contact.kind == "ellipsoid on plane":
        body, _ = model.body(contact.b)
        frame = world.turn @ (body.orientation if isinstance(body, RigidBody) else np.eye(3))
        if not isinstance(body, RigidBody):
            return np.full(n, np.nan)
        normal = np.einsum("nki,nk->ni", triads(table, contact.b) @ frame, axes[:, :, 2])
        return along - unit * np.linalg.norm(normal * np.array(contact.semi_axes), axis=1)
    if contact.kind == "ball on cylinder":
        delta = delta - along[:, None] * axes[:, :, 2]
    size = np.linalg.norm(delta, axis=1)
    return radius_a - radius - size if contact.inside else size - radius - radius_a


def contact_complaints(model, run, world, tolerance=1e-8):
    size = model.size() * world.units[0]
    for name in "static", "dynamic":
        table = run.tables.get(name)
        if table is None or not len(table.numbers):
            continue
        for gear in model.gears:
            if gear.mesh:
                yield from (f"{name}: {gear.name}, {complaint}" for complaint in of_teeth(gear, table, world, tolerance))
        for contact in model.contacts:
            judge = of_group if isinstance(contact, Group) else of_contact
            for complaint in judge(model, contact, table, world, size, tolerance):
                yield f"{name}: {contact.name}, {complaint}"


def law_of(contact, g, world):
    """The elastic force of a law, in the world's units."""
    pressed = np.maximum(g, 0) / world.units[0]
    return contact.law.stiffness * pressed**contact.law.exponent * world.factor(FORCE)


def between(model, buffer, table, world):
    """The gap of a buffer from the abscissae of its two sliders."""
    parts = [next(joint.part for joint in model.joints if joint.name == name) for name in (buffer.a, buffer.b)]
    apart = table[buffer.b + ".arc length"] - table[buffer.a + ".arc length"]
    return (apart if parts[1] > parts[0] else -apart) - world.units[0] * buffer.length


def of_teeth(gear, table, world, tolerance):
    """Nothing between the flanks; there, what the mesh says, if it has no damper."""
    pressed = abs(np.radians(table[gear.name + ".play"])) - gear.mesh["Backlash"] / 2
    moment, k = abs(table[gear.name + ".moment"]), gear.mesh["Mesh stiffness"] * world.factor(HINGE_SPRING)
    round_off = k * tolerance
    if (moment[pressed < -tolerance] > round_off).any():
        yield "moment where no flank is touched"
    if len(gear.mesh) == 2 and (abs(moment - k * np.maximum(pressed, 0)) > round_off + 1e-9 * moment.max(initial=0)).any():
        yield "moment is another one"


def of_contact(model, contact, table, world, size, tolerance):
    gap, force = table[contact.name + ".gap"], table[contact.name + ".force"]
    measure = between if isinstance(contact, Buffer) else distance
    error = np.nanmax(abs(gap - measure(model, contact, table, world)), initial=0) / size
    if error > tolerance:
        yield f"gap: off by {error:.1e} of the size"
    wanted, off = law_of(contact, -gap, world), law_of(contact, -gap + tolerance * size, world)
    round_off = law_of(contact, tolerance * size, world) + 1e-9 * world.factor(FORCE)
    if force.min(initial=0) < -round_off:
        yield f"pulls, with {force.min()}"
    if (force[gap > tolerance * size] > round_off).any():
        yield "presses where nothing touches"
    if contact.law.is_elastic() and (abs(force - wanted) > off - wanted + round_off + 1e-9 * wanted).any():
        yield f"force: {abs(force - wanted).max():.2g} away from its law"
    if contact.law.friction() and "Bristle damping" not in contact.law.entries:
        excess = (table[contact.name + ".friction"] - contact.law.friction() * force).max(initial=0)
        if excess > 1e-9 * force.max(initial=0) + round_off:
            yield f"friction is {excess:.2g} above its bound"


def of_group(model, group, table, world, size, tolerance):
    forces = [table.vector(f"{group.name}.{body}.force") for body in group.bodies()]
    total, most = abs(sum(forces)).max(initial=0), max(abs(f).max(initial=0) for f in forces)
    if total > 1e-9 * most:
        yield f"forces on all bodies leave {total / most:.1e} of the largest"
    if group.beams:
        return
    unit, centres = world.units[0], {p: table.vector(p + ".position") for p in group.balls}
    pressed = [unit * r - (centres[p] - unit * (world.turn @ at + world.shift)) @ (world.turn @ normal)
               for at, normal in group.planes for p, r in group.balls.items()]
    names = list(group.balls)
    bodies = [("ground", p) for _ in group.planes for p in group.balls] + [(p, q) for k, p in enumerate(names) for q in names[:k]]
    pressed += [unit * (group.balls[p] + group.balls[q]) - np.linalg.norm(centres[p] - centres[q], axis=1)
                for k, p in enumerate(names) for q in names[:k]]
    depth, touched = np.maximum(0, np.max(pressed, axis=0)), np.sum(np.array(pressed) > 0, axis=0)
    sure = np.min(abs(np.array(pressed)), axis=0) > tolerance * size
    if abs(table[group.name + ".depth"] - depth).max() > tolerance * size:
        yield "depth is another one"
    if (table[group.name + ".touched"] != touched)[sure].any():
        yield "another number of pairs touches"
    if group.law.friction():
        return
    words = [group.words_of(*(point.partition(".")[0] for point in pair)) for pair in bodies]
    energy = sum(law_of(group, p, world) * np.maximum(p, 0) * said.get("stiffness", group.law.stiffness) / group.law.stiffness
                 for p, said in zip(pressed, words)) / (group.law.exponent + 1)
    if abs(table[group.name + ".energy"] - energy).max() > 1e-6 * energy.max(initial=1e-300):
        yield "energy is another one"


# ---------------------------------------------------------------------- momenta


def is_free(model):
    """Nothing acts from outside."""
    joined = [thing for thing in (*model.joints, *model.contacts) if not isinstance(thing, (Group, Buffer))]
    grounded = any(thing.a == "ground" or thing.b == "ground" for thing in joined)
    return not (grounded or model.gravity is not None or model.loads or
                any(isinstance(c, Group) and c.planes for c in model.contacts))


def momenta(model, run, world):
    """The mass centre of what is free moves evenly: with contacts alone to round-off if nothing is dissipated, otherwise to the
    order of the scheme (doc/benchmarks/stability.md), where this finds gross errors only."""
    # forces act in the triads of stages, which those of one stage leave by the square of the angle a step turns by
    tolerance = (1e-5 if model.stages == 1 else 1e-8) if model.radius == 1 and not model.joints else 0.2 if model.stages == 1 else 2e-2
    table = run.tables.get("dynamic")
    if table is None or len(table.numbers) < 3 or not is_free(model):
        return
    if not model.contacts and not any(joint.kind.startswith("sliding") for joint in model.joints):
        return
    sums, total, fastest = np.zeros((len(table.numbers), 3)), 0.0, 0.0
    for body in model.bodies:
        if isinstance(body, Beam):
            if body.rigid or len(body.line) > 2:
                return  # one node, or nodes of another line
            for nodes in body.nodes():
                polynomials = np.linalg.inv(np.vander(nodes, increasing=True))  # columns: of each node
                weights = (nodes[-1] ** np.arange(1, len(nodes) + 1) - nodes[0] ** np.arange(1, len(nodes) + 1)) / np.arange(1, len(nodes) + 1)
                for node, weight in zip(nodes, weights @ polynomials):
                    sums += body.weight() * weight * table.vector(f"{body.name}.at {float(node)!r}.position")
            total += body.weight()
            continue
        centre = table.vector(body.name + ".centre.position")
        arm = world.turn @ body.orientation @ body.centre_of_mass * world.units[0]
        sums += body.mass * (centre + triads(table, body.name + ".centre") @ arm)
        total += body.mass
        fastest = max(fastest, np.linalg.norm(table.vector(body.name + ".centre.velocity"), axis=1).max())
    x, t = sums / total, table["t"]
    gone = np.diff(t) > 1e-3 * model.step * world.units[2]
    speed = (np.diff(x, axis=0) / np.diff(t)[:, None])[gone]
    round_off = 1e-13 * abs(x).max(initial=0) / (1e-3 * model.step * world.units[2])
    error = abs(speed - speed[0]).max(initial=0)
    if error > tolerance * max(fastest, abs(speed).max(initial=0)) + round_off:
        yield f"the mass centre of what is free changes its speed by {error:.2g} of {fastest:.2g}"
