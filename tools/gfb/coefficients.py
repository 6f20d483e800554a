"""Writes a bearing's stiffness and damping for rotor codes.

  tools/coefficients CASE.h5 --ross NAME.toml    a BearingElement of ROSS: ross.BearingElement.load("NAME.toml")
  tools/coefficients CASE.h5 --xltrc NAME.txt    columns as XLTRC2's: frequency [rpm], K [N/m], C [N s/m]

CASE.h5 is of analysis = 'linear_dynamics'. Both hold the four coefficients of x and y over the frequency of vibration, at
the one speed of the case: for stability take them at the frequency of the mode, not at the speed.
"""

import argparse
import json
import math
import pathlib

from gfb.results import Unreadable, open_results, reading
from gfb.tool import stop

PLANE = (("xx", 0, 0), ("xy", 0, 1), ("yx", 1, 0), ("yy", 1, 1))  # name, row, column


def read_coefficients(path):
    """Frequencies [rad/s], K and C (frequency, row, column) in SI."""
    with reading(path), open_results(path) as file:
        if "dynamics" not in file:
            raise ValueError("no stiffness and damping in it; they are of analysis = 'linear_dynamics'")
        return tuple(file[f"dynamics/{name}"][...] for name in ("frequency", "stiffness", "damping"))


def columns_of(stiffness, damping):
    """{kxx: values over frequency, ..., cyy: ...}."""
    return {kind + name: values[:, row, column] for kind, values in (("k", stiffness), ("c", damping))
            for name, row, column in PLANE}


def ross_text(frequency, columns, name):
    """A BearingElement as ROSS saves it; node 0."""
    lines = [f"[{json.dumps('BearingElement_' + name)}]", "n = 0", f"tag = {json.dumps(name)}", "scale_factor = 1"]
    for key, values in sorted({**columns, "frequency": frequency}.items()):
        lines.append(f"{key} = [{', '.join(repr(float(value)) for value in values)}]")
    return "\n".join(lines) + "\n"


def xltrc_text(frequency, columns, name):
    """Columns with a heading; frequencies in rpm."""
    heads = ["Freq[rpm]"] + [f"{key.capitalize()}[{'N/m' if key[0] == 'k' else 'N-s/m'}]" for key in columns]
    lines = [f"* {name}: the frequency is that of the vibration, at one speed of the shaft", "".join(f"{head:>16}" for head in heads)]
    for i, omega in enumerate(frequency):
        lines.append("".join(f"{value:16.7e}" for value in (omega*30.0/math.pi, *(values[i] for values in columns.values()))))
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(prog="tools/coefficients", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=pathlib.Path, help="CASE.h5")
    parser.add_argument("--ross", type=pathlib.Path, metavar="TOML", help="write ROSS's file")
    parser.add_argument("--xltrc", type=pathlib.Path, metavar="TXT", help="write XLTRC2's columns")
    options = parser.parse_args()
    if options.ross is None and options.xltrc is None:
        stop("nothing to write: name --ross TOML or --xltrc TXT")
    try:
        frequency, stiffness, damping = read_coefficients(options.file)
    except Unreadable as error:
        stop(str(error))
    except FileNotFoundError:
        stop(f"{options.file}: there is no such file")
    columns = columns_of(stiffness, damping)
    for path, text_of in ((options.ross, ross_text), (options.xltrc, xltrc_text)):
        if path is None:
            continue
        try:
            path.write_text(text_of(frequency, columns, options.file.stem), encoding="utf-8")
        except OSError as error:
            stop(f"{path}: {error.strerror}", 3)
        print(f"written: {path}")
    return 0
