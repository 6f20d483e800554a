#!/usr/bin/env python3
"""Bumps with sizes of their own: against planar frames, against equal ones, full against condensed."""

import tempfile

import h5py
import numpy

import gfb_run
from gfb_run import Checks, case_groups, largest_difference
from strips import FOIL, HELD, MICROMETRE, crests, fields, solve

SMALL = {"arc_elements": 8, "flat_elements": 2, "axial_elements": 4}
SIZES = {"bump_pitch": [4.6e-3, 3.9e-3, 5.2e-3, 4.1e-3], "bump_half_length": [1.8e-3, 1.5e-3, 2.1e-3, 1.7e-3],
         "bump_height": [0.50e-3, 0.42e-3, 0.51e-3, 0.47e-3], "bump_thickness": [1.0e-4, 0.8e-4, 1.2e-4, 0.9e-4]}
SCALARS = {f"bump_{name}": name for name in ("pitch", "half_length", "height", "thickness")}
BEARING = gfb_run.Bearing(radius=19.05e-3, length=38.1e-3, clearance=31.8e-6, viscosity=1.95e-5)


def listed(sizes, **foil):
    """A bump foil whose sizes are lists."""
    kept = {key: value for key, value in FOIL.items() if key not in SCALARS.values()}
    return {**{name: None for name in SCALARS.values()}, **kept, "bumps": len(sizes["bump_pitch"]), **sizes, **foil}


def run_strip(folder, name, foil, **groups):
    """A strip of shells; a key that is None is left out."""
    content = {"scene": {"analysis": "strip"}, "model": {}, "mesh": dict(SMALL),
               "bump_foil": {key: value for key, value in foil.items() if value is not None},
               "strip_load": {"pressure": 0.2e6}}
    ranks = groups.pop("ranks", 1)
    for group, keys in {"strip_load": HELD, **groups}.items():
        content.setdefault(group, {}).update(keys)
    content["strip_load"] = {key: value for key, value in content["strip_load"].items() if value is not None}
    return gfb_run.solve(folder, name, content, ranks)


def frame(sizes, begins, pressure, elements=40):
    """Crest deflections of a chain of beams per metre of width, Poisson's ratio 0: arcs and flats of their
    own thickness; feet glide on the sleeve and turn, the first line is clamped."""
    pitch, half, high, thick = (numpy.array(sizes[name]) for name in SIZES)
    flat = pitch - 2.0*half
    pieces = []  # points and thickness of each stretch
    start = 0.0

    def level(length, thickness):
        nonlocal start
        pieces.append((numpy.array([[start + length*k/6, 0.0] for k in range(7)]), thickness, None))
        start += length

    bumps = len(pitch)
    if begins == "half_flat":
        level(0.5*flat[0], thick[0])
    for bump in range(bumps):
        if begins == "flat":
            level(flat[bump], thick[bump])
        radius = (half[bump]**2 + high[bump]**2)/(2.0*high[bump])
        angle = 2.0*numpy.arctan2(high[bump], half[bump])
        turn = numpy.linspace(-angle, angle, elements + 1)
        points = numpy.stack([start + half[bump] + radius*numpy.sin(turn),
                              high[bump] - radius*(1.0 - numpy.cos(turn))], axis=1)
        pieces.append((points, thick[bump], bump))
        start += 2.0*half[bump]
        if begins == "corner":
            level(flat[bump], thick[bump])
        elif begins == "half_flat" and bump < bumps - 1:
            level(0.5*(flat[bump] + flat[bump + 1]), 0.5*(thick[bump] + thick[bump + 1]))
    if begins == "half_flat":
        level(0.5*flat[-1], thick[-1])
    nodes = 1 + sum(len(points) - 1 for points, _, _ in pieces)
    stiffness, load = numpy.zeros((3*nodes, 3*nodes)), numpy.zeros(3*nodes)
    fixed, crest, last = {0, 1, 2}, [], 0
    for points, thickness, bump in pieces:
        if bump is not None:
            fixed |= {3*last + 1, 3*(last + elements) + 1}
            crest.append(last + elements//2)
            load[3*crest[-1] + 1] = -pressure*pitch[bump]
        for one, other in zip(points, points[1:]):
            along = numpy.arange(3*last, 3*last + 6)
            stiffness[numpy.ix_(along, along)] += beam(one, other, thickness)
            last += 1
    free = [number for number in range(3*nodes) if number not in fixed]
    moved = numpy.zeros(3*nodes)
    moved[free] = numpy.linalg.solve(stiffness[numpy.ix_(free, free)], load[free])
    return -moved[3*numpy.array(crest) + 1]


def beam(one, other, thickness):
    """Stiffness of a straight Timoshenko beam a metre wide."""
    length = numpy.hypot(*(other - one))
    c, s = (other - one)/length
    shear = 12.0*thickness**2/12.0/(5.0/6.0*0.5*length**2)
    a = FOIL["youngs_modulus"]*thickness/length
    d = FOIL["youngs_modulus"]*thickness**3/12.0/length**3/(1.0 + shear)
    near, far = (4.0 + shear)*d*length**2, (2.0 - shear)*d*length**2
    local = numpy.array([[a, 0, 0, -a, 0, 0], [0, 12*d, 6*d*length, 0, -12*d, 6*d*length],
                         [0, 6*d*length, near, 0, -6*d*length, far],
                         [-a, 0, 0, a, 0, 0], [0, -12*d, -6*d*length, 0, 12*d, -6*d*length],
                         [0, 6*d*length, far, 0, -6*d*length, near]])
    turn = numpy.kron(numpy.eye(2), numpy.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]))
    return turn.T @ local @ turn


def check_frames(checks, folder):
    """Each of four bumps has its sizes, whichever edge is fixed and however the strip begins."""
    fine = {"arc_elements": 40, "flat_elements": 10, "axial_elements": 2}
    for begins in ("corner", "flat", "half_flat"):
        wanted = frame(SIZES, begins, 0.2e6)
        foil = listed(SIZES, poissons_ratio=0.0, fixed_line=begins)
        found = crests(run_strip(folder, f"frame_{begins}", foil, mesh=fine))
        checks.below(f"own sizes, begins with '{begins}': crests of a planar frame",
                     numpy.abs(found/wanted - 1.0).max(), 5.0e-3)
        back = {name: values[::-1] for name, values in SIZES.items()}
        foil = listed(back, poissons_ratio=0.0, fixed_line=begins, fixed_edge="trailing")
        other = crests(run_strip(folder, f"frame_{begins}_back", foil, mesh=fine))
        checks.below(f"own sizes, begins with '{begins}': mirrored", largest_difference(other[::-1], found), 1.0e-8)


def check_single(checks, folder):
    """A bump of each size alone: Walowit and Anno's stiffness where it is flat, and the run's own companion."""
    for bump in range(4):
        sizes = {name: [values[bump]] for name, values in SIZES.items()}
        sizes["bump_height"] = [sizes["bump_half_length"][0]/50.0]
        foil = listed(sizes, poissons_ratio=0.0, fixed_edge="none")
        answer = run_strip(folder, "single", foil, mesh={"arc_elements": 32, "axial_elements": 2})
        force = 0.2e6*sizes["bump_pitch"][0]
        thickness, half = sizes["bump_thickness"][0], sizes["bump_half_length"][0]
        wanted = force/(FOIL["youngs_modulus"]*thickness**3/(2.0*half**3))
        checks.below(f"bump {bump + 1} alone, nearly flat: Walowit and Anno", crests(answer)[0]/wanted - 1.0, 1.0e-2)
    with h5py.File(f"{run_strip(folder, 'companions', listed(SIZES)).stem}.h5") as file:
        found = file["companions/walowit_anno"][...].ravel()
        checks.that("own sizes: no planar chain, which has bumps alike", "planar_chain" not in file["companions"])
    wanted = [0.2e6*s*2.0*(1.0 - FOIL["poissons_ratio"]**2)*(l/t)**3/FOIL["youngs_modulus"]
              for s, l, t in zip(*(SIZES[name] for name in ("bump_pitch", "bump_half_length", "bump_thickness")))]
    checks.below("own sizes: companions of single bumps", largest_difference(found, wanted), 1.0e-12)


def check_same(checks, folder):
    """What must not change the answer; equal sizes are the single ones to the last digit."""
    one = run_strip(folder, "own", listed(SIZES))
    for words, groups in (("not condensed", {"model": {"reduction": "none"}}), ("two ranks", {"ranks": 2}),
                          ("whole width", {"model": {"half_width": "no"}})):
        other = run_strip(folder, "other", listed(SIZES), **groups)
        checks.below(f"own sizes, {words}: crests", largest_difference(crests(other), crests(one)), 1.0e-9)
        checks.below(f"own sizes, {words}: stresses", largest_difference(
            fields(other)["von_mises_upper"], fields(one)["von_mises_upper"]), 1.0e-7)
    checks.that(f"own sizes: {one['distinct_super_elements']:.0f} kinds of super-elements",
                one["distinct_super_elements"] == 12)
    two = {name: [values[0], values[1], values[0], values[1]] for name, values in SIZES.items()}
    checks.that("two sizes in turn: the kinds of two bumps",
                run_strip(folder, "two", listed(two))["distinct_super_elements"] == 6)
    scalar = {**FOIL, "bumps": 4}
    equal = {name: 4*[FOIL[key]] for name, key in SCALARS.items()}
    for line in ("corner", "half_flat"):
        first = run_strip(folder, "scalar", {**scalar, "fixed_line": line})
        for words, sizes in (("", equal), (", one value", {name: values[:1] for name, values in equal.items()})):
            second = run_strip(folder, "equal", listed(sizes, bumps=4, fixed_line=line))
            checks.that(f"equal sizes{words}, begins with '{line}': every number of the summary",
                        first.physical() == second.physical())


def check_stepped_heights(checks, folder):
    """Bumps far apart under a plate: straight between kinks where the next lower crest is met."""
    gap = numpy.array([5.0, 0.0, 8.5])*MICROMETRE
    sizes = {"bump_pitch": 3*[40*FOIL["half_length"]], "bump_half_length": 3*[FOIL["half_length"]],
             "bump_height": list(FOIL["height"] - gap), "bump_thickness": [FOIL["thickness"]]}
    load = {"kind": "plates", "maximum_displacement": 12*MICROMETRE, "steps_up": 24, "steps_down": 0, **HELD}
    rows = run_strip(folder, "stepped", listed(sizes), strip_load={**load, "pressure": None}).history()
    force, travel = rows["force"], rows["plate_travel"]
    slope = numpy.diff(force)/numpy.diff(travel)
    lines = []
    for low, high in ((0.0, 5.0), (5.0, 8.5), (8.5, 12.0)):
        at = numpy.flatnonzero((travel[:-1] > (low + 0.4)*MICROMETRE) & (travel[1:] < (high - 0.1)*MICROMETRE))
        checks.below(f"heights in steps: straight from {low} to {high} um",
                     numpy.ptp(slope[at])/slope[at].mean(), 2.0e-3)
        lines.append((slope[at[-1]], force[at[-1]] - slope[at[-1]]*travel[at[-1]]))
    kinks = [-(b[1] - a[1])/(b[0] - a[0]) for a, b in zip(lines, lines[1:])]
    print("       kinks at", " ".join(f"{kink/MICROMETRE:.4f}" for kink in kinks), "um")
    checks.below("heights in steps: kinks at the gaps", numpy.abs(kinks/numpy.array([5.0, 8.5])/MICROMETRE - 1.0).max(),
                 5.0e-2)


def bearing(folder, name, foil, kind, ranks=1, **groups):
    """A small bearing at a position."""
    groups = {"top_foil": {"thickness": 1.02e-4, "youngs_modulus": 2.14e11, "poissons_ratio": 0.29},
              "contact": {"friction_top": 0.1, "friction_sleeve": 0.1}, **groups,
              "bump_foil": {key: value for key, value in foil.items() if value is not None and key != "width"}}
    groups["mesh"] = {"arc_elements": 6, "flat_elements": 2}
    content = case_groups(BEARING, mesh=(96, 4), foil=kind, eccentricity=[25.0e-6, 5.0e-6], speed_rpm=30000.0,
                          groups=groups)
    return gfb_run.solve(folder, name, content, ranks)


def check_bearing(checks, folder):
    """Beams and shells under a film: a node above every crest, equal sizes the single ones."""
    bumps = 24
    radius = BEARING.radius
    pad = 2.0*numpy.pi*radius
    pitch = pad/bumps*(1.0 + 0.1*numpy.cos(numpy.arange(bumps)*2.0*numpy.pi/bumps))
    shape = {"bump_half_length": [1.6e-3, 1.8e-3]*12, "bump_height": [0.508e-3, 0.505e-3]*12,
             "bump_thickness": [0.9e-4, 1.1e-4]*12}
    scalar = {**FOIL, "bumps": bumps, "fixed_edge": "trailing", "fixed_line": "half_flat", "pitch": pad/bumps}
    for model in ("beam", "shell"):
        equal = {name: [scalar[key]] for name, key in SCALARS.items()}
        foil = listed(equal, bumps=bumps, fixed_edge="trailing", fixed_line="half_flat")
        one, other = bearing(folder, "scalar", scalar, model), bearing(folder, "equal", foil, model)
        checks.that(f"{model}: equal sizes, every number of the summary", one.physical() == other.physical())
        foil = listed({"bump_pitch": list(pitch), **shape}, bumps=bumps, fixed_edge="trailing", fixed_line="half_flat")
        answer = bearing(folder, "own", foil, model)
        with h5py.File(f"{answer.stem}.top_foil.vtkhdf") as file:
            station = numpy.unique(file["VTKHDF"]["Points"][:, 0].round(12))
        crest = numpy.cumsum(pitch) - 0.5*pitch
        checks.below(f"{model}: own sizes, a node above every crest",
                     max(numpy.abs(station - x).min() for x in crest)/radius, 1.0e-9)
        ranks = bearing(folder, "ranks", foil, model, ranks=2)
        checks.below(f"{model}: own sizes, two ranks",
                     gfb_run.summary_difference(answer, ranks, gfb_run.natural_sizes(BEARING))[0], 1.0e-6)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_frames(checks, folder)
        check_single(checks, folder)
        check_same(checks, folder)
        check_stepped_heights(checks, folder)
        check_bearing(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
