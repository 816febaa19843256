"""Lines and sentences of the summary of an efficiency study, and the figures that a sweep of it keeps."""

from tribodyn.numerics.variable import Variable
from tribodyn.post.report import Line, Lines, on_closures, on_energy, on_methods
from tribodyn.record.reader import Record
from tribodyn.studies.gears.shared import (
    CONTACT_RATIO,
    EFFECTIVE_CONTACT_RATIO,
    ENERGY,
    MESH_FREQUENCY,
    NORMAL_LOAD,
    THERMAL,
    TRIBOLOGY,
    WALL_TIME,
)
from tribodyn.studies.gears.temperature import THERMAL_FIGURES

LINES: Lines = {
    "Geometry": (
        CONTACT_RATIO,
        EFFECTIVE_CONTACT_RATIO,
        Line(
            "specific_sliding_max",
            "Specific sliding, maximum",
            form=".3f",
            definition="Largest magnitude along the path of contact of a flank's speed less its mate's, over "
            "the flank's own.",
        ),
    ),
    "Dynamics": (MESH_FREQUENCY, NORMAL_LOAD),
    "Tribology": TRIBOLOGY,
    "Energy": (
        *ENERGY,
        Line(
            "load_sharing",
            "Load sharing of the samples",
            definition="How the pairs share the load in the samples and in all lines above: operating or "
            "efficiency.load_sharing.",
        ),
        Line(
            "efficiency_elastic",
            "Efficiency, elastic load sharing",
            100.0,
            "%",
            ".3f",
            definition="Mean power out over mean power in, loads shared by the pairs' stiffness.",
        ),
        Line(
            "efficiency_uniform",
            "Efficiency, equal loads",
            100.0,
            "%",
            ".3f",
            definition="The same, the load divided equally among the pairs in contact.",
        ),
        Line(
            "efficiency_single_pair",
            "Efficiency, one pair at a time",
            100.0,
            "%",
            ".3f",
            definition="The same, one pair at a time.",
        ),
        Line(
            "efficiency_torque_ratio",
            "Efficiency, torque ratio of one pair",
            100.0,
            "%",
            ".3f",
            definition="Mean ratio of torques over the path of contact of one pair that carries the load "
            "alone.",
        ),
        Line(
            "efficiency_loss_factor",
            "Efficiency, loss factor integrated",
            100.0,
            "%",
            ".3f",
            definition="1 − μ H_v of an involute pair with a constant coefficient, H_v integrated over "
            "the path of contact.",
        ),
        Line(
            "efficiency_hoehn",
            "Efficiency, Höhn's loss factor",
            100.0,
            "%",
            ".3f",
            definition="The same with the closed form of H_v by Höhn, for contact ratios from 1 to 2.",
        ),
    ),
    "Temperature": THERMAL,
    "Load spectrum": (
        Line(
            "spectrum_efficiency",
            "Efficiency over the load spectrum",
            100.0,
            "%",
            ".3f",
            definition="Energy put out over energy put in, all duties with their shares of time.",
        ),
        Line(
            "spectrum_power_friction_mean",
            "Loss to tooth friction over the load spectrum",
            1.0,
            "W",
            ".3g",
            definition="Mean over time of the duties' losses.",
        ),
        Line(
            "duty_share",
            "Share of time, by duty",
            100.0,
            "%",
            ".3g",
            definition="Shares of the duties, their sum 100 %.",
            listed=True,
        ),
        Line(
            "duty_efficiency",
            "Efficiency, by duty",
            100.0,
            "%",
            ".3f",
            definition="Efficiency of each duty.",
            listed=True,
        ),
        Line(
            "duty_power_friction_mean",
            "Loss to tooth friction, by duty",
            1.0,
            "W",
            ".3g",
            definition="Mean loss during each duty.",
            listed=True,
        ),
        Line(
            "duty_film_parameter_min",
            "Minimum film parameter λ, by duty",
            form=".3g",
            definition="Minimum of each duty.",
            listed=True,
        ),
        Line(
            "duty_hertz_pressure_max",
            "Maximum Hertz pressure, by duty",
            1e-9,
            "GPa",
            ".3g",
            definition="Maximum of each duty.",
            listed=True,
        ),
    ),
    "Solver": (WALL_TIME,),
}

SWEPT: dict[str, Variable] = {
    "efficiency": Variable((), "1", "efficiency over the mesh cycle"),
    "power_friction_mean": Variable((), "W", "mean power lost to tooth friction"),
    "friction_coefficient_mean": Variable((), "1", "friction coefficient, mean by loss"),
    "film_min": Variable((), "m", "minimum central film thickness"),
    "hertz_pressure_max": Variable((), "Pa", "maximum Hertz pressure"),
    "flash_temperature_max": Variable((), "K", "maximum flash temperature rise"),
    "film_parameter_min": Variable((), "1", "minimum film parameter"),
    "normal_load_max": Variable((), "N", "maximum normal load of a pair"),
    "contact_ratio": Variable((), "1", "contact ratio"),
    "specific_sliding_max": Variable((), "1", "largest magnitude of specific sliding of both flanks"),
    "efficiency_elastic": Variable((), "1", "efficiency, elastic load sharing"),
    "efficiency_uniform": Variable((), "1", "efficiency, equal loads"),
    "efficiency_single_pair": Variable((), "1", "efficiency, one pair at a time"),
    "efficiency_torque_ratio": Variable((), "1", "efficiency, torque ratio of one pair"),
    **THERMAL_FIGURES,
    "friction_in_range_fraction": Variable(
        (), "1", "share of the contact in which the friction law is in its range"
    ),
    "closure_in_range_fraction": Variable(
        (), "1", "share of the contact in which the film law is in its range"
    ),
}

SHORT = {"loss": "power_friction_mean"}

PANELS = ("normal_load", "friction_coefficient", "hertz_pressure", "power_friction", "efficiency")


def sentences(record: Record) -> list[str]:
    """Say how well the study satisfies what can be checked: range of the film law, balance of energy."""
    summary = record.summary
    return [*on_methods(summary), *on_closures(summary), *on_energy(summary)]
