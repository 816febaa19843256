"""Strength of a gear's material: given, or by ISO 6336-5."""

from typing import cast

from tribodyn.geometry.drive import MaterialData
from tribodyn.standards.metals import (
    BENDING,
    CONTACT,
    Grade,
    Metal,
    Treatment,
    stress_number,
    yield_from_hardness,
)


def metal_of(material: MaterialData) -> Metal | None:
    """Strength of a material: given, or by ISO 6336-5; None where its heat treatment is not said."""
    if material.treatment is None:
        return None
    treatment, grade = cast(Treatment, material.treatment), cast(Grade, material.grade)
    contact, root = material.contact_stress_limit, material.bending_stress_limit
    if contact is None:
        contact = stress_number(CONTACT[treatment][grade], material.hardness)
    if root is None:
        root = stress_number(BENDING[treatment][grade], material.hardness)
    strength = material.yield_strength or yield_from_hardness(material.hardness)
    return Metal(treatment, contact, root, material.hardness, strength)
