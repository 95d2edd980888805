"""Figures 20 to 24 of the paper, two pictures of applications/tail_rotor_transmission.md: shaft speeds, tail tip, moments, whirl.

Some seconds."""

from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap
from plot_time import peaks, spectrum

from figures_of.common import BLUE, GREEN, RED, SMALL, TIME_COLORS, Run, np, plt, save


SHORT = ["Dynamic/End time = 0.5 s"] if SMALL else []
ZONE = (46.9, 49.1)  # rad/s, unstable in the paper
END = 50.5  # rad/s, reached in the paper


def label(ax, text):
    ax.set_title(text, loc="left", fontsize=11)


def draw_motion(table):
    t = table["t"]
    figure, axes = plt.subplots(
        4, 1, figsize=(8.5, 9.4), sharex=True, layout="constrained", gridspec_kw={"height_ratios": [3, 2.4, 2.4, 2.4]}
    )
    ax = axes[0]
    ax.axhspan(*ZONE, color=RED, alpha=0.12, lw=0, label="unstable in the paper")
    ax.axhline(END, color="0.5", lw=0.9, ls=":", label=f"{END} rad/s, end speed of the paper")
    ax.plot(t, table["S.rotation rate"], color=BLUE, ls="-", label="shaft 1")
    ax.plot(t, table["G2 in.rotation rate"], color=GREEN, ls=(0, (4, 2)), label="shaft 2")
    ax.set_ylabel("speed [rad/s]")
    ax.set_ylim(44.5, 51.2)
    ax.legend(loc="lower right")
    label(ax, "Speeds of the shafts (fig. 20)")

    middle = np.hypot(*(table[f"shaft 1.middle.displacement {i}"] for i in "yz"))
    axes[1].plot(t, 1e3 * middle, color=BLUE, ls="-", lw=1.1)
    axes[1].set_ylabel("distance [mm]")
    axes[1].set_ylim(0, None)
    label(axes[1], "Middle of shaft 1, distance from its straight line (compare fig. 21)")

    axes[2].plot(t, 1e3 * table["tail.end.displacement y"], color=RED, ls=(0, (4, 1.2)), lw=1.1, label="sideways")
    axes[2].plot(t, 1e3 * table["tail.end.displacement z"], color=BLUE, ls="-", lw=1.3, label="vertical")
    axes[2].set_ylabel("displacement [mm]")
    axes[2].legend(loc="upper left")
    label(axes[2], "Tip of the tail (fig. 22)")

    axes[3].plot(t, table["shaft 1.middle.moment 2"], color=BLUE, ls="-", lw=1.3, label="M₂")
    axes[3].plot(t, table["shaft 1.middle.moment 3"], color=RED, ls=(0, (4, 1.2)), lw=1.1, label="M₃")
    axes[3].set_ylabel("moment [N m]")
    axes[3].legend(loc="upper left")
    label(axes[3], "Middle of shaft 1, bending moments in axes of the shaft (fig. 23)")
    axes[3].set_xlabel("t [s]")
    axes[3].set_xlim(t[0], t[-1])
    figure.align_ylabels(axes)
    return figure


def draw_whirl(table):
    t = table["t"]
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(11, 4.6), layout="constrained", gridspec_kw={"width_ratios": [1, 1.15]}
    )
    places = 1e3 * np.column_stack([table[f"shaft 1.middle.displacement {i}"] for i in "yz"])
    cuts = np.unique(np.linspace(0, len(t) - 1, 401).astype(int))
    lines = LineCollection([places[i : j + 1] for i, j in zip(cuts, cuts[1:])], cmap=LinearSegmentedColormap.from_list("samara time", TIME_COLORS), lw=0.8)
    lines.set_array(0.5 * (t[cuts[1:]] + t[cuts[:-1]]))
    left.add_collection(lines)
    left.autoscale_view()
    left.set_aspect("equal", adjustable="datalim")
    left.locator_params(nbins=5)
    figure.colorbar(lines, ax=left, label="t [s]", fraction=0.05, aspect=30)
    left.set_xlabel("sideways, y [mm]")
    left.set_ylabel("vertical, z [mm]")
    label(left, "Middle of shaft 1 (fig. 21)")

    resolution = 2 * np.pi / np.ptp(t)
    for i, name, color, line in ((2, "M₂, sideways", BLUE, "-"), (3, "M₃, vertical", RED, (0, (4, 1.2)))):
        frequencies, amplitudes = spectrum(t, table[f"fuselage.start.moment {i}"])
        shown = frequencies < 225
        right.plot(frequencies[shown], amplitudes[shown], color=color, ls=line, lw=1.2, label=name)
        for frequency, amplitude in peaks(frequencies, amplitudes, 1.5 * resolution)[:2]:
            if amplitude > 0.1 * amplitudes.max():
                above = (5, 3) if i == 3 or frequency > 50 else (-31, 3)
                right.annotate(f"{frequency:.1f}", (frequency, amplitude), above, textcoords="offset points", color=color, fontsize=10)
    for n in range(1, 5):
        right.axvline(49.4 * n, color="0.8", lw=0.9, ls=":", zorder=0)
        right.text(49.4 * n, 0.14, f"{n}×", color="0.45", fontsize=9, ha="center", bbox={"fc": "w", "ec": "none", "pad": 1})
    for frequency, name, height in ((61.1, "61, fuselage", 260), (187.6, "188, mode 8", 6)):
        right.text(frequency + 2, height, name, fontsize=9, color="0.3", ha="left" if frequency < 100 else "center")
    right.set_yscale("log")
    right.set_ylim(0.1, 2e4)
    right.set_xlim(0, 225)
    right.set_xlabel("frequency [rad/s]; dotted: multiples of 49.4")
    right.set_ylabel("amplitude [N m]")
    right.legend(loc="upper right")
    label(right, "Bending moments at the root of the fuselage (fig. 24)")
    return figure


def make(parts, drawn):
    table = Run("rotorcraft/tail_rotor_transmission.prm", "Analyses = static, dynamic", *SHORT).dynamic
    save(draw_motion(table), "tail_rotor_motion.png")
    save(draw_whirl(table), "tail_rotor_whirl.png", colours=256)
