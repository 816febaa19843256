"""Lines and sentences of an assessment's summary."""

import math

from tribodyn.numerics.variable import Variable
from tribodyn.post.report import Line, Lines
from tribodyn.record.reader import Record
from tribodyn.studies.gears.shared import CONTACT_RATIO, EFFECTIVE_CONTACT_RATIO, WALL_TIME

_RPM = 30.0 / math.pi


def _over_samples(name: str, factor: float = 1.0, unit: str = "") -> Line:
    """Line of the scatter of the figure above."""
    return Line(
        f"{name}_spread",
        "over samples: median, 5, 95 %",
        factor,
        unit,
        ".3f",
        "Percentiles of the same over samples of the deviations that the tolerance class allows.",
        listed=True,
    )


LINES: Lines = {
    "Geometry": (CONTACT_RATIO, EFFECTIVE_CONTACT_RATIO),
    "Loaded contact": (
        Line(
            "loaded_transmission_error_peak_to_peak",
            "Loaded transmission error, peak to peak",
            1e6,
            "µm",
            definition="Of r_p θ_p − r_g θ_g in slow rotation under the duty's torque.",
        ),
        _over_samples("loaded_transmission_error_peak_to_peak", 1e6, "µm"),
        Line(
            "face_load_factor",
            "Face load factor K_Hβ",
            form=".3f",
            definition="Maximum over mean line load along the face, where the line load is at its maximum.",
        ),
        _over_samples("face_load_factor"),
        Line(
            "transverse_load_factor",
            "Transverse load factor K_Hα",
            form=".3f",
            definition="Maximum load of a tooth while two pairs or more are on their path, with a base pitch "
            "deviation f_pb − y_α of one tooth, over the same of accurate teeth.",
        ),
        Line(
            "transverse_load_factor_method_b",
            "by ISO 6336-1, method B",
            form=".3f",
            definition="K_Hα by the formulas of the standard, with the same deviation.",
        ),
        _over_samples("transverse_load_factor"),
        Line(
            "pinion_root_tension_max",
            "Maximum root tension, pinion",
            1e-6,
            "MPa",
            definition="Maximum surface stress in the fillet on the loaded side, slow rotation.",
        ),
        Line(
            "gear_root_tension_max",
            "Maximum root tension, gear",
            1e-6,
            "MPa",
            definition="The same of the gear.",
        ),
    ),
    "Steady states": (
        Line(
            "dynamic_factor",
            "Dynamic factor K_v at the duty",
            form=".3f",
            definition="Maximum of the loads' moment over that of the mean load, from the motion.",
        ),
        _over_samples("dynamic_factor"),
        Line(
            "dynamic_factor_max",
            "Maximum over the speeds",
            form=".3f",
            definition="Maximum of the same over all speeds that were asked for.",
        ),
        Line(
            "dynamic_factor_max_speed",
            "at a pinion speed of",
            _RPM,
            "rpm",
            ".0f",
            "Speed of the pinion at that maximum.",
        ),
        Line(
            "contact_loss_from",
            "Contact is lost from",
            _RPM,
            "rpm",
            ".0f",
            "Lowest speed of the pinion at which no pair carries load for part of the time.",
        ),
    ),
    "Film and losses": (
        Line(
            "specific_film_min",
            "Minimum specific film λ_GF",
            form=".3g",
            definition="Film over Ra by ISO/TS 6336-22, method A, with the simulation's pressures.",
        ),
        Line(
            "contact_temperature_max",
            "Maximum contact temperature",
            form=".1f",
            unit="°C",
            offset=-273.15,
            definition="Bulk temperature and flash temperature rise, maximum along the path of contact.",
        ),
        Line(
            "power_friction_mean",
            "Loss to tooth friction",
            1.0,
            "W",
            ".4g",
            "Mean power of the friction forces by the first friction law.",
        ),
        Line(
            "efficiency",
            "Efficiency of the mesh",
            100.0,
            "%",
            ".3f",
            "Mean power out over mean power in by the first friction law.",
        ),
        Line(
            "efficiency_lowest",
            "by the other friction laws, from",
            100.0,
            "%",
            ".3f",
            "Lowest of all friction laws that were asked for.",
        ),
        Line("efficiency_highest", "to", 100.0, "%", ".3f", "Highest of all of them."),
    ),
    "Solver": (WALL_TIME,),
}

SWEPT: dict[str, Variable] = {
    "efficiency": Variable((), "1", "efficiency of the mesh"),
    "power_friction_mean": Variable((), "W", "mean power lost to tooth friction"),
    "dynamic_factor": Variable((), "1", "dynamic factor at the duty"),
    "dynamic_factor_max": Variable((), "1", "maximum dynamic factor over the speeds"),
    "hertz_pressure_max": Variable((), "Pa", "maximum Hertz pressure, slow rotation"),
    "specific_film_min": Variable((), "1", "minimum specific film, ISO/TS 6336-22, method A"),
    "contact_temperature_max": Variable((), "K", "maximum contact temperature"),
    "loaded_transmission_error_peak_to_peak": Variable(
        (), "m", "loaded static transmission error, peak to peak"
    ),
    "pinion_root_tension_max": Variable((), "Pa", "maximum root tension of the pinion"),
    "gear_root_tension_max": Variable((), "Pa", "maximum root tension of the gear"),
}

PANELS = ("hertz_pressure", "contact_temperature", "specific_film")


def sentences(record: Record) -> list[str]:
    """Say what is assumed and what is extrapolated."""
    summary = record.summary
    return [str(one) for name in ("assumed", "extrapolated") for one in summary.get(name, {}).values()]
