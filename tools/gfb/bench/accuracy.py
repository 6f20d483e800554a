"""What a run says of its own error (&accuracy), against answers on meshes far finer.

Sixty scenes: rigid bearings and bearings on springs of several eccentricities, speeds, clearances, widths and
tilts, with a slit or periodic, position or load given, bilinear and biquadratic films, and planar beams. Each names
a quantity and a target. Printed are the share of scenes whose true error is no larger than the estimate, and the
median of estimate over true error. The answers stand in docs/measured/accuracy_fine_meshes.json; --reference
computes them anew, each on two meshes, whose difference says how well it is known.
"""

import json
import math
import statistics
import tempfile

from gfb.build import version_of
from gfb.results import read_json
from gfb.running import run_case
from gfb.tables import markdown_table, plain_table
from gfb.tool import MEASURED, ROOT, stop

REFERENCE = MEASURED/"accuracy_fine_meshes.json"
AIM_COVERED, AIM_RATIO = 0.95, 3.0
ROUNDING = 1.0e-8  # of a value: solver tolerances; a smaller error is none
RADIUS, VISCOSITY, AMBIENT = 19.05e-3, 1.95e-5, 1.0135e5
MESHES = {1: (208, 64), 2: (104, 32)}  # of the case, by film order; runs begin with a quarter
FINE = ((104, 32), (208, 64))          # biquadratic; the second is the answer
BEAM_MESH, BEAM_FINE = (104, 8, 12, 3), ((416, 16, 48, 12), (832, 32, 96, 24))
FINER = {"rigid_03", "rigid_19", "rigid_30", "rigid_34", "beams_01", "beams_02"}  # whose runs come near to that: twice as fine
CRESTS = {"half_length": 1.778e-3, "height": 0.508e-3, "pitch": 4.572e-3, "bumps": 26, "fixed_edge": "trailing",
          "fixed_line": "half_flat"}
STEEL = {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29}

# name: quantity, target, film order, foil, edge, place ("held" e/C or "load" N), rpm, C [um], L/D, tilt (x, y) [rad]
SCENES = {
    "rigid_01": ("force_x", 1e-2, 1, "rigid", "slit", ("held", 0.3, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "rigid_02": ("force_y", 1e-3, 1, "rigid", "slit", ("held", 0.6, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "rigid_03": ("force_x", 1e-3, 1, "rigid", "slit", ("held", 0.9, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "rigid_04": ("maximum_pressure", 1e-2, 1, "rigid", "slit", ("held", 0.9, 0.1), 6e4, 31.8, 1.0, (0, 0)),
    "rigid_05": ("friction_torque", 1e-3, 1, "rigid", "slit", ("held", 0.8, 0.0), 1.2e5, 31.8, 1.0, (0, 0)),
    "rigid_06": ("power_loss", 1e-3, 1, "rigid", "periodic", ("held", 0.5, 0.5), 3e4, 20.0, 0.5, (0, 0)),
    "rigid_07": ("force_x", 1e-2, 1, "rigid", "periodic", ("held", 0.7, 0.0), 1e4, 20.0, 1.0, (0, 0)),
    "rigid_08": ("force_y", 1e-2, 1, "rigid", "periodic", ("held", 0.9, 0.0), 5e3, 40.0, 2.0, (0, 0)),
    "rigid_09": ("attitude_angle", 1e-2, 1, "rigid", "periodic", ("held", 0.4, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "rigid_10": ("force_x", 1e-3, 1, "rigid", "slit", ("held", 0.0, 0.7), 1e4, 50.0, 0.5, (0, 0)),
    "rigid_11": ("torque_x", 1e-2, 1, "rigid", "slit", ("held", 0.5, 0.0), 3e4, 31.8, 1.0, (4e-4, 0)),
    "rigid_12": ("torque_y", 1e-2, 1, "rigid", "slit", ("held", 0.5, 0.2), 3e4, 31.8, 1.0, (0, 5e-4)),
    "rigid_13": ("maximum_pressure", 1e-2, 1, "rigid", "slit", ("held", 0.4, 0.0), 6e4, 31.8, 1.0, (0, 7e-4)),
    "rigid_14": ("eccentricity_x", 1e-2, 1, "rigid", "slit", ("load", -50.0, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "rigid_15": ("eccentricity_y", 1e-2, 1, "rigid", "slit", ("load", -100.0, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "rigid_16": ("minimum_gap", 1e-2, 1, "rigid", "slit", ("load", -200.0, 30.0), 3e4, 31.8, 1.0, (0, 0)),
    "rigid_17": ("friction_torque", 1e-2, 1, "rigid", "periodic", ("load", 0.0, -80.0), 4e4, 25.0, 1.0, (0, 0)),
    "rigid_18": ("force_x", 1e-3, 2, "rigid", "slit", ("held", 0.6, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "rigid_19": ("force_y", 1e-4, 2, "rigid", "slit", ("held", 0.9, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "rigid_20": ("torque_x", 1e-3, 2, "rigid", "slit", ("held", 0.6, 0.1), 3e4, 31.8, 1.0, (3e-4, 1e-4)),
    "rigid_21": ("eccentricity_x", 1e-3, 2, "rigid", "slit", ("load", -100.0, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "rigid_22": ("friction_torque", 1e-4, 2, "rigid", "periodic", ("held", 0.8, 0.0), 2e4, 31.8, 1.0, (0, 0)),
    "rigid_23": ("force_x", 1e-3, 2, "rigid", "periodic", ("held", 0.5, 0.3), 1.2e5, 25.0, 0.5, (0, 0)),
    # Fast, narrow and tilted: nodal extremes that converge with the elements' order by chance.
    "rigid_24": ("maximum_pressure", 1e-2, 1, "rigid", "slit", ("held", 0.5, 0.0), 3.46e5, 31.8, 0.5, (6e-4, 3e-4)),
    "rigid_25": ("minimum_pressure", 1e-2, 1, "rigid", "slit", ("held", 0.5, 0.0), 3.46e5, 31.8, 0.5, (6e-4, 3e-4)),
    "rigid_26": ("maximum_pressure", 1e-3, 1, "rigid", "slit", ("held", 0.3, 0.2), 3.46e5, 31.8, 0.5, (0, 8e-4)),
    "rigid_27": ("minimum_pressure", 1e-3, 1, "rigid", "slit", ("held", 0.3, 0.2), 3.46e5, 31.8, 0.5, (0, 8e-4)),
    "rigid_28": ("maximum_pressure", 1e-3, 1, "rigid", "periodic", ("held", 0.4, 0.0), 3.46e5, 31.8, 0.5, (8e-4, 0)),
    "rigid_29": ("minimum_pressure", 1e-3, 1, "rigid", "periodic", ("held", 0.4, 0.0), 3.46e5, 31.8, 0.5, (8e-4, 0)),
    # Fast, long, short, periodic and tilted.
    "rigid_30": ("force_y", 1e-3, 1, "rigid", "slit", ("held", 0.85, 0.1), 3.46e5, 31.8, 2.0, (0, 0)),
    "rigid_31": ("friction_torque", 1e-3, 1, "rigid", "periodic", ("held", 0.6, 0.0), 3.46e5, 31.8, 0.5, (0, 0)),
    "rigid_32": ("minimum_gap", 1e-2, 1, "rigid", "periodic", ("load", 0.0, -150.0), 6e4, 25.0, 1.0, (0, 0)),
    "rigid_33": ("eccentricity_x", 1e-3, 1, "rigid", "periodic", ("load", -80.0, -40.0), 2e4, 31.8, 2.0, (0, 0)),
    "rigid_34": ("maximum_pressure", 1e-2, 1, "rigid", "slit", ("held", 0.7, 0.0), 3e4, 31.8, 2.0, (2e-4, 2e-4)),
    "rigid_35": ("torque_y", 1e-2, 1, "rigid", "periodic", ("held", 0.4, 0.1), 6e4, 40.0, 0.5, (0, 8e-4)),
    "springs_01": ("force_x", 1e-3, 1, "springs", "slit", ("held", 0.6, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "springs_02": ("force_y", 1e-2, 1, "springs", "slit", ("held", 0.9, 0.2), 3e4, 31.8, 1.0, (0, 0)),
    "springs_03": ("eccentricity_x", 1e-2, 1, "springs", "slit", ("load", -100.0, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "springs_04": ("minimum_gap", 1e-2, 1, "springs", "slit", ("load", -100.0, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "springs_05": ("maximum_pressure", 1e-2, 1, "springs", "slit", ("load", -150.0, 0.0), 4.5e4, 31.8, 1.0, (0, 0)),
    "springs_06": ("power_loss", 1e-3, 1, "springs", "periodic", ("held", 0.7, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "springs_07": ("torque_x", 1e-2, 1, "springs", "slit", ("held", 0.6, 0.0), 3e4, 31.8, 1.0, (4e-4, 0)),
    "springs_08": ("minimum_gap_edge", 1e-2, 1, "springs", "slit", ("held", 0.8, 0.0), 3e4, 31.8, 1.0, (1e-4, 1e-4)),
    "springs_09": ("attitude_angle", 1e-2, 1, "springs", "slit", ("load", -60.0, 60.0), 6e4, 40.0, 0.5, (0, 0)),
    "springs_10": ("force_x", 1e-3, 2, "springs", "slit", ("held", 0.8, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "springs_11": ("eccentricity_y", 1e-3, 2, "springs", "slit", ("load", -100.0, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "springs_12": ("minimum_pressure", 1e-3, 2, "springs", "periodic", ("held", 0.7, 0.2), 3e4, 31.8, 1.0, (0, 0)),
    "springs_13": ("friction_torque", 1e-4, 2, "springs", "slit", ("held", 0.5, 0.5), 3e4, 31.8, 1.0, (2e-4, 0)),
    "springs_14": ("maximum_pressure", 1e-3, 1, "springs", "slit", ("held", 0.5, 0.0), 3.46e5, 31.8, 0.5, (6e-4, 3e-4)),
    "springs_15": ("eccentricity_y", 1e-3, 1, "springs", "periodic", ("load", -120.0, 0.0), 1.5e5, 31.8, 1.0, (0, 0)),
    "springs_16": ("maximum_pressure", 1e-3, 2, "springs", "slit", ("load", -200.0, 0.0), 3e4, 31.8, 2.0, (0, 0)),
    "local_01": ("force_x", 1e-3, 1, "local", "slit", ("held", 0.6, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "local_02": ("minimum_gap", 1e-2, 1, "local", "slit", ("load", -15.0, 0.0), 6e4, 31.8, 0.5, (0, 0)),
    "local_03": ("maximum_pressure", 1e-2, 1, "local", "periodic", ("held", 0.7, 0.1), 6e4, 31.8, 1.0, (2e-4, 0)),
    "beams_01": ("force_x", 1e-2, 1, "beam", "slit", ("held", 0.5, 0.0), 3e4, 31.8, 1.0, (0, 0)),
    "beams_02": ("force_y", 1e-2, 1, "beam", "slit", ("held", 0.6, 0.1), 3e4, 31.8, 1.0, (0, 0)),
    "beams_03": ("friction_torque", 1e-2, 1, "beam", "slit", ("held", 0.9, 0.2), 3e4, 31.8, 1.0, (0, 0)),
    "beams_04": ("minimum_gap", 1e-2, 1, "beam", "slit", ("held", 0.8, 0.0), 4.5e4, 31.8, 1.0, (0, 0)),
    "beams_05": ("maximum_pressure", 1e-2, 1, "beam", "slit", ("held", 0.7, 0.0), 3e4, 31.8, 0.5, (0, 0)),
    "beams_06": ("eccentricity_x", 1e-2, 1, "beam", "slit", ("load", -60.0, 0.0), 4.5e4, 31.8, 1.0, (0, 0)),
}


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--reference", action="store_true", help=f"compute {REFERENCE.relative_to(ROOT)} anew")
    parser.add_argument("--scenes", metavar="NAME", nargs="+", default=list(SCENES), choices=list(SCENES),
                        help="only these; default: all")


def case_of(name):
    """A scene's groups, without mesh and accuracy."""
    _, _, order, foil, edge, place, rpm, clearance, slenderness, tilt = SCENES[name]
    clearance *= 1.0e-6
    operation = {"speed_rpm": rpm, "tilt": tuple(map(float, tilt))}
    if place[0] == "held":
        operation["eccentricity"] = (place[1]*clearance, place[2]*clearance)
    else:
        operation["load"] = place[1:]
    groups = {
        "scene": {"title": name, "analysis": "fixed_position" if place[0] == "held" else "equilibrium"},
        "bearing": {"radius": RADIUS, "length": 2.0*RADIUS*slenderness, "clearance": clearance,
                    "leading_edge_condition": edge},
        "gas": {"viscosity": VISCOSITY, "ambient_pressure": AMBIENT},
        "operation": operation,
        "model": {"foil": foil, "film_order": order},
        "output": {"fields": "none"},
    }
    if foil in ("springs", "local"):
        groups["model"] |= {"foil": "elastic_foundation", "foundation_stiffness": 1.0e10,
                            "foundation_pressure": "local" if foil == "local" else "axial_mean"}
    elif foil == "beam":
        groups |= {"top_foil": {**STEEL, "fixed_edge": "trailing"}, "bump_foil": {**STEEL, **CRESTS},
                   "contact": {"friction_top": 0.0, "friction_sleeve": 0.0, "normal_stiffness": 5.0e10}}
    return groups


def mesh_keys(mesh):
    """&mesh from elements around, over the width, of an arc, of a flat."""
    names = ("circumferential_elements", "axial_elements", "arc_elements", "flat_elements")
    return dict(zip(names, mesh))


def compute_reference(gfb, folder, names):
    """Answers on fine meshes, with where they come from."""
    version = version_of(gfb)
    scenes = read_json(REFERENCE, "scenes")[0] if REFERENCE.exists() else {}
    for name in names:
        quantity = SCENES[name][0]
        values, groups = [], case_of(name)
        beam = groups["model"]["foil"] == "beam"
        if not beam:
            groups["model"]["film_order"] = 2
        meshes = BEAM_FINE if beam else FINE
        if name in FINER:
            meshes = [tuple(2*number for number in mesh) for mesh in meshes]
        for mesh in meshes:
            groups["mesh"] = mesh_keys(mesh)
            values.append(run_case(gfb, groups, folder, name).summary[quantity])
        scenes[name] = {"quantity": quantity, "value": values[1], "coarser": values[0],
                        "elements": list(meshes[1]), "program": version}
        print(f"{name}: {quantity} {values[1]!r}, differs by {abs(values[1] - values[0])/abs(values[1]):.1e}", flush=True)
    content = {"what": "answers on fine meshes of the scenes of tools/gfb/bench/accuracy.py; `coarser` is the value on "
                       "half as many elements each way; films of biquadratic elements, beams with bilinear ones",
               "made_by": "tools/bench accuracy --reference", "scenes": dict(sorted(scenes.items()))}
    REFERENCE.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def measure(gfb, folder, name, fine):
    """A run that states its error, beside the true one."""
    quantity, target, order, foil = SCENES[name][:4]
    groups = case_of(name)
    groups["mesh"] = mesh_keys(BEAM_MESH if foil == "beam" else MESHES[order])
    groups["accuracy"] = {"quantity": quantity, "target": target}
    run = run_case(gfb, groups, folder, name, may_stop=True)
    value = run.summary[quantity]
    return {"name": name, "quantity": quantity, "target": target, "met": run.summary["accuracy_met"] == "true",
            "meshes": int(run.summary["meshes"]), "order": run.summary.get(f"{quantity}_order", 0.0), "value": value,
            "estimate": run.summary.get(f"{quantity}_error", math.inf)/abs(value),
            "error": max(abs(value - fine["value"])/abs(fine["value"]), ROUNDING),
            "doubt": abs(fine["value"] - fine["coarser"])/abs(3.0*fine["value"]), "cpu": run.cpu}


def run(options):
    """Measures; returns the table."""
    with tempfile.TemporaryDirectory() as folder:
        if options.reference:
            compute_reference(options.gfb, folder, options.scenes)
        if not REFERENCE.exists():
            stop(f"there is no {REFERENCE}: --reference computes it")
        fine = read_json(REFERENCE, "scenes")[0]
        rows = [measure(options.gfb, folder, name, fine[name]) for name in options.scenes]
    (options.output/"accuracy.md").write_text(report(rows, markdown_table), encoding="utf-8")
    return report(rows, plain_table)


def report(rows, table):
    """Table and verdict."""
    heads = ["scene", "quantity", "target", "meshes", "order", "estimate", "true error", "ratio", "met", "CPU [s]"]
    cells = [[row["name"], row["quantity"], f"{row['target']:.0e}", str(row["meshes"]), f"{row['order']:.2f}",
              f"{row['estimate']:.1e}", f"{row['error']:.1e}", f"{row['estimate']/row['error']:.2f}",
              "yes" if row["met"] else "no", f"{row['cpu']:.2f}"] for row in rows]
    return table("errors that runs state, against fine meshes (relative)", heads, cells) + "\n" + verdict(rows)


def verdict(rows):
    """What the aims are about."""
    ratios = [row["estimate"]/row["error"] for row in rows]
    covered = sum(ratio >= 1.0 for ratio in ratios)
    sure = sum(row["estimate"] >= row["error"] + row["doubt"] for row in rows)
    within = sum(row["error"] <= row["target"] for row in rows if row["met"])
    met = sum(row["met"] for row in rows)
    return (f"The estimate covers the true error in {covered} of {len(rows)} scenes ({100.0*covered/len(rows):.1f} %; aim: "
            f"{100.0*AIM_COVERED:.0f} % at least).\n"
            f"Median of estimate over true error: {statistics.median(ratios):.2f} (aim: at most {AIM_RATIO:g}).\n"
            f"Target met by the estimate in {met} scenes; in {within} of them the true error meets it, too.\n"
            "The fine answers are off by about a third of what they changed on their last refinement; with that "
            f"added to the true error\nthe estimate covers it in {sure} scenes.\n")
