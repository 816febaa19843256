"""What the studies of gear pairs have in common: records over time, what `check` says."""

from collections.abc import Sequence
from typing import Any

from tribodyn.dynamics.recorded import DOF_SCALE, PAIR, SAMPLES
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.material import MaterialData
from tribodyn.geometry.sheet.outlines import GEOMETRY
from tribodyn.mesh.cycle import MESH_CYCLE
from tribodyn.record.schema import TIME, Layout
from tribodyn.studies.protocol.study import Checked, TextTable

LAYOUT = Layout(
    TIME, SAMPLES, {"pair": PAIR, "dof": DOF_SCALE}, groups={"mesh_cycle": MESH_CYCLE, "geometry": GEOMETRY}
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
