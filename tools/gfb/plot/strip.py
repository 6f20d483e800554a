"""Pictures of loaded bump strips: deflection per bump, force-displacement loops, contact states."""

import os
import textwrap

import numpy
from matplotlib import pyplot

from gfb.plot import contact
from gfb.results import used_keys
from gfb.tool import stop

MICRO = 1.0e6
MILLI = 1.0e3
FORCE = "history/axial_force"  # of thrust bearings
KINDS = ("bumps", "loop", "contact")
STYLES = ("-", "--", "-.", ":")
MOST_MARKED = 30   # rows of a history whose points are marked
MOST_LABELLED = 24 # bars that carry their value
WIDEST_LABEL = 60 # letters of a line of a legend
SHORTEST = 5       # letters of a common name that says something
LEAST = 1.0e-12    # of the largest force: a load below it is none


def is_strip(file):
    """Whether a case file is of a strip under loads."""
    return "history/crest_deflection_1" in file


def is_bearing(file):
    """Whether a case file is of a bearing on foils with contacts."""
    return any(f"history/{name}" in file for name in ("eccentricity_x", "axial_gap")) and any(f"contact/{name}/state" in file for name in contact.SURFACES)


def draw(paths, files, kind, steps):
    """The picture of one or several strips, or of a bearing's contacts."""
    if len(files) == 1 and kind in (None, "contact") and is_bearing(files[0]):
        return draw_contacts(paths[0], files[0], steps)
    for path, file in zip(paths, files):
        if not is_strip(file):
            stop(f"{path}: not a strip under loads, or no load step was done")
    if kind is None:
        kind = "loop" if all(goes_back(file) for file in files) else "bumps"
    if steps and kind == "loop":
        stop("a loop is of all steps; --step is for --show bumps and contact")
    if kind == "contact":
        if len(files) > 1:
            stop("contact states are drawn of one file at a time")
        return draw_contacts(paths[0], files[0], steps)
    if kind == "bumps":
        if len(steps) > 1:
            stop("deflections are drawn of one step at a time")
        return draw_bumps(paths, files, steps)
    return draw_loops(paths, files)


def goes_back(file):
    """Whether the load falls again."""
    force = numpy.abs(file["history/force"][...])
    return bool(force[-1] < force.max()*(1.0 - LEAST))


def row_of(path, file, step):
    """The row of a step; without one, a strip's largest force, which is the full load, or a bearing's last point."""
    numbers = steps_of(file)
    if step is None:
        return len(numbers) - 1 if is_bearing(file) else int(numpy.argmax(numpy.abs(file["history/force"][...])))
    if step not in numbers:
        stop(f"{path}: no step {step}; there are {numbers[0]} to {numbers[-1]}")
    return int(numpy.flatnonzero(numbers == step)[0])


def steps_of(file):
    """Numbers of a strip's load steps or of a bearing's sweep points."""
    if is_bearing(file):
        return numpy.arange(1, len(file[FORCE if FORCE in file else "history/force_x"]) + 1)
    return numpy.rint(file["history/step"][...]).astype(int)


def words_of(file, row):
    """A row in words: which it is, and its load."""
    if not is_bearing(file):
        return f"step {int(file['history/step'][row])}, {file['history/force'][row]:.4g} N"
    forces = [file[name] for name in ((FORCE,) if FORCE in file else ("history/force_x", "history/force_y"))]
    words = f"{numpy.linalg.norm([force[row] for force in forces]):.4g} N"
    return words if len(forces[0]) == 1 else f"point {row + 1}, {words}"


def name_of(path):
    """The case's name."""
    return path.name.removesuffix(".h5")


def common_name(paths):
    """What the names of all cases begin with, or nothing."""
    words = os.path.commonprefix([name_of(path) for path in paths])
    return words.rstrip("_-. ") if len(words) >= SHORTEST else ""


# --- what distinguishes files ---

def labels(paths, files):
    """What a legend calls each file: the keys that differ and that some file sets, or the case's name."""
    names = [name_of(path) for path in paths]
    if len(files) == 1:
        return names
    used = [used_keys(file) for file in files]
    differing = []
    for key in {key: None for keys in used for key in keys}:
        found = [keys.get(key, ("none", True)) for keys in used]
        if key != ("scene", "title") and len({value for value, _ in found}) > 1 and not all(d for _, d in found):
            differing.append(key)
    words = [", ".join(f"{key[1]} = {keys.get(key, ('none', True))[0]}" for key in differing) for keys in used]
    if not differing or len(differing) > 3 or len(set(words)) < len(words):
        return names
    return words


# --- deflection per bump ---

def draw_bumps(paths, files, steps):
    """Mean deflection of each crest line, a bar a file."""
    step = steps[0] if steps else None
    columns = []
    for path, file in zip(paths, files):
        row = row_of(path, file, step)
        bumps = sum(name.startswith("crest_deflection_") for name in file["history"])
        columns.append([MICRO*file[f"history/crest_deflection_{n}"][row] for n in range(1, bumps + 1)])
    most = max(map(len, columns))
    width = 0.84/len(columns)
    labelled = most*len(columns) <= MOST_LABELLED
    figure, chart = pyplot.subplots(figsize=(max(6.5, 0.42*most*len(columns) + 2.0), 4.2), layout="constrained")
    for i, (column, label) in enumerate(zip(columns, labels(paths, files))):
        place = numpy.arange(1, len(column) + 1) + (i - 0.5*(len(columns) - 1))*width
        bars = chart.bar(place, column, 0.94*width, label=label)
        if labelled:
            chart.bar_label(bars, fmt="%.2f", fontsize=7, padding=1.5)
    chart.axhline(0.0, color="0.4", linewidth=0.8)
    chart.set(xlabel="bump, counted along x (the shaft's motion)", ylabel="deflection towards the sleeve [um]",
              xticks=range(1, most + 1))
    chart.grid(axis="y", alpha=0.3)
    chart.margins(y=0.1)
    where = "at the full load" if step is None else f"in step {step}"
    chart.set_title(f"mean deflection of each crest line {where}", fontsize=10)
    figure.suptitle(common_name(paths), fontsize=11)
    if len(files) > 1:
        chart.legend(fontsize=8)
    return figure


# --- loops ---

def travel(file):
    """Name of what the force moves, and its values from the unloaded start on [m]."""
    history = file["history"]
    if "plate_travel" in history:
        return "travel of the upper plate", with_start(history["plate_travel"][...])
    crests = [history[name][...] for name in history if name.startswith("crest_deflection_")]
    return "largest crest deflection", with_start(numpy.max(crests, axis=0))


def with_start(values):
    """The history with its unloaded start, which stands in no row."""
    return numpy.concatenate(([0.0], values))


def draw_loops(paths, files):
    """Force against travel; and the same less the straight line to the full load, where loops open."""
    figure, (chart, opened) = pyplot.subplots(1, 2, figsize=(10.5, 5.4), layout="constrained")
    words = set()
    for i, (file, label) in enumerate(zip(files, labels(paths, files))):
        word, way = travel(file)
        words.add(word)
        force = with_start(file["history/force"][...])
        top = int(numpy.argmax(numpy.abs(force)))
        if not (abs(force[top]) > 0.0 and abs(way[top]) > 0.0):
            stop(f"{paths[i]}: nothing is loaded, there is no loop")
        if "dissipated_energy" in file["summary"]:
            label = f"{MILLI*file['summary/dissipated_energy'][()]:.4g} mJ: {label}"
        look = {"linestyle": STYLES[i % len(STYLES)], "marker": "o" if len(force) <= MOST_MARKED else "",
                "markersize": 3.0, "linewidth": 1.3, "label": textwrap.fill(label, WIDEST_LABEL)}
        for one, height in ((chart, force), (opened, force - force[top]/way[top]*way)):
            (line,) = one.plot(MICRO*way, height, **look)
            draw_arrows(one, MICRO*way, height, force, line.get_color())
    across = " / ".join(sorted(words)) + " [um]"
    chart.set(xlabel=across, ylabel="force on all crests [N]")
    chart.set_title("loading and unloading", fontsize=10)
    opened.set(xlabel=across, ylabel="force less the line [N]")
    opened.set_title("the same, less the straight line to the full load", fontsize=10)
    for one in (chart, opened):
        one.grid(alpha=0.3)
    chart.legend(fontsize=8, title="with the work lost in the cycle", title_fontsize=8, loc="upper left", bbox_to_anchor=(0.0, -0.17))  # beside no loop
    figure.suptitle(common_name(paths), fontsize=11)
    return figure


def draw_arrows(chart, way, height, force, colour):
    """The sense of a loop: an arrow where the load rises and one where it falls."""
    top = int(numpy.argmax(numpy.abs(force)))
    for first, last in ((0, top), (top, len(force) - 1)):
        if last > first:
            at = (first + last - 1)//2
            chart.annotate("", (0.5*(way[at] + way[at + 1]), 0.5*(height[at] + height[at + 1])), (way[at], height[at]),
                           arrowprops={"arrowstyle": "-|>", "color": colour, "mutation_scale": 13.0, "shrinkA": 0.0, "shrinkB": 0.0})


# --- contacts ---

def draw_contacts(path, file, steps):
    """States and forces of the contacts, of each step asked for or of the full load."""
    rows = [row_of(path, file, step) for step in steps or [None]]
    return contact.draw(path, file, rows, [words_of(file, row) for row in rows], name_of(path), used_keys(file))
