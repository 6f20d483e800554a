#!/usr/bin/env python3
"""Strips side by side with sizes of their own: the sum of the single strips; equal values as today's."""


import h5py
import numpy

from bump_sizes import BEARING, bearing, run_strip
from gfb_run import largest_difference, natural_sizes, run_checks, summary_difference
from split_strips import CUT, SUMS
from strips import FOIL, MICROMETRE

NAMES = ("pitch", "half_length", "height", "thickness")
MESH = {"arc_elements": 8, "flat_elements": 2}
PLATES = {"kind": "plates", "maximum_displacement": 6*MICROMETRE, "steps_up": 3, "steps_down": 0, "pressure": None}
LAW = {"normal_stiffness": 2.0e11}  # the default follows the mean bump
EACH = 4  # elements of a strip along the axis
SOFT = {"half_length": [1.9e-3, 1.6e-3, 1.7e-3], "thickness": [0.9e-4, 1.1e-4, 1.0e-4]}
ALL = {**SOFT, "pitch": [4.6e-3, 4.1e-3, 4.9e-3], "height": [0.507e-3, 0.505e-3, 0.508e-3],
       "offset": [0.0, 1.2e-3, 0.4e-3]}
MIRRORED = {"half_length": [1.9e-3, 1.6e-3, 1.9e-3], "height": [0.506e-3, 0.508e-3, 0.506e-3],
            "pitch": [4.6e-3, 4.1e-3, 4.6e-3], "offset": [0.0, 1.2e-3, 0.0]}
TWO = {"half_length": [1.9e-3, 1.6e-3], "thickness": [0.9e-4, 1.1e-4]}


def split(folder, name, sizes, load=None, foil=None, mesh=MESH, **groups):
    """Strips side by side."""
    strips = len(next(iter(sizes.values())))
    content = {**FOIL, "bumps": 3, **dict.fromkeys(set(NAMES) & set(sizes)), **(foil or {}), "strips": strips,
               "cut_width": CUT, **{f"strip_{size}": values for size, values in sizes.items()}}
    groups.setdefault("contact", LAW)
    return run_strip(folder, name, content, strip_load=load or PLATES, mesh={**mesh, "axial_elements": EACH*strips}, **groups)


def singles(folder, sizes, foil=None, **groups):
    """History of each strip alone; a lower one stands as far below the plate as it is lower."""
    strips = len(next(iter(sizes.values())))
    groups.pop("ranks", None)
    histories = []
    for strip in range(strips):
        own = {size: values[strip] for size, values in sizes.items() if size != "offset"}
        low = max(sizes["height"]) - own["height"] if "height" in sizes else 0.0
        content = {**FOIL, "bumps": 3, **(foil or {}), **own, "width": (FOIL["width"] - (strips - 1)*CUT)/strips}
        if low > 0.0:
            content["crest_gap"] = low
        histories.append(run_strip(folder, "one", content, strip_load=PLATES, mesh={**MESH, "axial_elements": EACH},
                                   contact=LAW, **groups).history())
    return histories


def check_sums(checks, folder):
    """Without friction: forces and energies of the whole are the sum of those of the strips."""
    trailing = {"fixed_edge": "trailing", "fixed_line": "half_flat"}
    for words, sizes, foil, groups in (
            ("softer, leading edge", SOFT, {}, {}),
            ("all sizes, leading edge", ALL, {}, {}),
            ("all sizes, trailing edge", ALL, trailing, {}),
            ("all sizes, not condensed", ALL, {}, {"model": {"reduction": "none"}}),
            ("all sizes, two ranks", ALL, trailing, {"ranks": 2}),
            ("fixed nowhere", ALL, {"fixed_edge": "none"}, {}),
            ("mirrored, half width", MIRRORED, {}, {}),
            ("mirrored, whole width", MIRRORED, {}, {"model": {"half_width": "no"}}),
            ("two strips", TWO, {}, {})):
        whole = split(folder, "split", sizes, foil=foil, **groups)
        half = "width: half" in whole.log
        checks.that(f"{words}: half width only where strips mirror each other", half == (words == "mirrored, half width"))
        parts = singles(folder, sizes, foil, **groups)
        off = max(largest_difference(whole.history()[name], sum(part[name] for part in parts)) for name in SUMS)
        checks.below(f"{words}: forces and energies", off, 1.0e-8)


def check_kinks(checks, folder):
    """Strips of three heights: no force before the plate has reached the highest, then straight between heights."""
    sizes = {"height": [0.504e-3, 0.508e-3, 0.506e-3]}
    rows = split(folder, "heights", sizes, {**PLATES, "steps_up": 12}, {"bumps": 1}).history()
    slope = numpy.diff(rows["force"], prepend=0.0)
    bend = numpy.flatnonzero(numpy.abs(numpy.diff(slope)) > 0.05*slope[0])
    checks.that(f"slopes change at 2 and 4 um: {0.5*(bend + 1)}", list(bend) == [3, 7])
    rows = split(folder, "force", sizes, {"kind": "plates", "maximum_force": 60.0, "steps_up": 2, "steps_down": 0,
                                          "pressure": None}, {"bumps": 1}).history()
    checks.that("a forced plate lies on the highest strip at first", rows["plate_travel"][0] > 0.0)


def check_equal(checks, folder):
    """Lists of equal values, or one for all, are the single values, to the last digit."""
    equal = {size: 3*[FOIL[size]] for size in NAMES}
    plain = run_strip(folder, "plain", {**FOIL, "bumps": 3, "strips": 3, "cut_width": CUT}, strip_load=PLATES,
                      mesh={**MESH, "axial_elements": 3*EACH}, contact=LAW)
    for words, sizes in (("three values", {**equal, "offset": 3*[0.0]}), ("one value", {})):
        lists = split(folder, "equal", sizes or equal, foil={} if sizes else {
            f"strip_{size}": FOIL[size] for size in NAMES})
        checks.that(f"{words}: the same answer to the last digit",
                    {**lists.summary, "wall_time": 0.0} == {**plain.summary, "wall_time": 0.0})


def check_bearings(checks, folder):
    """Under a film: half and whole width, condensed and full, two ranks; forces balance; softer edges deflect."""
    foil = {**FOIL, "bumps": 26, "fixed_edge": "trailing", "fixed_line": "half_flat"}
    cut = {"strips": 3, "cut_width": CUT}
    own = {**cut, "half_length": None, "strip_half_length": [1.95e-3, 1.778e-3, 1.95e-3], "thickness": None,
           "strip_thickness": [0.95e-4, 1.05e-4, 0.95e-4]}
    shifted = {**cut, "strip_offset": [0.0, 1.5e-3, 0.0], "pitch": 4.4e-3}
    clean = {name: {key: value for key, value in {**foil, **more}.items() if value is not None}
             for name, more in (("plain", cut), ("own", own), ("shifted", shifted))}
    runs = {name: bearing(folder, name, content, "shell") for name, content in clean.items()}
    for words, name, groups in (("whole width", "own", {"model": {"half_width": "no"}}),
                                ("not condensed", "own", {"model": {"reduction": "none"}}),
                                ("two ranks", "own", {"ranks": 2}), ("two ranks", "shifted", {"ranks": 2}),
                                ("whole width", "shifted", {"model": {"half_width": "no"}})):
        other = bearing(folder, "other", clean[name], "shell", **groups)
        difference = summary_difference(other, runs[name], natural_sizes(BEARING))
        checks.below(f"{name}, {words}: {difference[1]}", difference[0], 1.0e-6)
    sag = {}
    for name in ("plain", "own"):
        with h5py.File(f"{runs[name].stem}.top_foil.vtkhdf") as file:
            points, moved = file["VTKHDF"]["Points"][...], file["VTKHDF"]["PointData"]["displacement"][...]
            middle = points[:, 2] == 0.0
            at = numpy.argmin(numpy.where(middle, moved[:, 1], 0.0))  # pressed most
            edge = (numpy.abs(points[:, 0] - points[at, 0]) < 1.0e-9) & (points[:, 2] == points[:, 2].max())
            sag[name] = moved[edge, 1][0]/moved[at, 1]
    print(f"       deflection of the edge over that of the middle: {sag['own']:.3f}; of equal strips {sag['plain']:.3f}")
    checks.that("softer edges deflect more, against the middle", sag["own"] > 1.1*sag["plain"])


def main():
    run_checks((check_kinks, check_equal, check_bearings), (check_sums,))


if __name__ == "__main__":
    main()
