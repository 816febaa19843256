"""Reported quantities of a solved contact study, and how far to trust them."""

from typing import Any

import numpy as np

from tribodyn.post.page.data import Profile, Profiles
from tribodyn.post.verdict import band_of, numbers, share, with_unit
from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

_STEADY = (
    *("central_film_min", "minimum_film_min", "film_parameter_min"),
    *("friction_coefficient_mean", "asperity_load_ratio_max"),
    *("temperature_rise_max", "hertz_pressure_max"),
)
REPORTED: Reported = {
    "Geometry": quantities("contact_ratio"),
    "Solved contact": quantities(
        *("normal_load_max", *_STEADY, "pressure_max", "positions_solved"),
        *("central_film_departure_max", "central_film_departure_mean", "minimum_film_departure_max"),
        *("transient_minimum_film_min", "transient_friction_coefficient_mean", "transient_positions_solved"),
    ),
    "Solver": quantities("wall_time"),
}

SWEPT = quantities(*_STEADY, "central_film_departure_max", "transient_minimum_film_min")

PANELS = (
    "central_film_thickness",
    "transient_central_film_thickness",
    "friction_coefficient",
    "hertz_pressure",
    "temperature_rise_max",
)


def profiles(record: Record) -> Profiles:
    """Pressure, film, temperature and shear over the contact; the film to three times the central one."""
    central = record["central_film_thickness"]
    top = 3.0 * float(np.nanmax(central)) if np.any(np.isfinite(central)) else None
    rows = (
        Profile("pressure"),
        Profile("film_thickness", top),
        Profile("temperature_rise"),
        Profile("shear_stress"),
    )
    if "transient_pressure" in record:
        rows = (Profile("transient_pressure"), Profile("transient_film_thickness", top), *rows)
    label = "Place in the direction of entrainment over the Hertz half width"
    return Profiles("The contact through the mesh", "place", label, rows)


def verdict(record: Record) -> list[str]:
    """Say what keeps the flanks apart, what friction and heat there are, and what squeeze changes."""
    summary, texts = numbers(record.summary), []
    if {"minimum_film_min", "film_parameter_min", "asperity_load_ratio_max", "hertz_pressure_max"} <= set(
        summary
    ):
        film = with_unit("minimum_film_min", summary["minimum_film_min"])
        ratio, carried = summary["film_parameter_min"], summary["asperity_load_ratio_max"]
        asperities = (
            f"asperities carry up to {share(carried)} of the load" if carried > 0.0 else "a full film"
        )
        pressure = with_unit("hertz_pressure_max", summary["hertz_pressure_max"])
        texts.append(f"The flanks press with up to {pressure}; {asperities}.")
        texts.append(f"The oil film is at least {film}; the central film is {ratio:.2g} times the roughness.")
    if {"friction_coefficient_mean", "temperature_rise_max"} <= set(summary):
        rise = with_unit("temperature_rise_max", summary["temperature_rise_max"])
        mean = summary["friction_coefficient_mean"]
        texts.append(
            f"The friction coefficient is {mean:.3f} on the mean{band_of(summary)}; the oil film heats by up "
            f"to {rise}."
        )
    if (departure := summary.get("central_film_departure_max")) is not None:
        texts.append(f"Squeeze moves the central film by up to {share(departure)}.")
    if (solved := summary.get("positions_solved", 0)) < (positions := summary.get("positions", 0)):
        texts.append(
            f"{positions - solved:.0f} of {positions:.0f} positions carry nothing, or have no solution."
        )
    return texts


def sentences(record: Record) -> list[str]:
    """Say what the model leaves out, and where no solution was found."""
    summary = record.summary
    prescribed = summary.get("loads") == "given"
    loads = "given loads" if prescribed else "quasi-static loads with friction, without inertia"
    texts = [f"Steady contacts, one after another, under {loads}."]
    texts.extend(_squeeze_sentences(summary))
    if (origin := summary.get("viscosity_origin")) is not None:
        texts.append(f"Viscosity at high pressure: {origin}.")
    if (residual := summary.get("residual_max")) is not None:
        texts.append(f"Flow and load are balanced to {residual:.1e}.")
    solved, of = summary.get("positions_solved"), summary.get("positions")
    if solved is not None and of is not None and solved < of:
        texts.append(f"At {of - solved} of {of} positions the pair carries nothing or no solution was found.")
    return texts


def _squeeze_sentences(summary: Any) -> list[str]:
    """What the way with squeeze is, and where it was interrupted."""
    restarts, solved = summary.get("transient_restarts"), summary.get("transient_positions_solved")
    if restarts is None or solved is None:
        return []
    texts = [
        "Beside them the same way with squeeze, from the steady film of the first position on: shear and "
        "heat quasi-steady, jumps of the load spread over the time in which the oil passes half a contact."
    ]
    if missing := summary.get("positions_solved", solved) - solved:
        texts.append(f"With squeeze {missing} positions were not reached; the film began anew behind them.")
    elif restarts:
        texts.append(f"With squeeze the film began anew {restarts} times.")
    return texts
