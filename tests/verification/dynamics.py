#!/usr/bin/env python3
"""Stiffness and damping under small vibrations: an independent program, a closed form, static differences.

Z = K + i w C, rows and columns e_x, e_y, phi_x, phi_y; errors are over the largest entry of their 2 x 2 block.
"""

import csv
import json
import math
import pathlib
import tempfile

import h5py
import numpy

from gfb_run import Bearing, Checks, case_groups, solve

REFERENCE = json.loads((pathlib.Path(__file__).parent/"reference/dynamic.json").read_text())
RING = Bearing(leading_edge_condition="periodic")
PLACE = (0.4*RING.clearance, 0.2*RING.clearance)
TILT = (1.0e-4, -2.0e-4)
TILTED = {"number": 2.0, "eccentricity": PLACE, "tilt": TILT}
BLOCKS = (slice(0, 2), slice(2, 4))
SPRINGS = {"foundation_stiffness": 2.0*RING.ambient_pressure/RING.clearance}
METAL = {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "fixed_edge": "trailing"}
FOIL_BEARING = Bearing(0.01905, 0.0381, 31.8e-6, 1.95e-5, 1.0135e5)


def coefficients(answer):
    """Frequencies and Z of an answer."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        group = file["dynamics"]
        frequency = group["frequency"][...]
        return frequency, group["stiffness"][...] + 1j*frequency[:, None, None]*group["damping"][...]


def vibrate(folder, name, bearing, dynamics, ranks=1, **case):
    """Z of a case at the frequencies of its group &dynamics."""
    content = case_groups(bearing, **case)
    content["scene"]["analysis"] = "linear_dynamics"
    content["dynamics"] = dynamics
    answer = solve(folder, name, content, ranks)
    return answer, *coefficients(answer)


def block_error(found, wanted, blocks=((0, 0), (0, 1), (1, 0), (1, 1))):
    """Largest error of some of the 2 x 2 blocks, each over its largest entry, or its size where it should vanish."""
    worst = 0.0
    for i, j in blocks:
        one, other = found[..., BLOCKS[i], BLOCKS[j]], wanted[..., BLOCKS[i], BLOCKS[j]]
        size = numpy.abs(other).max()
        worst = max(worst, numpy.abs(one - other).max()/(size if size > 0.0 else 1.0))
    return float(worst)


# --- an independent program ---

def from_reference(folder, one, frequencies, mesh, order):
    """The program's answer to one of the reference's cases."""
    case = one["case"]
    bearing = Bearing(*(case[key] for key in ("radius", "length", "clearance", "viscosity", "ambient_pressure",
                                              "leading_edge_condition")))
    model = {"film_order": order} | {key: case[key] for key in ("foundation_stiffness", "foundation_pressure")
                                     if key in case}
    losses = {key: case[key] for key in ("loss_factor", "foundation_damping") if key in case}
    return vibrate(folder, "reference", bearing, {"frequencies": frequencies, **losses}, mesh=mesh, foil=case["foil"],
                   groups={"model": model}, speed_rpm=case["speed_rpm"], **one["operation"])


def check_reference(checks, folder):
    """Biquadratic elements everywhere; the default bilinear ones on two of the cases."""
    for one in REFERENCE["coefficients"]:
        wanted = numpy.array([numpy.array(row["K"]) + 1j*row["w"]*numpy.array(row["C"]) for row in one["frequencies"]])
        frequencies = [row["w"] for row in one["frequencies"]]
        tilted = "tilt" in one["operation"]
        _, _, found = from_reference(folder, one, frequencies, (120, 16), 2)
        checks.below(f"{one['name']}, biquadratic: translation", block_error(found, wanted, [(0, 0)]), 1.0e-4)
        checks.below(f"{one['name']}, biquadratic: tilts", block_error(found, wanted, [(1, 1)]), 5.0e-4)
        checks.below(f"{one['name']}, biquadratic: cross blocks",
                     block_error(found, wanted, [(0, 1), (1, 0)]), 1.5e-3 if tilted else 0.0)
        # What tilts are off by is the mesh across the width, of fourth order.
        coarse = block_error(found, wanted, [(1, 1)])
        _, _, found = from_reference(folder, one, frequencies, (120, 32), 2)
        for words, blocks in ("translation", [(0, 0)]), ("tilts", [(1, 1)]), ("cross blocks", [(0, 1), (1, 0)]):
            checks.below(f"{one['name']}, biquadratic, 32 elements across: {words}", block_error(found, wanted, blocks),
                         1.0e-4 if tilted or words != "cross blocks" else 0.0)
        checks.below(f"{one['name']}, biquadratic: order of the tilts, off four",
                     math.log2(coarse/block_error(found, wanted, [(1, 1)])) - 4.0, 0.4)
        if one["name"] in ("rigid slit, held", "axial mean, balanced"):
            _, _, found = from_reference(folder, one, frequencies, (240, 32), 1)
            checks.below(f"{one['name']}, bilinear: translation", block_error(found, wanted, [(0, 0)]), 2.0e-3)
            checks.below(f"{one['name']}, bilinear: tilts", block_error(found, wanted, [(1, 1)]), 1.0e-2)
    for one in REFERENCE["critical_mass"]:
        answer, _, _ = from_reference(folder, one, [1000.0], (120, 16), 2)
        checks.below(f"{one['name']}: critical mass", answer["critical_mass"]/one["critical_mass"] - 1.0, 1.0e-4)
        checks.below(f"{one['name']}: whirl ratio", answer["whirl_ratio"]/one["whirl_ratio"] - 1.0, 5.0e-5)


# --- closed form ---

def concentric(bearing, omega, frequency, stiffness, loss):
    """Z of a concentric full ring whose springs feel the local pressure."""
    ratio = bearing.length/(2.0*bearing.radius)
    scale = 6.0*bearing.viscosity/bearing.ambient_pressure*(bearing.radius/bearing.clearance)**2
    soft = bearing.ambient_pressure/(stiffness*bearing.clearance*(1.0 + 1j*loss))
    whole, moment = {}, {}
    for n in (1, -1):
        beta = scale*(2.0*frequency + n*omega)
        k = numpy.sqrt(1.0 + 1j*beta*(1.0 + soft) + 0j)
        whole[n] = -1j*beta/k**2*(2.0*ratio - 2.0*numpy.tanh(k*ratio)/k)
        moment[n] = -1j*beta/k**2*(2.0*ratio**3/3.0 - 2.0*ratio*(ratio/(k*numpy.tanh(k*ratio)) - 1.0/k**2))
    z = numpy.zeros((4, 4), complex)
    unit = -math.pi*bearing.ambient_pressure*bearing.radius**2/bearing.clearance
    for integral, block, size, turn in ((whole, BLOCKS[0], unit, -1j), (moment, BLOCKS[1], unit*bearing.radius**2, -1j)):
        direct, cross = 0.5*(integral[1] + integral[-1]), 0.5*turn*(integral[1] - integral[-1])
        z[block, block] = size*numpy.array([[direct, cross], [-cross, direct]])
    return z


def check_ring(checks, folder):
    """With losses in the springs at three frequencies; rigid, no force where the gap turns with half the speed."""
    speed = RING.speed_rpm(3.0)*math.pi/30.0
    springs = {"foil": "elastic_foundation",
               "groups": {"model": {"film_order": 2, "foundation_pressure": "local", **SPRINGS}}}
    case = {"mesh": (48, 16), "number": 3.0, "eccentricity": (0.0, 0.0)}
    _, frequency, found = vibrate(folder, "ring", RING, {"frequency_ratios": (0.3, 1.0, 3.0), "loss_factor": 0.3},
                                  **case, **springs)
    wanted = numpy.array([concentric(RING, speed, w, SPRINGS["foundation_stiffness"], 0.3) for w in frequency])
    checks.below("concentric ring on springs with losses: translation", block_error(found, wanted, [(0, 0)]), 1.0e-4)
    checks.below("concentric ring on springs with losses: tilts", block_error(found, wanted, [(1, 1)]), 5.0e-4)
    answer, _, found = vibrate(folder, "ring", RING, {"frequency_ratios": (0.5, 1.0)}, **case)
    forwards = numpy.array([1.0, -1j])
    for name, block in (("force", BLOCKS[0]), ("torque", BLOCKS[1])):
        checks.below(f"concentric ring: {name} where the gap turns with half the speed",
                     numpy.abs(found[0, block, block]@forwards).max()/numpy.abs(found[0, block, block]).max(), 2.0e-6)
    checks.below("concentric ring: every mass whirls", answer["critical_mass"], 1.0e-9)
    checks.below("concentric ring: with half the speed", answer["whirl_ratio"] - 0.5, 1.0e-6)


# --- differences of static forces ---

def static_force(folder, bearing, place, case):
    """Minus the force on the sleeve, and the torque on the shaft: what a positive stiffness lets grow."""
    content = case_groups(bearing, **(case | {"eccentricity": tuple(place[:2]), "tilt": tuple(place[2:])}))
    answer = solve(folder, "static", content)
    return numpy.array([-answer["force_x"], -answer["force_y"], answer["torque_x"], answer["torque_y"]])


def check_static(checks, folder, name, bearing, case, limit, step=1.0e-3, dynamics=None):
    """K at a frequency next to zero against four-point differences, 4 x 4."""
    groups = case.setdefault("groups", {})
    groups["solver"] = {"residual_tolerance": 1.0e-13, "step_tolerance": 1.0e-11}
    _, _, found = vibrate(folder, "slow", bearing, {"frequencies": [1.0e-3], **(dynamics or {})}, **case)
    place = numpy.array([*case["eccentricity"], *case["tilt"]])
    wanted = numpy.zeros((1, 4, 4))
    for j in range(4):
        width = step*bearing.clearance*(1.0 if j < 2 else 2.0/bearing.length)
        move = width*numpy.eye(4)[j]
        at = {k: static_force(folder, bearing, place + k*move, case) for k in (-2, -1, 1, 2)}
        wanted[0, :, j] = (8.0*(at[1] - at[-1]) - (at[2] - at[-2]))/(12.0*width)
    checks.below(f"{name}: K(0) against differences of forces, 4 x 4", block_error(found.real, wanted), limit)


def beams(friction):
    """Beams on a coarse mesh."""
    return {"mesh": (104, 4), "foil": "beam", "speed_rpm": 30000.0, "tilt": TILT,
            "eccentricity": (0.8*FOIL_BEARING.clearance, 0.2*FOIL_BEARING.clearance),
            "groups": {"model": {"half_width": "no"}, "mesh": {"align_crests": False}, "top_foil": METAL,
                       "bump_foil": {**METAL, "half_length": 1.778e-3, "height": 0.508e-3, "pitch": 4.572e-3,
                                     "bumps": 26, "fixed_line": "half_flat"},
                       "contact": {"friction_top": friction, "friction_sleeve": friction}}}


def check_slow(checks, folder):
    mean = {"model": {"foundation_pressure": "axial_mean", **SPRINGS}}
    check_static(checks, folder, "rigid, upwind", Bearing(),
                 {"mesh": (32, 8), "groups": {"model": {"film_scheme": "supg"}}, **TILTED}, 1.0e-8)
    check_static(checks, folder, "mean foundation", Bearing(),
                 {"mesh": (32, 8), "foil": "elastic_foundation", "groups": mean, **TILTED}, 1.0e-8)
    check_static(checks, folder, "beams, sliding on", FOIL_BEARING, beams(0.1), 2.0e-7, 5.0e-5,
                 {"contact_tangent": "slip"})


# --- what must not matter ---

def check_same(checks, folder):
    """Half and whole width, ranks, units; the table is the file's."""
    bearing = Bearing()
    ratios = {"frequency_ratios": (0.25, 1.0)}
    foils = {"rigid": {"foil": "rigid"},
             "local foundation": {"foil": "elastic_foundation", "groups": {
                 "model": {"foundation_pressure": "local", **SPRINGS}}},
             "mean foundation": {"foil": "elastic_foundation", "groups": {
                 "model": {"foundation_pressure": "axial_mean", **SPRINGS}}}}
    for name, foil in foils.items():
        case = {"mesh": (48, 8), "number": 2.0, "eccentricity": PLACE, **foil}
        losses = ratios if name == "rigid" else {**ratios, "loss_factor": 0.1, "foundation_damping": 1.0e5}
        found = {}
        for width in ("yes", "no"):
            case["groups"] = {"model": {**foil.get("groups", {}).get("model", {}), "half_width": width}}
            answer, _, found[width] = vibrate(folder, "width", bearing, losses, **case)
        size = numpy.abs(found["no"]).max()
        checks.below(f"{name}: half and whole width", block_error(found["yes"], found["no"], [(0, 0), (1, 1)]), 1.0e-10)
        checks.below(f"{name}: cross blocks vanish", numpy.abs(found["no"][:, :2, 2:]).max()/size, 1.0e-12)
        ranks = 4 if name == "mean foundation" else 2
        _, _, other = vibrate(folder, "ranks", bearing, losses, ranks, **case)
        checks.below(f"{name}: {ranks} ranks", block_error(other, found["no"], [(0, 0), (1, 1)]), 1.0e-8)
    rows = list(csv.reader(pathlib.Path(f"{answer.stem}.coefficients.csv").read_text().splitlines()))
    table = {key: numpy.array([float(row[i]) for row in rows[1:]]) for i, key in enumerate(rows[0])}
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        checks.that("table: rows and columns", numpy.array_equal(table["kxy"], file["dynamics/stiffness"][:, 0, 1]) and
                    numpy.array_equal(table["cphiyx"], file["dynamics/damping"][:, 3, 0]))
        checks.that("arrays have units and meanings", all({"unit", "meaning"} <= set(item.attrs)
                                                          for item in file["dynamics"].values()))
    check_units(checks, folder, bearing)
    check_beams(checks, folder)


def check_units(checks, folder, bearing):
    """Lengths twice, pressures four times as large: K is eight times as large, at the same frequencies."""
    case = {"mesh": (48, 8), "number": 2.0, "groups": {"model": {"half_width": "no"}}}
    _, _, one = vibrate(folder, "unit", bearing, {"frequencies": (2000.0, 8000.0)}, eccentricity=PLACE, tilt=TILT,
                        **case)
    large = Bearing(2.0*bearing.radius, 2.0*bearing.length, 2.0*bearing.clearance, 4.0*bearing.viscosity,
                    4.0*bearing.ambient_pressure)
    _, _, other = vibrate(folder, "unit", large, {"frequencies": (2000.0, 8000.0)},
                          eccentricity=tuple(2.0*e for e in PLACE), tilt=TILT, **case)
    scale = numpy.array([[8.0, 16.0], [16.0, 32.0]]).repeat(2, 0).repeat(2, 1)
    checks.below("units", block_error(other/scale, one), 1.0e-12)


def check_beams(checks, folder):
    """Half and whole width of beams, sticking; sticking contacts make a bearing stiffer than sliding ones."""
    case = beams(0.1) | {"tilt": (0.0, 0.0)}
    found = {}
    for width, tangent in (("yes", "stick"), ("no", "stick"), ("yes", "slip")):
        case["groups"]["model"]["half_width"] = width
        _, _, found[width, tangent] = vibrate(folder, "beams", FOIL_BEARING,
                                              {"frequency_ratios": (0.5,), "contact_tangent": tangent}, **case)
    checks.below("beams: half and whole width",
                 block_error(found["yes", "stick"], found["no", "stick"], [(0, 0), (1, 1)]), 1.0e-8)
    checks.that("beams: contacts that stick are stiffer than those that slide",
                found["yes", "stick"][0, 0, 0].real > 1.02*found["yes", "slip"][0, 0, 0].real)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_reference(checks, folder)
        check_ring(checks, folder)
        check_slow(checks, folder)
        check_same(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
