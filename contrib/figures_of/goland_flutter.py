"""The chart of flutter and divergence in theory/aerodynamics.md: Goland's wing.

Runs prm/studies/goland_flutter.prm, some seconds: the eigenvalues of all members beside the roots of the exact determinant of bending
and twist in the flow of two lags, and the closed form of the divergence."""

import re

from figures_of.common import BLUE, RED, Run, columns, np, plt, save


L, CHORD, A, RHO, M, D, EI, GJ = 6.096, 1.8288, -0.34, 1.225, 35.71, 0.18288, 9.77e6, 0.987e6
INERTIA, B = 7.445665 + M * D**2, CHORD / 2


def determinant(U, p):
    """Zero at eigenvalues p of the wing clamped at its root, see tests/aero/goland_exact.h; R. T. Jones's lags."""
    s = p * B / U
    C = 1 - 0.165 * s / (s + 0.0455) - 0.335 * s / (s + 0.3)
    pitch = C * (1 + (0.5 - A) * s)
    L_h, L_a = np.pi * s**2 + 2 * np.pi * C * s, np.pi * (s - A * s**2) + 2 * np.pi * pitch
    M_h = np.pi * A * s**2 + 2 * np.pi * (A + 0.5) * C * s
    M_a = np.pi * (-(0.5 - A) * s - (1 / 8 + A**2) * s**2) + 2 * np.pi * (A + 0.5) * pitch
    q, K = RHO * U**2 * B, np.zeros((6, 6), complex)
    K[0, 1] = K[1, 2] = K[2, 3] = K[4, 5] = 1
    K[3, 0], K[3, 4] = (-p**2 * M - q * L_h / B) / EI, (p**2 * M * D + q * L_a) / EI
    K[5, 0], K[5, 4] = (-p**2 * M * D + q * M_h) / GJ, (p**2 * INERTIA - q * B * M_a) / GJ
    values, vectors = np.linalg.eig(K * L)
    return np.linalg.det(((vectors * np.exp(values)) @ np.linalg.inv(vectors))[np.ix_([2, 3, 5], [2, 3, 5])])


def branch(p, speeds):
    """The eigenvalue that begins at p, by Newton's method from one speed to the next."""
    roots = []
    for U in speeds:
        for _ in range(30):
            f, h = determinant(U, p), 1e-5
            step = 2 * h * f / (determinant(U, p + h) - determinant(U, p - h))
            p -= step
            if abs(step) < 1e-9:
                break
        roots.append(p)
    return np.array(roots)


def computed():
    """Speed and the eigenvalues of each member."""
    def members_in(folder):
        tables = ((modes.parent.name, columns(modes)) for modes in folder.rglob("modes.csv"))
        return [(float(re.search(r"([\d.]+)_m", name)[1]), table["real"] + 1j * table["imaginary"]) for name, table in tables]

    members = Run("studies/goland_flutter.prm", study=True, see=members_in).seen
    return sorted(members, key=lambda member: member[0])


def make(parts, drawn):
    members = computed()
    figure, (growth, frequency) = plt.subplots(1, 2, figsize=(12, 4.2), layout="constrained")
    speeds = np.arange(20, 266, 5.0)
    for start, color, name in (-1.25 + 93.1j, RED, "twist, which flutters"), (-1.24 + 46.15j, BLUE, "bending"):
        exact = branch(start, speeds)
        growth.plot(speeds, exact.real, color=color, lw=1)
        frequency.plot(speeds, exact.imag, color=color, lw=1, label=name + ", exact determinant")
        near = [(U, values[np.argmin(abs(values - branch(start, np.append(speeds[speeds < U], U))[-1]))]) for U, values in members]
        growth.plot([U for U, _ in near], [p.real for _, p in near], ls="", marker="o", ms=4, color=color)
        frequency.plot([U for U, _ in near], [p.imag for _, p in near], ls="", marker="o", ms=4, color=color)
    real = [(U, max(p.real for p in values if abs(p.imag) < 1e-9)) for U, values in members]
    growth.plot([U for U, _ in real], [p for _, p in real], marker="s", ms=4, lw=0.8, color="0.4")
    divergence = np.pi / 2 / L * np.sqrt(GJ / (0.5 * RHO * CHORD * 0.08 * CHORD * 2 * np.pi))
    growth.axvline(divergence, color="0.4", ls=":")
    growth.annotate("κL = π/2", (divergence, -22), xytext=(-4, 0), textcoords="offset points", ha="right", color="0.4")
    growth.axhline(0, color="k", lw=0.6)
    growth.set(ylabel="real part [1/s]", xlabel="wind [m/s]", ylim=(-25, 25))
    frequency.set(ylabel="frequency [rad/s]", xlabel="wind [m/s]", ylim=(0, 100))
    frequency.plot([], [], marker="o", ls="", color="0.3", label="the model, five elements")
    growth.plot([], [], marker="s", ms=4, lw=0.8, color="0.4", label="largest real eigenvalue of the model")
    frequency.legend(loc="lower left")
    growth.legend(loc="upper left")
    save(figure, "goland_flutter.png")
