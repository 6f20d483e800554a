#!/usr/bin/env python3
"""What a bearing of beams writes of its foils: displacements, contacts and stresses against each other and statics."""

import tempfile

import h5py
import numpy

from gfb_run import Checks, largest_difference
from shell_bearing import BEARING, BUMPS, SHEET, solve

MESH = {"circumferential_elements": 104, "axial_elements": 6, "arc_elements": 8, "flat_elements": 2,
        "align_crests": True}
THICKNESS = SHEET["thickness"]
STIFFNESS = 5.0e10  # of the contacts [N/m^2]
LIMIT = 1.0e-8      # of stresses that are differences of displacements
CASES = {
    "half the width": {"model": {"half_width": "yes"}},
    "whole width": {"model": {"half_width": "no"}},
    "leading edges fixed": {"top_foil": {"fixed_edge": "leading"},
                            "bump_foil": {"fixed_edge": "leading", "fixed_line": "corner"}},
    "shaft held": {"scene": {"analysis": "fixed_position"}, "operation": {"eccentricity": (26.0e-6, 8.0e-6)}},
}


def beams(folder, name, ranks=1, model=None, **groups):
    """A bearing of beams."""
    return solve(folder, name, ranks=ranks, mesh=MESH, model={"foil": "beam", **(model or {})}, **groups)


def sheet(run, part):
    """Points (stations, rows, 3), fields of nodes (stations, rows, ...) and of cells (stations - 1, rows - 1, ...)."""
    with h5py.File(f"{run.stem}.{part}.vtkhdf", "r") as file:
        group = file["VTKHDF"]
        points = group["Points"][...]
        rows = int(numpy.count_nonzero(points[:, 0] == points[0, 0]))
        shape = (len(points)//rows, rows)
        nodes = {name: data[...].reshape(*shape, *data.shape[1:]) for name, data in group["PointData"].items()}
        cells = {name: data[...].reshape(shape[0] - 1, rows - 1, *data.shape[1:])
                 for name, data in group.get("CellData", {}).items()}
    return points.reshape(*shape, 3), nodes, cells


def line_forces(run):
    """Line number, x, normal and tangential force per metre of each contact line of each surface, and its states."""
    found = {}
    with h5py.File(f"{run.stem}.h5", "r") as file:
        for surface, group in file["contact"].items():
            lines = int(group["line"][...].max())
            table = {name: group[name][...].reshape(*group[name].shape[:-1], lines, -1) for name in group}
            there = table["line"][:, 0] > 0.0
            found[surface] = {"line": table["line"][there, 0], "x": table["position_x"][there, 0],
                              "normal": table["normal_force"][-1][there], "friction": table["friction_x"][-1][there],
                              "across": table["friction_z"][-1][there], "state": table["state"][-1][there]}
    return found


def station_at(x, place):
    """Stations at given places."""
    found = [int(numpy.argmin(numpy.abs(x - one))) for one in place]
    assert numpy.abs(x[found] - place).max() < 1.0e-9
    return found


def check_sheets(checks, words, run, contacts):
    """Foils move alike along the axis; crests and top foil are as near as the contacts' forces say."""
    (top, top_nodes, _), (bumps, bump_nodes, _) = sheet(run, "top_foil"), sheet(run, "bump_foil")
    moved, below = top_nodes["displacement"], bump_nodes["displacement"]
    for name, field in (("top foil", moved), ("bump foil", below)):
        checks.below(f"{words}: {name} moves alike along z", largest_difference(field, field[:, :1] + 0.0*field), 0.0)
        checks.below(f"{words}: {name} does not move along z", numpy.abs(field[:, :, 2]).max(), 0.0)
        checks.that(f"{words}: {name} moves", numpy.abs(field[:, 0, 1]).max() > 0.02*BEARING.clearance)
    film = run.film_arrays()
    checks.below(f"{words}: the film's deflection is the top foil's", largest_difference(
        film["deflection"], -moved[:, :, 1]), 1.0e-15)
    interior = numpy.ones(len(bumps), dtype=bool)
    for surface in contacts.values():
        interior[station_at(bumps[:, 0, 0], surface["x"])] = False
    checks.that(f"{words}: {interior.sum()} stations between crests and corners move",
                numpy.count_nonzero(below[interior, 0, 1]) > 0.9*interior.sum())
    crests = contacts["top"]
    over = moved[station_at(top[:, 0, 0], crests["x"]), 0, 1]
    under = below[station_at(bumps[:, 0, 0], crests["x"]), 0, 1]
    depth = {"top": under - over, "sleeve": -below[station_at(bumps[:, 0, 0], contacts["sleeve"]["x"]), 0, 1]}
    for name, surface in contacts.items():
        force = STIFFNESS*numpy.maximum(depth[name], 0.0)
        checks.below(f"{words}: {name}, force = stiffness times penetration", largest_difference(
            surface["normal"], force[:, None] + 0.0*surface["normal"]), 1.0e-9)
        checks.below(f"{words}: {name}, no friction along z", numpy.abs(surface["across"]).max(), 0.0)
        closed = force > 1.0e-6*force.max()
        checks.that(f"{words}: {name}, {closed.sum()} of {len(closed)} lines closed", 0 < closed.sum() < len(closed)
                    and numpy.all(surface["state"][closed] > 0.0))
    lifted = 1.0 - numpy.count_nonzero(crests["state"][:, 0])/len(crests["x"])
    checks.below(f"{words}: lifted_length", run["lifted_length"] - lifted, 1.0e-12)
    for edge, station in (("leading", 0), ("trailing", -1)):
        for suffix in ("", "_edge"):
            checks.below(f"{words}: {edge}_edge_lift{suffix}", run[f"{edge}_edge_lift{suffix}"] - moved[station, 0, 1],
                         1.0e-18)


def check_field(checks, words, run, contacts):
    """Contact forces and states in the file of the bumps are those of `/contact`."""
    bumps, nodes, _ = sheet(run, "bump_foil")
    force, state = numpy.zeros((len(bumps), 3)), numpy.zeros(len(bumps))
    for name, surface in contacts.items():
        stations = station_at(bumps[:, 0, 0], surface["x"])
        force[stations, 0] = surface["friction"][:, 0]
        force[stations, 1] = surface["normal"][:, 0]*(-1.0 if name == "top" else 1.0)
        state[stations] = surface["state"][:, 0]
    checks.below(f"{words}: contact_force", largest_difference(nodes["contact_force"],
                                                             force[:, None] + 0.0*nodes["contact_force"]), 1.0e-15)
    checks.below(f"{words}: contact_state", largest_difference(nodes["contact_state"],
                                                             state[:, None] + 0.0*nodes["contact_state"]), 0.0)


def film_forces(run):
    """Force of the film on each station of the top foil, along v [N/m of width], linear between stations."""
    film = run.film_arrays()
    x, z = film["x"][:, 0], film["z"][0]
    pressure = film["pressure"] - BEARING.ambient_pressure
    mean = numpy.sum(0.5*(pressure[:, 1:] + pressure[:, :-1])*numpy.diff(z), axis=1)/(z[-1] - z[0])
    force = numpy.zeros_like(x)
    force[:-1] -= numpy.diff(x)*(2.0*mean[:-1] + mean[1:])/6.0
    force[1:] -= numpy.diff(x)*(mean[:-1] + 2.0*mean[1:])/6.0
    return force


def section_forces(points, force, from_start):
    """Tension and bending moment in the middle of every element, from the forces on its free side, per metre."""
    tension, moment = numpy.empty(len(points) - 1), numpy.empty(len(points) - 1)
    for i, (start, end) in enumerate(zip(points[:-1], points[1:])):
        middle, along = 0.5*(start + end), (end - start)/numpy.linalg.norm(end - start)
        side = slice(0, i + 1) if from_start else slice(i + 1, None)
        arm = points[side] - middle
        sign = 1.0 if from_start else -1.0
        tension[i] = -sign*force[side].sum(axis=0) @ along
        moment[i] = sign*numpy.sum(arm[:, 0]*force[side][:, 1] - arm[:, 1]*force[side][:, 0])
    return tension, moment


def check_statics(checks, words, run, contacts, from_start):
    """In every element the stresses carry what film and contacts do to the foil on its free side."""
    load = {"top_foil": film_forces(run), "bump_foil": 0.0}
    for part in ("top_foil", "bump_foil"):
        points, _, cells = sheet(run, part)
        points = points[:, 0, :2]
        force = numpy.zeros((len(points), 2))
        force[:, 1] = load[part]
        for name, surface in contacts.items():
            if part == "top_foil" and name == "sleeve":
                continue
            stations = station_at(points[:, 0], surface["x"])
            push = numpy.stack([surface["friction"][:, 0], surface["normal"][:, 0]*(-1.0 if name == "top" else 1.0)], 1)
            force[stations] += -push if part == "top_foil" else push
        tension, moment = section_forces(points, force, from_start)
        for name, expected in (("membrane_stress", tension/THICKNESS), ("bending_stress", 6.0*moment/THICKNESS**2)):
            stress = cells[name]
            checks.below(f"{words}: {part}, {name} in {len(tension)} elements", largest_difference(
                stress[:, :, 1], expected[:, None] + 0.0*stress[:, :, 1]), LIMIT)
            checks.below(f"{words}: {part}, {name} along the axis keeps the width", largest_difference(
                stress[:, :, 0], SHEET["poissons_ratio"]*stress[:, :, 1]), 1.0e-14)
        for face, sign in (("lower", -1.0), ("upper", 1.0)):
            across = cells["membrane_stress"][:, :, 1] + sign*cells["bending_stress"][:, :, 1]
            ratio = SHEET["poissons_ratio"]
            checks.below(f"{words}: {part}, von Mises of the {face} face", largest_difference(
                cells[f"von_mises_{face}"], numpy.abs(across)*numpy.sqrt(1.0 - ratio + ratio**2)), 1.0e-13)


def check_case(checks, folder, words, **groups):
    """All of one bearing."""
    run = beams(folder, "beams", **groups)
    contacts = line_forces(run)
    stations = len(sheet(run, "bump_foil")[0])
    checks.that(f"{words}: three unknowns a station of the bumps", run["foil_unknowns_full"] == 3*stations)
    checks.that(f"{words}: nothing of a condensation in the summary",
                not {"foil_unknowns_retained", "distinct_super_elements"} & set(run.summary))
    check_sheets(checks, words, run, contacts)
    check_field(checks, words, run, contacts)
    free_start = groups.get("bump_foil", {}).get("fixed_edge", BUMPS["fixed_edge"]) == "trailing"
    check_statics(checks, words, run, contacts, free_start)


def arrays(path):
    """All datasets of a file but those that tell the run's cost and place."""
    found = {}

    def keep(name, item):
        if isinstance(item, h5py.Dataset) and not name.endswith("/rank") \
                and name.split("/")[0] in ("VTKHDF", "history", "contact"):
            found[name] = item[...]
    with h5py.File(path, "r") as file:
        file.visititems(keep)
    return found


def check_ranks(checks, folder):
    """The files hold the same on two ranks."""
    for words, groups in (("half", {}), ("tilted", {"operation": {"tilt": (5.0e-5, 2.0e-5)}})):
        base = beams(folder, "base", **groups)
        other = beams(folder, "ranks", ranks=2, **groups)
        for ending in (".film.vtkhdf", ".top_foil.vtkhdf", ".bump_foil.vtkhdf", ".h5"):
            first, second = arrays(f"{base.stem}{ending}"), arrays(f"{other.stem}{ending}")
            same = first.keys() == second.keys()
            worst = max((largest_difference(first[name], second[name]), name) for name in first
                        if first[name].dtype.kind == "f" and not name.startswith("history/")) if same else (1.0, "names")
            checks.below(f"{words}, 2 ranks: {ending[1:]} ({worst[1]})", worst[0], 1.0e-8)
            checks.that(f"{words}, 2 ranks: {ending[1:]}, cells", same and all(
                numpy.array_equal(first[name], second[name]) for name in first if first[name].dtype.kind in "iu"))


def check_shape(checks, folder):
    """Points and cells are those of a bearing of shells."""
    beam, shell = beams(folder, "beam"), solve(folder, "shell", mesh=MESH)
    for part in ("top_foil", "bump_foil"):
        first, second = (arrays(f"{run.stem}.{part}.vtkhdf") for run in (beam, shell))
        checks.that(f"{part}: the datasets of shells", first.keys() == second.keys())
        for name in ("VTKHDF/Points", "VTKHDF/Connectivity", "VTKHDF/Offsets", "VTKHDF/Types"):
            checks.that(f"{part}: {name} of shells", numpy.array_equal(first[name], second[name]))
    first, second = (arrays(f"{run.stem}.h5") for run in (beam, shell))
    names = [name for name in second if name.startswith("contact/")]
    checks.that("contacts: the datasets of shells", [name for name in first if name.startswith("contact/")] == names)
    for name in names:
        checks.that(f"{name}: as large as of shells", first[name].shape == second[name].shape)
        if name.rpartition("/")[2] in ("line", "position_x", "position_z"):
            checks.that(f"{name}: of shells", numpy.array_equal(first[name], second[name]))


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        for words, groups in CASES.items():
            check_case(checks, folder, words, **groups)
        check_ranks(checks, folder)
        check_shape(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
