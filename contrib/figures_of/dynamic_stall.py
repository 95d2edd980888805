"""The chart and the table of measured loops in theory/aerodynamics.md.

Runs prm/examples/aero/pitching_airfoil.prm beside the three measured loops of tests/reference/rotor, some seconds."""

from figures_of.common import BLUE, RED, TOP, Run, few, into_page, measured, np, plt, save, table


S809, LS417 = "prm/examples/aero/stall/S809.dat", "prm/examples/aero/stall/LS417.dat"
LOOPS = {"pitching_ls417_k036": ("LS(1)-0417, 14° ± 10.6°, k = 0.036", LS417, "47.73 m/s", "14 deg", "10.57 deg", "1.2018"),
         "pitching_s809_k025": ("S809, 18.8° ± 10.7°, k = 0.025", S809, "34.351 m/s", "18.812 deg", "10.686 deg", "0.6074"),
         "pitching_s809_k050": ("S809, 18.8° ± 10.7°, k = 0.05", S809, "34.29 m/s", "18.777 deg", "10.684 deg", "1.2063")}
MODELS = {"two lags": ("Unsteady = two lags", "0.6"), "lags 1.7, 3": ("Separation lags = 1.7, 3", RED),
          "lags 1.7, 12": ("Separation lags = 1.7, 12", BLUE)}


def computed(loop, entry):
    """Angle [deg] and lift of the last period, from the lowest angle."""
    _, polar, speed, mean, amplitude, frequency = LOOPS[loop]
    values = zip(("U", "mean", "amplitude", "frequency"), (speed, mean, amplitude, frequency))
    motion = Run("examples/aero/pitching_airfoil.prm", f"Surfaces/air on wing/{entry}", f"Airfoils/section/File = {TOP / polar}",
                 *(f"Constants/{name} = {value}" for name, value in values)).dynamic
    angle, lift = list(motion.values())[1:3]
    return angle[-181:], lift[-181:]


def make(parts, drawn):
    figure, axes = plt.subplots(1, 3, figsize=(12, 4), layout="constrained", sharey=True)
    rows = []
    for ax, (loop, (title, *_)) in zip(axes, few(LOOPS).items()):
        points = measured(f"rotor/{loop}.csv")
        angle, lift = np.array([[float(p["angle [deg]"]), float(p["lift coefficient"])] for p in points]).T
        up = np.gradient(angle) > 0
        ax.plot(angle, lift, ls="", marker="o", ms=3, mfc="none", color="k", label="measured")
        rows.append([title, "measured", f"{lift.max():.2f}", f"{lift[up].mean() - lift[~up].mean():.2f}", ""])
        for name, (entry, color) in MODELS.items():
            a, c = computed(loop, entry)
            half = len(a) // 2
            at = np.where(up, np.interp(angle, a[:half + 1], c[:half + 1]), np.interp(angle, a[half:][::-1], c[half:][::-1]))
            ax.plot(a, c, color=color, label=name)
            rows.append(["", f"`Separation {name}`" if "," in name else name, f"{c.max():.2f}", f"{at[up].mean() - at[~up].mean():.2f}", f"{np.sqrt(np.mean((at - lift)**2)):.2f}"])
        ax.set_title(title)
        ax.set_xlabel("angle of attack [deg]")
    axes[0].set_ylabel("lift coefficient")
    axes[0].legend()
    save(figure, "dynamic_stall.png", 120)
    into_page("theory/aerodynamics.md", "measured loops", table("loop |  | largest lift | lift: nose up less nose down | rms of the difference", rows))
