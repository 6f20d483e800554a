"""Film and foils rolled up on the shaft: a picture with heights and displacements drawn larger, and CASE.3d.vtkhdf for ParaView."""

import contextlib
import dataclasses
import math
import os

import h5py
import numpy
from matplotlib import colors, pyplot

from gfb import steps
from gfb.plot.film import WORDS
from gfb.plot.foil import round_scale
from gfb.plot.scene import case_name, number, round_numbers, scene_of
from gfb.plot.strip import used_keys
from gfb.results import attribute, open_results
from gfb.tool import stop

HEIGHT = 0.3     # of the radius: how high the picture makes the bumps
TRAVEL = 0.15    # of the radius: how far it moves the node that moves most, at most
LINES = 240      # stations of a picture, about
LONG = 2.5       # longest side over the shortest from which on the picture comes nearer: two bearings of a rotor
ELEVATION, AZIMUTH = 24.0, -58.0
VTK_QUAD = 9
ROUND_OFF = 1.0e-9  # of z [m]
LIGHT = colors.LightSource(azdeg=200.0, altdeg=50.0)


@dataclasses.dataclass
class Shaft:
    """What film and foils are rolled up on."""

    radius: float  # of the shaft [m]
    begin: float   # theta where foils begin [rad]
    level: float   # height of the top foil at rest, which lies a clearance off the shaft [m]
    clearance: float


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
        return self.fields["theta"] if self.kind == "film" else shaft.begin + self.points[:, 0]/shaft.radius

    def rolled(self, shaft, height=1.0, travel=0.0):
        """Places of the points, moved by `travel` displacements, with heights off the shaft drawn larger [m]."""
        angle, off, z = self.angle(shaft), numpy.zeros(len(self.points)), self.points[:, 2]
        if self.kind != "film":
            moved = travel*self.fields["displacement"]
            angle, z = angle + moved[:, 0]/shaft.radius, z + moved[:, 2]
            off = height*(shaft.clearance + shaft.level - self.points[:, 1]) - moved[:, 1]
        far = shaft.radius + off
        return numpy.column_stack((far*numpy.cos(angle), far*numpy.sin(angle), z))

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
    radius = number(keys, "bearing", "radius")
    if radius is None:
        stop(f"{case}: not a bearing, there is nothing to roll up on")
    heights = [surface.points[:, 1].max() for surface in surfaces if surface.kind != "film"]
    return Shaft(radius, math.radians(number(keys, "bearing", "leading_edge_angle") or 0.0), max(heights, default=0.0),
                 number(keys, "bearing", "clearance") or 0.0)


def draw(path, grid=True):
    """The picture of a case; beside it CASE.3d.vtkhdf is written, where the grid is wanted."""
    case, paths = paths_of(path)
    surfaces = []
    for name, one in paths.items():
        with open_results(one) as file:
            surfaces.append(read_surface(name, file))
    beside = path.with_name(case + ".h5")
    if not beside.exists():
        stop(f"{beside}: there is no such file; it has the shaft's radius")
    shaft = read_shaft(beside, surfaces)
    if grid:
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
        chart.view_init(elev=ELEVATION, azim=AZIMUTH, vertical_axis="y")
    figure.suptitle(scene.title(path), fontsize=11)
    return figure


def draw_film(figure, chart, films, shaft, scene):
    """Pressure on the shaft, and where the load presses it."""
    values = numpy.concatenate([film.fields["pressure"] for film in films])*1.0e-3
    norm = colors.Normalize(values.min(), values.max())
    for film in films:
        paint(chart, film, film.rolled(shaft), film.fields["pressure"]*1.0e-3, norm, "viridis")
    bar(figure, chart, norm, "viridis", f"{WORDS['pressure']} [kPa]")
    words = "film on the shaft"
    if scene.load_angle is not None:
        angle, z = math.radians(scene.load_angle), 0.0
        along = 1.0e3*shaft.radius*numpy.array((math.cos(angle), math.sin(angle), z))
        chart.quiver(*(-1.9*along), *(0.8*along), color="C3", linewidth=2.0, arrow_length_ratio=0.3)
        chart.quiver(*(1.1*along), *(0.8*along), color="C3", linewidth=2.0, arrow_length_ratio=0.3)
        words += ", arrows: direction of the load"
    chart.set_title(words, fontsize=10)
    equal_sides(chart, numpy.concatenate([1.0e3*film.rolled(shaft) for film in films]))


def draw_foils(figure, chart, foils, shaft, _):
    """Foils coloured by how far they are away from where they rest."""
    height = max(numpy.ptp(numpy.concatenate([foil.points[:, 1] for foil in foils])) + shaft.clearance, 1.0e-9)
    taller = max(1.0, round_scale(HEIGHT*shaft.radius/height))
    away = {foil.name: -foil.fields["displacement"][:, 1]*1.0e6 for foil in foils}
    largest = max(float(numpy.abs(foil.fields["displacement"]).max()) for foil in foils)
    travel = round_scale(TRAVEL*shaft.radius/largest) if largest > 0.0 else 1.0
    bumps = [foil for foil in foils if foil.kind == "bump_foil"]
    # A free edge that lifts far towards the shaft would leave the rest without colour.
    far = max([float(numpy.abs(away[foil.name]).max()) for foil in bumps] + [float(one.max()) for one in away.values()] + [1.0e-12])
    norm = colors.Normalize(-far, far, clip=True)
    places = [foil.rolled(shaft, taller, travel) for foil in foils]
    for foil, place in zip(foils, places):
        paint(chart, foil, place, away[foil.name], norm, "RdBu_r", cut=foil.kind == "bump_foil" and len(bumps) < len(foils))
    beyond = any(numpy.abs(one).max() > far for one in away.values())
    bar(figure, chart, norm, "RdBu_r", "deflection away from the shaft [um]", "both" if beyond else "neither")
    cut = ", bumps in front cut away" if 0 < len(bumps) < len(foils) else ""
    chart.set_title(f"foils: displacements x {travel:g}, heights off the shaft x {taller:g}{cut}", fontsize=10)
    equal_sides(chart, 1.0e3*numpy.concatenate(places))


def paint(chart, surface, places, values, norm, colour, cut=False):
    """A surface in colours; cut: without its half at z > 0."""
    for sheet in surface.sheets():
        if cut:
            sheet = sheet[:, surface.points[sheet[0], 2] <= ROUND_OFF]
        x, y, z = (1.0e3*places[sheet, axis] for axis in range(3))
        inside = values[sheet]
        inside = 0.25*(inside[1:, 1:] + inside[:-1, 1:] + inside[1:, :-1] + inside[:-1, :-1])
        stride = max(1, len(sheet)//LINES)
        chart.plot_surface(x, y, z, facecolors=pyplot.get_cmap(colour)(norm(inside)), rstride=stride,
                           cstride=max(1, sheet.shape[1]//40), linewidth=0.0, antialiased=False, shade=surface.kind != "film",
                           lightsource=LIGHT)


def bar(figure, chart, norm, colour, words, extend="neither"):
    """A colour bar below a chart."""
    figure.colorbar(pyplot.cm.ScalarMappable(norm, colour), ax=chart, location="bottom", shrink=0.6, pad=0.0,
                    ticks=round_numbers(6), extend=extend).set_label(words, fontsize=9)


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
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with h5py.File(temporary, "w") as file:
            fill(file.create_group("VTKHDF"), grid, every, values)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


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
