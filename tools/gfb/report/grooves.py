"""Where the grooves of a case run, for pictures: of each band lines along its grooves. Angles in rad, places across the motion in m."""

import itertools
import math

from gfb.report.sketch_lines import TURN

DRAWN = 24     # lines of a band where the case does not say how many grooves there are
MOST = 120     # lines of a band
POINTS = 33    # of a line
MOST_BANDS = 50


def groove_lines(bearing):
    """The lines of all bands, each as points (theta, z or radius), without the bounds of a turn; empty where there are no grooves.

    A line is one along which x/s rises as the cotangent of its angle; of a ring that is a logarithmic spiral. Lines that rise with theta pump up on a
    surface at rest and down on one that turns.
    """
    angles, begins, ends = (bearing.listed(f"grooves%{name}") for name in ("angle", "band_begin", "band_end"))
    pumping = bearing.case.listed("grooves%pumping") if "grooves%pumping" in bearing.case else []
    at_rest = bearing.case.get("grooves%on") == "sleeve"
    if not 0 < len(begins) == len(ends) == len(pumping) <= MOST_BANDS or len(angles) not in (1, len(begins)):
        return []
    angles = angles*len(begins) if len(angles) == 1 else angles
    count = min(int(bearing.size("grooves%count") or DRAWN), MOST)
    lines = []
    for angle, begin, end, word in zip(angles, begins, ends, pumping, strict=True):
        if not (0.0 < angle < 0.25*TURN and begin < end) or bearing.is_ring and not begin > 0.0:
            raise ValueError("no band of grooves")
        slope = (1.0 if (word == "up") == at_rest else -1.0)/math.tan(angle)
        places = [begin + (end - begin)*i/(POINTS - 1) for i in range(POINTS)]
        turned = [slope*(math.log(place/begin) if bearing.is_ring else (place - begin)/bearing.radius) for place in places]
        lines += [[(TURN*i/count + more, place) for more, place in zip(turned, places, strict=True)] for i in range(count)]
    return lines


def shown_parts(line, shown):
    """The parts of a line whose points are shown, those of two points or more."""
    parts = ([point for _, point in group] for seen, group in itertools.groupby(((shown(*point), point) for point in line), lambda one: one[0]) if seen)
    return [part for part in parts if len(part) > 1]


def groove_words(bearing):
    """What the grooves are, in words; empty where there are none."""
    depth, angles = bearing.size("grooves%depth"), bearing.listed("grooves%angle")
    if depth is None or not angles:
        return ""
    where = {"shaft": "runner" if bearing.is_ring else "shaft", "sleeve": "ring" if bearing.is_ring else "sleeve"}.get(bearing.case.get("grooves%on"))
    both = " and ".join(dict.fromkeys(f"{math.degrees(angle):.3g}" for angle in angles))
    return f"grooves on the {where}, {both} deg, {1.0e6*depth:.4g} um deep" if where else ""
