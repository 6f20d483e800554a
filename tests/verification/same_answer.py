"""Two runs of one case compared: every number of the summary and of the history that is not a cost, and every word."""

import dataclasses
import math
import re

import numpy

from gfb_run import COST, ROUNDING, Bearing, largest_difference, natural_sizes, summary_difference


@dataclasses.dataclass
class Difference:
    """What differs between two answers."""

    summary: tuple   # largest relative difference, its name
    history: tuple   # the same
    words: bool      # the same words stand in both summaries
    columns: bool    # both histories have the same columns

    @property
    def largest(self):
        """Of all numbers, and where."""
        return max(self.summary, self.history)

    @property
    def alike(self):
        """All that is no number."""
        return self.words and self.columns


def number_of(text, key):
    """A number of a case file; None where it is not there."""
    found = re.search(rf"^ *{key} *= *([-+.0-9a-zA-Z]+)", text, re.MULTILINE)
    return float(found.group(1)) if found else None


def sizes_of(text, one):
    """What differences of quantities that may vanish are compared with."""
    measures = {key: number_of(text, key) for key in ("radius", "length", "clearance", "ambient_pressure")}
    if None not in measures.values():
        bearing = Bearing(**measures)
        ends = [f"{edge}_edge_lift{place}" for edge in ("leading", "trailing") for place in ("", "_edge")]
        orbits = [name for name in one.summary if re.fullmatch(r"orbit_[xy](_\d+)?", name)]  # of the midplane, of both bearings
        largest_orbit = max((one[name] for name in orbits), default=0.0)  # by a couple alone the midplane moves by nothing
        return natural_sizes(bearing) | {name: bearing.clearance for name in ends} | dict.fromkeys(orbits, largest_orbit) | {
            f"held_force_{axis}": bearing.force_unit for axis in "xy"} | {
            "largest_multiplier": 10.0}  # from differences of orbits that are 2e-6 apart
    works = ("strain_energy", "penalty_energy", "friction_work", "external_work", "dissipated_energy")
    if "maximum_force" not in one.summary:
        return ROUNDING
    largest, energy = one["maximum_deflection"], one["maximum_deflection"]*one["maximum_force"]
    return {name: energy for name in works} | {"force": one["maximum_force"], "plate_travel": largest} | {
        name: largest for name in one.summary if name.startswith("crest_deflection_")}


def history_of(answer):
    """The columns of the history; none where there are no steps."""
    try:
        return answer.history()
    except KeyError:
        return {}


def words_of(answer):
    """What is no number in a summary."""
    return {name: value for name, value in answer.summary.items() if isinstance(value, str)}


def column_difference(first, second, size):
    """Of two columns of histories. NaN stands where a row has no such number: in both, or they differ."""
    first, second = numpy.asarray(first), numpy.asarray(second)
    if first.shape != second.shape or not numpy.array_equal(numpy.isnan(first), numpy.isnan(second)):
        return math.inf
    there = ~numpy.isnan(first)
    return largest_difference(first[there], second[there], size) if there.any() else 0.0


def difference(one, other, text):
    """Compares two answers to a case file's text; a NaN of a summary equals nothing."""
    sizes = sizes_of(text, one)
    sizes |= {name: sizes[kind[1]] for name in one.summary  # statistics of a sample
              if (kind := re.fullmatch(r"(\w+)_(mean|deviation|q\d+)", name)) and kind[1] in sizes}
    rows, columns = history_of(one), history_of(other)
    history = max(((column_difference(rows[key], columns[key], sizes.get(key)), key)
                   for key in set(rows) & set(columns) - COST), default=(0.0, "no steps"))
    summary = summary_difference(one, other, sizes)
    for name, value in [*one.physical().items(), *other.physical().items()]:
        if math.isnan(value):
            summary = math.inf, name
    return Difference(summary, history, words_of(one) == words_of(other), set(rows) == set(columns))
