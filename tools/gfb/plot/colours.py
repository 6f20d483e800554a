"""Colours of maps: enough of them, over a scale on which the loaded zone is seen."""

import numpy
from matplotlib import cm, colors, rcParamsDefault, ticker

BANDS = 200      # colours of a map: so many that none hides a difference
NARROW = 0.02    # of what is below zero: what is above is spread no further, so that rounding has no colour
LINES = tuple(one["color"] for one in rcParamsDefault["axes.prop_cycle"])  # of curves, here and in the studio
TICKS = 6        # numbers beside a scale, about
THICKNESS = {"gap"}      # fields whose scale is logarithmic: the loaded zone is a small part of the largest
SIGNED = {"deflection"}  # fields with colours on both sides of zero


def round_numbers(count):
    """Places of about so many ticks."""
    return ticker.MaxNLocator(count, steps=[1, 2, 5, 10])


def around_zero(low, high):
    """A scale whose white is zero; what is above has all shades, however far the rest reaches below.

    A free edge that lifts further than loaded foils deflect would leave these without colour.
    """
    down, up = max(-low, 0.0), max(high, 0.0)
    up = max(up, NARROW*down) or 1.0
    return {"cmap": "RdBu_r", "norm": colors.TwoSlopeNorm(0.0, -max(down, up), up)}


def look_of(name, low, high):
    """Colours of a field of a film between two values."""
    if name in SIGNED:
        return around_zero(low, high)
    if name in THICKNESS and 0.0 < low < high:
        return {"cmap": "viridis", "norm": colors.LogNorm(low, high)}
    return {"cmap": "viridis", "norm": colors.Normalize(low, high)}


def levels_of(low, high, norm):
    """Borders of the colours between two values, as the scale spreads them."""
    if not high > low:  # contourf wants two
        return numpy.array((low, numpy.nextafter(low, numpy.inf)))
    levels = numpy.asarray(norm.inverse(numpy.linspace(norm(low), norm(high), BANDS + 1)), dtype=float)
    levels[[0, -1]] = low, high  # without rounding
    return levels


def draw_bar(figure, charts, cmap, norm, **look):
    """A colour bar with round numbers; of a scale about zero each side has its half."""
    bar = figure.colorbar(cm.ScalarMappable(norm, cmap), ax=charts, **look)
    ticks = round_ticks(norm)
    bar.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    bar.ax.minorticks_off()
    return bar


def round_ticks(norm):
    """Round numbers on a scale."""
    if isinstance(norm, colors.LogNorm):
        return decade_numbers(norm.vmin, norm.vmax)
    if isinstance(norm, colors.TwoSlopeNorm):
        found = [*round_numbers(TICKS//2).tick_values(norm.vmin, 0.0), *round_numbers(TICKS//2).tick_values(0.0, norm.vmax)[1:]]
    else:
        found = round_numbers(TICKS).tick_values(norm.vmin, norm.vmax)
    return [tick for tick in found if norm.vmin <= tick <= norm.vmax]


def decade_numbers(low, high):
    """Round numbers on a logarithmic scale: 1, 2, 5 of every power of ten, or evenly apart where these are too few."""
    powers = 10.0**numpy.arange(numpy.floor(numpy.log10(low)), numpy.ceil(numpy.log10(high)) + 1.0)
    found = [one*power for power in powers for one in (1.0, 2.0, 5.0) if low <= one*power <= high]
    if len(found) >= TICKS//2:
        return found
    return [value for value in round_numbers(TICKS).tick_values(low, high) if low <= value <= high]
