"""What each orifice of a film that is fed does: where it is, its flow, the pressure in its mouth, whether it is choked or gas leaves by it."""

import math

from gfb.report.sketch import Bearing

MOST = 64  # rows of a table
HEADS = ("n", "theta [deg]", "z or radius [mm]", "flow [mg/s]", "mouth [kPa]", "it is")


def orifice_rows(results):
    """(number, theta [deg], z or radius [mm], flow [mg/s], pressure in the mouth [kPa], words) of each orifice whose flow is known."""
    flows = {number: results.value(f"orifice_flow_{number}") for number in range(1, MOST + 1)}
    flows = {number: flow for number, flow in flows.items() if flow is not None}
    if not flows:
        return []
    try:
        holes = Bearing(results.case).holes()
    except (ValueError, OverflowError):  # the numbers of a case that is not gfb's
        holes = {}
    pressures = {number: results.value(f"mouth_pressure_{number}") for number in flows}
    known = sorted(value for value in pressures.values() if value is not None)
    choked = results.count("choked_orifices")*len(flows)//max(len(holes), len(flows))  # of sectors that are alike the first one's are listed
    highest = known[choked - 1] if 0 < choked <= len(known) else -math.inf  # the flow of all whose mouth has no more is as fast as sound
    rows = []
    for number, flow in flows.items():
        pressure, (theta, along) = pressures[number], holes.get(number, (None, None))
        words = "gas leaves the film" if flow < 0.0 else "choked" if pressure is not None and pressure <= highest else ""
        rows.append((number, "" if theta is None else f"{math.degrees(theta) % 360.0:.4g}", "" if along is None else f"{1.0e3*along:.4g}",
                     f"{1.0e6*flow:.4g}", "" if pressure is None else f"{1.0e-3*pressure:.4g}", words))
    return rows
