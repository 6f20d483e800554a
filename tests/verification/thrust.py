#!/usr/bin/env python3
"""Thrust bearings, rigid and on springs: closed forms, an independent solution, one pad against all, turned bearings, differences
of forces and of answers, profiles of pads, strips side by side, limits, ranks.

`--long` has all rows of the reference."""

import json
import math
import pathlib
import sys
import tempfile

import h5py
import numpy

from gfb_run import Checks, observed_order, solve

REFERENCE = {row["id"]: row for row in
             json.loads((pathlib.Path(__file__).parent/"reference"/"thrust.json").read_text(encoding="utf-8"))}
FEW = ("rigid-0", "rigid_tilted-3", "foundation_mean-9", "foundation_strips-11", "foundation_moment-15", "foundation_radial-22")
RADII = (0.05, 0.025)
ARC = math.pi/4.0
PADS = 6
SPEED_RPM = 40000.0
VISCOSITY = 1.85e-5
SPRINGS = {"foil": "elastic_foundation", "foundation_stiffness": 1.0e10}
TIGHT = {"solver": {"residual_tolerance": 1.0e-13, "step_tolerance": 1.0e-12}}


def thrust(operation, analysis="fixed_position", model=None, **more):
    """Groups of a bearing with a ramp over half of each pad."""
    groups = {"scene": {"analysis": analysis}, "bearing": {"kind": "thrust", "outer_radius": RADII[0], "inner_radius": RADII[1]},
              "pads": {"count": PADS, "arc": ARC}, "ramp": {"part": 0.5, "height": 2.0e-5},
              "gas": {"viscosity": VISCOSITY, "ambient_pressure": 101325.0},
              "operation": {"speed_rpm": SPEED_RPM} | operation, "model": model or {"foil": "rigid"},
              "mesh": {"circumferential_elements": 16, "radial_elements": 8}}
    for group, keys in more.items():
        groups[group] = groups.get(group, {}) | keys
    return groups


def coefficients(answer):
    """Stiffness and damping, [frequency, row, column]."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        return [numpy.reshape(file[f"dynamics/{name}"][...], (-1, 3, 3)) for name in ("stiffness", "damping")]


def referred(row, **more):
    """The groups of a row of the reference."""
    return {"scene": {"analysis": "linear_dynamics"}} | {name: dict(keys) for name, keys in row["input"].items()} | more


def check_reference(checks, folder, names):
    for name in names:
        row = REFERENCE[name]
        answer, wanted = solve(folder, name, referred(row)), row["output"]
        shown = dict.fromkeys(("axial_force", "friction_torque", "minimum_gap", "axial_gap"), 2.0e-3) | \
            {"centre_radius": 1.0e-4, "centre_angle": 5.0e-4, "maximum_deflection": 1.0e-3}
        for quantity, limit in shown.items():
            if abs(wanted.get(quantity, 0.0)) > 0.0:
                checks.below(f"{name}: {quantity}", answer[quantity]/wanted[quantity] - 1.0, limit + 5.0e-4*(name == "foundation_moment-15"))
        for quantity, found in zip(("stiffness", "damping"), coefficients(answer), strict=True):
            there = numpy.array(wanted[quantity])
            size = numpy.sqrt(numpy.abs(numpy.outer(there[0].diagonal(), there[0].diagonal())))
            checks.below(f"{name}: {quantity}", float((numpy.abs(found - there)/size).max()), 5.0e-3)


def check_closed_form(checks, folder):
    """Between flat parallel faces there is Couette flow alone: torque mu Omega N arc (R_o^4 - R_i^4)/(4 d)."""
    groups = thrust({"axial_gap": 1.0e-5})
    del groups["ramp"]
    answer = solve(folder, "flat", groups)
    omega = SPEED_RPM*math.pi/30.0
    torque = VISCOSITY*omega*PADS*ARC*(RADII[0]**4 - RADII[1]**4)/(4.0*1.0e-5)
    checks.below("flat pads: friction torque over the closed form", answer["friction_torque"]/torque - 1.0, 1.0e-12)
    checks.below("flat pads: axial force [N]", answer["axial_force"], 1.0e-9)


def check_squeeze(checks, folder):
    """A narrow flat pad at rest that is squeezed: the rectangle's series of sines, to the width over the radius squared.

    Of p' in G (p'_xx + p'_yy) - i omega h p' = i omega p_a h' with G = p_a h^3/(12 mu): Z = - int p' dA/h'.
    """
    height, width, radius = 1.0e-5, 0.01, 1.0
    given = {"foil": "rigid"}, {"dynamics": {"frequencies": (2000.0, 60000.0)}}
    answer = solve(folder, "squeezed", {"scene": {"analysis": "linear_dynamics"},
                                        "bearing": {"kind": "thrust", "outer_radius": radius + 0.5*width, "inner_radius": radius - 0.5*width},
                                        "pads": {"count": 1, "arc": 1.5*width/radius}, "gas": {"viscosity": VISCOSITY, "ambient_pressure": 101325.0},
                                        "operation": {"speed_rpm": 0.0, "axial_gap": height}, "model": given[0], **given[1],
                                        "mesh": {"circumferential_elements": 32, "radial_elements": 24, "edge_refinement": 4.0}})
    conductance, area = 101325.0*height**3/(12.0*VISCOSITY), 1.5*width**2
    odd = numpy.arange(1, 400, 2)
    m, n = numpy.meshgrid(odd, odd)
    wave = (math.pi*m/(1.5*width))**2 + (math.pi*n/width)**2
    stiffness, damping = coefficients(answer)
    for i, omega in enumerate(given[1]["dynamics"]["frequencies"]):
        exact = area*(64.0/(math.pi**4*m**2*n**2)*1j*omega*101325.0/(conductance*wave + 1j*omega*height)).sum()
        found = stiffness[i, 0, 0] + 1j*omega*damping[i, 0, 0]
        checks.below(f"a flat pad squeezed at {omega:g} rad/s against the series", abs(found/exact - 1.0), 1.0e-3)


def check_order(checks, folder):
    """The force of bilinear elements by Galerkin errs with the square of their size."""
    there = REFERENCE["rigid-0"]["output"]["axial_force"]
    scheme = {"foil": "rigid", "film_order": 1, "film_scheme": "galerkin"}
    coarse, fine = (solve(folder, "order", thrust({"axial_gap": 1.0e-5}, model=scheme, mesh={
        "circumferential_elements": 2*rows, "radial_elements": rows, "edge_refinement": 1.0}))["axial_force"] - there
        for rows in (16, 32))
    order = observed_order(coarse, fine)
    checks.that(f"order of the axial force: {order:.2f} (within 0.2 of 2)", abs(order - 2.0) < 0.2)


def check_one_pad(checks, folder):
    """One pad that stands for all against all of them; the bearing turned with its tilt."""
    vibration = {"dynamics": {"frequency_ratios": 0.5}} | TIGHT
    one = solve(folder, "one", thrust({"axial_load": 150.0}, "linear_dynamics", SPRINGS, **vibration))
    every = solve(folder, "all", thrust({"axial_load": 150.0, "tilt": (1.0e-30, 0.0)}, "linear_dynamics", SPRINGS, **vibration))
    checks.that("an aligned runner: one pad is solved, of a tilted one all", (one["pads_solved"], every["pads_solved"]) == (1, PADS))
    for name in ("axial_gap", "friction_torque", "maximum_pressure", "axial_force_4"):
        checks.below(f"one pad against all: {name}", one[name]/every[name] - 1.0, 1.0e-11)
    for name, first, second in zip(("K", "C"), coefficients(one), coefficients(every), strict=True):
        size = numpy.sqrt(numpy.abs(numpy.outer(first[0].diagonal(), first[0].diagonal())))
        checks.below(f"one pad against all: {name}", float((numpy.abs(first - second)/size).max()), 1.0e-10)
    with h5py.File(f"{one.stem}.film.vtkhdf", "r") as file, h5py.File(f"{every.stem}.film.vtkhdf", "r") as other:
        for name in ("Points", "PointData/pressure", "PointData/theta", "PointData/pad"):
            values, there = file[f"VTKHDF/{name}"][...], other[f"VTKHDF/{name}"][...]
            checks.below(f"one pad against all: {name} of the film file", float(numpy.abs(values - there).max()/numpy.abs(there).max()),
                         1.0e-10)
    tilt = numpy.array([6.0e-5, -3.0e-5])
    angle = 2.0*math.pi/PADS
    turned = (tilt[0]*math.cos(angle) - tilt[1]*math.sin(angle), tilt[0]*math.sin(angle) + tilt[1]*math.cos(angle))
    before = solve(folder, "before", thrust({"axial_gap": 1.2e-5, "tilt": tuple(tilt)}, **TIGHT))
    after = solve(folder, "after", thrust({"axial_gap": 1.2e-5, "tilt": turned}, **TIGHT))
    checks.below("turned by a pad with its tilt: axial force", after["axial_force"]/before["axial_force"] - 1.0, 1.0e-12)
    checks.below("turned by a pad with its tilt: torque", math.hypot(after["torque_x"], after["torque_y"]) /
                 math.hypot(before["torque_x"], before["torque_y"]) - 1.0, 1.0e-11)


def check_differences(checks, folder):
    """K at a slow vibration against differences of forces; derivatives by keys against differences of answers."""
    place = {"axial_gap": 9.0e-6, "tilt": (5.0e-5, -2.0e-5)}
    slow = solve(folder, "slow", thrust(place, "linear_dynamics", SPRINGS, dynamics={"frequency_ratios": 1.0e-6}, **TIGHT))
    stiffness = coefficients(slow)[0][0]

    def force(step):
        moved = {"axial_gap": place["axial_gap"] + step[0], "tilt": (place["tilt"][0] + step[1], place["tilt"][1] + step[2])}
        answer = solve(folder, "held", thrust(moved, model=SPRINGS, **TIGHT))
        return numpy.array([-answer["axial_force"], answer["torque_x"], answer["torque_y"]])

    # e_z is minus the gap, and the force on the sleeve minus that on the runner, as the torque is the shaft's.
    for column, (name, step) in enumerate({"axial gap": 2.0e-9, "tilt about x": 4.0e-8, "tilt about y": 4.0e-8}.items()):
        move = numpy.eye(3)[column]*step
        rate = (force(move) - force(-move))/(2.0*step)
        scale = numpy.sqrt(stiffness[column, column]*stiffness.diagonal())
        sign = numpy.array([1.0, -1.0, -1.0]) if column == 0 else numpy.array([-1.0, 1.0, 1.0])
        checks.below(f"stiffness by differences of forces: {name}", float((numpy.abs(stiffness[:, column] - sign*rate)/scale).max()), 1.0e-6)
    named = {"ramp%height": ("ramp", "height", 2.0e-5), "gas%viscosity": ("gas", "viscosity", VISCOSITY),
             "operation%axial_load": ("operation", "axial_load", 150.0)}
    derived = solve(folder, "derived", thrust({"axial_load": 150.0}, "equilibrium", SPRINGS, sensitivity={
        "quantity": ("axial_gap", "friction_torque", "minimum_gap"), "parameters": tuple(named)}, **TIGHT))
    for key, (group, name, value) in named.items():
        step = 1.0e-4*value
        content = thrust({"axial_load": 150.0}, "equilibrium", SPRINGS, **TIGHT)
        ahead, behind = (solve(folder, "moved", content | {group: content[group] | {name: value + sign*step}}) for sign in (1.0, -1.0))
        for quantity in ("axial_gap", "friction_torque", "minimum_gap"):
            rate = (ahead[quantity] - behind[quantity])/(2.0*step)
            found = derived[f"d_{quantity}_d_{group}_{name}"]
            checks.below(f"{quantity} by {key} against differences", found/rate - 1.0, 1.0e-5)
    held = {"axial_gap": 1.2e-5}
    by_gap = solve(folder, "derived", thrust(held, model=SPRINGS, sensitivity={
        "quantity": ("axial_force", "friction_torque"), "parameters": "operation%axial_gap"}, **TIGHT))
    spring = coefficients(solve(folder, "coefficients", thrust(held, "linear_dynamics", SPRINGS, dynamics={"frequencies": 1.0e-3}, **TIGHT)))[0]
    checks.below("axial force by the gap that is held: minus the stiffness", by_gap["d_axial_force_d_operation_axial_gap"]/-spring[0, 0, 0] - 1.0, 1.0e-6)
    swept = solve(folder, "swept", thrust({"axial_load": 150.0}, "equilibrium", SPRINGS, sweep={"parameter": "axial_load", "values": (100.0, 150.0)},
                  sensitivity={"quantity": "axial_gap", "parameters": "operation%axial_load"}, **TIGHT))
    checks.below("a sweep of the load has the derivative of its last point", swept.history()["d_axial_gap_d_operation_axial_load"][-1]/
                 derived["d_axial_gap_d_operation_axial_load"] - 1.0, 1.0e-7)


def check_profiles(checks, folder):
    """Pads whose measured profile is a wedge are those with a ramp, and so are pads with some of both; derivatives by either."""
    starts = [2.0*math.pi*pad/PADS for pad in range(PADS)]
    angles = [start + share*ARC for start in starts for share in (0.0, 0.5, 1.0)]

    def pads(profile, ramp, **more):
        groups = thrust({"axial_load": 150.0}, "equilibrium", SPRINGS, **TIGHT, **more)
        bore = {"profile_angle": angles, "profile_height": [-profile, 0.0, 0.0]*PADS}
        groups = groups | {"ramp": {"part": 0.5, "height": ramp}} | ({"bore": bore} if profile > 0.0 else {})
        return {name: keys for name, keys in groups.items() if name != "ramp" or ramp > 0.0}

    ramp, wedge, both = (solve(folder, "profile", pads(*heights)) for heights in ((0.0, 2.0e-5), (2.0e-5, 0.0), (5.0e-6, 1.5e-5)))
    for quantity in ("axial_gap", "friction_torque", "minimum_gap"):
        checks.below(f"pads with a wedge as their profile and pads with a ramp: {quantity}", wedge[quantity]/ramp[quantity] - 1.0, 1.0e-9)
        checks.below(f"pads with a part of the ramp in their profile: {quantity}", both[quantity]/ramp[quantity] - 1.0, 1.0e-9)
    held = {"axial_gap": 1.2e-5}
    waves = {"waves": 2*PADS, "wave_amplitude": 2.0e-6, "wave_angle": 0.3}
    derived = solve(folder, "derived", thrust(held, bore=waves, sensitivity={
        "quantity": "axial_force", "parameters": ("bore%wave_amplitude", "ramp%height")}, **TIGHT))
    for group, name, value in (("bore", "wave_amplitude", 2.0e-6), ("ramp", "height", 2.0e-5)):
        ahead, behind = (solve(folder, "moved", thrust(held, **({"bore": waves} | {group: {"bore": waves, "ramp": {}}[group] | {
            name: value*(1.0 + step)}}), **TIGHT))["axial_force"] for step in (1.0e-4, -1.0e-4))
        found = derived[f"d_axial_force_d_{group}_{name}"]*2.0e-4*value
        checks.below(f"axial force by {group}%{name}, of waves on ramps, against differences", found/(ahead - behind) - 1.0, 1.0e-5)


def check_rotor(checks, folder):
    """A heavy rotor moves along its axis as stiffness and damping at its frequency say."""
    held = {"axial_gap": 9.0e-6}
    mass = 800.0
    found = solve(folder, "rotor", thrust(held, "linear_dynamics", SPRINGS, dynamics={"frequency_ratios": 0.02}, rotor={"mass": mass}, **TIGHT))
    there = solve(folder, "there", thrust(held, "linear_dynamics", SPRINGS, dynamics={"frequencies": found["axial_frequency"]}, **TIGHT))
    checks.below("a heavy rotor: frequency", found["axial_frequency"]/math.sqrt(there["stiffness_zz"]/mass) - 1.0, 1.0e-4)
    checks.below("a heavy rotor: growth", found["growth_rate"]/(-0.5*there["damping_zz"]/mass) - 1.0, 1.0e-3)


def check_strips(checks, folder):
    """Strips of one stiffness are the foundation without strips; a stiffer inner strip holds the inner edge."""
    strips = {"foil": "elastic_foundation", "cut_radii": (0.033, 0.042)}
    whole, cut = (solve(folder, name, thrust({"axial_load": 150.0}, "equilibrium", model, **TIGHT)) for name, model in (
        ("whole", SPRINGS), ("cut", strips | {"strip_foundation_stiffness": (1.0e10, 1.0e10, 1.0e10)})))
    checks.below("three strips of one stiffness: axial gap", cut["axial_gap"]/whole["axial_gap"] - 1.0, 2.0e-3)  # rows lie elsewhere


def check_limits(checks, folder):
    """At the load capacity an equilibrium has the smallest film; a runner that a tilt lets touch is refused."""
    found = solve(folder, "capacity", thrust({"axial_load": 100.0}, "load_capacity", SPRINGS, capacity={"smallest_gap": 3.0e-6}))
    there = solve(folder, "there", thrust({"axial_load": found["load_capacity"]}, "equilibrium", SPRINGS))
    checks.below("equilibrium at the load capacity: smallest film", there["minimum_gap"]/3.0e-6 - 1.0, 1.0e-6)
    leaning = solve(folder, "leaning", thrust({"axial_load": 100.0}, "misalignment_allowance", SPRINGS, capacity={"smallest_gap": 3.0e-6}))
    there = solve(folder, "tilted", thrust({"axial_load": 100.0, "tilt": (leaning["misalignment_allowance"], 0.0)}, "equilibrium", SPRINGS))
    checks.below("equilibrium at the misalignment allowance: smallest film", there["minimum_gap"]/3.0e-6 - 1.0, 1.0e-6)
    refused = solve(folder, "touching", thrust({"axial_load": 200.0, "tilt": (1.5e-4, 0.0)}, "equilibrium", SPRINGS), status=2)
    checks.that("200 N on a runner tilted by 0.15 mrad: touch-down, which the log says", "touches down" in refused.log)


def check_tilted_starts(checks, folder):
    """A runner with a given tilt begins where the film is open: an independent finite-volume film, and the answers that other
    starts lead to; between two bearings, too, where a tilt that takes all of the play is refused."""
    ramp = {"part": 0.17777777777777778, "height": 2.0e-5}

    def gap(name, tilt, more=None, foil=None, **groups):
        return solve(folder, name, thrust({"axial_load": 40.0, "tilt": tilt} | (more or {}), "equilibrium", foil, ramp=ramp, **TIGHT, **groups))

    found = gap("tilted_start", (0.0, 4.0e-4))
    checks.below("tilt of 0.4 mrad: axial gap of an independent film", found["axial_gap"]/29.21e-6 - 1.0, 2.0e-3)
    checks.below("tilt of 0.4 mrad: smallest film of it", found["minimum_gap"]/9.408e-6 - 1.0, 2.0e-3)
    for foil, name in ((None, "rigid"), (SPRINGS | {"foundation_pressure": "local"}, "springs")):
        for size, load in ((4.0e-4, 40.0), (6.0e-4, 40.0), (2.0e-3, 5.0)):
            here, there = (gap("tilted_start", (0.0, size), {"axial_load": load} | more, foil)
                           for more in ({}, {"axial_gap": 1.0e-4 + 0.05*size}))
            checks.below(f"{name}, tilt of {size:.1e}: as from a wide gap", here["minimum_gap"]/there["minimum_gap"] - 1.0, 1.0e-9)
        near, wide = (gap("tilted_start", (0.0, 6.0e-4), {"axial_gap": size}, foil) for size in (5.0e-6, 1.3e-4))
        checks.below(f"{name}: as from a gap that the tilt closes", near["minimum_gap"]/wide["minimum_gap"] - 1.0, 1.0e-9)
    play = {"bearing": {"axial_play": 9.0e-5}}
    one = gap("tilted_play", (0.0, 4.0e-4), **play)
    other = gap("tilted_play", (0.0, 4.0e-4), {"axial_load": -40.0}, **play)
    checks.below("between two bearings, loads of both senses: one gap is the other's",
                 (one["axial_gap"] + other["axial_gap"])/9.0e-5 - 1.0, 1.0e-6)
    checks.that("between two bearings: the film is open", one["minimum_gap"] > 1.0e-6)
    refused = solve(folder, "tilted_shut", thrust({"axial_load": 40.0, "tilt": (0.0, 1.0e-3)}, "equilibrium", ramp=ramp, **play), status=2)
    checks.that("a tilt that takes the play: refused, with the reason", "wherever it stands" in refused.log)


def check_ranks(checks, folder):
    """Two ranks give the answer of one."""
    groups = thrust({"axial_load": 150.0, "moment": (0.3, -0.1)}, "equilibrium", SPRINGS, **TIGHT)
    one, two = solve(folder, "one_rank", groups), solve(folder, "two_ranks", groups, ranks=2)
    for name in ("axial_gap", "tilt_x", "tilt_y", "friction_torque", "minimum_gap"):
        checks.below(f"two ranks: {name}", two[name]/one[name] - 1.0, 1.0e-8)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        if "--long" in sys.argv[1:]:
            check_reference(checks, folder, [name for name, row in REFERENCE.items() if name not in FEW and not row["group"].startswith("plate")])
        else:
            check_closed_form(checks, folder)
            check_squeeze(checks, folder)
            check_reference(checks, folder, FEW)
            check_order(checks, folder)
            check_one_pad(checks, folder)
            check_differences(checks, folder)
            check_profiles(checks, folder)
            check_rotor(checks, folder)
            check_strips(checks, folder)
            check_limits(checks, folder)
            check_tilted_starts(checks, folder)
            check_ranks(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
