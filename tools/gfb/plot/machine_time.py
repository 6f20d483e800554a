"""Pictures of a machine over time: orbits of the axis at each bearing in its clearance, at discs and stations, thinnest films, spectra over the
speed, points once a turn."""

import math

import numpy
from matplotlib import pyplot

from gfb.plot import machine as drawing
from gfb.plot import transient
from gfb.plot.colours import round_numbers
from gfb.plot.scene import case_name
from gfb.plot.transient import LAST, MICRO
from gfb.tool import stop

ACROSS = 3   # pictures beside each other
SMALL = 0.5  # of the clearance: an orbit that spans less is drawn once more, enlarged


def draw(path, file, kind):
    """The picture asked for; without a kind orbits."""
    machine, history = drawing.read(path, file), {name: data[...] for name, data in file["transient"].items()}
    if len(history["time"]) < 3:
        stop(f"{path}: no more than {len(history['time'])} instants, which make no picture")
    places = [name.removeprefix("x_") for name in history if name.startswith("x_")]
    if kind == "thinnest":
        figure = draw_thinnest(history)
    elif kind == "waterfall":
        if "spectrum" not in file:
            stop(f"{path}: less than two turns: there is no spectrum")
        figure = draw_waterfall(history, {name: data[...] for name, data in file["spectrum"].items()}, places)
    elif kind == "bifurcation":
        figure = draw_bifurcation(path, history, places)
    else:
        figure = draw_orbits(machine, history, places)
    figure.suptitle(f"{case_name(path)}: {transient.words_of(history)}", fontsize=11)
    return figure


def words_of(place):
    """`bearing_1` in words."""
    return place.replace("_", " ")


def charts_of(number, side=3.6):
    """So many charts, a few beside each other."""
    across = min(number, ACROSS)
    down = -(-number//across)
    figure, charts = pyplot.subplots(down, across, figsize=(side*across + 0.4, side*down + 0.5), squeeze=False, layout="constrained")
    for chart in list(charts.flat)[number:]:
        chart.remove()
    return figure, list(charts.flat)[:number]


# --- orbits ---

def draw_orbits(machine, history, places):
    """A chart a place: of bearings with the clearance around it, and the orbit alone inside where it is small."""
    figure, charts = charts_of(len(places))
    for place, chart in zip(places, charts):
        x, y = (MICRO*history[f"{axis}_{place}"] for axis in "xy")
        draw_way(chart, history, x, y)
        chart.set_title(f"{words_of(place)}: {numpy.ptp(x):.3g} x {numpy.ptp(y):.3g} um", fontsize=9)
        chart.set(aspect="equal", xlabel="x [um]", ylabel="y [um]")
        number = int(place.rpartition("_")[2]) if place.startswith("bearing_") else 0
        if number and not machine.thrust[number - 1] and machine.bearings[number - 1, 3] > 0.0:
            middle = [MICRO*machine.offset(axis)[number - 1] for axis in "xy"]
            draw_clearance(chart, history, x, y, drawing.draw_reach(chart, machine, number, middle), middle)
        else:
            look_at(chart, x, y)
        chart.grid(alpha=0.3)
    return figure


def draw_way(chart, history, x, y):
    """The way, its last turns dark, its begin and end."""
    late = history["turns"] >= history["turns"][-1] - LAST
    chart.plot(x, y, color="C0", linewidth=0.6, alpha=0.5)
    chart.plot(x[late], y[late], color="C0", linewidth=1.3)
    chart.plot(x[0], y[0], "o", color="C2", markersize=4)
    chart.plot(x[-1], y[-1], "s", color="C3", markersize=4)


def look_at(chart, x, y):
    """The limits of a chart about a way."""
    half = 0.6*max(numpy.ptp(x), numpy.ptp(y), 1.0e-6)
    chart.set(xlim=(0.5*(x.min() + x.max()) - half, 0.5*(x.min() + x.max()) + half), ylim=(0.5*(y.min() + y.max()) - half, 0.5*(y.min() + y.max()) + half))


def draw_clearance(chart, history, x, y, clearance, middle):
    """Room for the clearance at rest about the sleeve's middle; a small orbit once more, larger."""
    far = max(clearance, float(numpy.hypot(x - middle[0], y - middle[1]).max()))
    chart.set(xlim=(middle[0] - 1.12*far, middle[0] + 1.12*far), ylim=(middle[1] - 1.12*far, middle[1] + 1.12*far))
    if max(numpy.ptp(x), numpy.ptp(y)) < SMALL*clearance:
        inside = chart.inset_axes((0.56, 0.56, 0.42, 0.42))
        draw_way(inside, history, x, y)
        look_at(inside, x, y)
        inside.set_aspect("equal")
        inside.tick_params(labelsize=6)
        chart.indicate_inset_zoom(inside, edgecolor="C3")


# --- over time and speed ---

def draw_thinnest(history):
    """The thinnest film of each bearing over time."""
    figure, chart = pyplot.subplots(figsize=(8.0, 5.0), layout="constrained")
    names = [name for name in history if name.startswith("minimum_gap_")]
    for name in names:
        chart.plot(history["time"], MICRO*history[name], linewidth=0.9, label=f"bearing {name.rpartition('_')[2]}")
    thinnest = min(names, key=lambda name: history[name].min())
    least = int(history[thinnest].argmin())
    chart.plot(history["time"][least], MICRO*history[thinnest][least], "v", color="C3", markersize=6,
               label=f"{MICRO*history[thinnest][least]:.3g} um at {history['time'][least]:.4g} s")
    chart.set(xlabel="time [s]", ylabel="thinnest film [um]", ylim=(0.0, None))
    chart.legend(fontsize=8, loc="lower left")
    chart.grid(alpha=0.3)
    return figure


def draw_waterfall(history, spectrum, places):
    """Spectra of the place that moves most along y."""
    place = max(places, key=lambda one: spectrum[f"amplitude_y_{one}"].max(initial=0.0))
    figure, chart = pyplot.subplots(figsize=(8.0, 5.4), layout="constrained")
    shown = {name: spectrum[name] for name in ("speed", "time", "frequency")} | {"amplitude_y": spectrum[f"amplitude_y_{place}"]}
    transient.draw_waterfall(chart, {"spectrum": shown, "of": f"y of {words_of(place)}"}, {})
    return figure


def draw_bifurcation(path, history, places):
    """The axis at each place once a turn, over the speed."""
    turns = history["turns"]
    whole = numpy.arange(math.ceil(turns[0]), math.floor(turns[-1]) + 1)
    if len(whole) < 2:
        stop(f"{path}: less than two turns: there are no points once a turn")
    speed = numpy.interp(whole, turns, history["speed"])*30.0/math.pi
    figure, charts = charts_of(len(places))
    for place, chart in zip(places, charts):
        for axis in "xy":
            chart.plot(speed, numpy.interp(whole, turns, MICRO*history[f"{axis}_{place}"]), ".", markersize=2.5, label=f"{axis}, once a turn")
        chart.set(xlabel="speed [rpm]", ylabel="[um]")
        chart.set_title(words_of(place), fontsize=9)
        chart.xaxis.set_major_locator(round_numbers(4))
        chart.legend(fontsize=8)
        chart.grid(alpha=0.3)
    return figure
