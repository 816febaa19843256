"""Stress at the flanks and roots of teeth whose loads are known over whole mesh cycles.

The loads may be those of slow rotation or of a motion: Hertz and finite elements take them as they are. A
tooth is followed from before its mesh to after it, as long as its neighbours' loads reach it through the rim.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS
from tribodyn.compliance.sharing.face_root_stress import root_stress_fields
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, half_width
from tribodyn.compliance.sharing.loaded_contact import slice_contacts
from tribodyn.numerics.processes.blas_threads import one_blas_thread
from tribodyn.numerics.shapes import Array, Float


class Peak(NamedTuple):
    """Where a stress is largest."""

    value: float  # Pa
    at: tuple[int, int, int, int]  # cycle, position, pair, slice
    #: max/mean over the face, 1 where it is even: of the largest stresses of all slices
    along_face: float


class ToothStress(NamedTuple):
    """Stress of teeth over mesh cycles, Pa."""

    pressure: Float[Array, "cycle position pair slice"]  # Hertz
    pressure_peak: Peak  # `along_face` of line loads as the pressures tell them
    #: root, root_peak: of pinion and gear; the stress at the point of the fillets with the largest tension
    #: of each tooth in turn, from `NEIGHBOURS` pitches before its mesh to as many after it
    root: tuple[Float[Array, "tooth time"], Float[Array, "tooth time"]]
    root_peak: tuple[Peak, Peak]


@one_blas_thread()
def tooth_stress(
    flanks: LoadedFlanks,
    roll: Float[Array, "position pair"],
    slice_load: Float[Array, "cycle position pair slice"],
) -> ToothStress:
    """Find pressures and root stresses of loads (N) of the slices of all pairs.

    `roll` are the pairs' angles from the pitch point in a mesh cycle, rad, the pair that entered first in
    front; a pair goes on in the place before its own in the next cycle. After the last of the cycles the
    first one follows again. In corner contact the curvature is that of the end of the path.
    """
    flexible, _, slices, coupled = flanks
    cycles, positions, pairs, _ = slice_load.shape
    beyond = ((0, 0), (NEIGHBOURS, NEIGHBOURS))
    # teeth beside the mesh carry nothing, wherever they are
    angles = np.tile(np.pad(roll, beyond), (cycles, 1))
    loads = np.pad(slice_load.reshape(cycles * positions, pairs, slices), (*beyond, (0, 0)))
    seen = slice_contacts(flanks, angles)
    per_width = loads * (slices / flexible.width)
    line_load = per_width / seen.length
    half = half_width(flexible, seen.curvature, line_load)
    with np.errstate(invalid="ignore", divide="ignore"):
        hertz_pressure = np.where(line_load > 0.0, 2.0 * line_load / (np.pi * half), 0.0)
    pressure = hertz_pressure[:, NEIGHBOURS : NEIGHBOURS + pairs].reshape(slice_load.shape)
    highest = np.max(pressure, axis=(0, 1, 2))
    mean = np.sqrt(np.mean(highest**2))  # of line loads, which go with the square
    roots: list[Float[Array, "tooth time"]] = []
    peaks: list[Peak] = []
    shape = cycles, positions, pairs + 2 * NEIGHBOURS
    fields: tuple[list[np.ndarray], list[np.ndarray]] = ([], [])
    for body, _, field in root_stress_fields(flexible, seen, per_width, coupled):
        fields[body].append(field)
    for of_body in fields:
        stress = np.concatenate(of_body, axis=1)
        point, row, pair, part = np.unravel_index(int(np.argmax(stress)), stress.shape)
        largest = np.max(stress, axis=(0, 1, 2))
        cycle, position = divmod(int(row), positions)
        at = cycle, position, int(pair) - NEIGHBOURS, int(part)
        peaks.append(Peak(float(largest[part]), at, float(largest[part] / np.mean(largest))))
        roots.append(_followed(stress[point, :, :, part].reshape(shape)))
    where = tuple(int(i) for i in np.unravel_index(int(np.argmax(pressure)), pressure.shape))
    at = where[0], where[1], where[2], where[3]
    top = float(pressure[at])
    return ToothStress(pressure, Peak(top, at, float(top / mean)), (roots[0], roots[1]), (peaks[0], peaks[1]))


def _followed(stress: Float[Array, "cycle position pair"]) -> Float[Array, "tooth time"]:
    """The same of one tooth after the other: in every cycle it moves on by a place to the front."""
    cycles, _, places = stress.shape
    teeth = [
        [stress[(first + age) % cycles, :, places - 1 - age] for age in range(places)]
        for first in range(cycles)
    ]
    return np.array([np.concatenate(tooth) for tooth in teeth])
