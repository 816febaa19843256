"""The functions given by points that a scenario may hold, or name as CSV files."""

from typing import Annotated

from tribodyn.scenario import units
from tribodyn.scenario.quantity import Column, CurveTable

RollAngles = Annotated[Column, units.ANGLE_KIND]


class TorqueCurve(CurveTable):
    """Torque over time that is added to the load; held constant outside the points."""

    time: Annotated[Column, units.TIME]
    torque: Annotated[Column, units.TORQUE]


class StiffnessCurve(CurveTable):
    """Stiffness of a single pair over the pinion's roll angle from the pitch point."""

    roll_angle: RollAngles
    stiffness: Annotated[Column, units.positive(units.STIFFNESS)]


class ErrorCurve(CurveTable):
    """Error of a pair's flanks over the pinion's roll angle from the pitch point."""

    roll_angle: RollAngles
    error: Annotated[Column, units.LENGTH]


class LoadCurve(CurveTable):
    """Normal load of a pair over the pinion's roll angle from the pitch point; below 0 it counts as 0."""

    roll_angle: RollAngles
    normal_load: Annotated[Column, units.FORCE]
