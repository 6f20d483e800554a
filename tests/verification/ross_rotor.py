#!/usr/bin/env python3
"""A stability analysis by ROSS of a rigid rotor on two bearings, from the table of coefficients that gfb writes.

Each eigenvalue is iterated with the coefficients at its own frequency; the mass at which the least damped mode neither grows
nor decays is gfb's critical mass. ROSS 2 reads a table over the frequency, ROSS 3 that and one over speed and frequency. They
come from PyPI, into build/ross and build/ross3; where neither can be had the test says so and is skipped.
"""

import math
import os
import pathlib
import shutil
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
OVER_SPEED = CASE | {"dynamics": {"frequencies": tuple(0.05*i*RPM*math.pi/30.0 for i in range(2, 21))},
                     "sweep": {"parameter": "speed_rpm", "values": (0.8*RPM, RPM)}}


# --- in ROSS's Python ---

def least_damped(ross, table, mass, speed, both):
    """Eigenvalue of the least damped mode of a rigid rotor of two such masses, with the coefficients at its frequency; of a bearing of a
    file over speed and frequency, where there is one, with both."""
    light = ross.Material("light", rho=100.0, E=1.0e13, Poisson=0.3)
    shaft = [ross.ShaftElement(0.05, 0.0, 0.05, material=light) for _ in range(2)]
    disk = ross.DiskElement(n=1, m=2.0*mass - sum(part.m for part in shaft), Id=1.0e-5*mass, Ip=1.0e-5*mass)
    names = [kind + row + column for kind in "kc" for row in "xy" for column in "xy"]
    bearings = [ross.BearingElement(n=n, frequency=table["frequency"], **{name: table[name] for name in names}) for n in (0, 2)]
    if both is not None:
        axes = ("speed", "frequency")
        bearings = [ross.BearingElement(n=n, **{name: getattr(both, name) for name in (*names, *axes)}) for n in (0, 2)]
    rotor, frequency = ross.Rotor(shaft, [disk], bearings), 0.5*speed
    for _ in range(40):
        at = {"speed": frequency} if both is None else {"speed": speed, "frequency": frequency}
        values = rotor.run_modal(num_modes=12, **at).evalues
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
    table, both = pandas.read_csv(path), None
    print("file:", same_file(path.replace(".coefficients.csv", ".toml"), table))
    if not ross.__version__.startswith("2."):
        both = ross.BearingElement.load(path.replace(".coefficients.csv", ".over_speed.toml"))
        print("over speed:", both.kxx_interpolated.kind)
    while high - low > 1.0e-4*low:
        middle = 0.5*(low + high)
        found = least_damped(ross, table, middle, speed, both)
        low, high = (low, middle) if found.real > 0.0 else (middle, high)
    return 0.5*(low + high), found.imag


# --- in the tests' ---

def main():
    if sys.argv[1:2] == ["--mass"]:
        print("critical:", *critical_mass(sys.argv[2], *map(float, sys.argv[3:])))
        return
    from gfb_run import GFB, Checks
    from gfb.run import run_file, write_case
    from pypi import SKIPPED, python_with
    pythons = {name: python_with(name, shutil.which(wanted) or "/usr/bin/python3")
               for name, wanted in (("ross", "python3.11"), ("ross3", "python3.13"))}
    pythons = {name: python for name, python in pythons.items() if python}
    if not pythons:
        print("skipped: ROSS cannot be installed here (tests/requirements-ross.txt: Python 3.11, -ross3.txt: 3.13; x86-64, PyPI)")
        sys.exit(SKIPPED)
    checks, speed = Checks(), RPM*math.pi/30.0
    with tempfile.TemporaryDirectory() as folder:
        answer = run_file(GFB, write_case(folder, "rotor", CASE), folder, options=())
        checks.that(f"gfb: status {answer.status}", answer.status == 0)
        mass, ratio = answer["critical_mass"], answer["whirl_ratio"]
        written = subprocess.run([sys.executable, TOOL, f"{answer.stem}.h5", "--ross", f"{answer.stem}.toml"], check=False)
        checks.that("tools/coefficients writes ROSS's file", written.returncode == 0)
        swept = run_file(GFB, write_case(folder, "swept", OVER_SPEED), folder, options=())
        written = subprocess.run([sys.executable, TOOL, f"{swept.stem}.h5", "--ross", f"{answer.stem}.over_speed.toml"], check=False)
        checks.that("tools/coefficients writes ROSS 3's file over the speed", written.returncode == 0)
        for name, python in pythons.items():
            done = subprocess.run([python, __file__, "--mass", f"{answer.stem}.coefficients.csv", repr(speed), repr(0.5*mass),
                                   repr(2.0*mass)], capture_output=True, encoding="utf-8", check=False, cwd=folder,
                                  env={**os.environ, "PYTHONPATH": ""})
            words = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("critical:")]
            checks.that(f"{name} reads its file, with the table's numbers", "file: True" in done.stdout)
            checks.that(f"{name} reads the table {'' if words else done.stderr[-500:]}", len(words) == 1)
            checks.that(f"{name}: the table over the speed is one of two axes where ROSS has them",
                        ("over speed: grid" in done.stdout) == (name == "ross3"))
            if words:
                found, frequency = map(float, words[0])
                checks.below(f"{name}: critical mass {mass:.5g} kg, by ROSS {found:.5g} kg", found/mass - 1.0, 1.0e-2)
                checks.below(f"{name}: whirl ratio {ratio:.4f}, by ROSS {frequency/speed:.4f}", frequency/speed/ratio - 1.0, 1.0e-2)
    checks.close()


if __name__ == "__main__":
    main()
