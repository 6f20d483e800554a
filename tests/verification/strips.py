#!/usr/bin/env python3
"""Strips and modes of shells: independent numbers, full against condensed, half width, ranks, files."""

import json
import math
import pathlib
import re
import sys
import tempfile

import h5py
import numpy

import gfb_run
from gfb_run import Checks, largest_difference

REFERENCE = json.loads((pathlib.Path(__file__).parent/"reference"/"strip.json").read_text(encoding="utf-8"))
FOIL = {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "half_length": 1.778e-3,
        "height": 0.508e-3, "pitch": 4.572e-3, "bumps": 10, "width": 38.1e-3, "fixed_edge": "leading"}
HELD = {"support": "held"}  # the checks here are those of the linear structure
MICROMETRE = 1.0e-6


def solve(folder, name, ranks=1, status=0, options=(), **groups):
    """Writes a case of the reference strip with changed groups, and runs it; corner lines cannot lift
    where no load is given."""
    content = {"scene": {"analysis": "strip"}, "bump_foil": dict(FOIL), "model": {},
               "mesh": {"arc_elements": 12, "flat_elements": 3, "axial_elements": 50}}
    for group, keys in groups.items():
        content.setdefault(group, {}).update(keys)
    if content["scene"]["analysis"] == "strip" and "strip_load" not in content:
        content["strip_load"] = {"pressure": 0.2e6, **HELD}
    return gfb_run.solve(folder, name, content, ranks, options, status)


def crests(answer):
    """Crest deflections in the order of the bumps."""
    bumps = sum(name.startswith("crest_deflection_") for name in answer.summary)
    return numpy.array([answer[f"crest_deflection_{bump}"] for bump in range(1, bumps + 1)])


def fields(answer):
    """Points, displacement and stresses of the foil's file."""
    with h5py.File(f"{answer.stem}.bump_foil.vtkhdf", "r") as file:
        group = file["VTKHDF"]
        found = {name: group["PointData"][name][...] for name in group["PointData"]}
        found |= {name: group["CellData"][name][...] for name in group["CellData"]}
        found["points"] = group["Points"][...]
    return found


def compare(checks, words, one, other, limit):
    """Crests and all fields of two strips."""
    checks.below(f"{words}: crests", largest_difference(crests(one), crests(other)), limit)
    first, second = fields(one), fields(other)
    checks.that(f"{words}: same fields", set(first) == set(second))
    for name in ("points", "displacement", "von_mises_upper"):
        checks.below(f"{words}: {name}", largest_difference(first[name], second[name]),
                     1.0e-15 if name == "points" else limit)


def check_reference(checks, folder):
    """Ten bumps of case 1 without friction; no corner line lifts there under the uniform load."""
    wanted = numpy.array(REFERENCE["case1"]["crest_deflection_um"]["friction 0"])*MICROMETRE
    strip = solve(folder, "reference")
    checks.below("case 1, friction 0: every crest", numpy.abs(crests(strip)/wanted - 1.0).max(), 1.0e-2)
    checks.that("unknowns 38505 and 7905", (strip["foil_unknowns_full"], strip["foil_unknowns_retained"])
                == (REFERENCE["case1"]["unknowns_full"], REFERENCE["case1"]["unknowns_reduced"]))
    checks.that("3 distinct super-elements", strip["distinct_super_elements"]
                == REFERENCE["case1"]["distinct_super_elements"])
    checks.below("largest crest", strip["maximum_deflection"]/crests(strip).max() - 1.0, 1.0e-15)
    table = REFERENCE["case1"]["increasing_decreasing_peak_0.4MPa_um"]["friction 0"]
    ramp = solve(folder, "ramp", strip_load={"pressure": 0.4e6, "distribution": "increasing_decreasing", **HELD})
    # In the reference the corner lines beside the clamped and lightly loaded bump 1 lift from the sleeve.
    off = crests(ramp)/(numpy.array(table)*MICROMETRE) - 1.0
    print("       increasing-decreasing, friction 0, off by", " ".join(f"{value:.1e}" for value in off))
    checks.below("increasing-decreasing, friction 0: crests 3 to 10", numpy.abs(off[2:]).max(), 1.0e-2)
    same = [0.08e6*min(n, 11 - n) for n in range(1, 11)]
    listed = solve(folder, "listed", strip_load={"distribution": "table", "bump_pressure": same, **HELD})
    checks.below("the same as a table", largest_difference(crests(ramp), crests(listed)), 1.0e-12)
    return strip


def check_same(checks, folder, strip):
    """What must not change the answer."""
    full = solve(folder, "full", model={"reduction": "none"})
    compare(checks, "full and condensed", full, strip, 1.0e-9)
    compare(checks, "half and whole width", solve(folder, "whole", model={"half_width": "no"}), strip, 1.0e-9)
    compare(checks, "2 ranks", solve(folder, "ranks", ranks=2), strip, 1.0e-8)
    compare(checks, "full, 2 ranks", solve(folder, "full_2", ranks=2, model={"reduction": "none"}), full, 1.0e-8)
    mirrored = solve(folder, "mirrored", bump_foil={"fixed_edge": "trailing"})
    checks.below("mirrored strip", largest_difference(crests(mirrored)[::-1], crests(strip)), 1.0e-9)
    twice = solve(folder, "twice", strip_load={"pressure": 0.4e6, **HELD})
    checks.below("twice the load", largest_difference(crests(twice), 2.0*crests(strip)), 1.0e-12)
    for line in ("flat", "half_flat"):
        one = solve(folder, line, bump_foil={"fixed_line": line})
        other = solve(folder, f"{line}_full", bump_foil={"fixed_line": line}, model={"reduction": "none"})
        compare(checks, f"fixed_line '{line}', full and condensed", other, one, 1.0e-9)
    free = solve(folder, "free", bump_foil={"fixed_edge": "none"})
    checks.below("free strip: symmetric about its middle crest for bumps far from the ends",
                 crests(free)[4]/crests(free)[5] - 1.0, 1.0e-3)


def check_convergence(checks, folder, strip):
    """The paper's mesh, which the strip has, is 1.6 to 2 % stiff at an inner bump."""
    finer = [solve(folder, f"mesh_{k}", mesh={"arc_elements": 12*k, "flat_elements": 3*k,
                                              "axial_elements": 50}) for k in (2, 4)]
    inner = [crests(answer)[4] for answer in (strip, *finer)]
    order = numpy.log2((inner[1] - inner[0])/(inner[2] - inner[1]))
    checks.within("order of an inner crest along the arc", order, 1.8, 2.2)
    finest = inner[2] + (inner[2] - inner[1])/3.0
    checks.within("the paper's mesh is stiff by [%]", 100.0*(1.0 - inner[0]/finest), 1.2, 2.2)


def check_stress(checks, folder):
    """The crest of one bump that glides on both feet: Winkler and Bach's bar bent by half the load times half its length."""
    thickness, half_length, height = FOIL["thickness"], FOIL["half_length"], FOIL["height"]
    radius = (half_length**2 + height**2)/(2.0*height)
    inner, outer = radius - 0.5*thickness, radius + 0.5*thickness
    neutral = thickness/math.log(outer/inner)
    moment = 0.5*0.2e6*FOIL["pitch"]*half_length  # a metre of width
    true = moment*(neutral - inner)/(thickness*(radius - neutral)*inner)
    errors = []
    for elements in (6, 12):
        answer = solve(folder, "stress", bump_foil={"bumps": 1, "fixed_edge": "none", "poissons_ratio": 0.0},
                       contact={"friction_top": 0.0, "friction_sleeve": 0.0}, strip_load={"pressure": 0.2e6},
                       mesh={"arc_elements": elements, "flat_elements": 2, "axial_elements": 2})
        errors.append(answer["maximum_bump_foil_stress"]/true - 1.0)
    checks.below("largest stress of a bump against Winkler and Bach", errors[1], 2.0e-3)
    checks.within("order of that", math.log2(abs(errors[0]/errors[1])), 1.8, 4.5)


def check_modes(checks, folder):
    """Fixed-interface frequencies, rigid modes, Craig-Bampton."""
    wanted = REFERENCE["modes_kHz"]["case1_fixed_interface"]
    density = {"density": REFERENCE["modes_kHz"]["density_kg_m3"]}
    for part, name in (("half_arc", "half arc"), ("arc", "whole arc, corner lines fixed"), ("flat", "flat")):
        modes = solve(folder, part, scene={"analysis": "modes"}, modes={"part": part, "count": 3}, bump_foil=density)
        found = numpy.array([modes[f"frequency_{i}"] for i in (1, 2, 3)])
        checks.below(f"modes of {name}", numpy.abs(found/1.0e3/numpy.array(wanted[name]) - 1.0).max(), 1.0e-2)
    mesh = {"arc_elements": 4, "flat_elements": 2, "axial_elements": 12}
    case = {"scene": {"analysis": "modes"}, "mesh": mesh}
    free = solve(folder, "free_modes", bump_foil={**density, "fixed_edge": "none"}, modes={"count": 8}, **case)
    checks.that("a free strip has six rigid modes", free["rigid_modes"] == 6)
    errors = []
    for kept in (0, 10):
        strip = solve(folder, f"kept_{kept}", bump_foil=density, modes={"count": 10, "substructure_modes": kept},
                      **case)
        full, reduced = (numpy.array([strip[f"{kind}frequency_{i}"] for i in range(1, 11)])
                         for kind in ("", "craig_bampton_"))
        errors.append(numpy.abs(reduced/full - 1.0).max())
        checks.below(f"Craig-Bampton, {kept} modes", errors[-1], 1.0e-4 if kept == 0 else 1.0e-5)
    checks.that(f"more modes, smaller error: {errors[1]:.1e} < {errors[0]:.1e}", errors[1] < errors[0])
    with h5py.File(f"{strip.stem}.h5", "r") as file:
        for kind in file["craig_bampton"]:
            if kind.startswith("kind_of"):
                continue
            mass = file[f"craig_bampton/{kind}/mass"][...]
            checks.below(f"{kind}: mass is symmetric", largest_difference(mass, mass.T), 1.0e-14)
            masses = numpy.linalg.eigvalsh(mass)
            checks.that(f"{kind}: mass is not negative", masses.min() > -1.0e-12*masses.max())
    with h5py.File(f"{strip.stem}.bump_foil.vtkhdf", "r") as file:
        checks.that("every mode has its shape", all(f"mode_{i}" in file["VTKHDF/PointData"] for i in range(1, 11)))
    plate = solve(folder, "plate", scene={"analysis": "modes"}, modes={"part": "top_foil", "count": 2},
                  bearing={"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6},
                  top_foil={"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, **density},
                  mesh={"circumferential_elements": 96, "axial_elements": 16})
    # A cantilever plate bends first like a beam between plane stress and plane strain.
    length = 2.0*numpy.pi*19.05e-3
    beam = 1.8751**2/(2.0*numpy.pi*length**2)*0.102e-3*numpy.sqrt(214.0e9/12.0/density["density"])
    checks.within("top foil: first bending over a beam's", plate["frequency_1"]/beam, 0.99, 1.05)


def check_numbers(checks, folder):
    """Contacts too soft and a stick length too long are told after the answer with what they are off by; defaults are not."""
    def squeezed(name, **contact):
        return solve(folder, name, bump_foil={"bumps": 2, "fixed_edge": "none"}, model={"reduction": "guyan"},
                     mesh={"arc_elements": 6, "flat_elements": 2, "axial_elements": 4},
                     contact={"friction_top": 0.2, "friction_sleeve": 0.2, **contact},
                     strip_load={"kind": "plates", "maximum_force": 60.0, "steps_up": 6, "steps_down": 6})

    plain = squeezed("plain")
    checks.that("contacts by default: no warning", "warning: contacts" not in plain.log and "warning: stick_length" not in plain.log)
    soft = squeezed("soft", normal_stiffness=1.0e9)
    off = 100.0*(soft["maximum_deflection"]/plain["maximum_deflection"] - 1.0)
    told = re.search(r"contacts penetrate by up to \S+ um, (\S+) % of the deflection .*: normal_stiffness = 1e9 in &contact", soft.log)
    checks.within(f"soft contacts: {off:.2g} % off, and the warning says so", off/float(told[1]) if told else 0.0, 0.5, 2.0)
    drawn = squeezed("drawn", stick_length=2.0e-7)
    lost = 100.0*(1.0 - drawn["dissipated_energy"]/plain["dissipated_energy"])
    told = re.search(r"warning: stick_length = 2e-7 m .*: about (\S+) % of the energy", drawn.log)
    checks.within(f"long stick length: {lost:.2g} % of the energy lacking, and the warning says so",
                  lost/float(told[1]) if told else 0.0, 0.3, 3.0)
    late = squeezed("late", stick_length=2.0e-5)
    checks.that("stick length as long as the slip: the answer is off, and that is told", "friction comes up so late" in late.log
                and late["maximum_deflection"]/plain["maximum_deflection"] > 1.005)


def check_reader(checks, folder, strip):
    """VTK's own reader opens the foil's file."""
    try:
        import vtk
    except ImportError:
        print("       no vtk in this Python: its reader is not asked")
        return
    reader = vtk.vtkHDFReader()
    reader.SetFileName(f"{strip.stem}.bump_foil.vtkhdf")
    reader.Update()
    grid = reader.GetOutput()
    checks.that("vtk: 151 x 51 points", grid.GetNumberOfPoints() == 151*51)
    checks.that("vtk: 150 x 50 cells", grid.GetNumberOfCells() == 150*50)
    checks.that("vtk: displacement is a vector",
                grid.GetPointData().GetArray("displacement").GetNumberOfComponents() == 3)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        strip = check_reference(checks, folder)
        if "--long" in sys.argv[1:]:
            check_same(checks, folder, strip)
            checks.close()
        check_convergence(checks, folder, strip)
        check_stress(checks, folder)
        check_modes(checks, folder)
        check_numbers(checks, folder)
        check_reader(checks, folder, strip)
    checks.close()


if __name__ == "__main__":
    main()
