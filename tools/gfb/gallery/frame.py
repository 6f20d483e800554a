"""Picture of the frame and its signs, for docs/manual/frame.md."""

import numpy
from matplotlib import patches, pyplot

E = numpy.array([0.94, 0.22])  # e/C of the picture, as in [Gu2020]
FILM, SHAFT = 0.3, 1.0         # drawn clearance and radius
PITCHES = 26
TILT = 0.09                    # drawn tilt [rad]
ARROW = {"arrowstyle": "-|>", "shrinkA": 0.0, "shrinkB": 0.0}


def draw_frame(_runs, folder):
    """Cross-section, unrolled pad, section of the foils, tilts."""
    figure = pyplot.figure(figsize=(12.0, 9.2), layout="constrained")
    grid = figure.add_gridspec(3, 2, width_ratios=(1.25, 1.0), height_ratios=(1.15, 1.0, 1.0))
    draw_section(figure.add_subplot(grid[:2, 0]))
    draw_unrolled(figure.add_subplot(grid[0, 1]))
    draw_foils(figure.add_subplot(grid[2, 0]))
    draw_tilt(figure.add_subplot(grid[1, 1]), "y", "x", -1.0)
    draw_tilt(figure.add_subplot(grid[2, 1]), "x", "y", 1.0)
    path = folder/"frame.png"
    figure.savefig(path, dpi=100)
    pyplot.close(figure)
    return path


def arrow(chart, start, end, words="", colour="k", place=None, width=1.5, **text):
    """An arrow with words at its end or at a place."""
    chart.annotate("", end, start, arrowprops={**ARROW, "color": colour, "linewidth": width})
    if words:
        chart.text(*(end if place is None else place), words, color=colour, **text)


def arc(chart, centre, radius, first, last, words="", colour="k", **text):
    """A curved arrow between two angles [deg], with words in its middle."""
    angle = numpy.radians(numpy.linspace(first, last, 60))
    x, y = centre[0] + radius*numpy.cos(angle), centre[1] + radius*numpy.sin(angle)
    chart.plot(x[:-2], y[:-2], color=colour, linewidth=1.2)
    chart.annotate("", (x[-1], y[-1]), (x[-4], y[-4]), arrowprops={**ARROW, "color": colour})
    middle = len(angle)//2
    far = 1.0 + 0.1/radius
    chart.text(centre[0] + far*(x[middle] - centre[0]), centre[1] + far*(y[middle] - centre[1]), words, color=colour,
               **text)


def bare(chart, title):
    """No axes, equal scales, a title."""
    chart.set_aspect("equal")
    chart.axis("off")
    chart.set_title(title, fontsize=10)


def draw_section(chart):
    """The bearing seen against z: e, load, attitude angle, theta, rotation."""
    shaft = -FILM*E
    chart.add_patch(patches.Circle((0.0, 0.0), SHAFT + FILM + 0.16, facecolor="0.85", edgecolor="0.4"))
    chart.add_patch(patches.Circle((0.0, 0.0), SHAFT + FILM, facecolor="white", edgecolor="C0", linewidth=2.0))
    chart.add_patch(patches.Circle(shaft, SHAFT, facecolor="0.95", edgecolor="k"))
    edge = SHAFT + FILM
    chart.plot([edge - 0.03, edge + 0.16], [0.0, 0.0], color="k", linewidth=3.0)
    chart.text(edge + 0.2, 0.05, "leading edge,\ntheta = theta_0 = 0", fontsize=8)
    chart.text(edge + 0.2, -0.06, "trailing edge,\ntheta = 2 pi", fontsize=8, va="top")
    arrow(chart, (0.0, 0.0), (2.2, 0.0), "x", place=(2.23, -0.03), width=0.9)
    arrow(chart, (0.0, 0.0), (0.0, 1.75), "y", place=(0.04, 1.72), width=0.9)
    chart.text(0.06, 1.56, "(z towards the viewer)", fontsize=8)
    direction = -E/numpy.hypot(*E)
    thin = edge*direction
    chart.plot(*zip((0.0, 0.0), thin), color="C3", linestyle=":", linewidth=1.0)
    chart.annotate("thinnest film,\nnear the direction of -e", thin, (-2.15, -1.25), fontsize=9, color="C3",
                   arrowprops={"arrowstyle": "-", "color": "C3", "linewidth": 0.8})
    arrow(chart, shaft, (0.0, 0.0), "e: from the shaft's centre\nto the sleeve's", "C3", (-0.15, -0.5), 2.0, fontsize=9)
    chart.plot(*shaft, "ko", markersize=3)
    chart.plot(0.0, 0.0, "o", color="C0", markersize=3)
    arrow(chart, shaft, shaft + (-0.85, 0.0), "load = (-W, 0),\non the shaft", "C2", (-1.2, 0.08), 2.0, fontsize=9)
    angle = numpy.degrees(numpy.arctan2(-direction[1], -direction[0]))
    arc(chart, (0.0, 0.0), 1.72, 180.0, 180.0 + angle, "", "C1")
    chart.plot([0.0, -1.8], [0.0, 0.0], color="C1", linewidth=0.8, linestyle="--")
    chart.text(-2.15, -0.55, "attitude\nangle > 0", color="C1", fontsize=9)
    chart.plot(*zip(thin, 1.78*direction), color="C1", linewidth=0.8, linestyle="--")
    arc(chart, (0.0, 0.0), 0.48, 0.0, 62.0, "theta", fontsize=9)
    arc(chart, shaft, 0.8, 65.0, 150.0, "", "C4")
    chart.text(-0.5, 0.62, "Omega: the shaft\nturns in +theta", color="C4", fontsize=9, va="top", ha="center")
    chart.text(0.75, -1.05, "top foil", color="C0", fontsize=9, rotation=50.0, ha="center")
    chart.text(0.0, -1.41, "sleeve with bumps", fontsize=9, ha="center")
    chart.set(xlim=(-2.25, 2.35), ylim=(-1.6, 1.85))
    bare(chart, "(a) cross-section, film drawn too thick; e/C = (0.94, 0.22)")


def draw_unrolled(chart):
    """The pad, unrolled."""
    long, wide = 2.0*numpy.pi, 2.0
    chart.add_patch(patches.Rectangle((0.0, -wide/2.0), long, wide, facecolor="C0", alpha=0.12, edgecolor="C0"))
    crests = long*(1.0 - (numpy.arange(PITCHES, 0, -1) - 0.5)*26.0*4.572/119.69/PITCHES)
    chart.vlines(crests, -wide/2.0, wide/2.0, color="0.6", linewidth=0.7)
    for number in (1, PITCHES):
        chart.text(crests[number - 1], wide/2.0 + 0.08, f"bump {number}", fontsize=8, ha="center")
    arrow(chart, (0.0, -1.5), (2.2, -1.5), "x = R (theta - theta_0): the surface of the shaft moves this way", "C4",
          (0.0, -2.0), fontsize=9)
    arrow(chart, (-0.3, -1.0), (-0.3, 1.3), "z", place=(-0.42, 1.38))
    chart.plot([0.0, long], [0.0, 0.0], color="k", linewidth=0.7, linestyle="-.")
    chart.text(long/2.0, 0.06, "midplane, z = 0", fontsize=8, ha="center", backgroundcolor="white")
    chart.text(long + 0.1, 0.0, "trailing\nedge", fontsize=8, va="center")
    chart.text(-0.45, -0.6, "leading\nedge", fontsize=8, va="center", ha="right")
    chart.set(xlim=(-1.4, long + 1.0), ylim=(-2.2, 1.7))
    bare(chart, "(b) unrolled, seen from outside; p = p_a on all four edges")


def draw_foils(chart):
    """A piece of sleeve, bumps, top foil and shaft."""
    x = numpy.linspace(0.0, 6.0, 400)
    height = numpy.clip(1.0 - ((x % 2.0 - 1.0)/0.75)**2, 0.0, None)*0.7
    sag = 0.85 - 0.16*(1.0 - numpy.cos(numpy.pi*(x - 1.0)))/2.0
    shaft = 1.55 - 0.05*x
    chart.fill_between(x, -0.3, 0.0, color="0.85")
    chart.plot(x, height + 0.06, color="0.35", linewidth=2.0)
    chart.plot(x, sag, color="C0", linewidth=2.0)
    chart.plot(x, 0.85 + 0.0*x, color="C0", linewidth=0.8, linestyle=":")
    chart.fill_between(x, shaft, 2.0, color="0.93")
    chart.plot(x, shaft, color="k", linewidth=1.2)
    chart.text(0.1, -0.22, "sleeve (rigid)", fontsize=8)
    chart.text(0.1, 1.72, "shaft", fontsize=8)
    arrow(chart, (4.7, 1.75), (5.9, 1.75), "motion, +x", "C4", (4.75, 1.82), fontsize=9)
    arrow(chart, (2.0, 0.85), (2.0, 0.69), "h_f > 0: deflection\ntowards the sleeve", "C0", (2.1, 0.93), fontsize=8)
    arrow(chart, (4.0, 1.36), (4.0, 0.70), "", "C3")
    arrow(chart, (4.0, 0.70), (4.0, 1.36), "gap h", "C3", (4.08, 1.0), fontsize=9)
    arrow(chart, (6.25, 0.0), (6.25, 0.75), "v, lift > 0:\ntowards\nthe shaft", place=(6.35, 0.3), fontsize=8)
    chart.set(xlim=(-0.1, 7.4), ylim=(-0.35, 2.05))
    bare(chart, "(c) foils, seen against z; dotted: top foil at rest")


def draw_tilt(chart, about, across, turn):
    """The shaft in the sleeve, seen along y or x; turn: of its right end, +1 up for a positive tilt."""
    half, bore, radius = 1.6, 0.75, 0.52
    for side in (-1.0, 1.0):
        below = side*bore - (0.18 if side < 0.0 else 0.0)
        chart.add_patch(patches.Rectangle((-half, below), 2.0*half, 0.18, facecolor="0.85", edgecolor="0.4"))
    z = numpy.array([-half - 0.35, half + 0.35])
    rise = turn*TILT*z
    chart.fill_between(z, rise - radius, rise + radius, color="0.93")
    for side in (-1.0, 1.0):
        chart.plot(z, rise + side*radius, color="k", linewidth=1.2)
    chart.plot(z, rise, color="k", linewidth=0.8, linestyle="-.")
    arrow(chart, (-half - 0.6, 0.0), (half + 0.75, 0.0), "z", "0.4", (half + 0.8, -0.05), 0.9)
    arrow(chart, (0.0, 0.0), (0.0, 1.35), across, "0.4", (0.06, 1.25), 0.9)
    arc(chart, (0.0, 0.0), 1.15, 0.0, turn*12.0, "", "C1")
    chart.text(1.02, turn*0.36 - 0.06, f"phi_{about} > 0", color="C1", fontsize=9, ha="right")
    wide = "grows" if turn < 0.0 else "shrinks"
    term = "+ z phi_y" if about == "y" else "- z phi_x"
    theta = "0" if about == "y" else "90 degrees"
    chart.text(half + 0.45, 0.78, f"at theta = {theta} the\ngap {wide} with z:\ne_{across} {term}", fontsize=8,
               va="center")
    chart.text(-half - 0.3, bore + 0.09, "sleeve", fontsize=8, ha="right", va="center")
    chart.text(-half - 0.42, -turn*TILT*half - 0.35, "shaft", fontsize=8, ha="right", va="center")
    view = "x up, y towards the viewer" if about == "y" else "y up, x away from the viewer"
    chart.set(xlim=(-2.7, 3.6), ylim=(-1.05, 1.5))
    bare(chart, f"({'d' if about == 'y' else 'e'}) tilt about {about}: z to the right, {view}")
