"""Types of fields that the tables of several kinds of study share."""

from typing import Annotated

from pydantic import Field

from tribodyn.scenario import units
from tribodyn.scenario.quantity import Quantity

Torque = Annotated[float, Quantity(units.TORQUE)]
Inertia = Annotated[float, Quantity(units.not_negative(units.INERTIA))]
TorsionalDamping = Annotated[float, Quantity(units.not_negative(units.TORSIONAL_DAMPING))]
Angle = Annotated[float, Quantity(units.ANGLE_KIND)]
SignedLength = Annotated[float, Quantity(units.LENGTH)]
Slices = Annotated[int, Field(strict=True, ge=1, le=501)]
Name = Annotated[str, Field(strict=True, pattern=r"^\w[\w .-]*$")]
"""A scenario's name, which also names its record."""
