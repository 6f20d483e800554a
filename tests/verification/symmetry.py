#!/usr/bin/env python3
"""What must not change an answer: half the width, a mirror, other units; and in which sense tilt acts."""

import dataclasses
import tempfile

import numpy

from gfb_run import Bearing, Checks, largest_difference, natural_sizes, run, summary_difference

LIMIT = 1.0e-10
BEARING = Bearing()
STIFFNESS = 2.0*BEARING.ambient_pressure/BEARING.clearance
PLACE = (0.3*BEARING.clearance, 0.5*BEARING.clearance)
LOAD = (-0.4*BEARING.force_unit, 0.1*BEARING.force_unit)


def foundation(pressure):
    """Keys of an elastic foundation."""
    return {"foundation_stiffness": STIFFNESS, "foundation_pressure": pressure}


def check_half_width(checks, folder):
    """Half the width, with symmetry at z = 0, gives the whole bearing's answer."""
    foils = {"rigid": ("rigid", {}), "upwind": ("rigid", {"film_scheme": "supg"}),
             "biquadratic": ("rigid", {"film_order": 2}),
             "biquadratic, local foundation": ("elastic_foundation", {"film_order": 2, **foundation("local")}),
             "biquadratic, mean foundation": ("elastic_foundation", {"film_order": 2, **foundation("axial_mean")}),
             "local foundation": ("elastic_foundation", foundation("local")),
             "mean foundation": ("elastic_foundation", foundation("axial_mean"))}
    for name, (foil, model) in foils.items():
        for operation in ({"load": LOAD}, {"eccentricity": PLACE}):
            answers = [run(folder, f"half_{width}", BEARING, mesh=(64, 16), number=3.0, foil=foil,
                           groups={"model": {"half_width": width, **model}}, **operation)
                       for width in ("yes", "no")]
            words = f"half width, {name}, {next(iter(operation))}"
            difference, worst = summary_difference(*answers, natural_sizes(BEARING))
            checks.below(f"{words}: summary ({worst})", difference, LIMIT)
            checks.that(f"{words}: fewer unknowns", answers[0]["unknowns"] < 0.6*answers[1]["unknowns"])
            half, whole = (answer.film_arrays() for answer in answers)
            checks.below(f"{words}: film", max(largest_difference(half[key], whole[key]) for key in whole), LIMIT)


def check_choice(checks, folder):
    """Half the width is chosen where nothing tilts, and only there."""
    cases = {"nothing tilts": ({}, True), "tilt": ({"tilt": (1.0e-4, 0.0)}, False),
             "tilt sweep": ({"groups": {"sweep": {"parameter": "tilt_y", "values": (0.0, 1.0e-4)}}}, False)}
    for name, (more, half) in cases.items():
        answer = run(folder, "choice", BEARING, mesh=(64, 16), number=3.0, eccentricity=PLACE, **more)
        checks.that(f"{name}: {'half' if half else 'whole'} width", (answer["unknowns"] < 64*16) == half)
    answer = run(folder, "odd", BEARING, mesh=(64, 15), number=3.0, eccentricity=PLACE)
    checks.that("odd number of rows: whole width", answer["unknowns"] > 64*15)


def check_mirror(checks, folder):
    """The tilt's mirror image about z = 0 turns the torque round and mirrors the film."""
    for foil, model in (("rigid", {}), ("elastic_foundation", foundation("local")),
                        ("elastic_foundation", foundation("axial_mean"))):
        for name, operation in (("held", {"eccentricity": PLACE}), ("balanced", {"load": LOAD})):
            answers = [run(folder, f"mirror_{sign}", BEARING, mesh=(64, 15), number=3.0, foil=foil,
                           tilt=(sign*2.0e-4, sign*1.0e-4), groups={"model": model}, **operation)
                       for sign in (1, -1)]
            words = f"mirrored tilt, {foil} {model.get('foundation_pressure', '')} {name}"
            sizes = natural_sizes(BEARING)
            checks.below(f"{words}: torque is odd", numpy.abs(
                answers[0].torque + answers[1].torque).max()/sizes["torque_x"], LIMIT)
            checks.below(f"{words}: force is even", numpy.abs(
                answers[0].force - answers[1].force).max()/sizes["force_x"], LIMIT)
            checks.that(f"{words}: there is a torque", numpy.abs(answers[0].torque).max() > 1.0e-3*sizes["torque_x"])
            first, second = (answer.film_arrays()["pressure"] for answer in answers)
            checks.below(f"{words}: pressure is mirrored", largest_difference(first[:, ::-1], second), LIMIT)


def check_restoring(checks, folder):
    """The film's torque on the shaft grows with the sleeve's tilt against it: it turns the shaft back."""
    for axis, tilt in (("x", (1.0e-4, 0.0)), ("y", (0.0, 1.0e-4))):
        for place in ((0.0, 0.0), PLACE):
            answer = run(folder, "restoring", BEARING, mesh=(64, 16), number=3.0, eccentricity=place, tilt=tilt)
            checks.that(f"torque_{axis} restores at {place}", answer[f"torque_{axis}"] > 0.0)


def check_thinnest(checks, folder):
    """The film is thinnest where eccentricity and tilt bring the shaft near: [Gu2020] eq. 12 as used here."""
    radius, end = 0.5*BEARING.clearance, 0.5*BEARING.length
    answer = run(folder, "thinnest", BEARING, mesh=(64, 16), number=3.0, eccentricity=(radius, 0.0),
                 tilt=(0.0, 2.0e-4))
    film = answer.film_arrays()
    least = numpy.unravel_index(numpy.argmin(film["gap"]), film["gap"].shape)
    checks.below("thinnest film opposite to (e_x, 0)", film["theta"][least] - numpy.pi, 1.0e-12)
    checks.below("and at the end where z tilt_y is positive", film["z"][least] - end, 1.0e-12)
    expected = BEARING.clearance - radius - end*2.0e-4
    checks.below("minimum_gap", answer["minimum_gap"]/expected - 1.0, 1.0e-12)
    checks.below("minimum_gap_edge", answer["minimum_gap_edge"]/expected - 1.0, 1.0e-12)
    checks.below("minimum_gap_midplane", answer["minimum_gap_midplane"]/(BEARING.clearance - radius) - 1.0, 1.0e-12)


# Powers of length, pressure and time in each quantity of the summary that has a unit of its own.
POWERS = {"m": (1, 0, 0), "N": (2, 1, 0), "N m": (3, 1, 0), "W": (3, 1, -1), "Pa": (0, 1, 0), "1": (0, 0, 0),
          "deg": (0, 0, 0)}


def check_units(checks, folder):
    """Other units of length, pressure and time, by powers of two, give the same digits."""
    scales = ((12, 0, 0), (-9, 0, 0), (0, 20, 0), (0, -14, 0), (0, 0, 11), (0, 0, -10), (8, -7, 9))
    for name, pressure in (("rigid", ""), ("local", "local"), ("mean", "axial_mean")):
        first = run(folder, "units", BEARING, **scaled_case((0, 0, 0), pressure))
        for scale in scales:
            length, stress, time = (2.0**power for power in scale)
            bearing = dataclasses.replace(
                BEARING, radius=BEARING.radius*length, length=BEARING.length*length,
                clearance=BEARING.clearance*length, viscosity=BEARING.viscosity*stress*time,
                ambient_pressure=BEARING.ambient_pressure*stress)
            second = run(folder, "scaled", bearing, **scaled_case(scale, pressure))
            sizes, worst = natural_sizes(BEARING), 0.0
            for key, value in first.physical().items():
                unit = 2.0**float(numpy.dot(scale, POWERS[first.units[key]]))
                worst = max(worst, abs(second[key]/unit - value)/sizes.get(key, abs(value)))
            checks.below(f"units x 2^{scale} of length, pressure, time, {name}", worst, LIMIT)


def scaled_case(scale, pressure):
    """A balanced, tilted bearing in other units."""
    length, stress, time = (2.0**power for power in scale)
    case = {"mesh": (64, 8), "tilt": (1.0e-4, 5.0e-5), "speed_rpm": BEARING.speed_rpm(3.0)/time,
            "load": tuple(numpy.array(LOAD)*stress*length**2)}
    if pressure:
        model = foundation(pressure)
        model["foundation_stiffness"] *= stress/length
        case |= {"foil": "elastic_foundation", "groups": {"model": model}}
    return case


def check_turned_load(checks, folder):
    """A load that turns: the answer turns with it where the bearing has no slit; where it has one, each point is that of its own scene."""
    angles = (170.0, 200.0, 260.0, 320.0, 50.0)
    size = float(numpy.hypot(*LOAD))
    turned = [tuple(size*part for part in (numpy.cos(numpy.radians(angle)), numpy.sin(numpy.radians(angle)))) for angle in angles]
    for name, edge in (("no slit", "periodic"), ("a slit", "slit")):
        groups = {"bearing": {"leading_edge_condition": edge}, "model": foundation("axial_mean")}
        more = {"mesh": (72, 8), "number": 3.0, "foil": "elastic_foundation"}
        history = run(folder, "turned", BEARING, load=turned[0], **more,
                      groups={**groups, "sweep": {"parameter": "load_angle", "values": angles}}).history()
        checks.below(f"turned load, {name}: the history has the angles", largest_difference(history["load_angle"], angles), 0.0)
        shaft = (history["eccentricity_x"] + 1j*history["eccentricity_y"])/BEARING.clearance
        with_load = shaft*numpy.exp(-1j*numpy.radians(angles))
        if name == "no slit":
            checks.below("turned load, no slit: the shaft turns with it", numpy.abs(with_load - with_load[0]).max(), LIMIT)
            continue
        checks.that("turned load, a slit: the answer does not turn with it", numpy.abs(with_load - with_load[0]).max() > 1.0e-2)
        for point, load in enumerate(turned):
            alone = run(folder, "alone", BEARING, load=load, groups=groups, **more)
            checks.below(f"turned load, a slit, {angles[point]:g} degrees: the answer of that load",
                         abs(shaft[point]*BEARING.clearance - complex(*alone.eccentricity))/BEARING.clearance, LIMIT)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_half_width(checks, folder)
        check_choice(checks, folder)
        check_mirror(checks, folder)
        check_restoring(checks, folder)
        check_thinnest(checks, folder)
        check_units(checks, folder)
        check_turned_load(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
