"""Lines, arcs and arrows of an SVG picture, and words below it."""

import math

LINE = 14.0        # of words
MOST_POINTS = 96   # of an arc
SIDE, ROOM = 212.0, 130.0  # where the view from the side begins, and how wide it is
TURN = 2.0*math.pi


class Drawing:
    """The lines of a picture: (look, groups of the case file that they are of, SVG path), and words below it: (look, words)."""

    def __init__(self, low=202.0):
        self.shapes, self.notes, self.low = [], [], low

    def picture(self, wide):
        """What the template has."""
        notes = [(look, words) for look, words in self.notes if words]
        return {"shapes": self.shapes, "texts": [(0.5*wide, self.low + LINE*i, look, words) for i, (look, words) in enumerate(notes)],
                "width": wide, "height": self.low + LINE*len(notes) - 6.0}

    def add(self, look, groups, path):
        """One more line, or area."""
        self.shapes.append((look, groups, path))

    def arrow(self, look, groups, begin, end):
        """A line with a head."""
        (x, y), (u, v) = begin, end
        far = math.hypot(u - x, v - y) or 1.0
        along = ((u - x)/far, (v - y)/far)
        back = (u - 7.0*along[0], v - 7.0*along[1])
        sides = [(back[0] - 4.0*sign*along[1], back[1] + 4.0*sign*along[0]) for sign in (1.0, -1.0)]
        self.add(f"{look} line", groups, line([begin, back]))
        self.add(look, groups, line([sides[0], end, sides[1]], True))


def line(points, closed=False):
    """An SVG path through points."""
    return "M" + " L".join(f"{x:.1f},{y:.1f}" for x, y in points) + " Z"*closed


def place(radius, angle):
    """A point of the view along the axis, which is 200 x 200: x to the right, y up."""
    return 100.0 + radius*math.cos(angle), 100.0 - radius*math.sin(angle)


def arc_of(radius, begin, angle):
    """Points of an arc; the radius is a number, or one at each angle."""
    many = max(2, math.ceil(MOST_POINTS*abs(angle)/TURN))
    return [place(radius(begin + angle*i/many) if callable(radius) else radius, begin + angle*i/many) for i in range(many + 1)]


def circle(x, y, radius):
    """An SVG path around a point."""
    return f"M{x - radius:.1f},{y:.1f} a{radius},{radius} 0 1 0 {2.0*radius},0 a{radius},{radius} 0 1 0 {-2.0*radius},0 Z"
