"""Page beside the paper: the orbit of an unbalanced shaft over time."""

import math

import numpy
from matplotlib import pyplot

from gfb.gallery.page import Page, input_link
from gfb.plot.transient import MICRO, draw_orbit, draw_thinnest, draw_way, places, read

CASE = "transient_unbalance"
ROOM = 0.1  # around the enlarged orbit, over its extent


def draw(runs, folder):
    """The orbit that inputs/transient_unbalance.nml ends in, and what the clearance leaves of it."""
    page = Page("orbit", "Beside the paper: the orbit of an unbalanced shaft", folder)
    result = page.took([runs.run(CASE)])[0]
    with result.open() as file:
        rows, keys = read(file)
    page.picture(draw_both(rows, keys), "The shaft's centre in its clearance, the same enlarged, the smallest film over time")
    clearance = number(result, "bearing", "clearance")
    sizes, turn = [result[f"orbit_{axis}"] for axis in "xy"], rows["turns"] > rows["turns"][-1] - 1.0
    speed = f"{rows['speed'][0]*30.0/math.pi:,.0f} rpm"
    page.short = (f"{MICRO*sizes[0]:.2f} x {MICRO*sizes[1]:.2f} um under {1.0e6*number(result, 'unbalance', 'unbalance'):g} g mm at "
                  f"{speed}, {100.0*max(sizes)/clearance:.1f} % of the clearance, steady after {rows['turns'][-1]:.0f} turns.")
    page.head("What is to be seen")
    middle = [numpy.mean(rows[f"eccentricity_{axis}"][turn]) for axis in "xy"]
    page.items([
        "Left: the shaft's centre at -e, in black where it touches the pad at rest, in orange the pad's edges. Middle: the same "
        "enlarged. The unbalance is there at once; from the equilibrium the shaft spirals into its orbit. Right: the smallest film.",
        f"The last turn goes round e/C = ({middle[0]/clearance:.4f}, {middle[1]/clearance:.4f}); the equilibrium is at "
        f"({rows['eccentricity_x'][0]/clearance:.4f}, {rows['eccentricity_y'][0]/clearance:.4f}).",
        f"The smallest film is {MICRO*rows['minimum_gap'][0]:.2f} um at rest, {MICRO*rows['minimum_gap'].min():.2f} um in the whole run "
        f"and {MICRO*rows['minimum_gap'][turn].min():.2f} um in the last turn.",
    ])
    page.say("How it is computed, checked and what it costs: [transient.md](../../manual/transient.md). Orbits that close by "
             "themselves are [periodic.md](../../manual/periodic.md).")
    page.parameters(result, f"{input_link(CASE)}, run by `tools/run inputs/{CASE}.nml`, drawn by "
                            f"`tools/plot results/{CASE}/{CASE}.h5`.")
    return page


def draw_both(rows, keys):
    """The orbit in its clearance and enlarged, and the smallest film."""
    figure, (whole, near, film) = pyplot.subplots(1, 3, layout="constrained", figsize=(15.5, 5.4))
    draw_orbit(whole, rows, keys)
    whole.legend(fontsize=8, loc="center", bbox_to_anchor=(0.5, 0.7))  # above the arrow of the load
    draw_way(near, rows)
    low, high = (numpy.array([function(place) for place in places(rows)]) for function in (numpy.min, numpy.max))
    half = (0.5 + ROOM)*(high - low).max()
    (x_low, x_high), (y_low, y_high) = zip(0.5*(low + high) - half, 0.5*(low + high) + half)
    near.set(xlabel="-e_x [um]", ylabel="-e_y [um]", xlim=(x_low, x_high), ylim=(y_low, y_high), aspect="equal")
    near.set_title("the orbit enlarged", fontsize=10)
    near.grid(alpha=0.3)
    draw_thinnest(film, rows, keys)
    return figure


def number(result, group, key):
    """A key's value."""
    return float(result.used[group, key][0])
