"""Rolling bearings by type, as rows of rolling elements; the sizes are those of one row."""

from typing import Literal, cast

import numpy as np

from tribodyn.train.elastic.rolling_bearing import BallRow, BearingRows, RollerRow, answer

#: Pairs: lines of contact meet the axis outside the rows (O, back to back), between them (X, face to face),
#: or run side by side.
Arrangement = Literal["O", "X", "tandem"]
#: Radius of a barrel's profile over that of its raceways: 79.959/81.585 mm of the 22317 that Harris takes as
#: example (Rolling Bearing Analysis, chapter 2; from memory).
OSCULATION = 0.98
#: Groove radius over ball diameter of the inner ring of self-aligning ball bearings, ISO 281 (at most).
SELF_ALIGNING_CONFORMITY = 0.53


def paired(row: BallRow | RollerRow, distance: float, arrangement: Arrangement) -> BearingRows:
    """Two rows whose middles are so far apart (m); of a tandem both push as the row given does."""
    lower, upper = {"O": (1, -1), "X": (-1, 1), "tandem": (row.thrust, row.thrust)}[arrangement]
    ends = ((lower, -distance / 2.0), (upper, distance / 2.0))
    return BearingRows(tuple(row._replace(thrust=thrust, offset=offset) for thrust, offset in ends))


def preload_of_force(row: BallRow | RollerRow, force: float) -> float:
    """Axial displacement of the rings against each other under an axial force (N), m."""
    from scipy.optimize import brentq  # heavy, and most pairs have no such bearing

    alone = row._replace(thrust=1, preload=0.0)

    def missing(displacement: float) -> float:
        return float(answer(alone, np.array([0.0, 0.0, displacement, 0.0, 0.0])).force[2]) - force

    return cast(float, brentq(missing, 0.0, row.diameter))


def four_point(row: BallRow) -> BearingRows:
    """Balls between rings with two grooves each: every ball is pressed along either diagonal, or both."""
    return paired(row, 0.0, "O")


def self_aligning_balls(row: BallRow) -> BearingRows:
    """Two rows in a spherical outer raceway; α is that of their lines through the bearing's middle."""
    return paired(row._replace(conformity=SELF_ALIGNING_CONFORMITY, aligning=True), 0.0, "X")


def spherical_rollers(row: RollerRow) -> BearingRows:
    """Two rows of barrels in a spherical outer raceway, inner raceways of the same profile."""
    raceway = row.pitch_diameter / (2.0 * np.cos(row.contact_angle)) + row.diameter / 2.0
    return paired(_barrels(row, float(raceway)), 0.0, "X")


def toroidal_rollers(row: RollerRow, raceway: float) -> RollerRow:
    """Long barrels between rings whose profiles have the same radius (m), larger than the raceway's own.

    They find their place along the axis and their tilt. A displacement s of the rings along the axis takes
    s²/(2 ρ − D) of the diametral clearance.
    """
    return _barrels(row, raceway)._replace(centres=2.0 * raceway - row.diameter)


def _barrels(row: RollerRow, raceway: float) -> RollerRow:
    crown = 2.0 * (1.0 / OSCULATION - 1.0) / raceway
    return row._replace(aligning=True, profiled=False, crown=crown)
