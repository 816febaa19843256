"""Stress at the roots of teeth whose load varies along the face, their neighbours' loads included."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, FreeEnds, at_radii, at_wave_numbers
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, half_width
from tribodyn.compliance.sharing.section import ObliqueFaces, elastic_section, length_per_width, raised
from tribodyn.compliance.sharing.slices import PairFlexibility, end_modes, modes, wave_numbers
from tribodyn.geometry.drive import SIDES
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.shapes import Array, Float

# Positions (of the mesh) taken at a time, to bound the memory.
_BATCH = 64


def root_stress(
    flexible: PairFlexibility,
    faces: ObliqueFaces,
    line_load: Float[Array, "position pair slice"],
    coupled: bool = True,
) -> tuple[Float[Array, "2 position pair slice"], Float[Array, "2 position pair slice"]]:
    """Maximum tension (positive) and compression (negative) along the root of every tooth, Pa.

    Of pinion and gear, (2, position, pair, slice). Stresses along the profile, of both fillets, from the
    middle of one gap to the middle of the next; those that the neighbours' loads make in the rim add to the
    tooth's own. Pairs stand one pitch apart, the one that entered first in front; line loads are per face
    width, in N/m. Not `coupled` each slice is in plane strain by itself.

    Of helical teeth in their elastic section (`section`), under the load's part in it; slices (last axis of
    `faces`) are touched at their own radii.
    """
    tension, compression = np.empty((2, *line_load.shape)), np.empty((2, *line_load.shape))
    for body, rows, stress in root_stress_fields(flexible, faces, line_load, coupled):
        tension[body, rows], compression[body, rows] = np.max(stress, axis=0), np.min(stress, axis=0)
    return tension, compression


def root_stress_fields(
    flexible: PairFlexibility,
    faces: ObliqueFaces,
    line_load: Float[Array, "position pair slice"],
    coupled: bool = True,
) -> Iterator[tuple[int, slice, Float[Array, "fillet_point position pair slice"]]]:
    """Stress at all points of both fillets, Pa: body, positions and field, a batch of positions at a time.

    See `root_stress`, which takes the extremes of these.
    """
    assembly = flexible.assembly
    positions, _, slices = line_load.shape
    length, section = flexible.width * length_per_width(assembly), elastic_section(assembly)
    wave_number = wave_numbers(length, slices, coupled)
    basis = modes(len(wave_number), slices)
    slice_load = line_load * (flexible.width / slices) * faces.within
    line_load = line_load * faces.within / length_per_width(assembly)
    reaches = faces.geometry.pinion_radius, faces.geometry.gear_radius
    # on the pinion the earlier tooth stands on the loaded flank's side, on the gear on the other
    for body, (side, gear, material, touched, sign) in enumerate(
        zip(SIDES, flexible.gears, flexible.materials, reaches, (1, -1), strict=True)
    ):
        reach = touched + raised(assembly, section, side)
        per_load = at_wave_numbers(gear, wave_number, material.poisson_ratio).root_stress
        place = at_radii(gear.radius, reach)
        ends = gear.ends if len(wave_number) > 1 else None
        weights = None if ends is None else (end_modes(ends, length, slices), at_radii(ends.radius, reach))
        for first in range(0, positions, _BATCH):
            rows = slice(first, first + _BATCH)
            stress = (
                _of_one_gear(per_load, _counted(line_load[rows], basis.T, place[rows], slices), sign) @ basis
            )
            if ends is not None and weights is not None:
                along, at_ends = weights
                counted = [_counted(slice_load[rows], along[parity], at_ends[rows]) for parity in (0, 1)]
                stress += _of_free_ends(ends, along, counted, sign)
            yield body, rows, stress


def _counted(
    load: Float[Array, "position pair slice"],
    along: Float[Array, "slice wave"],
    place: Float[Array, "position pair slice radius"],
    among: int = 1,
) -> Float[Array, "position pair radius wave"]:
    """Loads, divided `among` some, as amplitudes of waves at the flank's positions.

    `place` is of every slice, or one for all.
    """
    if place.shape[2] == 1:
        return place[:, :, 0, :, None] * (load @ along / among)[:, :, None, :]
    return np.einsum("tjs,sn,tjsm->tjmn", load, along / among, place, optimize=True)


def _of_one_gear(
    per_load: Float[Array, "mode sector 2 point radius"],
    amplitude: Float[Array, "position pair radius wave"],
    sign: int,
) -> Float[Array, "fillet_point position pair wave"]:
    """Amplitudes (point, position, pair, n) of the stress, Pa, at the points of both fillets.

    `per_load` (1 or n, sector, fillet, point, M) per unit line load, `amplitude` (position, pair, M, n) of
    the line loads, N/m, at the flank's positions.
    """
    positions, pairs, _, count = amplitude.shape
    every = np.broadcast_to(per_load, (count, *per_load.shape[1:]))
    total = np.zeros((count, np.prod(per_load.shape[2:4]), positions, pairs))
    for sector, read, loaded in _sectors(pairs, sign):
        rows = every[:, sector].reshape(count, -1, per_load.shape[-1])
        total[..., read] += np.einsum("npm,tjmn->nptj", rows, amplitude[:, loaded], optimize=True)
    return total.transpose(1, 2, 3, 0)


def _of_free_ends(
    ends: FreeEnds,
    along: Float[Array, "2 slice wave"],
    counted: list[Float[Array, "position pair radius wave"]],
    sign: int,
) -> Float[Array, "fillet_point position pair slice"]:
    """What free end faces add to the stress (point, position, pair, slice), Pa.

    `along` as made by `end_modes`, `counted` the loads' amplitudes of both parities, N/m.
    """
    positions, pairs = counted[0].shape[:2]
    waves, points = len(ends.wave_number), np.prod(ends.root_stress.shape[4:6])
    total = np.zeros((points, positions, pairs, along.shape[1]))
    for parity in (0, 1):
        for sector, read, loaded in _sectors(pairs, sign):
            rows = ends.root_stress[parity, :, :, sector].reshape(waves, waves, points, -1)
            amplitudes = np.einsum("klpm,tjml->ptjk", rows, counted[parity][:, loaded], optimize=True)
            total[:, :, read] += amplitudes @ along[parity].T
    return total


def _sectors(pairs: int, sign: int) -> Iterator[tuple[int, slice, slice]]:
    """Sector, the pairs that are read and those that load them, for all that are near enough."""
    nearest = min(pairs - 1, NEIGHBOURS)
    for pitches in range(-nearest, nearest + 1):
        # the tooth that is read entered `pitches` before the loaded one
        read = slice(max(-pitches, 0), pairs - max(pitches, 0))
        loaded = slice(max(pitches, 0), pairs - max(-pitches, 0))
        yield NEIGHBOURS + sign * pitches, read, loaded


# Stress at the flanks and roots of teeth whose loads are known over whole mesh cycles.
#
# The loads may be those of slow rotation or of a motion: Hertz and finite elements take them as they are. A
# tooth is followed from before its mesh to after it, as long as its neighbours' loads reach it through the
# rim.


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
    seen = flanks.contacts(angles)
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
