"""A case of the gear with rolling elements: everything one run needs to know, in SI units."""

from dataclasses import dataclass

from tribodyn.studies.protocol.study import CaseHead
from tribodyn.studies.rolling.engagement import Mode, RollingFriction
from tribodyn.studies.rolling.geometry import RollingDrive


@dataclass(frozen=True)
class RollingCase(CaseHead):
    """One run of a gear with rolling elements, complete.

    Parameters
    ----------
    title, name, kind, toml, sha256 : as in `tribodyn.studies.gear_pair.case.Case`; `kind` is "irefc"
    mode : motion in time with corrected speeds, or the paper's single position with its printed formulas
    input_power : power of the shaft, W
    input_speed : speed of the shaft, rad/s
    samples_per_cycle : int
        Samples while an element takes its neighbour's place: a cycle, of which a revolution has Z2 + 1.
    """

    mode: Mode
    drive: RollingDrive
    input_power: float
    input_speed: float
    friction: RollingFriction
    samples_per_cycle: int = 40
