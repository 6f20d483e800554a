"""Pictures of results that can be turned and read off, as figures of Plotly: films, foils, and values along points or time."""

import contextlib
import html
import math
import pathlib

import matplotlib
import numpy
from matplotlib import colors

from gfb.files import kept_within
from gfb.look import FONT
from gfb.plot.colours import LINES, look_of, round_ticks
from gfb.plot.foil import is_foil, names, round_scale, shape_of
from gfb.plot.ring import TRAVEL
from gfb.plot.rolled import drawn_larger, paths_of, read_shaft, read_surface
from gfb.plot.scene import scene_of
from gfb.reading import surface
from gfb.report.main import read_run
from gfb.results import attribute, open_results, reading
from gfb.tables import readable

MOST = 240     # stations, or rows, of a drawn surface
POINTS = 5000  # of a curve
LOOK = {"margin": {"l": 0, "r": 0, "t": 10, "b": 0}, "font": {"size": 12, "family": FONT}, "colorway": LINES, "modebar": {"bgcolor": "white", "color": "#aaa"}}
EYE = {"x": 1.35, "y": -1.75, "z": 1.05}  # from where a surface is seen, its sides being about 1
MODES = {"responsive": True, "displaylogo": False}
POINTS_PICTURE, FOILS, POINT = "points", "foils", "number of the point or step"


def read_result(folder, name):
    """A result of a folder, as the page of tools/report has it, and its pictures; none of its files is a link, or lies elsewhere."""
    stem = folder.inside(name)
    with kept_within(folder.path):
        run = read_run(stem, None, pictures=False)
        return run | {"stem": stem, "name": name, "pictures": pictures(stem), "columns": columns_of(stem)}


def draw_result(folder, stem, name):
    """A picture of it, from such files; None where it cannot be drawn."""
    with kept_within(folder.path):
        return draw(stem, name)


def pictures(stem):
    """Names of the pictures that there are of a result."""
    found = []
    film = pathlib.Path(f"{stem}.film.vtkhdf")
    if film.exists():
        with reading(film), open_results(film) as file:
            fields = file["VTKHDF/PointData"]
            found += [f"film: {name}" for name in fields if name not in ("theta", "pad") and numpy.ndim(fields[name]) == 1]
    for path in foils_of(stem):
        with reading(path), open_results(path) as file:
            for name in names(file):
                found.append(FOILS if name == "displacement" else f"{part_of(path)}: {name}")
    if any(len(column) > 1 for column in columns_of(stem)[0].values()):
        found.append(POINTS_PICTURE)
    return list(dict.fromkeys(found))


def foils_of(stem):
    """Files of foils of a result."""
    stem = pathlib.Path(stem)
    beside = [*stem.parent.glob(f"{glob_escaped(stem.name)}.top_foil*.vtkhdf"), *stem.parent.glob(f"{glob_escaped(stem.name)}.bump_foil*.vtkhdf")]
    return sorted((path for path in beside if not path.name.endswith(".steps.vtkhdf")), reverse=True)


def glob_escaped(name):
    """A name that `glob` takes for itself."""
    return "".join(f"[{letter}]" if letter in "*?[" else letter for letter in name)


def part_of(path):
    """Which foil a file is of."""
    return path.name.removesuffix(".vtkhdf").rpartition(".")[2]


def draw(stem, name):
    """A picture; None where it cannot be drawn of this result."""
    with contextlib.suppress(SystemExit):  # with which tools/plot ends where it has nothing to draw
        kind, _, field = name.partition(": ")
        if kind == "film":
            return film(stem, field)
        return foils(stem) if name == FOILS else strip(stem, kind, field)
    return None


def named(name, unit):
    """A name with its unit."""
    return f"{name.replace('_', ' ')} [{unit}]" if unit not in ("", "1") else name.replace("_", " ")


def sheet(x, y, z, colour, words, **looks):
    """A surface of stations and rows, with fewer of them where there are many."""
    every = tuple(slice(None, None, max(1, -(-side//MOST))) for side in numpy.shape(z))
    x, y, z, colour = (numpy.ascontiguousarray(one[every], dtype="float32") for one in (x, y, z, colour))
    return {"type": "surface", "x": x, "y": y, "z": z, "surfacecolor": colour, "hovertemplate": looks.pop("hover", None),
            "colorbar": {"title": {"text": words, "side": "top"}, "orientation": "h", "thickness": 10, "len": 0.8, "y": 0.0, "yanchor": "top"}, **looks}


def space(data, x, y, z, sides=None, near=1.0, above=""):
    """A figure in space; near: how far from it the eye is, 1 leaves room for words at the axes; above: words about it."""
    shape = {"aspectmode": "manual", "aspectratio": dict(zip("xyz", sides))} if sides else {"aspectmode": "data"}
    axes = {f"{axis}axis": {"title": {"text": words}, "visible": bool(words), "nticks": 6} for axis, words in zip("xyz", (x, y, z))}
    return {"data": data, "layout": {**LOOK, "scene": {**axes, **shape, "domain": {"y": [0.12, 1.0]}, "camera": {"eye": {axis: near*one for axis, one in EYE.items()}}}}, "config": MODES, "above": above}


# --- films ---

def film(stem, name):
    """A field of the film: over angle and width of a journal, over the sectors of a thrust bearing."""
    path = pathlib.Path(f"{stem}.film.vtkhdf")
    with reading(path), open_results(path) as file:
        found = surface(file["VTKHDF"])
        if name not in found:
            return None
        values, unit = readable(found[name].values, found[name].attrs["units"])
        words = named(name, unit)
        ring = "radius" in found.coords
        theta = found["theta"].values
        pads = found["pad"].values[:, 0] if "pad" in found else numpy.zeros(len(theta))
    across = 1.0e3*found["radius" if ring else "z"].values
    data: list[dict[str, object]] = []
    for pad in numpy.unique(pads):
        own = pads == pad
        for place, height in [(theta[own], values[own])] if ring else within_a_turn(theta[own], values[own]):
            angle, side = numpy.meshgrid(place, across, indexing="ij")
            if ring:
                x, y, hover = side*numpy.cos(angle), side*numpy.sin(angle), f"x %{{x:.4g}} mm, y %{{y:.4g}} mm<br>%{{z:.5g}} {unit}<extra></extra>"
            else:
                x, y, hover = numpy.degrees(angle), side, f"theta %{{x:.4g}} deg, z %{{y:.4g}} mm<br>%{{z:.5g}} {unit}<extra></extra>"
            data.append(sheet(x, y, height, height, words, hover=hover, showscale=not data))
    figure = space(data, "x [mm]" if ring else "theta [deg]", "y [mm]" if ring else "z [mm]", words, (1.2, 1.2, 0.6) if ring else (1.6, 1.0, 0.7), near=1.2)
    if not ring:
        figure["layout"]["scene"]["xaxis"] |= {"range": [0.0, 360.0], "dtick": 90.0}
    return figure | {"field": name}


def within_a_turn(theta, values):
    """Stations of a pad and their values, theta from 0 to 360 degrees; in two where the pad goes over that."""
    turn = 2.0*numpy.pi
    begin = theta - turn*numpy.floor((theta.min() + 1.0e-9)/turn)
    over = int(numpy.searchsorted(begin, turn*(1.0 + 1.0e-9)))
    if over == len(begin):
        return [(begin, values)]
    before = max(over - 1, 0)
    part = (turn - begin[before])/(begin[over] - begin[before])
    middle = ((1.0 - part)*values[before] + part*values[over])[None]
    return [(numpy.append(begin[:over], turn), numpy.concatenate((values[:over], middle))),
            (numpy.append(turn, begin[over:]) - turn, numpy.concatenate((middle, values[over:])))]


def same_colours(figures):
    """One range of colours for what stands side by side; films have the scale that tools/plot has: that of a gap is logarithmic."""
    films = [one for one in figures if "field" in one]
    sheets = [one for figure in films for one in figure["data"]]
    if sheets:
        low, high = min(float(one["z"].min()) for one in sheets), max(float(one["z"].max()) for one in sheets)
        look = look_of(films[0]["field"], low, high)
        ticks = round_ticks(look["norm"])
        for one in sheets:
            one |= {"surfacecolor": numpy.ascontiguousarray(look["norm"](one["z"]), dtype="float32"), "cmin": 0.0, "cmax": 1.0, "colorscale": scale_of(look["cmap"])}
            one["colorbar"] |= {"tickmode": "array", "tickvals": [float(look["norm"](tick)) for tick in ticks], "ticktext": [f"{tick:g}" for tick in ticks]}
        is_log = isinstance(look["norm"], colors.LogNorm)
        for figure in films:
            figure["layout"]["scene"]["zaxis"] |= {"range": [math.log10(low), math.log10(high)] if is_log else [low, high]}
            if is_log:
                figure["layout"]["scene"]["zaxis"] |= {"type": "log", "tickmode": "array", "tickvals": ticks, "ticktext": [f"{tick:g}" for tick in ticks]}
    others = [one for figure in figures if "field" not in figure for one in figure["data"]]
    for one in others:
        one |= {"cmin": min(one["cmin"] for one in others), "cmax": max(one["cmax"] for one in others)}


def scale_of(name):
    """A map of colours of tools/plot, as Plotly has them."""
    return [[i/32.0, colors.to_hex(matplotlib.colormaps[name](i/32.0))] for i in range(33)]


# --- foils ---

def foils(stem):
    """All foils: of a journal around the shaft, others as they lie."""
    paths = foils_of(stem)
    if any(not is_journal(path) for path in paths):
        return lying(paths, "displacement")
    case = pathlib.Path(f"{stem}.h5")
    surfaces = []
    for name, path in paths_of(case)[1].items():
        with reading(path), open_results(path) as file:
            surfaces.append(read_surface(name, file))
    found = [one for one in surfaces if one.kind != "film"]
    places, away, taller, travel = drawn_larger(found, read_shaft(case, surfaces))
    far = max(float(one.max()) for one in away) or 1.0  # a free edge that lifts far would leave the rest without colour
    data: list[dict[str, object]] = []
    for foil, place, off in zip(found, places, away):
        for numbers in foil.sheets():
            x, y, z = (1.0e3*place[numbers, axis] for axis in (2, 0, 1))
            data.append(sheet(x, y, z, off[numbers], "away from the shaft [um]", colorscale=scale_of("RdBu_r"), cmin=-far,
                              cmax=far, showscale=not data, hover=f"{foil.name.replace('_', ' ')}<br>%{{surfacecolor:.4g}} um<extra></extra>"))
    return space(data, "", "", "", near=0.9, above=f"displacements x {travel:g}, heights off the shaft x {taller:g}")


def is_journal(path):
    """Whether a foil's file is of a journal bearing: there is its film, and the foil is unrolled."""
    film_path = path.with_name(path.name[:-len(f"{part_of(path)}.vtkhdf")] + "film.vtkhdf")
    if not film_path.exists():
        return False
    with reading(film_path), open_results(film_path) as file:
        return "radius" not in surface(file["VTKHDF"]).coords


def strip(stem, part, field):
    """A field of one foil."""
    return lying([path for path in foils_of(stem) if part_of(path) == part], field)


def lying(paths, field):
    """Foils as they lie, moved further than they move."""
    shapes = []
    for path in paths:
        with reading(path), open_results(path) as file:
            if is_foil(file) and field in file["VTKHDF/PointData"]:
                shape = shape_of(path, file)
                shapes.append((part_of(path), file["VTKHDF/Points"][...].reshape(shape), file[f"VTKHDF/PointData/{field}"][...].reshape(shape)))
    if not shapes:
        return None
    largest = max(float(numpy.abs(moved).max()) for _, _, moved in shapes)
    side = max(float(numpy.ptp(points, axis=(0, 1)).max()) for _, points, _ in shapes)
    scale = round_scale(TRAVEL*side/largest) if largest > 0.0 else 1.0
    is_mode = field != "displacement"
    words = field.replace("_", " ") if is_mode else "displacement [um]"
    data: list[dict[str, object]] = []
    for part, points, moved in shapes:
        x, y, z = (1.0e3*(points + scale*moved)[:, :, axis] for axis in (0, 2, 1))
        if numpy.ptp(points[:, :, 1]) > numpy.ptp(points[:, :, 2]):  # a sector lies across the axis
            y, z = z, y
        size = numpy.sqrt((moved**2).sum(axis=2))*(1.0 if is_mode else 1.0e6)
        data.append(sheet(x, y, z, size, words, colorscale="Viridis", showscale=not data, cmin=0.0, cmax=max(largest*(1.0 if is_mode else 1.0e6), 1e-12),
                          hover=f"{part.replace('_', ' ')}<br>%{{surfacecolor:.4g}}<extra></extra>"))
    hertz = scene_of(paths[0]).frequencies.get(field)
    words = f"{hertz:.5g} Hz" if hertz else "" if is_mode else f"displacements x {scale:g}"
    return space(data, "x [mm]", "", "", above=words)


# --- points ---

def columns_of(stem):
    """{column: values} and {column: unit} of points or load steps, of a shaft over time of that."""
    path = f"{stem}.h5"
    with reading(path), open_results(path) as file:
        group = file["transient"] if "transient" in file else file["history"]
        found = {name: data for name, data in group.items() if data.ndim == 1}
        most = max((len(data) for data in found.values()), default=0)
        found = {name: data for name, data in found.items() if len(data) == most}
        values = {POINT: numpy.arange(1.0, most + 1.0)} | {name: data[...] for name, data in found.items()}
        return values, {name: attribute(data, "unit") for name, data in found.items()}


def along_of(columns, used):
    """The column along which a result goes: time, what its sweep changes, or the number of the point."""
    sweep = used.groups.get("sweep", {}).get("parameter", "")
    return next((name for name in ("time", str(sweep), str(sweep).replace("%", "_")) if name in columns), POINT)


def curves(runs, x, y):
    """A column of the history over another, of several results; runs: (name, {column: values}, {column: unit})."""
    data: list[dict[str, object]] = []
    units: dict[str, str] = {}
    for name, columns, own in runs:
        if x in columns and y in columns:
            units |= own
            every = slice(None, None, max(1, -(-len(columns[x])//POINTS)))
            across, up = (readable(columns[one][every], own.get(one, ""))[0] for one in (x, y))
            data.append({"type": "scatter", "mode": "lines+markers" if len(across) < 100 else "lines", "name": html.escape(name),
                         "x": numpy.ascontiguousarray(across, dtype="float64"), "y": numpy.ascontiguousarray(up, dtype="float64")})
    words = [named(one, readable(0.0, units.get(one, ""))[1]) for one in (x, y)]
    return {"data": data, "config": MODES,
            "layout": {**LOOK, "margin": {"l": 60, "r": 10, "t": 10, "b": 45}, "height": 380, "showlegend": len(data) > 1,
                       "legend": {"orientation": "h", "y": 1.12}, "xaxis": {"title": {"text": words[0]}}, "yaxis": {"title": {"text": words[1]}}}}
