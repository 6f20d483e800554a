"""`gfb.study`: the program called over the values of keys."""

from __future__ import annotations

import concurrent.futures
import itertools
import pathlib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy
import xarray

from gfb.case import Case
from gfb.members import BATCH, MEMBER_NAME, check_all, find_member, older_programs, run_member, run_members, warn
from gfb.program import PathLike, find_program, unit_of_key, words_of
from gfb.running import Result


def study(case: Case, values: Mapping[str, Sequence[Any]], folder: PathLike = "study", name: str = "study", processes: int = 1,
          gfb: PathLike | None = None) -> xarray.Dataset:
    """Runs a case for every combination of values of keys, `{"bearing%clearance": [3e-5, 4e-5], ...}`; a dataset of the
    summaries with a dimension a key. `status` is the program's; numbers are NaN where there is no answer. Called again,
    it computes what is not there yet, was stopped, or is another program's, of which it warns. All combinations are checked before the first is computed."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    cases = []
    for combination in itertools.product(*values.values()):
        one = case.copy()
        one.update(zip(values, combination))
        cases.append(one)
    stems = [folder/MEMBER_NAME.format(study=name, number=number + 1) for number in range(len(cases))]
    check_all(cases, gfb)
    missing = [number for number, stem in enumerate(stems) if find_member(cases[number], stem, gfb) is None]
    others = [older for number in missing for older in older_programs(cases[number], stems[number], gfb)]
    if others:
        own = words_of(find_program(gfb))
        warn(f"{folder}: {len(others)} results of {', '.join(sorted(set(others)))} are computed again by {own}")
    size = max(1, min(BATCH, -(-len(missing)//max(1, processes))))
    batches = [missing[first:first + size] for first in range(0, len(missing), size)]
    with concurrent.futures.ThreadPoolExecutor(max_workers=max(1, processes)) as pool:
        list(pool.map(lambda batch: run_members([cases[number] for number in batch], [stems[number] for number in batch], gfb), batches))
    found = [find_member(one, stem, gfb) or run_member(one, stem, gfb) for one, stem in zip(cases, stems)]
    return table(values, found, {key: unit_of_key(find_program(gfb), key) for key in values})


def table(values: Mapping[str, Sequence[Any]], found: Sequence[Result], units: Mapping[str, str]) -> xarray.Dataset:
    """The dataset of a study: its dimensions, each with its values and their unit, where they have one, and the results."""
    shape = tuple(map(len, values.values()))
    dims = tuple(values)
    answers = [one.summary if one.converged else {} for one in found]
    names = dict.fromkeys(name for summary in answers for name, value in summary.items() if isinstance(value, float))
    variables = {"status": xarray.Variable(dims, numpy.reshape([one.status for one in found], shape), {"units": "1"})}
    for name in names:
        unit = next(one.units[name] for one in found if name in one.units)
        numbers = [summary.get(name, numpy.nan) for summary in answers]
        variables[name] = xarray.Variable(dims, numpy.reshape(numbers, shape), {"units": unit})
    return xarray.Dataset(variables, coords={key: axis(key, items, units.get(key, "")) for key, items in values.items()})


def axis(key: str, items: Sequence[Any], unit: str) -> xarray.Variable:
    """The values of a key along its dimension; each is one, also where it is a list."""
    data = numpy.empty(len(items), dtype=object)
    data[:] = [tuple(item) if isinstance(item, (list, numpy.ndarray)) else item for item in items]
    if not any(isinstance(item, tuple) for item in data):
        data = numpy.array(list(items))
    return xarray.Variable((key,), data, {"units": unit} if unit else {})
