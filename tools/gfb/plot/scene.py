"""What a picture says of the scene beside its data: load, speed and model, where the load points, words for names."""

import dataclasses
import math
from typing import Optional

import numpy

from gfb import steps
from gfb.case import Case
from gfb.report.grooves import groove_lines
from gfb.report.sketch import Bearing
from gfb.results import BROKEN, open_results, text_of, used_keys

MODELS = {"rigid": "rigid", "elastic_foundation": "elastic foundation", "beam": "beams", "shell": "shells", "plate": "plate on crests"}
WORDS = {"speed_rpm": "speed", "attitude_angle": "attitude angle", "load_angle": "angle of the load", "minimum_gap": "thinnest film",
         "minimum_gap_midplane": "thinnest film, midplane", "minimum_gap_edge": "thinnest film, edges", "eccentricity_x": "e_x",
         "eccentricity_y": "e_y", "axial_eccentricity": "e_z", "torque_x": "torque about x", "torque_y": "torque about y",
         "force_x": "force along x",
         "force_y": "force along y", "tilt_x": "tilt about x", "tilt_y": "tilt about y", "maximum_pressure": "largest pressure, absolute",
         "minimum_pressure": "smallest pressure, absolute", "axial_gap": "axial gap", "axial_force": "axial force",
         "load_capacity_coefficient": "coefficient", "lift_off_speed_rpm": "lift-off speed", "lift_off_supply_pressure": "lift-off supply pressure"}
MOVING = ("transient", "periodic")  # analyses in which the film's force changes and the load stays
NEAR = 1.0e-4  # of the film's force: a load that differs less is it
MOST_PADS = 1000  # more are none of gfb
SAME = 1.0e-9  # of the largest value: edges that differ less are one line


@dataclasses.dataclass
class Scene:
    """Of the case file beside a grid file; empty where there is none, or none that can be read."""

    words: str = ""           # load, speed and model
    load_angle: Optional[float] = None  # theta at which the load presses the shaft [deg]
    radius: Optional[float] = None      # of the shaft [m]
    begins: tuple = (0.0,)    # theta where each pad begins [deg]
    frequencies: dict = dataclasses.field(default_factory=dict)  # mode_1: natural frequency [Hz]
    grooves: tuple = ()                 # lines along grooves, points (theta [rad], z or radius [m])
    holes: tuple = ()                   # (theta [deg], z or radius [m]) of the orifices that feed the film

    def title(self, path):
        """The case's name, and these words."""
        return ": ".join(filter(None, (case_name(path), self.words)))


def case_name(path):
    """What the names of a run's files begin with: CASE, of branches CASE.branches.1."""
    return path.name.removesuffix(".h5") if path.suffix == ".h5" else path.name.rsplit(".", 2)[0]


def scene_of(path):
    """The scene of CASE.h5 beside CASE.film.vtkhdf, CASE.top_foil.vtkhdf or CASE.bump_foil.vtkhdf."""
    case = path.with_name(case_name(path) + ".h5")
    try:
        with open_results(case) as file:
            return read_scene(file)
    except BROKEN:
        return Scene()  # the picture is of another file


def read_scene(file):
    """The same of an open case file."""
    keys, summary, scene = used_keys(file), file["summary"], Scene()
    scene.frequencies = {f"mode_{name.removeprefix('frequency_')}": float(data[()]) for name, data in summary.items()
                         if name.startswith("frequency_")}
    if not {("bearing", "radius"), ("bearing", "outer_radius")} & set(keys):  # a strip
        return scene
    scene.radius = number(keys, "bearing", "radius")
    scene.begins = tuple(map(math.degrees, leading_edges(keys)))
    if {("grooves", "on"), ("feed", "kind")} & set(keys):
        bearing = Bearing(Case.parse(text_of(file["scene/used"][()])))
        scene.grooves = tuple(groove_lines(bearing))
        scene.holes = tuple((math.degrees(angle), along) for angle, along in bearing.holes().values())
    words, history = [], file["history"]
    if "force_x" in summary and "force_y" in summary:
        force = complex(summary["force_x"][()], summary["force_y"][()])
        load = load_of(keys, history, force)
        pressing = force if load is None else load
        words.append(f"{'film force' if load is None else 'load'} {abs(pressing):.4g} N")
        scene.load_angle = math.degrees(math.atan2(pressing.imag, pressing.real)) if abs(pressing) > 0.0 else None
    if "axial_force" in summary:
        words.append(f"{summary['axial_force'][()]:.4g} N on {int(number(keys, 'pads', 'count') or 1)} pads")
    speed = history["speed_rpm"][-1] if "speed_rpm" in history else number(keys, "operation", "speed_rpm")
    if speed is not None:
        words.append(f"{speed:,.0f} rpm")
    model = keys.get(("model", "foil"), ("",))[0].strip("'")
    scene.words = ", ".join(filter(None, [*words, MODELS.get(model, model)]))
    return scene


def load_of(keys, history, force):
    """The load that is asked for [N], None where none is: a shaft that moves has another film force, a balanced one the load's, and one
    that is fixed, as in a sweep of tilt, the film's force alone."""
    given = complex(*map(float, keys["operation", "load"][0].split(","))) if ("operation", "load") in keys else None
    if keys.get(("scene", "analysis"), ("",))[0].strip("'") in MOVING:
        return given
    size = history["load"][-1] if "load" in history else numpy.nan if given is None else abs(given)
    return force if abs(size - abs(force)) <= NEAR*abs(force) else None


def leading_edges(keys):
    """theta where each pad of an echo begins [rad]."""
    count = int(number(keys, "pads", "count") or 1)
    if not 0 < count <= MOST_PADS:
        raise ValueError(f"scene/used: {count} pads")
    first = number(keys, "pads", "first_leading_edge")
    if first is None:
        first = number(keys, "bearing", "leading_edge_angle") or 0.0
    return tuple(first + 2.0*math.pi*pad/count for pad in range(count))


def pad_of(name):
    """The pad of a foil that is called top_foil_2 or bump_foil_2; without a number the only one."""
    ending = name.rpartition("_")[2]
    return int(ending) if ending.isdigit() else 1


def of_pad(values, pad):
    """What belongs to a pad; pads are counted on through the bearings of a rotor."""
    return values[(pad - 1) % len(values)]


def number(keys, group, key):
    """A number of the echo; None where it is not in it."""
    return float(keys[group, key][0]) if (group, key) in keys else None


# --- words ---

def named(name, unit):
    """A result's name as an axis has it."""
    words = WORDS.get(name, name.replace("_", " "))
    return words if unit in ("", "1") else f"{words} [{unit}]"


def step_words(file, step):
    """Which value a step, from 0, has, such as 'speed = 30000 rpm'."""
    name, unit, number_there = steps.value(file, step)
    return f"{named(name, '')} = {number_there:.6g}{'' if unit == '1' else f' {unit}'}"


# --- colours and lines ---

def draw_edges(chart, along, values, z):
    """Lines along both edges, or one where they are the same; z in mm."""
    if numpy.nanmax(numpy.abs(values[:, 0] - values[:, -1])) <= SAME*numpy.nanmax(numpy.abs(values)) and abs(z[0] + z[-1]) <= SAME*abs(z[-1]):
        chart.plot(along, values[:, -1], "--", label=f"edges, z = +-{z[-1]:.4g} mm")
        return
    for edge, style in ((-1, "--"), (0, ":")):
        chart.plot(along, values[:, edge], style, label=f"edge, z = {z[edge]:.4g} mm")


def theta_above(chart, scene, pad=1):
    """A second axis, theta, above that of x [mm] of the foils of a pad."""
    if scene.radius is None:
        return
    begin, per_mm = of_pad(scene.begins, pad), math.degrees(1.0e-3/scene.radius)
    axis = chart.secondary_xaxis("top", functions=(lambda x: begin + x*per_mm, lambda theta: (theta - begin)/per_mm))
    axis.set_xlabel("theta [deg]", fontsize=9)
    apart = 60.0 if len(scene.begins) == 1 else 20.0
    axis.set_xticks(numpy.arange(apart*math.ceil(begin/apart), begin + 361.0, apart))
