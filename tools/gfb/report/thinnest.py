"""Where the film is thinnest: by the fields of its file, for the numbers of a journal's answer do not have it. The shaft's centre is at -e,
but the film is thinnest there in a plain, aligned, rigid journal alone: pads, preload, a bore, foils and tilt move the place."""

import dataclasses
import math
import pathlib

import numpy

from gfb.results import open_results, reading

SAME = 1.0e-9   # of the smallest gap: places that are alike
FITS = 1.0e-6   # of it: a film with another one is that of another state


@dataclasses.dataclass
class Place:
    """One place of the film."""

    angle: float       # theta [rad]
    across: float      # z from the bearing's midplane, of a thrust bearing the radius [m]
    pad: int = 0       # its number; 0 where there is one alone, or the film is as thin on others
    alike: int = 1     # so many pads have such a place
    is_ring: bool = False

    def short(self) -> str:
        """The place, as a picture has room for it."""
        across = f"{'radius' if self.is_ring else 'z ='} {1.0e3*self.across + 0.0:.3g} mm"
        return f"theta = {math.degrees(self.angle) % 360.0:.0f} deg, {across}" + (f", pad {self.pad}" if self.pad else "")

    def words(self) -> str:
        """The place in a sentence."""
        return f"at {self.short()}" + f", alike on {self.alike} pads"*(self.alike > 1)


def place_of_thinnest(stem, summary) -> Place | None:
    """That of a result; None without a film's file, and of one whose film is that of another state."""
    path = pathlib.Path(f"{stem}.film.vtkhdf")
    told = summary.get("minimum_gap", {}).get("value")
    if not isinstance(told, float) or not path.exists():
        return None
    with reading(path), open_results(path) as file:
        points, fields = file["VTKHDF/Points"][...], file["VTKHDF/PointData"]
        if "gap" not in fields or "theta" not in fields:
            return None
        gap, theta = fields["gap"][...], fields["theta"][...]
        pad = fields["pad"][...] if "pad" in fields else numpy.zeros(len(gap))
    smallest = float(gap.min())
    if not abs(smallest - told) <= FITS*abs(smallest):
        return None
    is_ring = bool(numpy.ptp(points[:, 1]) > numpy.ptp(points[:, 2]))  # sectors lie across the axis
    if is_ring:
        across = numpy.hypot(points[:, 0], points[:, 1])
    else:  # of the second bearing of a rotor, too, from its own midplane
        across = points[:, 2] - 0.5*(points[:, 2].min() + points[:, 2].max())
    node, pads = node_of_thinnest(gap, theta, across, pad, is_ring)
    return Place(float(theta[node]), float(across[node]), int(pads[0]) if len(pads) == 1 and numpy.ptp(pad) > 0 else 0, len(pads), is_ring)


def node_of_thinnest(gap, theta, across, pad, is_ring) -> tuple[int, numpy.ndarray]:
    """The node where a film is thinnest, as the log has it, and the pads that are as thin: of places that are alike the last along the
    motion, which is the last in the file, and there the outermost of a ring, of a journal that nearest to the midplane, at +z."""
    smallest = gap.min()
    alike = numpy.flatnonzero(gap <= smallest + SAME*abs(smallest))
    pads = numpy.unique(pad[alike])
    own = alike[pad[alike] == pads[0]]
    own = own[numpy.abs(theta[own] - theta[own[-1]]) <= SAME]
    if not is_ring:
        far = numpy.abs(across[own])
        own = own[far <= far.min() + SAME*numpy.ptp(across)]
    return int(own[numpy.argmax(across[own])]), pads
