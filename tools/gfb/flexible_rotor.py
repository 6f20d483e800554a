"""`gfb.ross_bearings` and `gfb.ross_modes`: bearings of gfb under a flexible shaft of ROSS, the package ross-rotordynamics."""

from __future__ import annotations

import dataclasses
import math
import os
import pathlib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy

from gfb.case import Case
from gfb.coefficients import SAME, TILTS_LOST, columns_of, is_sweep, read_at_speed, read_speeds, read_synchronous, speeds_of
from gfb.members import find_member, run_member, warn

HOW_TO_INSTALL = ("pip install './tools[ross]' in a checkout of gfb; before Python 3.12 that is pip install 'ross-rotordynamics==2.3.0' 'plotly<6', "
                  "for ROSS 2.3 cannot be imported with plotly 6 and newer, else 'ross-rotordynamics>=3'")
ROOT_TOLERANCE = 1.0e-9  # of a mode's own frequency


@dataclasses.dataclass
class Mode:
    """A mode of a rotor with its bearings' coefficients at the mode's own frequency."""

    frequency: float      # damped [rad/s]
    growth_rate: float    # [1/s]; above zero the mode grows
    forward: bool         # whirls with the shaft's sense
    shape: numpy.ndarray  # complex displacements along x and y of each node, a row a node

    @property
    def damping_ratio(self) -> float:
        """Of critical damping."""
        return -self.growth_rate/math.hypot(self.growth_rate, self.frequency)

    @property
    def logarithmic_decrement(self) -> float:
        """Logarithm of one maximum over the next one."""
        return -2.0*math.pi*self.growth_rate/self.frequency


def ross_bearings(bearings: Any, nodes: int | Sequence[int], speed_rpm: float | None = None, synchronous: bool = False,
                  folder: str | os.PathLike[str] = "bearings", gfb: str | os.PathLike[str] | None = None) -> list[Any]:
    """ROSS's BearingElements for `ross.Rotor(shaft, disks, elements)`, one a node.

    bearings: a result of `analysis = 'linear_dynamics'`, its .h5 file, or a case, which is run in the folder; or several, one
    a node. One alone stands at all nodes. Of one speed, or with `speed_rpm` from a sweep over it, the elements have tables over the
    frequency of vibration. A whole sweep gives tables over speed and frequency, which ROSS 3 has; `synchronous` tables over
    the speed, of the frequency that equals it, for the response to unbalance. Of a thrust bearing a warning says what ROSS has no place for. Raises ImportError without ROSS, ValueError where the
    call, `gfb.results.Unreadable` where a file is wrong."""
    ross = import_ross()
    nodes = [nodes] if isinstance(nodes, int) else list(nodes)
    bearings = list(bearings) if isinstance(bearings, (list, tuple)) else [bearings]
    if len(bearings) not in (1, len(nodes)):
        raise ValueError(f"{len(bearings)} bearings for {len(nodes)} nodes: give one for all nodes, or one a node")
    if synchronous and speed_rpm is not None:
        raise ValueError("synchronous tables are over all speeds of a sweep: leave speed_rpm out")
    paths = [file_of(bearing, number, pathlib.Path(folder), gfb) for number, bearing in enumerate(bearings, 1)]
    two = ross.__version__.startswith("2.")
    if not synchronous and speed_rpm is None:
        check_speeds(paths, two)
    tables = [table_of(path, speed_rpm, synchronous, two) for path in paths]
    thrust = [path.stem for path, (_, columns) in zip(paths, tables) if "kzz" in columns]
    if thrust:
        warn(f"{', '.join(thrust)}: {TILTS_LOST}")
    if len(tables) == 1:
        paths, tables = len(nodes)*paths, len(nodes)*tables
    return [element(ross, node, path.stem, *table) for node, path, table in zip(nodes, paths, tables)]


def import_ross() -> Any:
    """The package, or an ImportError that says how to have it; a plotly that it does not know ends in other errors."""
    try:
        import ross
    except ModuleNotFoundError as error:
        raise ImportError(f"ROSS is not here ({error}): {HOW_TO_INSTALL}", name="ross") from None
    except Exception as error:
        raise ImportError(f"ROSS cannot be imported ({type(error).__name__}): {HOW_TO_INSTALL}", name="ross") from error
    if not hasattr(ross, "BearingElement"):
        raise ImportError(f"the package ross here is another one, it has no BearingElement: {HOW_TO_INSTALL}", name="ross")
    return ross


def file_of(bearing: Any, number: int, folder: pathlib.Path, gfb: str | os.PathLike[str] | None) -> pathlib.Path:
    """The result file; a case is run, unless that was done before."""
    if isinstance(bearing, (str, os.PathLike)):
        return pathlib.Path(bearing)
    if not isinstance(bearing, Case):
        return pathlib.Path(f"{bearing.stem}.h5")
    folder.mkdir(parents=True, exist_ok=True)
    stem = folder/f"bearing_{number}"
    result = find_member(bearing, stem, gfb) or run_member(bearing, stem, gfb)
    if not result.converged:
        raise ValueError(f"{stem}.nml: there is no answer, so neither stiffness nor damping ({result.reason})")
    return pathlib.Path(f"{stem}.h5")


def check_speeds(paths: Sequence[pathlib.Path], two: bool) -> None:
    """One shaft has one speed: files of one speed must agree, and a sweep stands beside none of them; ROSS 2 has no place for one."""
    swept = [path for path in paths if is_sweep(path)]
    if swept and two:
        raise ValueError(f"{swept[0]}: a sweep, and a table of ROSS 2 is over one axis: say speed_rpm=..., or synchronous=True for the "
                         "response to unbalance; ROSS 3 has tables over speed and frequency")
    if swept and len(swept) < len(paths):
        raise ValueError(f"{swept[0]}: a sweep beside results of one speed: say which one with speed_rpm=...")
    speeds = [] if swept else [found[0] for found in map(speeds_of, paths) if found is not None]
    if speeds and max(speeds) - min(speeds) > SAME*max(speeds):
        raise ValueError(f"the bearings of one shaft are of different speeds: {', '.join(f'{speed:g}' for speed in speeds)} rpm")


def table_of(path: pathlib.Path, speed_rpm: float | None, synchronous: bool, two: bool) -> tuple[dict[str, Any], dict[str, Any]]:
    """Axes [rad/s] and coefficients of a bearing's tables."""
    if synchronous:
        speed, *both = read_synchronous(path)
        return {"frequency" if two else "speed": speed}, columns_of(*both)
    if speed_rpm is None and is_sweep(path):
        speed, frequency, *both = read_speeds(path)
        return {"speed": speed, "frequency": frequency}, columns_of(*both)
    frequency, *both = read_at_speed(path, speed_rpm)
    return {"frequency": frequency}, columns_of(*both)


def element(ross: Any, node: int, tag: str, axes: Mapping[str, Any], columns: Mapping[str, Any]) -> Any:
    """ROSS's element. ROSS 2 lays a smoothing spline through a table, which may miss it by 1 N s/m on average: here it passes through."""
    made = ross.BearingElement(n=node, tag=f"{tag} at node {node}", **axes, **columns)
    frequency = numpy.asarray(axes.get("frequency", ()))
    if ross.__version__.startswith("2.") and len(frequency) > 1:
        from scipy.interpolate import UnivariateSpline  # ROSS needs it, too
        for name, values in columns.items():
            setattr(made, f"{name}_interpolated", UnivariateSpline(frequency, values, k=min(3, len(frequency) - 1), s=0.0))
    return made


def ross_modes(rotor: Any, speed_rpm: float) -> list[Mode]:
    """The modes of a `ross.Rotor` at a speed of its shaft, each with its bearings' coefficients at its own frequency, by rising frequency.

    Those between the lowest and the highest frequency that the tables of all bearings share: none is extrapolated. For any
    ROSS: `run_modal` of ROSS 2 has one frequency for coefficients and gyroscopic moments."""
    axes = [numpy.asarray(one.frequency, dtype=float) for one in rotor.bearing_elements if getattr(one, "frequency", None) is not None]
    if not axes:
        raise ValueError("no bearing of this rotor has a table over the frequency of vibration: use run_modal")
    low, high = max(axis.min() for axis in axes), min(axis.max() for axis in axes)
    grid = [frequency for frequency in numpy.unique(numpy.concatenate(axes)) if low <= frequency <= high]
    if len(grid) < 2:
        raise ValueError("the tables of this rotor's bearings share no range of frequencies")
    speed = speed_rpm*math.pi/30.0
    # Sorted frequencies of vibration are continuous functions of that of the coefficients: none is lost where two of them cross.
    above = numpy.array([vibrations(rotor, speed, frequency) - frequency for frequency in grid]) > 0.0
    found = [own_frequency(rotor, speed, grid[i], grid[i + 1], which) for i, which in zip(*numpy.nonzero(above[:-1] != above[1:]))]
    return sorted((mode_at(rotor, speed, *one) for one in found), key=lambda mode: mode.frequency)


def vibrations(rotor: Any, speed: float, frequency: float) -> numpy.ndarray:
    """Frequencies of all modes with coefficients of one frequency, from the highest down; zero of those that do not vibrate."""
    values = numpy.linalg.eigvals(rotor.A(speed, frequency=frequency))
    return numpy.sort(values.imag)[::-1][:len(values)//2]


def own_frequency(rotor: Any, speed: float, low: float, high: float, which: int) -> tuple[float, int]:
    """The frequency between two that is the same in the coefficients and in a mode, and the mode's place among all."""
    from scipy.optimize import brentq  # ROSS needs it, too
    return float(brentq(lambda frequency: vibrations(rotor, speed, frequency)[which] - frequency, low, high, xtol=ROOT_TOLERANCE*high)), which


def mode_at(rotor: Any, speed: float, frequency: float, which: int) -> Mode:
    """The mode in a place, with coefficients of its frequency."""
    values, vectors = numpy.linalg.eig(rotor.A(speed, frequency=frequency))
    chosen = numpy.argsort(-values.imag)[which]
    shape = vectors[:len(values)//2, chosen].reshape(-1, rotor.number_dof)[:, :2]
    turn = numpy.sum(numpy.imag(shape[:, 0].conj()*shape[:, 1]))  # y follows x by a quarter of a turn where a mode goes forward
    return Mode(float(values[chosen].imag), float(values[chosen].real), bool(turn < 0.0), shape)
