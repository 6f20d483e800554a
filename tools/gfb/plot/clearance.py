"""How far a shaft's centre may go before it touches the pads at rest, where pads end and where bumps stand around it."""

import dataclasses
import math

import numpy

from gfb.plot.scene import leading_edges, number

MICRO = 1.0e6
TURN = 2.0*math.pi
DIRECTIONS = 1441  # of the limit that is drawn
OPEN = 1.5         # of the clearance: where nothing is nearer the limit is not drawn
LOAD = 0.4         # of the clearance: length of the load's arrow
SAME = 1.0e-9      # angles and lengths that differ less are one


@dataclasses.dataclass
class Bearing:
    """The pads of a case file's echo."""

    radius: float      # of the shaft [m]
    clearance: float   # at rest, less what the assembly takes [m]
    shift: float       # of each pad's centre towards the shaft [m]
    begins: tuple      # theta of the leading edges [rad]
    arc: float         # of a pad [rad]
    narrowest: tuple   # theta where the preload takes most of the gap [rad]
    bumps: int         # of a pad, 0 where not given
    ring: bool         # a full one, without edges
    bored: bool        # &bore is given, whose shape is not drawn

    def limit(self, angle):
        """Distance from the bearing's centre at which the shaft's touches, in these directions [m]; infinite where no pad is.

        A pad holds the centre back in a circle about its own; beyond the pad's ends it leans against an end.
        """
        nearest = numpy.full(numpy.shape(angle), numpy.inf)
        for begin, narrow in zip(self.begins, self.narrowest):
            off = self.shift*numpy.cos(angle - narrow)
            # The pad's centre is at -shift (cos narrow, sin narrow).
            far = -off + numpy.sqrt(self.clearance**2 - self.shift**2 + off**2)
            place = numpy.arctan2(far*numpy.sin(angle) + self.shift*math.sin(narrow), far*numpy.cos(angle) + self.shift*math.cos(narrow))
            on_pad = (place - begin + SAME) % TURN <= self.arc + 2.0*SAME
            nearest = numpy.where(on_pad, numpy.minimum(nearest, far), nearest)
            for end in (begin, begin + self.arc):
                across = numpy.cos(angle - end)
                gap = self.clearance - self.shift*math.cos(end - narrow)
                nearest = numpy.minimum(nearest, numpy.where(across > SAME, gap/numpy.maximum(across, SAME), numpy.inf))
        return nearest


    def thinnest(self, x, y):
        """theta where the shaft is nearest to the pads at rest [rad], its centre at (x, y) [m]."""
        angle = numpy.concatenate([begin + numpy.linspace(0.0, self.arc, DIRECTIONS) for begin in self.begins])
        narrow = numpy.repeat(self.narrowest, DIRECTIONS)
        gap = self.clearance - self.shift*numpy.cos(angle - narrow) - x*numpy.cos(angle) - y*numpy.sin(angle)
        return float(angle[numpy.argmin(gap)])


def bearing_of(keys):
    """The bearing of an echo; None where it has no clearance or no radius."""
    radius, clearance = number(keys, "bearing", "radius"), number(keys, "bearing", "clearance")
    if radius is None or clearance is None:
        return None
    begins = leading_edges(keys)
    arc = arc_of(keys, len(begins), begins[0])
    shift = (number(keys, "pads", "preload") or 0.0)*clearance
    offset = number(keys, "pads", "preload_offset")
    narrowest = tuple(begin + (0.5 if offset is None else offset)*arc for begin in begins)
    rest = clearance - (number(keys, "bearing", "assembly_interference") or 0.0)
    return Bearing(radius, rest, shift, begins, arc, narrowest, int(number(keys, "bump_foil", "bumps") or 0),
                   "periodic" in keys.get(("bearing", "leading_edge_condition"), ("",))[0],
                   any(group == "bore" for group, _ in keys))


def arc_of(keys, count, first):
    """Arc of a pad, given or by the gap between pads; without either a single one ends at 2 pi."""
    arc = number(keys, "pads", "arc")
    if arc is not None:
        return arc
    gap, default = keys.get(("pads", "gap"), ("0.0", True))
    return TURN - first if count == 1 and default else TURN/count - float(gap)


def crests_of(file, keys):
    """theta of the crests [rad], where the program itself has them: at the contacts; none where the model has no bumps."""
    bearing = bearing_of(keys)
    if bearing is None or not bearing.bumps or "contact/top/position_x" not in file:
        return numpy.empty(0)
    line = numpy.rint(file["contact/top/line"][...]).astype(int)
    place = file["contact/top/position_x"][...]
    bears = line > 0  # a line that is held has no contacts
    # Lines are counted on through all pads, those of a second bearing too; positions begin with each pad.
    pad = (line[bears] - 1)//bearing.bumps % len(bearing.begins)
    angle = numpy.array(bearing.begins)[pad] + place[bears]/bearing.radius
    return numpy.unique(numpy.round(angle/SAME).astype(int))*SAME


# --- in a picture ---

def draw_limit(chart, keys, crests):
    """The limit of the shaft's centre, the pads' edges and a mark at each crest; how far all this reaches [um], 0 where it is not known."""
    bearing = bearing_of(keys)
    if bearing is None or bearing.clearance <= bearing.shift:
        return 0.0
    angle = numpy.linspace(0.0, TURN, DIRECTIONS)
    limit = bearing.limit(angle)
    limit[limit > OPEN*bearing.clearance] = numpy.nan
    chart.plot(MICRO*limit*numpy.cos(angle), MICRO*limit*numpy.sin(angle), color="k", linewidth=1.0,
               label="clearance without &bore" if bearing.bored else "clearance")
    if not bearing.ring:
        edges = numpy.concatenate((bearing.begins, numpy.add(bearing.begins, bearing.arc)))
        mark(chart, bearing, edges, (0.95, 1.08), {"color": "C1", "linewidth": 1.2, "label": "pad edges"})
    if len(crests):
        mark(chart, bearing, crests, (1.0, 1.05), {"color": "0.4", "linewidth": 1.6, "label": "bumps"})
    return MICRO*float(numpy.nanmax(limit, initial=0.0))


def draw_load(chart, keys):
    """An arrow from the bearing's centre in the direction of the load of an echo."""
    bearing, load = bearing_of(keys), keys.get(("operation", "load"))
    both = numpy.array([float(word) for word in load[0].split(",")]) if load else numpy.zeros(2)
    if bearing is None or len(both) != 2 or not numpy.hypot(*both) > 0.0:
        return
    tip = LOAD*MICRO*bearing.clearance*both/numpy.hypot(*both)
    chart.annotate("", tip, (0.0, 0.0), arrowprops={"arrowstyle": "-|>", "color": "C5", "linewidth": 1.6, "shrinkA": 0.0, "shrinkB": 0.0})
    chart.plot([], [], color="C5", linewidth=1.6, marker=">", markersize=5, label="load on the shaft")


def mark(chart, bearing, angle, reach, look):
    """Short lines across the limit, in directions seen from the bearing's centre."""
    far = MICRO*numpy.minimum(bearing.limit(angle), OPEN*bearing.clearance)
    lines = chart.plot(*(numpy.array(reach)[:, None]*far*along for along in (numpy.cos(angle), numpy.sin(angle))), **look)
    for line in lines[1:]:
        line.set_label(None)
