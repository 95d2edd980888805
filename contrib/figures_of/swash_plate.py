"""The picture of applications/swash_plate.md: the control chain as the program draws it, and the pitch of its blades.

Some seconds."""

from matplotlib.collections import PolyCollection
from plot_pictures import SCREEN, TO_EYE, Picture, fit, series, shaded

from figures_of.common import BLUE, GREEN, PURPLE, RED, Run, np, plt, save


COLOURS = BLUE, RED, GREEN, PURPLE


def draw_chain(ax, picture):
    corners = [picture.points[c] for c in picture.cells]
    faces = shaded(np.tile([0.36, 0.55, 0.75, 1.0], (len(corners), 1)), corners)
    order = np.argsort([c.mean(axis=0) @ TO_EYE for c in corners])
    wide = [1.6 if len(corners[i]) < 3 else 0.2 for i in order]
    edges = np.column_stack([0.75 * faces[:, :3], faces[:, 3:]])
    ax.add_collection(PolyCollection([corners[i] @ SCREEN for i in order], facecolors=faces[order], edgecolors=edges[order],
                                     linewidths=wide, rasterized=True))
    fit(ax, picture.points @ SCREEN)


def make(parts, drawn):
    run = Run("rotorcraft/swash_plate.prm", "Dynamic/End time = 0.3", pictures=True,
              see=lambda folder: Picture(series(folder / "dynamic.pvd")[-1]))
    figure = plt.figure(figsize=(11, 4.6), dpi=110)
    draw_chain(figure.add_axes([0.0, 0.02, 0.44, 0.96]), run.seen)
    ax = figure.add_axes([0.52, 0.14, 0.46, 0.8])
    for k, colour in enumerate(COLOURS):
        ax.plot(1e3 * run.dynamic["t"], run.dynamic[f"blade {k + 1}:pitch.rotation"], color=colour, ls="-", label=f"blade {k + 1}")
    ax.axvspan(0, 50, color="0.93", lw=0)
    ax.set_xlabel("time [ms]")
    ax.set_ylabel("pitch [deg]")
    ax.legend(ncol=4, loc="upper right")
    save(figure, "swash_plate.png", colours=256)
