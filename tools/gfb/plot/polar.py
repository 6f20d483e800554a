"""The film around the shaft: pressure and film thickness over theta, with load, pad edges and thinnest film."""

import numpy
from matplotlib import pyplot

from gfb.plot.colours import round_numbers
from gfb.plot.film import ORIFICE, ROUND_OFF, WORDS, read_film
from gfb.plot.scene import scene_of
from gfb.tool import stop

KIND = "polar"
SHOWN = ("pressure", "gap")
HOLE = 0.6    # of the drawn range: radius of the circle in the middle, on which the smallest values stand
ROOM = 0.04   # of the range: beyond its ends
LOAD = 0.85   # of the hole: how far the arrow of the load reaches


def draw(path, file):
    """Two pictures around the shaft: along the midplane, and dashed along the edges."""
    film, scene = read_film(path, file), scene_of(path)
    names = [name for name in SHOWN if name in film.fields]
    if not names:
        stop(f"{path}: no pressure or gap in it")
    figure, axes = pyplot.subplots(1, len(names), figsize=(5.6*len(names), 6.3), squeeze=False, subplot_kw={"projection": "polar"})
    for chart, name in zip(axes[0], names):
        draw_field(chart, film, name)
        mark_load(chart, scene)
        mark_holes(chart, scene)
        if name == "gap":
            mark_thinnest(chart, film)
    words = dict(entry[::-1] for chart in axes[0] for entry in zip(*chart.get_legend_handles_labels()))
    figure.legend(words.values(), words.keys(), fontsize=9, loc="lower center", ncols=3)
    figure.subplots_adjust(left=0.05, right=0.95, top=0.83, bottom=0.19, wspace=0.2)
    figure.suptitle(scene.title(path), fontsize=11)
    return figure


def draw_field(chart, film, name):
    """A field over theta, a line a row that is shown, and the pads' edges."""
    values, unit = film.readable(name)
    rows = [(film.middle, "-", "midplane" if abs(film.z[film.middle]) <= ROUND_OFF*numpy.ptp(film.z) else
             f"z = {1.0e3*film.z[film.middle]:.3g} mm")]
    rows += [(row, style, f"edge, z = {1.0e3*film.z[row]:.4g} mm") for row, style in ((-1, "--"), (0, ":"))]
    if numpy.allclose(values[:, 0], values[:, -1], rtol=ROUND_OFF, atol=0.0):
        rows = [rows[0], (-1, "--", "edges")]
    shown = values[:, [row for row, _, _ in rows]]
    low, high = 0.0 if name == "gap" else float(shown.min()), float(shown.max())  # a film that is thin looks thin
    span = high - low if high - low > ROUND_OFF*abs(high) else abs(high) or 1.0
    angle = numpy.radians(film.theta)
    pads = film.pads
    for pad in pads:
        for colour, (row, style, label) in enumerate(rows):
            chart.plot(angle[pad], values[pad, row], style, color=f"C{colour}", linewidth=1.4, label=label if pad == pads[0] else None)
        for end in (pad.start, pad.stop - 1):
            chart.plot(2*[angle[end]], (low, high + ROOM*span), color="0.45", linewidth=0.9,
                       label="pad edges" if end == 0 else None)
    inside = 0.0 if name == "gap" else ROOM*span  # the shaft is where the film is zero
    chart.set_ylim(low - inside, high + ROOM*span)
    chart.set_rorigin(low - HOLE*span - inside)
    chart.yaxis.set_major_locator(round_numbers(4))
    chart.set_rlabel_position(22.5)  # between the angles' labels
    chart.tick_params(axis="y", labelsize=8)
    chart.set_title(f"{WORDS[name]} [{unit}] over theta", fontsize=10, pad=12.0)
    chart.grid(alpha=0.4)


def mark_load(chart, scene):
    """An arrow of the load, from the shaft's centre."""
    if scene.load_angle is None:
        return
    angle, origin, (low, _) = numpy.radians(scene.load_angle), chart.get_rorigin(), chart.get_ylim()
    tip = origin + LOAD*(low - origin)
    chart.annotate("", (angle, tip), (angle, origin), arrowprops={"arrowstyle": "-|>", "color": "k", "linewidth": 1.6}, annotation_clip=False)
    chart.plot([], [], "k-", linewidth=1.6, marker=">", markersize=5, label="load on the shaft")


def mark_holes(chart, scene):
    """Where orifices are, on the outer circle."""
    angles = sorted({theta % 360.0 for theta, _ in scene.holes})
    if angles:
        chart.plot(numpy.radians(angles), [chart.get_ylim()[1]]*len(angles), **ORIFICE, linestyle="none", clip_on=False, label="orifices")


def mark_thinnest(chart, film):
    """A ring where the film is thinnest, on the row that is shown and nearest to it."""
    values, unit = film.readable("gap")
    ties = values <= values.min()*(1.0 + ROUND_OFF)  # a gap that is the same along z is marked in the middle
    station, row = numpy.unravel_index(numpy.argmin(numpy.where(ties, numpy.abs(film.z), numpy.inf)), values.shape)
    low, high = chart.get_ylim()
    place = min(max(values[station, row], low), high)  # between the rows shown it may be thinner than on them
    chart.plot(numpy.radians(film.theta[station]), place, "o", color="w", markeredgecolor="k", markersize=6.5, zorder=5, clip_on=False,
               label=f"thinnest: {values[station, row]:.3g} {unit} at {film.theta[station] % 360.0:.0f} deg, z = {1.0e3*film.z[row]:.3g} mm")
