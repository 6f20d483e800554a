"""A machine to scale: its shaft with discs, loads and bearings, the static line in their clearances, moments and stress along it."""

import dataclasses
import math

import numpy
from matplotlib import patches, pyplot

from gfb.case import Case
from gfb.plot.clearance import DIRECTIONS, OPEN, bearing_of
from gfb.plot.scene import case_name
from gfb.results import text_of
from gfb.tool import stop

KIND = "machine"
MILLI, MICRO, MEGA = 1.0e3, 1.0e6, 1.0e-6
STEEL = 7800.0        # [kg/m3], of which discs are drawn where the case does not say how large they are
LARGEST = 0.5         # radius of a disc over the shaft's length, at most
PLATE = 0.02          # thickness of a thrust bearing's plate over the shaft's length, as drawn
SLEEVE = 0.35         # thickness of a sleeve over the radius in it
LINE = 0.55           # of the largest radius: height to which the static line is drawn larger
ARROW = 0.9           # length of a load's arrow over the largest radius
MOST_LOADS = 50
PARTS = 8             # of an element, as drawn


@dataclasses.dataclass
class Disc:
    """A rigid disc."""

    position: float  # [m]
    mass: float      # [kg]
    radius: float    # as drawn [m]
    width: float     # the same [m]


@dataclasses.dataclass
class Machine:
    """What a case file's results say of a machine."""

    case: Case
    z: numpy.ndarray         # of the nodes [m]
    line: numpy.ndarray      # (node, x y theta_x theta_y) of the static line [m], [rad]; empty without an answer
    sections: numpy.ndarray  # (end of an element, z, diameter, moments, shears, stress) [SI]
    bearings: numpy.ndarray  # (bearing, z, length, radius, clearance) [m]
    discs: list
    thrust: list             # of each bearing: to which side a thrust bearing's pads face, 0 of a journal's
    places: list             # (words, z) of bearings, discs and stations, in the order of the results
    speed: float             # [rpm]
    pads: list               # Bearing of each whose pads have a preload, else None

    @property
    def length(self):
        """From the shaft's first end to its last [m]."""
        return self.z[-1] - self.z[0]

    @property
    def thickest(self):
        """The largest radius of shaft, discs and sleeves [m]."""
        return max([0.5*self.sections[:, 1].max(), *(disc.radius for disc in self.discs),
                    *(radius*(1.0 if side else 1.0 + SLEEVE) for radius, side in zip(self.bearings[:, 2], self.thrust))])

    def offset(self, axis):
        """How far each sleeve stands off the line [m]."""
        return values_of(self.case, f"bearings%offset_{axis}", len(self.bearings))


    def reach(self, number):
        """How far the axis may go in the n-th sleeve before the journal touches its pads at rest, all around it [m]: (direction, x y)."""
        angle = numpy.linspace(0.0, 2.0*math.pi, DIRECTIONS)
        clearance, pads = self.bearings[number - 1, 3], self.pads[number - 1]
        far = numpy.full(DIRECTIONS, clearance)
        if pads is not None:
            far = pads.limit(angle)
            far[far > OPEN*clearance] = numpy.nan
        return numpy.column_stack((far*numpy.cos(angle), far*numpy.sin(angle)))

    def room(self, number):
        """The same along -x and x alone, at most the clearance [m]."""
        clearance, pads = self.bearings[number - 1, 3], self.pads[number - 1]
        return numpy.full(2, clearance) if pads is None else numpy.minimum(pads.limit(numpy.array((math.pi, 0.0))), clearance)


def is_machine(file):
    """Whether a case file is of a machine with an answer."""
    return "shaft/line" in file


def read(path, file):
    """The machine of an open case file."""
    if not is_machine(file):
        stop(f"{path}: no shaft is in it; machines have &shaft")
    case = Case.parse(text_of(file["scene/used"][()]))
    bearings, line = file["shaft/bearings"][:, :4], file["shaft/line"][...]
    discs = discs_of(case)
    places = [(f"bearing {number}", row[0]) for number, row in enumerate(bearings, 1)]
    places += [(f"disc {number}" if len(discs) > 1 else "disc", disc.position) for number, disc in enumerate(discs, 1)]
    places += [(f"{MILLI*float(z):.4g} mm", float(z)) for z in listed(case, "machine%stations")]
    speed = float(file["history/speed_rpm"][-1]) if "history/speed_rpm" in file else float(case["machine%speed_rpm"])
    facing = values_of(case, "bearings%facing", len(bearings), 1.0)
    thrust = [float(facing[number - 1])*(f"force_z_{number}" in file["summary"]) for number in range(1, len(bearings) + 1)]
    return Machine(case, line[:, 0], line[:, 1:], file["shaft/sections"][...], bearings, discs, thrust, places, speed,
                   [pads_of(file, number) for number in range(1, len(bearings) + 1)])


def pads_of(file, number):
    """The pads of the n-th bearing's own file where they have a preload, so that its clearance is not how far the shaft may go; else None."""
    if f"scene/bearing_{number}" not in file:
        return None
    groups = Case.parse(text_of(file[f"scene/bearing_{number}"][()])).groups
    keys = {(group, key): (str(value), False) for group, values in groups.items() for key, value in values.items()}
    found = bearing_of(keys)
    return found if found is not None and 0.0 < found.shift < found.clearance else None


def draw_reach(chart, machine, number, middle):
    """How far the axis may go in a sleeve, about the sleeve's middle; the largest distance [um]."""
    line = MICRO*machine.reach(number)
    chart.plot(middle[0] + line[:, 0], middle[1] + line[:, 1], color="0.4", linewidth=1.2, label="clearance at rest")
    return float(numpy.nanmax(numpy.hypot(*line.T)))


def listed(case, name):
    """The values of a key that may be missing, or have several."""
    return case.listed(name) if name in case else ()


def values_of(case, name, count, default=0.0):
    """A number for each of several, where one may stand for all."""
    values = listed(case, name) or (default,)
    return numpy.full(count, float(values[0])) if len(values) == 1 else numpy.array(values, dtype=float)


def discs_of(case):
    """The discs: as large as steel with their mass and polar inertia, where they have one."""
    positions = listed(case, "discs%positions")
    count = len(positions)
    masses, polar = (values_of(case, f"discs%{name}", count) for name in ("masses", "polar_inertias"))
    whole = sum(values_of(case, "shaft%lengths", len(listed(case, "shaft%lengths"))))
    found = []
    for z, mass, inertia in zip(positions, masses, polar):
        radius = math.sqrt(2.0*inertia/mass) if inertia > 0.0 else (mass/(STEEL*math.pi))**(1.0/3.0)
        radius = min(radius, LARGEST*whole)
        found.append(Disc(float(z), mass, radius, min(mass/(STEEL*math.pi*radius**2), 0.5*radius)))
    return found


def title(path, machine):
    """The case's name, and what machine it is."""
    return f"{case_name(path)}: shaft in {len(machine.bearings)} bearing{'s'*(len(machine.bearings) != 1)}, {machine.speed:,.0f} rpm"


# --- the picture ---

def draw(path, file):
    """The machine, its line in the clearances, and moments along it."""
    machine = read(path, file)
    figure, charts = pyplot.subplots(3, 1, figsize=(9.0, 9.6), sharex=True, layout="constrained", height_ratios=(1.3, 1.0, 1.0))
    draw_machine(charts[0], machine)
    draw_line(charts[1], machine)
    draw_moments(charts[2], machine)
    charts[2].set_xlabel("z [mm], from the shaft's first end")
    charts[2].set_xlim(MILLI*(machine.z[0] - 0.04*machine.length), MILLI*(machine.z[-1] + 0.04*machine.length))
    figure.suptitle(title(path, machine), fontsize=11)
    return figure


def draw_machine(chart, machine):
    """Segments, discs, sleeves and loads to scale, and the static line larger."""
    lengths = values_of(machine.case, "shaft%lengths", len(listed(machine.case, "shaft%lengths")))
    outer, inner = (values_of(machine.case, f"shaft%{name}_diameters", len(lengths)) for name in ("outer", "inner"))
    first = 0.0
    for length, thick, bore in zip(lengths, outer, inner):
        box(chart, first, first + length, -0.5*thick, 0.5*thick, facecolor="0.85", edgecolor="0.3", linewidth=0.8)
        if bore > 0.0:
            box(chart, first, first + length, -0.5*bore, 0.5*bore, facecolor="w", edgecolor="0.5", linewidth=0.6, linestyle="--")
        first += length
    for disc in machine.discs:
        box(chart, disc.position - 0.5*disc.width, disc.position + 0.5*disc.width, -disc.radius, disc.radius, facecolor="0.7",
            edgecolor="0.3", linewidth=0.8)
        chart.annotate(f"{disc.mass:.3g} kg", (MILLI*disc.position, MILLI*disc.radius), (0, 3), textcoords="offset points", ha="center", fontsize=8)
    for number, (z, length, radius, _) in enumerate(machine.bearings, 1):
        faces = machine.thrust[number - 1]
        ends = (z - faces*PLATE*machine.length, z) if faces else (z - 0.5*length, z + 0.5*length)
        low, high = (radius - length, radius) if faces else (radius, (1.0 + SLEEVE)*radius)  # of sectors the length is along their radius
        for side in (1.0, -1.0):
            box(chart, min(ends), max(ends), side*low, side*high, facecolor="C0", alpha=0.35, edgecolor="C0", hatch="///")
        chart.annotate(f"bearing {number}", (MILLI*sum(ends)/2.0, MILLI*(-high if faces else high)), (0, -11 if faces else 3), textcoords="offset points", ha="center", fontsize=8)
    draw_loads(chart, machine)
    chart.plot(MILLI*machine.z[[0, -1]], (0.0, 0.0), "k-.", linewidth=0.6)
    if len(machine.line):
        draw_larger_line(chart, machine)
    chart.set_aspect("equal", adjustable="datalim")
    high = 1.25*MILLI*machine.thickest  # at least: limits that are fixed Matplotlib would warn of where the scale needs more
    chart.update_datalim([(0.0, -high), (0.0, high)], updatex=False)
    chart.margins(y=0.0)
    chart.set(ylabel="[mm]")
    chart.set_title("to scale; discs as large as steel with their mass and inertia", fontsize=9)


def box(chart, left, right, low, high, **look):
    """A rectangle [m]."""
    chart.add_patch(patches.Rectangle((MILLI*left, MILLI*min(low, high)), MILLI*(right - left), MILLI*abs(high - low), **look))


def draw_loads(chart, machine):
    """Forces along x, which points up."""
    positions = listed(machine.case, "loads%positions")[:MOST_LOADS]
    forces = values_of(machine.case, "loads%forces_x", len(positions))
    for z, force in zip(positions, forces):
        if abs(force) > 0.0:
            tip = math.copysign(MILLI*ARROW*machine.thickest, force)
            chart.annotate("", (MILLI*z, 0.0), (MILLI*z, -tip), arrowprops={"arrowstyle": "->", "color": "C3"})
            chart.annotate(f"{force:.3g} N", (MILLI*z, -tip), (3, 0), textcoords="offset points", color="C3", fontsize=8)


def draw_larger_line(chart, machine):
    """The static line, so many times larger that it is seen."""
    most = numpy.abs(machine.line[:, :2]).max()
    if not most > 0.0:
        return
    factor = round_down(LINE*machine.thickest/most)
    for column, (axis, style) in enumerate((("x", "-"), ("y", "--"))):
        chart.plot(*smooth(machine, MILLI*factor*machine.line, column), style, color="C3", linewidth=1.3, label=f"{axis}, {factor:g} times larger")
    chart.legend(fontsize=8, loc="lower left", ncols=2)


def smooth(machine, motions, column):
    """z [mm] and the axis along x or y between the nodes, too: a cubic with the slopes of the sections, which shear adds next to nothing to."""
    value, slope = motions[:, column], motions[:, 3] if column == 0 else -motions[:, 2]
    share = numpy.linspace(0.0, 1.0, PARTS, endpoint=False)
    length = numpy.diff(machine.z)[:, None]
    between = value[:-1, None]*(1.0 - 3.0*share**2 + 2.0*share**3) + value[1:, None]*(3.0*share**2 - 2.0*share**3) \
        + length*(slope[:-1, None]*(share - 2.0*share**2 + share**3) + slope[1:, None]*(share**3 - share**2))
    z = machine.z[:-1, None] + length*share
    return MILLI*numpy.append(z, machine.z[-1]), numpy.append(between, value[-1])


def round_down(value):
    """1, 2 or 5 times a power of ten, at most a value."""
    power = 10.0**math.floor(math.log10(value))
    return next(one*power for one in (5.0, 2.0, 1.0) if one*power <= value*(1.0 + 1.0e-9))


def draw_line(chart, machine):
    """Where the shaft's axis is, and how far it goes along x in each sleeve before it touches what is at rest."""
    if len(machine.line):
        for column, (axis, style) in enumerate((("x", "-"), ("y", "--"))):
            chart.plot(*smooth(machine, MICRO*machine.line, column), style, color="C3", linewidth=1.4, label=f"axis along {axis}")
    for number, (z, length, *_) in enumerate(machine.bearings):
        if machine.thrust[number]:
            continue
        middle, (low, high) = machine.offset("x")[number], machine.room(number + 1)
        chart.fill_between(MILLI*numpy.array((z - 0.5*length, z + 0.5*length)), MICRO*(middle - low), MICRO*(middle + high),
                           color="C0", alpha=0.18, linewidth=0.0, label=None if number else "sleeve's middle, and the clearance along x at rest")
        chart.plot(MILLI*numpy.array((z - 0.5*length, z + 0.5*length)), 2*[MICRO*middle], color="C0", linewidth=0.8)
    for disc in machine.discs:
        chart.axvline(MILLI*disc.position, color="0.6", linewidth=0.8, linestyle=":")
    chart.set_ylabel("static line [um]")
    chart.legend(fontsize=8, loc="best")
    chart.grid(alpha=0.3)


def draw_moments(chart, machine):
    """Bending moment and stress of the outer fibre."""
    rows = machine.sections
    chart.plot(MILLI*rows[:, 0], numpy.hypot(rows[:, 2], rows[:, 3]), color="C0", label="bending moment")
    chart.plot(MILLI*rows[:, 0], numpy.hypot(rows[:, 4], rows[:, 5])*0.1*machine.length, color="C2", linewidth=0.9, linestyle="--",
               label="shear force times a tenth of the length")
    chart.set(ylabel="[N m]", ylim=(0.0, None))
    right = chart.twinx()
    right.plot(MILLI*rows[:, 0], MEGA*rows[:, 6], color="C1", linewidth=1.2)
    right.set_ylim(0.0, None)
    right.set_ylabel("stress of the outer fibre [MPa]", color="C1")
    right.tick_params(colors="C1")
    chart.legend(fontsize=8, loc="best")
    chart.grid(alpha=0.3)
