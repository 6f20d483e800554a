"""What of an HDF5 file is looked at before anything in it is read: that all of it lies in this file, how much it holds and how deep.

A result file may come from anywhere. HDF5 follows a link into another file, and reads a dataset whose numbers or words another
file holds, without a word; and a few kilobytes are as many numbers, groups and names as somebody likes."""

import h5py
import numpy

from gfb.files import MOST_TEXT
from gfb.namelist import groups_of

MODEST = 2**27  # bytes that the arrays of any file may hold together: less than any tool needs for a picture
FOLDED = 100    # of more the bytes a byte of the file may stand for: gfb's own fields, which it compresses, stay below 20
MOST_OBJECTS = 10_000     # groups and arrays: of gfb's own files those with the most derivatives have some thousand
MOST_ATTRIBUTES = 100     # of one of them
DEEPEST = 8               # groups in groups; gfb's own have four
KINDS = {h5py.h5l.TYPE_SOFT: "a soft link", h5py.h5l.TYPE_EXTERNAL: "a link into another file"}
NUMBERS = (h5py.h5t.INTEGER, h5py.h5t.FLOAT)
HISTORY = b"history/"
ECHO = b"scene/used"
SCENE = b"scene/"  # texts alone


def look_through(file, size):
    """Raises ValueError, which names the object, where an open file of so many bytes is not closed in itself, holds more than it can
    stand for, or more objects than results have, has a history that is no table of numbers, or an echo of its case that is none."""
    arrays = arrays_of(file)
    sizes = {name: bytes_of(name, data, size) for name, data in arrays.items()}
    held = sum(sizes.values())
    if held > max(MODEST, FOLDED*size):
        name = max(sizes, key=lambda one: sizes[one])
        raise ValueError(f"{words_of(name)}: the file's {size:,} bytes stand for {held:,}, most of them here")
    rows = set()
    for name, data in arrays.items():
        if name.startswith(HISTORY):
            rows.add(column_rows(name, data))
    if len(rows) > 1:
        raise ValueError(f"history: its columns have {min(rows)} to {max(rows)} rows")
    for name, data in arrays.items():
        if name.startswith(SCENE):
            check_text(name, data, sizes[name])


def words_of(name):
    """A name as it is printed: of a long one the beginning."""
    return (name if len(name) < 100 else name[:100] + b"...").decode("utf-8", "replace")


def arrays_of(file):
    """{path: dataset of h5py's lower level} of all that a file holds; a dataset of several names under each, a group under one."""
    root = h5py.h5g.open(file.id, b"/")
    arrays, seen, found, left = {}, {h5py.h5o.get_info(root).addr}, 0, [(b"", root)]
    while left:
        above, group = left.pop()
        found += group.get_num_objs()
        if found > MOST_OBJECTS:
            raise ValueError(f"{words_of(above) or '/'}: more than {MOST_OBJECTS:,} groups and arrays, which are not read")
        for last in group:
            name = above + b"/" + last if above else last
            kind = group.links.get_info(last).type
            if kind != h5py.h5l.TYPE_HARD:
                raise ValueError(f"{words_of(name)}: {KINDS.get(kind, 'a link of an unknown kind')}, which is not followed")
            item = h5py.h5o.open(group, last)
            if h5py.h5a.get_num_attrs(item) > MOST_ATTRIBUTES:
                raise ValueError(f"{words_of(name)}: more than {MOST_ATTRIBUTES} attributes")
            if isinstance(item, h5py.h5d.DatasetID):
                arrays[name] = whole(name, item)
            elif isinstance(item, h5py.h5g.GroupID) and (place := h5py.h5o.get_info(item).addr) not in seen:
                if name.count(b"/") >= DEEPEST:
                    raise ValueError(f"{words_of(name)}: more than {DEEPEST} groups in groups, which are not read")
                seen.add(place)
                left.append((name, item))
    return arrays


def whole(name, data):
    """A dataset, whose contents must lie in this file and be numbers or words."""
    laid = data.get_create_plist()
    if laid.get_external_count() or laid.get_layout() == h5py.h5d.VIRTUAL:
        raise ValueError(f"{words_of(name)}: its contents lie in another file, which is not read")
    if data.get_type().get_class() not in (*NUMBERS, h5py.h5t.STRING):
        raise ValueError(f"{words_of(name)}: neither numbers nor words")
    return data


def bytes_of(name, data, size):
    """Bytes of a dataset in memory, of a file of so many bytes: those of its largest piece where it is kept in larger ones than itself,
    and of words of any length no more each than the file has."""
    laid, kind = data.get_create_plist(), data.get_type()
    entries = data.get_space().get_simple_extent_npoints()
    if kind.get_class() == h5py.h5t.STRING and kind.is_variable_str():
        return entries*size
    if laid.get_layout() == h5py.h5d.CHUNKED:
        entries = max(entries, int(numpy.prod(laid.get_chunk(), dtype=float)))
    return entries*kind.get_size()


def column_rows(name, data):
    """Rows of a column of the history."""
    column = h5py.Dataset(data)
    words = words_of(name)
    if column.ndim != 1 or column.dtype.kind not in "fiu":
        raise ValueError(f"{words}: not one column of numbers")
    if numpy.isinf(column[...]).any():
        raise ValueError(f"{words}: an infinite number")
    return len(column)


def check_text(name, data, held):
    """One text, and of an echo the groups and keys of a case."""
    text = h5py.Dataset(data)
    words = name.decode()
    if text.shape != () or h5py.check_string_dtype(text.dtype) is None:
        raise ValueError(f"{words}: not one text")
    if held > MOST_TEXT and not data.get_type().is_variable_str() or len(content := text[()]) > MOST_TEXT:
        raise ValueError(f"{words}: a text of more than {MOST_TEXT//2**20} MB")
    if name == ECHO:
        try:
            groups = groups_of(content.decode("utf-8", "replace"))
        except ValueError as error:
            raise ValueError(f"{words}: {error}") from error
        if not groups:
            raise ValueError(f"{words}: no group of a case")
