#!/usr/bin/env python3
"""Limits of Z = K + i w C on rigid full rings: turned, vibrating fast, and with a gas that is hardly compressed.

All on biquadratic elements; errors are over the largest entry of their 2 x 2 block.
"""

import dataclasses
import math
import tempfile

import numpy

from dynamics import BLOCKS, block_error, vibrate
from gfb_run import Bearing, Checks, observed_order

RING = Bearing(leading_edge_condition="periodic")
EXACT = {"model": {"film_order": 2}, "solver": {"residual_tolerance": 1.0e-13, "step_tolerance": 1.0e-11}}
DIRECT = [(0, 0), (1, 1)]
RATIO = 0.4  # eccentricity over clearance, along x


def coefficients(folder, bearing, mesh, number, ratios, place=(RATIO, 0.0), tilt=(0.0, 0.0)):
    """Frequencies and Z at frequencies over the speed; the place is over the clearance."""
    place = tuple(bearing.clearance*one for one in place)
    return vibrate(folder, "limit", bearing, {"frequency_ratios": ratios}, mesh=mesh, number=number, eccentricity=place,
                   tilt=tilt, groups=EXACT)


# --- no direction of its own ---

def check_turned(checks, folder):
    """Z turns with eccentricity and tilt, all 16 entries; by whole elements and not.

    The mesh turns Z's error with it but for its own harmonics, of the size of (e/2C)^elements.
    """
    state, wanted = numpy.array([0.4, 0.2, 1.0e-4, -2.0e-4]), None
    for angle in (0.0, 2.0*math.pi*7.0/40.0, 1.0):
        c, s = math.cos(angle), math.sin(angle)
        turn = numpy.kron(numpy.eye(2), [[c, -s], [s, c]])
        place = turn@state
        _, _, found = coefficients(folder, RING, (40, 8), 2.0, (0.5, 2.0), place[:2], tuple(place[2:]))
        if wanted is None:
            wanted = found
        else:
            checks.below(f"ring turned by {math.degrees(angle):.0f} degrees: Z turns with it",
                         block_error(found, turn@wanted@turn.T), 1.0e-12)


# --- fast ---

def trapped(bearing, film):
    """Z of gas that stays where it is, p h constant: the integral of p0/h0 B_i B_j, of gfb's own steady film."""
    theta, z = film["theta"], film["z"]
    motion = numpy.stack((numpy.cos(theta), numpy.sin(theta), -z*numpy.sin(theta), z*numpy.cos(theta)), axis=-1)
    around = numpy.full((len(theta), 1), 2.0*math.pi/(len(theta) - 1))
    around[[0, -1]] *= 0.5  # the ring's first station is its last one
    across = numpy.full(z.shape[1], 2.0/3.0)
    across[1::2], across[[0, -1]] = 4.0/3.0, 1.0/3.0
    weight = bearing.radius*around*across*(z[0, 1] - z[0, 0])*film["pressure"]/film["gap"]
    return numpy.einsum("ab,abi,abj->ij", weight, motion, motion)


def edge_layers(bearing, frequency):
    """What Z lacks at its edges, where p' = 0: layers in which p' decays as exp(-k s), k^2 = 12 i mu w/(p_a h^2).

    Their share of Z is the integral of -(p_a/h) B_i B_j/k along both edges, in which the gap cancels.
    """
    size = bearing.ambient_pressure**1.5/numpy.sqrt(12j*bearing.viscosity*frequency)*2.0*math.pi*bearing.radius
    arm = numpy.array([1.0, 1.0, 0.25*bearing.length**2, 0.25*bearing.length**2])
    return -size[:, None, None]*numpy.diag(arm)


def check_fast(checks, folder):
    """The limit is approached as w^-1/2, by the edge layers' closed form; what is left falls as 1/w."""
    answer, frequency, found = coefficients(folder, RING, (24, 96), 2.0, (50.0, 200.0))
    limit, layers = trapped(RING, answer.film_arrays())[None], edge_layers(RING, frequency)
    for name, block in (("translation", BLOCKS[0]), ("tilts", BLOCKS[1])):
        size = numpy.abs(limit[:, block, block]).max()
        off = numpy.abs((found - limit)[:, block, block]).max(axis=(1, 2))/size
        rest = numpy.abs((found - limit - layers)[:, block, block]).max(axis=(1, 2))/size
        checks.within(f"fast, {name}: falls as the frequency to the power of minus", observed_order(*off, 4.0), 0.47, 0.53)
        checks.below(f"fast, {name}: with edge layers", rest[1], 3.0e-3)
        checks.within(f"fast, {name}: what they leave falls to the power of minus", observed_order(*rest, 4.0), 0.9, 1.1)


# --- hardly compressed ---

def incompressible(radial, tangential, slope, omega, frequency):
    """Z for an eccentricity along x, from the damping C_rr, C_tt of squeeze films and d(e C_tt)/de.

    The incompressible film is linear in e' and turning: one that turns with omega/2 beside a shaft at rest is one at rest
    beside a shaft that whirls with -omega/2. So -f = C (s' - omega/2 x s), of which K is the derivative.
    """
    stiffness = 0.5*omega*numpy.array([[0.0, tangential], [-slope, 0.0]])
    return stiffness + 1j*frequency[:, None, None]*numpy.diag([radial, tangential])


def sommerfeld(bearing, omega, frequency):
    """Long bearing, Z per metre: h^3 p'/(12 mu R^2) = c + v sin theta (squeeze), c - v cos theta (across it).

    Radial: 12 mu R^3 times the integral of sin^2/h^3; tangential: of cos^2/h^3 less its mean by weight 1/h^3, which is
    Sommerfeld's load, 12 pi mu R^3 omega/C^2 eps/((2 + eps^2) root), over e omega/2.
    """
    eps, root = RATIO, math.sqrt(1.0 - RATIO**2)
    unit = math.pi*bearing.viscosity*(bearing.radius/bearing.clearance)**3
    tangential = 24.0*unit/((2.0 + eps**2)*root)
    slope = tangential*(1.0 + eps**2/root**2 - 2.0*eps**2/(2.0 + eps**2))
    return incompressible(12.0*unit/root**3, tangential, slope, omega, frequency)


def ocvirk(bearing, omega, frequency):
    """Short bearing: h^3 p_zz = 12 mu times the gap's rate, so mu R L^3 times the integrals of b_i b_j/h^3, b = (cos, sin).

    A tilt's gap is z (phi_y cos - phi_x sin): phi_y is radial and -phi_x tangential, and L^5/60 stands for L^3. There
    (3 h^2 h' p0_z)_z has h'_z as well and counts twice: K has the integral of b_i (2 (b_j/h^3)' - b_j'/h^3) where that of
    translations has b_i (b_j/h^3)'.
    """
    eps, root = RATIO, math.sqrt(1.0 - RATIO**2)
    unit = math.pi*bearing.viscosity*bearing.radius*bearing.length**3/bearing.clearance**3
    radial, tangential = unit*(1.0 + 2.0*eps**2)/root**5, unit/root**3
    block = incompressible(radial, tangential, tangential*(1.0 + 3.0*eps**2/root**2), omega, frequency)
    tilted = 2.0*block.real - 0.5*omega*numpy.array([[0.0, radial], [-tangential, 0.0]]) + 1j*block.imag
    turn = numpy.array([[0.0, -1.0], [1.0, 0.0]])
    z = numpy.zeros((len(frequency), 4, 4), complex)
    z[:, BLOCKS[0], BLOCKS[0]] = block
    z[:, BLOCKS[1], BLOCKS[1]] = bearing.length**2/60.0*turn@tilted@turn.T
    return z


def check_long(checks, folder, number):
    """Two long rings on equal elements: their ends are alike, and the difference is the middle alone."""
    found = {}
    for widths in (16, 20):  # radii
        bearing = dataclasses.replace(RING, length=widths*RING.radius)
        _, frequency, found[widths] = coefficients(folder, bearing, (48, 3*widths), number, (0.5, 2.0))
    omega = frequency[0]/0.5
    middle = (found[20] - found[16])/(4.0*RING.radius)
    checks.below(f"Lambda = {number:.0e}, long: Sommerfeld's K and C",
                 block_error(middle[:, :2, :2], sommerfeld(RING, omega, frequency), [(0, 0)]), 1.0e-5)


def check_short(checks, folder, number):
    """Short rings approach Ocvirk's as the square of the width."""
    error = {name: [] for name in ("translation", "tilts")}
    for width in (0.2, 0.1):  # radii
        bearing = dataclasses.replace(RING, length=width*RING.radius)
        _, frequency, found = coefficients(folder, bearing, (48, 16), number, (0.5, 2.0))
        wanted = ocvirk(bearing, frequency[0]/0.5, frequency)
        for name, block in zip(error, DIRECT):
            error[name].append(block_error(found, wanted, [block]))
    for name, (wide, narrow) in error.items():
        checks.below(f"Lambda = {number:.0e}, L/D = 0.05: Ocvirk's K and C, {name}", narrow, 3.0e-3)
        checks.within(f"short, {name}: order in the width", observed_order(wide, narrow), 1.9, 2.1)


def main():
    checks = Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_turned(checks, folder)
        check_fast(checks, folder)
        check_long(checks, folder, 1.0e-6)
        check_short(checks, folder, 1.0e-6)
    checks.close()


if __name__ == "__main__":
    main()
