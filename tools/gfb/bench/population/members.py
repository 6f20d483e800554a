"""Members of tools/bench population: bearings drawn by numbers from a fixed seed, and an engineer's bearing on a grid."""

import dataclasses
import itertools
import math
import random

SEED = 20
AMBIENT, VISCOSITY = 101350.0, 1.95e-5  # [Pa], [Pa s]
SHEET = {"youngs_modulus": 214.0e9, "poissons_ratio": 0.29}
RIGID, FOUNDATION, BEAM, SHELL = "rigid", "elastic_foundation", "beam", "shell"
MODELS = (RIGID, FOUNDATION, BEAM, SHELL)
TURN = (BEAM, FOUNDATION, BEAM, FOUNDATION, SHELL)  # which model a member has, in turn
HOT_TURN = (RIGID, FOUNDATION, BEAM, FOUNDATION, BEAM)
PITCH = (1.5e-3, 10.0e-3)  # of bumps that are made [m]
ELEMENTS_A_BUMP, ELEMENTS_AROUND = 6, 96  # the film's, at least
STEEL_MESH = {"arc_elements": 8, "flat_elements": 2}

# Radius and length 15 and 30 mm; loads from light to beyond what it carries at the lowest of the speeds.
ENGINEER_ANGLES = tuple(range(0, 360, 30))  # of the load, from x [deg]
ENGINEER_LOADS = (20.0, 60.0, 100.0, 140.0)  # [N]
ENGINEER_SPEEDS = (40000.0, 80000.0, 120000.0)  # [rpm]
ENGINEER_SHELLS = 24  # points of the grid that have shells, too


@dataclasses.dataclass(frozen=True)
class Member:
    """A bearing of a population."""

    name: str     # by which it can be asked for again
    model: str
    groups: dict  # of its case file

    @property
    def load(self):
        """Its magnitude [N]."""
        return math.hypot(*self.groups["operation"]["load"])


def logarithmic(chance, low, high):
    """A number between two others, every decade as likely."""
    return low*(high/low)**chance.random()


def steel(thickness, **more):
    """A foil."""
    return {"thickness": thickness, **SHEET, **more}


def random_member(number, model, seed=SEED):
    """A bearing by its number: the same one whatever else is asked for."""
    chance = random.Random(f"{seed}, {number}")
    radius = chance.uniform(8.0e-3, 50.0e-3)
    length = 2.0*radius*chance.uniform(0.5, 1.5)
    clearance = radius*logarithmic(chance, 0.0005, 0.003)
    around = 2.0*math.pi*radius
    bumps = chance.randint(max(8, math.ceil(around/PITCH[1])), min(40, math.floor(around/PITCH[0])))
    half_length = 0.5*around/bumps*chance.uniform(0.5, 0.9)
    height = half_length*chance.uniform(0.15, 0.45)
    foils = [logarithmic(chance, 50.0e-6, 200.0e-6) for _ in range(2)]
    edges = [chance.choice(("leading", "trailing")) for _ in range(2)]
    friction = [max(0.0, chance.uniform(-0.1, 0.3)) for _ in range(2)]  # none for one in four
    speed = logarithmic(chance, 5.0e3, 120.0e3)
    load = 2.0*radius*length*logarithmic(chance, 2.0e3, 4.0e5)
    angle = chance.uniform(0.0, 2.0*math.pi)
    groups = {
        "scene": {"analysis": "equilibrium"},
        "bearing": {"radius": radius, "length": length, "clearance": clearance},
        "gas": {"viscosity": VISCOSITY, "ambient_pressure": AMBIENT},
        "operation": {"speed_rpm": speed, "load": (load*math.cos(angle), load*math.sin(angle))},
        "top_foil": steel(foils[0], fixed_edge=edges[0]),
        "bump_foil": steel(foils[1], half_length=half_length, height=height, bumps=bumps, fixed_edge=edges[1],
                           fixed_line=chance.choice(("corner", "half_flat"))),
        "contact": {"friction_top": friction[0], "friction_sleeve": friction[1]},
    }
    return Member(f"{number}", model, meshed(groups, model))


def meshed(groups, model):
    """Groups of a bearing of shells with the mesh that a population has, and without what a model has no use for."""
    bumps = groups["bump_foil"]["bumps"]
    mesh = {"circumferential_elements": bumps*max(ELEMENTS_A_BUMP, math.ceil(ELEMENTS_AROUND/bumps)),
            "axial_elements": 8}
    groups = {**groups, "model": {"foil": model}, "mesh": {**mesh, **STEEL_MESH}, "output": {"fields": "none"}}
    if model == FOUNDATION:
        groups = {name: keys for name, keys in groups.items() if name not in ("top_foil", "contact")}
        groups["mesh"] = mesh
        groups["bump_foil"] = {key: value for key, value in groups["bump_foil"].items() if key[:5] != "fixed"}
    return groups


def hot_member(number, model, seed=SEED):
    """A hot bearing by its number: that of the same number cold, of one pad or three, with heat that leaves by ways of any strength."""
    chance = random.Random(f"hot, {seed}, {number}")
    groups = dict(random_member(number, FOUNDATION if model == RIGID else model, seed).groups)
    ambient = chance.choice((293.15, 293.15, 350.0, 500.0))
    groups["gas"] = {"viscosity_law": "sutherland", "ambient_pressure": AMBIENT*logarithmic(chance, 1.0, 3.0)}
    groups["thermal"] = {
        "ambient_temperature": ambient, "shaft_conductance": logarithmic(chance, 0.05, 3.0),
        "sleeve_conductance": logarithmic(chance, 0.2, 10.0), "bump_conductance": logarithmic(chance, 50.0, 500.0),
        "shaft_expansion": chance.uniform(8.0e-6, 16.0e-6), "sleeve_expansion": chance.uniform(8.0e-6, 16.0e-6),
        "carry_over": chance.uniform(0.5, 0.95)}
    groups.setdefault("top_foil", {"thickness": logarithmic(chance, 50.0e-6, 200.0e-6)})
    if chance.random() < 0.4:
        groups["pads"] = {"count": 3, "arc": chance.uniform(1.8, 2.0), "preload": chance.uniform(0.0, 0.6)}
        if "bump_foil" in groups:
            groups["bump_foil"] = {**groups["bump_foil"], "bumps": max(4, groups["bump_foil"]["bumps"]//4)}
    groups["model"] = {"foil": model}
    del groups["mesh"]  # the default one: what a user waits for
    if model == RIGID:
        del groups["bump_foil"]
    return Member(f"hot {number}", model, groups)


def tilted_member(number, model, seed=SEED):
    """A bearing by its number whose shaft is tilted as far as half of its clearance at the ends."""
    chance = random.Random(f"tilted, {seed}, {number}")
    member = random_member(number, model, seed)
    bearing = member.groups["bearing"]
    tilt, angle = bearing["clearance"]/bearing["length"]*chance.uniform(0.1, 1.0), chance.uniform(0.0, 2.0*math.pi)
    return Member(f"tilted {number}", model, {**member.groups, "operation": {
        **member.groups["operation"], "tilt": (tilt*math.cos(angle), tilt*math.sin(angle))}})


def engineer_member(degrees, load, speed, model):
    """A bearing as an engineer would try it: thin foils, friction 0.1, both edges fixed at the trailing end."""
    angle = math.radians(degrees)
    groups = {
        "scene": {"analysis": "equilibrium"},
        "bearing": {"radius": 15.0e-3, "length": 30.0e-3, "clearance": 25.0e-6},
        "gas": {"viscosity": VISCOSITY, "ambient_pressure": AMBIENT},
        "operation": {"speed_rpm": speed, "load": (round(load*math.cos(angle), 9), round(load*math.sin(angle), 9))},
        "top_foil": steel(0.1e-3, fixed_edge="trailing"),
        "bump_foil": steel(0.1e-3, half_length=1.4e-3, height=0.45e-3, bumps=26, fixed_edge="trailing"),
        "contact": {"friction_top": 0.1, "friction_sleeve": 0.1},
    }
    return Member(f"{degrees} deg, {load:g} N, {speed:g} rpm", model, meshed(groups, model))


def random_set(count, models, seed=SEED):
    """The first members of the population; models in turn."""
    turn = [one for one in TURN if one in models]
    return [random_member(number, turn[number % len(turn)], seed) for number in range(count)]


def engineer_set(count, models, seed=SEED):
    """The grid of the engineer's bearing, of which the first are far apart: beams everywhere, shells at the first points."""
    grid = list(itertools.product(ENGINEER_ANGLES, ENGINEER_LOADS, ENGINEER_SPEEDS))
    random.Random(seed).shuffle(grid)
    members = [engineer_member(*point, model) for number, point in enumerate(grid) for model in models
               if model == BEAM or model == SHELL and number < ENGINEER_SHELLS]
    return members[:count]


def hot_set(count, models, seed=SEED):
    """The first hot members; models in turn."""
    turn = [one for one in HOT_TURN if one in models]
    return [hot_member(number, turn[number % len(turn)], seed) for number in range(count)]


def tilted_set(count, models, seed=SEED):
    """The first tilted members; models in turn."""
    turn = [one for one in TURN if one in models]
    return [tilted_member(number, turn[number % len(turn)], seed) for number in range(count)]


SETS = {"random": random_set, "engineer": engineer_set, "hot": hot_set, "tilted": tilted_set}
