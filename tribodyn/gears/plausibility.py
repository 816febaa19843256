"""Which numbers of a case of gears lie outside what is usual.

Nothing is refused here: a number outside the field's usual range is more often a slip, a wrong unit or a
digit too many, than a gear.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from functools import wraps
from math import isfinite
from typing import Any, NamedTuple, TypeVar

from tribodyn.cases.results import CaseHead, CheckResult, TextTable
from tribodyn.dynamics.data import BearingData
from tribodyn.gears.case import GearCase
from tribodyn.gears.check import with_rounding
from tribodyn.gears.duty import duty_lines, nominal_duty
from tribodyn.gears.rating.bearings import bearing_part, bearing_rows, shafts_of_pair
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.drive import SIDES, Side, body_of
from tribodyn.geometry.families import family
from tribodyn.numerics.files.rows import table_rows
from tribodyn.tribology.oil import T_40, T_100, ZERO_CELSIUS, LubricantData

AnyCase = TypeVar("AnyCase", bound=CaseHead)


class UsualRange(NamedTuple):
    """What is usual of a number: its ends in a unit, where they are from, and what lies beyond them."""

    what: str
    low: float
    high: float
    unit: str
    source: str
    beyond: str

    @property
    def ends(self) -> str:
        """The range in words."""
        if not isfinite(self.high):
            return f"at least {self.low:g} {self.unit}".rstrip()
        first = f"{self.low:g} to" if self.low else "at most"
        return f"{first} {self.high:g} {self.unit}".rstrip()

    def sentence(self, number: float) -> str:
        """What to say of a number outside."""
        with_unit = f"{number:.4g} {self.unit}".rstrip()
        return f"{self.what}: {with_unit}; usual is {self.ends} ({self.source}). {self.beyond}"


#: By the names of `_numbers`, in whose units the ends are.
USUAL = {
    name: UsualRange(what, float(low), float(high), *words)
    for name, what, low, high, *words in (row.values() for row in table_rows(__package__, "usual_ranges.csv"))
}


def checks_gears(check: Callable[[AnyCase], CheckResult]) -> Callable[[AnyCase], CheckResult]:
    """A study's `check` that also says the duty of a pair of gears, what is unusual and what is rounded."""

    @wraps(check)
    def completed(case: AnyCase) -> CheckResult:
        return with_duty(with_rounding(check(case), case.toml), case)

    return completed


def with_duty(checked: CheckResult, case: CaseHead, bearings: Iterable[BearingData] = ()) -> CheckResult:
    """What `check` says, with the duty first and what is unusual; of a `GearCase`, others as they are.

    `bearings` hold its gears.
    """
    if not isinstance(case, GearCase):  # of another package's study
        return checked
    duty = nominal_duty(case, assemble(family(case.family), case.drive))
    lines = duty_lines(duty)
    rows = [(name, f"{_four_digits(value)} {unit}".strip()) for name, (value, unit) in lines.items()]
    table = TextTable("Duty", ("quantity", "value"), rows)
    unusual = unusual_values(case, bearings)
    held = bearing_part(shafts_of_pair(case), getattr(case, "lubricant", None))
    data = {"duty": lines, "unusual": unusual, **held} | checked.data
    tables = [table]
    if held:
        tables.append(TextTable("Bearings", *bearing_rows(held["bearings"])))
    return checked._replace(data=data, tables=(*tables, *checked.tables), warnings=tuple(unusual))


def _four_digits(value: float) -> str:
    return f"{value:#.4g}".removesuffix(".")


def unusual_values(case: GearCase, bearings: Iterable[BearingData] = ()) -> list[str]:
    """Say of each number of a case that lies outside the field's usual range what is usual, in a sentence."""
    sentences: dict[str, None] = {}  # of both gears, or both bearings, once
    outside: set[str] = set()
    for name, number in _numbers(case, bearings):
        usual_range = USUAL[name]
        twice = name == "roughness_over_module" and "roughness" in outside
        if isfinite(number) and not twice and not usual_range.low <= number <= usual_range.high:
            outside.add(name)
            sentences[usual_range.sentence(number)] = None
    assembly = assemble(family(case.family), case.drive)
    return [*sentences, *shortened_flanks(assembly)]


def shortened_flanks(assembly: Assembly) -> list[str]:
    """What undercut takes of the path of contact, a line for each gear."""
    whole, left = assembly.contact_ratio_between(*assembly.tip_limits), assembly.contact_ratio
    undercut: list[Side] = [side for side in SIDES if assembly.shortened(side)]
    begins = {side: 2e3 * float(assembly.tooth(side).form_radius) for side in undercut}
    return [
        f"The {side} is undercut: its flank begins at a diameter of {begins[side]:.6g} mm, which leaves a "
        f"contact ratio of {left:.4g} of {whole:.4g}."
        for side in undercut
    ]


def _numbers(case: Any, bearings: Iterable[BearingData]) -> Iterator[tuple[str, float]]:
    """Go through what is looked at: name in `USUAL`, value in its unit; not what is not given, or zero."""
    drive, mesh = case.drive, case.mesh
    assembly = assemble(family(case.family), drive)
    duty, module = nominal_duty(case, assembly), float(drive.module)
    yield "module", module * 1e3
    yield "face_width", float(assembly.common_width) / abs(2.0 * float(assembly.path.pinion_pitch_radius))
    yield "gear_ratio", abs(float(drive.gear.teeth) / float(drive.pinion.teeth))
    yield "contact_ratio", duty.contact_ratio
    for side in SIDES:
        body = body_of(drive, side)
        rim = float(assembly.tooth(side).root_radius) - float(body.bore_radius)
        yield "rim", rim / (module * float(body.addendum + body.dedendum))
        flank = getattr(mesh.modifications, side)
        ends = flank.tip.amount, flank.root.amount, flank.lead.start, flank.lead.end, flank.lead.crowning
        yield "relief", max(ends) / module
    if duty.pitch_line_speed:
        yield "pitch_line_speed", duty.pitch_line_speed
    pairs = max(1, math.floor(duty.contact_ratio))  # that share the load everywhere
    yield "specific_load", duty.line_load / (module * 1e3) / pairs
    yield "hertz_pressure", duty.hertz_pressure
    yield "roughness", case.mean_roughness * 1e6
    yield "roughness_over_module", case.roughness / module
    yield "backlash", (mesh.backlash or 0.0) / module
    for table in (mesh, getattr(case, "settings", None)):
        if ratio := getattr(table, "damping_ratio", 0.0):
            yield "mesh_damping", ratio
    for material in case.materials:
        yield "youngs_modulus", material.youngs_modulus * 1e-9
        yield "material_density", material.density
    for bearing in bearings:
        for axis in ("x", "y"):
            yield "bearing_stiffness", getattr(bearing, f"stiffness_{axis}") * 1e-6
            if ratio := getattr(bearing, f"damping_ratio_{axis}"):
                yield "bearing_damping", ratio
    if friction := getattr(case, "friction", None):
        yield "friction_coefficient", float(friction.values.get("coefficient") or math.nan)
    if oil := getattr(case, "lubricant", None):
        yield from _of_oil(oil)


def _of_oil(oil: LubricantData) -> Iterator[tuple[str, float]]:
    if (sheet := oil.sheet) is not None:
        thick, thin = (math.log10(1e6 * float(v) + 0.7) for v in (sheet.viscosity_40, sheet.viscosity_100))
        yield "viscosity_40", 1e6 * float(sheet.viscosity_40)
        slope = (math.log10(thick) - math.log10(thin)) / math.log10(T_100 / T_40)
        yield "viscosity_slope", slope
        yield "oil_temperature", float(oil.temperature) - ZERO_CELSIUS
    yield "inlet_viscosity", 1e3 * oil.inlet_viscosity
    yield "pressure_viscosity", 1e9 * oil.pressure_viscosity
    yield "oil_density", oil.density
