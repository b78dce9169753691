"""The picture of the conventions, docs/conventions.png: axes, headings and incidence in plan, motions in elevation."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def arrow(ax, start, end, text, colour, offset=(0, 0)):
    ax.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.8})
    middle = np.add(start, end) / 2 + offset
    ax.text(*middle, text, color=colour, ha="center", va="center", fontsize=9)


def plan(ax):
    ax.add_patch(plt.Rectangle((-3, -1.5), 6, 3, fill=False, lw=1.5))
    arrow(ax, (0, 0), (4.2, 0), "x, surge, ahead", "k", (3.0, 0.4))
    arrow(ax, (0, 0), (0, 2.8), "y, sway, to port", "k", (1.7, 1.2))
    arrow(ax, (-6.5, -0.5), (-4, -0.5), "heading 0°\nincidence χ = 180°", "C0", (0, -0.7))
    arrow(ax, (6.9, -0.5), (4.4, -0.5), "heading 180°\nincidence χ = 0°, head sea", "C3", (0, -0.7))
    arrow(ax, (-2, -4.4), (-2, -1.9), "heading 90°\nχ = 270°", "C0", (-1.5, 0))
    arrow(ax, (5.5, -4.4), (3.4, -2.3), "heading 135°\nχ = 315°", "C2", (2.3, -0.3))
    ax.set_title("in plan: directions are travelled to")
    ax.set_xlim(-7.5, 8.5), ax.set_ylim(-5, 3.6)


def elevation(ax):
    ax.plot([-7, 8], [0, 0], "C0", lw=1)
    ax.plot([-7, 8], [-3.5, -3.5], "k", lw=2)
    ax.add_patch(plt.Rectangle((-3, -1.2), 6, 2.4, fill=False, lw=1.5))
    arrow(ax, (0, 0), (0, 3), "z, heave, up", "k", (1.4, 1.0))
    arrow(ax, (0, 0), (4.2, 0), "x", "k", (2.3, 0.3))
    ax.annotate("", (1.6, -0.75), (1.1, 0.9), arrowprops={"arrowstyle": "-|>", "connectionstyle": "arc3,rad=-0.5"})
    ax.text(3.2, 1.9, "pitch > 0:\nbow down", fontsize=9, va="center")
    ax.text(-6.9, 0.2, "z = 0, still water", color="C0", fontsize=9)
    ax.text(-6.9, -3.2, "z = −depth, bed", fontsize=9)
    ax.set_title("from starboard: rotations by the right hand")
    ax.set_xlim(-7.5, 8.5), ax.set_ylim(-4.2, 3.6)


if __name__ == "__main__":
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    plan(axes[0]), elevation(axes[1])
    for ax in axes:
        ax.set_aspect("equal"), ax.axis("off")
    figure.savefig(Path(__file__).with_name("conventions.png"), dpi=80)
