"""What every model of `models/` begins with, and the materials."""

from typing import Annotated

from pydantic import Field

from tribodyn.input import quantity, units
from tribodyn.standards.metals import Grade, Treatment

Pressure = Annotated[float, quantity.InUnit(units.positive(units.PRESSURE))]
Strength = Annotated[float, quantity.InUnit(units.positive(units.PRESSURE), "1500 MPa")]

#: Title of a model that a scenario writes out.
OWN_VALUES = "own values"


class Described(quantity.Table):
    """What every model begins with; a table in a scenario may leave it out."""

    title: quantity.Text = Field(OWN_VALUES, description="what it is, in a line")
    source: quantity.Text = Field("not stated", description="where the numbers come from")
    assumptions: quantity.Text = Field("", description="what the source does not give and was chosen here")


class Material(Described):
    """A solid (`models/materials/`)."""

    youngs_modulus: Pressure
    poisson_ratio: Annotated[float, Field(strict=True, ge=0, lt=0.5)]
    density: Annotated[float, quantity.InUnit(units.positive(units.DENSITY))]
    thermal_conductivity: Annotated[float, quantity.InUnit(units.positive(units.CONDUCTIVITY))]
    specific_heat: Annotated[float, quantity.InUnit(units.positive(units.SPECIFIC_HEAT))]
    hardness: Annotated[float, quantity.InUnit(units.positive(units.PRESSURE), "7 GPa")] = Field(
        description="Vickers hardness as a pressure"
    )
    treatment: Treatment | None = Field(
        None, description="heat treatment by ISO 6336-5; needed for safeties against pitting and bending"
    )
    grade: Grade = Field("MQ", description="quality of the material by ISO 6336-5")
    contact_stress_limit: Strength | None = Field(
        None, description="σ_Hlim; default: by treatment, grade and hardness"
    )
    bending_stress_limit: Strength | None = Field(
        None, description="σ_Flim; default: by treatment, grade and hardness"
    )
    yield_strength: Strength | None = Field(
        None, description="of the root, of through-hardened steel; default: from the hardness"
    )


MaterialReference = Annotated[Material, quantity.model_file("materials")]
