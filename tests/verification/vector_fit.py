#!/usr/bin/env python3
"""The fit of tools/coefficients --state-space against the vector fitting of scikit-rf: poles and deviations of the same data.

scikit-rf comes from PyPI, into build/scikit-rf; where it cannot be had the test says so and is skipped.
"""

import os
import pathlib
import subprocess
import sys
import tempfile

import numpy

REAL, PAIRS = 2, 3  # poles
PASSES = 200


# --- in scikit-rf's Python ---

def fit_of_library(path):
    """Poles and values of a file's data, both in the file's units, beside it."""
    import skrf
    from skrf.vectorFitting import VectorFitting
    with numpy.load(path) as file:
        frequency, values = file["frequency"], file["values"]
    network = skrf.Network(f=frequency/(2.0*numpy.pi), s=values, z0=1.0, f_unit="Hz")
    library = VectorFitting(network)
    library.max_iterations, library.max_tol = PASSES, 1.0e-12
    library.vector_fit(n_poles_real=REAL, n_poles_cmplx=PAIRS, init_pole_spacing="log", fit_constant=True, fit_proportional=False)
    found = numpy.array([[library.get_model_response(i, j, network.f) for j in range(4)] for i in range(4)])
    numpy.savez(path.replace(".npz", ".fitted.npz"), poles=library.poles, values=numpy.moveaxis(found, -1, 0))


# --- in the tests' ---

def made_up(frequency):
    """A function of eight poles."""
    from gfb.state_space import Fit
    random = numpy.random.default_rng(2)
    poles = numpy.array([-700.0, -9000.0, -900.0 + 2000.0j, -2000.0 + 3500.0j, -1500.0 + 6000.0j])
    residues = (random.standard_normal((5, 4, 4)) + 1j*random.standard_normal((5, 4, 4)))*1.0e3
    residues[:2] = residues[:2].real
    return Fit(poles, residues, random.standard_normal((4, 4)), numpy.zeros((4, 4)))(1j*frequency)


def bearing(gfb, folder):
    """Frequencies and Z of a small bearing on springs, tilts with an arm that makes the entries comparable."""
    from gfb.coefficients import read_coefficients
    from gfb.running import run_file, write_case
    ratios = [0.05*i for i in range(1, 20)] + [1.0 + 0.1*i for i in range(11)]
    case = {"scene": {"analysis": "linear_dynamics"}, "bearing": {"radius": 19.05e-3, "length": 38.1e-3, "clearance": 31.8e-6},
            "gas": {"viscosity": 1.95e-5, "ambient_pressure": 1.0135e5}, "operation": {"speed_rpm": 60000.0, "load": (-30.0, 0.0)},
            "model": {"foil": "elastic_foundation", "foundation_stiffness": 5.0e9, "foundation_pressure": "axial_mean"},
            "mesh": {"circumferential_elements": 52, "axial_elements": 8}, "dynamics": {"frequency_ratios": tuple(ratios)}}
    answer = run_file(gfb, write_case(folder, "small", case), folder, options=("--quiet",))
    frequency, stiffness, damping = read_coefficients(f"{answer.stem}.h5")
    impedance = stiffness + 1j*frequency[:, None, None]*damping
    arm = numpy.sqrt(numpy.abs(impedance[:, 2:, 2:]).max()/numpy.abs(impedance[:, :2, :2]).max())*numpy.array([0, 0, 1, 1])
    arm[:2] = 1.0
    return frequency, impedance/numpy.outer(arm, arm)/numpy.abs(impedance[:, :2, :2]).max()


def compare(checks, python, folder, name, frequency, values, same_poles):
    """The same data by both."""
    from gfb.state_space import deviation, fit
    path = pathlib.Path(folder)/f"{name}.npz"
    numpy.savez(path, frequency=frequency, values=values)
    done = subprocess.run([python, __file__, "--fit", path], capture_output=True, encoding="utf-8", check=False,
                          env={**os.environ, "PYTHONPATH": "", "OPENBLAS_NUM_THREADS": "1"})
    checks.that(f"{name}: scikit-rf fits {done.stderr[-500:] if done.returncode else ''}", done.returncode == 0)
    if done.returncode:
        return
    with numpy.load(path.with_suffix(".fitted.npz")) as file:
        poles, theirs = file["poles"], deviation(file["values"], values)
    ours = fit(frequency, values, REAL + 2*PAIRS)
    checks.that(f"{name}: deviation {ours.deviation:.2e}, by scikit-rf {theirs:.2e}", ours.deviation < 1.2*theirs + 1.0e-11)
    if same_poles:
        far = numpy.abs(numpy.sort_complex(poles) - numpy.sort_complex(ours.poles)) if len(poles) == len(ours.poles) else [numpy.inf]
        checks.below(f"{name}: poles differ by", max(far)/numpy.abs(poles).max(), 1.0e-7)


def main():
    if sys.argv[1:2] == ["--fit"]:
        fit_of_library(sys.argv[2])
        return
    from gfb_run import GFB, Checks
    from pypi import SKIPPED, python_with
    python = python_with("scikit-rf")
    if python is None:
        print("skipped: scikit-rf cannot be installed here (tests/requirements-scikit-rf.txt: Python 3.11, x86-64, PyPI)")
        sys.exit(SKIPPED)
    checks, frequency = Checks(), numpy.linspace(100.0, 9000.0, 40)
    with tempfile.TemporaryDirectory() as folder:
        compare(checks, python, folder, "known function", frequency, made_up(frequency), same_poles=True)
        compare(checks, python, folder, "bearing", *bearing(GFB, folder), same_poles=False)
    checks.close()


if __name__ == "__main__":
    main()
