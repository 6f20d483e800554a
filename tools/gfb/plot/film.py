"""Films of bearings: their fields on stations and rows, maps of them and lines along midplane and edges."""

import dataclasses

import numpy
from matplotlib import pyplot

from gfb import tables
from gfb.plot.colours import draw_bar, levels_of, look_of
from gfb.plot.scene import draw_edges, scene_of
from gfb.results import attribute
from gfb.tool import stop

FIELDS = ("pressure", "gap", "deflection")
WORDS = {"pressure": "absolute pressure", "gap": "film thickness", "deflection": "foil deflection"}
GROOVE = {"color": "k", "linewidth": 0.5, "alpha": 0.5}  # a line along a groove
ORIFICE = {"marker": "o", "color": "none", "markeredgecolor": "k", "markersize": 4.0, "markeredgewidth": 0.8, "zorder": 4}  # an orifice
ROUND_OFF = 1.0e-9  # of the bearing's length: a row nearer to z = 0 is the midplane


@dataclasses.dataclass
class Film:
    """The fields of a film file."""

    theta: numpy.ndarray  # of the stations, growing [deg]
    z: numpy.ndarray      # of the rows, from the midplane [m]
    fields: dict          # name: values on (station, row), in SI units
    units: dict           # name: unit
    ends: tuple = ()      # of the pads: station behind the last one of each

    @property
    def pads(self):
        """Stations of every pad."""
        ends = self.ends or (len(self.theta),)
        return [slice(first, last) for first, last in zip((0, *ends), ends)]

    def broken(self, values):
        """theta, and values on the stations, with nothing between pads: a line over them has a gap where a bearing has one."""
        return broken(self.theta, values, self.ends[:-1])

    @property
    def middle(self):
        """Row nearest to the midplane."""
        return int(numpy.argmin(numpy.abs(self.z)))

    def readable(self, name):
        """A field in the unit of a picture, and that unit."""
        return tables.readable(self.fields[name], self.units[name])


def ends_of(pad):
    """Places behind the last station of every pad but the last, of the pads' numbers at the stations."""
    return tuple(int(last) + 1 for last in numpy.flatnonzero(numpy.diff(pad)))


def broken(along, values, ends):
    """Places along a line and values there, with nothing between at these numbers."""
    return numpy.insert(along, ends, numpy.nan), numpy.insert(values, ends, numpy.nan, axis=0)


def readable(data):
    """Values of a dataset in the unit of a picture, and that unit."""
    return tables.readable(data[...], attribute(data, "unit"))


def read_film(path, file, names=FIELDS):
    """The film of an open file, with the fields of these names that it has."""
    points = file["VTKHDF/Points"][...]
    fields = file["VTKHDF/PointData"]
    rows = int(numpy.count_nonzero(points[:, 0] == points[0, 0]))
    if "theta" not in fields or len(points) % rows:
        stop(f"{path}: not the film of a bearing")
    shape = (len(points)//rows, rows)
    theta = numpy.degrees(fields["theta"][...].reshape(shape)[:, 0])
    if theta[-1] <= theta[0]:  # a full ring ends where it begins
        theta[-1] += 360.0
    there = [name for name in names if name in fields]
    z = points[:rows, 2]
    z = z - 0.5*(z[0] + z[-1])  # of the second bearing of a rotor, too, from its midplane
    pad = fields["pad"][...].reshape(shape)[:, 0] if "pad" in fields else numpy.ones(shape[0])
    ends = (*ends_of(pad), shape[0])
    return Film(theta, z, {name: fields[name][...].reshape(shape) for name in there},
                {name: attribute(fields[name], "unit") for name in there}, ends)


def draw_film(path, file):
    """Maps at the left, lines at the right, one row a field."""
    film = read_film(path, file)
    names = [name for name in film.fields if name != "deflection" or numpy.any(film.fields[name])]
    if not names:
        stop(f"{path}: no pressure, gap or deflection in it")
    figure, axes = pyplot.subplots(len(names), 2, figsize=(10.0, 2.5*len(names) + 0.5), squeeze=False,
                                   layout="constrained", sharex=True)
    axial, middle, scene = 1.0e3*film.z, film.middle, scene_of(path)
    at_middle = abs(axial[middle]) <= ROUND_OFF*(axial[-1] - axial[0])
    for (chart, lines), name in zip(axes, names):
        values, unit = film.readable(name)
        draw_map(figure, chart, film, values, values.min(), values.max(), look_of(name, values.min(), values.max()))
        chart.set_title(f"{WORDS[name]} [{unit}]", fontsize=10)
        theta, shown = film.broken(values)
        lines.plot(theta, shown[:, middle], label="midplane" if at_middle else f"z = {axial[middle]:.3g} mm")
        draw_edges(lines, theta, shown, axial)
        mark_load((chart, lines), film, scene)
        mark_grooves(chart, film, scene)
        mark_holes(chart, film, scene)
        if name == "gap":
            mark_thinnest(chart, lines, film, values, unit)
        lines.set_ylabel(f"{WORDS[name]} [{unit}]")
        lines.grid(alpha=0.3)
        legend_above(lines)
    return with_labels(figure, axes, film, scene.title(path))


def with_labels(figure, axes, film, title):
    """The figure with the angle below its last row of charts, and its title."""
    for one in axes[-1]:
        label_theta(one, film)
    figure.suptitle(title, fontsize=11)
    return figure


def legend_above(chart):
    """A legend that covers no line."""
    chart.legend(fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False, borderpad=0.1)


def mark_load(charts, film, scene):
    """A line where the load presses the shaft."""
    if scene.load_angle is None:
        return
    place = film.theta[0] + (scene.load_angle - film.theta[0]) % 360.0
    for chart in charts:
        chart.axvline(place, color="k", linewidth=0.9, linestyle="-.", label="direction of the load")


def mark_grooves(chart, film, scene):
    """Thin lines along the grooves, as they lie at one moment."""
    for line in scene.grooves:
        theta, along = numpy.degrees([angle for angle, _ in line]), [1.0e3*place for _, place in line]
        theta = film.theta[0] + (theta - film.theta[0]) % 360.0
        chart.plot(*broken(theta, numpy.array(along), numpy.flatnonzero(numpy.abs(numpy.diff(theta)) > 180.0) + 1), **GROOVE)


def mark_holes(chart, film, scene):
    """A circle at every orifice."""
    for theta, along in scene.holes:
        chart.plot(film.theta[0] + (theta - film.theta[0]) % 360.0, 1.0e3*along, **ORIFICE)


def mark_thinnest(chart, lines, film, values, unit):
    """A ring where the film is thinnest."""
    ties = values <= values.min()*(1.0 + ROUND_OFF)  # a gap that is the same along z is marked in the middle
    station, row = numpy.unravel_index(numpy.argmin(numpy.where(ties, numpy.abs(film.z), numpy.inf)), values.shape)
    place = film.theta[station], 1.0e3*film.z[row]
    chart.plot(*place, "o", color="w", markeredgecolor="k", markersize=6.0, clip_on=False, zorder=5)
    lines.plot(film.theta[station], values[station, row], "o", color="w", markeredgecolor="k", markersize=6.0, zorder=5,
               label=f"thinnest, {values[station, row]:.3g} {unit}")


def draw_map(figure, chart, film, values, low, high, look, extend="neither"):
    """Colours over theta and z between two values, a patch a pad, with their scale."""
    levels = levels_of(low, high, look["norm"])
    for pad in film.pads:
        chart.contourf(film.theta[pad], 1.0e3*film.z, values[pad].T, levels=levels, extend=extend, **look)
    draw_bar(figure, chart, **look, extend=extend)
    chart.set_ylabel("z [mm]")


def label_theta(chart, film):
    """The axis along the motion: of pads with gaps the whole turn."""
    end = film.theta[-1] if len(film.pads) == 1 else film.theta[0] + 360.0
    chart.set_xlabel("theta [deg]")
    chart.set_xticks(numpy.arange(60.0*numpy.ceil(film.theta[0]/60.0), end + 1.0, 60.0))
    chart.set_xlim(film.theta[0], end)
