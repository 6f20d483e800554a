#!/usr/bin/env python3
"""Modes of a rigid rotor on gas bearings: an independent program, a closed form, what must not matter."""

import json
import math
import pathlib
import sys
import tempfile

import h5py
import numpy

from dynamics import FOIL_BEARING, REFERENCE, RING, SPRINGS, beams, concentric
from dynamics_foils import shells
from gfb_run import Bearing, Checks, case_groups, run_file, solve, write_case

MESH = (60, 8)


def rotor_case(one, mass, frequencies=(1000.0,), mesh=MESH, **groups):
    """Groups of a case file for one of the reference's cases with a rotor."""
    case = one["case"]
    bearing = Bearing(*(case[key] for key in ("radius", "length", "clearance", "viscosity", "ambient_pressure",
                                              "leading_edge_condition")))
    model = {"film_order": 2} | {key: case[key] for key in ("foundation_stiffness", "foundation_pressure")
                                 if key in case}
    losses = {key: case[key] for key in ("loss_factor", "foundation_damping") if key in case}
    content = case_groups(bearing, mesh=mesh, foil=case["foil"], groups={"model": model},
                          speed_rpm=case.get("speed_rpm", 1.0), **one["operation"])
    content["scene"]["analysis"] = "linear_dynamics"
    content["dynamics"] = {"frequencies": frequencies, **losses}
    content["rotor"] = {"mass": mass}
    return content | groups


def speed_of(content):
    """Speed of the shaft [rad/s]."""
    return content["operation"]["speed_rpm"]*math.pi/30.0


def modes_of(answer):
    """lambda, share, kind and sense of the modes."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        group = file["dynamics"]
        return [group[f"mode_{name}"][...] for name in ("growth_rate", "frequency", "shaft_share", "kind", "sense")]


def check_growth(checks, folder):
    """Growth and frequency beside the critical mass; none at it."""
    for one in REFERENCE["growth"]:
        for mass, growth, frequency in one["rows"]:
            content = rotor_case(one, mass)
            answer = solve(folder, "growth", content)
            omega = speed_of(content)
            checks.below(f"{one['name']}, {mass:.3f} kg: growth over the speed",
                         answer["growth_rate"]/omega - growth, 1.0e-4)
            checks.below(f"{one['name']}, {mass:.3f} kg: frequency over the speed",
                         answer["whirl_frequency"]/omega - frequency, 1.0e-4)
        content["rotor"]["mass"] = answer["critical_mass"]
        answer = solve(folder, "growth", content)
        checks.below(f"{one['name']}: no growth at the critical mass", answer["growth_rate"]/omega, 1.0e-9)
        checks.below(f"{one['name']}: whirl frequency there",
                     answer["whirl_frequency"]/omega/answer["whirl_ratio"] - 1.0, 1.0e-8)


def check_onset(checks, folder):
    """Rotors under their weight in a sweep over speed."""
    for one in REFERENCE["onset"]:
        known = one["onset_speed_rpm"]
        content = rotor_case(one, one["mass"])
        content["operation"]["speed_rpm"] = 0.93*known
        content["sweep"] = {"parameter": "speed_rpm", "values": (0.93*known, 1.04*known)}
        answer = solve(folder, "onset", content)
        checks.that(f"{one['name']}: the summary begins with it", list(answer.summary)[2] == "onset_speed_rpm")
        checks.below(f"{one['name']}: onset speed", answer["onset_speed_rpm"]/known - 1.0, 2.0e-4)
        with h5py.File(f"{answer.stem}.h5", "r") as file:
            growth = file["history/growth_rate"][...]
            mass = file["history/critical_mass"][...]
            checks.that(f"{one['name']}: growth and critical mass change there", growth[0] < 0.0 < growth[1] and
                        mass[0] > one["mass"] > mass[1])
            checks.that(f"{one['name']}: points first in arrays", file["dynamics/stiffness"].shape == (2, 1, 4, 4) and
                        file["dynamics/frequency"].shape[0] == 2 and file["dynamics/mode_frequency"].shape[0] == 2)


def ring_matrix(rotor, omega, rate, stiffness, dampers):
    """D of both kinds on a concentric full ring."""
    whole = concentric(RING, omega, -1j*rate, stiffness + rate*dampers, 0.0)
    arm = 0.5*rotor["bearing_distance"]
    motion = numpy.array([[0.0, arm], [-arm, 0.0], [1.0, 0.0], [0.0, 1.0]])
    cylindrical = whole[:2, :2] + rate**2*rotor["mass"]*numpy.eye(2)
    conical = motion.T@whole@motion + 0.5*rate**2*rotor["transverse_inertia"]*numpy.eye(2)
    conical = conical + 0.5*rate*omega*rotor["polar_inertia"]*numpy.array([[0.0, 1.0], [-1.0, 0.0]])
    return {1: cylindrical, 2: conical}


def nearest_root(function, start):
    """Root of a function of a complex number by the secant method."""
    before, here = start, start*(1.0 + 1.0e-4)
    at_before = function(before)
    for _ in range(50):
        at_here = function(here)
        if abs(here - before) < 1.0e-13*abs(here) or at_here == at_before:
            break
        before, here, at_before = here, here - at_here*(here - before)/(at_here - at_before), at_here
    return here


def check_ring(checks, folder):
    """All modes of a rotor on concentric rings, rigid and on damped springs, with gyroscopic torque."""
    omega = RING.speed_rpm(3.0)*math.pi/30.0
    rotor = {"mass": 0.2, "transverse_inertia": 6.0e-4, "polar_inertia": 1.0e-4, "bearing_distance": 0.12}
    foundation = {"model": {"film_order": 2, "foundation_pressure": "local", **SPRINGS}}
    spring = SPRINGS["foundation_stiffness"]
    cases = {"rigid": ("rigid", {"model": {"film_order": 2}}, 1.0e30, 0.0),
             "springs": ("elastic_foundation", foundation, spring, 0.0),
             "dampers": ("elastic_foundation", foundation, spring, 0.3*spring/omega)}
    for name, (foil, groups, stiffness, damping) in cases.items():
        content = case_groups(RING, mesh=(48, 16), foil=foil, groups=groups, number=3.0, eccentricity=(0.0, 0.0))
        content["scene"]["analysis"] = "linear_dynamics"
        content["dynamics"] = {"frequency_ratios": (0.5,)} | ({"foundation_damping": damping} if damping > 0.0 else {})
        content["rotor"] = rotor
        answer = solve(folder, "ring", content)
        growth, frequency, share, kind, sense = modes_of(answer)
        worst, count, ways = 0.0, {1: 0, 2: 0}, True
        for one in numpy.flatnonzero((share > 0.02) & (frequency > 0.0) & (growth > -omega)):
            found = growth[one] + 1j*frequency[one]
            wanted = nearest_root(lambda rate, k=int(kind[one]): numpy.linalg.det(
                ring_matrix(rotor, omega, rate, stiffness, damping)[k]), found)
            worst = max(worst, abs(found - wanted)/abs(wanted))
            count[int(kind[one])] += 1
            ways = ways and abs(abs(sense[one]) - 1.0) < 1.0e-4
        checks.below(f"ring, {name}: {count[1]} cylindrical and {count[2]} conical modes, closed form", worst, 3.0e-4)
        checks.that(f"ring, {name}: modes of both kinds, in circles", min(count.values()) >= 1 and ways)


def constant_threshold(stiffness, damping):
    """Mass above which a shaft on constant K and C is unstable; None where every mass is stable."""
    (kxx, kxy), (kyx, kyy) = stiffness
    (cxx, cxy), (cyx, cyy) = damping
    kappa = (kxx*cyy + kyy*cxx - kxy*cyx - kyx*cxy)/(cxx + cyy)
    square = ((kxx - kappa)*(kyy - kappa) - kxy*kyx)/(cxx*cyy - cxy*cyx)
    return kappa/square if square > 0.0 else None


def check_constants(checks, folder):
    """Thresholds of coefficients that are taken for constants: right at the whirl's frequency, else wrong."""
    heavy = REFERENCE["growth"][2]
    heavy = heavy | {"case": {key: value for key, value in heavy["case"].items() if key != "foundation_damping"}}
    for name, one in (("axial mean, 60 N", heavy), ("local springs, 20 N", REFERENCE["growth"][1])):
        content = rotor_case(one, 1.0)
        omega = speed_of(content)
        first = solve(folder, "constants", content)
        content["dynamics"] = {"frequency_ratios": (first["whirl_ratio"], 1.0, 0.5, 0.1)}
        answer = solve(folder, "constants", content)
        with h5py.File(f"{answer.stem}.h5", "r") as file:
            masses = [constant_threshold(k[:2, :2], c[:2, :2])
                      for k, c in zip(file["dynamics/stiffness"][...], file["dynamics/damping"][...])]
        known = answer["critical_mass"]
        print(f"       {name}: {known:.4f} kg; of constants at the whirl, 1, 0.5, 0.1 of the speed {omega:.0f} rad/s: "
              + ", ".join("any" if mass is None else f"{mass:.4f}" for mass in masses))
        checks.below(f"{name}: constants of the whirl's frequency", masses[0]/known - 1.0, 1.0e-6)
        checks.that(f"{name}: constants of the speed say that every mass is stable" if name.startswith("axial") else
                    f"{name}: constants of the speed are off by more than a fifth",
                    masses[1] is None if name.startswith("axial") else
                    masses[1] is None or abs(masses[1]/known - 1.0) > 0.2)


def check_same(checks, folder):
    """A sweep over the mass, ranks, groups, half and whole width, loss factor."""
    one = REFERENCE["growth"][0]
    rotor = {"mass": 0.3, "transverse_inertia": 1.0e-3, "polar_inertia": 4.0e-4, "bearing_distance": 0.1}
    content = rotor_case(one, 0.3, mesh=(32, 8))
    content["rotor"] = rotor
    shares = {}
    for name, width, ranks in (("half", "yes", 1), ("whole", "no", 1), ("two ranks", "yes", 2)):
        content["model"]["half_width"] = width
        growth, frequency, share, _, _ = modes_of(solve(folder, "same", content, ranks))
        kept = (share > 0.02) & (growth > -3000.0)
        shares[name] = numpy.array([growth[kept], frequency[kept], share[kept]])
    for name in ("whole", "two ranks"):
        checks.that(f"{name}: as many modes", shares[name].shape == shares["half"].shape)
        checks.below(f"half and {name}: modes", numpy.abs(shares[name]/shares["half"] - 1.0).max(), 1.0e-6)

    content = rotor_case(one, 1.0, mesh=(32, 8))
    mass = solve(folder, "sweep", content)["critical_mass"]
    content["sweep"] = {"parameter": "rotor%mass", "values": (0.9*mass, mass, 1.1*mass)}
    with h5py.File(f"{solve(folder, 'sweep', content).stem}.h5", "r") as file:
        growth = file["history/growth_rate"][...]
    checks.that("sweep over the mass: growth begins at the critical mass",
                growth[0] < -1.0 and abs(growth[1]) < 1.0e-4 and growth[2] > 1.0)

    one = REFERENCE["onset"][0]
    content = rotor_case(one, one["mass"], mesh=(32, 8))
    content["operation"]["speed_rpm"] = 9000.0
    content["sweep"] = {"parameter": "speed_rpm", "values": (9000.0, 9500.0, 10500.0, 11000.0)}
    path = write_case(folder, "groups", content)
    answers = [run_file(path, folder, ranks, options) for ranks, options in ((1, ()), (2, ("--groups", "2")))]
    onsets = [answer["onset_speed_rpm"] for answer in answers]
    checks.below("onset in two groups of ranks", onsets[1]/onsets[0] - 1.0, 1.0e-6)

    content = rotor_case(REFERENCE["growth"][2], 3.0, mesh=(32, 8))
    content["dynamics"] = {"frequencies": (1000.0,), "loss_factor": 0.2}
    answer = solve(folder, "loss", content, options=())
    checks.that("loss factor: no growth rate, and why", "growth_rate" not in answer.summary and
                "no growth rates" in answer.log)


def check_foils(checks, folder):
    """Modes of both kinds on beams and shells, half and whole width."""
    for name, case in (("beams", beams(0.1)), ("shells", shells(0.1))):
        found = {}
        for width in ("yes", "no"):
            case["groups"]["model"]["half_width"] = width
            content = case_groups(FOIL_BEARING, **(case | {"tilt": (0.0, 0.0)}))
            content["scene"]["analysis"] = "linear_dynamics"
            content["dynamics"] = {"frequency_ratios": (0.5,)}
            content["rotor"] = {"mass": 5.0, "transverse_inertia": 0.02, "polar_inertia": 2.0e-3,
                                "bearing_distance": 0.1}
            growth, frequency, share, kind, _ = modes_of(solve(folder, "foils", content))
            kept = (share > 0.05) & (growth > -0.5*frequency)
            found[width] = numpy.array([growth[kept]/frequency[kept], frequency[kept], kind[kept]])
        checks.that(f"{name}: modes of both kinds, as many on half and whole width",
                    found["yes"].shape == found["no"].shape and set(found["no"][2]) == {1.0, 2.0})
        checks.below(f"{name}: half and whole width",
                     max(numpy.abs(found["yes"][0] - found["no"][0]).max(),
                         numpy.abs(found["yes"][1]/found["no"][1] - 1.0).max()), 1.0e-7)


def check_unstable_foil(checks, folder):
    """Where a foil grows by itself, as the stability at a fixed shaft says, the rotor's growth is not taken for it."""
    for lift, steady in ((1.5e-5, True), (2.1e-5, False)):
        case = beams(0.1) | {"mesh": (104, 8), "tilt": (0.0, 0.0), "eccentricity": None, "load": (-100.0, 0.0),
                             "leading_edge_lift": lift}
        case["groups"] = case["groups"] | {
            "model": {}, "solver": {"stability": True},
            "contact": {"friction_top": 0.1, "friction_sleeve": 0.1, "normal_stiffness": 5.0e10, "stick_length": 1.0e-7}}
        content = case_groups(FOIL_BEARING, **case)
        content["scene"]["analysis"] = "linear_dynamics"
        content["dynamics"] = {"frequency_ratios": (0.5,)}
        content["rotor"] = {"mass": 10.0}
        answer = solve(folder, "lifted", content, options=())
        growth, frequency, share, _, _ = modes_of(answer)
        grows = (growth > 0.0) & (share < 0.02)
        checks.that(f"edge lifted {lift*1.0e6:.0f} um: growing modes of the foil as with a fixed shaft",
                    answer["growing_modes"] == sum(1 if steady else 2 for _ in frequency[grows]) > 0)
        checks.that("the log says so, and the rotor's number is the rotor's",
                    "film or foil move by themselves" in answer.log and answer["growth_rate"] < 0.0)


def compressor(foil_mass):
    """Groups of a lightly loaded bearing of three preloaded pads on beams, whose top foils touch no bump in places."""
    foil = {"youngs_modulus": 207.0e9, "poissons_ratio": 0.29, "density": 8280.0, "fixed_edge": "leading"}
    return {"scene": {"analysis": "linear_dynamics"},
            "operation": {"speed_rpm": 14000.0, "load": (-4.41, 0.0)},
            "model": {"foil": "beam"},
            "bearing": {"radius": 12.5e-3, "length": 25.0e-3, "clearance": 35.0e-6},
            "pads": {"count": 3, "arc": 2.0, "first_leading_edge": 0.0, "preload": 0.3},
            "gas": {"viscosity_law": "sutherland", "temperature": 423.15, "ambient_pressure": 1.5e5},
            "top_foil": {"thickness": 0.1e-3, **foil},
            "bump_foil": {"thickness": 0.08e-3, "half_length": 1.3e-3, "height": 0.4e-3, "pitch": 3.4e-3, "bumps": 7,
                          "strips": 3, "cut_width": 0.5e-3, **foil},
            "contact": {"friction_top": 0.2, "friction_sleeve": 0.2},
            "mesh": {"axial_elements": 8},
            "dynamics": {"frequency_ratios": (0.5,), "foil_mass": foil_mass},
            "rotor": {"mass": 0.45},
            "sweep": {"parameter": "speed_rpm", "values": (14000.0, 18000.0)}}


def check_foil_mass(checks, folder):
    """A mode of the foil next to the rotor's is not taken for it: growth and onset are those without the foil's mass."""
    with_mass = solve(folder, "mass_on", compressor("on"), options=())
    without = solve(folder, "mass_off", compressor("off"), options=())
    checks.below("foil mass: onset as without it", with_mass["onset_speed_rpm"]/without["onset_speed_rpm"] - 1.0, 2.0e-3)
    with h5py.File(f"{with_mass.stem}.h5", "r") as file, h5py.File(f"{without.stem}.h5", "r") as other:
        growth, largest = (file[f"history/{name}"][...] for name in ("growth_rate", "largest_growth_rate"))
        checks.below("foil mass: growth over the speed as without it",
                     (growth[0] - other["history/growth_rate"][0])/(14000.0*math.pi/30.0), 5.0e-4)
        modes = {name: file[f"dynamics/mode_{name}"][0] for name in ("growth_rate", "frequency", "shaft_share", "foil_share")}
    checks.that("the least damped mode of any kind is told beside it", largest[0] > growth[0] and
                largest[0] == modes["growth_rate"][0])
    checks.that("it is the foil's", modes["foil_share"][0] > 0.9 and modes["shaft_share"][0] < 1.0e-3 and
                "a mode of the foil" in with_mass.log)
    checks.that("the rotor's is the rotor's", modes["shaft_share"][modes["growth_rate"] == growth[0]][0] > 0.5)
    checks.below("it is next to the foil's alone, of 135.4 Hz", modes["frequency"][0]/(2.0*math.pi*135.4) - 1.0, 0.02)


def branch_of(folder, name, content):
    """Growth and frequency of the rotor's branch along a sweep of its mass, and the modes that vibrate of every point."""
    with h5py.File(f"{solve(folder, name, content).stem}.h5", "r") as file:
        modes = {key: file[f"dynamics/mode_{key}"][...] for key in ("growth_rate", "frequency", "moving_share", "owner")}
        return file["history/growth_rate"][...], file["history/whirl_frequency"][...], modes


def check_crossing(checks, folder):
    """As the rotor's mass grows its frequency passes that of a foil: far from its onset the foil's mode, damped less, is never taken
    for the rotor's; near it both veer, and the branch goes on from the one to the other without a jump."""
    masses = {20000.0: (0.08, 0.12, 0.16), 25000.0: tuple(0.1225 + 0.0025*i for i in range(7))}
    found = {}
    for speed, values in masses.items():
        for foil_mass in ("on", "off"):
            content = compressor(foil_mass)
            content["operation"]["speed_rpm"] = speed
            content["mesh"] = {"circumferential_elements": 48, "axial_elements": 4}
            content["sweep"] = {"parameter": "rotor%mass", "values": values}
            found[speed, foil_mass] = branch_of(folder, "crossing", content)
        (growth, frequency, modes), (plain, unhurried, _) = (found[speed, foil_mass] for foil_mass in ("on", "off"))
        omega = speed*math.pi/30.0
        foil = numpy.where(modes["owner"] == 2, modes["growth_rate"], -numpy.inf).max(axis=1)
        checks.that(f"{speed:.0f} rpm: a mode of the foil is damped less than the rotor's somewhere", (foil > growth).any())
        # A foil's mode would be off by 0.08; where both veer they exchange 0.005.
        checks.below(f"{speed:.0f} rpm: growth over the speed, as without the foil's mass", numpy.abs(growth - plain).max()/omega, 1.0e-2)
        checks.below(f"{speed:.0f} rpm: frequency over the speed, as without the foil's mass", numpy.abs(frequency - unhurried).max()/omega, 2.0e-2)
    steps = numpy.diff(growth), numpy.diff(plain)
    checks.within("growth where they veer: largest step between neighbours over that without the foil's mass",
                  numpy.abs(steps[0]).max()/numpy.abs(steps[1]).max(), 0.5, 3.0)
    both = modes["owner"] == 4
    pairs = [modes["moving_share"][point][both[point]] for point in range(len(both)) if both[point].sum() == 2]
    checks.that("two modes that veer are named as both the rotor's and the foil's", len(pairs) > 0)
    checks.below("their shares make one", max(abs(sum(pair) - 1.0) for pair in pairs), 0.15)


def check_lost_modes(checks, folder):
    """Modes next to a foil's are found, and the rotor's is the rotor's, though the foil's is damped less and has some of it."""
    content = compressor("on")
    content["mesh"] = {}
    content["operation"]["speed_rpm"] = 15300.0
    content["sweep"]["values"] = (15300.0, 15500.0)
    growth, frequency, modes = branch_of(folder, "lost", content)
    checks.within("15,500 rpm: growth", growth[-1], -6.4, -6.1)
    checks.within("15,500 rpm: whirl", frequency[-1], 597.0, 601.0)
    foil = (modes["owner"] == 2) & (modes["growth_rate"] > growth[:, None])
    checks.that("a mode of the foil is damped less at each of the speeds", foil.any(axis=1).all())


def check_foil_peak(checks, folder):
    """Frequencies that are put between two given find the peak of the foil's mode, which is 0.7 rad/s wide: lines are what is solved."""
    content = compressor("on")
    del content["sweep"]
    whole = content | {"dynamics": content["dynamics"] | {"frequency_ratios": (0.1, 2.0), "interpolation_tolerance": 0.02}}
    table = solve(folder, "peak", whole, options=())
    with h5py.File(f"{table.stem}.h5", "r") as file:
        frequency, *both = (file[f"dynamics/{name}"][...] for name in ("frequency", "stiffness", "damping"))
        mode = file["dynamics/mode_frequency"][0]
        checks.below("lines between frequencies: their own miss", file["dynamics/interpolation_miss"][0], 0.02)
    checks.that("few frequencies hold the peak", 10 < len(frequency) < 60)
    checks.that("a peak it is", numpy.ptp(both[0][:, 1, 1]) > 0.5*numpy.median(both[0][:, 1, 1]))
    for number, off in enumerate((-0.4, -0.1, 0.2, 0.7)):
        content["dynamics"] = {"frequencies": (mode + off,), "foil_mass": "on"}
        alone = solve(folder, f"peak_{number}", content, options=())
        with h5py.File(f"{alone.stem}.h5", "r") as file:
            for name, values in zip(("stiffness", "damping"), both):
                solved = file[f"dynamics/{name}"][...].reshape(4, 4)[:2, :2]
                line = [[numpy.interp(mode + off, frequency, values[:, row, column]) for column in range(2)] for row in range(2)]
                checks.below(f"{name} {off} rad/s off the foil's mode: line against solved", numpy.abs(line - solved).max()/numpy.abs(solved).max(), 0.025)


def check_onset_with_losses(checks, folder):
    """With a loss factor the onset is where the critical mass passes the rotor's."""
    one = REFERENCE["onset"][1]
    content = rotor_case(one, one["mass"], mesh=(32, 8))
    content["dynamics"] = {"frequency_ratios": (0.5,), "loss_factor": 0.1}
    content["operation"]["speed_rpm"] = 12000.0
    content["sweep"] = {"parameter": "speed_rpm", "values": (12000.0, 14000.0)}
    answer = solve(folder, "losses", content, options=())
    onset = answer["onset_speed_rpm"]
    checks.that("onset with a loss factor: found, and its way said", 12000.0 < onset < 14000.0 and
                "the critical mass passes" in answer.log)
    del content["sweep"]
    content["operation"]["speed_rpm"] = onset
    checks.below("critical mass at that speed is the rotor's",
                 solve(folder, "losses", content)["critical_mass"]/one["mass"] - 1.0, 1.0e-5)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        if "--long" not in sys.argv:
            check_foil_peak(checks, folder)
            check_crossing(checks, folder)
            check_onset_with_losses(checks, folder)
            checks.close()
        check_lost_modes(checks, folder)
        check_foil_mass(checks, folder)
        check_growth(checks, folder)
        check_onset(checks, folder)
        check_ring(checks, folder)
        check_constants(checks, folder)
        check_same(checks, folder)
        check_foils(checks, folder)
        check_unstable_foil(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
