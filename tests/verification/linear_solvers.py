#!/usr/bin/env python3
"""Iterations and factors in files against factors in memory; what iterations, memory and machine cannot do is said;
estimates of memory against peaks."""

import pathlib
import re
import subprocess
import tempfile

import shell_bearing
from contact_strips import COARSE, SMALL, pressed, squeezed
from gfb_run import GFB, SECONDS, Bearing, Checks, largest_difference, run, summary_difference
from gfb_run import solve as gfb_solve
from pads import of_pads
from sensitivity import foils, with_keys
from small_motions import case as vibrating
from strips import fields, solve
from thrust_shell import shells

FACTOR = 1.5  # between estimate and peak, as the log states it
HELD = {"support": "held", "pressure": 0.2e6, "steps_up": 1}
FULL = {"reduction": "none"}
HOT = {"ambient_temperature": 293.15, "sleeve_conductance": 2.0}
LEFT = "the linear iterations did not converge: factors from here on"
WRITTEN = ("--check",)  # a case that is not solved yet
UNIT = {"MB": 1.0e6, "GB": 1.0e9}


def check_same(checks, folder):
    """The three solvers have one answer: symmetric, unilateral, with friction, with a plate's full row, on two ranks."""

    def held(name, **groups):
        return solve(folder, name, strip_load=dict(HELD), mesh=SMALL, model=dict(FULL), **groups)

    def resting(name, **groups):
        return pressed(folder, name, mesh=SMALL, model=dict(FULL), strip_load={"pressure": 0.2e6, "steps_up": 2}, **groups)

    def rubbing(name, **groups):
        return pressed(folder, name, top=0.1, sleeve=0.1, mesh=COARSE, model=dict(FULL),
                       strip_load={"pressure": 0.2e6, "steps_up": 2}, **groups)

    def forced(name, **groups):
        return squeezed(folder, name, steps=2, down=0, mesh=SMALL, model=dict(FULL), **groups)

    for words, make in (("held", held), ("resting on the sleeve", resting), ("with friction", rubbing),
                        ("forced plate", forced)):
        base = make("direct")
        for solver in ("iterative", "out_of_core"):
            other = make(solver, solver={"linear_solver": solver})
            checks.below(f"{words}, {solver}: summary", summary_difference(other, base)[0], 1.0e-9)
            checks.below(f"{words}, {solver}: displacement",
                         largest_difference(fields(other)["displacement"], fields(base)["displacement"]), 1.0e-9)
    two = held("ranks", solver={"linear_solver": "iterative"}, ranks=2)
    checks.below("held, iterative, 2 ranks: summary", summary_difference(two, held("direct"))[0], 1.0e-9)


def check_bearings(checks, folder):
    """Film, foils and shaft by iterations and by factors, two ranks; factors go on where iterations do not."""

    def bearing(name, linear_solver, ranks=1, options=("--verbose",)):
        mesh = {"circumferential_elements": 104, "axial_elements": 24, "arc_elements": 8, "flat_elements": 2}
        return shell_bearing.solve(folder, name, ranks, options=options, mesh=mesh, model=dict(FULL),
                                   solver={"linear_solver": linear_solver})

    base = bearing("base", "direct")
    for ranks in (1, 2):
        other = bearing("other", "iterative", ranks=ranks)
        where = f"bearing, {ranks} rank(s)"
        values, others = base.physical(), other.physical()
        checks.that(f"{where}: what factors alone tell is left out", set(values) - set(others) == {"determinant_sign", "edge_stiffness"})
        checks.below(f"{where}: iterations against factors",
                     max(abs(others[name] - values[name])/shell_bearing.SIZES.get(name, abs(values[name])) for name in others
                         if values[name] != others[name]), 1.0e-8)
        checks.that(f"{where}: iterations sufficed", "factors from here on" not in other.log)
    bearing("left", "iterative", options=WRITTEN)
    status, log = run_with(pathlib.Path(folder)/"left.nml", folder, "-bearing_ksp_max_it", "2")
    checks.that("bearing: factors go on, which is said once", status == 0 and log.count(LEFT) == 1)


def check_small(checks, folder):
    """Small bearings of shells of every kind by iterations, from the first step on, and by factors."""
    full, at = {"model": {"foil": "shell", "reduction": "none"}}, (0.5*shell_bearing.BEARING.clearance, 0.0)
    ring = {"model": dict(FULL), "mesh": {"circumferential_elements": 52, "axial_elements": 4, "arc_elements": 4, "flat_elements": 2}}
    kinds = {
        "journal": lambda name, solver: shell_bearing.solve(folder, name, **shell_bearing.held(at), **ring, **solver),
        "tilted journal": lambda name, solver: shell_bearing.solve(
            folder, name, **shell_bearing.held(at, tilt=(1.0e-4, 0.0)), **ring, **solver),
        "three pads": lambda name, solver: gfb_solve(folder, name, of_pads("shell", {"count": 3}, **full, **solver)),
        "hot thrust": lambda name, solver: gfb_solve(folder, name, shells(
            {"axial_load": 100.0}, model={"reduction": "none"}, thermal=HOT | {"shaft_conductance": 0.5}, **solver))}
    for kind, make in kinds.items():
        base, other = (make(f"small_{name}", {"solver": {"linear_solver": name}}) for name in ("direct", "iterative"))
        compare(checks, f"small bearing, {kind}", base, other, shell_bearing.SIZES if kind != "hot thrust" else {})


def check_hot(checks, folder):
    """A journal with heat, which gas carries along the film, by iterations over the whole width on two ranks."""
    full = {"reduction": "none"}
    fin = HOT | {"shaft": "fin", "shaft_end_conductance": (0.1, 0.1), "shaft_expansion": 1.2e-5, "bump_conductance": 190.0,
                 "modulus_slope": -3.0e-4}
    hot = with_keys(foils("shell", 0.1), gas={"viscosity": None, "viscosity_law": "sutherland"}, thermal=fin, model=full,
                    scene={"analysis": "fixed_position"}, operation={"load": None, "eccentricity": (8.0e-6, 2.0e-6)},
                    mesh={"circumferential_elements": 26, "axial_elements": 2, "flat_elements": 1})
    base = gfb_solve(folder, "hot", hot)
    other = gfb_solve(folder, "hot_iterative", with_keys(hot, solver={"linear_solver": "iterative"}, model={"half_width": "no"}), 2)
    checks.that("hot journal: warmer than the gas around", other["film_temperature"] > 293.15 + 2.0)
    compare(checks, "hot journal, whole width, 2 ranks", base, other, shell_bearing.SIZES)


def check_vibrations(checks, folder):
    """Stiffness, damping, critical mass and a rotor's growth, foils with their mass, by iterations and by factors."""
    groups = vibrating("shell", "linear_dynamics", {"eccentricity": (1.1e-5, 5.0e-6)},
                       dynamics={"frequency_ratios": 1.5, "foil_mass": "auto"}, rotor={"mass": 0.0844})
    groups = with_keys(groups, bearing={"radius": 3.0e-3, "length": 6.0e-3}, bump_foil={"bumps": 4}, model={"reduction": "none"},
                       mesh={"circumferential_elements": 16, "axial_elements": 2, "flat_elements": 1})
    base = gfb_solve(folder, "vibrating", groups)
    iterated = with_keys(groups, solver={"linear_solver": "iterative"})
    whole = with_keys(iterated, model={"half_width": "no"})
    del whole["rotor"]
    half = gfb_solve(folder, "iterated", iterated)
    checks.that("vibrations: modes that are not counted are called so", "modes are not counted" in half.log)
    for words, other in (("half the width, a rotor", half), ("whole width, 2 ranks", gfb_solve(folder, "whole", whole, 2))):
        for name in base.physical():
            if name.startswith(("stiffness_", "damping_x", "damping_y")):
                size = abs(base[f"{name[:-2]}xx"])
            elif name in ("critical_mass", "whirl_ratio", "growth_rate", "whirl_frequency") and name in other.physical():
                size = abs(base[name])
            else:
                continue
            checks.below(f"vibrations, {words}: {name}", (other[name] - base[name])/size, 1.0e-8)


def check_derivatives(checks, folder):
    """Derivatives of an answer's numbers by keys, by iterations of the transposed equations and by its factors."""
    names = ("minimum_gap", "friction_torque", "maximum_pressure", "maximum_top_foil_stress")
    groups = with_keys(foils("shell", 0.1), model={"reduction": "none"},
                       mesh={"circumferential_elements": 26, "axial_elements": 2, "flat_elements": 1},
                       sensitivity={"quantity": names, "parameters": ("gas%viscosity", "bump_foil%thickness")})
    base = gfb_solve(folder, "derived", groups)
    iterated = with_keys(groups, solver={"linear_solver": "iterative"})
    for words, other in (("half the width", gfb_solve(folder, "iterated", iterated)),
                         ("whole width, 2 ranks", gfb_solve(folder, "whole", with_keys(iterated, model={"half_width": "no"}), 2))):
        slopes = [name for name in base.physical() if name.startswith("d_")]
        checks.that(f"derivatives, {words}: all are there", len(slopes) == 2*len(names) and set(slopes) <= set(other.physical()))
        for name in slopes:
            checks.below(f"derivatives, {words}: {name}", other[name]/base[name] - 1.0, 1.0e-8)


def compare(checks, words, base, other, given):
    """Numbers of an answer by iterations, which sufficed, and by factors."""
    values, others = base.physical(), other.physical()
    sizes = {name: abs(values[name]) for name in others} | given | \
        {name: shell_bearing.BEARING.force_unit for name in others if name.startswith("force_")} | {"energy_imbalance": 1.0}
    checks.below(f"{words}: iterations against factors",
                 max((abs(others[name] - values[name])/sizes[name] for name in others if values[name] != others[name]), default=0.0), 1.0e-8)
    checks.that(f"{words}: iterations sufficed", LEFT not in other.log and "GMRES on two levels" in other.log)


def run_with(path, folder, *petsc):
    """Status and log of a case with options of PETSc's."""
    done = subprocess.run([GFB, "--output", str(folder), str(path), "--petsc", *petsc],
                          capture_output=True, text=True, timeout=SECONDS, check=False)
    return done.returncode, done.stdout


def iterations(path, folder):
    """Iterations of each linear solve of a case."""
    _, log = run_with(path, folder, "-strip_ksp_converged_reason")
    return [int(number) for number in re.findall(r"iterations ([0-9]+)", log)]


def check_growth(checks, folder):
    """Twice as fine a mesh does not need more iterations."""
    counts = []
    for name, arc, flat, axial in (("coarse", 8, 2, 48), ("fine", 16, 4, 96)):
        solve(folder, name, strip_load=dict(HELD), model=dict(FULL), solver={"linear_solver": "iterative"},
              mesh={"arc_elements": arc, "flat_elements": flat, "axial_elements": axial}, options=WRITTEN)
        counts.append(iterations(pathlib.Path(folder)/f"{name}.nml", folder))
    checks.that(f"iterations {counts[0]}, on half the element size {counts[1]}",
                counts[0] and counts[1] and max(counts[1]) <= 1.2*max(counts[0]))


def check_failures(checks, folder):
    """Iterations that do not converge go on with factors; factors that do not fit are a sentence and no answer."""
    for solver, words, petsc, ends in (
            ("iterative", LEFT, ("-strip_ksp_max_it", "2"), 0),
            ("direct", "MUMPS ran out of memory", ("-strip_mat_mumps_icntl_23", "1"), 2)):
        solve(folder, f"failing_{solver}", strip_load=dict(HELD), mesh=SMALL, model=dict(FULL), solver={"linear_solver": solver},
              options=WRITTEN)
        status, log = run_with(pathlib.Path(folder)/f"failing_{solver}.nml", folder, *petsc)
        checks.that(f"{solver}: status {ends} and '{words}'", status == ends and log.count(words) == 1)
        checks.that(f"{solver}: an answer is written where there is one", (pathlib.Path(folder)/f"failing_{solver}.summary").exists() == (ends == 0))


def estimate(path, status=0):
    """What `--check` says of a case's memory [B], and its exit status."""
    done = subprocess.run([GFB, "--check", str(path)], capture_output=True, text=True, timeout=SECONDS, check=False)
    if done.returncode != status:
        raise RuntimeError(f"--check of {path} ended with status {done.returncode}, not {status}")
    found = re.search(r"memory: about ([0-9.e+]+) (MB|GB) in all", done.stdout)
    return float(found[1])*UNIT[found[2]]


def check_estimates(checks, folder):
    """Estimates and peaks of strips and bearings differ by no more than the stated factor."""
    middle = {"arc_elements": 16, "flat_elements": 4, "axial_elements": 64}
    answers = {}
    for solver in ("direct", "out_of_core", "iterative"):
        answers[f"strip, small, {solver}"] = solve(folder, f"small_{solver}", mesh=SMALL, model=dict(FULL),
                                                   strip_load=dict(HELD), solver={"linear_solver": solver})
        answers[f"strip, {solver}"] = solve(folder, f"strip_{solver}", mesh=middle, model=dict(FULL),
                                            strip_load=dict(HELD), solver={"linear_solver": solver})
    answers["strip, condensed"] = solve(folder, "condensed", mesh=middle, strip_load=dict(HELD))
    answers["strip, full, friction"] = pressed(folder, "friction", top=0.1, sleeve=0.1, mesh=middle, model=dict(FULL),
                                               strip_load={"pressure": 0.2e6, "steps_up": 1})
    answers["rigid bearing"] = run(folder, "rigid", Bearing(), mesh=(600, 100), eccentricity=(0.5e-5, 0.2e-5),
                                   number=1.0)
    for words, answer in answers.items():
        ratio = estimate(answer.stem.with_suffix(".nml"))/answer["peak_memory"]
        checks.within(f"estimate over peak, {words}, {answer['peak_memory']/1.0e6:.0f} MB", ratio, 1.0/FACTOR, FACTOR)


def check_machine(checks, folder):
    """A scene that no machine holds is refused before it is begun; `--check` prints what it needs."""
    keys = {"arc_elements": 1000, "flat_elements": 200, "axial_elements": 4000}
    answer = solve(folder, "huge", status=1, mesh=keys, model=dict(FULL), strip_load=dict(HELD))
    checks.that("a strip of 240 million unknowns: a sentence with its memory and what helps",
                re.search(r"needs about [0-9.]+(e[0-9]+)? GB of memory .* linear_solver = 'iterative'", answer.complaint))
    path = pathlib.Path(folder)/"huge.nml"
    checks.that("--check refuses it, too: more than 200 GB", estimate(path, status=1) > 2.0e11)
    checks.that("nothing is written", [file.name for file in pathlib.Path(folder).glob("huge.*")] == ["huge.nml"])


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_same(checks, folder)
        check_bearings(checks, folder)
        check_small(checks, folder)
        check_hot(checks, folder)
        check_vibrations(checks, folder)
        check_derivatives(checks, folder)
        check_growth(checks, folder)
        check_failures(checks, folder)
        check_estimates(checks, folder)
        check_machine(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
