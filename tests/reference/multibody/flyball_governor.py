#!/usr/bin/python3
"""The stiff flyball governor, prm/benchmarks/dynamics/flyball_governor.prm: makes the table beside it.

Three unknowns: the angle beta of both rods below the horizontal, the height z of the slider, and the speed of the shaft, which its
moment of momentum tells. Explicit method of Runge and Kutta of order 4 with steps that resolve the springs (rate 1e4/s), once more
with half of each; the digits are those that both agree on. Nothing is shared with Samara."""

import math

OMEGA, BETA, GRAVITY, STIFFNESS, DAMPING, REST = 2 * math.pi, math.radians(30), 9.81, 8e5, 4e4, 0.5
BAR, BALL, SLIDER, ARM, MIDDLE = 0.3, 5.0, 3.0, 0.05, 0.5
MASS = BAR + BALL
CENTRE = (0.5 * BAR + BALL) / MASS                                  # of a bar and its ball, from the pivot
ALONG = BAR * 2e-4 / 12
ACROSS = BAR * 1.0001 / 12 + BAR * (CENTRE - 0.5) ** 2 + BALL * (1 - CENTRE) ** 2
FIXED = 5e-6 + 0.005                                                # shaft and slider about the axis
TIMES = (1, 2.5, 5, 7.5, 10)


def inertia(beta):
    """About the axis, and its derivative by beta."""
    c, s = math.cos(beta), math.sin(beta)
    x = ARM + CENTRE * c
    return (FIXED + 2 * (MASS * x * x + ALONG * s * s + ACROSS * c * c),
            4 * (-MASS * x * CENTRE * s + (ALONG - ACROSS) * s * c))


MOMENTUM = OMEGA * inertia(BETA)[0]


def rates(beta, z, beta_rate, z_rate):
    """Of the four numbers."""
    c, s = math.cos(beta), math.sin(beta)
    J, slope = inertia(beta)
    # a coupler: from the middle of the bar to the slider
    dx, dz = MIDDLE * c, 1 - MIDDLE * s - z
    length = math.hypot(dx, dz)
    by_beta, by_z = (-dx * MIDDLE * s - dz * MIDDLE * c) / length, -dz / length
    tension = STIFFNESS * (length - REST) + DAMPING * (by_beta * beta_rate + by_z * z_rate)
    turning = 0.25 * (MOMENTUM / J) ** 2 * slope + MASS * GRAVITY * CENTRE * c - tension * by_beta
    return beta_rate, z_rate, turning / (MASS * CENTRE**2 + ACROSS), -GRAVITY - 2 * tension * by_z / SLIDER


def integrate(halved):
    """beta, z and the speed of the shaft at the times."""
    y, n, rows = (BETA, 0.5, 0.0, 0.0), 0, []
    fine, coarse, first = 2e-6 / 2**halved, 2e-5 / 2**halved, 0.01   # fine ones until the springs have settled
    plan = [(fine, round(first / fine)), (coarse, round((TIMES[-1] - first) / coarse))]
    for h, steps in plan:
        for n in range(1, steps + 1):
            a = rates(*y)
            b = rates(*[v + 0.5 * h * w for v, w in zip(y, a)])
            c = rates(*[v + 0.5 * h * w for v, w in zip(y, b)])
            d = rates(*[v + h * w for v, w in zip(y, c)])
            y = tuple(v + h / 6 * (p + 2 * q + 2 * r + s) for v, p, q, r, s in zip(y, a, b, c, d))
            t = n * h + (first if h == coarse else 0)
            if any(abs(t - wanted) < 0.5 * h for wanted in TIMES):
                rows.append((round(t, 3), y[1], MOMENTUM / inertia(y[0])[0], math.degrees(y[0])))
    return rows


if __name__ == "__main__":
    once, twice = integrate(0), integrate(1)
    apart = max(abs(p - q) for a, b in zip(once, twice) for p, q in zip(a, b))
    print("# Stiff flyball governor, IFToMM A05; data as in prm/benchmarks/dynamics/flyball_governor.prm.")
    print("# CERTAINTY: derivable - made by flyball_governor.py, with steps and half of them apart by %.0e." % apart)
    print("t,z,speed,beta")
    for row in twice:
        print("%g,%.11f,%.10f,%.9f" % row)
