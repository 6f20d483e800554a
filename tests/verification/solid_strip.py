"""A bump strip between rigid plates as a plane-strain solid, with Coulomb friction at its faces or its mid-surface.

Eight-node quadrilaterals, condensed onto what may touch; each step of the load is a linear complementarity problem, by
Lemke's method. Nothing here is the program's.
"""

import numpy

TOP, FLOOR = -1.0, 1.0  # direction of the force of what is touched, along v
COMPLIANCE = 1.0e-11  # of a contact, a metre wide [m2/N]
LENT = 3.0e3  # stiffness lent to every unknown in a step, of which the last answer is the rest [N/m2]


def slopes(a, b):
    """Derivatives (2, 8) of an eight-node element's shape functions at a place in [-1, 1] x [-1, 1]."""
    rate = numpy.zeros((2, 8))
    for i, (x, y) in enumerate([[-1, -1], [1, -1], [1, 1], [-1, 1]]):
        rate[0, i] = 0.25*x*(1 + b*y)*(2*a*x + b*y)
        rate[1, i] = 0.25*y*(1 + a*x)*(2*b*y + a*x)
    rate[:, 4] = -a*(1 - b), -0.5*(1 - a*a)
    rate[:, 5] = 0.5*(1 - b*b), -b*(1 + a)
    rate[:, 6] = -a*(1 + b), 0.5*(1 - a*a)
    rate[:, 7] = -0.5*(1 - b*b), -b*(1 - a)
    return rate


def element_stiffness(points, matrix):
    """Stiffness of eight-node elements: points (elements, 8, 2), per metre of width."""
    total = numpy.zeros((len(points), 16, 16))
    abscissae, weights = numpy.polynomial.legendre.leggauss(3)
    for a, weight_a in zip(abscissae, weights):
        for b, weight_b in zip(abscissae, weights):
            rate = slopes(a, b)
            jacobian = numpy.einsum("ka,eai->eki", rate, points)
            slope = numpy.linalg.solve(jacobian, numpy.broadcast_to(rate, (len(points), 2, 8)))
            strain = numpy.zeros((len(points), 3, 16))
            strain[:, 0, 0::2] = strain[:, 2, 1::2] = slope[:, 0]
            strain[:, 1, 1::2] = strain[:, 2, 0::2] = slope[:, 1]
            volume = weight_a*weight_b*numpy.linalg.det(jacobian)
            total += numpy.einsum("e,eki,kl,elj->eij", volume, strain, matrix, strain)
    return total


def plane_strain(modulus, poisson):
    """Stresses (x, v, shear) by strains [Pa]."""
    factor = modulus/((1 + poisson)*(1 - 2*poisson))
    return factor*numpy.array([[1 - poisson, poisson, 0], [poisson, 1 - poisson, 0], [0, 0, 0.5 - poisson]])


def schur(matrix, kept):
    """A stiffness condensed onto some unknowns."""
    rest = numpy.setdiff1d(numpy.arange(len(matrix)), kept)
    return matrix[numpy.ix_(kept, kept)] - matrix[numpy.ix_(kept, rest)] @ numpy.linalg.solve(
        matrix[numpy.ix_(rest, rest)], matrix[numpy.ix_(rest, kept)])


class Piece:
    """An arc or a flat: columns x layers of elements between two faces, functions of s in [0, 1]."""

    def __init__(self, lower, upper, columns, layers, matrix):
        s, eta = numpy.linspace(0.0, 1.0, 2*columns + 1), numpy.linspace(0.0, 1.0, 2*layers + 1)
        grid = lower(s)[:, None]*(1 - eta[None, :, None]) + upper(s)[:, None]*eta[None, :, None]
        self.number = -numpy.ones(grid.shape[:2], int)
        there = [(i, j) for i in range(len(s)) for j in range(len(eta)) if not (i % 2 and j % 2)]
        for number, place in enumerate(there):
            self.number[place] = number
        self.points = numpy.array([grid[place] for place in there])
        at = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
        elements = numpy.array([[self.number[2*i + a, 2*j + b] for a, b in at] for i in range(columns)
                                for j in range(layers)])
        unknowns = (2*elements[:, :, None] + numpy.arange(2)).reshape(len(elements), 16)
        self.stiffness = numpy.zeros((2*len(there), 2*len(there)))
        for place, block in zip(unknowns, element_stiffness(self.points[elements], matrix)):
            self.stiffness[numpy.ix_(place, place)] += block

    def condensed(self, nodes):
        return schur(self.stiffness, (2*numpy.asarray(nodes)[:, None] + numpy.arange(2)).ravel())


class Strip:
    """Bumps with a flat behind each, condensed onto its contacts: `where` is 'face' or 'mid'."""

    def __init__(self, foil, where, columns=64, layers=4, clamped=False):
        thickness, height, half, pitch = (foil[key] for key in ("thickness", "height", "half_length", "pitch"))
        radius = (half**2 + height**2)/(2*height)
        matrix = plane_strain(foil["youngs_modulus"], foil["poissons_ratio"])
        sides = numpy.array([-0.5, 0.5])*thickness
        angles = numpy.arccos((radius - height + sides)/(radius + sides))  # where faces of arc and flat meet
        ends = (radius + sides)*numpy.sin(angles)

        def arc(side):
            return lambda s: numpy.stack([(radius + sides[side])*numpy.sin(angles[side]*(2*s - 1)),
                                          height - radius + (radius + sides[side])*numpy.cos(angles[side]*(2*s - 1))], -1)

        def flat(side):
            return lambda s: numpy.stack([ends[side] + s*(pitch - 2*ends[side]), numpy.full_like(s, sides[side])], -1)

        bump = Piece(arc(0), arc(1), columns, layers, matrix)
        between = Piece(flat(0), flat(1), max(2, columns//8), layers, matrix)
        a, f = bump.number, between.number
        crest = a[columns, -1 if where == "face" else layers]
        low = 0 if where == "face" else layers
        kept = [list(dict.fromkeys([*a[0], *a[-1], crest])), [*f[0], *f[-1]]]
        parts = [bump.condensed(kept[0]), between.condensed(kept[1])]
        number = {}

        def place(kind, i, node):
            """Number of a piece's node in the strip; ends of pieces are one."""
            if kind and node in f[0]:
                return place(0, i, a[-1][list(f[0]).index(node)])
            if kind and i + 1 < foil["bumps"]:
                return place(0, i + 1, a[0][list(f[-1]).index(node)])
            return number.setdefault((kind, i, node), len(number))

        blocks = [(numpy.array([place(kind, i, node) for node in kept[kind]]), parts[kind])
                  for i in range(foil["bumps"]) for kind in (0, 1)]
        stiffness = numpy.zeros((2*len(number), 2*len(number)))
        for nodes, block in blocks:
            unknowns = (2*nodes[:, None] + numpy.arange(2)).ravel()
            stiffness[numpy.ix_(unknowns, unknowns)] += block
        crests = [place(0, i, crest) for i in range(foil["bumps"])]
        feet = [place(0, i, a[end, low]) for i in range(foil["bumps"]) for end in (0, -1)]
        held = [place(0, 0, node) for node in a[0]] if clamped else []
        touching = numpy.array([node for node in crests + feet if node not in held])
        self.normal = numpy.where(numpy.isin(touching, crests), TOP, FLOOR)
        free = numpy.setdiff1d(numpy.arange(len(stiffness)), [2*node + k for node in held for k in (0, 1)])
        unknowns = (2*touching[:, None] + numpy.arange(2)).ravel()
        self.stiffness = schur(stiffness[numpy.ix_(free, free)], numpy.searchsorted(free, unknowns))


def complementary(matrix, given, tolerance=1.0e-9):
    """z >= 0, w = matrix z + given >= 0, z w = 0, by Lemke's method."""
    count = len(given)
    if (given >= 0.0).all():
        return numpy.zeros(count)
    cover = 1.0 + 0.5*numpy.random.default_rng(2).random(count)
    whole = numpy.hstack([numpy.eye(count), -matrix, -cover[:, None], given[:, None]])
    table, basis = whole.copy(), numpy.arange(count)  # w: 0..n-1, z: n..2n-1, artificial: 2n
    entering, row = 2*count, int(numpy.argmin(given/cover))
    for pivot in range(20000):
        table[row] /= table[row, entering]
        other = numpy.arange(count) != row
        table[other] -= numpy.outer(table[other, entering], table[row])
        leaving, basis[row] = basis[row], entering
        if leaving == 2*count:
            z = numpy.zeros(2*count + 1)
            z[basis] = numpy.linalg.solve(whole[:, basis], given)
            return z[count:2*count]
        if pivot % 25 == 24:
            table = numpy.linalg.solve(whole[:, basis], whole)
        entering = leaving + count if leaving < count else leaving - count
        column = table[:, entering]
        able = column > tolerance*max(1.0, numpy.abs(column).max())
        if not able.any():
            raise RuntimeError("Lemke's method ended on a ray")
        ratio = numpy.where(able, numpy.maximum(table[:, -1], 0.0)/numpy.where(able, column, 1.0), numpy.inf)
        ties = numpy.flatnonzero(ratio <= ratio.min()*(1 + 1.0e-9) + 1.0e-14)
        last = ties[basis[ties] == 2*count]
        row = int(last[0] if len(last) else ties[numpy.argmax(column[ties])])
    raise RuntimeError("Lemke's method did not end")


def loop(strip, friction, force, steps):
    """A plate is pressed on the crests up to a force per metre, and let go. Returns its largest travel [m], and the
    energy that the loop loses [J/m]."""
    count = len(strip.normal)
    matrix = numpy.zeros((2*count + 1, 2*count + 1))  # the last unknown is the plate's
    matrix[:-1, :-1] = 0.5*(strip.stiffness + strip.stiffness.T)
    flexible = numpy.linalg.inv(matrix + LENT*numpy.eye(len(matrix)))
    across, along = numpy.zeros((count, len(matrix))), numpy.zeros((count, len(matrix)))
    each = numpy.arange(count)
    across[each, 2*each + 1] = strip.normal
    across[strip.normal == TOP, -1] = -1.0  # the plate's travel is downwards
    along[each, 2*each] = 1.0
    length, unit = 1.0e-6, 1.0e3  # scales of the problem [m], [N/m]
    distance, mixed, slip = across @ flexible @ across.T, across @ flexible @ along.T, along @ flexible @ along.T
    big = numpy.zeros((4*count, 4*count))  # pressure, rub forward, rub back, slip
    big[:count, :3*count] = numpy.hstack([distance + COMPLIANCE*numpy.eye(count), mixed, -mixed])
    big[count:2*count, :3*count] = numpy.hstack([mixed.T, slip, -slip])
    big[2*count:3*count, :3*count] = -big[count:2*count, :3*count]
    big *= unit/length
    big[count:2*count, 3*count:] = big[2*count:3*count, 3*count:] = numpy.eye(count)
    big[3*count:, :3*count] = numpy.hstack([friction*numpy.eye(count), -numpy.eye(count), -numpy.eye(count)])
    state, travel, forces = numpy.zeros(len(matrix)), [0.0], [0.0]
    for factor in [*numpy.arange(1, steps + 1)/steps, *numpy.arange(steps - 1, 0, -1)/steps, 1.0e-3]:
        right = LENT*state
        right[-1] += factor*force
        free = flexible @ right
        slipped = along @ (free - state)/length
        z = complementary(big, numpy.concatenate([across @ free/length, slipped, -slipped, numpy.zeros(count)]))
        state = free + flexible @ (across.T @ (unit*z[:count]) + along.T @ (unit*(z[count:2*count] - z[2*count:3*count])))
        travel.append(state[-1])
        forces.append(factor*force)
    return max(travel), numpy.trapezoid(forces, travel) if hasattr(numpy, "trapezoid") else numpy.trapz(forces, travel)
