"""The report of an assessment: a first page for whoever asks, the details on those behind it."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.gears.rating.rating_text import unit_of
from tribodyn.gears.rating.sheet import COLUMNS, rating_rows
from tribodyn.gears.rating.spectrum import spectrum_tables
from tribodyn.gears.rating.standard import ZERO_CELSIUS
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import as_written
from tribodyn.post.style import inline
from tribodyn.quantities.catalogue import SPREAD, quantities
from tribodyn.quantities.quantity import Quantity
from tribodyn.record.reader import Record
from tribodyn.standards.contact_path import POINTS
from tribodyn.studies.assessment import first_page
from tribodyn.studies.assessment.first_page import (
    listed,
    numbers_table,
    range_over,
)
from tribodyn.studies.assessment.pair import parts
from tribodyn.studies.assessment.pair.case import AssessmentCase
from tribodyn.studies.assessment.pair.figures import pictures
from tribodyn.studies.assessment.pair.limit_table import holds
from tribodyn.studies.assessment.pair.report import verdict
from tribodyn.studies.assessment.pair.run import check
from tribodyn.studies.pages import loaded_again
from tribodyn.studies.protocol import tasks

_RPM = 30.0 / math.pi
#: What is said of a range.
_ENDS = ("p5", "p95")
#: What stands in ``iso`` and ``simulated`` beside each other, in the spread, and in the margins.
_COMPARED = quantities(
    *("theta_M", "mu_m", "h_Y", "lambda_GF", "c_prime", "c_gamma_alpha", "K_v", "K_Halpha", "H_v", "loss"),
    *("sigma_H", "sigma_F", "S_H", "S_F"),
)
_SCATTERED = quantities("K_Hbeta", "transmission_error_peak_to_peak")
_MARGINS = quantities("theta_B", "S_B", "S_intS", "S_lambda")
_HEADS = ("", "ISO 6336", "5 to 95 % of samples", "simulated", "5 to 95 % of samples", "")


def page(record: Record) -> str:
    """Write the page of an assessment's record; parts that lie beside it have their pictures on it."""
    summary = record.summary
    case: AssessmentCase = loaded_again(record).case
    request = parts.request_of(case)
    taking_part = parts.parts(request)
    behind = tasks.folder_of(Path(record.path))
    done = tasks.kept(parts.tasks_of(taking_part), behind)
    answers = parts.answers(taking_part, done) if done is not None else ()
    curves = [curve for answer in answers for curve in answer.curves]
    picture = inline(pictures(record, curves), "error, vibration, film, losses")
    front = first_page.Front(
        verdict(record), holds(summary), _asked(case), _tiles(summary), _scatter(summary)
    )
    body = [
        _by_standard(summary),
        _reasons(summary),
        f'<div class="pictures"><p>{picture}</p></div>',
        _points(summary),
        _factors(summary),
        first_page.folded_sums(spectrum_tables(summary.get("spectrum", {}))),
        first_page.bearings_table(summary),
        *(
            first_page.part_section(part.study, part.role.title, [done[task.name] for task in part.tasks])
            for part in taking_part
            if done
        ),
    ]
    return first_page.written(record, "Assessment", front, body, check(case).tables)


def _factors(summary: Mapping[str, Any]) -> str:
    """Every factor of the standards, folded."""
    rows = rating_rows(summary.get("iso", {}))
    if not rows:
        return ""
    inside = numbers_table("Factors of ISO 6336", COLUMNS, rows)
    page = f'<details class="factors"><summary>Every factor of ISO 6336</summary>{inside}</details>'
    if american := rating_rows(summary.get("agma", {})):
        page += numbers_table("Rating by AGMA 2101", COLUMNS, american)
    return page


def _asked(case: AssessmentCase) -> str:
    drive = as_written(family(case.family), case.drive)
    centre = f", a {drive.centre_distance * 1e3:.6g} mm" if drive.centre_distance is not None else ""
    helix = f"β {math.degrees(drive.helix_angle):.6g}°, " if drive.helix_angle else ""
    ratio, quality = float(drive.gear.teeth / drive.pinion.teeth), case.quality
    assert quality is not None, "refused by the rules"
    gears = (
        f"{case.family} {drive.pinion.teeth:.0f}/{drive.gear.teeth:.0f}, module {drive.module * 1e3:.4g} mm, "
        f"{helix}x {drive.pinion.profile_shift:g}/{drive.gear.profile_shift:g}{centre}, "
        f"b {drive.pinion.face_width * 1e3:.4g}/{drive.gear.face_width * 1e3:.4g} mm, "
        f"grade {quality.grade:g}, Ra {case.mean_roughness * 1e6:.3g} µm"
    )
    speed, torque = case.operating.pinion_speed, case.operating.gear_torque / ratio
    duty = (
        f"{speed * torque * 1e-3:.4g} kW at {speed * _RPM:.5g} rpm of the pinion, "
        f"{torque:.4g} N m on the pinion, {case.operating.gear_torque:.4g} N m on the gear"
    )
    oil = first_page.oil_line(case.lubricant, case.oil_temperature, case.settings.lubrication)
    materials = " / ".join(dict.fromkeys(material.name for material in case.materials))
    return first_page.asked({"Gears": gears, "Material": materials, "Oil": oil, "Duty": duty})


def _tiles(summary: Mapping[str, Any]) -> str:
    simulated, margins = summary["simulated"], summary["margins"]["simulated"]
    lost = summary.get("contact_loss_speed_from")
    spread = [f"{100.0 * summary[f'efficiency_{end}']:.2f}" for end in ("lowest", "highest")]
    highest = f"{summary['dynamic_factor_max']:.2f} at {summary['dynamic_factor_max_speed'] * _RPM:.0f} rpm"
    root = max(summary[f"{side}_root_tension_max"] for side in ("pinion", "gear"))
    error = summary["loaded_transmission_error_peak_to_peak"]
    samples, counts = summary.get("by_sample", {}), summary.get("sample_counts", {})
    roots = [samples[name] for name in ("pinion_root_tension_max", "gear_root_tension_max") if samples]

    def over(name: str, digits: str, factor: float = 1.0, offset: float = 0.0) -> str:
        return range_over(samples.get(name), digits, factor, offset)

    shown = (
        (
            f"{100.0 * summary['efficiency']:.2f} %",
            f"efficiency; {spread[0]} to {spread[1]} % by other laws",
            over("efficiency", ".2f", 100.0),
        ),
        (
            f"{simulated['K_v']:.2f}",
            f"dynamic factor at the duty; up to {highest}",
            over("dynamic_factor", ".2f"),
        ),
        (
            f"{simulated['lambda_GF']['worst']:.2f}",
            "minimum specific film λ_GF",
            over("specific_film_min", ".2f"),
        ),
        (
            f"{margins['theta_B']:.0f} °C",
            f"contact temperature; bulk {simulated['theta_M']['worst']:.0f} °C",
            over("contact_temperature_max", ".0f", 1.0, -ZERO_CELSIUS),
        ),
        (
            f"{summary['hertz_pressure_max'] * 1e-9:.2f} GPa",
            "maximum Hertz pressure, slow rotation without K_A",
            over("hertz_pressure_max", ".2f", 1e-9),
        ),
        (
            f"{root * 1e-6:.0f} MPa",
            "maximum root tension, slow rotation without K_A",
            range_over(np.max(roots, axis=0), ".0f", 1e-6) if roots else "",
        ),
        (
            f"{error * 1e6:.2f} µm",
            "loaded transmission error, peak to peak",
            over("loaded_transmission_error_peak_to_peak", ".2f", 1e6),
        ),
        (
            "none" if lost is None else f"{lost * _RPM:.0f} rpm",
            "loss of contact over the speeds" if lost is None else "contact is lost from this pinion speed",
            f"{counts['contact_lost']} of {counts['samples']} samples lose it" if counts else "",
        ),
    )
    return first_page.tiles(shown)


def _by_standard(summary: Mapping[str, Any]) -> str:
    """Both parts beside each other, with ranges where there are samples."""
    both = summary.get("iso", {}), summary["simulated"]
    margins = [summary["margins"].get(part, {}) for part in ("iso", "simulated")]
    rows = []
    for quantity in (*_COMPARED, *_MARGINS):
        values = [part.get(quantity.name) for part in (margins if quantity in _MARGINS else both)]
        if quantity in _MARGINS and values == [None, None]:
            continue
        ranges = [_between(part.get("spread", {}).get(quantity.name), quantity) for part in both]
        cells = [_shown(value, quantity) for value in values]
        rows.append(
            (
                quantity.title,
                *(text for pair in zip(cells, ranges, strict=True) for text in pair),
                unit_of(quantity),
            )
        )
    heads, application = _HEADS, float(summary["load_factors"]["K_A"])
    if not any(part.get("spread") for part in both):
        rows, heads = [row[:2] + row[3:4] + row[5:] for row in rows], heads[:2] + heads[3:4] + heads[5:]
    kind = " ranges" if len(heads) == len(_HEADS) else ""
    return numbers_table(f"Standard and simulation, both with K_A {application:g}", heads, rows, kind)


def _between(percentiles: Mapping[str, float] | None, quantity: Quantity) -> str:
    """A range; nothing of what does not scatter."""
    if percentiles is None:
        return ""
    ends = [quantity.written(float(percentiles[end])) for end in _ENDS]
    return " to ".join(ends) if ends[0] != ends[1] else ""


def _reasons(summary: Mapping[str, Any]) -> str:
    """Why both part, where they do."""
    reasons = summary.get("reasons", {})
    return listed("Where standard and simulation part by more than 5 %", reasons) if reasons else ""


def _scatter(summary: Mapping[str, Any]) -> str:
    """Quantities over the samples that stand nowhere else, where there are any."""
    spread = summary["simulated"].get("spread", {})
    rows = [
        (quantity.title, *(_shown(spread[quantity.name][part], quantity) for part in SPREAD), quantity.unit)
        for quantity in _SCATTERED
        if quantity.name in spread
    ]
    if not rows:
        return ""
    samples = min(int(percentiles["samples"]) for percentiles in spread.values())
    heading = f"Scatter over {samples} samples of what is not known"
    return numbers_table(heading, ("", "median", "5 %", "95 %", ""), rows, " scatter")


def _shown(value: Any, quantity: Quantity) -> str:
    if isinstance(value, Mapping):
        if "worst" not in value:  # of pinion and gear
            return " / ".join(_shown(value[side], quantity) for side in SIDES)
        value = value["worst"]
    return "–" if value is None else quantity.written(float(value))


def _points(summary: Mapping[str, Any]) -> str:
    names = (*POINTS, "worst")
    rows = []
    for quantity in quantities("lambda_GF", "h_Y", "theta_B"):
        for by, part in (("ISO", "iso"), ("simulated", "simulated")):
            if values := summary.get(part, {}).get(quantity.name):
                label = f"{quantity._replace(unit=unit_of(quantity)).titled}, {by}"
                rows.append((label, *(_shown(values.get(name), quantity) for name in names)))
    return numbers_table("Along the path of contact", ("", *names), rows, " points")
