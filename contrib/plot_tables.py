"""Tables of results: columns of numbers with their names and units, and tables for LaTeX."""

import fnmatch
import functools
import io

import numpy as np
import pandas as pd

from plot_style import Skip, Wrong, name_of, nearest, unit_of


def texts(path):
    """The table as it is written."""
    if not path.exists():
        raise Skip(f"no {path.name}")
    text = path.read_text(encoding="utf-8", errors="replace")
    text = text[: text.rfind("\n") + 1]  # a killed run leaves a last line without its end
    if not text.strip():
        raise Skip(f"{path.name} is empty")
    kinds = {"dtype": str, "keep_default_na": False, "on_bad_lines": "skip", "index_col": False, "skipinitialspace": True}
    return pd.read_csv(io.StringIO(text), **kinds).rename(columns=str.strip)


def numbers(column):
    return pd.to_numeric(column, errors="coerce").to_numpy(float)


@functools.cache
def read(path):
    """The columns as numbers; what is not a number is nan."""
    return texts(path).apply(pd.to_numeric, errors="coerce").astype(float)


def between(path, options):
    """The rows in the window of time of the command line; where time goes back, the later rows hold."""
    rows = read(path)
    t = rows.iloc[:, 0]
    rows = rows[(t <= t[::-1].cummin()[::-1]) & (options.first <= t) & (t <= options.last)]
    if rows.iloc[:, 0].nunique() < 2:
        raise Skip(f"{path.name} has fewer than two times from {options.first:g} s to {options.last:g} s")
    return rows


def find(wanted, labels, where):
    """The labels with these names, in which * stands for anything; all if there are none."""
    found = {} if wanted else dict.fromkeys(labels)
    for text in wanted:
        fitting = [label for label in labels if fnmatch.fnmatchcase(name_of(label), name_of(text))]
        if not fitting:
            raise Wrong(f"{where} has no column '{name_of(text)}'" + nearest(name_of(text), map(name_of, labels)))
        found.update(dict.fromkeys(fitting))
    return list(found)


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
    rows = rows[find(wanted, rows.columns, path.name)]
    units = map(unit_of, rows.columns)
    left = [np.isnan(numbers(rows[label])).all() and any(rows[label]) for label in rows.columns]
    head = [[in_latex(name_of(label)) for label in rows.columns]]
    if any(map(unit_of, rows.columns)):  # in braces: after \\ a bracket would be a length
        head.append(["{[" + in_latex(unit) + "]}" if unit else "" for unit in units])
    body = [map(in_latex, row) for row in rows.itertuples(index=False)]
    yield r"\begin{tabular}{" + "".join("l" if is_text else "r" for is_text in left) + "}"
    for rule, cells in ((r"\toprule", head), (r"\midrule", body)):
        yield rule
        yield from (" & ".join(row) + r" \\" for row in cells)
    yield r"\bottomrule"
    yield r"\end{tabular}"
