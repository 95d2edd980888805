"""The chart and the tables of applications/xv15_hover.md: power in hover against two tests, and what it depends on.

Runs prm/rotorcraft/xv15_hover.prm over the collective angle for each rung of the ladder, a minute or two.

The part polars makes the drag tables in prm/rotorcraft/xv15: the source has columns at M = 0, 0.577, 0.816 and 0.949 alone, and drag does
not rise along a straight line between the second and the third. It is given there by C. N. H. Lock's law, c_d(0.577) + 20 (M - M_c)^4,
with M_c from the column at 0.816, or from 0.577 on where it would have begun before."""

import pathlib
import tempfile

from figures_of.common import (BLUE, GREEN, ORANGE, PURPLE, RED, TOP, Run, few, into_page, measured, np, plt, printed, read, save, update)


KEPT = "applications/xv15_hover.csv"
NAMES = ["rung", "collective [deg]", "CT", "CP", "CP induced", "CP profile"]
POLARS = TOP / "prm/rotorcraft/xv15"
COLUMNS = 0, 0.57735, 0.816497, 0.948683  # of the source
BETWEEN = 0.6, 0.62, 0.64, 0.66, 0.68, 0.7, 0.72, 0.74, 0.76, 0.78, 0.8
AIRFOILS = "X25 root", "X25", "X18", "X12", "X08"
THRUST = 0.004, 0.006, 0.008, 0.010, 0.012  # C_T of the tables
ANGLES = np.arange(-3, 16.1, 1.9)  # collective at 0.75 R [deg]
RADIUS, TIP_SPEED, DENSITY, SOLIDITY = 3.81, 769.4 * 0.3048, 1.225, 0.089
MASS_FLOW, PRANDTL = "Subsystems/hub/Aerodynamics/flow/Mass flow = first state", "Subsystems/hub/Aerodynamics/flow/Tip loss = Prandtl"


def shapes(harmonics, power):
    return [f"Subsystems/hub/Aerodynamics/flow/Harmonics = {harmonics}", f"Subsystems/hub/Aerodynamics/flow/Power = {power}"]


def blades(entry):
    return [f"Subsystems/blade/Surfaces/blade/{entry}"]


LADDER = {
    "(0, 0): one state": shapes(0, 0),
    "(0, 2): two radial shapes": shapes(0, 2),
    "(0, 4): three": shapes(0, 4),
    "(0, 8): five": [],
    "(0, 16): nine": shapes(0, 16),
    "(3, 9): the blades are three": shapes(3, 9),
    "(6, 12)": shapes(6, 12),
    "`Mass flow = first state`": [MASS_FLOW],
    "`Tip loss = Prandtl`": [PRANDTL],
    "no lift beyond 0.97 R": blades("Lift factor = table: 0.3 1; 3.695 1; 3.6958 0; 3.82 0"),
    "blades cut out to 0.15 R": ["Constants/r0 = 0.15*R"],
    "twice the stations": blades("Stations = 6"),
    "blades without cone": ["Constants/cone = 0.01 deg"],
    "elastic blades": ["elastic"],
    "elastic blades, half as stiff": ["elastic", "Constants/soft = 2"],
    "drag along straight lines of M": ["straight"],
    "Mach numbers 5 % less": ["Aerodynamics/air/Speed of sound = 1.05*tip/0.69"],
    "half the Mach number": ["Aerodynamics/air/Speed of sound = 2*tip/0.69"],
}


# ------------------------------------------------------------------------------------------------------------- polars


def read_polars(path):
    lines = path.read_text().splitlines()
    name, counts = lines[1].rsplit(";", 1)
    counts = [int(n) for n in counts.split()]
    tables, line = [], 2
    for n_rows in counts[1::2]:
        machs = tuple(float(x) for x in lines[line].split())
        tables.append((machs, np.array([[float(x) for x in row.split()] for row in lines[line + 1:line + 1 + n_rows]])))
        line += 1 + n_rows
    return name, tables


def write_polars(path, name, tables):
    text = ["# FREE FORMAT", name + "; " + " ".join(f"{len(machs)} {len(rows)}" for machs, rows in tables)]
    for machs, rows in tables:
        text += [" ".join(f"{x:g}" for x in machs)] + [" ".join(f"{x:.6g}" for x in row) for row in rows]
    path.write_text("\n".join(text) + "\n")


def at_columns(machs, rows):
    """The columns of the source alone."""
    return COLUMNS, rows[:, [0] + [1 + machs.index(M) for M in COLUMNS]]


def with_rise(machs, rows):
    _, rows = at_columns(machs, rows)
    low, high, d_low, d_high = COLUMNS[1], COLUMNS[2], rows[:, 2], rows[:, 3]
    growth = np.maximum(d_high - d_low, 1e-12)
    begin = np.maximum(high - (growth / 20)**0.25, low)
    columns = [np.where(d_high > d_low, d_low + growth * np.maximum((M - begin) / (high - begin), 0)**4,
                        d_low + (d_high - d_low) * (M - low) / (high - low)) for M in BETWEEN]
    return COLUMNS[:2] + BETWEEN + COLUMNS[2:], np.column_stack([rows[:, :3], *columns, rows[:, 3:]])


def polars_of(folder, change):
    for path in sorted(POLARS.glob("*.c81")):
        name, tables = read_polars(path)
        tables[1] = change(*tables[1])
        write_polars(pathlib.Path(folder, path.name), name, tables)


# --------------------------------------------------------------------------------------------------------------- runs


def run(angle, entries):
    """C_T, C_P, its induced and its profile part; None where there is no hover."""
    entries = [f"Constants/theta75 = {angle} deg", *shapes(0, 8), *entries,
               "Output/Probes = hub:flow.thrust, hub:flow.power, hub:flow.induced power, hub:flow.profile power"]
    model = "xv15_hover_elastic.prm" if "elastic" in entries else "xv15_hover.prm"
    done = Run("rotorcraft/" + model, *(e for e in entries if e != "elastic"), may_fail=True)
    if done.code:
        return None
    row = [done.static[f"hub:flow.{name}"][-1] for name in ("thrust", "power", "induced power", "profile power")]
    unit = DENSITY * np.pi * RADIUS**2 * TIP_SPEED**2
    return [row[0] / unit] + [x / (unit * TIP_SPEED) for x in row[1:]]


def measure():
    for name, entries in few(LADDER).items():
        with tempfile.TemporaryDirectory() as folder:
            if entries == ["straight"]:
                polars_of(folder, at_columns)
                entries = [f"Airfoils/{n}/File = {folder}/64-{n.replace(' ', '_')}.c81" for n in AIRFOILS]
            for angle in few(ANGLES):
                if values := run(angle, entries):
                    yield dict(zip(NAMES, [name, f"{angle:g}"] + [f"{x:.6g}" for x in values]))


def curve(rows, name):
    """Columns C_T, C_P, induced, profile of a rung in the order of the thrust."""
    values = np.array([[float(row[x]) for x in NAMES[2:]] for row in rows if row["rung"] == name])
    return values[np.argsort(values[:, 0])].T


def at_thrust(x, y, thrust):
    """y at C_T by the parabola through the three nearest points."""
    near = np.argsort(abs(x - thrust))[:3]
    return np.polyval(np.polyfit(x[near], y[near], 2), thrust)


def tested(file, runs=None):
    """Measured C_T and C_P in the order of the thrust."""
    values = np.array([[float(row["CT"]), float(row["CP"])] for row in measured(f"rotorcraft/{file}.csv", runs)])
    return values[np.argsort(values[:, 0])].T


def fitted(thrust, power, at):
    """Measured C_P at a C_T: a cubic through what was measured within 0.0025 of it."""
    near = abs(thrust - at) < 0.0025
    return np.polyval(np.polyfit(thrust[near], power[near], min(3, near.sum() - 1)), at)


SHIPPED, BASE, STRAIGHT = "(3, 9): the blades are three", "(0, 8): five", "drag along straight lines of M"


def merit(thrust, power):
    return thrust**1.5 / np.sqrt(2) / power


def draw(rows, tests):
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    for (name, (thrust, power)), marker in zip(tests.items(), "os"):
        lifted = thrust > 5e-4
        for ax, values in (axes[0], power), (axes[1], merit(np.maximum(thrust, 0), power)):
            ax.plot(thrust[lifted], values[lifted], ls="", marker=marker, ms=4, mfc="none", color="0.35", label=f"measured, {name}")
    for name, label, color, line in ((SHIPPED, "Peters-He, harmonics up to three", BLUE, "-"),
                                     (BASE, "radial shapes alone", PURPLE, "-"),
                                     ("(0, 0): one state", "one state", GREEN, "-"),
                                     ("(6, 12)", "harmonics up to six", ORANGE, "-"),
                                     (STRAIGHT, "radial shapes, drag along straight lines of M", RED, (0, (4, 1.2)))):
        thrust, power, *_ = curve(rows, name)
        for ax, values in (axes[0], power), (axes[1], merit(np.maximum(thrust, 0), power)):
            ax.plot(thrust, values, color=color, ls=line, label=label)
    axes[0].set(xlim=(0, 0.016), ylim=(0, 0.0022), xlabel="$C_T$", ylabel="$C_P$")
    axes[1].set(xlim=(0, 0.016), ylim=(0, 0.95), xlabel="$C_T$", ylabel="figure of merit")
    axes[1].legend(loc="lower right", fontsize=9)
    save(figure, "xv15_hover.png", 130)


def print_tables(rows, tests):
    reference = {name: [fitted(*of, c) for c in THRUST] for name, of in tests.items()}
    power = {name: [at_thrust(x, y, c) for c in THRUST] for name in LADDER for x, y, *_ in [curve(rows, name)]}
    print("| | " + " | ".join(f"{c:g}" for c in THRUST) + " |\n|---|" + "---|" * len(THRUST))
    for name, values in {"measured, " + n: v for n, v in reference.items()}.items():
        print(f"| C_P {name} | " + " | ".join(f"{x:.6f}" for x in values) + " |")
    for label, name in ("(3, 9)", SHIPPED), ("(0, 8)", BASE), ("(0, 8), straight lines", STRAIGHT):
        x, _, induced, profile = curve(rows, name)
        print(f"| C_P {label} | " + " | ".join(f"{p:.6f}" for p in power[name]) + " |")
        print("| of it induced | " + " | ".join(f"{at_thrust(x, induced, c):.6f}" for c in THRUST) + " |")
        print("| of it profile | " + " | ".join(f"{at_thrust(x, profile, c):.6f}" for c in THRUST) + " |")
    for label, name in ("(3, 9)", SHIPPED), ("(0, 8)", BASE):
        for test in tests:
            print(f"| {label} against {test} | " + " | ".join(f"{100 * (p / r - 1):+.1f} %" for p, r in zip(power[name], reference[test])) + " |")
    for name, values in {**{"measured, " + n: v for n, v in reference.items()}, "(3, 9)": power[SHIPPED], "(0, 8)": power[BASE]}.items():
        print(f"| figure of merit, {name} | " + " | ".join(f"{merit(c, p):.3f}" for c, p in zip(THRUST, values)) + " |")
    print()
    print("| C_P against OARF | " + " | ".join(f"{c:g}" for c in THRUST) + " |\n|---|" + "---|" * len(THRUST))
    for name in LADDER:
        print(f"| {name} | " + " | ".join(f"{100 * (p / r - 1):+.0f} %" for p, r in zip(power[name], reference["OARF"])) + " |")


def make(parts, drawn):
    if "polars" in parts:
        return polars_of(POLARS, with_rise)
    rows = read(KEPT) if drawn else update(KEPT, measure(), NAMES[:2])
    tests = {"OARF": tested("xv15_hover_oarf", {"15"}), "Wright Field": tested("xv15_hover_wadc_cr177436")}
    draw(rows, tests)
    into_page("applications/xv15_hover.md", "power", printed(print_tables, rows, tests))
