#!/usr/bin/env python3
"""Sweeps whose friction remembers: points as steps of one loading, in bearings of beams and of shells."""

import math
import tempfile

import h5py
import numpy

from gfb_run import Checks, largest_difference, summary_difference
from shell_bearing import BEARING, SIZES, displacement, solve

MESH = {"circumferential_elements": 104, "axial_elements": 4, "arc_elements": 8, "flat_elements": 2,
        "align_crests": True}
FOILS = ("beam", "shell")
FRICTION = 0.1
STICK = 1.0e-7             # stick length [m]
DRAG = 3.0                 # slip that is carried along, at most, over the stick length
UP_AND_DOWN = (100.0, 125.0, 150.0, 125.0, 100.0)


def sweep(folder, name, foil, values, memory=True, parameter="load", held=False, model=None, mesh=None, **groups):
    """A sweep of a bearing with friction at crests and corners."""
    keys = {"parameter": parameter, "values": values, "friction_memory": memory, "hold_position": held}
    contact = {"friction_top": FRICTION, "friction_sleeve": FRICTION, "stick_length": STICK}
    return solve(folder, name, mesh=MESH | (mesh or {}), model={"foil": foil, **(model or {})}, sweep=keys,
                 contact={**contact, **groups.pop("contact", {})}, **groups)


NO_ANSWER = ("load", "tilt_x", "newton_iterations", "factorizations")  # what the sweep changes, what was counted


def row(history, point):
    """A point's numbers, those of the answer alone."""
    return {name: values[point] for name, values in history.items()
            if values.dtype.kind == "f" and name not in NO_ANSWER}


def rows_difference(first, second):
    """Largest difference of two points' numbers, relative or over their natural sizes."""
    worst = (0.0, "all")
    for name, value in first.items():
        size = SIZES.get(name, max(abs(value), abs(second[name])))
        worst = max(worst, (abs(value - second[name])/size if size > 0.0 else 0.0, name))
    return worst


def check_hysteresis(checks, folder):
    """Up and down: every point for itself comes back, points that remember do not."""
    for foil in FOILS:
        alone = sweep(folder, "alone", foil, UP_AND_DOWN, memory=False).history()
        joined = sweep(folder, "joined", foil, UP_AND_DOWN).history()
        for point in (0, 1):
            difference, name = rows_difference(row(alone, point), row(alone, -1 - point))
            checks.below(f"{foil}: without memory {UP_AND_DOWN[point]:.0f} N up and down agree ({name})",
                         difference, 1.0e-8)
        difference, name = rows_difference(row(alone, 0), row(joined, 0))
        checks.below(f"{foil}: the first point has nothing to remember ({name})", difference, 1.0e-8)
        place = joined["eccentricity_x"]/BEARING.clearance
        for point in (0, 1):
            # Friction that held the foils up while they were loaded holds them down while they are let go.
            checks.within(f"{foil}: with memory e_x/C at {UP_AND_DOWN[point]:.0f} N, down less up",
                          place[-1 - point] - place[point], 0.01, 0.2)


def check_friction_off(checks, folder):
    """The less friction, the less there is to remember."""
    opening = []
    for friction in (1.0e-3, 1.0e-5):
        place = sweep(folder, "little", "shell", (100.0, 150.0, 100.0), contact={
            "friction_top": friction, "friction_sleeve": friction}).history()["eccentricity_x"]/BEARING.clearance
        opening.append(place[-1] - place[0])
    checks.within("friction of 0.001: loop opens by C times", opening[0], 1.0e-5, 5.0e-3)
    checks.within("friction of 0.00001: loop opens less, by the friction's ratio", opening[0]/opening[1], 90.0, 110.0)


def line_nodes(points, place):
    """Nodes of a surface that stand at given (x, z)."""
    found = [int(numpy.argmin(numpy.hypot(points[:, 0] - x, points[:, 2] - z))) for x, z in place]
    assert numpy.abs(points[found][:, [0, 2]] - place).max() < 1.0e-9
    return found


def contacts_of(run):
    """Corner and crest contacts after the last point: place, way, slip, friction, normal force, state."""
    with h5py.File(f"{run.stem}.bump_foil.vtkhdf", "r") as file:
        bumps = file["VTKHDF/Points"][...]
    with h5py.File(f"{run.stem}.top_foil.vtkhdf", "r") as file:
        top = file["VTKHDF/Points"][...]
    found = {}
    with h5py.File(f"{run.stem}.h5", "r") as file:
        for surface, group in file["contact"].items():
            there = group["line"][...] > 0.0
            place = numpy.stack([group["position_x"][there], group["position_z"][there]], 1)
            way = displacement(run, "bump_foil")[line_nodes(bumps, place)][:, [0, 2]]
            if surface == "top":
                way = way - displacement(run, "top_foil")[line_nodes(top, place)][:, [0, 2]]
            found[surface] = {"way": way, "pressing": group["normal_force"][-1][there]}
            for name in ("slip", "friction"):
                found[surface][name] = numpy.stack([group[f"{name}_{axis}"][-1][there] for axis in "xz"], 1)
    return found


def carried(slip, pressing):
    """What a contact takes along of its slip: what fits into the law's rise; nothing where it is open."""
    length = numpy.maximum(numpy.linalg.norm(slip, axis=1), 1.0e-30)
    return slip*(numpy.minimum(1.0, DRAG*STICK/length)*(pressing > 0.0))[:, None]


def check_rule(checks, folder):
    """Slips of three points against the displacements of the foils, and friction against the slips."""
    values = (100.0, 150.0, 60.0)
    for foil in FOILS:
        points = [contacts_of(sweep(folder, "rule", foil, values[:count])) for count in (1, 2, 3)]
        for surface in ("sleeve", "top"):
            memory = numpy.zeros_like(points[0][surface]["way"])
            before = numpy.zeros_like(memory)
            for load, point in zip(values, (one[surface] for one in points)):
                closed = point["pressing"] > 1.0e-3*point["pressing"].max()
                expected = memory + point["way"] - before
                checks.below(f"{foil}, {surface}, {load:.0f} N: slip in {numpy.count_nonzero(closed)} contacts over C",
                             numpy.abs(expected - point["slip"])[closed].max()/BEARING.clearance, 1.0e-9)
                length = numpy.linalg.norm(point["slip"], axis=1)[closed]
                force = -FRICTION*(point["pressing"][closed]*numpy.tanh(length/STICK)/length)[:, None]
                checks.below(f"{foil}, {surface}, {load:.0f} N: friction", largest_difference(
                    force*point["slip"][closed], point["friction"][closed]), 1.0e-6)
                memory = carried(point["slip"], point["pressing"])
                before = point["way"]
        turned = [numpy.sign(one["top"]["friction"][:, 0]) for one in points[1:]]
        checks.that(f"{foil}: friction turns round at {numpy.count_nonzero(turned[0]*turned[1] < 0.0)} crests",
                    numpy.any(turned[0]*turned[1] < 0.0))


def check_same(checks, folder):
    """Coupling, ranks, width and condensation change nothing."""
    values = (100.0, 140.0, 100.0)
    for foil in FOILS:
        base = sweep(folder, "base", foil, values)
        if foil == "shell":
            others = {"whole width": {"model": {"half_width": "no"}}, "full": {"model": {"reduction": "none"}},
                      "3 ranks": {"ranks": 3}}
        else:
            others = {"partitioned": {"model": {"coupling": "partitioned"}}, "2 ranks": {"ranks": 2}}
        for words, keys in others.items():
            other = sweep(folder, "other", foil, values, **keys)
            difference, name = summary_difference(base, other, SIZES)
            checks.below(f"{foil}, {words}: last point ({name})", difference, 1.0e-8)
            first, second = base.history(), other.history()
            difference, name = max(rows_difference(row(first, point), row(second, point))
                                   for point in range(len(values)))
            checks.below(f"{foil}, {words}: all points ({name})", difference, 1.0e-8)


def check_cuts(checks, folder):
    """How the way from point to point is cut changes nothing: friction carries its slip at points alone."""
    for foil, values, aligned, limits in (("beam", (100.0, 150.0, 60.0), True, (10, 14)),
                                          ("shell", (60.0, 200.0, 60.0), False, (25,))):
        mesh = {"align_crests": aligned}
        base = sweep(folder, "base", foil, values, mesh=mesh)
        for limit in limits:
            other = sweep(folder, f"cut_{limit}", foil, values, mesh=mesh, quiet=False,
                          solver={"maximum_iterations": limit})
            told = other.log
            cuts = told[told.index("point 1 of"):].count("cut: ")
            checks.that(f"{foil}, {limit} iterations a step: {cuts} cuts between the points", cuts > 0)
            difference, name = summary_difference(base, other, SIZES)
            checks.below(f"{foil}, {limit} iterations a step ({name})", difference, 1.0e-8)


def check_points_between(checks, folder):
    """More points between the same loads: Coulomb's law comes to one answer, the smoothed one stays near its own."""
    for foil in FOILS:
        for law in ("coulomb", "tanh_drag"):
            found = []
            for between in (1, 3, 9):
                up = numpy.linspace(100.0, 150.0, between + 1)
                history = sweep(folder, "between", foil, (*up, *up[-2::-1]), contact={"friction_law": law}).history()
                found.append(history["eccentricity_x"][[0, -1]]/BEARING.clearance)
            opening = found[0][1] - found[0][0]
            first, second = numpy.diff([place[1] for place in found])
            words = f"{foil}, {law}, 1, 3, 9 points between: e_x/C changes by {first:.1e}, then"
            if law == "coulomb":
                checks.below(words, second, 1.0e-6)
            else:
                # What slides slowly is at the end of the law's rise, not above it: tanh(3) of the whole friction.
                checks.below(words, second, (1.0 - math.tanh(DRAG))*opening)


def check_other_sweeps(checks, folder):
    """A shaft that is held and tilted, or moved: there and back."""
    tilts = (0.0, 1.0e-4, 0.0, -1.0e-4, 0.0)
    for foil in FOILS:
        tilted = {memory: sweep(folder, f"tilted_{memory}", foil, tilts, memory=memory, parameter="tilt_x", held=True,
                                model={"half_width": "no"}) for memory in (False, True)}
        torque = {memory: run.history()["torque_x"] for memory, run in tilted.items()}
        slip = {}
        for memory, run in tilted.items():
            with h5py.File(f"{run.stem}.h5", "r") as file:
                closed = file["contact/top/normal_force"][0] > 0.0
                slip[memory] = numpy.abs(file["contact/top/slip_x"][0][closed]).max()/STICK
        # The equilibrium was the first step: the first tilt begins with what it has left, at the end of the law's
        # rise. The friction missing there, of the whole one, lets the foils go on by as much of their way.
        checks.that(f"{foil}, held, without memory: slip of {slip[False]:.0f} stick lengths", slip[False] > 10.0*DRAG)
        checks.within(f"{foil}, held, with memory: slip over stick length", slip[True], 0.5*DRAG,
                      DRAG + (1.0 - math.tanh(DRAG))*slip[False])
        size = numpy.abs(torque[False]).max()
        checks.below(f"{foil}, tilted and back without memory: torque at no tilt",
                     numpy.abs(torque[False][[0, 2, 4]]).max()/size, 1.0e-8)
        stays = numpy.abs(torque[True][[2, 4]]).max()/size
        if foil == "beam":
            checks.below("beam, tilted and back with memory: what is planar keeps no torque", stays, 1.0e-8)
        else:
            checks.that(f"shell, tilted and back with memory: torque that stays, {stays:.1e} of that of the tilt",
                        1.0e-4 < stays < 1.0)
        moved = {"scene": {"analysis": "fixed_position"}, "operation": {"eccentricity": (20.0e-6, 8.0e-6)}}
        values = (25.0e-6, 30.0e-6, 25.0e-6)
        force = {memory: sweep(folder, "moved", foil, values, memory=memory, parameter="eccentricity_x",
                               **moved).history()["force_x"] for memory in (False, True)}
        checks.below(f"{foil}, moved and back without memory: force", force[False][2]/force[False][0] - 1.0, 1.0e-8)
        checks.within(f"{foil}, moved and back with memory: force over that before", force[True][2]/force[True][0],
                      0.5, 0.99)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_hysteresis(checks, folder)
        check_friction_off(checks, folder)
        check_rule(checks, folder)
        check_same(checks, folder)
        check_cuts(checks, folder)
        check_points_between(checks, folder)
        check_other_sweeps(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
