"""Result files of two runs compared bit by bit: every dataset and attribute, every line of a summary, every other file."""

import dataclasses
import math
import pathlib
import re

import h5py
import numpy

from gfb.files import read_text
from gfb.results import Unreadable, open_results, reading

# What two runs of one program on one case need not have alike; nothing else is left out. A name without a folder holds
# in summaries and in every group of every file.
EXCLUDED = {
    "wall_time": "time",
    "peak_memory": "memory",
    "step/elapsed": "time, in files to restart from",
    "provenance/date": "when it ran",
    "provenance/host": "where it ran",
    "provenance/command": "holds the program's path",
    "program": "which program it was",
    "provenance/program_version": "which program it was",
    "provenance/commit": "which program it was",
    "provenance/build": "which program it was",
    "provenance/blas": "its library and kernel: both programs get the kernel of the second",
    "provenance/blas@meaning": "the same",
}
ANSWERS = (".h5", ".vtkhdf", ".summary", ".nml", ".csv")  # endings of what gfb leaves
HDF5 = (".h5", ".vtkhdf")
MOST_LINES = 2**28  # bytes of a text, such as the points of a long motion
RESTART = ".restart.h5"  # two of different formats are not compared: what the runs that go on from them answer is


@dataclasses.dataclass(frozen=True)
class Difference:
    """Something that is not the same."""

    where: str                # file and name
    words: str                # how it differs
    relative: float = math.inf  # largest relative difference of its numbers; infinite where none is known


def excluded(name):
    """Whether a dataset or a line of a summary is left out."""
    return name in EXCLUDED or name.rpartition("/")[2] in EXCLUDED


def folder_differences(before, after):
    """All differences of the result files of two folders, the largest first."""
    before, after = pathlib.Path(before), pathlib.Path(after)
    ones, others = files_of(before), files_of(after)
    found = one_sided(ones, others, "file")
    for name in sorted(ones & others):
        found += file_differences(before/name, after/name, name)
    return sorted(found, key=lambda one: -one.relative)


def files_of(folder):
    """Names of the result files below a folder."""
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.name.endswith(ANSWERS)}


def one_sided(ones, others, kind, place=""):
    """What only one of two sets of names has."""
    found = []
    for name in sorted(set(ones) ^ set(others)):
        found.append(Difference(place + name, f"{kind} only {'before' if name in ones else 'after'}"))
    return found


def file_differences(before, after, name):
    """All differences of two files; one that cannot be read differs."""
    try:
        return read_differences(before, after, name)
    except Unreadable as error:
        return [Difference(name, f"cannot be read: {error}")]


def read_differences(before, after, name):
    """The same of files that can be read."""
    if name.endswith(HDF5):
        return dataset_differences(before, after, name)
    one, other = lines_of(before), lines_of(after)
    if name.endswith(".summary"):
        return summary_differences(one, other, name)
    if name.endswith(".used.nml"):
        return text_differences(keys_of(one), keys_of(other), name)
    return text_differences(one, other, name)


# --- HDF5 ---

def dataset_differences(before, after, name):
    """The same of two HDF5 files: groups, datasets, and the attributes of both."""
    one, other = contents_of(before), contents_of(after)
    if name.endswith(RESTART) and one.get("format") != other.get("format"):
        return []
    found = one_sided(one, other, "name", name + ":")
    for key in sorted(set(one) & set(other)):
        if key == "scene/used":
            texts = [numpy.asarray(file[key]).item() for file in (one, other)]
            found += text_differences(*(keys_of(text.decode().splitlines()) for text in texts), f"{name}:{key}")
            continue
        words, relative = value_difference(one[key], other[key])
        if words:
            found.append(Difference(f"{name}:{key}", words, relative))
    return found


def contents_of(path):
    """{name: array} of a file; attributes as name@attribute, groups without values."""
    contents = {}

    def add(name, item):
        if excluded(name):
            return
        contents[name] = item[()] if isinstance(item, h5py.Dataset) else None
        for attribute, value in item.attrs.items():
            contents[f"{name}@{attribute}"] = value

    with reading(path), open_results(path) as file:
        add("", file)
        file.visititems(add)
    return contents


def value_difference(one, other):
    """Words, empty where two values have the same bits, and the largest relative difference."""
    if one is None and other is None:
        return "", 0.0
    if one is None or other is None:
        return "a group in one, a dataset in the other", math.inf
    one, other = numpy.asarray(one), numpy.asarray(other)
    if one.dtype.kind in "SO" and other.dtype.kind in "SO":  # texts; an array of them holds where they are, not what
        return ("", 0.0) if one.tolist() == other.tolist() else ("other words", math.inf)
    if one.dtype != other.dtype:
        return f"type {one.dtype} before, {other.dtype} after", math.inf
    if one.shape != other.shape:
        return f"shape {one.shape} before, {other.shape} after", math.inf
    if one.tobytes() == other.tobytes():
        return "", 0.0
    if one.dtype.kind not in "fiu":
        return "other words", math.inf
    relative = relative_difference(one, other)
    return f"{unlike_entries(one, other)} of {one.size} differ, by {relative:.1e}", relative


def unlike_entries(one, other):
    """How many entries of two arrays have other bits."""
    rows = [numpy.frombuffer(array.tobytes(), dtype=numpy.uint8).reshape(array.size, -1) for array in (one, other)]
    return int((rows[0] != rows[1]).any(axis=1).sum())


def relative_difference(one, other):
    """Largest difference over the largest size; infinite where a number stands against none. Zeros of other sign: 0."""
    one, other = numpy.asarray(one, dtype=float), numpy.asarray(other, dtype=float)
    finite = numpy.isfinite(one) & numpy.isfinite(other)
    if not ((one == other) | (numpy.isnan(one) & numpy.isnan(other)) | finite).all():
        return math.inf
    difference = numpy.abs(one[finite] - other[finite]).max(initial=0.0)
    size = max(numpy.abs(one[finite]).max(initial=0.0), numpy.abs(other[finite]).max(initial=0.0))
    return float(difference/size) if difference > 0.0 else 0.0


# --- text ---

def lines_of(path):
    """Lines of a text file."""
    with reading(path):
        return read_text(path, most=MOST_LINES).splitlines()


def keys_of(lines):
    """Keys with their values, whatever group of a case file they stand in, without comments."""
    text = re.sub(r"^ *([!&/].*)?\n", "", "".join(re.sub(r" ! .*$", "", line) + "\n" for line in lines), flags=re.MULTILINE)
    return sorted(re.sub(r",\n +", ", ", text).splitlines())


def summary_differences(one, other, place):
    """Lines of two summaries, by name."""
    lines = [{line.split(" = ", 1)[0]: line for line in text if not excluded(line.split(" = ", 1)[0])}
             for text in (one, other)]
    found = one_sided(*lines, "name", place + ":")
    for name in sorted(set(lines[0]) & set(lines[1])):
        if lines[0][name] != lines[1][name]:
            found.append(line_difference(f"{place}:{name}", lines[0][name], lines[1][name]))
    if not found and list(lines[0]) != list(lines[1]):
        found.append(Difference(place, "lines in another order"))
    return found


def line_difference(where, one, other):
    """Two lines of a name."""
    values = [line.partition(" = ")[2] for line in (one, other)]
    words = f"{values[0]} before, {values[1]} after"
    try:
        numbers = [float(value.partition(" [")[0]) for value in values]
    except ValueError:
        return Difference(where, words)
    return Difference(where, words, relative_difference(*numbers))


def text_differences(one, other, name):
    """Two files of text; the first line that differs is shown."""
    if one == other:
        return []
    pairs = list(zip(one + [""]*(len(other) - len(one)), other + [""]*(len(one) - len(other))))
    unlike = [pair for pair in pairs if pair[0] != pair[1]]
    return [Difference(name, f"{len(unlike)} lines differ, first: '{unlike[0][0].strip()}' before, "
                             f"'{unlike[0][1].strip()}' after")]
