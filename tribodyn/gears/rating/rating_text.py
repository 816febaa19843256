"""What a rating says: sentences that a record keeps, units as they are written, a table of its factors."""

from collections.abc import Mapping, Sequence
from typing import Any

from tribodyn.gears.rating.settings import RatingTable
from tribodyn.quantities.catalogue import GROUPS, QUANTITIES
from tribodyn.quantities.quantity import Quantity
from tribodyn.record.reader import Record

COLUMNS = ("", "pinion", "gear", "")
#: Load factors before what they enter.
_FACTORS = ("K_A", "K_gamma", "K_v", "K_Hbeta", "K_Halpha", "C_R")


def numbered(sentences: Sequence[str]) -> dict[str, str]:
    """Sentences as a summary keeps them, in order."""
    return {f"{number:02d}": sentence for number, sentence in enumerate(sentences, 1)}


def sentences(record: Record) -> list[str]:
    """Say what is assumed and what is extrapolated."""
    summary = record.summary
    return [str(text) for name in ("assumed", "extrapolated") for text in summary.get(name, {}).values()]


def unit_of(quantity: Quantity) -> str:
    """Its unit; temperatures by the standards are kept in °C."""
    return quantity.unit.replace("degC", "°C")


def factors_said(settings: RatingTable) -> str:
    """Which load factors are given, and where the others are from."""
    factors = {
        "K_γ": settings.mesh_load_factor,
        "K_v": settings.dynamic_factor,
        "K_Hβ": settings.face_load_factor,
        "K_Hα": settings.transverse_load_factor,
        "C_R": settings.gear_blank_factor,
    }
    written = [f"K_A = {settings.application_factor:g}"]
    written += [f"{name} = {value:g} (given)" for name, value in factors.items() if value is not None]
    open_face = "" if settings.face_load_factor else "; K_Hβ by the contact analysis"
    return f"{', '.join(written)}{open_face}."


def life_said(settings: RatingTable, duties: int) -> str:
    """What the required life is, and which loads it has."""
    hours = settings.life / 3600.0
    rz = "6 Ra" if settings.peak_roughness is None else f"{settings.peak_roughness * 1e6:g} µm"
    loads = "the duty all the time"
    if duties:
        loads = f"{duties} duties of the load spectrum with K_A = 1, by Miner's sum (ISO 6336-6)"
    return (
        f"Required life {hours:.6g} h, S_Hmin {settings.safety_pitting:g}, S_Fmin "
        f"{settings.safety_bending:g}; {loads}. Rz of the flanks {rz}, of the roots "
        f"{settings.root_roughness * 1e6:g} µm."
    )


def ring_said(iso: Mapping[str, Any]) -> list[str]:
    """How much the root of a ring as cut and by the standard's formula differ, of values by name."""
    ways = {"cut": "of the fillet as cut", "formula": "by the formula of ISO 6336-3"}
    other = next((way for way in ways if f"rho_F_{way}" in iso), None)
    if other is None:
        return []
    (text_of_way,) = (text for way, text in ways.items() if way != other)
    remarks = []
    for side, rho in iso["rho_F"].items():
        against = iso[f"rho_F_{other}"][side]
        if abs(against / rho - 1.0) > 1e-6:  # of a gear cut by a rack both are the same
            stress, less = (1e-6 * iso[name][side] for name in ("sigma_F0", f"sigma_F0_{other}"))
            remarks.append(
                f"Root of the {side}, internal teeth: ρ_F {1e3 * rho:.2f} mm, σ_F0 {stress:.1f} N/mm² "
                f"{text_of_way}; {1e3 * against:.2f} mm, {less:.1f} N/mm² {ways[other]} (key ring_root)."
            )
    return remarks


def rating_rows(iso: Mapping[str, Any]) -> list[tuple[str, str, str, str]]:
    """Title, value of the pinion and of the gear, unit; what both have in common stands in the first column.

    A life without damage has no end: its number is a lower bound.
    """
    rows = []
    for name in (*_FACTORS, *(quantity.name for quantity in GROUPS["capacity"])):
        value, quantity = iso.get(name), QUANTITIES[name]
        if value is None:
            continue
        both = value if isinstance(value, Mapping) else {"pinion": value}
        endless = iso.get(name.replace("life", "damage"), {}) if name.startswith("life_") else {}
        written = [
            "≥ " * (endless.get(side) == 0.0) + quantity.written(float(both[side])) if side in both else ""
            for side in ("pinion", "gear")
        ]
        rows.append((quantity.title, *written, unit_of(quantity)))
    return rows
