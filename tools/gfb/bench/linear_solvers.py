"""Linear solvers of full-order strips: memory, CPU time, iterations and error as the mesh grows; memory estimates.

Ten bumps without friction, corner lines held, one load step; half the width is solved. The same scene by factors in
memory, factors in files, iterations, and with condensed bumps. Then estimates of `gfb --check` beside measured peaks,
for strips and bearings, full and reduced, with and without friction.
"""

import re
import tempfile

from gfb.program import call
from gfb.running import run_logged, write_case
from gfb.tables import markdown_table, plain_table
from gfb.tool import stop

FOIL = {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "half_length": 1.778e-3,
        "height": 0.508e-3, "pitch": 4.572e-3}
BUMPS = {**FOIL, "bumps": 10, "width": 38.1e-3, "fixed_edge": "leading", "fixed_line": "corner"}
# Elements of an arc, of a flat, over the whole width: about 1e4, 3e4, 1e5, 3e5, 1e6 unknowns.
MESHES = ((12, 3, 26), (24, 6, 40), (24, 6, 132), (24, 6, 398), (48, 12, 666))
SOLVERS = {"direct": ("none", "direct"), "out_of_core": ("none", "out_of_core"), "iterative": ("none", "iterative"),
           "direct, condensed": ("guyan", "direct")}
MOST = 6.0e9  # estimated memory of what is run [B]
UNIT = {"MB": 1.0e6, "GB": 1.0e9}


def add_options(parser):
    """The command's own options."""
    parser.add_argument("--sizes", metavar="N", type=int, default=4, choices=range(1, len(MESHES) + 1),
                        help="only the first N of the meshes; the fifth has 1e6 unknowns; default: %(default)s")
    parser.add_argument("--most-memory", metavar="BYTES", type=float, default=MOST,
                        help="what is estimated to need more is left out; default: %(default)s")


def run(options):
    """Measures; returns the tables and leaves them in Markdown and the picture."""
    with tempfile.TemporaryDirectory() as folder:
        growth = [{name: measure(options, strip_case(mesh, *how), folder) for name, how in SOLVERS.items()}
                  for mesh in MESHES[:options.sizes]]
        checked = [(words, measure(options, groups, folder)) for words, groups in calibration()]
    draw(growth, options.output/"linear-solvers.png")
    tables = [growth_table(growth), estimate_table(growth, checked)]
    (options.output/"linear-solvers.md").write_text("\n".join(markdown_table(*table) for table in tables),
                                                    encoding="utf-8")
    return "\n".join(plain_table(*table) for table in tables)


# --- scenes ---

def strip_case(mesh, reduction, solver, friction=0.0):
    """The groups of a strip."""
    load = {"kind": "crest_pressure", "distribution": "uniform", "pressure": 0.2e6, "steps_up": 1}
    if not friction:
        load["support"] = "held"
    contact = {"friction_top": friction}
    if friction:
        contact["friction_sleeve"] = friction
    return {"scene": {"analysis": "strip"}, "bump_foil": BUMPS, "contact": contact, "strip_load": load,
            "model": {"reduction": reduction, "half_width": "yes"},
            "mesh": dict(zip(("arc_elements", "flat_elements", "axial_elements"), mesh)),
            "solver": {"linear_solver": solver}}


def bearing_case(mesh, foil, reduction, solver="direct"):
    """The groups of a bearing with its shaft held."""
    groups = {"scene": {"analysis": "fixed_position"},
              "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6},
              "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5},
              "operation": {"speed_rpm": 30000.0, "eccentricity": [10.0e-6, 5.0e-6]},
              "model": {"foil": foil, "half_width": "yes"},
              "mesh": {"circumferential_elements": mesh[0], "axial_elements": mesh[1]},
              "solver": {"linear_solver": solver}}
    if foil == "shell":
        plate = {name: FOIL[name] for name in ("thickness", "youngs_modulus", "poissons_ratio")}
        groups["model"]["reduction"] = reduction
        groups["top_foil"] = {**plate, "fixed_edge": "trailing"}
        groups["bump_foil"] = {**FOIL, "bumps": 26, "fixed_edge": "trailing", "fixed_line": "half_flat"}
        groups["contact"] = {"friction_top": 0.1, "friction_sleeve": 0.1}
    return groups


def calibration():
    """(words, groups) of scenes whose estimates are looked at beside the growing strips."""
    for mesh in ((12, 3, 26), (24, 6, 132)):
        for name, (reduction, solver) in SOLVERS.items():
            if name != "iterative" or mesh[0] == 12:
                yield f"strip with friction, {words(mesh)}, {name}", strip_case(mesh, reduction, solver, 0.1)
    for mesh in ((240, 32), (960, 64)):
        yield f"rigid bearing, {mesh[0]} x {mesh[1]}", bearing_case(mesh, "rigid", "")
    for mesh, reduction, solver in (((208, 16), "guyan", "direct"), ((208, 16), "none", "direct"),
                                    ((208, 32), "guyan", "direct"), ((208, 32), "none", "direct"),
                                    ((208, 32), "guyan", "out_of_core"), ((416, 32), "none", "out_of_core"),
                                    ((832, 64), "guyan", "direct"), ((832, 64), "none", "direct")):
        model = {"guyan": "condensed", "none": "full order"}[reduction]
        yield (f"shell bearing, {mesh[0]} x {mesh[1]}, {model}, {solver}", bearing_case(mesh, "shell", reduction, solver))


def words(mesh):
    """A strip's mesh as a table names it."""
    return f"{mesh[0]} + {mesh[1]} x {mesh[2]}"


# --- one run ---

def measure(options, groups, folder):
    """What one run costs, its estimate and its answers; None where it would be too large."""
    estimate = estimated(options.gfb, groups, folder)
    if estimate > options.most_memory:
        return None
    done, stages = run_logged(options.gfb, groups, folder, "scene", may_stop=True)
    events = stages["Main Stage"]
    return {"unknowns": done.summary["unknowns"], "memory": done.summary["peak_memory"], "cpu": done.cpu,
            "estimate": estimate, "solves": done.summary["newton_iterations"],
            "iterations": events["PCApply"][0] - done.summary["newton_iterations"],
            "answers": {name: value for name, value in done.summary.items() if name.startswith("crest_deflection_")}}


def estimated(gfb, groups, folder):
    """What `--check` says a scene needs [B]."""
    said = call([gfb, "--check", write_case(folder, "check", groups)])
    found = re.search(r"memory: about ([0-9.e+]+) (MB|GB) in all", said.log)
    if found is None:
        stop(f"gfb --check said no memory:\n{said.log}{said.complaint}", 3)
    return float(found[1])*UNIT[found[2]]


# --- tables ---

def growth_table(growth):
    """Title, heads and rows of the growing strips."""
    rows = []
    for mesh, runs in zip(MESHES, growth):
        reference = runs["direct"]
        for name, one in runs.items():
            first = words(mesh) if name == "direct" else ""
            if one is None:
                rows.append([first, name] + ["left out"] + [""]*6)
                continue
            error = "" if reference is None or name == "direct" else f"{difference(one, reference):.0e}"
            rows.append([first, name, f"{one['unknowns']:,.0f}", f"{one['memory']/1.0e6:,.0f}",
                         f"{one['memory']/one['unknowns']/1.0e3:.1f}", f"{one['cpu']:.1f}", f"{one['solves']:.0f}",
                         f"{one['iterations']:.0f}" if name == "iterative" else "", error])
    return ("strips of ten bumps without friction; kB: of memory for each unknown; error: largest difference of a\n"
            "crest's deflection from the direct full-order answer, relative",
            ["mesh", "linear solver", "unknowns", "memory [MB]", "kB", "CPU [s]", "solves", "iterations", "error"], rows)


def difference(one, reference):
    """Largest relative difference of the crests' deflections."""
    return max(abs(one["answers"][name]/value - 1.0) for name, value in reference["answers"].items())


def estimate_table(growth, checked):
    """Title, heads and rows of estimates and peaks."""
    listed = [(f"strip, {words(mesh)}, {name}", one) for mesh, runs in zip(MESHES, growth) for name, one in runs.items()]
    rows = [[scene, f"{one['unknowns']:,.0f}", f"{one['estimate']/1.0e6:,.0f}", f"{one['memory']/1.0e6:,.0f}",
             f"{one['estimate']/one['memory']:.2f}"] for scene, one in listed + checked if one is not None]
    return ("memory as `--check` estimates it, and the peak of the run",
            ["scene", "unknowns", "estimate [MB]", "peak [MB]", "ratio"], rows)


# --- picture ---

def draw(growth, path):
    """Memory and CPU time against unknowns."""
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(10.0, 4.2), layout="constrained")
    for name in SOLVERS:
        # A condensed strip stands where the full one of its mesh does.
        runs = [(of_mesh["iterative"], of_mesh[name]) for of_mesh in growth]
        runs = [(full["unknowns"], one) for full, one in runs if full and one]
        axes[0].loglog([size for size, _ in runs], [one["memory"]/1.0e6 for _, one in runs], "o-", label=name)
        axes[1].loglog([size for size, _ in runs], [one["cpu"] for _, one in runs], "o-", label=name)
    axes[0].axhline(4.0*2**30/1.0e6, color="0.5", linestyle=":")
    axes[0].set(ylabel="peak memory [MB]; dotted: 4 GiB")
    axes[1].set(ylabel="CPU time of the process [s]")
    for one in axes:
        one.set(xlabel="unknowns of the full strip")
        one.grid(alpha=0.3)
    axes[0].legend(fontsize=8)
    figure.savefig(path, dpi=90)
