"""What is taken off the flanks on purpose or by error, and how the axes deviate: lengths and angles, SI."""

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from tribodyn.case import Table


class Relief(NamedTuple):
    """Relief of one end of the profile.

    Parameters
    ----------
    amount : float
        Material missing at the end of the active profile, m along the normal.
    length : float
        How far it reaches from that end, m along the line of action (|Δr|).
    exponent : float
        1: linear, 2: parabolic.
    """

    amount: float = 0.0
    length: float = 0.0
    exponent: float = 1.0


class LeadRelief(NamedTuple):
    """Relief along the face: parabola, straight part in the middle, parabola (Jia et al., y1, y2, y3).

    Parameters
    ----------
    start, end : float
        Material missing at both ends of the face, m along the normal.
    unmodified : float
        Length of the straight part, m.
    """

    start: float = 0.0
    end: float = 0.0
    unmodified: float = 0.0


class FlankModification(NamedTuple):
    """How the driving flanks of one gear differ from the family's.

    Parameters
    ----------
    tip, root : Relief
    lead : LeadRelief
    profile_error : Table or None
        Material missing along the normal over the pinion's roll angle from the pitch point (rad, m).
    pitch_error : tuple of float
        One a tooth, m along the normal, positive where material is missing; empty: none.
    """

    tip: Relief = Relief()
    root: Relief = Relief()
    lead: LeadRelief = LeadRelief()
    profile_error: "Table | None" = None
    pitch_error: tuple[float, ...] = ()


class Misalignment(NamedTuple):
    """Angles between the axes, rad (ISO 6336-1, ISO/TR 10064-3).

    Parameters
    ----------
    in_plane : float
        Within the plane of action.
    out_of_plane : float
        Perpendicular to it.
    """

    in_plane: float = 0.0
    out_of_plane: float = 0.0


class Modifications(NamedTuple):
    """Flanks of both gears, and how their axes stand."""

    pinion: FlankModification = FlankModification()
    gear: FlankModification = FlankModification()
    misalignment: Misalignment = Misalignment()


UNMODIFIED = Modifications()


def vary_along_lead(modifications: Modifications) -> bool:
    """Whether anything differs from place to place along the face."""
    both = (modifications.pinion, modifications.gear)
    return any(modifications.misalignment) or any(flank.lead.start or flank.lead.end for flank in both)
