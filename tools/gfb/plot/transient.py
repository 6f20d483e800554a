"""Pictures of a shaft that moves: its orbit, spectra over the speed, points once a turn, the thinnest film over time."""

import math

import numpy
from matplotlib import colors, patches, pyplot

from gfb.plot.scene import case_name, number, round_numbers
from gfb.plot.strip import used_keys
from gfb.tool import stop

KINDS = ("orbit", "waterfall", "bifurcation", "thinnest")
MICRO = 1.0e6
HIGHEST = 3.0     # frequency of a waterfall over that of the turns, at most
LEAST = 0.1       # the same, at least
STEADY = 1.0e-3   # of the speed: one that changes less stays
LAST = 5.0        # turns of an orbit that are drawn darker


def is_transient(file):
    """Whether a case file is of a shaft that moves."""
    return "transient/time" in file


def draw(path, file, kind):
    """The picture asked for; without a kind orbit and thinnest film."""
    if not is_transient(file):
        stop(f"{path}: nothing moves in it; --show {kind or KINDS[0]} is of analysis = 'transient'")
    history = {name: data[...] for name, data in file["transient"].items()}
    if "spectrum" in file:
        history["spectrum"] = {name: data[...] for name, data in file["spectrum"].items()}
    if len(history["time"]) < 3:
        stop(f"{path}: no more than {len(history['time'])} instants, which make no picture")
    keys = used_keys(file) if "scene/used" in file else {}
    drawing = {"orbit": draw_orbit, "waterfall": draw_waterfall, "bifurcation": draw_bifurcation, "thinnest": draw_thinnest}
    if kind is None:
        figure, (left, right) = pyplot.subplots(1, 2, figsize=(11.0, 5.4), layout="constrained")
        draw_orbit(left, history, keys)
        draw_thinnest(right, history, keys)
    else:
        figure, chart = pyplot.subplots(figsize=(6.6, 6.2) if kind == "orbit" else (8.0, 5.4), layout="constrained")
        drawing[kind](chart, history, keys)
    figure.suptitle(f"{case_name(path)}: {words_of(history)}", fontsize=11)
    return figure


def words_of(history):
    """Speed and turns in words."""
    speed = history["speed"]*30.0/math.pi
    turns = history["turns"][-1] - history["turns"][0]
    steady = numpy.ptp(speed) <= 1.0e-6*numpy.abs(speed).max()
    return (f"{speed[0]:,.0f} rpm" if steady else f"{speed[0]:,.0f} to {speed[-1]:,.0f} rpm") + f", {turns:.4g} turns"


def places(history):
    """Where the shaft's centre stands in the bearing, at -e [um]."""
    return -MICRO*history["eccentricity_x"], -MICRO*history["eccentricity_y"]


def journals(history):
    """(words, colour, where the shaft's centre stands [um]) of each bearing: a rotor that tilts has two."""
    if "eccentricity_x_1" not in history:
        return [("", "C0", places(history))]
    return [(f" at {side}z", f"C{2*number - 2}", tuple(-MICRO*history[f"eccentricity_{axis}_{number}"] for axis in "xy"))
            for number, side in ((1, "+"), (2, "-"))]


# --- orbit ---

def draw_orbit(chart, history, keys):
    """The way of the shaft's centre, the clearance circle and where the bumps stand."""
    shafts = journals(history)
    turns = history["turns"]
    late = turns >= turns[-1] - LAST
    far = max(numpy.hypot(*place).max() for _, _, place in shafts)
    clearance = number(keys, "bearing", "clearance")
    if clearance is not None:
        far = max(far, MICRO*clearance)
        chart.add_patch(patches.Circle((0.0, 0.0), MICRO*clearance, fill=False, color="k", linewidth=1.0, label="clearance"))
        mark_bumps(chart, keys, MICRO*clearance)
    for words, colour, (x, y) in shafts:
        first = colour == "C0"
        chart.plot(x, y, color=colour, linewidth=0.6, alpha=0.5)
        chart.plot(x[late], y[late], color=colour, linewidth=1.3,
                   label="bearing" + words if words else "all turns" if late.all() else f"the last {LAST:g} turns dark")
        chart.plot(x[0], y[0], "o", color="C4" if words else "C2", markersize=5, label="begin" if first else None)
        chart.plot(x[-1], y[-1], "s", color="C3", markersize=5, label="end" if first else None)
    chart.set(xlabel="shaft's centre, -e_x [um]", ylabel="-e_y [um]", xlim=(-1.12*far, 1.12*far), ylim=(-1.12*far, 1.12*far),
              aspect="equal")
    chart.set_title("orbit", fontsize=10)
    chart.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=4)
    chart.grid(alpha=0.3)


def mark_bumps(chart, keys, radius):
    """A mark at each bump's crest, on the clearance circle."""
    needed = [number(keys, *key) for key in (("bearing", "radius"), ("bump_foil", "pitch"), ("bump_foil", "bumps"),
                                                ("bump_foil", "half_length"))]
    if None in needed:
        return
    shaft, pitch, bumps, half = needed
    begin = math.radians(number(keys, "bearing", "leading_edge_angle") or 0.0)
    angle = 2.0*math.pi - (half + numpy.arange(bumps)*pitch)/shaft  # the last bump ends at the trailing edge
    angle = angle[angle >= begin]
    chart.plot(numpy.array((1.0, 1.04))[:, None]*radius*numpy.cos(angle), numpy.array((1.0, 1.04))[:, None]*radius*numpy.sin(angle),
               color="0.4", linewidth=1.6)


# --- over time ---

def draw_thinnest(chart, history, _):
    """The smallest film thickness over time."""
    for number, (words, colour, _) in enumerate(journals(history), 1):
        chart.plot(history["time"], MICRO*history[f"minimum_gap_{number}" if words else "minimum_gap"], color=colour, linewidth=0.9,
                   label="bearing" + words if words else None)
    least = int(numpy.argmin(history["minimum_gap"]))
    chart.plot(history["time"][least], MICRO*history["minimum_gap"][least], "v", color="C3", markersize=6,
               label=f"{MICRO*history['minimum_gap'][least]:.3g} um at {history['time'][least]:.4g} s")
    chart.set(xlabel="time [s]", ylabel="thinnest film [um]", ylim=(0.0, None))
    chart.locator_params(axis="x", nbins=5)
    chart.set_title("thinnest film", fontsize=10)
    chart.legend(fontsize=8)
    chart.grid(alpha=0.3)


def draw_bifurcation(chart, history, _):
    """The shaft's centre once a turn, over the speed."""
    turns = history["turns"]
    whole = numpy.arange(math.ceil(turns[0]), math.floor(turns[-1]) + 1)
    if len(whole) < 2:
        stop("less than two turns: there are no points once a turn")
    speed = numpy.interp(whole, turns, history["speed"])*30.0/math.pi
    for words, _, place in journals(history):
        for values, name in zip(place, ("-e_x", "-e_y")):
            chart.plot(speed, numpy.interp(whole, turns, values), ".", markersize=2.5, label=f"{name}{words}, once a turn")
    chart.set(xlabel="speed [rpm]", ylabel="shaft's centre [um]")
    chart.xaxis.set_major_locator(round_numbers(7))
    chart.legend(fontsize=8)
    chart.grid(alpha=0.3)


# --- spectra ---

def draw_waterfall(chart, history, _):
    """Spectra one above the other at their speeds, with the lines of the turns and of half of them."""
    if "spectrum" not in history:
        stop("less than two turns: there is no spectrum")
    found = history["spectrum"]
    speeds, times = found["speed"]*30.0/math.pi, found["time"]
    place, = (name for name in ("amplitude_y", "amplitude_y_1") if name in found)
    lines = list(zip(found["frequency"], MICRO*found[place]))
    steady = numpy.ptp(speeds) <= STEADY*speeds.max()
    heights, words = (times, "time [s]") if steady else (speeds, "speed [rpm]")
    least, highest = LEAST*speeds.min()/60.0, HIGHEST*speeds.max()/60.0
    largest = max(line[frequency > least].max(initial=0.0) for frequency, line in lines) or 1.0
    turns = f"spectra of e_y{journals(history)[0][0]} over {speeds[0]/60.0/lines[0][0][1]:.0f} turns each"
    if len(lines) == 1:
        heights, scale, words = numpy.zeros(1), 1.0, "amplitude of e_y [um]"
        turns = turns.replace("spectra", "spectrum").removesuffix(" each")
    else:
        scale = 2.5*numpy.ptp(heights)/(len(lines) - 1)/largest
        turns += f"; highest peak {largest:.3g} um"
    shades = pyplot.get_cmap("viridis")(colors.Normalize(0, len(lines))(numpy.arange(len(lines))))
    for depth, (height, shade, (frequency, line)) in enumerate(zip(heights[::-1], shades[::-1], reversed(lines))):
        shown = (frequency <= highest) & (frequency > least)
        chart.fill_between(frequency[shown], height, height + scale*line[shown], color="white", zorder=2 + depth, linewidth=0.0)
        chart.plot(frequency[shown], height + scale*line[shown], color=shade, linewidth=0.9, zorder=2 + depth)
    for ratio, name, style in ((1.0, "1 x", "--"), (0.5, "1/2 x", ":")):
        if len(lines) == 1:
            chart.axvline(ratio*speeds[0]/60.0, linestyle=style, color="C3", linewidth=1.0, label=f"{name} speed")
        else:
            chart.plot(ratio*speeds/60.0, heights, style, color="C3", linewidth=1.0, zorder=3 + len(lines), label=f"{name} speed")
    chart.set(xlabel="frequency [Hz]", ylabel=words, xlim=(0.0, highest))
    chart.set_title(turns, fontsize=10)
    chart.legend(fontsize=8)
