"""The page's first block: what an engineer asks first, in the units people speak, each with a margin where the case has what it
is measured against."""

import math

from gfb.report.answer import KELVIN, THINNEST, Results, direction, place_words
from gfb.report.machine import is_machine, machine_glance
from gfb.report.margin import ONSET
from gfb.report.verdict import FILM, HEAT, LOWEST_SUPPLY, STRESS, all_margins

ROUND_OFF = 1.0e-9  # of a flow [Pa m3/s]


def glance(summary, case, place=None, frequency=None, machine=None):
    """(what, how much, margin or verdict, whether that is a bad one) of one run; place: where its film is thinnest; frequency: of its
    stiffness and damping [rad/s]; machine: tables of a machine."""
    results = Results(summary, case, place, frequency, machine)
    if is_machine(case):
        return list(machine_glance(results))
    return [row for question in (film, centre, load, limits, losses, supply, grooves, balance, vibrations, rotor, foils, heat) for row in question(results)]


def film(results):
    """How thin the film is, and where."""
    words = results.words("minimum_gap")
    if not words:
        return
    where = place_words(results)
    rough = results.key("shaft_contact%roughness")
    if rough:
        where += f"{', ' if where else ''}{results.value('minimum_gap')/rough:.3g} times the roughness"
    margin, is_broken = against(results, FILM)
    yield THINNEST, words, "; ".join(filter(None, (where, margin))), is_broken


def centre(results):
    """Where the shaft's centre stands, -e, which is another place than that of the thinnest film."""
    e, angle = direction(results), results.value("attitude_angle")
    if e and angle is not None:
        yield "shaft's centre", f"{1.0e6*e[0]:.4g} um towards {math.degrees(e[1]) % 360.0:.0f} deg", f"attitude angle {angle:.3g} deg from the load", False


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


def against(results, name):
    """What a result is measured against and by how much it keeps that, and whether it breaks it."""
    return next(((f"{one.against}{f' ({one.where})' if one.where else ''}", one.is_broken) for one in all_margins(results) if one.result == name), ("", False))


def allowed(results, name):
    """A row of what the case allows, and how far it is kept; nothing where the case says nothing."""
    for one in all_margins(results):
        if one.result == name:
            yield f"allowed {one.subject}", one.value, *against(results, name)


def limits(results):
    """Capacity, lift-off and misalignment, against the case's load, speed and tilt."""
    reached = results.value("limit_reached")
    ends = "" if reached is None or reached > 0.0 else "; the branch of answers ends before the limit asked for"
    for words, name in (("load capacity", "load_capacity"), ("lift-off speed", "lift_off_speed_rpm")):
        if results.value(name) is not None:
            margin, is_broken = against(results, name)
            yield words, f"{results.value(name):.4g} N" if name == "load_capacity" else f"{results.value(name):,.0f} rpm", (margin + ends).removeprefix("; "), is_broken
    if results.value(LOWEST_SUPPLY) is not None:
        margin, is_broken = against(results, LOWEST_SUPPLY)
        yield "lift-off supply pressure", f"{1.0e-5*results.value(LOWEST_SUPPLY):.4g} bar", (margin + ends).removeprefix("; "), is_broken
    if results.value("misalignment_allowance") is not None:
        yield "misalignment left", results.words("misalignment_allowance"), ends.lstrip("; "), False


def losses(results):
    """Power and torque."""
    if results.value("power_loss") is not None:
        yield "power loss", f"{results.value('power_loss'):.4g} W", f"friction torque {results.words('friction_torque')}", False


def supply(results):
    """What feeds the film: how much gas, the power to compress it, how its orifices do."""
    if results.value("supply_flow") is None:
        return
    choked, back = (results.count(f"{name}_orifices") for name in ("choked", "backflow"))
    more = [f"{results.words('supply_power')} to compress it"] + [f"{choked} orifices choked"]*bool(choked) + [f"gas leaves the film through {back}"]*bool(back)
    yield "supply", results.words("supply_flow"), ", ".join(more), False


def grooves(results):
    """How far grooves pump the film up, and what flows out of its ends."""
    if results.value("pumped_pressure") is None:
        return
    flows = abs(results.value("flow_low") or 0.0) > ROUND_OFF
    yield "pumped up by grooves", results.words("pumped_pressure"), f"{results.words('flow_high')} flow to larger z or radius" if flows else "", False


def balance(results):
    """Whether the equilibrium is a stable one, where that was asked."""
    unstable = results.value("stability")
    if unstable is not None:
        _, is_broken = against(results, "stability")
        yield "foils at rest", "unstable" if is_broken else "stable", f"{-unstable:.0f} ways in which the foils leave this equilibrium" if is_broken else "", is_broken


def vibrations(results):
    """All stiffness and damping with the frequency that they hold for, and the mass that whirls."""
    for words, scale, unit in (("stiffness", 1.0e-6, "MN/m"), ("damping", 1.0e-3, "kN s/m")):
        there = [(axes, results.value(f"{words}_{axes}")) for axes in ("xx", "xy", "yx", "yy", "zz")]
        there = [(axes, value) for axes, value in there if value is not None]
        if there:
            yield words, ", ".join(f"{axes} {scale*value:.4g}" for axes, value in there) + f" {unit}", held_at(results), False
    critical = results.value("critical_mass")
    if critical is not None:
        margin, is_broken = against(results, "critical_mass")
        heavier = "a heavier rotor whirls" if results.value("axial_gap") is None else "a heavier runner hammers along the axis"
        yield "critical mass", f"{critical:.4g} kg", margin or heavier, is_broken


def held_at(results):
    """The frequency of stiffness and damping, in words; empty where it is not known."""
    frequency = results.frequency
    if frequency is None:
        return ""
    speed = results.key("operation%speed_rpm")
    return f"at {frequency/(2.0*math.pi):.4g} Hz" + (f", {frequency/(speed*math.pi/30.0):.3g} times the speed" if speed and "sweep" not in results.case.groups else "")


def rotor(results):
    """How the rotor's least damped mode goes on, and at which speed it begins to grow."""
    if results.value("growth_rate") is not None:
        frequency = results.value("whirl_frequency") or results.value("axial_frequency")
        yield "rotor's least damped mode", f"{frequency/(2.0*math.pi):.4g} Hz" if frequency else "", *against(results, "growth_rate")
    onset = results.value(ONSET)
    if onset is not None:
        yield "onset of whirl", f"{onset:,.0f} rpm", *against(results, ONSET)


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
    yield from allowed(results, STRESS)


def heat(results):
    """How hot it gets, and what clearance is left."""
    for words, name in (("hottest film", "maximum_film_temperature"), ("shaft", "shaft_temperature"), ("sleeve", "sleeve_temperature")):
        if results.value(name) is not None:
            yield words, f"{results.value(name) - KELVIN:.4g} °C", "", False
    yield from allowed(results, HEAT)
    if results.value("running_clearance") is not None:
        cold = results.key("bearing%clearance")
        yield "clearance when it runs", results.words("running_clearance"), f"{1.0e6*cold:.4g} um cold" if cold else "", False
    if results.value("running_play") is not None:
        yield "its play under the preload", results.words("running_play"), "on foils at rest", False
