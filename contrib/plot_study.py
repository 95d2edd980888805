"""Figures of a parameter study, from study.csv; drawn by contrib/plot."""

import textwrap

import numpy as np

from plot_style import MARKERS, Skip, legend, logarithmic, look, panels
from plot_tables import numbers, texts


def draw_errors(column, label, runs, options):
    """Errors against a column, a curve a method; beside it the rate of its last two members; below what fails, and why."""
    rows = texts(runs[0].folder / "study.csv")
    rows = rows[~((rows["method"] == "reference") & (rows["role"] == "reference"))]
    rows = rows.assign(x=numbers(rows[column]), error=numbers(rows["error"])).replace({"error": {0: np.nan}})
    drawn = rows.dropna(subset=["x", "error"])
    if not drawn.groupby("method")["x"].nunique().max() > 1:
        raise Skip(f"study.csv has no errors over several '{column}' of a method")
    varied = {member.split(" = ")[0] for member in rows["member"] if " = " in member}
    path = runs[0].folder / "study.txt"  # begins with what the study is, and what it compares
    title = "\n".join(path.read_text(encoding="utf-8").split("\n\n")[0].splitlines()[:2]) if path.exists() else ""
    figure, (ax,) = panels(options, [70], title)
    for k, method in enumerate(rows["method"].unique()):
        own = drawn[drawn["method"] == method]
        if len(own):
            ax.plot(own["x"], own["error"], marker=MARKERS[k % 12], label=method, **look(0, 1, k))
        (x, error), n = own[["x", "error"]].to_numpy()[-2:].T, len(own)
        if column != "time [s]" and n > 1 and x[0] != x[1] and min(*x, *error) > 0:
            slope = np.log(error[1] / error[0]) / np.log(x[1] / x[0])
            if abs(slope) > 0.3:
                ax.annotate(f"{slope:.1f}", np.sqrt([x[0] * x[1], error[0] * error[1]]), (4, 3 if slope < 0 else -8),
                            textcoords="offset points", color=look(0, 1, k)["color"], fontsize=7)
    logarithmic(ax.xaxis, drawn["x"].to_numpy())
    logarithmic(ax.yaxis, drawn["error"].to_numpy())
    ax.set(xlabel=label or (varied.pop() if len(varied) == 1 else "varied entry"), ylabel="error [–]")
    lines = []
    for (method, reason), own in rows[rows["outcome"].str.startswith("fails")].groupby(["method", "outcome"], sort=False):
        lines += [f"✕ {': '.join(filter(None, [method, ', '.join(filter(None, own['member']))]))}"]
        lines += textwrap.wrap(reason, int(options.width * 22), max_lines=2, placeholder=" …")
    if lines:
        figure.supxlabel("\n".join(lines[:18]), fontsize=7, color="#b22", x=0.01, ha="left")
    legend(ax)
    return figure


def draw_costs(runs, options):
    """Errors against what a member costs: the column of study.csv that the ladder of the study has as its cost, else the time."""
    ladder = runs[0].folder / "study_ladder.csv"
    column = "time [s]"
    if ladder.exists() and "cost" in (costs := texts(ladder)).columns:  # with a unit it is the time
        rows = texts(runs[0].folder / "study.csv").set_index(["method", "member"])
        chosen = [(numbers(costs["cost"])[i], (level, member)) for i, (level, member) in enumerate(zip(costs["level"], costs["member"]))]
        for name in "unknowns", "steps", "iterations":
            if all(np.isnan(cost) or cost == float(rows.loc[[at], name].iloc[0]) for cost, at in chosen if at in rows.index):
                column = name
                break
    return draw_errors(column, f"cost: {column}" if column != "time [s]" else "time to solution, of one processor [s]", runs, options)
