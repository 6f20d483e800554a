"""One part of a design study: the bearing of a case under another analysis."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gfb.case import Case
from gfb.design_work import Part

DIRECTIONS = 12                      # of the load, around the bearing
SPEEDS = (0.5, 0.75, 1.0, 1.25)      # over the speed of the case, of capacities
WHIRL_SPEEDS = (0.4, 0.55, 0.7, 0.85, 1.0, 1.15, 1.3)
FREQUENCY_RATIOS = (0.25, 0.5, 1.0)  # of vibrations over the speed, where the case has none
ORBIT_TURNS, ORBIT_STEADY = 60, 1.0e-3
WORK = {"point": "the equilibrium, its stiffness and damping", "directions": f"{DIRECTIONS} equilibria", "capacity": f"a search at each of {len(SPEEDS)} speeds",
        "misalignment": "a search for the tilt", "lift_off": "a search for the speed", "whirl": f"stiffness and damping at {len(WHIRL_SPEEDS)} speeds",
        "orbit": f"steps in time over up to {ORBIT_TURNS} turns", "tolerances": "the equilibrium and derivatives by keys"}
STATE = ("scene", "bearing", "pads", "ramp", "bore", "gas", "shaft_contact", "thermal", "operation", "model", "mesh", "top_foil",
         "bump_foil", "contact", "solver", "output")


def with_analysis(case: Case, name: str, question: str, analysis: str, kept: Sequence[str] = (), **groups: dict[str, Any]) -> Part:
    """A part of the study: the bearing of the case under another analysis."""
    one = Case({group: keys for group, keys in case.groups.items() if group in (*STATE, *kept)} | groups)
    one["scene%analysis"] = analysis
    if analysis == "linear_dynamics" and not {"dynamics%frequencies", "dynamics%frequency_ratios"} & set(one):
        one["dynamics%frequency_ratios"] = FREQUENCY_RATIOS
    one["scene%title"] = f"{case.groups['scene'].get('title', '')}: {question}".lstrip(": ")
    points = len(one.listed("sweep%values")) if "sweep%values" in one else 1
    return Part(name, question, one, states=points if analysis in ("equilibrium", "linear_dynamics") else 0, work=WORK[name])
