#!/usr/bin/env python3
"""Film and foils at all points of a sweep in one VTKHDF file each: every step is what the sweep that ends there writes, to
the last digit; read with h5py and with VTK's own reader; grids that move; ranks, groups, runs without an answer."""

import pathlib
import tempfile

import h5py
import numpy

from gfb_run import Checks, largest_difference, solve
from shell_bearing import BEARING, BUMPS, SHEET

SPEEDS = (10000.0, 20000.0, 30000.0)
HEIGHTS = (0.508e-3, 0.515e-3, 0.52e-3)
SURFACES = ("film", "top_foil", "bump_foil")
RANKS = 1.0e-8   # runs on other numbers of ranks agree so far
GROUPS = 1.0e-5  # points that start from nothing and from their neighbour do


def case(foil="beam", parameter="speed_rpm", values=SPEEDS, **groups):
    """A small bearing of [Gu2020]'s geometry, its shaft held, with a sweep."""
    content = {
        "scene": {"analysis": "fixed_position"},
        "bearing": {"radius": BEARING.radius, "length": BEARING.length, "clearance": BEARING.clearance},
        "gas": {"viscosity": BEARING.viscosity, "ambient_pressure": BEARING.ambient_pressure},
        "operation": {"speed_rpm": 30000.0, "eccentricity": (25.0e-6, 8.0e-6)},
        "model": {"foil": foil},
        "mesh": {"circumferential_elements": 104, "axial_elements": 4},
        "sweep": {"parameter": parameter, "values": values},
    }
    if foil == "beam":
        content |= {"top_foil": dict(SHEET), "bump_foil": {**SHEET, **BUMPS},
                    "contact": {"friction_top": 0.1, "friction_sleeve": 0.1}}
        content["mesh"] |= {"arc_elements": 4, "flat_elements": 1}
    for group, keys in groups.items():
        content.setdefault(group, {}).update(keys)
    return content


def read_alone(path):
    """Arrays of a file without steps."""
    with h5py.File(path, "r") as file:
        grid = file["VTKHDF"]
        names = ("Points", "Connectivity", "Offsets", "Types")
        found = {name: grid[name][...] for name in names}
        for group in ("PointData", "CellData"):
            found |= {f"{group}/{name}": data[...] for name, data in grid[group].items()}
        return found


def read_step(path, step):
    """The same of a step, as the VTKHDF specification says where it stands."""
    with h5py.File(path, "r") as file:
        grid, steps = file["VTKHDF"], file["VTKHDF/Steps"]
        part = int(steps["PartOffsets"][step])
        points, cells, corners = (int(grid[name][part]) for name in
                                  ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"))
        point, cell, corner = (int(steps[name][step].item()) for name in
                               ("PointOffsets", "CellOffsets", "ConnectivityIdOffsets"))
        found = {"Points": grid["Points"][point:point + points], "Types": grid["Types"][cell:cell + cells],
                 "Connectivity": grid["Connectivity"][corner:corner + corners],
                 "Offsets": grid["Offsets"][cell + part:cell + part + cells + 1]}
        for group, entries in (("PointData", points), ("CellData", cells)):
            for name, data in grid[group].items():
                first = int(steps[f"{group}Offsets/{name}"][step])
                found[f"{group}/{name}"] = data[first:first + entries]
        return found


def read_by_vtk(path, steps):
    """The same of every step by VTK's own reader, and the value that it finds there."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    reader = vtk.vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    for time in steps:
        reader.UpdateTimeStep(time)
        grid = reader.GetOutput()
        found = {"Points": vtk_to_numpy(grid.GetPoints().GetData()),
                 "Connectivity": vtk_to_numpy(grid.GetCells().GetConnectivityArray()),
                 "Offsets": vtk_to_numpy(grid.GetCells().GetOffsetsArray())}
        for group, data in (("PointData", grid.GetPointData()), ("CellData", grid.GetCellData())):
            found |= {f"{group}/{data.GetArrayName(i)}": vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
        value = grid.GetFieldData().GetArray(0)
        yield found, (value.GetName(), value.GetValue(0))


def steps_of(stem, surface):
    """File, unit of the values, values, and what the field data say they are."""
    path = pathlib.Path(f"{stem}.{surface}.steps.vtkhdf")
    with h5py.File(path, "r") as file:
        steps, fields = file["VTKHDF/Steps"], file["VTKHDF/FieldData"]
        assert steps.attrs["NSteps"] == len(steps["Values"])
        (name, data), = fields.items()
        return path, data.attrs["unit"], list(steps["Values"]), (name, list(data))


def same(one, other):
    """Whether two files' arrays are the same to the last digit."""
    return set(one) == set(other) and all(numpy.array_equal(values, other[name]) for name, values in one.items())


def check_steps(checks, folder, name, content, times=None):
    """Every step is the answer of the sweep that ends there."""
    values = content["sweep"]["values"]
    whole = solve(folder, name, content)
    ends = []
    for number in range(1, len(values) + 1):
        short = {group: dict(keys) for group, keys in content.items()}
        short["sweep"]["values"] = values[:number]
        ends.append(solve(folder, f"{name}_{number}", short))
    try:
        import vtk  # noqa: F401
        by_vtk = True
    except ImportError:
        by_vtk = False
        print("       no vtk in this Python: its reader is not asked")
    for surface in SURFACES:
        path, _, found, (_, field) = steps_of(whole.stem, surface)
        checks.that(f"{name}, {surface}: steps {found}, values {field}", found == list(times or values) and field == list(values))
        alone = [read_alone(f"{end.stem}.{surface}.vtkhdf") for end in ends]
        checks.that(f"{name}, {surface}: every step is what the sweep that ends there writes",
                    all(same(read_step(path, step), one) for step, one in enumerate(alone)))
        if not by_vtk:
            continue
        read = list(read_by_vtk(path, found))
        checks.that(f"{name}, {surface}: VTK's reader finds the same",
                    len(read) == len(alone) and all(same(one | {"Types": other["Types"]}, other)
                                                    for (one, _), other in zip(read, alone)))
        checks.that(f"{name}, {surface}: and the values {[value for _, value in read]}",
                    [value for _, (_, value) in read] == list(values))
    return whole


def grids_of(stem, surface):
    """How many grids a file has."""
    with h5py.File(f"{stem}.{surface}.steps.vtkhdf", "r") as file:
        return len(file["VTKHDF/NumberOfPoints"])


def check_others(checks, folder, whole):
    """The same sweep on two ranks and in two groups."""
    for name, ranks, options, limit in (("ranks", 2, (), RANKS), ("groups", 2, ("--groups", "2"), GROUPS)):
        place = pathlib.Path(folder)/name
        place.mkdir()
        other = solve(place, "speeds", case(), ranks, options)
        for surface in SURFACES:
            worst = 0.0
            for step in range(len(SPEEDS)):
                one, two = (read_step(steps_of(run.stem, surface)[0], step) for run in (whole, other))
                for field in ("PointData/gap", "PointData/pressure", "PointData/displacement"):
                    if field in one:
                        worst = max(worst, largest_difference(one[field], two[field]))
            checks.below(f"two {name}, {surface}: fields of all steps", worst, limit)
            checks.that(f"two {name}, {surface}: one grid", grids_of(other.stem, surface) == 1)


def check_ends(checks, folder):
    """Without fields, without a sweep, without an answer."""
    folder = pathlib.Path(folder)
    solve(folder, "none", case("rigid", output={"fields": "none"}))
    checks.that("without fields there is no series", not list(folder.glob("none.*steps*")))
    alone = case("rigid")
    del alone["sweep"]
    solve(folder, "alone", alone)
    checks.that("a single answer has none either", not list(folder.glob("alone.*steps*")))
    content = case("rigid", "load", (10.0, 20.0), scene={"analysis": "equilibrium"}, operation={"load": (-20.0, 0.0)})
    del content["operation"]["eccentricity"]
    solve(folder, "pressed", content)
    kept = (folder/"pressed.film.steps.vtkhdf").read_bytes()
    content["sweep"]["values"] = (10.0, 20.0, 1.0e7)
    solve(folder, "pressed", content, status=2)
    _, unit, found, _ = steps_of(folder/"pressed.unconverged", "film")
    checks.that(f"a sweep that ends early: the steps {found} {unit} that have an answer", found == [10.0, 20.0] and unit == "N")
    checks.that("and the older file as it was", (folder/"pressed.film.steps.vtkhdf").read_bytes() == kept)


def check_shaft_in_time(checks, folder):
    """Fields at chosen times are those of runs that end there, on any ranks; none before the first of the times."""
    def content(duration, **keys):
        made = case(scene={"analysis": "transient"}, rotor={"mass": 1.0},
                    transient={"duration": duration, "steps_per_turn": 40, "unbalance": 1.0e-6, **keys})
        del made["sweep"]
        made["operation"] = {"speed_rpm": 30000.0, "load": (-60.0, 0.0)}
        return made

    end, fields = 5.0e-4, {"field_interval": 2.5e-4}
    whole = solve(folder, "moves", content(end, **fields))
    two = solve(folder, "moves_2", content(end, **fields), ranks=2)
    late = solve(folder, "moves_late", content(end, **fields, field_start=4.0e-4))
    ends = [solve(folder, f"moves_{number}", content(duration)) for number, duration in ((3, 0.5*end), (4, end))]
    for surface in SURFACES:
        path, unit, found, (name, _) = steps_of(whole.stem, surface)
        checks.that(f"shaft in time, {surface}: at {found} {unit}", name == "time" and unit == "s" and len(found) == 3 and found[0] == 0.0)
        checks.below(f"shaft in time, {surface}: at the times asked for", largest_difference(numpy.array(found[1:]), [0.5*end, end], end), 1.0e-9)
        other = steps_of(two.stem, surface)[0]
        for step, short in ((1, ends[0]), (2, ends[1])):
            one, alone = read_step(path, step), read_alone(f"{short.stem}.{surface}.vtkhdf")
            name = "PointData/gap" if surface == "film" else "PointData/displacement"
            size = numpy.abs(alone[name]).max()
            checks.below(f"{surface}, step {step}: of a run that ends there", largest_difference(one[name], alone[name], size), 1.0e-9)
            checks.below(f"{surface}, step {step}: two ranks", largest_difference(read_step(other, step)[name], one[name], size), RANKS)
        times = steps_of(late.stem, surface)[2]
        checks.below(f"{surface}: one time from 0.4 ms on", abs(times[0] - 4.0e-4)/end if len(times) == 1 else 1.0, 1.0e-9)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        whole = check_steps(checks, folder, "speeds", case())
        checks.that("grids that stay are there once", {grids_of(whole.stem, surface) for surface in SURFACES} == {1})
        check_steps(checks, folder, "down", case(values=SPEEDS[::-1], sweep={"friction_memory": True}), (1.0, 2.0, 3.0))
        heights = check_steps(checks, folder, "heights", case(parameter="bump_foil%height", values=HEIGHTS))
        checks.that("foils that move at rest have a grid a step, the film one",
                    [grids_of(heights.stem, surface) for surface in SURFACES] == [1, len(HEIGHTS), len(HEIGHTS)])
        check_others(checks, folder, whole)
        check_ends(checks, folder)
        check_shaft_in_time(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
