"""Files of several steps, CASE.film.steps.vtkhdf and the like: which values they have, and one step as a file of its own."""

import pathlib

import h5py
import numpy

from gfb.guard import FOLDED, MODEST
from gfb.results import attribute

ENDING = ".steps.vtkhdf"


def has_steps(file):
    """Whether a grid file has steps."""
    return "VTKHDF/Steps" in file


def count(file):
    """How many steps it has. ValueError where they stand for more than the file can hold: steps may share their numbers."""
    grid, steps = file["VTKHDF"], file["VTKHDF/Steps"]
    many = int(steps.attrs["NSteps"])
    if not 0 < many <= len(steps["PartOffsets"]):
        raise ValueError(f"VTKHDF/Steps: {many:,} steps, and places of {len(steps['PartOffsets']):,}")
    bytes_a_step = int(grid["NumberOfPoints"][...].max())*sum(data.dtype.itemsize*int(numpy.prod(data.shape[1:], dtype=float))
                                                              for data in (grid["Points"], *grid["PointData"].values()))
    if many*bytes_a_step > max(MODEST, FOLDED*file.id.get_filesize()):
        raise ValueError(f"VTKHDF/Steps: {many:,} steps stand for {many*bytes_a_step:,} bytes")
    return many


def value(file, step):
    """Name, unit and number of what a step, from 0, has a value of."""
    (name, data), = file["VTKHDF/FieldData"].items()
    return name, attribute(data, "unit"), float(data[step])


def beside(path):
    """The file of all steps beside one of a single answer; None where there is none."""
    other = path.with_name(path.name.removesuffix(".vtkhdf") + ENDING)
    return other if other.exists() else None


def alone(path):
    """The path that a file of one step would have."""
    return pathlib.Path(str(path).removesuffix(ENDING) + ".vtkhdf") if str(path).endswith(ENDING) else path


def at_step(file, step):
    """A step, from 0, as a grid file without steps, in memory; to be closed."""
    grid, steps = file["VTKHDF"], file["VTKHDF/Steps"]
    part = int(steps["PartOffsets"][step])
    points, cells, corners = (int(grid[name][part]) for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"))
    point, cell, corner = (int(steps[name][step].item()) for name in ("PointOffsets", "CellOffsets", "ConnectivityIdOffsets"))
    one = h5py.File(f"{file.filename} step {step}", "w", driver="core", backing_store=False)
    one["VTKHDF/Points"] = grid["Points"][point:point + points]
    one["VTKHDF/Connectivity"] = grid["Connectivity"][corner:corner + corners]
    for group, entries in (("PointData", points), ("CellData", cells)):
        one.require_group(f"VTKHDF/{group}")
        for name, data in grid[group].items():
            first = int(steps[f"{group}Offsets/{name}"][step])
            one[f"VTKHDF/{group}/{name}"] = data[first:first + entries]
            one[f"VTKHDF/{group}/{name}"].attrs.update(data.attrs)
    return one
