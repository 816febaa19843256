"""What `check` prints of a case of gears: the geometry sheet, stiffness, oil and laws."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import MaterialData
from tribodyn.mesh.by_compliance import compliance_remark
from tribodyn.mesh.quasi_static import single_pair
from tribodyn.post.report import exceeded
from tribodyn.studies.gears.oil import oil_data, oil_remarks, oil_table
from tribodyn.studies.gears.prepare import PreparedGears
from tribodyn.studies.protocol.results import CheckResult, TextTable
from tribodyn.tribology.closure import (
    Lubricated,
    duty_range,
    exceeded_limits,
    law_figures,
    laws_of,
    nominal_line_load,
)
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.law import Closure
from tribodyn.tribology.lubricant import LubricantData
from tribodyn.tribology.surface_state import range_shares

#: Name of a law in messages, by what it is a law of.
_NAMES = {"closure_exceeded": "film law", "friction_exceeded": "friction law"}


def check_gears(
    prepared: PreparedGears[Any], closure: Closure | None = None, masses: Any = None
) -> CheckResult:
    """What `check` prints of gears whose mesh is tabulated.

    Parameters
    ----------
    closure : Closure, optional
        Laws in use, where the study has any.
    masses : sequence of (mass kg, inertia kg m²), optional
        Of pinion and gear, where they are to stand in the sheet.
    """
    case, assembly = prepared.case, prepared.assembly
    pair = single_pair(prepared.cycle, case.operating.gear_torque)
    method = f'compliance = "{case.mesh.compliance}"'
    remark = compliance_remark(assembly, case.materials, case.mesh)
    checked = sheet_and_stiffness(assembly, case.materials, method, pair, masses, remark)
    checked = with_oil(checked, case.lubricant)
    return checked if closure is None else _with_laws(checked, case, closure)


def with_oil(checked: CheckResult, lubricant: LubricantData) -> CheckResult:
    """Return what `check` prints with the lubricant added, under the key `lubricant`."""
    return checked._replace(
        data={**checked.data, "lubricant": oil_data(lubricant)},
        tables=(*checked.tables, oil_table(lubricant)),
        remarks=(*checked.remarks, *oil_remarks(lubricant)),
    )


def _with_laws(checked: CheckResult, case: Lubricated, closure: Closure) -> CheckResult:
    """Add the laws in use, their ranges, and where the nominal duty leaves them."""
    outside = _exceeded(case, closure)
    rows = [(law.table, law.name, law.stated or "none stated") for law in laws_of(case)]
    remarks = [remark for name, law in _NAMES.items() for remark in exceeded(outside, name, law)]
    return checked._replace(
        data={**checked.data, "laws": {**law_figures(case), **outside}},
        tables=(*checked.tables, TextTable("Laws and their ranges", ("", "law", "range"), rows)),
        remarks=(*checked.remarks, *remarks),
    )


def _exceeded(case: Lubricated, closure: Closure) -> dict[str, Any]:
    """Limits exceeded along the path by a pair that carries the whole torque alone, without vibration."""
    if not case.operating.gear_torque or not case.operating.pinion_speed:
        return {}
    duty = duty_range(case)
    entrainment, curvature, ratio = np.array(duty.places).T
    sliding = ratio * entrainment
    speeds = entrainment + 0.5 * sliding, entrainment - 0.5 * sliding
    contact = local_contact(nominal_line_load(duty), curvature, entrainment, sliding, *speeds)
    return exceeded_limits(case, *range_shares(contact, closure))


def sheet_and_stiffness(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    method: str,
    pair: tuple[float, float],
    masses: Any = None,
    remark: str = "",
) -> CheckResult:
    """The sheet of gears, and how stiff they are.

    Parameters
    ----------
    assembly : checked
    materials : (MaterialData, MaterialData)
    method : how the stiffness was worked out
    pair : (float, float); normal load of a single pair at the pitch point, N, and its stiffness at that load,
        N/m
    masses : sequence of (mass kg, inertia kg m²), optional
        Of pinion and gear, where they are to stand in the sheet.
    remark : what is to be said of the stiffness
    """
    from tribodyn.geometry.sheet import geometry_sheet

    normal_load, stiffness = pair
    width = float(assembly.common_width)
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
    return CheckResult(data, (*sheet_tables(sheet), table, *tables), remarks)


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
