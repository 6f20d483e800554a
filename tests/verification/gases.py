#!/usr/bin/env python3
"""Films of slipping, real and turbulent gases against reference/gas_and_bore.json, exact integrals, and each other.

Forces, torque and extreme pressures of biquadratic films within 1e-4 and the order of bilinear ones, Galerkin and SUPG. On
a ring the integral of H^3 Phi + 6 Kn H^2 P around, Phi' the density over the viscosity, is the same at every z. A table of
the real gas gives what its equation of state gives. The stiffness at a frequency next to zero is that of differences.
"""

import math
import tempfile

import numpy

from bore import check_row, errors, rows, solve
from dynamics import vibrate
from gfb_run import Bearing, Checks, case_groups, observed_order, run
from gfb_run import solve as solve_case

GAS_CONSTANT = 8.314462618
CARBON_DIOXIDE = {"equation_of_state": "peng_robinson", "temperature": 330.0, "molar_mass": 0.0440098,
                  "critical_temperature": 304.1282, "critical_pressure": 7377300.0, "acentric_factor": 0.22394}
DENSE = Bearing(radius=0.02, length=0.04, clearance=3.0e-5, viscosity=2.2e-5, ambient_pressure=8.0e6)
MESHES = ((72, 24), (72, 24), (144, 48))


def gas_of(bearing, given):
    """`&gas` of a row beside viscosity and pressure."""
    if "knudsen" in given:
        return {"mean_free_path": given["knudsen"]*bearing.clearance}
    gas = dict(CARBON_DIOXIDE, viscosity_exponent=given["viscosity_exponent"])
    if given["reynolds_ambient"] is not None:
        gas["turbulence"] = "ng_pan"
    return gas


def check_rows(checks, folder):
    """All rows."""
    for row in rows("slip", "real_gas"):
        given = row["parameters"]
        bearing = Bearing(leading_edge_condition=given["leading_edge"]) if "knudsen" in given else DENSE
        check_row(checks, folder, bearing, row, {"gas": gas_of(bearing, given)}, MESHES)


def check_supg(checks, folder):
    """SUPG tends to the same answers."""
    for row in rows("slip", "real_gas"):
        given = row["parameters"]
        bearing = Bearing(leading_edge_condition=given["leading_edge"]) if "knudsen" in given else DENSE
        groups = {"gas": gas_of(bearing, given), "model": {"film_scheme": "supg"}}
        answer = run(folder, "supg", bearing, mesh=(208, 64), groups=groups, number=given["bearing_number"],
                     eccentricity=(given["ex"]*bearing.clearance, given["ey"]*bearing.clearance))
        found = errors(bearing, row, answer)
        checks.below(f"{row['name']}: SUPG, force", math.hypot(found["fx"], found["fy"]), 3.0e-3)


def pressure_of(amount):
    """Peng and Robinson's pressure of carbon dioxide."""
    t, t_c, p_c, w = (CARBON_DIOXIDE[name] for name in ("temperature", "critical_temperature", "critical_pressure",
                                                         "acentric_factor"))
    alpha = (1.0 + (0.37464 + 1.54226*w - 0.26992*w**2)*(1.0 - math.sqrt(t/t_c)))**2
    a, b = 0.45724*(GAS_CONSTANT*t_c)**2/p_c*alpha, 0.0778*GAS_CONSTANT*t_c/p_c
    return GAS_CONSTANT*t*amount/(1.0 - b*amount) - a*amount**2/(1.0 + 2.0*b*amount - (b*amount)**2)


def carbon_dioxide_table(points=400):
    """Pressures [Pa] and densities [kg/m3] from 3 to 25 MPa."""
    amount = numpy.linspace(1.0, 20000.0, 400001)
    pressure = pressure_of(amount)
    table = numpy.geomspace(3.0e6, 2.5e7, points)
    return table, 0.0440098*numpy.interp(table, pressure, amount)


def invariant_error(film, bearing, potential, slip):
    """Largest relative difference along z of the integral of H^3 Phi + slip H^2 P around a ring."""
    gap, pressure = film["gap"][:-1]/bearing.clearance, film["pressure"][:-1]/bearing.ambient_pressure
    held = (gap**3*potential(pressure) + slip*gap**2*pressure).mean(axis=0)
    return float(numpy.abs(held/held[-1] - 1.0).max())


def check_rings(checks, folder):
    """Exact for any gas: with slip, and with an equation of state and a viscosity."""
    slip = next(row for row in rows("slip") if row["parameters"]["leading_edge"] == "periodic")
    ring, kn = Bearing(leading_edge_condition="periodic"), slip["parameters"]["knudsen"]
    dense = Bearing(0.02, 0.04, 3.0e-5, 2.2e-5, 8.0e6, "periodic")
    real = {"parameters": {"bearing_number": 1.0, "ex": 0.6, "ey": 0.0}}
    amount = numpy.linspace(1.0, 20000.0, 400001)
    pressure = pressure_of(amount)/8.0e6
    ambient = numpy.interp(1.0, pressure, amount)
    rate = (amount/ambient)**0.5  # density over viscosity, its square root
    integral = numpy.concatenate(([0.0], numpy.cumsum(0.5*(rate[1:] + rate[:-1])*numpy.diff(pressure))))
    for name, bearing, row, gas, potential, slips in (
            ("slip", ring, slip, {"mean_free_path": kn*ring.clearance}, lambda p: 0.5*p**2, 6.0*kn),
            ("real gas", dense, real, dict(CARBON_DIOXIDE, viscosity_exponent=0.5),
             lambda p: numpy.interp(p, pressure, integral), 0.0)):
        found = [invariant_error(solve(folder, bearing, row, mesh, 2, {"gas": gas}).film_arrays(), bearing, potential, slips)
                 for mesh in ((36, 12), (72, 24))]
        checks.below(f"ring, {name}: integral along z", found[-1], 1.0e-4)
        checks.that(f"ring, {name}: order {observed_order(*found):.2f} (at least 2.5)", observed_order(*found) > 2.5)


def check_table(checks, folder):
    """A table of what the equation of state gives; an ideal gas as a table; air's viscosity by its law."""
    row = rows("real_gas")[0]
    table = dict(zip(("density_table_pressure", "density_table_density"), carbon_dioxide_table()))
    found = errors(DENSE, row, solve(folder, DENSE, row, (72, 24), 2, {"gas": {k: list(map(float, v)) for k, v in table.items()}}))
    checks.below("real gas as a table: force", math.hypot(found["fx"], found["fy"]), 1.0e-4)
    row = {"parameters": {"bearing_number": 3.0, "ex": 0.5, "ey": 0.2}}
    bearing = Bearing()
    plain = solve(folder, bearing, row, (24, 8), 2, {})
    line = solve(folder, bearing, row, (24, 8), 2, {"gas": {"density_table_pressure": [1.0e4, 1.0e5, 1.0e6],
                                                            "density_table_density": [0.1, 1.0, 10.0]}})
    checks.below("ideal gas as a table: force", math.dist(plain.force, line.force)/math.hypot(*plain.force), 1.0e-10)
    hot = 1.458e-6*600.0**1.5/710.4
    groups = case_groups(bearing, mesh=(24, 8), speed_rpm=20000.0, eccentricity=(1.0e-5, 0.0))
    groups["gas"]["viscosity"] = hot
    given = solve_case(folder, "given", groups)
    groups["gas"] |= {"viscosity": None, "viscosity_law": "sutherland", "temperature": 600.0}
    law = solve_case(folder, "law", groups)
    checks.below("air of 600 K: force", math.dist(given.force, law.force)/math.hypot(*given.force), 1.0e-12)


def check_stiffness(checks, folder):
    """Stiffness at a frequency next to zero against differences of forces at positions beside."""
    turbulent = dict(CARBON_DIOXIDE, viscosity_exponent=0.5, turbulence="ng_pan")
    for name, bearing, gas, number in (("slip", Bearing(), {"mean_free_path": 1.0e-6}, 3.0),
                                       ("turbulent real gas", DENSE, turbulent, 0.05)):
        step = 1.0e-5*bearing.clearance
        base = (0.5*bearing.clearance, 0.1*bearing.clearance)
        common = {"mesh": (48, 12), "number": number}
        _, _, found = vibrate(folder, "dynamics", bearing, {"frequencies": 1.0e-6}, eccentricity=base,
                              groups={"gas": gas}, **common)
        for i, moved in enumerate("xy"):
            force = [numpy.array(run(folder, "beside", bearing, groups={"gas": gas}, **common, eccentricity=tuple(
                base[k] + side*step*(k == i) for k in range(2))).force) for side in (1, -1)]
            slope = (force[0] - force[1])/(2.0*step)
            # The force acts on the sleeve and e is the sleeve's: its stiffness is minus the slope.
            checks.below(f"{name}: stiffness by {moved}",
                         numpy.abs(found[0, :2, i].real + slope).max()/numpy.abs(slope).max(), 1.0e-6)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_rows(checks, folder)
        check_supg(checks, folder)
        check_rings(checks, folder)
        check_table(checks, folder)
        check_stiffness(checks, folder)
    checks.close()


if __name__ == "__main__":
    main()
