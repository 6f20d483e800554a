"""Film and foils in space, rolled up on the shaft or on a runner: a picture with heights and displacements drawn larger, and CASE.3d.vtkhdf."""

import contextlib
import dataclasses
import math

import h5py
import numpy
from matplotlib import colors, pyplot

from gfb import steps
from gfb.files import fresh
from gfb.plot.colours import around_zero, draw_bar
from gfb.plot.film import WORDS
from gfb.plot.foil import round_scale
from gfb.plot.scene import case_name, leading_edges, number, of_pad, pad_of, scene_of
from gfb.results import attribute, open_results, used_keys
from gfb.tool import stop

HEIGHT = 0.3     # of the radius: how high the picture makes the bumps
TRAVEL = 0.15    # of the radius: how far it moves the node that moves most, at most
LINES = 240      # stations of a pad in a picture, about
ROWS = 40        # its rows, about
LONG = 2.5       # longest side over the shortest from which on the picture comes nearer: two bearings of a rotor
ELEVATION, AZIMUTH = 24.0, -58.0
BELOW = {"location": "bottom", "shrink": 0.6, "pad": 0.0}  # of a colour bar
VTK_QUAD = 9
APART = 1.7      # of a runner's radius: how far above it the picture puts a bearing on its other side
ROUND_OFF = 1.0e-9  # of z [m]
LIGHT = numpy.array((-0.22, 0.77, -0.60))  # whence it shines
SHADOW = 0.65    # brightness of what turns away from it


@dataclasses.dataclass
class Shaft:
    """What film and foils are rolled up on."""

    radius: float  # of the shaft, or of a runner [m]
    begins: tuple  # theta where the foils of each pad begin [rad]
    level: float   # height of the top foil at rest, which lies a clearance off the shaft [m]
    clearance: float
    runner: bool = False  # surfaces are sectors, which lie in space already


@dataclasses.dataclass
class Surface:
    """A film or foil as a grid file has it, unrolled."""

    name: str
    kind: str              # film, top_foil or bump_foil
    points: numpy.ndarray  # (points, 3) [m]
    cells: numpy.ndarray   # (cells, 4)
    rows: int
    fields: dict           # name: values
    units: dict            # name: unit

    def angle(self, shaft):
        """theta of the points [rad]."""
        return self.fields["theta"] if self.kind == "film" else of_pad(shaft.begins, pad_of(self.name)) + self.points[:, 0]/shaft.radius

    def rolled(self, shaft, height=1.0, travel=0.0):
        """Places of the points, moved by `travel` displacements, with heights off the shaft drawn larger [m]."""
        if shaft.runner:
            return self.points*[1.0, 1.0, height] + (0.0 if self.kind == "film" else travel*self.fields["displacement"]) \
                + [0.0, 0.0, APART*shaft.radius*self.is_opposite(shaft)]
        angle, off, z = self.angle(shaft), numpy.zeros(len(self.points)), self.points[:, 2]
        if self.kind != "film":
            moved = travel*self.fields["displacement"]
            angle, z = angle + moved[:, 0]/shaft.radius, z + moved[:, 2]
            off = height*(shaft.clearance + shaft.level - self.points[:, 1]) - moved[:, 1]
        far = shaft.radius + off
        return numpy.column_stack((far*numpy.cos(angle), far*numpy.sin(angle), z))

    def is_opposite(self, shaft):
        """Whether it is of a bearing on the runner's other side: the second film, and pads that are counted on."""
        return pad_of(self.name) > (1 if self.kind == "film" else len(shaft.begins))

    def away(self, shaft):
        """How far the points of a foil are away from shaft or runner, against where they rest [m]."""
        if not shaft.runner:
            return -self.fields["displacement"][:, 1]
        return (1.0 if self.is_opposite(shaft) else -1.0)*self.fields["displacement"][:, 2]

    def displacement(self, shaft):
        """Displacement vectors of the rolled points [m]."""
        if self.kind == "film":
            return numpy.zeros_like(self.points)
        angle, (u, v, w) = self.angle(shaft), self.fields["displacement"].T
        return numpy.column_stack((-u*numpy.sin(angle) - v*numpy.cos(angle), u*numpy.cos(angle) - v*numpy.sin(angle), w))

    def sheets(self):
        """Numbers of the points on (station, row), a sheet a pad."""
        number_of = numpy.arange(len(self.points)).reshape(-1, self.rows)
        if "pad" not in self.fields:
            return [number_of]
        pad = self.fields["pad"][number_of[:, 0]]
        return [number_of[pad == one] for one in numpy.unique(pad)]


def read_surface(name, file):
    """A surface of an open file without steps."""
    grid = file["VTKHDF"]
    points, cells = grid["Points"][...], grid["Connectivity"][...].reshape(-1, 4)
    rows = int(cells[0].max() - cells[0].min() - 1)  # a cell joins neighbours of two stations
    fields = {field: data[...] for field, data in grid["PointData"].items()}
    kind = name if name in ("film", "top_foil", "bump_foil") else name.rpartition("_")[0]
    needed = "theta" if kind == "film" else "displacement"
    if needed not in fields or len(points) % rows:
        stop(f"{file.filename}: not a film or foil of a bearing")
    return Surface(name, kind, points, cells, rows, fields, {field: attribute(data, "unit") for field, data in grid["PointData"].items()})


def paths_of(path):
    """{surface: its file} of a case, which any of its files names."""
    case = case_name(steps.alone(path))
    found = {one.name[len(case) + 1:].removesuffix(".vtkhdf"): one for one in path.parent.glob("*.vtkhdf")
             if one.name.startswith(case + ".")}
    order = ("film", "top_foil", "bump_foil")
    kept = {name: one for name, one in found.items() if name.startswith(order) and "." not in name}
    if not kept:
        stop(f"{path}: there is no {case}.film.vtkhdf and no {case}.top_foil.vtkhdf beside it")
    return case, dict(sorted(kept.items(), key=lambda item: [item[0].startswith(one) for one in order], reverse=True))


def read_shaft(case, surfaces):
    """The shaft, from CASE.h5."""
    with open_results(case) as file:
        keys = used_keys(file)
    radius, outer = number(keys, "bearing", "radius"), number(keys, "bearing", "outer_radius")
    if radius is None and outer is None:
        stop(f"{case}: not a bearing, there is nothing to roll up on")
    if radius is None:
        return Shaft(outer, leading_edges(keys), 0.0, 0.0, runner=True)
    heights = [surface.points[:, 1].max() for surface in surfaces if surface.kind != "film"]
    return Shaft(radius, leading_edges(keys), max(heights, default=0.0), number(keys, "bearing", "clearance") or 0.0)


def draw(path, grid=True):
    """The picture of a case; beside it CASE.3d.vtkhdf is written, where the grid is wanted and does not lie in space already."""
    case, paths = paths_of(path)
    surfaces = []
    for name, one in paths.items():
        with open_results(one) as file:
            surfaces.append(read_surface(name, file))
    beside = path.with_name(case + ".h5")
    if not beside.exists():
        stop(f"{beside}: there is no such file; it has the shaft's radius")
    shaft = read_shaft(beside, surfaces)
    if grid and not shaft.runner:
        written = path.with_name(case + ".3d.vtkhdf")
        write(written, paths, surfaces, shaft)
        print(f"for ParaView: {written}")
    return draw_surfaces(surfaces, shaft, scene_of(path.with_name(case + ".film.vtkhdf")), path.with_name(case + ".h5"))


# --- picture ---

def draw_surfaces(surfaces, shaft, scene, path):
    """The film on the shaft at the left, the foils at the right."""
    films = [one for one in surfaces if one.kind == "film" and "pressure" in one.fields]
    foils = [one for one in surfaces if one.kind != "film"]
    charts = [draw_film] * bool(films) + [draw_foils] * bool(foils)
    if not charts:
        stop(f"{path}: no pressure and no foil that could be drawn")
    figure, axes = pyplot.subplots(1, len(charts), figsize=(6.4*len(charts), 5.8), squeeze=False, layout="constrained",
                                   subplot_kw={"projection": "3d"})
    for chart, drawing in zip(axes.flat, charts):
        drawing(figure, chart, films if drawing is draw_film else foils, shaft, scene)
        chart.set_axis_off()
        chart.view_init(elev=ELEVATION + 20.0*shaft.runner, azim=AZIMUTH, vertical_axis="z" if shaft.runner else "y")
    figure.suptitle(scene.title(path), fontsize=11)
    return figure


def draw_film(figure, chart, films, shaft, scene):
    """Pressure on the shaft, and where the load presses it."""
    values = [1.0e-3*film.fields["pressure"] for film in films]
    every = numpy.concatenate(values)
    look = {"cmap": "viridis", "norm": colors.Normalize(every.min(), every.max())}
    places = [1.0e3*film.rolled(shaft) for film in films]
    paint(chart, [patches(*one) for one in zip(films, places, values)], look, shade=False)
    draw_bar(figure, chart, **look, **BELOW).set_label(f"{WORDS['pressure']} [kPa]", fontsize=9)
    words = "film on the sectors" + ", the runner's other side above"*any(film.is_opposite(shaft) for film in films) if shaft.runner else "film on the shaft"
    if scene.load_angle is not None:
        angle, z = math.radians(scene.load_angle), 0.0
        along = 1.0e3*shaft.radius*numpy.array((math.cos(angle), math.sin(angle), z))
        chart.quiver(*(-1.9*along), *(0.8*along), color="C3", linewidth=2.0, arrow_length_ratio=0.3)
        chart.quiver(*(1.1*along), *(0.8*along), color="C3", linewidth=2.0, arrow_length_ratio=0.3)
        words += ", arrows: direction of the load"
    chart.set_title(words, fontsize=10)
    equal_sides(chart, numpy.concatenate(places))


def drawn_larger(foils, shaft):
    """Places of the foils' points with heights and displacements drawn larger [m], how far these are away from shaft or runner [um],
    and how much larger heights and displacements are; heights of a plate are none: 1."""
    across = 2 if shaft.runner else 1
    height = numpy.ptp(numpy.concatenate([foil.points[:, across] for foil in foils])) + shaft.clearance
    taller = max(1.0, round_scale(HEIGHT*shaft.radius/height)) if height > 0.0 else 1.0
    largest = max(float(numpy.abs(foil.fields["displacement"]).max()) for foil in foils)
    travel = round_scale(TRAVEL*shaft.radius/largest) if largest > 0.0 else 1.0
    return [foil.rolled(shaft, taller, travel) for foil in foils], [1.0e6*foil.away(shaft) for foil in foils], taller, travel


def draw_foils(figure, chart, foils, shaft, _):
    """Foils coloured by how far they are away from where they rest."""
    found, away, taller, travel = drawn_larger(foils, shaft)
    places = [1.0e3*one for one in found]
    cut = 0 < sum(foil.kind == "bump_foil" for foil in foils) < len(foils) and not shaft.runner
    look = around_zero(min(one.min() for one in away), max(one.max() for one in away))
    paint(chart, [patches(*one, cut=cut and one[0].kind == "bump_foil") for one in zip(foils, places, away)], look, shade=True)
    draw_bar(figure, chart, **look, **BELOW).set_label(f"deflection away from the {'runner' if shaft.runner else 'shaft'} [um]", fontsize=9)
    chart.set_title(f"foils: displacements x {travel:g}" + (f", heights x {taller:g}" if taller > 1.0 else "")
                    + (", bumps in front cut away" if cut else ""), fontsize=10)
    equal_sides(chart, numpy.concatenate(places))


def patches(surface, places, values, cut=False):
    """Quadrilaterals of a surface, none of them across a gap between pads, and their values; cut: without its half at z > 0."""
    corners, means = [], []
    for sheet in surface.sheets():
        if cut:
            sheet = sheet[:, surface.points[sheet[0], 2] <= ROUND_OFF]
        rows, columns = (strided(many, most) for many, most in zip(sheet.shape, (LINES, ROWS)))
        sheet = sheet[numpy.ix_(rows, columns)]
        four = numpy.stack((sheet[:-1, :-1], sheet[1:, :-1], sheet[1:, 1:], sheet[:-1, 1:]), axis=-1).reshape(-1, 4)
        corners.append(places[four])
        means.append(values[four].mean(axis=1))
    return numpy.concatenate(corners), numpy.concatenate(means)


def strided(many, most):
    """Numbers from 0 to the last, no more than so many or some more."""
    return numpy.unique(numpy.append(numpy.arange(0, many, max(1, many//most)), many - 1))


def paint(chart, surfaces, look, shade):
    """All surfaces in colours of one scale, as one collection: what is nearer covers what is behind it."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # --help is answered without matplotlib
    corners, values = (numpy.concatenate(part) for part in zip(*surfaces))
    shades = pyplot.get_cmap(look["cmap"])(look["norm"](values))
    if shade:
        normal = numpy.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        normal /= numpy.maximum(numpy.linalg.norm(normal, axis=1, keepdims=True), 1.0e-300)
        shades[:, :3] *= (SHADOW + (1.0 - SHADOW)*numpy.abs(normal @ LIGHT))[:, None]
    chart.add_collection3d(Poly3DCollection(corners, facecolors=shades, linewidths=0.0, antialiaseds=False))


def equal_sides(chart, places):
    """One scale along all axes."""
    sides = numpy.ptp(places, axis=0)
    middle = places.min(axis=0) + 0.5*sides
    half = 0.5*sides.max()
    for axis, centre in zip("xyz", middle):
        getattr(chart, f"set_{axis}lim")(centre - half, centre + half)
    # With y upwards the order of the box's sides depends on matplotlib's version: that of a cube does not.
    chart.set_box_aspect((1.0, 1.0, 1.0), zoom=1.25 if sides.max() < LONG*sides.min() else 1.6)


# --- CASE.3d.vtkhdf ---

def write(path, paths, surfaces, shaft):
    """All surfaces as one grid, at rest and to scale, with displacements to warp it by; all steps where the case has some."""
    grid = {"points": numpy.concatenate([surface.rolled(shaft) for surface in surfaces])}
    first = numpy.cumsum([0, *(len(surface.points) for surface in surfaces)])
    grid["cells"] = numpy.concatenate([surface.cells + start for surface, start in zip(surfaces, first)])
    with contextlib.ExitStack() as opened:
        others = {name: steps.beside(one) for name, one in paths.items()}
        files = {name: opened.enter_context(open_results(one)) for name, one in others.items() if one}
        moves = len(files) < len(paths) or any(len(file["VTKHDF/NumberOfPoints"]) > 1 for file in files.values())
        every, values = [fields_of(surfaces, shaft)], None
        if files and not moves:
            one = next(iter(files.values()))
            every, values = [], one["VTKHDF/Steps/Values"][...]
            for step in range(steps.count(one)):
                every.append(fields_of([surface_at(name, file, step) for name, file in files.items()], shaft))
    with fresh(path) as place, h5py.File(place, "w") as file:
        fill(file.create_group("VTKHDF"), grid, every, values)


def surface_at(name, file, step):
    """A surface of an open file at a step."""
    one = steps.at_step(file, step)
    try:
        return read_surface(name, one)
    finally:
        one.close()


def fields_of(surfaces, shaft):
    """Fields of all surfaces together; nan where a surface has not got one."""
    kinds = {"film": 0.0, "top_foil": 1.0, "bump_foil": 2.0}
    fields = {"displacement": numpy.concatenate([surface.displacement(shaft) for surface in surfaces]),
              "surface": numpy.concatenate([numpy.full(len(surface.points), kinds[surface.kind]) for surface in surfaces])}
    for name in ("pressure", "gap", "deflection"):
        if not any(name in surface.fields or surface.kind != "film" and name == "deflection" for surface in surfaces):
            continue
        values = []
        for surface in surfaces:
            there = surface.fields.get(name, numpy.full(len(surface.points), numpy.nan))
            if name == "deflection" and surface.kind != "film":
                there = -surface.fields["displacement"][:, 1]
            values.append(there)
        fields[name] = numpy.concatenate(values)
    return fields


def fill(group, grid, every, values):
    """The grid and its fields, as VTKHDF 2.0 lays them down."""
    points, cells = grid["points"], grid["cells"]
    group.attrs["Version"] = numpy.array((2, 0), dtype="i8")
    group.attrs.create("Type", b"UnstructuredGrid", dtype=h5py.string_dtype("ascii", 16))
    group["NumberOfPoints"], group["NumberOfCells"] = numpy.array([len(points)]), numpy.array([len(cells)])
    group["NumberOfConnectivityIds"] = numpy.array([cells.size])
    group["Points"], group["Connectivity"] = points, cells.ravel().astype("i8")
    group["Offsets"] = numpy.arange(0, cells.size + 1, 4, dtype="i8")
    group["Types"] = numpy.full(len(cells), VTK_QUAD, dtype="u1")
    for name in every[0]:
        group[f"PointData/{name}"] = numpy.concatenate([fields[name] for fields in every])
    if values is None:
        return
    many = len(every)
    places = group.create_group("Steps")
    places.attrs["NSteps"] = many
    places["Values"] = values
    for name, shape in (("PartOffsets", many), ("PointOffsets", many), ("CellOffsets", (many, 1)), ("ConnectivityIdOffsets", (many, 1))):
        places[name] = numpy.zeros(shape, dtype="i8")
    places["NumberOfParts"] = numpy.ones(many, dtype="i8")
    for name in every[0]:
        places[f"PointDataOffsets/{name}"] = len(points)*numpy.arange(many, dtype="i8")
