#!/usr/bin/env python3
"""Statistics over random bumps: members, groups of ranks, the limit of a small spread."""

import tempfile

import h5py
import numpy
from gfb_run import Bearing, Checks, case_groups, largest_difference, solve
from strips import HELD, MICROMETRE

SMALL = {"arc_elements": 8, "flat_elements": 2, "axial_elements": 4}
LEVELS = (5, 25, 50, 75, 95)
COUNT = 6
PLACE = ("eccentricity_x", "eccentricity_y", "minimum_gap", "friction_torque", "maximum_pressure")
SMOOTH = ("eccentricity_x", "minimum_gap", "friction_torque")
FOIL = {"youngs_modulus": 2.14e11, "poissons_ratio": 0.29}
BUMPS = 8
HEAT = {"shaft_conductance": 0.3, "sleeve_conductance": 1.0, "bump_conductance": 190.0, "shaft_expansion": 1.2e-5, "cooling_flow": 1.0e-4,
        "channel_conductance": 180.0, "channel_sleeve_conductance": 50.0}
FACTORS = {"thermal%bump_conductance": 2.0, "thermal%shaft_conductance": 3.0, "bearing%clearance": 1.1}


def bearing(folder, name, groups=(), bump_foil=(), ranks=1, options=(), status=0):
    """A small bearing of beams under a load, without friction."""
    shape = Bearing(radius=5.0e-3, length=8.0e-3, clearance=2.0e-5)
    content = case_groups(shape, mesh=(64, 6), foil="beam", load=(-2.0, 0.5), speed_rpm=60000.0, groups={
        "top_foil": {"thickness": 8.0e-5, **FOIL, "fixed_edge": "trailing"},
        "bump_foil": {"thickness": 8.0e-5, **FOIL, "half_length": 1.2e-3, "height": 3.0e-4, "bumps": BUMPS,
                      "fixed_edge": "trailing", "fixed_line": "half_flat", **dict(bump_foil)},
        "mesh": {"arc_elements": 6, "flat_elements": 2}, **dict(groups)})
    return solve(folder, name, content, ranks, options, status)


def random(deviation, seed=5):
    """Keys of random heights."""
    return {"height_deviation": deviation, "seed": seed}


def strip(folder, name, bump_foil=(), groups=(), status=0):
    """A strip of three bumps whose crests all are loaded in the end."""
    content = {"scene": {"analysis": "strip"},
               "bump_foil": {"thickness": 1.0e-4, **FOIL, "half_length": 1.778e-3, "height": 5.08e-4, "pitch": 4.572e-3,
                             "bumps": 3, "width": 1.0e-2, **dict(bump_foil)},
               "strip_load": {"kind": "plates", "maximum_displacement": 20*MICROMETRE, "steps_up": 2, "steps_down": 0,
                              **HELD}, "mesh": SMALL, **dict(groups)}
    return solve(folder, name, content, status=status)


def sampled(count=COUNT):
    """The group of a sample."""
    return {"sample": {"count": count}}


def check_members(checks, folder, many):
    """A member is the single run with its seed; groups and ranks do not matter."""
    rows = many.history()
    checks.that("a row a member, by seeds", list(rows["seed"]) == list(range(5, 5 + COUNT)))
    one = bearing(folder, "alone", bump_foil=random(0.5*MICROMETRE, 7))
    worst = max(abs(rows[name][2]/one[name] - 1.0) for name in PLACE)
    checks.below("a member is the single run with its seed", worst, 1.0e-10)
    for ranks, groups in ((2, 2), (3, 2)):
        other = bearing(folder, "sample", sampled(), random(0.5*MICROMETRE), ranks, ("--groups", str(groups)))
        differ = max(largest_difference(rows[name], other.history()[name]) for name in PLACE)
        checks.below(f"{groups} groups of {ranks} ranks: members", differ, 1.0e-8)
        differ = max(abs(other[f"{name}_deviation"]/many[f"{name}_deviation"] - 1.0) for name in PLACE)
        checks.below(f"{groups} groups of {ranks} ranks: deviations", differ, 1.0e-6)


def check_statistics(checks, many):
    """Mean, deviation and quantiles of the table's own columns, by numpy."""
    rows, off = many.history(), 0.0
    with h5py.File(f"{many.stem}.h5") as file:
        for name in PLACE:
            column = rows[name]
            expected = {"mean": column.mean(), "deviation": column.std(ddof=1),
                        **{f"q{level:02}": numpy.quantile(column, level/100) for level in LEVELS}}
            off = max(off, *(abs(many[f"{name}_{key}"] - value)/abs(column).max() for key, value in expected.items()))
            stored = file[f"sample/{name}/quantiles"][...].ravel()
            off = max(off, largest_difference(stored, [expected[f"q{level:02}"] for level in LEVELS]))
    checks.below("mean, deviation, quantiles: numpy's", off, 1.0e-13)


def check_small_spread(checks, folder):
    """Deviation and shift of the mean (gaps have a mean) are linear in a small spread, what is left of both is quadratic."""
    nominal = bearing(folder, "nominal", {"sensitivity": {"quantity": SMOOTH, "parameters": "bump_foil%crest_gap(:)"}})
    samples = [bearing(folder, f"spread_{spread}", sampled(3), random(spread*MICROMETRE)) for spread in (0.1, 0.01, 0.001)]
    check_adjoint(checks, nominal, samples)
    for name in SMOOTH:
        for words, values in (("deviation", [answer[f"{name}_deviation"] for answer in samples]),
                              ("mean's shift", [answer[f"{name}_mean"] - nominal[name] for answer in samples])):
            checks.below(f"{name}: a tenth of the spread, a tenth of the {words}", 10.0*values[2]/values[1] - 1.0, 2.0e-2)
            left = [wide - 10.0*narrow for wide, narrow in zip(values, values[1:])]
            checks.below(f"{name}: and a hundredth of what is not linear", 100.0*left[1]/left[0] - 1.0, 0.1)


def check_adjoint(checks, nominal, samples):
    """Members, their mean and deviation tend to what the derivatives by single gaps predict, with the square of the spread."""
    gaps = numpy.array([drawn(seed, BUMPS) for seed in (5, 6, 7)])*MICROMETRE
    for name in SMOOTH:
        slope = numpy.array([nominal[f"d_{name}_d_bump_foil_crest_gap_{bump}"] for bump in range(1, BUMPS + 1)])
        off = []
        for spread, answer in zip((0.1, 0.01, 0.001), samples):
            predicted = nominal[name] + spread*gaps @ slope
            size = numpy.ptp(predicted)
            off.append([largest_difference(answer.history()[name], predicted, size),
                        abs(answer[f"{name}_mean"] - predicted.mean())/size,
                        abs(answer[f"{name}_deviation"] - predicted.std(ddof=1))/size])
        for words, values in zip(("members", "mean", "deviation"), zip(*off)):
            checks.below(f"{name}: {words} by the adjoint, spread of a thousandth of a micrometre", values[2], 2.0e-3)
            checks.below(f"{name}: {words} by the adjoint, a tenth of the spread", 10.0*values[2]/values[1] - 1.0, 0.2)


def check_first_order(checks, folder):
    """A strip's force: variance by differences of single gaps, the curvature's share by halved spreads."""
    step, base = 0.02*MICROMETRE, strip(folder, "flat")
    slope = numpy.array([(strip(folder, "one", {"crest_gap": [step if i == bump else 0.0 for i in range(3)]})
                          ["maximum_force"] - base["maximum_force"])/step for bump in range(3)])
    spread = 0.1*MICROMETRE
    rows = strip(folder, "drawn", random(spread, 1), sampled(12))
    predicted = []
    for seed in range(1, 13):
        gaps = numpy.array(drawn(seed, 3))*spread
        predicted.append(base["maximum_force"] + slope @ gaps)
    found = rows.history()["maximum_force"]
    checks.below("strip: members by single gaps", largest_difference(found, predicted, numpy.ptp(predicted)), 1.0e-5)
    checks.below("strip: deviation by single gaps", rows["maximum_force_deviation"]/numpy.std(predicted, ddof=1) - 1.0,
                 1.0e-5)
    checks.that("strip: a quantile of the stiffness", rows["loading_stiffness_q05"] < rows["loading_stiffness_q95"])


def normal(seed, count):
    """Numbers of deviation 1: L'Ecuyer's combined generator, Box and Muller's normal law."""
    modulus, factor = (2147483563, 2147483399), (40014, 40692)
    state = [1 + seed % (modulus[0] - 1), 1 + (seed*69069 + 12345) % (modulus[1] - 1)]

    def uniform():
        for i in range(2):
            state[i] = factor[i]*state[i] % modulus[i]
        return ((state[0] - state[1]) % (modulus[0] - 1) or modulus[0] - 1)/modulus[0]

    for _ in range(20):
        uniform()
    heights = []
    for _ in range(count):
        first, second = uniform(), uniform()
        heights.append(numpy.sqrt(-2.0*numpy.log(first))*numpy.cos(2.0*numpy.pi*second))
    return numpy.array(heights)


def drawn(seed, count):
    """Gaps of heights with deviation 1."""
    heights = normal(seed, count)
    return numpy.max(heights) - heights


def check_vibrations(checks, folder):
    """Members that vibrate: critical mass and growth are those of single runs, and have statistics."""
    groups = {"scene": {"analysis": "linear_dynamics"}, "dynamics": {"frequency_ratios": 0.5}, "rotor": {"mass": 0.3}}
    many = bearing(folder, "many", {**sampled(2), **groups}, random(0.5*MICROMETRE))
    rows = many.history()
    one = bearing(folder, "alone", groups, random(0.5*MICROMETRE, 6))
    entries = [f"{part}_{row}{column}" for part in ("stiffness", "damping") for row in "xy" for column in "xy"]
    for name in ("critical_mass", "whirl_ratio", "growth_rate", *entries):
        checks.below(f"vibrations: {name} of a member", rows[name][1]/one[name] - 1.0, 1.0e-10)
    with h5py.File(f"{one.stem}.h5") as file:
        matrices = numpy.concatenate([file[f"dynamics/{part}"][0, :2, :2].ravel() for part in ("stiffness", "damping")])
    checks.that("vibrations: entries are those of the arrays", matrices.tolist() == [one[name] for name in entries])
    spread = [abs(rows[name][1] - rows[name][0])/numpy.sqrt(2.0)/many[f"{name}_deviation"] - 1.0 for name in entries]
    checks.below("vibrations: deviation of stiffness and damping", max(map(abs, spread)), 1.0e-8)
    checks.below("vibrations: mean critical mass", many["critical_mass_mean"]/rows["critical_mass"].mean() - 1.0, 1.0e-14)


def heated(folder, name, keys=(), groups=(), ranks=1, options=()):
    """A small rigid bearing with heat; keys: other values, by their names."""
    content = case_groups(Bearing(), mesh=(32, 4), number=2.0, load=(-20.0, 0.0), groups={
        "top_foil": {"thickness": 1.0e-4}, "thermal": HEAT, **dict(groups)})
    for key, value in dict(keys).items():
        group, _, word = key.partition("%")
        content[group] = content[group] | {word: value}
    return solve(folder, name, content, ranks, options)


def check_parameters(checks, folder):
    """Keys scatter by their factors; a member is the single run with its values, and groups of ranks do not matter."""
    asked = {"sample": {"count": COUNT, "parameters": list(FACTORS), "factors": list(FACTORS.values())}}
    many = heated(folder, "scattered", groups=asked)
    rows, given = many.history(), {"thermal%bump_conductance": 190.0, "thermal%shaft_conductance": 0.3, "bearing%clearance": Bearing.clearance}
    values = {key: rows[f"value_of_{key.replace('%', '_')}"] for key in FACTORS}
    powers = {key: numpy.log(values[key]/given[key])/numpy.log(factor) for key, factor in FACTORS.items()}
    checks.that("parameters: values lie between the ends", all(abs(power).max() < 1.0 for power in powers.values()))
    spread = numpy.concatenate(list(powers.values()))
    checks.that("parameters: to both sides, no two the same", spread.min() < -0.3 and spread.max() > 0.3 and len(set(spread)) == len(spread))
    one = heated(folder, "single", {key: float(value[3]) for key, value in values.items()})
    names = ("shaft_temperature", "running_clearance", "minimum_gap", "heat_to_channel")
    checks.below("parameters: a member is the single run with its values", max(abs(rows[name][3]/one[name] - 1.0) for name in names), 1.0e-10)
    checks.below("parameters: deviation of the shaft's temperature", many["shaft_temperature_deviation"]/rows["shaft_temperature"].std(ddof=1) - 1.0, 1.0e-9)
    other = heated(folder, "scattered", groups=asked, ranks=2, options=("--groups", "2")).history()
    checks.below("parameters: two groups", max(largest_difference(rows[name], other[name]) for name in (*names, "value_of_bearing_clearance")), 1.0e-8)


def check_no_answer(checks, folder):
    """Members without an answer are named, and not in the statistics."""
    none = bearing(folder, "few", {**sampled(2), "solver": {"maximum_iterations": 1}}, random(0.5*MICROMETRE), status=2)
    checks.that("no answer: counted", none["members"] == 2 and none["converged_members"] == 0)
    checks.that(f"no answer: named: {none['member_1']}", none["member_1"].startswith("seed 5: no answer ("))
    checks.that("no answer: no statistics", "minimum_gap_mean" not in none.summary)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        many = bearing(folder, "sample", sampled(), random(0.5*MICROMETRE))
        check_statistics(checks, many)
        check_members(checks, folder, many)
        check_small_spread(checks, folder)
        check_first_order(checks, folder)
        check_vibrations(checks, folder)
        check_parameters(checks, folder)
        check_no_answer(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
