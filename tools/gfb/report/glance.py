"""The page's first block: what an engineer asks first, in the units people speak, each with a margin where the case has what it
is measured against."""

import math

from gfb.tables import readable_unit

KELVIN = 273.15
MOST = 1.0e100  # of a number of a case


class Results:
    """Results and keys of one run."""

    def __init__(self, summary, case, place=None, frequency=None):
        self.summary, self.case = summary, case
        self.place = place          # of the thinnest film
        self.frequency = frequency  # of stiffness and damping [rad/s]

    def value(self, name):
        """A number; None where there is none."""
        value = self.summary.get(name, {}).get("value")
        return value if isinstance(value, float) and math.isfinite(value) else None

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


def glance(summary, case, place=None, frequency=None):
    """(what, how much, margin or verdict, whether that is a bad one) of one run; place: where its film is thinnest; frequency: of its
    stiffness and damping [rad/s]."""
    results = Results(summary, case, place, frequency)
    return [row for question in (film, centre, load, limits, losses, balance, vibrations, rotor, foils, heat) for row in question(results)]


def film(results):
    """How thin the film is, and where."""
    words = results.words("minimum_gap")
    if not words:
        return
    where, edge, middle = "", results.value("minimum_gap_edge"), results.value("minimum_gap_midplane")
    if results.place:
        where = results.place.words()
    elif results.value("minimum_gap_radius") is not None:
        where = f"at radius {1.0e3*results.value('minimum_gap_radius'):.3g} mm, {math.degrees(results.value('minimum_gap_angle') or 0.0) % 360.0:.0f} deg"
    elif edge is not None and middle is not None and max(edge, middle) > 1.02*min(edge, middle):
        where = "at the bearing's edge" if edge < middle else "at the midplane"
    rough = results.key("shaft_contact%roughness")
    if rough:
        where += f"{', ' if where else ''}{results.value('minimum_gap')/rough:.3g} times the roughness"
    yield "thinnest film", words, where, False


def centre(results):
    """Where the shaft's centre stands, -e, which is another place than that of the thinnest film."""
    e, angle = direction(results), results.value("attitude_angle")
    if e and angle is not None:
        yield "shaft's centre", f"{1.0e6*e[0]:.4g} um towards {math.degrees(e[1]) % 360.0:.0f} deg", f"attitude angle {angle:.3g} deg from the load", False


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


def load(results):
    """What it carries, and over which area."""
    force = results.value("axial_force")
    if force is not None:
        yield "load on the runner", f"{force:.4g} N", f"{results.words('mean_pressure')} over the pads", False
    elif results.value("force_x") is not None and results.value("force_y") is not None:
        force = math.hypot(results.value("force_x"), results.value("force_y"))
        radius, length = results.key("bearing%radius"), results.key("bearing%length")
        area = f"{1.0e-3*force/(2.0*radius*length):.3g} kPa over length times diameter" if radius and length else ""
        yield "load on the shaft", f"{force:.4g} N", area, False
    if results.value("opposite_force") is not None:
        yield "runner's other side", f"{results.value('opposite_force'):.4g} N", f"{results.words('opposite_gap')} of gap", False
    if results.value("axial_gap") is not None:
        yield "axial gap", results.words("axial_gap"), "", False


def limits(results):
    """Capacity, lift-off and misalignment, against the case's load, speed and tilt."""
    reached = results.value("limit_reached")
    ends = "" if reached is None or reached > 0.0 else "; the branch of answers ends before the limit asked for"
    capacity, wanted = results.value("load_capacity"), carried_by(results.case)
    if capacity is not None:
        margin = f"{capacity/wanted:.3g} times the {wanted:.4g} N of the case" if wanted else ""
        yield "load capacity", f"{capacity:.4g} N", margin + ends, bool(wanted) and capacity < wanted
    lift_off, speed = results.value("lift_off_speed_rpm"), results.key("operation%speed_rpm")
    if lift_off is not None:
        yield "lift-off speed", f"{lift_off:,.0f} rpm", (f"{100.0*lift_off/speed:.3g} % of {speed:,.0f} rpm" if speed else "") + ends, \
            bool(speed) and lift_off > speed
    if results.value("misalignment_allowance") is not None:
        yield "misalignment left", results.words("misalignment_allowance"), ends.lstrip("; "), False


def losses(results):
    """Power and torque."""
    if results.value("power_loss") is not None:
        yield "power loss", f"{results.value('power_loss'):.4g} W", f"friction torque {results.words('friction_torque')}", False


def balance(results):
    """Whether the equilibrium is a stable one, where that was asked."""
    unstable = results.value("stability")
    if unstable is not None:
        yield "foils at rest", "stable" if unstable == 0.0 else "unstable", \
            "" if unstable == 0.0 else f"{-unstable:.0f} ways in which the foils leave this equilibrium", unstable != 0.0


def vibrations(results):
    """All stiffness and damping with the frequency that they hold for, and the mass that whirls."""
    for words, scale, unit in (("stiffness", 1.0e-6, "MN/m"), ("damping", 1.0e-3, "kN s/m")):
        there = [(axes, results.value(f"{words}_{axes}")) for axes in ("xx", "xy", "yx", "yy", "zz")]
        there = [(axes, value) for axes, value in there if value is not None]
        if there:
            yield words, ", ".join(f"{axes} {scale*value:.4g}" for axes, value in there) + f" {unit}", held_at(results), False
    critical, mass = results.value("critical_mass"), results.key("rotor%mass")
    if critical is not None:
        margin = f"the rotor brings {mass:.4g} kg: {'it whirls' if mass > critical else f'{critical/mass:.3g} times that'}" if mass \
            else "a heavier rotor whirls"
        yield "critical mass", f"{critical:.4g} kg", margin, bool(mass) and mass > critical


def held_at(results):
    """The frequency of stiffness and damping, in words; empty where it is not known."""
    frequency = results.frequency
    if frequency is None:
        return ""
    speed = results.key("operation%speed_rpm")
    return f"at {frequency/(2.0*math.pi):.4g} Hz" + (f", {frequency/(speed*math.pi/30.0):.3g} times the speed" if speed and "sweep" not in results.case.groups else "")


def rotor(results):
    """How the rotor's least damped mode goes on, and at which speed it begins to grow."""
    growth = results.value("growth_rate")
    if growth is not None:
        frequency = results.value("whirl_frequency") or results.value("axial_frequency")
        damped = results.value("damping_ratio")
        words = f"{frequency/(2.0*math.pi):.4g} Hz" if frequency else ""
        ratio = f", damping ratio {damped:.3g}" if damped is not None else ""
        yield "rotor's least damped mode", words, ("dies out" if growth < 0.0 else "grows") + ratio, growth >= 0.0
    onset, speed = results.value("onset_speed_rpm"), results.key("operation%speed_rpm")
    if onset is not None:
        yield "onset of whirl", f"{onset:,.0f} rpm", f"{onset/speed:.3g} times {speed:,.0f} rpm" if speed else "", False


def foils(results):
    """How far the foils deflect, and how much of them is idle."""
    lifted = results.value("lifted_length")
    idle = "" if lifted is None else f"{100.0*lifted:.3g} % of their length"
    if (results.value("maximum_deflection") or 0.0) > 0.0:
        yield "foil gives way by", results.words("maximum_deflection"), "", False
    if idle:
        yield "crests that touch nothing", idle, "", False
    for words, name in (("largest stress of the top foil", "maximum_top_foil_stress"), ("largest stress of the bumps", "maximum_bump_foil_stress")):
        if results.value(name) is not None:
            yield words, results.words(name), "von Mises", False


def heat(results):
    """How hot it gets, and what clearance is left."""
    for words, name in (("hottest film", "maximum_film_temperature"), ("shaft", "shaft_temperature"), ("sleeve", "sleeve_temperature")):
        if results.value(name) is not None:
            yield words, f"{results.value(name) - KELVIN:.4g} °C", "", False
    if results.value("running_clearance") is not None:
        cold = results.key("bearing%clearance")
        yield "clearance when it runs", results.words("running_clearance"), f"{1.0e6*cold:.4g} um cold" if cold else "", False
