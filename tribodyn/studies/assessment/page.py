"""The report of an assessment: a first page for whoever asked, the details on those behind it."""

import math
from collections.abc import Mapping, Sequence
from html import escape
from importlib import resources
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tribodyn.errors import InputError
from tribodyn.numerics.output_files import write_output
from tribodyn.numerics.scatter import SPREAD
from tribodyn.post.page.page import table, warnings_of
from tribodyn.post.style import inline
from tribodyn.record.reader import Record, open_record
from tribodyn.standards.contact_path import POINTS
from tribodyn.studies.assessment import parts
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.judged import LIMITS
from tribodyn.studies.assessment.pictures import pictures
from tribodyn.studies.assessment.run import check
from tribodyn.studies.protocol.load import load
from tribodyn.studies.protocol.part import Curve
from tribodyn.studies.protocol.study import Study

_RPM = 30.0 / math.pi
#: Name in ``iso`` and ``simulated`` -> what it is called, factor and format of what is shown, unit.
_COMPARED = {
    "theta_M": ("Bulk temperature θ_M", 1.0, ".1f", "°C"),
    "mu_m": ("Mean friction μ_m", 1.0, ".4f", ""),
    "h_Y": ("Minimum film h_Y", 1e6, ".3f", "µm"),
    "lambda_GF": ("Specific film λ_GF", 1.0, ".3f", ""),
    "c_prime": ("Stiffness of one pair c′", 1e-9, ".2f", "N/(mm µm)"),
    "c_gamma_alpha": ("Mesh stiffness c_γα", 1e-9, ".2f", "N/(mm µm)"),
    "K_v": ("Dynamic factor K_v", 1.0, ".3f", ""),
    "K_Halpha": ("Transverse load factor K_Hα", 1.0, ".3f", ""),
    "H_v": ("Loss factor H_v", 1.0, ".4f", ""),
    "loss": ("Loss to tooth friction", 1.0, ".1f", "W"),
}
#: Name in the spread -> the same.
_SCATTERED = {
    "K_v": ("Dynamic factor K_v", 1.0, ".2f", ""),
    "K_Halpha": ("Transverse load factor K_Hα", 1.0, ".2f", ""),
    "K_Hbeta": ("Face load factor K_Hβ", 1.0, ".2f", ""),
    "loaded_transmission_error_peak_to_peak": ("Loaded error, peak to peak", 1e6, ".2f", "µm"),
    "transmission_error_peak_to_peak": ("The same in motion", 1e6, ".2f", "µm"),
}
_MARGINS = {
    "theta_B": ("Contact temperature θ_B", ".1f", "°C"),
    "S_B": ("Scuffing S_B, flash temp.", ".2f", ""),
    "S_intS": ("Scuffing S_intS, integral temp.", ".2f", ""),
    "S_lambda": ("Micropitting S_λ", ".2f", ""),
}


def page(record: Record) -> str:
    """Write the page of an assessment's record; parts that lie beside it have their pictures on it."""
    summary = record.summary
    with TemporaryDirectory(prefix="tribodyn-") as folder:
        scenario = Path(folder) / "scenario.toml"
        write_output(scenario, str(record.attrs["scenario"]))
        try:
            case: AssessmentCase = load(scenario).case
        except InputError as error:  # the file that it names is gone with this block
            raise error.moved(lambda _: str(record.path)) from None
    asked = parts.asked_of(case)
    taking_part = parts.parts(asked)
    behind = parts.folder_of(Path(record.path))
    done = parts.kept(taking_part, behind)
    curves: list[Curve] = []
    if done is not None:
        for _, answer in parts.answers(taking_part, asked, done):
            curves += answer.curves
    title = str(record.scenario.get("title", record.label))
    picture = inline(pictures(record, curves), "error, vibration, film, losses")
    body = [
        _header(record, title),
        _verdict(record, summary),
        _asked(case),
        _tiles(summary),
        '<div class="columns">',
        f"<div>{_limits(summary)}{_scatter(summary)}{_list('Assumed', summary.get('assumed', {}))}</div>",
        f"<div>{_by_standard(summary)}{_list('Extrapolated', summary.get('extrapolated', {}))}</div>",
        "</div>",
        f'<div class="pictures"><p>{picture}</p></div>',
        '<div class="break"></div>',
        _points(summary),
        *(
            _part(part.study, part.role.title, [done[task.name] for task in part.tasks])
            for part in taking_part
            if done
        ),
        "<section><h2>Gears and oil</h2>" + "".join(table(*one) for one in check(case).tables) + "</section>",
        _origin(record),
    ]
    pieces = {"TITLE": escape(title), "STYLE": _file("page.css"), "BODY": "\n".join(body)}
    written = _file("page.html").split("@")
    return "".join(pieces.get(piece, piece) for piece in written)


def _file(name: str) -> str:
    return resources.files(__package__ or "").joinpath(name).read_text(encoding="utf-8")


def _header(record: Record, title: str) -> str:
    created = str(record.attrs["created"]).partition("T")[0]
    version = record.attrs["tribodyn_version"]
    made = f"Assessment, {escape(created)}, tribodyn {escape(version)}"
    return f"<header><h1>{escape(title)}</h1><p>{made}</p></header>"


def _verdict(record: Record, summary: Mapping[str, Any]) -> str:
    limits = summary.get("limits", {})
    missed = [LIMITS[name].label for name, one in limits.items() if not one["kept"]]
    if missed:
        said = f'<p class="verdict bad">Limits exceeded: {escape("; ".join(missed))}.</p>'
    else:
        said = f'<p class="verdict good">All {len(limits)} limits hold.</p>' if limits else ""
    within = [
        f"{LIMITS[name].label} ({one['p95'] * LIMITS[name].factor:.3g} at 95 %)"
        for name, one in limits.items()
        if one["kept"] and not one.get("kept_p95", True)
    ]
    if within:
        held = "" if missed else f"All {len(limits)} limits hold with accurate teeth. "
        text = f"{held}Exceeded within the scatter of the deviations: {'; '.join(within)}."
        said = (said if missed else "") + f'<p class="verdict bad">{escape(text)}</p>'
    return said + warnings_of(record, named=False).replace('class="warning"', 'class="verdict bad"')


def _asked(case: AssessmentCase) -> str:
    drive, sheet = case.drive, case.lubricant.sheet
    centre = f", a {drive.centre_distance * 1e3:.6g} mm" if drive.centre_distance is not None else ""
    ratio = float(drive.gear.teeth / drive.pinion.teeth)
    gears = (
        f"{case.family} {drive.pinion.teeth:.0f}/{drive.gear.teeth:.0f}, module {drive.module * 1e3:.4g} mm, "
        f"x {drive.pinion.profile_shift:g}/{drive.gear.profile_shift:g}{centre}, "
        f"b {drive.pinion.face_width * 1e3:.4g}/{drive.gear.face_width * 1e3:.4g} mm, "
        f"grade {case.quality.grade:g}, Ra {case.mean_roughness * 1e6:.3g} µm"
    )
    speed, torque = case.operating.pinion_speed, case.operating.gear_torque / ratio
    duty = (
        f"{speed * torque * 1e-3:.4g} kW at {speed * _RPM:.5g} rpm of the pinion, "
        f"{torque:.4g} N m on the pinion, {case.operating.gear_torque:.4g} N m on the gear"
    )
    oil = f"at {case.oil_temperature - 273.15:.4g} °C, {case.settings.lubrication}"
    if sheet is not None:
        oil = f"{sheet.type}, {sheet.viscosity_40 * 1e6:.4g}/{sheet.viscosity_100 * 1e6:.4g} mm²/s, {oil}"
    materials = " / ".join(dict.fromkeys(one.name for one in case.materials))
    rows = (("Gears", gears), ("Material", materials), ("Oil", oil), ("Duty", duty))
    cells = (f"<tr><td><b>{name}</b></td><td>{escape(text)}</td></tr>" for name, text in rows)
    return f'<table class="asked">{"".join(cells)}</table>'


def _tiles(summary: Mapping[str, Any]) -> str:
    own, margins = summary["simulated"], summary["margins"]["simulated"]
    lost = summary.get("contact_loss_speed_from")
    spread = [f"{100.0 * summary[f'efficiency_{end}']:.2f}" for end in ("lowest", "highest")]
    highest = f"{summary['dynamic_factor_max']:.2f} at {summary['dynamic_factor_max_speed'] * _RPM:.0f} rpm"
    root = max(summary[f"{side}_root_tension_max"] for side in ("pinion", "gear"))
    error = summary["loaded_transmission_error_peak_to_peak"]
    shown = (
        (f"{100.0 * summary['efficiency']:.2f} %", f"efficiency; {spread[0]} to {spread[1]} % by other laws"),
        (f"{own['K_v']:.2f}", f"dynamic factor at the duty; up to {highest}"),
        (f"{own['lambda_GF']['worst']:.2f}", "minimum specific film λ_GF"),
        (f"{margins['theta_B']:.0f} °C", f"contact temperature; bulk {own['theta_M']['worst']:.0f} °C"),
        (f"{summary['hertz_pressure_max'] * 1e-9:.2f} GPa", "maximum Hertz pressure, slow rotation"),
        (f"{root * 1e-6:.0f} MPa", "maximum root tension"),
        (f"{error * 1e6:.2f} µm", "loaded transmission error, peak to peak"),
        ("none", "loss of contact over the speeds")
        if lost is None
        else (f"{lost * _RPM:.0f} rpm", "contact is lost from this pinion speed"),
    )
    tiles = (
        f'<div class="tile"><b>{escape(one)}</b><span>{escape(text)}</span></div>' for one, text in shown
    )
    return f'<div class="tiles">{"".join(tiles)}</div>'


def _limits(summary: Mapping[str, Any]) -> str:
    rows = []
    for name, one in summary.get("limits", {}).items():
        limit = LIMITS[name]
        value, bound = one["value"] * limit.factor, one["limit"] * limit.factor
        sign, mark = "≥" if limit.least else "≤", "" if one["kept"] else ' class="bad"'
        verdict = "holds" if one["kept"] else "exceeded"
        rows.append(
            f"<tr{mark}><td>{escape(limit.label)}</td><td>{value:.3g}</td><td>{sign} {bound:.3g}</td>"
            f"<td>{escape(limit.unit)}</td><td>{verdict}</td></tr>"
        )
    head = "<tr><th>Limit</th><th>value</th><th>required</th><th></th><th></th></tr>"
    return f'<section><h2>Limits</h2><table class="numbers">{head}{"".join(rows)}</table></section>'


def _by_standard(summary: Mapping[str, Any]) -> str:
    iso, own, rows = summary.get("iso", {}), summary["simulated"], []
    for name, (label, factor, form, unit) in _COMPARED.items():
        rows.append((label, _shown(iso.get(name), factor, form), _shown(own.get(name), factor, form), unit))
    margins = summary["margins"]
    for name, (label, form, unit) in _MARGINS.items():
        values = [_shown(margins.get(part, {}).get(name), 1.0, form) for part in ("iso", "simulated")]
        if any(one != "–" for one in values):
            rows.append((label, *values, unit))
    cells = "".join(
        f"<tr><td>{escape(label)}</td><td>{first}</td><td>{second}</td><td>{escape(unit)}</td></tr>"
        for label, first, second, unit in rows
    )
    head = "<tr><th></th><th>ISO 6336</th><th>simulated</th><th></th></tr>"
    return f'<section><h2>Standard and simulation</h2><table class="numbers">{head}{cells}</table></section>'


def _scatter(summary: Mapping[str, Any]) -> str:
    """Figures over the samples of deviations, where there are any."""
    spread = summary["simulated"].get("spread", {})
    rows = [
        f"<tr><td>{label}</td>"
        + "".join(f"<td>{_shown(spread[name][part], factor, form)}</td>" for part in SPREAD)
        + f"<td>{unit}</td></tr>"
        for name, (label, factor, form, unit) in _SCATTERED.items()
        if name in spread
    ]
    if not rows:
        return ""
    known = min(int(one["samples"]) for one in spread.values())
    head = "<tr><th></th>" + "".join(f"<th>{one}</th>" for one in ("median", "5 %", "95 %", "")) + "</tr>"
    return (
        f"<section><h2>Scatter over {known} samples of deviations</h2>"
        f'<table class="numbers scatter">{head}{"".join(rows)}</table></section>'
    )


def _shown(value: Any, factor: float, form: str) -> str:
    if isinstance(value, Mapping):
        value = value["worst"]
    if value is None or not math.isfinite(float(value)):
        return "–"
    return format(float(value) * factor, form)


def _points(summary: Mapping[str, Any]) -> str:
    iso, own = summary.get("iso", {}), summary["simulated"]
    rows = [
        ("λ_GF, ISO", iso.get("lambda_GF"), 1.0, ".3f"),
        ("λ_GF, simulated", own["lambda_GF"], 1.0, ".3f"),
        ("h_Y, ISO (µm)", iso.get("h_Y"), 1e6, ".3f"),
        ("h_Y, simulated (µm)", own["h_Y"], 1e6, ".3f"),
        ("Contact temperature, simulated (°C)", own["theta_B"], 1.0, ".1f"),
    ]
    head = "".join(f"<th>{name}</th>" for name in ("", *POINTS, "worst"))
    cells = "".join(
        f"<tr><td>{escape(label)}</td>"
        + "".join(f"<td>{_shown(values.get(name), factor, form)}</td>" for name in (*POINTS, "worst"))
        + "</tr>"
        for label, values, factor, form in rows
        if values
    )
    return (
        '<section><h2>Along the path of contact</h2><table class="numbers points">'
        f"<tr>{head}</tr>{cells}</table></section>"
    )


def _list(heading: str, said: Mapping[str, str]) -> str:
    items = "".join(f"<li>{escape(str(one))}</li>" for one in said.values()) or "<li>Nothing.</li>"
    return f'<section class="small"><h2>{heading}</h2><ul>{items}</ul></section>'


def _part(study: Study, title: str, done: Sequence[parts.Done]) -> str:
    """Picture and summary of the first record of a part; of rows their extremes stand on the first page."""
    from tribodyn.post.page.page import summary_tables
    from tribodyn.studies.pages.pictures import overview

    for one in done:
        if not one.summary:
            continue
        with open_record(one.path) as record:
            picture = f"<p>{inline(overview(record), title)}</p>"
            tables = summary_tables([record], [study.reported()])
        return f"<section><h2>{escape(title)}</h2>{picture}{tables}</section>"
    return ""


def _origin(record: Record) -> str:
    scenario = escape(str(record.attrs["scenario"]))
    digest = escape(str(record.attrs["scenario_sha256"]))
    return (
        f'<section class="break"><h2>Scenario and origin</h2><p class="quiet">scenario sha256 {digest}</p>'
        f"<pre>{scenario}</pre></section>"
    )
