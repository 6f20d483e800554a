#!/usr/bin/env python3
"""Several pads and their preload: an independent solution, one pad against a shifted one, three pads against three runs
of one, symmetry, ranks, a restart."""

import json
import math
import pathlib

import numpy

from sample import normal
from gfb_run import largest_difference, observed_order, run_checks, solve

REFERENCE = json.loads((pathlib.Path(__file__).parent/"reference"/"pads.json").read_text(encoding="utf-8"))["cases"]
TURN = 2.0*math.pi/3.0
MESH = (56, 40)
PLACE = (1.2e-5, 0.9e-5)
FOILS = {
    "top_foil": {"thickness": 1.27e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29, "fixed_edge": "leading"},
    "bump_foil": {"thickness": 1.27e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29, "half_length": 1.778e-3,
                  "height": 5.08e-4, "bumps": 8, "fixed_edge": "leading"},
    "contact": {"friction_top": 0.1, "friction_sleeve": 0.1}}


def referred(row, mesh, order):
    """The groups of a row of the reference."""
    given = row["input"]
    operation = {"speed_rpm": given["speed_rpm"]}
    for name in ("load", "eccentricity", "tilt"):
        if f"{name}_x" in given:
            operation[name] = (given[f"{name}_x"], given[f"{name}_y"])
    model = {"foil": "rigid", "film_order": order, "film_scheme": "galerkin"}
    if "foundation_pressure" in row:
        model |= {"foil": "elastic_foundation", "foundation_stiffness": given["foundation_stiffness"],
                  "foundation_pressure": row["foundation_pressure"]}
    return {"scene": {"analysis": "equilibrium" if "load" in operation else "fixed_position"},
            "bearing": {name: given[name] for name in ("radius", "length", "clearance")}, "pads": row["pads"],
            "gas": {name: given[name] for name in ("viscosity", "ambient_pressure")}, "operation": operation,
            "model": model, "mesh": {"circumferential_elements": mesh[0], "axial_elements": mesh[1]}}


def of_pads(foil, pads, place=PLACE, load=None, **more):
    """Groups of a bearing with foils of its own on each pad."""
    operation = {"speed_rpm": 45000.0} | ({"load": load} if load else {"eccentricity": place})
    meshed = foil in ("beam", "shell")
    mesh = {"axial_elements": 4} | ({"arc_elements": 4, "flat_elements": 1} if meshed else {"circumferential_elements": 24})
    return {"scene": {"analysis": "equilibrium" if load else "fixed_position"},
            "bearing": {"radius": 0.01905, "length": 0.0381, "clearance": 3.18e-5},
            "pads": {"arc": 2.0, "preload": 0.2} | pads, "gas": {"viscosity": 1.95e-5, "ambient_pressure": 101350.0},
            "operation": operation, "model": {"foil": foil}, "mesh": mesh} | (FOILS if meshed else {}) | more


def check_reference(checks, folder):
    for row in REFERENCE:
        answer, wanted = solve(folder, "row", referred(row, MESH, 2)), row["output"]
        for name in ("force", "torque"):
            if f"{name}_x" not in wanted:
                continue
            there = [wanted[f"{name}_{axis}"] for axis in "xy"]
            found = [answer[f"{name}_{axis}"] - there[axis == "y"] for axis in "xy"]
            checks.below(f"{row['name']}: {name}", math.hypot(*found)/math.hypot(*there), 1.0e-4)
        for name in ("friction_torque", "eccentricity_x", "eccentricity_y"):
            if wanted.get(name):
                checks.below(f"{row['name']}: {name}", answer[name]/wanted[name] - 1.0, 1.0e-4)


def check_order(checks, folder):
    row = REFERENCE[2]
    errors = [solve(folder, "order", referred(row, (n, n), 1))["force_x"]/row["output"]["force_x"] - 1.0
              for n in (24, 48, 96)]
    checks.within("bilinear elements: order", observed_order(errors[1], errors[2]), 1.8, 2.2)


def check_preload(checks, folder):
    """One pad with a preload is one without at another eccentricity."""
    angle, shift = 0.3 + 0.4*2.0, 0.25*3.18e-5
    for foil in ("rigid", "beam"):
        films, answers = [], []
        for preload, place in ((0.25, PLACE), (0.0, (PLACE[0] - shift*math.cos(angle), PLACE[1] - shift*math.sin(angle)))):
            answer = solve(folder, "preload", of_pads(foil, {"first_leading_edge": 0.3, "preload": preload,
                                                             "preload_offset": 0.4}, place))
            answers.append(answer)
            films.append(answer.film_arrays())
        for field in ("gap", "pressure"):
            checks.below(f"{foil}: a preload is a shift: {field}", largest_difference(films[0][field], films[1][field]),
                         1.0e-9 if foil == "beam" else 1.0e-12)


def check_three(checks, folder):
    """Three pads are three runs of one."""
    for foil in ("rigid", "beam", "shell"):
        three = solve(folder, "three", of_pads(foil, {"count": 3}))
        single = [solve(folder, "single", of_pads(foil, {"count": 1, "first_leading_edge": i*TURN})) for i in range(3)]
        force = math.hypot(*three.force)
        for axis in "xy":
            total = sum(one[f"force_{axis}"] for one in single)
            checks.below(f"{foil}: force_{axis} of three pads", (three[f"force_{axis}"] - total)/force, 1.0e-10)
            for i, one in enumerate(single):
                checks.below(f"{foil}: force_{axis}_{i + 1}",
                             (three[f"force_{axis}_{i + 1}"] - one[f"force_{axis}"])/force, 1.0e-10)
        for i, one in enumerate(single):
            checks.below(f"{foil}: minimum_gap_{i + 1}", three[f"minimum_gap_{i + 1}"]/one["minimum_gap"] - 1.0, 1.0e-9)
        centred = solve(folder, "centred", of_pads(foil, {"count": 3}, (0.0, 0.0)))
        checks.below(f"{foil}: no force on a centred shaft",
                     math.hypot(*centred.force)/math.hypot(centred["force_x_1"], centred["force_y_1"]), 1.0e-10)


def check_heights(checks, folder):
    """With random heights each pad has a draw of its own: the numbers of a seed one after the other; the first is that of one pad."""
    bumps = FOILS["bump_foil"]["bumps"]
    deviations = normal(7, 3*bumps).reshape(3, bumps)*1.0e-6
    for foil in ("beam", "shell"):
        random = {"bump_foil": FOILS["bump_foil"] | {"height_deviation": 1.0e-6, "seed": 7}}
        three = solve(folder, "three", of_pads(foil, {"count": 3}) | random)
        for i, heights in enumerate(deviations):
            given = {"bump_foil": FOILS["bump_foil"] | {"crest_gap": tuple(heights.max() - heights)}}
            one = solve(folder, "single", of_pads(foil, {"count": 1, "first_leading_edge": i*TURN}) | given)
            checks.below(f"{foil}, random heights: force_x_{i + 1}", (three[f"force_x_{i + 1}"] - one["force_x"])/math.hypot(*three.force),
                         1.0e-9)


def with_free_edges(bearing, load):
    """Beams of three pads whose leading edges are free, so that suction may draw them up."""
    sheet = {"youngs_modulus": 2.14e11, "poissons_ratio": 0.29, "fixed_edge": "trailing"}
    shape, preload, speed, top, bumps, friction = bearing
    return {"scene": {"analysis": "equilibrium"}, "bearing": dict(zip(("radius", "length", "clearance"), shape)),
            "pads": {"count": 3, "arc": 2.007, "preload": preload, "preload_offset": 0.5},
            "gas": {"viscosity": 1.95e-5, "ambient_pressure": 101350.0},
            "operation": {"speed_rpm": speed, "load": load}, "model": {"foil": "beam"}, "output": {"fields": "none"},
            "top_foil": {**sheet, "thickness": top}, "bump_foil": {**sheet, **bumps, "fixed_line": "half_flat"},
            "contact": {"friction_top": friction, "friction_sleeve": 0.0},
            "mesh": {"circumferential_elements": 6*bumps["bumps"], "axial_elements": 8, "arc_elements": 8, "flat_elements": 2}}


def check_turns(checks, folder):
    """Film and foils in turns end where they end together."""
    for foil, limit in (("elastic_foundation", 1.0e-7), ("beam", 1.0e-7)):
        model = {"foil": foil} | ({} if foil == "beam" else {"foundation_stiffness": 6.0e9})
        together, turns = (solve(folder, coupling, of_pads(foil, {"count": 3}, load=(-60.0, 20.0),
                                                           model={**model, "coupling": coupling}))
                           for coupling in ("monolithic", "partitioned"))
        for name in ("eccentricity_x", "minimum_gap", "minimum_gap_2", "force_x_1", "friction_torque"):
            checks.below(f"{foil}: in turns, {name}", turns[name]/together[name] - 1.0, limit)
    ranks = solve(folder, "ranks", of_pads("beam", {"count": 3}, load=(-60.0, 20.0),
                                           model={"foil": "beam", "coupling": "partitioned"}), ranks=2)
    checks.below("in turns, two ranks", ranks["minimum_gap"]/turns["minimum_gap"] - 1.0, limit)


def turned(vector, times):
    """A vector, on by so many of three pads."""
    angle = times*TURN
    return (vector[0]*math.cos(angle) - vector[1]*math.sin(angle), vector[0]*math.sin(angle) + vector[1]*math.cos(angle))


def lifts(rows, row):
    """Lifts of the pads' leading edges in a row."""
    return [rows[f"leading_edge_lift_{pad + 1}"][row] for pad in range(3)]


def check_branches(checks, folder):
    """Equilibria of three pads: those of a load turned by a pad are the same with the pads turned; one asked for is found; the
    cold start takes one whose edges all rest, where there is one."""
    free = {group: {**keys, "fixed_edge": "trailing"} if "fixed_edge" in keys else keys for group, keys in FOILS.items()}
    free["bump_foil"] = {**free["bump_foil"], "bumps": 5}
    load, clearance = (-20.0, 5.0), 3.18e-5
    scenes = [of_pads("beam", {"count": 3, "arc": 1.9, "preload": 0.0}, load=turned(load, times), **free) for times in range(2)]
    tables = [solve(folder, "all", scene, options=("--branches",)).history() for scene in scenes]
    checks.that("branches: several, whose edges are lifted pad by pad", len(tables[0]["branch"]) >= 4)
    checks.that("branches: a load turned has as many", len(tables[0]["branch"]) == len(tables[1]["branch"]))
    for row in range(len(tables[0]["branch"])):
        place, there = (numpy.array([table["eccentricity_x"], table["eccentricity_y"]]).T/clearance for table in tables)
        wanted = turned(place[row], 1)
        other = min(range(len(there)), key=lambda i: math.dist(there[i], wanted))
        here, turn = lifts(tables[0], row), lifts(tables[1], other)
        off = max(math.dist(there[other], wanted), max(abs(turn[(pad + 1) % 3] - here[pad]) for pad in range(3))/clearance)
        checks.below(f"branches: equilibrium {row + 1}, turned by a pad", off, 1.0e-6)
        asked = {**scenes[0], "operation": {**scenes[0]["operation"], "leading_edge_lift": tuple(float(f"{lift:.4g}") for lift in here)}}
        found = solve(folder, "asked", asked)
        checks.below(f"branches: equilibrium {row + 1}, asked for by its lifts",
                     math.dist((found["eccentricity_x"]/clearance, found["eccentricity_y"]/clearance), place[row]), 1.0e-7)
        checks.below(f"branches: equilibrium {row + 1}, the pads bear the load",
                     math.dist([sum(found[f"force_{axis}_{pad}"] for pad in (1, 2, 3)) for axis in "xy"], load)/math.hypot(*load), 1.0e-9)
    cold = solve(folder, "cold", scenes[0])
    resting = [row for row in range(len(tables[0]["branch"])) if max(lifts(tables[0], row)) < 0.02*clearance]
    checks.that("branches: the cold start ends where all edges rest", len(resting) > 0 and min(
        abs(tables[0]["eccentricity_x"][row] - cold["eccentricity_x"]) for row in resting) < 1.0e-9*clearance)


def check_free_edges(checks, folder):
    """Where suction draws at an edge a cold start finds the answer, or names the pad; by symmetry whatever pad it is."""
    load = (21.3, 38.1)
    found = ((0.04736, 0.1249, 6.99e-5), 0.2, 12120.0, 6.63e-5,
             {"thickness": 1.004e-4, "half_length": 4.04e-3, "height": 1.18e-3, "bumps": 10}, 0.255)
    answers = [solve(folder, "edges", with_free_edges(found, turned(load, times))) for times in range(3)]
    place, gap = (answers[0]["eccentricity_x"], answers[0]["eccentricity_y"]), answers[0]["minimum_gap"]
    checks.below("free edges: the force is the load", math.dist(answers[0].force, load)/math.hypot(*load), 1.0e-9)
    for times, one in enumerate(answers[1:], 1):
        off = math.dist((one["eccentricity_x"], one["eccentricity_y"]), turned(place, times))
        checks.below(f"free edges, turned by {times} pads: position", off/math.hypot(*place), 1.0e-6)
        checks.below(f"free edges, turned by {times} pads: smallest gap", one["minimum_gap"]/gap - 1.0, 1.0e-6)
    drawn = ((0.02025, 0.0571, 2.378e-5), 0.0, 46670.0, 5.81e-5,
             {"thickness": 1.605e-4, "half_length": 2.1e-3, "height": 4.05e-4, "bumps": 8}, 0.0)
    for times, pad in ((0, 3), (1, 1)):
        log = solve(folder, "drawn", with_free_edges(drawn, turned((2.82, 6.35), times)), status=2).log
        checks.that(f"free edges: that of pad {pad} is drawn to the shaft",
                    f"the film draws the free edge of the top foil of pad {pad} to the shaft" in log)


def check_bore(checks, folder):
    """Each pad has the bore at its own angles, and the gas' laws."""
    more = {"bore": {"waves": 2, "wave_amplitude": 2.0e-6, "wave_angle": 0.3},
            "gas": {"viscosity": 1.95e-5, "ambient_pressure": 101350.0, "mean_free_path": 6.6e-7}}
    three = solve(folder, "bore", of_pads("beam", {"count": 3}, **more))
    for i in range(3):
        one = solve(folder, "bore_1", of_pads("beam", {"count": 1, "first_leading_edge": i*TURN}, **more))
        off = math.hypot(three[f"force_x_{i + 1}"] - one["force_x"], three[f"force_y_{i + 1}"] - one["force_y"])
        checks.below(f"waves of the bore and slip: force of pad {i + 1}", off/math.hypot(*three.force), 1.0e-10)


def check_film(checks, folder):
    """The written gap, pad by pad, is the formula."""
    film = solve(folder, "film", of_pads("rigid", {"count": 3, "first_leading_edge": 0.2})).film_arrays()
    theta, pad = film["theta"], film["pad"]
    centre = 0.2 + (pad - 1.0)*TURN + 0.5*2.0
    gap = 3.18e-5*(1.0 - 0.2*numpy.cos(theta - centre)) + PLACE[0]*numpy.cos(theta) + PLACE[1]*numpy.sin(theta)
    checks.below("the gap of three pads", largest_difference(film["gap"], gap), 1.0e-12)
    checks.that("each pad has its stations", [int((pad == i).sum()) for i in (1, 2, 3)] == [25*5]*3)


def check_sweep(checks, folder):
    """Ranks, and the end of a sweep, find what one rank finds at once."""
    for foil in ("beam", "shell"):
        once = solve(folder, "once", of_pads(foil, {"count": 3}, load=(-40.0, 0.0)))
        others = {"a sweep over the preload": (1, {"sweep": {"parameter": "pads%preload", "values": (0.3, 0.2)}})}
        if foil == "beam":  # shells on other ranks: every_input.py
            others |= {"2 ranks": (2, {}), "a sweep": (1, {"sweep": {"parameter": "load", "values": (60.0, 50.0, 40.0)}})}
        for words, (ranks, more) in others.items():
            other = solve(folder, "other", of_pads(foil, {"count": 3}, load=(-40.0, 0.0), **more), ranks=ranks)
            worst = max(abs(other[name]/once[name] - 1.0) for name in ("eccentricity_x", "eccentricity_y", "force_x_2",
                                                                     "minimum_gap", "friction_torque"))
            checks.below(f"{foil} under a load: {words}", worst, 1.0e-8)


def main():
    run_checks((check_reference, check_order, check_preload, check_three, check_heights, check_turns, check_bore, check_film, check_sweep),
               (check_free_edges, check_branches))


if __name__ == "__main__":
    main()
