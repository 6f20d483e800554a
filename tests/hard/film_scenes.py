"""Rigid bearings: thin films, bearing numbers over six decades, steep and stretched meshes, refusals."""

import math

import numpy

from hard_trial import merged, scene_book

SCENES, scene = scene_book()
PAD = {
    "scene": {"analysis": "fixed_position"},
    "bearing": {"radius": 0.02, "length": 0.04, "clearance": 2.0e-5},
    "gas": {"viscosity": 2.0e-5, "ambient_pressure": 1.0e5},
    "operation": {"speed_rpm": 0.0},
    "model": {"foil": "rigid"},
    "mesh": {"circumferential_elements": 128, "axial_elements": 8},
}
RING = merged(PAD, bearing={"leading_edge_condition": "periodic"})
# Opens along the motion; its rows are so far apart that the midplane's is that of an infinitely wide pad.
WEDGE = merged(PAD, bearing={"length": 20.0, "leading_edge_angle": math.pi},
               mesh={"axial_elements": 16})
EQUILIBRIUM = {"analysis": "equilibrium"}
C, HALF_LENGTH = 2.0e-5, 0.02
FORCE_UNIT = 1.0e5*0.04*0.04
CONTACT = {"roughness": 1.0e-6, "pressure": 5.0e7, "friction": 0.12}


def rpm(number):
    """Speed at a bearing number 6 mu Omega / p_a (R / C)^2."""
    return number*1.0e5/(6.0*2.0e-5)*(2.0e-5/0.02)**2*30.0/math.pi


def at(number, *eccentricity, **more):
    """Keys of a shaft held at an eccentricity ratio."""
    return {"speed_rpm": rpm(number), "eccentricity": tuple(C*e for e in eccentricity), **more}


def thin(eps, degrees):
    """An eccentricity ratio in a direction."""
    return eps*math.cos(math.radians(degrees)), eps*math.sin(math.radians(degrees))


def invariant(answer, eps):
    """Largest relative error of the mean of H^3 P^2 over the ring, which is 1 + 1.5 eps^2 at every z."""
    film = answer.film_arrays()
    mean = ((film["gap"]/C)**3*(film["pressure"]/1.0e5)**2)[:-1].mean(axis=0)
    return float(numpy.abs(mean/(1.0 + 1.5*eps**2) - 1.0).max())


@scene("Thin rigid films", "ring, eccentricity ratio 0.95", eps=0.95, elements=64)
@scene("Thin rigid films", "ring, eccentricity ratio 0.99", eps=0.99, elements=128)
@scene("Thin rigid films", "ring, eccentricity ratio 0.999", eps=0.999, elements=320)
def ring(trial, eps, elements):
    """Bearing number 1, elements of second order: the exact integral, and an error that shrinks with the mesh."""
    errors = [invariant(trial.solve(RING, operation=at(1.0, eps, 0.0), model={"film_order": 2},
                                    mesh={"circumferential_elements": n*elements, "axial_elements": 4*n}), eps)
              for n in (1, 2)]
    trial.below("integral of H^3 P^2", errors[1], 2.0e-3)
    trial.that(f"its error shrinks to a third or less: {errors[0]:.1e}, {errors[1]:.1e}", errors[1] < errors[0]/3.0)
    trial.says(f"exact integral to {errors[1]:.0e}")


@scene("Thin rigid films", "pad, 0.95: force as the load gives the position back", eps=0.95, elements=128)
@scene("Thin rigid films", "pad, 0.99: the same", eps=0.99, elements=256)
@scene("Thin rigid films", "pad, 0.999: the same", eps=0.999, elements=512)
def pad(trial, eps, elements):
    """From nothing, and from a start on the other side."""
    place, mesh = thin(eps, -40.0), {"circumferential_elements": elements, "axial_elements": 4}
    held = trial.solve(PAD, operation=at(1.0, *place), mesh=mesh)
    for start in ({}, {"eccentricity": (0.1*C, 0.3*C)}):
        found = trial.solve(PAD, scene=EQUILIBRIUM, mesh=mesh,
                            operation={"speed_rpm": rpm(1.0), "load": tuple(held.force), **start})
        trial.below("position given back", numpy.abs(found.eccentricity/C - place).max(), 1.0e-8)
    trial.says(f"position to 1e-8 C, from two starts, {math.hypot(*held.force):.0f} N")


@scene("Bearing numbers", "ring, 1e-3: force in proportion, at right angles to the eccentricity")
def slow(trial):
    """In the limit the film is Sommerfeld's."""
    answers = [trial.solve(RING, operation=at(number, 0.5, 0.0)) for number in (1.0e-3, 2.0e-3)]
    trial.below("force in proportion to the speed", math.hypot(*answers[1].force)/math.hypot(*answers[0].force)/2.0
                - 1.0, 1.0e-5)
    trial.below("attitude angle over 90 deg", answers[0]["attitude_angle"]/90.0 - 1.0, 1.0e-3)
    trial.says("linear to 1e-5, attitude 90 deg")


@scene("Bearing numbers", "ring, 0.1", number=0.1)
@scene("Bearing numbers", "ring, 10", number=10.0)
@scene("Bearing numbers", "ring, 100", number=100.0)
@scene("Bearing numbers", "ring, 1e3", number=1000.0)
def ring_number(trial, number):
    """Exact integral at an eccentricity ratio of 0.5."""
    error = invariant(trial.solve(RING, operation=at(number, 0.5, 0.0), model={"film_scheme": "galerkin"},
                                  mesh={"circumferential_elements": 192, "axial_elements": 16}), 0.5)
    trial.below("integral of H^3 P^2", error, 1.0e-3)
    trial.says(f"exact integral to {error:.0e}")


@scene("Bearing numbers", "ring, 1e3 and 1e4: P H at the midplane, the limit of high speed")
def fast(trial):
    for number, limit in (1.0e3, 3.0e-3), (1.0e4, 1.0e-3):
        film = trial.solve(RING, operation=at(number, 0.5, 0.0), model={"film_scheme": "supg"},
                           mesh={"circumferential_elements": 208, "axial_elements": 64}).film_arrays()
        product = (film["pressure"]*film["gap"])[:, 32]/(1.0e5*C)
        error = numpy.abs(product/math.sqrt(1.375) - 1.0).max()
        trial.below(f"P H at {number:g}", error, limit)
        trial.says(f"{number:g}: {error:.0e}")


def line_pressure(number, eps, points=20001):
    """Pressure of the infinitely wide pad from pi to 2 pi, by Runge-Kutta against the motion, where it is stable.

    P H^3 P' = number (P H - c), P = 1 at both ends; c by the secant method. Its least value.
    """
    angle = numpy.linspace(2.0*math.pi, math.pi, 2*points - 1)
    gap = (1.0 + eps*numpy.cos(angle)).tolist()
    step = -math.pi/(points - 1)

    def backward(c):
        def slope(p, h):
            return number*(p*h - c)/(p*h**3)
        p, least = 1.0, 1.0
        for i in range(0, 2*points - 2, 2):
            k1 = slope(p, gap[i])
            k2 = slope(p + 0.5*step*k1, gap[i + 1])
            k3 = slope(p + 0.5*step*k2, gap[i + 1])
            k4 = slope(p + step*k3, gap[i + 2])
            p += step*(k1 + 2.0*k2 + 2.0*k3 + k4)/6.0
            least = min(least, p)
        return p - 1.0, least

    one, other = gap[-1], 1.02*gap[-1]
    first, second = backward(one)[0], backward(other)[0]
    for _ in range(8):
        if abs(second) < 1.0e-12 or second == first:
            break
        one, other, first = other, other - second*(other - one)/(second - first), second
        second = backward(other)[0]
    return backward(other)[1]


@scene("High Peclet numbers", "opening wedge, Lambda 300, undershoot of both schemes", number=300.0, eps=0.5,
       elements=416)
@scene("High Peclet numbers", "shallow wedge, Lambda 100, the same", number=100.0, eps=0.1, elements=26)
@scene("High Peclet numbers", "shallow wedge, Lambda 1000, the same", number=1000.0, eps=0.1, elements=52)
def wedge(trial, number, eps, elements):
    """Before the trailing edge the pressure is far below ambient, and rises in a layer thinner than two elements."""
    least, found = line_pressure(number, eps), {}
    for scheme in "galerkin", "supg":
        film = trial.solve(WEDGE, operation=at(number, eps, 0.0), model={"film_scheme": scheme},
                           mesh={"circumferential_elements": elements}).film_arrays()
        found[scheme] = max(least - film["pressure"][:, 8].min()/1.0e5, 0.0)
    trial.that(f"Galerkin's undershoot {found['galerkin']:.1e} is larger than SUPG's {found['supg']:.1e}",
               found["galerkin"] > 2.0*found["supg"])
    trial.below("undershoot of SUPG, over the layer's jump", found["supg"]/(1.0 - least), 0.1)
    trial.says(f"below the exact least pressure of {least:.4f} p_a by {found['galerkin']:.1e} (Galerkin), "
               f"{found['supg']:.1e} (SUPG)")


@scene("High Peclet numbers", "opening wedge, Lambda 1000, 26 elements", elements=26, iterations=100)
@scene("High Peclet numbers", "the same, 416 elements", elements=416, iterations=100)
def coarse_wedge(trial, elements):
    """Galerkin's wiggles empty the film, which is told at once; upwinding, which is chosen by itself, has an answer."""
    mesh = {"circumferential_elements": elements}
    trial.refused(WEDGE, ("film_scheme = 'supg' has an answer",), operation=at(1000.0, 0.5, 0.0), model={"film_scheme": "galerkin"},
                  mesh=mesh)
    film = trial.solve(WEDGE, operation=at(1000.0, 0.5, 0.0), mesh=mesh).film_arrays()
    least = line_pressure(1000.0, 0.5)
    under = max(least - film["pressure"][:, 8].min()/1.0e5, 0.0)
    trial.below("automatic choice: undershoot over the layer's jump", under/(1.0 - least), 0.1)
    trial.says(f"automatic choice: below the exact least pressure by {under:.1e} p_a")


@scene("Touch-down", "ring, half of what its thinnest film carries: an answer; twice: refused",
       iterations=1000)
def touch_down(trial):
    """The force rises with the eccentricity: what the smallest film allowed carries bounds the load."""
    force = [math.hypot(*trial.solve(RING, operation=at(1.0, eps, 0.0)).force) for eps in (0.9, 0.99, 0.999, 0.9999)]
    trial.that("the force rises with the eccentricity", all(numpy.diff(force) > 0.0))
    load = {"speed_rpm": rpm(1.0)}
    found = trial.balanced(RING, scene=EQUILIBRIUM, operation={**load, "load": (-0.5*force[-1], 0.0)})
    trial.within("eccentricity ratio", math.hypot(*found.eccentricity)/C, 0.9, 0.9999)
    refused = trial.refused(RING, scene=EQUILIBRIUM, operation={**load, "load": (-2.0*force[-1], 0.0)})
    trial.that("what was reached carries less", math.hypot(*refused.force) <= 1.001*force[-1])


@scene("Touch-down", "pad, 1e7 N with &shaft_contact: more than it can carry with no film left",
       iterations=2000)
def beyond_contact(trial):
    """p_0 over the projected area is 8e4 N: refused; half as much as the asperities carry at 0.99 C: an answer."""
    case = merged(PAD, shaft_contact=CONTACT)
    trial.refused(case, scene=EQUILIBRIUM, operation={"speed_rpm": 100.0, "load": (-1.0e7, 0.0)})
    held = trial.solve(case, operation=at(0.01, *thin(0.99, -30.0)))
    found = trial.balanced(case, scene=EQUILIBRIUM, operation={"speed_rpm": rpm(0.01), "load": tuple(0.5*held.force)})
    trial.that("it touches", found["maximum_solid_contact_pressure"] > 1.0e4)


@scene("Touch-down", "pad with &shaft_contact, 1 N to 1 kN, 1,000 rpm: balance, thinner and thinner")
def light_to_heavy(trial):
    case, gaps = merged(PAD, scene=EQUILIBRIUM, shaft_contact=CONTACT), []
    for load in 1.0, 30.0, 1000.0:
        gaps.append(trial.balanced(case, operation={"speed_rpm": 1000.0, "load": (-load, 0.2*load)})["minimum_gap"])
    trial.that("heavier loads make thinner films", gaps[0] > gaps[1] > gaps[2] > 0.0)
    trial.says(f"balance; gaps {gaps[0]*1e6:.1f}, {gaps[1]*1e6:.1f}, {gaps[2]*1e6:.2f} um")


@scene("Tilt", "centred, 0.9 of the tilt at which the ends touch", ratio=0.9)
@scene("Tilt", "the same, 0.999", ratio=0.999)
def tilted(trial, ratio):
    """Mirrored tilts give mirrored films; the smallest gap is the plane geometry's."""
    tilt = ratio*C/HALF_LENGTH
    case = merged(PAD, mesh={"axial_elements": 31, "circumferential_elements": 96})
    answers = [trial.solve(case, operation=at(2.0, 0.0, 0.0, tilt=(0.0, sign*tilt))) for sign in (1.0, -1.0)]
    trial.below("torque is odd", numpy.abs(answers[0].torque + answers[1].torque).max()/numpy.abs(answers[0].torque).max(),
                1.0e-8)
    trial.below("smallest gap", (answers[0]["minimum_gap"] - (1.0 - ratio)*C)/C, 1.0e-9)
    first, second = (answer.film_arrays()["pressure"] for answer in answers)
    trial.below("mirrored film", numpy.abs(first[:, ::-1]/second - 1.0).max(), 1.0e-8)
    trial.says(f"mirrored, gap {(1.0 - ratio)*C*1e9:.0f} nm")


@scene("Tilt", "no position is free at 1.01 of it: refused")
def tilted_beyond(trial):
    """At any eccentricity one end's film is below zero."""
    trial.refused(PAD, ("must stay below the clearance",), status=1, scene=EQUILIBRIUM, mesh={"axial_elements": 16},
                  operation={"speed_rpm": rpm(2.0), "load": (-10.0, 0.0), "tilt": (0.0, 1.01*C/HALF_LENGTH)})


@scene("Tilt", "sweep to 0.99 of it under 41 N: thinner and thinner, then refused for touching down", iterations=600)
def tilt_sweep(trial):
    """Balance at every point there is; the last state's film is all but gone."""
    limit = C/HALF_LENGTH
    parts = (0.0, 0.3, 0.5, 0.7, 0.8, 0.99)
    answer = trial.refused(PAD, ("touches down",), scene=EQUILIBRIUM,
                           operation={"speed_rpm": rpm(2.0), "load": (-40.0, 10.0)},
                           sweep={"parameter": "tilt_x", "values": tuple(limit*part for part in parts)},
                           mesh={"axial_elements": 16, "circumferential_elements": 96})
    rows = answer.history()
    wrong = numpy.hypot(rows["force_x"] + 40.0, rows["force_y"] - 10.0).max()
    trial.below("balance", wrong/math.hypot(40.0, 10.0), 1.0e-6)
    trial.that("points before", len(rows["tilt_x"]) == 5)
    trial.that("thinner and thinner", all(numpy.diff(rows["minimum_gap"]) < 0.0))
    trial.below("last state's film over C", answer["minimum_gap"]/C, 1.0e-2)
    trial.says(f"gap at 0.8 of it {1e6*rows['minimum_gap'][-1]:.2f} um")


@scene("Meshes and steps", "ring 1e-3 as long as wide, elements 400 times as long as wide: the narrow bearing's "
       "closed form")
def narrow(trial):
    """d/dz(P h^3 dP/dz) = source: for a narrow, slow bearing p - p_a = 3 mu U' h'/(R h^3) (L^2/4 - z^2)."""
    length, number, eps = 4.0e-5, 1.0e-2, 0.5
    answer = trial.solve(RING, bearing={"length": length}, operation=at(number, eps, 0.0),
                         mesh={"circumferential_elements": 128, "axial_elements": 16})
    film = answer.film_arrays()
    theta, z = film["theta"], film["z"]
    omega = rpm(number)*math.pi/30.0
    gap = C*(1.0 + eps*numpy.cos(theta))
    wanted = -3.0*2.0e-5*omega*(-C*eps*numpy.sin(theta))/gap**3*(0.25*length**2 - z**2)
    found = film["pressure"] - 1.0e5
    error = numpy.abs(found - wanted).max()/numpy.abs(wanted).max()
    trial.below("pressure", error, 3.0e-3)
    trial.says(f"pressure to {error:.0e}")


@scene("Meshes and steps", "unequal steps of speed, 60,000 to 100 rpm and back: each point as from a cold start")
def unequal(trial):
    speeds = (60000.0, 59999.0, 200.0, 100.0, 30000.0)
    case = merged(PAD, scene=EQUILIBRIUM, operation={"load": (-2.0, 0.5), "speed_rpm": speeds[0]})
    rows = trial.solve(case, sweep={"parameter": "speed_rpm", "values": speeds}).history()
    for i in (2, 3, 4):
        cold = trial.balanced(case, operation={"speed_rpm": speeds[i]})
        found = numpy.array([rows["eccentricity_x"][i], rows["eccentricity_y"][i]])
        trial.below(f"point {i + 1}", numpy.abs(found - cold.eccentricity).max()/C, 1.0e-7)
    trial.says("as from cold starts")
