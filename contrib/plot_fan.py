"""Modes and multipliers against the speed of rotation, drawn by contrib/plot: one curve a family."""

import collections

import matplotlib.pyplot as plt
import numpy as np

from plot_style import COLORS, DASHES, MARKERS, RED, Skip, finish, legend, panels
from plot_tables import numbers, texts

EQUAL = 5e-3  # of the frequency: branches of one family that are nearer than this everywhere are one curve
MOST_LINES = 6  # of n/rev
MOST_NAMED = 12  # curves; of more only the families have names
NO_SWING = 0.95  # damping ratio: what has more at all speeds, as lags of the air have, is not drawn in a fan
MAPS = {"flap": "Blues", "lag": "Reds", "torsion": "Greens", "support": "Greys", "": "turbo"}
OF_PATTERN = {"collective": "-", "progressive": "--", "regressive": ":", "differential": "-."}
HERTZ = (lambda w: w / (2 * np.pi), lambda f: 2 * np.pi * f)


class Curve:
    """Rows of a branch, or of several that are equal, by speed."""

    def __init__(self, branch, rows, frequency, growth):
        rows = rows.assign(speed=numbers(rows["speed [rad/s]"])).sort_values("speed")
        self.speed, self.frequency, self.growth = (numbers(rows[name]) for name in ("speed", frequency, growth))
        self.damping = numbers(rows.get("damping ratio", rows[growth]))
        self.branches = {int(float(branch))}
        families, patterns = ([*rows.get(name, [""] * len(rows))] for name in ("family", "pattern"))
        self.family, self.pattern = (collections.Counter(words).most_common(1)[0][0] for words in (families, patterns))
        names = [", ".join(filter(None, pair)) for pair in zip(families, patterns)]
        self.way = " to ".join(dict.fromkeys([names[0], names[-1]]))
        if not self.pattern:  # of one blade, or by content alone: flap 2 to flap-torsion
            words = [family for family in families if family]
            self.family = " to ".join(dict.fromkeys(words[:: max(1, len(words) - 1)]))
        self.kind = self.family.split(" ")[0].split("-")[0]

    def is_as(self, other):
        if self.family != other.family or not np.array_equal(self.speed, other.speed):
            return False
        mine, its = (curve.frequency + 1j * curve.growth for curve in (self, other))
        return bool(np.all(np.abs(mine - its) <= EQUAL * (np.abs(mine) + 1e-300)))

    def label(self, of_family):
        if not self.family:
            first, last = min(self.branches), max(self.branches)
            return f"mode {first}" if first == last else f"modes {first} – {last}"
        if self.pattern and of_family == 1 and len(self.branches) > 1:
            return f"{self.family} ({len(self.branches)} patterns)"
        return ", ".join(filter(None, (self.family, self.pattern)))


def read_curves(path, frequency, growth):
    rows = texts(path)
    if rows["speed [rad/s]"].nunique() < 2:
        raise Skip(f"{path.name} has fewer than two speeds")
    curves = []
    for branch, of_branch in rows.groupby("branch", sort=False):
        curve = Curve(branch, of_branch, frequency, growth)
        same = next((other for other in curves if other.is_as(curve)), None)
        if same:
            same.branches |= curve.branches
        else:
            curves.append(curve)
    return sorted(curves, key=lambda curve: curve.frequency[-1])


def styled(curves):
    """Curves with color, dashes and label."""
    count = collections.Counter(curve.family for curve in curves)
    labels = [curve.label(count[curve.family]) for curve in curves]
    # two branches that most speeds call alike: by what they begin and end as, by their numbers if that does not help
    ways, often = (collections.Counter(words) for words in ([curve.way for curve in curves], labels))
    for curve, label in zip(curves, labels):
        if often[label] > 1:
            label = curve.way if ways[curve.way] == 1 else f"{label} (branch {min(curve.branches)})"
        names = sorted({c.family or str(sorted(c.branches)) for c in curves if c.kind == curve.kind})
        place = names.index(curve.family or str(sorted(curve.branches))) / max(1, len(names) - 1)
        color = plt.get_cmap(MAPS.get(curve.kind, "Purples"))(0.9 - 0.5 * place if curve.kind else 0.05 + 0.87 * place)
        dashes = OF_PATTERN.get(curve.pattern, "-") if count[curve.family] > 1 else "-"
        yield curve, color, (0, (6, 1, 1, 1, 1, 1)) if label == curve.way and " to " in label else dashes, label


def looks(runs, all_curves):
    """Curves of all runs with color, dashes, marker and label; of several runs each has a colour."""
    named = set()
    for r, (run, curves) in enumerate(zip(runs, all_curves)):
        for k, (curve, color, dashes, label) in enumerate(styled(curves)):
            if len(runs) == 1:
                if len(curves) > MOST_NAMED:
                    label = None if curve.family in named else curve.family
                    named.add(curve.family)
                yield curve, color, dashes, "o", label
            else:
                yield curve, COLORS[r % 8], DASHES[r % 4], MARKERS[r % 12], None if k else run.name


def draw_speeds(file, runs, options):
    """Frequencies above, damping ratios or growth rates below, against the speed."""
    of_fan = file == "fan.csv"
    growth, lower = ("real [1/s]", "damping") if of_fan else ("growth rate [1/s]", "growth")
    title = "Frequencies against the speed of rotation" if of_fan else "Floquet exponents against the speed of rotation"
    everything = [read_curves(run.folder / file, "frequency [rad/s]", growth) for run in runs]
    all_curves = [[c for c in curves if not of_fan or not np.all(np.abs(c.damping) > NO_SWING)] for curves in everything]
    curves = sum(all_curves, [])
    if not curves:
        raise Skip("nothing swings")
    two = max(np.nanmax(np.abs(getattr(curve, lower)), initial=0) for curve in curves) > 1e-9
    figure, axes = panels(options, 1 + two, title, 60 if two else 80, [5, 3][: 1 + two])
    top, bottom = axes[0], axes[-1]
    fastest = max(curve.speed[-1] for curve in curves)
    for curve, color, dashes, marker, label in looks(runs, all_curves):
        if of_fan and len(runs) == 1 and len(curves) <= MOST_NAMED and curve.speed[-1] == fastest > 0:
            label += f" {curve.frequency[-1] / curve.speed[-1]:.2f}/rev"
        look = {"ls": dashes, "marker": marker, "ms": 2, "mew": 0.5, "mfc": color if len(runs) == 1 else "none", "color": color}
        top.plot(curve.speed, curve.frequency, label=label, **look)
        if two:
            bottom.plot(curve.speed, getattr(curve, lower), **look)
    top.set(xlim=(min(curve.speed[0] for curve in curves), 1.01 * fastest), ylabel="frequency [rad/s]")
    top.set_ylim(0, 1.05 * max(max(curve.frequency.max() for curve in curves), 1e-9))
    draw_revolutions(top)
    top.secondary_yaxis("right", functions=HERTZ).set_ylabel("frequency [Hz]")
    if options.full:
        share = top.secondary_xaxis("top", functions=(lambda w: 100 * w / options.full, lambda p: p * options.full / 100))
        share.set_xlabel(f"speed [% of {options.full:g} rad/s]")
    if two:
        bottom.set_ylabel("damping ratio [–]" if of_fan else "growth rate [1/s]")
        bottom.axhline(0, color="0.4", lw=0.6)
        (low, high), sign = bottom.get_ylim(), 1 if of_fan else -1
        if min(np.nanmin(sign * getattr(curve, lower)) for curve in curves) < -1e-4 * (high - low):
            bottom.axhspan(0, low if sign > 0 else high, color=RED, alpha=0.08, lw=0)
            bottom.text(0.015, 0.03 if sign > 0 else 0.88, "unstable", transform=bottom.transAxes, color="#b23", fontsize=7)
            bottom.set_ylim(low, high)
    left_out = sum(len(c.branches) for c in sum(everything, [])) - sum(len(c.branches) for c in curves)
    if left_out:
        options.say(f"{left_out} motion{'s' * (left_out > 1)} that do{'es' * (left_out == 1)} not swing")
    return finish(options, figure, axes, "speed [rad/s]", above=10 if options.full else 0)


def draw_revolutions(ax):
    """Light lines at 1, 2, ... a revolution, each with its name where it leaves the panel, not nearer than letters are high."""
    (x_low, x_high), (y_low, y_high) = ax.get_xlim(), ax.get_ylim()
    step = next((s for s in (1, 2, 5, 10, 20, 50) if s * x_high > 0.1 * y_high), 0)
    last = np.inf
    for n in step * np.arange(1, MOST_LINES + 1):
        at_top = n * x_high > y_high
        x = 0.96 * y_high / n if at_top and n else x_high - 0.02 * (x_high - x_low)
        if not n or x <= x_low + 0.03 * (x_high - x_low) or last - x < 0.45 / ax.figure.get_figwidth() * (x_high - x_low) and at_top:
            break
        last = x if at_top else last
        ax.axline((x_low, n * x_low), slope=n, ls="--", color="0.75", lw=0.6, zorder=1)
        ax.text(x, n * x, f"{n}/rev", color="0.45", fontsize=6.5, ha="center" if at_top else "right", va="center", zorder=1.5,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8})


def draw_locus(runs, options):
    """Exponents in their plane; dots grow with the speed."""
    of_floquet = (runs[0].folder / "floquet_speeds.csv").exists()
    names = ("floquet_speeds.csv", "frequency [rad/s]", "growth rate [1/s]") if of_floquet else ("fan.csv", "imaginary [rad/s]", "real [1/s]")
    all_curves = [read_curves(run.folder / names[0], *names[1:]) for run in runs]
    roots = [curve.growth + 1j * curve.frequency for curve in sum(all_curves, [])]
    size = max(np.abs(root).max() for root in roots)
    if max(np.abs(root.real).max() for root in roots) <= 1e-9 * size:
        raise Skip("nothing grows or decays")
    if not options.figures and max(np.abs(root - root[0]).max() for root in roots) < 0.05 * size:
        raise Skip("no root moves")
    figure, axes = panels(options, 1, "", 80)
    ax, speeds = axes[0], np.concatenate([curve.speed for curve in sum(all_curves, [])])
    for curve, color, dashes, _, label in looks(runs, all_curves):
        ax.plot(curve.growth, curve.frequency, ls=dashes, color=color, lw=0.8, label=label)
        ax.scatter(curve.growth, curve.frequency, s=2 + 14 * (curve.speed - speeds.min()) / np.ptp(speeds), color=color, lw=0)
        if options.full and len(roots) <= MOST_NAMED:  # the speed at the ends, in per cent
            for i in (0, -1):
                ax.annotate(f"{100 * curve.speed[i] / options.full:.0f} %", (curve.growth[i], curve.frequency[i]), (3, 2),
                            textcoords="offset points", fontsize=6, color="0.35")
    ax.axvline(0, color="0.4", lw=0.6)
    if ax.get_xlim()[1] > 0:
        ax.axvspan(0, ax.get_xlim()[1], color=RED, alpha=0.08, lw=0)
    ax.secondary_yaxis("right", functions=HERTZ).set_ylabel("frequency [Hz]")
    ax.set(xlabel="growth rate [1/s]", ylabel="frequency [rad/s]")
    legend(ax)
    figure.suptitle(f"Root locus from {speeds.min():g} to {speeds.max():g} rad/s, dots grow with the speed")
    return figure
