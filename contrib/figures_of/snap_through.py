"""The figure of benchmarks/stability_snap_through.md: Lee's frame and the deep arch along the arc of their paths and by load steps.

Some seconds."""

from figures_of.common import BLUE, RED, Run, few, np, plt, save


# model, largest load, (probe, label, sign, colour), limit points of the exact equations: load, then the probes
CASES = {
    "Lee's frame": (
        "lees_frame",
        20,
        [("frame.load.displacement x", "to the right", 1, BLUE), ("frame.load.displacement y", "down", -1, RED)],
        [(18.5445271, 26.8783278, 48.7542405), (-9.3924896, 90.1770005, 58.2249579)],
        ("displacement of the load [cm]", "P [kN]"),
    ),
    "Deep arch, clamped and hinged": (
        "deep_arch_path",
        1000,
        [("arch.middle.displacement x", "to the right", 1, BLUE), ("arch.middle.displacement y", "down", -1, RED)],
        [(897.2891338, 61.14170984, 113.7307344), (-73.04876023, 57.06771797, 122.0656124)],
        ("displacement of the crown", "P"),
    ),
}


def make(parts, drawn):
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    for ax, (title, (model, P, probes, limits, (abscissa, ordinate))) in zip(axes, few(CASES).items()):
        path = Run(f"benchmarks/stability/{model}.prm", "Static/Largest arc = 0.05")
        along, steps = path.static, path.static_path
        # load control stops at the limit point
        by_load = Run(f"benchmarks/stability/{model}.prm", "Static/Path = load", "Static/Load steps = 20", may_fail=True).static
        stable = steps["sign of the determinant"] == steps["sign of the determinant"][0]
        for k, (probe, label, sign, color) in enumerate(probes):
            # from the unloaded state; the determinant keeps its sign up to the limit points
            u = np.append(0, sign * along[probe])
            f = P * np.append(0, along["load factor"])
            ax.plot(u, f, color=color, ls="-", lw=1.2, marker=".", ms=4, label=label)
            hidden = ~np.append(True, stable)
            ax.plot(np.where(hidden, u, np.nan), f, color="w", ls="-", lw=0.6)
            ax.plot(sign * by_load[probe], P * by_load["load factor"], color="0.25", ls="", marker="o", ms=5, mfc="none",
                    label="load steps" if k == 0 else None)
            ax.plot([l[k + 1] for l in limits], [l[0] for l in limits], color="k", ls="", marker="x", ms=7,
                    label="limit points, exact rod" if k == 0 else None)
        ax.axhline(0, color="0.6", lw=0.8, ls="-")
        ax.set_xlabel(abscissa)
        ax.set_ylabel(ordinate)
        ax.set_title(title, loc="left", fontsize=11)
    axes[0].legend(loc="lower left")
    save(figure, "stability_snap_through.png")
