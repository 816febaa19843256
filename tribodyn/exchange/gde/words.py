"""Names of elements and units of GDE files, as far as they are known: no schema and no sample was at hand.

The first name of each is the one that is written. Case, hyphens and prefixes of namespaces do not count.
"""

import math
from typing import NamedTuple

#: First elements of a file.
ROOTS = ("gear_data_exchange_format", "gear_data_exchange", "gde_format", "gde_file", "gde")
#: What holds a gear: the last of them that stand inside each other is one.
GEARS = (
    *("gear", "gear_data", "gear_element", "cylindrical_gear", "involute_gear", "external_gear"),
    *("internal_gear", "gearing"),
)
GEOMETRY = ("geometry", "basic_geometry", "gear_geometry", "nominal_data")
INSPECTION = ("inspection", "measurement", "measurements", "measurement_data", "measured_data")
#: What holds nothing that is read here.
OTHERS = (
    *("header", "identification", "administration", "process", "process_data", "tool", "tools", "tool_data"),
    *("tolerances", "modifications", "results", "evaluation_results", "measuring_conditions"),
    *("tooth_thickness", "tooth_thickness_measurement", "comment", "remarks", "units"),
)
GROUPS = ("gears", "gear_elements", "profiles", "helices", "traces", "profile", "helix")

PROFILES = ("profile_measurement", "profile_trace", "profile_curve", "profile_line")
HELICES = ("helix_measurement", "helix_trace", "lead_measurement", "lead_trace", "helix_curve")
PITCHES = ("pitch_measurement", "pitch", "pitch_deviations")
RUNOUTS = ("runout_measurement", "runout", "run_out", "run_out_measurement")

TOOTH = ("tooth_number", "tooth", "tooth_no")
FLANK = ("flank", "side")
POINTS = ("point", "measuring_point", "p")
ROLL_LENGTHS = ("roll_length", "length_of_roll", "rolling_length")
ROLL_ANGLES = ("roll_angle", "angle_of_roll", "rolling_angle")
DIAMETERS = ("diameter", "measuring_diameter", "d")
FACES = ("face_position", "facewidth_position", "axial_position", "z")
DEVIATIONS = ("deviation", "deviations", "value")
CUMULATIVE = ("cumulative_pitch_deviation", "index_deviation", "cumulative_pitch_deviations")
SINGLE = ("single_pitch_deviation", "single_pitch_deviations")
RADIAL = ("radial_deviation", "radial_deviations", "radial_reading")
BEGIN, END = ("evaluation_begin", "evaluation_start"), ("evaluation_end",)

#: Of `NominalGear`: field -> names and the kind of quantity.
NOMINAL = {
    "teeth": (("number_of_teeth", "teeth"), "number"),
    "internal": (("gear_type", "type_of_gear"), "type"),
    "module": (("normal_module", "module"), "length"),
    "pressure_angle": (("normal_pressure_angle", "pressure_angle"), "angle"),
    "helix_angle": (("helix_angle", "helix_angle_reference_diameter"), "angle"),
    "hand": (("hand_of_helix", "helix_direction", "hand", "helix_hand"), "hand"),
    "profile_shift": (
        ("profile_shift_coefficient", "addendum_modification_coefficient"),
        "number",
    ),
    "face_width": (("face_width", "facewidth"), "length"),
    "tip_diameter": (("tip_diameter",), "length"),
}
HANDS = {
    **dict.fromkeys(("right", "right_hand", "r"), "right"),
    **dict.fromkeys(("left", "left_hand", "l"), "left"),
    **dict.fromkeys(("spur", "none", "straight"), ""),
}
SIDES = {
    **dict.fromkeys(("left", "l", "links", "left_flank"), "left"),
    **dict.fromkeys(("right", "r", "rechts", "right_flank"), "right"),
}


class GdeUnit(NamedTuple):
    """A unit: the kind of quantity, and its size in SI units."""

    kind: str
    si: float


UNITS = {
    **dict.fromkeys(("mm",), GdeUnit("length", 1e-3)),
    **dict.fromkeys(("um", "µm", "μm", "mum", "micrometer", "micrometre", "micron"), GdeUnit("length", 1e-6)),
    **dict.fromkeys(("m",), GdeUnit("length", 1.0)),
    **dict.fromkeys(("in", "inch"), GdeUnit("length", 25.4e-3)),
    **dict.fromkeys(("deg", "°", "degree", "degrees"), GdeUnit("angle", math.pi / 180)),
    **dict.fromkeys(("rad",), GdeUnit("angle", 1.0)),
}


def plain(name: str) -> str:
    """A name as the tables above have it: small letters, without the prefix of a namespace."""
    return name.rpartition(":")[2].strip().lower().replace("-", "_")
