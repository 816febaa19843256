"""What the studies of gear pairs have in common: records over time, lines of a summary, what `check` says."""

from collections.abc import Sequence
from typing import Any

from tribodyn.dynamics.recorded import DOF_SCALE, PAIR, SAMPLES
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.recorded import GEOMETRY
from tribodyn.mesh.recorded import MESH_CYCLE
from tribodyn.post.report import Line
from tribodyn.record.schema import TIME, Layout
from tribodyn.studies.study import Checked, TextTable

LAYOUT = Layout(
    TIME, SAMPLES, {"pair": PAIR, "dof": DOF_SCALE}, groups={"mesh_cycle": MESH_CYCLE, "geometry": GEOMETRY}
)

CONTACT_RATIO = Line("contact_ratio", "Contact ratio", form=".4f")
EFFECTIVE_CONTACT_RATIO = Line(
    "contact_ratio_effective", "Contact ratio under load, corner contact included", form=".4f"
)
SINGLE_PAIR = Line(
    "stiffness_single_pair_at_pitch_point", "Stiffness of one pair at the pitch point", 1e-6, "N/µm"
)
MESH_FREQUENCY = Line("mesh_frequency", "Mesh frequency", 1.0, "Hz")
NORMAL_LOAD = Line("normal_load_max", "Maximum normal load", 1.0, "N", ",.0f")
TRIBOLOGY = (
    Line("film_min", "Minimum film thickness", 1e6, "µm", ".3g"),
    Line("film_parameter_min", "Minimum film parameter", form=".3g"),
    Line("hertz_pressure_max", "Maximum Hertz pressure", 1e-9, "GPa", ".3g"),
    Line("flash_temperature_max", "Maximum flash temperature rise", 1.0, "K", ".3g"),
    Line("friction_coefficient_mean", "Friction coefficient, mean", form=".4f"),
    Line("friction_force_mean", "Friction force, mean over the cycle", 1.0, "N", ".1f"),
)
ENERGY = (
    Line("driving_gear", "Driving gear"),
    Line("power_in_mean", "Power in, mean", 1.0, "W", ",.1f"),
    Line("power_friction_mean", "Friction loss, mean", 1.0, "W", ".3g"),
    Line(
        "friction_work_on_vibration", "Friction's work on the vibration, share of the loss", 100.0, "%", ".2g"
    ),
    Line("efficiency", "Efficiency", 100.0, "%", ".2f"),
)
WALL_TIME = Line("wall_time", "Wall time", 1.0, "s", ".3g")


def checked(
    assembly: Assembly,
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
    from tribodyn.compliance.iso6336 import single_pair_stiffness as iso6336
    from tribodyn.geometry.sheet import geometry_sheet

    pinion, gear = assembly.drive.pinion, assembly.drive.gear
    width = float(min(pinion.face_width, gear.face_width))
    per_width = {method: stiffness / width}
    if assembly.family.involute:
        iso = iso6336(pinion.teeth, gear.teeth, pinion.profile_shift, gear.profile_shift)
        per_width["ISO 6336 c', which contains the measured correction 0.8"] = iso.single_pair
        per_width["ISO 6336 c'_th, theory"] = iso.theoretical
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
    data = {"geometry": sheet, "stiffness": {"line_load": line_load, "by": by, "remark": remark}}
    return Checked(data, (*sheet_tables(sheet), table), (remark,) if remark else ())


def sheet_tables(sheet: dict[str, Any]) -> Sequence[TextTable]:
    """Lay out the sheet of `tribodyn.geometry.sheet`: a table of the pair, one of the gears."""
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
