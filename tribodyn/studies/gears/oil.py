"""What `check` and summaries say of a lubricant: every number that the laws read, and where it is from."""

from typing import Any

from tribodyn.studies.protocol.study import TextTable
from tribodyn.tribology.lubricant import LubricantData, oil_values
from tribodyn.tribology.oil import GIVEN, T_40, T_100, ZERO_CELSIUS, kinematic_viscosity

#: Factor to the unit that is shown, and that unit, by SI unit.
_SHOWN = {"Pa s": (1e3, "mPa s"), "1/Pa": (1e9, "1/GPa"), "1": (1.0, "")}


def oil_data(lubricant: LubricantData) -> dict[str, Any]:
    """Return every number of a lubricant by name: `value` (SI), `unit`, `origin` and, where known, `spread`.

    With a data sheet also `type`, `oil_temperature`, `temperature`, at which the numbers hold, K, and
    `kinematic_viscosity`.
    """
    found: dict[str, Any] = {}
    if (sheet := lubricant.sheet) is not None:
        kinematic = kinematic_viscosity(sheet.viscosity_40, sheet.viscosity_100, lubricant.temperature)
        found["type"] = sheet.type
        warmer = lubricant.supply is not None
        around = lubricant.supply if warmer else lubricant.temperature
        origin = "operating.oil_temperature, or the network of [temperature]" if warmer else GIVEN
        found["oil_temperature"] = {"value": around, "unit": "K", "origin": origin}
        origin = "bulk temperature of the teeth" if warmer else "that of the oil"
        found["temperature"] = {"value": lubricant.temperature, "unit": "K", "origin": origin}
        found["kinematic_viscosity"] = {"value": kinematic, "unit": "m2/s", "origin": "ASTM D341"}
    for name, one in oil_values(lubricant).items():
        found[name] = {"value": float(one.value), "unit": one.unit, "origin": one.origin}
        if one.spread is not None:
            found[name]["spread"] = list(one.spread)
    return found


def oil_table(lubricant: LubricantData) -> TextTable:
    """Return the same as a table."""
    rows = []
    for name, one in oil_data(lubricant).items():
        if name in ("type", "oil_temperature", "temperature"):
            continue
        factor, unit = (
            (1e6, "mm2/s") if one["unit"] == "m2/s" else _SHOWN.get(one["unit"], (1.0, one["unit"]))
        )
        spread = " to ".join(f"{factor * end:.4g}" for end in one.get("spread", ()))
        rows.append((name, f"{factor * one['value']:.4g}", unit, one["origin"], spread))
    title = "Lubricant"
    if (sheet := lubricant.sheet) is not None:
        where = ", bulk temperature of the teeth" if lubricant.supply is not None else ""
        title += f" ({sheet.type}) at {lubricant.temperature - ZERO_CELSIUS:.4g} °C{where}"
    return TextTable(title, ("quantity", "value", "unit", "from", "spread"), rows)


def oil_remarks(lubricant: LubricantData) -> list[str]:
    """Say what is extrapolated beyond the data sheet's two temperatures."""
    if lubricant.sheet is None or T_40 <= lubricant.temperature <= T_100:
        return []
    return [
        f"The oil at {lubricant.temperature - ZERO_CELSIUS:.4g} °C: viscosity extrapolated beyond the data "
        "sheet's 40 to 100 °C by ASTM D341."
    ]
