"""Films and foils of thrust bearings: their fields on the sectors, as they lie in the plane across the axis."""

import numpy
from matplotlib import pyplot

from gfb.plot.colours import around_zero, draw_bar, levels_of, look_of, round_numbers
from gfb.plot.film import GROOVE, ORIFICE, ROUND_OFF, WORDS, readable
from gfb.plot.foil import round_scale, shape_of
from gfb.plot.scene import scene_of
from gfb.report.thinnest import node_of_thinnest

TRAVEL = 0.15  # of a pad's longer side: how far the picture moves the node that moves most, at most
FLATTEST = 0.25  # of a box over its longest side


def is_ring(file):
    """Whether an open film or foil file is one of sectors across the axis; bumps are higher than flat, but less than they are wide."""
    points = file["VTKHDF/Points"]
    return bool(numpy.ptp(points[:, 1]) > numpy.ptp(points[:, 2]))


def sectors_of(file):
    """The nodes of each pad: their numbers on (station, row)."""
    fields = file["VTKHDF/PointData"]
    theta = fields["theta"][...]
    pad = fields["pad"][...] if "pad" in fields else numpy.ones(len(theta))
    rows = int(numpy.argmax(numpy.abs(theta - theta[0]) > ROUND_OFF))
    return [numpy.flatnonzero(pad == number).reshape(-1, rows) for number in numpy.unique(pad)]


def draw_outline(chart, points):
    """The edges of a sector, the leading one black."""
    edges = numpy.concatenate([points[0, :], points[:, -1], points[-1, ::-1], points[::-1, 0]])
    chart.plot(edges[:, 0], edges[:, 1], color="0.4", linewidth=0.6)
    chart.plot(points[0, :, 0], points[0, :, 1], color="k", linewidth=1.4)


def draw_ring(path, file, words=WORDS, look=look_of, bounds=lambda values: (values.min(), values.max())):
    """A map a field that has words, seen from the runner: it turns from x to y."""
    fields, points = file["VTKHDF/PointData"], 1.0e3*file["VTKHDF/Points"][...]
    names = [name for name in words if name in fields and (name != "deflection" or numpy.any(fields[name]))]
    figure, axes = pyplot.subplots(1, len(names), figsize=(4.6*len(names), 4.8), squeeze=False, layout="constrained")
    sectors, scene = sectors_of(file), scene_of(path)
    for chart, name in zip(axes[0], names, strict=True):
        values, unit = readable(fields[name])
        low, high = bounds(values)
        shades = look(name, low, high)
        levels = levels_of(low, high, shades["norm"])
        beyond = "both" if high - low < numpy.ptp(values) else "neither"
        for nodes in sectors:
            chart.contourf(points[nodes, 0], points[nodes, 1], values[nodes], levels=levels, extend=beyond, **shades)
            draw_outline(chart, points[nodes])
        for theta, radius in scene.holes:
            chart.plot(1.0e3*radius*numpy.cos(numpy.radians(theta)), 1.0e3*radius*numpy.sin(numpy.radians(theta)), **ORIFICE)
        if name == "gap":
            pad = fields["pad"][...] if "pad" in fields else numpy.zeros(len(values))
            thinnest = node_of_thinnest(values, fields["theta"][...], numpy.hypot(points[:, 0], points[:, 1]), pad, True)[0]
            chart.plot(points[thinnest, 0], points[thinnest, 1], "o", color="w", markeredgecolor="k", markersize=6.0, zorder=5)
            chart.text(0.5, 0.5, f"thinnest\n{values[thinnest]:.3g} {unit}", transform=chart.transAxes, ha="center", va="center",
                       fontsize=9)
        for line in scene.grooves:
            chart.plot(*(1.0e3*numpy.array([(r*numpy.cos(angle), r*numpy.sin(angle)) for angle, r in line])).T, **GROOVE)
        draw_bar(figure, chart, **shades, location="bottom", extend=beyond)
        chart.set_title(f"{words[name]} [{unit}]", fontsize=10)
        chart.set_aspect("equal")
        chart.set_xlabel("x [mm]")
        chart.set_ylabel("y [mm]")
    figure.suptitle(scene.title(path) + "\nthe runner turns from x to y; leading edges are black", fontsize=10)
    return figure


def draw_foil(path, file):
    """A pad's foil: how far it is away from where it rests, with the lines that touch, and its shape in space."""
    shape = shape_of(path, file)
    fields, points = file["VTKHDF/PointData"], 1.0e3*file["VTKHDF/Points"][...].reshape(shape)
    moved = fields["displacement"][...].reshape(shape)[:, :, 2]
    if points[:, :, 2].mean() > 0.0:  # of the bearing on the runner's other side, which is drawn as if it faced up, too
        moved, points = -moved, points*[1.0, 1.0, -1.0]
    away = -1.0e6*moved
    figure = pyplot.figure(figsize=(11.0, 5.2), layout="constrained")
    chart, space = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2, projection="3d")
    look = around_zero(away.min(), away.max())
    drawn = chart.contourf(points[:, :, 0], points[:, :, 1], away, levels=levels_of(away.min(), away.max(), look["norm"]), **look)
    draw_outline(chart, points)
    words = "deflection away from the runner [um]"
    if "contact_state" in fields:
        words += "; dashed: " + ("lines that touch" if numpy.ptp(points[:, :, 2]) > 0.0 else "crests that push")
        touches = fields["contact_state"][...].reshape(shape[:2]) > 0.0
        for station in numpy.flatnonzero(touches.any(axis=1)):
            x, y = (numpy.where(touches[station], points[station, :, axis], numpy.nan) for axis in (0, 1))
            chart.plot(x, y, color="0.3", linewidth=0.8, linestyle="--")
    chart.set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
    chart.set_title(words, fontsize=10)
    draw_in_space(space, points, moved, drawn)
    draw_bar(figure, [chart, space], **look, location="bottom", shrink=0.5)
    what = path.name.removesuffix(".vtkhdf").rpartition(".")[2].replace("_", " ")
    figure.suptitle(f"{scene_of(path).title(path)}: {what}\nthe runner turns from x to y; the leading edge is black", fontsize=10)
    return figure


def draw_in_space(chart, points, moved, colours):
    """The deflected foil, the runner above it; along the axis it is moved further than it moves."""
    largest, side = 1.0e3*float(numpy.abs(moved).max()), float(numpy.ptp(points[:, :, :2], axis=(0, 1)).max())
    high = float(numpy.ptp(points[:, :, 2]))
    travel = 0.5*high if high > 0.0 else TRAVEL*side  # of bumps, over their height
    scale = round_scale(travel/largest) if largest > 0.0 else 1.0
    x, y, z = points[:, :, 0], points[:, :, 1], points[:, :, 2] + 1.0e3*scale*moved
    values = -1.0e6*moved
    inside = 0.25*(values[1:, 1:] + values[:-1, 1:] + values[1:, :-1] + values[:-1, :-1])
    chart.plot_surface(x, y, z, facecolors=colours.to_rgba(inside), rstride=1, cstride=1, linewidth=0.0, antialiased=False, shade=False)
    chart.plot(x[0], y[0], z[0], color="k", linewidth=1.4)
    chart.set(xlabel="x [mm]", ylabel="y [mm]", zticks=[])
    chart.set_title(f"displacements x {scale:g}, the runner is above", fontsize=10)
    sides = numpy.array([numpy.ptp(x), numpy.ptp(y), numpy.ptp(z)])
    chart.set_box_aspect(numpy.maximum(sides, FLATTEST*sides.max()), zoom=1.2)
    for axis in (chart.xaxis, chart.yaxis):
        axis.set_major_locator(round_numbers(4))
    # Across the pad, from its outer radius and behind its trailing edge.
    chart.view_init(elev=32.0, azim=numpy.degrees(numpy.arctan2(y[-1, -1], x[-1, -1])) + 15.0)
