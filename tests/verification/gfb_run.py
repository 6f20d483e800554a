"""Runs gfb on cases made on the fly, reads what it wrote, and counts what agrees and what does not."""

import dataclasses
import math
import os
import pathlib
import subprocess
import sys

import h5py
import numpy

GFB = os.environ.get("GFB", "gfb")
MPIEXEC = os.environ.get("GFB_MPIEXEC", "mpiexec")
SECONDS = 900  # no run here takes that long

# Names of the summary that say what the answer cost, not what it is.
COST = {"unknowns", "newton_iterations", "factorizations", "wall_time", "peak_memory"}


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


@dataclasses.dataclass
class Answer:
    """What a run left behind."""

    status: int
    log: str
    complaint: str
    stem: pathlib.Path  # of the files, without ending
    summary: dict       # name: number, or word
    units: dict         # name: unit

    def __getitem__(self, name):
        return self.summary[name]

    @property
    def force(self):
        return numpy.array([self["force_x"], self["force_y"]])

    @property
    def torque(self):
        return numpy.array([self["torque_x"], self["torque_y"]])

    @property
    def eccentricity(self):
        return numpy.array([self["eccentricity_x"], self["eccentricity_y"]])

    def physical(self):
        """Numbers of the summary without those of the cost."""
        return {name: value for name, value in self.summary.items()
                if name not in COST and isinstance(value, float)}

    def film(self):
        """The film file's fields as (station, row) arrays: x, z, theta, pressure, gap, ..."""
        with h5py.File(f"{self.stem}.film.vtkhdf", "r") as file:
            points = file["VTKHDF/Points"][...]
            fields = {name: data[...] for name, data in file["VTKHDF/PointData"].items()}
        rows = int(numpy.count_nonzero(points[:, 0] == points[0, 0]))
        shape = (len(points)//rows, rows)
        fields["x"] = points[:, 0]
        fields["z"] = points[:, 2]
        return {name: data.reshape(shape) for name, data in fields.items()}

    def history(self):
        """The columns of the history."""
        with h5py.File(f"{self.stem}.h5", "r") as file:
            return {name: data[...] for name, data in file["history"].items()}


def namelist_value(value):
    """A Python value as a namelist writes it; numbers read back exactly."""
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, bool):
        return ".true." if value else ".false."
    if isinstance(value, (int, float)):
        return repr(value)
    return ", ".join(namelist_value(one if isinstance(one, str) else float(one)) for one in value)


def case_text(bearing, mesh=(104, 30), foil="rigid", load=None, eccentricity=None, number=None,
              groups=None, **operation):
    """A case file: the position is held where no load is given. `groups` holds further keys."""
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
    text = ""
    for group, keys in content.items():
        lines = "".join(f"  {key} = {namelist_value(value)}\n" for key, value in keys.items())
        text += f"&{group}\n{lines}/\n"
    return text


def read_summary(path):
    """Numbers or words, and units, of a summary file."""
    values, units = {}, {}
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        name, rest = line.split(" = ", 1)
        word, _, unit = rest.partition(" [")
        units[name] = unit.rstrip("]")
        try:
            values[name] = float(word)
        except ValueError:
            values[name] = word
    return values, units


def run_file(path, folder, ranks=1, options=(), status=0):
    """Runs gfb on a case file; stops the whole check where it ends with another status."""
    command = [GFB, "--output", str(folder), *options, str(path)]
    if ranks > 1:
        command = [MPIEXEC, "-n", str(ranks), *command]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS, check=False)
    log, complaint = done.stdout.decode(), done.stderr.decode()
    if done.returncode != status:
        sys.exit(f"{' '.join(command)}: status {done.returncode}, not {status}\n{log[-3000:]}\n{complaint[-3000:]}")
    stem = pathlib.Path(folder)/pathlib.Path(path).stem
    if "--branches" in options:
        stem = stem.with_name(stem.name + ".branches")
    if status == 2:
        stem = stem.with_name(stem.name + ".unconverged")
    values, units = {}, {}
    if status in (0, 2) and stem.with_name(stem.name + ".summary").exists():
        values, units = read_summary(stem.with_name(stem.name + ".summary"))
    return Answer(done.returncode, log, complaint, stem, values, units)


def run(folder, name, bearing, ranks=1, status=0, **case):
    """Writes a case and runs it."""
    path = pathlib.Path(folder)/f"{name}.nml"
    path.write_text(case_text(bearing, **case), encoding="utf-8")
    return run_file(path, folder, ranks=ranks, options=["--quiet"], status=status)


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
    return sizes


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
