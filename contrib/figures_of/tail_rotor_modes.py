"""Tables of the modes in applications/tail_rotor_transmission.md: four frequencies against what the paper leaves open, and size.

Some minutes."""

from figures_of.common import Run, few, into_page, table


MODEL = "rotorcraft/tail_rotor_transmission.prm"
PAPER = (46.91, 49.09, 51.90, 61.03)
BEAMS = ("fuselage", "tail", "shaft 1", "shaft 2")


def frequencies(overrides):
    """Number of unknowns, the four frequencies between 45.5 and 75 rad/s."""
    run = Run(MODEL, "Analyses = static, modal", *overrides, may_fail=True)
    if run.code:
        return None, run.text.strip().splitlines()[-1]
    return int(run.number(r": (\d+) unknowns \(")), [v for v in run.modes["frequency"] if 45.5 < v < 75][:4]


def all_beams(entry, value, beams=BEAMS):
    return ["Bodies/%s/%s = %s" % (beam, entry, value) for beam in beams]


def section(name, **entries):
    return ["Sections/%s/%s = %s" % (name, entry.replace("_", " "), value) for entry, value in entries.items()]


def blades(mass, tip):
    return section("blade", Mass=mass) + ["Subsystems/blade/Bodies/tip mass/Mass = %s kg" % tip]


def flexible_blades():
    """In fixed axes as the others: beside flexible blades the response changes more in these, so that `automatic` takes turning ones."""
    return all_beams("Rigid", "false", ["blade %d" % i for i in (1, 2, 3, 4)]) + ["Modal/Axes = fixed"]


STUDIES = {
    "Size of the model (elements of fuselage, tail, shaft 1, shaft 2 times degree)": [
        ("as shipped: 4, 2, 4, 2 cubic", []),
        ("8, 4, 8, 4 quartic", sum((["Bodies/%s/Elements = %d" % (b, n)] for b, n in zip(BEAMS, (8, 4, 8, 4))), []) + all_beams("Degree", 4)),
        ("2, 1, 2, 1 cubic", sum((["Bodies/%s/Elements = %d" % (b, n)] for b, n in zip(BEAMS, (2, 1, 2, 1))), [])),
        ("1, 1, 1, 1 cubic", all_beams("Elements", 1)),
        ("1, 1, 1, 1 quartic", all_beams("Elements", 1) + all_beams("Degree", 4)),
        ("4, 2, 4, 2 quadratic", all_beams("Degree", 2)),
        ("4, 2, 4, 2 linear", all_beams("Degree", 1)),
        ("16, 8, 16, 8 linear", sum((["Bodies/%s/Elements = %d" % (b, n)] for b, n in zip(BEAMS, (16, 8, 16, 8))), []) + all_beams("Degree", 1)),
    ],
    "Brackets and blades": [
        ("brackets rigid, blades rigid", []),
        ("brackets flexible", all_beams("Rigid", "false", ("bracket S", "bracket M", "bracket T"))),
        ("brackets flexible, a tenth of the stiffness", all_beams("Rigid", "false", ("bracket S", "bracket M", "bracket T")) + section("bracket", EA="22.9e6", EI2="0.64e6", EI3="0.64e6", GJ="0.29e6", GA2="4.4e6", GA3="4.4e6")),
        ("blades flexible, EI 10 and 100 kN m2", flexible_blades()),
        ("blades flexible, EI 2 and 20 kN m2", flexible_blades() + section("blade", EI2="20e3", EI3="2e3")),
        ("no blades (1 g and 1 g/m)", blades("0.001", "0.001") + section("blade", I2="1e-6", I3="1e-6")),
        ("uniform blades of 10.4 kg and 4.3 kg m2: 3.25 kg/m", blades("3.25", "1e-4")),
        ("uniform blades of 13.6 kg and 5.64 kg m2: 4.26 kg/m", blades("4.264", "1e-4")),
        ("tips 0.1 kg heavier", blades("2.45", "0.7")),
        ("hubs of couplings without mass to speak of (1 g)", ["Bodies/hub S/Mass = 1 g"]),
    ],
    "What else the paper leaves open": [
        ("axis 2 of fuselage and tail sideways", all_beams("Axis 2", "0, 1, 0", ("fuselage", "tail"))),
        ("axis 2 of the shafts sideways", all_beams("Axis 2", "0, 1, 0", ("shaft 1", "shaft 2"))),
        ("axis 2 of all of them sideways", all_beams("Axis 2", "0, 1, 0")),
        ("tail 1.2 m long instead of 1.2 m projected", ["Constants/Lt = 1.2/sqrt(2) m"]),
        ("shear stiffnesses times 10", section("fuselage", GA2="1320e6", GA3="1320e6") + section("tail", GA2="440e6", GA3="440e6") + section("shaft", GA2="44e6", GA3="44e6")),
        ("no section inertia", section("fuselage", I2="1e-9", I3="1e-9") + section("tail", I2="1e-9", I3="1e-9") + section("shaft", I2="1e-9", I3="1e-9")),
        ("shafts below the fuselage", ["Constants/bracket = -0.25 m"]),
        ("second gear box 1:2 instead of 2:1", ["Joints/gears 2/Ratio = 2"]),
        ("drive free instead of at constant speed", ["Modal/Hold rotations = false", "Modal/Modes = 8"]),
        ("rotor plane without offset", ["Constants/offset = 0 m"]),
    ],
}

def make(parts, drawn):
    failed = []
    for title, cases in STUDIES.items():
        rows = []
        for name, overrides in few(cases):
            unknowns, found = frequencies(overrides)
            if unknowns is None or len(found) < 4:
                rows.append([name, f"fails: {found}"])
                failed.append(name)
                continue
            worst = max(abs(f / p - 1) for f, p in zip(found, PAPER))
            rows.append([name, unknowns, *(f"{f:.3f}" for f in found), f"{100 * worst:.2f} %"])
        into_page("applications/tail_rotor_transmission.md", title,
                  table("model | unknowns | shaft | shaft | fuselage | fuselage | largest difference from the paper", rows))
    if failed:
        raise SystemExit("no four frequencies: " + ", ".join(failed))
