"""Modes and multipliers against the speed of rotation, drawn by contrib/plot: one curve a family."""

import collections
import types

import numpy as np

from plot_style import HERTZ, MARKERS, RED, Skip, finish, look, name_runs, panels
from plot_tables import numbers, texts

EQUAL = 5e-3  # of the frequency: branches of one family that are nearer than this everywhere are one curve
MOST_LINES = 6  # of n/rev
MOST_NAMED = 12  # curves; of more only the families and the patterns have names
NO_SWING = 0.95  # damping ratio: what has more at all speeds, as lags of the air have, is not drawn in a fan
OF_PATTERN = {"collective": "-", "progressive": "--", "regressive": ":", "differential": "-."}


def read_curves(path, frequency, growth):
    """A curve a branch, or one for several that are equal; family and pattern are those of most speeds."""
    rows = texts(path)
    rows = rows.assign(speed=numbers(rows["speed [rad/s]"]), **{name: "" for name in ("family", "pattern") if name not in rows})
    if rows["speed"].nunique() < 2:
        raise Skip(f"{path.name} has fewer than two speeds")
    curves = []
    for branch, own in rows.sort_values("speed").groupby("branch", sort=False):
        most = {name: collections.Counter(own[name]).most_common(1)[0][0] for name in ("family", "pattern")}
        curve = types.SimpleNamespace(branches=[int(float(branch))], speed=own["speed"].to_numpy(), family=most["family"],
                                      pattern=most["pattern"], frequency=numbers(own[frequency]), growth=numbers(own[growth]),
                                      damping=numbers(own.get("damping ratio", own[growth])))
        same = next((other for other in curves if are_equal(curve, other)), None)
        if same:
            same.branches += curve.branches
        else:
            curves.append(curve)
    return named(sorted(curves, key=lambda curve: curve.frequency[-1]))


def are_equal(one, other):
    if one.family != other.family or not np.array_equal(one.speed, other.speed):
        return False
    roots = [curve.growth + 1j * curve.frequency for curve in (one, other)]
    return np.all(np.abs(roots[0] - roots[1]) <= EQUAL * (np.abs(roots[0]) + 1e-300))


def named(curves):
    """The curves with labels: family and pattern, or the numbers of the branches where these do not tell."""
    of_family = collections.Counter(curve.family for curve in curves)
    for curve in curves:
        n = len(curve.branches)
        curve.label = ", ".join(filter(None, (curve.family, curve.pattern))) or f"mode{'s' * (n > 1)} {', '.join(map(str, sorted(curve.branches)))}"
        if curve.pattern and of_family[curve.family] == 1 and n > 1:
            curve.label, curve.pattern = f"{curve.family} ({n} patterns)", ""
    often = collections.Counter(curve.label for curve in curves)
    keys = {}  # of colours
    for curve in curves:
        alike = often[curve.label] > 1 and len(curves) <= MOST_NAMED
        curve.label += f" (branch {min(curve.branches)})" * alike
        curve.colour = keys.setdefault(curve.label if alike or not curve.family else curve.family, len(keys))
    return curves


def looks(ax, runs, all_curves):
    """Curves of all runs, how they look and their labels. One run: a colour a family, dashes a pattern. Several: a colour a run."""
    several, crowded, shown = len(runs) > 1, len(all_curves[0]) > MOST_NAMED, {None}
    for r, curve in ((r, curve) for r, curves in enumerate(all_curves) for curve in curves):
        how = look(r, len(runs), 0 if several else curve.colour)
        mark = MARKERS[(r if several else curve.colour // 8) % 12]  # of more families than colours
        how |= {} if several else {"ls": OF_PATTERN.get(curve.pattern, how["ls"])}
        how |= {"marker": mark, "ms": 2 + 1.5 * (len(runs) - 1 - r), "mew": 0.5, "mfc": "none" if several else how["color"]}
        label = None if several else (crowded and curve.family) or curve.label
        yield curve, how, label if label not in shown else None
        shown.add(label)
    name_runs(ax, runs, [])
    for pattern in dict.fromkeys(curve.pattern for curve in all_curves[0] if curve.pattern) if crowded and not several else ():
        ax.plot([], [], color="0.3", ls=OF_PATTERN.get(pattern, "-"), label=pattern)


def draw_speeds(file, runs, options):
    """Frequencies above, damping ratios or growth rates below, against the speed."""
    of_fan = file == "fan.csv"
    growth, lower, unit = ("real [1/s]", "damping", "damping ratio [–]") if of_fan else ("growth rate [1/s]", "growth", "growth rate [1/s]")
    title = "Frequencies against the speed of rotation" if of_fan else "Floquet exponents against the speed of rotation"
    everything = [read_curves(run.folder / file, "frequency [rad/s]", growth) for run in runs]
    all_curves = [[c for c in curves if not of_fan or not np.all(np.abs(c.damping) > NO_SWING)] for curves in everything]
    curves = sum(all_curves, [])
    if not curves:
        raise Skip("nothing swings")
    if len(curves) < len(sum(everything, [])):
        options.say(f"without {len(sum(everything, [])) - len(curves)} curves of motions that do not swing")
    two = max(np.nanmax(np.abs(getattr(curve, lower)), initial=0) for curve in curves) > 1e-9
    figure, axes = panels(options, [75, 45] if two else [80], title)
    top, bottom = axes[0], axes[-1]
    fastest = max(curve.speed[-1] for curve in curves)
    for curve, how, label in looks(top, runs, all_curves):
        if of_fan and label and len(curves) <= MOST_NAMED and curve.speed[-1] == fastest > 0:
            label += f" {curve.frequency[-1] / curve.speed[-1]:.2f}/rev"
        top.plot(curve.speed, curve.frequency, label=label, **how)
        if two:
            bottom.plot(curve.speed, getattr(curve, lower), **how)
    top.set(xlim=(min(curve.speed[0] for curve in curves), 1.01 * fastest), ylabel="frequency [rad/s]")
    top.set_ylim(0, 1.05 * max(max(curve.frequency.max() for curve in curves), 1e-9))
    draw_revolutions(top)
    top.secondary_yaxis("right", functions=HERTZ).set_ylabel("frequency [Hz]")
    if options.full:
        share = top.secondary_xaxis("top", functions=(lambda w: 100 * w / options.full, lambda p: p * options.full / 100))
        share.set_xlabel(f"speed [% of {options.full:g} rad/s]")
    if two:
        bottom.set_ylabel(unit)
        bottom.axhline(0, color="0.4", lw=0.6)
        (low, high), sign = bottom.get_ylim(), 1 if of_fan else -1
        if min(np.nanmin(sign * getattr(curve, lower)) for curve in curves) < -1e-4 * (high - low):
            bottom.axhspan(0, low if sign > 0 else high, color=RED, alpha=0.08, lw=0)
            bottom.text(0.015, 0.03 if sign > 0 else 0.88, "unstable", transform=bottom.transAxes, color="#b23", fontsize=7)
            bottom.set_ylim(low, high)
    return finish(options, figure, axes, "speed [rad/s]", above=10 if options.full else 0)


def draw_revolutions(ax):
    """Light lines at 1, 2, ... a revolution, each with its name where it leaves the panel, not nearer than letters are high."""
    (x_low, x_high), y_high = ax.get_xlim(), ax.get_ylim()[1]
    step = next((s for s in (1, 2, 5, 10, 20, 50) if s * x_high > 0.1 * y_high), 100)
    room, last = 0.45 / ax.figure.get_figwidth() * (x_high - x_low), np.inf
    for n in range(step, step * MOST_LINES + 1, step):
        at_top = n * x_high > y_high
        x = 0.96 * y_high / n if at_top else x_high - 0.02 * (x_high - x_low)
        if x <= x_low + 0.03 * (x_high - x_low) or at_top and last - x < room:
            break
        last = x if at_top else last
        ax.axline((x_low, n * x_low), slope=n, ls="--", color="0.75", lw=0.6, zorder=1)
        ax.text(x, n * x, f"{n}/rev", color="0.45", fontsize=6.5, ha="center" if at_top else "right", va="center", zorder=1.5,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8})
