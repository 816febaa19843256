"""The study of the solved contact: its loads, and the solved contact beside single ones and regressions."""

from dataclasses import replace

import numpy as np
import pytest

import tribodyn as td
from tests.support.pages import data_of, needs_browser, shown, unpacked
from tribodyn.geometry.families import family
from tribodyn.studies.ehl import along_path
from tribodyn.studies.ehl.along_path import jump_width, prepare, way
from tribodyn.studies.ehl.judgement import case_for
from tribodyn.studies.ehl.run import quantities_of
from tribodyn.studies.protocol.load import load_scenario


@pytest.fixture(scope="module")
def run():
    """The shipped CRC drive at five positions."""
    return td.run("ehl-crc-23-47", {"output.positions": 5})


def test_its_contacts_are_those_of_the_function(run):
    """Smooth, without sliding: central films within the heat's and the asperities' small share."""
    data = run.data
    at = 2
    alone = td.line_contact(
        line_load=float(data["line_load"][at]),
        radius=float(data["equivalent_radius"][at]),
        entrainment_speed=float(data["entrainment_speed"][at]),
        viscosity=0.35,
        pressure_viscosity=25e-9,
        viscosity_pressure_index=0.57,
        effective_modulus=226.37e9,
    )
    assert float(data["central_film_thickness"][at]) == pytest.approx(alone.central_film_thickness, rel=0.15)
    assert float(data["hertz_pressure"][at]) == pytest.approx(alone.pressure.max(), rel=0.03)


def test_profiles_carry_the_load(run):
    data = run.data
    place = data["place"].to_numpy()
    for at in range(data.sizes["phase"]):
        width = float(data["half_width"][at])
        carried = np.trapezoid(data["pressure"][at].to_numpy(), place) * width
        assert carried == pytest.approx(float(data["line_load"][at]), rel=0.02)


def test_regressions_stand_beside_it(run):
    assert {"masjedi-khonsari", "dowson-higginson", "moes"} <= set(run.summary["film_over_solved"])
    assert all(0.3 < ratio < 3.0 for ratio in run.summary["film_over_solved"].values())
    assert "solved" not in run.summary["friction_over_solved"]


@pytest.fixture(scope="module")
def judged():
    return td.compare_laws("crc-23-47", positions=5)


def test_laws_are_judged_by_the_study_of_any_scenario(run, judged):
    """The ratios of the study's own record, whatever scenario names drive, oil and duty."""
    for law, ratio in run.summary["film_over_solved"].items():
        found = judged.laws["film", law]
        assert found.median == pytest.approx(ratio, rel=1e-6)
        assert found.minimum <= found.median <= found.maximum
    assert judged.laws["film", "masjedi-khonsari"].right == 1.0
    assert "masjedi-khonsari" in judged.said
    assert judged.as_dict()["said"] == judged.said


def test_all_film_laws_are_compared_with_one_film(run, judged):
    films = [ratio.against for ratio in judged.ratios if ratio.what == "film"]
    assert len(films) > 3
    assert len(set(films)) == 1
    data = run.data
    smooth, rough = (data[name].to_numpy() for name in ("central_film_smooth", "central_film_thickness"))
    assert np.all(smooth < rough)
    assert np.all(data["minimum_film_smooth"].to_numpy() < smooth)


def test_friction_shares_in_the_torque(monkeypatch):
    """Where one pair carries all: F (r_g cos α ± μ (r_g sin α − s)) = T on the gear of an involute."""
    monkeypatch.setattr(along_path, "friction_along", lambda _study, over: np.full(len(over.roll), 0.08))
    study = along_path.prepare(case_for(load_scenario("involute-23-47"), 60))
    over, cycle = along_path.way(study), study.cycle
    alone = over.normal_load > 0.75 * over.normal_load.max()
    radius = float(cycle.gear_pitch_radius)
    angle = family("involute").working_path(study.case.drive).pressure_angle(0.0)
    base = float(cycle.pinion_pitch_radius) * np.cos(angle)
    arm = radius * np.cos(angle)
    arm = arm + 0.08 * np.sign(over.roll) * (radius * np.sin(angle) - base * over.roll)
    torque = (over.normal_load * arm)[alone]
    away = np.abs(over.roll[alone]) > 0.01
    np.testing.assert_allclose(torque[away], study.case.operating.gear_torque, rtol=1e-3)
    assert np.count_nonzero(away) > 5


def test_what_has_no_oil_is_not_judged():
    with pytest.raises(td.InputError, match="without lubricant"):
        td.judge("load-contact-18-36", positions=5)


@pytest.mark.parametrize("positions", [0, 3, 2001, 4.0, True, "8", float("nan")])
def test_positions_that_are_none(positions):
    with pytest.raises(td.InputError) as caught:
        td.compare_laws("crc-23-47", positions=positions)
    assert caught.value.key == "positions"


def test_the_page_has_the_profiles_of_every_position(run, tmp_path):
    (record,) = data_of(run.report(tmp_path / "page.html"))["records"]
    profiles = record["profiles"]
    np.testing.assert_allclose(unpacked(profiles["x"]), run.data["place"], rtol=1e-6)
    rows = {row["name"]: row for row in profiles["rows"]}
    pressure = unpacked(rows["pressure"]["y"]).reshape(run.data["pressure"].shape)
    np.testing.assert_allclose(pressure * 1e9, run.data["pressure"], rtol=1e-6)
    # the film's axis ends where the flanks have parted; the curves of 161 places are not on offer beside it
    assert rows["film_thickness"]["high"] == pytest.approx(3e6 * run.data["central_film_thickness"].max())
    assert not {"pressure", "film_thickness"} & {series["name"] for series in record["series"]}


@needs_browser
@pytest.mark.slow
def test_the_cursor_moves_the_profiles(run, tmp_path):
    page = run.report(tmp_path / "page.html")
    phase = run.data["phase"].to_numpy()
    assert 'data-profiled="3"' in shown(f"{page.as_uri()}#at={phase[3] + 1e-3}")


@pytest.fixture(scope="module")
def squeezed():
    """The same way with squeeze, at twelve positions."""
    return td.run("ehl-crc-23-47", {"output.positions": 12, "contact.transient": True, "contact.step": 0.2})


def test_squeeze_keeps_the_film_that_was(squeezed):
    """The film stays thick for a while where the load rises, thin where it falls."""
    data, summary = squeezed.data, squeezed.summary
    steady, film = (data[f"{kind}central_film_thickness"].to_numpy() for kind in ("", "transient_"))
    assert np.all(np.isfinite(film))
    assert film[0] == pytest.approx(steady[0], rel=2e-3)
    load = data["line_load"].to_numpy()
    assert film[np.argmax(np.diff(load)) + 1] > steady[np.argmax(np.diff(load)) + 1]
    assert summary["central_film_departure_max"] == pytest.approx(np.max(np.abs(film / steady - 1.0)))
    assert 0.02 < summary["central_film_departure_max"] < 0.3
    assert summary["central_film_departure_mean"] < 0.05
    assert (summary["transient_positions_solved"], summary["transient_restarts"]) == (12, 0)


def test_profiles_with_squeeze_carry_the_load(squeezed):
    data = squeezed.data
    place = data["place"].to_numpy()
    carried = (
        np.trapezoid(data["transient_pressure"].to_numpy(), place, axis=1) * data["half_width"].to_numpy()
    )
    np.testing.assert_allclose(carried, data["line_load"].to_numpy(), rtol=0.02)


def test_jumps_of_the_load_are_spread(monkeypatch):
    """Over the width that is stated, twice as steep in its middle; the mean load stays."""
    monkeypatch.setattr(along_path, "friction_along", lambda _study, over: np.zeros(len(over.roll)))
    case = case_for(load_scenario("crc-23-47"), 5)
    sharp = way(prepare(case)).table
    study = prepare(replace(case, transient=True))
    over = way(study)
    width = jump_width(study, float(np.max(sharp[1])), over.radius, over.speeds)
    assert np.trapezoid(over.table[1], over.table[0]) == pytest.approx(
        np.trapezoid(sharp[1], sharp[0]), rel=1e-3
    )
    jump = np.max(np.abs(np.diff(sharp[1])))
    steepest = np.max(np.abs(np.diff(over.table[1]) / np.diff(over.table[0])))
    assert steepest == pytest.approx(2.0 * jump / width, rel=0.1)


@pytest.mark.parametrize(
    ("lubricant", "temperature", "torque", "verdict"),
    [
        ("iso-vg-220-pao", "80 degC", "200 N*m", "laws extrapolated"),
        ("squalane", "80 degC", "200 N*m", "inside the model"),
        ("squalane", "80 degC", "900 N*m", "laws extrapolated"),
        ("squalane", "110 degC", "200 N*m", "laws extrapolated"),
    ],
)
def test_an_oil_estimated_or_beyond_its_measurement_is_extrapolated(lubricant, temperature, torque, verdict):
    """With the band of its friction where it is estimated."""
    oil = {"lubricant": lubricant, "operating.oil_temperature": temperature}
    case = td.scenario("ehl-crc-23-47", oil | {"operating.gear_torque": torque, "output.positions": 4})
    found = quantities_of(replace(case, operating=replace(case.operating, pinion_speed=100.0)))
    assert found["trust"] == verdict
    assert ("viscosity_unmeasured" in found.get("trust_reasons", {})) == (verdict != "inside the model")
    assert ("type" in found["viscosity_origin"]) == ("friction_band_low" in found) == (lubricant[:3] == "iso")
    if lubricant[:3] == "iso":
        assert found["friction_band_low"] < 1.0 <= found["friction_band_high"]


def test_superfinished_flanks_rub_less_than_hobbed_ones():
    means = []
    for finish in ("superfinished", "ground", "hobbed"):
        changes = {"drive.finish": finish, "drive.roughness": "0.8 um", "output.positions": 4}
        found = quantities_of(td.scenario("ehl-crc-23-47", changes))
        means.append(found["asperity_load_ratio_max"])
    assert sorted(means) == means
    assert means[2] > 2.0 * means[0]
