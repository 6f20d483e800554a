"""Errors of tools/bench work-precision: what a reference knows, what entries are off by, and which of them pay."""

import dataclasses
import math

import numpy

TRUSTED, DOUBTFUL, LOWEST_ORDER, NEAR = 1.25, 3.0, 0.5, 0.1  # of docs/manual/accuracy.md
OPEN, LIFTED, FAR = 0.1, 15.0e-6, 0.15  # differences of another branch: open crests, lift [m], position over C
ELSEWHERE = 0.2  # an entry that is off by more in any quantity is right in others by accident
LUCK = 1.5  # times its error: a finer mesh that is off by more
PAYS, LEAST = 1.15, 0.05  # what other jobs make of a CPU time: times, and seconds
LIFTS = ("leading_edge_lift", "trailing_edge_lift")


@dataclasses.dataclass
class Known:
    """A quantity of the reference."""

    quantity: object
    value: numpy.ndarray
    scale: float
    order: float | None  # observed; None: to and fro
    doubt: float         # estimated error, over the scale


@dataclasses.dataclass
class Judged:
    """An entry beside the reference."""

    entry: object
    row: dict
    errors: list  # of the quantities, over their scales; empty where there is no answer
    state: str    # why it is not compared; empty where it is
    luck: tuple = ()  # quantities whose errors are small because those of model and mesh cancel

    @property
    def cpu(self):
        return min(self.row["cpu"])

    def count(self, name):
        """A number of the summary."""
        return self.row["summary"][name]


def vector(quantity, row):
    """A quantity of a run; no suction, no torque: zero."""
    return numpy.array([row["summary"].get(name, 0.0) for name in quantity.names]) - quantity.offset


def known(scene, store):
    """What the reference's three meshes say of each quantity."""
    rows = [store.row(groups) for _, groups in scene.reference]
    return [know(quantity, [vector(quantity, row) for row in rows], scene.order) for quantity in scene.quantities]


def know(quantity, values, order):
    """The rule of docs/manual/accuracy.md, for vectors by the lengths of their changes."""
    before, last = values[1] - values[0], values[2] - values[1]
    sizes = [float(numpy.linalg.norm(one)) for one in (before, last)]
    scale = quantity.scale or float(numpy.linalg.norm(values[2]))
    observed = math.log2(sizes[0]/sizes[1]) if float(before @ last) > 0.0 and sizes[1] > 0.0 else None
    if observed is None or observed < LOWEST_ORDER:
        return Known(quantity, values[2], scale, observed, DOUBTFUL*max(sizes)/scale)
    factor = TRUSTED if abs(observed - order) <= NEAR*order else DOUBTFUL
    return Known(quantity, values[2], scale, observed, factor*sizes[1]/(2.0**min(observed, order) - 1.0)/scale)


def judge(scene, store, facts):
    """All entries beside the reference."""
    base = store.row(scene.reference[-1][1])["summary"]
    judged = []
    for entry in scene.entries:
        row = store.row(entry.groups)
        state = "" if row["converged"] else "no answer"
        if not state and scene.branch:
            state = other_branch(row["summary"], base, facts)
        errors = [] if state else [off(one, row) for one in facts]
        judged.append(Judged(entry, row, errors, state))
    for one in compared(judged):
        one.luck = tuple(i for i, fact in enumerate(facts) if any(
            sure(other, fact, i) > LUCK*sure(one, fact, i) for other in compared(judged)
            if finer(other.entry, one.entry)))
    return judged


def finer(one, other):
    """Whether an entry's mesh is finer than another's of the same model."""
    return one.model == other.model and one.size != other.size and all(a >= b for a, b in zip(one.size, other.size))


def off(one, row):
    """A run's error in a quantity."""
    return float(numpy.linalg.norm(vector(one.quantity, row) - one.value))/one.scale



def other_branch(summary, base, facts):
    """Whether foils with free edges lie elsewhere; springs and rigid sleeves cannot."""
    if "lifted_length" not in summary:
        return ""
    place = next(one for one in facts if "eccentricity_x" in one.quantity.names)
    lifts = max(abs(summary[name] - base[name]) for name in LIFTS)
    far = off(place, {"summary": summary}) > FAR
    opened = abs(summary["lifted_length"] - base["lifted_length"])
    return "another equilibrium" if far or lifts > LIFTED or opened > OPEN else ""


def compared(judged):
    """Entries with errors."""
    return [one for one in judged if not one.state]


def sure(one, fact, i):
    """Error of an entry, no smaller than what the reference can judge."""
    return max(one.errors[i], fact.doubt)


def front(judged, facts, i, cost):
    """Entries than which none is both cheaper and better, by rising cost."""
    best, found = math.inf, []
    for one in sorted(compared(judged), key=lambda one: (cost(one), one.errors[i])):
        if sure(one, facts[i], i) < best and i not in one.luck:
            best = sure(one, facts[i], i)
            found.append(one)
    return found


def cheapest(judged, facts, places, target):
    """The cheapest entry whose errors, the reference's doubt added, are within a target; None where there is none.

    Of those that cost the same but for scatter the one with the smallest error in the first of the quantities.
    """
    good = [one for one in compared(judged)
            if all(one.errors[i] + facts[i].doubt <= target and i not in one.luck for i in places)
            and max(one.errors) <= ELSEWHERE]
    if not good:
        return None
    least = min(one.cpu for one in good)
    first = places[0]
    return min((one for one in good if not pays(one.cpu, least)), key=lambda one: sure(one, facts[first], first))


def pays(dear, cheap):
    """Whether a CPU time is larger than another one beyond scatter."""
    return dear > PAYS*cheap and dear > cheap + LEAST


def limits(facts, judged):
    """[(entry on its family's finest mesh, differences from the mesh before it)]."""
    found = []
    for at, one in enumerate(judged):
        if not one.entry.limit or one.state:
            continue
        before = [other for other in judged[:at] if other.entry.family == one.entry.family and not other.state]
        found.append((one, [] if not before else
                      [differ(fact.quantity, one, before[-1], fact.scale) for fact in facts]))
    return found


def differ(quantity, one, other, scale=None):
    """Distance of two entries in a quantity, over a scale; without one over the quantity's, or its size in the first."""
    values = [vector(quantity, each.row) for each in (one, other)]
    scale = scale or quantity.scale or max(float(numpy.linalg.norm(values[0])), 1e-300)
    return float(numpy.linalg.norm(values[1] - values[0]))/scale


def pairs(scene, judged):
    """[(words, dear entry, cheap entry, their differences)] of the pairs that were both solved."""
    by_words = {one.entry.words: one for one in judged}
    found = []
    for words, dear, cheap in scene.pairs:
        one, other = by_words.get(dear), by_words.get(cheap)
        if one and other and not one.state and not other.state:
            found.append((words, one, other, [differ(quantity, one, other) for quantity in scene.quantities]))
    return found
