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

    title: quantity.Text = OWN_VALUES
    source: quantity.Text = "not stated"
    assumptions: quantity.Text = ""


class Material(Described):
    """A solid (`models/materials/`)."""

    youngs_modulus: Pressure
    poisson_ratio: Annotated[float, Field(strict=True, ge=0, lt=0.5)]
    density: Annotated[float, quantity.InUnit(units.positive(units.DENSITY))]
    thermal_conductivity: Annotated[float, quantity.InUnit(units.positive(units.CONDUCTIVITY))]
    specific_heat: Annotated[float, quantity.InUnit(units.positive(units.SPECIFIC_HEAT))]
    hardness: Annotated[float, quantity.InUnit(units.positive(units.PRESSURE), "7 GPa")]
    treatment: Treatment | None = None
    grade: Grade = "MQ"
    contact_stress_limit: Strength | None = None
    bending_stress_limit: Strength | None = None
    yield_strength: Strength | None = None


MaterialReference = Annotated[Material, quantity.model_file("materials")]
