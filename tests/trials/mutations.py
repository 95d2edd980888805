"""Small damages to a .prm file that is right, as a tired user or an editor would do them."""

import re

NUMBERS = ["0", "-1", "1e308", "-1e308", "1e-308", "nan", "inf", "1e400", "", "1/0", "0/0", "sqrt(-1)", "x", "1, 2", "1 m", "1 s",
           "3 kg*m^2/s", "1e5", "-0", "1;", "(", "2*", "0x10", "1,5", "½", "1e", "--1", "t", "t^t", "9" * 400]
WORDS = ["ground", "b0", "b0.centre", "end", "", "set", "subsection", "true", "rigid", "beam", "revolute", "no such thing", "ä", "\x07",
         "..", "b0.", ".j", "b0.j.j", "a" * 5000]
LINES = ["end", "subsection x", "set", "set =", "set a", "subsection", "include nothing.prm", "\\", "# a remark", "\t", "set Title = again",
         "subsection Bodies", "set Copy of = b0", "end end", "\ufeff", "\x00", "set Position = 0, 0, 0", "sub section Joints"]
SLOW = "Step", "End time", "Elements", "Degree", "Mesh", "Load steps", "Modes", "Smallest step", "Stages", "Iterations", "Tolerance"


def number(random, lines):
    """Another number, but not where it only makes a run long."""
    k = random.randrange(len(lines))
    numbers = list(re.finditer(r"(?<![\w.])-?\d[\d.]*(e-?\d+)?", lines[k]))
    if "=" not in lines[k] or not numbers or any(word in lines[k].partition("=")[0] for word in SLOW):
        return word(random, lines)
    place = random.choice(numbers)
    lines[k] = lines[k][: place.start()] + random.choice(NUMBERS) + lines[k][place.end() :]


def word(random, lines):
    k = random.randrange(len(lines))
    words = list(re.finditer(r"[\w.]+", lines[k].partition("=")[2] or lines[k]))
    if words and not any(word in lines[k].partition("=")[0] for word in SLOW):
        old = random.choice(words)[0]
        lines[k] = lines[k].replace(old, random.choice(WORDS), 1)


def letter(random, lines):
    k = random.randrange(len(lines))
    if lines[k] and not any(word in lines[k].partition("=")[0] for word in SLOW):
        place = random.randrange(len(lines[k]))
        lines[k] = lines[k][:place] + random.choice(["", "a", "=", ",", ";", " ", "\\", "\u00e9", "\t"]) + lines[k][place + 1 :]


def delete(random, lines):
    del lines[random.randrange(len(lines))]


def double(random, lines):
    lines.insert(random.randrange(len(lines)), random.choice(lines))


def swap(random, lines):
    j, k = random.randrange(len(lines)), random.randrange(len(lines))
    lines[j], lines[k] = lines[k], lines[j]


def insert(random, lines):
    lines.insert(random.randrange(len(lines)), random.choice(LINES))


def truncate(random, lines):
    del lines[random.randrange(1, len(lines) + 1) :]


KINDS = [number] * 6 + [word] * 3 + [letter] * 2 + [delete, double, swap, insert, truncate]


def mutant(random, text):
    lines = text.replace(" \\\n", " ").splitlines()
    for _ in range(random.choice((1, 1, 1, 2, 3))):
        if lines:
            random.choice(KINDS)(random, lines)
    return "\n".join(lines) + "\n"
