"""Contacts of foils: where they are open, stick or slip, and how hard they push, on every contact line; pad borders and cuts of strips."""

import textwrap

import numpy
from matplotlib import colors, patches, pyplot

from gfb.plot.colours import around_zero, draw_bar
from gfb.tool import stop

MILLI = 1.0e3
SURFACES = {"top": "crest lines on the top foil or upper plate", "sleeve": "corner lines on the sleeve"}
STATES = ("open", "sticks", "slips")
STATE_COLOURS = ("0.85", "C0", "C1")
STATE_LOOK = {"cmap": colors.ListedColormap(STATE_COLOURS), "norm": colors.Normalize(-0.5, 2.5)}
MOST_BESIDE = 40   # contact lines of both surfaces that stand beside each other
NARROW = 22        # letters of a line below charts that stand beside each other
MOST_NUMBERED = 30 # contact lines of a map that all bear their number


def draw(path, file, rows, words, name, keys):
    """Maps of states, and of forces where the file has them, along the contact lines, at these rows of the history."""
    surfaces = [surface for surface in SURFACES if f"contact/{surface}/state" in file]
    if not surfaces:
        stop(f"{path}: no contacts in it")
    lines = {surface: line_table(file[f"contact/{surface}"]) for surface in surfaces}
    fields = ["state"] + ["normal_force"]*all(f"contact/{surface}/normal_force" in file for surface in surfaces)
    look = look_of_forces([file[f"contact/{surface}/normal_force"][row][lines[surface][2]] for surface in surfaces for row in rows]) \
        if len(fields) > 1 else None
    wide = [max(4, len(lines[surface][0])) for surface in surfaces]
    figure, axes = charts_of(len(rows), len(fields), wide)
    for place, row in enumerate(rows):
        for number, field in enumerate(fields):
            charts = axes[place, number]
            for chart, surface in zip(charts, surfaces):
                numbers, z, node = lines[surface]
                states = file[f"contact/{surface}/state"][row][node]
                if field == "state":
                    draw_columns(chart, numbers, z, states, STATE_LOOK)
                    chart.set_title(f"{words[place]}: {surface}", fontsize=9)
                else:
                    forces = 1.0e-3*file[f"contact/{surface}/{field}"][row][node]
                    draw_columns(chart, numbers, z, numpy.ma.masked_where(states == 0.0, forces), look)  # open
                    chart.set_title(f"{surface}: force [N/mm]", fontsize=9)
                draw_cuts(chart, z, keys)
                draw_pads(chart, file[f"contact/{surface}/position_x"][...][node[:, 0]]
                          if f"contact/{surface}/position_x" in file else numpy.arange(len(node)))
            if field != "state" and look is not None:
                draw_bar(figure, list(charts), **look, pad=0.01)
    stacked = sum(wide) > MOST_BESIDE
    for chart in axes.ravel():
        if chart.get_subplotspec().is_first_col():
            chart.set_ylabel("radius [mm]" if "history/axial_gap" in file else "z [mm]")
    for charts in axes[-1]:
        for chart, surface in zip(charts, surfaces):
            if stacked or chart.get_subplotspec().is_last_row():
                words = f"number along x of the {SURFACES[surface]}"
                chart.set_xlabel(words if stacked else textwrap.fill(words, NARROW), fontsize=9)
    marks = [patches.Patch(color=colour, label=word) for word, colour in zip(STATES, STATE_COLOURS)]
    if cuts_of(0.0, 1.0, keys):
        marks.append(patches.Patch(facecolor="w", edgecolor="k", label="cut between strips"))
    figure.legend(handles=marks, loc="upper right", ncols=len(marks), fontsize=8)
    figure.suptitle(f"{name}: contact states" + (" and forces" if look else ""), fontsize=11, x=0.01, ha="left")
    return figure


def look_of_forces(values):
    """Colours of forces per length [N/m], of all contacts alike; two-way contacts pull, too."""
    low, high = (1.0e-3*float(function([function(one) for one in values])) for function in (numpy.min, numpy.max))
    if low < 0.0:
        return around_zero(low, high)
    return {"cmap": "viridis", "norm": colors.Normalize(0.0, high or 1.0)}


def charts_of(rows, fields, wide):
    """A figure and its charts on (row, field, surface): all side by side, or surfaces, or everything below each other, as there is room."""
    many, size = rows*fields, sum(wide)
    if fields*size <= MOST_BESIDE:
        figure, axes = pyplot.subplots(rows, fields*len(wide), squeeze=False, layout="constrained", sharey=True, sharex="col",
                                       figsize=(max(6.5, 2.4 + 0.38*fields*size), 2.2*rows + 1.1), gridspec_kw={"width_ratios": fields*wide})
        return figure, axes.reshape(rows, fields, len(wide))
    if size > MOST_BESIDE:
        figure, axes = pyplot.subplots(many*len(wide), 1, squeeze=False, layout="constrained", figsize=(11.0, 2.2*many*len(wide) + 0.7),
                                       sharey=True)
        return figure, axes.reshape(rows, len(wide), fields).swapaxes(1, 2)
    figure, axes = pyplot.subplots(many, len(wide), squeeze=False, layout="constrained", sharey=True, sharex="col",
                                   figsize=(max(6.5, 2.4 + 0.38*sum(wide)), 2.2*many + 1.1), gridspec_kw={"width_ratios": wide})
    return figure, axes.reshape(rows, fields, len(wide))


def draw_columns(chart, numbers, z, values, look):
    """A column a contact line; grey where there is no value."""
    cmap = pyplot.get_cmap(look["cmap"]).with_extremes(bad=STATE_COLOURS[0])
    for i, column in enumerate(values):
        chart.pcolormesh([i + 0.6, i + 1.4], edges(MILLI*z), column[:, None], cmap=cmap, norm=look["norm"])
    places = numpy.arange(1, len(numbers) + 1)[::1 + len(numbers)//(MOST_NUMBERED + 1)]
    chart.set(xticks=places, xlim=(0.4, len(numbers) + 0.6))
    chart.set_xticklabels([numbers[place - 1] for place in places])


def cuts_of(low, high, keys):
    """Where the cuts between strips side by side begin and end, of a width from low to high [m]."""
    strips, cut = (float(keys.get(("bump_foil", key), (default,))[0]) for key, default in (("strips", "1"), ("cut_width", "0.0")))
    wide = (high - low - (strips - 1.0)*cut)/strips
    return [(low + strip*(wide + cut) - cut, low + strip*(wide + cut)) for strip in range(1, int(strips))]


def draw_cuts(chart, z, keys):
    """White bands where there is no foil."""
    for cut in cuts_of(z[0], z[-1], keys):
        low, high = (MILLI*end for end in cut)
        chart.axhspan(low, high, facecolor="w", edgecolor="k", linewidth=0.5, zorder=3)


def draw_pads(chart, along):
    """Lines between pads, and their numbers above: places along the motion begin anew with each."""
    begins = [0, *(int(line) + 1 for line in numpy.flatnonzero(numpy.diff(along) < 0.0)), len(along)]
    if len(begins) == 2:
        return
    for border in begins[1:-1]:
        chart.axvline(border + 0.5, color="k", linewidth=1.4)
    for pad, (first, last) in enumerate(zip(begins, begins[1:]), start=1):
        chart.text(0.5*(first + last + 1), 1.01, f"pad {pad}", transform=chart.get_xaxis_transform(), fontsize=8, ha="center", va="bottom")
    chart.set_title(chart.get_title(), fontsize=9, pad=16.0)


def line_table(group):
    """Numbers of the contact lines, z over the whole width [m], and the node of every line and z.

    Where half the width was solved, the other half is its mirror image. A line that is held has no contacts;
    its entries bear no number.
    """
    line = numpy.rint(group["line"][...]).astype(int)
    numbers = sorted(set(line) - {0})
    if not numbers:
        stop("no contact line bears a number")
    position = group["position_z"][...]
    nodes = []
    for number in numbers:
        own = numpy.flatnonzero(line == number)
        nodes.append(own[numpy.argsort(position[own])])
    if len({len(own) for own in nodes}) > 1:
        stop("contact lines of different lengths cannot be drawn")
    node = numpy.array(nodes)
    z = position[node[0]]
    if z[0] >= 0.0 and len(z) > 1 and "axial_gap" not in group.file.get("history", ()):
        z = numpy.concatenate((-z[:0:-1], z))
        node = numpy.concatenate((node[:, :0:-1], node), axis=1)
    return numbers, z, node


def edges(z):
    """Borders halfway between nodes."""
    middle = 0.5*(z[1:] + z[:-1])
    return numpy.concatenate((z[:1], middle, z[-1:]))
