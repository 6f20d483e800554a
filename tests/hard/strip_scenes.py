"""Bump strips of shells: friction, stick lengths, hard contacts, thin and thick foils, few and many bumps."""

import math

import numpy

from hard_trial import SHEET, STRIP, merged, scene_book

SCENES, scene = scene_book()
PLANE = {"friction_top": 0.2, "friction_sleeve": 0.2, "stick_length": 1.0e-9}
SMOOTH = {"friction_top": 0.0, "friction_sleeve": 0.0}
DENSITY = 8440.0


def loop(trial, **changes):
    """A loading and its end, whose energy is the work of the load: never negative, no more than was put in."""
    answer = trial.solve(STRIP, **changes)
    put_in = answer["maximum_force"]*answer["maximum_deflection"]
    trial.within("dissipated energy over force times travel", answer["dissipated_energy"]/put_in, -1.0e-6, 1.0)
    return answer


def same(trial, words, one, other, limit, names=("loading_stiffness", "maximum_deflection")):
    """Two strips agree."""
    worst = max(abs(other[name]/one[name] - 1.0) for name in names)
    trial.below(words, worst, limit)
    return worst


@scene("Friction of strips", "none, free at both ends: all work comes back; full and condensed")
def smooth(trial):
    """Nothing but the plates holds it along the motion."""
    answer = loop(trial, contact=SMOOTH)
    trial.below("dissipated energy over the work put in", answer["dissipated_energy"]
                / (answer["maximum_force"]*answer["maximum_deflection"]), 1.0e-5)
    full = trial.solve(STRIP, contact=SMOOTH, model={"reduction": "none"})
    worst = same(trial, "full and condensed", answer, full, 1.0e-7)
    trial.says(f"no loss; full = condensed to {worst:.0e}")


@scene("Friction of strips", "0.05 to 1: stiffer and stiffer; twice the steps; half and whole width",
       iterations=400)
def rough(trial):
    stiffness = []
    for friction in 0.05, 0.2, 0.5, 1.0:
        contact = {"friction_top": friction, "friction_sleeve": friction}
        answer = loop(trial, contact=contact)
        stiffness.append(answer["loading_stiffness"])
        finer = trial.solve(STRIP, contact=contact, strip_load={"steps_up": 10, "steps_down": 10})
        same(trial, f"friction {friction:g}, twice the steps", answer, finer, 5.0e-3)
    whole = trial.solve(STRIP, contact=contact, model={"half_width": "no"})
    same(trial, "half and whole width", answer, whole, 1.0e-6)
    trial.that("more friction makes it stiffer", all(numpy.diff(stiffness) > 0.0))
    trial.says(f"stiffness times {stiffness[-1]/stiffness[0]:.1f} from 0.05 to 1; half = whole")


@scene("Friction of strips", "1, crest pressure, fixed edge: full and condensed")
def rough_pressed(trial):
    case = merged(STRIP, contact={"friction_top": 1.0, "friction_sleeve": 1.0}, bump_foil={"fixed_edge": "leading"})
    case["strip_load"] = {"pressure": 0.2e6, "steps_up": 5}
    one, other = (trial.solve(case, model={"reduction": kind}) for kind in ("guyan", "none"))
    worst = same(trial, "full and condensed", one, other, 1.0e-6, ("maximum_deflection",))
    trial.says(f"full = condensed to {worst:.0e}")


def bounds(trial):
    """Stiffness without friction and with Coulomb's, between which every smoothed law lies."""
    return [trial.solve(STRIP, contact=contact)["loading_stiffness"]
            for contact in (SMOOTH, {**PLANE, "friction_law": "coulomb"})]


@scene("Stick lengths", "1e-4 m: next to no friction", length=1.0e-4, iterations=400)
@scene("Stick lengths", "1e-6 m: between none and Coulomb's", length=1.0e-6, iterations=400)
@scene("Stick lengths", "1e-8 m: Coulomb's", length=1.0e-8, iterations=400)
@scene("Stick lengths", "1e-10 m: Coulomb's", length=1.0e-10, iterations=400)
def stick(trial, length):
    """The smoothed law is weaker than Coulomb's, and becomes it."""
    least, most = bounds(trial)
    part = (loop(trial, contact={**PLANE, "stick_length": length})["loading_stiffness"] - least)/(most - least)
    if length <= 1.0e-8:
        trial.within("part of Coulomb's stiffening", part, 0.98, 1.02)
    else:
        trial.within("part of Coulomb's stiffening", part, 0.0, 0.3 if length > 1.0e-5 else 1.0)
    trial.says(f"{100.0*part:.1f} % of Coulomb's stiffening")


@scene("Contact stiffness", "1e8 to 1e14 N/m^2: error in proportion to 1/k", iterations=100)
def hard_contact(trial):
    """Without friction the travel is the bumps' plus F/k's: differences of two decades fall by ten a decade."""
    travel = [trial.solve(STRIP, contact={**SMOOTH, "normal_stiffness": 10.0**power})["maximum_deflection"]
              for power in range(8, 15)]
    off = -numpy.diff(travel)
    ratios = off[:-1]/off[1:]
    for power, ratio in zip(range(8, 13), ratios):
        # soft contacts deflect as much as the bumps, and their lines share the load in another way
        trial.within(f"fall of the difference at 1e{power}", ratio, 9.0 if power == 8 else 9.8, 11.0 if power == 8 else 10.2)
    trial.says("differences fall by " + ", ".join(f"{ratio:.2f}" for ratio in ratios))


@scene("Contact stiffness", "1e15 N/m^2, a penetration of 1e-12 m: the travel that 1e13 and 1e14 predict", iterations=100)
def hardest_contact(trial):
    """Newton's residual stays at the round-off of the contact forces; the differences still fall by ten a decade."""
    travel = [trial.solve(STRIP, contact={**SMOOTH, "normal_stiffness": 10.0**power})["maximum_deflection"]
              for power in (13, 14, 15)]
    ratio = (travel[0] - travel[1])/(travel[1] - travel[2])
    trial.within("fall of the difference", ratio, 9.98, 10.02)
    trial.says(f"differences fall by {ratio:.4f}")


@scene("Contact stiffness", "exponent 1.5: penetration as the law has it", exponent=1.5, iterations=200)
@scene("Contact stiffness", "exponent 2: the same", exponent=2.0, iterations=200)
def exponents(trial, exponent):
    """A law so hard that it presses in half as far adds half as much to the travel; a 1e14 contact adds 1e-11 m."""
    off = []
    hard = trial.solve(STRIP, contact={**SMOOTH, "normal_stiffness": 1.0e14})["maximum_deflection"]
    for penetration in 4.0e-8, 2.0e-8, 1.0e-8:
        stiffness = 1.0e3/penetration**exponent
        off.append(trial.solve(STRIP, contact={**SMOOTH, "normal_stiffness": stiffness, "exponent": exponent})
                   ["maximum_deflection"] - hard)
    trial.within("half the penetration, half the difference", off[0]/off[1], 1.9, 2.1)
    trial.within("again", off[1]/off[2], 1.9, 2.1)
    trial.says(f"differences halve by {off[0]/off[1]:.3f} and {off[1]/off[2]:.3f}")


def stiffness_of(trial, thickness):
    """Stiffness without friction, the force scaled with the cube of the thickness."""
    case = merged(STRIP, contact=SMOOTH, bump_foil={"thickness": thickness},
                  strip_load={"maximum_force": 10.0*(thickness/0.1e-3)**3, "steps_up": 2, "steps_down": 0})
    return trial.solve(case)["loading_stiffness"]


@scene("Foils", "25 um to 0.5 mm: compliance of bending as 1/t^3, of stretching and shear as 1/t", iterations=400)
def thickness(trial):
    """Compliance a/t^3 + b/t: a and b of two thicknesses foretell the others'."""
    sheets = numpy.array([25.0e-6, 50.0e-6, 0.1e-3, 0.25e-3, 0.5e-3])
    found = numpy.array([t**3/stiffness_of(trial, t) for t in sheets])
    b = (found[-1] - found[0])/(sheets[-1]**2 - sheets[0]**2)
    wanted = found[0] + b*(sheets**2 - sheets[0]**2)
    trial.that("stretching deflects, too", b > 0.0)
    worst = numpy.abs(found/wanted - 1.0).max()
    trial.below("compliance as foretold", worst, 2.0e-2)
    trial.says(f"compliance as predicted to {worst:.0e}")


def compliance(trial, ratio):
    """Travel over force times the cube of the thickness, and what round-off leaves of it."""
    thickness = ratio*STRIP["bump_foil"]["pitch"]
    case = merged(STRIP, contact=SMOOTH, bump_foil={"thickness": thickness},
                  strip_load={"maximum_force": 10.0*(thickness/0.1e-3)**3, "steps_up": 2, "steps_down": 0})
    answer = trial.solve(case)
    return thickness**3/answer["loading_stiffness"], answer.summary.get("deflection_round_off", 0.0)


@scene("Foils", "a strip whose thickness is 1e-3 of its pitch: still t^3, no locking", iterations=100)
def thin(trial):
    """Against 0.01 of the pitch, and twice the thickness."""
    thick, thin_one, twice = (compliance(trial, ratio)[0] for ratio in (0.01, 1.0e-3, 2.0e-3))
    trial.below("thin and twice as thin", thin_one/twice - 1.0, 1.0e-3)
    trial.within("thick over thin, compliance", thick/thin_one, 1.0, 1.03)
    trial.says(f"t^3 to {abs(thin_one/twice - 1.0):.0e}")


def foretold(trial, quantity, ratio):
    """A quantity that changes little with the thickness, as its square where shear layers are thinner than elements,
    from two other thin foils."""
    thin_one, twice = (quantity(trial, part)[0] for part in (0.5e-4, 1.0e-4))
    return thin_one + (twice - thin_one)*((ratio/0.5e-4)**2 - 1.0)/3.0


@scene("Foils", "a strip whose thickness is 1e-5 of its pitch: t^3, too", ratio=1.0e-5, iterations=100)
@scene("Foils", "a strip whose thickness is 2e-5 of its pitch: t^3, too", ratio=2.0e-5, iterations=100)
def thinner(trial, ratio):
    """As near to what 0.5e-4 and 1e-4 of the pitch foretell as the summary says that round-off leaves it: bending is ratio^2 of
    stretching, so some roundings over that; how many depends on the order in which a processor adds."""
    found, round_off = compliance(trial, ratio)
    off = found/foretold(trial, compliance, ratio) - 1.0
    trial.within("what round-off leaves, as the summary says", round_off, 1.0e-8, 10.0*numpy.finfo(float).eps/ratio**2)
    trial.below("compliance over the foretold, over that", off/(2.0*round_off + 3.0e-7), 1.0)
    trial.says(f"t^3 to {abs(off):.0e}, round-off said to be {round_off:.0e}")


@scene("Foils", "top foil whose thickness is 1e-5 of its length: bends as a beam")
def thin_plate(trial):
    """The first mode of a cantilever plate lies between plane stress and plane strain."""
    radius = 19.05e-3
    length = 2.0*math.pi*radius
    sheet = {**SHEET, "thickness": 1.0e-5*length, "density": DENSITY}
    answer = trial.solve({"scene": {"analysis": "modes"}, "modes": {"part": "top_foil", "count": 2},
                          "bearing": {"radius": radius, "length": 38.1e-3, "clearance": 31.8e-6},
                          "model": {}, "top_foil": sheet,
                          "mesh": {"circumferential_elements": 64, "axial_elements": 12}})
    beam = 1.8751**2/(2.0*math.pi*length**2)*sheet["thickness"]*math.sqrt(214.0e9/12.0/DENSITY)
    trial.within("first bending over a beam's", answer["frequency_1"]/beam, 0.99, 1.05)
    trial.says(f"first frequency {answer['frequency_1']/beam:.3f} of a beam's")


def strip_modes(trial, ratio, edge):
    """Modes of a strip as thin as that part of its pitch."""
    foil = {**STRIP["bump_foil"], "thickness": ratio*STRIP["bump_foil"]["pitch"], "density": DENSITY, "fixed_edge": edge}
    return trial.solve({"scene": {"analysis": "modes"}, "modes": {"part": "strip", "count": 8}, "model": {},
                        "bump_foil": foil, "mesh": STRIP["mesh"]})


def clamped(trial, ratio):
    """Frequencies over the thickness, and what round-off leaves of them."""
    answer = strip_modes(trial, ratio, "leading")
    return numpy.array([answer[f"frequency_{i}"] for i in range(1, 9)])/ratio, answer.summary.get("frequency_round_off", 0.0)


@scene("Foils", "clamped strip, thickness 1e-4 of the pitch: frequencies in proportion to it")
def in_proportion(trial):
    """Against 1e-3 of the pitch."""
    worst = numpy.abs(clamped(trial, 1.0e-4)[0]/clamped(trial, 1.0e-3)[0] - 1.0).max()
    trial.below("all eight", worst, 3.0e-4)
    trial.says(f"in proportion to {worst:.0e}")


@scene("Foils", "clamped strip, thickness 1e-5 of the pitch: frequencies in proportion", ratio=1.0e-5, allowed=1.0e-6)
@scene("Foils", "clamped strip, thickness 1e-6 of the pitch: frequencies in proportion", ratio=1.0e-6, allowed=1.0e-6)
def thin_clamped(trial, ratio, allowed):
    """As 0.5e-4 and 1e-4 of the pitch foretell, and within what the summary says that round-off leaves."""
    found, round_off = clamped(trial, ratio)
    worst = numpy.abs(found/foretold(trial, clamped, ratio) - 1.0).max()
    trial.below("all eight", worst, allowed)
    trial.below("all eight, over what the summary says", worst/(round_off + 3.0e-7), 1.0)
    trial.says(f"in proportion to {worst:.0e}, round-off said to be up to {round_off:.0e}")


def loose_ones(trial, ratio):
    """The first two elastic frequencies of a free strip over the thickness, and all of its answer."""
    answer = strip_modes(trial, ratio, "none")
    return numpy.array([answer["frequency_7"], answer["frequency_8"]])/ratio, answer


@scene("Foils", "free strip, thickness 1e-3 of the pitch: six motions without strain", ratio=1.0e-3)
@scene("Foils", "free strip, thickness 1e-4 of the pitch: six motions without strain", ratio=1.0e-4)
@scene("Foils", "free strip, thickness 1e-5 of the pitch: six motions without strain", ratio=1.0e-5, allowed=1.0e-6)
@scene("Foils", "free strip, thickness 1e-6 of the pitch: six motions without strain", ratio=1.0e-6, allowed=1.0e-6)
def thin_free(trial, ratio, allowed=None):
    """The others of the thinnest as 0.5e-4 and 1e-4 of the pitch foretell."""
    found, answer = loose_ones(trial, ratio)
    trial.that(f"rigid modes: {answer['rigid_modes']:g}, not 6", answer["rigid_modes"] == 6)
    trial.below("their frequencies over the first elastic one", answer["frequency_6"]/answer["frequency_7"], 1.0e-6)
    trial.says(f"{answer['rigid_modes']:g} rigid modes")
    if allowed:
        worst = numpy.abs(found/foretold(trial, loose_ones, ratio) - 1.0).max()
        trial.below("the others in proportion", worst, allowed)
        trial.says(f"others in proportion to {worst:.0e}")


@scene("Bumps", "3 to 60, free, no friction: each more bump adds the same stiffness", iterations=400)
def many(trial):
    counts = (3, 15, 30, 60)
    found = [trial.solve(STRIP, contact=SMOOTH, bump_foil={"bumps": n},
                         strip_load={"maximum_force": 10.0*n, "steps_up": 2, "steps_down": 0})["loading_stiffness"]
             for n in counts]
    each = [(found[i + 1] - found[i])/(counts[i + 1] - counts[i]) for i in range(3)]
    trial.below("15 to 30 and 30 to 60", each[2]/each[1] - 1.0, 1.0e-4)
    trial.below("3 to 15 and 30 to 60", each[0]/each[2] - 1.0, 1.0e-2)
    trial.says(f"the same to {abs(each[2]/each[1] - 1.0):.0e}")


@scene("Bumps", "one, free at both ends, no friction: nothing fixes it along the plates; full and condensed")
def single(trial):
    case = merged(STRIP, contact=SMOOTH, bump_foil={"bumps": 1}, strip_load={"maximum_force": 10.0})
    one, full = (trial.solve(case, model={"reduction": kind}) for kind in ("guyan", "none"))
    worst = same(trial, "full and condensed", one, full, 1.0e-7)
    trial.says(f"full = condensed to {worst:.0e}")


@scene("Bumps", "one, 0.25, 0.5 and 1 m wide: stiffness in proportion but for the ends", iterations=400)
def wide(trial):
    found = []
    for width, elements in (0.25, 20), (0.5, 40), (1.0, 80):
        case = merged(STRIP, contact={"friction_top": 0.2, "friction_sleeve": 0.2},
                      bump_foil={"bumps": 1, "width": width}, mesh={"axial_elements": elements},
                      strip_load={"maximum_force": 1000.0*width, "steps_up": 4, "steps_down": 0})
        found.append(trial.solve(case)["loading_stiffness"])
    ratio = (found[2] - found[1])/(found[1] - found[0])
    trial.below("twice the width more, twice the stiffness more", ratio/2.0 - 1.0, 1.0e-3)
    trial.says(f"adds {ratio:.4f} times as much")


@scene("Meshes and steps", "elements 500 times as wide as long: the strip without ends", iterations=400)
def stretched(trial):
    """A strip 1 m wide on two elements across is a planar arch, as stiff as one on twenty, but for the ends."""
    case = merged(STRIP, contact=SMOOTH, bump_foil={"width": 1.0},
                  strip_load={"maximum_force": 4000.0, "steps_up": 2, "steps_down": 0})
    few, many_ones = (trial.solve(case, mesh={"axial_elements": n})["loading_stiffness"] for n in (2, 20))
    trial.below("2 and 20 elements across", few/many_ones - 1.0, 1.0e-2)
    trial.says(f"the same to {abs(few/many_ones - 1.0):.0e}")


@scene("Reversals", "a strip loaded and unloaded in one step each: as in twenty", iterations=400)
def one_step(trial):
    """The load turns back at every step."""
    contact = {"friction_top": 0.2, "friction_sleeve": 0.2}
    one = loop(trial, contact=contact, strip_load={"steps_up": 1, "steps_down": 1})
    twenty = loop(trial, contact=contact, strip_load={"steps_up": 20, "steps_down": 20})
    worst = same(trial, "one step and twenty: stiffness", twenty, one, 2.0e-2, ("loading_stiffness",))
    trial.says(f"stiffness as with twenty steps to {worst:.0e}")


@scene("Other units", "strip with friction, lengths times 2^12, pressures times 2^-7: same digits")
def units(trial):
    length, stress = 2.0**12, 2.0**-7
    contact = {"friction_top": 0.2, "friction_sleeve": 0.2}
    foil = STRIP["bump_foil"]
    one = trial.solve(STRIP, contact=contact)
    other = trial.solve(STRIP, contact=contact, strip_load={"maximum_force": 40.0*stress*length**2}, bump_foil={
        "youngs_modulus": foil["youngs_modulus"]*stress,
        **{key: foil[key]*length for key in ("thickness", "half_length", "height", "pitch", "width")}})
    worst = max(abs(other["maximum_deflection"]/one["maximum_deflection"]/length - 1.0),
                abs(other["dissipated_energy"]/one["dissipated_energy"]/(stress*length**3) - 1.0))
    trial.below("travel and energy", worst, 1.0e-9)
    trial.says(f"to {worst:.0e}")
