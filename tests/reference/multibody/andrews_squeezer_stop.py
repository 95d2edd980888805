#!/usr/bin/python3
"""Andrews' squeezing mechanism with a stop, as in prm/benchmarks/dynamics/andrews_squeezer_stop.prm: makes the table beside it.

The seven bars have their angles as unknowns, M(q) q'' + G(q)^T lambda = f, G q'' = -G' q', solved for q'' and integrated by the
explicit method of Dormand & Prince of order 8 (scipy) with tolerances of 1e-13; it is stopped and begun anew where the stop is
touched or left. Without the stop it gives the twelve digits of A03_andrews_squeezer_t0.03.csv. Nothing is shared with Samara."""

import numpy as np
from scipy.integrate import solve_ivp

END, STIFFNESS, PLACE = 0.03, 2000.0, 0.06  # s, N m/rad, rad: of gamma, the angle of the plate EBD

A, B, C, O = np.array([-0.06934, -0.00227]), np.array([-0.03635, 0.03273]), np.array([0.014, 0.072]), np.zeros(2)
NAMES = ["OF", "EF", "EBD", "GE", "AG", "HE", "AH"]
MASS = np.array([0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498])
INERTIA = np.array([2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5])
# a point: a fixed one, and for bars (c, s): c (cos, sin) + s (-sin, cos) of its angle
CENTRES = [(O, {0: (0.00092, 0)}), (O, {0: (0.007, 0), 1: (-0.0115, 0)}), (B, {2: (0.01043, -0.01874)}),
           (A, {4: (0.04, 0), 3: (0, -0.00579)}), (A, {4: (0.02308, 0.00916)}), (A, {6: (0, -0.04), 5: (0.00579, 0)}),
           (A, {6: (-0.00449, -0.01228)})]
MEETING = [(O, {0: (0.007, 0), 1: (-0.028, 0)}), (B, {2: (0, -0.035)}), (A, {4: (0.04, 0), 3: (0, -0.02)}),
           (A, {6: (0, -0.04), 5: (0.02, 0)})]
SPRING_END = (B, {2: (0.02, -0.018)})
BETA, GAMMA, PHI, DELTA, EPSILON = (-0.0617138900142764496, 0.455279819163070380, 0.222668390165885885,
                                    0.487364979543842550, 1.23054744454982119)
START = np.array([BETA, BETA, GAMMA, PHI + DELTA, DELTA, EPSILON - PHI, EPSILON])


def point(of, q, v):
    """Place, Jacobian matrix, and the acceleration without that of the angles."""
    x, J, a = of[0].copy(), np.zeros((2, 7)), np.zeros(2)
    for j, (c, s) in of[1].items():
        along, across = np.array([np.cos(q[j]), np.sin(q[j])]), np.array([-np.sin(q[j]), np.cos(q[j])])
        x += c * along + s * across
        J[:, j] = c * across - s * along
        a -= (c * along + s * across) * v[j] ** 2
    return x, J, a


def accelerations(q, v, is_touched):
    M, f = np.diag(INERTIA), np.zeros(7)
    for mass, of in zip(MASS, CENTRES):
        _, J, a = point(of, q, v)
        M = M + mass * J.T @ J
        f -= mass * J.T @ a
    f[0] += 0.033
    x, J, _ = point(SPRING_END, q, v)
    length = np.hypot(*(x - C))
    f -= J.T @ ((x - C) / length * 4530 * (length - 0.07785))
    if is_touched:
        f[2] += STIFFNESS * (PLACE - q[2])
    saddle, right = np.zeros((13, 13)), np.zeros(13)
    saddle[:7, :7], right[:7] = M, f
    _, J_first, a_first = point(MEETING[0], q, v)
    for k in range(3):
        _, J, a = point(MEETING[k + 1], q, v)
        saddle[7 + 2 * k:9 + 2 * k, :7], right[7 + 2 * k:9 + 2 * k] = J - J_first, a_first - a
    saddle[:7, 7:] = saddle[7:, :7].T
    return np.linalg.solve(saddle, right)[:7]


def integrate():
    """State at the end, and when the stop was touched and left."""
    y, t, is_touched, changes = np.concatenate([START, np.zeros(7)]), 0.0, False, []
    while t < END:
        def gap(_, y):
            return y[2] - PLACE
        gap.terminal, gap.direction = True, 1 if is_touched else -1
        done = solve_ivp(lambda _, y: np.concatenate([y[7:], accelerations(y[:7], y[7:], is_touched)]), (t, END), y,
                         method="DOP853", rtol=1e-13, atol=1e-13, events=gap)
        t, y = done.t[-1], done.y[:, -1]
        if done.status == 1:
            is_touched = not is_touched
            changes.append(t)
    return y, changes


if __name__ == "__main__":
    y, changes = integrate()
    print("# Andrews' squeezer with a stop of 2000 N m/rad at gamma = 0.06, t = 0.03 s; data as in A03_andrews_squeezer_t0.03.csv.")
    print("# CERTAINTY: derivable - made by andrews_squeezer_stop.py, ten digits; angles since the start [rad], velocities [rad/s].")
    print("# The stop is touched and left at " + ", ".join("%.9g" % t for t in changes) + " s.")
    print("bar,angle,velocity")
    for i, name in enumerate(NAMES):
        print("%s,%.12g,%.12g" % (name, y[i] - START[i], y[7 + i]))
