"""Figures of a parameter study, from study.csv and study_ladder.csv; drawn by contrib/plot."""

import csv

import matplotlib.pyplot as plt
import numpy as np

MARKERS = "osD^vP*Xhd<>"
COLORS = ["#1f5fa8", "#d1495b", "#2a9d5c", "#e08e1b", "#7b4fa3", "#17a2b8", "#8c564b", "#666666"]
CHOSEN = "#2a9d5c"
FAILING = "#b22"
MAX_REASON = 110  # letters


class NoStudy(Exception):
    """There is nothing to draw; says why."""


def number(text):
    try:
        return float(text)
    except ValueError:
        return np.nan


def read_rows(path):
    if not path.exists():
        raise NoStudy(f"no {path.name}")
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def methods_of(rows):
    """method -> its rows, the reference run left out if it is no member of a method"""
    groups = {}
    for row in rows:
        if not (row["method"] == "reference" and row["role"] == "reference"):
            groups.setdefault(row["method"], []).append(row)
    return groups


def varied_entry(rows):
    """Name of the entry that is varied if it is the same for all, otherwise nothing."""
    names = {row["member"].split(" = ")[0] for row in rows if " = " in row["member"]}
    return names.pop() if len(names) == 1 else ""


def title_of(folder):
    """What the study is, and what it compares: the first lines of its text."""
    path = folder / "study.txt"
    lines = path.read_text(encoding="utf-8").split("\n\n")[0].splitlines() if path.exists() else []
    return "\n".join(lines[:2])


def shortened(text):
    return text if len(text) <= MAX_REASON else text[: MAX_REASON - 1].rstrip() + "…"


def logarithmic_if_positive(ax, axis, values):
    values = np.array(values, dtype=float)
    values = values[np.isfinite(values)]
    if len(values) and values.min() > 0:
        getattr(ax, f"set_{axis}scale")("log")
        if values.max() < 20 * values.min():  # few decades: ticks of their own, 1 2 4 8
            getattr(ax, f"{axis}axis").set_major_locator(plt.LogLocator(base=10, subs=(1, 2, 5)))
            getattr(ax, f"{axis}axis").set_major_formatter(plt.FuncFormatter(lambda x, _: f"{x:g}"))
            getattr(ax, f"{axis}axis").set_minor_formatter(plt.NullFormatter())


def draw_slopes(ax, curves):
    """The rate of the last two members of each curve, written beside it: what the table says, at a glance."""
    for x, error, color in curves:
        good = np.isfinite(x) & np.isfinite(error) & (error > 0) & (x > 0)
        x, error = x[good], error[good]
        if len(x) < 2 or x[-1] == x[-2]:
            continue
        slope = np.log(error[-1] / error[-2]) / np.log(x[-1] / x[-2])
        ax.annotate(
            f"{slope:.1f}",
            (np.sqrt(x[-1] * x[-2]), np.sqrt(error[-1] * error[-2])),
            xytext=(6, 6 if slope < 0 else -11),
            textcoords="offset points",
            color=color,
            fontsize=9,
        )


def draw_curves(folder, column, label, slopes):
    rows = read_rows(folder / "study.csv")
    groups = methods_of(rows)
    figure, ax = plt.subplots(figsize=(9.5, 6), layout="constrained")
    curves, failures, all_x, all_error = [], [], [], []
    for i, (name, members) in enumerate(groups.items()):
        color = COLORS[i % len(COLORS)]
        x = np.array([number(row[column]) for row in members])
        error = np.array([number(row["error"]) for row in members])
        error[error == 0] = np.nan  # equal to the reference: nowhere on a logarithmic axis
        failing = [row for row in members if row["outcome"].startswith("fails")]
        failures += [(name, row, number(row[column]), color) for row in failing]
        curves.append((x, error, color))
        all_x += list(x[np.isfinite(error)])
        all_error += list(error)
        shown = np.isfinite(x) & np.isfinite(error)
        if not shown.any() and not failing:
            continue
        ax.plot(
            x[shown],
            error[shown],
            marker=MARKERS[i % len(MARKERS)],
            ms=6,
            ls="-",
            color=color,
            label=name,
        )
    if not np.isfinite(all_x).any():
        plt.close(figure)
        raise NoStudy(f"study.csv has no errors over '{column}'")
    logarithmic_if_positive(ax, "x", all_x)
    logarithmic_if_positive(ax, "y", all_error)
    ax.set_xlabel(label)
    ax.set_ylabel("error")
    ax.set_title(title_of(folder), loc="left")
    if slopes:
        draw_slopes(ax, curves)
    draw_failures(ax, failures)
    if len(groups) > 1 or failures:
        ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1), borderaxespad=0)
    return figure


def draw_failures(ax, failures):
    """Members that fail: crosses at the top where their place on the axis is known, and the reason of each in words."""
    if not failures:
        return
    low, high = ax.get_xlim()
    stacked = {}
    for _, _, x, color in failures:
        if np.isfinite(x) and (x > 0 or ax.get_xscale() != "log"):
            stacked[x] = stacked.get(x, 0) + 1
            ax.plot([x], [1.01 - 0.04 * stacked[x]], "x", ms=9, mew=2, color=color, transform=ax.get_xaxis_transform(), clip_on=False)
            low, high = min(low, x), max(high, x)
    ax.set_xlim(low, high)
    reasons = {}
    for name, row, _, _ in failures:
        reasons.setdefault((name, row["outcome"]), []).append(row["member"])
    lines = [
        f"✕ {': '.join(filter(None, [name, ', '.join(filter(None, what))]))}\n   {shortened(reason)}"
        for (name, reason), what in reasons.items()
    ]
    more = [f"… and {len(lines) - 8} more, in study.csv"] if len(lines) > 8 else []
    ax.annotate(
        "\n".join(lines[:8] + more),
        (0, 0),
        xycoords="axes fraction",
        xytext=(0, -48),
        textcoords="offset points",
        va="top",
        fontsize=9,
        color=FAILING,
        annotation_clip=False,
    )


def draw_unknowns(folder):
    rows = read_rows(folder / "study.csv")
    if len({row["unknowns"] for row in rows if number(row["unknowns"]) > 0}) < 2:
        raise NoStudy("all members of the study have as many unknowns")
    return draw_curves(folder, "unknowns", "unknowns", slopes=True)


def draw_value(folder):
    rows = read_rows(folder / "study.csv")
    name = varied_entry(rows)
    if len({row["value"] for row in rows if np.isfinite(number(row["value"]))}) < 2:
        raise NoStudy("no number is varied in the study")
    return draw_curves(folder, "value", name or "varied entry", slopes=True)


def draw_time(folder):
    return draw_curves(folder, "time [s]", "time to solution, of one processor [s]", slopes=False)


def draw_ladder(folder):
    """What each level costs, and how good it is, with the tolerance and the level that is chosen."""
    rows = read_rows(folder / "study_ladder.csv")
    tolerance = number(rows[0]["tolerance"]) if rows and "tolerance" in rows[0] else np.nan
    cost = "cost [s]" if rows and "cost [s]" in rows[0] else "cost"
    places = np.arange(len(rows))
    error = np.array([number(row["error"]) for row in rows])
    price = np.array([number(row[cost]) for row in rows])
    if not np.isfinite(error).any():
        raise NoStudy("no level of the study has an error")
    figure, (upper, lower) = plt.subplots(
        2, 1, figsize=(max(7, 1.15 * len(rows) + 2), 7.5), sharex=True, layout="constrained"
    )
    colors = [
        CHOSEN if row["verdict"] == "cheapest" else COLORS[0] if row["verdict"] == "meets" else "#b9c3cd" for row in rows
    ]
    for ax, values, label in ((upper, error, "error"), (lower, price, cost)):
        shown = np.isfinite(values) & (values > 0)
        ax.set_ylabel(label)
        ax.grid(axis="x", visible=False)
        if not shown.any():
            continue
        low = min(values[shown].min(), tolerance if ax is upper and tolerance > 0 else np.inf) / 3
        ax.set_yscale("log")
        ax.set_ylim(low, 4 * max(values[shown].max(), tolerance if ax is upper and tolerance > 0 else 0))
        for place, value, color in zip(places[shown], values[shown], np.array(colors)[shown]):
            ax.bar(place, value - low, bottom=low, width=0.62, color=color)
            ax.annotate(
                f"{value:.2g}", (place, value), xytext=(0, 4), textcoords="offset points", ha="center", fontsize=9,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8}, zorder=3
            )
    if tolerance > 0:
        upper.axhline(tolerance, color=FAILING, lw=1.2, ls="--")
        upper.annotate(
            f"tolerance {tolerance:g}",
            (1, tolerance),
            xycoords=("axes fraction", "data"),
            xytext=(-2, 3),
            textcoords="offset points",
            ha="right",
            color=FAILING,
            fontsize=9,
        )
    for place, row in zip(places, rows):
        if row["verdict"].startswith("fails"):
            upper.annotate(
                "✕ " + shortened(row["verdict"]),
                (place, 0.03),
                xycoords=("data", "axes fraction"),
                rotation=90,
                ha="center",
                va="bottom",
                color=FAILING,
                fontsize=9,
            )
    lower.set_xticks(places)
    labels = [row["level"] + ("\n" + row["member"] if row["member"] else "") for row in rows]
    slanted = max(len(line) for label in labels for line in label.split("\n")) > 14
    lower.set_xticklabels(labels, rotation=30 if slanted else 0, ha="right" if slanted else "center")
    chosen = [row["level"] for row in rows if row["verdict"] == "cheapest"]
    figure.suptitle(title_of(folder), fontsize=12)
    upper.set_title(
        f"Cheapest level that meets the tolerance: {chosen[0]}" if chosen else "No level meets the tolerance"
    )
    return figure


FIGURES = {
    "study_unknowns": draw_unknowns,
    "study_value": draw_value,
    "study_time": draw_time,
    "study_ladder": draw_ladder,
}
