#!/usr/bin/env python3
"""Heat of thrust bearings: the isothermal film, a thin film between walls, energy that closes, one pad against all, ranks, gas that
cools the bumps, plates and shells, vibrations, derivatives against differences, a load capacity that heat ends."""

import math
import tempfile

import h5py
import numpy

from gfb_run import Checks, solve
from thrust import PADS, TIGHT, coefficients, thrust
from thrust_shell import LOAD, TOP, shells

AMBIENT = 293.15
WALLS = {"ambient_temperature": AMBIENT, "shaft_conductance": 0.5, "sleeve_conductance": 2.0, "bump_conductance": 300.0}
HELD = {"ambient_temperature": AMBIENT, "shaft": "given", "shaft_temperature": AMBIENT, "sleeve": "given", "sleeve_temperature": AMBIENT,
        "top_foil": "given", "top_foil_temperature": AMBIENT}
SPRINGS = {"foil": "elastic_foundation", "foundation_stiffness": 1.0e10}
NAMES = ("axial_gap", "friction_torque", "film_temperature", "maximum_top_foil_temperature", "shaft_temperature", "inlet_temperature",
         "heat_to_shaft", "heat_to_top_foil", "heat_by_gas", "mass_flow_sides")


def heated(operation, analysis="equilibrium", model=None, thermal=None, **more):
    """Groups of a small thrust bearing with heat."""
    groups = {"thermal": thermal or WALLS, "top_foil": {"thickness": 1.5e-4}} | TIGHT
    for group, keys in more.items():
        groups[group] = groups.get(group, {}) | keys
    return thrust(operation, analysis, model or SPRINGS, **groups)


def check_limits(checks, folder):
    """Walls of ambient temperature and a gas that conducts without limit: the isothermal film. A thin film between such walls is
    warmer by mu V^2/(12 k), which grows with the radius squared."""
    plain = solve(folder, "plain", thrust(LOAD, "equilibrium", SPRINGS, **TIGHT))
    cold = solve(folder, "cold", heated(LOAD, thermal=HELD | {"prandtl": 1.0e-12}))
    for name in ("axial_gap", "friction_torque", "minimum_gap"):
        checks.below(f"isothermal: {name}", cold[name]/plain[name] - 1.0, 1.0e-9)
    flat = heated({"axial_gap": 2.0e-6, "speed_rpm": 20000.0}, "fixed_position", {"foil": "rigid"}, HELD)
    del flat["ramp"]
    thin = solve(folder, "thin", flat)
    with h5py.File(f"{thin.stem}.film.vtkhdf", "r") as file:
        radius = numpy.linalg.norm(file["VTKHDF/Points"][...][:, :2], axis=1)
        rise = file["VTKHDF/PointData/temperature"][...].ravel() - AMBIENT
    wanted = 0.71*(20000.0*math.pi/30.0*radius)**2/(12.0*1005.0)
    inside = (radius > 0.0255) & (radius < 0.0495)
    checks.below("thin film: its rise over the walls", float(numpy.median(numpy.abs(rise/wanted - 1.0)[inside])), 1.0e-3)


def check_same(checks, folder):
    """One pad stands for all, two ranks for one; energy closes, and what cools takes what it is given."""
    cooled = WALLS | {"cooling_flow": 5.0e-4, "channel_conductance": 180.0, "channel_sleeve_conductance": 0.0}
    one = solve(folder, "one", heated(LOAD, thermal=cooled))
    every = solve(folder, "every", heated(LOAD | {"tilt": (1.0e-30, 0.0)}, thermal=cooled))
    two = solve(folder, "two", heated(LOAD, thermal=cooled), ranks=2)
    checks.that("an aligned runner: one pad is solved, of a tilted one all", (one["pads_solved"], every["pads_solved"]) == (1, PADS))
    for title, other in (("one pad against all", every), ("two ranks", two)):
        for name in (*NAMES, "cooling_outlet_temperature"):
            checks.below(f"{title}: {name}", one[name]/other[name] - 1.0, 1.0e-8)
    checks.below("energy closes", one["energy_imbalance"], 1.0e-9)
    taken = 5.0e-4*1005.0*(one["cooling_outlet_temperature"] - AMBIENT)
    checks.below("the cooling gas takes what the top foil gives it", taken/one["heat_to_channel"] - 1.0, 1.0e-8)
    checks.below("the sleeve gives away what comes through the bumps", 2.0*(one["sleeve_temperature"] - AMBIENT)/one["heat_through_bumps"]
                 - 1.0, 1.0e-8)
    checks.that("cooling gas cools", one["shaft_temperature"] < solve(folder, "uncooled", heated(LOAD))["shaft_temperature"])
    moment = solve(folder, "moment", heated(LOAD | {"moment": (0.2, 0.1)}))
    checks.that("under a moment pads differ", abs(moment["film_temperature_1"] - moment["film_temperature_4"]) > 0.1)
    checks.below("under a moment energy closes", moment["energy_imbalance"], 1.0e-9)


def check_foils(checks, folder):
    """Plates and shells with heat: energy closes, and shells' film is warmer than gas that feels none of it."""
    plate = heated(LOAD, model={"foil": "plate", "crest_stiffness": 3.5e7}, top_foil=TOP, bump_foil={"crest_angles": (0.25, 0.4, 0.55, 0.7)})
    shell = shells(LOAD, thermal={name: value for name, value in WALLS.items() if name != "bump_conductance"})
    for title, groups in (("plates", plate), ("shells", shell)):
        answer = solve(folder, title, groups)
        checks.below(f"{title}: energy closes", answer["energy_imbalance"], 1.0e-8)
        checks.that(f"{title}: the film is {answer['film_temperature'] - AMBIENT:.0f} K over ambient", answer["film_temperature"] > AMBIENT + 20.0)
    full = solve(folder, "full", shells(LOAD, model={"reduction": "none"}, thermal=shell["thermal"]))
    checks.below("shells, condensed against full: film_temperature", answer["film_temperature"]/full["film_temperature"] - 1.0, 1.0e-8)


def check_motion(checks, folder):
    """Vibrations keep the temperatures: slow ones have the stiffness of films between walls that are held."""
    thermal = HELD | {"shaft_temperature": 350.0, "top_foil_temperature": 330.0}
    held = {"axial_gap": 1.2e-5}
    answer = solve(folder, "slow", heated(held, "linear_dynamics", thermal=thermal, dynamics={"frequencies": 1.0e-3}))
    found = coefficients(answer)[0][0][0, 0]
    step = 1.0e-9
    ahead, behind = (solve(folder, "moved", heated({"axial_gap": 1.2e-5 + sign*step}, "fixed_position", thermal=thermal)) for sign in (1.0, -1.0))
    rate = -(ahead["axial_force"] - behind["axial_force"])/(2.0*step)
    checks.below("stiffness of slow vibrations against differences, whose film changes its temperature a little", found/rate - 1.0, 1.0e-2)


def check_derivatives(checks, folder):
    """Derivatives by keys of heat against differences."""
    named = {"shaft_conductance": 0.5, "bump_conductance": 300.0, "cooling_flow": 5.0e-4}
    cooled = WALLS | {"cooling_flow": 5.0e-4, "channel_conductance": 180.0, "channel_sleeve_conductance": 50.0}
    derived = solve(folder, "derived", heated(LOAD, thermal=cooled, sensitivity={
        "quantity": ("axial_gap", "shaft_temperature"), "parameters": tuple(f"thermal%{name}" for name in named)}))
    for name, value in named.items():
        ahead, behind = (solve(folder, "moved", heated(LOAD, thermal=cooled | {name: value*(1.0 + sign*1.0e-3)})) for sign in (1.0, -1.0))
        for quantity in ("axial_gap", "shaft_temperature"):
            rate = (ahead[quantity] - behind[quantity])/(2.0e-3*value)
            checks.below(f"{quantity} by {name} against differences", derived[f"d_{quantity}_d_thermal_{name}"]/rate - 1.0, 1.0e-4)


def hottest(found):
    """Temperature of the hottest place of film and top foil."""
    return max(found["maximum_film_temperature"], found["maximum_top_foil_temperature"])


def check_capacity(checks, folder):
    """A load capacity ends at the first of film and heat, from a lighter load and from one that is too hot; a plain equilibrium under it
    is as hot. A temperature that is not reached changes nothing."""
    film = solve(folder, "film", heated(LOAD, "load_capacity", capacity={"smallest_gap": 4.0e-6}))
    for title, above in (("not reached", 10.0), ("reached", -10.0)):
        highest = hottest(film) + above
        limits = {"smallest_gap": 4.0e-6, "highest_temperature": highest}
        found = solve(folder, "capacity", heated(LOAD, "load_capacity", capacity=limits))
        checks.that(f"{title}: the limit is found", found["limit_reached"] == "true")
        if above > 0.0:
            checks.below("a temperature that is not reached", found["load_capacity"]/film["load_capacity"] - 1.0, 1.0e-9)
            continue
        checks.that("heat ends it before the film does", LOAD["axial_load"] < found["load_capacity"] < 0.99*film["load_capacity"]
                    and found["minimum_gap"] > 1.01*film["minimum_gap"] and found["temperature_margin"] == 1.0)
        plain = solve(folder, "hot", heated({"axial_load": found["load_capacity"]}))
        checks.below("a plain equilibrium under that load is as hot", (hottest(plain) - highest)/(highest - AMBIENT), 1.0e-6)
        heavy = solve(folder, "heavy", heated({"axial_load": 0.5*(found["load_capacity"] + film["load_capacity"])}, "load_capacity", capacity=limits))
        checks.below("from a load that is too hot", heavy["load_capacity"]/found["load_capacity"] - 1.0, 1.0e-8)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_limits(checks, folder)
        check_same(checks, folder)
        check_foils(checks, folder)
        check_motion(checks, folder)
        check_derivatives(checks, folder)
        check_capacity(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
