"""Pictures of a machine's orbits that close: the branch over its parameter, and the orbits at bearings, discs and stations."""

import numpy
from matplotlib import pyplot

from gfb.plot import machine as drawing
from gfb.plot.colours import round_numbers
from gfb.plot.machine_time import charts_of, look_at, words_of
from gfb.plot.periodic import DRAWN, MICRO, PARAMETERS
from gfb.plot.scene import case_name


def draw(path, file):
    """The branch, where there is one, and a chart a place."""
    machine, rows = drawing.read(path, file), {name: data[...] for name, data in file["periodic"].items()}
    places = [name.removeprefix("x_") for name in rows if name.startswith("x_")]
    followed = [name for name in PARAMETERS if numpy.ptp(rows[name]) > 0.0]
    figure, charts = charts_of(len(places) + bool(followed))
    if followed:
        draw_branch(charts[0], rows, followed[0], places)
    for place, chart in zip(places, charts[bool(followed):]):
        draw_orbits(chart, rows, place)
        number = int(place.rpartition("_")[2]) if place.startswith("bearing_") else 0
        if number and not machine.thrust[number - 1]:
            middle = [MICRO*machine.offset(axis)[number - 1] for axis in "xy"]
            make_room(chart, drawing.draw_reach(chart, machine, number, middle), middle)
    figure.suptitle(f"{case_name(path)}: orbits that close", fontsize=11)
    return figure


def draw_branch(chart, rows, name, places):
    """The larger extent at each place over the parameter: solid where orbits are stable, dashed where they are not."""
    words, factor = PARAMETERS[name]
    value, stable = factor*rows[name], rows["stable"] > 0.5
    for number, place in enumerate(places):
        size = MICRO*numpy.maximum(rows[f"orbit_x_{place}"], rows[f"orbit_y_{place}"])
        for first in range(len(value) - 1):
            both = slice(first, first + 2)
            chart.plot(value[both], size[both], "-" if stable[first + 1] and (stable[first] or first == 0) else "--", color=f"C{number}", linewidth=1.4)
        chart.plot([], [], color=f"C{number}", label=words_of(place))
        chart.plot(value[stable], size[stable], "o", color=f"C{number}", markersize=3.0)
        chart.plot(value[~stable], size[~stable], "o", color=f"C{number}", markersize=3.0, markerfacecolor="white")
    chart.set(xlabel=words, ylabel="larger extent of the orbit [um]", ylim=(0.0, None))
    chart.xaxis.set_major_locator(round_numbers(4))
    chart.set_title("filled: stable", fontsize=9)
    chart.legend(fontsize=8)
    chart.grid(alpha=0.3)


def draw_orbits(chart, rows, place):
    """Ways of the axis over a period, later orbits brighter."""
    x, y = (MICRO*rows[f"{axis}_{place}"] for axis in "xy")
    for row in numpy.unique(numpy.linspace(0, len(x) - 1, min(DRAWN, len(x))).astype(int)):
        chart.plot(x[row], y[row], "-" if rows["stable"][row] > 0.5 else "--", linewidth=1.0, color=pyplot.cm.viridis(row/max(1, len(x) - 1)))
    look_at(chart, x, y)
    chart.set(aspect="equal", xlabel="x [um]", ylabel="y [um]")
    chart.set_title(f"{words_of(place)}: {numpy.ptp(x[-1]):.3g} x {numpy.ptp(y[-1]):.3g} um", fontsize=9)
    chart.grid(alpha=0.3)


def make_room(chart, clearance, middle):
    """Room for the clearance at rest, beside the orbits."""
    limits = [*chart.get_xlim(), *chart.get_ylim()]
    low, high = min(limits[0] - middle[0], limits[2] - middle[1], -1.12*clearance), max(limits[1] - middle[0], limits[3] - middle[1], 1.12*clearance)
    chart.set(xlim=(middle[0] + low, middle[0] + high), ylim=(middle[1] + low, middle[1] + high))
