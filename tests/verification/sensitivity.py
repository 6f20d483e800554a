#!/usr/bin/env python3
"""Sensitivities by the adjoint: against differences of whole answers, the sums that dimensions demand, sweeps, ranks."""

import math

from gfb_run import run_checks, solve

LIMIT = 1.0e-6      # relative, of a derivative against differences
CENTRAL = {1: 0.5, -1: -0.5}  # weights of the answers that many steps away: second order
CENTRAL_FOURTH = {1: 2.0/3.0, -1: -2.0/3.0, 2: -1.0/12.0, -2: 1.0/12.0}  # for longer steps, where round-off is large
SUM_LIMIT = 1.0e-7  # of a sum over keys, over the sum of its terms' sizes
NAMES = ("eccentricity_x", "eccentricity_y", "attitude_angle", "friction_torque", "power_loss", "minimum_gap",
         "maximum_pressure", "minimum_pressure")
FIXED_NAMES = ("attitude_angle", "force_x", "force_y", "torque_x", "torque_y", "friction_torque", "power_loss", "minimum_gap",
               "maximum_pressure", "minimum_pressure")
STRESSES = ("maximum_top_foil_stress", "maximum_bump_foil_stress")
HEAT_NAMES = ("film_temperature", "maximum_film_temperature", "top_foil_temperature", "maximum_top_foil_temperature",
              "shaft_temperature", "sleeve_temperature", "inlet_temperature", "cooling_outlet_temperature", "heat_to_shaft",
              "heat_to_top_foil", "heat_through_bumps", "heat_to_channel", "heat_by_gas", "running_clearance")
SPRINGS = {
    "scene": {"analysis": "equilibrium"},
    "bearing": {"radius": 0.01905, "length": 0.0381, "clearance": 3.18e-5},
    "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5},
    "operation": {"speed_rpm": 30000.0, "load": (-60.0, 10.0)},
    "model": {"foil": "elastic_foundation", "foundation_stiffness": 4.7e9},
    "mesh": {"circumferential_elements": 48, "axial_elements": 8},
    "solver": {"residual_tolerance": 1.0e-12, "step_tolerance": 1.0e-13},
    "output": {"fields": "none"},
}
FILM_KEYS = ("gas%viscosity", "gas%ambient_pressure", "bearing%clearance", "bearing%radius", "bearing%length",
             "operation%speed_rpm")
SHEET = {"thickness": 1.02e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29, "fixed_edge": "trailing"}
SMALL = {"radius": 0.0095, "length": 0.019, "clearance": 2.0e-5}  # 13 bumps

WARM_GAS = {"viscosity": None, "viscosity_law": "sutherland"}
HEAT = {"bump_conductance": 190.0, "sleeve_conductance": 1.0, "shaft_expansion": 1.2e-5, "sleeve_expansion": 1.0e-5,
        "shaft_density": 7850.0, "shaft_youngs_modulus": 2.1e11, "shaft_poissons_ratio": 0.3, "ambient_temperature": 293.15}
COOLED = {  # springs with a shaft that conducts along itself over a cooled channel
    "top_foil": {"thickness": 1.02e-4}, "mesh": {"circumferential_elements": 32, "axial_elements": 8}, "bump_foil": {"height": 5.08e-4},
    "thermal": {**HEAT, "shaft": "fin", "shaft_end_conductance": (0.1, 0.2), "cooling_flow": 5.0e-4, "channel_conductance": 100.0,
                "channel_sleeve_conductance": 60.0, "carry_over": 0.7}}


def with_keys(content, **changes):
    """A case with other values of some keys."""
    return {group: {**content.get(group, {}), **changes.get(group, {})} for group in {**content, **changes}}


def foils(model, friction):
    """A small bearing of shells or beams; with friction its crests stand where they are whatever the bumps' length is."""
    return with_keys(
        SPRINGS, bearing=SMALL, operation={"speed_rpm": 40000.0, "load": (-14.0, 2.0)}, top_foil=SHEET,
        bump_foil={**SHEET, "half_length": 1.778e-3, "height": 5.08e-4, "pitch": 4.572e-3, "bumps": 13,
                   "fixed_line": "half_flat" if friction > 0.0 else "corner"},
        contact={"friction_top": friction, "friction_sleeve": friction},
        mesh={"circumferential_elements": 52, "axial_elements": 4, "arc_elements": 4, "flat_elements": 2}
    ) | {"model": {"foil": model}}


def value_of(content, key):
    """Value of a key; of the load its magnitude."""
    group, name = key.split("%")
    value = content[group][name]
    return math.hypot(*value) if key == "operation%load" else value


def changed(content, key, value):
    """The case with another value of a key."""
    group, name = key.split("%")
    if key == "operation%load":
        value = tuple(part*value/value_of(content, key) for part in content[group][name])
    return with_keys(content, **{group: {name: value}})


def slope_name(name, key):
    """Name of a derivative among the results."""
    return f"d_{name}_d_{key.replace('%', '_')}"


def derived(folder, content, keys, names=NAMES, ranks=1, **more):
    """Summary of a case with derivatives."""
    return solve(folder, "derived", with_keys(content, sensitivity={"quantity": names, "parameters": keys, **more}), ranks).summary


def check_differences(checks, folder, words, content, steps, names=NAMES, sides=CENTRAL):
    """Every derivative against a central difference of whole answers, each with its relative step."""
    answer = derived(folder, content, tuple(steps), names)
    for key, part in steps.items():
        value = value_of(content, key)
        there = {side: solve(folder, "differ", changed(content, key, value*(1.0 + side*part))).summary for side in sides}
        worst = (0.0, "all")
        for name in names:
            difference = sum(weight*there[side][name] for side, weight in sides.items())/(part*value)
            size = max(abs(difference), 1.0e-2*abs(answer[name]/value), 1.0e-30)  # tiny ones are round-off of the answers
            worst = max(worst, (abs(answer[slope_name(name, key)] - difference)/size, name))
        checks.below(f"{words}: by {key}, {worst[1]}", worst[0], LIMIT)
    return answer


def check_sum(checks, words, answer, content, name, powers, degree):
    """Euler's theorem: a result of that degree in some units is the sum of its derivatives times the keys' degrees."""
    terms = [power*value_of(content, key)*answer[slope_name(name, key)] for key, power in powers.items()]
    terms.append(-degree*answer[name])
    checks.below(f"{words}: {name}", sum(terms)/sum(abs(term) for term in terms), SUM_LIMIT)


def check_film(checks, folder):
    """Springs under a load, and a tilted shaft at a given position over the whole width."""
    steps = dict.fromkeys((*FILM_KEYS, "operation%load", "model%foundation_stiffness"), 3.0e-5)
    answer = check_differences(checks, folder, "springs", SPRINGS, steps)
    pressures = {"gas%viscosity": 1, "gas%ambient_pressure": 1, "operation%load": 1, "model%foundation_stiffness": 1}
    lengths = {"bearing%radius": 1, "bearing%length": 1, "bearing%clearance": 1, "operation%load": 2,
               "model%foundation_stiffness": -1}
    times = {"gas%viscosity": 1, "operation%speed_rpm": -1}
    for name, degrees in (("minimum_gap", (0, 1, 0)), ("friction_torque", (1, 3, 0)), ("maximum_pressure", (1, 0, 0)),
                          ("attitude_angle", (0, 0, 0)), ("power_loss", (1, 3, -1))):
        for words, powers, degree in zip(("pressures", "lengths", "times"), (pressures, lengths, times), degrees):
            check_sum(checks, f"springs, sum over {words}", answer, SPRINGS, name, powers, degree)
    fixed = with_keys(SPRINGS, scene={"analysis": "fixed_position"})
    fixed["operation"] = {"speed_rpm": 30000.0, "eccentricity": (2.0e-5, 8.0e-6), "tilt": (2.0e-4, 1.0e-4)}
    touching = with_keys(SPRINGS, shaft_contact={"roughness": 1.0e-6, "pressure": 5.0e6, "friction": 0.1},
                         operation={"speed_rpm": 10000.0, "load": (-80.0, 3.0)})
    check_differences(checks, folder, "asperities", touching, {"bearing%clearance": 1.0e-5, "shaft_contact%roughness": 3.0e-5})
    check_differences(checks, folder, "fixed and tilted", fixed, dict.fromkeys(FILM_KEYS[:4], 3.0e-5), FIXED_NAMES)


def check_heat(checks, folder):
    """Every result of heat, by walls and geometry: a shaft that conducts along itself over a cooled channel; foils as structures."""
    cooled = with_keys(SPRINGS, gas=WARM_GAS, **COOLED)
    check_differences(checks, folder, "cooled", cooled, dict.fromkeys(
        ("thermal%bump_conductance", "thermal%cooling_flow", "thermal%shaft_expansion", "thermal%carry_over", "bearing%clearance",
         "operation%speed_rpm", "top_foil%thickness", "bearing%radius"), 3.0e-5), NAMES + HEAT_NAMES)
    one, two = (derived(folder, cooled, ("thermal%shaft_expansion",), HEAT_NAMES, ranks) for ranks in (1, 2))
    for name in HEAT_NAMES:
        slope = slope_name(name, "thermal%shaft_expansion")
        checks.below(f"cooled, 2 ranks: {slope}", two[slope]/one[slope] - 1.0, LIMIT)
    touching = with_keys(SPRINGS, gas=WARM_GAS, thermal={**HEAT, "shaft_conductance": 0.05}, top_foil={"thickness": 1.02e-4},
                         shaft_contact={"roughness": 2.0e-6, "pressure": 5.0e6, "friction": 0.1},
                         operation={"speed_rpm": 10000.0, "load": (-80.0, 3.0)})
    check_differences(checks, folder, "asperities with heat", touching, {"thermal%shaft_expansion": 3.0e-5},
                      NAMES + ("shaft_temperature", "heat_by_gas", "running_clearance"))
    plain = tuple(name for name in HEAT_NAMES if name not in ("cooling_outlet_temperature", "heat_to_channel"))
    softening = {**HEAT, "shaft_conductance": 0.3, "modulus_slope": -3.0e-3}
    check_differences(checks, folder, "shells with heat, which soften", with_keys(foils("shell", 0.1), gas=WARM_GAS, thermal=softening), {
        "thermal%shaft_conductance": 1.0e-4, "thermal%modulus_slope": 1.0e-4, "bump_foil%youngs_modulus": 3.0e-4,
        "bump_foil%thickness": 1.0e-4, "gas%ambient_pressure": 3.0e-5}, NAMES + STRESSES + plain)


def check_foils(checks, folder):
    """Shells and beams, with friction and without; pressures scale foils as well."""
    shells = foils("shell", 0.1)
    check_differences(checks, folder, "shells with friction", shells,
                      {"bump_foil%thickness": 1.0e-4, "bump_foil%height": 5.0e-5, "bump_foil%half_length": 8.0e-5,
                       "top_foil%thickness": 1.0e-4, "contact%friction_top": 2.0e-4, "bearing%clearance": 5.0e-5, "bump_foil%pitch": 1.6e-5},
                      NAMES + STRESSES)
    keys = {"gas%viscosity": 1, "gas%ambient_pressure": 1, "operation%load": 1, "top_foil%youngs_modulus": 1,
            "bump_foil%youngs_modulus": 1}
    one, two = (derived(folder, shells, tuple(keys), NAMES + STRESSES, ranks) for ranks in (1, 2))
    for name, degree in (("minimum_gap", 0), ("friction_torque", 1), ("maximum_pressure", 1), *((name, 1) for name in STRESSES)):
        check_sum(checks, "shells with friction, sum over pressures", one, shells, name, keys, degree)
        for key in keys:
            slope = slope_name(name, key)
            checks.below(f"shells with friction, 2 ranks: {slope}", two[slope]/one[slope] - 1.0, LIMIT)
    check_differences(checks, folder, "shells without friction", foils("shell", 0.0),
                      {"bump_foil%half_length": 2.0e-5, "operation%load": 5.0e-5}, NAMES + STRESSES)
    check_differences(checks, folder, "beams with friction at their faces",
                      with_keys(foils("beam", 0.1), contact={"contact_surface": "face"}),
                      {"bump_foil%thickness": 1.0e-4, "top_foil%thickness": 1.0e-4, "contact%friction_sleeve": 5.0e-4}, NAMES + STRESSES)
    check_differences(checks, folder, "shells with friction at their faces",
                      with_keys(shells, contact={"contact_surface": "face"}),
                      {"bump_foil%thickness": 1.0e-4, "top_foil%thickness": 1.0e-4})
    # By default half a pitch is 4.5 elements: neither key may change how many there are.
    near = with_keys(foils("beam", 0.1), bearing={"radius": 0.0095045}, mesh={"circumferential_elements": None})
    check_differences(checks, folder, "beams, as many elements as fit", near, {"bump_foil%pitch": 8.0e-6, "bearing%radius": 8.0e-6})


def check_lists(checks, folder):
    """Single values of lists: gaps of 0 against one-sided differences of second order, thicknesses against central ones."""
    step, bumps = 1.0e-9, 13
    content = foils("shell", 0.1)
    answer = derived(folder, content, ("bump_foil%crest_gap(:)", "bump_foil%corner_gap(9)"), NAMES)
    for key, bump in (("crest_gap", 7), ("crest_gap", 9), ("corner_gap", 9)):
        there = [solve(folder, "differ", with_keys(content, bump_foil={
            key: [times*step if i == bump else 0.0 for i in range(1, bumps + 1)]})).summary for times in (1, 2)]
        for name in ("eccentricity_x", "eccentricity_y", "minimum_gap"):
            difference = (4.0*there[0][name] - 3.0*answer[name] - there[1][name])/(2.0*step)
            checks.below(f"{name} by {key}({bump})", answer[f"d_{name}_d_bump_foil_{key}_{bump}"]/difference - 1.0, LIMIT)
    listed = with_keys(content, bump_foil={"bump_thickness": (*[1.02e-4]*6, 1.05e-4, *[1.02e-4]*6)})
    del listed["bump_foil"]["thickness"]
    part = 1.0e-4
    answer = derived(folder, listed, ("bump_foil%bump_thickness(7)", "bump_foil%bump_thickness(8)"), NAMES)
    for bump, value in ((7, 1.05e-4), (8, 1.02e-4)):
        there = []
        for side in (1.0 + part, 1.0 - part):
            thickness = list(listed["bump_foil"]["bump_thickness"])
            thickness[bump - 1] *= side
            there.append(solve(folder, "differ", with_keys(listed, bump_foil={"bump_thickness": thickness})).summary)
        for name in ("eccentricity_x", "minimum_gap"):
            difference = (there[0][name] - there[1][name])/(2.0*part*value)
            checks.below(f"{name} by bump_thickness({bump})",
                         answer[f"d_{name}_d_bump_foil_bump_thickness_{bump}"]/difference - 1.0, LIMIT)


def check_tolerances_and_sweep(checks, folder):
    """The variance is the sum of squares; a sweep, also one over the very key, has the derivatives of its points."""
    keys, tolerances = ("bearing%clearance", "gas%viscosity"), (1.0e-6, 2.0e-7)
    answer = derived(folder, SPRINGS, keys, ("minimum_gap",), tolerances=tolerances)
    variance = sum((answer[slope_name("minimum_gap", key)]*tolerance)**2 for key, tolerance in zip(keys, tolerances))
    checks.below("variance: the sum of squares", answer["variance_minimum_gap"]/variance - 1.0, 1.0e-14)
    checks.below("standard deviation: its root", answer["standard_deviation_minimum_gap"]/math.sqrt(variance) - 1.0, 1.0e-14)
    asked = {"quantity": "minimum_gap", "parameters": keys}
    for words, parameter, values in (("load", "load", (math.hypot(60.0, 10.0), 50.0)),
                                     ("clearance", "bearing%clearance", (3.18e-5, 3.0e-5))):
        swept = solve(folder, "swept", with_keys(SPRINGS, sensitivity=asked, sweep={"parameter": parameter, "values": values})).history()
        for point, value in enumerate(values):
            alone = changed(SPRINGS, "operation%load" if words == "load" else parameter, value)
            single = derived(folder, alone, keys, ("minimum_gap",))
            for key in keys:
                slope = slope_name("minimum_gap", key)
                checks.below(f"sweep of {words}, point {point + 1}: {slope}", swept[slope][point]/single[slope] - 1.0, 1.0e-7)


def main():
    """Runs all checks."""
    run_checks((check_film, check_tolerances_and_sweep, check_foils), (check_heat, check_lists))


if __name__ == "__main__":
    main()
