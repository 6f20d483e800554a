"""Bearings on springs, beams and shells: loads, speeds, tilts, friction, contacts, branches, other units."""

import math

import numpy

from hard_trial import BEAMS, CLEARANCE, GU2020, merged, scene_book

SCENES, scene = scene_book()
EQUILIBRIUM = {"analysis": "equilibrium"}
AMBIENT = GU2020["gas"]["ambient_pressure"]
SPRINGS = {**GU2020, "scene": EQUILIBRIUM, "mesh": {"circumferential_elements": 96, "axial_elements": 8},
           "model": {"foil": "elastic_foundation", "foundation_stiffness": 5.0e9, "foundation_pressure": "axial_mean"}}
RIGID = merged({name: keys for name, keys in SPRINGS.items() if name != "model"}, model={"foil": "rigid"})
RESTING = merged(BEAMS, scene=EQUILIBRIUM)
# Fixed where the film begins: no free edge under its suction, one equilibrium.
LEADING = merged(RESTING, top_foil={"fixed_edge": "leading"})
SHELLS = merged(RESTING, model={"foil": "shell"},
                mesh={"circumferential_elements": 52, "axial_elements": 4, "arc_elements": 4, "align_crests": False})
CONTACT = {"roughness": 1.0e-6, "pressure": 5.0e7, "friction": 0.12}
# An independent model of beams on the paper's mesh: resting, and with the free edge lifted.
INDEPENDENT = {"resting": (0.9182, 0.2711), "lifted": (0.9435, 0.2181)}
PAPER = {"circumferential_elements": 104, "axial_elements": 30, "arc_elements": 12, "flat_elements": 3,
         "align_crests": False}


def off(one, other):
    """Distance of two positions over the clearance."""
    return float(numpy.abs(one.eccentricity - other.eccentricity).max()/CLEARANCE)


@scene("Loads", "springs, 1e-6, 1, 100 and 1,000 N: balance, fixed and free alike", case=SPRINGS, iterations=400,
       loads=(1.0e-6, 1.0, 100.0, 1000.0))
@scene("Loads", "beams fixed at the leading edge, 1, 20, 100 and 150 N: the same", case=LEADING,
       loads=(1.0, 20.0, 100.0, 150.0), iterations=600)
def loads(trial, case, loads):
    gaps = []
    for load in loads:
        answer = trial.balanced(case, operation={"load": (-load, 0.0)})
        trial.way_back(case, answer, 1.0e-6)
        gaps.append(answer["minimum_gap"])
    trial.that("heavier loads make thinner films", all(numpy.diff(gaps) < 0.0))
    trial.says("balance; least gaps " + ", ".join(f"{gap*1e6:.2f}" for gap in gaps) + " um")


@scene("Loads", "beams, 3,000 N at 1,000 rpm: without asperities refused, with them an answer", iterations=1500)
def too_heavy(trial):
    """3,000 N over the projected area is 20 p_a; a slow film does not come near that before it is gone."""
    heavy = {"load": (-3000.0, 100.0), "speed_rpm": 1000.0}
    trial.refused(RESTING, operation=heavy)
    answer = trial.balanced(RESTING, operation=heavy, shaft_contact=CONTACT)
    trial.within("share of the asperities", answer["solid_contact_force_x"]/-3000.0, 0.5, 1.0 + 1.0e-9)
    trial.says(f"asperities carry {100.0*answer['solid_contact_force_x']/-3000.0:.1f} %")


@scene("Loads", "beams with a free leading edge, 1 N: floats off its bumps; from three starts, up to 2 N and back in other steps",
       iterations=1500)
def light(trial):
    """Far below the folds of the branches that rest (37.9 N) and that lift (9.7 N); found with the edge held."""
    first = trial.balanced(RESTING, operation={"load": (-1.0, 0.0)})
    trial.within("crests open", first["lifted_length"], 0.8, 1.0)
    trial.within("lift of the edge over C", first["leading_edge_lift"]/CLEARANCE, 0.2, 0.8)
    for start in (1.0e-5, 1.0e-5), (-2.0e-6, 1.5e-5):
        other = trial.balanced(RESTING, operation={"load": (-1.0, 0.0), "eccentricity": start})
        trial.below(f"from {start}", off(first, other), 1.0e-6)
    places = []
    for values in (1.0, 2.0, 1.0), (1.0, 1.1, 1.3, 2.0, 1.7, 1.0):
        rows = trial.solve(RESTING, operation={"load": (-1.0, 0.0)}, sweep={"parameter": "load", "values": values}).history()
        place = numpy.array([rows["eccentricity_x"], rows["eccentricity_y"]]).T/CLEARANCE
        trial.below("back at 1 N", numpy.abs(place[-1] - place[0]).max(), 1.0e-6)
        places.append(place[values.index(2.0)])
    trial.below("2 N in one step and in three", numpy.abs(places[1] - places[0]).max(), 1.0e-6)
    trial.says(f"balance; {100.0*first['lifted_length']:.0f} % of the crests open, edge lifted "
               f"{1.0e6*first['leading_edge_lift']:.1f} um")


@scene("Speeds", "springs, 1,000 to 120,000 rpm, 50 N: faster is thicker, fixed and free alike", case=SPRINGS,
       load=50.0, speeds=(1000.0, 10000.0, 60000.0, 120000.0))
@scene("Speeds", "beams fixed at the leading edge, 10,000 to 120,000 rpm, 20 N: the same", case=LEADING, load=20.0,
       iterations=500,
       speeds=(10000.0, 30000.0, 60000.0, 120000.0))
def speeds(trial, case, load, speeds):
    gaps = []
    for speed in speeds:
        operation = {"load": (-load, 0.0), "speed_rpm": speed}
        answer = trial.balanced(case, operation=operation)
        trial.way_back(case, answer, 1.0e-6, operation=operation)
        gaps.append(answer["minimum_gap"])
    trial.that(f"faster shafts make thicker films: {gaps}", all(numpy.diff(gaps) > 0.0))
    trial.says("balance; least gaps " + ", ".join(f"{gap*1e6:.2f}" for gap in gaps) + " um")


@scene("Speeds", "beams, 1,000 rpm, 20 N: balance, fixed and free alike", iterations=200)
def slow_beams(trial):
    answer = trial.balanced(RESTING, operation={"load": (-20.0, 0.0), "speed_rpm": 1000.0})
    trial.way_back(RESTING, answer, 1.0e-6, operation={"speed_rpm": 1000.0})
    trial.says(f"least gap {answer['minimum_gap']*1e6:.2f} um")


@scene("Tilt", "beams, 100 N, tilted until the ends touch: mirrored tilts, then refused", iterations=1500)
def tilted_beams(trial):
    """The foils move alike all along z: with a gap h at the midplane, a tilt beyond h over half the length touches."""
    answers = [trial.balanced(RESTING, operation={"load": (-100.0, 0.0), "tilt": (0.0, sign*2.0e-4)})
               for sign in (1.0, -1.0)]
    trial.below("mirrored tilts: the same position", off(*answers), 1.0e-7)
    trial.refused(RESTING, operation={"load": (-100.0, 0.0), "tilt": (0.0, 5.0e-3)})


@scene("Friction of bearings", "beams, 0 to 1: balance, a stiffer foil at more friction", iterations=500)
def friction(trial):
    """The shaft goes less far against a stiffer foil."""
    places = []
    for value in 0.0, 0.1, 0.3, 1.0:
        answer = trial.balanced(RESTING, contact={"friction_top": value, "friction_sleeve": value},
                                operation={"load": (-100.0, 0.0)})
        places.append(math.hypot(*answer.eccentricity)/CLEARANCE)
    trial.that(f"eccentricity falls with friction: {places}", all(numpy.diff(places) < 0.0))
    trial.says("e/C " + ", ".join(f"{place:.4f}" for place in places))


@scene("Stick lengths", "beams, 1e-5 to 1e-9 m: the shortest two alike", iterations=600)
def stick(trial):
    """In the limit the law is Coulomb's."""
    answers = [trial.balanced(RESTING, contact={"stick_length": length}, operation={"load": (-100.0, 0.0)})
               for length in (1.0e-5, 1.0e-8, 1.0e-9)]
    smooth = trial.balanced(RESTING, contact={"friction_top": 0.0, "friction_sleeve": 0.0},
                            operation={"load": (-100.0, 0.0)})
    trial.below("1e-8 and 1e-9 m", off(answers[1], answers[2]), 2.0e-3)
    trial.that("a longer one is between that and none", answers[2]["eccentricity_x"] < answers[0]["eccentricity_x"]
               < smooth["eccentricity_x"])
    trial.says(f"shortest two alike to {off(answers[1], answers[2]):.0e} C")


@scene("Stick lengths", "beams, 1e-10 m: has an answer", iterations=600,
       limit="lost before the shaft is released: of all starts only one near the foil, which is no more tried, leads there")
def shortest_stick(trial):
    """As with 1e-9 m."""
    trial.balanced(RESTING, contact={"stick_length": 1.0e-10}, operation={"load": (-100.0, 0.0)})


@scene("Contact stiffness", "beams, 1e9 to 1e15 N/m^2: hard ones alike", iterations=600)
def hard_contact(trial):
    """Penetrations fall by ten a decade, and the position moves as they do."""
    answers = [trial.balanced(RESTING, contact={"normal_stiffness": 10.0**power}, operation={"load": (-100.0, 0.0)})
               for power in (9, 11, 13, 15)]
    differences = [off(answer, answers[-1]) for answer in answers[:-1]]
    trial.that(f"differences fall: {differences}", differences[1] < 0.1*differences[0])
    trial.below("1e13 and 1e15", differences[2], 1.0e-3)
    trial.says("off the hardest by " + ", ".join(f"{one:.0e}" for one in differences) + " C")


@scene("Contact stiffness", "beams, exponent 1.5 and 2, hard: as exponent 1", iterations=600)
def exponents(trial):
    base = trial.balanced(RESTING, contact={"normal_stiffness": 1.0e13}, operation={"load": (-100.0, 0.0)})
    for exponent in 1.5, 2.0:
        # 1 kN/m at 1 nm
        hard = {"exponent": exponent, "normal_stiffness": 1.0e3/1.0e-9**exponent}
        other = trial.balanced(RESTING, contact=hard, operation={"load": (-100.0, 0.0)})
        trial.below(f"exponent {exponent:g}", off(base, other), 1.0e-3)
        trial.says(f"{exponent:g}: off by {off(base, other):.0e} C")


@scene("Foils", "beams of 25 um to 0.5 mm, fixed at the leading edge, 5 N: balance, fixed and free alike", iterations=800)
def sheets(trial):
    """A stiffer foil keeps the shaft nearer."""
    places = []
    for thickness in 25.0e-6, 50.0e-6, 0.1e-3, 0.25e-3, 0.5e-3:
        sheet = {"top_foil": {"thickness": thickness}, "bump_foil": {"thickness": thickness}}
        answer = trial.balanced(LEADING, operation={"load": (-5.0, 0.0)}, **sheet)
        trial.way_back(LEADING, answer, **sheet)
        places.append(math.hypot(*answer.eccentricity)/CLEARANCE)
    trial.that(f"nearer: {places}", all(numpy.diff(places) < 0.0))
    trial.says("e/C " + ", ".join(f"{place:.4f}" for place in places))


@scene("Foils", "beams of 0.5 mm with a free leading edge, 30 N: refused, as the film draws the edge to the shaft from every "
       "height; from 100 N down the branch ends in a fold above 30 N", iterations=1500)
def thick(trial):
    """Held at any height the edge has to be pressed down, from two starts alike."""
    sheet = {"top_foil": {"thickness": 0.5e-3}, "bump_foil": {"thickness": 0.5e-3}}
    least = []
    for start in {}, {"eccentricity": (1.0e-5, 1.0e-5)}:
        answer = trial.refused(RESTING, ("has to be pressed down at each",), operation={"load": (-30.0, 0.0), **start}, **sheet)
        least.append(float(trial.reason(answer).split(", by ")[-1].split(" N")[0]))
    trial.within("least force of one start over that of the other", least[0]/least[1], 0.8, 1.25)
    trial.that("a force", least[0] > 1.0e-3)
    fold = trial.refused(RESTING, ("fold",), operation={"load": (-100.0, 0.0)},
                         sweep={"parameter": "load", "values": (100.0, 30.0)}, **sheet)
    trial.within("load at the fold of the resting branch", math.hypot(*fold.force), 30.0, 60.0)
    trial.says(f"the resting branch ends at {math.hypot(*fold.force):.2f} N")


@scene("Bumps", "beams on 3 bumps: balance, fixed and free alike", bumps=3, case=RESTING, load=10.0,
       iterations=800)
@scene("Bumps", "beams on 60 bumps: the same", bumps=60, case=LEADING, load=20.0, iterations=800)
def bumps(trial, bumps, case, load):
    """Balance, held and free alike."""
    pitch = 2.0*math.pi*19.05e-3/bumps*0.999
    half = min(1.778e-3, 0.39*pitch)
    case = merged(case, bump_foil={"bumps": bumps, "pitch": pitch, "half_length": half,
                                      "height": 0.508e-3 if bumps < 60 else 0.25e-3},
                  mesh={"circumferential_elements": 120}, operation={"load": (-load, 0.0)})
    answer = trial.balanced(case)
    trial.way_back(case, answer)
    trial.says(f"balance; least gap {answer['minimum_gap']*1e6:.2f} um")


@scene("Branches", "beams, resting edge: the independent model's position", branch="resting", iterations=1500)
@scene("Branches", "beams, lifted edge: the independent model's position", branch="lifted", iterations=6000)
def branches(trial, branch):
    lift = {"leading_edge_lift": 2.9e-5} if branch == "lifted" else {}
    answer = trial.balanced(RESTING, operation={"load": (-100.0, 0.0), **lift}, mesh=PAPER)
    wrong = numpy.abs(answer.eccentricity/CLEARANCE - INDEPENDENT[branch]).max()
    trial.below("off the independent position, over C", wrong, 1.0e-3)
    trial.says(f"position to {wrong:.0e} C")


@scene("Branches", "beams, the load falls from 100 to 30 N: refused at the fold that an arc along the branch goes round",
       iterations=3000)
def fold(trial):
    """Two ways to the fold."""
    sweep = {"parameter": "load", "values": (100.0, 60.0, 30.0)}
    case = merged(RESTING, operation={"load": (-100.0, 0.0)}, mesh=PAPER)
    rows = trial.solve(case, sweep={**sweep, "turn_folds": True}).history()
    load = rows["load"][rows["fold"] == 1][0]
    answer = trial.refused(case, ("fold",), sweep=sweep)
    kept = answer.history()["load"]
    trial.that("both points before the fold are kept", list(kept) == [100.0, 60.0])
    trial.within("last load over the fold's", math.hypot(*answer.force)/load, 0.999, 1.02)
    trial.says(f"fold at {load:.2f} N, last state {math.hypot(*answer.force):.2f} N")


def cycles(trial, law):
    """Positions at both loads, a column a cycle, and the balance of all."""
    rows = trial.solve(RESTING, contact={"friction_law": law}, operation={"load": (-100.0, 0.0)},
                       sweep={"parameter": "load", "values": (100.0, 60.0)*5, "friction_memory": True}).history()
    wrong = numpy.abs(numpy.hypot(rows["force_x"], rows["force_y"])/rows["load"] - 1.0).max()
    trial.below("balance", wrong, 1.0e-6)
    return rows["eccentricity_x"].reshape(5, 2).T/CLEARANCE


@scene("Reversals", "beams that remember, the load turns back at each point: the cycle closes", iterations=1500)
def reversals(trial):
    """Coulomb's friction comes back to the same two positions."""
    place = cycles(trial, "coulomb")
    change = numpy.abs(place[:, -1] - place[:, -2]).max()
    trial.below("last two cycles", change, 1.0e-4)
    trial.says(f"cycle closes to {change:.0e} C")


@scene("Reversals", "the same, friction that starts anew at a reversal: creeps on, less each cycle", iterations=1500)
def creep(trial):
    """What starts anew holds nothing back at first, so the foil deflects a little at each reversal; its stiffness ends it."""
    change = numpy.abs(numpy.diff(cycles(trial, "tanh_reset")[1]))
    trial.that(f"less each cycle: {change}", all(numpy.diff(change) < 0.0))
    trial.says("change of a cycle " + ", ".join(f"{one:.1e}" for one in change) + " C")


@scene("Near-singular supports", "springs, soft: the film's own force back; hard: rigid")
def springs(trial):
    """Stiffness from p_a/(100 C) to 1e6 p_a/C."""
    unit = AMBIENT/CLEARANCE
    soft = trial.balanced(SPRINGS, model={"foundation_stiffness": 0.01*unit}, operation={"load": (-2.0, 0.0)})
    trial.way_back(SPRINGS, soft, model={"foundation_stiffness": 0.01*unit})
    hard = trial.balanced(SPRINGS, model={"foundation_stiffness": 1.0e6*unit}, operation={"load": (-50.0, 0.0)})
    rigid = trial.balanced(RIGID, operation={"load": (-50.0, 0.0)})
    trial.below("hard springs and rigid", off(hard, rigid), 1.0e-5)
    trial.says(f"soft: balance; hard: rigid to {off(hard, rigid):.0e} C")


@scene("Near-singular supports", "beams on bumps that no edge fixes: refused as it is read")
def loose(trial):
    """Without friction nothing would hold them along the sleeve."""
    trial.refused(RESTING, ("fixed_edge = 'none'",), status=1, operation={"load": (-50.0, 0.0)},
                  bump_foil={"fixed_edge": "none", "fixed_line": None})


@scene("Near-singular supports", "beams without friction, the strip fixed by half a flat alone", iterations=200)
def slippery(trial):
    """From two starts."""
    smooth = {"friction_top": 0.0, "friction_sleeve": 0.0}
    case = merged(LEADING, contact=smooth, operation={"load": (-50.0, 0.0)})
    one, other = trial.balanced(case), trial.balanced(case, operation={"eccentricity": (1.0e-5, 1.0e-5)})
    trial.below("two starts", off(one, other), 1.0e-7)
    trial.says(f"two starts alike to {off(one, other):.0e} C")


@scene("Near-singular supports", "shells, coarse, 100 N: full and condensed foils, half and whole width", iterations=600)
def shells(trial):
    base = trial.balanced(SHELLS, operation={"load": (-100.0, 0.0)})
    full = trial.balanced(SHELLS, operation={"load": (-100.0, 0.0)}, model={"reduction": "none", "half_width": "no"})
    trial.below("full whole width and condensed half", off(base, full), 1.0e-7)
    trial.says(f"the same to {off(base, full):.0e} C")


def in_units(case, length, stress, time):
    """A case in other units."""
    other, powers = merged(case), {
        "bearing": {"radius": length, "length": length, "clearance": length},
        "gas": {"viscosity": stress*time, "ambient_pressure": stress},
        "operation": {"speed_rpm": 1.0/time, "load": stress*length**2},
        "top_foil": {"thickness": length, "youngs_modulus": stress},
        "bump_foil": {"thickness": length, "youngs_modulus": stress, "half_length": length, "height": length,
                      "pitch": length},
        "contact": {"normal_stiffness": stress, "stick_length": length},
        "model": {"foundation_stiffness": stress/length},
        "shaft_contact": {"roughness": length, "pressure": stress}}
    for group, keys in powers.items():
        for key, unit in keys.items():
            value = other.get(group, {}).get(key)
            if value is not None:
                other[group][key] = tuple(one*unit for one in value) if isinstance(value, tuple) else value*unit
    return other


@scene("Other units", "springs with asperities, powers of two", case=merged(SPRINGS, shaft_contact=CONTACT, operation={
    "load": (-300.0, 20.0), "speed_rpm": 2000.0}))
@scene("Other units", "beams, powers of two", case=merged(RESTING, operation={"load": (-100.0, 0.0)}), iterations=600)
def units(trial, case):
    """The same digits, but for round-off of powers that are no powers of two."""
    base = trial.balanced(case)
    for powers in (10, 0, 0), (0, -9, 0), (-6, 5, 8):
        length, stress, time = (2.0**power for power in powers)
        other = trial.balanced(in_units(case, length, stress, time))
        worst = numpy.abs(other.eccentricity/length - base.eccentricity).max()/CLEARANCE
        trial.below(f"position in units of {powers}", worst, 1.0e-9)
        trial.that("as many iterations", other["newton_iterations"] == base["newton_iterations"])
        trial.says(f"to {worst:.0e} C")
