"""Small motions of a machine: shapes of its modes in space, their frequencies and decrements over the speed, its response to unbalance, and
undamped critical speeds over the stiffness of bearings, from the shaft's matrices."""

import math

import numpy
from matplotlib import pyplot

from gfb.plot import machine as drawing
from gfb.plot.machine import MICRO, MILLI, smooth
from gfb.plot.rotor import DEAD, branches
from gfb.plot.scene import case_name
from gfb.tool import stop

KINDS = ("shapes", "response", "critical")
MOST_SHAPES = 6    # that a picture has
ROUND = 73         # points of an orbit
ORBITS = 25        # of a shape, about
RPM = 30.0/math.pi
SPEEDS = 4         # critical speeds that a map has
CIRCULAR = 0.05    # a smaller sense goes to and fro
PLACE = 5          # numbers of a place's response: z, amplitude and phase of x, of y
PEAKED = 0.4*math.pi  # decrement of an amplification by 2.5, below which API 617 counts no critical speed
DECREMENT = 1.0    # at the ends of the colours


def read_modes(file):
    """{name: (point, mode)} of all modes, a point alone one row."""
    group = file["dynamics"]
    names = {"frequency": "mode_frequency", "growth": "mode_growth_rate", "damping": "mode_damping_ratio", "sense": "mode_sense",
             "decrement": "logarithmic_decrement"}
    swept = "history/speed_rpm" in file
    return {name: group[place][...] if swept else group[place][...].reshape(1, -1) for name, place in names.items()}


def need_modes(path, file):
    """Stops where there are no modes."""
    if "dynamics/mode_frequency" not in file or not drawing.is_machine(file):
        stop(f"{path}: no modes of a machine; they come with analysis = 'linear_dynamics'")


# --- shapes in space ---

def draw_shapes(path, file):
    """The orbits of the axis in the least damped modes of the last point."""
    need_modes(path, file)
    machine, modes = drawing.read(path, file), read_modes(file)
    shape = file["dynamics/mode_shape"][...]
    many = min(len(shape), MOST_SHAPES)
    if many == 0:
        stop(f"{path}: no mode was found")
    shape = shape.reshape(len(shape), -1, 4, 2)
    across = 2 if many == 4 else min(many, 3)
    figure, charts = pyplot.subplots(-(-many//across), across, figsize=(4.8*across, 3.2*-(-many//across)), squeeze=False,
                                     subplot_kw={"projection": "3d"}, layout="constrained")
    for chart in list(charts.flat)[many:]:
        chart.remove()
    for number, chart in zip(range(many), charts.flat):
        motions = shape[number, :, :, 0] + 1j*shape[number, :, :, 1]
        draw_shape(chart, machine, motions/numpy.abs(motions[:, :2]).max())
        frequency, sense = modes["frequency"][-1, number], modes["sense"][-1, number]
        chart.set_title(f"mode {number + 1}: {frequency/(2.0*math.pi):.4g} Hz, {frequency*RPM/machine.speed:.3g} of the speed,\n"
                        f"{way_of(sense)}, log decrement {modes['decrement'][-1, number]:.3g}", fontsize=9)
    figure.suptitle(drawing.title(path, machine), fontsize=11)
    return figure


def way_of(sense):
    """Which way a mode goes round, as the log says it."""
    return "to and fro" if abs(sense) <= CIRCULAR else "forward" if sense > 0.0 else "backward"


def draw_shape(chart, machine, motions):
    """Orbits at the nodes, the axis at an instant, and where the bearings are; the machine's z to the right, x up."""
    turn = numpy.exp(1j*numpy.linspace(0.0, 2.0*math.pi, ROUND))
    z, place = MILLI*machine.z, motions[:, :2]
    for node in range(0, len(z), max(1, len(z)//ORBITS)):
        orbit = (place[node, :, None]*turn).real
        chart.plot(numpy.full(ROUND, z[node]), orbit[1], orbit[0], color="C0", linewidth=0.6, alpha=0.6)
    largest = place.ravel()[numpy.abs(place).argmax()]
    instant = (motions*abs(largest)/largest).real
    (along, x), (_, y) = (smooth(machine, instant, column) for column in (0, 1))
    chart.plot(along, y, x, color="C3", linewidth=1.8)
    chart.plot(z[[0, -1]], (0.0, 0.0), (0.0, 0.0), "k-.", linewidth=0.8)
    for number, (middle, length, *_) in enumerate(machine.bearings, 1):
        length = 0.0 if machine.thrust[number - 1] else length
        chart.plot(MILLI*numpy.array((middle - 0.5*length, middle + 0.5*length)), (0.0, 0.0), (0.0, 0.0), color="C2", linewidth=4.0, solid_capstyle="butt")
        chart.text(MILLI*middle, 0.0, -1.25, str(number), color="C2", fontsize=9, ha="center")
    for places, look in ((machine.bearings[:, 0], {"marker": "o", "color": "C2"}), ([disc.position for disc in machine.discs], {"marker": "s", "color": "0.3"})):
        for middle in places:
            node = numpy.abs(machine.z - middle).argmin()
            chart.plot(z[node], instant[node, 1], instant[node, 0], markersize=5, **look)
    chart.set(ylim=(-1.05, 1.05), zlim=(-1.05, 1.05), yticks=(-1, 0, 1), zticks=(-1, 0, 1))
    chart.set_box_aspect((2.2, 1.0, 1.0), zoom=1.2)
    chart.view_init(elev=18.0, azim=-62.0)
    chart.tick_params(labelsize=7, pad=0)
    chart.set_xlabel("z [mm]", fontsize=8, labelpad=4)
    chart.set_ylabel("y", fontsize=8, labelpad=-4)
    chart.set_zlabel("x", fontsize=8, labelpad=-8)


# --- over the speed ---

def draw_campbell(path, file):
    """Frequencies of the modes over the speed, joined to branches, and their logarithmic decrements."""
    need_modes(path, file)
    if "history/speed_rpm" not in file:
        stop(f"{path}: --show campbell needs a sweep over speed_rpm")
    speed, modes = file["history/speed_rpm"][...], read_modes(file)
    rising = numpy.argsort(speed, kind="stable")
    speed, modes = speed[rising], {name: values[rising] for name, values in modes.items()}
    hertz, decrement = modes["frequency"]/(2.0*math.pi), modes["decrement"]
    with numpy.errstate(invalid="ignore"):
        shown = (modes["damping"] < DEAD) & (hertz > 0.0)
        way = numpy.where(modes["sense"] > 0.0, 1, 2)
    figure, (above, below) = pyplot.subplots(2, 1, figsize=(7.4, 8.0), sharex=True, layout="constrained")
    ends = numpy.array([0.0, 1.05*speed.max()])
    for ratio, words, style in ((1.0, "1 x speed", "k-."), (0.5, "1/2 x", "k:")):
        above.plot(ends, ratio*ends/60.0, style, linewidth=1.0, label=words)
    joined = branches(speed, modes["growth"] + 1j*modes["frequency"], modes["sense"], numpy.ones(hertz.shape), shown)
    crossings = []
    for branch in joined:
        place = tuple(numpy.array(branch).T)
        for chart, values in ((above, hertz), (below, decrement)):
            chart.plot(speed[place[0]], values[place], color="0.55", linewidth=1.0, zorder=2)
        crossings += crossings_of(speed[place[0]], hertz[place], decrement[place])
    for one, words, marker in ((1, "forward", "o"), (2, "backward", "v")):
        here = shown & (way == one)
        across = numpy.broadcast_to(speed[:, None], here.shape)[here]
        for chart, values in ((above, hertz), (below, decrement)):
            drawn = chart.scatter(across, values[here], c=decrement[here], marker=marker, cmap="coolwarm_r", vmin=-DECREMENT, vmax=DECREMENT,
                                  edgecolors="k", linewidths=0.6, s=30, zorder=3, label=words)
    if crossings:
        crossings.sort()
        above.plot(crossings, numpy.array(crossings)/60.0, "*", color="gold", markeredgecolor="k", markersize=13, zorder=4,
                   label="meets the speed: " + ", ".join(f"{one:,.0f}" for one in crossings) + " rpm")
    figure.colorbar(drawn, ax=[above, below], label="logarithmic decrement: red grows", aspect=40)
    below.axhline(0.0, color="k", linewidth=0.8)
    if "onset_speed_rpm" in file["summary"]:
        onset = float(file["summary/onset_speed_rpm"][()])
        for chart in (above, below):
            chart.axvline(onset, color="C3", linewidth=1.0, label=f"onset {onset:,.0f} rpm" if chart is above else None)
    above.set(xlim=ends, ylim=(0.0, 1.05*max(ends[1]/60.0, hertz[shown].max(initial=0.0))), ylabel="frequency [Hz]")
    low, high = (numpy.nanquantile(decrement[shown], share) for share in (0.0, 0.8))
    below.set(xlabel="speed [rpm]", ylabel="logarithmic decrement; below 0 it grows", ylim=(min(-0.1, 1.1*low), max(0.5, 1.2*high)))
    above.legend(fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, frameon=False)
    for chart in (above, below):
        chart.grid(alpha=0.3)
    figure.suptitle(case_name(path), fontsize=11)
    return figure


def crossings_of(speed, hertz, decrement):
    """Speeds at which a branch's frequency is that of the turns, and so little damped that the response has a peak there [rpm]."""
    off = hertz - speed/60.0
    return [float(speed[i] + (speed[i + 1] - speed[i])*off[i]/(off[i] - off[i + 1])) for i in range(len(off) - 1)
            if off[i]*off[i + 1] < 0.0 and min(decrement[i:i + 2]) < PEAKED]


# --- unbalance ---

def draw_response(path, file):
    """Amplitude and phase over the speed, or at one speed the ellipses."""
    if "dynamics/response" not in file:
        stop(f"{path}: no response to unbalance; it comes with &unbalance and analysis = 'linear_dynamics'")
    machine = drawing.read(path, file)
    table = file["dynamics/response"][...]
    speed = response_speeds(file)
    if speed is None:
        return draw_ellipses(path, machine, table)
    rising = numpy.argsort(speed, kind="stable")
    speed, table = speed[rising], table[rising].reshape(len(speed), -1, PLACE)
    figure, (above, below) = pyplot.subplots(2, 1, figsize=(7.4, 7.4), sharex=True, layout="constrained")
    for number, (words, _) in enumerate(machine.places):
        for column, style in ((1, "-"), (3, "--")):
            axis = "x" if column == 1 else "y"
            above.plot(speed, MICRO*table[:, number, column], style, color=f"C{number}", linewidth=1.4, marker=".", label=f"{words}, {axis}")
            below.plot(speed, numpy.degrees(numpy.unwrap(table[:, number, column + 1])), style, color=f"C{number}", linewidth=1.2, marker=".")
    above.set(ylabel="amplitude [um]", ylim=(0.0, None))
    below.set(xlabel="speed [rpm]", ylabel="phase [deg]")
    if "onset_speed_rpm" in file["summary"]:
        onset = float(file["summary/onset_speed_rpm"][()])
        for chart in (above, below):
            chart.axvline(onset, color="C3", linewidth=1.0, label=f"onset {onset:,.0f} rpm: beyond it whirls" if chart is above else None)
    for number, critical in enumerate(critical_speeds_of(file), 1):
        for chart in (above, below):
            chart.axvline(critical, color="k", linestyle=":", linewidth=1.0, label=f"critical speed {number}, {critical:,.0f} rpm" if chart is above else None)
    above.legend(fontsize=8, ncols=2)
    for chart in (above, below):
        chart.grid(alpha=0.3)
    figure.suptitle(f"{case_name(path)}: response to unbalance", fontsize=11)
    return figure


def response_speeds(file):
    """The speeds of the response [rpm]; None where it is at one."""
    for name in ("dynamics/response_speed", "history/speed_rpm"):
        if name in file:
            return file[name][...].ravel()
    return None


def critical_speeds_of(file):
    """Those that were found [rpm]."""
    summary = file["summary"]
    found: list[float] = []
    while f"critical_speed_{len(found) + 1}" in summary:
        found.append(float(summary[f"critical_speed_{len(found) + 1}"][()]))
    return found


def draw_ellipses(path, machine, table):
    """The way of the axis about its place at rest, at each bearing, disc and station."""
    turn = numpy.exp(1j*numpy.linspace(0.0, 2.0*math.pi, ROUND))
    figure, charts = pyplot.subplots(1, len(table), figsize=(3.4*len(table), 4.5), squeeze=False, layout="constrained")
    far = 1.15*MICRO*max(table[:, 1].max(), table[:, 3].max())
    for chart, (words, _), (_, x, phase_x, y, phase_y) in zip(charts.flat, machine.places, table):
        across, up = (MICRO*(size*numpy.exp(1j*phase)*turn).real for size, phase in ((y, phase_y), (x, phase_x)))
        chart.plot(up, across, color="C0")
        chart.plot(up[0], across[0], "o", color="C3", markersize=5)
        chart.set_title(f"{words}\n{MICRO*x:.3g} x {MICRO*y:.3g} um", fontsize=9)
        chart.set(xlim=(-far, far), ylim=(-far, far), aspect="equal", xlabel="x [um]")
        chart.grid(alpha=0.3)
    charts[0, 0].set_ylabel("y [um]")
    figure.suptitle(f"{drawing.title(path, machine)}: response to unbalance, red at phase 0", fontsize=11)
    return figure


# --- critical speeds over stiffness ---

def critical_speeds(mass, stiffness, polar, nodes, spring):
    """The first undamped forward speeds [rad/s] of a shaft on equal springs [N/m]: K q = W^2 (M - G) q in each plane."""
    held = stiffness.copy()
    for node in nodes:
        held[2*node, 2*node] += spring
    half = numpy.linalg.cholesky(held)
    inner = numpy.linalg.solve(half, numpy.linalg.solve(half, mass - polar).T)
    flexible = numpy.linalg.eigvalsh(0.5*(inner + inner.T))[::-1]
    return 1.0/numpy.sqrt(flexible[flexible > 0.0][:SPEEDS])


def draw_critical(path, file):
    """The first critical speeds over the stiffness that each bearing would have, without damping."""
    machine = drawing.read(path, file)
    mass, stiffness, polar = (file[f"shaft/{name}"][...] for name in ("mass", "stiffness", "polar_inertia"))
    nodes = [int(numpy.abs(machine.z - z).argmin()) for z, side in zip(machine.bearings[:, 0], machine.thrust) if not side]
    if len(nodes) < 2:
        stop(f"{path}: --show critical is of two journals or more")
    middle = mass[::2, ::2].sum()*(machine.speed/RPM)**2/len(nodes)  # of a stiff shaft its first critical speed is near the speed then
    springs = middle*numpy.logspace(-2.5, 2.5, 81)
    speeds = numpy.full((len(springs), SPEEDS), numpy.nan)
    for row, spring in zip(speeds, springs):
        found = critical_speeds(mass, stiffness, polar, nodes, spring)*RPM
        row[:len(found)] = found
    figure, chart = pyplot.subplots(figsize=(7.4, 5.4), layout="constrained")
    for number, column in enumerate(speeds.T, 1):
        if numpy.isfinite(column).any():
            chart.loglog(springs, column, color=f"C{number - 1}", label=f"critical speed {number}")
    chart.axhline(machine.speed, color="k", linestyle="-.", linewidth=1.0, label=f"the speed, {machine.speed:,.0f} rpm")
    chart.set(xlabel="stiffness of each bearing [N/m]", ylabel="undamped forward critical speed [rpm]", xlim=(springs[0], springs[-1]))
    chart.legend(fontsize=8)
    chart.grid(alpha=0.3, which="both")
    figure.suptitle(f"{case_name(path)}: undamped critical speeds", fontsize=11)
    return figure


DRAWN = {drawing.KIND: drawing.draw, "shapes": draw_shapes, "response": draw_response, "critical": draw_critical}
