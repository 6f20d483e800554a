#!/usr/bin/env python3
"""Films that are fed and carry heat, and porous walls that feed a real gas: closed forms, what is made leaves, derivatives against
differences, half and whole widths, ranks.

A bearing whose walls and supply have one temperature is the isothermal one of that temperature, whatever the gas around has."""

import math
import pathlib
import sys
import tempfile

import numpy

from gfb_run import Checks, solve

AMBIENT, WARM = 293.15, 333.15
SPECIFIC_HEAT = 1005.0
AIR = {"viscosity_law": "sutherland", "ambient_pressure": 101325.0}
JOURNAL = {"radius": 0.015, "length": 0.03, "clearance": 1.5e-5, "leading_edge_condition": "periodic"}
SECTORS = {"kind": "thrust", "outer_radius": 0.03, "inner_radius": 0.015}
HOLES = {"kind": "orifices", "supply_pressure": 6.0e5, "orifice_diameter": 3.0e-4, "orifices": 6, "row_positions": [-0.008, 0.008],
         "mouth_diameter": 1.0e-3}
LINE = HOLES | {"spread": "line"}
WALL = {"kind": "porous", "supply_pressure": 6.0e5, "permeability": 2.0e-15, "wall_thickness": 4.0e-3}
SUPPLIES = {"wall": WALL, "wall with inertia": WALL | {"inertia_coefficient": 1.0e11}, "line": LINE, "rims": HOLES}
COARSE = {"circumferential_elements": 48, "axial_elements": 8}
TIGHT = {"residual_tolerance": 1.0e-13, "step_tolerance": 1.0e-12}
CONDUCTS = {"ambient_temperature": AMBIENT, "shaft_conductance": 0.3, "sleeve_conductance": 1.0, "bump_conductance": 190.0,
            "shaft_expansion": 12.0e-6, "sleeve_expansion": 10.0e-6}
CARBON_DIOXIDE = {"ambient_pressure": 1.0e6, "viscosity": 1.6e-5, "temperature": 310.0, "molar_mass": 0.0440098,
                  "equation_of_state": "peng_robinson", "critical_temperature": 304.1282, "critical_pressure": 7.3773e6,
                  "acentric_factor": 0.22394, "viscosity_exponent": 0.1}


def viscosity(temperature):
    """Of air, by Sutherland's law."""
    return 1.458e-6*temperature**1.5/(temperature + 110.4)


def held(temperature):
    """Walls of a temperature."""
    return {"ambient_temperature": AMBIENT, "shaft": "given", "shaft_temperature": temperature, "top_foil": "given",
            "top_foil_temperature": temperature, "sleeve": "given", "sleeve_temperature": temperature, "bump_conductance": 100.0}


def fed(feed, thermal=None, analysis="fixed_position", bearing=None, speed=20000.0, **more):
    """Groups of a bearing on a rigid sleeve."""
    groups = {"scene": {"analysis": analysis}, "bearing": dict(bearing or JOURNAL), "gas": dict(AIR),
              "operation": {"speed_rpm": speed, "eccentricity": [5.0e-6, 2.0e-6]}, "model": {"foil": "rigid"}, "feed": dict(feed),
              "mesh": dict(COARSE), "solver": dict(TIGHT), "top_foil": {"thickness": 1.0e-4}}
    if thermal:
        groups["thermal"] = dict(thermal)
        if thermal.get("top_foil") == "given":
            del groups["top_foil"]
    else:
        del groups["top_foil"]
    return groups | more


def check_even(checks, folder):
    """At rest, walls and supply of one temperature: the film has it, and is the isothermal one of that temperature."""
    for name, feed in SUPPLIES.items():
        feed = feed | {"supply_temperature": WARM}
        hot = solve(folder, "even", fed(feed, held(WARM), speed=0.0))
        plain = solve(folder, "plain", fed(feed, speed=0.0, gas={"ambient_pressure": 101325.0, "viscosity": viscosity(WARM),
                                                                 "temperature": WARM}))
        for quantity in ("force_x", "force_y", "supply_flow", "supply_power", "maximum_pressure"):
            checks.below(f"{name}, all of one temperature: {quantity}", hot[quantity]/plain[quantity] - 1.0, 1.0e-12)
        for quantity in ("film_temperature", "maximum_film_temperature"):
            checks.below(f"{name}, all of one temperature: {quantity} [K]", hot[quantity] - WARM, 1.0e-9)
        brought = SPECIFIC_HEAT*hot["supply_flow"]*(WARM - AMBIENT)
        for quantity in ("heat_by_supply", "heat_by_gas"):
            checks.below(f"{name}, all of one temperature: {quantity}", hot[quantity]/brought - 1.0, 1.0e-11)


def check_balance(checks, folder):
    """A supply that is 10 K warmer: what it brings, by hand; energy and mass close; half and whole widths, four ranks."""
    taken = ("force_x", "supply_flow", "shaft_temperature", "film_temperature", "heat_by_supply", "heat_by_gas", "heat_to_shaft")
    for name, feed in SUPPLIES.items():
        groups = fed(feed | {"supply_temperature": AMBIENT + 10.0}, CONDUCTS)
        half = solve(folder, "half", groups)
        checks.below(f"{name}: heat of the supply by hand", half["heat_by_supply"]/(SPECIFIC_HEAT*half["supply_flow"]*10.0) - 1.0, 1.0e-12)
        left = half["power_loss"] + half["heat_by_supply"] - half["heat_to_shaft"] - half["heat_to_top_foil"] - half["heat_by_gas"]
        checks.below(f"{name}: energy", left/half["power_loss"], 1.0e-11)
        checks.below(f"{name}: mass", half["mass_flow_sides"]/half["supply_flow"] - 1.0, 1.0e-12)
        whole = solve(folder, "whole", groups | {"model": {"foil": "rigid", "half_width": "no"}})
        several = solve(folder, "several", groups, ranks=4)
        for quantity in taken:
            checks.below(f"{name}, half and whole: {quantity}", whole[quantity]/half[quantity] - 1.0, 1.0e-11)
            checks.below(f"{name}, four ranks: {quantity}", several[quantity]/half[quantity] - 1.0, 1.0e-10)


def check_strong(checks, folder):
    """The more gas, the nearer its temperature: insulated walls but for a weak shaft follow a warm supply at rest."""
    walls = CONDUCTS | {"shaft_conductance": 1.0e-4, "sleeve_conductance": 1.0e-4, "shaft_expansion": 0.0, "sleeve_expansion": 0.0}
    away = []
    for permeability in (2.0e-15, 8.0e-15, 32.0e-15):
        answer = solve(folder, "strong", fed(WALL | {"permeability": permeability, "supply_temperature": WARM}, walls, speed=0.0))
        away.append((WARM - answer["film_temperature"])/(WARM - AMBIENT))
    checks.that(f"film behind a strong supply: {', '.join(f'{part:.1e}' for part in away)} of the rise is missing",
                away[0] < 2.0e-2 and away[2] < away[1] < away[0])
    lost = 1.0e-4*(answer["shaft_temperature"] + answer["sleeve_temperature"] - 2.0*AMBIENT)
    checks.below("what the gas loses leaves through shaft and sleeve", (answer["heat_by_supply"] - answer["heat_by_gas"] - lost)
                 / answer["heat_by_supply"], 1.0e-12)


def check_slopes(checks, folder):
    """Slow vibrations between walls of the supply's temperature are differences of forces; derivatives by keys are differences."""
    walls = held(WARM) | {"prandtl": 1.0e-9}  # a gas that conducts without limit has the temperature of the walls
    for name, feed in (("wall", WALL), ("line", LINE), ("rims", HOLES | {"pocket_volume": 1.0e-10})):
        feed = feed | {"supply_temperature": WARM}
        slow = solve(folder, "slow", fed(feed, walls, "linear_dynamics", dynamics={"frequencies": [1.0e-3]}))
        step = 1.0e-9
        forces = [solve(folder, f"moved_{sign}", fed(feed, walls, operation={
            "speed_rpm": 20000.0, "eccentricity": [5.0e-6 + sign*step, 2.0e-6]}))["force_x"] for sign in (1, -1)]
        checks.below(f"{name}: K at rest over the slope of the force", -slow["stiffness_xx"]*2.0*step/(forces[0] - forces[1]) - 1.0, 1.0e-5)
    for name, feed in (("wall", WALL), ("line", LINE), ("rims", HOLES)):
        feed = feed | {"supply_temperature": 303.15}
        loaded = fed(feed, CONDUCTS, "equilibrium", operation={"speed_rpm": 20000.0, "load": [-40.0, 0.0]})
        answer = solve(folder, "derived", loaded | {"sensitivity": {"quantity": ["minimum_gap", "heat_by_gas", "shaft_temperature"],
                                                                    "parameters": "feed%supply_temperature, feed%supply_pressure"}})
        for key, value in (("supply_temperature", 303.15), ("supply_pressure", 6.0e5)):
            moved = [solve(folder, f"derived_{sign}", loaded | {"feed": feed | {key: value*(1.0 + sign*1.0e-4)}}) for sign in (1, -1)]
            for quantity in ("minimum_gap", "heat_by_gas", "shaft_temperature"):
                checks.below(f"{name}: {quantity} by {key} over its difference", answer[f"d_{quantity}_d_feed_{key}"]*2.0e-4*value
                             / (moved[0][quantity] - moved[1][quantity]) - 1.0, 2.0e-5)


def check_kinds(checks, folder):
    """Pads, thrust sectors and rings, springs, foils with holes; a motion that holds the temperatures."""
    warm = {"supply_temperature": 313.15}
    pads = fed(HOLES | warm, CONDUCTS, bearing={key: JOURNAL[key] for key in ("radius", "length", "clearance")},
               pads={"count": 3, "arc": 2.0}, mesh={"circumferential_elements": 24, "axial_elements": 8})
    sectors = fed(HOLES | warm | {"orifices": 2, "row_positions": [0.022]}, {key: value for key, value in CONDUCTS.items() if "expansion" not in key},
                  bearing=SECTORS, pads={"count": 4, "arc": 1.4}, operation={"axial_gap": 1.0e-5, "speed_rpm": 20000.0},
                  mesh={"circumferential_elements": 16, "radial_elements": 8})
    springs = fed(HOLES | warm, CONDUCTS, "equilibrium", operation={"speed_rpm": 20000.0, "load": [-30.0, 0.0]},
                  model={"foil": "elastic_foundation", "foundation_stiffness": 5.0e9})
    ring = fed(WALL | warm, {key: value for key, value in CONDUCTS.items() if "expansion" not in key},
               bearing=SECTORS | {"leading_edge_condition": "periodic"}, operation={"axial_gap": 1.0e-5, "speed_rpm": 20000.0},
               mesh={"circumferential_elements": 16, "radial_elements": 8})
    for name, groups in (("pads", pads), ("sectors", sectors), ("springs", springs), ("ring", ring)):
        answer = solve(folder, name, groups)
        checks.below(f"{name}: energy", answer["energy_imbalance"], 1.0e-10)
        flows = answer["mass_flow_sides"] + answer["mass_flow_trailing_edge"] - answer["mass_flow_leading_edge"]
        checks.below(f"{name}: mass", flows/answer["supply_flow"] - 1.0, 1.0e-10)
    checks.below("pads: the heat of each adds up", sum(solve(folder, "pads", pads)[f"heat_by_supply_{pad}"] for pad in (1, 2, 3))
                 / solve(folder, "pads", pads)["heat_by_supply"] - 1.0, 1.0e-12)
    metal = {"thickness": 1.02e-4, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "fixed_edge": "trailing"}
    bumps = metal | {"half_length": 1.778e-3, "height": 5.08e-4, "pitch": 4.572e-3, "bumps": 26}
    foil = {"scene": {"analysis": "equilibrium"}, "bearing": {"radius": 0.01905, "length": 0.0381, "clearance": 31.8e-6}, "gas": dict(AIR),
            "feed": HOLES | warm | {"through": "top_foil"}, "thermal": dict(CONDUCTS), "top_foil": metal, "bump_foil": bumps,
            "contact": {"friction_top": 0.1, "friction_sleeve": 0.1}, "model": {"foil": "beam"},
            "operation": {"speed_rpm": 10000.0, "load": [-40.0, 0.0]}}
    answer = solve(folder, "beams", foil)
    checks.below("beams with holes: energy", answer["energy_imbalance"], 1.0e-8)
    turning = fed(WALL | warm, CONDUCTS, "transient", transient={"turns": 0.2, "steps_per_turn": 100, "orbit_radius": 1.0e-7, "orbit_frequency": 2000.0})
    checks.that("a motion begins from the warm film", solve(folder, "turning", turning)["film_temperature"] > AMBIENT + 1.0)


def real_gas():
    """R T, attraction and covolume of Peng and Robinson's carbon dioxide."""
    kappa = 0.37464 + (1.54226 - 0.26992*0.22394)*0.22394
    alpha = (1.0 + kappa*(1.0 - math.sqrt(310.0/304.1282)))**2
    return 8.314462618*310.0, 0.45724*(8.314462618*304.1282)**2/7.3773e6*alpha, 0.0778*8.314462618*304.1282/7.3773e6


def amount_at(pressure):
    """Of carbon dioxide in a volume, by bisection [mol/m3]."""
    energy, attraction, covolume = real_gas()
    low, high = 0.0, (1.0 - 1.0e-9)/covolume
    for _ in range(200):
        middle = 0.5*(low + high)
        there = middle*(energy/(1.0 - covolume*middle) - attraction*middle/(1.0 + 2.0*covolume*middle - (covolume*middle)**2))
        low, high = (middle, high) if there < pressure else (low, middle)
    return middle


def check_real_gas(checks, folder):
    """A gap so wide that the film is at ambient pressure takes what Darcy's law gives, by a fine quadrature; a table of an ideal gas."""
    ring = {"kind": "thrust", "outer_radius": 0.02, "inner_radius": 0.019, "leading_edge_condition": "periodic"}
    feed = {"kind": "porous", "supply_pressure": 6.0e6, "permeability": 1.0e-16, "wall_thickness": 1.0e-4}
    answer = solve(folder, "real", {"scene": {"analysis": "fixed_position"}, "bearing": ring, "gas": dict(CARBON_DIOXIDE), "feed": feed,
                                    "operation": {"speed_rpm": 0.0, "axial_gap": 3.0e-4}, "model": {"foil": "rigid"}, "solver": dict(TIGHT)})
    places, weights = numpy.polynomial.legendre.leggauss(200)
    pressures = 3.5e6 + 2.5e6*places
    amounts = numpy.array([amount_at(pressure) for pressure in pressures])
    thickness = CARBON_DIOXIDE["viscosity"]*(amounts/amount_at(1.0e6))**0.1
    flux = 1.0e-16/1.0e-4*float(numpy.sum(2.5e6*weights*CARBON_DIOXIDE["molar_mass"]*amounts/thickness))
    checks.below("carbon dioxide through a wall, Darcy's flow", answer["supply_flow"]/(flux*math.pi*(0.02**2 - 0.019**2)) - 1.0, 1.0e-6)
    work = float(numpy.sum(2.5e6*weights/(CARBON_DIOXIDE["molar_mass"]*amounts)))
    checks.below("carbon dioxide: the work to compress it", answer["supply_power"]/(answer["supply_flow"]*work) - 1.0, 1.0e-10)
    groups = fed(WALL, gas={"ambient_pressure": 101325.0, "viscosity": 1.85e-5, "temperature": AMBIENT})
    density = 0.0289647/(8.314462618*AMBIENT)
    table = [5.0e4, 1.01325e5, 3.0e5, 1.0e6]
    ideal = solve(folder, "ideal", groups)
    tabled = solve(folder, "tabled", groups | {"gas": {"ambient_pressure": 101325.0, "viscosity": 1.85e-5, "density_table_pressure": table,
                                                       "density_table_density": [density*pressure for pressure in table]}})
    for quantity in ("force_x", "force_y", "supply_flow", "supply_power"):
        checks.below(f"a table of an ideal gas: {quantity}", tabled[quantity]/ideal[quantity] - 1.0, 1.0e-9)
    held_gap = fed(WALL | {"supply_pressure": 6.0e6}, gas=dict(CARBON_DIOXIDE))
    slow = solve(folder, "slow", held_gap | {"scene": {"analysis": "linear_dynamics"}, "dynamics": {"frequencies": [1.0e-3]}})
    forces = [solve(folder, "moved", held_gap | {"operation": {"speed_rpm": 20000.0, "eccentricity": [5.0e-6 + sign*1.0e-9, 2.0e-6]}})["force_x"]
              for sign in (1, -1)]
    checks.below("carbon dioxide: K at rest over the slope of the force", -slow["stiffness_xx"]*2.0e-9/(forces[0] - forces[1]) - 1.0, 1.0e-5)


def main():
    checks = Checks()
    quick = (check_even, check_balance, check_strong, check_slopes, check_kinds, check_real_gas)
    chosen = [check for check in quick if len(sys.argv) < 2 or check.__name__ in sys.argv[1:]]
    with tempfile.TemporaryDirectory() as name:
        for check in chosen:
            check(checks, pathlib.Path(name))
    checks.close()


if __name__ == "__main__":
    main()
