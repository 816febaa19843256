"""Lines and sentences of the summary of a solved contact study, and the figures that a sweep of it keeps."""

from typing import Any

import numpy as np

from tribodyn.numerics.variable import Variable
from tribodyn.post.page.profiles import Profile, Profiles
from tribodyn.post.report import Line, Lines
from tribodyn.record.reader import Record
from tribodyn.studies.gears.shared import CONTACT_RATIO, NORMAL_LOAD, WALL_TIME

_LINES = (
    (
        "central_film_min",
        "Central film, minimum",
        1e6,
        "µm",
        "Minimum along the way of the solved mean gap on the line of centres.",
    ),
    (
        "minimum_film_min",
        "Minimum film, minimum",
        1e6,
        "µm",
        "Minimum along the way of the solved minimum gap.",
    ),
    (
        "film_parameter_min",
        "Film parameter λ, minimum",
        1.0,
        "",
        "Central film over the roughness of both surfaces.",
    ),
    (
        "friction_coefficient_mean",
        "Friction coefficient, mean",
        1.0,
        "",
        "Mean along the way, weighted by load and sliding speed.",
    ),
    (
        "asperity_load_ratio_max",
        "Load share of the asperities, maximum",
        100.0,
        "%",
        "Maximum along the way.",
    ),
    (
        "temperature_rise_max",
        "Temperature rise of the oil, maximum",
        1.0,
        "K",
        "Mean over the film, maximum over the contact and the way.",
    ),
    ("hertz_pressure_max", "Hertz pressure, maximum", 1e-9, "GPa", "Of the dry contact."),
    ("pressure_max", "Pressure, maximum", 1e-9, "GPa", "Of the solved contact, at the places recorded."),
    ("positions_solved", "Positions solved", 1.0, "", "Positions at which the contact was solved."),
    (
        "central_film_departure_max",
        "Departure of transient from steady film, maximum",
        100.0,
        "%",
        "Amount of the central film with squeeze over the steady one, less one; maximum along the way.",
    ),
    (
        "central_film_departure_mean",
        "Departure of transient from steady film, mean",
        100.0,
        "%",
        "Mean of the same.",
    ),
    (
        "minimum_film_departure_max",
        "Departure of transient from steady minimum film, maximum",
        100.0,
        "%",
        "The same of the minimum film.",
    ),
    (
        "transient_minimum_film_min",
        "Minimum film with squeeze, minimum",
        1e6,
        "µm",
        "Minimum along the way of the minimum gap with squeeze.",
    ),
    (
        "transient_friction_coefficient_mean",
        "Friction coefficient with squeeze, mean",
        1.0,
        "",
        "Mean along the way, weighted by load and sliding speed.",
    ),
    (
        "transient_positions_solved",
        "Positions solved with squeeze",
        1.0,
        "",
        "Positions that the film was carried through.",
    ),
)

LINES: Lines = {
    "Geometry": (CONTACT_RATIO,),
    "Solved contact": (
        NORMAL_LOAD,
        *(
            Line(name, title, scale, unit, ".3g", definition=what)
            for name, title, scale, unit, what in _LINES
        ),
    ),
    "Solver": (WALL_TIME,),
}

SWEPT: dict[str, Variable] = {
    "central_film_min": Variable((), "m", "minimum central film thickness, solved"),
    "minimum_film_min": Variable((), "m", "minimum film thickness, solved"),
    "film_parameter_min": Variable((), "1", "minimum film parameter, solved"),
    "friction_coefficient_mean": Variable((), "1", "friction coefficient, solved, mean by loss"),
    "asperity_load_ratio_max": Variable((), "1", "maximum load share of the asperities"),
    "temperature_rise_max": Variable((), "K", "maximum temperature rise of the oil"),
    "hertz_pressure_max": Variable((), "Pa", "maximum Hertz pressure"),
    "central_film_departure_max": Variable((), "1", "maximum departure of the film with squeeze"),
    "transient_minimum_film_min": Variable((), "m", "minimum film thickness with squeeze"),
}

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


def sentences(record: Record) -> list[str]:
    """Say what the model leaves out, and where no solution was found."""
    summary = record.summary
    given = summary.get("loads") == "given"
    loads = "given loads" if given else "quasi-static loads with friction, without inertia"
    said = [f"Steady contacts, one after another, under {loads}."]
    said.extend(_squeeze_sentences(summary))
    if (residual := summary.get("residual_max")) is not None:
        said.append(f"Flow and load are balanced to {residual:.1e}.")
    solved, of = summary.get("positions_solved"), summary.get("positions")
    if solved is not None and of is not None and solved < of:
        said.append(f"At {of - solved} of {of} positions the pair carries nothing or no solution was found.")
    return said


def _squeeze_sentences(summary: Any) -> list[str]:
    """What the way with squeeze is, and where it was interrupted."""
    restarts, solved = summary.get("transient_restarts"), summary.get("transient_positions_solved")
    if restarts is None or solved is None:
        return []
    said = [
        "Beside them the same way with squeeze, from the steady film of the first position on: shear and "
        "heat quasi-steady, jumps of the load spread over the time in which the oil passes half a contact."
    ]
    if missing := summary.get("positions_solved", solved) - solved:
        said.append(f"With squeeze {missing} positions were not reached; the film began anew behind them.")
    elif restarts:
        said.append(f"With squeeze the film began anew {restarts} times.")
    return said
