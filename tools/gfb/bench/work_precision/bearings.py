"""Bearings of tools/bench work-precision: cases from coarse to fine, from a rigid sleeve to shells; references."""

from gfb.bench import bearing as bench_bearing
from gfb.bench.work_precision.scenes import AMBIENT, CLEARANCE, Entry, Quantity, Scene, merged

PITCHES = bench_bearing.CASE["bump_foil"]["bumps"]
TILT = 2.0e-4  # [rad]


def bearing_groups(foil, mesh, tilt, **model):
    """Groups of the bearing; mesh: elements a pitch, of an arc (a quarter on a flat), over the width."""
    order = model.get("film_order", 1)
    groups = merged(bench_bearing.CASE, top_foil={"fixed_edge": "leading"}, model={"foil": foil, **model},
                    operation={"tilt": (tilt, 0.0)}, output={"fields": "none"},
                    mesh={"circumferential_elements": PITCHES*mesh[0]//order, "axial_elements": mesh[2]//order,
                          "arc_elements": mesh[1], "flat_elements": mesh[1]//4})
    if foil in ("rigid", "elastic_foundation"):
        groups["mesh"] = {key: value for key, value in groups["mesh"].items() if key[:3] not in ("arc", "fla")}
        del groups["contact"], groups["top_foil"]
    if foil == "rigid":
        del groups["bump_foil"]
    return groups


def bearing_words(foil, mesh):
    """A mesh in words."""
    return f"{mesh[0]}, {mesh[1]} + {mesh[1]//4}, {mesh[2]}" if foil in ("shell", "beam") else f"{mesh[0]}, {mesh[2]}"


FOILS = {"rigid": ("rigid", {}), "springs": ("elastic_foundation", {"foundation_pressure": "axial_mean"}),
         "springs, local pressure": ("elastic_foundation", {"foundation_pressure": "local"}), "beams": ("beam", {}),
         "beams, SUPG": ("beam", {"film_scheme": "supg"}), "beams, biquadratic film": ("beam", {"film_order": 2}),
         "beams, whole width": ("beam", {"half_width": "no"}), "shells": ("shell", {}),
         "shells, SUPG": ("shell", {"film_scheme": "supg"}), "shells, biquadratic film": ("shell", {"film_order": 2}),
         "shells, all unknowns": ("shell", {"reduction": "none"}),
         "shells, whole width": ("shell", {"half_width": "no"}),
         "shells, coulomb": ("shell", {}), "shells, without friction": ("shell", {}),
         "beams, without friction": ("beam", {}), "shells, partitioned": ("shell", {"coupling": "partitioned"})}


def bearing_entry(family, mesh, tilt, limit=False):
    """An entry of a family."""
    foil, model = FOILS[family]
    groups = bearing_groups(foil, mesh, tilt, **model)
    if family.endswith("coulomb"):
        groups["contact"]["friction_law"] = "coulomb"
    elif family.endswith("without friction"):
        groups["contact"] |= {"friction_top": 0.0, "friction_sleeve": 0.0}
    model = family if "without" in family or "biquadratic" in family else family.split(",")[0]
    return Entry(family, bearing_words(foil, mesh), groups, limit, mesh, model)


def bearing_entries(families, tilt):
    """Entries of {family: meshes}; the last of several is the family's finest."""
    return [bearing_entry(family, mesh, tilt, limit=len(meshes) > 1 and mesh == meshes[-1])
            for family, meshes in families.items() for mesh in meshes]


SERIES = [(4, 12, 8), (8, 24, 16), (16, 48, 32), (32, 96, 64)]
SIMPLE = {"rigid": SERIES, "springs": SERIES, "springs, local pressure": SERIES[1:2], "beams": SERIES}
BEARING_SAID = (
    "[Gu2020]'s bearing under 100 N at 30,000 rpm, {tilt}, friction 0.1, the **top foil fixed at its leading edge**: fixed "
    "at the other one it has several equilibria ([branches.md](../manual/branches.md)), fixed so one was met from all starts. What "
    "ends elsewhere all the same (open crests, lift of the edges, position) is listed as such. A mesh is named by elements "
    "a pitch (film and top foil), of an arc + of a flat, over the whole width; the default mesh is 8, 12 + 3, 32. "
    "`springs`: elastic foundation under the axial mean of the pressure, [WalowitAnno1975]. Shells are condensed, with a "
    "bilinear film by Galerkin, unless they say otherwise; a mesh with a biquadratic film is counted between its nodes.")


def bearing_scene(quick):
    """100 N, aligned."""
    base, paired = (4, 12, 8), (8, 24, 16)
    if quick:
        families = {name: meshes[:2] for name, meshes in SIMPLE.items()} | {"shells": [base]}
        levels, paired = [(2, 12, 4), (4, 24, 8), (8, 48, 16)], base
    else:
        families = SIMPLE | {
            "beams, biquadratic film": [(8, 24, 8), (8, 24, 16), (16, 48, 16)], "beams, SUPG": SERIES[1:2],
            "beams, whole width": SERIES[1:2], "beams, without friction": SERIES[1:2],
            "shells": [base, (4, 24, 8), (8, 12, 8), (8, 12, 16), paired, (8, 48, 16), (16, 24, 16), (8, 12, 32),
                       (8, 48, 32), (16, 48, 32)],
            "shells, biquadratic film": [(4, 24, 8), (8, 24, 8), (8, 24, 16), (16, 48, 16)],
            "shells, all unknowns": [base, paired],
            "shells, whole width": [paired], "shells, SUPG": [paired], "shells, coulomb": [paired],
            "shells, without friction": [paired], "shells, partitioned": [base]}
        levels = SERIES[1:]
    return Scene(
        "bearing, 100 N, aligned",
        BEARING_SAID.format(tilt="not tilted, half the width solved unless it says otherwise"),
        (Quantity("position over C", ("eccentricity_x", "eccentricity_y"), scale=CLEARANCE),
         Quantity("film at the midplane", ("minimum_gap_midplane",)), Quantity("smallest film", ("minimum_gap",)),
         Quantity("largest pressure", ("maximum_pressure",), AMBIENT),
         Quantity("friction torque", ("friction_torque",))),
        bearing_entries(families, 0.0), [(bearing_words("shell", mesh), bearing_groups("shell", mesh, 0.0))
                                         for mesh in levels],
        pairs=bearing_pairs(paired, base), branch=True, whole="shells")


def tilted_scene(quick):
    """100 N, tilted."""
    base, paired = (4, 12, 8), (8, 24, 16)
    if quick:
        families = {name: meshes[:2] for name, meshes in SIMPLE.items()}
        levels, paired = [(2, 4, 4), (4, 8, 8), (8, 16, 16)], base
    else:
        families = SIMPLE | {"beams, biquadratic film": [(8, 24, 8), (8, 24, 16)],
                             "beams, without friction": SERIES[1:2],
                             "shells": [base, (8, 12, 8), (8, 24, 8), (8, 12, 16), paired, (8, 12, 32), (12, 36, 24)],
                             "shells, biquadratic film": [(8, 24, 8), (8, 24, 16), (16, 48, 16)],
                             "shells, all unknowns": [base],
                             "shells, without friction": [base]}
        levels = [(5, 16, 10), (10, 32, 20), (20, 64, 40)]
    return Scene(
        "bearing, 100 N, tilted 2e-4 rad",
        BEARING_SAID.format(tilt="tilted by 2e-4 rad about x, the whole width solved"),
        (Quantity("restoring torque", ("torque_x", "torque_y")), Quantity("smallest film", ("minimum_gap",)),
         Quantity("position over C", ("eccentricity_x", "eccentricity_y"), scale=CLEARANCE),
         Quantity("largest pressure", ("maximum_pressure",), AMBIENT)),
        bearing_entries(families, TILT), [(bearing_words("shell", mesh), bearing_groups("shell", mesh, TILT))
                                          for mesh in levels],
        pairs=bearing_pairs(paired, base), branch=True, whole="shells")


def bearing_pairs(mesh, other):
    """What can be left out of the bearing; those that have not been asked for are passed over."""
    words = [bearing_words("shell", one) for one in (mesh, other)]
    simple = bearing_words("rigid", mesh)
    pairs = [("beams instead of shells", "shells", "beams"),
             ("no friction between the foils", "shells", "shells, without friction"),
             ("half the width instead of the whole", "shells, whole width", "shells"),
             ("condensed bumps instead of all unknowns", "shells, all unknowns", "shells"),
             ("SUPG instead of Galerkin", "shells", "shells, SUPG"),
             ("`coulomb` instead of `tanh_drag`", "shells", "shells, coulomb"),
             ("monolithic instead of partitioned", "shells, partitioned", "shells"),
             ("no friction between the foils, beams", "beams", "beams, without friction")]
    meshes = [("12 + 3 elements a bump instead of 24 + 6", (8, 24, 16), (8, 12, 16)),
              ("16 elements over the width instead of 32", (8, 12, 32), (8, 12, 16)),
              ("8 elements over the width instead of 16", (8, 12, 16), (8, 12, 8)),
              ("8 elements a pitch instead of 16", (16, 24, 16), (8, 24, 16))]
    refined = [(said, *(f"shells, {bearing_words('shell', one)}" for one in both)) for said, *both in meshes]
    same = [(said, f"{dear}, {one}", f"{cheap}, {one}") for one in dict.fromkeys(words) for said, dear, cheap in pairs]
    return (*refined, *same,
            ("springs instead of beams", f"beams, {words[0]}", f"springs, {simple}"),
            ("springs instead of shells", f"shells, {words[0]}", f"springs, {simple}"),
            ("a rigid sleeve instead of shells", f"shells, {words[0]}", f"rigid, {simple}"))
