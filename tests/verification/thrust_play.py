#!/usr/bin/env python3
"""A runner between two bearings: what both do is what two single bearings do, whose runs share no equation with it."""

import pathlib
import tempfile

import numpy

from gfb_run import Checks, solve
from thrust import PADS, SPRINGS, TIGHT, coefficients, thrust
from thrust_shell import SMOOTH, shells

PLAY = 6.0e-5
GAP = 2.2e-5
TILT = (6.0e-5, -9.0e-5)
FREQUENCIES = {"dynamics": {"frequencies": (500.0, 4000.0)}}


def single(folder, name, gap, tilt, model):
    """One of the two alone: its force, its torque, what it brakes with, its thinnest film, stiffness and damping."""
    answer = solve(folder, name, thrust({"axial_gap": gap, "tilt": tilt}, "linear_dynamics", model, **FREQUENCIES, **TIGHT))
    return numpy.array([answer[key] for key in ("axial_force", "torque_x", "torque_y", "friction_torque")]), \
        answer["minimum_gap"], *coefficients(answer)


def check_held(checks, folder, title, model, tilt):
    """Held: b of the other side has the other sign, so its forces count negative, its stiffness as it is."""
    play = {"bearing": {"axial_play": PLAY}}
    answer = solve(folder, f"both_{title}", thrust({"axial_gap": GAP, "tilt": tilt}, "linear_dynamics", model, **play, **FREQUENCIES, **TIGHT))
    one = single(folder, f"one_{title}", GAP, tilt, model)
    other = single(folder, f"other_{title}", PLAY - GAP, tuple(-value for value in tilt), model)
    wanted = one[0] + numpy.array([-1.0, -1.0, -1.0, 1.0])*other[0]
    found = numpy.array([answer[key] for key in ("axial_force", "torque_x", "torque_y", "friction_torque")])
    checks.below(f"{title}: force, torques, over those of two bearings", float(numpy.abs(found - wanted).max()/abs(wanted[0])), 1.0e-11)
    checks.below(f"{title}: opposite force", answer["opposite_force"]/other[0][0] - 1.0, 1.0e-11)
    checks.below(f"{title}: opposite gap [m]", answer["opposite_gap"] - (PLAY - GAP), 1.0e-18)
    checks.below(f"{title}: opposite film", answer["opposite_minimum_gap"]/other[1] - 1.0, 1.0e-10)
    checks.below(f"{title}: film", answer["minimum_gap"]/min(one[1], other[1]) - 1.0, 1.0e-10)
    shares = [answer[f"axial_force_{pad + 1}"] for pad in range(2*PADS)]
    checks.below(f"{title}: shares of the pads", sum(shares)/answer["axial_force"] - 1.0, 1.0e-11)
    for quantity, both, first, second in zip(("stiffness", "damping"), coefficients(answer), one[2:], other[2:], strict=True):
        size = numpy.abs(first + second).max(axis=(1, 2), keepdims=True)
        checks.below(f"{title}: {quantity}", float((numpy.abs(both - first - second)/size).max()), 1.0e-9)
    checks.that(f"{title}: pads solved", answer["pads_solved"] == (2*PADS if any(tilt) else 2))
    return answer


def check_loads(checks, folder):
    """Without a load the runner stands in the middle; a load of the other sense is its mirror image."""
    groups = {"bearing": {"axial_play": PLAY}, **TIGHT}
    middle = solve(folder, "middle", thrust({"axial_load": 0.0}, "equilibrium", SPRINGS, **groups))
    checks.below("no load: in the middle [m]", middle["axial_gap"] - 0.5*PLAY, 1.0e-12)
    down, up = (solve(folder, name, thrust({"axial_load": load}, "equilibrium", SPRINGS, **groups)) for name, load in (
        ("down", 60.0), ("up", -60.0)))
    checks.below("60 N one way and the other: gaps", down["axial_gap"]/up["opposite_gap"] - 1.0, 1.0e-9)
    checks.below("60 N: films", down["minimum_gap"]/up["opposite_minimum_gap"] - 1.0, 1.0e-9)
    alone = solve(folder, "alone", thrust({"axial_gap": down["axial_gap"]}, model=SPRINGS))
    against = solve(folder, "against", thrust({"axial_gap": PLAY - down["axial_gap"]}, model=SPRINGS))
    checks.below("60 N: the difference of two bearings", (alone["axial_force"] - against["axial_force"])/60.0 - 1.0, 1.0e-7)
    wide = solve(folder, "wide", thrust({"axial_load": 60.0}, "equilibrium", SPRINGS, **(groups | {"bearing": {"axial_play": 2.0e-3}})))
    one = solve(folder, "one", thrust({"axial_load": 60.0}, "equilibrium", SPRINGS, **TIGHT))
    checks.below("far from the other one: one bearing", wide["axial_gap"]/one["axial_gap"] - 1.0, 1.0e-3)


def check_moment(checks, folder):
    """Tilts that are unknown, two ranks."""
    groups = thrust({"axial_load": 40.0, "moment": (0.15, -0.1)}, "equilibrium", SPRINGS, bearing={"axial_play": PLAY}, **TIGHT)
    one, two = (solve(folder, f"moment_{ranks}", groups, ranks=ranks) for ranks in (1, 2))
    checks.below("moment: force", one["axial_force"]/40.0 - 1.0, 1.0e-9)
    checks.below("moment: its torque", abs(one["torque_x"] + 0.15) + abs(one["torque_y"] - 0.1), 1.0e-9)
    checks.below("moment: two ranks", two["minimum_gap"]/one["minimum_gap"] - 1.0, 1.0e-9)


def check_rotor(checks, folder):
    """The stiffness of both sides holds the rotor: a heavy one moves at the square root of it over its mass."""
    mass = 3.0e3
    answer = solve(folder, "rotor", thrust({"axial_load": 20.0}, "linear_dynamics", bearing={"axial_play": PLAY}, rotor={"mass": mass},
                                           dynamics={"frequencies": (1.0,)}))
    stiffness, _ = coefficients(answer)
    checks.below("a heavy rotor between both", answer["axial_frequency"]/(stiffness[0][0, 0]/mass)**0.5 - 1.0, 1.0e-3)


def check_shells(checks, folder):
    """Both foils on both sides, without friction, whose forces keep how they came about."""
    groups = shells({"axial_load": 30.0}, contact=SMOOTH)
    groups["bearing"] = groups["bearing"] | {"axial_play": PLAY}
    both = solve(folder, "shells", groups)
    alone = solve(folder, "shells_one", shells({"axial_gap": both["axial_gap"]}, "fixed_position", contact=SMOOTH))
    other = solve(folder, "shells_other", shells({"axial_gap": PLAY - both["axial_gap"]}, "fixed_position", contact=SMOOTH))
    checks.below("shells: the difference of two bearings", (alone["axial_force"] - other["axial_force"])/30.0 - 1.0, 1.0e-6)
    checks.below("shells: deflection", both["maximum_deflection"]/alone["maximum_deflection"] - 1.0, 1.0e-6)
    names = {path.name for path in both.stem.parent.glob("shells.*.vtkhdf")}
    checks.that("shells: a film a side, foils of all pads", {"shells.film.vtkhdf", "shells.film_2.vtkhdf"} <= names
                and sum(".top_foil_" in name for name in names) == 2*PADS)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for title, model, tilt in (("rigid", {"foil": "rigid"}, (0.0, 0.0)), ("tilted", {"foil": "rigid"}, TILT), ("springs", SPRINGS, TILT)):
            check_held(checks, folder, title, model, tilt)
        check_loads(checks, folder)
        check_moment(checks, folder)
        check_rotor(checks, folder)
        check_shells(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
