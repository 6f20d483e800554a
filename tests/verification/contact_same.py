#!/usr/bin/env python3
"""What must not change a strip on frictional contacts: condensation, half width, ranks, mirrors, units; and loads
that nothing balances."""

import tempfile

import numpy

from contact_strips import COARSE, SMALL, contact_lines, pressed, squeezed
from gfb_run import COST, Checks, largest_difference
from strips import FOIL, crests, fields, solve


def compare(checks, words, one, other, limit, same_nodes=True):
    """All quantities and steps of two runs; contacts node by node where the nodes are the same."""
    first, second = one.history(), other.history()
    names = set(first) - COST
    checks.that(f"{words}: same quantities", names == set(second) - COST)
    worst = max((largest_difference(first[name], second[name]), name) for name in names)
    checks.below(f"{words}: every step, worst {worst[1]}", worst[0], limit)
    worst = max((abs(one[name] - value)/abs(value), name) for name, value in other.physical().items() if value != 0.0)
    checks.below(f"{words}: summary, worst {worst[1]}", worst[0], limit)
    if not same_nodes:
        return
    for name, values in fields(other).items():
        if name in ("displacement", "contact_force", "contact_state"):
            checks.below(f"{words}: {name}", largest_difference(fields(one)[name], values), limit)
    for surface in ("sleeve", "top"):
        for name in ("normal_force", "friction_x"):
            checks.below(f"{words}: {name} at the {surface}", largest_difference(
                contact_lines(one, surface)[0][name], contact_lines(other, surface)[0][name]), limit)


def check_same(checks, folder):
    """Condensation, half width, ranks and mirrors change nothing. The last step is a loaded one."""
    foils = {edge: {"fixed_edge": edge, "fixed_line": "flat"} for edge in ("leading", "trailing")}
    moved = {"maximum_displacement": 60.0e-6}

    def crest_run(name, **groups):
        load = {"pressure": 0.4e6, "distribution": "increasing_decreasing", "steps_up": 4}
        return pressed(folder, name, top=0.1, sleeve=0.1, strip_load=load, mesh=SMALL, **groups)

    def forced_run(name, **groups):
        return squeezed(folder, name, steps=5, down=0, mesh=SMALL, **groups)

    def moved_run(name, **groups):
        return squeezed(folder, name, steps=5, down=0, mesh=SMALL, bump_foil=foils["leading"],
                        strip_load=dict(moved), **groups)

    for words, run in (("crests", crest_run), ("forced plate", forced_run), ("moved plate", moved_run)):
        base = run("base")
        full = run("full", model={"reduction": "none"})
        compare(checks, f"{words}, full and condensed", full, base, 1.0e-9)
        compare(checks, f"{words}, half and whole width", run("whole", model={"half_width": "no"}), base, 1.0e-9,
                same_nodes=False)
        compare(checks, f"{words}, 2 ranks", run("ranks", ranks=2), base, 1.0e-8)
    compare(checks, "forced plate, full, 2 ranks", forced_run("ranks", ranks=2, model={"reduction": "none"}),
            forced_run("base"), 1.0e-8)
    one, other = (squeezed(folder, edge, steps=5, bump_foil=foil, mesh=SMALL) for edge, foil in foils.items())
    checks.below("mirrored strip between plates", largest_difference(crests(one), crests(other)[::-1]), 1.0e-9)
    checks.below("mirrored strip's energy", one["dissipated_energy"]/other["dissipated_energy"] - 1.0, 1.0e-9)
    one, other = (pressed(folder, edge, top=0.1, sleeve=0.1, mesh=SMALL, bump_foil={"fixed_edge": edge})
                  for edge in ("leading", "trailing"))
    checks.below("mirrored strip under pressure", largest_difference(crests(one), crests(other)[::-1]), 1.0e-9)


def check_units(checks, folder):
    """Powers of two as units of length and force: all defaults follow the scene."""
    base = None
    for length, force in ((1.0, 1.0), (2.0**10, 1.0), (1.0, 2.0**20), (2.0**-7, 2.0**9)):
        stress = force/length**2
        foil = {name: FOIL[name]*length for name in ("thickness", "half_length", "height", "pitch", "width")}
        foil |= {"youngs_modulus": FOIL["youngs_modulus"]*stress, "bumps": 4}
        run = pressed(folder, "units", top=0.1, sleeve=0.1, bump_foil=foil, mesh=COARSE,
                      strip_load={"pressure": 0.2e6*stress, "steps_up": 4, "steps_down": 4})
        found = numpy.array([*crests(run)/length, run["dissipated_energy"]/(length*force)])
        if base is None:
            base = found
            continue
        checks.below(f"lengths x {length:g}, forces x {force:g}", numpy.abs(found/base - 1.0).max(), 1.0e-10)


def check_no_equilibrium(checks, folder):
    """What lifts off ends with a sentence, and nothing of a plausible answer."""
    lifting = [1.0e5]*4 + [-6.0e5]*2 + [1.0e5]*4
    for words, friction, load in (("upward pressure", 0.0, {"pressure": -0.2e6}),
                                  ("upward pressure, friction 0.1", 0.1, {"pressure": -0.2e6}),
                                  ("a table that lifts", 0.1, {"distribution": "table", "bump_pressure": lifting})):
        run = pressed(folder, "lifted", sleeve=friction, status=2, bump_foil={"fixed_edge": "none"}, mesh=COARSE,
                      strip_load=load)
        checks.that(f"{words} on a free strip: says so", "lifts" in run.log or "no equilibrium" in run.log)
        checks.that(f"{words} on a free strip: not converged", run["converged"] == "false")
    for words, groups in (("friction below 0", {"contact": {"friction_sleeve": -0.1}}),
                          ("stick length 0", {"contact": {"stick_length": 0.0}}),
                          ("stiffness below 0", {"contact": {"normal_stiffness": -1.0}}),
                          ("a table of two for ten bumps",
                           {"strip_load": {"distribution": "table", "bump_pressure": [1.0e5, 2.0e5]}})):
        run = solve(folder, "wrong", status=1, mesh=COARSE, **groups)
        key = list(list(groups.values())[0])[-1]
        checks.that(f"{words}: the key is named", f": {key} = " in run.complaint)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_same(checks, folder)
        check_units(checks, folder)
        check_no_equilibrium(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
