"""Rotors on bearings: frequency and damping of their modes over the speed, maps of the critical mass."""

import numpy
from matplotlib import colors, pyplot

from gfb.plot.colours import draw_bar, levels_of
from gfb.results import used_keys
from gfb.tool import stop

KINDS = ("campbell", "map")
MODE = ("frequency", "damping_ratio", "shaft_share", "foil_share", "owner", "kind", "sense")  # what is shown of each
ROTOR, FOIL, BOTH = 1, 2, 4  # owners of modes
LEAST = 0.02     # of files that do not name the owner: a smaller share of the rotor is a mode of film or foil
DEAD = 0.9       # a larger damping ratio is no vibration
KIND_WORDS = {1: "cylindrical", 2: "conical"}
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
    words, _ = used_keys(file).get((group, key), ("", True))
    return numpy.array([float(word) for word in words.split(",")]) if words else None


def along(file, name, points):
    """Speed [rpm] or load [N] of every point, swept or not."""
    if name in file["history"]:
        return file["history"][name][...]
    value = key_of(file, "operation", name)
    return numpy.full(points, numpy.hypot(*value) if name == "load" else value[0])


def read_modes(group, here=...):
    """Modes of one answer, or on (point, mode), as arrays by name."""
    return {name: group[f"mode_{name}"][here] for name in MODE if f"mode_{name}" in group}


def of_rotor(modes):
    """Which modes are the rotor's, or both the rotor's and the foil's."""
    if "owner" in modes:
        return (modes["owner"] == ROTOR) | (modes["owner"] == BOTH)
    with numpy.errstate(invalid="ignore"):
        return modes["shaft_share"] > LEAST


def of_foil(modes):
    """Which modes are the foil's: the rotor has no share that counts, and the foil more of the energy than the film."""
    if "owner" in modes:
        return modes["owner"] == FOIL
    if "foil_share" not in modes:
        return numpy.zeros(modes["frequency"].shape, bool)
    with numpy.errstate(invalid="ignore"):
        return (modes["shaft_share"] < LEAST) & (modes["foil_share"] > 1.0 - modes["shaft_share"] - modes["foil_share"])


def rates(modes):
    """growth + i frequency [1/s]."""
    with numpy.errstate(invalid="ignore", divide="ignore"):
        return modes["frequency"]*(1j - modes["damping_ratio"]/numpy.sqrt(1.0 - modes["damping_ratio"]**2))


def branches(speed, rate, sense, kind, shown):
    """Modes of neighbouring points that are one: of the same kind, and each the nearest of the other's point; lists of (point, mode). Where a
    branch is wanted next is by its last two points; what goes round another way is farther, by up to three times."""
    found: list[list[tuple[int, int]]] = []
    ends: list[list[tuple[int, int]]] = []
    for point in range(len(rate)):
        here = [(point, int(mode)) for mode in numpy.flatnonzero(shown[point])]
        away = numpy.full((len(here), len(ends)), numpy.inf)
        for column, branch in enumerate(ends):
            wanted, last = predicted(speed, rate, branch, point), branch[-1]
            for row, mode in enumerate(here):
                if kind[mode] == kind[last]:
                    away[row, column] = abs(rate[mode] - wanted)*(1.0 + abs(sense[mode] - sense[last]))
        joined = []
        for row, mode in enumerate(here):
            column = int(numpy.argmin(away[row])) if ends else 0
            fits = bool(ends) and numpy.isfinite(away[row, column]) and int(numpy.argmin(away[:, column])) == row
            branch = ends[column] if fits else []
            if not fits:
                found.append(branch)
            branch.append(mode)
            joined.append(branch)
        ends = joined
    return found


def predicted(speed, rate, branch, point):
    """The rate of a branch at a point, on the line through its last two."""
    last, before = rate[branch[-1]], rate[branch[-2]] if len(branch) > 1 else None
    step = speed[branch[-1][0]] - speed[branch[-2][0]] if len(branch) > 1 else 0.0
    return last if before is None or not step > 0.0 else last + (last - before)*(speed[point] - speed[branch[-1][0]])/step


def draw_campbell(path, file):
    """Frequencies of the rotor's modes over the speed, joined to branches, with their damping ratios; foil modes as marks."""
    if "dynamics/mode_frequency" not in file or "speed_rpm" not in file["history"]:
        stop(f"{path}: --show campbell needs a sweep over speed_rpm with &rotor")
    speed, modes = file["history/speed_rpm"][...], read_modes(file["dynamics"])
    rising = numpy.argsort(speed, kind="stable")
    speed, modes = speed[rising], {name: values[rising] for name, values in modes.items()}
    hertz, damping = modes["frequency"]/(2.0*numpy.pi), modes["damping_ratio"]
    figure, (above, below) = pyplot.subplots(2, 1, figsize=(7.0, 7.4), sharex=True, layout="constrained")
    ends = numpy.array([0.0, 1.05*speed.max()])
    for ratio, words, style in ((1.0, "running speed", "k-."), (0.5, "half of it", "k:")):
        above.plot(ends, ratio*ends/60.0, style, linewidth=1.0, label=words)
    with numpy.errstate(invalid="ignore"):
        vibrates = (damping < DEAD) & (hertz > 0.0)
        shown = vibrates & of_rotor(modes)
    for branch in branches(speed, rates(modes), modes["sense"], modes["kind"], shown):
        place = tuple(numpy.array(branch).T)
        for chart, values in ((above, hertz), (below, damping)):
            chart.plot(speed[place[0]], values[place], color=f"C{int(modes['kind'][place][0]) - 1}", linewidth=1.2)
    for kind, words in KIND_WORDS.items():
        for sense, way, marker in ((1.0, "forward", "o"), (-1.0, "backward", "v")):
            here = shown & (modes["kind"] == kind) & (modes["sense"]*sense > 0.0)
            if here.any():
                look = {"color": f"C{kind - 1}", "markersize": 4, "markerfacecolor": f"C{kind - 1}" if sense > 0.0 else "w"}
                mark_modes((above, below), speed, (hertz, damping), here, marker, f"{words}, {way}", look)
    here = vibrates & of_foil(modes)
    if here.any():
        mark_modes((above, below), speed, (hertz, damping), here, "x", "of the foil", {"color": "C7", "markersize": 5})
    below.axhline(0.0, color="k", linewidth=0.8)
    if "onset_speed_rpm" in file["summary"]:
        onset = float(file["summary/onset_speed_rpm"][()])
        for chart in (above, below):
            chart.axvline(onset, color="C3", linewidth=1.0, label=f"onset {onset:,.0f} rpm" if chart is above else None)
    highest = max([ends[1]/60.0, *hertz[shown | here]])
    above.set(xlim=ends, ylim=(0.0, 1.05*highest), ylabel="frequency [Hz]")
    below.set(xlabel="speed [rpm]", ylabel="damping ratio; below 0 the mode grows")
    above.legend(fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4, frameon=False)
    for chart in (above, below):
        chart.grid(alpha=0.3)
    figure.suptitle(path.name.removesuffix(".h5"), fontsize=11)
    return figure


def mark_modes(charts, speed, fields, here, marker, label, look):
    """A mark for each of some modes, in the charts of frequency and damping."""
    speeds = numpy.broadcast_to(speed[:, None], here.shape)[here]
    for chart, values in zip(charts, fields):
        chart.plot(speeds, values[here], marker, label=label, zorder=3, **look)


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
    ends = mass[found].min(), mass[found].max()
    look = {"cmap": "viridis", "norm": colors.LogNorm(*ends)}
    chart.tricontourf(speed[found], load[found], mass[found], levels=levels_of(*ends, look["norm"]), **look)
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
        chart.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=2, frameon=False)
    draw_bar(figure, chart, **look).set_label("critical mass [kg]")
    chart.use_sticky_edges = False
    chart.margins(0.03)  # points at the ends of the axes are whole
    chart.set_xlabel("speed [rpm]")
    chart.set_ylabel("load [N]")
    chart.set_title("critical mass; white: frequency of the whirl over the speed", fontsize=10)
    return figure
