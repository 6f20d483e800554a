"""Pictures of a shaft that moves: its orbit, spectra over the speed, points once a turn, the thinnest film over time."""

import math

import numpy
from matplotlib import colors, patches, pyplot

from gfb.plot.clearance import crests_of, draw_limit, draw_load
from gfb.plot.colours import round_numbers
from gfb.plot.scene import case_name, number
from gfb.results import used_keys
from gfb.tool import stop

KINDS = ("orbit", "waterfall", "bifurcation", "thinnest")
MICRO = 1.0e6
HIGHEST = 3.0     # frequency of a waterfall over that of the turns, at most
LEAST = 0.1       # the same, at least
STEADY = 1.0e-3   # of the speed: one that changes less stays
LAST = 5.0        # turns of an orbit that are drawn darker
SMALL = 0.2       # of the clearance: an orbit that spans less is drawn once more, enlarged
STILL = 1.0e-4    # of the clearance: half the side of the smallest square that is enlarged
LEAST_SQUARE = 0.045  # of the picture of the clearance: the smallest square drawn in it
TALLEST = 4.0     # highest peak of a waterfall over the distance of its spectra
RATIOS = ((1.0, "1 x", "--"), (0.5, "1/2 x", ":"))  # of the speed, that are marked in spectra


def is_transient(file):
    """Whether a case file is of a shaft that moves."""
    return "transient/time" in file


def draw(path, file, kind):
    """The picture asked for; without a kind orbit and thinnest film."""
    if not is_transient(file):
        stop(f"{path}: nothing moves in it; --show {kind or KINDS[0]} is of analysis = 'transient'")
    history, keys = read(file)
    if len(history["time"]) < 3:
        stop(f"{path}: no more than {len(history['time'])} instants, which make no picture")
    drawing = {"waterfall": draw_waterfall, "bifurcation": draw_bifurcation, "thinnest": draw_thinnest}
    if kind in drawing:
        figure, chart = pyplot.subplots(figsize=(8.0, 5.4), layout="constrained")
        drawing[kind](chart, history, keys)
    else:
        orbits = 1 if enlarged(history, keys) is None else 2
        figure, axes = pyplot.subplots(1, orbits + (kind is None), squeeze=False, layout="constrained",
                                       figsize=(6.6, 6.2) if kind and orbits == 1 else (5.5*(orbits + (kind is None)), 5.4))
        draw_orbits(axes[0, :orbits], history, keys)
        if kind is None:
            draw_thinnest(axes[0, -1], history, keys)
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

def read(file):
    """What an open file has of the motion, with the crests around the shaft, and the keys of its echo."""
    history = {name: data[...] for name, data in file["transient"].items()}
    if "spectrum" in file:
        history["spectrum"] = {name: data[...] for name, data in file["spectrum"].items()}
    keys = used_keys(file) if "scene/used" in file else {}
    history["crests"] = crests_of(file, keys)
    return history, keys


def enlarged(history, keys):
    """Middle and half the side of the square around an orbit that is small in its clearance [um]; None for a large one."""
    clearance = number(keys, "bearing", "clearance")
    if clearance is None:
        return None
    ways = [place for _, _, place in journals(history)]
    low, high = (numpy.array([function([function(way[axis]) for way in ways]) for axis in (0, 1)]) for function in (numpy.min, numpy.max))
    span = (high - low).max()
    if span >= SMALL*MICRO*clearance:
        return None
    return 0.5*(low + high), max(0.6*span, STILL*MICRO*clearance)


def draw_orbits(charts, history, keys):
    """The orbit in its clearance and, where there is a second chart, the same enlarged."""
    charts = list(charts)
    draw_orbit(charts[0], history, keys)
    if len(charts) == 1:
        return
    (x, y), half = enlarged(history, keys)
    draw_way(charts[1], history)
    charts[1].set(xlabel="-e_x [um]", ylabel="-e_y [um]", xlim=(x - half, x + half), ylim=(y - half, y + half), aspect="equal")
    across = charts[0].get_xlim()
    charts[1].set_title(f"the orbit alone, {(across[1] - across[0])/(2.0*half):.3g} times larger", fontsize=10)
    charts[1].grid(alpha=0.3)
    side = max(half, LEAST_SQUARE*across[1])  # a smaller one is not seen
    charts[0].add_patch(patches.Rectangle((x - side, y - side), 2.0*side, 2.0*side, fill=False, color="C3", linewidth=0.8, zorder=4))


def draw_orbit(chart, history, keys):
    """The way of the shaft's centre, how far it may go, where pads end and where bumps stand."""
    far = max(numpy.hypot(*place).max() for _, _, place in journals(history))
    far = max(far, draw_limit(chart, keys, history["crests"]))
    draw_load(chart, keys)
    draw_way(chart, history)
    chart.set(xlabel="shaft's centre, -e_x [um]", ylabel="-e_y [um]", xlim=(-1.12*far, 1.12*far), ylim=(-1.12*far, 1.12*far),
              aspect="equal")
    chart.set_title("orbit", fontsize=10)
    chart.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=4)
    chart.grid(alpha=0.3)


def draw_way(chart, history):
    """The way itself, its last turns dark, begin and end."""
    turns = history["turns"]
    late = turns >= turns[-1] - LAST
    for words, colour, (x, y) in journals(history):
        first = colour == "C0"
        chart.plot(x, y, color=colour, linewidth=0.6, alpha=0.5)
        chart.plot(x[late], y[late], color=colour, linewidth=1.3,
                   label="bearing" + words if words else "all turns" if late.all() else f"the last {LAST:g} turns dark")
        chart.plot(x[0], y[0], "o", color="C4" if words else "C2", markersize=5, label="begin" if first else None)
        chart.plot(x[-1], y[-1], "s", color="C3", markersize=5, label="end" if first else None)


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
    chart.legend(fontsize=8, loc="lower left")  # next to zero, where the least is drawn
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
    least, highest = LEAST*speeds.min()/60.0, HIGHEST*speeds.max()/60.0
    shown = [(frequency[seen], line[seen]) for frequency, line in lines for seen in [(frequency <= highest) & (frequency > least)]]
    what = history.get("of") or f"e_y{journals(history)[0][0]}"
    turns = f"of {what} over {speeds[0]/60.0/lines[0][0][1]:.0f} turns"
    chart.set(xlabel="frequency [Hz]", xlim=(0.0, highest))
    if len(lines) == 1:
        draw_spectrum(chart, *shown[0], speeds[0])
        chart.set_ylabel(f"amplitude of {what} [um]")
        chart.set_title(f"spectrum {turns}", fontsize=10)
    else:
        largest = max(line.max(initial=0.0) for _, line in shown) or 1.0
        draw_spectra(chart, shown, speeds, times, largest, what)
        chart.set_title(f"spectra {turns} each; highest peak {largest:.3g} um", fontsize=10)
    chart.legend(fontsize=8)


def draw_spectrum(chart, frequency, line, speed):
    """A single one."""
    chart.plot(frequency, line, color="C0", linewidth=0.9)
    for ratio, name, style in RATIOS:
        chart.axvline(ratio*speed/60.0, linestyle=style, color="C3", linewidth=1.0, label=f"{name} speed")


def draw_spectra(chart, lines, speeds, times, largest, what):
    """Several: the height of each is the root of the amplitude, so that unbalance is seen beside whirl."""
    steady = numpy.ptp(speeds) <= STEADY*speeds.max()
    bases = times if steady else speeds
    scale = TALLEST*numpy.ptp(bases)/(len(lines) - 1)/math.sqrt(largest)
    shades = pyplot.get_cmap("viridis")(colors.Normalize(0, len(lines))(numpy.arange(len(lines))))
    # The lower one stands in front, whether the speed rises or falls; those at one speed do not cover each other.
    depths = len(lines) - numpy.unique(numpy.round(bases/(STEADY*numpy.ptp(bases))), return_inverse=True)[1]
    for base, depth, shade, (frequency, line) in zip(bases, depths, shades, lines):
        height = base + scale*numpy.sqrt(line)
        chart.fill_between(frequency, base, height, color="white", zorder=2 + depth, linewidth=0.0)
        chart.plot(frequency, height, color=shade, linewidth=0.9, zorder=2.5 + depth)
    for ratio, name, style in RATIOS:
        chart.plot(ratio*speeds/60.0, bases, style, color="C3", linewidth=1.0, zorder=4 + len(lines), label=f"{name} speed")
    chart.set_ylabel("time [s]" if steady else "speed [rpm]")
    values = numpy.array([0.0, *sorted({round_down(share*largest) for share in (1.0, 0.25, 0.05)})])
    axis = chart.secondary_yaxis("right")
    axis.set_yticks(bases.min() + scale*numpy.sqrt(values), [f"{value:g}" for value in values], fontsize=7)
    axis.set_ylabel(f"amplitude of {what} [um], root scale from each line's foot; ticks at the lowest line", fontsize=8, loc="bottom")


def round_down(value):
    """The largest 1, 2 or 5 times a power of ten that is not larger."""
    power = 10.0**math.floor(math.log10(value))
    return max(step for step in (1.0, 2.0, 5.0) if step*power <= value*(1.0 + 1.0e-9))*power
