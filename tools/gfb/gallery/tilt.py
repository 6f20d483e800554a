"""Answers of the tilted bearing of [Gu2020] section 4.3, and what the paper's text says of them."""

import dataclasses

import numpy

from gfb.gallery.bearing import COARSER_MESH, MICRO, PAPER_MESH, ambient, lifted
from gfb.gallery.page import Page

MODELS = {"beam": "beams (2D)", "shell": "shells (3D)"}
TILT = 2.0e-4  # of figs. 12 and 13 [rad]
HELD = {"sweep.values": TILT}  # a sweep of this tilt alone
N_MM = 1.0e3
BEHIND = 270.0  # end of the film [deg]
BEFORE = 90.0   # its beginning [deg]
# Criteria of the judgements.
LINEAR = 0.05     # departure from a straight line through zero, over the largest torque
SYMMETRIC = 0.15  # asymmetry of the sub-ambient part below which it is near-symmetric
FAR = 0.25        # of the half width: beyond it the peak has moved towards the edge
HALF = 0.5        # of the rigid gap's antisymmetric part: below it the film is relatively symmetrical


@dataclasses.dataclass
class Answer:
    """One branch on one mesh: both models, tilted about either axis."""

    name: str
    sweeps: dict  # (model, axis): result of the sweep; that about y ends at TILT, so its film is the one there

    @property
    def held(self):
        """{model: result} at TILT about y."""
        return {model: self.sweeps[model, "y"] for model in MODELS}


def answers(runs):
    """Answers on both meshes, on a coarser one on the lifted branch, and words on what was not found."""
    found = [resting(runs, "default mesh", {}), resting(runs, "paper's mesh", PAPER_MESH)]
    sweeps, missed = {}, []
    for model, axis, case in cases():
        if missed:
            break
        one, words = lifted(runs, model, case, COARSER_MESH)
        if one is None or not one.converged:
            missed.append(f"Lifted branch on a coarser mesh, {MODELS[model]} tilted about {axis}: {words}.")
        sweeps[model, axis] = one
    if not missed:
        found.append(Answer("lifted, coarser mesh (104 x 16, bumps of 6 + 2)", sweeps))
    return found, missed


def resting(runs, mesh, changes):
    """The answer on the resting branch."""
    return Answer(f"resting, {mesh}", {(model, axis): runs.run(case, changes) for model, axis, case in cases()})


def cases():
    """Model, axis of the tilt and case of all sweeps."""
    return [(model, axis, f"gu2020_{figure}_{model}") for model in MODELS
            for axis, figure in (("x", "fig11a"), ("y", "fig11b"))]


# --- numbers of an answer ---

def curve(result, axis, name):
    """Tilts of a sweep, growing [rad], and a column of its history."""
    tilt = result.history[f"tilt_{axis}"]
    order = numpy.argsort(tilt)
    return tilt[order], result.history[name][order]


def tilts(result, axis):
    """Tilts of a sweep, growing [rad]."""
    return numpy.sort(result.history[f"tilt_{axis}"])


def torque_at(result, axis, name, tilt=TILT):
    """A torque of a sweep at a tilt [N m]; nan where the sweep did not come there."""
    there, torque = curve(result, axis, name)
    at = numpy.flatnonzero(numpy.isclose(there, tilt))
    return torque[at[0]] if len(at) else numpy.nan


def radians(tilt):
    """A tilt in words."""
    return f"{round(1.0e4*tilt, 3):g}e-4 rad"


def stiffness(result, axis, name):
    """Slope of a torque at zero tilt, from the smallest tilt of the sweep [N m/rad]."""
    tilt = tilts(result, axis)
    smallest = numpy.min(tilt[tilt > 0.0])
    return (torque_at(result, axis, name, smallest) - torque_at(result, axis, name, 0.0))/smallest


def departure(result, axis, name):
    """Largest departure of a torque from the best straight line through zero, over its largest value."""
    tilt, torque = curve(result, axis, name)
    slope = (tilt @ torque)/(tilt @ tilt)
    return numpy.abs(torque - slope*tilt).max()/numpy.abs(torque).max()


def place_of_peak(result):
    """theta [deg] and z [mm] of the largest pressure."""
    pressure = result.film.fields["pressure"]
    station, row = numpy.unravel_index(pressure.argmax(), pressure.shape)
    return result.film.theta[station], 1.0e3*result.film.z[row]


def weights(film):
    """Trapezoid weights of stations and rows."""
    def along(x):
        return 0.5*(numpy.diff(x, prepend=x[0]) + numpy.diff(x, append=x[-1]))
    return along(film.theta)[:, None]*along(film.z)[None, :]


def asymmetry(result):
    """Of the sub-ambient part s = max(p_a - p, 0): integral of |s(z) - s(-z)| over that of s(z) + s(-z)."""
    film = result.film
    part = numpy.maximum(ambient(result) - film.fields["pressure"], 0.0)
    weight = weights(film)
    whole = (weight*(part + part[:, ::-1])).sum()
    return (weight*numpy.abs(part - part[:, ::-1])).sum()/whole if whole > 0.0 else 0.0


def antisymmetric(result, region):
    """Root mean square of h(z) - h(-z) where `region` says, over that of the rigid gap."""
    film = result.film
    gap = film.fields["gap"]
    rigid = gap - film.fields["deflection"]
    there = weights(film)*region
    parts = [numpy.sqrt((there*(field - field[:, ::-1])**2).sum()) for field in (gap, rigid)]
    return parts[0]/parts[1]


def regions(result):
    """{words: where}, masks on (station, row)."""
    film = result.film
    everywhere = numpy.ones(film.fields["gap"].shape, dtype=bool)
    suction = film.fields["pressure"] < ambient(result)
    return {"0 to 90 degrees": everywhere & (film.theta < BEFORE)[:, None],
            "270 to 360 degrees": everywhere & (film.theta > BEHIND)[:, None],
            "where p < p_a": suction | suction[:, ::-1]}


# --- what the text says: (truth, numbers) of an answer ---

def of_models(words):
    """Numbers of both models, in words."""
    return ", ".join(f"{MODELS[model]} {words(model)}" for model in MODELS)


def linear(answer, axis, names="xy"):
    """Whether torques grow nearly linearly with a tilt."""
    off = {(model, name): departure(answer.sweeps[model, axis], axis, f"torque_{name}")
           for model in MODELS for name in names}
    far = min(tilts(answer.sweeps[model, axis], axis).max() for model in MODELS)
    return (max(off.values()) < LINEAR, of_models(lambda model: ", ".join(
        f"M_{name} {100.0*off[model, name]:.1f} %" for name in names)) + f" up to {radians(far)}")


def largest(answer):
    """Whether M_y under a tilt about y is the largest torque at the same tilt."""
    truth, words = True, {}
    for model in MODELS:
        values = {(name, axis): abs(torque_at(answer.sweeps[model, axis], axis, f"torque_{name}"))
                  for axis in "xy" for name in "xy"}
        truth = truth and max(values, key=values.get) == ("y", "y")
        words[model] = ", ".join(f"M_{name}(phi_{axis}) {N_MM*value:.0f}" for (name, axis), value in values.items())
    return truth, of_models(words.get) + f" N mm at {radians(TILT)}, without sign"


def stiffer(answer, axes="xy"):
    """Whether the beams' angular stiffness is larger."""
    slope = {(model, axis): stiffness(answer.sweeps[model, axis], axis, f"torque_{axis}")
             for model in MODELS for axis in axes}
    return (all(slope["beam", axis] > slope["shell", axis] for axis in axes),
            of_models(lambda model: ", ".join(f"dM_{axis}/dphi_{axis} {slope[model, axis]:.0f}" for axis in axes))
            + " N m/rad")


def higher_peak(answer):
    """Whether the beams' largest pressure is larger."""
    peak = {model: one["maximum_pressure"]/ambient(one) for model, one in answer.held.items()}
    return peak["beam"] > peak["shell"], of_models(lambda model: f"{peak[model]:.3f} p_a")


def thinner(answer):
    """Whether the beams' smallest film is thinner."""
    film = {model: MICRO*one["minimum_gap"] for model, one in answer.held.items()}
    return film["beam"] < film["shell"], of_models(lambda model: f"{film[model]:.2f} um")


def moves_out(answer):
    """Whether, with the tilt about y, the film gets thinner, and the peak pressure larger and nearer to an edge."""
    truth, words = True, {}
    for model in MODELS:
        sweep = answer.sweeps[model, "y"]
        films, peaks = (curve(sweep, "y", name)[1] for name in ("minimum_gap", "maximum_pressure"))
        place = place_of_peak(sweep)[1]
        truth = (truth and (numpy.diff(films) < 0.0).all() and (numpy.diff(peaks) > 0.0).all()
                 and abs(place) > FAR*half(sweep))
        words[model] = (f"{MICRO*films[0]:.2f} to {MICRO*films[-1]:.2f} um, {peaks[0]/ambient(sweep):.2f} to "
                        f"{peaks[-1]/ambient(sweep):.2f} p_a, peak at z = {place:.1f} mm at {radians(TILT)}")
    return bool(truth), of_models(words.get)


def half(result):
    """Half the bearing's length [mm]."""
    return 1.0e3*result.film.z[-1]


def cross_torques(answer, name="torque_x"):
    """{model: M_x under the tilt about y} [N mm]."""
    return {model: N_MM*answer.held[model][name] for model in MODELS}


def opposite(answer):
    """Whether M_x under a tilt about y has opposite signs."""
    torque = cross_torques(answer)
    return torque["beam"]*torque["shell"] < 0.0, of_models(lambda model: f"{torque[model]:+.1f} N mm")


def turns(answer):
    """Whether the beams' M_x under a tilt about y is positive, and negative without the sub-ambient pressure."""
    whole, part = cross_torques(answer), cross_torques(answer, "torque_x_without_suction")
    return (whole["beam"] > 0.0 > part["beam"],
            of_models(lambda model: f"{whole[model]:+.1f} and without suction {part[model]:+.1f} N mm"))


def symmetric(answer):
    """Whether the sub-ambient pressure is near-symmetric for shells only."""
    one = {model: asymmetry(answer.held[model]) for model in MODELS}
    return one["shell"] < SYMMETRIC <= one["beam"], of_models(lambda model: f"{one[model]:.2f}")


def even_film(answer):
    """Whether the shells' film is relatively symmetrical at its beginning and end, where the beams' is not."""
    parts = {model: {words: antisymmetric(one, where) for words, where in regions(one).items()}
             for model, one in answer.held.items()}
    ends = list(regions(answer.held["shell"]))[:2]
    return (all(parts["shell"][words] < HALF <= parts["beam"][words] for words in ends),
            of_models(lambda model: ", ".join(f"{value:.2f} ({words})" for words, value in parts[model].items())))


STATEMENTS = {  # key: the paper's statement, criterion, its judge
    "linear_x": ("torque against tilt is nearly linear (tilt about x).",
                 f"departure from a straight line through zero below {100*LINEAR:.0f} % of the largest torque",
                 lambda answer: linear(answer, "x")),
    "linear_y": ("torque against tilt is nearly linear (tilt about y, M_y).",
                 f"departure from a straight line through zero below {100*LINEAR:.0f} % of the largest torque",
                 lambda answer: linear(answer, "y", "y")),
    "linear_y_of_x": ("torque against tilt is nearly linear (tilt about y, M_x).",
                      f"departure from a straight line through zero below {100*LINEAR:.0f} % of the largest M_x",
                      lambda answer: linear(answer, "y", "x")),
    "largest": ("M_y at a tilt phi_y is the largest torque at the same tilt.", "its size", largest),
    "stiffer_x": ("the angular stiffness is larger for the 2D foils (about x).", "slope at zero tilt",
                  lambda answer: stiffer(answer, "x")),
    "stiffer_y": ("the angular stiffness is larger for the 2D foils (about y).", "slope at zero tilt",
                  lambda answer: stiffer(answer, "y")),
    "peak": ("the peak pressure is larger for the 2D foils at the same tilt.", "its size", higher_peak),
    "thinner": ("the smallest film is thinner for the 2D foils.", "its size", thinner),
    "moves": ("with the tilt about y the smallest film gets thinner, the peak pressure larger, and it moves towards "
              "the edge of the bearing.",
              f"from point to point; the peak beyond {100*FAR:.0f} % of the half width, where without tilt it is "
              "symmetric to z = 0", moves_out),
    "opposite": ("the signs of M_x under a tilt about y are opposite for 2D and 3D foils.", "its sign", opposite),
    "turns": ("without the sub-ambient pressure the M_x of the 2D foils becomes negative.", "its signs", turns),
    "symmetric": ("the sub-ambient pressure is almost symmetric about z = 0 for the 3D foils, and not for the 2D ones.",
                  "asymmetry, the integral of abs(s(z) - s(-z)) over that of s(z) + s(-z) with s = max(p_a - p, 0): 0 "
                  f"is symmetric, 1 one-sided; below {SYMMETRIC} is near-symmetric", symmetric),
    "even": ("the 3D foils' film is relatively symmetrical about z = 0 from 0 to 90 and from 270 to 360 degrees.",
             f"root mean square of h(z) - h(-z) over that of the rigid gap; at most {HALF} for the shells, more for "
             "the beams",
             even_film),
}


def judge(page, found, keys):
    """Judges some of the statements of all answers."""
    for key in keys:
        statement, criterion, of = STATEMENTS[key]
        judged = {answer.name: of(answer) for answer in found}
        page.judge(statement, {name: truth for name, (truth, _) in judged.items()},
                   " ".join(f"{name.capitalize()}: {numbers}." for name, (_, numbers) in judged.items())
                   + f" (Criterion: {criterion}.)")


def draw_statements(runs, folder):
    """All statements of section 4.3, of every answer."""
    page = Page("section43", "[Gu2020] section 4.3: the text's statements on the tilted bearing, yes or no", folder)
    found, missed = answers(runs)
    for answer in found:
        page.took(list(answer.sweeps.values()))
    rows, yes = [], {answer.name: 0 for answer in found}
    for statement, criterion, of in STATEMENTS.values():
        row = [f"{statement} ({criterion})"]
        for answer in found:
            truth, numbers = of(answer)
            yes[answer.name] += bool(truth)
            row.append(f"**{'yes' if truth else 'no'}**: {numbers}")
        rows.append(row)
    page.say("The shaft is fixed at its aligned position under 100 N at 30,000 rpm and tilted. Where no tilt is named "
             f"it is phi_y = {radians(TILT)}. Pictures and tables: [fig. 11a](fig11a.md), [fig. 11b](fig11b.md), [fig. "
             "12](fig12.md), [fig. 13](fig13.md). Resting: the free leading edge lies on the bumps; lifted: it stands "
             "off them.")
    page.table("Statement (criterion), and gfb's answers", ["statement", *(answer.name for answer in found)], rows,
               words=1 + len(found))
    if missed:
        page.items(missed)
    page.short = ("yes to " + ", ".join(f"{count} of {len(STATEMENTS)} ({name})" for name, count in yes.items()) + ".")
    page.head("What the paper leaves open")
    page.items(["Which equilibrium the shaft is fixed at: see [the page of positions](positions.md).",
                "Up to which tilt the curves go: here 3e-4 rad; fig. 12 has 2e-4.",
                "Friction acts as a vector in the tangent plane. Along the motion alone (`friction_direction = 'motion'`) the "
                "shells' torques are up to about a fifth smaller: [fig. 11a](fig11a.md), [fig. 11b](fig11b.md).",
                "How near \"nearly linear\", \"almost symmetric\" and \"relatively symmetrical\" are: the criteria "
                "above are the gallery's.",
                "The mesh of the 2D foils, and whether any mesh is converged: statements whose answers differ between "
                "the two meshes are not settled by the paper's mesh. The pages of the figures vary friction, contact, "
                "fixed edges and mesh."])
    page.parameters(found[0].sweeps["shell", "y"],
                    "[inputs](../../../inputs): `gu2020_fig11a_beam.nml`, `.._shell.nml`, `gu2020_fig11b_beam.nml`, "
                    "`.._shell.nml` (shown); at one tilt with `values = 2e-4`.")
    return page
