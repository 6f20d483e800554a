"""Picture of a contact, for docs/manual/equations.md."""

import numpy
from matplotlib import pyplot

from gfb.gallery.frame import ARROW, arrow, bare

TOP, BUMP = 0.5, 0.5  # drawn thicknesses
PENETRATION = 0.12


def draw_contact(_runs, folder):
    """A crest that penetrates the top foil, and a corner line above the sleeve."""
    figure, charts = pyplot.subplots(1, 2, figsize=(11.0, 4.2), width_ratios=(1.5, 1.0), layout="constrained")
    draw_crest(charts[0])
    draw_corner(charts[1])
    path = folder/"contact.png"
    figure.savefig(path, dpi=100)
    pyplot.close(figure)
    return path


def sheet(chart, x, middle, thickness, colour, words, place):
    """A foil's faces and mid-surface."""
    chart.fill_between(x, middle - 0.5*thickness, middle + 0.5*thickness, color=colour, alpha=0.25, linewidth=0.0)
    chart.plot(x, middle, color=colour, linewidth=1.5, linestyle="-.")
    chart.text(*place, words, color=colour, fontsize=9)


def measure(chart, x, low, high, words):
    """A distance along the normal."""
    chart.annotate("", (x, high), (x, low), arrowprops={**ARROW, "arrowstyle": "<|-|>", "color": "k"})
    chart.text(x + 0.08, 0.5*(low + high), words, fontsize=9, va="center")


def draw_crest(chart):
    """Node Q of a crest under the top foil."""
    x = numpy.linspace(-3.2, 3.2, 200)
    distance = 0.5*(TOP + BUMP) - PENETRATION
    sheet(chart, x, 0.0*x, TOP, "C0", "top foil, t_t", (-3.1, 0.32))
    sheet(chart, x, -distance - 0.14*x**2, BUMP, "0.35", "bump foil, t_b", (-2.75, -2.55))
    chart.plot([0.0], [-distance], "ko", markersize=5)
    chart.plot([0.0], [0.0], "ko", markersize=5)
    chart.text(-0.12, -distance - 0.2, "Q, at R", fontsize=9, ha="right")
    chart.text(-0.12, 0.1, "P, foot at r", fontsize=9, ha="right")
    measure(chart, 0.0, -distance, 0.0, "(R - r) . n")
    chart.plot([0.9, 2.3], [-distance, -distance], color="k", linewidth=0.6)
    measure(chart, 1.9, -0.5*(TOP + BUMP), 0.0, "d0 = t_t/2 + t_b/2")
    chart.plot([1.7, 2.1], [-0.5*(TOP + BUMP)]*2, color="k", linewidth=0.6)
    chart.annotate("delta", (1.2, -0.5*(TOP + BUMP)), (2.0, -1.35), fontsize=9, arrowprops={"arrowstyle": "-", "color": "C3"}, color="C3")
    chart.plot([1.2, 1.2], [-0.5*(TOP + BUMP), -distance], color="C3", linewidth=3.0)
    arrow(chart, (0.0, -distance), (0.0, -distance - 1.0), "n, and f_n on Q", "C3", (0.1, -distance - 1.0), fontsize=9)
    arrow(chart, (0.0, -distance), (-1.0, -distance), "friction t\nwhere Q slides to +x", "C4", (-2.55, -distance - 0.3), fontsize=9)
    chart.set(xlim=(-3.3, 3.9), ylim=(-2.8, 0.8))
    bare(chart, "(a) crest under the top foil: forces act at the mid-surfaces")


def draw_corner(chart):
    """A corner line on the sleeve."""
    x = numpy.linspace(-1.6, 1.6, 120)
    chart.fill_between(x, -0.9, 0.0, color="0.85")
    chart.text(-1.5, -0.6, "sleeve (rigid, no thickness)", fontsize=9)
    sheet(chart, x, 0.5*BUMP + 0.45*numpy.clip(x, 0.0, None)**1.3, BUMP, "0.35", "arc", (1.15, 1.35))
    chart.text(-1.5, 0.62, "flat", color="0.35", fontsize=9)
    chart.plot([0.0], [0.5*BUMP], "ko", markersize=5)
    measure(chart, 0.0, 0.0, 0.5*BUMP, "d0 = t_b/2")
    arrow(chart, (0.0, 0.5*BUMP), (0.0, 1.25), "n, f_n", "C3", (0.08, 1.2), fontsize=9)
    chart.set(xlim=(-1.7, 1.9), ylim=(-1.0, 1.7))
    bare(chart, "(b) corner line at rest: delta = 0")
