#!/usr/bin/env python3
"""Small motions of foils that rub: in time they are those of the linear theory of contacts that stick.

At rest most contacts slide: the state was found by loads that grow. Small motions turn them back, and they stick once
they are shaken down. So a circle is followed until its force stays, and a growing whirl is watched after the base has
shaken the bearing more than it whirls: without that a motion that grows slides a little further in each turn.

With --long shells, the mass of the foils, and vibrations of finite amplitude against the harmonic balance.
"""

import math
import pathlib
import sys
import tempfile

import h5py
import numpy

from gfb_run import Checks, solve
from transient import TIGHT, history, modes_in

SPEED = 60000.0
OMEGA = SPEED*math.pi/30.0
METAL = {"thickness": 1.0e-4, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "density": 8440.0, "fixed_edge": "leading"}
PLACE, LOAD = {"eccentricity": (1.1e-5, 5.0e-6)}, {"load": (-7.0, 1.0)}
RADIUS = 1.0e-9  # of circles [m]
SMALL, AXES = 1.0e-60, "xy"


def case(foil, analysis, operation, **groups):
    """A small bearing with eight bumps."""
    return {"scene": {"analysis": analysis}, "bearing": {"radius": 6.0e-3, "length": 12.0e-3, "clearance": 15.0e-6},
            "gas": {"viscosity": 1.95e-5, "ambient_pressure": 101350.0}, "operation": {"speed_rpm": SPEED, **operation},
            "model": {"foil": foil}, "top_foil": METAL,
            "bump_foil": {**METAL, "half_length": 1.8e-3, "height": 0.5e-3, "bumps": 8},
            "contact": {"friction_top": 0.1, "friction_sleeve": 0.1},
            "mesh": {"circumferential_elements": 32, "axial_elements": 4, "arc_elements": 4, "flat_elements": 2}, **groups}


def linear(folder, foil, operation, dynamics, mass=0.0844):
    """The linear answer, and its 2 x 2 Z at its one frequency; at its amplitudes."""
    answer = solve(folder, "linear", case(foil, "linear_dynamics", operation, dynamics=dynamics, rotor={"mass": mass}))
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        group = file["dynamics"]
        omega = float(numpy.ravel(group["frequency"][...])[0])
        found = [group[f"stiffness{end}"][...].reshape(-1, 4, 4)[:, :2, :2] + 1j*omega*group[f"damping{end}"][...].reshape(-1, 4, 4)[:, :2, :2]
                 for end in ("", "_at_amplitude") if f"stiffness{end}" in group]
    return answer, found


def harmonic(rows, name, frequency, turns):
    """The first harmonic of the last turns of a frequency, x and y, through Blackman's window."""
    kept = rows["time"] > rows["time"][-1] - turns*2.0*math.pi/frequency + 1.0e-3*rows["step"][-1]
    window = numpy.blackman(numpy.count_nonzero(kept) + 1)[:-1]*numpy.exp(-1j*frequency*rows["time"][kept])
    return numpy.array([2.0*(window*rows[f"{name}_{axis}"][kept]).sum()/numpy.abs(window).sum() for axis in AXES])


def check_circle(checks, folder, foil="beam", mass="off", turns=8):
    """The force on a tiny circle, shaken down."""
    frequency = 1.5*OMEGA
    words = f"{foil}, foil mass {mass}"
    _, (sticking,) = linear(folder, foil, PLACE, {"frequencies": frequency, "foil_mass": mass})
    _, (sliding,) = linear(folder, foil, PLACE, {"frequencies": frequency, "foil_mass": mass, "contact_tangent": "slip"})
    rows = history(solve(folder, "circle", case(foil, "transient", PLACE, solver=TIGHT, transient={
        "turns": turns, "steps_per_turn": 120, "orbit_radius": RADIUS, "orbit_frequency": frequency, "foil_mass": mass})))
    force = harmonic(rows, "force", frequency, 4.0)
    stick, slip = (-one[0] @ numpy.array([RADIUS, -1j*RADIUS]) for one in (sticking, sliding))
    size = numpy.linalg.norm(stick)
    checks.that(f"{words}: a circle tells sticking from sliding", numpy.linalg.norm(stick - slip)/size > 0.1)
    checks.below(f"{words}: force on a circle against sticking", numpy.linalg.norm(force - stick)/size, 1.0e-2)


def shaken(amplitude, frequency, turns, axes=AXES):
    """The acceleration of a base that moves with an amplitude that rises and goes to nothing: keys of &transient."""
    end = turns*2.0*math.pi/OMEGA
    time = numpy.linspace(0.0, end, 60*turns + 1)
    rise = numpy.sin(math.pi*time/end)**4
    rise[-1] = 0.0
    wave = amplitude*frequency**2*rise*numpy.exp(1j*frequency*time)
    return table(time, wave, axes)


def table(time, wave, axes):
    """The keys, with no number too small to be read again."""
    columns = {"x": wave.real*("x" in axes), "y": wave.imag*("y" in axes)}
    return {"base_time": tuple(time)} | {f"base_acceleration_{axis}": tuple(numpy.where(abs(one) > SMALL, one, 0.0))
                                         for axis, one in columns.items()}


def check_growth(checks, folder, foil="beam", mass="off", turns=25):
    """Whirl after a push, below and above the critical mass."""
    words = f"{foil}, foil mass {mass}"
    keys = {"frequency_ratios": 0.5, "foil_mass": mass}
    critical = linear(folder, foil, LOAD, keys)[0]["critical_mass"]
    found = []
    for share in (0.9, 1.1):
        answer, _ = linear(folder, foil, LOAD, keys, share*critical)
        rows = history(solve(folder, "growth", case(
            foil, "transient", LOAD, solver=TIGHT, rotor={"mass": share*critical},
            transient={"turns": turns, "steps_per_turn": 60, "pulse": (0.0, 4.0e-7), "pulse_length": 2.0e-4, "foil_mass": mass,
                       **shaken(4.0e-9, 1.5*OMEGA, 12)})))
        found.append(modes_in(rows, min(turns - 13.0, 25.0), 2)[0])
        checks.below(f"{words}, {share} of the critical mass: growth over the speed",
                     (found[-1].real - answer["growth_rate"])/OMEGA, 2.0e-5)
        checks.below(f"{words}, {share} of the critical mass: frequency over the speed",
                     (found[-1].imag - answer["whirl_frequency"])/OMEGA, 1.0e-4)
    checks.that(f"{words}: whirl dies out below the critical mass and grows above it", found[0].real < 0.0 < found[1].real)


def check_amplitudes(checks, folder, foil="beam"):
    """Vibrations along x and along y: a shaft so heavy that it rests, on a base that moves, against the harmonic balance."""
    frequency, periods, steps = 0.5*OMEGA, 14, 100
    limits = {1.0e-8: 0.01, 1.0e-7: 0.02, 1.0e-6: 0.1}
    _, (stick, found) = linear(folder, foil, LOAD, {"frequencies": frequency, "foil_mass": "off", "vibration_amplitudes": tuple(limits)})
    period = 2.0*math.pi/frequency
    time = numpy.linspace(0.0, periods*period, 200*periods + 1)
    part = numpy.clip(time/(6.0*period), 0.0, 1.0)
    rise = numpy.polynomial.Polynomial([0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0]) # smooth, from 0 to 1
    rates = [rise.deriv(k)(part)/(6.0*period)**k if k else rise(part) for k in range(3)]
    wave = numpy.exp(1j*frequency*time)*(rates[2] + 2j*frequency*rates[1] - frequency**2*rates[0])
    for i, (amplitude, limit) in enumerate(limits.items()):
        for axis in range(2):
            base = table(time, amplitude*wave.real*(1.0 + 1.0j), AXES[axis])
            rows = history(solve(folder, "vibrating", case(foil, "transient", LOAD, rotor={"mass": 1.0e4}, solver=TIGHT, transient={
                "turns": 2*periods, "steps_per_turn": steps, "foil_mass": "off", **base})))
            place, force = (harmonic(rows, one, frequency, 4.0) for one in ("eccentricity", "force"))
            words = f"{foil}, {amplitude} m along {AXES[axis]}"
            checks.below(f"{words}: it is that amplitude", abs(place[axis])/amplitude - 1.0, 2.0e-3)
            march, balance, small = -force/place[axis], found[i][:, axis], stick[0][:, axis]
            checks.below(f"{words}: harmonic balance against a march", numpy.linalg.norm(balance - march)/numpy.linalg.norm(march), limit)
            if limit > 0.05:
                checks.that(f"{words}: the march is off sticking", numpy.linalg.norm(small - march)/numpy.linalg.norm(march) > 0.12)
                checks.within(f"{words}: the shaft's work against the march's", balance[axis].imag/march[axis].imag, 0.8, 1.25)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if "--long" in sys.argv:
            for foil, mass in (("beam", "on"), ("shell", "off"), ("shell", "on")):
                # Foil modes that the start has set going die out slowly.
                check_circle(checks, folder, foil, mass, 30 if mass == "on" else 8)
            check_growth(checks, folder, "shell")
            check_growth(checks, folder, "beam", "on", 60)
            check_amplitudes(checks, folder)
        else:
            check_circle(checks, folder)
            check_growth(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
