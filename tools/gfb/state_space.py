"""A bearing's stiffness and damping over the frequency as linear differential equations: poles and state-space matrices.

Z(s) = D + s E + sum_n R_n/(s - p_n), fitted to K + i w C by relaxed vector fitting [Gustavsen2006]: all entries share their
poles, the poles lie in the left half plane, and all is real in time: poles and residues come in conjugate pairs.
"""

import dataclasses

import numpy

TOLERANCE = 1.0e-5  # of the deviation, which decides how many poles are taken
MOST_POLES = 24
PASSES = 30         # of the poles' relocation, at most
SETTLED = 1.0e-10   # change of the poles that ends it, relative
FEWEST = 5          # frequencies
FLATTEST = 1.0e-8   # smallest constant of the function whose zeros are the new poles
BLOCKS = ((slice(0, 2), slice(0, 2)), (slice(0, 2), slice(2, 4)), (slice(2, 4), slice(0, 2)), (slice(2, 4), slice(2, 4)))


class CannotFit(ValueError):
    """Data that determine no fit."""


@dataclasses.dataclass
class Fit:
    """Poles, one of each conjugate pair, residues and constants, of Z(s) in SI."""

    poles: numpy.ndarray     # real, or with a positive imaginary part [rad/s]
    residues: numpy.ndarray  # (pole, row, column)
    constant: numpy.ndarray  # D
    rate: numpy.ndarray      # E
    deviation: float = numpy.nan  # largest at the data's frequencies, relative
    between: float = numpy.nan    # the same at every second frequency, of a fit that did not have them

    def __call__(self, s):
        """Z (row, column) at complex s; (..., row, column) at several."""
        s = numpy.asarray(s, dtype=complex)[..., None, None]
        value = self.constant + s*self.rate
        for pole, residue in zip(self.poles, self.residues):
            value = value + residue/(s - pole)
            if pole.imag:
                value = value + residue.conj()/(s - pole.conj())
        return value

    @property
    def all_poles(self):
        """Both of each pair."""
        return numpy.concatenate([[pole, pole.conj()] if pole.imag else [pole] for pole in self.poles])

    @property
    def number(self):
        """Number of poles, both of each pair."""
        return len(self.all_poles)

    def matrices(self):
        """A, B, C, D, E: x' = A x + B a, force = -(C x + D a + E a')."""
        states = 4*self.number
        a, b, c = numpy.zeros((states, states)), numpy.zeros((states, 4)), numpy.zeros((4, states))
        at, one = 0, numpy.eye(4)
        for pole, residue in zip(self.poles, self.residues):
            here, there = slice(at, at + 4), slice(at + 4, at + 8)
            a[here, here], b[here], c[:, here] = pole.real*one, one, residue.real
            at += 4
            if pole.imag:
                a[there, there] = pole.real*one
                a[here, there], a[there, here] = pole.imag*one, -pole.imag*one
                b[here], c[:, there] = 2.0*one, residue.imag
                at += 4
        return a, b, c, self.constant, self.rate


# --- the fit ---

def fit(frequency, impedance, poles=None, with_rate=False):
    """Fit of Z (frequency, row, column) at frequencies [rad/s]; with so many poles, or as few as the tolerance asks for."""
    most = min(MOST_POLES, len(frequency) - 2 - with_rate)
    half = (len(frequency) + 1)//2 - 2 - with_rate  # as many as every second frequency determines, too
    if len(frequency) < FEWEST or len(set(frequency)) < len(frequency):
        raise CannotFit(f"frequencies that differ: {len(set(frequency))} of {len(frequency)}; {FEWEST} are the fewest, 20 to 40 usual")
    if not (numpy.isfinite(impedance).all() and numpy.abs(impedance[:, :2, :2]).max() > 0.0 and frequency.min() > 0.0):
        raise CannotFit("stiffness and damping are not finite, or zero, or a frequency is not positive")
    if poles is not None and not 0 < poles <= most:
        raise CannotFit(f"{poles} poles: {len(frequency)} frequencies allow 1 to {most}")
    numbers = range(1, min(most, max(half, 1)) + 1) if poles is None else [poles]
    best = fit_with(frequency, impedance, numbers[0], with_rate)
    for number in numbers[1:]:
        if best.deviation <= TOLERANCE:
            break
        best = min(best, fit_with(frequency, impedance, number, with_rate), key=lambda found: found.deviation)
    if best.number <= half:
        told = fit_with(frequency[::2], impedance[::2], best.number, with_rate)
        best.between = deviation(told(1j*frequency[1::2]), impedance[1::2])
    return best


def fit_with(frequency, impedance, number, with_rate):
    """The same with so many poles; inside, lengths and frequencies are scaled."""
    highest = frequency.max()
    length = numpy.sqrt(numpy.abs(impedance[:, 2:, 2:]).max()/numpy.abs(impedance[:, :2, :2]).max()) or 1.0
    arm = numpy.array([1.0, 1.0, length, length])
    s = 1j*frequency/highest
    values = (impedance/numpy.multiply.outer(arm, arm)).reshape(len(s), 16)
    values = values/numpy.abs(impedance[:, :2, :2]).max()
    weight = 1.0/numpy.abs(values).max(axis=1)
    poles = first_poles(s.imag, number)
    fits = []
    for _ in range(PASSES):  # poles may wander between fits of the same quality: the best counts
        moved = relocated(s, values, weight, poles, with_rate)
        still = numpy.allclose(moved, poles, rtol=SETTLED, atol=0.0) if len(moved) == len(poles) else False
        poles = moved
        solution, misfit = residues_of(s, values, weight, poles, with_rate)
        fits.append((misfit, poles, solution))
        if still:
            break
    _, poles, solution = min(fits, key=lambda one: one[0])
    scale = numpy.abs(impedance[:, :2, :2]).max()*numpy.multiply.outer(arm, arm)
    made = as_fit(poles*highest, solution.reshape(-1, 4, 4)*scale, highest, with_rate)
    made.deviation = deviation(made(1j*frequency), impedance)
    return made


def first_poles(frequency, number):
    """Weakly damped pairs spread over the band, and a real one where the number is odd."""
    low, high = frequency.min(), frequency.max()
    pairs = numpy.geomspace(low, high, number//2 + 2)[1:-1] if number//2 > 1 else numpy.array([numpy.sqrt(low*high)])[:number//2]
    return numpy.concatenate(([-high + 0.0j] if number % 2 else [], (-0.1 + 1.0j)*pairs)).astype(complex)


def functions(s, poles):
    """Real basis of the fractions with these poles: (frequency, function)."""
    columns = []
    for pole in poles:
        one, other = 1.0/(s - pole), 1.0/(s - pole.conj())
        columns += [one + other, 1j*(one - other)] if pole.imag else [one]
    return numpy.array(columns).T


def own_columns(s, poles, with_rate):
    """What each entry has for itself: fractions, constant, and s."""
    columns = [functions(s, poles), numpy.ones((len(s), 1))] + ([s[:, None]] if with_rate else [])
    return numpy.hstack(columns)


def real(rows):
    """Real and imaginary parts below each other."""
    return numpy.concatenate((rows.real, rows.imag))


def relocated(s, values, weight, poles, with_rate):
    """New poles: the zeros of sigma, with (sigma Z) and sigma both of the old poles; those on the right are mirrored."""
    own, shared = own_columns(s, poles, with_rate), numpy.hstack((functions(s, poles), numpy.ones((len(s), 1))))
    rows = []
    for entry in values.T:
        if not entry.any():
            continue
        block = real(weight[:, None]*numpy.hstack((own, -shared*entry[:, None])))
        rows.append(numpy.linalg.qr(block, mode="r")[own.shape[1]:, own.shape[1]:])
    relaxed = shared.real.sum(axis=0)/len(s)  # sigma is one in the mean: no constant is fixed
    system = numpy.vstack((*rows, relaxed))
    right = numpy.zeros(len(system))
    right[-1] = 1.0
    size = numpy.linalg.norm(system, axis=0)
    solution = numpy.linalg.lstsq(system/size, right, rcond=None)[0]/size
    constant = solution[-1] if abs(solution[-1]) > FLATTEST else numpy.copysign(FLATTEST, solution[-1])
    matrix, inflow = numpy.zeros((len(solution) - 1,)*2), numpy.zeros(len(solution) - 1)
    at = 0
    for pole in poles:
        matrix[at, at], inflow[at] = pole.real, 1.0
        if pole.imag:
            matrix[at:at + 2, at:at + 2] = [[pole.real, pole.imag], [-pole.imag, pole.real]]
            inflow[at], inflow[at + 1] = 2.0, 0.0
            at += 1
        at += 1
    return stable(numpy.linalg.eigvals(matrix - numpy.outer(inflow, solution[:-1])/constant))


def stable(poles):
    """One of each pair, in the left half plane, sorted."""
    kept = numpy.array([complex(-max(abs(pole.real), 1.0e-12*abs(pole)), pole.imag) for pole in poles if pole.imag >= 0.0])
    return kept[numpy.lexsort((kept.real, kept.imag))]


def residues_of(s, values, weight, poles, with_rate):
    """Coefficients (column, entry) of given poles by least squares, and the norm of what is left."""
    columns = real(weight[:, None]*own_columns(s, poles, with_rate))
    right = real(weight[:, None]*values)
    size = numpy.linalg.norm(columns, axis=0)
    solution = numpy.linalg.lstsq(columns/size, right, rcond=None)[0]/size[:, None]
    return solution, numpy.linalg.norm(columns@solution - right)


def as_fit(poles, solution, highest, with_rate):
    """Residues and constants from the coefficients of the scaled basis."""
    residues, at = [], 0
    for pole in poles:
        residues.append(highest*(solution[at] + 1j*solution[at + 1] if pole.imag else solution[at].astype(complex)))
        at += 2 if pole.imag else 1
    rate = solution[at + 1]/highest if with_rate else numpy.zeros((4, 4))
    return Fit(poles, numpy.array(residues), solution[at], rate)


def deviation(found, wanted):
    """Largest difference over the frequencies: displacements, tilts and what couples them, each over its own largest entry there."""
    size = [numpy.abs(wanted[:, rows, columns]).max(axis=(1, 2)) for rows, columns in BLOCKS]
    size[1] = size[2] = numpy.sqrt(size[0]*size[3])
    return max(float((numpy.abs((found - wanted)[:, rows, columns]).max(axis=(1, 2))/numpy.maximum(one, 1.0e-300)).max())
               for (rows, columns), one in zip(BLOCKS, size))
