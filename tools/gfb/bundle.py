"""A proximal bundle method: the smallest value of a function with kinks, under constraints with kinks, from values and one-sided gradients.

Each run leaves a tangent plane; the model of a function is the largest of its planes, so what the other side of a kink looks like
is known once a trial has been there. A step minimises the model plus the squared length of the step over twice its reach. Planes of
a function that is not convex pass the centre above its value: they are let down by twice that, by the square of their distance at least.
"""

from __future__ import annotations

import dataclasses
import warnings
from collections.abc import Callable

import numpy

Function = Callable[[numpy.ndarray], "tuple[numpy.ndarray, numpy.ndarray] | None"]

ENOUGH = 0.1         # of the gain promised, for a trial to become the centre
GOOD = 0.7           # of it, for a longer reach
LONGER, SHORTER = 2.0, 0.4
LET_DOWN = 0.05      # of a plane, over the square of its distance: a little of the curvature that scaled functions have
MOST_PLANES = 40     # the nearest of them
PENALTY = 10.0       # of the largest violation, at first; more where a step would pay for breaking a bound
MOST_PENALTY = 1.0e4
FIRST_REACH, LONGEST_REACH, SMALLEST_REACH = 1.0, 100.0, 1.0e-8
MOST_STEPS = 2000    # of the models, which cost no run; a search that has not ended by then goes to and fro


@dataclasses.dataclass
class Plane:
    """What a run has given: objective first, then constraints, which shall not be positive."""

    place: numpy.ndarray
    values: numpy.ndarray
    gradients: numpy.ndarray  # (functions, variables)


def minimise(function: Function, start: numpy.ndarray, tolerance: float) -> str:
    """From a start with an answer, over variables from 0 to 1, until the model promises less than the tolerance; why it ended.
    The function has objective and constraints with their gradients, or None where there is no answer."""
    centre = plane_at(function, start)
    if centre is None:
        raise ValueError("there is no answer at the start")
    planes, reach, penalty = [centre], FIRST_REACH, PENALTY
    furthest = reach  # that a search with little promise looks: less where there was no answer
    for _ in range(MOST_STEPS):
        if reach < SMALLEST_REACH:
            break
        step, promised = best_step(planes, centre, reach, penalty)
        if promised <= tolerance and reach < furthest:
            reach = min(LONGER*reach, furthest)
            continue
        if promised <= tolerance:
            if worst(centre.values) <= tolerance or penalty >= MOST_PENALTY:
                return "nothing more is promised"
            penalty *= 10.0
            continue
        trial = plane_at(function, numpy.clip(centre.place + step, 0.0, 1.0))
        if trial is None:
            reach *= SHORTER
            furthest = reach
            continue
        gain = merit(centre.values, penalty) - merit(trial.values, penalty)
        planes.append(trial)
        if gain > ENOUGH*promised and worst(trial.values) > worst(centre.values) + tolerance and penalty < MOST_PENALTY:
            penalty *= 10.0
        elif gain > ENOUGH*promised:
            centre = trial
            reach = min(LONGER*reach, LONGEST_REACH) if gain > GOOD*promised else reach
        elif gain < -promised or promise(planes, centre, step, penalty) > 0.5*promised:  # too far for the planes, or let down too much
            reach *= SHORTER
        planes = sorted(planes, key=lambda plane: float(numpy.sum((plane.place - centre.place)**2)))[:MOST_PLANES]
    return "no step improves the best run"


def plane_at(function: Function, place: numpy.ndarray) -> Plane | None:
    """What a run gives; None where there is no answer."""
    found = function(place)
    return None if found is None else Plane(place, *found)


def worst(values: numpy.ndarray) -> float:
    """The largest violation."""
    return max(0.0, float(numpy.max(values[1:], initial=0.0)))


def merit(values: numpy.ndarray, penalty: float) -> float:
    """Objective, and the largest violation at its price."""
    return float(values[0]) + penalty*worst(values)


def models(planes: list[Plane], centre: Plane) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Slopes (planes, functions, variables) and values at the centre (planes, functions) of what lies below each function."""
    slopes = numpy.array([plane.gradients for plane in planes])
    ways = numpy.array([centre.place - plane.place for plane in planes])
    values = numpy.array([plane.values for plane in planes]) + numpy.einsum("pfn,pn->pf", slopes, ways)
    below = numpy.maximum(abs(centre.values - values), LET_DOWN*numpy.sum(ways**2, axis=1)[:, None])
    return slopes, centre.values - below


def promise(planes: list[Plane], centre: Plane, step: numpy.ndarray, penalty: float) -> float:
    """What the models say that a step gains."""
    slopes, values = models(planes, centre)
    return merit(centre.values, penalty) - merit(numpy.max(values + slopes @ step, axis=0), penalty)


def best_step(planes: list[Plane], centre: Plane, reach: float, penalty: float) -> tuple[numpy.ndarray, float]:
    """The step that the models and the reach make best, and what it promises. Unknowns: step, objective, violation."""
    from scipy.optimize import minimize

    slopes, values = models(planes, centre)
    count = centre.place.size
    rows = slopes.reshape(-1, count)
    of_objective = numpy.tile(numpy.arange(slopes.shape[1]) == 0, slopes.shape[0])[:, None]
    matrix = numpy.hstack([-rows, of_objective, ~of_objective])
    right = values.copy()
    right[:, 0] -= centre.values[0]
    first = numpy.append(numpy.zeros(count), [0.0, worst(centre.values)])
    price = numpy.append(numpy.zeros(count), [1.0, penalty])
    length = numpy.append(numpy.full(count, 1.0/reach), [0.0, 0.0])
    bounds = [*zip(-centre.place, 1.0 - centre.place), (None, None), (0.0, None)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # of steps that rounding leaves a little outside
        found = minimize(lambda z: price @ z + 0.5*length @ z**2, first, jac=lambda z: price + length*z, method="SLSQP", bounds=bounds,
                         constraints={"type": "ineq", "fun": lambda z: matrix @ z - right.ravel(), "jac": lambda z: matrix},
                         options={"ftol": 1.0e-13, "maxiter": 300})
    step = numpy.clip(found.x[:count], -centre.place, 1.0 - centre.place)
    return step, promise(planes, centre, step, penalty)
