"""Reported quantities of an assessment, and how far to trust them."""

from collections.abc import Iterator, Mapping
from typing import Any

from tribodyn.gears.rating.limits import on_limits
from tribodyn.gears.rating.rating_text import sentences as sentences
from tribodyn.post.verdict import numbers, outside, with_unit
from tribodyn.quantities.catalogue import quantities, scatter_of
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

REPORTED: Reported = {
    "Geometry": quantities(
        *("contact_ratio", "overlap_ratio", "total_contact_ratio", "contact_ratio_effective"),
    ),
    "Loaded contact": (
        *quantities("loaded_transmission_error_peak_to_peak"),
        scatter_of("loaded_transmission_error_peak_to_peak"),
        *quantities("face_load_factor"),
        scatter_of("face_load_factor"),
        *quantities("shaft_misalignment", "given_misalignment"),
        *quantities("transverse_load_factor", "transverse_load_factor_method_b"),
        scatter_of("transverse_load_factor"),
        *quantities("pinion_root_tension_max", "gear_root_tension_max"),
    ),
    "Steady states": (
        *quantities("dynamic_factor"),
        scatter_of("dynamic_factor"),
        *quantities("dynamic_factor_max", "dynamic_factor_max_speed"),
        scatter_of("dynamic_factor_max"),
        *quantities("contact_loss_speed_from"),
    ),
    "Load capacity": quantities("S_H", "S_F", "life"),
    "Film and losses": (
        *quantities("specific_film_min"),
        scatter_of("specific_film_min"),
        *quantities("contact_temperature_max"),
        scatter_of("contact_temperature_max"),
        *quantities("power_friction_mean", "efficiency"),
        scatter_of("efficiency"),
        *quantities("efficiency_lowest", "efficiency_highest"),
    ),
    "Solver": quantities("wall_time"),
}

SWEPT = quantities(
    *("efficiency", "power_friction_mean", "dynamic_factor", "dynamic_factor_max"),
    *("hertz_pressure_max", "specific_film_min", "contact_temperature_max"),
    *("loaded_transmission_error_peak_to_peak", "pinion_root_tension_max", "gear_root_tension_max"),
    *("S_H", "S_F", "life", "life_unlimited"),
)

PANELS = ("hertz_pressure", "contact_temperature", "specific_film")


def verdict(record: Record) -> list[str]:
    """Say whether the limits hold, what moves and presses, what is lost, and how far to trust it."""
    sentences = [sentence for _, sentence in on_limits(record.summary)]
    texts = [str(record.summary[name]) for name in ("not_judged", "rests_on") if name in record.summary]
    return [*sentences, *texts, *shown(record.summary), *outside(record.summary)]


def shown(summary: Mapping[str, Any]) -> Iterator[str]:
    """What moves, presses and is lost."""
    summary = numbers(summary)
    if "dynamic_factor" in summary:
        yield vibration(summary)
    if {"specific_film_min", "hertz_pressure_max", "contact_temperature_max"} <= set(summary):
        pressure = with_unit("hertz_pressure_max", summary["hertz_pressure_max"])
        hot = with_unit("contact_temperature_max", summary["contact_temperature_max"])
        film = f"the film is at least {summary['specific_film_min']:.2g} times their Ra"
        yield f"The flanks press with up to {pressure} and reach {hot}; {film}."
    if {"efficiency", "efficiency_lowest", "efficiency_highest"} <= set(summary):
        ends = " to ".join(f"{100.0 * summary[f'efficiency_{end}']:.2f}" for end in ("lowest", "highest"))
        yield f"The mesh is {100.0 * summary['efficiency']:.2f} % efficient; by other friction laws {ends} %."


def vibration(summary: Mapping[str, Any], of: str = "") -> str:
    """How much vibration raises the loads, and where contact is lost; `of` is what turns at the speeds."""
    text = f"Vibration raises the tooth forces to {summary['dynamic_factor']:.2f} times their mean"
    highest, where = (summary.get(f"dynamic_factor_max{end}") for end in ("", "_speed"))
    if highest is not None and where is not None:
        text += f", at {with_unit('dynamic_factor_max_speed', where)}{of} to {highest:.2f} times"
    if (lost := summary.get("contact_loss_speed_from")) is not None:
        text += f"; the teeth separate from {with_unit('contact_loss_speed_from', lost)}{of}"
    return f"{text}."
