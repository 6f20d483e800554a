#!/usr/bin/env python3
"""Vibrations and stability of several pads: three pads against three runs of one, symmetry, differences of forces,
ranks, a rotor's modes, folds."""

import math
import tempfile

import h5py
import numpy

from dynamics import SPRINGS, block_error, coefficients
from gfb_run import Checks, solve
from pads import FOILS, PLACE, TURN, of_pads

RATIOS = (0.3, 1.0)
ONE = {"frequency_ratios": (0.5,)}
COARSE = {"mesh": {"arc_elements": 2}, "bump_foil": {"bumps": 5}}
TILT = (1.5e-4, -1.0e-4)
EVEN_AND_ODD = ((0, 0), (1, 1))
DENSE = {group: FOILS[group] | {"density": 8200.0} for group in ("top_foil", "bump_foil")}


def merged(groups, more):
    """Groups of a case with keys of more groups."""
    return groups | {name: groups.get(name, {}) | keys for name, keys in more.items()}


def vibrating(foil, pads, dynamics=None, more=None, **place):
    """Groups of a vibrating bearing of pads."""
    groups = merged(of_pads(foil, pads, **place), more or {})
    groups["scene"] = {"analysis": "linear_dynamics"}
    groups["dynamics"] = ({} if "frequencies" in (dynamics or {}) else {"frequency_ratios": RATIOS}) | (dynamics or {})
    return groups


def vibrate(folder, *args, ranks=1, **more):
    """An answer and its Z."""
    answer = solve(folder, "vibration", vibrating(*args, **more), ranks)
    return answer, coefficients(answer)[1]


CASES = {
    "local springs with losses": ("elastic_foundation", {"loss_factor": 0.1, "foundation_damping": 1.0e5},
                                  {"model": {"foundation_pressure": "local", **SPRINGS}}),
    "mean springs with losses": ("elastic_foundation", {"loss_factor": 0.1, "foundation_damping": 1.0e5},
                                 {"model": {"foundation_pressure": "axial_mean", **SPRINGS}}),
    "beams with mass, asperities, tilted": (
        "beam", {"foil_mass": "on", "loss_factor": 0.02},
        {"operation": {"tilt": TILT}, "shaft_contact": {"roughness": 2.0e-6, "pressure": 2.0e6, "friction": 0.1}} | DENSE),
    "shells with mass": ("shell", {"foil_mass": "on"} | ONE, merged(DENSE, COARSE)),
    "shells that slide on, tilted": ("shell", {"contact_tangent": "slip"} | ONE, {"operation": {"tilt": TILT}} | COARSE),
}


def check_sum(checks, folder):
    """Three pads at a fixed position are three runs of one."""
    for words, (foil, dynamics, more) in CASES.items():
        _, found = vibrate(folder, foil, {"count": 3}, dynamics, more)
        single = [vibrate(folder, foil, {"count": 1, "first_leading_edge": i*TURN}, dynamics, more)[1] for i in range(3)]
        checks.below(f"{words}: Z of three pads", block_error(found, sum(single)), 1.0e-10)


def check_amplitudes(checks, folder):
    """Contacts that slide to and fro, each by itself."""
    case = {"frequency_ratios": (0.5,), "vibration_amplitudes": (1.0e-6, 4.0e-6)}
    found = []
    for pads in ({"count": 3}, *({"count": 1, "first_leading_edge": i*TURN} for i in range(3))):
        answer, _ = vibrate(folder, "beam", pads, case, place=(2.0e-5, 0.9e-5))
        with h5py.File(f"{answer.stem}.h5", "r") as file:
            found.append([file[f"dynamics/{name}_at_amplitude"][...][..., :2] for name in ("stiffness", "damping")]
                         + [file["dynamics/friction_loss_at_amplitude"][...].reshape(-1, 2)])
    for i, words in enumerate(("stiffness", "damping", "loss")):
        total = sum(one[i] for one in found[1:])
        checks.below(f"beams of three pads at amplitudes: {words}",
                     numpy.abs(found[0][i] - total).max()/numpy.abs(total).max(), 1.0e-6)
    checks.that("beams of three pads at amplitudes: contacts lose energy", bool((found[0][2][-1] > 0.0).all()))


def check_symmetry(checks, folder):
    """Pads 120 degrees apart on a centred shaft: the force turns with the motion, the torque with the tilt."""
    _, found = vibrate(folder, "shell", {"count": 3}, place=(0.0, 0.0))
    for name, block in (("translation", found[:, :2, :2]), ("tilts", found[:, 2:, 2:])):
        off = numpy.abs([block[:, 0, 0] - block[:, 1, 1], block[:, 0, 1] + block[:, 1, 0]]).max()
        checks.below(f"shells, centred shaft: {name}", off/numpy.abs(block).max(), 1.0e-9)


def check_static(checks, folder):
    """K next to no frequency against differences of forces and torques, 4 x 4."""
    tight = {"solver": {"residual_tolerance": 1.0e-13, "step_tolerance": 1.0e-11}}
    _, found = vibrate(folder, "beam", {"count": 3}, {"frequencies": (1.0e-3,), "contact_tangent": "slip"},
                       {"operation": {"tilt": TILT}} | tight)
    wanted = numpy.zeros((1, 4, 4))
    for j in range(4):
        move = 1.0e-4*numpy.eye(4)[j]*(3.18e-5 if j < 2 else 2.0*3.18e-5/0.0381)
        at = []
        for place in (numpy.array([*PLACE, *TILT]) + move, numpy.array([*PLACE, *TILT]) - move):
            groups = of_pads("beam", {"count": 3}, tuple(place[:2]))
            answer = solve(folder, "static", merged(groups, {"operation": {"tilt": tuple(place[2:])}} | tight))
            at.append(numpy.array([*(-numpy.array(answer.force)), *answer.torque]))
        wanted[0, :, j] = (at[0] - at[1])/(2.0*move[j])
    checks.below("beams: K(0) against differences of forces", block_error(found.real, wanted), 1.0e-5)


def check_same(checks, folder):
    """Half and whole width, two ranks; an equilibrium, and its place held."""
    more = merged(DENSE, COARSE)
    found = {width: vibrate(folder, "shell", {"count": 3}, {"foil_mass": "on"} | ONE,
                            more | {"model": {"half_width": width}})[1] for width in ("yes", "no")}
    checks.below("shells: half and whole width", block_error(found["yes"], found["no"], EVEN_AND_ODD), 1.0e-9)
    found = [vibrate(folder, "beam", {"count": 3}, {"foil_mass": "on"} | ONE, DENSE, ranks=ranks)[1] for ranks in (1, 2)]
    checks.below("beams: 2 ranks", block_error(found[1], found[0], EVEN_AND_ODD), 1.0e-9)
    answer, balanced = vibrate(folder, "beam", {"count": 3}, load=(-40.0, 0.0))
    held, there = vibrate(folder, "beam", {"count": 3}, place=(answer["eccentricity_x"], answer["eccentricity_y"]))
    checks.below("beams under a load, and held there", block_error(balanced, there, EVEN_AND_ODD), 1.0e-7)
    checks.below("beams under a load, and held there: critical mass",
                 answer["critical_mass"]/held["critical_mass"] - 1.0, 1.0e-6)


def check_rotor(checks, folder):
    """A rotor of the critical mass neither grows nor decays, nor does it at the onset of a sweep over speed."""
    answer, _ = vibrate(folder, "elastic_foundation", {"count": 3}, {}, {"model": SPRINGS}, load=(-20.0, 0.0))
    more = {"model": SPRINGS, "rotor": {"mass": answer["critical_mass"]}}
    rotor, _ = vibrate(folder, "elastic_foundation", {"count": 3}, {}, more, load=(-20.0, 0.0))
    omega = 45000.0*math.pi/30.0
    checks.below("a rotor of the critical mass: growth over the speed", rotor["growth_rate"]/omega, 1.0e-8)
    checks.below("its frequency", rotor["whirl_frequency"]/omega/answer["whirl_ratio"] - 1.0, 1.0e-8)
    more["sweep"] = {"parameter": "speed_rpm", "values": (42000.0, 48000.0)}
    swept = solve(folder, "onset", vibrating("elastic_foundation", {"count": 3}, {}, more, load=(-20.0, 0.0)))
    checks.below("onset of a sweep over speed", swept["onset_speed_rpm"]/45000.0 - 1.0, 1.0e-6)


def check_stability(checks, folder):
    """The modes of three pads are those of each, and so is their stiffness against tilts."""
    solver = {"solver": {"stability": True}, "sweep": {"parameter": "tilt_y", "values": (0.0, 1.0e-4)}}
    answers = []
    for pads in ({"count": 3}, *({"count": 1, "first_leading_edge": i*TURN} for i in range(3))):
        answers.append(solve(folder, "stability", of_pads("beam", pads, (2.2e-5, 0.9e-5), **solver)))
    three, single = answers[0], answers[1:]
    for name in ("stability", "growing_modes"):
        checks.that(f"beams: {name} of three pads", three[name] == sum(one[name] for one in single))
    checks.below("beams: margin of the least stable pad",
                 three["stability_margin"]/min(one["stability_margin"] for one in single) - 1.0, 1.0e-6)
    for name in ("angular_stiffness_yy", "angular_stiffness_xy"):
        total = sum(one[name] for one in single)
        checks.below(f"beams: {name} of three pads", three[name]/total - 1.0, 1.0e-9)


def check_folds(checks, folder):
    """A branch is followed round its fold: both its sides are equilibria, with determinants of either sign."""
    more = {"top_foil": {"fixed_edge": "trailing"}, "bump_foil": {"fixed_edge": "trailing"},
            "sweep": {"parameter": "load", "values": (60.0, 30.0, 20.0), "turn_folds": True}}
    answer = solve(folder, "folds", merged(of_pads("beam", {"count": 3, "preload": 0.0}, load=(-60.0, 0.0)), more))
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        load, force, sign, place, firmness = (file[f"history/{name}"][...] for name in (
            "load", "force_x", "determinant_sign", "eccentricity_y", "edge_stiffness"))
        edges = numpy.array([file[f"history/edge_stiffness_{i}"][...] for i in (1, 2, 3)])
    checks.that("beams: there and back round a fold", list(load[[0, 1, 3, 4]]) == [60.0, 30.0, 30.0, 60.0]
                and 20.0 < load[2] < 30.0)
    checks.below("beams: equilibria on both sides of a fold", abs(force/load + 1.0).max(), 1.0e-7)
    checks.that("beams: they are different", abs(place[3] - place[1]) > 1.0e-8)
    checks.that("beams: the determinant changes its sign at a fold", sign[0] == sign[1] == -sign[3] == -sign[4])
    checks.that("beams: so does the least of the edges' stiffnesses", firmness[1]*firmness[3] < 0.0
                and numpy.array_equal(edges.min(axis=0), firmness))


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        for check in (check_sum, check_amplitudes, check_symmetry, check_static, check_same, check_rotor, check_stability,
                      check_folds):
            check(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
