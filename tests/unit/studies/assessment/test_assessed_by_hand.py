"""Limits, parts and pages of an assessment from numbers that can be followed by hand."""

import json
import math
import re
from html import unescape
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.record.sweep_schema import DONE, FAILED
from tribodyn.studies.assessment import local, page, parts, said
from tribodyn.studies.assessment import run as assessing
from tribodyn.studies.assessment.judged import judged
from tribodyn.studies.assessment.local import bulk_of, local_of, point_angles
from tribodyn.studies.efficiency import assess as of_losses
from tribodyn.studies.gear_pair import assess as of_motions
from tribodyn.studies.protocol.part import Asked, Done, Task

ZERO = 273.15


def asked_with(**changed: Any) -> Asked:
    tables: dict[str, Any] = {"drive": "drive", "lubricant": "oil", "bearings": "stiff"}
    tables |= {"oil_temperature": "80 degC", "damping_ratio": 0.07}
    speeds = (20.0, 60.0, 100.0, 140.0, 180.0, 220.0)
    asked = Asked("pair", tables, 100.0, 96.0, (48.0, 96.0), speeds, ("xu", "niemann"), 2e-6, 3)
    return asked._replace(**changed)


def test_losses_by_every_law_beside_the_first():
    done = {
        "efficiency-xu": Done(
            Path(), {"power_friction_mean": 60.0, "power_in_mean": 4000.0, "film_min": 2e-7}
        ),
        "efficiency-niemann": Done(Path(), {"power_friction_mean": 90.0, "power_in_mean": 5000.0}),
        "efficiency-lost": Done(Path(), failures=("lost",)),
    }
    asked = asked_with(laws=("xu", "niemann", "lost"))
    figures = of_losses.answer(asked, done).figures
    assert figures["loss_by_law"] == {"xu": 60.0, "niemann": 90.0}
    assert (figures["loss_lowest"], figures["loss_highest"]) == (60.0, 90.0)
    # both over what the first law's duty puts in
    assert figures["efficiency_lowest"] == pytest.approx(1.0 - 90.0 / 4000.0)
    assert figures["efficiency_highest"] == pytest.approx(1.0 - 60.0 / 4000.0)
    assert (figures["film_min"], "bulk_temperature" in figures) == (2e-7, False)


def test_motions_over_the_speed():
    """At the duty, at the highest, at the maxima, and where contact is lost."""
    factor = np.array([1.1, 1.4, 1.2, 1.6, np.nan, 1.3])
    lost = np.array([0.0, 2e-6, 5e-7, 0.25, np.nan, 0.125])
    rows = {
        "dynamic_factor": factor,
        "contact_loss_fraction": lost,
        "transmission_error_peak_to_peak": np.arange(6.0),
    }
    asked = asked_with()
    first, samples = of_motions.tasks(asked)
    answer = of_motions.answer(
        asked, {first.name: Done(Path(), rows=rows), samples.name: Done(Path(), rows=rows)}
    )
    figures = answer.figures
    assert (figures["dynamic_factor"], figures["contact_loss_fraction"]) == (1.2, 5e-7)
    assert figures["transmission_error_peak_to_peak"] == 2.0
    assert (figures["dynamic_factor_max"], figures["dynamic_factor_max_speed"]) == (1.6, 140.0)
    assert (figures["contact_loss_from"], figures["contact_loss_to"]) == (60.0, 220.0)
    assert figures["contact_loss_fraction_max"] == 0.25
    assert figures["speeds_without_result"] == 1
    (curve,) = answer.curves
    np.testing.assert_allclose(curve.x, np.array(asked.speeds) * 30.0 / math.pi)
    assert curve.mark == pytest.approx(100.0 * 30.0 / math.pi)
    assert answer.spread["dynamic_factor"] is factor
    alone = of_motions.answer(
        asked, {first.name: Done(Path(), rows={**rows, "contact_loss_fraction": lost * 0.0})}
    )
    assert alone.spread == {}
    assert "contact_loss_from" not in alone.figures
    assert first.scenario["mesh"] == {"compliance": "fem", "damping_ratio": 0.07}
    assert first.scenario["friction"] == {"law": "xu"}
    assert first.values == [f"{speed!r} rad/s" for speed in asked.speeds]
    assert samples.scenario["mesh"]["slices"] > 1
    assert (samples.values, samples.needed) == (["1", "2", "3"], False)
    assert len(of_motions.tasks(asked_with(samples=0))) == 1
    assert of_motions.maxima(np.array([1.0, 1.5, 1.2, 1.8, 1.1, 1.3, 1.29, 1.4])) == [3, 1, 5][:2]


def test_points_are_a_pitch_from_the_ends():
    assembly: Any = SimpleNamespace(roll_limits=(-0.21, 0.27), pitch_angle=0.3)
    expected = [-0.21, (-0.21 - 0.03) / 2.0, -0.03, 0.0, 0.09, (0.09 + 0.27) / 2.0, 0.27]
    np.testing.assert_allclose(point_angles(assembly), expected, rtol=1e-12)


@pytest.mark.parametrize("given", [None, 371.5])
def test_bulk_temperature_by_loss_or_by_the_simulation(given: float | None):
    """θ_oil + 7400 (P_vz/(a b))^0.72 X_S/1.2 with kW and mm, as ISO/TR 15144-1 has it."""
    path = SimpleNamespace(pinion_pitch_radius=0.03, gear_pitch_radius=0.07)
    assembly: Any = SimpleNamespace(path=path, common_width=0.02)
    case: Any = SimpleNamespace(settings=SimpleNamespace(lubrication="spray"), oil_temperature=350.0)
    expected = 350.0 + 7400.0 * (0.06 / (100.0 * 20.0)) ** 0.72 * 1.2 / 1.2
    found = bulk_of(case, assembly, {"power_friction_mean": 60.0, "bulk_temperature": given})
    assert found == pytest.approx(given or expected, rel=1e-9)


def test_the_simulation_along_the_path(monkeypatch: pytest.MonkeyPatch):
    """Pressure with the root of K_A K_v; no Hertz contact where its half width is a tenth of the radius."""
    taken: list[Any] = []
    path = SimpleNamespace(
        signed_distance=lambda roll: roll * 0.03, pinion_pitch_radius=0.03, gear_pitch_radius=0.07
    )
    assembly: Any = SimpleNamespace(path=path, roll_limits=(-0.2, 0.25), pitch_angle=0.3, common_width=0.02)

    def motion(_: Any, distance: np.ndarray) -> Any:
        return SimpleNamespace(
            pinion_speed=0.01 + distance,
            gear_speed=0.009 - 0.5 * distance,
            relative_curvature=200.0 + 1e4 * distance,
        )

    def films(*given: Any) -> str:
        taken.append(given)
        return "films"

    monkeypatch.setattr(local, "kinematics", motion)
    monkeypatch.setattr(local.micropitting, "at_places", films)
    monkeypatch.setattr(local, "flanks_of", lambda _: SimpleNamespace(reduced_modulus=2.2e11))
    monkeypatch.setattr(local, "oil_of", lambda _: "oil")
    case: Any = SimpleNamespace(settings=SimpleNamespace(application_factor=1.5), pinion_speed=100.0)
    roll = np.linspace(-0.3, 0.3, 13)
    load = np.where(np.abs(roll) < 0.18, 4000.0, 0.0)
    load[np.abs(roll - 0.05) < 1e-9] = 9e8
    along = {"roll_angle": roll, "normal_load": load, "hertz_pressure": 1e5 * np.sqrt(load)}
    for factor in (1.4, 0.9):
        figures = {"dynamic_factor": factor, "friction_coefficient_mean": 0.05, "bulk_temperature": 370.0}
        found = local_of(case, assembly, along, figures)
        places = sorted({*point_angles(assembly), *(float(one) for one in roll if -0.2 <= one <= 0.25)})
        np.testing.assert_allclose(found.roll_angle, places, atol=1e-15)
        pressure, radius, speeds, friction, bulk, _, oil = taken.pop()
        assert (friction, bulk, oil, found.films) == (0.05, 370.0, "oil", "films")
        for k, place in enumerate(places):
            distance = place * 0.03
            curvature = 200.0 + 1e4 * distance
            carried = float(np.interp(place, roll, load))
            half = math.sqrt(8.0 * carried / 0.02 / curvature / (math.pi * 2.2e11))
            pressed = float(np.interp(place, roll, along["hertz_pressure"]))
            hertzian = pressed > 0.0 and half * curvature < 0.1
            wanted = pressed * math.sqrt(1.5 * max(factor, 1.0)) if hertzian else math.nan
            assert pressure[k] == pytest.approx(wanted, nan_ok=True)
            assert radius[k] == found.radius[k] == pytest.approx(1.0 / curvature)
            v1, v2 = 100.0 * (0.01 + distance), 100.0 * (0.009 - 0.5 * distance)
            assert (speeds[0][k], speeds[1][k]) == pytest.approx((v1, v2))
            assert found.sliding[k] == pytest.approx(abs(v1 - v2))
        assert np.any(np.isnan(pressure))
        assert np.any(np.isfinite(pressure))
    at = found.at_points(found.roll_angle * 2.0 + 1.0)
    np.testing.assert_allclose(at, 2.0 * point_angles(assembly) + 1.0, atol=1e-14)


def standard_with(**changed: Any) -> Any:
    dynamic = SimpleNamespace(factor=1.15, resonance_ratio=0.4, resonance_speed=900.0, range="subcritical")
    given = {
        "dynamic": dynamic,
        "transverse": 1.25,
        "mesh_stiffness_face": 1.7e10,
        "flash_bulk": 373.15,
        "flash_contact": 423.15,
        "integral": 393.15,
        "films": SimpleNamespace(specific_film=np.array([0.9, 0.6, 1.2])),
    }
    return SimpleNamespace(**given | changed)


FIGURES = {
    "dynamic_factor": 1.4,
    "pinion_root_tension_max": 300e6,
    "gear_root_tension_max": 350e6,
    "loaded_transmission_error_peak_to_peak": 4e-6,
    "face_load_factor": 1.3,
}


def verdict_of(
    limits: dict[str, Any], spread: Any = None, found: Any = None, **strength: Any
) -> dict[str, Any]:
    case: Any = SimpleNamespace(
        limits=limits, oil_temperature=353.15, settings=SimpleNamespace(application_factor=1.2)
    )
    films = SimpleNamespace(
        bulk_temperature=370.0,
        flash_rise=np.array([20.0, np.nan, 75.0]),
        specific_film=np.array([0.8, 0.5, np.nan]),
        pressure=np.array([9e8, np.nan, 1.2e9]),
    )
    known = {"scuffing": 573.15, "scuffing_integral": 633.15, "specific_film": 0.4} | strength
    local: Any = SimpleNamespace(films=films)
    return judged(case, found, SimpleNamespace(**known), local, FIGURES, spread or {})  # pyright: ignore[reportArgumentType]


def test_limits_hold_from_the_side_that_they_are_on():
    """Safeties at least, the others at most; the worse of standard and simulation counts."""
    equal = {
        "scuffing_flash": min(220.0 / 70.0, (573.15 - 353.15) / (445.0 - 353.15)),
        "scuffing_integral": 360.0 / 120.0,
        "micropitting": min(0.6 / 0.4, 0.5 / 0.4),
        "dynamic_factor": 1.4,
        "hertz_pressure": 1.2e9,
        "root_tension": 350e6,
        "loaded_error": 4e-6,
    }
    least = ("scuffing_flash", "scuffing_integral", "micropitting")
    for share in (0.999, 1.0, 1.001):
        found = verdict_of({name: value * share for name, value in equal.items()}, found=standard_with())
        for name, value in equal.items():
            one = found["limits"][name]
            assert one["value"] == pytest.approx(value, rel=1e-12)
            if share != 1.0:
                assert one["kept"] == ((share < 1.0) == (name in least)), name
    for name in ("dynamic_factor", "hertz_pressure", "root_tension", "loaded_error"):
        assert verdict_of({name: equal[name]})["limits"][name]["kept"]
    margins = found["margins"]
    assert margins["simulated"]["theta_B"] == pytest.approx(445.0 - ZERO)
    assert margins["simulated"]["S_lambda"] == pytest.approx(1.25)
    factors = found["load_factors"]
    assert (factors["K_A"], factors["K_Hbeta"], factors["K_v"], factors["K_Halpha"]) == (1.2, 1.3, 1.15, 1.25)
    assert (factors["N"], factors["resonance_speed"], factors["c_gamma_beta"]) == (0.4, 900.0, 1.7e10)


def test_what_is_not_known_is_not_judged():
    limits = {"scuffing_flash": 1.5, "scuffing_integral": 1.5, "micropitting": 1.0, "dynamic_factor": None}
    found = verdict_of(limits, scuffing=None, scuffing_integral=None, specific_film=None)
    assert found["limits"] == {}
    assert {part: set(of) for part, of in found["margins"].items()} == {"simulated": {"theta_B"}}
    assert set(found["load_factors"]) == {"K_A", "K_Hbeta"}
    only = verdict_of({"scuffing_flash": 1.5}, scuffing_integral=None)["limits"]["scuffing_flash"]
    assert only["value"] == pytest.approx(220.0 / 91.85)


def test_the_scatter_is_judged_by_its_95_percent():
    spread = {"dynamic_factor": {"p95": 1.45}, "loaded_transmission_error_peak_to_peak": {"p95": math.nan}}
    found = verdict_of({"dynamic_factor": 1.42, "loaded_error": 5e-6}, spread)["limits"]
    assert found["dynamic_factor"] | {"value": 0} == {
        "value": 0, "limit": 1.42, "kept": True, "p95": 1.45, "kept_p95": False
    }  # fmt: skip
    assert "p95" not in found["loaded_error"]
    assert verdict_of({"dynamic_factor": 1.45}, spread)["limits"]["dynamic_factor"]["kept_p95"]


def rows_of(html: str) -> dict[str, list[str]]:
    """Cells of a table by the first of its row."""
    rows = {}
    for row in re.findall(r"<tr[^>]*>(.*?)</tr>", html):
        cells = [unescape(re.sub(r"<[^>]*>", "", cell)) for cell in re.findall(r"<td>(.*?)</td>", row)]
        if cells:
            rows[cells[0]] = cells[1:]
    return rows


def summary_with() -> dict[str, Any]:
    points = dict.fromkeys(("A", "AB", "B", "C", "D", "DE", "E"), 0.0)

    def at(worst: float) -> dict[str, float]:
        return points | {"A": worst * 2.0, "worst": worst}

    def side(scale: float) -> dict[str, Any]:
        return {
            "theta_M": at(90.25 * scale),
            "theta_B": at(120.5 * scale),
            "mu_m": at(0.0512 * scale),
            "h_Y": at(1.234e-7 * scale),
            "lambda_GF": at(0.345 * scale),
            "c_prime": 1.3e10 * scale,
            "c_gamma_alpha": 1.9e10 * scale,
            "K_v": 1.125 * scale,
            "K_Halpha": 1.25 * scale,
            "K_Hbeta": 1.5 * scale,
            "H_v": 0.1535 * scale,
            "loss": 61.25 * scale,
        }

    scatter = {"median": 1.5, "p5": 1.25, "p95": 1.75, "samples": 12}
    small = {name: one * 1e-6 if name != "samples" else one for name, one in scatter.items()}
    own = side(2.0) | {
        "spread": {"K_v": scatter, "loaded_transmission_error_peak_to_peak": small | {"samples": 9}}
    }
    return {
        "iso": side(1.0),
        "simulated": own,
        "margins": {
            "iso": {"theta_B": 150.0, "S_B": 2.5, "S_intS": 3.25},
            "simulated": {"theta_B": 171.875, "S_B": 2.125, "S_lambda": math.nan},
        },
        "limits": {
            "dynamic_factor": {"value": 1.4, "limit": 1.5, "kept": True},
            "hertz_pressure": {"value": 1.7e9, "limit": 1.5e9, "kept": False},
            "root_tension": {"value": 3e8, "limit": 5e8, "kept": True},
            "loaded_error": {"value": 4e-6, "limit": 5e-6, "kept": True, "p95": 6e-6, "kept_p95": False},
            "micropitting": {"value": 1.25, "limit": 1.0, "kept": True},
        },
        "efficiency": 0.98765,
        "efficiency_lowest": 0.975,
        "efficiency_highest": 0.99125,
        "dynamic_factor_max": 1.875,
        "dynamic_factor_max_speed": 200.0 * math.pi / 30.0,
        "pinion_root_tension_max": 310e6,
        "gear_root_tension_max": 290e6,
        "hertz_pressure_max": 1.25e9,
        "loaded_transmission_error_peak_to_peak": 4.25e-6,
        "contact_loss_from": 1500.0 * math.pi / 30.0,
    }


def test_the_page_shows_both_sides_in_engineers_units():
    summary = summary_with()
    found = rows_of(page._by_standard(summary))
    assert found["Bulk temperature θ_M"] == ["90.2", "180.5", "°C"]
    assert found["Mean friction μ_m"] == ["0.0512", "0.1024", ""]
    assert found["Minimum film h_Y"] == ["0.123", "0.247", "µm"]
    assert found["Specific film λ_GF"] == ["0.345", "0.690", ""]
    assert found["Stiffness of one pair c′"] == ["13.00", "26.00", "N/(mm µm)"]
    assert found["Mesh stiffness c_γα"] == ["19.00", "38.00", "N/(mm µm)"]
    assert found["Dynamic factor K_v"] == ["1.125", "2.250", ""]
    assert found["Transverse load factor K_Hα"] == ["1.250", "2.500", ""]
    assert found["Loss factor H_v"] == ["0.1535", "0.3070", ""]
    assert found["Loss to tooth friction"] == ["61.2", "122.5", "W"]
    assert found["Contact temperature θ_B"] == ["150.0", "171.9", "°C"]
    assert found["Scuffing S_B, flash temp."] == ["2.50", "2.12", ""]
    assert found["Scuffing S_intS, integral temp."] == ["3.25", "–", ""]
    assert "Micropitting S_λ" not in found
    points = rows_of(page._points(summary))
    assert points["λ_GF, ISO"][0] == "0.690"
    assert points["h_Y, simulated (µm)"][0] == "0.494"
    assert points["h_Y, ISO (µm)"][-1] == "0.123"
    assert points["Contact temperature, simulated (°C)"][-1] == "241.0"
    scatter = rows_of(page._scatter(summary))
    assert scatter["Dynamic factor K_v"] == ["1.50", "1.25", "1.75", ""]
    assert scatter["Loaded error, peak to peak"] == ["1.50", "1.25", "1.75", "µm"]
    assert "over 9 samples" in page._scatter(summary)
    for name in ("K_Halpha", "K_Hbeta", "transmission_error_peak_to_peak"):
        factor = 1e-6 if "error" in name else 1.0
        of = {part: value * factor for part, value in (("median", 1.5), ("p5", 1.25), ("p95", 1.75))}
        ((_, cells),) = rows_of(page._scatter({"simulated": {"spread": {name: of | {"samples": 4}}}})).items()
        assert cells[:3] == ["1.50", "1.25", "1.75"]
    assert page._scatter({"simulated": {}}) == ""


def test_the_page_says_which_limits_hold():
    summary = summary_with()
    rows = rows_of(page._limits(summary))
    assert rows["Dynamic factor K_v"] == ["1.4", "≤ 1.5", "", "holds"]
    assert rows["Hertz pressure with K_v"] == ["1.7", "≤ 1.5", "GPa", "exceeded"]
    assert rows["Root tension"] == ["300", "≤ 500", "MPa", "holds"]
    assert rows["Loaded error, peak to peak"] == ["4", "≤ 5", "µm", "holds"]
    assert rows["Micropitting S_λ"] == ["1.25", "≥ 1", "", "holds"]
    record: Any = SimpleNamespace(summary=summary, message="")
    verdict = page._verdict(record, summary)
    assert "Limits exceeded: Hertz pressure with K_v." in verdict
    assert "Loaded error, peak to peak (6 at 95 %)" in verdict
    kept = {"limits": {"dynamic_factor": summary["limits"]["dynamic_factor"]}}
    assert "All 1 limits hold." in page._verdict(record, kept)


def test_the_tiles_of_the_first_page():
    summary = summary_with()
    tiles = dict(re.findall(r'<div class="tile"><b>(.*?)</b><span>(.*?)</span>', page._tiles(summary)))
    assert tiles["98.77 %"].startswith("efficiency; 97.50 to 99.12 %")
    assert tiles["2.25"] == "dynamic factor at the duty; up to 1.88 at 200 rpm"
    assert "0.69" in tiles
    assert tiles["172 °C"] == "contact temperature; bulk 180 °C"
    assert "1.25 GPa" in tiles
    assert "310 MPa" in tiles
    assert "4.25 µm" in tiles
    assert "1500 rpm" in tiles
    del summary["contact_loss_from"]
    assert "<b>none</b><span>loss of contact" in page._tiles(summary)


def test_the_page_says_what_was_asked():
    sheet = SimpleNamespace(type="mineral", viscosity_40=220e-6, viscosity_100=19e-6)
    body = {"teeth": 25.0, "profile_shift": 0.25, "face_width": 0.04}
    drive = SimpleNamespace(
        centre_distance=0.129,
        module=0.003,
        pinion=SimpleNamespace(**body),
        gear=SimpleNamespace(**body | {"teeth": 60.0, "profile_shift": 0.1, "face_width": 0.038}),
    )
    case: Any = SimpleNamespace(
        family="involute",
        drive=drive,
        lubricant=SimpleNamespace(sheet=sheet),
        quality=SimpleNamespace(grade=6.0),
        mean_roughness=0.8e-6,
        gear_torque=240.0,
        pinion_speed=1800.0 * math.pi / 30.0,
        oil_temperature=353.15,
        settings=SimpleNamespace(lubrication="dip"),
        materials=(SimpleNamespace(name="steel"), SimpleNamespace(name="steel")),
    )
    rows = rows_of(page._asked(case))
    (gears,) = rows["Gears"]
    assert gears == "involute 25/60, module 3 mm, x 0.25/0.1, a 129 mm, b 40/38 mm, grade 6, Ra 0.8 µm"
    assert rows["Duty"] == ["18.85 kW at 1800 rpm of the pinion, 100 N m on the pinion, 240 N m on the gear"]
    assert rows["Oil"] == ["mineral, 220/19 mm²/s, at 80 °C, dip"]
    assert rows["Material"] == ["steel"]


def test_figures_over_cases_with_those_that_fail():
    block = {
        "status": [DONE, FAILED, DONE],
        "message": ["", "pointed", ""],
        "a": np.array([1.0, 2.0, 3.0]),
        "b": np.array([4.0, 5.0, np.nan]),
    }
    seen: list[Any] = []

    class Together:
        def settings(self, cases: Any, transient: Any, engine: str) -> str:
            seen.append((cases, engine))
            return "settings"

        def evaluate(self, chunk: Any, settings: str, workers: Any) -> Any:
            seen.append((chunk.numbers.tolist(), chunk.cases, settings))
            return block

    study: Any = SimpleNamespace(swept=lambda: ("a", "b"), batch=Together)
    rows, failures = parts._figures(study, ["x", "y", "z"])
    assert seen == [(["x", "z"], "native"), ([0, 1, 2], ("x", "y", "z"), "settings")]
    np.testing.assert_array_equal([rows["a"], rows["b"]], [[1.0, np.nan, 3.0], [4.0, np.nan, np.nan]])
    assert failures == ["pointed"]

    def one(case: float) -> dict[str, Any]:
        if case < 0.0:
            raise InputError("drive", rule="pointed")
        return {"a": case, "b": None if case > 2.0 else 2.0 * case}

    alone: Any = SimpleNamespace(swept=lambda: ("a", "b"), batch=lambda: None, figures=one)
    rows, failures = parts._figures(alone, [1.0, -1.0, 3.0])
    np.testing.assert_array_equal([rows["a"], rows["b"]], [[1.0, np.nan, 3.0], [2.0, np.nan, np.nan]])
    assert len(failures) == 1


def test_rows_are_taken_up_where_they_are_of_the_same_task(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    task = Task(
        "speeds", "over speed", {"kind": "gear-pair"}, "operating.pinion_speed", ("1 rad/s", "2 rad/s")
    )
    runs: list[Any] = []

    def figures(study: Any, cases: Any) -> Any:
        runs.append(cases)
        return {"a": [1.5, math.nan], "b": [2.5, 3.5]}, ["lost"]

    class Overrides(dict):
        """Stands for a case."""

        sha256 = "own"

    monkeypatch.setattr(parts, "case_of", lambda one, overrides: Overrides(overrides))
    monkeypatch.setattr(parts, "_figures", figures)
    study: Any = None
    for _ in range(2):
        found = parts._varied(study, task, tmp_path)
        np.testing.assert_array_equal(found.rows["a"], [1.5, math.nan])
        assert tuple(found.failures) == ("lost",)
    assert runs == [[{"operating.pinion_speed": "1 rad/s"}, {"operating.pinion_speed": "2 rad/s"}]]
    assert parts._kept_rows(task._replace(values=("1 rad/s",)), tmp_path) is None
    assert parts._kept_rows(task._replace(name="other"), tmp_path) is None
    assert parts._kept_run(task._replace(name="none"), tmp_path) is None
    data = json.loads((tmp_path / "speeds.json").read_text(encoding="utf-8"))
    assert data["figures"] == {"a": [1.5, None], "b": [2.5, 3.5]}


def test_a_part_that_is_not_needed_may_fail(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    one = Task("one", "the first", {"kind": "efficiency"})
    more = Task("more", "further", {"kind": "efficiency"}, "key", ("1", "2"), needed=False)
    last = Task("last", "the last", {"kind": "efficiency"}, needed=False)
    every = (parts.Part("study", "role", (one, more)), parts.Part("study", "role", (last,)))  # pyright: ignore[reportArgumentType]
    tried: list[Any] = []

    def fails(study: Any, task: Task, folder: Path) -> Done:
        raise InputError(task.name, rule="cannot be")

    monkeypatch.setattr(parts, "case_of", lambda task, overrides=None: tried.append((task.name, overrides)))
    monkeypatch.setattr(parts, "_run", lambda study, task, folder: Done(folder / task.name, {"a": 1}))
    monkeypatch.setattr(parts, "_varied", fails)
    told: list[float] = []
    found = parts.results(every, tmp_path / "new", told.append)
    assert told == pytest.approx([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0])
    assert tried == [("one", {})]
    assert found["one"].summary == found["last"].summary == {"a": 1}
    assert "further" in found["more"].failures[0]
    with pytest.raises(InputError):
        parts.results((parts.Part("study", "role", (more._replace(needed=True),)),), tmp_path)  # pyright: ignore[reportArgumentType]
    assert tried[-1] == ("more", {"key": "1"})
    left = {"one": Done(tmp_path), "more": None, "last": None}
    monkeypatch.setattr(parts, "_kept_run", lambda task, folder: left[task.name])
    monkeypatch.setattr(parts, "_kept_rows", lambda task, folder: left[task.name])
    kept = parts.kept(every, tmp_path)
    assert kept is not None
    assert kept["one"] is left["one"]
    assert kept["more"].failures == ("further",)
    left["one"] = None
    assert parts.kept(every, tmp_path) is None


def test_of_a_part_the_first_record_is_shown(monkeypatch: pytest.MonkeyPatch):
    opened: list[Any] = []

    class Opened:
        def __enter__(self) -> str:
            return "record"

        def __exit__(self, *_: object) -> None: ...

    def open_record(path: Path) -> Opened:
        opened.append(path)
        return Opened()

    monkeypatch.setattr(page, "open_record", open_record)
    monkeypatch.setattr(page, "inline", lambda picture, about: f"<img {picture} {about}>")
    monkeypatch.setattr("tribodyn.studies.pages.pictures.overview", lambda record: f"of {record}")
    monkeypatch.setattr("tribodyn.post.page.page.summary_tables", lambda records, lines: f"{records} {lines}")
    study: Any = SimpleNamespace(lines=lambda: "lines")
    done = [Done(Path("rows"), rows={}), Done(Path("first"), {"a": 1}), Done(Path("second"), {"a": 2})]
    found = page._part(study, "Losses", done)
    assert opened == [Path("first")]
    assert "<h2>Losses</h2><p><img of record Losses></p>['record'] ['lines']" in found
    assert page._part(study, "Losses", done[:1]) == ""


def test_what_is_put_together_of_the_parts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Figures of all, scatter over those samples that are known, margins beside them; no empty tables."""
    one: Any = SimpleNamespace(
        figures={"face_load_factor": 1.3, "film_min": 2e-7},
        along={"roll_angle": "roll"},
        spread={"dynamic_factor": np.array([1.4, 1.2, np.nan, 1.3])},
    )
    other: Any = SimpleNamespace(figures={"efficiency": 0.98}, along={}, spread={})
    films = SimpleNamespace(bulk_temperature=360.0, flash_rise=np.array([np.nan, 25.0, 15.0]))
    local: Any = SimpleNamespace(films=films, points=np.arange(7.0))
    seen: list[Any] = []
    simple: dict[str, Any] = {
        "prepare": lambda _: SimpleNamespace(family=SimpleNamespace(involute=False)),
        "local_of": lambda case, assembly, along, figures: seen.append((along, dict(figures))) or local,
        "simulated_part": lambda *_: {"lambda_GF": {"worst": 0.25}},
        "strength_of": lambda _: "strength",
        "judged": lambda case, found, *_: {
            "margins": {"simulated": {"S_B": 2.0}},
            "limits": {},
            "found": found,
        },
        "assumed": lambda case, involute: ["first", "second"] if not involute else [],
        "extrapolated": lambda *_: [],
    }
    for name, stand_in in simple.items():
        monkeypatch.setattr(assessing, name, stand_in)
    done = {
        "a": Done(tmp_path, {"trust": "outside the model", "trust_reasons": {"deflection": 1}}),
        "b": Done(tmp_path, {"trust": "inside the model"}),
        "c": Done(tmp_path),
    }
    monkeypatch.setattr(parts, "asked_of", lambda _: "asked")
    monkeypatch.setattr(parts, "parts", lambda _: ())
    monkeypatch.setattr(parts, "results", lambda *_, force: done)
    monkeypatch.setattr(parts, "answers", lambda *_: [("part", one), ("part", other)])
    case: Any = SimpleNamespace(pinion_speed=100.0, gear_torque=96.0, oil_temperature=353.0)
    found, summary = assessing.assessed(case, tmp_path)
    assert found is local
    assert seen == [({"roll_angle": "roll"}, {"face_load_factor": 1.3, "film_min": 2e-7, "efficiency": 0.98})]
    assert summary["contact_temperature_max"] == 385.0
    assert summary["duty"] == {"pinion_speed": 100.0, "gear_torque": 96.0, "oil_temperature": 353.0}
    assert summary["dynamic_factor_spread"][0] == pytest.approx(1.3)
    assert summary["point_angles"] == dict(
        zip(("A", "AB", "B", "C", "D", "DE", "E"), map(float, range(7)), strict=True)
    )
    assert summary["assumed"] == {"01": "first", "02": "second"}
    assert (summary["trust"], summary["trust_reasons"]) == ("outside the model", {"deflection": 1})
    assert not {"limits", "iso", "extrapolated", "transverse_load_factor_method_b"} & summary.keys()
    assert summary["found"] is None
    assert (summary["units"]["film_min"], summary["units"]["pinion_speed"]) == ("m", "rad/s")
    assert assessing._scatter(np.array([1.0, np.nan, 3.0]))["samples"] == 2
    assert assessing._trust({"b": done["b"], "c": done["c"]}, "b") == {"trust": "inside the model"}
    assert assessing._trust({"c": done["c"]}, "c") == {}
    extrapolated = {"trust": "laws extrapolated", "trust_reasons": {"film_law_range": {"value": 1.0}}}
    both = {"b": done["b"], "d": Done(tmp_path, extrapolated)}
    assert assessing._trust(both, "bd") == extrapolated
    assert assessing._trust(both, "b") == {"trust": "inside the model"}  # for comparison only


def test_datasets_along_the_path():
    films = SimpleNamespace(
        bulk_temperature=360.0,
        flash_rise=np.array([5.0, 7.0]),
        pressure="p",
        film_thickness="h",
        specific_film="l",
    )
    local: Any = SimpleNamespace(films=films, roll_angle="roll", normal_load="load", radius="r", sliding="v")
    found = assessing._arrays(local)
    np.testing.assert_array_equal(found["contact_temperature"], [365.0, 367.0])
    assert (found["hertz_pressure"], found["film_thickness"]) == ("p", "h")
    assert (found["equivalent_radius"], found["sliding_speed"], found["specific_film"]) == ("r", "v", "l")


def test_laws_beyond_their_range_are_said(monkeypatch: pytest.MonkeyPatch):
    """Of needed tasks in their sentences, of the others in one; failures of all."""
    one = Task("one", "film and losses", {})
    other = Task("other", "losses by another law", {}, needed=False)
    third = Task("third", "losses by a third law", {}, needed=False)
    lost = Task("lost", "lost", {}, needed=False)

    class Opened:
        def __enter__(self) -> str:
            return "record"

        def __exit__(self, *_: object) -> None: ...

    monkeypatch.setattr(said, "open_record", lambda _: Opened())
    sentences = ["The film law is extrapolated.", "All is well."]
    study = SimpleNamespace(sentences=lambda record: sentences)
    taking: Any = (SimpleNamespace(study=study, tasks=(one, other, third, lost)),)
    done = {
        "one": Done(Path("one"), {"a": 1}),
        "other": Done(Path("other"), {"friction_in_range_fraction": 0.99}),
        "third": Done(Path("third"), {"friction_in_range_fraction": 1.0}),
        "lost": Done(Path("lost"), failures=("lost: why", "lost: why")),
    }
    assert said.extrapolated(taking, done) == [
        "Film and losses: The film law is extrapolated.",
        "lost: why",
        "For comparison only, outside the range of the law in part or all: losses by another law.",
    ]
    sentences.append(f"{said.EXCEEDED} much.")
    assert said.extrapolated(taking, done)[0].endswith(f"{said.EXCEEDED} much.")


def test_a_part_without_a_sound_seal_is_computed_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """As those of earlier versions, and those of a process that was killed before it wrote the seal."""
    monkeypatch.setattr(parts, "case_of", lambda task, overrides: SimpleNamespace(sha256="own"))
    task = Task("one", "the first", {})
    (tmp_path / "one.h5").write_bytes(b"stands for a record")
    for seal in (None, b"", b"a b c", b"\xff\x00", b"one"):
        if seal is not None:
            (tmp_path / "one.origin").write_bytes(seal)
        assert parts._kept_run(task, tmp_path) is None
        parts._require_unchanged(task, tmp_path)
    with pytest.raises(KeyboardInterrupt), parts._sealing(task, tmp_path):
        raise KeyboardInterrupt
    assert not (tmp_path / "one.origin").exists()
    with parts._sealing(task, tmp_path):
        (tmp_path / "one.h5").write_bytes(b"another")
    parts._require_unchanged(task, tmp_path)
    assert parts._is_current(task, tmp_path)
    monkeypatch.setattr(parts, "case_of", lambda task, overrides: SimpleNamespace(sha256="other"))
    assert not parts._is_current(task, tmp_path)
    for changed in (b"anothes", b"", b"another\0"):
        (tmp_path / "one.h5").write_bytes(changed)
        with pytest.raises(InputError, match="was changed since"):
            parts._require_unchanged(task, tmp_path)


def test_a_page_is_put_together_of_its_pieces(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """In their order; parts that do not lie beside the record are left out."""
    summary = summary_with() | {"assumed": {"01": "hard steel"}, "extrapolated": {}}
    attrs = {"scenario": "a = 1", "scenario_sha256": "0123", "created": "2026-01-02T03:04"}
    attrs |= {"tribodyn_version": "7.0"}
    record: Any = SimpleNamespace(
        summary=summary,
        attrs=attrs,
        path=str(tmp_path / "r.h5"),
        scenario={"title": "A & B"},
        label="r",
        message="",
    )
    task = Task("one", "the first", {})
    part = SimpleNamespace(study="study", role=SimpleNamespace(title="Losses"), tasks=(task,))
    tables = [("Pair", ("quantity", "value"), [("teeth", "25")])]
    simple: dict[str, Any] = {
        "load": lambda path: SimpleNamespace(case=path.read_text(encoding="utf-8")),
        "pictures": lambda of, curves: f"pictures {curves}",
        "inline": lambda picture, about: f"<img {picture}>",
        "check": lambda case: SimpleNamespace(tables=tables),
        "_asked": lambda case: f"<p>asked {case}</p>",
        "_part": lambda study, title, done: f"<section>{study} {title} {done}</section>",
    }
    for name, stand_in in simple.items():
        monkeypatch.setattr(page, name, stand_in)
    monkeypatch.setattr(parts, "asked_of", lambda case: "asked")
    monkeypatch.setattr(parts, "parts", lambda asked: (part,))
    monkeypatch.setattr(parts, "answers", lambda *_: [(part, SimpleNamespace(curves=("curve",)))])
    left: list[Any] = [None, {"one": "done"}]
    monkeypatch.setattr(parts, "kept", lambda taking, folder: left[0])
    bare = page.page(record)
    left.pop(0)
    found = page.page(record)
    assert "<section>study Losses ['done']</section>" in found
    assert "<section>study Losses" not in bare
    assert "<img pictures ['curve']>" in found
    assert "<img pictures []>" in bare
    pieces = [
        "A &amp; B",
        "asked a = 1",
        "<h2>Limits</h2>",
        "hard steel",
        "<h2>Standard and simulation</h2>",
        "<h2>Along the path of contact</h2>",
        "<h2>Gears and oil</h2>",
        "scenario sha256 0123",
    ]
    places = [found.index(one) for one in pieces]
    assert places == sorted(places)
    assert "Nothing." in found
    assert found.index("<h2>Gears and oil</h2>") < found.index(">25<") < found.index("Scenario and origin")
