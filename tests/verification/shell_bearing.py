#!/usr/bin/env python3
"""The bearing of shells: independent numbers, balance, what must not change it, limits, mesh convergence."""

import dataclasses
import pathlib
import tempfile

import h5py
import numpy

import gfb_run
from gfb_run import Bearing, Checks, largest_difference, natural_sizes, observed_order, summary_difference
from symmetry import POWERS

# [Gu2020]: 100 N, 30,000 rpm.
BEARING = Bearing(radius=19.05e-3, length=38.1e-3, clearance=31.8e-6, viscosity=1.95e-5, ambient_pressure=1.0135e5)
LOAD = (-100.0, 0.0)
SPEED = 30000.0
SHEET = {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29}
BUMPS = {"half_length": 1.778e-3, "height": 0.508e-3, "pitch": 4.572e-3, "bumps": 26, "fixed_edge": "trailing",
         "fixed_line": "half_flat"}
MICROMETRE = 1.0e-6

# Independent shell model: contact of 5e10 N/m^2, stick length 0.1 um, friction 0.1 at both sides, paper's mesh.
PAPER_MESH = {"circumferential_elements": 104, "axial_elements": 30, "arc_elements": 12, "flat_elements": 3,
              "align_crests": False}
REFERENCE = {"trailing": {"eccentricity": (0.9108, 0.2622), "midplane": 6.98, "edge": 6.37, "pressure": 2.499},
             "leading": {"eccentricity": (0.9174, 0.2578), "midplane": 6.90, "edge": 6.28, "pressure": 2.524,
                         "lift": (42.4, 49.7)}}

# What friction does needs no fine mesh across the width.
COARSE = {**PAPER_MESH, "axial_elements": 8}

ALIGNED = {"circumferential_elements": 104, "axial_elements": 8, "arc_elements": 8, "flat_elements": 2}
INSIDE = {"circumferential_elements": 52, "axial_elements": 8, "arc_elements": 8, "flat_elements": 2,
          "align_crests": False}
SIZES = natural_sizes(BEARING) | {name: BEARING.clearance for name in (
    "leading_edge_lift", "leading_edge_lift_edge", "trailing_edge_lift", "trailing_edge_lift_edge")}


def solve(folder, name, ranks=1, status=0, bearing=BEARING, options=(), quiet=True, **groups):
    """Writes a case of the reference bearing with changed groups, and runs it; what is None is left out."""
    content = {
        "scene": {"analysis": "equilibrium"},
        "bearing": {"radius": bearing.radius, "length": bearing.length, "clearance": bearing.clearance},
        "gas": {"viscosity": bearing.viscosity, "ambient_pressure": bearing.ambient_pressure},
        "operation": {"speed_rpm": SPEED},
        "top_foil": {**SHEET, "fixed_edge": "trailing"},
        "bump_foil": {**SHEET, **BUMPS},
        "contact": {"friction_top": 0.1, "friction_sleeve": 0.1, "normal_stiffness": 5.0e10, "stick_length": 1.0e-7},
        "model": {"foil": "shell", "film_scheme": "galerkin"},
        "mesh": INSIDE,
    }
    for group, keys in groups.items():
        content[group] = None if keys is None else {**content.get(group, {}), **keys}
    if content["scene"]["analysis"] == "equilibrium":
        content["operation"].setdefault("load", LOAD)
    return gfb_run.solve(folder, name, content, ranks, [*([] if quiet else ["--verbose"]), *options], status)


def held(eccentricity, **operation):
    """Groups of a shaft held at a position."""
    return {"scene": {"analysis": "fixed_position"}, "operation": {"eccentricity": tuple(eccentricity), **operation}}


def displacement(answer, part):
    """Displacements of a foil's nodes (nodes, 3) [m]."""
    with h5py.File(f"{answer.stem}.{part}.vtkhdf", "r") as file:
        return file["VTKHDF/PointData/displacement"][...]


def check_reference(checks, folder):
    """Both cases of the independent model from a cold start, and what friction does."""
    for edge, wanted in REFERENCE.items():
        run = solve(folder, edge, mesh=PAPER_MESH, top_foil={"fixed_edge": edge}, solver={"stability": edge == "trailing"})
        words = f"top foil fixed at the {edge} edge"
        off = run.eccentricity/BEARING.clearance - wanted["eccentricity"]
        checks.below(f"{words}: e_x/C off by", off[0], 3.0e-3)
        checks.below(f"{words}: e_y/C off by", off[1], 3.0e-3)
        for place, limit in (("midplane", 0.1), ("edge", 0.15)):
            gap = run[f"minimum_gap_{place}"]/MICROMETRE
            checks.below(f"{words}: gap at the {place} {gap:.3f} um, off by", gap - wanted[place], limit)
        pressure = run["maximum_pressure"]/BEARING.ambient_pressure
        checks.below(f"{words}: highest pressure {pressure:.4f} p_a, off by", pressure/wanted["pressure"] - 1.0, 2.0e-2)
        for name, lift in zip(("trailing_edge_lift", "trailing_edge_lift_edge"), wanted.get("lift", (0.0, 0.0))):
            checks.below(f"{words}: {name} {run[name]/MICROMETRE:.2f} um, off by", run[name]/MICROMETRE - lift, 0.5)
        # The free edge rests on the bumps: the branch the reference calls resting.
        checks.below(f"{words}: leading edge lies on the bumps [um]", run["leading_edge_lift"]/MICROMETRE, 0.5)
        check_balance(checks, words, run)
        if edge == "trailing":
            check_resting(checks, words, run)
    smooth, rubbing = (solve(folder, "friction", mesh=COARSE, contact={"friction_top": value, "friction_sleeve": value})
                       for value in (0.0, 0.1))
    rise = (smooth.eccentricity - rubbing.eccentricity)[0]/BEARING.clearance
    checks.within("without friction e_x/C rises by (planar model: 0.111)", rise, 0.09, 0.13)


def check_resting(checks, words, run):
    """A top foil that lies on the bumps has no negative eigenvalue."""
    checks.that(f"{words}: no mode grows", run["stability"] == 0.0)
    checks.that(f"{words}: the log calls it stable, and not nearly neutral",
                "(stable) while the shaft is fixed" in run.log)
    # As stiff as bumps under the sheet, a part of p_a/C.
    checks.within(f"{words}: stiffness of the softest mode over p_a/C", run["stability_margin"], 0.05, 1.0)
    checks.that(f"{words}: determinant positive", run["determinant_sign"] == 1.0)


def check_balance(checks, words, run, load=LOAD):
    """The film carries the load."""
    checks.below(f"{words}: force = load", numpy.abs(run.force - load).max()/numpy.linalg.norm(load), 1.0e-10)


def compare(checks, words, one, other, limit):
    """All numbers of two summaries, and the films where the nodes are the same."""
    difference, name = summary_difference(one, other, SIZES)
    checks.below(f"{words}: summary ({name})", difference, limit)
    first, second = one.film_arrays(), other.film_arrays()
    checks.below(f"{words}: film", max(largest_difference(first[key], second[key]) for key in first), limit)


def check_same(checks, folder):
    """Half width, condensation, ranks and the way to the answer change nothing."""
    for mesh, words in ((ALIGNED, "crests on nodes"), (INSIDE, "crests inside elements")):
        base = solve(folder, "base", mesh=mesh)
        check_balance(checks, words, base)
        checks.that(f"{words}: foils touch and lift", 0.0 < base["lifted_length"] < 1.0)
        whole = solve(folder, "whole", mesh=mesh, model={"half_width": "no"})
        checks.that(f"{words}: half the width has fewer unknowns", base["unknowns"] < 0.6*whole["unknowns"])
        compare(checks, f"{words}, half and whole width", whole, base, 1.0e-9)
        full = solve(folder, "full", mesh=mesh, model={"reduction": "none"})
        checks.that(f"{words}: condensed has fewer unknowns", base["unknowns"] < 0.8*full["unknowns"])
        compare(checks, f"{words}, full and condensed", full, base, 1.0e-8)
    check_ways(checks, folder, base, ((25.0e-6, 10.0e-6), (15.0e-6, 0.0)))  # crests inside elements


def check_ways(checks, folder, base, places, solver=solve):
    """Ranks, start positions, limits and a held shaft lead to the same answer."""
    for ranks in (2, 4):
        compare(checks, f"{ranks} ranks", solver(folder, "ranks", ranks=ranks), base, 1.0e-8)
    for place in places:
        start = solver(folder, "start", operation={"eccentricity": place})
        checks.that(f"started at {place}: another way", start["newton_iterations"] != base["newton_iterations"])
        compare(checks, f"started at {place}", start, base, 1.0e-8)
    limits = {"residual_tolerance": 1.0e-11, "step_tolerance": 1.0e-12}
    words = ", ".join(f"{key} {value:g}" for key, value in limits.items())
    other = solver(folder, "limits", solver=limits)
    checks.that(f"{words}: another way", other["newton_iterations"] != base["newton_iterations"])
    compare(checks, words, other, base, 1.0e-8)
    fixed = solver(folder, "fixed", **held(base.eccentricity))
    check = numpy.abs(fixed.force - LOAD).max()/numpy.linalg.norm(LOAD)
    checks.below("held at the position found: force = load", check, 1.0e-8)
    # A shaft that is held has no equations, and neither a determinant nor an edge that is free with it.
    free = {name: value for name, value in base.summary.items() if name not in ("determinant_sign", "edge_stiffness")}
    compare(checks, "held at the position found", fixed, dataclasses.replace(base, summary=free), 1.0e-8)


def check_stiff(checks, folder, solver=solve):
    """Foils that hardly give come to the rigid film, in proportion to what they give."""
    rigid = {"top_foil": None, "bump_foil": None, "contact": None, "model": {"foil": "rigid"},
             "mesh": {key: None for key in ("arc_elements", "flat_elements", "align_crests")}}
    for words, place in (("held", held((20.0e-6, 10.0e-6))), ("balanced", {})):
        wanted = solve(folder, "rigid", **place, **rigid)
        off = []
        for factor in (1.0e3, 1.0e5):
            foil = {"thickness": 0.4e-3, "youngs_modulus": factor*SHEET["youngs_modulus"]}
            run = solver(folder, "stiff", top_foil=foil, bump_foil=foil,
                         contact={"normal_stiffness": 5.0e7*factor}, **place)
            off.append(max(largest_difference(run.film_arrays()["pressure"], wanted.film_arrays()["pressure"]),
                           numpy.abs(run.force - wanted.force).max()/numpy.linalg.norm(wanted.force),
                           numpy.abs(run.eccentricity - wanted.eccentricity).max()/BEARING.clearance))
        checks.below(f"very stiff foils, {words}: the rigid film", off[1], 1.0e-4)
        checks.within(f"very stiff foils, {words}: order in 1/E", observed_order(*off, ratio=100.0), 0.9, 1.1)


def check_rest(checks, folder):
    """Without speed nothing moves."""
    place = numpy.array((22.0e-6, 8.0e-6))
    run = solve(folder, "rest", **held(place, speed_rpm=0.0))
    film = run.film_arrays()
    gap = BEARING.clearance + place[0]*numpy.cos(film["theta"]) + place[1]*numpy.sin(film["theta"])
    checks.below("at rest: undeflected gap", largest_difference(film["gap"], gap), 1.0e-12)
    checks.below("at rest: ambient pressure", largest_difference(
        film["pressure"], numpy.full_like(gap, BEARING.ambient_pressure)), 1.0e-12)
    for part in ("top_foil", "bump_foil"):
        checks.below(f"at rest: {part} over C", numpy.abs(displacement(run, part)).max()/BEARING.clearance, 1.0e-12)
    checks.below("at rest: no force", numpy.abs(run.force).max()/BEARING.force_unit, 1.0e-12)
    moved = solve(folder, "moving", **held(place))
    for part in ("top_foil", "bump_foil"):
        checks.that(f"at speed: {part} moves", numpy.abs(displacement(moved, part)).max() > 0.01*BEARING.clearance)


def check_mirror(checks, folder):
    """The tilt's mirror image about z = 0 turns the torque round and mirrors the film."""
    runs = [solve(folder, f"mirror_{sign}", mesh={"axial_elements": 6}, **held(
        (26.0e-6, 8.0e-6), tilt=(sign*5.0e-5, sign*2.0e-5))) for sign in (1, -1)]
    torque, force = (numpy.linalg.norm(values) for values in (runs[0].torque, runs[0].force))
    checks.that("tilt: there is a torque", runs[0]["torque_x"] > 1.0e-3*SIZES["torque_x"])
    checks.below("mirrored tilt: torque is odd", numpy.abs(runs[0].torque + runs[1].torque).max()/torque, 1.0e-8)
    checks.below("mirrored tilt: force is even", numpy.abs(runs[0].force - runs[1].force).max()/force, 1.0e-8)
    first, second = (run.film_arrays() for run in runs)
    for name in ("pressure", "gap"):
        checks.below(f"mirrored tilt: {name}", largest_difference(first[name][:, ::-1], second[name]), 1.0e-8)


def check_units(checks, folder):
    """Other units of length, pressure and time, by powers of two: the contact's defaults follow the scene."""
    base = None
    for scale in ((0, 0, 0), (10, 0, 0), (0, 20, 0), (0, 0, -11), (-7, 9, 5)):
        length, stress, time = (2.0**power for power in scale)
        bearing = dataclasses.replace(
            BEARING, radius=BEARING.radius*length, length=BEARING.length*length, clearance=BEARING.clearance*length,
            viscosity=BEARING.viscosity*stress*time, ambient_pressure=BEARING.ambient_pressure*stress)
        sheet = {"thickness": SHEET["thickness"]*length, "youngs_modulus": SHEET["youngs_modulus"]*stress}
        shape = {name: BUMPS[name]*length for name in ("half_length", "height", "pitch")}
        run = solve(folder, "units", bearing=bearing, top_foil=sheet, bump_foil=sheet | shape, contact=None,
                    operation={"speed_rpm": SPEED/time, "load": tuple(numpy.array(LOAD)*stress*length**2)})
        if base is None:
            base = run
            continue
        worst = (0.0, "all")
        for name, value in base.physical().items():
            if base.units[name] in POWERS:
                unit = 2.0**float(numpy.dot(scale, POWERS[base.units[name]]))
                size = SIZES.get(name, abs(value))
                worst = max(worst, (abs(run[name]/unit - value)/size if size > 0.0 else 0.0, name))
        checks.below(f"units x 2^{scale} of length, pressure, time ({worst[1]})", worst[0], 1.0e-8)


def check_convergence(checks, folder):
    """Elements of film and top foil along the motion: 4, 8, 16 a pitch, crests on nodes."""
    quantities = {"e_x/C": [], "e_y/C": [], "minimum gap [um]": [], "highest pressure/p_a": []}
    for elements in (4, 8, 16):
        run = solve(folder, "convergence", mesh={"circumferential_elements": 26*elements, "axial_elements": 4,
                                                 "align_crests": True})
        found = (*run.eccentricity/BEARING.clearance, run["minimum_gap"]/MICROMETRE,
                 run["maximum_pressure"]/BEARING.ambient_pressure)
        for values, value in zip(quantities.values(), found):
            values.append(value)
    for name, values in quantities.items():
        first, second = numpy.diff(values)
        words = " ".join(f"{value:.5f}" for value in values)
        checks.that(f"{name} with 4, 8, 16 elements a pitch: {words}; observed order "
                    f"{observed_order(first, second):.1f}", abs(second) < abs(first))


def check_no_equilibrium(checks, folder):
    """A load the film cannot carry ends with a sentence, and nothing of a plausible answer."""
    run = solve(folder, "overload", status=2, operation={"load": (-2000.0, 0.0)})
    checks.that("2000 N: says that there is no equilibrium", "no equilibrium found: " in run.log)
    checks.that("2000 N: says how far it came", "last state reached: load (" in run.log)
    checks.that("2000 N: not converged", run["converged"] == "false")
    checks.that("2000 N: no answer beside it", not (pathlib.Path(folder)/"overload.summary").exists())
    checks.that("2000 N: finite numbers", all(numpy.isfinite(value) for value in run.physical().values()))
    carried = numpy.linalg.norm(run.force)
    checks.within("2000 N: carried when it ended [N]", carried, 100.0, 2000.0)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_reference(checks, folder)
        check_same(checks, folder)
        check_stiff(checks, folder)
        check_rest(checks, folder)
        check_mirror(checks, folder)
        check_units(checks, folder)
        check_convergence(checks, folder)
        check_no_equilibrium(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
