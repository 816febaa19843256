"""Charts of a result."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.app.picture import Result, plain

#: Digits of a curve, and points of it.
_DIGITS, _POINTS = 5, 250


class Chart(NamedTuple):
    """A chart of a stage of the computations."""

    name: str
    stage: str
    data: str  # array of the result, or of its curves
    title: str
    each: str = ""  # what its rows or columns are: "torque", "pair"
    bars: bool = False
    note: str = ""  # what is in it, and what is not


CHARTS = (
    Chart(
        "te-static",
        "static",
        "transmission_error",
        "Transmission error, quasi-static",
        "torque",
        note="Of the teeth alone: what bearings and shafts give under the load is not in it.",
    ),
    Chart(
        "te-motion",
        "motion",
        "transmission_error_rotational",
        "Transmission error, in motion",
        note="Of the gears' rotations: bearings and shafts, which give under the load, add to its mean.",
    ),
    Chart("te-torques", "torques", "transmission_error", "Transmission error at several torques", "torque"),
    Chart("stiffness", "static", "stiffness", "Mesh stiffness", "torque"),
    Chart("load-motion", "motion", "normal_load", "Load of the pairs, in motion", "pair"),
    Chart("load-static", "static", "load", "Load of the pairs, quasi-static", "pair"),
    Chart("film", "motion", "central_film_thickness", "Film thickness", "pair"),
    Chart("film-ratio", "motion", "film_parameter", "Film over roughness, λ", "pair"),
    Chart("temperature", "motion", "flash_temperature_rise", "Flash temperature", "pair"),
    Chart("pressure", "motion", "hertz_pressure", "Hertz pressure", "pair"),
    Chart("friction", "motion", "friction_coefficient", "Friction coefficient", "pair"),
    Chart("loss", "motion", "power_friction", "Loss to friction"),
    Chart(
        "harmonics-static", "static", "harmonics", "Orders of the error, quasi-static", "torque", bars=True
    ),
    Chart("harmonics-motion", "motion", "harmonics", "Orders of the error, in motion", bars=True),
)
#: Stages that have charts.
CHARTED = tuple(dict.fromkeys(chart.stage for chart in CHARTS))
#: Units of stages whose arrays stand beside their results.
_UNITS = {"transmission_error": "µm", "stiffness": "N/µm", "load": "N", "harmonics": "µm"}


def charts_of(stage: str, result: Result) -> list[dict[str, Any]]:
    """Charts of the result of a stage."""
    return [
        _drawn(chart, result, values)
        for chart in CHARTS
        if chart.stage == stage and (values := _values(result, chart.data)) is not None
    ]


def _values(result: Result, name: str) -> np.ndarray | None:
    values = result.get("curves", {}).get(name, result.get(name))
    if values is None or not np.size(values):
        return None
    array = np.asarray(values, dtype=float)
    return array if np.isfinite(array).any() else None


def _drawn(chart: Chart, result: Result, values: np.ndarray) -> dict[str, Any]:
    if chart.each == "torque":
        rows = np.atleast_2d(values)
        names = [f"{torque:.4g} N·m" for torque in np.atleast_1d(result["torques"]).tolist()]
    else:
        rows = values[None] if values.ndim == 1 else values.T
        names = [f"pair {number + 1}" for number in range(len(rows))] if chart.each else [""] * len(rows)
    if chart.bars:
        abscissa, label = np.arange(1, rows.shape[1] + 1), "order of the mesh"
    else:
        abscissa, label = np.asarray(result["phase"], float), "mesh cycle"
    step = max(1, len(abscissa) // _POINTS)
    unit = result.get("units", {}).get(chart.data, _UNITS.get(chart.data, ""))
    return {
        "name": chart.name,
        "stage": chart.stage,
        "title": chart.title,
        "note": chart.note,
        "kind": "bars" if chart.bars else "lines",
        "x_label": label,
        "x_unit": "",
        "y_unit": unit,
        "place": CHARTS.index(chart),
        "x": plain(abscissa[::step], _DIGITS),
        "curves": [
            {"name": name, "y": plain(row[::step], _DIGITS)}
            for name, row in zip(names, rows, strict=True)
            if np.isfinite(row).any()
        ],
    }
