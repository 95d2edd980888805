"""Units and place of a model: one description of a mechanism is written in many worlds, which must not matter.

A world has units (a length of 1 is written as `length`, and so on) and stands somewhere: a place x of the description is written
as length (turn x + shift). Rotations are matrices (3, 3)."""

import math

import numpy as np

# exponents of length, mass, time
NUMBER, LENGTH, MASS, TIME = (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)
FREQUENCY, SPEED, ACCELERATION = (0, 0, -1), (1, 0, -1), (1, 0, -2)
FORCE, MOMENT, ENERGY = (1, 1, -2), (2, 1, -2), (2, 1, -2)
SPRING, DAMPER, HINGE_SPRING, HINGE_DAMPER = (0, 1, -2), (0, 1, -1), (2, 1, -2), (2, 1, -1)
POWER, BENDING, LINE_FORCE, LINE_MOMENT = (2, 1, -3), (3, 1, -2), (0, 1, -2), (1, 1, -2)
LINE_MASS, LINE_INERTIA = (-1, 1, 0), (1, 1, 0)
INERTIA, PRESSURE, DENSITY = (2, 1, 0), (-1, 1, -2), (-3, 1, 0)


def cross_matrix(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def rotation(vector):
    """The matrix of a rotation vector [rad]."""
    angle = np.linalg.norm(vector)
    c = cross_matrix(vector)
    if angle < 1e-8:
        return np.eye(3) + c + c @ c / 2
    return np.eye(3) + math.sin(angle) / angle * c + (1 - math.cos(angle)) / angle**2 * c @ c


def angles_321(matrix):
    """Angles of Rz(a) Ry(b) Rx(c) [rad]."""
    b = math.atan2(-matrix[2, 0], math.hypot(matrix[0, 0], matrix[1, 0]))
    return math.atan2(matrix[1, 0], matrix[0, 0]), b, math.atan2(matrix[2, 1], matrix[2, 2])


def axes(third, near=None):
    """Triad (columns) with a given third axis; the first lies near a direction."""
    third = np.asarray(third) / np.linalg.norm(third)
    near = np.eye(3)[np.argmin(abs(third))] if near is None else np.asarray(near)
    first = near - third * (third @ near)
    first /= np.linalg.norm(first)
    return np.column_stack((first, np.cross(third, first), third))


class World:
    def __init__(self, length=1.0, mass=1.0, time=1.0, turn=np.eye(3), shift=np.zeros(3)):
        self.units, self.turn, self.shift = (length, mass, time), turn, shift

    def factor(self, dimension):
        return math.prod(unit**power for unit, power in zip(self.units, dimension))

    def number(self, value, dimension=NUMBER):
        return repr(float(value) * self.factor(dimension))

    def vector(self, value, dimension=NUMBER):
        """A direction or velocity or force, inertial components."""
        return ", ".join(self.number(x, dimension) for x in self.turn @ value)

    def body_vector(self, value, dimension=NUMBER):
        """Components in axes of a body, or three numbers that are no vector."""
        return ", ".join(self.number(x, dimension) for x in value)

    def place(self, value, separator=", "):
        return separator.join(self.number(x, LENGTH) for x in self.turn @ value + self.shift)

    def orientation(self, matrix):
        return ", ".join(repr(a) for a in angles_321(self.turn @ matrix))
