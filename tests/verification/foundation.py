#!/usr/bin/env python3
"""Elastic foundation: a full ring on springs against an independent solution, and its limits.

The ring has H = 1 + eps cos(theta) + a (P - 1) with a = p_a/(K C) = 1, Lambda = 1, L/D = 1, the springs
feeling the local pressure.
"""

import math
import tempfile

import numpy

from gfb_run import Bearing, Checks, largest_difference, natural_sizes, observed_order, run, solve, summary_difference

MESHES = ((104, 32), (208, 64), (416, 128))
TABLE = ((0.3, 0.38587, 55.695), (0.6, 0.77126, 43.548))  # eps, W/(p_a R^2), attitude angle [deg]
FORCE = 1.0e-3      # relative, on the finest mesh
ATTITUDE = 0.05     # degrees, on the finest mesh
ORDER = (1.8, 2.2)  # from three meshes among themselves: the table's five digits end too early for it
RING = Bearing(leading_edge_condition="periodic")


def on_springs(stiffness, pressure="local"):
    """Keys of a foundation."""
    return {"foil": "elastic_foundation",
            "groups": {"model": {"foundation_stiffness": stiffness, "foundation_pressure": pressure}}}


def check_table(checks, folder):
    stiffness = RING.ambient_pressure/RING.clearance
    for eps, force, attitude in TABLE:
        forces = []
        for mesh in MESHES:
            answer = run(folder, "ring", RING, mesh=mesh, number=1.0,
                         eccentricity=(eps*RING.clearance, 0.0), **on_springs(stiffness))
            forces.append(math.hypot(*answer.force)/(RING.ambient_pressure*RING.radius**2))
        checks.below(f"a = 1, eps {eps:g}: force", forces[-1]/force - 1.0, FORCE)
        checks.below(f"a = 1, eps {eps:g}: attitude angle", answer["attitude_angle"] - attitude, ATTITUDE)
        checks.within(f"a = 1, eps {eps:g}: order",
                      observed_order(forces[0] - forces[1], forces[1] - forces[2]), *ORDER)


def check_film_file(checks, folder):
    """The written gap is the rigid one plus the written deflection, which is what the springs give."""
    bearing = Bearing()
    stiffness = 0.5*bearing.ambient_pressure/bearing.clearance
    place = (0.3*bearing.clearance, 0.4*bearing.clearance)
    for pressure in ("local", "axial_mean"):
        film = run(folder, "film", bearing, mesh=(64, 16), number=2.0, eccentricity=place,
                   **on_springs(stiffness, pressure)).film_arrays()
        angle, z = film["theta"], film["z"]
        over = film["pressure"] - bearing.ambient_pressure
        if pressure == "axial_mean":
            mean = (0.5*(over[:, 1:] + over[:, :-1])*(z[:, 1:] - z[:, :-1])).sum(axis=1)/bearing.length
            over = numpy.broadcast_to(mean[:, None], z.shape)
        rigid = bearing.clearance + place[0]*numpy.cos(angle) + place[1]*numpy.sin(angle)
        checks.below(f"{pressure}: deflection follows the springs", largest_difference(
            film["deflection"], over/stiffness), 1.0e-9)
        checks.below(f"{pressure}: gap is rigid gap and deflection", largest_difference(
            film["gap"], rigid + film["deflection"]), 1.0e-12)


def check_stiff(checks, folder):
    """Very stiff springs leave the rigid bearing."""
    bearing = Bearing()
    operation = {"mesh": (104, 16), "number": 2.0, "load": (-0.5*bearing.force_unit, 0.1*bearing.force_unit)}
    rigid = run(folder, "rigid", bearing, **operation)
    for pressure in ("local", "axial_mean"):
        stiff = run(folder, "stiff", bearing, **operation,
                    **on_springs(1.0e10*bearing.ambient_pressure/bearing.clearance, pressure))
        difference, name = summary_difference(rigid, stiff, natural_sizes(bearing))
        checks.below(f"very stiff, {pressure}: equals rigid ({name})", difference, 1.0e-8)


def check_mean(checks, folder):
    """Where the pressure hardly varies along the axis, its mean and itself deflect the springs alike."""
    differences = []
    for length in (0.4, 1.6):  # long against the diameter: edges count less
        bearing = Bearing(length=length)
        forces = []
        for pressure in ("local", "axial_mean"):
            answer = run(folder, "long", bearing, mesh=(64, 128), number=1.0,
                         eccentricity=(0.5*bearing.clearance, 0.0),
                         **on_springs(bearing.ambient_pressure/bearing.clearance, pressure))
            forces.append(math.hypot(*answer.force))
        differences.append(abs(forces[1]/forces[0] - 1.0))
    checks.below("long bearing: mean and local pressure agree", differences[1], 1.0e-2)
    checks.below("four times as long: half the difference at most", differences[1]/differences[0], 0.5)


def check_large_deflection(checks, folder):
    """Springs that deflect by much of the bumps' height: the log says so, and not of stiffer ones."""
    for stiffness, warned in ((2.0e9, True), (2.0e10, False)):
        answer = solve(folder, "soft", {
            "bearing": {"radius": 0.02, "length": 0.04, "clearance": 3.0e-5},
            "gas": {"viscosity": 1.95e-5, "ambient_pressure": 101325.0},
            "operation": {"speed_rpm": 30000.0, "load": (-100.0, 0.0)},
            "bump_foil": {"height": 1.0e-4},
            "model": {"foil": "elastic_foundation", "foundation_stiffness": stiffness, "foundation_pressure": "axial_mean"},
            "mesh": {"circumferential_elements": 32, "axial_elements": 4}})
        checks.that(f"springs of {stiffness:g} N/m^3: a warning is{'' if warned else ' not'} given",
                    ("% of the bump height: displacements were taken to be small" in answer.log) == warned)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_table(checks, folder)
        check_film_file(checks, folder)
        check_stiff(checks, folder)
        check_mean(checks, folder)
        check_large_deflection(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
