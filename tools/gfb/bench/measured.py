"""Load capacity and drag beside numbers measured by others: one strip and split strips, thin and thick top foils, preload.

Capacity of a bearing 43.7 mm in diameter and 34.9 mm long from 20,000 to 68,000 rpm, shells, and the drag of a longer one under
light loads; the foils are those of [Gu2020], because those of the measured bearings were not published (a quarter of an hour and more).
--heat: only the capacity of one of these bearings once more, with heat and growth (a quarter of an hour, too).
"""

import itertools
import math
import pathlib
import tempfile

import numpy

from gfb.running import run_file, write_case
from gfb.tables import markdown_table, plain_table

PAGE = pathlib.Path(__file__).resolve().parents[3]/"docs/measured/comparisons.md"
RADIUS, LENGTH = 21.85e-3, 34.9e-3                  # [m]
PRESSURE = 352.0e3                                  # W/(D L) measured at the last of the speeds [Pa]
MEASURED = PRESSURE*2.0*RADIUS*LENGTH               # [N]
SPEEDS = (20000.0, 36000.0, 68000.0)                # [rpm]
DRAG_SPEEDS = (20000.0, 30000.0, 40000.0)
DRAG_PRESSURES = (6.0e3, 1.6e4, 2.6e4)             # W/(D L), the least, the middle and the most of the test [Pa]
DRAG_LENGTH = 1.04*2.0*RADIUS                       # the test's L/D [m]
DRAG_MEASURED = 0.04                                # coefficient
BUMPS = 30                                          # as many as fit around
ARC, FLAT = 6, 2                                    # elements of an arc and of a flat
SHEET = {"youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "fixed_edge": "leading"}
THIN, THICK, SOFT = 0.102e-3, 0.203e-3, 0.076e-3   # [m]
SPLIT = {"strips": 3, "cut_width": 0.6e-3, "strip_thickness": (SOFT, THIN, SOFT)}
OUTER = "cuts of 0.6 mm, outer strips of 0.076 mm"
VARIANTS = {  # words: rows, width of the middle ones over those at the edges, top foil, bump foil, free radius less the bore's [m]
    "one strip, 16 rows": (16, 1.0, THIN, {"thickness": THIN}, 0.0),
    "one strip, 16 rows, finer at the edges": (16, 4.0, THIN, {"thickness": THIN}, 0.0),
    "one strip, top foil of 0.203 mm": (16, 4.0, THICK, {"thickness": THIN}, 0.0),
    "three strips, softer at the edges": (18, 1.0, THIN, SPLIT, 0.0),
    "three strips, softer at the edges, top foil of 0.203 mm": (18, 1.0, THICK, SPLIT, 0.0),
    "one strip, pressed on its bumps at rest": (16, 4.0, THIN, {"thickness": THIN}, 110.0e-6),
}
RESTS_ON = (  # what each of them assumes beyond what all do
    "bumps as stiff at the edges as in the middle", "the same; rows finer at the edges", "a top foil twice as thick", OUTER,
    f"{OUTER}; a top foil twice as thick", "a top foil made 0.11 mm wider than the bore")
DRAG_VARIANTS = tuple(list(VARIANTS)[i] for i in (0, 3, 5))
WALLS = {"shaft_conductance": 0.45, "sleeve_conductance": 1.0}  # a solid shaft of 100 mm to each side, a housing of 0.1 m2 in still air [W/K]
GROWTH = {"shaft_expansion": 1.2e-5, "sleeve_expansion": 1.2e-5, "shaft_density": 7850.0, "shaft_youngs_modulus": 2.1e11,
          "shaft_poissons_ratio": 0.3}
HEATED = {  # words: &thermal, and what a line assumes
    "one temperature": (None, "gas of 1.85e-5 Pa s"),
    "heat, nothing grows": (WALLS, "0.45 W/K from the shaft, 1 W/K from the sleeve, bumps as estimated"),
    "heat and growth": (WALLS | GROWTH, "the same; shaft and sleeve of steel, which grow by 12e-6/K, the shaft with its speed, too"),
    "heat and growth, heat leaves twice as easily": (
        {name: 2.0*value for name, value in WALLS.items()} | {"bump_conductance": 380.0} | GROWTH,
        "0.9 W/K, 2 W/K, bumps 380 W/(m2 K)"),
}
HEAT_ROWS = 8
HEAT_MARK = "<!-- heat -->\n"
HEAD = """# Measured numbers of others

Written by `tools/bench measured --docs`.

What was measured is load and speed; foils, clearances, gas and the film at which a test was stopped were not published, or not whole.
So these lines show orders and trends, and rest on what is assumed: both foils are [Gu2020]'s, 0.102 mm, {bumps} bumps of a pitch of
4.572 mm, as many as fit around; clearance 31.8 um, friction 0.1, air of 1.85e-5 Pa s at 1.0135e5 Pa, one temperature; both foils are
fixed at their leading edges, because the film draws a free leading edge up at 68,000 rpm, the strip of bumps at the first bump's foot
(`fixed_line = 'corner'`); the load acts opposite the slit. What the tests were is taken from the abstracts of their papers.
Foils are shells. The mesh has {arc} elements an arc and {flat} a flat, {around} around the bearing, and along its width 16 rows of one strip,
18 of three: all alike on the first line and of three strips, else four times narrower at the edges than in the middle
(`edge_refinement = 4`). Capacity is the load at which the smallest film is {gap:g} um, or where the branch ends before (marked *; *none*: no
equilibrium from which to look for it). Nothing was fitted.
"""
MIDDLE = """In the middle of the width the film is then {least:.1f} to {most:.1f} um: where that is the smallest film nearly, the whole width is at its
limit; where it is more, the edges are, where the pressure falls and the bumps hold the foil up. What still differs: heat (below; a thin film
is hot, and a hot gas is more viscous; shaft and foils grow), coatings that wear in, the criterion (tests end where the torque rises or
the shaft rubs, at films that nobody measured), and the foils, which are not those of the test."""
LOADS = """
## 352 kPa at 68,000 rpm [Heshmat1982]

A bearing of one pad, 43.7 mm in diameter and 34.9 mm long, bore 352 kPa: {measured:.0f} N. [N], and the film in the middle of the width
at the limit of the last speed:

{table}
*over n*: W grows as speed^n between the first and the last speed; designers take 1 [DellaCorteValco2000].

{said}
"""
DRAGS = """
## A drag coefficient of 0.04 from 20,000 to 40,000 rpm [SanAndres2012]

The test's bearing had L/D = 1.04 and bore 0.06 to 0.26 bar; its coefficient of about 0.04 is said of all of these together. Its
sizes are not known here: the diameter is that of the bearing above, the length 1.04 times as much. Friction torque over W R, on 8 rows,
three strips on 18:

{table}
gfb reaches {least:.0f} to {most:.0f} % of 0.04. The coefficient falls with the load and grows with the speed, as a film's does: by
itself it says little without its load. Cuts and a top foil that is pressed on at rest change it by {spread}. Each line rests on what
its foils rest on above. Measured bearings rub, too, at start and where rows of bumps lift; these do not, once the film is there.
"""


HEAT = """
## Once more with heat and growth

`tools/bench measured --heat --docs`: the bearing of 352 kPa above, *one strip*, on {rows} rows, at three speeds from the lowest up.
Conductances are the estimates of [heat.md](../manual/heat.md#which-conductances-do-i-need-and-where-from), which no test of this bearing gives;
ambient air and far places have 293.15 K; viscosity by Sutherland. Nothing was fitted.

{table}
*n*: W grows as speed^n from 20,000 to 36,000 rpm. The last columns are those of the last speed that has an answer: clearance when
it runs, shaft above ambient. *none*: no equilibrium under the 120 N with which the search for a limit begins.

"""


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--quick", action="store_true", help="planar beams, three variants, a coarse mesh (a minute)")
    parser.add_argument("--docs", action="store_true", help="write docs/measured/comparisons.md")
    parser.add_argument("--heat", action="store_true", help="only the lines with heat, of the page only their part")
    parser.add_argument("--gap", type=float, default=1.0e-6, metavar="M", help="smallest film at the limit; default: %(default)s m")


def run(options):
    """Computes all lines; returns the tables, and writes the page where that is asked for."""
    if options.heat:
        return run_heat(options)
    with tempfile.TemporaryDirectory() as folder:
        answers = {}
        for words, variant in list(VARIANTS.items())[:3 if options.quick else None]:
            answers[words] = capacities(options, folder, *variant)
            print(f"{words}:", *(f"{load:.0f}" for load, _, _ in answers[words]), "N", flush=True)
        loads = load_table(answers)
        drags, reached, spread = drag_table(options, folder)
    if options.docs and not options.quick:
        heat = HEAT_MARK + PAGE.read_text(encoding="utf-8").partition(HEAT_MARK)[2]
        PAGE.write_text(HEAD.format(gap=options.gap*1.0e6, bumps=BUMPS, arc=ARC, flat=FLAT, around=BUMPS*(ARC + FLAT))
                        + LOADS.format(measured=MEASURED, table=markdown_table(*loads), said=said_of(answers))
                        + DRAGS.format(table=markdown_table(*drags), least=min(reached), most=max(reached), spread=spread) + heat,
                        encoding="utf-8")
    return plain_table(*loads) + "\n" + plain_table(*drags)


def run_heat(options):
    """The lines with heat; of the page the part behind their mark, whose words below the table stay."""
    with tempfile.TemporaryDirectory() as folder:
        found = {}
        for words, (thermal, _) in HEATED.items():
            found[words] = run_file(options.gfb, write_case(folder, "capacity", heat_groups(options, thermal)), folder, seconds=1800)
            if found[words].status not in (0, 2):
                raise SystemExit(found[words].log)
            print(f"{words}:", *(f"{load:.0f}" for load in found[words].history()["load_capacity"]), "N", flush=True)
        table = heat_table({words: answer.history() for words, answer in found.items()})
    if options.docs and not options.quick:
        write_heat(table)
    return plain_table(*table)


def heat_groups(options, thermal):
    """The case of a line with heat, or of the one without."""
    groups = groups_of(options, LENGTH, HEAT_ROWS, 1.0, THIN, {"thickness": THIN}, 0.0) | {
        "scene": {"analysis": "load_capacity"}, "capacity": {"smallest_gap": options.gap},
        "operation": {"speed_rpm": SPEEDS[0], "load": (-120.0, 0.0)}, "sweep": {"parameter": "speed_rpm", "values": SPEEDS}}
    if thermal is None:
        return groups
    return groups | {"thermal": thermal, "gas": {"viscosity_law": "sutherland", "ambient_pressure": 1.0135e5}}


def heat_table(histories):
    """A line a variant."""
    heads = ["", "assumes", *(f"{speed:,.0f} rpm" for speed in SPEEDS), "n", "clearance [um]", "shaft [K]"]
    rows = []
    for words, history in histories.items():
        loads, reached = ([*history[name], math.nan, math.nan, math.nan][:3] for name in ("load_capacity", "limit_reached"))
        hot = "shaft_temperature" in history
        rows.append([words, HEATED[words][1], *(number(load, ".0f") + ("" if limit or math.isnan(load) else " *") for load, limit in zip(loads, reached)),
                     number(math.log(loads[1]/loads[0])/math.log(SPEEDS[1]/SPEEDS[0]), ".2f"),
                     f"{1.0e6*history['running_clearance'][-1]:.1f}" if hot else "31.8",
                     f"{history['shaft_temperature'][-1] - 293.15:+.0f}" if hot else ""])
    return "load capacity with heat [N]", heads, rows


def write_heat(table):
    """The part of the page with heat."""
    before, _, after = PAGE.read_text(encoding="utf-8").partition(HEAT_MARK)
    words = after.partition("<!-- words -->\n")[2]
    PAGE.write_text(before.rstrip("\n") + "\n\n" + HEAT_MARK + HEAT.format(rows=HEAT_ROWS, table=markdown_table(*table))
                    + "<!-- words -->\n" + words, encoding="utf-8")


def groups_of(options, length, rows, finer, top, bumps, larger):
    """A case's groups but for what is asked."""
    return {
        "bearing": {"radius": RADIUS, "length": length, "clearance": 31.8e-6},
        "gas": {"viscosity": 1.85e-5, "ambient_pressure": 1.0135e5},
        "top_foil": SHEET | {"thickness": top} | ({"free_radius": RADIUS + larger} if larger else {}),
        "bump_foil": SHEET | {"half_length": 1.778e-3, "height": 0.508e-3, "pitch": 4.572e-3, "bumps": BUMPS, "fixed_line": "corner"} | bumps,
        "contact": {"friction_top": 0.1, "friction_sleeve": 0.1},
        "model": {"foil": "beam" if options.quick else "shell"},
        "mesh": {"axial_elements": 4 if options.quick else rows, "arc_elements": ARC, "flat_elements": FLAT}
        | ({"edge_refinement": finer} if finer > 1.0 else {}),
        "output": {"fields": "none"},
    }


def capacities(options, folder, *variant):
    """Load, whether it is at the limit, and the film in the middle there, speed by speed; as far as the sweep gets."""
    groups = groups_of(options, LENGTH, *variant) | {
        "scene": {"analysis": "load_capacity"}, "capacity": {"smallest_gap": options.gap},
        "operation": {"speed_rpm": SPEEDS[-1], "load": (-120.0, 0.0)},
        "sweep": {"parameter": "speed_rpm", "values": SPEEDS[::-1]}}
    answer = run_file(options.gfb, write_case(folder, "capacity", groups), folder, 1, [], seconds=1800)
    if answer.status not in (0, 2):
        raise SystemExit(answer.log)
    rows = answer.history()
    found = list(zip(rows["load_capacity"], rows["limit_reached"], rows["minimum_gap_midplane"]))
    return (found + [(math.nan, 0.0, math.nan)]*len(SPEEDS))[:len(SPEEDS)][::-1]


def load_table(answers):
    """A line a variant."""
    heads = ["foils", "rests on", *(f"{speed:,.0f} rpm" for speed in SPEEDS), "over measured", "n", "middle [um]"]
    return "load capacity [N]", heads, [
        [words, assumed, *(number(load, ".0f") + ("" if reached or math.isnan(load) else " *") for load, reached, _ in found),
         number(found[-1][0]/MEASURED, ".2f"), number(exponent(found), ".2f"), number(1.0e6*found[-1][2], ".1f")]
        for (words, found), assumed in zip(answers.items(), RESTS_ON)]


def number(value, form):
    """A number of a table, or that there is none."""
    return "none" if math.isnan(value) else f"{value:{form}}"


def exponent(found):
    """n of a load that grows as speed^n."""
    return math.log(found[-1][0]/found[0][0])/math.log(SPEEDS[-1]/SPEEDS[0])


def said_of(answers):
    """What the lines say."""
    parts = [found[-1][0]/MEASURED for found in answers.values() if not math.isnan(found[-1][0])]
    powers = [exponent(found) for found in answers.values() if not math.isnan(exponent(found))]
    middle = [1.0e6*found[-1][2] for found in answers.values() if not math.isnan(found[-1][2])]
    order = sorted((words for words in answers if not math.isnan(answers[words][-1][0])), key=lambda words: answers[words][-1][0])
    return (f"These bear {min(parts):.2f} to {max(parts):.2f} of what was measured, and their capacity grows as speed^{min(powers):.2f} to "
            f"speed^{max(powers):.2f};\nleast is borne by *{order[0]}*, most by *{order[-1]}*.\n"
            f"{MIDDLE.format(least=min(middle), most=max(middle))}")


def drag_table(options, folder):
    """A line a load and a variant; all coefficients in per cent of the measured one; by how much variants differ."""
    rows, found = [], []
    for pressure, words in itertools.product(DRAG_PRESSURES, DRAG_VARIANTS[:1 if options.quick else None]):
        load = pressure*2.0*RADIUS*DRAG_LENGTH
        count, _, *foils = VARIANTS[words]
        groups = groups_of(options, DRAG_LENGTH, count if "strips" in foils[1] else 8, 1.0, *foils) | {
            "scene": {"analysis": "equilibrium"}, "operation": {"speed_rpm": DRAG_SPEEDS[0], "load": (-load, 0.0)},
            "sweep": {"parameter": "speed_rpm", "values": DRAG_SPEEDS}}
        answer = run_file(options.gfb, write_case(folder, "drag", groups), folder, 1, [], seconds=1800)
        torques = list(answer.history()["friction_torque"]) if answer.status in (0, 2) else []
        found.append([torque/(load*RADIUS) for torque in torques] + [math.nan]*(len(DRAG_SPEEDS) - len(torques)))
        rows.append([words.removesuffix(", 16 rows"), f"{pressure*1.0e-5:.2f} bar", f"{load:.1f} N", *(number(one, ".4f") for one in found[-1])])
        print(f"{words}, {pressure*1.0e-5:.2f} bar:", *rows[-1][3:], flush=True)
    shape = (len(DRAG_PRESSURES), -1, len(DRAG_SPEEDS))
    by_load = numpy.array(found).reshape(shape)
    spread = numpy.nanmax(numpy.ptp(by_load, axis=1)/by_load[:, 0])
    reached = 100.0*by_load[numpy.isfinite(by_load)]/DRAG_MEASURED
    return ("drag coefficient", ["foils", "W/(D L)", "W", *(f"{speed:,.0f} rpm" for speed in DRAG_SPEEDS)], rows), reached, f"{100.0*spread:.1g} % at most"
