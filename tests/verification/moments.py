#!/usr/bin/env python3
"""Forces, torques and friction of the written film by quadrature of our own, and their balance.

The film is at rest as a whole, so the torque of its shear on the shaft less that on the sleeve is the
moment of the pressures about the shaft's centre. With the shear (2 mu U/h +- (h/2) dp/dx) at the two
surfaces, the difference is R times the integral of h dp/dx; by parts, with p = p_a at the ends of the pad,
and with the derivative of the rigid gap by theta,

    T_shaft - T_sleeve = e_x F_y - e_y F_x + tilt_y M_x - tilt_x M_y.

With a rigid foil the gap is exact at the Gauss points, so this holds to their quadrature: fourth order.
"""

import math
import tempfile

import numpy

from gfb_run import Bearing, Checks, natural_sizes, observed_order, run

ROUND_OFF = 1.0e-10
MESHES = ((64, 16), (128, 32), (256, 64))
GAUSS = 0.5 + numpy.array([-0.5, 0.5])/math.sqrt(3.0)


def at_points(field):
    """A nodal field at the 2 x 2 Gauss points of all cells: (stations - 1, rows - 1, 2, 2)."""
    s = GAUSS[:, None]*numpy.ones(2)
    t = GAUSS[None, :]*numpy.ones((2, 1))
    corners = field[:-1, :-1], field[1:, :-1], field[1:, 1:], field[:-1, 1:]
    weights = (1.0 - s)*(1.0 - t), s*(1.0 - t), s*t, (1.0 - s)*t
    return sum(corner[..., None, None]*weight for corner, weight in zip(corners, weights))


def slope(field, x):
    """Derivative along x at the same points."""
    t = GAUSS[None, :]*numpy.ones((2, 1))
    rise = (field[1:] - field[:-1])/(x[1:] - x[:-1])
    return rise[:, :-1, None, None]*(1.0 - t) + rise[:, 1:, None, None]*t


def rigid_gap(bearing, eccentricity, tilt, angle, height):
    """Gap of a shaft in an undeformed sleeve."""
    return (bearing.clearance + (eccentricity[0] + height*tilt[1])*numpy.cos(angle)
            + (eccentricity[1] - height*tilt[0])*numpy.sin(angle))


def integrals(bearing, film, speed_rpm, eccentricity, tilt):
    """Force (2), torque (2), friction torque on the shaft and on the sleeve, by 2 x 2 points a cell.

    Between the nodes the foil's deflection is bilinear; the rigid gap is what it is.
    """
    x, z = film["x"], film["z"]
    area = ((x[1:, :-1] - x[:-1, :-1])*(z[:-1, 1:] - z[:-1, :-1])/4.0)[..., None, None]
    pressure = at_points(film["pressure"]) - bearing.ambient_pressure
    height, angle = at_points(z), at_points(x)/bearing.radius
    deflection = film["gap"] - rigid_gap(bearing, eccentricity, tilt, x/bearing.radius, z)
    gap = at_points(deflection) + rigid_gap(bearing, eccentricity, tilt, angle, height)
    entraining = 0.5*bearing.radius*speed_rpm*math.pi/30.0
    couette = 2.0*bearing.viscosity*entraining/gap
    poiseuille = 0.5*gap*slope(film["pressure"], x)
    total = [(area*integrand).sum() for integrand in (
        pressure*numpy.cos(angle), pressure*numpy.sin(angle), pressure*height*numpy.sin(angle),
        -pressure*height*numpy.cos(angle), bearing.radius*(couette + poiseuille),
        bearing.radius*(couette - poiseuille))]
    return numpy.array(total[:2]), numpy.array(total[2:4]), total[4], total[5]


def check_written(checks, folder, name, bearing, **case):
    """Summary and film file tell the same, and the moments balance with fourth order."""
    sizes = natural_sizes(bearing)
    errors = []
    for mesh in MESHES:
        answer = run(folder, name, bearing, mesh=mesh, number=3.0, **case)
        e, tilt = answer.eccentricity, case.get("tilt", (0.0, 0.0))
        force, torque, shaft, sleeve = integrals(bearing, answer.film_arrays(), bearing.speed_rpm(3.0), e, tilt)
        moment = e[0]*force[1] - e[1]*force[0] + tilt[1]*torque[0] - tilt[0]*torque[1]
        errors.append((shaft - sleeve)/moment - 1.0)
    checks.below(f"{name}: force of the summary", numpy.abs(force - answer.force).max()/sizes["force_x"], ROUND_OFF)
    checks.below(f"{name}: torque of the summary", numpy.abs(torque - answer.torque).max()/sizes["torque_x"], ROUND_OFF)
    checks.below(f"{name}: friction torque of the summary", shaft/answer["friction_torque"] - 1.0, ROUND_OFF)
    checks.below(f"{name}: power loss", answer["power_loss"]/(
        shaft*bearing.speed_rpm(3.0)*math.pi/30.0) - 1.0, ROUND_OFF)
    checks.below(f"{name}: balance of moments", errors[-1], 1.0e-6)
    checks.within(f"{name}: order of the balance", observed_order(errors[-2], errors[-1]), 3.8, 4.2)


def check_suction(checks, folder):
    """Without suction only the pressure above ambient counts."""
    bearing = Bearing()
    answer = run(folder, "suction", bearing, mesh=MESHES[-1], number=3.0,
                 eccentricity=(0.4*bearing.clearance, 0.0), tilt=(2.0e-4, 1.0e-4))
    film = answer.film_arrays()
    film["pressure"] = numpy.maximum(film["pressure"], bearing.ambient_pressure)
    torque = integrals(bearing, film, 0.0, answer.eccentricity, (2.0e-4, 1.0e-4))[1]
    found = numpy.array([answer[f"torque_{axis}_without_suction"] for axis in "xy"])
    # Cells that hold the line p = p_a are cut at points here and at corners there.
    checks.below("torque without suction", numpy.abs(torque/found - 1.0).max(), 2.0e-3)
    checks.that("suction matters", numpy.abs(found/answer.torque - 1.0).max() > 0.05)
    checks.that("suction was there", answer["minimum_pressure"] < 0.99*bearing.ambient_pressure)


def check_rest(checks, folder):
    """Without speed there is no pressure, no force, no friction."""
    bearing = Bearing()
    answer = run(folder, "rest", bearing, mesh=(64, 16), eccentricity=(0.9*bearing.clearance, 0.0))
    checks.below("at rest: force", numpy.abs(answer.force).max()/bearing.force_unit, 1.0e-14)
    checks.that("at rest: friction and loss", answer["friction_torque"] == 0.0 and answer["power_loss"] == 0.0)
    checks.below("at rest: pressure", answer["maximum_pressure"]/bearing.ambient_pressure - 1.0, 1.0e-14)
    checks.that("at rest: no attitude angle", "attitude_angle" not in answer.summary)
    centred = run(folder, "centred", bearing, mesh=(64, 16), number=1.0, eccentricity=(0.0, 0.0))
    speed = 0.5*bearing.radius*bearing.speed_rpm(1.0)*math.pi/30.0
    couette = 2.0*bearing.viscosity*speed/bearing.clearance*2.0*math.pi*bearing.radius**2*bearing.length
    checks.below("centred: Petroff's friction", centred["friction_torque"]/couette - 1.0, 1.0e-12)


def check_load(checks, folder):
    """A balanced film carries the load."""
    bearing = Bearing()
    stiffness = 2.0*bearing.ambient_pressure/bearing.clearance
    foils = {"rigid": {}, "local": {"foundation_pressure": "local"}, "mean": {"foundation_pressure": "axial_mean"}}
    for name, model in foils.items():
        foil = "elastic_foundation" if model else "rigid"
        keys = {**model, "foundation_stiffness": stiffness} if model else {}
        for load in ((-0.5, 0.15), (0.02, -0.4), (0.0, 0.3)):
            wanted = numpy.array(load)*bearing.force_unit
            answer = run(folder, "load", bearing, mesh=(96, 16), number=4.0, load=tuple(wanted), foil=foil,
                         groups={"model": keys})
            checks.below(f"{name}: force is the load {load}", numpy.abs(
                answer.force - wanted).max()/numpy.hypot(*wanted), ROUND_OFF)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        pad, ring = Bearing(), Bearing(leading_edge_condition="periodic")
        place = (0.5*pad.clearance, -0.3*pad.clearance)
        check_written(checks, folder, "pad", pad, eccentricity=place)
        check_written(checks, folder, "ring", ring, eccentricity=place)
        check_written(checks, folder, "tilted", pad, eccentricity=place, tilt=(2.0e-4, -1.0e-4))
        check_written(checks, folder, "upwind", pad, eccentricity=place, groups={"model": {"film_scheme": "supg"}})
        check_suction(checks, folder)
        check_rest(checks, folder)
        check_load(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
