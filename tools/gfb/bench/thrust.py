"""Thrust bearings: error against time on several meshes, rigid, on springs, plates and shells, and what more pads and a tilt cost.

The bearing of inputs/thrust_foundation.nml: a rigid one whose gap is held, one on local springs, one on springs under the mean along
the radius, one on plates and one on shells, under 200 N. Errors are those of axial force, or axial gap, and of the axial stiffness against a mesh of
twice the elements each way of the finest. CPU times are those of whole runs less the start of MPI, medians of the rounds.
"""

import statistics
import sys
import tempfile

from gfb.bench.options import add_first, add_repetitions
from gfb.build import version_of
from gfb.running import run_file, start_time, write_case
from gfb.tables import markdown_table, plain_table
from gfb.tool import MEASURED, stop

MESHES = ((32, 16, 1), (64, 32, 1), (128, 64, 1), (16, 8, 2), (32, 16, 2), (64, 32, 2))  # elements along the motion, the radius; order
FINEST = (128, 64, 2)
SCENES = {"rigid, held": ({"foil": "rigid"}, {"axial_gap": 1.0e-5}, "axial_force"),
          "local springs, 200 N": ({"foundation_pressure": "local"}, {"axial_load": 200.0}, "axial_gap"),
          "radial mean, 200 N": ({"foundation_pressure": "radial_mean"}, {"axial_load": 200.0}, "axial_gap"),
          "plates, 200 N": ({"foil": "plate", "crest_stiffness": 4.0e7}, {"axial_load": 200.0}, "axial_gap"),
          "shells, 200 N": ({"foil": "shell"}, {"axial_load": 200.0}, "axial_gap")}
STEEL = {"youngs_modulus": 2.14e11, "poissons_ratio": 0.29}
TOP = {"top_foil": {"thickness": 1.5e-4} | STEEL}
PLATE = TOP | {"bump_foil": {"crest_angles": tuple(0.7853981633974483*(number - 0.5)/8.0 for number in range(1, 9))}}
STRIP = TOP | {"bump_foil": {"bumps": 6, "half_length": 1.0e-3, "height": 4.0e-4, "thickness": 1.0e-4} | STEEL,
               "contact": {"friction_top": 0.1, "friction_sleeve": 0.1}}
HELD, LOADED, FINE = 7, 16, 5  # aims: factorizations of a held gap, of a load on springs, on the finest mesh
SAME = 1.1  # aim: all aligned pads over one
HEAD = """# Thrust bearings: error against time

```
tools/bench thrust --docs --repetitions {repetitions}
```

The bearing of [inputs/thrust_foundation.nml](../../inputs/thrust_foundation.nml) on several meshes of a pad, order 1 and 2 of the film's
elements, on one rank. Errors are relative, against {finest[0]} x {finest[1]} biquadratic elements; *K* is the axial stiffness at a quarter
of the speed. *Factors* are all factorizations of equilibria, *finest* those of the scene's own mesh with that of the vibration. CPU
times are those of whole runs less the start of MPI, medians of the rounds. Order 1 is Galerkin's.

{table}
What pads cost, on 32 x 16 biquadratic elements, 200 N on local springs: an aligned runner solves one pad for all, a tilted one each.

{pads}
A pad of shells at a held gap, 6 bumps, 32 x 16 biquadratic elements, and a journal's of as many nodes:

{beside}
{missed}
{program}.

"""


def add_options(parser):
    """The command's own options."""
    add_repetitions(parser, "rounds of all meshes", 3)
    add_first(parser, "meshes", MESHES)
    parser.add_argument("--docs", action="store_true", help="write docs/measured/bench_thrust.md")


def run(options):
    """Measures; returns the tables and leaves them in Markdown."""
    with tempfile.TemporaryDirectory() as folder:
        start = start_time(options.gfb)
        rows, counts = [], {}
        for scene in SCENES:
            print(f"{scene} ...", file=sys.stderr, flush=True)
            there = solve(options.gfb, folder, scene, FINEST)
            for mesh in MESHES[:options.meshes]:
                rounds = [solve(options.gfb, folder, scene, mesh) for _ in range(options.repetitions)]
                counts[scene, mesh] = rounds[0]
                rows.append(row_of(scene, mesh, rounds, there, start))
        pads = [(words, [solve(options.gfb, folder, "local springs, 200 N", (32, 16, 2), **more) for _ in range(options.repetitions)])
                for words, more in (("1 pad", {"count": 1}), ("6 pads, aligned", {}), ("6 pads, tilted", {"tilt": (3.0e-5, 0.0)}))]
        shells = [(words, [solve_pad(options.gfb, folder, thrust) for _ in range(options.repetitions)])
                  for words, thrust in (("sector", True), ("journal", False))]
    table = ("CPU times beyond the start of MPI", ["bearing", "elements", "order", "unknowns", "CPU [s]", "force or gap", "K", "factors",
                                                 "finest"], rows)
    tables = [table_of_pads(pads, start), table_of_pads(shells, start)]
    missed = "".join(f"- {words}\n" for words in missed_aims(counts, pads, shells, start))
    (options.output/"thrust.md").write_text(markdown_table(*table) + "".join(markdown_table(*one) for one in tables) + missed,
                                            encoding="utf-8")
    if options.docs:
        head = HEAD.format(repetitions=options.repetitions, finest=FINEST, table=markdown_table(*table),
                           pads=markdown_table(*tables[0]), beside=markdown_table(*tables[1]),
                           program=version_of(options.gfb), missed=f"Missed:\n\n{missed}" if missed else "All aims are met.\n")
        (MEASURED/"bench_thrust.md").write_text(head.rstrip() + "\n", encoding="utf-8")
    return plain_table(*table) + "".join(plain_table(*one) for one in tables) + missed


def solve(gfb, folder, scene, mesh, count=6, tilt=None):
    """The answer of a scene on a mesh."""
    model, operation, _ = SCENES[scene]
    if "foil" not in model:
        model = model | {"foil": "elastic_foundation", "foundation_stiffness": 1.0e10}
    load = {"axial_load": 200.0*count/6.0} if "axial_load" in operation else operation
    groups = {"scene": {"analysis": "linear_dynamics"}, "bearing": {"kind": "thrust", "outer_radius": 0.05, "inner_radius": 0.025},
              "pads": {"count": count, "arc": 0.7853981633974483}, "ramp": {"part": 0.5, "height": 2.0e-5},
              "gas": {"viscosity": 1.85e-5, "ambient_pressure": 101325.0},
              "operation": {"speed_rpm": 40000.0} | load | ({"tilt": tilt} if tilt else {}), "dynamics": {"frequency_ratios": 0.25},
              "model": model | {"film_order": mesh[2]} | ({"film_scheme": "galerkin"} if mesh[2] == 1 else {}),
              "mesh": {"circumferential_elements": mesh[0], "radial_elements": mesh[1]}} | {"plate": PLATE, "shell": STRIP}.get(model["foil"], {})
    return answer_of(gfb, folder, scene, groups)


def solve_pad(gfb, folder, thrust):
    """The answer of one pad of shells at a held gap: of a sector, or of a journal as long as its middle."""
    if thrust:
        held = {"bearing": {"kind": "thrust", "outer_radius": 0.05, "inner_radius": 0.025}, "ramp": {"part": 0.2, "height": 2.0e-5},
                "operation": {"speed_rpm": 40000.0, "axial_gap": 1.2e-5}, "mesh": {"radial_elements": 16}}
    else:
        held = {"bearing": {"radius": 0.0375, "length": 0.025, "clearance": 3.0e-5}, "mesh": {"axial_elements": 16},
                "operation": {"speed_rpm": 40000.0, "eccentricity": (-1.0e-5, -1.0e-5)}}
    groups = {"scene": {"analysis": "fixed_position"}, "pads": {"count": 1, "arc": 0.7853981633974483},
              "gas": {"viscosity": 1.85e-5, "ambient_pressure": 101325.0}, "model": {"foil": "shell", "film_order": 2}} | STRIP | held
    groups["model"] |= {} if thrust else {"half_width": "no"}
    groups["mesh"] |= {"circumferential_elements": 32}
    return answer_of(gfb, folder, "a pad of shells", groups)


def answer_of(gfb, folder, scene, groups):
    """The answer of a case, which has one."""
    answer = run_file(gfb, write_case(folder, "thrust", groups), folder)
    if answer.status != 0:
        stop(f"{scene}: gfb ended with status {answer.status}:\n{answer.log}{answer.complaint}", 3)
    return answer


def row_of(scene, mesh, rounds, there, start):
    """A row of the table."""
    answer, name = rounds[0], SCENES[scene][2]
    errors = [abs(answer[quantity]/there[quantity] - 1.0) for quantity in (name, "stiffness_zz")]
    return [scene, f"{mesh[0]} x {mesh[1]}", str(mesh[2]), f"{answer['unknowns']:,.0f}", f"{time_of(rounds, start):.2f}",
            *(f"{error:.1e}" for error in errors), f"{answer['factorizations']:.0f}", f"{answer['factorizations_finest']:.0f}"]


def time_of(rounds, start):
    """CPU time of the median round."""
    return statistics.median(one.cpu - start for one in rounds)


def table_of_pads(pads, start):
    """Title, heads and rows."""
    rows = [[words, f"{rounds[0]['unknowns']:,.0f}", f"{time_of(rounds, start):.2f}", f"{rounds[0]['factorizations']:.0f}",
             f"{rounds[0]['newton_iterations']:.0f}"] for words, rounds in pads]
    return "Pads", ["pads", "unknowns", "CPU [s]", "factors", "iterations"], rows


def missed_aims(counts, pads, shells, start):
    """A sentence for every aim that is missed, on the default mesh."""
    for (scene, mesh), answer in counts.items():
        if SCENES[scene][0].get("foil") == "shell":  # the aims are those of films on springs
            continue
        aim = HELD if "axial_gap" in SCENES[scene][1] else LOADED
        found = answer["factorizations"] - 1.0  # without that of the vibration
        if mesh == (32, 16, 2) and found > aim:
            yield f"{scene}: {found:.0f} factorizations, coarse mesh and all; the aim is {aim}"
        if mesh == (32, 16, 2) and answer["factorizations_finest"] - 1.0 > FINE:
            yield f"{scene}: {answer['factorizations_finest'] - 1.0:.0f} factorizations of the finest mesh; the aim is {FINE}"
    one, every = (time_of(rounds, start) for _, rounds in pads[:2])
    if every > SAME*one:
        yield f"6 aligned pads: {every/one:.2f} times one; the aim is {SAME:g}"
    sector, journal = (time_of(rounds, start)/rounds[0]["newton_iterations"] for _, rounds in shells)
    if sector > SAME*journal:
        yield f"an iteration of a sector's shells: {sector/journal:.2f} times that of a journal's; the aim is {SAME:g}"
