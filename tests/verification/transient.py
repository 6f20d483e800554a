#!/usr/bin/env python3
"""A shaft over time: an orbit whose force is known exactly, the linear theory of small motions, the rotor's own balance,
an independent program's orbits (with --long), and what must not matter.

Full ring: on a circle of frequency w the film's force is that of a steady film at the speed Omega - 2 w, turning with it,
at any amplitude; there is none at w = Omega/2.

Small motions in equal steps D obey the same difference formula in all unknowns, so a mode of rate lambda goes as z^n with
lambda = (3 - 4/z + 1/z^2)/(2 D): a growth rate is compared without any error of the steps.
"""

import json
import math
import pathlib

import h5py
import numpy

from dynamics import FOIL_BEARING, RING, beams
from gfb_run import case_groups, largest_difference, observed_order, run_checks, run_file, solve
from rotor import modes_of, rotor_case, speed_of

ORBITS = json.loads((pathlib.Path(__file__).parent/"reference/orbits.json").read_text(encoding="utf-8"))["orbits"]
MESH = (32, 4)
TIGHT = {"residual_tolerance": 1.0e-12, "step_tolerance": 1.0e-13}
ORDER = (1.8, 2.2)
NAMES = ("time", "turns", "speed", "eccentricity_x", "eccentricity_y", "velocity_x", "velocity_y", "force_x", "force_y",
         "load_x", "load_y", "minimum_gap", "maximum_pressure", "step", "stored_gas", "gas_outflow")


def history(answer):
    """All rows over time, one array a name."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        return {name: values[...] for name, values in file["transient"].items()}


def plane(rows, name):
    """Both components of a history as complex numbers."""
    return rows[f"{name}_x"] + 1j*rows[f"{name}_y"]


def rate(rows, values):
    """Backward difference of second order over the rows' steps, from the third row on."""
    step = numpy.diff(rows["time"])
    ratio = step[1:]/step[:-1]
    newest, oldest = (1.0 + 2.0*ratio)/((1.0 + ratio)*step[1:]), ratio**2/((1.0 + ratio)*step[1:])
    return newest*(values[2:] - values[1:-1]) + oldest*(values[:-2] - values[1:-1])


def ring_case(ratio, steps, radius, turns=2.0):
    """A full ring whose sleeve goes round on a circle."""
    content = case_groups(RING, mesh=(48, 8), number=1.0, eccentricity=(0.0, 0.0), groups={"model": {"film_order": 2}})
    content["scene"]["analysis"] = "transient"
    content["transient"] = {"turns": turns, "steps_per_turn": steps, "orbit_radius": radius,
                            "orbit_frequency": ratio*speed_of(content)}
    return content


def check_ring(checks, folder):
    """The exact orbit: order of the steps, the value they tend to, no force at half the speed."""
    radius, ratio = 0.4*RING.clearance, 0.3
    steady = case_groups(RING, mesh=(48, 8), number=1.0 - 2.0*ratio, eccentricity=(radius, 0.0),
                         groups={"model": {"film_order": 2}})
    force = solve(folder, "steady", steady).force
    exact = complex(*force)
    found = []
    for steps in (60, 120, 240):
        rows = history(solve(folder, "ring", ring_case(ratio, steps, radius)))
        found.append(plane(rows, "force")[-1]/(plane(rows, "eccentricity")[-1]/radius))
    place = case_groups(RING, mesh=(48, 8), number=1.0, eccentricity=(radius, 0.0), groups={"model": {"film_order": 2}})
    first = complex(*solve(folder, "place", place).force)
    checks.below("ring: it begins with the steady film of its first place", abs(plane(rows, "force")[0]/first - 1.0), 1.0e-8)
    order = observed_order(abs(found[0] - found[1]), abs(found[1] - found[2]))
    checks.within("ring: order of the steps", order, *ORDER)
    limit = (4.0*found[2] - found[1])/3.0
    checks.below("ring: force of the turning steady film", abs(limit - exact)/abs(exact), 3.0e-4)
    half = [abs(plane(history(solve(folder, "half", ring_case(0.5, steps, radius))), "force")[-1])/abs(exact)
            for steps in (60, 120)]
    checks.below("ring: force at half the speed", half[1], 2.0e-3)
    checks.within("ring: its order", observed_order(*half), *ORDER)


def foil_case(mass, load, mesh=MESH, name="PT1", **keys):
    """A rotor on damped springs, over time."""
    one = {"name": name, "case": ORBITS[name]["case"], "operation": {"load": load}}
    content = rotor_case(one, mass, mesh=mesh)
    linear = {group: dict(values) for group, values in content.items()}
    damping = content.pop("dynamics")["foundation_damping"]
    content["scene"]["analysis"] = "transient"
    content["transient"] = {"foundation_damping": damping, **keys}
    return content, linear


def check_rows(checks, rows, mass):
    """What the rows say of each other: the shaft's equation of motion, and its work."""
    checks.that("names of the history", set(NAMES) <= set(rows) and len({len(row) for row in rows.values()}) == 1)
    place, velocity = plane(rows, "eccentricity"), plane(rows, "velocity")
    size = numpy.abs(velocity).max()
    checks.below("velocity is the rate of the position", numpy.abs(rate(rows, place) - velocity[2:]).max()/size, 1.0e-6)
    missing = plane(rows, "force") - plane(rows, "load")
    size = numpy.abs(missing).max()
    checks.below("force, load and inertia balance", numpy.abs(mass*rate(rows, velocity) - missing[2:]).max()/size, 1.0e-6)
    checks.below("work is kinetic energy", numpy.abs(missing_energy(rows, mass)).max(), 5.0e-3)


def missing_energy(rows, mass):
    """Kinetic energy of the shaft less the work of the film and of the outer forces so far, over the largest energy."""
    velocity = plane(rows, "velocity")
    # The shaft moves against the sleeve, and the force on it is the reaction: twice the same sign.
    power = ((plane(rows, "force") - plane(rows, "load"))*velocity.conj()).real
    work = numpy.concatenate(([0.0], numpy.cumsum(0.5*(power[1:] + power[:-1])*numpy.diff(rows["time"]))))
    energy = 0.5*mass*numpy.abs(velocity)**2
    return (energy - energy[0] - work)/energy.max()


def stepped(free, step):
    """The rate with which a mode goes in equal steps: the reverse of the formula above."""
    return -numpy.log(2.0 - numpy.sqrt(1.0 + 2.0*complex(free)*step))/step


def harmonic(rows, omega, free, turns):
    """Mean and first harmonic of the last turns [m], x and y, beside free modes that die out."""
    kept = rows["turns"] > rows["turns"][-1] - turns
    time = rows["time"][kept] - rows["time"][-1]
    free = [stepped(one, rows["step"][-1]) for one in free]
    columns = numpy.array([numpy.ones_like(time), numpy.cos(omega*time), numpy.sin(omega*time)]
                          + [part for one in free for part in ((numpy.exp(one*time)).real, (numpy.exp(one*time)).imag)]).T
    parts = [numpy.linalg.lstsq(columns, rows[f"eccentricity_{axis}"][kept], rcond=None)[0] for axis in "xy"]
    first = numpy.array([part[1] - 1j*part[2] for part in parts])*numpy.exp(-1j*omega*rows["time"][-1])
    return numpy.array([part[0] for part in parts]), first


def slow_modes(answer, omega):
    """Rates of the modes that are seen longest [1/s]."""
    growth, frequency, *_ = modes_of(answer)
    slow = (frequency > 0.0) & (growth > -0.5*omega)
    return growth[slow] + 1j*frequency[slow]


def check_gas(checks, words, rows):
    """What the film holds changes by what flows out, over a turn and over every step."""
    missing = (rate(rows, rows["stored_gas"]) + rows["gas_outflow"][2:])*rows["step"][2:]/rows["stored_gas"].mean()
    turn = rows["turns"][2:] > rows["turns"][-1] - 1.0 - 1.0e-9
    checks.below(f"gas, {words}: balance over a turn", abs(missing[turn].sum()), 1.0e-12)
    checks.below(f"gas, {words}: balance of each step", numpy.abs(missing).max(), 1.0e-12)
    checks.that(f"gas, {words}: it does go in and out", numpy.ptp(rows["stored_gas"])/rows["stored_gas"].mean() > 1.0e-9)


def check_unbalance(checks, folder):
    """Response to a small unbalance: that of Z at the same mesh."""
    mass, unbalance = 0.1, 1.0e-9
    content, linear = foil_case(mass, (-20.0, 0.0), name="PT2", turns=6, unbalance=unbalance)
    omega = speed_of(content)
    linear["dynamics"]["frequencies"] = (omega,)
    answer = solve(folder, "linear", linear)
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        stiffness, damping = (file[f"dynamics/{name}"][0, :2, :2] for name in ("stiffness", "damping"))
    drive = unbalance*omega**2*numpy.array([1.0, -1.0j])
    wanted = -numpy.linalg.solve(stiffness + 1j*omega*damping - mass*omega**2*numpy.eye(2), drive)
    found = []
    for steps in (100, 200):
        content["transient"]["steps_per_turn"] = steps
        rows = history(solve(folder, "unbalance", content))
        found.append(harmonic(rows, omega, slow_modes(answer, omega), 2.0)[1])
    check_rows(checks, rows, mass)
    check_gas(checks, "small motion", rows)
    size = numpy.linalg.norm(wanted)
    checks.below("unbalance: response of the linear theory",
                 numpy.linalg.norm((4.0*found[1] - found[0])/3.0 - wanted)/size, 1.0e-4)
    checks.below("unbalance: with 200 steps a turn", numpy.linalg.norm(found[1] - wanted)/size, 5.0e-3)


def modes_in(rows, turns, count=1, name="eccentricity"):
    """Rates of the modes that a free motion ends in, from rows at equal steps: the least damped one first."""
    kept = rows["turns"] > rows["turns"][-1] - turns
    motion = [numpy.diff(rows[f"{name}_{axis}"][kept]) for axis in "xy"] # the equilibrium drops out
    order = 2*count
    before = numpy.concatenate([numpy.array([one[order - i:len(one) - i] for i in range(1, order + 1)]).T for one in motion])
    after = numpy.concatenate([one[order:] for one in motion])
    z = numpy.roots(numpy.concatenate(([1.0], -numpy.linalg.lstsq(before, after, rcond=None)[0])))
    rates = (3.0 - 4.0/z + 1.0/z**2)/(2.0*rows["step"][-1])
    return sorted(rates[rates.imag > 0.0], key=lambda one: -one.real)


def check_growth(checks, folder):
    """A pushed shaft: growth and frequency of the linear theory, none at the critical mass, which the march itself tells."""
    upwind = {"film_order": 1, "film_scheme": "supg"}
    cases = (("above the critical mass", 1.1, {}), ("at it", 1.0, {}), ("SUPG", 1.1, upwind),
             ("local springs, SUPG", 1.1, upwind | {"foundation_pressure": "local"}), ("rigid pad", 1.1, {"foil": "rigid"}))
    for words, share, model in cases:
        content, linear = foil_case(0.3, (-20.0, 0.0), name="PT2", turns=10, steps_per_turn=60)
        omega = speed_of(content)
        for one in (content, linear):
            one["model"].update(model)
            if model.get("foil") == "rigid":
                del one["model"]["foundation_stiffness"], one["model"]["foundation_pressure"]
        if model.get("foil") == "rigid":
            del content["transient"]["foundation_damping"], linear["dynamics"]["foundation_damping"]
        mass = share*solve(folder, "critical", linear)["critical_mass"]
        linear["rotor"]["mass"] = content["rotor"]["mass"] = mass
        answer = solve(folder, "mode", linear)
        push = 1.0e-4*31.8e-6*mass*0.5*omega
        content["transient"] |= {"pulse": (push, 0.0), "pulse_length": 2.0*math.pi/omega}
        march = solve(folder, "growth", content)
        checks.below(f"push, {words}: the march tells the critical mass", march["critical_mass"]/answer["critical_mass"] - 1.0, 1.0e-9)
        if abs(share - 1.0) > 0.01:
            checks.that(f"push, {words}: and that the first point is unstable", f"linearly unstable: the mass of {mass:.4g} kg" in march.log)
        found = modes_in(history(march), 4.0)[0]/omega
        checks.below(f"push, {words}: growth over the speed", found.real - answer["growth_rate"]/omega, 2.0e-5)
        checks.below(f"push, {words}: frequency over the speed", found.imag - answer["whirl_frequency"]/omega, 2.0e-5)


def check_beams(checks, folder):
    """Beams that do not rub: both modes of a pushed shaft are those of the linear theory."""
    beam = beams(0.0)
    groups = {group: dict(keys) for group, keys in beam["groups"].items()}
    del groups["model"]
    mass = 0.8
    linear = case_groups(FOIL_BEARING, beam["mesh"], "beam", load=(-60.0, 0.0), speed_rpm=beam["speed_rpm"],
                         groups=groups | {"rotor": {"mass": mass}})
    omega = speed_of(linear)
    content = {group: dict(keys) for group, keys in linear.items()}
    linear["scene"]["analysis"] = "linear_dynamics"
    linear["dynamics"] = {"frequencies": (omega,), "foil_mass": "off"}
    content["scene"]["analysis"] = "transient"
    content["solver"] = TIGHT
    content["transient"] = {"turns": 8, "steps_per_turn": 60, "pulse_length": 2.0*math.pi/omega,
                            "pulse": (1.0e-5*FOIL_BEARING.clearance*mass*0.5*omega, 0.0)}
    wanted = sorted(slow_modes(solve(folder, "beams", linear), omega), key=lambda one: -one.real)
    found = modes_in(history(solve(folder, "beams_pushed", content)), 6.0, 2)
    for number, (one, other) in enumerate(zip(found, wanted), 1):
        checks.below(f"beams: mode {number} over the speed", abs(one - other)/omega, 2.0e-4)
    checks.that("beams: two modes", min(len(found), len(wanted)) >= 2)


def check_same(checks, folder):
    """Rest stays rest; ranks."""
    content, _ = foil_case(0.3, (-60.0, 0.0), turns=1, steps_per_turn=60)
    rows = history(solve(folder, "rest", content))
    checks.below("without a drive nothing moves", numpy.ptp(rows["eccentricity_x"])/31.8e-6, 1.0e-9)
    content["transient"] |= {"unbalance": 1.0e-6}
    one, two = (history(solve(folder, "ranks", content, ranks)) for ranks in (1, 2))
    content["transient"]["unsolved_part"] = 0.0
    last = history(solve(folder, "last_digits", content))
    part = abs(plane(one, "eccentricity") - plane(last, "eccentricity")).max()/numpy.ptp(last["eccentricity_x"])
    spent = (one["newton_iterations"][-1] - one["newton_iterations"][0])/(last["newton_iterations"][-1] - last["newton_iterations"][0])
    checks.that(f"steps solved to a part of their error: {spent:.2f} of the iterations, {part:.1e} of the orbit", spent < 0.8 and 0.0 < part < 1.0e-4)
    content["solver"] = {"step_tolerance": 1.0e-9}
    del content["transient"]["unsolved_part"]
    given = history(solve(folder, "given", content))
    checks.that("a tolerance that is given holds: the same digits", numpy.array_equal(plane(given, "eccentricity"), plane(last, "eccentricity")))
    again = history(run_file(folder/"ranks.used.nml", folder))
    checks.that("an echo is read as its case was", numpy.array_equal(plane(again, "eccentricity"), plane(one, "eccentricity")))
    checks.below("two ranks: positions", largest_difference(
        plane(one, "eccentricity"), plane(two, "eccentricity"), 31.8e-6), 1.0e-8)
    checks.below("two ranks: forces", largest_difference(plane(one, "force"), plane(two, "force"), 60.0), 1.0e-7)


def check_steps(checks, folder):
    """A smooth push: steps that the error chooses end where equal ones tend to, which are of order 2."""
    mass = 0.3
    content, _ = foil_case(mass, (-60.0, 0.0), turns=1, time_tolerance=1.0e-7)
    omega = speed_of(content)
    content["transient"] |= {"pulse": (0.05*31.8e-6*mass*omega, 0.0), "pulse_length": 1.2*math.pi/omega}
    content["solver"] = TIGHT # what Newton's method leaves is gas, too
    chosen = history(solve(folder, "chosen", content))
    check_gas(checks, "large motion, steps by the error", chosen)
    checks.that("steps by the error: at least 60 a turn, and they change",
                chosen["step"].max() <= 2.0*math.pi/omega/60.0*(1.0 + 1.0e-9) and numpy.ptp(chosen["step"][1:]) > 0.0)
    del content["transient"]["time_tolerance"]
    ends, energy = [], []
    for steps in (60, 120, 240, 480): # the energy's order shows from 240 on
        content["transient"] |= {"steps_per_turn": steps}
        rows = history(solve(folder, "equal", content))
        ends.append(plane(rows, "eccentricity")[-1])
        energy.append(abs(missing_energy(rows, mass)[-1]))
    checks.within("equal steps: order of the energy that is missing after a turn", observed_order(*energy[2:]), *ORDER)
    checks.below("equal steps: that energy with 480 steps", energy[3], 1.0e-4)
    checks.within("equal steps: their order", observed_order(abs(ends[1] - ends[0]), abs(ends[2] - ends[1])), *ORDER)
    checks.below("steps by the error: where the shaft ends",
                 abs(plane(chosen, "eccentricity")[-1] - (4.0*ends[2] - ends[1])/3.0)/31.8e-6, 2.0e-5)


def check_touch_down(checks, folder):
    """A shaft that is pushed into its foil stops there, however seldom a line is written, and says that it has not reached what
    it was asked for; resumed from a restart file it ends in the same way, and an orbit may be given a limit before."""
    mass, ends, keys = 0.3, [], ("turns", "time_steps", "minimum_gap_over_time", "critical_mass", "not_reached", "ending")
    for every in (1, 1000):
        content, _ = foil_case(mass, (-60.0, 0.0), turns=1, output_every=every)
        omega = speed_of(content)
        content["transient"] |= {"pulse": (-6.0*31.8e-6*mass*omega, 0.0), "pulse_length": 0.6*math.pi/omega}
        content["solver"] = {"touch_down_gap": 5.0e-6}
        content["output"] = {"restart_every": 7}
        ends.append(solve(folder, "touch_down", content, status=2))
    one = ends[0]
    checks.that("touch-down: the shaft does", history(one)["turns"][-1] < 0.9)
    checks.that("touch-down: what was asked for is not reached", one["converged"] == "false" and one["not_reached"] == "1 turns"
                and one["ending"] == "the shaft touches down" and "not reached: 1 turns: the shaft touches down at time" in one.log)
    checks.that("touch-down: that begins the summary, behind how the run ended",
                list(one.summary)[:6] == ["analysis", "converged", "outcome", "reason", "not_reached", "ending"])
    checks.that("touch-down: at a film that still bears", "warning: touch_down_gap = 5e-6 m in &solver" in one.log)
    checks.that("touch-down: from a point that is stable", one["critical_mass"] > mass and "is linearly stable: the mass of" in one.log)
    again = solve(folder, "touch_down", content, options=["--restart"], status=2)
    checks.that("touch-down: resumed", "restart: resumed from time" in again.log)
    for words, other in (("with few lines", ends[1]), ("resumed", again)):
        checks.that(f"touch-down: the same {words}", all(other[name] == one[name] for name in keys))
    content["transient"] |= {"largest_orbit": 5.0e-6}
    checks.that("a limit of the orbit that was asked for is reached", solve(folder, "limit", content)["ending"]
                == "the orbit has grown beyond its limit")


def extent(rows, name):
    """Extent of a motion over the last turn, on parabolas through each row and the two before."""
    time, values = rows["time"], rows[name]
    begin = numpy.interp(rows["turns"][-1] - 1.0, rows["turns"], time)
    found = []
    for i in range(2, len(time)):
        unit = time[i] - time[i - 1]
        parabola = numpy.polynomial.Polynomial(numpy.linalg.solve(
            numpy.vander((time[i - 2:i + 1] - time[i - 1])/unit, increasing=True), values[i - 2:i + 1]))
        first = max(begin, time[i - 1])
        if first < time[i]:
            inside = [1.0, *parabola.deriv().roots()]
            found += [parabola(one) for one in inside if (first - time[i - 1])/unit <= one <= 1.0]
            found.append(parabola((first - time[i - 1])/unit))
    return max(found) - min(found)


def check_lines(checks, folder):
    """Few lines and many: the same orbit, the same end; a spectrum as far as the lines resolve it; long histories are compressed."""
    found = {}
    for every in (1, 16, 80):
        content, _ = foil_case(0.3, (-60.0, 0.0), turns=40, steps_per_turn=80, unbalance=1.0e-6, steady_tolerance=1.0e-7,
                               output_every=every)
        found[every] = solve(folder, f"lines_{every}", content)
    omega, one = speed_of(content), found[1]
    checks.that(f"lines: the orbit is steady after {one['turns']:.1f} turns", one["ending"] == "the orbit is steady" and one["turns"] < 20.0)
    same = ("turns", "time_steps", "orbit_x", "orbit_y", "minimum_gap_over_time", "ending", "eccentricity_x")
    for every in (16, 80):
        checks.that(f"lines: every {every} steps the same summary", all(found[every][name] == one[name] for name in same))
    rows = history(one)
    checks.below("lines: extents", abs(one["orbit_x"]/extent(rows, "eccentricity_x") - 1.0), 1.0e-10)
    with h5py.File(f"{found[16].stem}.h5", "r") as file:
        frequency = file["spectrum/frequency"][0, -1]*2.0*math.pi/omega
    checks.below("lines: five a turn, and the spectrum ends at 2.5 times the speed", abs(frequency - 2.5), 1.0e-6)
    with h5py.File(f"{found[80].stem}.h5", "r") as file:
        checks.that("lines: one a turn, and no spectrum", "spectrum" not in file)
    checks.that("lines: the log says so", "no spectrum: less than two lines a turn, with output_every = 80" in found[80].log)
    with h5py.File(f"{one.stem}.h5", "r") as file:
        for name, values in file["transient"].items():
            checks.that(f"lines: {name} is compressed", values.size > 1000 and values.chunks is not None
                        and values.compression == "gzip" and values.shuffle)
    with h5py.File(f"{found[16].stem}.h5", "r") as file:
        checks.that("lines: short ones are in one piece", file["transient/time"].chunks is None)
    wanted = 1.0e-6*omega**2*numpy.exp(1j*omega*rows["time"]) - 60.0
    checks.below("lines: loads come back", numpy.abs(plane(rows, "load") - wanted).max()/60.0, 1.0e-12)


def check_steady(checks, folder):
    """An orbit is steady when nothing changes any more, whether the error chooses the steps or not."""
    keys = {"turns": 40, "unbalance": 2.0e-6, "steady_tolerance": 1.0e-5}
    found = [solve(folder, "steady", foil_case(0.3, (-60.0, 0.0), **keys, **steps)[0])
             for steps in ({}, {"steps_per_turn": 200})]
    checks.that("steady: by chosen steps and by equal ones", all("ending" in answer.summary for answer in found))
    checks.below("steady: after the same time", abs(found[0]["turns"] - found[1]["turns"]), 0.5)
    for name in ("orbit_x", "orbit_y"):
        checks.below(f"steady: {name}", abs(found[0][name]/found[1][name] - 1.0), 5.0e-3)
    keys = {"duration": 0.02, "steps_per_turn": 40, "unbalance": 1.0e-9, "steady_tolerance": 1.0e-3}
    change = {"it speeds up": ({"final_speed_rpm": 31000.0}, 0.02), "it speeds up for a while": (
        {"final_speed_rpm": 31000.0, "ramp_time": 0.008}, 0.008), "a pulse comes": (
        {"pulse": (1.0e-9, 0.0), "pulse_start": 0.006, "pulse_length": 0.003}, 0.009), "the base moves": (
        {"base_time": (0.0, 0.006, 0.007), "base_acceleration_x": (0.01, 0.01, 0.0)}, 0.007)}
    for words, (drive, until) in change.items():
        content, _ = foil_case(0.3, (-60.0, 0.0), **keys, **drive)
        settles = until < keys["duration"]
        answer = solve(folder, "settled", content, status=0 if settles else 2)
        turn = 2.0*math.pi/speed_of(content)
        if settles:
            checks.within(f"steady: {words}: two turns after that", (answer["time"] - until)/turn, 1.9, 2.2)
            checks.that(f"steady: {words}: then it ends", answer["ending"] == "the orbit is steady")
        else:
            checks.that(f"steady: {words}: it goes on", "ending" not in answer.summary and answer["time"] == until)
            checks.that(f"steady: {words}: not reached", answer["not_reached"] == "a steady orbit" and answer["converged"] == "false"
                        and "not reached: a steady orbit: the time is over; the last two turns differ by" in answer.log)


def friction_loop(folder, turns, **law):
    """Loads and positions while a load doubles and goes back, over so many turns in as many steps, and the same in load steps
    of a sweep [N], [m]."""
    beam = beams(0.1)
    groups = {group: dict(keys) for group, keys in beam["groups"].items() if group != "model"}
    groups["contact"] |= law
    steady = case_groups(FOIL_BEARING, beam["mesh"], "beam", load=(-40.0, 0.0), speed_rpm=beam["speed_rpm"], groups=groups)
    steady["solver"] = TIGHT
    length = 2.0*math.pi/speed_of(steady)*turns
    content = {group: dict(keys) for group, keys in steady.items()}
    content["scene"]["analysis"] = "transient"
    content["rotor"] = {"mass": 0.01}
    content["transient"] = {"turns": turns, "steps_per_turn": 1, "pulse": (-20.0*length, 0.0), "pulse_length": length}
    rows = history(solve(folder, "slow", content))
    steady["sweep"] = {"parameter": "load", "values": tuple(float(-load) for load in rows["load_x"]), "friction_memory": True}
    return -rows["load_x"], rows["eccentricity_x"], solve(folder, "sweep", steady).history()["eccentricity_x"]


def check_friction(checks, folder):
    """Crests and corners that rub: the loop of a slow load tends to that of load steps, as the film's damping vanishes.

    What sticks in motion keeps its friction, and at rest friction follows the normal force: 0.1 % of the energy.
    """
    off, lost = [], []
    for turns in (40, 80):
        load, slow, steady = friction_loop(folder, turns, friction_law="coulomb")
        width = numpy.abs(steady - steady[::-1]).max()
        work = [numpy.trapz(load, path) for path in (slow, steady)]
        off.append(numpy.abs(slow - steady).max()/width)
        lost.append(work[0]/work[1] - 1.0)
    checks.that(f"friction: the loop is {width*1.0e6:.2f} um wide", width > 1.0e-6)
    checks.below("friction: position of 80 turns, over the loop's width", off[1], 0.02)
    checks.within("friction: order in the duration", observed_order(*off), 0.8, 1.2)
    checks.below("friction: energy of a loop that takes for ever", 2.0*lost[1] - lost[0], 3.0e-3)
    _, slow, steady = friction_loop(folder, 40, friction_law_in_motion="as_at_rest")
    checks.below("friction as at rest: position of 40 turns, over the loop's width",
                 numpy.abs(slow - steady).max()/numpy.abs(steady - steady[::-1]).max(), 0.03)


def check_start(checks, folder):
    """An unbalance is there at once: equal steps are of order 2 from such a start, too."""
    ends = []
    for steps in (60, 120, 240):
        content, _ = foil_case(0.3, (-60.0, 0.0), turns=1, steps_per_turn=steps, unbalance=1.0e-7)
        content["solver"] = TIGHT
        ends.append(plane(history(solve(folder, "start", content)), "eccentricity")[-1])
    checks.within("sudden start: order of the steps",
                  observed_order(abs(ends[1] - ends[0]), abs(ends[2] - ends[1])), *ORDER)


def check_orbits(checks, folder):
    """Large orbits of an independent program, on meshes no finer than these limits need: orbits.py has what is left of them."""
    one = ORBITS["PT3"]
    wanted = numpy.array([complex(*part) for part in one["result"]["harmonic_1"]])
    found = []
    for steps in (60, 120):
        content, linear = foil_case(one["operation"]["mass"], one["operation"]["load"], (48, 6), turns=60,
                                    steps_per_turn=steps, unbalance=one["operation"]["unbalance_kg_m"])
        omega = speed_of(content)
        # Of the way to the orbit 1.5e-3 is left after 60 turns: only the slow mode is.
        free = [mode for mode in slow_modes(solve(folder, "modes", linear), omega) if mode.real > -0.05*omega]
        found.append(harmonic(history(solve(folder, "orbit", content)), omega, free, 4.0))
    mean, first = ((4.0*found[1][part] - found[0][part])/3.0 for part in (0, 1))
    checks.below("PT3: first harmonic of a large orbit", numpy.linalg.norm(first - wanted)/numpy.linalg.norm(wanted), 5.0e-4)
    checks.below("PT3: its centre over the clearance", numpy.linalg.norm(mean - one["result"]["mean"])/31.8e-6, 5.0e-4)
    one = ORBITS["PT2"]
    mass = one["operation"]["mass"]
    content, _ = foil_case(mass, one["operation"]["load"], (30, 4), name="PT2", turns=110, steps_per_turn=60)
    omega = speed_of(content)
    content["transient"] |= {"pulse": (0.3*31.8e-6*mass*0.5*omega, 0.0), "pulse_length": 2.0*math.pi/omega}
    rows = history(solve(folder, "limit_cycle", content))
    kept = rows["turns"] > rows["turns"][-1] - 10.0
    for axis, limit in zip("xy", one["result"]["limit_peak_to_peak"]):
        checks.below(f"PT2: limit cycle, peak to peak of {axis}",
                     numpy.ptp(rows[f"eccentricity_{axis}"][kept])/limit - 1.0, 1.0e-2)


def main():
    run_checks((check_ring, check_unbalance, check_growth, check_beams, check_same, check_steps, check_touch_down, check_start),
               (check_orbits, check_lines, check_steady, check_friction))


if __name__ == "__main__":
    main()
