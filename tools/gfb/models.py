"""`gfb.compare_models`: one case with the models of its foil side by side, in one table and one picture.

`tools/models` prints the table and draws the picture."""

from __future__ import annotations

import concurrent.futures
import dataclasses
import math
import os
import pathlib
import re
from collections.abc import Sequence
from typing import Any

import xarray

from gfb.case import Case, CaseError
from gfb.members import find_member, run_member
from gfb.program import DONE, NOT_CONVERGED, WRONG_INPUT
from gfb.reading import read
from gfb.running import Result
from gfb.studies import table
from gfb.tables import markdown_table, readable_unit
from gfb.tool import draw_into_files, parser_of, stop

OF_JOURNALS = ("rigid", "elastic_foundation", "beam", "shell")
OF_RUNNERS = ("rigid", "elastic_foundation", "plate", "shell")
ENDS = {DONE: "", NOT_CONVERGED: "no answer", WRONG_INPUT: "not possible"}
# What a model has no use for says so: a key with its value, or a group; strips side by side go with all that is theirs.
USELESS = re.compile(r"&(\w+): (?:(\w+)(?:\([^)]*\))? = .*?: |the group )(needs (?:foil|strips) = .*)")
SHOWN = ("eccentricity_x", "eccentricity_y", "attitude_angle", "axial_gap", "minimum_gap", "maximum_pressure", "maximum_deflection",
         "maximum_top_foil_stress", "maximum_bump_foil_stress", "torque_x", "torque_y", "friction_torque", "power_loss", "stiffness_xx", "stiffness_yy", "stiffness_zz", "critical_mass",
         "load_capacity", "lift_off_speed_rpm", "misalignment_allowance", "axial_frequency", "unknowns", "factorizations", "wall_time")
DEGREES = 180.0/math.pi
HELP = """Foil models of one case side by side: a table, and a picture of films, pressures and costs.

  tools/models CASE.nml [FOLDER]

Runs the case with every model of its foil and says what a model has no use for. Called again, it computes what is not there yet.
Exit status: 0 done, 1 the case is wrong, 3 a file or the machine failed.
"""


@dataclasses.dataclass
class Models:
    """Answers of one case by several models."""

    data: xarray.Dataset             # every number of the summaries over `model`, and `status`
    left_out: dict[str, list[str]]   # what of the case a model has no use for, with why
    reasons: dict[str, str]          # of models without an answer
    films: dict[str, pathlib.Path]   # files of fields, of those with one

    def table(self, names: Sequence[str] = SHOWN) -> str:
        """A Markdown table of results, and lines that say what was left out."""
        models = [str(name) for name in self.data.model.values]
        rows = []
        for name in names:
            if name not in self.data or not (abs(self.data[name].fillna(0.0)) > 0.0).any():
                continue
            unit, scale = readable_unit(self.data[name].units, name)
            rows.append([name, unit, *(readable(float(value)*scale) for value in self.data[name].values)])
        rows.append(["", "", *(ENDS[int(status)] for status in self.data.status.values)])
        lines = [f"- {model}: left out {'; '.join(self.left_out[model])}\n" for model in models if self.left_out[model]]
        lines += [f"- {model}: {words}\n" for model, words in self.reasons.items()]
        return markdown_table("", ["result", "unit", *models], rows if any(rows[-1]) else rows[:-1]) + "".join(["\n", *lines] if lines else [])

    def plot(self, path: str | os.PathLike[str]) -> pathlib.Path:
        """Draws films and pressures of all models over the angle, and what each cost."""
        from matplotlib import pyplot

        from gfb.plot.film import broken, ends_of
        figure, axes = pyplot.subplots(1, 3, figsize=(12.0, 3.8), layout="constrained", width_ratios=(3, 3, 2))
        for model, file in self.films.items():
            angle, film, where = line_of(read(file))
            ends = ends_of(film["pad"].values) if "pad" in film else ()
            for chart, name, scale in zip(axes, ("gap", "pressure"), (1.0e6, 1.0e-3)):
                chart.plot(*broken(angle.values, scale*film[name].values, ends), label=model)
        for chart, words in zip(axes, ("film thickness [um]", "absolute pressure [kPa]")):
            chart.set(xlabel="theta [deg]", title=f"{words}, {where}" if self.films else words)
            chart.grid(alpha=0.3)
        axes[0].set_ylim(bottom=0.0)
        if self.films:
            axes[0].legend(fontsize=8)
        models = [str(name) for name in self.data.model.values]
        axes[2].barh(models, self.data.get("wall_time", 0.0*self.data.status).fillna(0.0).values)
        axes[2].invert_yaxis()
        axes[2].set(xlabel="time [s]", title="what each cost")
        figure.savefig(path, dpi=130)
        pyplot.close(figure)
        return pathlib.Path(path)


def readable(value: float) -> str:
    """A number of four digits; nothing for none."""
    return "" if value != value else f"{value:.4g}"


def line_of(film: xarray.Dataset) -> tuple[Any, xarray.Dataset, str]:
    """Angle [deg] and fields at the midplane, or in the middle of the first sector, and where that is."""
    across = "radius" if "radius" in film.dims else "z"
    line = film.isel({across: film.sizes[across]//2})
    if across == "z":
        return DEGREES*line.theta, line, "midplane"
    if "pad" in line:
        line = line.isel(theta=line["pad"].values == 1.0)
    return DEGREES*line.theta, line, "pad 1, mean radius"


def compare_models(case: Case, models: Sequence[str] | None = None, folder: str | os.PathLike[str] = "models", name: str = "models",
                   processes: int = 1, gfb: str | os.PathLike[str] | None = None) -> Models:
    """Runs a case with every model of its foil; by default rigid, springs, beams (of thrust bearings plates) and shells.

    Of a sweep the table has the last point. What a model has no use for is left out, and said. A model that the case cannot have has status 1 and a reason, one without an
    answer status 2; numbers are NaN there. Called again, it computes what is not there yet, was stopped, or is another program's."""
    if models is None:
        models = OF_RUNNERS if case.is_thrust() else OF_JOURNALS
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    left_out: dict[str, list[str]] = {}
    reasons: dict[str, str] = {}
    cases = {}
    for model in models:
        cases[model], left_out[model], wrong = with_model(case, model, gfb)
        if wrong:
            reasons[model] = wrong
    stems = {model: folder/f"{name}_{model}" for model in models}

    def answer(model: str) -> Result:
        if model in reasons:
            return Result(WRONG_INPUT, "", reasons[model], stems[model], {}, {})
        return find_member(cases[model], stems[model], gfb) or run_member(cases[model], stems[model], gfb)

    with concurrent.futures.ThreadPoolExecutor(max_workers=max(1, processes)) as pool:
        found = list(pool.map(answer, models))
    for model, result in zip(models, found):
        if result.status == NOT_CONVERGED:
            reasons[model] = f"no answer, {result.reason}; the last state reached is in {result.stem.name}.summary"
    files = {model: folder/f"{name}_{model}.film.vtkhdf" for model, result in zip(models, found) if result.converged}
    return Models(table({"model": list(models)}, found, {}), left_out, reasons, {model: file for model, file in files.items() if file.exists()})


def with_model(case: Case, model: str, gfb: str | os.PathLike[str] | None) -> tuple[Case, list[str], str]:
    """The case with a model, without what that has no use for; what it was; and what is still wrong, empty where nothing is."""
    one = case.copy()
    left_out: list[str] = []
    one["model%foil"] = model
    while True:
        try:
            one.check(gfb=gfb)
        except CaseError as error:
            words = str(error)
        else:
            return one, left_out, ""
        useless = [found for line in words.splitlines() if (found := USELESS.search(line))]
        if not useless:
            return one, left_out, "; ".join(line.partition(": ")[2] for line in words.splitlines())
        for found in useless:
            group, key, why = found.groups()
            if key:
                del one[f"{group}%{key}"]
            else:
                del one.groups[group]
            left_out.append(f"`&{group}`{f': `{key}`' if key else ''}, which {why}")


def main() -> int:
    """Table and picture of a case file."""
    parser = parser_of("tools/models", HELP)
    parser.add_argument("case", type=pathlib.Path, metavar="CASE.nml", help="the case file; its foil is each model in turn")
    parser.add_argument("folder", nargs="?", type=pathlib.Path, metavar="FOLDER", help="of runs and picture; default: results/CASE.models")
    parser.add_argument("--gfb", help="the program; default: as gfb from Python finds it")
    options = parser.parse_args()
    draw_into_files()
    name = options.case.stem
    folder = options.folder or pathlib.Path("results")/f"{name}.models"
    try:
        models = compare_models(Case.read(options.case), folder=folder, name=name, processes=max(1, (os.cpu_count() or 2)//2), gfb=options.gfb)
    except CaseError as error:
        return stop(f"{options.case}: {error}")
    print(models.table())
    print(f"drawn: {models.plot(folder/f'{name}.models.png')}")
    return 0
