"""The one way in which files are opened that somebody else may have made: regular ones alone, a pipe is not waited for, and a text no
longer than one of a case. Within a folder, as the page in the browser reads, nothing outside of it and no link."""

import contextlib
import contextvars
import os
import pathlib
import secrets
import stat
from typing import Optional

MOST_TEXT = 2**22  # bytes of a case, or of a summary; the program reads a quarter of it
CALM = os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY
_within: contextvars.ContextVar[Optional[pathlib.Path]] = contextvars.ContextVar("within", default=None)  # the folder, where a part of the work keeps to one


class Unfit(OSError):
    """A file that is not opened; its text says which, and why."""


@contextlib.contextmanager
def kept_within(folder):
    """What is opened inside, by whatever of the package, lies in this folder or below, and is reached by no link."""
    before = _within.set(pathlib.Path(folder))
    try:
        yield
    finally:
        _within.reset(before)


def is_kept():
    """Whether this part of the work keeps to a folder."""
    return _within.get() is not None


def opened(path):
    """Number of a regular file, open for reading; FileNotFoundError where there is none, Unfit where it is another thing."""
    folder = _within.get()
    number = os.open(path, os.O_RDONLY | CALM) if folder is None else open_inside(folder, path)
    if not stat.S_ISREG(os.fstat(number).st_mode):
        os.close(number)
        raise Unfit(f"{path}: no file, but a folder, a pipe or a device")
    return number


def open_inside(folder, path, flags=os.O_RDONLY, mode=0o666):
    """Number of an open file of a folder, or of one below: step by step from the folder itself, so that no link leads out of it."""
    parts = pathlib.PurePath(path).relative_to(folder).parts if pathlib.PurePath(path).is_absolute() else pathlib.PurePath(path).parts
    if not parts or ".." in parts:
        raise Unfit(f"{path}: this lies outside the chosen folder")
    place = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        for part in parts[:-1]:
            below = opened_at(place, part, os.O_RDONLY | os.O_DIRECTORY, mode, path)
            os.close(place)
            place = below
        return opened_at(place, parts[-1], flags, mode, path)
    finally:
        os.close(place)


def opened_at(place, name, flags, mode, path):
    """Number of what a folder, by its number, has under a name, unless that is a link."""
    try:
        return os.open(name, flags | os.O_NOFOLLOW | CALM, mode, dir_fd=place)
    except OSError as error:
        if is_link(place, name):
            raise Unfit(f"{path}: a link, which is not followed") from None
        raise type(error)(error.errno, error.strerror, str(path)) from None


def is_link(place, name):
    """Whether a name of a folder is a link."""
    try:
        return stat.S_ISLNK(os.stat(name, dir_fd=place, follow_symlinks=False).st_mode)
    except OSError:
        return False


def read_text(path, errors="strict", most=MOST_TEXT):
    """A text file, in UTF-8, of so many bytes at most."""
    with open(opened(path), "rb") as file:
        content = file.read(most + 1) if os.fstat(file.fileno()).st_size <= most else None
    if content is None or len(content) > most:
        raise Unfit(f"{path}: a text of more than {most//2**20} MB, which is not read")
    return content.decode("utf-8", errors).replace("\r\n", "\n").replace("\r", "\n")


@contextlib.contextmanager
def fresh(path):
    """A name beside a file, which nobody can foresee: what is written there gets the file's own when it is whole. A link in its place
    is replaced, not followed; what is no file, such as a device that the user names, is written as it is."""
    path = pathlib.Path(path)
    if os.path.lexists(path) and not path.is_symlink() and not path.is_file():
        yield path
        return
    beside = path.with_name(f".{secrets.token_hex(8)}.{path.name[-100:]}")
    os.close(os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666))
    try:
        yield beside
        os.replace(beside, path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def write_inside(folder, name, text, replaces):
    """Writes a text of a folder: one that is new, under a name that is free (FileExistsError otherwise), or one in the place of an
    older one, as a whole, under a name that nobody can foresee until it is written."""
    first = f".{name[:100]}.{secrets.token_hex(8)}" if replaces else name
    place = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
    try:
        number = opened_at(place, first, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666, first)
        try:
            with open(number, "w", encoding="utf-8", newline="") as file:
                file.write(text)
            if replaces:
                os.replace(first, name, src_dir_fd=place, dst_dir_fd=place)
        except BaseException:
            os.unlink(first, dir_fd=place)
            raise
    finally:
        os.close(place)
