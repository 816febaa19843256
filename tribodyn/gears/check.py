"""What is said of a case of gears: the geometry sheet, stiffness, oil, laws and a rounded centre distance."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from tribodyn.cases.results import CheckResult, TextTable
from tribodyn.gears.case import LubricatedCase, rounded_in
from tribodyn.gears.prepare import PreparedGears
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import MaterialData, Side
from tribodyn.geometry.helix import pitch_slope
from tribodyn.mesh.by_compliance import compliance_remark
from tribodyn.mesh.quasi_static import single_pair
from tribodyn.post.report import exceeded
from tribodyn.post.verdict import IN_DOUBT
from tribodyn.quantities.quantity import Quantity, from_to
from tribodyn.tribology.closure import duty_range, exceeded_limits, law_quantities, laws_of, nominal_line_load
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.high_pressure import contact_viscosity
from tribodyn.tribology.law import Closure, FilmLaw, FrictionLaw
from tribodyn.tribology.oil import (
    GIVEN,
    T_40,
    T_100,
    ZERO_CELSIUS,
    LubricantData,
    kinematic_viscosity,
    oil_values,
)
from tribodyn.tribology.surface_state import range_shares

if TYPE_CHECKING:  # SciPy, which a plain run does without
    from tribodyn.compliance.sharing.slices import PairFlexibility


def with_rounding(checked: CheckResult, toml: str) -> CheckResult:
    """What `check` says, with how the centre distance of the scenario is rounded."""
    rounded = rounded_in(toml)
    if rounded is None:
        return checked
    lines = rounded.lines()
    rows = [(name, f"{value:.6g} {unit}") for name, (value, unit) in lines.items()]
    data = checked.data | {"geometry": checked.data["geometry"] | lines}
    table = TextTable("Printed digits", ("quantity", "value"), rows)
    return CheckResult(data, (*checked.tables, table), (*checked.remarks, rounded.remark()))


LINE_LOAD = Quantity("line_load", "Line load", "N/mm", ".0f")
PER_WIDTH = Quantity("per_width", "Stiffness per width", "N/(mm µm)", ".2f")
#: Factor to the unit that is shown, and that unit, by SI unit.
_SHOWN = {"Pa s": (1e3, "mPa s"), "1/Pa": (1e9, "1/GPa"), "1": (1.0, ""), "m2/s": (1e6, "mm²/s")}


def oil_data(lubricant: LubricantData) -> dict[str, Any]:
    """Return every number of a lubricant by name: `value` (SI), `unit`, `origin` and, where known, `spread`.

    With a data sheet also `type`, `oil_temperature`, `temperature`, at which the numbers hold, K, and
    `kinematic_viscosity`.
    """
    numbers: dict[str, Any] = {}
    if (sheet := lubricant.sheet) is not None:
        kinematic = kinematic_viscosity(sheet.viscosity_40, sheet.viscosity_100, lubricant.temperature)
        numbers["type"] = sheet.type
        warmer = lubricant.supply is not None
        around = lubricant.supply if warmer else lubricant.temperature
        origin = "operating.oil_temperature, or the network of [temperature]" if warmer else GIVEN
        numbers["oil_temperature"] = {"value": around, "unit": "K", "origin": origin}
        origin = "bulk temperature of the teeth" if warmer else "that of the oil"
        numbers["temperature"] = {"value": lubricant.temperature, "unit": "K", "origin": origin}
        numbers["kinematic_viscosity"] = {"value": kinematic, "unit": "m2/s", "origin": "ASTM D341"}
    for name, number in oil_values(lubricant).items():
        numbers[name] = {"value": float(number.value), "unit": number.unit, "origin": number.origin}
        if number.spread is not None:
            numbers[name]["spread"] = list(number.spread)
    return numbers


def oil_table(lubricant: LubricantData) -> TextTable:
    """Return the same as a table."""
    rows = []
    for name, number in oil_data(lubricant).items():
        if name in ("type", "oil_temperature", "temperature"):
            continue
        factor, unit = _SHOWN.get(number["unit"], (1.0, number["unit"]))
        spread = " to ".join(f"{factor * end:.4g}" for end in number.get("spread", ()))
        rows.append((name, f"{factor * number['value']:.4g}", unit, number["origin"], spread))
    title = "Lubricant"
    if (sheet := lubricant.sheet) is not None:
        where = ", bulk temperature of the teeth" if lubricant.supply is not None else ""
        title += f" ({sheet.type}) at {lubricant.temperature - ZERO_CELSIUS:.4g} °C{where}"
    return TextTable(title, ("quantity", "value", "unit", "from", "spread"), rows)


def oil_remarks(lubricant: LubricantData) -> list[str]:
    """Say what is extrapolated beyond the data sheet's two temperatures, and a measured law's."""
    if lubricant.sheet is None:
        return []
    measured = lubricant.sheet.law
    remarks = [] if measured is None else contact_viscosity(lubricant).limits(0.0, lubricant.temperature)
    if T_40 <= lubricant.temperature <= T_100:
        return [*remarks]
    return [
        *remarks,
        f"The oil at {lubricant.temperature - ZERO_CELSIUS:.4g} °C: viscosity extrapolated beyond the data "
        "sheet's 40 to 100 °C by ASTM D341.",
    ]


#: Name of a law in messages, by what it is a law of.
_NAMES = {"closure_exceeded": "film law", "friction_exceeded": "friction law"}


_BY_BODIES = ("energy", "fem")
_BODY_REMARKS = {
    "free": 'mesh.body = "free": the stiffness has no wind-up of the gear bodies in it.',
    "held": 'mesh.body = "held": the stiffness has the wind-up of the gear bodies against their bores in it.',
}


def check_gears(
    prepared: PreparedGears[Any], closure: Closure | None = None, masses: Any = None
) -> CheckResult:
    """What `check` prints of gears whose mesh is tabulated, with the laws in use where there are any.

    `masses`, (mass kg, inertia kg m²) of pinion and gear, stand in the sheet where they are given.
    """
    case, assembly = prepared.case, prepared.assembly
    torque = case.operating.gear_torque
    pair = single_pair(prepared.cycle, torque)
    method = f'compliance = "{case.mesh.compliance}"'
    remark = compliance_remark(assembly, case.materials, case.mesh)
    checked = sheet_and_stiffness(assembly, case.materials, method, pair, masses, remark, torque)
    checked = with_oil(checked, case.lubricant)
    if case.mesh.compliance in _BY_BODIES:
        checked = checked._replace(remarks=(*checked.remarks, _BODY_REMARKS[case.mesh.body]))
    if prepared.slice_remark:
        checked = checked._replace(remarks=(*checked.remarks, prepared.slice_remark))
    return checked if closure is None else _with_laws(checked, case, closure)


def with_oil(checked: CheckResult, lubricant: LubricantData) -> CheckResult:
    """Return what `check` prints with the lubricant added, under the key `lubricant`."""
    return checked._replace(
        data={**checked.data, "lubricant": oil_data(lubricant)},
        tables=(*checked.tables, oil_table(lubricant)),
        remarks=(*checked.remarks, *oil_remarks(lubricant)),
    )


def _with_laws(checked: CheckResult, case: LubricatedCase, closure: Closure) -> CheckResult:
    """Add the laws in use, why they were taken, and where the nominal duty leaves their ranges."""
    outside = _exceeded(case, closure)
    laws = zip(laws_of(case), (case.film.ratio, case.friction.ratio), strict=True)
    rows = [(law.table, law.name, *_at_duty(law, outside, ratio)) for law, ratio in laws]
    remarks = [remark for name, law in _NAMES.items() for remark in exceeded(outside, name, law)]
    chosen = [f"{key} = {law}, {why}." for key, (law, why) in case.chosen().items()]
    columns = ("", "law", "at this duty", "over the solved contact")
    return checked._replace(
        data={**checked.data, "laws": {**law_quantities(case), **outside}},
        tables=(*checked.tables, TextTable("Laws", columns, rows)),
        remarks=(*checked.remarks, *chosen, *remarks),
    )


def _at_duty(
    law: FilmLaw | FrictionLaw, outside: dict[str, Any], ratio: tuple[float, float, float] | None
) -> tuple[str, str]:
    """Whether the duty is inside the range of a law, and how far it is from the solved contact.

    `ratio` is that of contacts solved at the duty; None: there are none.
    """
    beyond = outside.get(f"{law.table}_outside", 0.0)
    range = "inside its range" if law.limits else "no range stated"
    if outside.get("closure_exceeded" if law.table == "film" else "friction_exceeded"):
        range = "partly outside its range" if beyond < IN_DOUBT else "outside its range"
    if ratio is not None:
        return range, f"{from_to(ratio[0], ratio[2])} at this duty"
    if law.judged is None:
        return range, "not compared"
    low, _, high = (beyond >= IN_DOUBT and law.judged.outside) or law.judged.ratio
    return range, f"{from_to(low, high)} in nine of ten contacts"


def _exceeded(case: LubricatedCase, closure: Closure) -> dict[str, Any]:
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
    gear_torque: float = 0.0,
) -> CheckResult:
    """The sheet of gears that were checked, and how stiff they are.

    `pair` is the normal load of a single pair at the pitch point, N, and its stiffness at that load, N/m, by
    a `method`, with a `remark` on it; `masses` are those of `check_gears`. With the torque on the gear, N m,
    the sheet has the forces of helical teeth.
    """
    from tribodyn.geometry.sheet import geometry_sheet

    normal_load, stiffness = pair
    width = float(assembly.common_width)
    per_width = {method: stiffness / width}
    reference, tables, remarks = {}, [], [remark] if remark else []
    if assembly.family.involute:
        iso, table, remark_on_reference = _reference(assembly, materials, normal_load)
        reference = {"iso_6336_1": iso}
        per_width["ISO 6336-1 c', factors below"] = iso["single_pair"]
        per_width["ISO 6336-1 c'_th, theory"] = iso["theoretical"]
        tables.append(table)
        remarks.append(remark_on_reference)
    by = {name: {"per_width": value, "stiffness": value * width} for name, value in per_width.items()}
    sheet = geometry_sheet(assembly, masses, gear_torque=gear_torque)
    line_load = normal_load / width
    table = TextTable(
        f"Stiffness of a single pair at the pitch point, at {LINE_LOAD.with_unit(line_load)}",
        ("by", "N/(mm µm)", "N/µm"),
        [
            (name, PER_WIDTH.written(value["per_width"]), f"{value['stiffness'] * 1e-6:.4g}")
            for name, value in by.items()
        ],
    )
    about = {"line_load": line_load, "by": by, "remark": remark} | reference
    data = {"geometry": sheet, "stiffness": about}
    return CheckResult(data, (*sheet_tables(sheet), table, *tables), remarks)


def check_on_elements(case: Any, flexible: "PairFlexibility") -> CheckResult:
    """What `check` says of gears on finite elements: their sheet, and the stiffness of a pair of them."""
    from tribodyn.compliance.sharing.loaded_contact import single_pair_stiffness

    assembly, torque = flexible.assembly, case.operating.gear_torque
    transverse = math.cos(float(assembly.path.pressure_angle(0.0)))
    # the stiffness along the path of contact, as the standard has it: load and deflection are each cos β_n of
    # the normal's
    cosine = 1.0 / math.hypot(1.0, float(pitch_slope(assembly)) * transverse)
    normal_load = torque / (float(assembly.path.gear_pitch_radius) * transverse * cosine)
    pair = normal_load, single_pair_stiffness(flexible, torque) * cosine**2
    return sheet_and_stiffness(assembly, case.materials, "finite elements", pair, gear_torque=torque)


def _reference(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], normal_load: float
) -> tuple[dict[str, Any], TextTable, str]:
    """Reference stiffness by ISO 6336-1: data in SI units, their table, and what is to be said of them."""
    from tribodyn.compliance.iso6336 import bodies_outside, outside, pair_of, reference_stiffness

    pair = pair_of(assembly, materials, normal_load)
    stiffness = reference_stiffness(pair)
    limits = [*outside(pair), *bodies_outside(assembly)]
    per_width = "N/(mm µm)"
    rows = [
        ("c'_th, one pair, theory for steel", PER_WIDTH.written(stiffness.theoretical), per_width),
        ("C_M, correction from measurements", f"{stiffness.correction:g}", ""),
        ("C_R, bodies: solid discs", f"{stiffness.blank:g}", ""),
        ("C_B, rack", f"{stiffness.rack:.4g}", ""),
        ("E/E_St", f"{stiffness.material:.4g}", ""),
        (f"reduction at F_t/b = {LINE_LOAD.with_unit(pair.line_load)}", f"{stiffness.load:.4g}", ""),
        ("c', one pair", PER_WIDTH.written(stiffness.single_pair), per_width),
        ("c_γα, mean of the mesh", PER_WIDTH.written(stiffness.mesh), per_width),
        ("c_γβ, for the face load factor", PER_WIDTH.written(stiffness.mesh_face), per_width),
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
    return _sheet_table("Pair", {"value": pair}), _sheet_table("Gears", bodies)


#: Endings of lines of a pair's sheet that hold for each of its gears.
_OF_BOTH = ("module", "helix angle", "of the rack on its rolling line")


def sheet_of_gear(sheet: Mapping[str, Any], side: Side) -> dict[str, Any]:
    """The lines of a pair's sheet that describe one of its gears."""
    return {name: value for name, value in sheet.items() if name.endswith(_OF_BOTH)} | sheet[side]


def gear_table(name: str, sheets: Mapping[str, Mapping[str, Any]]) -> TextTable:
    """Lay out the sheets of a gear by its meshes."""
    titles = {f"in {mesh}" if mesh else "value": sheet for mesh, sheet in sheets.items()}
    return _sheet_table(f"Gear {name}", titles)


def _sheet_table(title: str, sheets: Mapping[str, Mapping[str, Any]]) -> TextTable:
    rows = [
        (name, *(with_unit(*sheet[name]) if name in sheet else "" for sheet in sheets.values()))
        for name in dict.fromkeys(name for sheet in sheets.values() for name in sheet)
    ]
    return TextTable(title, ("quantity", *sheets), rows)


def with_unit(value: Any, unit: str) -> str:
    """Write a value with its unit."""
    number = f"{value:.6g}" if isinstance(value, float) else str(value)
    return f"{number} {unit}".strip()
