#!/usr/bin/env python3
"""Derivatives of critical mass and whirl ratio: against differences of whole answers for every foil, the sums that dimensions demand,
with heat, condensed bumps, ranks, sweeps, and where there are none."""


from gfb_run import run_checks, solve
from sensitivity import CENTRAL, CENTRAL_FOURTH, COOLED, FILM_KEYS, HEAT, LIMIT, SPRINGS, WARM_GAS, check_differences, check_sum, derived, foils, slope_name, with_keys

NAMES = ("critical_mass", "whirl_ratio")
COEFFICIENTS = tuple(f"{what}_{entry}" for what in ("stiffness", "damping") for entry in ("xx", "xy", "yx", "yy"))
LONG = 1.0e-3  # of a key: a step that is long against rounding
VIBRATION = {"scene": {"analysis": "linear_dynamics"}, "dynamics": {"frequency_ratios": 1.0}}
STEEL = {"density": 7850.0}
PLATE = {"bump_foil": {"bumps": 26, "half_length": 1.778e-3, "height": 5.08e-4, "pitch": 4.572e-3, "thickness": 1.02e-4, "youngs_modulus": 2.14e11,
                       "poissons_ratio": 0.29}, "top_foil": {"thickness": 1.5e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29}}


def vibrating(content, **changes):
    """A case under small vibrations."""
    return with_keys(content, **VIBRATION | changes)


def light(model, friction, **changes):
    """A small bearing of shells or beams under a load so light that some shaft whirls on it."""
    return with_keys(vibrating(foils(model, friction), operation={"load": (-5.0, 1.0)}), **changes)


def check(checks, folder, words, content, steps, sides=CENTRAL):
    """All derivatives by each key against differences."""
    return check_differences(checks, folder, words, content, steps, NAMES + COEFFICIENTS, sides)


def check_stiff(checks, folder, words, content, steps):
    """The same of foils that stiff contacts hold, whose coefficients have 1e-10 of them rounded: long steps of fourth order."""
    return check(checks, folder, words, content, steps, CENTRAL_FOURTH)


def check_springs(checks, folder):
    """Rigid bearings and springs, lossless and with every loss; asperities; a held and tilted shaft; pads."""
    springs = vibrating(SPRINGS)
    step = 3.0e-5
    answer = check(checks, folder, "springs", springs, dict.fromkeys((*FILM_KEYS, "operation%load", "model%foundation_stiffness"), step))
    # a mass is pressure times length times time squared
    for words, powers, degree in (
            ("pressures", {"gas%viscosity": 1, "gas%ambient_pressure": 1, "operation%load": 1, "model%foundation_stiffness": 1}, 1),
            ("lengths", {"bearing%radius": 1, "bearing%length": 1, "bearing%clearance": 1, "operation%load": 2,
                         "model%foundation_stiffness": -1}, 1),
            ("times", {"gas%viscosity": 1, "operation%speed_rpm": -1}, 2)):
        check_sum(checks, f"springs, sum over {words}", answer, springs, "critical_mass", powers, degree)
        check_sum(checks, f"springs, sum over {words}", answer, springs, "whirl_ratio", powers, 0)
    few = {"gas%viscosity": step, "bearing%clearance": step}
    rigid = {group: keys for group, keys in springs.items() if group != "model"} | {"model": {"foil": "rigid"}}
    check(checks, folder, "rigid", rigid, few | {"operation%load": step})
    stiffness = few | {"model%foundation_stiffness": 1.0e-4}
    local = with_keys(springs, model={"foundation_pressure": "local"})
    check(checks, folder, "springs under each pressure, loss factor", with_keys(local, dynamics={"loss_factor": 0.02}),
          stiffness | {"dynamics%loss_factor": 1.0e-4})
    check(checks, folder, "springs with dampers", with_keys(springs, foil_damping={"foundation_damping": 2.0e5}),
          stiffness | {"foil_damping%foundation_damping": 1.0e-4})
    check(checks, folder, "springs with Maxwell arms", with_keys(local, foil_damping={"maxwell_stiffness": 2.0e9, "maxwell_time": 3.0e-4}),
          stiffness | {"foil_damping%maxwell_time": 1.0e-4})
    check(checks, folder, "asperities", with_keys(springs, shaft_contact={"roughness": 3.0e-6, "pressure": 5.0e6, "friction": 0.1},
                                                  operation={"load": (-40.0, 3.0)}), few | {"shaft_contact%roughness": step})
    check(checks, folder, "three pads", with_keys(springs, pads={"count": 3, "arc": 2.0, "preload": 0.3}), few | {"pads%preload": 1.0e-4})
    held = with_keys(springs)
    held["operation"] = {"speed_rpm": 30000.0, "eccentricity": (2.0e-5, 8.0e-6), "tilt": (2.0e-4, 1.0e-4)}
    check(checks, folder, "held and tilted", held, few)


def check_foils(checks, folder):
    """Beams, shells and plates: friction that sticks and slides, losses, mass, faces, pads."""
    few = {"bump_foil%thickness": LONG, "bearing%clearance": 2.0e-4}
    more = few | dict.fromkeys(("top_foil%thickness", "operation%load", "operation%speed_rpm", "contact%friction_top"), LONG)
    beams = light("beam", 0.1)
    check_stiff(checks, folder, "beams, contacts stick", beams, more)
    check_stiff(checks, folder, "beams, contacts slide on", with_keys(beams, dynamics={"contact_tangent": "slip"}), more)
    check_stiff(checks, folder, "beams, loss factor", with_keys(beams, dynamics={"loss_factor": 0.1}), few | {"dynamics%loss_factor": LONG})
    check_stiff(checks, folder, "beams, viscous losses", with_keys(beams, foil_damping={"loss_factor": 0.1, "loss_frequency": 2.0e3}),
          few | {"foil_damping%loss_factor": LONG})
    check_stiff(checks, folder, "beams, curved law of contacts",
          with_keys(beams, contact={"exponent": 1.5, "normal_stiffness": 1.0e12, "friction_law": "coulomb"}), few)
    check_stiff(checks, folder, "beams over the whole width, tilted", with_keys(beams, operation={"tilt": (1.0e-4, 5.0e-5)}), few)
    check_stiff(checks, folder, "beams on three pads",
          with_keys(beams, pads={"count": 3, "arc": 2.0, "preload": 0.3}, bump_foil={"bumps": 4, "pitch": 4.5e-3}), few)
    shape = {"bump_foil%height": LONG, "bump_foil%half_length": LONG, "bump_foil%pitch": 1.0e-4}
    shells = light("shell", 0.1)
    condensed = check_stiff(checks, folder, "shells", shells, few | shape)
    full = check_stiff(checks, folder, "shells, bumps not condensed", with_keys(shells, model={"reduction": "none"}), few)
    two = derived(folder, shells, tuple(few), NAMES, ranks=2)
    for name in (slope_name(name, key) for name in NAMES for key in few):
        checks.below(f"condensed against full: {name}", full[name]/condensed[name] - 1.0, LIMIT)
        checks.below(f"2 ranks: {name}", two[name]/condensed[name] - 1.0, LIMIT)
    check_stiff(checks, folder, "shells with mass", with_keys(shells, top_foil=STEEL, bump_foil=STEEL, foil_damping={"foil_mass": "on"}), few)
    check_stiff(checks, folder, "shells, contacts at faces", with_keys(shells, contact={"contact_surface": "face"}), few)
    plates = with_keys(vibrating(SPRINGS), operation={"load": (-30.0, 3.0)}, mesh={"circumferential_elements": 104}, **PLATE)
    check_stiff(checks, folder, "plates that lift", plates | {"model": {"foil": "plate"}}, few | {"top_foil%thickness": LONG})


def check_heat(checks, folder):
    """Temperatures stay under a vibration, and follow the key with the answer: a cooled channel, centrifugal growth."""
    step = 3.0e-5
    check(checks, folder, "springs with heat, cooled", with_keys(vibrating(SPRINGS), gas=WARM_GAS, **COOLED), dict.fromkeys(
        ("thermal%bump_conductance", "thermal%cooling_flow", "thermal%shaft_expansion", "bearing%clearance", "operation%speed_rpm"), step))


def check_foils_with_heat(checks, folder):
    """Shells that soften with their temperature."""
    shells = with_keys(light("shell", 0.1), gas=WARM_GAS, thermal={**HEAT, "shaft_conductance": 0.3, "modulus_slope": -3.0e-3})
    check_stiff(checks, folder, "shells with heat, which soften", shells,
                dict.fromkeys(("thermal%shaft_conductance", "thermal%modulus_slope", "bump_foil%thickness"), LONG))


def check_ranks(checks, folder):
    """The same on two ranks, though stiff contacts have most of what is rounded: of keys that leave the foils alone."""
    keys = ("gas%viscosity", "bearing%clearance", "operation%load")
    one, two = (derived(folder, light("beam", 0.1), keys, NAMES, ranks) for ranks in (1, 2))
    for slope in (slope_name(name, key) for name in NAMES for key in keys):
        checks.below(f"2 ranks: {slope}", two[slope]/one[slope] - 1.0, 1.0e-8)


def check_gaps(checks, folder):
    """Gaps of 0 against one-sided differences of second order."""
    step, bumps, bump = 1.0e-9, 13, 7
    content = light("beam", 0.1)
    answer = derived(folder, content, (f"bump_foil%crest_gap({bump})",), NAMES)
    there = [solve(folder, "differ", with_keys(content, bump_foil={
        "crest_gap": [times*step if i == bump else 0.0 for i in range(1, bumps + 1)]})).summary for times in (1, 2)]
    for name in NAMES:
        difference = (4.0*there[0][name] - 3.0*answer[name] - there[1][name])/(2.0*step)
        checks.below(f"{name} by crest_gap({bump})", answer[f"d_{name}_d_bump_foil_crest_gap_{bump}"]/difference - 1.0, LIMIT)


def check_sweep_and_none(checks, folder):
    """A sweep has the derivatives of its points; where no shaft whirls there are none, and a warning says so. Others stay as they are."""
    keys, values = ("gas%viscosity",), (60.0, 50.0)
    content = vibrating(SPRINGS, operation={"load": (-60.0, 0.0)})
    asked = {"quantity": ("minimum_gap", *NAMES), "parameters": keys}
    swept = solve(folder, "swept", with_keys(content, sensitivity=asked, sweep={"parameter": "load", "values": values})).history()
    for point, value in enumerate(values):
        alone = with_keys(content, operation={"load": (-value, 0.0)})
        single = derived(folder, alone, keys, ("minimum_gap", *NAMES))
        static = derived(folder, with_keys({group: alone[group] for group in SPRINGS}, scene={"analysis": "equilibrium"}), keys, ("minimum_gap",))
        for name in ("minimum_gap", *NAMES):
            slope = slope_name(name, keys[0])
            checks.below(f"point {point + 1} of a sweep: {slope}", swept[slope][point]/single[slope] - 1.0, LIMIT)
        slope = slope_name("minimum_gap", keys[0])
        checks.below(f"at rest, {value:g} N: {slope}", static[slope]/single[slope] - 1.0, 1.0e-9)
    calm = solve(folder, "calm", vibrating(foils("beam", 0.1), sensitivity=asked))
    checks.that("no shaft whirls: no derivatives of whirl, but of the rest",
                [name for name in calm.summary if name.startswith("d_")] == [slope_name("minimum_gap", keys[0])])
    checks.that("a warning says so", "no derivative of whirl by any key: no rigid shaft whirls" in calm.log)


def main():
    """Runs all checks."""
    run_checks((check_springs, check_heat, check_gaps, check_ranks, check_sweep_and_none), (check_foils, check_foils_with_heat))


if __name__ == "__main__":
    main()
