"""Every entry of the catalogue, as the program itself lists it, set to extremes in a small model that has an object of its kind."""

import re
import subprocess

from outline import changed, get, parse

VALUES = ["0", "-1", "1e-300", "1e300", "1e-12", "1e12", "nan", "inf", "", "1, 2", "x", "1/0", "0, 0, 0", "1e300, 0, 0", "1e-300, 0, 0",
          "nan, 0, 0", "-1, -1, -1", "1e154, 1e154, 1e154", "0*t", "1e300*t", "1/t", "sqrt(t - 1)", "9" * 2000]
GROUPS = "Sections", "Bodies", "Joints", "Loads"
LONG = "End time", "Elements", "Load steps", "Most steps", "Pictures", "Modes", "Step", "Passages"  # large ones only make a run long

JOINTS = ["revolute", "prismatic", "screw", "cylindrical", "planar", "spherical", "universal", "rigid", "spring", "distance",
          "flexible joint", "rolling ball", "knife edge"]
OWN = {"screw": "set Pitch = 0.1", "rolling ball": "set Radius = 0.2",
       "flexible joint": "set Stiffness = 100, 100, 100\nset Rotational stiffness = 10, 10, 10", "rigid": "set Reaction = true"}
SECTIONS = {
    "engineering constants": "set EA = 1e6\nset GA2 = 1e6\nset GA3 = 1e6\nset GJ = 100\nset EI2 = 100\nset EI3 = 100\nset Mass = 1\nset I2 = 1e-4\nset I3 = 1e-4",
    "matrices": "set Stiffness = 1e6, 1e6, 1e6, 100, 100, 100\nset Inertia = 1, 1, 1, 2e-4, 1e-4, 1e-4",
    "rectangle": "set E = 2e9\nset Density = 1000\nset Width 2 = 0.02\nset Width 3 = 0.03",
    "tube": "set E = 2e9\nset Density = 1000\nset Outer radius = 0.02",
    "table": "set Stations = tube to 0, rectangle to 1"}
TAIL = """
subsection Dynamic
set Step = 0.01
set End time = 0.05
end
subsection Output
set Pictures = false
set Probes = {probes}
end
"""


def body(name, place, beam=False):
    if beam:
        return f"subsection {name}\nset Type = beam\nset Points = {place}, 0, 0; {place}, 0.5, 0\nset Section = {beam}\nset Elements = 1\nend"
    return f"subsection {name}\nset Type = rigid body\nset Mass = 1\nset Inertia = 0.1, 0.2, 0.25\nset Position = {place}, 0, 0\nset Frames = f at {place} 0.3 0.2\nend"


def mechanism_of_all_joints():
    """A body at each kind of joint, moving under its weight."""
    bodies = "\n".join(body("at " + kind, k, "tube" if kind in ("spring", "rigid") else False) for k, kind in enumerate(JOINTS))
    joints = []
    for kind in JOINTS:
        b = f"at {kind}" + (".start" if kind in ("spring", "rigid") else "")
        joints.append(f"subsection {kind}\nset Type = {kind}\nset Body A = ground\nset Body B = {b}\n{OWN.get(kind, '')}\nend")
    gears = "subsection gear\nset Type = gear\nset Joint A = revolute\nset Joint B = cylindrical\nend"
    probes = ", ".join(f"at {kind}.{'end' if kind in ('spring', 'rigid') else 'centre'}.position z" for kind in JOINTS)
    return f"""set Analyses = dynamic
subsection Sections
subsection tube
set Type = tube
{SECTIONS['tube']}
end
end
subsection Bodies
{bodies}
end
subsection Joints
{chr(10).join(joints).replace('set Body A = ground', 'set Body A = at revolute.f', 0)}
{gears}
end
subsection Loads
subsection gravity
set Type = gravity
end
end
""" + TAIL.format(probes=probes)


def cantilevers():
    """A beam of each kind of section, clamped, under loads of all kinds, in statics, modes and motion."""
    sections = "\n".join(f"subsection {kind}\nset Type = {kind}\n{text}\nend" for kind, text in SECTIONS.items() if kind != "table")
    bodies = "\n".join(body("beam" if kind == "tube" else "of " + kind, k, kind) for k, kind in enumerate(SECTIONS) if kind != "table")
    names = ["beam" if kind == "tube" else "of " + kind for kind in SECTIONS if kind != "table"]
    joints = "\n".join(f"subsection clamp {name}\nset Type = rigid\nset Body A = ground\nset Body B = {name}.start\nend" for name in names)
    return f"""set Analyses = static, modal, dynamic
subsection Sections
{sections}
end
subsection Bodies
{bodies}
{body('rigid body', 9)}
end
subsection Joints
{joints}
subsection hub
set Type = revolute
set Body A = ground
set Body B = rigid body
subsection rotation
set Spring = 10
end
end
end
subsection Loads
subsection gravity
set Type = gravity
end
subsection point load
set Type = point load
set At = beam.end
set Force = 0, 0, 1
end
subsection line load
set Type = line load
set Body = beam
set Force = 0, 0, 1
end
end
subsection Static
set Load steps = 1
end
subsection Modal
set Modes = 3
set Animations = 0
end
""" + TAIL.format(probes=", ".join(f"{name}.end.position z" for name in names))


def catalogue(program):
    """(group, kind, path of the entry) of all entries, from `--help everything`."""
    text = subprocess.run([program, "--help", "everything"], capture_output=True, text=True, check=True).stdout
    group = kind = None
    for line in text.splitlines():
        if line.startswith("## "):
            group, kind = line[3:].strip(), None
        elif line.startswith("### "):
            kind = line[4:].strip()
        elif line.startswith("| ") and not line.startswith(("| entry", "| dimension", "| a ")):
            entry = line.split("|")[1].strip()
            if group in GROUPS and kind:
                yield group, kind, entry.split(" / ")
            elif group == "The model":
                yield group, None, entry.split(" / ")
            elif group == "Analyses" and kind in ("static", "modal", "dynamic"):
                yield group, kind, entry.split(" / ")


def models(program):
    """(name, text) for every entry and value that makes sense."""
    moving, standing = parse(mechanism_of_all_joints()), parse(cantilevers())
    for group, kind, entry in catalogue(program):
        if group == "Joints":
            base, place = moving, [group, kind]
        elif group in GROUPS:
            base, place = standing, [group, kind]
        else:
            base, place = standing, [] if kind is None else [kind.capitalize()]
        for value in VALUES:
            if entry[-1] in LONG and value in ("1e12", "1e300"):
                continue
            tree = base
            if len(place) == 2 and get(base, place) is None:  # a kind that the models above do not have
                tree = changed(tree, [*place, "Type"], kind)
            yield f"{kind or 'model'} / {' / '.join(entry)} = {value[:40]}", changed(tree, [*place, *entry], value)
