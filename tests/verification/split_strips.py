#!/usr/bin/env python3
"""Strips side by side, cut apart: a split strip is the sum of its strips."""

import tempfile

import h5py
import numpy


from bump_sizes import BEARING, bearing, run_strip
from gfb_run import Checks, case_groups, largest_difference, natural_sizes, solve, summary_difference
from sample import normal
from strips import FOIL, HELD, MICROMETRE, crests

CUT = 0.8e-3
PLATES = {"kind": "plates", "maximum_displacement": 5*MICROMETRE, "steps_up": 2, "steps_down": 0, "pressure": None}
SUMS = ("force", "external_work", "strain_energy", "penalty_energy")


def pair(folder, strips, elements, load, foil=None, **groups):
    """A split strip, and one of its strips alone, each with `elements` elements along the axis."""
    foil = {**FOIL, "bumps": 3, **(foil or {})}
    alone = (foil["width"] - (strips - 1)*CUT)/strips
    mesh = {"arc_elements": 8, "flat_elements": 2}
    whole = run_strip(folder, "split", {**foil, "strips": strips, "cut_width": CUT}, strip_load=load,
                      mesh={**mesh, "axial_elements": strips*elements}, **groups)
    groups.pop("ranks", None)
    if "maximum_force" in load:
        load = {**load, "maximum_force": load["maximum_force"]/strips}
    one = run_strip(folder, "one", {**foil, "width": alone}, strip_load=load,
                    mesh={**mesh, "axial_elements": elements}, **groups)
    return whole, one


def check_sums(checks, folder):
    """Without friction: forces, energies and stiffness of a split strip are those of one strip, times their number."""
    free = {"fixed_edge": "none"}
    for words, strips, foil, load, groups in (
            ("plates, held", 2, {}, {**PLATES, **HELD}, {}),
            ("plates, held", 3, {}, {**PLATES, **HELD}, {}),
            ("plates, resting on the sleeve", 4, {}, PLATES, {}),
            ("plates, whole width", 3, {}, PLATES, {"model": {"half_width": "no"}}),
            ("plates, whole width", 2, {}, PLATES, {"model": {"half_width": "no"}}),
            ("plates, not condensed", 2, {}, PLATES, {"model": {"reduction": "none"}}),
            ("plates, two ranks", 2, {}, PLATES, {"ranks": 2}),
            ("plates, fixed nowhere", 2, free, PLATES, {}),
            ("plates, fixed nowhere", 3, free, PLATES, {}),
            ("plates, own sizes", 2, {"bump_height": [5.08e-4, 5.07e-4, 5.06e-4], "height": None,
                                      "bump_thickness": [1.0e-4, 0.9e-4, 1.1e-4], "thickness": None}, PLATES, {}),
            ("forced plate", 2, {}, {**PLATES, "maximum_displacement": None, "maximum_force": 40.0}, {}),
            ("crest pressure", 3, {}, {"support": "held"}, {})):
        split, one = pair(folder, strips, 4, load, foil, **groups)
        words = f"{strips} strips, {words}"
        off = max(largest_difference(split.history()[name], strips*one.history()[name]) for name in SUMS)
        checks.below(f"{words}: forces and energies", off, 1.0e-8)
        checks.below(f"{words}: crests", largest_difference(crests(split), crests(one)), 1.0e-8)
        if words == "2 strips, plates, held":
            with h5py.File(f"{split.stem}.bump_foil.vtkhdf") as file:
                stations = len(numpy.unique(file["VTKHDF"]["Points"][:, 0].round(12)))
                checks.that("no cells over the cut", file["VTKHDF"]["NumberOfCells"][0] == 8*(stations - 1))
                points, cells = file["VTKHDF"]["Points"][...], file["VTKHDF"]["Connectivity"][...].reshape(-1, 4)
                middle = points[cells][:, :, 2].mean(axis=1)
                checks.that("all cells beside it", (numpy.abs(middle) > 0.5*CUT).all())


def check_heights(checks, folder):
    """With random heights each strip has a draw of its own: the numbers of a seed one after the other, as of pads."""
    strips, bumps = 3, 3
    groups = {"strip_load": PLATES, "model": {"half_width": "no"}}
    foil, mesh = {**FOIL, "bumps": bumps}, {"arc_elements": 8, "flat_elements": 2}
    split = run_strip(folder, "split", {**foil, "strips": strips, "cut_width": CUT, "height_deviation": MICROMETRE, "seed": 5},
                      mesh={**mesh, "axial_elements": 2*strips}, **groups)
    total = 0.0
    for heights in normal(5, strips*bumps).reshape(strips, bumps)*MICROMETRE:
        one = run_strip(folder, "one", {**foil, "width": (FOIL["width"] - (strips - 1)*CUT)/strips,
                                        "crest_gap": list(heights.max() - heights)}, mesh={**mesh, "axial_elements": 2}, **groups)
        total = total + one.history()["force"]
    checks.below("random heights: force of three strips with draws of their own", largest_difference(split.history()["force"], total),
                 1.0e-8)


def check_bearings(checks, folder):
    """Strips under a film."""
    foil = {**FOIL, "bumps": 26, "fixed_edge": "trailing", "fixed_line": "half_flat"}
    split = {"strips": 2, "cut_width": CUT}
    part = 1.0 - CUT/BEARING.length
    law = {"friction_top": 0.1, "friction_sleeve": 0.1, "normal_stiffness": 2.0e11, "stick_length": 6.0e-9}
    one = bearing(folder, "beam_split", {**foil, **split}, "beam", contact=law)
    soft = {**foil, "youngs_modulus": part*FOIL["youngs_modulus"]}
    other = bearing(folder, "beam_soft", soft, "beam", contact={**law, "normal_stiffness": part*2.0e11})
    other.summary["maximum_bump_foil_stress"] /= part  # its forces are spread over the whole width
    checks.below("beams: a split strip is one of the width without the cut",
                 summary_difference(one, other, natural_sizes(BEARING))[0], 1.0e-6)
    shells = {}
    for words, foils, groups in (("split", split, {}), ("whole", split, {"model": {"half_width": "no"}}),
                                 ("uncut", {}, {}), ("three", {"strips": 3, "cut_width": CUT}, {})):
        shells[words] = bearing(folder, words, {**foil, **foils}, "shell", **groups)
    shells["ranks"] = bearing(folder, "ranks", {**foil, **split}, "shell", ranks=2)
    for words, limit in (("whole", 1.0e-6), ("ranks", 1.0e-6)):
        difference = summary_difference(shells[words], shells["split"], natural_sizes(BEARING))
        checks.below(f"shells, 2 strips, {words}: {difference[1]}", difference[0], limit)
    for words in ("split", "three"):
        off = numpy.hypot(shells[words]["force_x"], shells[words]["force_y"])/ \
            numpy.hypot(shells["uncut"]["force_x"], shells["uncut"]["force_y"]) - 1.0
        print(f"       shells, {words}: force off that of one strip by {100*off:.3f} %")
        checks.below(f"shells, {words}: force near that of one strip", off, 2.0e-2)


def check_cold_start(checks, folder):
    """Crests of cut strips keep touching where a smaller mesh's answer is carried over: few factorizations of the finest mesh."""
    foil = {**FOIL, "bumps": 26, "fixed_edge": "trailing", "fixed_line": "half_flat", "cut_width": 0.5e-3}
    for strips in (3, 5):
        case = case_groups(BEARING, mesh=(None, 32), foil="shell", load=(-100.0, 0.0), speed_rpm=30000.0, groups={
            "top_foil": {"thickness": 1.02e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29, "fixed_edge": "trailing"},
            "bump_foil": {key: value for key, value in {**foil, "strips": strips}.items() if key != "width"},
            "contact": {"friction_top": 0.1, "friction_sleeve": 0.1}})
        found = solve(folder, f"cold_{strips}", case)
        checks.within(f"{strips} strips, cold: factorizations of the finest mesh", found["factorizations_finest"], 3, 8)
        checks.within(f"{strips} strips, cold: factorizations", found["factorizations"], 30, 50)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_cold_start(checks, folder)
        check_sums(checks, folder)
        check_heights(checks, folder)
        check_bearings(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
