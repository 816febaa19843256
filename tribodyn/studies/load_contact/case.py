"""A case of the static load contact study: everything one run needs to know, in SI units."""

from dataclasses import dataclass

from tribodyn.studies.gears.case import GearCase, LubricatedCase


@dataclass(frozen=True, kw_only=True)
class LoadContactCase(GearCase):
    """One study of teeth in slow rotation under load, complete.

    Parameters
    ----------
    gear_torques : tuple of float
        Torques of the Harris map, > 0 and increasing, N m; empty: none is made.
    friction_coefficient : float
        μ of all pairs, ≥ 0.
    positions_per_cycle : int
        Positions of the pinion in one mesh cycle.
    cycles : int
        Mesh cycles to roll through; more than one where teeth differ.
    lubricated : LubricatedCase or None
        The same gears with oil, at a speed > 0, for the film over the face; None: there is no lubricant.
    """

    gear_torques: tuple[float, ...] = ()
    friction_coefficient: float = 0.0
    positions_per_cycle: int = 60
    cycles: int = 1
    lubricated: LubricatedCase | None = None
