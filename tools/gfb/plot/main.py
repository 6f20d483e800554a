"""Draws results of gfb.

  tools/plot CASE.film.vtkhdf           maps of pressure, gap and deflection, and their lines along
                                        the midplane and the bearing's edge
      --show polar                        pressure and gap around the shaft, with load, pad edges and thinnest film
      --show heat                         of &thermal: temperatures of film and top foil, heat into the shaft
  tools/plot CASE.bump_foil.vtkhdf      the bumps' deflected midline and their crests' deflections
  tools/plot CASE.top_foil.vtkhdf       map of a bearing's top foil, and lines along midplane and edges; of a thrust bearing's
                                        CASE.top_foil_1.vtkhdf a map in its plane, and its shape
  tools/plot CASE.bump_foil.vtkhdf MODE ...   shapes of modes, such as mode_1 (also of the top foil)
  tools/plot CASE.h5 [COLUMN ...]       columns of the history against what the sweep changes, or load steps;
                                        of one point alone a table
      --together                          columns of one unit in one chart
  tools/plot CASE.h5 --show dynamics    stiffness and damping over the frequency of vibration; of a sweep
                                        the last point, or the one of --step
  tools/plot CASE.h5 --show heat        of &thermal: where the heat goes, and temperatures; of a sweep along it with running clearance,
                                        thinnest film and runaway, of one of its points with --step
  tools/plot SAMPLE.h5 [COLUMN ...]     of &sample: histogram and cumulative share of minimum_gap, or of other results
  tools/plot STRIP.h5 ...               strips under loads, one or several in a picture:
      --show bumps                        mean deflection of every crest line
      --show loop                         force against travel of the plate or largest crest deflection
      --show contact                      where contacts are open, stick or slip, and their forces (one file; also a bearing's)
                                        without --show: loops where the load goes back, otherwise bumps
  tools/plot CASE.h5 --show campbell    frequency and damping of a rotor's modes, of a sweep over the speed
  tools/plot CASE.h5 ... --show map     critical mass over load and speed, of several sweeps
  tools/plot CASE.film.steps.vtkhdf     a step of a sweep's film or foils, the last one or that of --step
  tools/plot --3d CASE.h5               film and foils of all pads in space; of a journal beside the picture CASE.3d.vtkhdf for ParaView
  tools/plot --animate CASE.h5          moving picture of a sweep's film, or else of an orbit: a GIF, with -o NAME.mp4 an MP4
  tools/plot CASE.h5                    of a machine: to scale, with its static line and moments
      --show shapes, campbell             its modes in space; frequencies and decrements over the speed, of a sweep
      --show response, critical           to unbalance; undamped critical speeds over the stiffness of bearings
  tools/plot CASE.h5                    of analysis = 'transient': orbit, a small one once more and larger, and thinnest film over time
  tools/plot CASE.h5                    of analysis = 'periodic': the branch over its parameter, and its orbits
      --show orbit, thinnest              each alone
      --show waterfall                    spectra over the speed of a run-up or coast-down; heights are roots of the amplitudes
      --show bifurcation                  the shaft's centre once a turn, over the speed

Where no columns are named, the ones most asked for are drawn; --list prints the names there are.
Several strips are distinguished by the keys in which they differ. A picture lies beside its data, named after them; CASE.h5 beside
a film or a foil gives the picture load, speed, model and natural frequencies.
"""

import argparse
import contextlib
import pathlib
from collections.abc import Sequence

import numpy

from gfb.tool import draw_into_files, parser_of, stop

draw_into_files()
from matplotlib import pyplot  # noqa: E402

from gfb import steps  # noqa: E402
from gfb.files import fresh  # noqa: E402
from gfb.plot import animation, dynamics, foil, heat, machine, machine_motions, machine_orbits, machine_time, periodic, polar, ring, rolled, rotor, sample, strip, transient  # noqa: E402
from gfb.plot.colours import round_numbers  # noqa: E402
from gfb.plot.film import draw_film, readable  # noqa: E402
from gfb.plot.scene import case_name, named, read_scene, step_words  # noqa: E402
from gfb.results import BROKEN, Unreadable, attribute, open_results, reading, used_keys  # noqa: E402

USUAL = ("minimum_gap", "attitude_angle", "maximum_pressure", "friction_torque")
USUAL_OF_TILT = ("torque_x", "torque_y", "minimum_gap", "maximum_pressure")
USUAL_OF_MACHINES = ("minimum_gap_", "power_loss_", "growth_rate", "whirl_frequency")
USUAL_OF_LIMITS = {  # what is looked for, and what it makes of the bearing
    "load_capacity": ("load_capacity", "load_capacity_coefficient", "attitude_angle", "friction_torque"),
    "lift_off_speed_rpm": ("lift_off_speed_rpm", "minimum_gap", "attitude_angle", "friction_torque"),
    "lift_off_supply_pressure": ("lift_off_supply_pressure", "supply_flow", "supply_power", "axial_gap", "attitude_angle"),
    "misalignment_allowance": ("misalignment_allowance", "attitude_angle", "maximum_pressure", "friction_torque")}
USUAL_OF_SUPPLY = ("minimum_gap", "supply_flow", "axial_force", "stiffness_zz", "stiffness_xx", "supply_power", "maximum_pressure")
MOST_USUAL = 4  # of these
OF_FILMS = {polar.KIND: polar.draw, heat.KIND: heat.draw_film}  # beside what is drawn unasked
ROUND_OFF = 1.0e-12  # of the largest number of a unit: a smaller one is zero
USUAL_OF_ONE = ("force_x", "force_y", "axial_force", "eccentricity_x", "eccentricity_y", "axial_eccentricity", "axial_gap",
                "attitude_angle", "minimum_gap", "minimum_gap_midplane", "minimum_gap_edge", "maximum_pressure", "minimum_pressure",
                "torque_x", "torque_y", "friction_torque", "power_loss", "critical_mass", "whirl_ratio", "load_capacity", "load_capacity_coefficient", "lift_off_speed_rpm",
                "lift_off_supply_pressure", "misalignment_allowance", "supply_flow", "supply_power", "choked_orifices", "backflow_orifices")


def main():
    parser = parser_of("tools/plot", __doc__)
    parser.add_argument("file", type=pathlib.Path, help="CASE.film.vtkhdf, CASE.bump_foil.vtkhdf or CASE.h5")
    parser.add_argument("columns", nargs="*", metavar="COLUMN",
                        help="names of the history, such as minimum_gap; or more files, NAME.h5")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="PNG",
                        help="the picture; default: beside the file, its name with what is shown and .png")
    parser.add_argument("--list", action="store_true", help="print the history's columns or a foil's fields, and stop")
    parser.add_argument("--together", action="store_true", help="columns of one unit in one chart")
    parser.add_argument("--show", choices=(*strip.KINDS, dynamics.KIND, polar.KIND, heat.KIND, *rotor.KINDS, *transient.KINDS, *machine_motions.DRAWN),
                        help="what of a strip's or bearing's CASE.h5; polar, heat: of CASE.film.vtkhdf, too")
    parser.add_argument("--3d", action="store_true", dest="rolled", help="film and foils in space")
    parser.add_argument("--picture-only", action="store_true", help="with --3d: no CASE.3d.vtkhdf")
    parser.add_argument("--animate", action="store_true", help="a moving picture of a sweep's film, or of an orbit")
    parser.add_argument("--step", type=step_numbers, default=[], metavar="N[,N...]",
                        help="load steps of --show bumps and contact, or sweep points of a bearing; default: the one "
                             "of the largest force, or the last point")
    options = parser.parse_args()
    more = [pathlib.Path(name) for name in options.columns if name.endswith(".h5")]
    options.columns = [name for name in options.columns if not name.endswith(".h5")]
    shown = ".3d" if options.rolled else f".{options.show}" if options.show else ""
    ending = ".gif" if options.animate else ".png"
    picture = options.output or options.file.with_name(f"{options.file.name}{shown}{ending}")
    picture = picture if picture.suffix else picture.with_name(picture.name + ending)
    with contextlib.ExitStack() as opened:
        files = [open_file(path, opened) for path in [options.file, *more]]
        try:
            with reading(options.file):
                if options.list:
                    print(list_names(options.file, files[0]), end="")
                    return 0
                if options.animate:
                    write_animation(options, files[0], picture)
                    return 0
                figure = draw(options, [options.file, *more], files)
        except Unreadable as error:
            stop(str(error))
    try:
        with fresh(picture) as place:
            figure.savefig(place, dpi=100)
    except BROKEN as error:
        stop(f"{picture}: {' '.join(str(error).split())}", 3)
    print(f"drawn: {picture}")
    return 0


def write_animation(options, file, picture):
    """The moving picture."""
    if options.show or options.rolled or options.columns or options.step:
        stop("--animate goes without --show, --3d, --step and columns")
    try:
        with fresh(picture) as place:
            animation.draw(options.file, file, place)
    except (OSError, ValueError) as error:
        if isinstance(error, Unreadable):
            raise
        stop(f"{picture}: {error}", 3)
    print(f"drawn: {picture}")


def step_numbers(text):
    """The numbers of --step."""
    try:
        return [int(word) for word in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}': whole numbers with commas between them") from None


def open_file(path, opened):
    """An HDF5 file that stays open as long as the stack."""
    try:
        return opened.enter_context(open_results(path))
    except FileNotFoundError:
        stop(f"{path}: there is no such file")
    except Unreadable as error:
        stop(str(error))
    except OSError as error:
        stop(f"{path}: cannot be read as HDF5: {' '.join(str(error).split())}")


def draw(options, paths, files):
    """The picture asked for."""
    path, file = paths[0], files[0]
    if options.rolled:
        if options.show or options.step or options.columns or len(files) > 1:
            stop("--3d is of one case, without --show, --step and columns")
        return rolled.draw(path, grid=not options.picture_only)
    if steps.has_steps(file):
        return draw_step(options, path, file)
    if options.show in transient.KINDS or transient.is_transient(file) and not (options.show or options.columns):
        if len(files) > 1 or options.step or options.columns:
            stop("a shaft's motion is drawn of one file, without --step and columns")
        return (machine_time if machine.is_machine(file) else transient).draw(path, file, options.show)
    if options.show == polar.KIND:
        return draw_polar(options, path, file)
    if options.show == heat.KIND:
        return draw_heat(options, path, file)
    if periodic.is_periodic(file) and not (options.show or options.step or options.columns) and len(files) == 1:
        return (machine_orbits if machine.is_machine(file) else periodic).draw(path, file)
    if options.show in machine_motions.DRAWN or options.show == "campbell" and machine.is_machine(file) or is_machine_at_rest(options, file):
        if len(files) > 1 or options.step or options.columns:
            stop("a machine is drawn of one file, without --step and columns")
        return (machine_motions.DRAWN | {"campbell": machine_motions.draw_campbell})[options.show or machine.KIND](path, file)
    of_strips = options.show or options.step or len(files) > 1
    if of_strips and options.columns:
        stop("columns are drawn of one file, without --show and --step")
    if options.show in rotor.KINDS:
        return rotor.draw(paths, files, options.show)
    if options.show == dynamics.KIND:
        if len(files) > 1:
            stop("stiffness and damping are drawn of one file")
        return dynamics.draw(path, file, options.step)
    if "sample" in file and not of_strips:
        return sample.draw(path, file, options.columns)
    if of_strips or (not options.columns and strip.is_strip(file)):
        return strip.draw(paths, files, options.show, options.step)
    if foil.is_foil(file):
        return draw_foil(path, file, options.columns)
    if "VTKHDF" in file:
        if options.columns:
            stop(f"{path}: columns are of a history; name a CASE.h5")
        return drawing_of(file)(path, file)
    if "history" in file:
        return draw_history(path, file, options.columns, options.together)
    return stop(f"{path}: neither a film or foil file nor a case file of gfb")


def is_machine_at_rest(options, file):
    """Whether a machine of one point is drawn unasked."""
    return machine.is_machine(file) and not (options.show or options.columns or len(file["history"]))


def drawing_of(file):
    """What draws a film: of sectors in their plane, else unrolled."""
    return ring.draw_ring if ring.is_ring(file) else draw_film


def draw_foil(path, file, columns):
    """A foil's picture: of a sector in its plane, else unrolled."""
    return ring.draw_foil(path, file) if ring.is_ring(file) and not columns else foil.draw(path, file, columns)


def draw_step(options, path, file):
    """The picture of a step: of the last one, where none is named."""
    many = steps.count(file)
    if options.show not in (None, *OF_FILMS) or options.columns or len(options.step) > 1:
        stop("of a file with steps one is drawn, --step N, without columns and --show but polar and heat")
    number = options.step[0] if options.step else many
    if not 1 <= number <= many:
        stop(f"{path}: no step {number}; there are {many}")
    one = steps.at_step(file, number - 1)
    try:
        if options.show and foil.is_foil(one):
            stop(f"{path}: a foil; --show {options.show} is of CASE.film.vtkhdf")
        if foil.is_foil(one):
            figure = draw_foil(steps.alone(path), one, [])
        else:
            figure = OF_FILMS.get(options.show, drawing_of(one))(steps.alone(path), one)
    finally:
        one.close()
    what = steps.alone(path).name.removesuffix(".vtkhdf").rpartition(".")[2].replace("_", " ")
    figure.suptitle(f"{case_name(steps.alone(path))}: {step_words(file, number - 1)}, step {number} of {many}: {what}", fontsize=11)
    return figure


def draw_polar(options, path, file):
    """The film around the shaft."""
    if options.columns or options.step or "VTKHDF" not in file or foil.is_foil(file):
        stop(f"{path}: --show polar is of one CASE.film.vtkhdf, without columns")
    if ring.is_ring(file):
        stop(f"{path}: --show polar is of journals; the sectors of a thrust bearing are drawn without --show")
    return polar.draw(path, file)


def draw_heat(options, path, file):
    """Heat of a film, or of a case file."""
    if options.columns or foil.is_foil(file):
        stop(f"{path}: --show heat is of CASE.film.vtkhdf or CASE.h5, without columns")
    if "VTKHDF" in file:
        if options.step:
            stop("--step is of CASE.film.steps.vtkhdf or CASE.h5")
        return heat.draw_film(path, file)
    return heat.draw(path, file, options.step, swept(file))


def list_names(path, file):
    """What --list prints."""
    if foil.is_foil(file):
        return "".join(f"{name}\n" for name in foil.names(file))
    if "history" in file:
        return list_columns(file)
    return stop(f"{path}: columns are of a history; name a CASE.h5")


# --- history ---

def list_columns(file):
    """Name, unit and meaning of each column."""
    return "".join(f"{name:26} [{attribute(data, 'unit')}]  {attribute(data, 'meaning')}\n"
                   for name, data in file["history"].items())


def swept(file):
    """Name of what the sweep changes, as the echo of the case has it; None without a sweep."""
    name = used_keys(file).get(("sweep", "parameter"), ("", True))[0].strip("'")
    return name if name.isidentifier() else None  # one of several keys, or group%key, is in the history under another name


def charts_of(history, columns, together):
    """Columns of every chart."""
    if not together:
        return [[name] for name in columns]
    charted: dict[str, list[str]] = {}
    for name in columns:
        charted.setdefault(attribute(history[name], "unit"), []).append(name)
    return list(charted.values())


def draw_history(path, file, columns, together=False):
    """One chart a column, or a unit, against what the sweep changes or else the number of the row."""
    history = file["history"]
    parameter = swept(file)
    if not columns:
        alone = any(data.shape == (1,) for data in history.values())
        usual: Sequence[str] = USUAL_OF_ONE if alone else USUAL_OF_TILT if parameter in ("tilt_x", "tilt_y") else USUAL
        if not alone:
            if "supply_flow" in history:
                usual = [name for name in USUAL_OF_SUPPLY if name in history][:MOST_USUAL]
            usual = next((names for limit, names in USUAL_OF_LIMITS.items() if limit in history), usual)
        columns = [name for name in usual if name in history]
        if not columns:  # of a machine: each result of each bearing
            columns = [name for name in history if name.startswith(USUAL_OF_MACHINES)]
        if not columns:
            stop(f"{path}: none of the usual columns is in it; name some, --list prints them")
    unknown = [name for name in columns if name not in history]
    if unknown:
        stop(f"{path}: no column {', '.join(unknown)}; there are: {', '.join(history)}")
    if len(history[columns[0]]) == 1:
        return draw_table(path, file, columns)
    if parameter is None and "step" in history:
        along, label = history["step"][...], "load step"
    elif parameter is not None and parameter in history or "key_value" in history:
        along, label = heat.along_of(history, parameter, used_keys(file))
    else:
        along, label = numpy.arange(1, len(history[columns[0]]) + 1), "row"
    charted = charts_of(history, columns, together)
    across = 1 if len(charted) == 1 else 2
    down = -(-len(charted)//across)
    figure, axes = pyplot.subplots(down, across, figsize=(5.0*across, 3.0*down + 0.4), squeeze=False,
                                   layout="constrained", sharex=True)
    for chart, names in zip(axes.flat, charted):
        for name in names:
            values, unit = readable(history[name])
            chart.plot(along, values, "o-", markersize=3.5, label=named(name, ""))
        chart.set_ylabel(f"[{unit}]" if len(names) > 1 else named(names[0], unit))
        chart.yaxis.set_major_locator(round_numbers(6))
        chart.xaxis.set_major_locator(round_numbers(6))
        if len(names) > 1:
            chart.legend(fontsize=8)
        chart.grid(alpha=0.3)
    for chart in axes.flat[len(charted):]:
        chart.set_visible(False)
    for chart in list(axes.flat)[max(0, len(charted) - across):len(charted)]:
        chart.set_xlabel(label)
        chart.tick_params(labelbottom=True)
    figure.suptitle(path.name.removesuffix(".h5"), fontsize=11)
    return figure


def draw_table(path, file, columns):
    """Numbers of a history of one point, which makes no curve."""
    numbers = {name: readable(file["history"][name]) for name in columns}
    largest: dict[str, float] = {}
    for values, unit in numbers.values():
        largest[unit] = max(largest.get(unit, 0.0), abs(values[0]))
    rows = [[named(name, ""), f"{values[0] if abs(values[0]) > ROUND_OFF*largest[unit] else 0.0:.5g}", "" if unit == "1" else unit]
            for name, (values, unit) in numbers.items()]
    figure, chart = pyplot.subplots(figsize=(6.0, 0.28*len(rows) + 1.0), layout="constrained")
    chart.axis("off")
    table = chart.table(rows, colWidths=(0.55, 0.25, 0.2), cellLoc="left", loc="center", edges="horizontal")
    table.auto_set_font_size(False)
    table.set_fontsize(10)
    table.scale(1.0, 1.35)
    for row in range(len(rows)):
        table[row, 1].set_text_props(ha="right")
        table[row, 2].set_text_props(ha="left")
    figure.suptitle(read_scene(file).title(path) if "summary" in file else case_name(path), fontsize=11)
    return figure
