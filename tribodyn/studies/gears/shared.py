"""What the studies of gear pairs have in common: records over time, lines of a summary, what `check` says."""

from collections.abc import Sequence
from typing import Any

from tribodyn.dynamics.recorded import DOF_SCALE, PAIR, SAMPLES
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.material import MaterialData
from tribodyn.geometry.sheet.recorded import GEOMETRY
from tribodyn.mesh.recorded import MESH_CYCLE
from tribodyn.post.report import Line
from tribodyn.record.schema import TIME, Layout
from tribodyn.studies.protocol.study import Checked, TextTable

LAYOUT = Layout(
    TIME, SAMPLES, {"pair": PAIR, "dof": DOF_SCALE}, groups={"mesh_cycle": MESH_CYCLE, "geometry": GEOMETRY}
)

CONTACT_RATIO = Line(
    "contact_ratio",
    "Contact ratio",
    form=".4f",
    definition="Rotation of the pinion during which a pair touches over the pitch between two pairs; "
    "unloaded teeth.",
)
EFFECTIVE_CONTACT_RATIO = Line(
    "contact_ratio_effective",
    "Contact ratio under load, corner contact included",
    form=".4f",
    definition="Rotation during which a pair carries load over the pitch between two pairs, elastic teeth.",
)
SINGLE_PAIR = Line(
    "stiffness_single_pair_at_pitch_point",
    "Stiffness of one pair at the pitch point",
    1e-6,
    "N/µm",
    definition="Load over deflection of one pair along its normal, the whole torque on this pair; with a "
    "load-dependent contact the tangent.",
)
MESH_FREQUENCY = Line(
    "mesh_frequency",
    "Mesh frequency",
    1.0,
    "Hz",
    definition="Pairs that pass per second: pinion teeth times its mean speed in revolutions per second.",
)
NORMAL_LOAD = Line(
    "normal_load_max",
    "Maximum normal load",
    1.0,
    "N",
    ",.0f",
    "Maximum of a single pair, along its normal.",
)
TRIBOLOGY = (
    Line(
        "film_min",
        "Minimum film thickness",
        1e6,
        "µm",
        ".3g",
        "Minimum of all pairs under load; the central film, or the minimum film where the law gives that.",
    ),
    Line(
        "film_parameter_min",
        "Minimum film parameter λ",
        form=".3g",
        definition="Minimum of film thickness over composite RMS roughness. Below 1 mixed to boundary, "
        "above 3 full "
        "film lubrication.",
    ),
    Line(
        "film_parameter_min_roll_angle",
        "at the roll angle from the pitch point",
        57.29577951308232,
        "°",
        ".3g",
        "Rotation of the pinion since the pair with the minimum film parameter passed the pitch point; "
        "negative "
        "before it.",
    ),
    Line(
        "hertz_pressure_max",
        "Maximum Hertz pressure",
        1e-9,
        "GPa",
        ".3g",
        "Maximum of the pressure in the middle of the Hertz contact, at the highest line load along the "
        "face.",
    ),
    Line(
        "flash_temperature_max",
        "Maximum flash temperature rise",
        1.0,
        "K",
        ".3g",
        "Maximum rise of the contact's temperature above the bulk of the teeth, which is as warm as the oil "
        "where [temperature] does not say otherwise.",
    ),
    Line(
        "friction_coefficient_mean",
        "Friction coefficient, mean",
        form=".4f",
        definition="Mean weighted with normal load times sliding speed: the coefficient that gives the "
        "same loss.",
    ),
    Line(
        "friction_force_mean",
        "Friction force, mean over the cycle",
        1.0,
        "N",
        ".1f",
        "Mean magnitude, by number of the pair; zero while a number has no contact.",
    ),
)
ENERGY = (
    Line(
        "driving_gear",
        "Driving gear",
        definition="The gear that puts power in, by the sign of the mean powers.",
    ),
    Line(
        "power_in_mean",
        "Power in, mean",
        1.0,
        "W",
        ",.1f",
        "Mean power that the driving gear puts in, from its integrated work.",
    ),
    Line(
        "power_friction_mean",
        "Loss to tooth friction, mean",
        1.0,
        "W",
        ".3g",
        "Mean power of the friction forces, from their integrated work.",
    ),
    Line(
        "power_damping_mean",
        "Loss to damping of mesh and bearings, mean",
        1.0,
        "W",
        ".3g",
        "Mean power of the damping forces of mesh and bearings, from their integrated work.",
    ),
    Line(
        "friction_work_on_vibration",
        "Friction's work on the vibration, share of the loss",
        100.0,
        "%",
        ".2g",
        "Work that friction does on the vibration over the loss that the rotation alone would have; "
        "positive where "
        "friction feeds the vibration.",
    ),
    Line(
        "efficiency",
        "Efficiency",
        100.0,
        "%",
        ".2f",
        "Mean power out over mean power in, by energy over whole mesh cycles; withheld outside 0 … 100 %.",
    ),
)
THERMAL = (
    Line(
        "bulk_temperature",
        "Bulk temperature of the teeth",
        form=".1f",
        unit="°C",
        offset=-273.15,
        definition="Mean of both gears, from the losses by [temperature]; film and friction are taken at it.",
    ),
    Line(
        "contact_temperature_max",
        "Maximum contact temperature",
        form=".1f",
        unit="°C",
        offset=-273.15,
        definition="Bulk temperature of the teeth, or that of the oil where [temperature] does not say "
        "otherwise, and the maximum flash temperature rise.",
    ),
    Line(
        "oil_temperature",
        "Temperature of the oil around the gears",
        form=".1f",
        unit="°C",
        offset=-273.15,
        definition="Given, or that of the network of [temperature].",
    ),
    Line("power_churning", "Loss to churning", 1.0, "W", ".3g", "By the formula of losses.churning."),
    Line("power_windage", "Loss to windage", 1.0, "W", ".3g", "By the formula of losses.windage."),
    Line(
        "power_bearings",
        "Loss to bearings without load",
        1.0,
        "W",
        ".3g",
        "By the formula of losses.bearings.",
    ),
    Line(
        "power_load_independent",
        "Load-independent losses",
        1.0,
        "W",
        ".3g",
        "Churning, windage and bearings by the formulas of [losses]; not in the lines above.",
    ),
    Line(
        "efficiency_with_losses",
        "Efficiency, load-independent losses included",
        100.0,
        "%",
        ".2f",
        "Power out over power in, to which the load-independent losses are added.",
    ),
)
WALL_TIME = Line(
    "wall_time", "Wall time", 1.0, "s", ".3g", "Time that the computation took, without start and drawing."
)


def checked(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    method: str,
    normal_load: float,
    stiffness: float,
    masses: Any = None,
    remark: str = "",
) -> Checked:
    """Say what gears a case describes and how stiff they are.

    Parameters
    ----------
    assembly : Assembly
        Checked.
    materials : (MaterialData, MaterialData)
        Of pinion and gear.
    method : str
        How the stiffness was worked out.
    normal_load : float
        Of a single pair at the pitch point, N.
    stiffness : float
        Of that pair at that load, N/m.
    masses : sequence of (mass kg, inertia kg m²), optional
        Of pinion and gear, where they are to stand in the sheet.
    remark : str
        What is to be said of the stiffness.
    """
    from tribodyn.geometry.sheet.sheet import geometry_sheet

    pinion, gear = assembly.drive.pinion, assembly.drive.gear
    width = float(min(pinion.face_width, gear.face_width))
    per_width = {method: stiffness / width}
    reference, tables, remarks = None, [], [remark] if remark else []
    if assembly.family.involute:
        reference, table, remark_on_reference = _reference(assembly, materials, normal_load)
        per_width["ISO 6336-1 c', factors below"] = reference["single_pair"]
        per_width["ISO 6336-1 c'_th, theory"] = reference["theoretical"]
        tables.append(table)
        remarks.append(remark_on_reference)
    by = {name: {"per_width": value, "stiffness": value * width} for name, value in per_width.items()}
    sheet = geometry_sheet(assembly, masses)
    line_load = normal_load / width
    table = TextTable(
        f"Stiffness of a single pair at the pitch point, at {line_load * 1e-3:.0f} N/mm",
        ("by", "N/(mm um)", "N/m"),
        [
            (name, f"{value['per_width'] * 1e-9:.2f}", f"{value['stiffness']:.4g}")
            for name, value in by.items()
        ],
    )
    about = {"line_load": line_load, "by": by, "remark": remark}
    if reference is not None:
        about["iso_6336_1"] = reference
    data = {"geometry": sheet, "stiffness": about}
    return Checked(data, (*sheet_tables(sheet), table, *tables), remarks)


def _reference(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], normal_load: float
) -> tuple[dict[str, Any], TextTable, str]:
    """Reference stiffness by ISO 6336-1: data in SI units, their table, and what is to be said of them."""
    from tribodyn.compliance.iso6336 import bodies_outside, outside, pair_of, reference_stiffness

    pair = pair_of(assembly, materials, normal_load)
    stiffness = reference_stiffness(pair)
    limits = [*outside(pair), *bodies_outside(assembly)]
    per_width = "N/(mm um)"
    rows = [
        ("c'_th, one pair, theory for steel", f"{stiffness.theoretical * 1e-9:.2f}", per_width),
        ("C_M, correction from measurements", f"{stiffness.correction:g}", ""),
        ("C_R, bodies: solid discs", f"{stiffness.blank:g}", ""),
        ("C_B, rack", f"{stiffness.rack:.4g}", ""),
        ("E/E_St", f"{stiffness.material:.4g}", ""),
        (f"reduction at F_t/b = {pair.line_load * 1e-3:.0f} N/mm", f"{stiffness.load:.4g}", ""),
        ("c', one pair", f"{stiffness.single_pair * 1e-9:.2f}", per_width),
        ("c_gamma alpha, mean of the mesh", f"{stiffness.mesh * 1e-9:.2f}", per_width),
        ("c_gamma beta, for the face load factor", f"{stiffness.mesh_face * 1e-9:.2f}", per_width),
    ]
    remark = "ISO 6336-1, method B, with K_A = 1"
    remark += ", reduced below 100 N/mm" if stiffness.load < 1.0 else ""
    remark += f", is outside its limits: {'; '.join(limits)}." if limits else ": inside its limits."
    data = {**stiffness._asdict(), "line_load": pair.line_load, "outside": limits}
    return data, TextTable("Reference stiffness by ISO 6336-1", ("factor", "value", "unit"), rows), remark


def sheet_tables(sheet: dict[str, Any]) -> Sequence[TextTable]:
    """Lay out the sheet of `tribodyn.geometry.sheet.sheet`: a table of the pair, one of the gears."""
    bodies = {name: sheet[name] for name in ("pinion", "gear")}
    pair = {name: value for name, value in sheet.items() if name not in bodies}
    names = list(dict.fromkeys(name for body in bodies.values() for name in body))
    rows = [
        (name, *(with_unit(*body[name]) if name in body else "" for body in bodies.values()))
        for name in names
    ]
    return (
        TextTable("Pair", ("quantity", "value"), [(name, with_unit(*value)) for name, value in pair.items()]),
        TextTable("Gears", ("quantity", *bodies), rows),
    )


def with_unit(value: Any, unit: str) -> str:
    """Write a value with its unit."""
    number = f"{value:.6g}" if isinstance(value, float) else str(value)
    return f"{number} {unit}".strip()
