"""Figures of a parameter study, from study.csv and study_ladder.csv; drawn by contrib/plot."""

import textwrap

import matplotlib.pyplot as plt
import numpy as np

from plot_style import COLORS, MARKERS, MM, Skip, legend, panels
from plot_tables import numbers, texts

CHOSEN, FAILING, OTHER = "#2a9d5c", "#b22", "#8a98a6"


def title_of(run):
    """What the study is, and what it compares: the first lines of its text."""
    path = run.folder / "study.txt"
    lines = path.read_text(encoding="utf-8").split("\n\n")[0].splitlines() if path.exists() else []
    return "\n".join(lines[:2])


def logarithmic(axis, values):
    """If all are positive; of few decades with ticks 1 3 10."""
    values = values[np.isfinite(values)]
    if len(values) and values.min() > 0:
        axis._set_axes_scale("log")
        if values.max() < 20 * values.min():
            axis.set_major_locator(plt.LogLocator(base=10, subs=(1, 3)))
            axis.set_major_formatter(plt.FuncFormatter(lambda x, _: f"{x:g}"))
            axis.set_minor_formatter(plt.NullFormatter())


def draw_errors(column, label, runs, options):
    """Errors against a column, a curve a method; beside it the rate of its last two members."""
    rows = texts(runs[0].folder / "study.csv")
    rows = rows[~((rows["method"] == "reference") & (rows["role"] == "reference"))]
    rows = rows.assign(x=numbers(rows[column]), error=np.where(numbers(rows["error"]) == 0, np.nan, numbers(rows["error"])))
    drawn = rows[np.isfinite(rows["x"]) & np.isfinite(rows["error"])]
    if not drawn.groupby("method")["x"].nunique().max() > 1:
        raise Skip(f"study.csv has no errors over several '{column}' of a method")
    varied = {member.split(" = ")[0] for member in rows["member"] if " = " in member}
    failures = rows[rows["outcome"].str.startswith("fails")]
    figure, (ax,) = panels(options, 1, title_of(runs[0]), 70)
    colors = {}
    for k, method in enumerate(rows["method"].unique()):
        own = drawn[drawn["method"] == method]
        colors[method] = COLORS[k % 8]
        if len(own):
            ax.plot(own["x"], own["error"], "-", marker=MARKERS[k % 12], color=COLORS[k % 8], label=method)
        x, error = own["x"].to_numpy()[-2:], own["error"].to_numpy()[-2:]
        if column != "time [s]" and len(x) == 2 and x[0] != x[1] and min(x) > 0 and min(error) > 0:
            slope = np.log(error[1] / error[0]) / np.log(x[1] / x[0])
            if abs(slope) > 0.3:
                ax.annotate(f"{slope:.1f}", np.sqrt([x[0] * x[1], error[0] * error[1]]), (4, 3 if slope < 0 else -8),
                            textcoords="offset points", color=COLORS[k % 8], fontsize=7)
    logarithmic(ax.xaxis, drawn["x"].to_numpy())
    logarithmic(ax.yaxis, drawn["error"].to_numpy())
    ax.set(xlabel=label or (varied.pop() if len(varied) == 1 else "varied entry"), ylabel="error [–]")
    # what fails: crosses at the top where the place is known, and the reasons in words
    for k, (_, row) in enumerate(failures[np.isfinite(failures["x"]) & (failures["x"] > 0)].iterrows()):
        ax.plot(row["x"], 0.98 - 0.04 * k % 0.4, "x", ms=5, color=colors[row["method"]], transform=ax.get_xaxis_transform())
    lines = []
    for (method, reason), own in failures.groupby(["method", "outcome"], sort=False):
        lines += [f"✕ {': '.join(filter(None, [method, ', '.join(filter(None, own['member']))]))}"]
        lines += textwrap.wrap(reason, int(options.width * 22), max_lines=2, placeholder=" …")
    if lines:
        figure.supxlabel("\n".join(lines[:18]), fontsize=7, color=FAILING, x=0.01, ha="left")
    legend(ax)
    return figure


def draw_ladder(runs, options):
    """How good each level is and what it costs, with the tolerance and the level that is chosen."""
    rows = texts(runs[0].folder / "study_ladder.csv").iloc[::-1]
    error, cost = numbers(rows["error"]), numbers(rows["cost [s]"] if "cost [s]" in rows else rows["cost"])
    tolerance = numbers(rows["tolerance"])[0] if "tolerance" in rows else np.nan
    if not np.isfinite(error).any():
        raise Skip("no level of the study has an error")
    chosen = [level for level, verdict in zip(rows["level"], rows["verdict"]) if verdict == "cheapest"]
    best = f"Cheapest level that meets the tolerance: {chosen[0]}" if chosen else "No level meets the tolerance"
    figure, axes = plt.subplots(1, 2, figsize=(options.width, (8 * len(rows) + 28) * MM), sharey=True, layout="constrained")
    places = np.arange(len(rows))
    colors = [{"cheapest": CHOSEN, "meets": COLORS[0]}.get(verdict, OTHER) for verdict in rows["verdict"]]
    for ax, values, label in zip(axes, (error, cost), ("error [–]", "cost [s]")):
        ax.scatter(values, places, c=colors, s=18, zorder=3)
        for x, y, color in zip(values, places, colors):
            if np.isfinite(x):
                ax.annotate(f"{x:.2g}", (x, y), (0, 4), textcoords="offset points", ha="center", fontsize=6.5, color=color)
        logarithmic(ax.xaxis, np.append(values, tolerance if ax is axes[0] else np.nan))
        ax.margins(x=0.3)
        ax.set_xlabel(label)
    if tolerance > 0:
        axes[0].axvline(tolerance, color=FAILING, lw=0.8, ls="--")
        axes[0].set_title(f"tolerance {tolerance:g}", color=FAILING, fontsize=7)
    for place, verdict in zip(places, rows["verdict"]):
        if verdict.startswith("fails"):
            axes[0].text(0.02, place, "✕ " + textwrap.shorten(verdict, 60, placeholder=" …"), color=FAILING, fontsize=6.5, va="center",
                         transform=axes[0].get_yaxis_transform())
    axes[0].set_yticks(places, [level + ("\n" + member if member else "") for level, member in zip(rows["level"], rows["member"])])
    axes[0].set_ylim(-0.6, len(rows) - 0.4)
    figure.suptitle("\n".join(filter(None, [title_of(runs[0]), best])))
    return figure
