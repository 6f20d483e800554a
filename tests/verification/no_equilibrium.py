#!/usr/bin/env python3
"""Where the film carries no such load: status 2, a sentence, what was reached, and older results untouched."""

import hashlib
import math
import pathlib
import tempfile

from gfb_run import Bearing, Checks, natural_sizes, run

GU2020 = Bearing(radius=0.01905, length=0.0381, clearance=31.8e-6, viscosity=1.95e-5, ambient_pressure=1.0135e5)
# Bumps of [Gu2020] by Walowit and Anno: with local pressure the pad's rim, at ambient pressure, does not
# yield, so the shaft stops at the clearance there, with less than 100 N on the film.
BUMPS = {"thickness": 0.102e-3, "youngs_modulus": 214.0e9, "poissons_ratio": 0.29, "half_length": 1.778e-3,
         "height": 0.508e-3, "pitch": 4.572e-3, "bumps": 26}

CASES = {
    "load beyond a rigid bearing": {"load": (-1.0e7, 0.0)},
    "load beyond a rigid bearing, tilted": {"load": (0.0, 1.0e7), "tilt": (1.0e-4, 0.0)},
    "rim of a foundation closes": {"load": (-100.0, 0.0), "foil": "elastic_foundation",
                                   "groups": {"bump_foil": BUMPS, "model": {"foundation_pressure": "local"}}},
    "rim of a soft foundation closes": {"load": (-160.0, 48.0), "foil": "elastic_foundation",
                                        "groups": {"model": {"foundation_stiffness": 3.0e9, "foundation_pressure": "local"}}},
    "sweep beyond what is carried": {"load": (-1.0, 0.0), "groups": {"sweep": {
        "parameter": "load", "values": (10.0, 50.0, 1.0e7, 20.0)}}},
    "too few iterations": {"load": (-100.0, 0.0), "groups": {"solver": {
        "maximum_iterations": 1, "smallest_load_step": 0.1}}},
}
ENDINGS = ("summary", "h5", "film.vtkhdf", "used.nml")
CARRIED = {"load": (-50.0, 0.0)}


def digests(folder):
    """A digest of every file of the good result."""
    return {ending: hashlib.sha256((folder/f"case.{ending}").read_bytes()).hexdigest() for ending in ENDINGS}


def check_case(checks, folder, words, case):
    base = {"mesh": (96, 16), "speed_rpm": 30000.0}
    for path in folder.iterdir():
        path.unlink()
    run(folder, "case", GU2020, **base, **CARRIED)
    before = digests(folder)
    answer = run(folder, "case", GU2020, status=2, **base, **case)
    checks.that(f"{words}: the good result is as it was", digests(folder) == before)
    left = sorted(path.name for path in folder.iterdir())
    for ending in ENDINGS:
        checks.that(f"{words}: case.unconverged.{ending}", f"case.unconverged.{ending}" in left)
    checks.that(f"{words}: nothing unfinished left", not any(name.startswith(".gfb") for name in left))
    checks.that(f"{words}: summary says so", answer["converged"] == "false")
    checks.that(f"{words}: the log says so", "no equilibrium found: " in answer.log)
    coarse = "no answer on the mesh of 48 x 8 (" in answer.log and "); the mesh of 96 x 16 follows" in answer.log
    checks.that(f"{words}: the coarse mesh's end is said when it is met", coarse or "groups" in case and "sweep" in case["groups"])
    checks.that(f"{words}: and what was reached", "last state reached: load (" in answer.log)
    checks.that(f"{words}: a remedy where there is one", ("'axial_mean' in &model" in answer.log) == ("rim" in words))
    checks.that(f"{words}: only numbers", all(map(math.isfinite, answer.physical().values())))
    checks.that(f"{words}: no NaN in the log", "NaN" not in answer.log and "Inf" not in answer.log)
    check_last_state(checks, words, answer)
    return answer


def check_last_state(checks, words, answer):
    """The last state is one that a film can have, and its load is the one that is told."""
    checks.that(f"{words}: last state has a film", answer["minimum_gap"] > 0.0)
    checks.that(f"{words}: last state has pressure", answer["minimum_pressure"] > 0.0)
    told = answer.log.split("last state reached: load (")[1].split(")")[0].split(",")
    size = natural_sizes(GU2020)["force_x"] + math.hypot(*answer.force)
    worst = max(abs(float(word) - force) for word, force in zip(told, answer.force))/size
    checks.below(f"{words}: film carries the load that is told", worst, 1.0e-4)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for words, case in CASES.items():
            answer = check_case(checks, folder, words, case)
            if "sweep" in words:
                rows = answer.history()
                checks.that(f"{words}: the points before are kept", list(rows["load"]) == [10.0, 50.0])
    checks.close()


if __name__ == "__main__":
    main()
