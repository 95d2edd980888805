#!/usr/bin/python3
"""Trim of a rotor with four rigid flapping blades: makes trim_flapping_rotor.csv, or with --check compares with it.

Units Omega = R = rho = 1; x aft, y to starboard, z up along the shaft, anticlockwise, psi = 0 aft. A blade is a line from its flap hinge at
.04 with inertia about the hinge alone; pitch is prescribed and has no inertia. Strips, 20 Gauss points from .2 to 1, see the flow at the
blade's axis, which is their three-quarter chord; forces act at the quarter chord, half a chord ahead, and lift is normal to the flow there.
Runge and Kutta's method of order 4 for flap angles and inflow, Newton's method with differences on periodicity and targets. Nothing is
shared with Samara but the definition of the rotor, prm/rotorcraft/flapping_rotor.prm."""

import argparse
import csv
import pathlib

import numpy as np

BLADES, SOLIDITY, SLOPE, DRAG, LOCK, HINGE, CUT_OUT, TWIST = 4, 0.08, 5.7, 0.01, 8.0, 0.04, 0.2, np.radians(-8)
CHORD = SOLIDITY * np.pi / BLADES
INERTIA = SLOPE * CHORD / LOCK  # about the hinge
STATIC = 1.5 * INERTIA / (1 - HINGE)  # static moment of a uniform rod about the hinge
THRUST = 0.0064
SCALES = np.array([0.01, 0.05, 0.05])  # of the targets
NODES, WEIGHTS = np.polynomial.legendre.leggauss(20)
RADII, WEIGHTS = CUT_OUT + (1 - CUT_OUT) * (NODES + 1) / 2, (1 - CUT_OUT) / 2 * WEIGHTS
N_STATES = 2 * BLADES + 3  # angles, rates, inflow: mean, sine, cosine


class Rotor:
    def __init__(self, mu, tilt, model, chord_counts=True):
        self.wind = np.array([mu, 0.0, -mu * np.tan(tilt)])  # of the air
        self.model, self.arm = model, CHORD / 2 if chord_counts else 0.0

    def rates(self, psi, x, controls):
        """Rates of the states; thrust, cosine and sine of flapping, torque."""
        beta, beta_rate, nu = x[:BLADES, None], x[BLADES : 2 * BLADES, None], x[2 * BLADES :]
        azimuth = psi + 2 * np.pi * np.arange(BLADES)[:, None] / BLADES
        c, s, cb, sb = np.cos(azimuth), np.sin(azimuth), np.cos(beta), np.sin(beta)
        zero = 0 * azimuth
        # axes of the blade without pitch: along it, in the direction of turning, normal to both
        e1 = np.stack([c * cb, s * cb, sb + zero], -1)
        e2 = np.stack([-s, c, zero], -1)
        e3 = np.cross(e1, e2)
        pitch = controls[0] + controls[1] * c + controls[2] * s
        pitch_rate = -controls[1] * s + controls[2] * c
        spin_along = sb + pitch_rate  # of the strip about e1
        theta = pitch + TWIST * (RADII - 0.75)
        ct, st = np.cos(theta)[..., None], np.sin(theta)[..., None]
        a2, a3 = ct * e2 + st * e3, ct * e3 - st * e2  # chord forward, normal up
        along = RADII - HINGE
        place = HINGE * np.stack([c, s, zero], -1) + along[None, :, None] * e1
        velocity = np.cross([0.0, 0.0, 1.0], place) + (along * beta_rate)[..., None] * e3
        quarter = place + self.arm * a2
        x_disk, y_disk = quarter[..., 0], quarter[..., 1]
        inflow = nu[0] + nu[1] * y_disk + nu[2] * x_disk
        air = self.wind - inflow[..., None] * np.array([0.0, 0.0, 1.0])
        relative = air - velocity
        v1, v2, v3 = (np.sum(relative * a, -1) for a in (e1, a2, a3))
        speed, alpha = np.hypot(v2, v3), np.arctan2(v3, -v2)
        w = v3 - self.arm * spin_along  # at the quarter chord
        q_u = 0.5 * CHORD * speed**2 / np.hypot(v2, w)
        lift, drag = SLOPE * alpha, DRAG
        force = (
            (0.5 * CHORD * speed * drag * v1)[..., None] * e1
            + (q_u * (lift * w + drag * v2))[..., None] * a2
            + (q_u * (drag * w - lift * v2))[..., None] * a3
        ) * WEIGHTS[:, None]
        hinge = HINGE * np.stack([c, s, zero], -1)
        flap_axis = -e2
        moment = np.sum(np.sum(np.cross(quarter - hinge, force) * flap_axis, -1), -1)
        acceleration = moment / INERTIA - (sb * (cb + HINGE * STATIC / INERTIA))[:, 0]
        thrust_of = force[..., 2]
        C = np.array([thrust_of.sum(), (thrust_of * y_disk).sum(), (thrust_of * x_disk).sum()]) / np.pi
        torque = -np.cross(quarter, force)[..., 2].sum() / np.pi
        angle = beta[:, 0]
        outputs = np.array([C[0], 2 * (angle * c[:, 0]).mean(), 2 * (angle * s[:, 0]).mean(), torque])
        return np.concatenate([beta_rate[:, 0], acceleration, self.inflow_rates(nu, C)]), outputs

    def inflow_rates(self, nu, C):
        mu, through = self.wind[0], -self.wind[2]
        if self.model == "glauert":
            total = np.hypot(mu, through + nu[0])
            return np.array([(C[0] - 2 * total * nu[0]) * 3 * np.pi / 8, -nu[1], -nu[2]])
        mean = nu[0]  # momentum theory's from the thrust: thrust = 2 V_T mean
        for _ in range(100):
            total = np.hypot(mu, through + mean)
            mean = 0.5 * mean + 0.5 * C[0] / (2 * total)
        total = np.hypot(mu, through + mean)
        return self.pitt_peters(nu, C, total, (mu**2 + (through + mean) * (through + 2 * mean)) / total, through + mean)

    def pitt_peters(self, nu, C, total, mass_flow, through):
        mu = self.wind[0]
        X = mu / (total + abs(through))
        k = (1 - X * X) / (1 + X * X)
        a = 15 * np.pi / 64 * X
        L = np.array([[0.5, 0, -a], [0, 4 / (1 + k), 0], [a, 0, 4 * k / (1 + k)]])
        return (C - np.array([total, mass_flow, mass_flow]) * np.linalg.solve(L, nu)) * np.array([3, 45 / 2, 45 / 2]) * np.pi / 8

    def turn(self, x, controls, share=1.0, steps=240):
        """The state after a share of a turn, mean outputs."""
        steps = int(steps * share)
        h, mean = 2 * np.pi * share / steps, np.zeros(4)
        for i in range(steps):
            psi = i * h
            k1, y1 = self.rates(psi, x, controls)
            k2, y2 = self.rates(psi + h / 2, x + h / 2 * k1, controls)
            k3, y3 = self.rates(psi + h / 2, x + h / 2 * k2, controls)
            k4, y4 = self.rates(psi + h, x + h * k3, controls)
            x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            mean += (y1 + 2 * y2 + 2 * y3 + y4) / 6 / steps
        return x, mean

    def trim(self, X):
        def residual(X):
            end, mean = self.turn(X[:N_STATES], X[N_STATES:], 1 / BLADES)
            # after a quarter each blade is where the one before it in the order of azimuths was
            end = np.concatenate([np.roll(end[:BLADES], 1), np.roll(end[BLADES : 2 * BLADES], 1), end[2 * BLADES :]])
            return np.concatenate([end - X[:N_STATES], (mean[:3] - [THRUST, 0, 0]) / SCALES])

        for _ in range(12):
            r = residual(X)
            if np.abs(r).max() < 1e-11:
                break
            columns = [(residual(X + d) - residual(X - d)) / 2e-6 for d in 1e-6 * np.eye(len(X))]
            X = X - np.linalg.solve(np.array(columns).T, r)
        return X


def row_of(model, mu, chord_counts=True):
    tilt = np.radians(20 * mu)
    rotor = Rotor(mu, tilt, model, chord_counts)
    nu = 0.0566 if mu == 0 else 0.003 / mu
    collective = np.radians(8 + 4 * mu)
    start = np.concatenate([np.full(BLADES, 0.07), np.zeros(BLADES), [nu, 0, 0], [collective, 0, -2 * mu * collective]])
    X = rotor.trim(start)
    _, mean = rotor.turn(X[:N_STATES], X[N_STATES:])
    return [model, mu, 20 * mu, *np.degrees(X[N_STATES:]), mean[3], *X[2 * BLADES : N_STATES], X[0]]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split(":")[0])
    parser.add_argument("--check", action="store_true", help="print the differences of the controls from the table, in degrees")
    parser.add_argument("--line", action="store_true", help="strips on a line, as in trim_strips_on_a_line.csv")
    options = parser.parse_args()
    name = "trim_strips_on_a_line.csv" if options.line else "trim_flapping_rotor.csv"
    table = pathlib.Path(__file__).with_name(name).read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in table if not line.startswith("#")))
    for row in rows:
        found = row_of(row["inflow"], round(float(row["mu"]), 9), not options.line)
        if options.check:
            errors = [value - float(cell) for value, cell in zip(found[3:6], list(row.values())[3:6])]
            print(row["inflow"], row["mu"], *(f"{error:.1e}" for error in errors), flush=True)
        else:
            print(",".join([found[0], *(f"{value:.8g}" for value in found[1:])]), flush=True)


if __name__ == "__main__":
    main()
