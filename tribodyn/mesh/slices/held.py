"""How slices of one tooth, and of two on one body, hold each other: deflections of all under loads on each.

The law of it is that of `coupled`. Neither gaps nor the torque change these matrices.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.energy import LoadedTooth, loaded_tooth, tooth_compliance, under_uneven_load
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData
from tribodyn.geometry.helix import normal_module
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import RollCurve, body_coupling
from tribodyn.numerics.elementary import cos, namespace, sqrt
from tribodyn.numerics.iteration import by_rows
from tribodyn.numerics.remembered import remembered
from tribodyn.numerics.shapes import Array, Float

#: ℓ_t and ℓ_b over the normal module.
TEETH_LENGTH, BODIES_LENGTH = 1.4, 3.0
#: Nodes that are solved at a time.
ROWS = 32
_WAVES = 4  # waves of the face per slice


class FrontSlots(NamedTuple):
    """Driving flanks of a table, (N, Q)."""

    signed_distance: Any
    compliance: Any
    share: Any
    arms: Any
    slices: int


def matrices(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    seen: FrontSlots,
    near: Array,
) -> tuple[Callable[[Any], list[Any]], tuple[Any, ...]]:
    """Make of rows the matrix, the contact's compliance, arms and shares of slots that are near; and rows."""
    r, slices, share = seen.signed_distance, seen.slices, seen.share
    loaded = [loaded_tooth(assembly, side, mesh.held) for side in SIDES]
    teeth, even, even_between = _parts(assembly, materials, mesh, loaded, r, slices)
    contact_compliance = seen.compliance - slices * (teeth + even)  # of the contact alone
    uneven = loaded if mesh.held else [under_uneven_load(tooth) for tooth in loaded]
    _, bodies, between = _parts(assembly, materials, mesh, uneven, r, slices)
    width = assembly.common_width / cos(assembly.drive.helix_angle)
    wave = np.pi * np.arange(_WAVES * slices) / width * normal_module(assembly.drive)
    falling = 1.0 / (1.0 + (TEETH_LENGTH * wave) ** 2), 1.0 / (1.0 + BODIES_LENGTH * wave)
    # a slice touches with its early part while it enters, with its late part while it leaves
    signs = namespace(*seen[:4], wave).sign(r)
    middle = (np.arange(share.shape[1]) % slices + 0.5 + signs * (1.0 - share) / 2.0) / slices

    def at_nodes(rows: Any) -> list[Any]:
        slot, between, even_between, *fields = rows
        at = np.arange(len(slot))[:, None]
        line, body, whole, contact, arm, part, place = (field[at, slot] for field in fields)
        along = spread(place, part, falling, slices)
        matrix = slices * _matrix(line, body, between, along, slot)
        if not mesh.held:  # what a load over the whole face does not meet
            over_face, same = _by_slots(even_between - between, slot)
            bodies_over_face = whole - body
            matrix = matrix + (
                over_face + same * (bodies_over_face[:, :, None] + bodies_over_face[:, None, :]) / 2.0
            )
        return [matrix, contact, arm, part]

    fields = teeth, bodies, even, contact_compliance, seen.arms, share, middle
    return at_nodes, (between, even_between, *fields)


@remembered(3)
def kept_matrices(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    seen: FrontSlots,
    near: Array,
) -> list[Any]:
    """What `matrices` makes of all rows: neither gaps nor the torque change it."""
    maker, made_of = matrices(assembly, materials, mesh, seen, near)
    return by_rows(maker, (near, *made_of), ROWS)


def spread(
    middle: Float[Array, "*node slot"],
    share: Float[Array, "*node slot"],
    factors: tuple[Float[Array, " wave"], ...],
    slices: int,
) -> list[Float[Array, "*node slot slot"]]:
    """Share of what a slice's load moves at another, of compliances that fall by factors with the wave.

    The waves are the cosines of the face, from the even one on; middles of the parts that touch are over its
    width. Of slices that touch over their whole width the shares of all loads sum up to 1.
    """
    xp, number = namespace(middle, share, *factors), np.arange(len(factors[0]))
    if xp is np and middle.ndim > 1:  # slices that touch over their whole width are the same at all nodes
        parts, place = np.unique(middle + 1j * share, return_inverse=True)
        place = place.reshape(middle.shape)
        at = place[..., :, None], place[..., None, :]
        return [one[at] for one in spread(np.real(parts), np.imag(parts), factors, slices)]
    basis = xp.cos(np.pi * number * middle[..., None]) * xp.sinc(number * share[..., None] / (2.0 * slices))
    weight = np.where(number > 0, 2.0, 1.0) / slices
    return [(basis * (weight * factor)) @ xp.swapaxes(basis, -1, -2) for factor in factors]


def _parts(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    tooth: list[LoadedTooth],
    r: Float[Array, "node slot"],
    slices: int,
) -> tuple[Float[Array, "node slot"], Float[Array, "node slot"], Float[Array, "node slice pair pair"]]:
    """Compliance of teeth and of bodies (N, Q) under a load over the whole face, and between pairs, m/N."""
    curve = RollCurve(*assembly.roll_limits)
    width = assembly.common_width
    nodes = assembly.path.signed_distance(curve.nodes())
    parts = [
        tooth_compliance(t, m, width, nodes, mesh.foundation) for t, m in zip(tooth, materials, strict=True)
    ]
    bodies = parts[0].foundation + parts[1].foundation
    teeth = parts[0].total + parts[1].total - bodies
    loads = [part.root_load for part in parts]
    together = namespace(teeth, bodies, *loads).concatenate(
        [teeth[..., None], bodies[..., None], *loads], axis=-1
    )
    channels = curve.interpolate(together, assembly.path.rotation(r))
    pairs = r.shape[1] // slices
    between = np.zeros((r.shape[0], slices, pairs, pairs))
    if mesh.foundation_coupling:
        load = channels[..., 2:].reshape(r.shape[0], pairs, slices, 6).swapaxes(1, 2)
        between = between + body_coupling(tooth, materials, load[..., :3], load[..., 3:], pairs)
    return channels[..., 0], channels[..., 1], between


def _matrix(
    teeth: Float[Array, "node place"],
    bodies: Float[Array, "node place"],
    between: Float[Array, "node slice pair pair"],
    along: list[Float[Array, "node place place"]],
    slot: Any,
) -> Float[Array, "node place place"]:
    """Deflection of slots per load on slots over the number of slices, without the contact.

    `slot` (node, place): the slots' numbers.
    """
    matrix, same = _by_slots(between, slot)
    matrix = matrix * along[1]
    for part, spreading in zip((teeth, bodies), along, strict=True):
        root = sqrt(part)
        matrix = matrix + same * root[:, :, None] * spreading * root[:, None, :]
    return matrix


def _by_slots(between: Float[Array, "node slice pair pair"], slot: Any) -> tuple[Any, Any]:
    """What couples pairs in a slice as between slots, in the mean of both slices; and whether of one pair."""
    _, slices, pairs, _ = between.shape
    pair, part = slot // slices, slot % slices
    # places in the array laid out flat: to take them is faster than by four indices
    at = (np.arange(len(slot))[:, None] * slices + part) * pairs**2
    one, other = pair[:, :, None], pair[:, None, :]
    both = one * pairs + other
    flat = between.reshape(-1)
    matrix = flat[at[:, :, None] + both] + flat[at[:, None, :] + both]
    return matrix / 2.0, one == other
