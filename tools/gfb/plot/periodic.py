"""Pictures of orbits that close: the branch over its parameter, stable and unstable, and the orbits themselves."""

import math

import numpy
from matplotlib import pyplot

from gfb.plot.clearance import crests_of, draw_limit, draw_load
from gfb.plot.colours import round_numbers
from gfb.plot.scene import case_name
from gfb.results import used_keys

MICRO = 1.0e6
DRAWN = 12  # orbits, at most
PARAMETERS = {"speed": ("speed [rpm]", 30.0/math.pi), "unbalance": ("unbalance [g mm]", 1.0e6), "mass": ("mass [kg]", 1.0)}


def is_periodic(file):
    """Whether a case file is of orbits that close."""
    return "periodic/period" in file


def draw(path, file):
    """Branch and orbits; of one orbit without a branch the orbit alone."""
    rows = {name: data[...] for name, data in file["periodic"].items()}
    keys = used_keys(file) if "scene/used" in file else {}
    followed = [name for name in PARAMETERS if numpy.ptp(rows[name]) > 0.0]
    if followed:
        figure, (left, right) = pyplot.subplots(1, 2, figsize=(11.0, 5.4), layout="constrained")
        draw_branch(left, rows, followed[0])
    else:
        figure, right = pyplot.subplots(figsize=(6.6, 6.2), layout="constrained")
    draw_orbits(right, rows, keys, crests_of(file, keys))
    figure.suptitle(f"{case_name(path)}: orbits that close", fontsize=11)
    return figure


def draw_branch(chart, rows, name):
    """Size of the orbits over the parameter: solid where they are stable, dashed where they are not."""
    words, factor = PARAMETERS[name]
    value, stable = factor*rows[name], rows["stable"] > 0.5
    for axis, colour in (("x", "C0"), ("y", "C1")):
        size = MICRO*rows[f"orbit_{axis}"]
        for first in range(len(value) - 1):
            both = slice(first, first + 2)
            chart.plot(value[both], size[both], "-" if stable[first + 1] and (stable[first] or first == 0) else "--", color=colour,
                       linewidth=1.5)
        chart.plot(value[stable], size[stable], "o", color=colour, markersize=3.5, label=f"extent of e_{axis}, stable")
        if not stable.all():
            chart.plot(value[~stable], size[~stable], "o", color=colour, markersize=3.5, markerfacecolor="white",
                       label=f"extent of e_{axis}, unstable")
    if rows["orbit_x"][0] < 1.0e-6*rows["orbit_x"].max():
        chart.plot(value[0], 0.0, "D", color="k", markersize=6, label="onset of whirl", zorder=5)
    chart.set(xlabel=words, ylabel="extent of the orbit [um]", ylim=(0.0, None))
    chart.xaxis.set_major_locator(round_numbers(6))
    chart.set_title("branch", fontsize=10)
    chart.legend(fontsize=8)
    chart.grid(alpha=0.3)


def draw_orbits(chart, rows, keys, crests):
    """Ways of the shaft's centre, -e, over a period, and the clearance with edges and bumps."""
    x, y = (-MICRO*rows[f"eccentricity_{axis}"] for axis in "xy")
    far = max(numpy.hypot(x, y).max(), draw_limit(chart, keys, crests))
    draw_load(chart, keys)
    for row in numpy.unique(numpy.linspace(0, len(x) - 1, min(DRAWN, len(x))).astype(int)):
        chart.plot(x[row], y[row], "-" if rows["stable"][row] > 0.5 else "--", linewidth=1.0, color=pyplot.cm.viridis(row/max(1, len(x) - 1)))
    chart.set(xlabel="shaft's centre, -e_x [um]", ylabel="-e_y [um]", xlim=(-1.12*far, 1.12*far), ylim=(-1.12*far, 1.12*far),
              aspect="equal")
    chart.set_title("orbits: stable ones solid, later ones brighter", fontsize=10)
    if chart.get_legend_handles_labels()[0]:
        chart.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=3)
    chart.grid(alpha=0.3)
