"""Film and strips of tools/bench work-precision: cases from coarse to fine, from simple to whole; references."""

import dataclasses

from gfb.bench import film as bench_film
from gfb.bench import strip as bench_strip
from gfb.case import Case

CLEARANCE, AMBIENT = bench_film.CLEARANCE, bench_film.CASE["gas"]["ambient_pressure"]
NAMES = {1: "bilinear", 2: "biquadratic"}


@dataclasses.dataclass
class Quantity:
    """What an engineer reads; a vector where it has several names."""

    words: str
    names: tuple           # of the summary
    offset: float = 0.0    # taken off before an error is made relative
    scale: float | None = None  # errors are relative to; None: the reference's size


@dataclasses.dataclass
class Entry:
    """A case that is compared."""

    family: str  # what it leaves out or adds; entries of a family differ by their mesh alone
    mesh: str    # in words
    groups: dict
    limit: bool = False  # its family's finest: what the family converges to
    size: tuple = ()     # of the mesh, a number a direction
    model: str = ""      # families of one model converge to the same

    def __post_init__(self):
        self.model = self.model or self.family

    @property
    def words(self):
        return f"{self.family}, {self.mesh}"


@dataclasses.dataclass
class Scene:
    """A scene, what is compared in it, and the three meshes of its reference, each twice as fine as the one before."""

    words: str
    said: str          # what is asked, in a paragraph
    quantities: tuple  # the first two are drawn
    entries: list
    reference: list    # (mesh in words, groups)
    order: float = 2.0  # of the reference's elements
    pairs: tuple = ()  # (what is simplified, dear entry, cheap entry)
    branch: bool = False  # several equilibria are possible
    whole: str = ""    # what the reference is, in words


def merged(groups, **changes):
    """Groups with some keys changed; a key that is None goes."""
    new = {name: dict(keys) for name, keys in groups.items()}
    for name, keys in changes.items():
        new[name] = {key: value for key, value in {**new.get(name, {}), **keys}.items() if value is not None}
    return new


def key_of(groups):
    """What a row is kept by."""
    return str(Case(groups))


# --- rigid film ---

def film_entry(order, width, scheme, nodes, limit=False):
    """An entry; nodes: intervals between nodes around and over the width."""
    mesh = (nodes[0]//order, nodes[1]//order)
    groups = merged(bench_film.film_case(mesh, width, order), model={"film_scheme": scheme})
    family = f"{NAMES[order]}, {width} width" + (", SUPG" if scheme == "supg" else "")
    return Entry(family, f"{mesh[0]} x {mesh[1]}", groups, limit, mesh)


def film_scene(quick):
    """The rigid film at eccentricity ratio 0.9."""
    counts = [(26, 8), (52, 16), (104, 32), (208, 64), (416, 128), (832, 256)][:3 if quick else 6]
    reference = [(104, 32), (208, 64), (416, 128)] if not quick else [(52, 16), (104, 32), (208, 64)]
    entries = [film_entry(order, "half", "galerkin", nodes, nodes == counts[-1 if order == 1 else -2])
               for order in NAMES for nodes in counts if order == 1 or nodes != (832, 256)]
    entries += [film_entry(1, "half", "supg", nodes, nodes == counts[-2]) for nodes in counts[:-1]]
    entries += [film_entry(order, "whole", "galerkin", nodes) for order in NAMES for nodes in counts[1:-1]]
    last = counts[-2]
    one, two = f"{last[0]} x {last[1]}", f"{last[0]//2} x {last[1]//2}"
    return Scene(
        "rigid film, eccentricity ratio 0.9",
        "[Gu2020]'s bearing with a rigid sleeve, the shaft fixed at 0.9 of the clearance, 30,000 rpm, a slit. A mesh is "
        "named by elements around x over the whole width; a biquadratic one has half as many in each direction on as many nodes.",
        (Quantity("film force", ("force_x", "force_y")), Quantity("friction torque", ("friction_torque",)),
         Quantity("largest pressure", ("maximum_pressure",), AMBIENT)),
        entries, [(f"{mesh[0]} x {mesh[1]}", bench_film.film_case(mesh, "half", 2)) for mesh in reference], order=3.0,
        pairs=(("half the width instead of the whole", f"bilinear, whole width, {one}", f"bilinear, half width, {one}"),
               ("SUPG instead of Galerkin", f"bilinear, half width, {one}", f"bilinear, half width, SUPG, {one}"),
               ("bilinear elements on as many nodes as biquadratic ones", f"biquadratic, half width, {two}",
                f"bilinear, half width, {one}")),
        whole="biquadratic, half width")


# --- strips ---

CONDENSED = "condensed, half width"


@dataclasses.dataclass
class StripKind:
    """How a strip is solved."""

    law: str = "tanh_drag"
    steps: int = 10
    reduction: str = "guyan"
    half: str = "yes"
    friction: bool = True
    solver: str = "direct"

    def family(self, usual):
        """In words, where it is not the usual kind."""
        if not self.friction:
            return "without friction"
        words = [self.law if self.law != usual.law else "", "all unknowns" if self.reduction == "none" else "",
                 "whole width" if self.half == "no" else "",
                 f"{self.steps} step" + "s"*(self.steps > 1) if self.steps != usual.steps else "",
                 "GMRES" if self.solver == "iterative" else ""]
        return ", ".join(word for word in words if word) or CONDENSED


def strip_groups(base, mesh, kind, stick=None):
    """Groups of a strip; mesh: elements of an arc, over the width; a flat has a quarter of an arc's."""
    loop = base["strip_load"]["kind"] == "plates"
    changes = {"strip_load": {"steps_up": kind.steps, "steps_down": kind.steps if loop else None},
               "contact": {"friction_law": kind.law if kind.friction else None, "stick_length": stick},
               "model": {"reduction": kind.reduction, "half_width": kind.half},
               "solver": {"linear_solver": kind.solver}, "output": {"fields": "none"},
               "mesh": {"arc_elements": mesh[0], "flat_elements": mesh[0]//4, "axial_elements": mesh[1]}}
    if not kind.friction:
        changes["contact"] |= {"friction_top": 0.0, "friction_sleeve": 0.0}
    return merged(base, **changes)


def strip_words(mesh):
    """A mesh in words."""
    return f"{mesh[0]} + {mesh[0]//4} x {mesh[1]}"


def strip_reference(base, levels, stick):
    """Meshes, steps and stick length, each twice as fine as before."""
    return [(f"{strip_words(mesh)}, {steps} steps",
             strip_groups(base, mesh, StripKind("coulomb", steps), stick/2**level))
            for level, (mesh, steps) in enumerate(levels)]


def strip_scene(quick):
    """Case 1: ten bumps under crest pressure."""
    base, usual = bench_strip.CASE_1, StripKind()
    series = [(4, 8), (8, 8), (8, 16), (12, 24), (12, 50), (24, 12), (24, 24), (24, 48), (48, 12), (48, 24), (48, 48)]
    series = series[:4] if quick else series
    kinds = [StripKind(law="coulomb"), StripKind(law="tanh_reset"), StripKind(steps=1), StripKind(steps=3),
             StripKind(friction=False), StripKind(half="no"), StripKind(reduction="none"),
             StripKind(reduction="none", solver="iterative"), StripKind(reduction="none", half="no")]
    at = series[3] if quick else series[4]
    levels = [((4, 8), 5), ((8, 16), 10), ((16, 32), 20)] if quick else [((24, 24), 10), ((48, 48), 20), ((96, 96), 40)]
    return Scene(
        "strip, case 1",
        "Ten bumps of [Gu2020] table 1 under 0.2 MPa on every crest, friction 0.1 on crests and corners, first corner "
        "line clamped; in 10 steps unless it says otherwise. A mesh is named by elements of an arc + of a flat x over the "
        "width. Bumps are condensed, half the width is solved and friction is `tanh_drag` unless an entry says otherwise.",
        (Quantity("largest deflection", ("maximum_deflection",)),
         Quantity("deflections of all crests", tuple(f"crest_deflection_{n}" for n in range(1, 11)))),
        strip_entries(base, series, kinds, usual, at), strip_reference(base, levels, 2.0e-9),
        pairs=strip_pairs(at, (("half the width instead of the whole", "whole width", CONDENSED),
                               ("condensed bumps instead of all unknowns", "all unknowns", CONDENSED),
                               ("GMRES instead of factors", "all unknowns", "all unknowns, GMRES"),
                               ("3 load steps instead of 10", CONDENSED, "3 steps"),
                               ("1 load step instead of 10", CONDENSED, "1 step"),
                               ("`coulomb` instead of `tanh_drag`", CONDENSED, "coulomb"),
                               ("`tanh_reset` instead of `tanh_drag`", CONDENSED, "tanh_reset"),
                               ("no friction", CONDENSED, "without friction"))),
        whole="`coulomb`, short stick length")


def strip_entries(base, series, kinds, usual, at):
    """The usual kind on all meshes, the other kinds on one, and those of other friction on fine ones, too."""
    entries = [Entry(CONDENSED, strip_words(mesh), strip_groups(base, mesh, usual), mesh == series[-1], mesh)
               for mesh in series]
    for kind in kinds:
        model = kind.reduction == "guyan" and kind.half == "yes"
        for mesh in dict.fromkeys([at, series[-3], series[-1]] if model else [at]):
            entries.append(Entry(kind.family(usual), strip_words(mesh), strip_groups(base, mesh, kind),
                                 model and mesh == series[-1], mesh))
    return entries


def strip_pairs(mesh, pairs):
    """Pairs on one mesh, after pairs of meshes."""
    meshes = [("24 elements over the width instead of 48", (48, 48), (48, 24)),
              ("12 elements over the width instead of 24", (48, 24), (48, 12)),
              ("24 + 6 elements a bump instead of 48 + 12", (48, 24), (24, 24)),
              ("12 + 3 elements a bump instead of 24 + 6", (24, 24), (12, 24))]
    return (*((words, *(f"{CONDENSED}, {strip_words(one)}" for one in both)) for words, *both in meshes),
            *((words, f"{one}, {strip_words(mesh)}", f"{other}, {strip_words(mesh)}") for words, one, other in pairs))


def loop_scene(quick):
    """Case 2: a loop of four bumps between plates."""
    base, usual = bench_strip.CASE_2, StripKind(steps=50)
    series = [(4, 8), (8, 8), (8, 16), (12, 24), (12, 50), (24, 12), (24, 24), (24, 48), (48, 12), (48, 24), (48, 48)]
    series = series[:4] if quick else series
    kinds = [StripKind(law, steps) for law in ("tanh_drag", "coulomb", "tanh_reset") for steps in (10, 50, 100)
             if (law, steps) != ("tanh_drag", 50)]
    kinds += [StripKind(steps=50, friction=False), StripKind(steps=50, half="no"),
              StripKind(steps=50, reduction="none")]
    at = series[3]
    levels = [((24, 24), 50), ((48, 48), 100), ((96, 96), 200)]
    levels = [((4, 8), 25), ((8, 16), 50), ((16, 32), 100)] if quick else levels
    return Scene(
        "loop, case 2",
        "Four bumps of [Gu2020] table 1 between rigid plates with friction 0.2 on both, free at both ends, to 100 N and "
        "back; in 50 + 50 steps unless it says otherwise. Meshes and models as in case 1.",
        (Quantity("dissipated energy", ("dissipated_energy",)),
         Quantity("travel at full load", ("maximum_deflection",))),
        strip_entries(base, series, kinds, usual, at), strip_reference(base, levels, 8.0e-9),
        pairs=strip_pairs(at, (("half the width instead of the whole", "whole width", CONDENSED),
                               ("condensed bumps instead of all unknowns", "all unknowns", CONDENSED),
                               ("10 + 10 load steps instead of 50 + 50", CONDENSED, "10 steps"),
                               ("100 + 100 load steps instead of 50 + 50", CONDENSED, "100 steps"),
                               ("`coulomb` instead of `tanh_drag`", CONDENSED, "coulomb"),
                               ("`tanh_reset` instead of `tanh_drag`", CONDENSED, "tanh_reset"),
                               ("`tanh_reset` in 10 + 10 steps", CONDENSED, "tanh_reset, 10 steps"),
                               ("no friction", CONDENSED, "without friction"))),
        whole="`coulomb`, short stick length")
