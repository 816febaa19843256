"""Strength of the materials of a pair of gears: given, or by ISO 6336-5."""

from typing import cast

from tribodyn.gears.by_standard import metal_of
from tribodyn.gears.case import GearCase
from tribodyn.standards.metals import VICKERS, Grade, Metal, hardness_range


def metals_of(case: GearCase) -> tuple[Metal, Metal] | None:
    """Strength of both gears' materials; None where one's is not known."""
    pinion, gear = (metal_of(material) for material in case.materials)
    return None if pinion is None or gear is None else (pinion, gear)


def metal_remarks(case: GearCase) -> list[str]:
    """What is taken for the strength of the materials, and where hardness is outside the standard's range."""
    remarks = []
    for material in dict.fromkeys(case.materials):
        if material.treatment is None:
            remarks.append(f"{material.name} has no heat treatment: no safety against pitting and bending.")
            continue
        metal = cast(Metal, metal_of(material))
        origin = "given" if material.contact_stress_limit and material.bending_stress_limit else "ISO 6336-5"
        text = f"Strength of {material.name}, {material.grade}: σ_Hlim {metal.contact_limit * 1e-6:.0f}"
        remarks.append(f"{text} and σ_Flim {metal.bending_limit * 1e-6:.0f} N/mm² ({origin}).")
        low, high = hardness_range(metal.treatment, cast(Grade, material.grade))
        hardness = material.hardness / VICKERS
        if origin != "given" and not 0.98 * low <= hardness <= 1.02 * high:
            remarks.append(
                f"{material.name}: {hardness:.0f} HV are outside the {low:g} to {high:g} of ISO 6336-5; its "
                "stress numbers are those of the end of the range."
            )
    return remarks
