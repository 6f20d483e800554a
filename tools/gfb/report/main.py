"""Makes one HTML page of results of gfb, which needs no other file.

  tools/report CASE.h5 ...          or CASE.summary, or the name without an ending; several stand side by side

The page has what one asks first (film, load, limits, power, stability, with margins), all results with units and errors, what the case files say and where they differ, what the scene
needed and why (as gfb --check prints it), pictures, the points of a sweep or the load steps, and where the numbers come
from. Exit status: 0 written, 1 a result cannot be read, 3 the page cannot be written.
"""

import base64
import concurrent.futures
import math
import os
import pathlib
import re
import subprocess
import tempfile
import time

import jinja2
import numpy

from gfb.bearing_files import names_of, renamed
from gfb.case import Case
from gfb.files import fresh
from gfb.heat import HEATED, balance
from gfb.look import FONT
from gfb.program import call, find_program
from gfb.report.answer import LAST_STATE, Results, ended
from gfb.report.glance import glance
from gfb.report.machine import is_machine, machine_picture, read_tables, sizes_of
from gfb.report.orifices import HEADS, orifice_rows
from gfb.report.sensitivities import sensitivities
from gfb.report.sketch import sketch
from gfb.report.thinnest import place_of_thinnest
from gfb.report.verdict import colour_of, margins_of, not_computed, plain, sentence, total_power
from gfb.results import Unreadable, open_results, read_summary, reading, text_of
from gfb.tables import readable_unit
from gfb.tool import command_beside, draw_into_files, parser_of, say, stop

PAGE = jinja2.Environment(loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent), autoescape=True,
                          trim_blocks=True, lstrip_blocks=True)
PAGE.globals |= {"font": FONT, "colour_of": colour_of, "last_state": LAST_STATE, "orifice_heads": HEADS}
ENDINGS = (".h5", ".summary")
SURFACES = {"film": "the film", "top_foil": "the top foil", "bump_foil": "the bump foil"}
OF_MACHINES = {"machine": "the machine to scale, its static line, moments along it", "shapes": "its modes in space", "response": "response to unbalance",
               "critical": "undamped critical speeds over the stiffness of the bearings"}
SHOWN = {"contact": "contacts", "dynamics": "stiffness and damping over the frequency", "campbell": "the rotor's modes over the speed"}
OVER_POINTS = ("campbell", "response")  # pictures of a machine's sweep
SECONDS = 300     # no picture takes that long
AT_ONCE = max(1, (os.cpu_count() or 2)//2)  # pictures
MOST_ROWS = 400   # of a table of points
SAME = 1.0e-9     # of the largest result of a unit: numbers that differ less are one


def main():
    parser = parser_of("tools/report", __doc__)
    parser.add_argument("results", nargs="+", metavar="RESULT", help="CASE.h5, CASE.summary, or CASE")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="HTML", help="the page; default: beside the first result")
    parser.add_argument("--gfb", help="the program, for what the scene needed; default: as gfb from Python finds it")
    options = parser.parse_args()
    draw_into_files()  # a page without pictures would say nothing of it
    stems = [stem_of(name) for name in options.results]
    output = options.output or pathlib.Path(f"{stems[0]}.html")
    try:
        runs = [read_run(stem, options.gfb) for stem in stems]
    except FileNotFoundError as error:
        stop(f"{error.filename or error}: there is no such result")
    except Unreadable as error:
        stop(str(error))
    print(plain(runs))
    print(f"written: {write_page(runs, output)}")
    return 0


def write_page(runs, output, study=(), heading="", margins=(), verdict=""):
    """Writes the page of some runs; study: rows as `glance` has them, which stand before all, its heading, its margins and verdict."""
    page = PAGE.get_template("page.html").render(runs=runs, study=study, heading=heading, verdict=verdict, margins=margins,
                                                 groups=[("", margins)] if study else [(run["name"], run["margins"]*run["converged"]) for run in runs],
                                                 total=total_power(runs) if not study else "", block=title_block(runs, heading),
                                                 answer=answer_rows(runs), keys=key_rows(runs), origin=origin_rows(runs))
    try:
        with fresh(output) as place:
            place.write_text(page, encoding="utf-8")
    except OSError as error:
        stop(f"{output}: {error.strerror}", 3)
    return output


def svg_of(drawn):
    """The picture of a sketch; empty where there is none."""
    return PAGE.get_template("sketch.html").render(drawn=drawn)


def title_block(runs, heading=""):
    """What a drawing's title block has, of whoever signs: project, case, date and version."""
    def together(values, between=", "):
        return between.join(dict.fromkeys(filter(None, values)))

    titles = [str(run["used"].groups.get("scene", {}).get("title", "")) for run in runs]
    return [("project", titles[0].removesuffix(f": {runs[0]['title']}") if heading else together(titles, "; ")), ("case", heading or together(run["name"] for run in runs)),
            ("computed", together(run["origin"].get("date", "")[:10] for run in runs)),
            ("gfb", together(" ".join(filter(None, (run["origin"].get("program_version"), run["origin"].get("commit", "")))) for run in runs))]


def stem_of(name):
    """A result's name without its ending."""
    for ending in ENDINGS:
        name = name.removesuffix(ending)
    return pathlib.Path(name)


def read_run(stem, gfb, title="", pictures=True, curve=False, seconds=0):
    """All that the page has of a result; curve: of several points no other picture; seconds: for all pictures, 0: as long as they take."""
    path = pathlib.Path(f"{stem}.h5")
    with reading(path), open_results(path) as file:
        summary = {name: of_dataset(file["summary"][name]) for name in in_order(stem, file["summary"])}
        table = file["history"]
        history = {name: table[name][:MOST_ROWS] for name in columns(table, summary)}
        heads = [(name, text_of(table[name].attrs["unit"])) for name in history]
        points = len(table[heads[0][0]]) if heads else 0
        swept = {name: float(data[points - 1]) for name, data in table.items()} if points else {}
        case_file = text_of(file["scene/case_file"][()])
        bearings = [text_of(file[f"scene/bearing_{number}"][()]) for number in range(1, MOST_ROWS) if f"scene/bearing_{number}" in file]
        used = Case.parse(text_of(file["scene/used"][()]))
        origin = {name: text_of(data[()]) for name, data in file["provenance"].items()}
        machine = read_tables(file, used)
        shows = [name for name in ("contact", "dynamics", "transient") if name in file and not (machine and name == "dynamics")] + ["heat"]*(HEATED in table) + ["ring"]*("axial_gap" in table)
        shows += ["campbell"]*("speed_rpm" in table and "dynamics/mode_frequency" in file)
        shows += ["machine"]*bool(machine) + ["shapes"]*(machine is not None and "dynamics/mode_shape" in file)
        shows += ["response"]*(machine is not None and "dynamics/response" in file) + ["critical"]*(machine is not None and len(machine.bearings) > 1)
        rows = [[number(history[name][row]) for name, _ in heads] for row in range(min(points, MOST_ROWS))]
        converged = bool(summary["converged"]["value"])
        frequency = float(numpy.atleast_2d(file["dynamics/frequency"][...])[-1, 0]) if "dynamics/frequency" in file else None
    with reading(path):  # of a file that is not gfb's, too
        place = place_of_thinnest(stem, summary)
        found = Results(summary, used, place, machine=machine)
        drawn_case = machine_picture(used, sizes_of(machine, summary)) if is_machine(used) else sketch(summary, used, place)
        margins = margins_of(found)
        about = {"margins": margins, "open_questions": not_computed(found, margins), "glance": glance(summary, used, place, frequency, machine), "sketch": drawn_case, "place": place, "heat": heat_rows(summary), "orifices": orifice_rows(found),
                 "sensitivities": sensitivities(summary, used, swept_keys(used, swept))}
        pad = place.pad if place else 0 if machine else thinnest_pad(summary)
    count = len(machine.bearings) if machine else 0
    rings = [number for number in range(1, count + 1) if f"force_z_{number}" in summary]  # thrust bearings
    drawings = pictures_of(stem, points, shows, curve, pad, count, rings, seconds) if pictures else []
    why = "" if converged else ended(summary)
    return about | {
        "verdict": sentence(margins, why, about["open_questions"]), "name": stem.name, "title": title or used.groups.get("scene", {}).get("title", ""), "summary": summary,
        "converged": converged, "ended": why, "heads": heads, "rows": rows if points > 1 else [], "left_out": max(0, points - MOST_ROWS),
        "case_file": case_file, "bearing_files": bearings, "amplitudes": machine.over_points if machine else None, "used": used, "origin": origin, "needs": needs_of(case_file, gfb, bearings) if pictures else "", "pictures": drawings}


def swept_keys(case, last):
    """{key: value} of what a sweep changes, at its last point."""
    parameter = case["sweep%parameter"] if "sweep%parameter" in case else ""
    if "%" in parameter:
        return {key: last["key_value"] for key in re.split(r"[,\s]+", parameter) if "key_value" in last}
    return {f"operation%{parameter}": last[parameter]} if parameter in last else {}


def in_order(stem, group):
    """Names of the results, in the order of the summary file where it is there."""
    path = pathlib.Path(f"{stem}.summary")
    first = [name for name in read_summary(path)[0] if name in group] if path.exists() else []
    return list(dict.fromkeys([*first, *group]))


def columns(history, summary):
    """Names of a history: first what the answer does not have, such as the value of a sweep, then as the answer stands."""
    return [*(name for name in history if name not in summary), *(name for name in summary if name in history)]


def of_dataset(data):
    """Value, unit and meaning of a result."""
    if data.shape != ():
        raise ValueError(f"{data.name}: not one value")
    value = data[()]
    return {"value": float(value) if data.dtype.kind == "f" else text_of(value),
            "unit": text_of(data.attrs.get("unit", "")), "meaning": text_of(data.attrs.get("meaning", ""))}


def number(value):
    """A number for a table; nothing where there is none."""
    return "" if value != value else f"{value:.6g}"


def needs_of(case_file, gfb, bearings=()):
    """What gfb --check says of the scene, on this machine; bearings: texts of the files that a machine names."""
    try:
        with tempfile.TemporaryDirectory() as folder:
            names = [f"bearing_{number}.nml" for number in range(1, len(bearings) + 1)]
            for name, text in zip(names, bearings):
                pathlib.Path(folder, name).write_text(text, encoding="utf-8")
            done = call([find_program(gfb), "--check", "-"], SECONDS, folder=folder if bearings else None,
                        text=renamed(case_file, names) if len(names_of(case_file)) == len(names) else case_file)
    except (FileNotFoundError, subprocess.TimeoutExpired) as error:
        return f"not known: {error}"
    return (done.log + done.complaint).strip()


# --- pictures ---

def thinnest_pad(summary):
    """The number of the pad with the thinnest film; 0 where the pads are not distinguished."""
    gaps = {int(name.rpartition("_")[2]): one["value"] for name, one in summary.items() if re.fullmatch(r"minimum_gap_\d+", name)}
    return min(gaps, key=lambda pad: gaps[pad]) if gaps else 0


def pictures_of(stem, points, shows, curve=False, pad=0, bearings=0, rings=(), seconds=0):
    """Title and picture of everything that tools/plot draws of a result, or of its points or time alone; what it cannot draw, or not in time,
    is left out."""
    wanted = [(words, [f"{stem}.{part}.vtkhdf"]) for part, words in SURFACES.items()]
    which = f"pad {pad}, where the film is thinnest" if pad else "pad 1"
    wanted += [(f"{SURFACES[part]} of {which}", [f"{stem}.{part}_{max(pad, 1)}.vtkhdf"]) for part in ("top_foil", "bump_foil")]
    wanted.insert(1, ("film and foils in space, heights and displacements drawn larger", [f"{stem}.film.vtkhdf", "--3d", "--picture-only"]))
    if "ring" not in shows:
        wanted.insert(1, ("pressure and film thickness around the shaft", [f"{stem}.film.vtkhdf", "--show", "polar"]))
    if "heat" in shows:
        wanted += [("temperatures of film and top foil, and heat into the shaft", [f"{stem}.film.vtkhdf", "--show", "heat"]),
                   ("heat along the points" if points > 1 else "where the heat goes, and how hot it is", [f"{stem}.h5", "--show", "heat"])]
        if points > 1:
            wanted.append(("heat at the last point", [f"{stem}.h5", "--show", "heat", "--step", str(points)]))
    if "transient" in shows:
        wanted.append(("orbit and thinnest film", [f"{stem}.h5"]))
        wanted += [("thinnest films over time", [f"{stem}.h5", "--show", "thinnest"])]*(bearings > 0)
    elif points > 1:
        wanted.insert(0, ("along the points or load steps", [f"{stem}.h5"]))
    wanted[:0] = [(words, [f"{stem}.h5", "--show", show]) for show, words in OF_MACHINES.items() if show in shows]
    for bearing in range(1, bearings + 1):
        wanted += [(f"{words} of bearing {bearing}", [f"{stem}.bearing_{bearing}.film.vtkhdf", *more])
                   for words, more in (("the film", []), ("pressure and film thickness around the shaft", ["--show", "polar"])) if not (more and bearing in rings)]
    wanted += [(words, [f"{stem}.h5", "--show", show]) for show, words in SHOWN.items() if show in shows]
    if curve and (points > 1 or "transient" in shows):
        wanted = [one for one in wanted if one[1] == [f"{stem}.h5"] or bearings and one[1][-1] in OVER_POINTS]
    with tempfile.TemporaryDirectory() as folder:
        there = [(words, arguments) for words, arguments in wanted if pathlib.Path(arguments[0]).exists()]
        for path in sorted({arguments[0] for _, arguments in there}):
            with reading(path):
                open_results(path).close()  # what is damaged, or no file of gfb, is no picture that could be left out
        end = time.monotonic() + (seconds or len(there)*SECONDS)

        def draw_one(number, words, arguments):
            left = end - time.monotonic()
            if left <= 0.0:
                return None
            say(f"{stem.name}: picture {number} of {len(there)}: {words}")
            data = drawn(arguments, pathlib.Path(folder)/f"{number}.png", min(SECONDS, left))
            return None if data is None else (words, data)

        pool = concurrent.futures.ThreadPoolExecutor(AT_ONCE)
        try:
            found = list(pool.map(draw_one, range(1, len(there) + 1), *zip(*there))) if there else []
        finally:
            pool.shutdown(cancel_futures=True)
    if None in found:
        say(f"{stem.name}: {found.count(None)} of {len(there)} pictures are left out: their time was over")
    return [one for one in found if one and one[1]]


def drawn(arguments, picture, seconds=SECONDS):
    """A picture of tools/plot as text; empty where there is none, None where there is none in so many seconds."""
    try:
        subprocess.run(command_beside("plot", *arguments, "-o", str(picture)), stdin=subprocess.DEVNULL, capture_output=True, check=True,
                       timeout=seconds)
    except subprocess.TimeoutExpired:
        return None
    except subprocess.CalledProcessError:
        return ""
    return base64.b64encode(picture.read_bytes()).decode()


# --- tables ---

def heat_rows(summary):
    """Where the heat goes [W, % of the power loss]; empty without heat."""
    if HEATED not in summary:
        return []
    flows = balance({name: one["value"] for name, one in summary.items()})
    power = flows[0][1]
    return [(words, number(flow), f"{100.0*flow/power:.3g}" if power > 0.0 else "") for words, flow in flows]


def answer_rows(runs):
    """Name, meaning, unit, and the value with its error of every run; errors have no row of their own."""
    names = dict.fromkeys(name for run in runs for name in run["summary"])
    rows = []
    for name in names:
        if name.endswith("_error") and name.removesuffix("_error") in names:
            continue
        known = next(run["summary"][name] for run in runs if name in run["summary"])
        rows.append({"name": name, "meaning": known["meaning"], "unit": known["unit"],
                     "values": [value_words(run["summary"], name) for run in runs]})
    return rows


def value_words(summary, name):
    """A result's value, with its estimated error where there is one."""
    if name not in summary:
        return ""
    value = summary[name]["value"]
    words = value if isinstance(value, str) else number(value)
    error = summary.get(f"{name}_error")
    return f"{words} ± {number(error['value'])}" if error else words


def key_rows(runs):
    """Every key that a case used, its value in every run, and whether they differ."""
    names = list(dict.fromkeys(name for run in runs for name in run["used"]))
    rows = []
    for name in names:
        values = [words_of(run["used"][name]) if name in run["used"] else "" for run in runs]
        rows.append({"name": name, "values": values, "differs": len(set(values)) > 1})
    return rows


def differences(first, second):
    """Rows of results that are numbers in both answers and differ."""
    both = {name: (one, one["value"], second["summary"].get(name, {}).get("value")) for name, one in first["summary"].items()}
    both = {name: row for name, row in both.items() if all(isinstance(value, float) and math.isfinite(value) for value in row[1:])}
    largest: dict[str, float] = {}  # of each unit: what is far below it is rounding
    for one, *values in both.values():
        largest[one["unit"]] = max(largest.get(one["unit"], 0.0), *map(abs, values))
    rows = []
    for name, (one, value, other) in both.items():
        if abs(other - value) > SAME*largest[one["unit"]]:
            unit, scale = readable_unit(one["unit"], name)
            before, after = scale*value, scale*other
            rows.append({"name": name + f" [{unit}]"*(unit != "1"), "first": rounded(before), "second": rounded(after), "more": rounded(after - before),
                         "percent": rounded(100.0*(after/before - 1.0)) if before else "", "meaning": one["meaning"]})
    return rows


def rounded(value):
    """A number with the digits that a table has; it sorts as one."""
    return float(f"{value:.4g}")


def words_of(value):
    """The value of a key."""
    return ", ".join(map(str, value)) if isinstance(value, tuple) else str(value)


def origin_rows(runs):
    """Where the numbers come from."""
    names = list(dict.fromkeys(name for run in runs for name in run["origin"]))
    return [(name, [run["origin"].get(name, "") for run in runs]) for name in names]
