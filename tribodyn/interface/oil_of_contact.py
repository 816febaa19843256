"""The oil of a solved contact by the name of a lubricant: its numbers at a temperature, and its fluid."""

from typing import Any

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.input.tables.oil.lubricant import read_lubricant
from tribodyn.tribology.ehl.fluid import Fluid
from tribodyn.tribology.ehl.problem import positive
from tribodyn.tribology.high_pressure import ContactViscosity
from tribodyn.tribology.oil import LubricantData
from tribodyn.tribology.pressure_law import asymptotic_coefficient


def named_oil(name: str, temperature: float | None, numbers: tuple[Any, ...]) -> LubricantData:
    """Return the lubricant at its temperature; InputError beside other numbers, or without a temperature."""
    if not isinstance(name, str):
        rule, remedy = "not the name of a lubricant", "name a shipped one, or the path of a file: oil.toml"
        raise InputError("lubricant", quoted(name), rule, remedy)
    keys = ("viscosity", "pressure_viscosity", "viscosity_pressure_index", "temperature_viscosity")
    for key, value in zip(keys, numbers, strict=True):
        if value is not None:
            raise InputError(
                key, value, f"contradicts lubricant = {quoted(name)}, which gives it", "leave it out"
            )
    if temperature is None:
        raise InputError("oil_temperature", None, "missing: the lubricant needs it", "give it in K: 353.15")
    return read_lubricant(name, positive("oil_temperature", temperature, "K"))


def fluid_of(oil: LubricantData, at: ContactViscosity, band: str) -> Fluid:
    """Return the fluid of an oil, with the best estimate or an end of its band."""
    laws = {"best": at.law, "lowest": at.lowest, "highest": at.highest}
    if band not in laws:
        raise unknown_name("viscosity_band", str(band), laws, "end of a band")
    eta, alpha = float(oil.inlet_viscosity), float(oil.pressure_viscosity)
    if (law := laws[band]) is None:
        if band != "best":
            raise InputError("viscosity_band", quoted(band), f"there is none: {at.origin}", 'write "best"')
        return Fluid(eta, alpha, min(float(oil.viscosity_pressure_index), 1.0))
    return Fluid(eta, asymptotic_coefficient(law), law=law)
