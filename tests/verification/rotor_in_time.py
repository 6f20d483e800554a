#!/usr/bin/env python3
"""A rigid rotor on two bearings over time, with its tilts: what is known of it without any other program.

Two point masses m at the bearings' midplanes are the rotor of the mass 2 m, of I_t = m L^2/2 and I_p = 0. Far apart, so
that a tilt moves a journal but hardly turns it, each of them is a shaft of its own on its bearing, at any amplitude.
Without gas a rotor that was turned goes round with I_p/I_t of the speed. Small conical motions have the rates of the
linear theory, see transient.py.
"""

import math
import sys
import tempfile

import h5py
import numpy

from dynamics import FOIL_BEARING, beams
from dynamics_foils import shells
from gfb_run import Checks, case_groups, largest_difference, observed_order, solve
from rotor import modes_of, speed_of
from transient import MESH, TIGHT, extent, foil_case, history, modes_in, plane, rate

CLEARANCE = 31.8e-6
DISTANCE = 0.12
ROTOR = {"transverse_inertia": 1.6e-3, "polar_inertia": 4.0e-4, "bearing_distance": DISTANCE}


def conical_case(mass, load, rotor=None, mesh=MESH, name="PT1", **keys):
    """A rotor on two bearings over time, and the linear theory's case of it."""
    content, linear = foil_case(mass, load, mesh, name, **keys)
    for one in (content, linear):
        one["rotor"] = one["rotor"] | (rotor or ROTOR)
    return content, linear


def check_alike(checks, folder):
    """What both bearings share leaves the rotor aligned: the answer of one bearing; forces are those of both."""
    mass = 1.5
    drive = {"turns": 2, "steps_per_turn": 60, "unbalance": 1.5e-6, "pulse": (0.01, 0.02), "pulse_length": 1.0e-3}
    single, _ = foil_case(mass, (-60.0, 0.0), **drive)
    double, _ = conical_case(mass, (-60.0, 0.0), **drive)
    for one in (single, double):
        one["solver"] = TIGHT
    one, two = (history(solve(folder, name, content)) for name, content in (("single", single), ("double", double)))
    for name in ("eccentricity", "velocity"):
        size = numpy.abs(plane(one, name)).max()
        checks.below(f"bearings alike: {name} of one", largest_difference(plane(one, name), plane(two, name), size), 1.0e-9)
    checks.below("bearings alike: twice its force", largest_difference(2.0*plane(one, "force"), plane(two, "force"), 120.0), 1.0e-8)
    checks.below("bearings alike: twice its gas", numpy.abs(two["stored_gas"]/one["stored_gas"] - 2.0).max(), 1.0e-9)
    checks.below("bearings alike: no tilt", numpy.abs(plane(two, "tilt")).max()*DISTANCE/CLEARANCE, 1.0e-9)


def check_apart(checks, folder):
    """Point masses on bearings far apart: each with the large orbit of a shaft on one bearing, with its own unbalance."""
    mass, unbalance = 1.5, (3.0e-6, 0.5e-6)
    alone = [history(solve(folder, "alone", foil_case(mass, (-60.0, 0.0), turns=1.5, steps_per_turn=60, unbalance=one, unsolved_part=0.0)[0]))
             for one in unbalance]
    checks.that("far apart: a large orbit", numpy.ptp(alone[0]["eccentricity_x"]) > 0.1*CLEARANCE)
    found = []
    for ratio in (250.0, 500.0):
        distance = ratio*FOIL_BEARING.length
        rotor = {"transverse_inertia": 0.5*mass*distance**2, "bearing_distance": distance}
        content, _ = conical_case(mass, (-60.0, 0.0), rotor, turns=1.5, steps_per_turn=60, unbalance=0.5*sum(unbalance), unsolved_part=0.0,
                                  couple_unbalance=0.5*(unbalance[0] - unbalance[1])*distance)
        rows = history(solve(folder, "apart", content))
        found.append(max(largest_difference(rows[f"eccentricity_x_{number}"] + 1j*rows[f"eccentricity_y_{number}"],
                                            plane(one, "eccentricity"), CLEARANCE) for number, one in enumerate(alone, 1)))
        checks.below(f"far apart, {ratio:.0f} lengths: each journal as if alone, over the clearance", found[-1], 20.0/ratio**2)
    checks.within("far apart: order in the distance", observed_order(*found), 1.8, 2.2)


def check_free(checks, folder):
    """A gas that is hardly there: after a turn the rotor goes round with I_p/I_t of the speed."""
    content, _ = conical_case(1.0, (-1.0e-9, 0.0), turns=6)
    content["gas"] = {"viscosity": 1.95e-12, "ambient_pressure": 1.0e-2}
    content["model"] = {"foil": "rigid"}
    del content["transient"]["foundation_damping"]
    omega = speed_of(content)
    wanted = ROTOR["polar_inertia"]/ROTOR["transverse_inertia"]
    content["transient"] |= {"couple_pulse": (1.0e-4*CLEARANCE, 0.0), "pulse_length": 2.0*math.pi/omega}
    found = []
    for steps in (60, 120):
        content["transient"]["steps_per_turn"] = steps
        rows = history(solve(folder, "free", content))
        turn = plane(rows, "tilt_velocity")[rows["turns"] > 1.5]
        angle = numpy.unwrap(numpy.angle(turn))
        found.append((angle[-1] - angle[0])/(len(turn) - 1)/rows["step"][-1]/omega)
    checks.below("no gas: precession over the speed", (4.0*found[1] - found[0])/3.0 - wanted, 1.0e-4)


def check_balance(checks, folder):
    """Torques, inertia and gyroscopic torque balance; the film's work and the outer one is kinetic energy."""
    content, _ = conical_case(1.0, (-60.0, 0.0), turns=1.5, couple_unbalance=2.0e-8, couple_unbalance_angle=0.5)
    omega = speed_of(content)
    content["transient"] |= {"couple_pulse": (1.5e-4, -1.0e-4), "pulse_length": 2.0*math.pi/omega}
    content["solver"] = TIGHT
    missing = []
    for steps in (120, 240):
        content["transient"]["steps_per_turn"] = steps
        rows = history(solve(folder, "balance", content))
        tilt, spin = plane(rows, "tilt"), plane(rows, "tilt_velocity")
        outer = -plane(rows, "torque") - plane(rows, "outer_torque") # on the sleeve's tilt
        # I_p Omega [0, 1; -1, 0] is a factor -i of the plane's complex number.
        gyroscopic = -1j*ROTOR["polar_inertia"]*omega*spin
        lost = ROTOR["transverse_inertia"]*rate(rows, spin) + (gyroscopic - outer)[2:]
        checks.below(f"{steps} steps: torques balance", numpy.abs(lost).max()/numpy.abs(outer).max(), 1.0e-6)
        momentum = ROTOR["transverse_inertia"]*spin - 1j*ROTOR["polar_inertia"]*omega*tilt
        given = numpy.concatenate(([0.0], numpy.cumsum(0.5*(outer[1:] + outer[:-1])*numpy.diff(rows["time"]))))
        size = numpy.abs(momentum - momentum[0]).max()
        power = ((plane(rows, "force") - plane(rows, "load"))*plane(rows, "velocity").conj()
                 + outer*spin.conj()).real
        work = numpy.concatenate(([0.0], numpy.cumsum(0.5*(power[1:] + power[:-1])*numpy.diff(rows["time"]))))
        energy = numpy.abs(plane(rows, "velocity"))**2 + 0.5*ROTOR["transverse_inertia"]*numpy.abs(spin)**2 # two masses of 1 kg
        missing.append((abs(momentum - momentum[0] - given)[-1]/size, abs(energy - energy[0] - work)[-1]/energy.max()))
    for number, words in enumerate(("angular momentum", "energy")):
        checks.below(f"{words} that is missing with 240 steps", missing[1][number], 2.0e-3)
        checks.within(f"{words}: order of the steps", observed_order(missing[0][number], missing[1][number]), 1.7, 2.4)
    for axis, lever in (("x", rows["tilt_y"]), ("y", -rows["tilt_x"])):
        for number, sign in ((1, 0.5), (2, -0.5)):
            there = rows[f"eccentricity_{axis}"] + sign*DISTANCE*lever
            checks.below(f"journal {number}, {axis}", numpy.abs(there - rows[f"eccentricity_{axis}_{number}"]).max()/CLEARANCE, 1.0e-12)
    gap = numpy.minimum(rows["minimum_gap_1"], rows["minimum_gap_2"])
    checks.below("smallest film is that of one bearing", numpy.abs(gap - rows["minimum_gap"]).max()/CLEARANCE, 1.0e-12)
    checks.that("bearings differ", numpy.abs(rows["minimum_gap_1"] - rows["minimum_gap_2"]).max() > 0.01*CLEARANCE)


def conical_modes(answer, omega):
    """Rates of the slow conical modes, the least damped first, and their sense."""
    growth, frequency, _, kind, sense = modes_of(answer)
    mine = (kind == 2) & (frequency > 0.0) & (growth > -0.6*omega)
    order = numpy.argsort(-growth[mine])
    return (growth + 1j*frequency)[mine][order], sense[mine][order]


def turned_case(rotor, model, steps):
    """A rotor that was turned a little on its bearings, and the linear theory's case of it."""
    content, linear = conical_case(0.3, (-20.0, 0.0), ROTOR | rotor, name="PT2", turns=4, steps_per_turn=steps)
    for one in (content, linear):
        one["model"].update(model)
        if model.get("foil") == "rigid":
            del one["model"]["foundation_stiffness"], one["model"]["foundation_pressure"]
    if model.get("foil") == "rigid":
        del content["transient"]["foundation_damping"], linear["dynamics"]["foundation_damping"]
    omega = speed_of(content)
    content["transient"] |= {"couple_pulse": (1.0e-4*CLEARANCE/DISTANCE*ROTOR["transverse_inertia"]*omega, 0.0),
                             "pulse_length": 0.5*math.pi/omega}
    content["solver"] = TIGHT
    return content, linear


def check_modes(checks, folder):
    """A rotor that was turned a little: growth and frequency of its conical modes, without and with a polar inertia, which
    splits them."""
    supg = {"film_order": 1, "film_scheme": "supg"}
    cases = (("no polar inertia", {"polar_inertia": 0.0}, {}), ("polar inertia", {}, {}), ("SUPG", {}, supg),
             ("rigid pad", {}, {"foil": "rigid"}))
    split = []
    for words, rotor, model in cases:
        content, linear = turned_case(rotor, model, 120)
        omega = speed_of(content)
        wanted, sense = conical_modes(solve(folder, "modes", linear), omega)
        rows = history(solve(folder, "turned", content))
        late = {name: values[rows["turns"] >= 1.0] for name, values in rows.items()}
        # The film's own modes die out besides.
        found = sorted((one for one in modes_in(late, 4.0, 5, "tilt") if abs(one.real) < omega), key=lambda one: -one.real)
        checks.below(f"{words}: growth of the first conical mode over the speed", (found[0].real - wanted[0].real)/omega, 5.0e-5)
        checks.below(f"{words}: its frequency", (found[0].imag - wanted[0].imag)/omega, 5.0e-5)
        if not model:
            split.append(found[:2])
            checks.below(f"{words}: second conical mode over the speed", abs(found[1] - wanted[1])/omega, 1.0e-3)
            checks.that(f"{words}: the first goes round with the speed, the second against it", sense[0] > 0.5 and sense[1] < -0.5)
    checks.that("gyroscopic torque: forward faster, backward slower", split[1][0].imag > split[0][0].imag + 0.01*omega
                and split[1][1].imag < split[0][1].imag - 0.1*omega)


def meshed_case(foil, friction, rotor, **keys):
    """A rotor on meshed foils over half a turn."""
    one = (beams if foil == "beam" else shells)(friction)
    groups = {group: dict(values) for group, values in one["groups"].items()}
    groups["model"].pop("half_width")
    content = case_groups(FOIL_BEARING, one["mesh"], foil, load=(-60.0, 0.0), speed_rpm=one["speed_rpm"], groups=groups)
    content["scene"]["analysis"] = "transient"
    content["rotor"] = {"mass": 1.5} | rotor
    content["transient"] = {"turns": 0.5, "steps_per_turn": 60, "unbalance": 3.0e-6, "unsolved_part": 0.0} | keys
    return content


def check_foils(checks, folder):
    """Foils that rub, each of both bearings with contacts of its own: the answer of one bearing; ranks."""
    for foil, turns in (("beam", 0.5), ("shell", 0.1)):
        one, two = (history(solve(folder, "foils", meshed_case(foil, 0.1, rotor, turns=turns))) for rotor in ({}, ROTOR))
        checks.below(f"{foil}s: both bearings alike", largest_difference(
            plane(one, "eccentricity"), plane(two, "eccentricity"), CLEARANCE), 1.0e-8)
    content = meshed_case("beam", 0.1, ROTOR, couple_unbalance=2.0e-7)
    one, two = (history(solve(folder, "ranks", content, ranks)) for ranks in (1, 2))
    tilt = numpy.abs(plane(one, "tilt")).max()
    checks.that("beams, couple unbalance: a large tilt", tilt*DISTANCE > 0.2*CLEARANCE)
    checks.below("beams, two ranks: tilts", largest_difference(plane(one, "tilt"), plane(two, "tilt"), tilt), 1.0e-8)


def check_files(checks, folder):
    """What the answer says of both bearings: pads, extents of the orbits, films of their own."""
    content, _ = conical_case(1.5, (-60.0, 0.0), turns=2, steps_per_turn=60, couple_unbalance=1.0e-7)
    answer = solve(folder, "files", content)
    rows = history(answer)
    for name in ("x_1", "y_1", "x_2", "y_2"):
        checks.below(f"orbit_{name}", answer[f"orbit_{name}"]/extent(rows, f"eccentricity_{name}") - 1.0, 1.0e-12)
    checks.below("orbit_tilt_y", answer["orbit_tilt_y"]/extent(rows, "tilt_y") - 1.0, 1.0e-12)
    for number, name in ((1, "film"), (2, "film_2")):
        with h5py.File(f"{answer.stem}.{name}.vtkhdf", "r") as file:
            points, gap = file["VTKHDF/Points"][...], file["VTKHDF/PointData/gap"][...]
        checks.below(f"{name}: its smallest gap", gap.min()/rows[f"minimum_gap_{number}"][-1] - 1.0, 1.0e-12)
        checks.below(f"{name}: its middle", 0.5*(points[:, 2].min() + points[:, 2].max()) - (1.5 - number)*DISTANCE, 1.0e-12)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        for name in sys.argv[1:] or ["alike", "apart", "free", "balance", "modes", "files"]:
            globals()["check_" + name](checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
