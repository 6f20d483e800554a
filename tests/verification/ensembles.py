#!/usr/bin/env python3
"""Groups of ranks: a divided sweep gives the numbers of the whole one, failed members stop no other, refusals."""

import pathlib
import shutil
import subprocess
import tempfile

import h5py
import numpy

from beam_bearing import BEAM
from gfb_run import COST, GFB, MPIEXEC, SECONDS, Bearing, Checks, case_text, largest_difference, natural_sizes, \
    read_summary, run_file, summary_difference
from shell_bearing import INSIDE, SIZES, solve

LIMIT = 1.0e-8
BEARING = Bearing()
MESH = (48, 8)
UNIT = BEARING.force_unit
SPRINGS = {"foundation_stiffness": 2.0*BEARING.ambient_pressure/BEARING.clearance, "foundation_pressure": "local"}
PLACE = (0.3*BEARING.clearance, 0.5*BEARING.clearance)
LOAD = (-0.4*UNIT, 0.1*UNIT)
# A sweep that tilts about the other axis too knows its secants by its first point alone.
SWEEPS = {
    "load": {"load": LOAD, "groups": {"sweep": {"parameter": "load", "values": (10.0, 20.0, 30.0, 40.0, 50.0, 60.0)}}},
    "position": {"eccentricity": PLACE, "groups": {"sweep": {"parameter": "eccentricity_x", "values": tuple(
        x*BEARING.clearance for x in (0.5, 0.3, 0.1, -0.1, -0.3))}}},
    "tilt": {"load": LOAD, "groups": {"sweep": {"parameter": "tilt_y", "values": (1.0e-4, 5.0e-5, 0.0, -5.0e-5)}}},
    "tilt without secants": {"load": LOAD, "tilt": (5.0e-5, 0.0), "groups": {"sweep": {
        "parameter": "tilt_y", "values": (1.0e-4, 5.0e-5, 0.0, -5.0e-5)}}},
    "tilt from none": {"load": LOAD, "tilt": (5.0e-5, 0.0), "groups": {"sweep": {
        "parameter": "tilt_y", "values": (0.0, 5.0e-5, 1.0e-4, 1.5e-4)}}},
    "foundation, held": {"load": LOAD, "foil": "elastic_foundation", "groups": {"model": SPRINGS, "sweep": {
        "parameter": "tilt_x", "values": (0.0, 5.0e-5, 1.0e-4, 1.5e-4, 2.0e-4), "hold_position": True}}},
    "foundation, speed": {"load": LOAD, "foil": "elastic_foundation", "groups": {"model": SPRINGS, "sweep": {
        "parameter": "speed_rpm", "values": (60000.0, 50000.0, 40000.0, 30000.0)}}},
}
WAYS = {"load": ((1, 1), (2, 2), (4, 4), (3, 2)), "foundation, held": ((2, 1), (2, 2), (4, 2))}  # ranks, groups


def write_case(folder, name, **case):
    """A case file."""
    case.setdefault("number", 3.0)
    path = folder/f"{name}.nml"
    path.write_text(case_text(BEARING, mesh=MESH, **case), encoding="utf-8")
    return path


def call(folder, *words, ranks=1):
    """Status, terminal and error stream of a run in a folder."""
    done = subprocess.run([MPIEXEC, "-n", str(ranks), GFB, *map(str, words)], cwd=folder, stdin=subprocess.DEVNULL,
                          capture_output=True, timeout=SECONDS, check=False)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


def datasets(path):
    """Every dataset of a file but those of its origin and cost."""
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[...]}) if isinstance(item, h5py.Dataset) else None)
    return {name: data for name, data in found.items() if not name.startswith("provenance/")}


def columns(path, name):
    """Unit and meaning of a dataset."""
    with h5py.File(path, "r") as file:
        return dict(file[name].attrs)


def size_of(name, sizes):
    """What a difference in a dataset is compared with; its own size where there is nothing better."""
    return sizes.get(name.rpartition("/")[2])


def compare(checks, words, whole, parts, sizes, limit=LIMIT):
    """The result files of a sweep in one piece and of a divided one."""
    difference, worst = summary_difference(whole, parts, sizes)
    checks.below(f"{words}: summary ({worst})", difference, limit)
    one, other = datasets(f"{whole.stem}.h5"), datasets(f"{parts.stem}.h5")
    checks.that(f"{words}: same datasets of the same shape", set(one) == set(other)
                and all(one[name].shape == other[name].shape for name in one))
    checks.that(f"{words}: same units and meanings", all(
        columns(f"{whole.stem}.h5", name) == columns(f"{parts.stem}.h5", name) for name in one))
    same = [name for name in one if one[name].dtype.kind == "f" and name.rpartition("/")[2] not in COST]
    differences = {name: largest_difference(one[name], other[name], size_of(name, sizes)) for name in same}
    worst = max(differences, key=differences.get)
    checks.below(f"{words}: {len(same)} datasets ({worst})", differences[worst], limit)
    counts = other["history/newton_iterations"]
    checks.that(f"{words}: iterations are counted on from group to group",
                all(numpy.diff(counts) > 0) and other["summary/newton_iterations"] >= counts[-1])
    checks.below(f"{words}: film", max(largest_difference(a, parts.film_arrays()[name]) for name, a in whole.film_arrays().items()),
                 limit)


def check_sweeps(checks, folder):
    """The same numbers in groups as in one piece."""
    sizes = natural_sizes(BEARING)
    for axes in ("xx", "xy", "yx", "yy"):
        sizes[f"angular_stiffness_{axes}"] = UNIT*BEARING.length**2/BEARING.clearance
    for axis in "xy":
        sizes[f"secant_stiffness_{axis}"] = UNIT*BEARING.length**2/BEARING.clearance
    for name, case in SWEEPS.items():
        path = write_case(folder, name.replace(" ", "_").replace(",", ""), **case)
        points = len(case["groups"]["sweep"]["values"])
        whole = run_file(path, folder/"whole", options=[])
        sweep = case["groups"]["sweep"]
        checks.that(f"{name}: the sweep takes its values", tuple(whole.history()[sweep["parameter"]]) == sweep["values"])
        for ranks, groups in WAYS.get(name, ((2, 2),)):
            words = f"{name}, {groups} group(s) of {ranks} rank(s)"
            place = folder/f"parts{ranks}{groups}"
            parts = run_file(path, place, ranks=ranks, options=["--groups", str(groups)])
            compare(checks, words, whole, parts, sizes)
            # Two groups that end a point at once may print in any order.
            done = sorted(int(line.split()[0]) for line in parts.log.splitlines() if f" of {points} done" in line)
            checks.that(f"{words}: a line a point", done == list(range(1, points + 1)))
            checks.that(f"{words}: every group has its log, the terminal no iterations",
                        len(list(place.glob(f"{path.stem}.group*.log"))) == groups and "residual" not in parts.log
                        and "point 1 of" not in parts.log)
            checks.that(f"{words}: no warning", "warning" not in parts.log)
            with h5py.File(f"{parts.stem}.h5", "r") as file:
                checks.that(f"{words}: says how many ranks and groups", file["provenance/ranks"][()] == ranks
                            and file["provenance/groups"][()] == groups)


def check_vibrations(checks, folder):
    """Frequencies of one answer, and points of a sweep with theirs: the same files in groups as in one piece."""
    ratios = (0.1, 0.3, 0.5, 0.8, 1.0, 1.5, 2.0)
    vibrating = {"scene": {"analysis": "linear_dynamics"}, "model": SPRINGS, "rotor": {"mass": 0.1}}
    for name, groups, ways in (
            ("vibrations", {"dynamics": {"frequency_ratios": ratios}}, ((1, 1), (2, 2), (4, 4), (4, 2))),
            ("fixed_frequencies", {"dynamics": {"frequencies": (500.0, 1500.0)}}, ((2, 2),)),
            ("vibrating_sweep", {"dynamics": {"frequency_ratios": ratios[:2]},
                                 "sweep": {"parameter": "speed_rpm", "values": (20000.0, 25000.0, 30000.0)}}, ((2, 2),))):
        path = write_case(folder, name, load=LOAD, foil="elastic_foundation", groups=vibrating | groups)
        whole = run_file(path, folder/"whole", options=["--quiet"])
        table = numpy.genfromtxt(f"{whole.stem}.coefficients.csv", delimiter=",", skip_header=1)
        arrays = datasets(f"{whole.stem}.h5")
        for ranks, number in ways:
            words = f"{name}, {number} group(s) of {ranks} rank(s)"
            parts = run_file(path, folder/f"parts{ranks}{number}", ranks=ranks, options=["--groups", str(number)])
            found = numpy.genfromtxt(f"{parts.stem}.coefficients.csv", delimiter=",", skip_header=1)
            checks.that(f"{words}: a row a frequency, in order", found.shape == table.shape and (found[:, 0] == table[:, 0]).all())
            checks.below(f"{words}: coefficients", float((numpy.abs(found - table).max(0)/numpy.abs(table).max(0).clip(1.0)).max()), LIMIT)
            for key in ("critical_mass", "whirl_ratio", "growth_rate", "whirl_frequency", "stiffness_xy", "damping_xx"):
                checks.below(f"{words}: {key}", parts[key]/whole[key] - 1.0, LIMIT)
            checks.that(f"{words}: the same datasets", set(datasets(f"{parts.stem}.h5")) == set(arrays))
            with h5py.File(f"{parts.stem}.h5", "r") as file:
                checks.that(f"{words}: says how many ranks and groups", file["provenance/ranks"][()] == ranks
                            and file["provenance/groups"][()] == number)


def check_beams(checks, folder):
    """Beams with friction: contacts of all points too; and where the groups find other equilibria."""
    sweep = {"parameter": "load", "values": (100.0, 110.0, 120.0, 130.0)}
    whole = solve(folder, "beams", model=BEAM, mesh=INSIDE, sweep=sweep)
    kept = folder/"whole_beams"
    kept.mkdir()
    for file in folder.glob("beams.*"):
        shutil.copy(file, kept)
    whole.stem = kept/"beams"
    for ranks, groups in ((2, 2), (4, 4)):
        parts = solve(folder, "beams", ranks=ranks, options=["--groups", str(groups)], model=BEAM, mesh=INSIDE, sweep=sweep)
        compare(checks, f"beams, {groups} groups of {ranks} ranks", whole, parts, SIZES | {"friction_z": 1.0, "slip_z": 1.0})
        checks.that("no warning", "warning" not in parts.log)
    # From above, the branch ends in a fold; from below it is another one than a start at 100 N finds.
    down = solve(folder, "down", ranks=2, options=["--groups", "2"], model=BEAM, mesh=INSIDE,
                 sweep={"parameter": "load", "values": (100.0, 20.0)})
    checks.that("beams, a fold between two groups: said", "warning: group 2: the path from the point before finds no "
                "answer at load = 20 N" in down.log)
    up = solve(folder, "up", ranks=2, options=["--groups", "2"], model=BEAM, mesh=INSIDE,
               sweep={"parameter": "load", "values": (20.0, 100.0)})
    checks.that("beams, another equilibrium than the path from the point before leads to: said",
                "warning: group 2: another answer than a sweep without groups from load = 100 N on" in up.log)
    for run, values in ((down, (100.0, 20.0)), (up, (20.0, 100.0))):
        rows = run.history()
        checks.that("  all points are there", tuple(rows["load"]) == values and run["converged"] == "true")
        checks.below("  and are equilibria", numpy.abs(rows["force_x"] + values).max()/100.0, LIMIT)
        with h5py.File(f"{run.stem}.h5", "r") as file:
            checks.that("  and the file says it", b"not all begin" in file["provenance/stretches"][()])


def check_failures(checks, folder):
    """A stretch without an answer."""
    values = (10.0, 50.0, 1.0e7, 20.0)
    path = write_case(folder, "carried", load=LOAD, groups={"sweep": {"parameter": "load", "values": values[:2]}})
    good = run_file(path, folder/"good", options=[])
    path.rename(folder/"beyond.nml")
    for file in (folder/"good").glob("carried.*"):
        file.rename(file.with_name(file.name.replace("carried", "beyond")))
    before = {file.name: file.read_bytes() for file in (folder/"good").glob("beyond.*")}
    path = write_case(folder, "beyond", load=LOAD, groups={"sweep": {"parameter": "load", "values": values}})
    rows = good.summary["force_x"]
    checks.that("an older result is there", len(before) == 6 and rows < 0.0)
    for ranks, found in ((4, (10.0, 50.0, 20.0)), (2, (10.0, 50.0))):
        words = f"{ranks} groups, one without an answer"
        answer = run_file(path, folder/"good", ranks=ranks, options=["--groups", str(ranks)], status=2)
        checks.that(f"{words}: the others' rows are there", tuple(answer.history()["load"]) == found)
        checks.that(f"{words}: the summary says it", answer["converged"] == "false")
        checks.that(f"{words}: it is named, with reason and what is missing", "group 3: no equilibrium found: " in answer.log
                    or ranks == 2 and "group 2: no equilibrium found: " in answer.log)
        checks.that(f"{words}: what is missing", "missing: load = 1e7 N to load = " in answer.log)
        checks.that(f"{words}: all are accounted for", "4 of 4 done" in answer.log)
        checks.that(f"{words}: the older result is as it was", before == {
            name: (folder/"good"/name).read_bytes() for name in before})
    path = write_case(folder, "blocked", load=LOAD, groups={"sweep": {"parameter": "load", "values": values[:2]}})
    (folder/"blocked.group2.log").mkdir()
    answer = run_file(path, folder, ranks=2, options=["--groups", "2"], status=3)
    checks.that("a group that cannot write its log: named", "group 2: " in answer.complaint
                and "blocked.group2.log: the file cannot be written" in answer.complaint)
    values, _ = read_summary(folder/"blocked.unconverged.summary")
    with h5py.File(folder/"blocked.unconverged.h5", "r") as file:
        checks.that("the other group's point is there", list(file["history/load"]) == [10.0]
                    and values["converged"] == "false")


def check_table(checks, folder):
    """Cases side by side: each as if alone, one without an answer, one whose file cannot be written."""
    cases = {"first": {"eccentricity": PLACE}, "beyond": {"load": (-1.0e7, 0.0)}, "third": {"load": LOAD},
             "springs": {"load": LOAD, "foil": "elastic_foundation", "groups": {"model": SPRINGS}}, "blocked": {"load": LOAD}}
    paths = [write_case(folder, name, **case) for name, case in cases.items()]
    names = [path.name for path in paths]
    alone = {path.stem: run_file(path, folder/"alone", options=[], status=2 if path.stem == "beyond" else 0)
             for path in paths}
    for groups, ranks in ((1, 1), (2, 2), (2, 4)):
        words = f"table, {groups} group(s) of {ranks} rank(s)"
        place = folder/f"table{groups}{ranks}"
        status, log, _ = call(folder, "--groups", groups, "--output", place, *names, ranks=ranks)
        checks.that(f"{words}: status 2", status == 2)
        check_members(checks, words, place/"ensemble", cases, {"beyond": 2})
        for name in cases:
            stem = place/(name + (".unconverged" if name == "beyond" else ""))
            difference, worst = summary_difference(alone[name], answer_at(stem), natural_sizes(BEARING))
            checks.below(f"{words}: {name} as alone ({worst})", difference, LIMIT)
            checks.that(f"{words}: {name} has its log", "what the scene needs" in (place/f"{name}.log").read_text())
        checks.that(f"{words}: says what failed", "1 of 5 without an answer" in log
                    and "beyond: no answer (no equilibrium found: " in log and "iteration" not in log)
        checks.that(f"{words}: a line a case", all(f"{number} of 5 done" in log for number in range(1, 6)))
    place = folder/"blocked"
    (place/"blocked.h5"/"full").mkdir(parents=True)
    (place/"springs.log").mkdir()
    status, log, _ = call(folder, "--groups", 2, "--name", "study", "--output", place, *names, ranks=2)
    checks.that("a case that cannot be written: status 3", status == 3)
    check_members(checks, "a case that cannot be written", place/"study", cases, {"beyond": 2, "blocked": 3, "springs": 3})
    checks.that("it is named", "blocked: failed (" in log and "blocked.h5: the file cannot be put in its place" in log)
    checks.that("so is one whose log cannot be written", "springs.log: the file cannot be written" in log)
    checks.that("no table under another name", not list(place.glob("ensemble*")))


def answer_at(stem):
    """What stands in a summary."""
    values, units = read_summary(stem.with_name(stem.name + ".summary"))
    return type("Found", (), {"summary": values, "units": units, "physical": lambda self: {
        name: value for name, value in values.items() if name not in COST and isinstance(value, float)}})()


def check_members(checks, words, stem, cases, failed):
    """The table has a row a case, in order."""
    with h5py.File(f"{stem}.h5", "r") as file:
        rows = {name: data[...] for name, data in file["history"].items()}
        marked = all({"unit", "meaning"} <= set(data.attrs) for data in file["history"].values())
    members = [name.decode().strip() for name in rows["member"]]
    reasons = [reason.decode().strip() for reason in rows["reason"]]
    checks.that(f"{words}: the table has the cases in order, with unit and meaning", members == list(cases) and marked)
    checks.that(f"{words}: their status", list(rows["exit_status"]) == [failed.get(name, 0) for name in cases])
    checks.that(f"{words}: reasons where there is no answer", all(
        bool(reason) == (name in failed) for name, reason in zip(cases, reasons)))
    for number, name in enumerate(cases):
        if failed.get(name) == 3:
            continue
        values, _ = read_summary(stem.with_name(name + (".unconverged" if name in failed else "") + ".summary"))
        checks.that(f"{words}: row of {name}", all(rows[key][number] == value for key, value in values.items()
                                                   if isinstance(value, float))
                    and rows["converged"][number] == (values["converged"] == "true"))
    values, _ = read_summary(stem.with_name(stem.name + ".summary"))
    checks.that(f"{words}: its summary", values["members"] == len(cases)
                and values["converged_members"] == len(cases) - len(failed)
                and all(values[f"member_{number + 1}"].startswith(f"{name}: ") for number, name in enumerate(cases)))


def check_refusals(checks, folder):
    """What cannot be divided is said before anything is computed."""
    sweep = {"parameter": "load", "values": (10.0, 20.0, 30.0)}
    sweeping = write_case(folder, "sweeping", load=LOAD, groups={"sweep": sweep}).name
    plain = write_case(folder, "plain", load=LOAD).name
    folds = write_case(folder, "folds", load=LOAD, groups={"sweep": {**sweep, "turn_folds": True}}).name
    wrong = write_case(folder, "wrong", load=LOAD, groups={"mesh": {"axial_elements": -3}}).name
    bad = write_case(folder, "bad", load=LOAD, groups={"gas": {"viscosity": -1.0}}).name
    (folder/"other").mkdir()
    shutil.copy(folder/plain, folder/"other"/plain)
    shutil.copy(folder/plain, folder/"ensemble.nml")
    vibrating = write_case(folder, "vibrating", load=LOAD, groups={
        "scene": {"analysis": "linear_dynamics"}, "dynamics": {"frequencies": (1000.0, 2000.0)}}).name
    amplitudes = vibrating_text(folder)
    remembers = solve_text(folder)
    before = sorted(path.name for path in folder.iterdir())
    for words, ranks, expected in (
            (("--groups", 3, sweeping), 2, ("3 groups need as many ranks", "the job has 2")),
            (("--groups", 4, sweeping), 4, ("4 groups for 3 values",)),
            (("--groups", 2, plain), 2, ("no &sweep",)),
            (("--groups", 3, vibrating), 3, ("3 groups for 2 frequencies",)),
            (("--groups", 2, amplitudes), 2, ("vibration_amplitudes",)),
            (("--groups", 2, folds), 2, ("turn_folds",)),
            (("--groups", 2, remembers), 2, ("friction_memory",)),
            (("--groups", 2, wrong, plain, bad, "nowhere.nml"), 2,
             ("wrong.nml", "axial_elements", "bad.nml", "viscosity", "nowhere.nml")),
            (("--groups", 2, plain, f"other/{plain}"), 2, ("same names", "other/plain.nml")),
            (("--groups", 2, plain, "ensemble.nml"), 2, ("ensemble.nml", "--name")),
            (("--groups", 3, plain, sweeping), 3, ("3 groups for 2 cases",)),
            (("--groups", 2, "--output", "/proc/gfb", plain, sweeping), 2, ("/proc/gfb",)),
            (("--groups", 0, plain), 1, ("--groups needs",)),
            (("--groups", "two", plain), 1, ("--groups needs",)),
            (("--groups", 1, "--branches", plain), 1, ("--branches",)),
            (("--name", "study", plain), 1, ("--name",)),
            ((plain, sweeping), 1, ("one case file at a time", "--groups N"))):
        status, log, complaint = call(folder, *words, ranks=ranks)
        checks.that(f"gfb {' '.join(map(str, words))}: {', '.join(expected)}",
                    status == (3 if "--output" in words else 1) and all(part in complaint for part in expected))
        checks.that("  once, and nothing computed", complaint.count(expected[0]) == 1 and "solution" not in log)
    status, log, _ = call(folder, "--check", "--groups", 2, plain, sweeping)
    checks.that("--check checks all", status == 0 and "plain.nml is in order" in log and "sweeping.nml is in order" in log)
    checks.that("nothing was written", before == sorted(path.name for path in folder.iterdir()))


def vibrating_text(folder):
    """A case of vibrations that are not small."""
    solve(folder, "amplitudes", options=["--check"], model=BEAM, mesh=INSIDE, operation={"load": (100.0, 0.0)},
          scene={"analysis": "linear_dynamics"}, dynamics={"frequencies": (1000.0, 2000.0), "vibration_amplitudes": 1.0e-6})
    return "amplitudes.nml"


def solve_text(folder):
    """A case with friction that remembers."""
    model = {**BEAM}
    solve(folder, "remembers", options=["--check"], model=model, mesh=INSIDE, sweep={
        "parameter": "load", "values": (100.0, 110.0), "friction_memory": True})
    return "remembers.nml"


def main():
    checks = Checks()
    for check in (check_sweeps, check_vibrations, check_failures, check_table, check_refusals, check_beams):
        with tempfile.TemporaryDirectory() as folder:
            check(checks, pathlib.Path(folder))
    checks.close()


if __name__ == "__main__":
    main()
