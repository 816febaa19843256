"""What standards of load capacity need to know beside the gears and their duty."""

from typing import Literal

from pydantic import Field

from tribodyn.scenario.quantity import Positive, Switch, Table


class RatingTable(Table):
    """What the standards need to know."""

    application_factor: Positive = Field(1.0, description="K_A, what the driven and the driving machine add")
    lubrication: Literal["dip", "spray", "submerged"] = Field(
        "dip", description="how the oil gets to the mesh"
    )
    structure_factor: Positive = Field(
        1.0, description="X_W: 1 of case-hardened steel, 1.5 nitrided (ISO/TS 6336-20, table 2)"
    )
    adequate_tip_relief: Switch = Field(
        False, description="whether the standards may count on the tip relief that the flanks have"
    )
