"""Modes and multipliers against the speed of rotation, drawn by contrib/plot: one curve a family."""

import collections
import csv

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.transforms import ScaledTranslation

EQUAL = 5e-3  # of the frequency: branches of one family that are nearer than this everywhere are one curve
MOST_LINES = 12  # of n/rev
NO_SWING = 0.95  # damping ratio: what has more at all speeds, as lags of the air have, is not drawn in a fan
MAPS = {"flap": "Blues", "lag": "Reds", "torsion": "Greens", "support": "Greys", "": "turbo"}
DASHES = {"collective": "-", "progressive": "--", "regressive": ":", "differential": "-."}


def beside(ax):
    """Where a legend stands: to the right of the axis in Hz and of its label, whatever the width."""
    to_the_right = ScaledTranslation(0.75, 0, ax.figure.dpi_scale_trans)
    return {"loc": "upper left", "bbox_to_anchor": (1, 1), "bbox_transform": ax.transAxes + to_the_right, "borderaxespad": 0}


class Curve:
    """Rows of a branch, or of several that are equal, by speed."""

    def __init__(self, rows, frequency, growth):
        rows = sorted(rows, key=lambda row: float(row["speed [rad/s]"]))
        self.speed = np.array([float(row["speed [rad/s]"]) for row in rows])
        self.frequency = np.array([float(row[frequency]) for row in rows])
        self.growth = np.array([float(row[growth]) for row in rows])
        self.damping = np.array([float(row.get("damping ratio") or "nan") for row in rows])
        self.branches = {rows[0]["branch"]}
        self.family, self.pattern = (
            collections.Counter(row.get(name) or "" for row in rows).most_common(1)[0][0] for name in ("family", "pattern")
        )
        names = [", ".join(filter(None, (row.get("family"), row.get("pattern")))) for row in rows]
        self.way = " to ".join(dict.fromkeys([names[0], names[-1]]))
        if not self.pattern:  # of one blade, or by content alone: flap 2 to flap-torsion
            words = [row["family"] for row in rows if row.get("family")]
            self.family = " to ".join(dict.fromkeys(words[:: max(1, len(words) - 1)]))

    def is_as(self, other):
        if self.family != other.family or not np.array_equal(self.speed, other.speed):
            return False
        size = np.abs(self.frequency + 1j * self.growth) + 1e-300
        change = np.abs(self.frequency - other.frequency + 1j * (self.growth - other.growth))
        return bool(np.all(change <= EQUAL * size))

    def label(self, of_family):
        if not self.family:
            numbers = sorted(int(float(branch)) for branch in self.branches)
            return f"mode {numbers[0]}" if len(numbers) == 1 else f"modes {numbers[0]} – {numbers[-1]}"
        if not self.pattern:
            return self.family
        if of_family == 1:
            return self.family + (f" ({len(self.branches)} patterns)" if len(self.branches) > 1 else f", {self.pattern}")
        return f"{self.family}, {self.pattern}"


def read_curves(path, frequency, growth, skip):
    if not path.exists():
        raise skip(f"no {path.name}")
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    if len({row["speed [rad/s]"] for row in rows}) < 2:
        raise skip(f"{path.name} has fewer than two speeds")
    branches = collections.defaultdict(list)
    for row in rows:
        branches[row["branch"]].append(row)
    curves = []
    for rows_of_branch in branches.values():
        curve = Curve(rows_of_branch, frequency, growth)
        same = next((other for other in curves if other.is_as(curve)), None)
        if same:
            same.branches |= curve.branches
        else:
            curves.append(curve)
    return sorted(curves, key=lambda curve: curve.frequency[-1])


def styled(curves):
    """Curves with color, dashes and label."""
    kinds = collections.defaultdict(list)
    for curve in curves:
        kinds[curve.family.split(" ")[0].split("-")[0]].append(curve)
    count = collections.Counter(curve.family for curve in curves)
    labels = [curve.label(count[curve.family]) for curve in curves]
    # two branches that most speeds call alike: by what they begin and end as, by their numbers if that does not help
    ways = collections.Counter(curve.way for curve in curves)
    often = collections.Counter(labels)
    for i, curve in enumerate(curves):
        if often[labels[i]] > 1:
            number = min(int(float(branch)) for branch in curve.branches)
            labels[i] = curve.way if ways[curve.way] == 1 else f"{labels[i]} (branch {number})"
    for curve, label in zip(curves, labels):
        kind = curve.family.split(" ")[0].split("-")[0]
        names = sorted({other.family or str(sorted(other.branches)) for other in kinds[kind]})
        place = names.index(curve.family or str(sorted(curve.branches)))
        tint = 0.9 - 0.5 * place / max(1, len(names) - 1) if kind else 0.05 + 0.87 * place / max(1, len(names) - 1)
        color = plt.get_cmap(MAPS.get(kind, "Purples"))(tint)
        dashes = DASHES.get(curve.pattern, "-") if count[curve.family] > 1 else "-"
        if label == curve.way and " to " in label:
            dashes = (0, (6, 1, 1, 1, 1, 1))
        yield curve, color, dashes, label


def draw_fan(folder, skip, full):
    everything = read_curves(folder / "fan.csv", "frequency [rad/s]", "real [1/s]", skip)
    curves = [curve for curve in everything if not np.all(np.abs(curve.damping) > NO_SWING)]
    if not curves:
        raise skip("nothing swings")
    with_damping = any(np.nanmax(np.abs(curve.damping), initial=0) > 1e-9 for curve in curves)
    figure, axes = plt.subplots(
        1 + with_damping,
        1,
        figsize=(9, 9.5 if with_damping else 6.5),
        sharex=True,
        squeeze=False,
        layout="constrained",
        gridspec_kw={"height_ratios": [5, 3][: 1 + with_damping]},
    )
    top = axes[0, 0]
    fastest = max(curve.speed[-1] for curve in curves)
    for curve, color, dashes, label in styled(curves):
        end = f"  {curve.frequency[-1] / curve.speed[-1]:.2f}/rev" if curve.speed[-1] == fastest > 0 else ""
        top.plot(curve.speed, curve.frequency, ls=dashes, marker="o", ms=3, color=color, label=label + end)
        if with_damping:
            axes[1, 0].plot(curve.speed, curve.damping, ls=dashes, marker="o", ms=3, color=color)
    top.set_ylim(0, 1.05 * max(max(curve.frequency.max() for curve in curves), 1e-9))
    top.set_xlim(min(curve.speed[0] for curve in curves), 1.01 * fastest)
    top.set_ylabel("frequency [rad/s]")
    handles, labels = top.get_legend_handles_labels()
    if len(curves) <= 24:
        top.legend(handles[::-1], labels[::-1], **beside(top))
    draw_revolutions(top)
    hertz = top.secondary_yaxis("right", functions=(lambda w: w / (2 * np.pi), lambda f: 2 * np.pi * f))
    hertz.set_ylabel("[Hz]")
    if full:
        share = top.secondary_xaxis("top", functions=(lambda w: 100 * w / full, lambda p: p * full / 100))
        share.set_xlabel(f"speed [% of {full:g} rad/s]")
    if with_damping:
        axes[1, 0].set_ylabel("damping ratio [–]")
        least = min(np.nanmin(curve.damping) for curve in curves)
        if least < 0:
            axes[1, 0].axhspan(1.1 * least, 0, color="#d1495b", alpha=0.08, lw=0)
            axes[1, 0].text(0.015, 0.03, "unstable", transform=axes[1, 0].transAxes, color="#b23", fontsize=10, va="bottom")
        axes[1, 0].axhline(0, color="0.4", lw=0.8)
    axes[-1, 0].set_xlabel("speed [rad/s]")
    left_out = sum(len(curve.branches) for curve in everything) - sum(len(curve.branches) for curve in curves)
    figure.suptitle(
        "Frequencies against the speed of rotation"
        + (f" ({left_out} motions that do not swing are left out)" if left_out > 1 else "")
        + (" (1 motion that does not swing is left out)" if left_out == 1 else "")
    )
    figure.align_ylabels(axes[:, 0])
    return figure


def draw_revolutions(ax):
    """Light lines at 1, 2, ... a revolution, each with its name where it leaves the panel."""
    (x_low, x_high), (y_low, y_high) = ax.get_xlim(), ax.get_ylim()
    for n in range(1, min(MOST_LINES, int(np.ceil(y_high / x_high))) + 1 if x_high > 0 else 0):
        ax.axline((x_low, n * x_low), slope=n, ls="--", color="0.75", lw=1, zorder=1)
        at_top = n * x_high > y_high
        x = 0.97 * y_high / n if at_top else x_low + 0.975 * (x_high - x_low)
        if x <= x_low:
            continue
        ax.text(
            x,
            n * x,
            f"{n}/rev",
            color="0.45",
            fontsize=9,
            ha="center" if at_top else "right",
            va="top" if at_top else "center",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1, "alpha": 0.8},
            zorder=1.5,
        )


def draw_growth(folder, skip, full):
    curves = read_curves(folder / "floquet_speeds.csv", "frequency [rad/s]", "growth rate [1/s]", skip)
    figure, axes = plt.subplots(2, 1, figsize=(9, 9), sharex=True, layout="constrained")
    for curve, color, dashes, label in styled(curves):
        axes[0].plot(curve.speed, curve.frequency, ls=dashes, marker="o", ms=3, color=color, label=label)
        axes[1].plot(curve.speed, curve.growth, ls=dashes, marker="o", ms=3, color=color)
    axes[0].set_ylabel("frequency [rad/s]")
    axes[0].set_ylim(0, 1.05 * max(max(curve.frequency.max() for curve in curves), 1e-9))
    axes[0].set_xlim(min(curve.speed[0] for curve in curves), max(curve.speed[-1] for curve in curves))
    if len(curves) <= 24:
        axes[0].legend(**beside(axes[0]))
    draw_revolutions(axes[0])
    axes[0].secondary_yaxis("right", functions=(lambda w: w / (2 * np.pi), lambda f: 2 * np.pi * f)).set_ylabel("[Hz]")
    if full:
        share = axes[0].secondary_xaxis("top", functions=(lambda w: 100 * w / full, lambda p: p * full / 100))
        share.set_xlabel(f"speed [% of {full:g} rad/s]")
    axes[1].axhline(0, color="0.4", lw=0.8)
    axes[1].set(xlabel="speed [rad/s]", ylabel="growth rate [1/s]")
    figure.suptitle("Floquet exponents against the speed of rotation")
    return figure


def mark_speeds(ax, curves, full):
    """At the ends of each curve, and where it grows fastest, how many per cent of the full speed it turns with."""
    for curve in curves:
        for i in sorted({0, len(curve.speed) - 1, int(np.argmax(curve.growth))}):
            ax.annotate(
                f"{100 * curve.speed[i] / full:.0f} %",
                (curve.growth[i], curve.frequency[i]),
                xytext=(4, 3),
                textcoords="offset points",
                fontsize=7,
                color="0.35",
            )


def draw_locus(folder, skip, full):
    """Exponents in their plane; dots grow with the speed."""
    if (folder / "floquet_speeds.csv").exists():
        curves = read_curves(folder / "floquet_speeds.csv", "frequency [rad/s]", "growth rate [1/s]", skip)
    else:
        curves = read_curves(folder / "fan.csv", "imaginary [rad/s]", "real [1/s]", skip)
    size = max(np.abs(curve.growth + 1j * curve.frequency).max() for curve in curves)
    if max(np.abs(curve.growth).max() for curve in curves) <= 1e-9 * size:
        raise skip("nothing grows or decays")
    figure, ax = plt.subplots(figsize=(9, 6.5), layout="constrained")
    speeds = np.concatenate([curve.speed for curve in curves])
    for curve, color, dashes, label in styled(curves):
        ax.plot(curve.growth, curve.frequency, ls=dashes, color=color, lw=1, label=label)
        ax.scatter(curve.growth, curve.frequency, s=6 + 30 * (curve.speed - speeds.min()) / np.ptp(speeds), color=color)
    ax.axvline(0, color="0.4", lw=0.8)
    if ax.get_xlim()[1] > 0:
        ax.axvspan(0, ax.get_xlim()[1], color="#d1495b", alpha=0.08, lw=0)
    ax.secondary_yaxis("right", functions=(lambda w: w / (2 * np.pi), lambda f: 2 * np.pi * f)).set_ylabel("[Hz]")
    if full:
        per_rev = ax.secondary_yaxis(1.1, functions=(lambda w: w / full, lambda n: n * full))
        per_rev.set_ylabel(f"[/rev of {full:g} rad/s]")
        mark_speeds(ax, curves, full)
    ax.set(xlabel="growth rate [1/s]", ylabel="frequency [rad/s]")
    if len(curves) <= 24:
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=2, borderaxespad=0)
    ax.set_title(f"Root locus from {speeds.min():g} to {speeds.max():g} rad/s, dots grow with the speed")
    return figure
