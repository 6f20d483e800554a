#!/usr/bin/env python3
"""Tilted shafts: angular stiffness by closed forms and by differences, odd torques, rotations, touch-down.

A concentric ring has a closed form. With zeta = z/R, Lambda, l = L/(2 R) and a = p_a/(K C), the compliance of springs
that feel the local pressure (a = 0 for a rigid ring, and where springs feel the axial mean, which a tilt leaves as
it is), the pressure of a small tilt is p_a R/C times the real part of g(zeta) exp(i theta), with

    g'' - s^2 g = i Lambda zeta,  g(+-l) = 0,  s^2 = 1 + i Lambda (1 + a).
"""

import cmath
import math
import tempfile

import numpy

import beam_bearing
import shell_bearing
from gfb_run import Bearing, Checks, observed_order, run
from shell_bearing import BEARING, INSIDE, LOAD, SPEED

ORDER = (1.9, 2.1)
RING = Bearing(leading_edge_condition="periodic")
NUMBER = 3.0               # Lambda of the rings
MESHES = ((64, 12), (128, 24), (256, 48))
TILT = 1.0e-4              # rad
STEPS = {"rigid": (8.0e-6, 4.0e-6), "foundation": (8.0e-6, 4.0e-6),  # of the differences; with contacts small
         "beam": (2.0e-6, 1.0e-6), "shell": (2.0e-6, 1.0e-6)}        # against what changes their state
SPRINGS = {"foundation_stiffness": 3.0e9, "foundation_pressure": "local"}
ENDS = {**INSIDE, "axial_elements": 4, "arc_elements": 4}  # for shells where any mesh will do
PAIRS = [(torque, tilt) for torque in "xy" for tilt in "xy"]


def rigid(folder, name, **case):
    """The reference bearing with a rigid pad."""
    return run(folder, name, BEARING, mesh=(64, 12), **adapted(case, LOAD))


def foundation(folder, name, **case):
    """On springs, under a load that leaves room for tilts."""
    case = adapted(case, (-30.0, 0.0))
    case["groups"].setdefault("model", {}).update(SPRINGS)
    return run(folder, name, BEARING, mesh=(64, 12), foil="elastic_foundation", **case)


def adapted(case, load):
    """Groups as the beams' and shells' cases have them, for bearings without foils."""
    case = dict(case)
    groups = {name: keys for name, keys in case.items() if name not in ("ranks", "status")}
    for name in groups:
        del case[name]
    return {**case, "groups": groups, "load": load, "speed_rpm": SPEED}


def beam(folder, name, **case):
    """On beams."""
    return beam_bearing.beams(folder, name, mesh=INSIDE, **case)


def shell(folder, name, mesh=INSIDE, **case):
    """On shells."""
    return shell_bearing.solve(folder, name, mesh=mesh, **case)


FOILS = {"rigid": rigid, "foundation": foundation, "beam": beam, "shell": shell}


def sweep(axis, values, hold):
    """Group of a sweep of tilt."""
    return {"parameter": f"tilt_{axis}", "values": tuple(values), "hold_position": hold}


def matrix(numbers, place=None):
    """Angular stiffness from a summary, or from a row of a history: torques by tilts."""
    found = [numbers[f"angular_stiffness_{torque}{tilt}"] for torque, tilt in PAIRS]
    return numpy.array([value if place is None else value[place] for value in found]).reshape(2, 2)


def ring_stiffness(compliance):
    """Angular stiffness of a concentric ring over p_a R^4/C: (xy, yy)."""
    half = 0.5*RING.length/RING.radius
    root = cmath.sqrt(1.0 + 1.0j*NUMBER*(1.0 + compliance))
    moment = 2.0*(half*cmath.cosh(root*half)/root - cmath.sinh(root*half)/root**2)
    total = -1.0j*NUMBER/root**2*(2.0*half**3/3.0 - half*moment/cmath.sinh(root*half))
    return -math.pi*total.imag, -math.pi*total.real


def check_ring(checks, folder):
    """The closed form of a concentric ring, with the order of the film's elements."""
    unit = RING.ambient_pressure*RING.radius**4/RING.clearance
    stiffness = RING.ambient_pressure/RING.clearance
    foils = {"rigid": ("rigid", {}, 0.0),
             "springs, local pressure": ("elastic_foundation", {"foundation_pressure": "local"}, 1.0),
             "springs, mean pressure": ("elastic_foundation", {"foundation_pressure": "axial_mean"}, 0.0)}
    for words, (foil, model, compliance) in foils.items():
        wanted = numpy.array(ring_stiffness(compliance))*unit
        found, errors = [], []
        for mesh in MESHES:
            model = model and {**model, "foundation_stiffness": stiffness}
            ring = matrix(run(folder, "ring", RING, mesh=mesh, number=NUMBER, foil=foil, eccentricity=(0.0, 0.0),
                              groups={"model": model, "sweep": sweep("y", (0.0,), False)}))/numpy.abs(wanted).max()
            checks.below(f"ring, {words}, {mesh[0]} x {mesh[1]}: the same about x and y", max(
                abs(ring[0, 0] - ring[1, 1]), abs(ring[0, 1] + ring[1, 0])), 1.0e-10)
            found.append(ring[:, 1])
            errors.append(numpy.abs(ring[:, 1] - wanted/numpy.abs(wanted).max()).max())
        limit = found[-1] + (found[-1] - found[-2])/3.0
        checks.below(f"ring, {words}: closed form, extrapolated", numpy.abs(
            limit - wanted/numpy.abs(wanted).max()).max(), 1.0e-4)
        checks.within(f"ring, {words}: order", observed_order(*errors[-2:]), *ORDER)


def check_turned(checks, folder):
    """A ring that is turned with its shaft has the turned angular stiffness."""
    place = 0.6*RING.clearance
    for words, (foil, model) in {"rigid": ("rigid", {}), "springs": (
            "elastic_foundation", {"foundation_stiffness": RING.ambient_pressure/RING.clearance,
                                   "foundation_pressure": "local"})}.items():
        found = []
        for angle in (0.0, 2.0*math.pi*5.0/64.0):
            found.append(matrix(run(
                folder, "turned", RING, mesh=(64, 12), number=NUMBER, foil=foil,
                eccentricity=(place*math.cos(angle), place*math.sin(angle)),
                groups={"model": model, "sweep": sweep("x", (0.0,), False)})))
        turn = numpy.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        checks.below(f"turned ring, {words}: turned stiffness", numpy.abs(
            turn @ found[0] @ turn.T - found[1]).max()/numpy.abs(found[0]).max(), 1.0e-10)
        checks.that(f"turned ring, {words}: no turn would be another", numpy.abs(
            found[0] - found[1]).max() > 0.01*numpy.abs(found[0]).max())


def check_rest(checks, folder):
    """Without speed no tilt has a torque."""
    answer = run(folder, "rest", RING, mesh=(64, 12), eccentricity=(0.0, 0.0),
                 groups={"sweep": sweep("x", (TILT,), False)})
    unit = RING.ambient_pressure*RING.radius**4/RING.clearance
    checks.below("at rest: angular stiffness", numpy.abs(matrix(answer)).max()/unit, 1.0e-12)
    checks.below("at rest: torque", numpy.abs(answer.torque).max()/(unit*TILT), 1.0e-12)


def check_sweeps(checks, folder):
    """Odd torques, slopes by differences, secants; held and balanced; what the names say."""
    for words, solver in FOILS.items():
        steps = STEPS[words]
        values = sorted([-TILT, 0.0, TILT] + [centre + sign*step for centre in (0.0, TILT) for sign in (-1, 1)
                                              for step in steps])
        slopes = {}
        # Of shells, each kind of sweep and each axis once.
        for hold, axis in [(True, "x"), (False, "y"), *([] if words == "shell" else [(True, "y"), (False, "x")])]:
            kind = f"{words}, {'held' if hold else 'balanced'}, tilt_{axis}"
            answer = solver(folder, "sweep", sweep=sweep(axis, values, hold))
            rows = answer.history()
            check_odd(checks, kind, rows, axis, steps)
            slopes[hold, axis] = check_slopes(checks, kind, rows, axis, steps)
            check_secants(checks, kind, rows, axis)
            if hold:
                check_held(checks, kind, answer, rows, words in ("beam", "shell"))
        size = numpy.abs(slopes[True, "x"]).max()
        worst = max(numpy.abs(slope - slopes[True, "x"]).max() for slope in slopes.values())
        # The force that a tilt changes is even in it: to first order a load needs no other position.
        checks.below(f"{words}: without tilt one stiffness, held or balanced, from all sweeps", worst/size, 1.0e-8)


def place_of(rows, axis, value):
    """Row with a tilt."""
    return int(numpy.argmin(numpy.abs(rows[f"tilt_{axis}"] - value)))


def torques(rows):
    """Torques (2, rows)."""
    return numpy.array([rows["torque_x"], rows["torque_y"]])


def check_odd(checks, kind, rows, axis, steps):
    """Torques of opposite tilts, of which the history has several."""
    torque, tilt = torques(rows), rows[f"tilt_{axis}"]
    size = numpy.abs(torque).max()
    worst = 0.0
    for value in (TILT, *steps):
        two = [place_of(rows, axis, sign*value) for sign in (1, -1)]
        checks.that(f"{kind}: tilts of {value:g} are opposite", tilt[two[0]] == -tilt[two[1]])
        worst = max(worst, numpy.abs(torque[:, two[0]] + torque[:, two[1]]).max()/size)
    checks.below(f"{kind}: torque is odd", worst, 1.0e-8)
    checks.below(f"{kind}: no torque without tilt", numpy.abs(
        torque[:, place_of(rows, axis, 0.0)]).max()/size, 1.0e-8)
    checks.that(f"{kind}: restores", torque["xy".index(axis), place_of(rows, axis, TILT)] > 0.0)


def check_slopes(checks, kind, rows, axis, steps):
    """Slopes are what central differences go to, with their order; returns that without tilt."""
    torque, tilt, column = torques(rows), rows[f"tilt_{axis}"], "xy".index(axis)
    for centre in (0.0, TILT):
        slope = matrix(rows, place_of(rows, axis, centre))[:, column]
        size = numpy.abs(slope).max()
        off = []
        for step in steps:
            high, low = place_of(rows, axis, centre + step), place_of(rows, axis, centre - step)
            off.append((torque[:, high] - torque[:, low])/(tilt[high] - tilt[low])/size - slope/size)
        checks.within(f"{kind} at {centre:g}: order of the differences", observed_order(
            *(numpy.abs(one).max() for one in off)), *ORDER)
        checks.below(f"{kind} at {centre:g}: slope, differences extrapolated", numpy.abs(
            off[1] + (off[1] - off[0])/3.0).max(), 1.0e-7)
    return matrix(rows, place_of(rows, axis, 0.0))


def check_secants(checks, kind, rows, axis):
    """Secants are torques over tilts, and the slope where there is no tilt."""
    torque, tilt, column = torques(rows), rows[f"tilt_{axis}"], "xy".index(axis)
    secant = numpy.array([rows["secant_stiffness_x"], rows["secant_stiffness_y"]])
    none = place_of(rows, axis, 0.0)
    checks.that(f"{kind}: secant without tilt is the slope", numpy.array_equal(
        secant[:, none], matrix(rows, none)[:, column]))
    tilted = numpy.abs(tilt) >= TILT
    wanted = torque[:, tilted]/tilt[tilted]
    checks.below(f"{kind}: secants", numpy.abs(secant[:, tilted] - wanted).max()/numpy.abs(wanted).max(), 1.0e-8)


def check_held(checks, kind, answer, rows, foils):
    """The summary says at which equilibrium the shaft is held, and has the slope there."""
    load = numpy.array([answer["held_force_x"], answer["held_force_y"]])
    wanted = numpy.array((-30.0, 0.0) if "foundation" in kind else LOAD)
    checks.below(f"{kind}: held where the load is carried", numpy.abs(load - wanted).max()/abs(wanted[0]), 1.0e-10)
    places = numpy.array([rows["eccentricity_x"], rows["eccentricity_y"]])
    checks.that(f"{kind}: held at one place", numpy.ptp(places, axis=1).max() == 0.0)
    none = int(numpy.argmin(numpy.abs(rows["tilt_" + kind[-1]])))
    checks.below(f"{kind}: slope of the summary", numpy.abs(matrix(answer) - matrix(rows, none)).max()
                 / numpy.abs(matrix(answer)).max(), 1.0e-8)
    for name in ("leading_edge_lift", "leading_edge_lift_edge", "lifted_length"):
        checks.that(f"{kind}: held_{name}", (f"held_{name}" in answer.summary) == foils)
        if foils and name != "lifted_length":
            checks.below(f"{kind}: held_{name}", (answer[f"held_{name}"] - rows[name][none])/BEARING.clearance, 1.0e-8)


def check_crossed(checks, folder):
    """Where the other tilt is not zero, the secant counts from the torque it has; without that there is none."""
    other = {"operation": {"tilt": (0.0, TILT)}}
    answer = beam(folder, "crossed", **other, sweep=sweep("x", (0.0, TILT), True))
    rows = answer.history()
    wanted = (torques(rows)[:, 1] - torques(rows)[:, 0])/TILT
    found = numpy.array([rows["secant_stiffness_x"][1], rows["secant_stiffness_y"][1]])
    checks.below("other tilt: secants", numpy.abs(found - wanted).max()/numpy.abs(wanted).max(), 1.0e-6)
    checks.that("other tilt: it has a torque", abs(torques(rows)[1, 0]) > 0.1*abs(torques(rows)[1, 1]))
    rows = beam(folder, "crossed", **other, sweep=sweep("x", (0.5*TILT, TILT), False)).history()
    checks.that("other tilt, never without the one swept: no secant", "secant_stiffness_x" not in rows)
    checks.that("other tilt, never without the one swept: a slope", "angular_stiffness_xx" in rows)


def check_same(checks, folder):
    """Ranks, and film and foils in turns, change nothing."""
    values = (0.0, TILT, 2.0*TILT)
    for words, solver in (("beam", beam), ("shell", shell)):
        base = solver(folder, "base", sweep=sweep("y", values, True))
        compare(checks, f"{words}, 2 ranks", base, solver(folder, "ranks", ranks=2, sweep=sweep("y", values, True)))
    turns = {"model": {"coupling": "partitioned"}}
    compare(checks, "beam, in turns", beam(folder, "base", sweep=sweep("x", values, True)),
            beam(folder, "turns", **turns, sweep=sweep("x", values, True)))


def compare(checks, words, one, other):
    """Torques, slopes and secants of two histories."""
    first, second = one.history(), other.history()
    for names in ("torque", "angular_stiffness", "secant_stiffness"):
        columns = [name for name in first if name.startswith(names) and "suction" not in name]
        size = max(numpy.abs(first[name]).max() for name in columns)
        checks.below(f"{words}: {names}", max(
            numpy.abs(first[name] - second[name]).max() for name in columns)/size, 1.0e-8)


def ending(answer, hold):
    """Why a sweep about y ended, and the last tilt it reached; nothing where the log does not say it in these words."""
    opening = "no answer found with the shaft fixed: " if hold else "no equilibrium found: "
    reason = [line[len(opening):] for line in answer.log.splitlines() if line.startswith(opening)]
    last = [line for line in answer.log.splitlines() if line.startswith("last state reached: ") and "tilt (0, " in line]
    return "".join(reason), float(last[0].split("tilt (0, ")[1].split(")")[0]) if last else math.nan


def check_ends(checks, folder):
    """A sweep ends where the shaft touches or answers fold, says so, and keeps the points before."""
    touch, fold = "the shaft touches down: ", "the branch of answers ends in a fold: "
    cases = [(words, 1.6e-3, None, touch, (True, False)) for words in FOILS]
    cases += [("beam", 1.6e-3, -40.0, fold, (True, False)), ("shell", 1.6e-3, -45.0, fold, (False,))]
    for words, end, load, wanted, holds in cases:
        for hold in holds:
            kind = f"{words}, {'held' if hold else 'balanced'}{f', {load} N' if load else ''}, to the end"
            values = (0.0, TILT, 2.0*TILT, end)
            operation = {"operation": {"load": (load, 0.0)}} if load else {}
            if words == "shell":
                operation["mesh"] = ENDS
            answer = FOILS[words](folder, "end", status=2, sweep=sweep("y", values, hold), **operation)
            reason, reached = ending(answer, hold)
            checks.that(f"{kind}: {reason}", reason.startswith(wanted))
            checks.within(f"{kind}: last tilt", reached, values[2], values[3])
            rows = answer.history()
            checks.that(f"{kind}: points before are kept", list(rows["tilt_y"]) == list(values[:3]))
            checks.that(f"{kind}: with their stiffness", bool(numpy.all(rows["angular_stiffness_yy"] > 0.0)))
            checks.that(f"{kind}: numbers", all(map(math.isfinite, answer.physical().values())))
            if wanted == touch:
                checks.within(f"{kind}: smallest film over C", answer["minimum_gap"]/BEARING.clearance, 0.0, 1.0e-3)
            if hold and words == "rigid":
                contact = min(tilt_of_contact(answer.eccentricity, sign*0.5*BEARING.length) for sign in (1, -1))
                checks.below(f"{kind}: where the cylinders touch", reached/contact - 1.0, 1.0e-3)


def tilt_of_contact(place, end):
    """Tilt about y at which a shaft at a place touches a rigid sleeve at z = end: |e + (z tilt, 0)| = C."""
    return (-place[0] + math.copysign(math.sqrt(BEARING.clearance**2 - place[1]**2), end))/end


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_ring(checks, folder)
        check_turned(checks, folder)
        check_rest(checks, folder)
        check_sweeps(checks, folder)
        check_crossed(checks, folder)
        check_same(checks, folder)
        check_ends(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
