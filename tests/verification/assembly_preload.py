#!/usr/bin/env python3
"""Foils that lie with a force at rest: a top foil of another free radius, a shaft larger than the bore in the foil.

Closed forms of the state at rest; the same bearing said in two ways; derivatives against differences of whole answers;
shells beside beams; restart, ranks, refusals.
"""

import math
import pathlib
import random
import re
import tempfile

import h5py
import numpy

from gfb_run import Bearing, Checks, case_groups, largest_difference, solve, summary_difference
from restart import check_kills
from sensitivity import CENTRAL, CENTRAL_FOURTH, check_differences, foils, with_keys

RADIUS, LENGTH, MICROMETRE = 0.02, 0.03, 1.0e-6
SHEET = {"thickness": 1.0e-4, "youngs_modulus": 2.0e11, "poissons_ratio": 0.3}
HALF_LENGTH, SOLVED = 1.5e-3, {"residual_tolerance": 1.0e-12, "step_tolerance": 1.0e-13}
RING = Bearing(leading_edge_condition="periodic")
SMALL_SIZES = {name: 2.0e-5 for name in ("eccentricity_x", "eccentricity_y", "leading_edge_lift", "leading_edge_lift_edge",
                                        "trailing_edge_lift", "trailing_edge_lift_edge")}


def free_radius(curvature, radius=RADIUS):
    """Radius of a foil that is so much more curved than the bore."""
    return 1.0/(1.0/radius + curvature)


def bending(sheet=SHEET):
    """D of a wide foil [N m]."""
    return sheet["youngs_modulus"]*sheet["thickness"]**3/(12.0*(1.0 - sheet["poissons_ratio"]**2))


def at_rest(folder, foil, curvature, begins=5.0, bumps=5, stations=40, sheet=SHEET):
    """The pad without speed, its shaft far away: ambient pressure everywhere."""
    given = {} if curvature is None else {"free_radius": free_radius(curvature)}
    return solve(folder, "rest", {
        "scene": {"analysis": "fixed_position"},
        "bearing": {"radius": RADIUS, "length": LENGTH, "clearance": 1.0e-4, "leading_edge_angle": begins},
        "gas": {"viscosity": 2.0e-5, "ambient_pressure": 1.0e5},
        "operation": {"speed_rpm": 0.0, "eccentricity": (0.0, 0.0)},
        "top_foil": {**sheet, **given},
        "bump_foil": {**sheet, "half_length": HALF_LENGTH, "height": 5.0e-4, "bumps": bumps, "fixed_edge": "trailing"},
        "contact": {"friction_top": 0.0, "friction_sleeve": 0.0},
        "model": {"foil": foil}, "solver": SOLVED,
        "mesh": {"circumferential_elements": stations, "axial_elements": 4, "arc_elements": 8, "flat_elements": 2}})


def field(answer, part, name):
    """A field of a foil's file."""
    with h5py.File(f"{answer.stem}.{part}.vtkhdf") as file:
        return file["VTKHDF"][name][...]


def check_cantilever(checks, folder):
    """A foil rolled more closely lifts off all bumps: a cantilever under an end couple and an even pressure."""
    length, curvature = RADIUS*(2.0*math.pi - 5.0), 0.1
    tip = 0.5*curvature*length**2 + curvature*length**4/(8.0*RADIUS**2)
    narrow = SHEET | {"poissons_ratio": 0.0}
    for words, foil, sheet, limit in (("beam", "beam", SHEET, 1.0e-4), ("shell, no lateral contraction", "shell", narrow, 1.0e-4),
                                      ("shell, which bends a little across", "shell", SHEET, 1.0e-2)):
        answer = at_rest(folder, foil, curvature, sheet=sheet)
        checks.below(f"{words}: free edge {tip/MICROMETRE:.3f} um off its bumps, off by",
                     answer["leading_edge_lift"]/tip - 1.0, limit)
        checks.that(f"{words}: no crest touches", answer["lifted_length"] == 1.0)
        if limit > 1.0e-3:
            continue
        edge = numpy.unique(field(answer, "top_foil", "Points")[:, 0])
        stress = numpy.abs(field(answer, "top_foil", "CellData/bending_stress")).max(axis=1).reshape(len(edge) - 1, -1)
        moment = 0.5*bending(sheet)*curvature/RADIUS**2*(0.5*(edge[1:] + edge[:-1]))**2
        checks.below(f"{words}: bending stress is the pressure's, the couple has bent the foil to its own shape",
                     largest_difference(stress, numpy.broadcast_to(6.0*moment[:, None]/SHEET["thickness"]**2, stress.shape)),
                     2.0e-3)
    beam, shell = (at_rest(folder, foil, -0.1, sheet=narrow).film_arrays()["deflection"] for foil in ("beam", "shell"))
    checks.below("pressed on its bumps, no lateral contraction: shells are beams", largest_difference(shell, beam), 1.0e-3)
    plain, same = (at_rest(folder, "shell", curvature).physical() for curvature in (None, 0.0))
    checks.that("the bore's radius as free radius: the answer without it to the last digit", plain == same)


def sprung(first):
    """Closed form of a foil that springs open on stiff bumps, the first of them at an angle from its edge: force there over
    M_0/R, angle where it lies again, rise over kappa_0 R^2.

    Curvature over kappa_0 behind the first bump, to be zero with rise and slope where it lies again:
    g = 1 - f (t - t_1) + t^2/2.
    """
    def force(span):
        return (1.0 + 0.5*(first + span)**2)/span

    def moment(span):
        return 0.5*span**2 - force(span)*span**3/3.0 + 0.5*(span**4/4.0 + 2.0*first*span**3/3.0 + 0.5*first**2*span**2)

    low, high = 1.0, 3.0
    for _ in range(100):
        middle = 0.5*(low + high)
        low, high = (middle, high) if moment(middle)*moment(low) > 0.0 else (low, middle)
    behind = numpy.linspace(0.0, low, 20001)
    curvature = 1.0 - force(low)*behind + 0.5*(first + behind)**2
    step = behind[1]
    slope = numpy.concatenate(([0.0], numpy.cumsum(0.5*step*(curvature[1:] + curvature[:-1]))))
    slope -= slope[-1]
    rise = numpy.cumsum(0.5*step*(slope[1:] + slope[:-1]))
    return force(low), first + low, numpy.abs(rise).max()


def check_sprung(checks, folder):
    """A foil that springs open lies on its bumps with an even pressure, rises behind its free edge and presses there."""
    curvature, bumps = -1.0, 26
    answer = at_rest(folder, "beam", curvature, 0.0, bumps, 208)
    points, force = field(answer, "bump_foil", "Points"), field(answer, "bump_foil", "PointData/contact_force")
    crest = numpy.isclose(points[:, 1], 5.0e-4, rtol=1.0e-9)
    crest &= numpy.isclose(points[:, 2], points[0, 2], atol=1.0e-12)
    angle, force = points[crest, 0]/RADIUS, -force[crest, 1]
    first, touch, rise = sprung(angle.min())
    moment = bending()*abs(curvature)
    checks.that(f"sprung open: {crest.sum()} crests, none pulls", crest.sum() == bumps and force.min() >= 0.0)
    checks.below("sprung open: force of the first crest", force[angle.argmin()]/(first*moment/RADIUS) - 1.0, 1.0e-2)
    again = angle[(force > 0.0) & (angle > angle.min())].min()
    checks.within("sprung open: the foil lies again, pitches behind the closed form's angle",
                  (again - touch)/(angle[1] - angle[0]), -0.5, 1.0)
    highest = -answer.film_arrays()["deflection"].min()
    checks.below(f"sprung open: rises by {highest/MICROMETRE:.2f} um, off by", highest/(rise*abs(curvature)*RADIUS**2) - 1.0,
                 3.0e-2)
    pressure = moment/RADIUS**2
    carried = pressure*(2.0*math.pi*RADIUS - 0.5*(2.0*math.pi - angle.max())*RADIUS)
    checks.below("sprung open: crests carry the even pressure D kappa_0/R^2", force.sum()/carried - 1.0, 5.0e-3)
    inner = force[(angle > again + 0.8) & (angle < angle.max() - 0.5)]
    checks.below("sprung open: each its pitch of it", largest_difference(inner, pressure*RADIUS*(angle[1] - angle[0]) + 0.0*inner),
                 2.0e-2)


def on_springs(interference, clearance=RING.clearance, touching=False, **more):
    """A full ring on springs."""
    groups = {"model": {"foundation_stiffness": 5.0e10, "foundation_pressure": "axial_mean"}, "solver": SOLVED,
              "bearing": {"assembly_interference": interference, "clearance": clearance}}
    if touching:
        groups["shaft_contact"] = {"roughness": 0.3e-6, "pressure": 1.0e9, "friction": 0.1}
    return case_groups(RING, mesh=(64, 8), foil="elastic_foundation", groups=groups, **more)


def check_interference(checks, folder):
    """Less clearance by another name; more than the clearance, the asperities press the springs back."""
    one = solve(folder, "less", on_springs(8.0e-6, speed_rpm=3.0e4, load=(-60.0, 10.0)))
    other = solve(folder, "less", on_springs(0.0, RING.clearance - 8.0e-6, speed_rpm=3.0e4, load=(-60.0, 10.0)))
    off, name = summary_difference(one, other, {"torque_x": 1.0, "torque_y": 1.0, "torque_x_without_suction": 1.0,
                                                "torque_y_without_suction": 1.0})
    checks.below(f"springs: interference is less clearance ({name})", off, 1.0e-8)
    beams = [solve(folder, "less", pressed_foils("beam", interference, clearance, None))
             for interference, clearance in ((4.0e-6, 2.0e-5), (0.0, 1.6e-5))]
    off, name = summary_difference(*beams, SMALL_SIZES | {"torque_x": 1.0, "torque_y": 1.0, "torque_x_without_suction": 1.0,
                                                          "torque_y_without_suction": 1.0})
    checks.below(f"beams: interference is less clearance ({name})", off, 1.0e-6)
    # Edges at ambient pressure do not deflect: no load that is so large has an answer.
    heavy = {"scene": {"analysis": "equilibrium"}, "bearing": {"radius": RADIUS, "length": 0.04, "clearance": 3.0e-5, "assembly_interference": 1.0e-6},
             "gas": {"viscosity": 2.0e-5, "ambient_pressure": 1.0e5}, "operation": {"speed_rpm": 3.0e4, "load": (-3000.0, 0.0)},
             "model": {"foil": "elastic_foundation", "foundation_stiffness": 1.0e11, "foundation_pressure": "local"},
             "mesh": {"circumferential_elements": 48, "axial_elements": 8}}
    last = solve(folder, "heavy", heavy, status=2)
    place = re.search(r"film thinnest at theta = (\S+) deg, z = (\S+) mm: (\S+) um", last.log)
    film = float(re.search(r"^minimum_gap = (\S+)", (pathlib.Path(folder)/"heavy.unconverged.summary").read_text(encoding="utf-8"), re.M)[1])
    checks.that(f"no answer: place and film of the last state: {place and place[0]}, {film:.3g} m", place is not None and abs(float(place[2])) == 20.0
                and film > 0.0 and abs(float(place[3])*MICROMETRE/film - 1.0) < 0.01 and "without the growth and interference of 1 um" in last.log)
    interference = 2.0*RING.clearance
    answer = solve(folder, "pressed", on_springs(interference, touching=True, speed_rpm=0.0, eccentricity=(0.0, 0.0)))
    low, high = 0.0, RING.clearance
    for _ in range(200):
        gap = 0.5*(low + high)
        pressure = 1.0e9*math.exp(-gap/0.3e-6)
        low, high = (gap, high) if RING.clearance - interference + pressure/5.0e10 > gap else (low, gap)
    checks.below(f"twice the clearance at rest: gap of {gap/MICROMETRE:.4f} um, off by", answer["minimum_gap"]/gap - 1.0, 1.0e-8)
    brake = 0.1*pressure*2.0*math.pi*RING.radius**2*RING.length
    checks.below("twice the clearance at rest: torque of the asperities", answer["friction_torque"]/brake - 1.0, 1.0e-8)


def pressed_foils(foil, interference=2.0e-6, clearance=2.0e-5, curvature=-0.5):
    """A small bearing of foils whose top foil springs open, and whose shaft is larger."""
    case = with_keys(foils(foil, 0.0), bearing={"assembly_interference": interference, "clearance": clearance},
                     contact={"normal_stiffness": 5.0e10})
    if curvature is not None:
        case["top_foil"] = case["top_foil"] | {"free_radius": free_radius(curvature, case["bearing"]["radius"])}
    return case


def check_derivatives(checks, folder):
    """The Jacobian and the load's derivatives: the adjoint against differences of whole answers."""
    for foil, keys, sides in (("beam", {"top_foil%free_radius": 3.0e-5}, CENTRAL_FOURTH),
                              ("beam", {"bearing%assembly_interference": 3.0e-4}, CENTRAL),
                              ("shell", {"top_foil%free_radius": 3.0e-6, "top_foil%thickness": 1.0e-4,
                                         "bearing%assembly_interference": 3.0e-4}, CENTRAL)):
        check_differences(checks, folder, f"{foil}s", pressed_foils(foil), keys, sides=sides)


def check_same(checks, folder):
    """Two ranks, and a run that is killed and goes on."""
    one, two = (solve(folder, "ranks", pressed_foils("shell"), ranks) for ranks in (1, 2))
    off, name = summary_difference(one, two, SMALL_SIZES | {"torque_x": 1.0, "torque_y": 1.0, "torque_x_without_suction": 1.0,
                                                            "torque_y_without_suction": 1.0})
    checks.below(f"shells on two ranks ({name})", off, 1.0e-8)
    sweep = with_keys(pressed_foils("beam"), sweep={"parameter": "load", "values": (14.0, 13.5, 13.0, 12.5, 12.0, 11.5, 11.0)},
                      output={"restart_every": 1})
    check_kills(checks, folder, "assembly", sweep, random.Random(20201))


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_cantilever(checks, folder)
        check_sprung(checks, folder)
        check_interference(checks, folder)
        check_derivatives(checks, folder)
        check_same(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
