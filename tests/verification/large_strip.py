"""A bump strip between rigid plates as a plane-strain solid that may move far: large displacements and rotations.

Eight-node quadrilaterals, Green's strains, St. Venant and Kirchhoff's material. Contacts are the lines of the program,
on the faces or the mid-surface, and stay on their nodes; friction is Coulomb's, without a stick length. Each step of the
plate is Newton's method on the solid, each iteration a linear complementarity problem. Nothing here is the program's.
"""

import numpy

from solid_strip import COMPLIANCE, FLOOR, LENT, TOP, complementary, plane_strain, slopes


def sections(foil, columns):
    """Lower and upper face of the strip by stations, two an element, and the stations of the crests and corners."""
    thickness, height, half, pitch = (foil[key] for key in ("thickness", "height", "half_length", "pitch"))
    radius = (half**2 + height**2)/(2*height)
    side = numpy.array([-0.5, 0.5])*thickness
    angle = numpy.arccos((radius - height + side)/(radius + side))  # where faces of arc and flat meet
    end = (radius + side)*numpy.sin(angle)
    leading = foil.get("fixed_line") == "flat"  # flats stand before their arcs, else behind
    sweep = numpy.linspace(-1.0, 1.0, 2*columns + 1)[:, None]
    part = numpy.linspace(0.0, 1.0, 2*max(2, columns//6) + 1)[:, None]
    place, crests, corners = [], [], []
    for bump in range(foil["bumps"]):
        centre = bump*pitch + (pitch - half if leading else half)
        arc = numpy.stack([centre + (radius + side)*numpy.sin(angle*sweep),
                           height - radius + (radius + side)*numpy.cos(angle*sweep)], -1)
        first = centre - end if leading else centre + end
        last = first + (-1.0 if leading else 1.0)*(pitch - 2.0*end)
        if leading and bump == 0:
            last = numpy.zeros(2)
        flat = numpy.stack(numpy.broadcast_arrays(first + part*(last - first), side), -1)
        for piece in (flat[::-1], arc) if leading else (arc, flat):
            if piece is arc:
                start = max(len(place) - 1, 0)
                crests.append(start + columns)
                corners += [start, start + 2*columns]
            place += list(piece[1:] if place else piece)
    return numpy.array(place), crests, corners


class LargeStrip:
    """The strip: clamped at its first station, or free; `large` is False for small displacements."""

    def __init__(self, foil, where, clamped=True, large=True, columns=24, layers=1):
        place, crests, corners = sections(foil, columns)
        eta = numpy.linspace(0.0, 1.0, 2*layers + 1)[None, :, None]
        grid = place[:, None, 0]*(1 - eta) + place[:, None, 1]*eta
        number = -numpy.ones(grid.shape[:2], int)
        there = [(i, j) for i, j in numpy.ndindex(number.shape) if not (i % 2 and j % 2)]
        for count, node in enumerate(there):
            number[node] = count
        points = numpy.array([grid[node] for node in there])
        at = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
        elements = numpy.array([[number[i + a, j + b] for a, b in at] for i in range(0, len(place) - 1, 2)
                                for j in range(0, 2*layers, 2)])
        self.large, self.width = large, foil["width"]
        self.unknown = (2*elements[:, :, None] + numpy.arange(2)).reshape(len(elements), 16)
        self.matrix = plane_strain(foil["youngs_modulus"], foil["poissons_ratio"])
        abscissae, weights = numpy.polynomial.legendre.leggauss(2)
        self.slope, self.volume = [], []
        for a, weight_a in zip(abscissae, weights):
            for b, weight_b in zip(abscissae, weights):
                rate = slopes(a, b)
                jacobian = numpy.einsum("ka,eai->eki", rate, points[elements])
                self.slope.append(numpy.linalg.solve(jacobian, numpy.broadcast_to(rate, (len(elements), 2, 8))))
                self.volume.append(self.width*weight_a*weight_b*numpy.linalg.det(jacobian))
        self.slope, self.volume = numpy.stack(self.slope, 1), numpy.stack(self.volume, 1)
        self.size = 2*len(there)
        held = [node for node in number[0] if node >= 0] if clamped else []
        self.free = numpy.setdiff1d(numpy.arange(self.size), [2*node + k for node in held for k in (0, 1)])
        top, low = (-1, 0) if where == "face" else (layers, layers)
        nodes = [(number[i, top], TOP) for i in crests] + [(number[i, low], FLOOR) for i in corners]
        nodes = list(dict.fromkeys((node, sign) for node, sign in nodes if node not in held))
        self.touching = numpy.array([node for node, _ in nodes])
        self.normal = numpy.array([sign for _, sign in nodes])
        self.small = None

    def inner_force(self, displacement):
        """Force of the strains, and its derivative."""
        if self.small is not None:
            return self.small @ displacement, self.small
        turn = numpy.einsum("eqka,eai->eqik", self.slope, displacement[self.unknown].reshape(-1, 8, 2))
        gradient = numpy.eye(2) + turn if self.large else numpy.broadcast_to(numpy.eye(2), turn.shape)
        strain = 0.5*(turn + turn.swapaxes(2, 3) + (turn.swapaxes(2, 3) @ turn if self.large else 0.0))
        stress = numpy.stack([strain[..., 0, 0], strain[..., 1, 1], 2.0*strain[..., 0, 1]], -1) @ self.matrix
        varied = numpy.empty((*self.volume.shape, 3, 8, 2))  # strains by displacements
        for row, (i, j) in enumerate(((0, 0), (1, 1), (0, 1))):
            varied[:, :, row] = self.slope[:, :, i, :, None]*gradient[:, :, None, :, j]
            if i != j:
                varied[:, :, row] += self.slope[:, :, j, :, None]*gradient[:, :, None, :, i]
        varied = varied.reshape(*self.volume.shape, 3, 16)
        weighed = self.volume[..., None]*stress
        force, whole = numpy.zeros(self.size), numpy.zeros((self.size, self.size))
        numpy.add.at(force, self.unknown, numpy.einsum("eqr,eqra->ea", weighed, varied))
        blocks = numpy.einsum("eqra,eqrb->eab", self.matrix @ varied*self.volume[..., None, None], varied, optimize=True)
        if self.large:
            tensor = weighed[..., [0, 2, 2, 1]].reshape(*self.volume.shape, 2, 2)
            tensed = numpy.einsum("eqka,eqkl,eqlb->eab", self.slope, tensor, self.slope, optimize=True)
            blocks[:, 0::2, 0::2] += tensed
            blocks[:, 1::2, 1::2] += tensed
        for place, block in zip(self.unknown, blocks):
            whole[numpy.ix_(place, place)] += block
        if not self.large:
            self.small = whole
        return force, whole


def moved_loop(strip, friction, travel, steps):
    """A plate moves down by `travel` in so many steps, and back. Returns the largest force [N] and the energy that the
    loop loses [J]."""
    count = len(strip.normal)
    across, along = (numpy.searchsorted(strip.free, 2*strip.touching + k) for k in (1, 0))
    each = numpy.arange(count)
    load = numpy.zeros((len(strip.free), 2*count))
    load[across, each], load[along, count + each] = strip.normal, 1.0
    length = 1.0e-6  # scale of the problem [m]; forces are in newtons
    displacement, forces, path = numpy.zeros(strip.size), [0.0], [0.0]
    for factor in [*numpy.arange(1, steps + 1)/steps, *numpy.arange(steps - 1, 0, -1)/steps, 1.0e-3]:
        before = displacement[strip.free]
        for _ in range(30):
            force, stiffness = strip.inner_force(displacement)
            now = displacement[strip.free]
            # lent by each iteration, of which the last one is the rest: nothing of it is left in the answer
            stiffness = stiffness[numpy.ix_(strip.free, strip.free)] + LENT*strip.width*numpy.eye(len(now))
            answer = numpy.linalg.solve(stiffness, numpy.column_stack([load, -force[strip.free]]))
            flexible, unloaded = answer[:, :-1], now + answer[:, -1]
            between = load.T @ flexible
            distance = strip.normal*unloaded[across] - numpy.where(strip.normal == TOP, factor*travel, 0.0)
            slipped = unloaded[along] - before[along]
            big = numpy.zeros((4*count, 4*count))  # pressure, rub forward, rub back, slip
            normal = between[:count, :count] + COMPLIANCE/strip.width*numpy.eye(count)
            big[:count, :3*count] = numpy.hstack([normal, between[:count, count:], -between[:count, count:]])
            big[count:2*count, :3*count] = numpy.hstack([between[count:, :count], between[count:, count:],
                                                         -between[count:, count:]])
            big[2*count:3*count, :3*count] = -big[count:2*count, :3*count]
            big /= length
            big[count:2*count, 3*count:] = big[2*count:3*count, 3*count:] = numpy.eye(count)
            big[3*count:, :3*count] = numpy.hstack([friction*numpy.eye(count), -numpy.eye(count), -numpy.eye(count)])
            z = complementary(big, numpy.concatenate([distance, slipped, -slipped, numpy.zeros(count)])/length)
            pressing = z[:count]
            then = unloaded + flexible @ numpy.concatenate([pressing, z[count:2*count] - z[2*count:3*count]])
            displacement[strip.free] = then
            if numpy.abs(then - now).max() < 1.0e-5*travel:
                break
        else:
            raise RuntimeError("Newton's method did not end")
        forces.append(pressing[strip.normal == TOP].sum())
        path.append(factor*travel)
    area = sum(0.5*(a + b)*(q - p) for a, b, p, q in zip(forces, forces[1:], path, path[1:]))
    return max(forces), area
