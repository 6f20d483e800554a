"""Heat of a bearing: temperatures of film and top foil over theta and width, where the heat goes, and all of it along a sweep."""

import numpy
from matplotlib import colors, pyplot

from gfb.heat import HEATED, balance, temperatures
from gfb.plot.colours import around_zero, round_numbers
from gfb.plot.film import ROUND_OFF, draw_map, legend_above, mark_load, read_film, readable, with_labels
from gfb.plot.ring import draw_ring, is_ring
from gfb.plot.scene import draw_edges, named, read_scene, scene_of
from gfb.results import used_keys
from gfb.tool import stop

KIND = "heat"
FIELDS = {"temperature": "film temperature", "top_foil_temperature": "top foil temperature", "heat_flux_shaft": "heat into the shaft"}
TINY = 1.0e-6     # of a temperature: a field that changes less is even
NEARLY = 1.0e-5   # of the hottest place: others that are as hot are the same
BEYOND = 0.03     # part of the places at either end that have the colour of its end: the film takes the temperature of its walls at once
SPAN = 0.25       # of the scale: how far lines may leave it in their chart
ROOM = 0.34       # of the longest bar: beside it, for its numbers
LEVELS = {  # words and look: film, top foil and shaft may lie on one another
    "shaft_temperature": ("shaft", {"linewidth": 5.0, "alpha": 0.35, "color": "C0"}),
    "maximum_film_temperature": ("film, hottest", {"color": "C3", "marker": "o"}),
    "maximum_top_foil_temperature": ("top foil, hottest", {"color": "k", "linestyle": ":"}),
    "sleeve_temperature": ("sleeve", {"color": "C2", "marker": "o"}),
    "inlet_temperature": ("drawn in at the slit", {"color": "C4", "marker": "o"}),
    "cooling_outlet_temperature": ("cooling gas, out", {"color": "C9", "marker": "o"})}
FLOWS = {"power_loss": ("power loss", "0.3"), "heat_to_shaft": ("into the shaft", "C0"), "heat_through_bumps": ("through the bumps", "C1"),
         "heat_to_channel": ("to the cooling gas", "C9"), "heat_by_gas": ("with the film's gas", "C3")}


# --- film ---

def draw_film(path, file):
    """Maps at the left, lines along midplane and edges at the right, a row a field; of sectors maps alone."""
    if is_ring(file):
        if not any(name in file["VTKHDF/PointData"] for name in FIELDS):
            stop(f"{path}: no temperature in it: the case has no &thermal")
        return draw_ring(path, file, FIELDS, look_of, scale_of)
    film, scene = read_film(path, file, FIELDS), scene_of(path)
    if not film.fields:
        stop(f"{path}: no temperature in it: the case has no &thermal")
    figure, axes = pyplot.subplots(len(film.fields), 2, figsize=(10.0, 2.5*len(film.fields) + 0.5), squeeze=False, layout="constrained",
                                   sharex=True)
    axial, middle = 1.0e3*film.z, film.middle
    at_middle = abs(axial[middle]) <= ROUND_OFF*(axial[-1] - axial[0])
    for (chart, lines), name in zip(axes, film.fields):
        values, unit = film.readable(name)
        if numpy.ptp(values) <= TINY*numpy.abs(values).max():
            values = numpy.full_like(values, values.mean())  # held at a temperature: rounding makes no bands
        low, high = scale_of(values)
        draw_map(figure, chart, film, values, low, high, look_of(name, low, high), "both")
        chart.set_title(f"{FIELDS[name]} [{unit}]", fontsize=10)
        theta, shown = film.broken(values)
        lines.plot(theta, shown[:, middle], label="midplane" if at_middle else f"z = {axial[middle]:.3g} mm")
        draw_edges(lines, theta, shown, axial)
        mark_load((chart, lines), film, scene)
        if name != "heat_flux_shaft":
            mark_hottest(chart, lines, film, values, unit)
        elif low < 0.0 < high:
            lines.axhline(0.0, color="k", linewidth=0.6)
        margin = SPAN*(high - low)
        lines.set_ylim(max(low - margin, values.min() - 0.2*margin), min(high + margin, values.max() + 0.2*margin))
        lines.set_ylabel(f"{FIELDS[name]} [{unit}]", fontsize=9)
        lines.grid(alpha=0.3)
        legend_above(lines)
    return with_labels(figure, axes, film, scene.title(path))


def scale_of(values):
    """The values between which colours differ."""
    low, high = numpy.quantile(values, (BEYOND, 1.0 - BEYOND))
    if high - low <= TINY*max(abs(low), abs(high)):
        low, high = values.min(), values.max()
    if high > low:
        return low, high
    return low - TINY*max(abs(low), 1.0), high + TINY*max(abs(high), 1.0)


def look_of(name, low, high):
    """Colours of a map: of heat that flows either way, white is none."""
    if name != "heat_flux_shaft":
        return {"cmap": "inferno", "norm": colors.Normalize(low, high)}
    if low < 0.0 < high:
        return around_zero(low, high)
    return {"cmap": "Reds" if high > 0.0 else "Blues_r", "norm": colors.Normalize(low, high)}


def mark_hottest(chart, lines, film, values, unit):
    """A ring where it is hottest."""
    ties = values >= values.max()*(1.0 - NEARLY)
    station, row = numpy.unravel_index(numpy.argmin(numpy.where(ties, numpy.abs(film.z), numpy.inf)), values.shape)
    look = {"color": "w", "markeredgecolor": "k", "markersize": 6.0, "zorder": 5}
    chart.plot(film.theta[station], 1.0e3*film.z[row], "o", clip_on=False, **look)
    lines.plot(film.theta[station], values[station, row], "o", label=f"hottest, {values[station, row]:.5g} {unit}", **look)


# --- an answer, a sweep ---

def draw(path, file, steps=(), parameter=None):
    """Where the heat goes and how hot all is at an answer; of a sweep without a step both along it."""
    if "history" not in file or HEATED not in file["history"]:
        stop(f"{path}: no heat in it: the case has no &thermal")
    if len(steps) > 1:
        stop("the heat of one point is drawn")
    history = file["history"]
    points = len(history[HEATED])
    if steps and not 1 <= steps[0] <= points:
        stop(f"{path}: no point {steps[0]}; there are 1 to {points}")
    if points == 0:
        stop(f"{path}: no point has an answer")
    if points > 1 and not steps:
        return draw_sweep(path, file, parameter)
    point = steps[0] - 1 if steps else 0
    words = read_scene(file).title(path)
    if points > 1:
        along, label = along_of(history, parameter, used_keys(file))
        words = f"{path.name.removesuffix('.h5')}: {label.split(' [')[0]} = {along[point]:.6g}{unit_of(label)}, point {point + 1} of {points}"
    return draw_answer({name: data[point] for name, data in history.items()}, words)


def unit_of(label):
    """The unit in an axis' words, behind a blank."""
    return f" {label[label.rindex('[') + 1:-1]}" if label.endswith("]") else ""


def draw_answer(results, words):
    """Bars of the heat's ways, and temperatures."""
    figure, (bars, levels) = pyplot.subplots(1, 2, figsize=(10.0, 3.6), width_ratios=(3, 2), layout="constrained")
    flows = balance(results)
    power = flows[0][1]
    for place, (_, flow) in enumerate(flows):
        bars.barh(place, flow, height=0.65, color="0.45" if place == 0 else "C3" if flow > 0.0 else "C0")
        share = f"  {flow:.4g} W" + ("" if place == 0 or not power > 0.0 else f", {100.0*flow/power:.3g} %")
        bars.annotate(share, (max(flow, 0.0), place), va="center", fontsize=9)
    bars.set_yticks(range(len(flows)), [name for name, _ in flows])
    bars.invert_yaxis()
    bars.axvline(0.0, color="k", linewidth=0.8)
    low, high = (limit([0.0, *(flow for _, flow in flows)]) for limit in (min, max))
    bars.set_xlim(low - 0.03*(high - low)*(low < 0.0), high + ROOM*(high - low))
    bars.set_xlabel("heat [W]" + (", negative: into the film" if low < 0.0 else ""))
    bars.set_title("where the heat goes", fontsize=10)
    draw_levels(levels, temperatures(results))
    for chart in (bars, levels):
        chart.grid(axis="x", alpha=0.3)
        chart.xaxis.set_major_locator(round_numbers(6))
    figure.suptitle(words, fontsize=11)
    return figure


def draw_levels(chart, known):
    """A line for everything that has a temperature: its mean, and how far it is to the hottest place."""
    highest = max(mean if largest is None else largest for _, mean, largest in known)
    lowest = min(mean for _, mean, _ in known)
    for place, (_, mean, largest) in enumerate(known):
        told = f"{mean:.1f} K"
        if largest is not None:
            chart.plot([mean, largest], [place, place], "-|", color="C3", markersize=10.0)
            told += f", at most {largest:.1f} K"
        chart.plot(mean, place, "o", color="C3")
        right = mean > 0.5*(lowest + highest)
        chart.annotate(told, (largest or mean, place) if right else (mean, place), xytext=(0, 7), textcoords="offset points",
                       ha="right" if right else "left", fontsize=8)
    chart.set_yticks(range(len(known)), [name for name, _, _ in known])
    chart.set_ylim(len(known) - 0.5, -0.8)
    span = max(highest - lowest, 1.0)
    chart.set_xlim(lowest - 0.1*span, highest + 0.1*span)
    chart.set_xlabel("temperature [K]")
    chart.set_title("how hot it is", fontsize=10)


def along_of(history, parameter, keys):
    """What a sweep changes, and the words of its axis."""
    if parameter is not None and parameter in history:
        along, unit = readable(history[parameter])
        return along, named(parameter, unit)
    if "key_value" in history:
        along, unit = readable(history["key_value"])
        name = keys.get(("sweep", "parameter"), ("value of the keys",))[0].strip("'").partition("%")[2]
        return along, named(name or "value of the keys", unit)
    return numpy.arange(1.0, len(history[HEATED]) + 1.0), "point"


def draw_sweep(path, file, parameter):
    """Temperatures, film and running clearance, and where the heat goes, over what the sweep changes; where the branch turns back."""
    history, keys = file["history"], used_keys(file)
    along, label = along_of(history, parameter, keys)
    turns = numpy.flatnonzero(history["fold"][...] > 0.5) if "fold" in history else numpy.empty(0, int)
    figure, axes = pyplot.subplots(2, 2, figsize=(10.0, 8.0), layout="constrained", sharex=True)
    charts = axes.ravel()

    def line(chart, values, words, look):
        """Values along the sweep, pale where the branch has turned back."""
        last = turns[0] + 1 if len(turns) else len(along)
        drawn, = chart.plot(along[:last], values[:last], label=words, markersize=3.5, **look)
        chart.plot(along[last - 1:], values[last - 1:], **look | {"alpha": 0.45*(drawn.get_alpha() or 1.0), "marker": ""})

    for name, (words, look) in LEVELS.items():
        if name in history:
            line(charts[0], history[name][...], words, look)
    charts[0].set_ylabel("temperature [K]")
    for name, words, colour in (("running_clearance", "running clearance", "C0"), ("axial_gap", "axial gap", "C0"),
                                ("minimum_gap", "thinnest film", "C1")):
        if name in history:
            line(charts[1], 1.0e6*history[name][...], words, {"color": colour, "marker": "o"})
    if ("bearing", "clearance") in keys:
        charts[1].axhline(1.0e6*float(keys["bearing", "clearance"][0]), color="0.4", linestyle=":", label="clearance, cold")
    charts[1].set_ylabel(("gap" if "axial_gap" in history else "clearance") + " and film [um]")
    power = history["power_loss"][...]
    for name, (words, colour) in FLOWS.items():
        if name not in history or not numpy.any(history[name][...]):
            continue
        line(charts[2], history[name][...], words, {"color": colour, "marker": "o"})
        if name != "power_loss":
            line(charts[3], 100.0*history[name][...]/power, words, {"color": colour, "marker": "o"})
    charts[2].set_ylabel("heat [W]")
    charts[3].set_ylabel("part of the power loss [%]")
    mark_turns(charts, along, label, turns, history["shaft_temperature"][...])
    if not (len(turns) or "summary" not in file or file["summary/converged"][()]):
        for chart in charts[:2]:
            chart.axvline(along[-1], color="0.4", linestyle="-.", linewidth=1.0, label=f"last answer: {along[-1]:,.5g}{unit_of(label)}")
    for chart in charts:
        chart.xaxis.set_major_locator(round_numbers(6))
        chart.yaxis.set_major_locator(round_numbers(6))
        chart.grid(alpha=0.3)
        chart.legend(fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, frameon=False)
    for chart in axes[-1]:
        chart.set_xlabel(label)
    figure.suptitle(f"{path.name.removesuffix('.h5')}: heat along the sweep", fontsize=11)
    return figure


def mark_turns(charts, along, label, turns, hot):
    """A line where the branch turns back; runaway, where the shaft has become hotter on the way there."""
    for row in turns:
        what = "runaway" if row > 0 and hot[row] > hot[row - 1] else "turns back"
        for place, chart in enumerate(charts):
            chart.axvline(along[row], color="C3", linestyle="-.", linewidth=1.0,
                          label=f"{what}: {along[row]:,.5g}{unit_of(label)}" if place < 2 else None)
