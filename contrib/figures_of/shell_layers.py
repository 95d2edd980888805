"""The plies of prm/examples/shells/laminate.prm, a picture of theory/shell.md, from the picture that samara writes.

On the left each ply at its top, pulled apart; on the right what there is through the thickness at two places. Some seconds."""

from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from plot_pictures import Picture, series

from figures_of.common import Run, np, plt, save


ANGLES = [0, 45, -45, 90, 90, -45, 45, 0]
PLACES = {"middle of the side x = 0": (0.0, 0.1), "centre": (0.15, 0.1)}


def draw(picture):
    fields, places = picture.fields, picture.points - picture.displacement
    figure = plt.figure(figsize=(12, 9))
    grid = figure.add_gridspec(3, 2, width_ratios=[1.5, 1], left=0, right=0.98, bottom=0.08, top=0.98, hspace=0.32, wspace=0.12)
    ax = figure.add_subplot(grid[:, 0], projection="3d")
    cells = np.array([cell for cell in picture.cells if len(cell) == 4])
    largest = np.nanmax(np.abs(fields["stress 11"])) / 1e6
    stress = plt.cm.ScalarMappable(plt.Normalize(-largest, largest), "RdBu_r")
    for layer in range(1, len(ANGLES) + 1):
        own = (fields["layer"] == layer) & (fields["height in layer"] == 1)
        shown = cells[own[cells[:, 0]]]
        corners = places[shown].copy()
        corners[:, :, 2] = layer
        colours = stress.to_rgba(fields["stress 11"][shown].mean(axis=1) / 1e6)
        ax.add_collection3d(Poly3DCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.1, zorder=layer))
        ax.plot([0, 0.3, 0.3, 0, 0], [0, 0, 0.2, 0.2, 0], layer, color="0.3", lw=0.6, zorder=layer + 0.5)
    ax.set(xlim=(0, 0.3), ylim=(0, 0.2), zlim=(0.5, len(ANGLES) + 0.5), xlabel="x [m]", ylabel="y [m]")
    ax.set_xticks([0, 0.1, 0.2, 0.3])
    ax.set_yticks([0, 0.1, 0.2])
    ax.set_zticks(range(1, len(ANGLES) + 1), [f"{layer}: {angle}°" for layer, angle in enumerate(ANGLES, 1)])
    ax.set_box_aspect((3, 2, 4.2))
    ax.view_init(elev=22, azim=-60)
    ax.computed_zorder = False
    figure.colorbar(stress, ax=ax, orientation="horizontal", shrink=0.6, pad=0.03, label="stress 11, along the fibres, at the top of each ply [MPa]")
    handles = [plt.Line2D([], [], color="0.3", ls=style, label=where) for style, where in zip(("-", "--"), PLACES)]
    for k, (unit, scale, names) in enumerate(((" [MPa]", 1e6, ["stress 11", "stress 22"]), (" [MPa]", 1e6, ["stress 13", "stress 23"]),
                                              ("", 1, ["index of failure"]))):
        ax = figure.add_subplot(grid[k, 1])
        for j, place in enumerate(PLACES.values()):
            for i, name in enumerate(names):
                z, value = profile(fields, places, place, name)
                ax.plot(value / scale, z * 1e3, ("-", "--")[j], color=f"C{i}")
        ax.set_xlabel(", ".join(names) + unit)
        ax.set_ylabel("height [mm]")
        colours = [plt.Line2D([], [], color=f"C{i}", label=name) for i, name in enumerate(names)]
        ax.legend(handles=colours if len(names) > 1 else handles, fontsize=8, loc="lower left" if k < 2 else "center right")
    return figure


def profile(fields, places, place, name):
    """Heights [m] from the bottom and values at them, the mean over the cells there, parabolas within plies."""
    here = np.isfinite(fields["layer"]) & (np.hypot(*(places[:, :2] - place).T) < 1e-6)
    heights, values = [], []
    for layer in range(1, len(ANGLES) + 1):
        at = [here & (fields["layer"] == layer) & (fields["height in layer"] == side) for side in (-1, 0, 1)]
        s = np.linspace(-1, 1, 9)
        z, v = (np.polyval(np.polyfit([-1, 0, 1], [fields[f][a].mean() for a in at], 2), s) for f in ("height", name))
        if name == "index of failure":  # no parabola
            v = np.interp(s, [-1, 0, 1], [fields[name][a].mean() for a in at])
        heights.extend(z)
        values.extend(v)
    return np.array(heights), np.array(values)


def make(parts, drawn):
    run = Run("examples/shells/laminate.prm", pictures=True, see=lambda folder: Picture(series(folder / "static.pvd")[-1]))
    save(draw(run.seen), "shell_layers.png", 80, 256)
