"""What gfb leaves behind: summaries, histories, films, and PETSc's log."""

import contextlib
import csv
import json
import os
import pathlib
import re
import zlib

import h5py

from gfb import guard
from gfb.files import Unfit, is_kept, opened, read_text
from gfb.namelist import Places

# Names of the summary that say what the answer cost, not what it is.
COST = {"unknowns", "newton_iterations", "factorizations", "factorizations_finest", "wall_time", "peak_memory"}


# What gfb writes behind the bytes of an HDF5 file: their checksum and their number.
SEAL = re.compile(rb"gfb crc32 ([0-9a-f]{8}) ([0-9a-f]{16})\n$")
SEAL_LENGTH = 36
PIECE = 2**20  # bytes of a file that are looked at together
PLAIN = b"gfb crc32 ******** ****************\n"  # what of it is always there
# What reading a file of another kind ends in.
BROKEN = (OSError, KeyError, IndexError, ValueError, TypeError, RuntimeError, AttributeError, ArithmeticError, MemoryError)


class Unreadable(Unfit):
    """A result file that is damaged, cut or none of this gfb; says so in one line."""


@contextlib.contextmanager
def reading(path):
    """What goes wrong inside is the file's fault; one that is not there is distinguished, by FileNotFoundError."""
    try:
        yield
    except (Unreadable, FileNotFoundError):
        raise
    except Unfit as error:
        raise Unreadable(str(error)) from error
    except BROKEN as error:
        words = " ".join(str(error).split()) or type(error).__name__
        raise Unreadable(f"{path}: not a whole file of this gfb: {words}") from error


def open_results(path):
    """An HDF5 file of gfb for reading; OSError where its bytes do not fit its checksum, and where guard.look_through refuses it.
    One without checksum, of an older version or another program, is read as it is."""
    try:
        number = opened(path)
    except Unfit as error:
        raise Unreadable(str(error)) from None
    try:
        size = compare_seal(number)
        # Kept within a folder, it must be the file that was looked at; HDF5 knows names alone.
        file = h5py.File(f"/proc/self/fd/{number}" if is_kept() else path, "r")
    finally:
        os.close(number)
    try:
        with reading(path):
            guard.look_through(file, size)
    except BaseException:
        file.close()
        raise
    return file


def compare_seal(number):
    """Bytes of an open file, which must fit its checksum where it has one."""
    with open(number, "rb", closefd=False) as content:
        length = content.seek(0, 2)
        content.seek(max(0, length - SEAL_LENGTH))
        tail = content.read()
        seal = SEAL.search(tail)
        if seal:
            content.seek(0)
            check, left = 0, length - SEAL_LENGTH
            while left > 0:
                piece = content.read(min(left, PIECE))
                check, left = zlib.crc32(piece, check), left - (len(piece) or left)
            if (int(seal[1], 16), int(seal[2], 16)) != (check, length - SEAL_LENGTH):
                raise OSError("damaged: its contents do not fit its checksum")
        elif is_broken_seal(tail):
            raise OSError("damaged: its checksum is cut or changed")
    return length


def is_broken_seal(tail):
    """Whether a file's end was a checksum: its beginning, cut, or most of its fixed characters."""
    kept = sum(one == other for one, other in zip(tail, PLAIN) if other != PLAIN[10])
    return kept > 6 or PLAIN[:10] in tail


def seal(path):
    """Puts the checksum behind a file that was changed on purpose."""
    content = pathlib.Path(path).read_bytes()
    if SEAL.search(content[-SEAL_LENGTH:]):
        content = content[:-SEAL_LENGTH]
    pathlib.Path(path).write_bytes(content + b"gfb crc32 %08x %016x\n" % (zlib.crc32(content), len(content)))


def read_summary(path):
    """{name: number or word} and {name: unit} of a summary file."""
    values, units = {}, {}
    with reading(path):
        for line in read_text(path).splitlines():
            name, rest = line.split(" = ", 1)
            word, _, unit = rest.partition(" [")
            units[name] = unit.rstrip("]")
            try:
                values[name] = float(word)
            except ValueError:
                values[name] = word
    return values, units


def read_history(path):
    """{column: values, a row each} of the history in a case's HDF5 file."""
    with reading(path), open_results(path) as file:
        return {name: data[...] for name, data in file["history"].items()}


def read_film(path):
    """{field: values on (station, row)} of a film file: x, z, theta, pressure, gap, ..."""
    with reading(path), open_results(path) as file:
        points = file["VTKHDF/Points"][...]
        fields = {name: data[...] for name, data in file["VTKHDF/PointData"].items()}
        rows = int((points[:, 0] == points[0, 0]).sum())
        fields |= {"x": points[:, 0], "z": points[:, 2]}
        return {name: data.reshape(len(points)//rows, rows) for name, data in fields.items()}


def read_json(path, *names):
    """What a tool has kept in a JSON file; under the names given, which must be there."""
    with reading(path):
        content = json.loads(read_text(path))
        return tuple(content[name] for name in names) if names else content


def text_of(value):
    """A text from an HDF5 file."""
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def used_keys(file):
    """{(group, key): (its value as the echo of the case has it, whether it is a default)} of a case's HDF5 file."""
    places = Places(text_of(file["scene/used"][()]))
    return {key: (places.words(*key), key in places.defaults) for key in places.values}


def attribute(data, name):
    """A text attribute."""
    return text_of(data.attrs[name])


def read_petsc_log(path):
    """{stage: {event: (calls, seconds)}} of PETSc's log (-log_view :FILE:ascii_csv); "summary": the whole stage."""
    stages: dict[str, dict[str, tuple[float, float]]] = {}
    with open(path, encoding="utf-8", newline="") as log:
        for stage, event, _, calls, seconds, *_ in csv.reader(log):
            if event == "Event Name":
                continue
            events = stages.setdefault(stage, {})
            before = events.get(event, (0.0, 0.0))  # older PETSc has a line for each registration
            if float(calls) > 0.0:
                events[event] = (before[0] + float(calls), before[1] + float(seconds))
    return stages
