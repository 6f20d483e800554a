"""What the checks share: bearings made on the fly, runs of gfb (tools/gfb/running.py), differences, counted claims."""

import dataclasses
import math
import os
import pathlib
import sys
import tempfile

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]/"tools"))

from gfb import running  # noqa: E402 (found only now)
from gfb.case import Case  # noqa: E402
from gfb.namelist import namelist_value  # noqa: E402, F401 (the checks take them from here)
from gfb.program import launcher  # noqa: E402
from gfb.results import COST, read_summary, seal  # noqa: E402, F401
from gfb.running import Result, write_case  # noqa: E402, F401

GFB = os.environ.get("GFB", "gfb")
MPIEXEC = launcher(GFB)
SECONDS = 900  # no run here takes that long
ROUNDING = {"energy_imbalance": 1.0}  # what is rounding alone is compared with


@dataclasses.dataclass(frozen=True)
class Bearing:
    """Geometry and gas; everything in SI."""

    radius: float = 0.02
    length: float = 0.04
    clearance: float = 2.0e-5
    viscosity: float = 2.0e-5
    ambient_pressure: float = 1.0e5
    leading_edge_condition: str = "slit"

    def speed_rpm(self, number):
        """Speed at a bearing number Lambda = 6 mu Omega / p_a (R / C)^2."""
        omega = number*self.ambient_pressure/(6.0*self.viscosity)*(self.clearance/self.radius)**2
        return omega*30.0/math.pi

    @property
    def force_unit(self):
        """p_a L D."""
        return self.ambient_pressure*self.length*2.0*self.radius


def case_text(bearing, **case):
    """The case file of case_groups."""
    return str(Case(case_groups(bearing, **case)))


def case_groups(bearing, mesh=(104, 30), foil="rigid", load=None, eccentricity=None, number=None,
                groups=None, **operation):
    """A case: the position is held where no load is given. `groups` holds further keys."""
    operation.setdefault("speed_rpm", bearing.speed_rpm(number) if number is not None else 0.0)
    if load is not None:
        operation["load"] = load
    if eccentricity is not None:
        operation["eccentricity"] = eccentricity
    content = {
        "scene": {"analysis": "fixed_position" if load is None else "equilibrium"},
        "bearing": {"radius": bearing.radius, "length": bearing.length, "clearance": bearing.clearance,
                    "leading_edge_condition": bearing.leading_edge_condition},
        "gas": {"viscosity": bearing.viscosity, "ambient_pressure": bearing.ambient_pressure},
        "operation": operation,
        "model": {"foil": foil},
        "mesh": {"circumferential_elements": mesh[0], "axial_elements": mesh[1]},
    }
    for group, keys in (groups or {}).items():
        content.setdefault(group, {}).update(keys)
    return content


def run_file(path, folder, ranks=1, options=(), status=0, environment=None):
    """Runs gfb on a case file; stops the whole check where it ends with another status."""
    answer = running.run_file(GFB, path, folder, ranks, options, seconds=SECONDS, environment=environment)
    if answer.status != status:
        sys.exit(f"{path} {' '.join(options)}: status {answer.status}, not {status}\n{answer.log[-3000:]}\n"
                 f"{answer.complaint[-3000:]}")
    return answer


def solve(folder, name, content, ranks=1, options=(), status=0, environment=None):
    """Writes a case file from its groups and runs it."""
    return run_file(write_case(folder, name, content), folder, ranks, options, status, environment)


def run(folder, name, bearing, ranks=1, status=0, **case):
    """Writes a case and runs it."""
    return solve(folder, name, case_groups(bearing, **case), ranks, status=status)


def observed_order(coarse, fine, ratio=2.0):
    """Order p of errors that shrink as size^p, where the size shrinks by `ratio`."""
    return math.log(abs(coarse)/abs(fine))/math.log(ratio)


def largest_difference(first, second, size=None):
    """Largest difference of two fields over the larger one's largest value, or over `size`."""
    first, second = numpy.asarray(first), numpy.asarray(second)
    if first.shape != second.shape:
        return math.inf
    scale = max(numpy.abs(first).max(), numpy.abs(second).max()) if size is None else size
    return float(numpy.abs(first - second).max()/scale) if scale > 0.0 else 0.0


def summary_difference(first, second, sizes=None):
    """Largest relative difference of two summaries' physical numbers, and its name.

    `sizes` gives names whose value may vanish a size to compare the difference with.
    """
    one, other = first.physical(), second.physical()
    if set(one) != set(other):
        return math.inf, "names: " + ", ".join(sorted(set(one) ^ set(other)))
    worst = (0.0, "all")
    for name, value in one.items():
        size = (sizes or {}).get(name, max(abs(value), abs(other[name])))
        difference = abs(value - other[name])/size if size > 0.0 else 0.0
        worst = max(worst, (difference, name))
    return worst


def natural_sizes(bearing):
    """What a difference of a quantity that may vanish is compared with."""
    force = bearing.force_unit
    sizes = {f"{share}force_{axis}": force for axis in "xy" for share in ("", "solid_contact_")}
    sizes |= {f"eccentricity_{axis}": bearing.clearance for axis in "xy"}
    for axis in "xy":
        sizes |= {f"torque_{axis}": force*bearing.length, f"torque_{axis}_without_suction": force*bearing.length}
    return sizes | ROUNDING


class Checks:
    """Prints each comparison and remembers those that failed."""

    def __init__(self):
        self.failed = 0
        self.passed = 0

    def that(self, words, truth):
        """A claim."""
        self.passed += bool(truth)
        self.failed += not truth
        print(f"{'ok    ' if truth else 'FAILED'} {words}", flush=True)

    def below(self, words, value, limit):
        """A size that must not exceed its limit; NaN fails."""
        self.that(f"{words}: {value:.2e} (at most {limit:.0e})", abs(value) <= limit)

    def within(self, words, value, low, high):
        """A number in a range; NaN fails."""
        self.that(f"{words}: {value:.4g} (within {low:g} .. {high:g})", low <= value <= high)

    def close(self):
        """Ends the script."""
        print(f"{self.passed} passed, {self.failed} failed")
        sys.exit(1 if self.failed or not self.passed else 0)


def run_checks(quick, slow):
    """A script's checks(checks, folder): the quick ones, with --long the slow ones and nothing else."""
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        for check in slow if "--long" in sys.argv[1:] else quick:
            check(checks, pathlib.Path(folder))
    checks.close()
