"""What tools/bench work-precision says of its figures: what to use when."""

import textwrap

from gfb.bench.work_precision import errors
from gfb.tables import markdown_table

WIDE = 120  # letters of a line

SHOWN = (0.1, 0.01, 0.001)  # targets of the table
NOTHING = 1.0e-6   # a change that is none
SETTLED = 0.5      # of an error: a smaller change on the last refinement does not explain it
NEAR_FLOOR = 0.25  # of what a model converges to: finer meshes are wasted
CLEAR = 2.0        # times the reference's doubt
SMALL = 1.0e-3     # a change that hardly matters
SAME_WAY = 0.7     # of an error: its size tells the direction
BEARINGS = ("bearing", "tilted")
FAMILY_WORDS = {"rigid": "A rigid sleeve", "springs": "An elastic foundation", "beams": "Planar beams"}


def percent(value):
    """In per cent, two digits."""
    return f"{100.0*value:.2g} %" if value < 0.995 else f"{100.0*value:.0f} %"


def filled(words):
    """A paragraph or a point of a list, in lines."""
    return textwrap.fill(words, WIDE, subsequent_indent="  "*words.startswith("- "), break_long_words=False,
                         break_on_hyphens=False)


def listed(words):
    """Words joined by commas and `and`."""
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]


def conclusions(found):
    """The section that says what to use when."""
    lines = ["## What to use when\n", *(filled(f"- {one}") for one in short(found)),
             "\nThe cheapest entry that is surely within a target, and nowhere off by more than "
             f"{percent(errors.ELSEWHERE)} (else it meets\nthe target by accident):\n",
             markdown_table("", ["scene", "quantity", *(f"to {percent(one)}" for one in SHOWN)],
                            [row for several in found.values() for row in target_rows(*several)])]
    for scene, facts, judged in found.values():
        said = scene_lines(scene, facts, judged)
        if said:
            lines.append(f"\n**{scene.words[0].upper()}{scene.words[1:]}** ([tables](#{anchor(scene.words)}))\n")
            lines += [filled(f"- {one}") for one in said]
    return "\n".join(lines) + "\n"


def anchor(words):
    """Of a heading."""
    return "".join(one if one.isalnum() or one == "-" else "-" if one == " " else "" for one in words.lower())


def target_rows(scene, facts, judged):
    """Rows of the table of targets: each quantity, then all of them."""
    rows = []
    for i, one in enumerate([*facts, None]):
        places = range(len(facts)) if one is None else [i]
        doubt = max(facts[at].doubt for at in places)
        cells = []
        for target in SHOWN:
            best = errors.cheapest(judged, facts, places, target)
            cells.append(f"{best.entry.words}: {best.cpu:.2f} s" if best else
                         "the reference cannot judge it" if doubt >= target else "none of these")
        rows.append([scene.words if i == 0 else "", one.quantity.words if one else "all of them", *cells])
    return rows


# --- one scene ---

def scene_lines(scene, facts, judged):
    """What a scene's figures say."""
    return [*usual_line(scene, facts, judged), *floor_lines(scene, facts, judged), *pair_lines(scene, judged)]


def usual_line(scene, facts, judged):
    """Error of the mesh that is usual, and what is cheaper and no worse."""
    usual = next((one for one in errors.compared(judged) if one.entry.words == scene.usual), None)
    if usual is None:
        return []
    said = (f"The usual choice ({usual.entry.words}) takes {usual.cpu:.2f} s: "
            + listed([error_words(usual, facts, i) for i in range(len(facts))]) + ".")
    better = [one for one in errors.compared(judged) if errors.pays(usual.cpu, one.cpu) and not one.luck and
              all(errors.sure(one, fact, i) <= errors.sure(usual, fact, i) for i, fact in enumerate(facts))]
    if better:
        best = min(better, key=lambda one: one.cpu)
        said += (f" Cheaper and no worse in any of these: {best.entry.words}, {best.cpu:.2f} s, "
                 f"{usual.cpu/best.cpu:.1f} times less.")
    return [said]


def error_words(one, facts, i):
    """An error with its quantity, and its direction where the size says it."""
    fact, value = facts[i], one.errors[i]
    if value < fact.doubt:
        return f"{fact.quantity.words} less than {percent(fact.doubt)} off"
    way = "off" if abs(one.over[i]) < SAME_WAY*value else "too large" if one.over[i] > 0.0 else "too small"
    return f"{fact.quantity.words} {percent(value)} {way}"


def floors(scene, facts, judged):
    """[(simpler model's finest entry, places of the quantities whose error no mesh mends)]."""
    return [(one, places) for one, last in errors.limits(facts, judged) if last and one.entry.family in scene.models
            for places in [[i for i, fact in enumerate(facts) if one.errors[i] > CLEAR*fact.doubt
                            and last[i] < SETTLED*one.errors[i]]] if places]


def floor_lines(scene, facts, judged):
    """What simpler models stay off by, which mesh of them is fine enough, and what is surely better."""
    lines = []
    for one, places in floors(scene, facts, judged):
        said = (f"**{one.entry.family}**, however fine the mesh: "
                + listed([error_words(one, facts, i) for i in places]) + ".")
        own = [other for other in errors.compared(judged) if other.entry.family == one.entry.family
               and all(abs(other.errors[i] - one.errors[i]) <= NEAR_FLOOR*one.errors[i] for i in places)]
        enough = min(own, key=lambda other: other.cpu)
        if enough is not one:
            said += f" Its mesh {enough.entry.mesh} ({enough.cpu:.2f} s) is as good: finer ones are wasted."
        whole = [other for other in errors.compared(judged) if other.entry.family == scene.base
                 and all(other.errors[i] + facts[i].doubt <= one.errors[i] for i in places)]
        if whole and one.entry.family != scene.base:
            best = min(whole, key=lambda other: other.cpu)
            said += (f" Surely better in all that: {best.entry.words}, {best.cpu:.2f} s, "
                     f"{ratio_words(best.cpu/enough.cpu)}.")
        lines.append(said)
    return lines


def ratio_words(ratio):
    """A ratio of times in words."""
    if ratio >= errors.PAYS:
        return f"{ratio:.1f} times as much"
    return "no more" if ratio > 1.0/errors.PAYS else f"{1.0/ratio:.1f} times less"


def pair_lines(scene, judged):
    """What is free, what is bought with accuracy, what gains nothing."""
    kinds = {"Free": [], "Next to free": [], "Bought with accuracy": [], "No faster": []}
    for words, dear, cheap, changes in errors.pairs(scene, judged):
        gain, told = dear.cpu/cheap.cpu, f"{words} ({cheap.entry.mesh})"
        largest = max(range(len(changes)), key=lambda i: changes[i])
        changed = f"{scene.quantities[largest].words} changes by {percent(changes[largest])}"
        if not errors.pays(dear.cpu, cheap.cpu):
            kinds["No faster"].append(f"{told}, {1.0/gain:.2f} times the time, "
                                      + ("nothing changes" if changes[largest] < NOTHING else changed))
        elif changes[largest] < NOTHING:
            kinds["Free"].append(f"{told}, {gain:.1f} times cheaper")
        elif changes[largest] < SMALL:
            kinds["Next to free"].append(f"{told}, {gain:.1f} times cheaper; {changed}")
        else:
            all_changed = ", ".join(f"{one.words} {percent(value)}" for one, value in zip(scene.quantities, changes))
            kinds["Bought with accuracy"].append(f"{told}, {gain:.1f} times cheaper: {all_changed}")
    return [f"{kind}: " + "; ".join(said) + "." for kind, said in kinds.items() if said]


# --- all scenes ---

def short(found):
    """A few rules over all scenes."""
    return [*model_lines(found), *target_lines(found), *film_lines(found), *pair_rules(found)]


def model_lines(found):
    """What the simpler models of the bearing are off by."""
    lines = []
    for family, words in FAMILY_WORDS.items():
        said = [f"{scene.words.split(', ')[-1]}: " + ", ".join(error_words(one, facts, i) for i in range(len(facts)))
                for name in BEARINGS if name in found for scene, facts, judged in [found[name]]
                for one, _ in errors.limits(facts, judged) if one.entry.family == family]
        if said:
            lines.append(f"**{words}**, beside shells, on its finest mesh: " + "; ".join(said) + ".")
    return lines


def target_lines(found):
    """The cheapest for several targets, in all quantities that the reference knows well enough."""
    lines = []
    for scene, facts, judged in found.values():
        said = {}
        for target in (0.1, 0.03, 0.01, 0.003, 0.001):
            places = [i for i, fact in enumerate(facts) if fact.doubt <= 0.5*target]
            best = errors.cheapest(judged, facts, places, target) if 0 in places else None
            if best:
                left = [fact.quantity.words for i, fact in enumerate(facts) if i not in places]
                said.setdefault(f"{best.entry.words} ({best.cpu:.2f} s" + (
                    f"; {listed(left)} not judged)" if left else ")"), []).append(percent(target))
        if said:
            lines.append(f"**{scene.words[0].upper()}{scene.words[1:]}**, in all that is read: "
                         + "; ".join(f"{listed(targets)} by {words}" for words, targets in said.items()) + ".")
    return lines


def film_lines(found):
    """Bilinear against biquadratic elements."""
    if "film" not in found:
        return []
    _, facts, judged = found["film"]
    said = []
    for target in errors.TARGETS:
        best = [errors.cheapest([one for one in judged if one.entry.family == f"{kind}, half width"], facts, [0],
                                target) for kind in ("bilinear", "biquadratic")]
        if None not in best and errors.pays(best[0].cpu, best[1].cpu):
            said.append(f"{percent(target)} {best[0].cpu/best[1].cpu:.1f} times ({best[1].entry.mesh}, "
                        f"{best[1].cpu:.2f} s, against {best[0].entry.mesh}, {best[0].cpu:.2f} s)")
    return ["**Biquadratic film elements** are cheaper than bilinear ones for an error of the force of "
            + "; ".join(said) + ". Below that both cost what the program's start does."] if said else []


def pair_rules(found):
    """What changes nothing in any scene, and what gains nothing in any."""
    made = {}
    for scene, _, judged in found.values():
        for words, dear, cheap, changes in errors.pairs(scene, judged):
            made.setdefault(words, []).append((dear.cpu/cheap.cpu, max(changes), errors.pays(dear.cpu, cheap.cpu)))
    lines, idle = [], []
    for words, all_of in made.items():
        gains, largest = [gain for gain, _, _ in all_of], max(change for _, change, _ in all_of)
        if largest >= SMALL and not any(paid for _, _, paid in all_of):
            idle.append(f"{words} (up to {percent(largest)})")
        if largest < NOTHING and max(gains) >= errors.PAYS:
            lines.append(f"**{words[0].upper()}{words[1:]}** changes nothing; CPU time falls {span(gains)} times "
                         f"in {len(gains)} comparison{'s'*(len(gains) > 1)}.")
    return [*lines, f"**Gains no time anywhere**, but changes answers: {'; '.join(idle)}."] if idle else lines


def span(values):
    """Smallest and largest."""
    low, high = min(values), max(values)
    return f"{low:.1f}" if f"{low:.1f}" == f"{high:.1f}" else f"{low:.1f} to {high:.1f}"
