"""Tables of results: columns of numbers with their names and units, and tables for LaTeX."""

import copy
import difflib
import fnmatch
import functools
import io
import re

import numpy as np
import pandas as pd

from plot_style import Skip, Wrong


def split_unit(text):
    match = re.fullmatch(r"(.*?)\s*\[([^\[\]]*)\]", text.strip())
    return match.groups() if match else (text.strip(), "")


def frame(path, **kinds):
    if not path.exists():
        raise Skip(f"no {path.name}")
    text = path.read_text(encoding="utf-8", errors="replace")
    text = text[: text.rfind("\n") + 1]  # a killed run leaves a last line without its end
    if not text.strip():
        raise Skip(f"{path.name} is empty")
    return pd.read_csv(io.StringIO(text), on_bad_lines="skip", index_col=False, skipinitialspace=True, **kinds)


def texts(path):
    """The table as it is written."""
    return frame(path, dtype=str, keep_default_na=False)


def numbers(column):
    return pd.to_numeric(column, errors="coerce").to_numpy(float)


def find(wanted, labels, where):
    """The labels with these names, in which * stands for anything; all if there are none."""
    found = {} if wanted else dict.fromkeys(labels)
    names = {label: split_unit(label)[0] for label in labels}
    for text in wanted:
        name = split_unit(text)[0]
        fitting = [label for label in labels if fnmatch.fnmatchcase(names[label], name)]
        if not fitting:
            near = difflib.get_close_matches(name, names.values(), 1, 0)
            raise Wrong(f"{where} has no column '{name}'" + (f"; the nearest is '{near[0]}'" if near else ""))
        found.update(dict.fromkeys(fitting))
    return list(found)


class Table:
    """A CSV file: names, units and the numbers as columns; what is not a number is nan."""

    def __init__(self, path):
        self.path = path
        rows = frame(path)
        self.labels = [label.strip() for label in rows.columns]
        self.names, self.units = zip(*map(split_unit, self.labels))
        self.values = np.column_stack([numbers(rows[label]) for label in rows.columns]).reshape(-1, len(self.labels))

    def column(self, name):
        if name not in self.names:
            raise Skip(f"{self.path.name} has no column '{name}'")
        return self.values[:, self.names.index(name)]

    def between(self, options):
        """The rows in the window of time of the command line; where time goes back, the later rows hold."""
        t = self.values[:, 0]
        holds = t <= np.fmin.accumulate(t[::-1])[::-1]
        part = copy.copy(self)
        part.values = self.values[holds & (options.first <= t) & (t <= options.last)]
        if len(np.unique(part.values[:, 0])) < 2:
            raise Skip(f"{self.path.name} has fewer than two times from {options.first:g} s to {options.last:g} s")
        return part

    def means(self, most):
        """Of rows next to each other, such that not more are left."""
        part = copy.copy(self)
        if len(self.values) > most:
            part.values = np.array([rows.mean(axis=0) for rows in np.array_split(self.values, most)])
        return part


read = functools.cache(Table)

LETTERS = {"\\": r"\textbackslash{}", "^": r"\^{}", "~": r"\~{}", "²": "$^2$", "³": "$^3$", "⁴": "$^4$", "–": "--", "°": r"$^\circ$"}
LETTERS |= {letter: "\\" + letter for letter in "_%&#$"} | {"{": r"\{", "}": r"\}"}


def in_latex(text):
    try:
        digits, _, power = f"{float(text):.4g}".partition("e")
    except ValueError:
        return "".join(LETTERS.get(letter, letter) for letter in text)
    if not np.isfinite(float(text)):
        return "--" if np.isnan(float(text)) else f"${float(text):g}$".replace("inf", r"\infty")
    return f"${digits}" + (rf" \times 10^{{{int(power)}}}$" if power else "$")


def latex(path, wanted):
    """Lines of a table with booktabs: names over units, numbers of four digits."""
    rows = texts(path)
    rows = rows[find(wanted, list(rows.columns), path.name)]
    names, units = zip(*map(split_unit, rows.columns))
    left = [np.isnan(numbers(rows[label])).all() and any(rows[label]) for label in rows.columns]
    yield r"\begin{tabular}{" + "".join("l" if is_text else "r" for is_text in left) + "}"
    yield r"\toprule"
    yield " & ".join(map(in_latex, names)) + r" \\"
    if any(units):  # in braces: after \\ a bracket would be a length
        yield " & ".join("{[" + in_latex(unit) + "]}" if unit else "" for unit in units) + r" \\"
    yield r"\midrule"
    for row in rows.itertuples(index=False):
        yield " & ".join(map(in_latex, row)) + r" \\"
    yield r"\bottomrule"
    yield r"\end{tabular}"
