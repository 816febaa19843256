"""Quantities of the solved contact."""

from tribodyn.quantities.quantity import Quantity

QUANTITIES = (
    Quantity(
        "central_film_min",
        "Central film, minimum",
        "µm",
        ".3g",
        "Minimum along the way of the solved mean gap on the line of centres.",
    ),
    Quantity(
        "minimum_film_min",
        "Minimum film, minimum",
        "µm",
        ".3g",
        "Minimum along the way of the solved minimum gap.",
    ),
    Quantity(
        "asperity_load_ratio_max",
        "Load share of the asperities, maximum",
        "%",
        ".3g",
        "Maximum along the way.",
    ),
    Quantity(
        "temperature_rise_max",
        "Temperature rise of the oil, maximum",
        "K",
        ".3g",
        "Mean over the film, maximum over the contact and the way.",
    ),
    Quantity(
        "pressure_max", "Pressure, maximum", "GPa", ".3g", "Of the solved contact, at the places recorded."
    ),
    Quantity(
        "positions_solved",
        "Positions solved",
        digits="d",
        definition="Positions at which the contact was solved.",
    ),
    Quantity(
        "central_film_departure_max",
        "Departure of transient from steady film, maximum",
        "%",
        ".3g",
        "Amount of the central film with squeeze over the steady one, less one; maximum along the way.",
    ),
    Quantity(
        "central_film_departure_mean",
        "Departure of transient from steady film, mean",
        "%",
        ".3g",
        "Mean of the same.",
    ),
    Quantity(
        "minimum_film_departure_max",
        "Departure of transient from steady minimum film, maximum",
        "%",
        ".3g",
        "The same of the minimum film.",
    ),
    Quantity(
        "transient_minimum_film_min",
        "Minimum film with squeeze, minimum",
        "µm",
        ".3g",
        "Minimum along the way of the minimum gap with squeeze.",
    ),
    Quantity(
        "transient_friction_coefficient_mean",
        "Friction coefficient with squeeze, mean",
        digits=".4f",
        definition="Mean along the way, weighted by load and sliding speed.",
    ),
    Quantity(
        "transient_positions_solved",
        "Positions solved with squeeze",
        digits="d",
        definition="Positions that the film was carried through.",
    ),
)
