"""Writes a bearing's stiffness and damping for rotor codes.

  tools/coefficients CASE.h5 --ross NAME.toml    a BearingElement of ROSS: ross.BearingElement.load("NAME.toml"); of one speed
      a table over the frequency of vibration, for ROSS 2 and 3; of a sweep over speed_rpm, without --point, a table over
      speed and frequency, which ROSS 3 reads
  tools/coefficients CASE.h5 --xltrc NAME.txt    columns as XLTRC2's: frequency [rpm], K [N/m], C [N s/m]
  tools/coefficients CASE.h5 --state-space [NAME.npz]   matrices of linear differential equations, for integration in time:
      x' = A x + B a,  force = -(C x + D a + E a'),  a = (x, y, phi_x, phi_y) of the shaft; NAME.mat for MATLAB (with SciPy);
      without a name CASE.state_space.npz beside CASE.h5

CASE.h5 is of analysis = 'linear_dynamics'. The first two hold the four coefficients of x and y over the frequency of
vibration, at one speed where no other is said: for stability take them at the frequency of the mode, not at the speed.
Of a thrust bearing ROSS gets kzz and czz, along the axis; the others are zero.
"""

import importlib.util
import json
import math
import pathlib

import numpy

from gfb.case import Case
from gfb.files import fresh
from gfb.results import Unreadable, open_results, reading, text_of
from gfb.state_space import CannotFit, fit
from gfb.tool import parser_of, say, stop

PLANE = (("xx", 0, 0), ("xy", 0, 1), ("yx", 1, 0), ("yy", 1, 1))  # name, row, column
ROSS_3 = "3: a table over the speed of the shaft (rows) and the frequency of vibration"
MOTIONS = (4, 3)  # of a journal, and of a runner: e_z, phi_x, phi_y
SAME = 1.0e-9  # relative difference of speeds that are one, typed in rpm or computed
REFUSED = 1.0e-2  # deviation of a fit that is refused, unless it is asked for
TILTS_LOST = ("a thrust bearing: ROSS's element has its stiffness and damping along the axis (kzz, czz) alone; those against a tilt of the runner are "
              "lost, and across the axis it carries nothing")
ABOUT = ("x' = A x + B a, force on the shaft = -(C x + D a + E a'), all changes against the steady state. a: displacement of "
         "the shaft along x, y [m], rotation about x, y [rad]; force: along x, y [N], torque about x, y [N m]. A [1/s], "
         "poles [rad/s] are its eigenvalues; frequencies [rad/s] between which it was fitted. deviation: largest relative one "
         "at these frequencies; between: at every second one, of a fit without them")


def read_coefficients(path, point=None):
    """Frequencies [rad/s], K and C (frequency, row, column) in SI; of a sweep those of a point, counted from 1."""
    with reading(path), open_results(path) as file:
        if "dynamics" not in file:
            raise Unreadable(f"{path}: {why_none(file)}")
        frequency, *both = (file[f"dynamics/{name}"].astype(float)[...] for name in ("frequency", "stiffness", "damping"))
        swept = both[0].ndim == 4
        if swept:
            points = len(both[0])
            if point is None or not 0 < point <= points:
                raise Unreadable(f"{path}: a sweep; say which of its points with --point, 1 to {points}")
            frequency, both = frequency[point - 1], [values[point - 1] for values in both]
        elif point is not None:
            raise Unreadable(f"{path}: --point is of sweeps, this is none")
        frequency = numpy.atleast_1d(frequency)
        if any(values.shape not in ((len(frequency), n, n) for n in MOTIONS) for values in both):
            raise ValueError("stiffness and damping are neither 4 x 4 a frequency, nor 3 x 3 of a thrust bearing")
        return frequency, *both


def why_none(file):
    """Why a result file has no stiffness and damping: its run has no answer, or is of another analysis."""
    said = {name: text_of(file[f"summary/{name}"][()]) for name in ("outcome", "reason") if f"summary/{name}" in file}
    if said:
        return f"there is no answer, so neither stiffness nor damping ({': '.join(said.values())})"
    return "no stiffness and damping in it; they are of analysis = 'linear_dynamics'"


def read_sweep(path, refusal):
    """Of a sweep over the speed: speeds, frequencies (speed, frequency) [rad/s], K and C (speed, frequency, row, column); another file is
    refused with these words."""
    with reading(path), open_results(path) as file:
        if "dynamics/stiffness" not in file or "speed_rpm" not in file.get("history", {}) or file["dynamics/stiffness"].ndim != 4:
            raise Unreadable(f"{path}: {refusal}")
        speed = file["history/speed_rpm"].astype(float)[...]*math.pi/30.0
        frequency, *both = (file[f"dynamics/{name}"].astype(float)[...] for name in ("frequency", "stiffness", "damping"))
        frequency = frequency.reshape(len(speed), -1)  # one a speed is a plain list
        if any(values.shape not in ((*frequency.shape, n, n) for n in MOTIONS) for values in both):
            raise ValueError("stiffness and damping are neither 4 x 4 a speed and frequency, nor 3 x 3 of a thrust bearing")
        return speed, frequency, *both


def read_speeds(path):
    """The same in the order of the speeds, with one row of frequencies, which all of them share."""
    speed, frequency, *both = read_sweep(path, "a sweep, but not over speed_rpm with analysis = 'linear_dynamics'; say which of its points (--point, "
                                         "in Python speed_rpm)")
    if (frequency != frequency[0]).any():
        raise Unreadable(f"{path}: a table over the speed needs the same frequencies at all speeds: give &dynamics frequencies, "
                         "not frequency_ratios, or say which point (--point, in Python speed_rpm)")
    lost = [number for number, values in enumerate(zip(*both), 1) if not numpy.isfinite(values).all()]
    if lost or len(set(speed)) < len(speed):
        raise Unreadable(f"{path}: a table over the speed needs speeds that differ, and an answer at each; "
                         + (f"point {lost[0]} has none" if lost else "there are equal ones"))
    order = numpy.argsort(speed)
    return speed[order], frequency[0], *(values[order] for values in both)


def speeds_of(path):
    """Speeds [rpm] of a sweep over them, a point each; of one speed that alone; None where a file does not say it."""
    with reading(path), open_results(path) as file:
        if "speed_rpm" in file.get("history", {}):
            return file["history/speed_rpm"].astype(float)[...]
        case = Case.parse(text_of(file["scene/case_file"][()])) if "scene/case_file" in file else Case()
        return [float(case["operation%speed_rpm"])] if "operation%speed_rpm" in case else None


def read_at_speed(path, speed_rpm):
    """The same as read_coefficients, of a speed: that of the file, or of a sweep over it; None: of the file."""
    speeds, swept = speeds_of(path), is_sweep(path)
    if speed_rpm is None or (speeds is None and not swept):
        point = None
    else:
        found = [number for number, speed in enumerate([] if speeds is None else speeds, 1) if abs(speed - speed_rpm) <= SAME*speed]
        if not found:
            raise Unreadable(f"{path}: no coefficients of {speed_rpm:g} rpm"
                             + ("" if speeds is None else f", only of {', '.join(f'{speed:g}' for speed in speeds)}"))
        point = found[0] if swept else None
    data = read_coefficients(path, point)
    if not all(numpy.isfinite(values).all() for values in data):
        raise Unreadable(f"{path}: there is no answer" + ("" if speed_rpm is None else f" at {speed_rpm:g} rpm"))
    return data


def read_synchronous(path):
    """Of a sweep over the speed, in the order of the speeds [rad/s]: speeds, K and C (speed, row, column) at the frequency that equals the speed."""
    speed, frequency, *both = read_sweep(path, "synchronous coefficients are of a sweep over speed_rpm with analysis = 'linear_dynamics'")
    nearest = numpy.argmin(abs(frequency - speed[:, None]), axis=1)
    order = numpy.argsort(speed, kind="stable")
    for one in order:
        words = f"{speed[one]*30.0/math.pi:g} rpm"
        if not all(numpy.isfinite(values[one]).all() for values in both):
            raise Unreadable(f"{path}: there is no answer at {words}")
        if abs(frequency[one, nearest[one]] - speed[one]) > SAME*speed[one]:
            raise Unreadable(f"{path}: no coefficients of vibrations at the speed, {words}: give frequency_ratios with 1.0, or "
                             "frequencies with all speeds [rad/s]")
    return speed[order], *(values[order, nearest[order]] for values in both)


def is_sweep(path):
    """Whether a file has stiffness and damping of several points."""
    with reading(path), open_results(path) as file:
        return "dynamics/stiffness" in file and file["dynamics/stiffness"].ndim == 4


def columns_of(stiffness, damping):
    """{kxx: values over frequency, or over speed and frequency, ..., cyy: ...}; of a runner kzz and czz, beside zeros."""
    if stiffness.shape[-1] < 4:
        return {kind + name: 0.0*values[..., 0, 0] for kind, values in (("k", stiffness), ("c", damping)) for name, _, _ in PLANE} | \
            {"kzz": stiffness[..., 0, 0], "czz": damping[..., 0, 0]}
    return {kind + name: values[..., row, column] for kind, values in (("k", stiffness), ("c", damping))
            for name, row, column in PLANE}


def ross_text(frequency, columns, name, speed=None):
    """A BearingElement as ROSS saves it; node 0. With speeds a table of two dimensions."""
    axes = {"frequency": frequency} | ({} if speed is None else {"speed": speed})
    lines = [f"# gfb, for ROSS {'2 and 3: a table over the frequency of vibration' if speed is None else ROSS_3}, in SI",
             f"[{json.dumps('BearingElement_' + name)}]", "n = 0", f"tag = {json.dumps(name)}", "scale_factor = 1"]
    lines += [f"{key} = {values.tolist()!r}" for key, values in sorted({**columns, **axes}.items())]
    return "\n".join(lines) + "\n"


def xltrc_text(frequency, columns, name):
    """Columns with a heading; frequencies in rpm."""
    heads = ["Freq[rpm]"] + [f"{key.capitalize()}[{'N/m' if key[0] == 'k' else 'N-s/m'}]" for key in columns]
    lines = [f"* {name}: the frequency is that of the vibration, at one speed of the shaft", "".join(f"{head:>16}" for head in heads)]
    for i, omega in enumerate(frequency):
        lines.append("".join(f"{value:16.7e}" for value in (omega*30.0/math.pi, *(values[i] for values in columns.values()))))
    return "\n".join(lines) + "\n"


def table_writer(text_of, data, name):
    """What writes a table to a path."""
    frequency, stiffness, damping = data
    if stiffness.shape[-1] < 4 and text_of is xltrc_text:
        stop(f"{name}: a thrust bearing; XLTRC2's columns are of journal bearings")
    return lambda path: path.write_text(text_of(frequency, columns_of(stiffness, damping), name), encoding="utf-8")


def ross_writer(over, data, name):
    """The same of ROSS's file, of one speed or over all of a sweep."""
    if over is None:
        return table_writer(ross_text, data, name)
    speed, frequency, *both = over
    return lambda path: path.write_text(ross_text(frequency, columns_of(*both), name, speed), encoding="utf-8")


def state_space_writer(options, data):
    """The same of the matrices; says how good they are."""
    frequency, stiffness, damping = data
    if stiffness.shape[-1] < 4:
        stop(f"{options.file}: a thrust bearing; --state-space is of journal bearings")
    if options.state_space.suffix == ".mat" and importlib.util.find_spec("scipy") is None:
        stop(f"{options.state_space}: a .mat file needs SciPy: apt-get install python3-scipy")
    if options.state_space.suffix not in (".npz", ".mat"):
        stop(f"{options.state_space}: the matrices are written as .npz or .mat")
    try:
        made = fit(frequency, stiffness + 1j*frequency[:, None, None]*damping, options.poles, options.velocity_term)
    except CannotFit as error:
        stop(f"{options.file}: no state space: {error}")
    between = "" if math.isnan(made.between) else f", {made.between:.1e} between"
    print(f"{made.number} poles, {4*made.number} states; largest deviation {made.deviation:.1e} at the frequencies{between}")
    largest = float(numpy.nanmax([made.deviation, made.between]))
    if not (largest < REFUSED or options.accept_deviation):
        stop(f"{options.file}: no state space: these equations are {100.0*largest:.2g} % off the bearing's: they need more poles, or more frequencies, "
             "wider or denser; a loss factor, or a film that is unstable under a fixed shaft, has none with stable poles. --accept-deviation writes them")
    if not largest < REFUSED:
        say("warning: these equations are not those of the bearing: they need more poles, or more frequencies, wider or denser; "
            "a loss factor, or a film that is unstable under a fixed shaft, has none with stable poles")
    content = dict(zip("ABCDE", made.matrices()), poles=made.all_poles, frequency=frequency, deviation=made.deviation,
                   between=made.between, about=ABOUT)
    return lambda path: save(path, content)


def save(path, content):
    """Writes the matrices."""
    with open(path, "wb") as file:
        if path.suffix == ".mat":
            from scipy.io import savemat  # a package that only this needs
            savemat(file, content)
        else:
            numpy.savez(file, **content)


def main():
    parser = parser_of("tools/coefficients", __doc__)
    parser.add_argument("file", type=pathlib.Path, help="CASE.h5")
    parser.add_argument("--ross", type=pathlib.Path, metavar="TOML", help="write ROSS's file")
    parser.add_argument("--xltrc", type=pathlib.Path, metavar="TXT", help="write XLTRC2's columns")
    parser.add_argument("--state-space", type=pathlib.Path, metavar="NPZ", nargs="?", const=pathlib.Path(),
                        help="write state-space matrices")
    parser.add_argument("--point", type=int, metavar="N", help="the point of a sweep, counted from 1")
    parser.add_argument("--poles", type=int, metavar="N", help="number of poles of --state-space; default: as many as 1e-5 needs")
    parser.add_argument("--velocity-term", action="store_true",
                        help="of --state-space: fit E as well; without it E is zero, as of gas that is squeezed fast")
    parser.add_argument("--accept-deviation", action="store_true",
                        help=f"of --state-space: write matrices that are more than {REFUSED:g} off, too")
    options = parser.parse_args()
    if options.ross is None and options.xltrc is None and options.state_space is None:
        stop("nothing to write: name --ross TOML, --xltrc TXT or --state-space")
    if options.state_space is None and (options.poles is not None or options.velocity_term or options.accept_deviation):
        stop("--poles and --velocity-term are of --state-space")
    if options.state_space == pathlib.Path():
        options.state_space = options.file.with_suffix(".state_space.npz")
    try:
        over_speed = options.ross is not None and options.point is None and is_sweep(options.file)
        over = read_speeds(options.file) if over_speed else None
        data = None if over_speed and options.xltrc is options.state_space is None else read_coefficients(options.file, options.point)
    except Unreadable as error:
        stop(str(error))
    except FileNotFoundError:
        stop(f"{options.file}: there is no such file")
    ross = "for ROSS 3, over speed and frequency" if over_speed else "for ROSS 2 and 3, over the frequency"
    for path, writer, words in ((options.ross, lambda: ross_writer(over, data, options.file.stem), f" ({ross})"),
                                (options.xltrc, lambda: table_writer(xltrc_text, data, options.file.stem), ""),
                                (options.state_space, lambda: state_space_writer(options, data), "")):
        if path is None:
            continue
        write = writer()
        try:
            with fresh(path) as place:
                write(place)
        except OSError as error:
            stop(f"{path}: {error.strerror}", 3)
        print(f"written: {path}{words}")
        if path == options.ross:
            used = over if over_speed else data
            if used is not None and used[-1].shape[-1] < MOTIONS[0]:
                say(f"{options.file}: {TILTS_LOST}")
    return 0
