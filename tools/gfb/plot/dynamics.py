"""The picture of a bearing's stiffness and damping over the frequency of vibration."""

import numpy
from matplotlib import pyplot

from gfb.plot.scene import case_name, read_scene
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
    frequency, here = group["frequency"][...], ...
    if group["stiffness"].ndim == 4:
        points = len(frequency)
        if len(steps) > 1 or not all(0 < step <= points for step in steps):
            stop(f"{path}: one point of the sweep at a time, --step 1 to {points}")
        here = steps[0] - 1 if steps else points - 1
        frequency, title = numpy.atleast_1d(frequency[here]), f"{title}: point {here + 1} of {points}"
    elif steps:
        stop(f"{path}: not a sweep: stiffness and damping are drawn without --step")
    elif "summary" in file:
        title = read_scene(file).title(path)
    figure, axes = pyplot.subplots(2, 2, figsize=(11.0, 6.6), layout="constrained", sharex=True)
    charts = CHARTS if group["stiffness"].shape[-1] == 4 else CHARTS_OF_RUNNER
    for chart, (name, entries, scale, label) in zip(axes.flat, charts, strict=True):
        values = group[name][here]*scale
        for words, row, column, colour, style in entries:
            chart.plot(frequency, values[:, row, column], style, color=colour, marker="o", markersize=3.0, label=words)
        chart.axhline(0.0, color="0.6", linewidth=0.8)
        chart.set_ylabel(label)
        chart.grid(alpha=0.3)
    for chart in axes[:, 1]:
        chart.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))  # of its row
    for chart in axes[1]:
        chart.set_xlabel("frequency of vibration [rad/s]")
    figure.suptitle(title, fontsize=11)
    return figure
