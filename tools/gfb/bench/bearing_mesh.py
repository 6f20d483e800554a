"""Mesh convergence of the [Gu2020] bearing on shells, each direction by itself.

100 N at 30,000 rpm, foils fixed at the trailing edge, default contact keys. Each series refines one direction by
twos and keeps the others: elements a pitch of film and top foil (which share their nodes, so film and sag are refined
together), elements of the bumps, elements over the width; the last one refines all together. Where the changes of a
quantity shrink without changing their sign, Richardson's extrapolation from the last two meshes, with the order
observed but at most 2, gives the error of the series' default mesh; elsewhere the largest change beyond the default
mesh bounds it.
"""

import dataclasses
import math
import pathlib
import tempfile

import numpy

from gfb.results import open_results, reading
from gfb.running import run_case

RADIUS, CLEARANCE, PRESSURE = 19.05e-3, 31.8e-6, 1.0135e5
PITCH, BUMPS = 4.572e-3, 26
SHEET = {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "fixed_edge": "trailing"}
CASE = {
    "scene": {"analysis": "equilibrium"},
    "bearing": {"radius": RADIUS, "length": 38.1e-3, "clearance": CLEARANCE},
    "gas": {"viscosity": 1.95e-5, "ambient_pressure": PRESSURE},
    "operation": {"speed_rpm": 30000.0, "load": (-100.0, 0.0)},
    "top_foil": SHEET,
    "bump_foil": {**SHEET, "half_length": 1.778e-3, "height": 0.508e-3, "pitch": PITCH, "bumps": BUMPS,
                  "fixed_line": "half_flat"},
    "contact": {"friction_top": 0.1, "friction_sleeve": 0.1},
    "model": {"foil": "shell", "film_scheme": "galerkin"},
}

# Elements a pitch, of an arc, over the width; a flat has a quarter of an arc's. The default mesh is (8, 12, 32).
DEFAULT = (8, 12, 32)
SERIES = {  # words: meshes, and the place in them of the default's value
    "film and top foil, elements a pitch": ([(4, 12, 16), (8, 12, 16), (16, 12, 16), (32, 12, 16)], 1),
    "bumps, elements of an arc + a flat": ([(8, 12, 16), (8, 24, 16), (8, 48, 16), (8, 96, 16)], 0),
    "elements over the width": ([(8, 12, 8), (8, 12, 16), (8, 12, 32), (8, 12, 64)], 2),
}
BASE = (8, 12, 16)  # in every series
TOGETHER = [(4, 12, 8), (8, 24, 16), (16, 48, 32)]
HIGHEST_ORDER = 2.0  # of linear elements
LOWEST_ORDER = 0.5   # slower sequences are not extrapolated
# Quantities: name, digits, unit of the errors.
QUANTITIES = (("e_x/C", 5), ("e_y/C", 5), ("film, midplane [um]", 3), ("film, edges [um]", 3), ("largest p/p_a", 4),
              ("sag [um]", 3))


@dataclasses.dataclass
class Estimate:
    """What a sequence of values says of the default mesh's error."""

    order: float | None  # observed with the last three meshes, None where there is none
    limit: float | None  # extrapolated
    error: float         # of the default mesh: its value less the limit, or a bound of its size
    bound: bool          # the error is a bound


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--quick", action="store_true", help="without the finest mesh of each series (half a minute)")


def run(options):
    """Computes all meshes; returns the table and leaves it in Markdown and the picture."""
    series = {words: (meshes[:-1] if options.quick else meshes, place)
              for words, (meshes, place) in SERIES.items()}
    together = TOGETHER[:-1] if options.quick else TOGETHER
    found, cost = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        for mesh in dict.fromkeys([DEFAULT, *(one for meshes, _ in series.values() for one in meshes), *together]):
            found[mesh], cost[mesh] = measure(options.gfb, mesh, folder)
    estimates = {words: [estimate([found[mesh][i] for mesh in meshes], place) for i in range(len(QUANTITIES))]
                 for words, (meshes, place) in series.items()}
    tables = [(words, value_table(meshes, found, cost, estimates[words])) for words, (meshes, _) in series.items()]
    tables.append(("all together", [*value_table(together, found, cost, None), added_row(together[-1], found)]))
    tables.append(("the default mesh", error_table(found, estimates)))
    draw(series, found, estimates, options.output/"bearing-mesh.png")
    (options.output/"bearing-mesh.md").write_text(
        "\n".join(f"{words}\n\n{markdown(table)}" for words, table in tables), encoding="utf-8")
    return ("shell bearing of [Gu2020], 100 N at 30,000 rpm, trailing edges fixed, one rank\n"
            "mesh: elements a pitch, of an arc + a flat, over the width; default: "
            f"{mesh_words(DEFAULT)}\n" + "".join(f"\n{words}\n{plain(table)}" for words, table in tables))


# --- one mesh ---

def measure(gfb, mesh, folder):
    """Quantities of a mesh, and CPU time [s]."""
    pitch, arc, axial = mesh
    groups = {**CASE, "mesh": {"circumferential_elements": BUMPS*pitch, "axial_elements": axial, "arc_elements": arc,
                               "flat_elements": arc//4}}
    done = run_case(gfb, groups, folder, "mesh")
    summary = done.summary
    values = (summary["eccentricity_x"]/CLEARANCE, summary["eccentricity_y"]/CLEARANCE,
              1.0e6*summary["minimum_gap_midplane"], 1.0e6*summary["minimum_gap_edge"],
              summary["maximum_pressure"]/PRESSURE, 1.0e6*largest_sag(pathlib.Path(folder)/"mesh.film.vtkhdf"))
    return values, done.cpu


def largest_sag(path):
    """Largest sag at the midplane between crests that are pressed down [m].

    A sag is the deflection between two crests less the mean at these.
    """
    with reading(path), open_results(path) as file:
        points = file["VTKHDF/Points"][...]
        deflection = file["VTKHDF/PointData/deflection"][...]
    middle = numpy.abs(points[:, 2]) <= 1.0e-9*RADIUS
    x, way = points[middle, 0], deflection[middle]
    crests = 2.0*math.pi*RADIUS - PITCH*(numpy.arange(BUMPS, 0, -1) - 0.5)
    at_crests = numpy.interp(crests, x, way)
    spans = zip(crests, crests[1:], at_crests, at_crests[1:])
    return max(way[(x >= first) & (x <= last)].max() - 0.5*(one + other)
               for first, last, one, other in spans if min(one, other) > 0.0)


# --- errors ---

def estimate(values, place):
    """Order, limit, and error of the value at a place; sizes halve from value to value."""
    change, before = values[-1] - values[-2], values[-2] - values[-3]
    order = math.log2(before/change) if before*change > 0.0 else None
    if order is not None and order >= LOWEST_ORDER:
        limit = values[-1] + change/(2.0**min(order, HIGHEST_ORDER) - 1.0)
        return Estimate(order, limit, values[place] - limit, False)
    beyond = [abs(value - values[place]) for value in values[place + 1:]]
    return Estimate(order, None, max([*beyond, abs(change)]), True)


# --- tables and picture ---

def mesh_words(mesh):
    """A mesh in words."""
    pitch, arc, axial = mesh
    return f"{pitch}, {arc} + {arc//4}, {axial}"


def value_table(meshes, found, cost, estimates):
    """Values of a series, with orders and limits where it has them."""
    rows = [["mesh", *(name for name, _ in QUANTITIES), "CPU [s]"]]
    for mesh in meshes:
        rows.append([mesh_words(mesh), *(f"{value:.{digits}f}" for value, (_, digits) in zip(found[mesh], QUANTITIES)),
                     f"{cost[mesh]:.1f}"])
    if estimates:
        rows.append(["observed order", *("-" if one.order is None else f"{one.order:.1f}" for one in estimates), ""])
        rows.append(["limit", *("not monotone" if one.limit is None else f"{one.limit:.{digits}f}"
                                for one, (_, digits) in zip(estimates, QUANTITIES)), ""])
    return rows


def added_row(mesh, found):
    """What the series give for a mesh when the changes of its three directions are added."""
    alone = [tuple(mesh[k] if k == direction else BASE[k] for k in range(3)) for direction in range(3)]
    values = [sum(found[one][i] for one in alone) - 2.0*found[BASE][i] for i in range(len(QUANTITIES))]
    return ["the last one, by adding", *(f"{value:.{digits}f}" for value, (_, digits) in zip(values, QUANTITIES)), ""]


def error_table(found, estimates):
    """Errors of the default mesh by direction, their sum, and the value without them."""
    rows = [["error in", *(name for name, _ in QUANTITIES)]]
    for words, several in estimates.items():
        rows.append([words, *(error_words(one, digits) for one, (_, digits) in zip(several, QUANTITIES))])
    signed = [sum(several[i].error for several in estimates.values() if not several[i].bound)
              for i in range(len(QUANTITIES))]
    bounds = [sum(several[i].error for several in estimates.values() if several[i].bound)
              for i in range(len(QUANTITIES))]
    rows.append(["sum", *(f"{value:+.{digits}f}" + (f" +-{bound:.{digits}f}" if bound > 0.0 else "")
                          for value, bound, (_, digits) in zip(signed, bounds, QUANTITIES))])
    rows.append(["default mesh", *(f"{value:.{digits}f}" for value, (_, digits) in zip(found[DEFAULT], QUANTITIES))])
    rows.append(["less the sum", *(f"{value - off:.{digits}f}"
                                   for value, off, (_, digits) in zip(found[DEFAULT], signed, QUANTITIES))])
    return rows


def error_words(one, digits):
    """An error or its bound."""
    return f"+-{one.error:.{digits}f}" if one.bound else f"{one.error:+.{digits}f}"


def plain(rows):
    """A table in columns."""
    wide = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "".join("  " + row[0].ljust(wide[0]) + "".join("  " + cell.rjust(width) for cell, width in
                                                          zip(row[1:], wide[1:])).rstrip() + "\n" for row in rows)


def markdown(rows):
    """A table in Markdown."""
    lines = [f"| {' | '.join(row)} |" for row in rows]
    lines.insert(1, f"| --- |{' ---: |'*(len(rows[0]) - 1)}")
    return "\n".join(lines) + "\n"


def draw(series, found, estimates, path):
    """Distance from the limit, or from the finest mesh, against the size of an element."""
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, len(series), figsize=(12.0, 4.4), layout="constrained", sharey=True)
    for axis, (words, (meshes, place)) in zip(axes, series.items()):
        size = 2.0**(place - numpy.arange(len(meshes)))
        for i, (name, _) in enumerate(QUANTITIES):
            values = numpy.array([found[mesh][i] for mesh in meshes])
            limit = estimates[words][i].limit
            style = "o-" if limit is not None else "x:"
            off = numpy.abs(values - (values[-1] if limit is None else limit))/abs(values[-1])
            axis.loglog(size[off > 0.0], off[off > 0.0], style, color=f"C{i}", markersize=4, label=name)
        axis.loglog(size, 1.0e-3*size**2, "k-", linewidth=0.7)
        axis.annotate("order 2", (size[0], 1.0e-3*size[0]**2), xytext=(-40, -12), textcoords="offset points",
                      fontsize=8)
        axis.axvline(1.0, color="grey", linewidth=0.7)
        axis.set_xticks(size, [f"{one:g}" for one in size])
        axis.minorticks_off()
        axis.set(xlabel="size of an element, over the default mesh's", title=words)
        axis.grid(which="both", alpha=0.3)
    axes[0].set_ylabel("distance from the limit, relative\n(x: not monotone, from the finest mesh)")
    axes[1].legend(fontsize=8)
    figure.savefig(path, dpi=110)
