"""What every tabulation of a mesh cycle demands of its input."""

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.drive import SIDES, Drive, Side, body_of
from tribodyn.mesh.data import MeshData
from tribodyn.numerics.elementary import is_jax
from tribodyn.numerics.shapes import Array, Float


def check_bores(drive: Drive) -> None:
    """Refuse a solid body where its elasticity is needed: it is held at its bore.

    Traced radii are not checked.

    Raises
    ------
    InputError
        Names the bore.
    """
    for side in SIDES:
        bore = body_of(drive, side).bore_radius
        if not is_jax(bore) and bore <= 0:
            raise InputError(
                f"drive.{side}.bore_radius",
                bore,
                "the elastic body is held at its bore",
                "give the radius at which the shaft holds it",
            )


def check_foundation(side: Side, compliance: Float[Array, "*contact"]) -> None:
    """Refuse a body whose compliance by the fitted polynomials is not positive: far outside their range.

    Traced values are not checked.

    Raises
    ------
    InputError
        Names the key that chooses another body.
    """
    if not is_jax(compliance) and not np.all(compliance > 0):
        raise InputError(
            "mesh.foundation",
            '"sainsot-velex"',
            f"far outside their range, the fitted polynomials give the {side}'s body no positive compliance",
            'use "ring"',
        )


def check_backlash(mesh: MeshData, back: bool) -> None:
    """Refuse back flanks at no distance."""
    if back and mesh.backlash is None:
        raise InputError(
            "mesh.backlash", rule="is needed for the contact of back flanks", remedy="give a length"
        )
