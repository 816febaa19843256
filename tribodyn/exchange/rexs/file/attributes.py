"""Attributes of REXS and the keys of scenarios that say the same: one table, for reading and for writing.

Names and units are those of schema 2.0.0; `older` are the names that files of 1.0 to 1.6 have.
"""

from typing import NamedTuple

from tribodyn.exchange.rexs.file.units import RexsUnit, unit_named


class RexsKey(NamedTuple):
    """An attribute, and the key that says the same; without a key what is read in another way."""

    name: str
    key: str
    unit: str = "none"
    older: tuple[str, ...] = ()

    @property
    def measured(self) -> RexsUnit:
        """Its unit."""
        unit = unit_named(self.unit)
        assert unit is not None, self.unit
        return unit


NUMBER_OF_TEETH = RexsKey("number_of_teeth", "teeth")
NORMAL_MODULE = RexsKey("normal_module", "module", "mm")
HELIX_ANGLE = RexsKey("helix_angle_reference_diameter", "helix_angle", "deg")
PRESSURE_ANGLE = RexsKey("normal_pressure_angle", "pressure_angle", "deg")
PROFILE_SHIFT = RexsKey("addendum_modification_coefficient", "profile_shift")
FACE_WIDTH = RexsKey("face_width", "face_width", "mm")
TIP_DIAMETER = RexsKey("tip_diameter", "tip_diameter", "mm")
QUALITY = RexsKey(
    "global_tolerance_class_iso_1328_2013", "quality", older=("tolerance_class_according_to_iso_1328_2013",)
)
THICKNESS_CODE = RexsKey(
    "tooth_thickness_deviation_tolerance_series_din_3967_1978",
    "thickness_code",
    older=("din_3967_deviation_tolerance_series",),
)
#: Deviations of the span: A_sn cos α; the lower one is the tolerance below the upper one.
UPPER_SPAN = RexsKey("upper_backlash_allowance_referenced_to_span", "thickness_allowance", "mum")
LOWER_SPAN = RexsKey("lower_backlash_allowance_referenced_to_span", "thickness_tolerance", "mum")
ROUGHNESS = RexsKey(
    "arithmetic_mean_roughness_flank_iso_4287_1997",
    "mean_roughness",
    "mum",
    ("arithmetic_average_roughness_flank",),
)
#: Mean peak-to-valley roughness, which is read where that of the arithmetic mean is missing.
ROUGHNESS_RZ = RexsKey(
    "mean_peak_to_valley_roughness_flank_iso_4287_1997", "", "mum", ("averaged_peak_to_valley_height_flank",)
)
#: Of cylindrical_gear and ring_gear, besides those above.
GEAR = (
    RexsKey("inner_diameter", "bore_diameter", "mm"),
    RexsKey("mass_of_component", "mass", "kg"),
    ROUGHNESS,
    RexsKey("number_of_teeth_for_span_measurement", "span_teeth"),
)
FLANK = (RexsKey("addendum_coefficient_basic_profile", "addendum"),)
_TOOL_ADDENDUM, _TOOL_ROUNDING = (
    "addendum_coefficient_reference_profile",
    "tip_corner_radius_factor_reference_profile",
)
RACK = (
    RexsKey(_TOOL_ADDENDUM, "dedendum"),
    RexsKey(_TOOL_ROUNDING, "fillet_radius", older=("tip_radius_factor",)),
)
CUTTER = (
    RexsKey("number_of_teeth", "cutter_teeth"),
    RexsKey("addendum_modification_coefficient", "cutter_profile_shift"),
    RexsKey(_TOOL_ADDENDUM, "cutter_addendum"),
    RexsKey(_TOOL_ROUNDING, "cutter_rounding", older=("tip_radius_factor",)),
)

CENTRE_DISTANCE = RexsKey("center_distance", "centre_distance", "mm")
ROTATING_ANGLE = RexsKey("rotating_angle_around_neg_u_axis", "azimuth", "deg")
#: Places along a shaft, and of a part in space.
U_ON_SHAFT = RexsKey("u_coordinate_on_shaft", "position", "mm")
U_INNER = RexsKey("u_coordinate_on_shaft_inner_side", "position", "mm")
U_OUTER = RexsKey("u_coordinate_on_shaft_outer_side", "position", "mm")
ORIGIN = RexsKey("support_vector", "", "mm")
U_AXIS, W_AXIS = RexsKey("u_axis_vector", "", "mm"), RexsKey("w_axis_vector", "", "mm")
FRAME = RexsKey("reference_component_for_position", "")

LENGTH = RexsKey("length", "length", "mm")
OUTER_BEGIN, OUTER_END = (RexsKey(f"outer_diameter_{end}", "diameter", "mm") for end in ("begin", "end"))
INNER_BEGIN, INNER_END = (RexsKey(f"inner_diameter_{end}", "bore", "mm") for end in ("begin", "end"))
INNER, OUTER = RexsKey("inner_diameter", "bore", "mm"), RexsKey("outer_diameter", "outside_diameter", "mm")

#: Type of a bearing in a scenario -> in REXS, the first as it is written.
BEARING_TYPES = {
    "deep-groove-ball": ("radial_grooved_ball_bearing",),
    "angular-contact-ball": ("angular_contact_ball_bearing",),
    "four-point-contact-ball": ("four_point_contact_ball_bearing",),
    "self-aligning-ball": ("radial_self_aligning_ball_bearing",),
    "cylindrical-roller": ("radial_roller_bearing",),
    "needle-roller": ("radial_needle_roller_bearing",),
    "tapered-roller": ("radial_tapered_roller_bearing",),
    "spherical-roller": ("radial_self_aligning_roller_bearing",),
}
BEARING_TYPE = RexsKey("bearing_type", "type")
AXIAL_ABSORPTION = RexsKey("axial_force_absorption", "thrust")
RADIAL_ABSORPTION = RexsKey("radial_force_absorption", "")
DESIGNATION = RexsKey("catalogue_designation", "", older=("name",))
STATIC_RATING = RexsKey("radial_static_load_rating", "static_rating", "kN", ("static_capacity",))
RATINGS = (
    RexsKey("radial_dynamic_load_rating", "dynamic_rating", "kN", ("dynamic_capacity",)),
    STATIC_RATING,
    RexsKey("fatigue_limit_load", "fatigue_load_limit", "kN"),
    RexsKey(
        "contamination_factor_iso_281_2007",
        "contamination_factor",
        older=(
            "contamination_factor_according_to_iso_281_2007",
            "contamination_factor_according_to_din_26281",
        ),
    ),
)
CLEARANCE = RexsKey("mounted_radial_bearing_clearance", "clearance", "mum")
PRELOAD, PRELOAD_FORCE = (
    RexsKey("preload_distance", "preload", "mum"),
    RexsKey("preload_force", "preload_force", "N"),
)
E_OF_CATALOGUE = RexsKey("catalogue_value_e", "")
RADIAL_STIFFNESS, AXIAL_STIFFNESS = (
    RexsKey(f"{way}_stiffness", f"stiffness_{way}", "N / m") for way in ("radial", "axial")
)
TILT_STIFFNESS = RexsKey("bending_stiffness", "stiffness_tilt", "N mm / rad")
TORSIONAL_STIFFNESS = RexsKey("rotational_stiffness", "stiffness", "N mm / rad")
ROWS = RexsKey("number_of_bearing_rows", "")
ROW_DISTANCE = RexsKey("distance_between_bearing_rows", "row_distance", "mm")
ROW_ABSORPTION = RexsKey("axial_force_absorption_of_row", "")
CONTACT_ANGLE = RexsKey("pressure_angle", "contact_angle", "deg")
#: Of a row of rolling elements, and of one of them.
ROW = (
    RexsKey("number_of_rolling_elements", "elements"),
    RexsKey("reference_diameter_rolling_bearing", "pitch_diameter", "mm", ("reference_diameter",)),
)
ELEMENT = (
    RexsKey("diameter_of_rolling_element", "element_diameter", "mm"),
    RexsKey("length_of_rolling_element", "roller_length", "mm"),
)

#: Base oil of a scenario -> of `lubricant_type_iso_6336_2019`.
OIL_TYPES = {
    "mineral": "mineral_oil",
    "pao": "polyalfaolefin",
    "pag": "water_soluble_polyglycol",
    "ester": "phosphate_ester",
}
OIL_TYPE = RexsKey("lubricant_type_iso_6336_2019", "type", older=("lubricant_type_iso_6336_2006",))
OIL_BASIS, OIL_KIND, OIL_NAME = (RexsKey(name, "") for name in ("basis", "kind", "name"))
LUBRICANT = (
    RexsKey("viscosity_at_40_degree_celsius", "viscosity_40", "mm^2 / s"),
    RexsKey("viscosity_at_100_degree_celsius", "viscosity_100", "mm^2 / s"),
    RexsKey("density_at_15_degree_celsius", "density_15", "kg / dm^3"),
)
OIL_TEMPERATURE = RexsKey("temperature_lubricant", "oil_temperature", "C")

#: Treatment of a scenario -> of `heat_treated_material_type_iso_6336_2019`.
TREATMENTS = {
    "case-hardened": "case_hardened_wrought_steel",
    "induction-hardened": "flame_or_induction_hardened_steel",
    "nitrided": "nitrided_steel",
    "nitrided-through-hardened": "nitrided_through_hardened_steel",
    "nitrocarburized": "nitrocaburized_wrought_steel",
    "through-hardened": "through_hardened_wrought_steel",
    "normalized": "normalized_wrought_low_carbon_steel",
    "grey-iron": "grey_cast_iron",
    "ductile-iron": "nodular_cast_iron_perlitic_or_bainitic_structure",
}
TREATMENT = RexsKey(
    "heat_treated_material_type_iso_6336_2019",
    "treatment",
    older=("heat_treated_material_type_iso_6336_2006",),
)
MATERIAL_NAME = RexsKey("material_designation", "")
DENSITY = RexsKey("density", "density", "kg / dm^3")
MATERIAL = (
    RexsKey("elastic_modulus", "youngs_modulus", "MPa"),
    RexsKey("poisson_ratio", "poisson_ratio"),
    DENSITY,
    RexsKey("thermal_conductivity", "thermal_conductivity", "W / (m K)"),
    RexsKey("thermal_capacity", "specific_heat", "J / (kg K)"),
    RexsKey("surface_hardness_vickers", "hardness", "HV"),
    RexsKey(
        "allowable_stress_number_contact_iso_6336_2016",
        "contact_stress_limit",
        "MPa",
        ("allowable_stress_number_contact_iso_6336_2003", "endurance_limit_flank"),
    ),
    RexsKey(
        "nominal_stress_number_tooth_root_iso_6336_2016",
        "bending_stress_limit",
        "MPa",
        ("nominal_stress_number_tooth_root_iso_6336_2003", "endurance_limit_root"),
    ),
    RexsKey("yield_strength", "yield_strength", "MPa"),
)

SPEED = RexsKey("rotational_speed", "speed", "1 / min")
TORQUE = RexsKey("torque_around_u_axis", "torque", "N m")
POWER = RexsKey("power", "power", "kW")
TRANSMITS, DEFINES_TORQUE, DEFINES_SPEED = (
    RexsKey(name, "") for name in ("transmits_torque", "defines_torque", "defines_speed")
)
SHARE = RexsKey("operating_time_fraction", "share", "%", ("load_duration_fraction",))
HOURS = RexsKey("operating_time", "share", "h")
MASS = RexsKey("mass_of_component", "mass", "kg")
INERTIA = RexsKey("moment_of_inertia_u_axis", "inertia", "kg m^2")

#: Modifications of flanks: type of the component -> attributes. Lengths lie along the line of action.
RELIEFS = {
    kind: (RexsKey(f"{kind}_depth", kind, "mm"), RexsKey(f"{kind}_datum_length", f"{kind}_length", "mm"))
    for kind in ("tip_relief", "root_relief")
}
RELIEF_SHAPE = RexsKey("shape_of_relief", "")
CROWNING = (
    RexsKey("helix_crowning_amount_datum_face", "lead_relief_start", "mm"),
    RexsKey("helix_crowning_amount_non_datum_face", "lead_relief_end", "mm"),
)
CROWNING_SHAPE = RexsKey("shape_of_helix_crowning", "")
#: Depth and length of the reliefs of both ends of the face.
END_RELIEFS = {
    f"end_relief_{face}": (
        RexsKey(f"end_relief_depth_{face}", key, "mm"),
        RexsKey(f"end_relief_length_{face}", "", "mm"),
    )
    for face, key in (("datum_face", "lead_relief_start"), ("non_datum_face", "lead_relief_end"))
}
HELIX_SLOPE = RexsKey("helix_slope", "helix_slope", "mm")
DATUM_FACE = RexsKey("datum_face_orientation", "")
