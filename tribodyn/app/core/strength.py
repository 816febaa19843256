"""Safeties of a mesh against pitting and tooth bending by ISO 6336, as its duty alone gives them."""

from collections.abc import Mapping
from typing import Any

from tribodyn.app.core.shown import Row, row_of
from tribodyn.cases.assessment_part import Meshing
from tribodyn.cases.results import TextTable
from tribodyn.gears.case import GearCase, OiledCase
from tribodyn.gears.rating.capacity import capacity_of, life_bins, safeties
from tribodyn.gears.rating.rating_text import COLUMNS, rating_rows
from tribodyn.gears.rating.settings import RatingTable
from tribodyn.gears.rating.standard import load_factors, rated_duty
from tribodyn.gears.rating.strength import metal_remarks, metals_of
from tribodyn.geometry.assembly import Assembly
from tribodyn.quantities.catalogue import quantities
from tribodyn.tribology.oil import ZERO_CELSIUS

#: What is not asked here: an assessment of the drive has it.
_TAKEN = "K_A, K_γ and K_Hβ are 1, the whole life is at this duty: an assessment counts spectrum and faces."


def strength_of(
    pair: GearCase, assembly: Assembly, meshing: tuple[Meshing, Meshing] = (Meshing(), Meshing())
) -> dict[str, Any]:
    """`rows` of S_H, S_F and the life of a pair whose pinion drives, and of either gear in `gears`.

    `remarks` say what was taken, or what is missing: then there are no rows.
    """
    missing = _missing(pair, assembly)
    if missing or not isinstance(pair, OiledCase):
        return {"rows": [], "gears": [], "remarks": missing}
    settings, temperature = RatingTable(), pair.lubricant.temperature
    warm = ZERO_CELSIUS if temperature is None else float(temperature)
    factors = load_factors(pair, assembly, rated_duty(settings, warm, face=1.0))
    capacity = capacity_of(pair, assembly, factors, life_bins(pair, assembly, factors), settings, meshing)
    assert capacity is not None, "metals are known"
    found = safeties(capacity)
    shown = quantities("S_H", "S_F")
    both = [(gear.pitting.safety, gear.bending.safety) for gear in capacity.gears]
    gears = [[row_of(*each) for each in zip(shown, of_gear, strict=True)] for of_gear in both]
    rows = [row_of(quantity, found[quantity.name]) for quantity in (*shown, *quantities("life"))]
    return {"rows": rows, "gears": gears, "remarks": [*metal_remarks(pair), *capacity.remarks, _TAKEN]}


def rated_by_check(data: Mapping[str, Any], mesh: str) -> tuple[list[Row], list[TextTable]]:
    """Rows of S_H and S_F, those of the weaker gear, that a check has of a mesh, if it rates any.

    And the table of all factors of a mesh of a train, which is not among the check's own.
    """
    of_train = data.get("rating", {}).get(mesh, {}).get("iso")
    iso = of_train or data.get("iso", {})
    shown = quantities("S_H", "S_F")
    rows = [row_of(each, min(iso[each.name].values())) for each in shown if each.name in iso]
    return rows, [TextTable(f"ISO 6336, {mesh}", COLUMNS, rating_rows(of_train))] if of_train else []


def _missing(pair: GearCase, assembly: Assembly) -> list[str]:
    """Why the standard cannot rate a pair; nothing where it can."""
    if not assembly.family.involute:
        return ["ISO 6336 rates involute teeth alone."]
    reasons = []
    if pair.drive.pinion.teeth < 0:
        reasons.append("The ring drives: an assessment rates its mate.")
    if not pair.operating.gear_torque > 0.0 or pair.operating.pinion_speed < 0.0:
        reasons.append("ISO 6336 rates a duty in which the pinion drives.")
    elif not pair.operating.pinion_speed > 0.0:
        reasons.append("No speed is given, on which factors and lives of ISO 6336 depend.")
    if pair.quality is None:
        reasons.append("No tolerance class is given (quality): ISO 6336-1 takes deviations from it.")
    if metals_of(pair) is None:
        reasons += [remark for remark in metal_remarks(pair) if "no heat treatment" in remark]
    if not isinstance(pair, OiledCase) or pair.lubricant.sheet is None:
        reasons.append("There is no oil with a data sheet, which ISO 6336-2 takes its viscosity from.")
    return reasons
