#!/usr/bin/env python3
"""Every input gives the same physical numbers on any number of ranks: on 1 and on 2, every fourth on 3 in place of 2.

every_input.py [--small | --others] [--as-is] [--ranks 1,2,3] [INPUT ...]

With --ranks every input runs on all of these. The first of the ranks is what the others are compared with: all numbers of the summary and of every load step or sweep
point that are not costs, and the shapes of modes, up to their sign. Inputs that would take minutes are solved on coarser
meshes, as the output says. `strip_modes:arc` and the like are inputs with a few keys changed.
"""

import argparse
import os
import pathlib
import re
import tempfile

import h5py
import numpy
from gfb_run import Checks, namelist_value, run_file
from same_answer import difference

INPUTS = pathlib.Path(os.environ.get("GFB_SOURCE", pathlib.Path(__file__).parents[2]))/"inputs"
IN_TURN = (2, 2, 2, 3)  # ranks beside 1: three wait for each other on two cores; four are those of ranks.py --long
LIMIT = 1.0e-8
PLATE = {"bearing": {"radius": 0.01, "length": 0.02}, "mesh": {"circumferential_elements": 20, "axial_elements": 6},
         "top_foil": {"thickness": 2.0e-4, "youngs_modulus": 2.0e11, "poissons_ratio": 0.3, "density": 8000.0}}
VARIANTS = {f"strip_modes:{part}": {"modes": {"part": part, "substructure_modes": 0}} | others for part, others in (
    ("half_arc", {}), ("arc", {}), ("flat", {}), ("top_foil", PLATE))}
SMALL = ("rigid_slit", "strip_linear", "strip_modes", *VARIANTS, "gu2020_strip_case1_uniform", "gu2020_fig11a_beam",
         "gu2020_bearing")  # in seconds

STRIP = {"mesh": {"arc_elements": 6, "flat_elements": 2, "axial_elements": 12}}
SHELLS = {"mesh": {"circumferential_elements": 104, "axial_elements": 8, "arc_elements": 6, "flat_elements": 2}}
PAPER = {"mesh": {"axial_elements": 8, "arc_elements": 6, "flat_elements": 2}}  # crests inside elements
FILM = {"mesh": {"circumferential_elements": 104, "axial_elements": 16}}
TWO_TILTS = {"sweep": {"values": (0.0, 1.0e-4)}}
COARSER = (  # which inputs, what is changed
    (r"gu2020_strip_case1_.*", STRIP | {"strip_load": {"steps_up": 3}}),
    (r"gu2020_strip_case2_.*", STRIP | {"strip_load": {"steps_up": 8, "steps_down": 8}}),
    (r"strip_linear|strip_modes", STRIP),
    (r"third_generation_strip", STRIP | {"strip_load": {"steps_up": 4, "steps_down": 4}}),
    (r"third_generation_bearing", {"mesh": {"circumferential_elements": 104, "axial_elements": 6, "arc_elements": 6, "flat_elements": 2}}),
    (r"rigid_slit|rigid_ring_sweep", FILM),
    (r"foundation_.*_sweep", FILM),
    (r"rotor_onset", {"mesh": {"circumferential_elements": 60, "axial_elements": 8}, "sweep": {"values": (8000.0, 14000.0, 20000.0)}}),
    (r"thermal_runaway", {"mesh": {"circumferential_elements": 60, "axial_elements": 6}}),
    (r"thermal_spread", {"mesh": {"circumferential_elements": 60, "axial_elements": 6}, "sample": {"count": 3}}),
    (r"thermal_shell", {"mesh": {"circumferential_elements": 104, "axial_elements": 6, "arc_elements": 4, "flat_elements": 1}}),
    (r"gu2020_fig11[ab]_.*", SHELLS | TWO_TILTS),
    (r"gu2020_bearing_fig10", SHELLS | {"sweep": {"values": (200.0, 175.0)}}),
    (r"gu2020_bearing_fig10_trailing", {"mesh": {**SHELLS["mesh"], "axial_elements": 4}, "sweep": {"values": (50.0, 75.0)}}),
    (r"gu2020_bearing|gu2020_bearing_fig9", SHELLS),
    (r"gu2020_dynamics|gu2020_dynamics_beam", SHELLS | {"dynamics": {"frequency_ratios": (0.5, 1.0)}}),
    (r"gu2020_dynamics_amplitude", SHELLS | {"dynamics": {"vibration_amplitudes": (1.0e-7, 2.0e-6)}}),
    (r"gu2020_dynamics_foundation", FILM | {"dynamics": {"frequency_ratios": (0.5, 1.0)}}),
    (r"transient_(unbalance|run_up|rotor)", {"mesh": {"circumferential_elements": 48, "axial_elements": 6}, "transient": {"turns": 2, "steps_per_turn": 60,
                                               "steady_tolerance": 0.0}}),
    (r"three_pads_stability", {"mesh": {"axial_elements": 4, "arc_elements": 4, "flat_elements": 1}, "sweep": {"values": (30000.0, 20000.0)}}),
    (r"three_pads_high_speed", {"mesh": {"axial_elements": 4, "arc_elements": 4, "flat_elements": 1}, "sweep": {"values": (0.7, 0.8)}}),
    (r"periodic_limit_cycles", {"mesh": {"circumferential_elements": 24, "axial_elements": 4}, "periodic": {
        "motion": "forced", "parameter": "unbalance", "final_value": 1.2e-5, "steps_per_turn": 20, "points": 1}, "unbalance": {"unbalance": 1.0e-5}}),
    (r"transient_drop", {"mesh": {"circumferential_elements": 48, "axial_elements": 6}, "transient": {"duration": 0.004, "steps_per_turn": 200}}),
    (r"transient_push_shell", SHELLS | {"transient": {"turns": 0.1, "steps_per_turn": 100}}),
    (r"random_bumps", {"mesh": {"axial_elements": 8}, "sample": {"count": 3}}),
    (r"gu2020_position_.*", PAPER),
    (r"capacity_speed", {"mesh": {"circumferential_elements": 104, "axial_elements": 8}, "sweep": {"values": (20000.0, 40000.0)}}),
    (r"capacity_lift_off", FILM | {"sweep": {"values": (10.0, 80.0)}}),
)


def changes_of(name, as_is):
    """What is changed in an input: to make it coarser, and to make a variant."""
    made = VARIANTS.get(name, {})
    if as_is:
        return made
    coarser = next((changes for pattern, changes in COARSER if re.fullmatch(pattern, name.partition(":")[0])), {})
    return {group: coarser.get(group, {}) | made.get(group, {}) for group in coarser | made}


def changed(text, changes):
    """A case file with other values of some keys, each on a line of its own."""
    for group, keys in changes.items():
        if not re.search(rf"^&{group}\b", text, re.MULTILINE):
            text += f"\n&{group}\n/\n"
        for key, value in keys.items():
            body = re.search(rf"^&{group}\b.*?^/", text, re.MULTILINE | re.DOTALL)
            kept = re.sub(rf"^ *{key} *=.*\n", "", body.group(), flags=re.MULTILINE)
            text = text[:body.start()] + kept[:-1] + f"  {key} = {namelist_value(value)}\n/" + text[body.end():]
    return text


def shapes_of(answer):
    """Shapes of modes by name, if there are any, scaled to a largest displacement of one."""
    shapes = {}
    for path in answer.stem.parent.glob(f"{answer.stem.name}.*.vtkhdf"):
        with h5py.File(path, "r") as file:
            shapes |= {name: data[...] for name, data in file["VTKHDF/PointData"].items() if name.startswith("mode_")}
    return {name: shape/numpy.abs(shape).max() for name, shape in shapes.items()}


def shape_difference(one, other):
    """Largest difference of two shapes whose signs are free."""
    return min(numpy.abs(one - other).max(), numpy.abs(one + other).max())


def check_input(checks, folder, name, ranks, as_is):
    text = (INPUTS/f"{name.partition(':')[0]}.nml").read_text(encoding="utf-8")
    changes = changes_of(name, as_is)
    if changes:
        print(f"       {name}: " + ", ".join(f"{key} = {namelist_value(value)}" for keys in changes.values()
                                             for key, value in keys.items()))
        text = changed(text, changes)
    path = pathlib.Path(folder)/f"{name.replace(':', '_')}.nml"
    path.write_text(text, encoding="utf-8")
    one, shapes = None, {}
    for count in ranks:
        answer = run_file(path, pathlib.Path(folder)/str(count), ranks=count, options=[])
        if one is None:
            one, shapes = answer, shapes_of(answer)
            continue
        words = f"{name}, {count} ranks against {ranks[0]}"
        found = difference(one, answer, text)
        checks.below(f"{words}: summary ({found.summary[1]})", found.summary[0], LIMIT)
        checks.that(f"{words}: the same words", found.words)
        checks.that(f"{words}: the same columns of the history", found.columns)
        checks.below(f"{words}: history ({found.history[1]})", found.history[0], LIMIT)
        if shapes:
            others = shapes_of(answer)
            checks.that(f"{words}: as many modes", set(others) == set(shapes))
            largest = max((shape_difference(shapes[key], others[key]), key) for key in set(shapes) & set(others))
            checks.below(f"{words}: shapes ({largest[1]})", largest[0], LIMIT)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("inputs", metavar="INPUT", nargs="*", help="name of a file in inputs/, or of a variant; default: all")
    few = parser.add_mutually_exclusive_group()
    few.add_argument("--small", action="store_true", help="a few inputs, in seconds")
    few.add_argument("--others", action="store_true", help="all but these")
    parser.add_argument("--third", action="store_true", help="every third one alone")
    parser.add_argument("--as-is", action="store_true", help="on the meshes of the inputs; hours")
    parser.add_argument("--ranks", help="such as 1,2,3,4,7; default: 1 and 2, every fourth 1 and 3")
    options = parser.parse_args()
    ranks = options.ranks and [int(word) for word in options.ranks.split(",")]
    if ranks and len(ranks) < 2:
        parser.error("--ranks: two or more numbers")
    names = [pathlib.Path(name).stem for name in options.inputs] or [
        *sorted(path.stem for path in INPUTS.glob("*.nml")), *VARIANTS]
    if (options.small or options.others) and not options.inputs:
        names = [name for name in names if (name in SMALL) == options.small]
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        for i, name in list(enumerate(names))[::3 if options.third else 1]:
            check_input(checks, folder, name, ranks or (1, IN_TURN[i % len(IN_TURN)]), options.as_is)
    checks.close()


if __name__ == "__main__":
    main()
