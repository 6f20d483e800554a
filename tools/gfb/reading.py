"""`gfb.read`: result files of gfb as xarray datasets, with units and meanings."""

from __future__ import annotations

import os
import pathlib

import h5py
import numpy
import xarray

from gfb import steps
from gfb.results import Unreadable, open_results, reading, text_of

SAME_ANGLE = 1.0e-9  # rad
PROVENANCE = ("scene", "provenance")  # groups whose texts become attributes


def read(path: str | os.PathLike[str]) -> xarray.Dataset:
    """A result file, `<case>.h5` or a surface `<case>.<part>.vtkhdf`.

    A case file: every number of the summary is a variable without dimension. Where the case has several points or load
    steps, names of the history have a value each along `point`. Other arrays are called by their path, such as
    `contact_top_normal_force`. A film: fields over `theta` and `z`, of sectors over `theta` and `radius`; a foil: fields over `node`; of `<case>.<part>.steps.vtkhdf` also
    along `point`, with what the sweep changes as its coordinate. Every variable has
    `units` and `long_name`; texts, such as the case itself, are attributes. Raises `FileNotFoundError`, and
    `gfb.results.Unreadable` (an `OSError`) for what is damaged or none of gfb's files."""
    path = pathlib.Path(path)
    with reading(path), open_results(path) as file:
        if steps.has_steps(file):
            return series(path, file)
        if "VTKHDF" in file:
            return surface(file["VTKHDF"])
        if "summary" not in file and "history" not in file:
            raise ValueError("neither a case nor a surface of gfb")
        return case(file)


def described(data: h5py.Dataset) -> dict[str, str]:
    """The attributes of a variable."""
    names = (("units", "unit"), ("long_name", "meaning"))
    return {ours: text_of(data.attrs[theirs]) for ours, theirs in names if theirs in data.attrs}


def is_text(data: h5py.Dataset) -> bool:
    """Whether a dataset holds words."""
    return data.dtype.kind in "SOU"


def case(file: h5py.File) -> xarray.Dataset:
    """A case file."""
    variables, attributes = {}, {}
    history = {name: data for name, data in file.get("history", {}).items() if isinstance(data, h5py.Dataset)}
    points = len(next(iter(history.values()))) if history else 0
    for name, data in file.get("summary", {}).items():
        if is_text(data):
            attributes[name] = text_of(data[()])
        else:
            variables[name] = xarray.Variable((), data[()], described(data))
    for name, data in history.items():
        if points != 1 and not is_text(data):
            variables[name] = xarray.Variable(("point",), data[...], described(data))
        elif name not in variables and not is_text(data):
            variables[name] = xarray.Variable((), data[0], described(data))
    for group in PROVENANCE:
        attributes |= {name: text_of(data[()]) for name, data in file.get(group, {}).items() if is_text(data)}

    def take(path: str, data: object) -> None:
        if isinstance(data, h5py.Dataset) and path.split("/")[0] not in ("summary", "history", *PROVENANCE):
            dims = dimensions(path, data.shape, points)
            variables[path.replace("/", "_")] = xarray.Variable(dims, data[...], described(data))

    file.visititems(take)
    return xarray.Dataset(variables, attrs=attributes)


def dimensions(path: str, shape: tuple[int, ...], points: int) -> tuple[str, ...]:
    """Names of the dimensions of an array that stands beside summary and history."""
    group = path.rpartition("/")[0].replace("/", "_")
    if group.startswith("contact"):
        return (("point", f"{group}_node") if len(shape) == 2 and shape[0] == points
                else tuple(f"{group}_{'node' if i == len(shape) - 1 else 'step'}" for i in range(len(shape))))
    return tuple(f"{path.replace('/', '_')}_{i}" for i in range(len(shape)))


def series(path: pathlib.Path, file: h5py.File) -> xarray.Dataset:
    """The film, or a foil, at all points of a sweep."""
    found, numbers = [], []
    for step in range(steps.count(file)):
        name, unit, number = steps.value(file, step)
        numbers.append(number)
        with steps.at_step(file, step) as one:
            found.append(surface(one["VTKHDF"]))
    if any(other.sizes != found[0].sizes for other in found):
        raise Unreadable(f"{path}: nodes differ from point to point, which makes no one dataset")
    return xarray.concat(found, "point").assign_coords({name: ("point", numbers, {"units": unit})})


def surface(group: h5py.Group) -> xarray.Dataset:
    """The film, or a foil."""
    points = group["Points"][...]
    fields = {name: (data[...], described(data)) for name, data in group["PointData"].items()}
    if "theta" in fields:
        theta = fields.pop("theta")[0]
        ring = bool(numpy.ptp(points[:, 1]) > numpy.ptp(points[:, 2]))  # sectors lie across the axis
        rows = int(numpy.argmax(abs(theta - theta[0]) > SAME_ANGLE)) if ring else int((points[:, 0] == points[0, 0]).sum())
        shape = (len(points)//rows, rows)
        coordinates = {"theta": ("theta", theta.reshape(shape)[:, 0], {"units": "rad"})}
        across = "radius" if ring else "z"
        if ring:
            coordinates["radius"] = ("radius", numpy.hypot(points[:rows, 0], points[:rows, 1]), {"units": "m"})
        else:
            coordinates["x"] = ("theta", points[:, 0].reshape(shape)[:, 0], {"units": "m"})
            coordinates["z"] = ("z", points[:, 2].reshape(shape)[0], {"units": "m"})
        return xarray.Dataset({name: (("theta", across), values.reshape(shape), words) for name, (values, words) in fields.items()},
                              coords=coordinates)
    coordinates = {axis: ("node", points[:, i], {"units": "m"}) for i, axis in enumerate("xyz")}
    return xarray.Dataset({name: (("node", "component")[:numpy.ndim(values)], values, words)
                           for name, (values, words) in fields.items()}, coords=coordinates)
