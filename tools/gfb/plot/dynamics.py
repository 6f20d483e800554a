"""The picture of a bearing's stiffness and damping over the frequency of vibration."""

import numpy
from matplotlib import pyplot

from gfb.plot.rotor import of_foil, rates, read_modes
from gfb.plot.scene import case_name, number, read_scene
from gfb.results import used_keys
from gfb.tool import stop

KIND = "dynamics"
ENTRIES = (("xx", 0, 0, "C0", "-"), ("xy", 0, 1, "C1", "-"), ("yx", 1, 0, "C1", "--"), ("yy", 1, 1, "C0", "--"))
ANGLES = (("phi_x phi_x", 2, 2, "C0", "-"), ("phi_x phi_y", 2, 3, "C1", "-"), ("phi_y phi_x", 3, 2, "C1", "--"),
          ("phi_y phi_y", 3, 3, "C0", "--"))
CHARTS = (("stiffness", ENTRIES, 1.0e-6, "K [MN/m]"), ("damping", ENTRIES, 1.0e-3, "C [kN s/m]"),
          ("stiffness", ANGLES, 1.0, "K [N m/rad]"), ("damping", ANGLES, 1.0, "C [N m s/rad]"))
AXIAL = (("zz", 0, 0, "C0", "-"),)
RUNNER = tuple((words, row - 1, column - 1, colour, style) for words, row, column, colour, style in ANGLES)  # order e_z, phi_x, phi_y
CHARTS_OF_RUNNER = (("stiffness", AXIAL, 1.0e-6, "K [MN/m]"), ("damping", AXIAL, 1.0e-3, "C [kN s/m]"),
                    ("stiffness", RUNNER, 1.0, "K [N m/rad]"), ("damping", RUNNER, 1.0, "C [N m s/rad]"))


def draw(path, file, steps=()):
    """Displacements above, tilts below; stiffness at the left, damping at the right; of a sweep the last point, or the one named."""
    if "dynamics" not in file:
        stop(f"{path}: no stiffness and damping in it; they are of analysis = 'linear_dynamics'")
    group, title = file["dynamics"], case_name(path)
    frequency, row = group["frequency"][...], -1
    here: object = ...
    if group["stiffness"].ndim == 4:
        points = len(frequency)
        if len(steps) > 1 or not all(0 < step <= points for step in steps):
            stop(f"{path}: one point of the sweep at a time, --step 1 to {points}")
        here = row = steps[0] - 1 if steps else points - 1
        frequency, title = numpy.atleast_1d(frequency[row]), f"{title}: point {row + 1} of {points}"
    elif steps:
        stop(f"{path}: not a sweep: stiffness and damping are drawn without --step")
    elif "summary" in file:
        title = read_scene(file).title(path)
    rising = numpy.argsort(frequency)
    frequency, modes = frequency[rising], foil_modes(group, here)
    unknown = [] if lines_are_known(group) else between(frequency, modes)
    figure, axes = pyplot.subplots(2, 2, figsize=(11.0, 7.0), layout="constrained", sharex=True)
    charts = CHARTS if group["stiffness"].shape[-1] == 4 else CHARTS_OF_RUNNER
    for chart, (name, entries, scale, label) in zip(axes.flat, charts, strict=True):
        values = numpy.insert(group[name][here][rising]*scale, unknown, numpy.nan, axis=0)
        for words, first, second, colour, style in entries:
            chart.plot(numpy.insert(frequency, unknown, numpy.nan), values[:, first, second], style, color=colour, marker="o", markersize=3.0,
                       label=words)
        chart.axhline(0.0, color="0.6", linewidth=0.8)
        chart.set_ylabel(label)
        chart.grid(alpha=0.3)
    for row_of_charts in axes:
        row_of_charts[1].legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    marks = mark_frequencies(axes.flat, speed_of(file, row), whirl_of(file, row), modes, [frequency[place - 1:place + 1] for place in unknown])
    if marks:
        figure.legend(handles=marks, fontsize=8, loc="upper left", ncols=len(marks), frameon=False, bbox_to_anchor=(0.0, 0.965))
    for chart in axes[0]:
        chart.secondary_xaxis("top", functions=(lambda omega: omega/(2.0*numpy.pi), lambda hertz: 2.0*numpy.pi*hertz)).set_xlabel("[Hz]", fontsize=9)
    for chart in axes[1]:
        chart.set_xlabel("frequency of vibration [rad/s]")
    figure.suptitle(title + "\n"*bool(marks), fontsize=11)
    return figure


# --- what happens at which frequency ---

def foil_modes(group, here):
    """(frequency, width of its peak) of each mode of the foil at an answer [rad/s]: a peak is as wide as twice its growth or decay."""
    if "mode_frequency" not in group:
        return []
    modes = read_modes(group, here)
    return [(rate.imag, 2.0*abs(rate.real)) for rate in rates(modes)[of_foil(modes)] if rate.imag > 0.0]


def lines_are_known(group):
    """Whether frequencies were put between those asked for until lines are K and C (interpolation_tolerance)."""
    return "interpolation_miss" in group and bool(numpy.isfinite(group["interpolation_miss"][...]).all())


def between(frequency, modes):
    """Places of frequencies before which K and C are not known: a foil mode stands there whose peak is narrower than their distance."""
    places = numpy.searchsorted(frequency, [mode for mode, _ in modes])
    return sorted({int(place) for place, (_, width) in zip(places, modes)
                   if 0 < place < len(frequency) and frequency[place] - frequency[place - 1] > width})


def speed_of(file, row):
    """The shaft's speed at a row of the history [rad/s]; None where it is not given."""
    speed = file["history/speed_rpm"][row] if "history/speed_rpm" in file else \
        number(used_keys(file), "operation", "speed_rpm") if "scene/used" in file else None
    return None if speed is None else float(speed)*numpy.pi/30.0


def whirl_of(file, row):
    """Frequency at which the critical mass whirls, at a row of the history [rad/s]; None where none does."""
    speed = speed_of(file, row)
    ratio = next((float(file[name][...].ravel()[row]) for name in ("history/whirl_ratio", "summary/whirl_ratio") if name in file), numpy.nan)
    return None if speed is None or not numpy.isfinite(ratio) else ratio*speed


def mark_frequencies(charts, speed, whirl, modes, unknown):
    """Lines at the speed, the whirl and foil modes, and where K and C are not known; one of each as a legend has them."""
    marks = {}
    for chart in charts:
        low, high = chart.get_xlim()
        for place, words, look in ((speed, "running speed", {"color": "k", "linestyle": "-."}),
                                   (whirl, "whirl of the critical mass", {"color": "C3", "linestyle": ":"}),
                                   *((mode, "mode of the foil", {"color": "C2", "linestyle": "--"}) for mode, _ in modes)):
            if place is not None and low <= place <= high:
                marks[words] = chart.axvline(place, linewidth=1.0, label=words, **look)
        for ends in unknown:
            words = "not known: frequencies further apart than this mode's peak is wide"
            marks[words] = chart.axvspan(*ends, color="C2", alpha=0.12, linewidth=0.0, label=words)
        chart.set_xlim(low, high)
    return list(marks.values())
