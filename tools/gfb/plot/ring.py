"""Films of thrust bearings: their fields on the sectors, as they lie in the plane across the axis."""

import numpy
from matplotlib import pyplot

from gfb.plot.film import BANDS, FIELDS, ROUND_OFF, SIGNED, WORDS, around_zero, readable
from gfb.plot.scene import round_numbers, scene_of


def is_ring(file):
    """Whether an open film file is one of sectors in a plane across the axis."""
    points = file["VTKHDF/Points"]
    return bool(numpy.ptp(points[:, 1]) > 0.0)


def sectors_of(file):
    """The nodes of each pad: their numbers on (station, row)."""
    fields = file["VTKHDF/PointData"]
    theta = fields["theta"][...]
    pad = fields["pad"][...] if "pad" in fields else numpy.ones(len(theta))
    rows = int(numpy.argmax(numpy.abs(theta - theta[0]) > ROUND_OFF))
    return [numpy.flatnonzero(pad == number).reshape(-1, rows) for number in numpy.unique(pad)]


def draw_ring(path, file):
    """A map a field, seen from the runner: it turns from x to y."""
    fields, points = file["VTKHDF/PointData"], 1.0e3*file["VTKHDF/Points"][...]
    names = [name for name in FIELDS if name in fields and (name != "deflection" or numpy.any(fields[name]))]
    figure, axes = pyplot.subplots(1, len(names), figsize=(4.6*len(names), 4.8), squeeze=False, layout="constrained")
    sectors = sectors_of(file)
    for chart, name in zip(axes[0], names, strict=True):
        values, unit = readable(fields[name])
        levels = round_numbers(BANDS).tick_values(values.min(), values.max()) if numpy.ptp(values) > 0.0 else BANDS
        look = around_zero(values) if name in SIGNED else {}
        for nodes in sectors:
            drawn = chart.contourf(points[nodes, 0], points[nodes, 1], values[nodes], levels=levels, **look)
            outline = numpy.concatenate([nodes[0, :], nodes[:, -1], nodes[-1, ::-1], nodes[::-1, 0]])
            chart.plot(points[outline, 0], points[outline, 1], color="0.4", linewidth=0.6)
            chart.plot(points[nodes[0], 0], points[nodes[0], 1], color="k", linewidth=1.4)
        if name == "gap":
            thinnest = int(numpy.argmin(values))
            chart.plot(points[thinnest, 0], points[thinnest, 1], "o", color="w", markeredgecolor="k", markersize=6.0, zorder=5)
            chart.text(0.5, 0.5, f"thinnest\n{values[thinnest]:.3g} {unit}", transform=chart.transAxes, ha="center", va="center",
                       fontsize=9)
        figure.colorbar(drawn, ax=chart, location="bottom", ticks=round_numbers(6), spacing="proportional")
        chart.set_title(f"{WORDS[name]} [{unit}]", fontsize=10)
        chart.set_aspect("equal")
        chart.set_xlabel("x [mm]")
        chart.set_ylabel("y [mm]")
    figure.suptitle(scene_of(path).title(path) + "\nthe runner turns from x to y; leading edges are black", fontsize=10)
    return figure
