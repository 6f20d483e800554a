"""What a force at rest does to a bearing: top foils of another free radius, shafts larger than the bore in the foil.

The bearing of [Gu2020] (beams, 105 x 8 elements with crests on nodes, both trailing edges fixed, friction 0.1) at 30,000 rpm
under light and usual loads, some points on shells, and a small bearing at 80,000 rpm under loads that draw its free edge up
(about five minutes, most of it for the tables of equilibria).
"""

import math
import tempfile

from gfb.results import read_film
from gfb.running import run_file, write_case

MICRO = 1.0e6
SHEET = {"youngs_modulus": 214.0e9, "poissons_ratio": 0.29}
GU = {
    "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6},
    "operation": {"speed_rpm": 30000.0},
    "top_foil": {**SHEET, "thickness": 0.102e-3, "fixed_edge": "trailing"},
    "bump_foil": {**SHEET, "thickness": 0.102e-3, "half_length": 1.778e-3, "height": 0.508e-3, "pitch": 4.572e-3, "bumps": 26,
                  "fixed_edge": "trailing", "fixed_line": "half_flat"},
    "mesh": {"circumferential_elements": 104, "axial_elements": 8, "arc_elements": 8, "flat_elements": 2},
}
ENGINEER = {
    "bearing": {"radius": 15.0e-3, "length": 30.0e-3, "clearance": 25.0e-6},
    "operation": {"speed_rpm": 80000.0},
    "top_foil": {**SHEET, "thickness": 0.1e-3, "fixed_edge": "trailing"},
    "bump_foil": {**SHEET, "thickness": 0.1e-3, "half_length": 1.4e-3, "height": 0.45e-3, "bumps": 26, "fixed_edge": "trailing"},
    "mesh": {"circumferential_elements": 156, "axial_elements": 8, "arc_elements": 8, "flat_elements": 2},
}
LIGHT = ((-8.4, 0.0), (-20.0, 0.0), (-100.0, 0.0))
DRAWN = ((-20.0, 0.0), (0.0, -20.0), (0.0, -100.0))
LARGER = (0.0, 40.0e-6, 110.0e-6, 220.0e-6)           # free radius less the bore's [m]
INTERFERENCE = (0.0, 5.0e-6, 10.0e-6, 15.0e-6, 20.0e-6, 25.0e-6, 30.0e-6)
PRELOADED = 110.0e-6
HEAD = ("free radius + [um]", "e/C", "film [um]", "free edge [um]", "crests open [%]", "edge stiffness [kN/m]", "growing modes",
        "torque [N mm]", "factorizations")


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--quick", action="store_true", help="without the tables of equilibria (a minute)")


def run(options):
    """Computes all points; returns the tables and leaves them in Markdown and the picture."""
    tables, points = [], {}
    with tempfile.TemporaryDirectory() as folder:
        for words, case, loads, foil in (("[Gu2020], beams", GU, LIGHT, "beam"), ("[Gu2020], shells", GU, LIGHT[:2], "shell"),
                                         ("15 mm, 80,000 rpm, beams", ENGINEER, DRAWN, "beam")):
            for load in loads:
                larger = LARGER if foil == "beam" else (0.0, PRELOADED)
                rows = [point(options.gfb, folder, case, load, foil, one, 0.0) for one in larger]
                tables.append((f"{words}, {load[0]:g}, {load[1]:g} N",
                               [HEAD, *(cells(one, answer, case) for one, answer in zip(larger, rows))]))
        for load in (LIGHT[0], LIGHT[2]):
            points[load] = [point(options.gfb, folder, GU, load, "beam", PRELOADED, one) for one in INTERFERENCE]
            tables.append((f"[Gu2020], beams, {load[0]:g} N, free radius + 110 um, over the interference",
                           [("interference [um]", *HEAD[1:]),
                            *(cells(one, answer, GU) for one, answer in zip(INTERFERENCE, points[load]))]))
        rough = {"shaft_contact": {"roughness": 0.3e-6, "pressure": 1.0e9, "friction": 0.1}}
        beyond = (31.0e-6, 33.0e-6, 36.0e-6)
        rows = [point(options.gfb, folder, GU | rough, LIGHT[1], "beam", PRELOADED, one) for one in beyond]
        tables.append(("[Gu2020], beams, -20 N, beyond the clearance of 31.8 um, with asperities of 0.3 um",
                       [("interference [um]", *HEAD[1:]), *(cells(one, answer, GU) for one, answer in zip(beyond, rows))]))
        if not options.quick:
            tables.append(("equilibria that gfb --branches finds, [Gu2020], beams, 105 x 4",
                           equilibria(options.gfb, folder)))
        shapes = {one: at_rest(options.gfb, folder, one) for one in (PRELOADED, 2*PRELOADED, 3*PRELOADED)}
    draw(shapes, points, options.output/"assembly.png")
    (options.output/"assembly.md").write_text("\n".join(f"{words}\n\n{markdown(table)}" for words, table in tables),
                                              encoding="utf-8")
    return "".join(f"\n{words}\n" + "\n".join("  ".join(row) for row in table) + "\n" for words, table in tables)


# --- points ---

def groups_of(case, foil, larger, interference, **operation):
    """A case's groups."""
    groups = {name: dict(keys) for name, keys in case.items()}
    groups["scene"] = {"analysis": "equilibrium" if "load" in operation else "fixed_position"}
    groups["gas"] = {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5}
    groups["operation"] |= operation
    groups["contact"] = {"friction_top": 0.1, "friction_sleeve": 0.1}
    groups["model"] = {"foil": foil}
    if larger > 0.0:
        groups["top_foil"]["free_radius"] = case["bearing"]["radius"] + larger
    if interference > 0.0:
        groups["bearing"]["assembly_interference"] = interference
    return groups


def point(gfb, folder, case, load, foil, larger, interference):
    """An answer, or why there is none."""
    groups = groups_of(case, foil, larger, interference, load=load)
    groups["solver"] = {"stability": True}
    return run_file(gfb, write_case(folder, "point", groups), folder, 1, [], seconds=600)


def cells(key, answer, case):
    """A row of a table."""
    first = f"{MICRO*key:.0f}"
    if answer.status != 0:
        why = [line for line in answer.log.splitlines() if line.startswith("no equilibrium found: ")]
        return (first, (why or ["none: none"])[0].split(": ", 1)[1].split(":")[0].split(", as the mesh")[0])
    clearance = case["bearing"]["clearance"]
    return (first, f"({answer['eccentricity_x']/clearance:.3f}, {answer['eccentricity_y']/clearance:.3f})",
            f"{MICRO*answer['minimum_gap']:.2f}", f"{MICRO*answer['leading_edge_lift']:.2f}",
            f"{100.0*answer['lifted_length']:.0f}", f"{1.0e-3*answer['edge_stiffness']:.1f}", f"{answer['growing_modes']:.0f}",
            f"{1.0e3*answer['friction_torque']:.2f}", f"{answer['factorizations']:.0f}")


def equilibria(gfb, folder):
    """All equilibria that are found with and without a force at rest."""
    rows = [("load [N]", "free radius + [um]", "e/C", "free edge [um]", "film [um]", "growing modes", "next to change [p_a/C]")]
    for load in LIGHT[1:]:
        for larger in (0.0, PRELOADED):
            groups = groups_of(GU, "beam", larger, 0.0, load=load)
            groups["mesh"] |= {"axial_elements": 4}
            done = run_file(gfb, write_case(folder, "all", groups), folder, 1, ["--branches"], seconds=600)
            lines = done.log.split("to change\n")[-1].splitlines()
            for line in lines:
                words = line.split()
                if not words or not words[0].isdigit():
                    break
                rows.append((f"{-load[0]:g}", f"{MICRO*larger:.0f}", f"({words[1]}, {words[2]})", words[3], words[8], words[9],
                             " ".join(words[10:])))
    return rows


def at_rest(gfb, folder, larger):
    """Rise of the foil over its bumps without film and shaft: angle [rad], rise [um]."""
    groups = groups_of(GU, "beam", larger, 0.0, speed_rpm=0.0, eccentricity=(0.0, 0.0))
    groups["bearing"]["clearance"] = 1.0e-4
    answer = run_file(gfb, write_case(folder, "rest", groups), folder, 1, [], seconds=600)
    film = read_film(f"{answer.stem}.film.vtkhdf")
    return film["theta"][:, 0], -MICRO*film["deflection"][:, 0]


# --- tables and picture ---

def markdown(table):
    """A table; a row that is too short has one cell more."""
    width = len(table[0])
    lines = ["| " + " | ".join((*row, *[""]*(width - len(row)))) + " |" for row in table]
    return "\n".join([lines[0], "|" + " --- |"*width, *lines[1:]]) + "\n"


def draw(shapes, points, path):
    """The foil at rest, and what interference does to film and torque."""
    from matplotlib import pyplot  # noqa: PLC0415

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10.0, 3.6), layout="constrained")
    for larger, (angle, rise) in shapes.items():
        left.plot(angle*180.0/math.pi, rise, label=f"free radius + {MICRO*larger:.0f} um")
    left.set(xlabel="angle behind the free edge [degrees]", ylabel="rise over the bumps at rest [um]", xlim=(0.0, 180.0))
    left.axhline(0.0, color="grey", linewidth=0.6)
    left.legend()
    other = right.twinx()
    for (load, answers), mark in zip(points.items(), "os"):
        found = [(one, answer) for one, answer in zip(INTERFERENCE, answers) if answer.status == 0]
        place = [MICRO*one for one, _ in found]
        right.plot(place, [MICRO*answer["minimum_gap"] for _, answer in found], f"C0-{mark}", label=f"film, {-load[0]:g} N")
        other.plot(place, [1.0e3*answer["friction_torque"] for _, answer in found], f"C1--{mark}",
                   label=f"torque, {-load[0]:g} N")
    right.set(xlabel="interference of assembly [um]", ylabel="smallest film [um]", ylim=(0.0, 36.0))
    other.set(ylabel="torque [N mm]", ylim=(0.0, 36.0))
    lines = [*right.get_lines(), *other.get_lines()]
    right.legend(lines, [line.get_label() for line in lines], loc="upper center", ncols=2)
    figure.savefig(path, dpi=120)
