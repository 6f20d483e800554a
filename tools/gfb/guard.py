"""What of an HDF5 file is looked at before anything in it is read: that all of it lies in this file, and how much it holds.

A result file may come from anywhere. HDF5 follows a link into another file, and reads a dataset whose numbers or words another
file holds, without a word; and a few kilobytes of compressed zeros are as many numbers as somebody likes."""

import h5py
import numpy

from gfb.case import Case

MODEST = 2**27  # bytes that the arrays of any file may hold together: less than any tool needs for a picture
FOLDED = 100    # of more the bytes a byte of the file may stand for: gfb's own fields, which it compresses, stay below 20
KINDS = {h5py.h5l.TYPE_SOFT: "a soft link", h5py.h5l.TYPE_EXTERNAL: "a link into another file"}
HISTORY = b"history/"
ECHO = b"scene/used"
TEXTS = (ECHO, b"scene/case_file")


def look_through(file, size):
    """Raises ValueError, which names the object, where an open file of so many bytes is not closed in itself, holds more than it can
    stand for, has a history that is no table of numbers, or an echo of its case that is none."""
    arrays = arrays_of(file)
    held = sum(bytes_of(data) for data in arrays.values())
    if held > max(MODEST, FOLDED*size):
        name = max(arrays, key=lambda one: bytes_of(arrays[one]))
        raise ValueError(f"{name.decode('utf-8', 'replace')}: the file's {size:,} bytes stand for {held:,}, most of them here")
    rows = set()
    for name, data in arrays.items():
        if name.startswith(HISTORY):
            rows.add(column_rows(name, data))
    if len(rows) > 1:
        raise ValueError(f"history: its columns have {min(rows)} to {max(rows)} rows")
    for name in TEXTS:
        if name in arrays:
            check_text(name, arrays[name])


def arrays_of(file):
    """{path: dataset of h5py's lower level} of all that a file holds; a group or dataset of several names under each."""
    names = []

    def take(name, info):
        if info.type == h5py.h5l.TYPE_HARD:
            return names.append(name)
        return f"{name.decode('utf-8', 'replace')}: {KINDS.get(info.type, 'a link of an unknown kind')}, which is not followed"

    refused = file.id.links.visit(take, info=True)  # ends with what is not None; it cannot raise from inside
    if refused:
        raise ValueError(refused)
    arrays = {}
    for name in names:
        item = h5py.h5o.open(file.id, name)
        if isinstance(item, h5py.h5d.DatasetID):
            laid = item.get_create_plist()
            if laid.get_external_count() or laid.get_layout() == h5py.h5d.VIRTUAL:
                raise ValueError(f"{name.decode('utf-8', 'replace')}: its contents lie in another file, which is not read")
            arrays[name] = item
    return arrays


def bytes_of(data):
    """Bytes of a dataset in memory; of texts those of their places."""
    return data.get_space().get_simple_extent_npoints()*data.get_type().get_size()


def column_rows(name, data):
    """Rows of a column of the history."""
    column = h5py.Dataset(data)
    words = name.decode("utf-8", "replace")
    if column.ndim != 1 or column.dtype.kind not in "fiu":
        raise ValueError(f"{words}: not one column of numbers")
    if numpy.isinf(column[...]).any():
        raise ValueError(f"{words}: an infinite number")
    return len(column)


def check_text(name, data):
    """One text, and of an echo the groups and keys of a case."""
    text = h5py.Dataset(data)
    words = name.decode()
    if text.shape != () or h5py.check_string_dtype(text.dtype) is None:
        raise ValueError(f"{words}: not one text")
    if name == ECHO:
        try:
            groups = Case.parse(text[()].decode("utf-8", "replace")).groups
        except ValueError as error:
            raise ValueError(f"{words}: {error}") from error
        if not groups:
            raise ValueError(f"{words}: no group of a case")
