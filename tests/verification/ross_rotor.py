#!/usr/bin/env python3
"""A stability analysis by ROSS of a rigid rotor on two bearings, from the table of coefficients that gfb writes.

Each eigenvalue is iterated with the coefficients at its own frequency; the mass at which the least damped mode neither grows
nor decays is gfb's critical mass. ROSS 2 reads a table over the frequency, ROSS 3 that and one over speed and frequency. They
come from PyPI, into build/ross and build/ross3; where neither can be had the test says so and is skipped.

The blocks of docs/manual/flexible_rotor.md are run, too: its onset of a stiff rotor is gfb's own, that of the flexible one is found by
other equations, the bearings' state-space matrices under ROSS's shaft, in which nothing is iterated.
"""

import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parents[2]
TOOL = PROJECT/"tools/coefficients"
PAGE = PROJECT/"docs/manual/flexible_rotor.md"
NEXT_TO_ONSET = (14000.0, 15000.0)  # of the page's flexible rotor [rpm]
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


def least_decrement(shaft, nodes, paths, speed_rpm):
    """Least logarithmic decrement of a rotor without bearings on the state-space matrices of these: eigenvalues without iteration."""
    import numpy
    from gfb.coefficients import read_at_speed
    from gfb.state_space import fit
    size, number_dof, speed = shaft.ndof, shaft.number_dof, speed_rpm*math.pi/30.0
    stiffness, damping, states, inputs, forces = shaft.K0.copy(), shaft.C0 + speed*shaft.G(), [], [], []
    for node, path in zip(nodes, paths):
        frequency, *both = read_at_speed(path, speed_rpm)
        a, b, c, d, e = fit(frequency, both[0] + 1j*frequency[:, None, None]*both[1]).matrices()
        place = numpy.zeros((2, size))  # of the node's x and y
        place[[0, 1], [number_dof*node, number_dof*node + 1]] = 1.0
        stiffness, damping = stiffness + place.T @ d[:2, :2] @ place, damping + place.T @ e[:2, :2] @ place
        states.append(a), inputs.append(b[:, :2] @ place), forces.append(place.T @ c[:2])
    inverse, ends = numpy.linalg.inv(shaft.M0), numpy.cumsum([0, *map(len, states)])
    matrix = numpy.zeros((2*size + ends[-1], 2*size + ends[-1]))
    matrix[:size, size:2*size] = numpy.eye(size)
    matrix[size:2*size, :2*size] = -inverse @ numpy.hstack((stiffness, damping))
    for first, last, a, b, c in zip(2*size + ends[:-1], 2*size + ends[1:], states, inputs, forces):
        matrix[first:last, first:last], matrix[first:last, :size], matrix[size:2*size, first:last] = a, b, -inverse @ c
    values = numpy.linalg.eigvals(matrix)
    whirling = values[(values.imag > 0.1*speed) & (values.imag < 1.2*speed)]
    return float(min(-2.0*math.pi*whirling.real/whirling.imag))


def run_page():
    """The page's blocks; then the same decrements and onset by matrices. Lines of what is compared."""
    import numpy
    names = {}
    exec("".join(re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)), names)
    paths = [f"{result.stem}.h5" for result in names["results"]]
    by_page = [min(mode.logarithmic_decrement for mode in names["modes"][speed]) for speed in NEXT_TO_ONSET]
    by_matrices = [least_decrement(names["pinned"], names["nodes"], paths, speed) for speed in NEXT_TO_ONSET]
    onset = float(numpy.interp(0.0, by_matrices[::-1], NEXT_TO_ONSET[::-1]))
    stiff = [float(number) for number in (12900.0 - 100.0*names["low"]/(names["high"] - names["low"]), names["rigid"]["onset_speed_rpm"])]
    print("page:", names["onset"], onset, *by_page, *by_matrices, *stiff)


# --- in the tests' ---

def check_page(checks, name, python, folder):
    """What the page's blocks find, and what stands in the page."""
    (pathlib.Path(folder)/"inputs").symlink_to(PROJECT/"inputs")
    done = subprocess.run([python, __file__, "--page"], capture_output=True, encoding="utf-8", check=False, cwd=folder,
                          env={**os.environ, "PYTHONPATH": str(PROJECT/"tools"), "OMP_NUM_THREADS": "1", "MPLBACKEND": "Agg"})
    words = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("page:")]
    checks.that(f"{name}: the page's blocks run {'' if words else done.stderr[-500:]}", len(words) == 1)
    if words:
        onset, by_matrices, slow, fast, slow_too, fast_too, stiff, by_gfb = map(float, words[0])
        written = float(re.search(r"# onset: (\d+) rpm", PAGE.read_text(encoding="utf-8"))[1])
        checks.below(f"{name}: onset of the flexible rotor {onset:.0f} rpm, in the page {written:.0f} rpm", onset/written - 1.0, 1.0e-3)
        checks.below(f"{name}: the same by matrices {by_matrices:.0f} rpm", onset/by_matrices - 1.0, 2.0e-3)
        checks.below(f"{name}: decrements {slow:.4f}, {fast:.4f}, by matrices {slow_too:.4f}, {fast_too:.4f}",
                     max(abs(slow - slow_too), abs(fast - fast_too)), 5.0e-3)
        checks.below(f"{name}: onset of the stiff rotor {stiff:.1f} rpm, by gfb's &rotor {by_gfb:.1f} rpm", stiff/by_gfb - 1.0, 1.0e-4)


def main():
    if sys.argv[1:2] == ["--mass"]:
        print("critical:", *critical_mass(sys.argv[2], *map(float, sys.argv[3:])))
        return
    if sys.argv[1:2] == ["--page"]:
        run_page()
        return
    from gfb_run import GFB, Checks
    from gfb.running import run_file, write_case
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
    for name, python in pythons.items():
        with tempfile.TemporaryDirectory() as folder:
            check_page(checks, name, python, folder)
    checks.close()


if __name__ == "__main__":
    main()
