"""The reference for Lee's frame in benchmarks/stability_snap_through.md: limit points on the exact equations of the planar rod.

No finite element: the section forces are constant between loads, the rod is integrated from the left hinge (Runge-Kutta of
order 8, tolerance 1e-12), and its unknown reactions (Fx, Fy) and angle are found so that the other end is at the other hinge,
without moment. The path of (Fx, Fy, angle, P) is followed by its arc; at limit points dP/ds = 0 by regula falsi. It takes
about two minutes and needs python3-scipy. What it prints is the reference in tests/statics/test_arc_length.cc."""

from figures_of.common import SMALL, np


L, E, A, I = 120.0, 7200.0, 6.0, 2.0  # cm, kN
EA, EI, GA = E * A, E * I, 5 / 6 * E / 2.6 * A
SCALE = np.array([200, 200, 1, 200.0])  # of Fx, Fy, angle, P
STEPS = np.array([1e-3, 1e-3, 1e-5, 1e-3])  # of difference quotients
TOLERANCE = 1e-4 if SMALL else 1e-12


def integrate(start, Fx, Fy, length):
    """Places x, y, angle, moment at the end of a piece under constant forces, for several rods at once."""
    from scipy.integrate import solve_ivp

    n = len(Fx)

    def rates(_, values):
        _, _, angle, moment = values.reshape(4, n)
        c, s = np.cos(angle), np.sin(angle)
        stretch, shear = 1 + (Fx * c + Fy * s) / EA, (Fy * c - Fx * s) / GA
        dx, dy = stretch * c - shear * s, stretch * s + shear * c
        return np.concatenate([dx, dy, moment / EI, dy * Fx - dx * Fy])

    return solve_ivp(rates, (0, length), start.ravel(), method="DOP853", rtol=TOLERANCE, atol=TOLERANCE).y[:, -1].reshape(4, n)


def miss(unknowns):
    """What is missing at the right hinge, and the place of the load."""
    Fx, Fy, angle, P = unknowns
    zero = 0 * angle
    corner = integrate(np.array([zero, zero, np.pi / 2 + angle, zero]), Fx, Fy, L)
    corner[2] -= np.pi / 2
    load = integrate(corner, Fx, Fy, L / 5)
    end = integrate(load, Fx, Fy + P, 4 / 5 * L)
    return np.array([end[0] / L - 1, end[1] / L - 1, end[3] * L / EI]), load


def linearise(unknowns):
    shifted = np.repeat(unknowns[:, None], 9, 1)
    for i in range(4):
        shifted[i, 1 + i] += STEPS[i]
        shifted[i, 5 + i] -= STEPS[i]
    r, load = miss(shifted)
    return r[:, 0], (r[:, 1:5] - r[:, 5:9]) / (2 * STEPS) * SCALE, load[:, 0]


def tangent(J, forward):
    t = np.linalg.solve(np.vstack([J, forward]), [0, 0, 0, 1])
    return t / np.linalg.norm(t)


def step(point, forward, s):
    """The point of the path in the plane at the distance s, and its tangent; None if it does not converge."""
    found = point + s * forward * SCALE
    for _ in range(8):
        r, J, load = linearise(found)
        d = np.linalg.solve(np.vstack([J, forward]), -np.append(r, forward @ ((found - point) / SCALE) - s))
        found = found + d * SCALE
        if abs(d).max() < 1e-10:
            return found, tangent(J, forward), load
    return None


def limit_point(point, forward, s, slope):
    a, b, at_a, at_b = 0, s, forward[3], slope
    while True:
        c = (a * at_b - b * at_a) / (at_b - at_a)
        found, t, load = step(point, forward, c)
        if abs(t[3]) < 1e-9:
            return found[3], load[0] - L / 5, load[1] - L
        if t[3] * at_b < 0:
            a, at_a = b, at_b
        else:
            at_a /= 2
        b, at_b = c, t[3]


def make(parts, drawn):
    point = np.zeros(4)
    forward = tangent(linearise(point)[1], np.array([0, 0, 0, 1.0]))
    s, n_found = 0.04, 0
    while n_found < (0 if SMALL else 2):
        result = step(point, forward, s)
        if result is None or result[1] @ forward < 0.97:
            s /= 2
            continue
        if result[1][3] * forward[3] < 0:
            print("limit load %.12g, the load is moved by (%.10g, %.10g)" % limit_point(point, forward, s, result[1][3]), flush=True)
            n_found += 1
        point, forward, _ = result
        s = min(1.5 * s, 0.1)
