"""Harmonics of periodic motions and growth of those that are none, drawn by contrib/plot."""

import csv

import matplotlib.pyplot as plt
import numpy as np

MOST_IN_LEGEND = 14


def draw_harmonics(folder, skip):
    path = folder / "harmonics.csv"
    if not path.exists():
        raise skip("no harmonics.csv")
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    groups = {}  # (unit, axes) -> quantity -> amplitudes
    for row in rows:
        of_quantity = groups.setdefault((row["axes"], row["unit"]), {}).setdefault(row["quantity"], {})
        of_quantity[int(row["harmonic"])] = float(row["amplitude"])
    if not groups:
        raise skip("harmonics.csv is empty")
    figure, axes = plt.subplots(len(groups), 1, figsize=(9, 3.2 * len(groups)), squeeze=False, layout="constrained")
    for ax, ((kind, unit), quantities) in zip(axes[:, 0], groups.items()):
        width = 0.8 / len(quantities)
        colors = plt.cm.viridis(np.linspace(0.05, 0.9, len(quantities)))
        for k, (name, amplitudes) in enumerate(quantities.items()):
            numbers = [n for n in sorted(amplitudes) if n > 0]
            place = np.array(numbers) - 0.4 + (k + 0.5) * width
            ax.bar(place, [amplitudes[n] for n in numbers], width, label=name, color=colors[k])
        ax.set_ylabel(f"amplitude [{unit}]")
        ax.set_title({"standing": "in standing axes", "turning": "in turning axes"}.get(kind, "probes"), fontsize=11)
        if len(quantities) <= MOST_IN_LEGEND:
            ax.legend()
        ax.xaxis.set_major_locator(plt.MaxNLocator(integer=True))
    axes[-1, 0].set_xlabel("harmonic of the period")
    figure.suptitle("Harmonics of the periodic motion, without the means")
    return figure


def draw_exponents(table):
    figure, ax = plt.subplots(figsize=(9, 5), layout="constrained")
    for index in range(1, len(table.names)):
        ax.plot(table.values[:, 0], table.values[:, index], label=f"{index}")
    ax.axhline(0, color="0.4", lw=0.8)
    ax.legend(title="exponent")
    ax.set(xlabel="time [s]", ylabel="mean growth rate so far [1/s]")
    ax.set_title("Lyapunov exponents")
    return figure
