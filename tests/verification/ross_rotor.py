#!/usr/bin/env python3
"""A stability analysis by ROSS of a rigid rotor on two bearings, from the table of coefficients that gfb writes.

Each eigenvalue is iterated with the coefficients at its own frequency; the mass at which the least damped mode neither grows
nor decays is gfb's critical mass. ROSS comes from PyPI, into build/ross; where it cannot be had the test says so and is skipped.
"""

import os
import pathlib
import subprocess
import sys
import tempfile

TOOL = pathlib.Path(__file__).resolve().parents[2]/"tools/coefficients"
RPM = 60000.0
CASE = {
    "scene": {"analysis": "linear_dynamics"},
    "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6},
    "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5},
    "operation": {"speed_rpm": RPM, "load": (-30.0, 0.0)},
    "model": {"foil": "elastic_foundation", "foundation_stiffness": 5.0e9, "foundation_pressure": "axial_mean"},
    "mesh": {"circumferential_elements": 104, "axial_elements": 16},
    "dynamics": {"frequency_ratios": tuple(0.05*i for i in range(2, 21))},
}


# --- in ROSS's Python ---

def least_damped(ross, table, mass, speed):
    """Eigenvalue of the least damped mode of a rigid rotor of two such masses, with the coefficients at its frequency."""
    light = ross.Material("light", rho=100.0, E=1.0e13, Poisson=0.3)
    shaft = [ross.ShaftElement(0.05, 0.0, 0.05, material=light) for _ in range(2)]
    disk = ross.DiskElement(n=1, m=2.0*mass - sum(part.m for part in shaft), Id=1.0e-5*mass, Ip=1.0e-5*mass)
    names = [kind + row + column for kind in "kc" for row in "xy" for column in "xy"]
    bearings = [ross.BearingElement(n=n, frequency=table["frequency"], **{name: table[name] for name in names}) for n in (0, 2)]
    rotor, frequency = ross.Rotor(shaft, [disk], bearings), 0.5*speed
    for _ in range(40):
        values = rotor.run_modal(speed=frequency, num_modes=12).evalues
        found = max((value for value in values if 0.02*speed < value.imag < 1.2*speed), key=lambda value: value.real)
        if abs(found.imag - frequency) < 1.0e-7*speed:
            break
        frequency = found.imag
    return found


def same_file(path, table):
    """Whether a file of tools/coefficients is the bearing that the table makes."""
    import numpy
    import ross
    bearing = ross.BearingElement.load(path)
    return all(numpy.allclose(getattr(bearing, kind + row + column), table[kind + row + column], rtol=1.0e-14, atol=0.0)
               for kind in "kc" for row in "xy" for column in "xy") and numpy.allclose(bearing.frequency, table["frequency"])


def critical_mass(path, speed, low, high):
    """The mass between two at which the mode neither grows nor decays, and the frequency there."""
    import pandas
    import ross
    table = pandas.read_csv(path)
    print("file:", same_file(path.replace(".coefficients.csv", ".toml"), table))
    while high - low > 1.0e-4*low:
        middle = 0.5*(low + high)
        found = least_damped(ross, table, middle, speed)
        low, high = (low, middle) if found.real > 0.0 else (middle, high)
    return 0.5*(low + high), found.imag


# --- in the tests' ---

def main():
    if sys.argv[1:2] == ["--mass"]:
        print("critical:", *critical_mass(sys.argv[2], *map(float, sys.argv[3:])))
        return
    import math

    from gfb_run import GFB, Checks
    from gfb.run import run_file, write_case
    from pypi import SKIPPED, python_with
    python = python_with("ross")
    if python is None:
        print("skipped: ROSS cannot be installed here (tests/requirements-ross.txt: Python 3.11, x86-64, PyPI)")
        sys.exit(SKIPPED)
    checks, speed = Checks(), RPM*math.pi/30.0
    with tempfile.TemporaryDirectory() as folder:
        answer = run_file(GFB, write_case(folder, "rotor", CASE), folder, options=())
        checks.that(f"gfb: status {answer.status}", answer.status == 0)
        mass, ratio = answer["critical_mass"], answer["whirl_ratio"]
        written = subprocess.run([sys.executable, TOOL, f"{answer.stem}.h5", "--ross", f"{answer.stem}.toml"], check=False)
        checks.that("tools/coefficients writes ROSS's file", written.returncode == 0)
        done = subprocess.run([python, __file__, "--mass", f"{answer.stem}.coefficients.csv", repr(speed), repr(0.5*mass),
                               repr(2.0*mass)], capture_output=True, encoding="utf-8", check=False, cwd=folder,
                              env={**os.environ, "PYTHONPATH": ""})
        words = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("critical:")]
        checks.that("ROSS reads its file, with the table's numbers", "file: True" in done.stdout)
        checks.that(f"ROSS reads the table {'' if words else done.stderr[-500:]}", len(words) == 1)
        if words:
            found, frequency = map(float, words[0])
            checks.below(f"critical mass {mass:.5g} kg, by ROSS {found:.5g} kg", found/mass - 1.0, 1.0e-2)
            checks.below(f"whirl ratio {ratio:.4f}, by ROSS {frequency/speed:.4f}", frequency/speed/ratio - 1.0, 1.0e-2)
    checks.close()


if __name__ == "__main__":
    main()
