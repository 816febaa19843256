"""What every tabulation of a mesh cycle demands of its input."""

from tribodyn.errors import InputError
from tribodyn.geometry.drive import SIDES, Drive, body_of
from tribodyn.mesh.data import MeshData
from tribodyn.numerics.elementary import is_jax


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


def check_backlash(mesh: MeshData, back: bool) -> None:
    """Refuse back flanks at no distance."""
    if back and mesh.backlash is None:
        raise InputError(
            "mesh.backlash", rule="is needed for the contact of back flanks", remedy="give a length"
        )
