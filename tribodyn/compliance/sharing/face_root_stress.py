"""Stress at the roots of teeth whose load varies along the face, their neighbours' loads included."""

from collections.abc import Iterator

import numpy as np

from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, FreeEnds, at_radii, at_wave_numbers
from tribodyn.compliance.sharing.oblique_faces import ObliqueFaces
from tribodyn.compliance.sharing.section import elastic_section, length_per_width, raised
from tribodyn.compliance.sharing.slices import PairFlexibility, end_modes, modes, wave_numbers
from tribodyn.geometry.drive import SIDES
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
