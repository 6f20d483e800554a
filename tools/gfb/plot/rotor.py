"""Rotors on bearings: frequency and damping of their modes over the speed, maps of the critical mass."""

import re

import numpy
from matplotlib import pyplot

from gfb.results import text_of
from gfb.tool import stop

KINDS = ("campbell", "map")
ROTOR = 0.02   # a smaller share of the rotor is a mode of film or foil
DEAD = 0.9       # a larger damping ratio is no vibration
KIND_WORDS = {1: "cylindrical", 2: "conical"}
LEVELS = 12      # of a map
GRAVITY = 9.81   # [m/s2]


def draw(paths, files, kind):
    """One of the pictures."""
    if kind == "campbell":
        if len(files) > 1:
            stop("--show campbell is of one file: a sweep over the speed")
        return draw_campbell(paths[0], files[0])
    return draw_map(paths, files)


def key_of(file, group, key):
    """Numbers of a key, as the echo of the case has them."""
    echo = text_of(file["scene/used"][()])
    found = re.search(rf"^&{group}$(.*?)^/$", echo, re.MULTILINE | re.DOTALL)
    found = found and re.search(rf"^\s*{key} = ([^!\n]*)", found[1], re.MULTILINE)
    return numpy.array([float(word) for word in found[1].replace(",", " ").split()]) if found else None


def along(file, name, points):
    """Speed [rpm] or load [N] of every point, swept or not."""
    if name in file["history"]:
        return file["history"][name][...]
    value = key_of(file, "operation", name)
    return numpy.full(points, numpy.hypot(*value) if name == "load" else value[0])


def draw_campbell(path, file):
    """Frequencies of the modes over the speed, and their damping ratios; of modes that vibrate."""
    if "dynamics/mode_frequency" not in file or "speed_rpm" not in file["history"]:
        stop(f"{path}: --show campbell needs a sweep over speed_rpm with &rotor")
    speed = file["history/speed_rpm"][...]
    of = {name: file[f"dynamics/mode_{name}"][...]
          for name in ("frequency", "damping_ratio", "shaft_share", "kind", "sense")}
    figure, (above, below) = pyplot.subplots(2, 1, figsize=(7.0, 7.0), sharex=True, layout="constrained")
    ends = numpy.array([0.0, 1.05*speed.max()])
    for ratio in (0.5, 1.0):
        above.plot(ends, ratio*ends/60.0, "k--" if ratio == 1.0 else "k:", linewidth=0.8)
        above.annotate(f"{ratio:g} of the speed", (ends[1], ratio*ends[1]/60.0), fontsize=8, ha="right", va="bottom")
    with numpy.errstate(invalid="ignore"):
        shown = (of["shaft_share"] > ROTOR) & (of["damping_ratio"] < DEAD)
    for kind, words in KIND_WORDS.items():
        for sense, way, marker in ((1.0, "forward", "o"), (-1.0, "backward", "v")):
            here = shown & (of["kind"] == kind) & (of["sense"]*sense > 0.0)
            if not here.any():
                continue
            speeds = numpy.broadcast_to(speed[:, None], here.shape)[here]
            label, colour = f"{words}, {way}", f"C{kind - 1}"
            above.plot(speeds, of["frequency"][here]/(2.0*numpy.pi), marker, color=colour, markersize=4,
                       markerfacecolor=colour if sense > 0.0 else "none", label=label)
            below.plot(speeds, of["damping_ratio"][here], marker, color=colour, markersize=4,
                       markerfacecolor=colour if sense > 0.0 else "none", label=label)
    below.axhline(0.0, color="k", linewidth=0.8)
    if "onset_speed_rpm" in file["summary"]:
        onset = float(file["summary/onset_speed_rpm"][()])
        for chart in (above, below):
            chart.axvline(onset, color="C3", linewidth=1.0)
        below.annotate(f"onset {onset:,.0f} rpm", (onset, 0.98), xycoords=("data", "axes fraction"), fontsize=8,
                       color="C3", rotation=90, ha="right", va="top")
    above.set_ylim(0.0, 1.25*ends[1]/60.0)
    above.set_xlim(ends)
    above.set_ylabel("frequency [Hz]")
    below.set_ylabel("damping ratio; below 0 the mode grows")
    below.set_xlabel("speed [rpm]")
    above.legend(fontsize=8)
    for chart in (above, below):
        chart.grid(alpha=0.3)
    figure.suptitle(path.name.removesuffix(".h5"), fontsize=11)
    return figure


def draw_map(paths, files):
    """Critical mass over load and speed, with lines of the whirl ratio; crosses where no mass whirls."""
    speeds, loads, masses, ratios = [], [], [], []
    for path, file in zip(paths, files):
        points = len(file["history/converged"]) if "history/converged" in file else 0
        if points == 0 or "dynamics" not in file:
            stop(f"{path}: --show map needs sweeps over load or speed with analysis = 'linear_dynamics'")
        none = numpy.full(points, numpy.nan)
        speeds.append(along(file, "speed_rpm", points))
        loads.append(along(file, "load", points))
        masses.append(file["history/critical_mass"][...] if "critical_mass" in file["history"] else none)
        ratios.append(file["history/whirl_ratio"][...] if "whirl_ratio" in file["history"] else none)
    speed, load, mass, ratio = (numpy.concatenate(part) for part in (speeds, loads, masses, ratios))
    found = mass > 0.0
    if found.sum() < 3 or len(set(speed)) < 2 or len(set(load)) < 2:
        stop("--show map needs two loads, two speeds and three points where some mass whirls")
    figure, chart = pyplot.subplots(figsize=(7.0, 5.0), layout="constrained")
    logarithm = numpy.log10(mass[found])
    filled = chart.tricontourf(speed[found], load[found], logarithm, LEVELS, cmap="viridis")
    lines = chart.tricontour(speed[found], load[found], ratio[found], 6, colors="w", linewidths=0.8)
    chart.clabel(lines, fontsize=8, fmt="%.2f")
    of_weight = numpy.log(mass[found]*GRAVITY/load[found])
    if of_weight.min() < 0.0 < of_weight.max():
        chart.tricontour(speed[found], load[found], of_weight, [0.0], colors="C3", linewidths=1.5)
        chart.plot([], [], color="C3", label="onset under the rotor's own weight")
    chart.plot(speed[found], load[found], "k.", markersize=3)
    if (~found).any():
        chart.plot(speed[~found], load[~found], "kx", markersize=6, label="no mass whirls")
    if chart.get_legend_handles_labels()[0]:
        chart.legend(fontsize=8)
    bar = figure.colorbar(filled, ax=chart)
    bar.set_label("critical mass [kg]")
    bar.ax.set_yticks(bar.get_ticks(), [f"{10.0**tick:.3g}" for tick in bar.get_ticks()])
    chart.set_xlabel("speed [rpm]")
    chart.set_ylabel("load [N]")
    chart.set_title("critical mass; white: frequency of the whirl over the speed", fontsize=10)
    return figure
