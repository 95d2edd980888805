"""The numbers and the figure of applications/tail_rotor_governor.md: a speed governor against two inertias and a shaft.

Modes of the model against the roots of the reduced one, for several gains; the gain at which torsion begins to grow (part: critical);
droop and motion after the pedals ask for more. About a minute; results are kept in results/tail_rotor_governor."""

from numpy.polynomial import polynomial as P

from figures_of.common import BLUE, RED, Run, few, into_page, np, plt, results, runge_kutta, save, table


MODEL = "rotorcraft/tail_rotor_governor.prm"
SPEED, TORQUE, LAG, MORE = 40.0, 200.0, 0.1, 1.3
TURBINE = 0.5 + 5e-5  # kg m^2
# 3 kg m^2 of the hub, four blades of 2.45 kg/m from 0.2 to 1 m, four tips of 0.6 kg at 1 m; at half the speed a quarter
ROTOR = (3 + 4 * (2.45 * (1 - 0.2**3) / 3 + 0.6)) / 4
LENGTHS = (6.0, 1.2 * np.sqrt(2))
# half of a shaft's own inertia, 0.002 kg m, to each end; GJ/L of both and four couplings in series
STIFFNESS = 1 / (sum(LENGTHS) / 22.1e3 + 4 / 0.1e6)
DAMPING = 4 * 10 * (STIFFNESS / 0.1e6) ** 2


def rotor_drag(more):
    """Slope of more/8 w^2 at the speed w [N m s]."""
    return more * SPEED / 4


def characteristic(gain, more=1.0):
    """Of (J1 s^2 + k) (J2 s^2 + B s + k) - k^2 + k K s/(1 + T s), k = k + c s, by (1 + T s) and over s: ascending powers."""
    half = 0.5 * 0.002 * sum(LENGTHS)
    k, lag = [STIFFNESS, DAMPING], [1, LAG]
    both = P.polymul(P.polyadd([0, 0, TURBINE + half], k), P.polyadd([0, rotor_drag(more), ROTOR + half], k))
    whole = P.polyadd(P.polymul(P.polysub(both, P.polymul(k, k)), lag), P.polymul(k, [0, gain]))
    return whole[1:]


def reduced(gain):
    roots = np.roots(characteristic(gain)[::-1])
    return sorted(roots[roots.imag >= 0], key=abs)


def critical(growth):
    """The gain at which growth(gain) changes its sign."""
    low, high = 10.0, 1000.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if growth(middle) > 0 else (middle, high)
    return 0.5 * (low + high)


def modes(gain):
    """The λ of all modes of the whole model."""
    found = Run(MODEL, f"Constants/gain = {gain:.12g} N*m*s", "Analyses = static, modal",
                keep=results("tail_rotor_governor") / f"modes_{gain:g}").modes
    return found["real"] + 1j * found["imaginary"]


def nearest(values, wanted):
    return values[np.argmin(abs(values - wanted))]


def motion(gain):
    """The table of a run in time."""
    return Run(MODEL, f"Constants/gain = {gain:.12g} N*m*s", "Analyses = static, dynamic",
               keep=results("tail_rotor_governor") / f"motion_{gain:g}").dynamic


def droop(gain):
    """The speed at which the governor asks for what the rotor takes."""
    w = np.roots([MORE / 8, gain, -(TORQUE + gain * SPEED)])
    return max(w.real)


def reduced_motion(gain, end, h=1e-4):
    """Turbine, rotor, twist and engine by Runge and Kutta's rule; times and the two speeds."""
    half = 0.5 * 0.002 * sum(LENGTHS)
    x = np.array([SPEED, SPEED, TORQUE / STIFFNESS, TORQUE])

    def rate(t, x):
        shaft = STIFFNESS * x[2] + DAMPING * (x[0] - x[1])
        more = 1 + (MORE - 1) * min(1, max(0, (t - 1) / 0.2))
        return np.array(
            [
                (x[3] - shaft) / (TURBINE + half),
                (shaft - more / 8 * x[1] ** 2) / (ROTOR + half),
                x[0] - x[1],
                (TORQUE + gain * (SPEED - x[1]) - x[3]) / LAG,
            ]
        )

    rows = [[0, *x]]
    for i in range(round(end / (10 * h))):
        x = runge_kutta(rate, x, 10 * i * h, 10 * (i + 1) * h, 10)
        rows.append([10 * (i + 1) * h, *x])
    return np.array(rows)


def draw():
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.6), layout="constrained")
    for gain, colour in few(((60, BLUE), (150, RED))):
        found = motion(gain)
        model = reduced_motion(gain, found["t"][-1])
        left.plot(found["t"], 2 * found["H.rotation rate"], color=colour, lw=1.2, ls="-", label=f"K = {gain} N m s")
        left.plot(model[:, 0], model[:, 2], color="black", lw=0.6, ls="--")
        left.axhline(droop(gain), color=colour, lw=0.6, ls=":")
    left.set_xlabel("t [s]")
    left.set_ylabel("twice the rotor's speed [rad/s]")
    left.legend(frameon=False)
    gains = np.linspace(5, 260, 60)
    shown = few((60, 20, 100, 150, 200, 250))
    for pick, label in ((0, "governor"), (-1, "torsion")):
        right.plot(gains, [reduced(g)[pick].real for g in gains], color="black", lw=0.8, ls="-")
        right.plot(shown, [nearest(modes(g), reduced(g)[pick]).real for g in shown], "o", ms=4, label=label)
    right.axhline(0, color="grey", lw=0.5)
    right.set_xlabel("K [N m s]")
    right.set_ylabel("Re λ [1/s]")
    right.legend(frameon=False)
    save(figure, "tail_rotor_governor.png")


def make(parts, drawn):
    rows = []
    for gain in few((60, 20, 100, 150, 250)):
        found, roots = modes(gain), reduced(gain)
        rows.append([gain] + [f"{v.real:.3f} ± {abs(v.imag):.3f} i" for root in (roots[0], roots[-1])
                              for v in (nearest(found, root), root)])
    into_page("applications/tail_rotor_governor.md", "modes", table(
        "K [N m s] | governor, Samara | closed form | torsion, Samara | closed form", sorted(rows)))
    print("gain at which torsion grows: two inertias", round(critical(lambda g: reduced(g)[-1].real), 2), " samara",
          critical(lambda g: nearest(modes(round(g, 2)), reduced(g)[-1]).real) if "critical" in parts else "not computed")
    for gain in few((60, 100)):
        found = motion(gain)
        print(f"K = {gain}: at the end {2 * found['H.rotation rate'][-1]:.4f} rad/s, droop {droop(gain):.4f};"
              f" engine {found['engine'][-1]:.3f}")
    draw()
