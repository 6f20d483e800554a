"""The bearing of a case to scale, as lines of an SVG picture: pads, bore, foils, ramps, load; gap and bumps drawn larger, by round numbers that
stand below. tools/studio has it beside the form; on pages of results it has the shaft's centre and the thinnest film, too."""

import itertools
import math

from gfb.report.answer import THINNEST, Results, direction, is_number
from gfb.report.grooves import groove_lines, groove_words, shown_parts
from gfb.report.sketch_lines import ROOM, SIDE, TURN, Drawing, arc_of, circle, line, place

SHAFT, RING, BAND = 64.0, 85.0, 5.0  # radius of a shaft, outer radius of sectors, thickness of a sleeve
# What is drawn larger: by how many times, unless it comes out lower or higher than these two.
GAP, BUMP, STEP = (100.0, 2.0, 14.0), (3.0, 2.0, 6.0), (200.0, 3.0, 16.0)  # clearance, bumps, ramps
FARTHEST = 24.0    # of a surface from the shaft
LAND, RUNNER = 104.0, 8.0  # of a pad that is cut: height of its land, and of the gap over it
WIDE = 200.0       # of the view along the axis; to its right stands the one from the side
MOST_PADS = 1000   # that are drawn: more are none of gfb
MOST_BUMPS = 2000  # of all pads together
MOST_HOLES = 1000  # of all rows together
HOLE = 1.6         # radius of an orifice in a picture


def factor_of(size, usual, low, high):
    """How many times larger a size is drawn: as usual, or else by 1, 2, 5, 10, ... times to be not above the middle; 1 at least."""
    if low <= size*usual <= high:
        return usual
    most = 0.5*(low + high)/max(size, 1.0e-12)
    power = 10.0**math.floor(math.log10(max(most, 1.0)))
    return next(one*power for one in (5.0, 2.0, 1.0) if one*power <= max(most, 1.0))


class Bearing:
    """What of a case can be drawn; ValueError where its numbers give no bearing."""

    def __init__(self, case):
        self.case, self.results = case, Results({}, case)
        self.is_ring = case.get("bearing%kind") == "thrust"
        self.foil = case.get("model%foil")
        self.radius = self.size("bearing%outer_radius" if self.is_ring else "bearing%radius")
        if self.radius is None:
            raise ValueError("no radius")
        count = self.number("pads%count", 1)
        self.first = self.number("pads%first_leading_edge", self.number("bearing%leading_edge_angle", 0.0))
        if not 1 <= count <= MOST_PADS:
            raise ValueError("no count of pads")
        self.count = int(count)
        self.arc = self.number("pads%arc", TURN/self.count - self.number("pads%gap", 0.0) - (self.first if self.count == 1 else 0.0))
        if not 0.0 < self.arc <= TURN*(1.0 + 1.0e-6) or abs(self.first) > TURN:
            raise ValueError("no arc of a pad")
        self.begins = [self.first + TURN*pad/self.count for pad in range(self.count)]

    def number(self, name, default=None):
        """A number of the case; ValueError where what stands there is none."""
        value = self.case.get(name)
        if value is not None and not is_number(value):
            raise ValueError(f"{name}: no number")
        return default if value is None else float(value)

    def size(self, name):
        """The same of what is above zero; None where it is not given."""
        value = self.number(name)
        if value is not None and not 0.0 < value < 1.0e6:
            raise ValueError(f"{name}: not above zero")
        return value

    def listed(self, name):
        """Numbers of a list."""
        if name not in self.case:
            return []
        values = self.case.listed(name)
        if len(values) > MOST_BUMPS or not all(map(is_number, values)):
            raise ValueError(f"{name}: no list of numbers")
        return [float(one) for one in values]

    def crests(self, radius):
        """Angles of the crests of a pad from its leading edge on, as the program has them, and half of a bump's chord; none where the case
        has no bumps."""
        pitch, half = self.size("bump_foil%pitch"), self.size("bump_foil%half_length")
        bumps, given = self.size("bump_foil%bumps"), self.listed("bump_foil%crest_angles")
        ramp = self.number("ramp%part", 0.0) if self.is_ring else 0.0
        room = self.arc*(1.0 - ramp)*radius
        if given or "bump_foil" not in self.case.groups or self.foil == "rigid":
            return given, half or 0.0
        pitches = self.listed("bump_foil%bump_pitch")
        if pitch is None and not pitches:
            if not bumps:
                return [], 0.0
            pitch = room/bumps
        begin = self.number("bump_foil%strip_offset", 0.0) if is_number(self.case.get("bump_foil%strip_offset", 0.0)) else 0.0
        if pitches:
            pitches = pitches*int(min(bumps or 1, MOST_BUMPS)) if len(pitches) == 1 else pitches
            places = [0.0, *itertools.accumulate(pitches[:-1])]
        else:
            bumps = min(bumps or room//pitch, MOST_BUMPS)
            places = [pitch*i for i in range(int(bumps))]
        first = begin + (half if half is not None else 0.5*(pitch or pitches[0]))
        found = [(first + one)/radius for one in places]
        if not self.is_ring and self.case.get("bump_foil%fixed_edge", "trailing") == "trailing":
            found = [self.arc - one for one in reversed(found)]
        return [ramp*self.arc + one for one in found if -0.01 <= one <= self.arc + 0.01], half or 0.25*(pitch or pitches[0])

    def holes(self):
        """{number: (theta, z or radius)} of the orifices on pads, counted row by row as the program does; none where a wall feeds, or nothing."""
        rows, listed = self.listed("feed%row_positions"), self.listed("feed%orifice_angles")
        count = len(listed) or int(self.size("feed%orifices") or 0)
        if self.case.get("feed%kind") != "orifices" or not 0 < count*len(rows) <= MOST_HOLES:
            return {}
        pitch, shift = (self.arc if self.is_ring else TURN)/count, self.number("feed%row_shift", 0.0)
        first = self.number("feed%first_orifice_angle", 0.5*pitch)
        found: dict[int, tuple[float, float]] = {}
        for row, along in enumerate(rows):
            for i in range(count):
                angle, number = (listed[i] if listed else first + pitch*i) + shift*row, row*count + i + 1
                if self.is_ring:  # each sector has its own
                    found |= {pad*count*len(rows) + number: (begin + angle, along) for pad, begin in enumerate(self.begins)}
                elif any((angle - begin) % TURN <= self.arc for begin in self.begins):  # none between pads
                    found[number] = (angle % TURN, along)
        return dict(sorted(found.items()))

    def supply_words(self):
        """What feeds the film, in words; empty where nothing does."""
        kind, pressure = self.case.get("feed%kind"), self.size("feed%supply_pressure")
        if kind not in ("orifices", "porous") or pressure is None:
            return ""
        size = self.size("feed%orifice_diameter" if kind == "orifices" else "feed%wall_thickness")
        what = f"{len(self.holes())} orifices" if kind == "orifices" else "porous wall"
        return f"{what}{f' of {1.0e3*size:.3g} mm' if size else ''}, {1.0e-5*pressure:.4g} bar absolute"

    def bore(self, angle):
        """What a bore takes off the gap [m]."""
        height = 0.0
        waves, amplitude = self.number("bore%waves", 0.0), self.number("bore%wave_amplitude", 0.0)
        if waves and amplitude:
            height += amplitude*math.cos(waves*(angle - self.number("bore%wave_angle", 0.0)))
        shims = self.listed("bore%shim_angle")
        for middle, (top, plateau, ramp) in zip(shims, zip(*(one*len(shims) if len(one) == 1 else one for one in map(
                self.listed, ("bore%shim_height", "bore%shim_arc", "bore%shim_ramp"))))):
            off = abs(math.remainder(angle - middle, TURN)) - 0.5*plateau
            height += top*min(1.0, max(0.0, 1.0 - off/ramp if ramp > 0.0 else float(off <= 0.0)))
        angles, heights = self.listed("bore%profile_angle"), self.listed("bore%profile_height")
        if len(angles) == len(heights) > 1:
            ends = [*zip(angles, heights), (angles[0] + TURN, heights[0])]
            here = angles[0] + (angle - angles[0]) % TURN
            for (one, low), (other, high) in itertools.pairwise(ends):
                if one <= here <= other and other > one:
                    height += low + (high - low)*(here - one)/(other - one)
                    break
        return height


# --- what is drawn ---

def case_sketch(case):
    """The picture of a case with its views along the axis and from the side; None where its numbers give no bearing and no strip."""
    try:
        drawing = draw_bearing(Bearing(case), True) if "bearing" in case.groups and case.get("scene%analysis") != "strip" else draw_strip(case)
    except (ValueError, OverflowError):
        return None
    return drawing.picture(SIDE + ROOM) | {"words": "the case to scale"}


def sketch(summary, case, thinnest=None):
    """The picture of a result: its bearing with the way of the shaft's centre, and with its thinnest film where its place is known; None
    where there is no film."""
    results = Results(summary, case, thinnest)
    if results.value("minimum_gap") is None:
        return None
    try:
        bearing = Bearing(case)
        drawing = draw_bearing(bearing, False)
    except (ValueError, OverflowError):
        return None
    ring = bearing.is_ring
    angle = results.value("minimum_gap_angle") if ring else None
    moved = None if ring else direction(results)
    thin, centre = None, None
    if thinnest:
        thin = place(RING*thinnest.across/bearing.radius if ring else SHAFT + BAND, thinnest.angle)
    elif angle is not None:
        thin = place(RING*(results.value("minimum_gap_radius") or 0.0)/bearing.radius, angle)
    if moved:
        centre = (*place(0.0, 0.0), *place(SHAFT - 2.0, moved[1]))
        drawing.add("centre line", "", line([centre[:2], centre[2:]]))
    if thin:
        drawing.add("thinnest", "", circle(thin[0], thin[1], 5.0))
    words = thinnest.short() if thinnest else ""
    first = [("note", f"○ {THINNEST}{', ' if words else ''}"), ("fine", words)] if thin else [("note", f"(place of the {THINNEST}: no film file)")]
    drawing.notes[:0] = first + [("note centre", "- - to the shaft's centre, -e")]*bool(centre)
    return drawing.picture(WIDE) | {"pads": [path for look, _, path in drawing.shapes if look == "pad"], "thinnest": thin, "centre": centre, "words": words}


def draw_bearing(bearing, with_side):
    """Pads, and what is on them."""
    return draw_ring(bearing, with_side) if bearing.is_ring else draw_journal(bearing, with_side)


def draw_journal(bearing, with_side):
    """A journal bearing along its axis: the shaft in the middle, the sleeve around it."""
    drawing, scale = Drawing(), SHAFT/bearing.radius
    clearance = bearing.size("bearing%clearance") or 1.0e-3*bearing.radius
    larger = factor_of(scale*clearance, *GAP)
    shift = bearing.number("pads%preload", 0.0)*clearance
    if abs(shift) > clearance:
        raise ValueError("no preload")
    rest = clearance - bearing.number("bearing%assembly_interference", 0.0)
    offset = bearing.number("pads%preload_offset", 0.5)
    height = bearing.size("bump_foil%height") or 0.0
    crests, half = bearing.crests(bearing.radius)
    taller = factor_of(scale*height, *BUMP)
    tall = min(scale*height*taller or BUMP[1], BUMP[2])*bool(crests)
    for begin in bearing.begins:
        narrow = begin + offset*bearing.arc

        def foil(angle, narrow=narrow):
            gap = rest - shift*math.cos(angle - narrow) - bearing.bore(angle)
            return SHAFT + max(-BAND, min(FARTHEST, scale*larger*gap))

        surface = arc_of(foil, begin, bearing.arc)
        back = arc_of(lambda angle, foil=foil: foil(angle) + tall, begin, bearing.arc)
        outside = arc_of(lambda angle, foil=foil: foil(angle) + tall + BAND, begin, bearing.arc)
        drawing.add("gas", "gas shaft_contact mesh", line([(100.0, 100.0), *surface], True))
        drawing.add("pad", "bearing pads bore", line([*outside, *reversed(back)], True))
        if len(crests)*bearing.count <= MOST_BUMPS:
            for crest in crests:
                wide = half/bearing.radius
                feet = [place(foil(begin + crest + sign*wide) + tall, begin + crest + sign*wide) for sign in (-1.0, 1.0)]
                top = place(foil(begin + crest) - tall, begin + crest)
                drawing.add("bump line", "bump_foil contact strip_load", "M{:.1f},{:.1f} Q{:.1f},{:.1f} {:.1f},{:.1f}".format(*feet[0], *top, *feet[1]))
        if bearing.foil != "rigid":
            drawing.add("foil line", "top_foil model thermal foil_damping", line(surface))
        for angle in sorted({angle for angle, _ in bearing.holes().values() if (angle - begin) % TURN <= bearing.arc}):
            drawing.add("hole line", "feed", line([place(foil(angle), angle), place(foil(angle) + tall + BAND + 3.0, angle)]))
    e = bearing.results.pair("operation%eccentricity") or (0.0, 0.0)
    off = scale*larger*math.hypot(*e)
    x, y = place(min(off, FARTHEST), math.atan2(-e[1], -e[0]))
    drawing.add("shaft", "bearing operation rotor unbalance", circle(x, y, SHAFT))
    draw_motion(drawing, bearing.case.get("scene%analysis"))
    both = bearing.results.pair("operation%load")
    if both and math.hypot(*both) > 0.0:
        angle = math.atan2(both[1], both[0])
        drawing.arrow("load", "operation", place(8.0, angle), place(46.0, angle))
        if bearing.case.get("scene%analysis") == "load_capacity":
            drawing.arrow("motion", "capacity", place(46.0, angle), place(SHAFT - 2.0, angle))
    drawing.notes += [("note load", "→ load")]*bool(both and math.hypot(*both) > 0.0) + [("note", "x →, y ↑, turns ↺"), ("note hole", bearing.supply_words()), ("note groove", groove_words(bearing))]
    if with_side:
        long = side_of_journal(drawing, bearing, scale)
        drawing.notes.append(("note", f"radius {1.0e3*bearing.radius:.4g} mm{long}"))
    for size, words, times in ((clearance*("bearing%clearance" in bearing.case), "clearance", larger), (height*bool(crests), "bumps", taller)):
        drawing.notes.append(("fine", f"{words} {1.0e6*size:.4g} um, drawn x {times:g}"*bool(size)))
    return drawing


def draw_motion(drawing, analysis):
    """What an analysis moves: the shaft's centre, its speed or its load; the shaft's tilt is seen from the side."""
    if analysis == "linear_dynamics":
        for x, y in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)):
            drawing.arrow("motion", "dynamics", (100.0 + 14.0*x, 100.0 + 14.0*y), (100.0 + 34.0*x, 100.0 + 34.0*y))
    elif analysis == "periodic":
        drawing.add("motion line", "periodic", circle(100.0, 100.0, 26.0))
    elif analysis == "transient":
        drawing.add("motion line", "transient", line([place(6.0 + 2.2*turn*TURN, turn*TURN) for turn in (i/40.0 for i in range(81))]))
    elif analysis == "lift_off":
        points = arc_of(SHAFT - 14.0, -0.6, 4.6)
        drawing.add("motion line", "capacity", line(points[:-2]))
        drawing.arrow("motion", "capacity", points[-3], points[-1])


def side_of_journal(drawing, bearing, scale):
    """The same from the side: shaft, sleeve, and its length in words; empty where it is not known."""
    length, slope = bearing.size("bearing%length"), bearing.number("bearing%half_angle", 0.0)
    if length is None or not abs(slope) < 0.5*math.pi:
        return ""
    scale = min(scale, (ROOM - 34.0)/length)
    axial, rise = scale*length*math.cos(slope), 0.5*scale*length*math.sin(slope)
    begin, end, radius = SIDE + 0.5*(ROOM - axial), SIDE + 0.5*(ROOM + axial), scale*bearing.radius
    sides = [(begin - 10.0, max(radius - rise, 1.0)), (begin, max(radius - rise, 1.0)), (end, radius + rise), (end + 10.0, radius + rise)]
    drawing.add("shaft", "bearing rotor unbalance transient periodic dynamics", line([(x, 100.0 - far) for x, far in sides] + [(x, 100.0 + far) for x, far in reversed(sides)], True))
    for sign in (-1.0, 1.0):
        near = [(begin, 100.0 + sign*(max(radius - rise, 1.0) + BAND)), (end, 100.0 + sign*(radius + rise + BAND))]
        drawing.add("pad", "bearing pads bore", line([*near, *((x, y + sign*BAND) for x, y in reversed(near))], True))
    for part in itertools.chain(*(shown_parts(one, lambda angle, _: math.cos(angle) >= 0.0) for one in groove_lines(bearing))):
        drawing.add("groove line", "grooves", line([(0.5*(begin + end) + scale*along, 100.0 - radius*math.sin(angle)) for angle, along in part]))
    for angle, along in bearing.holes().values():
        if math.cos(angle) >= -1.0e-9 and 2.0*abs(along) < length:  # those on the side that is seen
            drawing.add("hole", "feed", circle(0.5*(begin + end) + scale*along, 100.0 - radius*math.sin(angle), HOLE))
    lean = 0.06*(end - begin) if bearing.case.get("scene%analysis") == "misalignment_allowance" or "operation%tilt" in bearing.case else 0.0
    drawing.add("axis line", "operation capacity", line([(begin - 16.0, 100.0 + lean), (end + 16.0, 100.0 - lean)]))
    return f", length {1.0e3*length:.4g} mm" + (f", half angle {math.degrees(slope):.3g} deg" if slope else "")


def draw_ring(bearing, with_side):
    """The sectors of a thrust bearing, across the axis."""
    drawing, scale, inner = Drawing(), RING/bearing.radius, bearing.size("bearing%inner_radius")
    if inner is None or not inner < bearing.radius:
        raise ValueError("no inner radius")
    part = bearing.number("ramp%part", 0.0)
    if not 0.0 <= part <= 1.0:
        raise ValueError("no part of a pad")
    crests, _ = bearing.crests(0.5*(inner + bearing.radius))
    for begin in bearing.begins:
        drawing.add("pad", "bearing pads bore gas mesh top_foil model", line([*arc_of(RING, begin, bearing.arc), *reversed(arc_of(scale*inner, begin, bearing.arc))], True))
        if part > 0.0:
            drawing.add("ramp", "ramp", line([*arc_of(RING, begin, part*bearing.arc), *reversed(arc_of(scale*inner, begin, part*bearing.arc))], True))
        for crest in crests*(len(crests)*bearing.count <= MOST_BUMPS):
            drawing.add("bump line", "bump_foil contact", line([place(scale*inner, begin + crest), place(RING, begin + crest)]))
    for one in groove_lines(bearing):
        drawing.add("groove line", "grooves", line([place(scale*along, angle) for angle, along in one]))
    for angle, along in bearing.holes().values():
        x, y = place(scale*along, angle)
        drawing.add("hole", "feed", circle(x, y, HOLE))
    drawing.notes += [("note load", "↓ load on the runner")]*(with_side and bool(bearing.number("operation%axial_load"))) + [("note", "x →, y ↑, turns ↺"), ("note hole", bearing.supply_words()), ("note groove", groove_words(bearing))]
    if with_side:
        larger = section_of_ring(drawing, bearing, inner, part)
        drawing.notes.append(("note", f"radius {1.0e3*inner:.4g} to {1.0e3*bearing.radius:.4g} mm, {bearing.count} pads of {math.degrees(bearing.arc):.4g} deg"))
    ramp = bearing.size("ramp%height") if part > 0.0 else None
    if ramp and with_side:
        drawing.notes.append(("fine", f"at the right a pad, cut: ramp {1.0e6*ramp:.4g} um x {larger:g}"))
    return drawing


def section_of_ring(drawing, bearing, inner, part):
    """A pad cut along its middle radius: ramp and land, the runner above them and the load on it; how many times larger heights are."""
    begin, end = SIDE + 7.0, SIDE + ROOM - 7.0
    scale, kink = (end - begin)/(0.5*bearing.arc*(inner + bearing.radius)), begin + part*(end - begin)
    height = bearing.size("ramp%height") if part > 0.0 else None
    larger = factor_of(scale*(height or 0.0), *STEP)
    low = LAND + min(scale*larger*(height or 0.0), 2.0*STEP[2])
    floor, runner = max(low, LAND) + 12.0, LAND - RUNNER
    drawing.add("pad", "bearing pads bore top_foil model", line([(kink, LAND), (end, LAND), (end, floor), (kink, floor)], True))
    if height:
        drawing.add("ramp", "ramp", line([(begin, low), (kink, LAND), (kink, floor), (begin, floor)], True))
    drawing.add("gas", "gas shaft_contact mesh", line([(begin, low), (kink, LAND), (end, LAND), (end, runner), (begin, runner)], True))
    drawing.add("shaft", "operation bearing rotor dynamics", line([(begin - 6.0, runner), (end + 6.0, runner), (end + 6.0, runner - 20.0), (begin - 6.0, runner - 20.0)], True))
    drawing.arrow("turn", "operation", (begin + 4.0, runner - 10.0), (begin + 26.0, runner - 10.0))
    if bearing.number("operation%axial_load", 0.0):
        drawing.arrow("load", "operation", (0.5*(begin + end), runner - 65.0), (0.5*(begin + end), runner - 21.0))
    return larger


def draw_strip(case):
    """Bumps in a row, of a strip without a film."""
    results, drawing = Results({}, case), Drawing(152.0)
    pitch, half, height, bumps = (results.key(f"bump_foil%{name}") for name in ("pitch", "half_length", "height", "bumps"))
    if half is None or not half > 0.0 or not 1 <= (bumps or 1) <= MOST_BUMPS:
        raise ValueError("no strip")
    bumps, pitch = int(bumps or 1), pitch or 2.5*half
    height = height or 0.25*half
    if not min(pitch, height) > 0.0 or case.get("modes%part") in ("half_arc", "arc"):
        bumps, pitch = 1, 2.5*half
    scale = (SIDE + ROOM - 30.0)/(bumps*pitch)
    taller = factor_of(scale*height, 1.0, 8.0, 40.0)
    tall = min(scale*height*taller, 60.0)
    for i in range(bumps):
        middle = 15.0 + scale*(i + 0.5)*pitch
        drawing.add("bump line", "bump_foil contact modes", f"M{middle - scale*half:.1f},120 Q{middle:.1f},{120.0 - 2.0*tall:.1f} {middle + scale*half:.1f},120")
        if "strip_load" in case.groups and bumps <= 40:
            drawing.arrow("load", "strip_load", (middle, 88.0 - tall), (middle, 117.0 - tall))
    drawing.add("pad", "bearing", line([(10.0, 121.0), (SIDE + ROOM - 10.0, 121.0), (SIDE + ROOM - 10.0, 127.0), (10.0, 127.0)], True))
    drawing.notes += [("note", f"{bumps} bump{'s'*(bumps > 1)}, pitch {1.0e3*pitch:.4g} mm"), ("fine", f"drawn: heights {1.0e6*height:.4g} um x {taller:g}")]
    return drawing
