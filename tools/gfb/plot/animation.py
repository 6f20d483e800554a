"""Moving pictures: film and foil over the steps of a sweep or of time, or the orbit of a shaft; a GIF, or an MP4 where ffmpeg is."""

import numpy
from matplotlib import animation, pyplot

from gfb import steps
from gfb.plot import clearance, transient
from gfb.plot.colours import draw_bar, look_of
from gfb.plot.film import WORDS, label_theta, read_film
from gfb.plot.scene import case_name, step_words
from gfb.results import open_results
from gfb.tool import stop

FIELDS = ("pressure", "gap", "deflection")
FRAMES = 100   # at most
PACE = 5.0     # frames a second, of steps
FAST = 20.0    # of an orbit
DOTS = 80      # a GIF's dots an inch
BESIDE = 1.07  # of the clearance: where the ring of the thinnest film stands, beside the shaft's centre


def draw(path, file, picture):
    """Writes the moving picture of a case, which any of its files names."""
    case = case_name(steps.alone(path))
    film = path.with_name(f"{case}.film{steps.ENDING}")
    if film.exists():
        with open_results(film) as opened:
            save(picture, *of_film(film, opened))
        return
    if transient.is_transient(file):
        save(picture, *of_orbit(path, file))
        return
    stop(f"{path}: nothing moves: there is no {film.name} and no orbit in it")


def save(picture, figure, frame, frames, pace):
    """The file, by Pillow or ffmpeg."""
    if picture.suffix == ".mp4":
        if not animation.writers.is_available("ffmpeg"):
            stop("an MP4 needs ffmpeg, which is not there; a name with .gif needs nothing")
        writer = animation.FFMpegWriter(fps=pace)
    else:
        writer = animation.PillowWriter(fps=pace)
    animation.FuncAnimation(figure, frame, frames=frames).save(picture, writer=writer, dpi=DOTS)


def chosen(many):
    """Numbers of the frames, evenly among so many."""
    return [int(i) for i in numpy.unique(numpy.linspace(0, many - 1, min(many, FRAMES)).round())]


# --- film over the steps ---

def of_film(path, file):
    """Maps of pressure, film thickness and deflection, one colour scale for all steps."""
    films = []
    numbers = chosen(steps.count(file))
    for step in numbers:
        one = steps.at_step(file, step)
        try:
            films.append(read_film(path, one))
        finally:
            one.close()
    names = [name for name in FIELDS if name in films[0].fields and any(numpy.any(film.fields[name]) for film in films)]
    if not names:
        stop(f"{path}: no pressure, gap or deflection in it")
    figure, axes = pyplot.subplots(len(names), 1, figsize=(8.0, 2.3*len(names) + 0.5), squeeze=False, layout="constrained", sharex=True)
    meshes = []
    for chart, name in zip(axes.flat, names):
        every, units = zip(*(film.readable(name) for film in films))
        low, high = min(one.min() for one in every), max(one.max() for one in every)
        shades = look_of(name, low, high)
        for pad in films[0].pads:
            mesh = chart.pcolormesh(films[0].theta[pad], 1.0e3*films[0].z, every[0][pad].T, shading="gouraud", **shades)
            meshes.append((mesh, [one[pad].T for one in every]))
        draw_bar(figure, chart, **shades, label=f"[{units[0]}]")
        chart.set_title(WORDS[name], fontsize=10)
        chart.set_ylabel("z [mm]")
    label_theta(axes[-1, 0], films[0])
    title = figure.suptitle(" ", fontsize=11)

    def frame(number):
        for mesh, every in meshes:
            mesh.set_array(every[number])
        title.set_text(f"{case_name(steps.alone(path))}: {step_words(file, numbers[number])}, step {numbers[number] + 1} of {steps.count(file)}")

    return figure, frame, len(films), PACE


# --- orbit ---

def of_orbit(path, file):
    """The shaft's centre on its way, with a tail of two turns, and where it is nearest to the pads; a small orbit beside it enlarged."""
    history, keys = transient.read(file)
    many = 1 if transient.enlarged(history, keys) is None else 2
    figure, axes = pyplot.subplots(1, many, figsize=(6.0*many, 6.4), squeeze=False, layout="constrained")
    transient.draw_orbits(axes[0], history, keys)
    shafts, bearing = transient.journals(history), clearance.bearing_of(keys)
    moving = []
    for chart in axes[0]:
        for line in chart.get_lines()[-4*len(shafts):]:
            line.set_alpha(0.3)
            line.set_label("")
        for _, colour, place in shafts:
            tail = chart.plot([], [], color=colour, linewidth=1.5)[0]
            spot = chart.plot([], [], "o", color="C3", markersize=8, label="shaft's centre" if colour == "C0" else None)[0]
            moving.append((tail, spot, *place))
    nearest = [(axes[0, 0].plot([], [], "o", color="w", markeredgecolor="k", markersize=8, zorder=6,
                                label=("thinnest film, foils at rest" + " and no &bore"*bearing.bored) if colour == "C0" else None)[0], *place)
               for _, colour, place in shafts if bearing is not None]
    axes[0, 0].legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=3)
    numbers = chosen(len(history["turns"]))
    title = figure.suptitle(" ", fontsize=11)

    def frame(number):
        end = numbers[number]
        shown = (history["turns"] <= history["turns"][end]) & (history["turns"] >= history["turns"][end] - 2.0)
        for tail, spot, x, y in moving:
            tail.set_data(x[shown], y[shown])
            spot.set_data(x[end:end + 1], y[end:end + 1])
        for ring, x, y in nearest:
            theta = numpy.array([bearing.thinnest(x[end]/clearance.MICRO, y[end]/clearance.MICRO)])
            far = clearance.MICRO*numpy.minimum(bearing.limit(theta), clearance.OPEN*bearing.clearance)
            ring.set_data(BESIDE*far*numpy.cos(theta), BESIDE*far*numpy.sin(theta))
        title.set_text(f"{case_name(path)}: turn {history['turns'][end]:.1f}, {history['time'][end]:.4g} s, "
                       f"{history['speed'][end]*30.0/numpy.pi:,.0f} rpm, film {1.0e6*history['minimum_gap'][end]:.3g} um")

    return figure, frame, len(numbers), FAST
