"""Tables of the motion in applications/tail_rotor_transmission.md: how the middle of shaft 1 depends on step, scheme, mesh.

And on tolerances and what is not known exactly. Parts are words of the titles of tables. All together take about a quarter of an hour.
Seconds are those of the processor, equilibrium and start of the program (0.3 s) included. Results are kept in
results/tail_rotor_motion."""

import re

from figures_of.common import SMALL, Run, few, interpolated, into_page, np, printed, results, scheme


MODEL = "rotorcraft/tail_rotor_transmission.prm"
BEAMS = ("fuselage", "tail", "shaft 1", "shaft 2")
ALL_BEAMS = BEAMS + ("bracket S", "bracket M", "bracket T")
SHORT = ["Dynamic/End time = 0.2 s"] if SMALL else []
PROBES = "Output/Probes = shaft 1.middle.displacement y, shaft 1.middle.displacement z, S.rotation rate"


def run(name, *entries):
    """Times, (y, z) of the middle of shaft 1, speed, the words of the log, seconds of processor; None if it fails."""
    done = Run(MODEL, "Analyses = static, dynamic", PROBES, *SHORT, *entries, keep=results("tail_rotor_motion") / name.replace("/", "_"),
               may_fail=True)
    if done.code:
        return None
    words = next(line for line in done.text.splitlines() if line.startswith("dynamic:"))
    motion = done.dynamic
    places = np.column_stack([motion[f"shaft 1.middle.displacement {c}"] for c in "yz"])
    return motion["t"], places, motion["S.rotation rate"], words, done.user, int(done.number(r"(\d+) unknowns"))


def difference(a, reference):
    """Largest distance of the two motions, relative to the largest distance from the straight line."""
    distances = np.linalg.norm(a[1] - interpolated(reference[0], reference[1], a[0], 6), axis=1)
    return distances.max() / np.linalg.norm(reference[1], axis=1).max()


def counts(words):
    steps, iterations, factorizations = re.search(r"(\d+) steps, (\S+) Newton .* (\S+) factorizations", words).groups()
    closes = re.search(r"closes to (\S+)", words)[1]
    return f"{steps} | {float(iterations):.1f} | {float(factorizations):.1f}", closes


def mesh(elements, degree):
    return [f"Bodies/{b}/Elements = {n}" for b, n in zip(BEAMS, elements)] + [f"Bodies/{b}/Degree = {degree}" for b in BEAMS]


REFERENCE = ("reference", *scheme(3, 1, "1e-3"), "Dynamic/Newton tolerance = 1e-13")
COARSE = scheme(3, 0.5, "2e-3")


MEMBERS = ((3, 0.5), (3, 1), (3, 0), (2, 1), (2, 0.5), (2, 0), (1, 1), (1, 0.5), (1, 0))


def steps():
    reference = run(*REFERENCE)
    finer = run("reference, half the step", *scheme(3, 1, "5e-4"), "Dynamic/Newton tolerance = 1e-13")
    print(f"The reference, {REFERENCE[1:]}, is {difference(reference, finer):.0e} from one with half its step.\n")
    print("| stages, ρ∞ | step 8 ms | 4 ms | 2 ms | 1 ms | 0.5 ms | order | seconds |\n" + "|---" * 8 + "|")
    for stages, radius in few(MEMBERS):
        runs = [run(f"s{stages} r{radius} h{h}", *scheme(stages, radius, h)) for h in few(("8e-3", "4e-3", "2e-3", "1e-3", "5e-4"), 2)]
        errors = [difference(r, reference) if r else None for r in runs]
        pairs = [(a, b) for a, b in zip(errors, errors[1:]) if a and b and b > 3e-6]  # below is where Newton's method stops
        order = f"{np.log2(pairs[-1][0] / pairs[-1][1]):.1f}" if pairs else "–"
        done = [r for r in runs if r]
        print(f"| {stages}, {radius} | " + " | ".join(f"{e:.1e}" if e else "none" for e in errors) + f" | {order} | {done[0][4]:.1f} … {done[-1][4]:.1f} |", flush=True)


def newton():
    reference = run(*REFERENCE)
    print("| Newton tolerance | step | error | iterations a step | energy closes to | seconds |\n|---|---|---|---|---|---|")
    for tolerance in few(("1e-8", "1e-10", "1e-12", "1e-13")):
        for h in few(("2e-3", "5e-4")):
            r = run(f"newton {tolerance} h{h}", *scheme(3, 0.5, h), f"Dynamic/Newton tolerance = {tolerance}")
            number, closes = counts(r[3])
            print(f"| {tolerance} | {h} s | {difference(r, reference):.0e} | {number.split(' | ')[1]} | {closes} | {r[4]:.1f} |", flush=True)


def tolerances():
    reference = run(*REFERENCE)
    print("| tolerance | stages, ρ∞ | error | steps | iterations | factorizations | seconds |\n|---|---|---|---|---|---|---|")
    for stages, radius in few(((3, 0.5), (2, 0))):
        for tolerance in few(("1e-2", "1e-3", "1e-4", "1e-5", "1e-6")):
            r = run(f"adaptive {tolerance} s{stages}", *scheme(stages, radius, "5e-4"), "Dynamic/Step control = adaptive",
                    f"Dynamic/Tolerance = {tolerance}")
            if r:
                print(f"| {tolerance} | {stages}, {radius} | {difference(r, reference):.0e} | {counts(r[3])[0]} | {r[4]:.1f} |", flush=True)


def meshes():
    finest = run("mesh finest", *COARSE, *mesh((8, 4, 8, 4), 4))
    print("| elements of fuselage, tail, shafts 1, 2; degree | unknowns | error | seconds |\n|---|---|---|---|")
    for elements, degree in few([((8, 4, 8, 4), 3), ((4, 2, 4, 2), 4), ((4, 2, 4, 2), 3), ((2, 1, 2, 1), 4), ((2, 1, 2, 1), 3),
                                 ((1, 1, 1, 1), 4), ((1, 1, 1, 1), 3), ((8, 4, 8, 4), 2), ((4, 2, 4, 2), 2), ((16, 8, 16, 8), 1),
                                 ((4, 2, 4, 2), 1)]):
        name = ", ".join(map(str, elements)) + "; " + str(degree)
        r = run(f"mesh {name}", *COARSE, *mesh(elements, degree))
        print(f"| {name} | {r[5]} | {difference(r, finest):.0e} | {r[4]:.1f} |", flush=True)


def sensitivity():
    base = run("sensitivity base", *COARSE, "Dynamic/Newton tolerance = 1e-13")
    torque = "Joints/S/rotation/Moment = t < 1 ? 0 : t < 2 ? 12*(1 + {0})*(1 - cos(2*pi*t)) : 0 N*m"
    cases = [("torque", torque, e) for e in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)]
    cases += [("azimuth at the start", "Loads/drive/Azimuth = {0}", e) for e in (1e-2, 1e-4, 1e-6)]
    cases += [("offset of the mass", "Sections/shaft/Mass centre = (1 + {0})*1 mm, 0", e) for e in (1e-2, 1e-4)]
    cases += [("EI₂₂ of the shafts", "Sections/shaft/EI2 = (1 + {0})*26.7 kN*m^2", e) for e in (1e-2, 1e-4)]
    cases += [("mass of the shafts", "Sections/shaft/Mass = (1 + {0})*0.848 kg/m", e) for e in (1e-2, 1e-4)]
    print("| changed by a part of it [rad] | change | largest change of the motion | ratio |\n|---|---|---|---|")
    for name, entry, change in few(cases):
        r = run(f"sensitivity {name} {change}", *COARSE, "Dynamic/Newton tolerance = 1e-13", entry.format(change))
        d = difference(r, base)
        print(f"| {name} | {change:g} | {d:.1e} | {d / change:.0f} |", flush=True)


def open_questions():
    cases = [
        ("as shipped", []),
        ("azimuth 90° at the start", ["Loads/drive/Azimuth = 90 deg"]),
        ("azimuth 180° at the start", ["Loads/drive/Azimuth = 180 deg"]),
        ("unbalance in the other plane", ["Sections/shaft/Mass centre = 0, 1 mm"]),
        ("shafts of one bending stiffness", ["Sections/shaft/EI2 = 27.2 kN*m^2", "Sections/shaft/EI3 = 27.2 kN*m^2"]),
        ("brackets flexible", [f"Bodies/{b}/Rigid = false" for b in ALL_BEAMS[4:]]),
        ("blades flexible", [f"Bodies/blade {i}:blade/Rigid = false" for i in (1, 2, 3, 4)]),
        ("dampers of the couplings 10 times as large", ["Joints/coupling 1/Damping = (5, 1000, 1000) N*s/m", "Joints/coupling 1/Rotational damping = (100, 0.1, 0.1) N*m*s/rad"]),
        ("torque up to 23.4 instead of 24 N m", ["Joints/S/rotation/Moment = t < 1 ? 0 : t < 2 ? 11.7*(1 - cos(2*pi*t)) : 0 N*m"]),
        ("torque up to 26 N m", ["Joints/S/rotation/Moment = t < 1 ? 0 : t < 2 ? 13*(1 - cos(2*pi*t)) : 0 N*m"]),
        ("torque up to 48 N m", ["Joints/S/rotation/Moment = t < 1 ? 0 : t < 2 ? 24*(1 - cos(2*pi*t)) : 0 N*m"]),
    ]
    print("| model | largest distance of shaft 1 [mm] before 2 s | before 5 s | mean speed from 4 to 5 s |\n|---|---|---|---|")
    for name, entries in few(cases):
        r = run(f"open {name}", *COARSE, *entries)
        t, distance = r[0], 1e3 * np.linalg.norm(r[1], axis=1)
        print(f"| {name} | {distance[t <= 2].max():.1f} | {distance.max():.1f} | {r[2][t >= 4].mean():.2f} |", flush=True)


TABLES = {
    "Step and scheme": steps,
    "Where Newton's method stops": newton,
    "Adaptive steps": tolerances,
    "Mesh, steps of 2 ms": meshes,
    "Sensitivity, steps of 2 ms": sensitivity,
    "Other models, steps of 2 ms": open_questions,
}

def make(parts, drawn):
    for title, table in TABLES.items():
        if not parts or any(part.lower() in title.lower() for part in parts):
            into_page("applications/tail_rotor_transmission.md", title, printed(table))
