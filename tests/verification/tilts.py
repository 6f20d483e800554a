#!/usr/bin/env python3
"""Stiffness and damping of all four motions of a journal under every foil, solved on half and on the whole width: against differences
of the forces and torques of fixed positions, of which a tilted one is always solved on the whole width, against each other, and
against a rotor that tilts over time. Without --long: modes of a rotor on both widths.

A tilt is no mirror image: where half the width is solved, pressures and foils move against those of the other half.
"""

import math

import numpy

from dynamics import block_error, coefficients
from gfb_run import run_checks, solve
from rotor import modes_of, speed_of
from transient import history, modes_in

CLEARANCE, LENGTH = 15.0e-6, 0.012
METAL = {"thickness": 1.0e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29, "fixed_edge": "leading"}
BUMPS = METAL | {"half_length": 1.2e-3, "height": 3.5e-4, "bumps": 12}
SHEETS = {"top_foil": METAL, "bump_foil": BUMPS}
SPRINGS = {"foil": "elastic_foundation", "foundation_stiffness": 5.0e9}
TIGHT = {"residual_tolerance": 1.0e-13, "step_tolerance": 1.0e-11}
FOILS = {
    "rigid": ({"foil": "rigid"}, {}),
    "springs under each point": (SPRINGS | {"foundation_pressure": "local"}, {}),
    "springs under the mean along the axis": (SPRINGS | {"foundation_pressure": "axial_mean"}, {}),
    "beams": ({"foil": "beam"}, SHEETS),
    "plates on springs that hold": ({"foil": "plate", "crest_springs": "two_sided"}, SHEETS),
    "plates on springs that push": ({"foil": "plate"}, SHEETS),
    "plates on springs at points": ({"foil": "plate", "spring_pitch": LENGTH/5.0}, SHEETS),
    "shells": ({"foil": "shell"}, SHEETS | {"mesh": {"arc_elements": 4, "flat_elements": 2}}),
}
PLACE = (0.3*CLEARANCE, -0.1*CLEARANCE)
ROTOR = {"transverse_inertia": 2.0e-5, "polar_inertia": 2.4e-6, "bearing_distance": 0.0192}


def journal(foil, analysis, operation, **more):
    """Groups of a small bearing."""
    model, sheets = FOILS[foil]
    groups = {"scene": {"analysis": analysis}, "bearing": {"radius": 6.0e-3, "length": LENGTH, "clearance": CLEARANCE},
              "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5}, "operation": {"speed_rpm": 60000.0} | operation,
              "solver": TIGHT, "mesh": {"circumferential_elements": 24, "axial_elements": 4, "align_crests": False}, "model": model}
    for group, keys in (sheets | more).items():
        groups[group] = groups.get(group, {}) | keys
    return groups


def vibrate(folder, foil, frequencies, width="auto", ranks=1):
    """Z of a held shaft."""
    content = journal(foil, "linear_dynamics", {"eccentricity": PLACE}, model={"half_width": width}, dynamics=frequencies)
    return coefficients(solve(folder, "vibrate", content, ranks))


def static_force(folder, foil, place):
    """Minus the force on the sleeve, and the torque on the shaft: what a positive stiffness lets grow."""
    answer = solve(folder, "static", journal(foil, "fixed_position", {"eccentricity": tuple(place[:2]), "tilt": tuple(place[2:])}))
    return numpy.array([-answer["force_x"], -answer["force_y"], answer["torque_x"], answer["torque_y"]])


def check_widths(checks, folder):
    """K next to zero frequency against differences, K and C at others on both widths."""
    for foil in FOILS:
        _, slow = vibrate(folder, foil, {"frequencies": 1.0e-3})
        wanted = numpy.zeros((1, 4, 4))
        for j in range(4):
            width = 2.0e-4*CLEARANCE*(1.0 if j < 2 else 2.0/LENGTH)
            ahead, behind = (static_force(folder, foil, numpy.array([*PLACE, 0.0, 0.0]) + sign*width*numpy.eye(4)[j]) for sign in (1.0, -1.0))
            wanted[0, :, j] = (ahead - behind)/(2.0*width)
        for words, block in (("translation", (0, 0)), ("tilts", (1, 1))):
            checks.below(f"{foil}, half width: K(0) of {words} against differences", block_error(slow.real, wanted, (block,)), 1.0e-6)
        half, whole = (vibrate(folder, foil, {"frequency_ratios": (0.5, 1.5)}, width)[1] for width in ("yes", "no"))
        checks.below(f"{foil}, half and whole width: K and C of translation", block_error(half, whole, ((0, 0),)), 1.0e-8)
        checks.below(f"{foil}, half and whole width: K and C of tilts", block_error(half, whole, ((1, 1),)), 1.0e-8)


def check_ranks(checks, folder):
    """Plates on half the width on two ranks, where those of tilts have no springs at z = 0."""
    one, two = (vibrate(folder, "plates on springs that push", {"frequency_ratios": 0.5}, ranks=ranks)[1] for ranks in (1, 2))
    checks.below("plates on springs that push, two ranks: K and C", block_error(two, one, ((0, 0), (1, 1))), 1.0e-8)


def check_march(checks, folder):
    """A rotor on plates that a couple has pushed a little decays as its conical mode does."""
    foil = "plates on springs that hold"
    operation, rotor = {"load": (-5.0, 1.0)}, {"rotor": {"mass": 0.088} | ROTOR}
    linear = journal(foil, "linear_dynamics", operation, dynamics={"frequency_ratios": 0.5}, **rotor)
    omega = speed_of(linear)
    growth, frequency, _, kind, _ = modes_of(solve(folder, "modes", linear))
    mine = (kind == 2) & (frequency > 0.0)
    wanted = (growth + 1j*frequency)[mine][numpy.argmax(growth[mine])]
    push = 1.0e-4*CLEARANCE/LENGTH*ROTOR["transverse_inertia"]*omega
    content = journal(foil, "transient", operation, transient={
        "turns": 6, "steps_per_turn": 60, "couple_pulse": (push, 0.3*push), "pulse_length": 0.5*math.pi/omega}, **rotor)
    rows = history(solve(folder, "march", content))
    late = {name: values[rows["turns"] >= 2.0] for name, values in rows.items()}
    found = min(modes_in(late, 4.0, 5, "tilt"), key=lambda one: abs(one - wanted))
    checks.below("rotor on plates: conical mode over time against that of half the width, over the speed",
                 abs(found - wanted)/omega, 1.0e-5)


def check_modes(checks, folder):
    """Modes of both kinds of a rotor on half the width, where tilts have foils of their own, are ones of the whole width, which has others of
    films alone that are against the mirror of the motions."""
    for foil in ("plates on springs that hold", "shells"):
        modes = []
        for width in ("yes", "no"):
            content = journal(foil, "linear_dynamics", {"load": (-5.0, 1.0)}, dynamics={"frequency_ratios": 0.5}, model={"half_width": width},
                              rotor={"mass": 0.088} | ROTOR)
            growth, frequency, _, kind, _ = modes_of(solve(folder, "modes", content))
            modes.append((growth + 1j*frequency, kind))
        (half, kinds), (whole, others) = modes
        checks.that(f"{foil}: modes of both kinds", {1, 2} <= set(kinds))
        checks.below(f"{foil}: modes on half and whole width", max(abs(whole[others == kind]/rate - 1.0).min() for rate, kind in zip(half, kinds)),
                     1.0e-7)


if __name__ == "__main__":
    run_checks((check_modes,), (check_widths, check_ranks, check_march))
