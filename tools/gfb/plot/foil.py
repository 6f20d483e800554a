"""Pictures of a foil file: deflected midline and crests of bumps, map of a top foil, or shapes of modes."""

import math

import numpy
from matplotlib import colors, pyplot

from gfb.plot.colours import around_zero, draw_bar, levels_of, round_numbers
from gfb.plot.scene import draw_edges, pad_of, scene_of, theta_above
from gfb.tool import stop

SHARE = 0.4        # of the foil's height: how far the picture moves the node that sinks most, at most
MODE_SHARE = 0.12  # of the foil's shorter side, for modes
LEAST_SIDE = 0.22  # of a mode's box over its longest one, to show narrow foils
ROUND_OFF = 1.0e-9 # of the foil's height: a smaller displacement is none
LINES = 14         # of a wireframe along each direction, at most
MOST_LABELLED = 14 # bars that carry their value


def is_foil(file):
    """Whether a grid file is of a foil: it has displacements or modes."""
    return "VTKHDF" in file and bool(names(file))


def names(file):
    """Vector fields of the file: displacement, or mode_1, mode_2 ..."""
    fields = file["VTKHDF/PointData"]
    return sorted((name for name in fields if name == "displacement" or name.startswith("mode_")),
                  key=lambda name: (len(name), name))


def draw(path, file, columns):
    """The picture of a foil: its deflection, or the modes named (the first where none is)."""
    there = names(file)
    unknown = [name for name in columns if name not in there]
    if unknown:
        stop(f"{path}: no field {', '.join(unknown)}; there are: {', '.join(there)}")
    shape = shape_of(path, file)
    points = file["VTKHDF/Points"][...].reshape(shape)
    fields = {name: file[f"VTKHDF/PointData/{name}"][...].reshape(shape) for name in columns or there[:1]}
    scene, name = scene_of(path), path.name.removesuffix(".vtkhdf").rpartition(".")[2]
    if list(fields) == ["displacement"]:
        flat = not numpy.ptp(points[:, :, 1]) > ROUND_OFF*numpy.ptp(points[:, :, 0])
        figure = (draw_sheet if flat else draw_strip)(points, fields["displacement"], scene, pad_of(name))
    else:
        figure = draw_modes(points, fields, scene)
    figure.suptitle(f"{scene.title(path)}: {name.replace('_', ' ')}", fontsize=11)
    return figure


def shape_of(path, file):
    """(stations, rows, 3) of a foil's points."""
    cells = file["VTKHDF/Connectivity"][...].reshape(-1, 4)
    rows, many = int(cells[0].max() - cells[0].min() - 1), len(file["VTKHDF/Points"])  # a cell joins neighbours of two stations
    if many % rows:
        stop(f"{path}: not a foil of stations and rows")
    return many//rows, rows, 3


def round_scale(value):
    """The largest of 1, 2, 5 times a power of ten that is not above a value."""
    power = 10.0**math.floor(math.log10(value))
    return max(one*power for one in (1.0, 2.0, 5.0) if one*power <= value)


# --- deflection ---

def crest_stations(height):
    """Stations higher than their neighbours."""
    between = range(1, len(height) - 1)
    return [i for i in between if height[i] > height[i - 1] and height[i] > height[i + 1]]


def line_mean(values, z):
    """Mean along a line of nodes (trapezoid rule)."""
    return float(numpy.sum(0.5*(values[1:] + values[:-1])*numpy.diff(z))/(z[-1] - z[0]))


def draw_strip(points, moved, scene, pad):
    """The midline from the side, at rest and deflected; deflection along each crest and its mean."""
    z = points[0, :, 2]
    middle = int(numpy.argmin(numpy.abs(z)))
    rest, change = points[:, middle, :2], moved[:, middle, :2]
    height = numpy.ptp(rest[:, 1])
    largest = numpy.abs(change[:, 1]).max()
    if not (height > 0.0 and largest > ROUND_OFF*height):
        stop("nothing bends here: no bumps, or no displacement; a strip that is let go again shows it with "
             "steps_down = 0")
    scale = round_scale(SHARE*height/largest)
    crests = crest_stations(rest[:, 1])
    figure = pyplot.figure(figsize=(10.0, 5.6), layout="constrained")
    grid = figure.add_gridspec(2, 2)
    side, bars, lines = (figure.add_subplot(grid[place]) for place in
                         (numpy.s_[0, :], numpy.s_[1, 0], numpy.s_[1, 1]))
    place = 1.0e3*(rest + scale*change)
    side.plot(1.0e3*rest[:, 0], 1.0e3*rest[:, 1], color="0.6", linewidth=1.0, label="at rest")
    side.plot(place[:, 0], place[:, 1], color="C0", label=f"deflected, displacements x {scale:g}")
    side.set(xlabel="x [mm]", ylabel="v [mm]", ylim=(None, 1.0e3*height*1.55))
    side.set_title("midline from the side, v drawn larger than x", fontsize=10)
    theta_above(side, scene, pad)
    side.legend(fontsize=8, ncols=2, loc="upper left")
    side.grid(alpha=0.3)
    numbers = range(1, len(crests) + 1)
    deflection = [-1.0e6*line_mean(moved[i, :, 1], z) for i in crests]
    charted = bars.bar(numbers, deflection)
    if len(crests) <= MOST_LABELLED:
        bars.bar_label(charted, fmt="%.2f", fontsize=7)
    bars.set(xlabel="bump", ylabel="deflection [um]", xticks=numbers[::1 + len(crests)//(MOST_LABELLED + 1)])
    bars.set_title("mean of each crest line", fontsize=10)
    bars.margins(y=0.12)
    for number in sorted({1, 2, len(crests)//2, len(crests) - 1, len(crests)} - {0}):
        lines.plot(1.0e3*z, -1.0e6*moved[crests[number - 1], :, 1], label=f"bump {number}")
    lines.set(xlabel="z [mm]", ylabel="deflection [um]")
    lines.set_title("along crest lines", fontsize=10)
    lines.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    lines.grid(alpha=0.3)
    return figure


def draw_sheet(points, moved, scene, pad):
    """A top foil: map of its deflection towards the sleeve, and that along the midplane and the two edges."""
    x, z = 1.0e3*points[:, 0, 0], 1.0e3*points[0, :, 2]
    deflection = -1.0e6*moved[:, :, 1]
    figure, (chart, lines) = pyplot.subplots(2, 1, figsize=(10.0, 5.6), layout="constrained", sharex=True)
    low, high = deflection.min(), deflection.max()
    look = around_zero(low, high)
    chart.contourf(x, z, deflection.T, levels=levels_of(low, high, look["norm"]), **look)
    draw_bar(figure, chart, **look)
    theta_above(chart, scene, pad)
    chart.set(ylabel="z [mm]")
    chart.set_title("deflection towards the sleeve [um]", fontsize=10)
    middle = int(numpy.argmin(numpy.abs(z)))
    lines.plot(x, deflection[:, middle], label="midplane" if abs(z[middle]) <= ROUND_OFF*z[-1] else f"z = {z[middle]:.3g} mm")
    draw_edges(lines, x, deflection, z)
    lines.set(xlabel="x [mm], along the shaft's motion", ylabel="deflection [um]", xlim=(x[0], x[-1]))
    lines.axhline(0.0, color="0.4", linewidth=0.8)
    lines.grid(alpha=0.3)
    lines.legend(fontsize=8)
    return figure


# --- modes ---

def draw_modes(points, fields, scene):
    """Surfaces moved by each field, coloured by how far, over the wireframe of rest."""
    down = -(-len(fields)//2)
    figure, axes = pyplot.subplots(down, min(2, len(fields)), squeeze=False, subplot_kw={"projection": "3d"},
                                   figsize=(5.8*min(2, len(fields)) + 1.0, 4.0*down), layout="constrained")
    for chart, (name, moved) in zip(axes.flat, fields.items()):
        draw_mode(chart, points, moved)
        frequency = f", {hertz(scene.frequencies[name])} Hz" if name in scene.frequencies else ""
        chart.set_title(name.replace("_", " ") + frequency, fontsize=10)
    for chart in axes.flat[len(fields):]:
        chart.set_visible(False)
    scale = pyplot.cm.ScalarMappable(colors.Normalize(0.0, 1.0), "viridis")
    figure.colorbar(scale, ax=axes, shrink=0.6, pad=0.16/min(2, len(fields)), ticks=round_numbers(5)).set_label("displacement over the largest", fontsize=9)
    return figure


def hertz(frequency):
    """A frequency with four digits or more, none of them a power of ten."""
    return f"{frequency:,.0f}" if frequency >= 1000.0 else f"{frequency:.4g}"


def strides(shape):
    """Steps of a wireframe."""
    return {"rstride": max(1, shape[0]//(4*LINES)), "cstride": max(1, shape[1]//LINES)}


def draw_mode(chart, points, moved):
    """One shape; x and z level, v upwards, to one scale but for sides much shorter than the longest."""
    far = numpy.linalg.norm(moved, axis=2)
    if not far.max() > 0.0:
        stop("a mode without displacement")
    extent = numpy.ptp(points.reshape(-1, 3), axis=0)
    place = 1.0e3*(points + MODE_SHARE*extent[[0, 2]].min()/far.max()*moved)
    points = 1.0e3*points
    chart.plot_wireframe(points[:, :, 0], points[:, :, 2], points[:, :, 1], color="0.75", linewidth=0.4, clip_on=False,
                         **strides(points.shape))
    colours = pyplot.get_cmap("viridis")(0.25*(far[1:, 1:] + far[:-1, 1:] + far[1:, :-1] + far[:-1, :-1])/far.max())
    chart.plot_surface(place[:, :, 0], place[:, :, 2], place[:, :, 1], facecolors=colours, rstride=1, cstride=1,
                       linewidth=0.0, antialiased=False, shade=False, clip_on=False)
    for axis, name in ((chart.xaxis, "x"), (chart.yaxis, "z"), (chart.zaxis, "v")):
        axis.set_label_text(f"{name} [mm]", fontsize=8)
        axis.labelpad = 1.0
        axis.set_major_locator(pyplot.MaxNLocator(4))
    both = numpy.concatenate((points.reshape(-1, 3), place.reshape(-1, 3)))
    sides = numpy.ptp(both, axis=0)
    chart.set_box_aspect(numpy.maximum(sides, LEAST_SIDE*sides.max())[[0, 2, 1]], zoom=1.1)
    chart.tick_params(labelsize=7)
    chart.view_init(elev=28.0, azim=-62.0 if sides[0] > 0.5*sides[2] else -35.0)
