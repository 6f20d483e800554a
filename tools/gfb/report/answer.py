"""Results and keys of one run, and what pages, the studio and the terminal say of them in the same words."""

import math

from gfb.tables import readable_unit

KELVIN = 273.15
MOST = 1.0e100  # of a number of a case
STOPPED = ("stopped", "out_of_time")  # outcomes of runs that did not come to their end
LAST_STATE = "the last state reached"  # whose numbers a run without an answer has
THINNEST = "thinnest film"


class Results:
    """Results and keys of one run."""

    def __init__(self, summary, case, place=None, frequency=None, machine=None):
        self.summary, self.case = summary, case
        self.machine = machine      # of a machine: what stands in its file alone
        self.place = place          # of the thinnest film
        self.frequency = frequency  # of stiffness and damping [rad/s]

    def value(self, name):
        """A number; None where there is none."""
        value = self.summary.get(name, {}).get("value")
        return value if isinstance(value, float) and math.isfinite(value) else None

    def count(self, name):
        """A number of things; 0 where there is none."""
        return round(self.value(name) or 0.0)

    def key(self, name, default=None):
        """A number of the case; what is none, of a case that is not gfb's, is not there."""
        value = self.case.get(name)
        return float(value) if is_number(value) else default

    def pair(self, name):
        """Two numbers of the case; None where there are none."""
        value = self.case.get(name)
        return value if isinstance(value, tuple) and len(value) == 2 and all(map(is_number, value)) else None

    def words(self, name):
        """A result in readable units, with its error where that is known; empty where there is none."""
        value = self.value(name)
        if value is None:
            return ""
        unit, scale = readable_unit(self.summary[name]["unit"], name)
        error = self.value(f"{name}_error")
        return f"{scale*value:.4g}" + (f" ± {scale*error:.2g}" if error is not None else "") + (f" {unit}" if unit != "1" else "")


def is_number(value):
    """Whether a value of a case is one that can be computed with."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= MOST


def direction(results):
    """How far a journal's centre stands from the sleeve's [m], and where to [rad]; None without one."""
    e = results.value("eccentricity_x"), results.value("eccentricity_y")
    if None in e or not math.hypot(*e) > 0.0:
        return None
    return math.hypot(*e), math.atan2(-e[1], -e[0])


def carried_by(case):
    """The load of a case [N]; None without one."""
    results = Results({}, case)
    axial = results.key("operation%axial_load")
    if axial is not None:
        return abs(float(axial))
    both = results.pair("operation%load")
    return math.hypot(*both) if both else None


def film_words(gap, where=""):
    """A thinnest film [m], and where it is."""
    return f"{THINNEST} {1.0e6*gap:.4g} um{' '*bool(where)}{where}"


def place_words(results):
    """Where the film of an answer is thinnest; empty where that is not known."""
    if results.place:
        return results.place.words()
    radius, edge, middle = (results.value(f"minimum_gap_{name}") for name in ("radius", "edge", "midplane"))
    if radius is not None:
        return f"at radius {1.0e3*radius:.3g} mm, {math.degrees(results.value('minimum_gap_angle') or 0.0) % 360.0:.0f} deg"
    if edge is not None and middle is not None and max(edge, middle) > 1.02*min(edge, middle):
        return "at the bearing's edge" if edge < middle else "at the midplane"
    return ""


def why_none(summary):
    """Why a run has no answer, in words; summary: {name: {"value": ...}}."""
    outcome, reason = (str(summary.get(name, {}).get("value", "")) for name in ("outcome", "reason"))
    return ": ".join(filter(None, (outcome.replace("_", " "), reason)))


def ended(summary):
    """How a run without an answer ended, in a sentence."""
    outcome, reason = (summary.get(name, {}).get("value", "") for name in ("outcome", "reason"))
    begin = "Stopped before there was an answer" if outcome in STOPPED else "No answer was found"
    return f"{begin}{f' ({reason})' if reason else ''}: the numbers are those of {LAST_STATE}."
