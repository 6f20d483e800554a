"""What stands where in the files of results: found in small runs of every analysis, one row a dataset."""

import pathlib
import re
import tempfile
from typing import Any

import h5py

from gfb.case import Case
from gfb.results import open_results, text_of
from gfb.running import run_case

NAMED = ("summary", "history", "provenance")  # groups whose names are those of `gfb --results`
SAMPLE = {"bump_foil%height_deviation": 1.0e-7, "bump_foil%seed": 1, "sample%count": 2, "model%foil": "beam"}
TILTING = {"rotor%transverse_inertia": 1.0e-3, "rotor%bearing_distance": 0.12, "model%foil": "beam", "transient%turns": 2.0,
           "mesh%circumferential_elements": 52, "mesh%axial_elements": 4}
# Of any mesh the files hold the same.
COARSE = {"mesh%circumferential_elements": 48, "mesh%axial_elements": 4}
COARSE_BEAMS = {"mesh%circumferential_elements": 52, "mesh%axial_elements": 4}
SWEPT = {"sweep%parameter": "speed_rpm", "sweep%values": (30000.0, 35000.0)}
SCENES: tuple[tuple[str, dict[str, Any]], ...] = (  # analysis of the template, what is changed in it
    ("equilibrium", COARSE), ("equilibrium", SAMPLE), ("strip", {}), ("modes", {}),
    ("linear_dynamics", {"rotor%mass": 0.1, **COARSE}), ("equilibrium", {**SWEPT, **COARSE}),
    ("transient", TILTING), ("periodic", {}),
    ("machine", {f"bearing_{number}%{key}": value for number in (1, 2) for key, value in COARSE_BEAMS.items()}))


def layout(gfb):
    """{kind of file: {path in it: (unit, meaning, dimensions, parts of the bearing)}}."""
    found: dict[str, dict[str, tuple[str, str, int, set[str]]]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for number, (analysis, changes) in enumerate(SCENES):
            case = Case.template(analysis, gfb)
            for key, value in changes.items():
                case[key] = value
            run_case(gfb, case.groups, folder, f"run{number}")
            for path in sorted(pathlib.Path(folder).glob(f"run{number}.*")):
                if path.suffix in (".h5", ".vtkhdf"):
                    kind, part = kind_of(path)
                    for name, (unit, meaning, dimensions) in datasets(path):
                        parts = found.setdefault(kind, {}).setdefault(name, (unit, meaning, dimensions, set()))[3]
                        parts.add(part)
    return found


def kind_of(path):
    """A file's name as the manual writes it, and the part of the bearing."""
    part, _, ending = re.sub(r"^bearing_\d+\.", "", path.name.partition(".")[2]).partition(".")
    part = re.sub(r"_\d+$", "", part)  # of several pads, of two bearings
    return (f"<case>.<part>.{ending}", part) if ending else (f"<case>.{part}", "")


def datasets(path):
    """(path, (unit, meaning, dimensions)) of what is in a file; numbered names once."""
    found = []

    def add(name, item):
        if not isinstance(item, h5py.Dataset) or name.startswith(tuple(f"{group}/" for group in NAMED)):
            return
        unit, meaning = (text_of(item.attrs.get(word, "")).strip() for word in ("unit", "meaning"))
        if re.match("sample/.*/", name):
            name, unit = re.sub("/.*/", "/<quantity>/", name), "its own"
        found.append(("/" + re.sub(r"_\d+(?=/|$)", "_<n>", name), (unit, meaning, item.ndim)))

    with open_results(path) as file:
        file.visititems(add)
    return found


def layout_tables(gfb):
    """The tables, one a kind of file."""
    return "\n".join(table(kind, paths) for kind, paths in sorted(layout(gfb).items()))


def table(kind, paths):
    """One of them; surfaces say which parts have what."""
    every = set().union(*(parts for *_, parts in paths.values()))
    parted = len(every) > 1
    heads = ["dataset", "dimensions", "unit", "meaning", *(["part"] if parted else [])]
    rows = [[f"`{name}`", str(dimensions), unit, meaning, *([parts_of(parts, every)] if parted else [])]
            for name, (unit, meaning, dimensions, parts) in sorted(paths.items())]
    lines = [heads, ["---:" if head == "dimensions" else "---" for head in heads], *rows]
    return f"`{kind}`:\n\n" + "".join("| " + " | ".join(line) + " |\n" for line in lines)


def parts_of(parts, every):
    """Which parts have a dataset."""
    return "all" if parts == every else ", ".join(f"`{part}`" for part in sorted(parts))
