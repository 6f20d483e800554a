#!/usr/bin/env python3
"""The result files: what h5py and vtk find in them, and that every number has a unit and a meaning."""

import pathlib
import sys
import tempfile

import h5py
import numpy

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import VTK_QUAD
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError:
    vtkHDFReader = None  # pip could not fetch it: tools/test says so

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]/"verification"))
from gfb_run import Bearing, Checks, run  # noqa: E402

BEARING = Bearing()
CASES = {
    "pad": (BEARING, {"eccentricity": (5.0e-6, 8.0e-6)}),
    "ring": (Bearing(leading_edge_condition="periodic"), {"eccentricity": (5.0e-6, 8.0e-6)}),
    "whole": (BEARING, {"load": (-20.0, 5.0), "tilt": (1.0e-4, 0.0)}),
    "sweep": (BEARING, {"load": (-20.0, 5.0), "foil": "elastic_foundation", "groups": {
        "model": {"foundation_stiffness": 2.0e10}, "sweep": {"parameter": "load", "values": (5.0, 20.0, 50.0)}}}),
}
MESH = (48, 12)
UNITS = {"m", "N", "N m", "W", "Pa", "deg", "rad", "1", "s", "B", "rpm", "m^2", ""}


def word(value):
    """Text of an attribute or dataset."""
    return value.decode() if isinstance(value, bytes) else str(value)


def check_datasets(checks, name, path):
    """Unit and meaning of every dataset."""
    wrong = []

    def visit(place, item):
        if not isinstance(item, h5py.Dataset):
            return
        if not {"unit", "meaning"} <= set(item.attrs):
            wrong.append(f"{place}: attributes {sorted(item.attrs)}")
        elif word(item.attrs["unit"]).strip() not in UNITS or not word(item.attrs["meaning"]).strip():
            wrong.append(f"{place}: '{word(item.attrs['unit'])}', '{word(item.attrs['meaning'])}'")
        elif item.dtype.kind == "f" and not word(item.attrs["unit"]).strip():
            wrong.append(f"{place}: a number without a unit")

    with h5py.File(path, "r") as file:
        file.visititems(visit)
    checks.that(f"{name}: unit and meaning of every dataset {wrong or ''}", not wrong)


def check_case_file(checks, name, answer, case_path):
    """Scene, provenance, summary and history."""
    with h5py.File(f"{answer.stem}.h5", "r") as file:
        checks.that(f"{name}: groups", {"scene", "provenance", "summary", "history"} <= set(file))
        verbatim = word(file["scene/case_file"][()])
        checks.that(f"{name}: the case file verbatim", verbatim == case_path.read_text(encoding="utf-8"))
        used = word(file["scene/used"][()])
        echo = pathlib.Path(f"{answer.stem}.used.nml").read_text(encoding="utf-8")
        checks.that(f"{name}: the echo too", used == echo)
        summary = file["summary"]
        checks.that(f"{name}: names of the summary", set(summary) == set(answer.summary))
        same = all(summary[key][()] == value for key, value in answer.summary.items() if isinstance(value, float))
        checks.that(f"{name}: its numbers, to the last digit", same)
        checks.that(f"{name}: its units", all(
            word(summary[key].attrs["unit"]).strip() == answer.units[key] for key, value in answer.summary.items()
            if isinstance(value, float)))
        checks.that(f"{name}: converged", summary["converged"][()] == 1.0 and answer["converged"] == "true")
        checks.that(f"{name}: provenance", {"program_version", "commit", "compiler", "libraries", "blas", "command",
                                            "host", "date", "ranks"} <= set(file["provenance"]))
        checks.that(f"{name}: ranks", file["provenance/ranks"][()] == 1.0)
        rows = {len(column) for column in file["history"].values()}
        checks.that(f"{name}: rows of the history", rows == {3 if name == "sweep" else 1})
        last = [file["history"][key][-1] == value for key, value in answer.physical().items()]
        checks.that(f"{name}: the last row is the summary", all(last))


def check_film_by_vtk(checks, name, bearing, answer):
    """ParaView's reader finds a grid of quadrilaterals with its fields."""
    reader = vtkHDFReader()
    reader.SetFileName(f"{answer.stem}.film.vtkhdf")
    checks.that(f"{name}: vtk can read the film", reader.CanReadFile(f"{answer.stem}.film.vtkhdf") == 1)
    reader.Update()
    grid = reader.GetOutput()
    stations, rows = MESH[0] + 1, MESH[1] + 1
    checks.that(f"{name}: points", grid.GetNumberOfPoints() == stations*rows)
    checks.that(f"{name}: cells", grid.GetNumberOfCells() == MESH[0]*MESH[1])
    kinds = {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}
    checks.that(f"{name}: all quadrilaterals", kinds == {VTK_QUAD})
    points = vtk_to_numpy(grid.GetPoints().GetData())
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    checks.that(f"{name}: every point belongs to a cell", set(corners.flat) == set(range(stations*rows)))
    x, z = points[corners, 0], points[corners, 2]
    area = 0.5*((x[:, 2] - x[:, 0])*(z[:, 3] - z[:, 1]) - (x[:, 3] - x[:, 1])*(z[:, 2] - z[:, 0]))
    checks.that(f"{name}: cells run counter-clockwise", area.min() > 0.0)
    whole = 2.0*numpy.pi*bearing.radius*bearing.length
    checks.below(f"{name}: they cover the pad", area.sum()/whole - 1.0, 1.0e-12)
    checks.that(f"{name}: the pad is flat", not points[:, 1].any())
    checks.below(f"{name}: symmetric about z = 0", (points[:, 2].min() + points[:, 2].max())/bearing.length, 1.0e-15)
    data = grid.GetPointData()
    fields = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    checks.that(f"{name}: fields", {"theta", "pressure", "gap", "deflection"} <= set(fields))
    checks.that(f"{name}: only numbers", all(numpy.isfinite(field).all() for field in fields.values()))
    checks.that(f"{name}: largest and smallest pressure", fields["pressure"].max() == answer["maximum_pressure"]
                and fields["pressure"].min() == answer["minimum_pressure"])
    checks.below(f"{name}: smallest gap", fields["gap"].min()/answer["minimum_gap"] - 1.0, 1.0e-14)
    edge = numpy.abs(points[:, 2]) == points[:, 2].max()
    checks.that(f"{name}: ambient pressure at the bearing edges",
                (fields["pressure"][edge] == bearing.ambient_pressure).all())


def check_choice(checks, folder):
    """`fields` says what the film file holds; with none there is no film file."""
    cases = ((("gap",), {"theta", "gap"}), (("pressure", "deflection"), {"theta", "pressure", "deflection"}))
    for wanted, expected in cases:
        answer = run(folder, "fields", BEARING, mesh=MESH, number=2.0, eccentricity=(0.0, 5.0e-6),
                     groups={"output": {"fields": wanted}})
        with h5py.File(f"{answer.stem}.film.vtkhdf", "r") as file:
            checks.that(f"fields = {wanted}", set(file["VTKHDF/PointData"]) == expected)
    run(folder, "nothing", BEARING, mesh=MESH, number=2.0, eccentricity=(0.0, 5.0e-6),
        groups={"output": {"fields": "none"}})
    checks.that("fields = none: no film file", not (folder/"nothing.film.vtkhdf").exists())
    checks.that("fields = none: the others are there", (folder/"nothing.summary").exists())


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for case, (bearing, keys) in CASES.items():
            answer = run(folder, case, bearing, mesh=MESH, number=2.0, **keys)
            for ending in ("h5", "film.vtkhdf"):
                check_datasets(checks, f"{case}.{ending}", f"{answer.stem}.{ending}")
            check_case_file(checks, case, answer, folder/f"{case}.nml")
            if vtkHDFReader is not None:
                check_film_by_vtk(checks, case, bearing, answer)
        check_choice(checks, folder)
        if vtkHDFReader is None:
            print("       no vtk in this Python: its reader is not asked")
        checks.that("nothing unfinished left", not list(folder.glob(".gfb*")))
    checks.close()


if __name__ == "__main__":
    main()
