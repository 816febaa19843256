"""An assessment: its figures beside formulas written out, its folder, its limits, what is refused."""

import json
import math
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest
from typer.testing import CliRunner

from tests.support.short_studies import short_case, shortened, written_template
from tribodyn.cli.app import app
from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.rating.standard import path_of
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import family, involute
from tribodyn.record.reader import Record
from tribodyn.standards.contact_path import POINTS, ContactPath, point_distances
from tribodyn.studies.assessment.parts import request_of
from tribodyn.studies.assessment.results.margins import local_of, point_angles
from tribodyn.studies.protocol.load import load_scenario

KIND = "assessment"
ISO = {"theta_M", "mu_m", "h_Y", "lambda_GF", "c_prime", "c_gamma_alpha", "K_v", "K_Halpha", "H_v", "loss"}


def invoked(*words: object, status: int = 0) -> str:
    ended = CliRunner().invoke(app, [str(word) for word in words])
    assert ended.exit_code == status, f"{ended.output}\n{ended.exception}"
    return ended.stderr if status else ended.stdout


def assess(folder: Path, *more: str) -> dict:
    scenario = written_template(KIND, folder)
    return json.loads(invoked("assess", scenario, *shortened(KIND), *more, "-o", folder / "out", "--json"))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("assessed")


@pytest.fixture(scope="module")
def assessed(folder: Path) -> dict:
    return assess(folder)


def test_the_simulation_stands_beside_it(assessed: dict):
    own, iso = assessed["simulated"], assessed["iso"]
    assert set(own) >= ISO
    # one model against another: the same order, not the same number
    for name in ("c_prime", "c_gamma_alpha", "K_v", "K_Halpha", "H_v", "loss"):
        assert 0.5 < own[name] / iso[name] < 2.0, name
    for name in ("h_Y", "lambda_GF", "mu_m", "theta_M"):
        assert 0.5 < own[name]["C"] / iso[name]["C"] < 2.0, name
    assert own["loss"] == pytest.approx(
        (1.0 - assessed["efficiency"]) / assessed["efficiency"] * 60e3, rel=1e-6
    )
    assert set(assessed["loss_by_law"]) == {"masjedi-khonsari", "niemann"}
    assert assessed["margins"]["iso"]["S_lambda"] == pytest.approx(
        iso["lambda_GF"]["worst"] / assessed["margins"]["iso"]["lambda_GFP"]
    )


def test_pitting_and_bending_of_the_simulation_stand_beside_the_standards(assessed: dict):
    own, iso, margins = assessed["simulated"], assessed["iso"], assessed["margins"]
    for name in ("sigma_H", "sigma_F", "S_H", "S_F", "life_pitting", "life_bending"):
        assert set(own[name]) == {"pinion", "gear"}
    for side in ("pinion", "gear"):
        # what is endured is the standard's, the stress the simulation's
        assert own["S_H"][side] * own["sigma_H"][side] == pytest.approx(iso["sigma_HG"][side])
        assert own["S_F"][side] * own["sigma_F"][side] == pytest.approx(iso["sigma_FG"][side])
        # the motion raises the stresses of slow rotation, by no more than all loads
        raised = own["sigma_F"][side] / assessed[f"{side}_root_tension_max"]
        assert 0.95 < raised < 1.01 * own["K_v"]
        parted = abs(math.log(own["S_F"][side] / iso["S_F"][side])) > math.log(1.05)
        said = [
            text for text in assessed.get("reasons", {}).values() if text.startswith(f"S_F of the {side}")
        ]
        assert len(said) == parted
    assert margins["simulated"]["S_H"] == min(own["S_H"].values())
    for limit, name in (("pitting", "S_H"), ("bending", "S_F"), ("life", "life")):
        both = [margins[part][name] for part in ("iso", "simulated")]
        assert assessed["limits"][limit]["value"] == min(both)


def test_a_deviating_tooth_and_samples_stand_beside_accurate_teeth(assessed: dict):
    own = assessed["simulated"]
    whole = 60e3 / (1800.0 * math.pi / 30.0) / (27e-3 * math.cos(math.radians(20.0)))
    with Record(Path(assessed["record"]).with_name("assessment-parts") / "loaded-contact.h5") as record:
        accurate = record.summary["shared_load_max"]
    assert 1.0 < own["K_Halpha"] <= whole / accurate * (1.0 + 1e-9)
    spread = own["spread"]
    assert {"K_v", "K_Halpha", "K_Hbeta", "loaded_transmission_error_peak_to_peak"} <= set(spread)
    for name, scatter in spread.items():
        assert scatter["p5"] <= scatter["median"] <= scatter["p95"], name
        assert scatter["samples"] == 2
    assert spread["K_Hbeta"]["p5"] > own["K_Hbeta"]  # inclined teeth
    assert spread["K_Halpha"]["p95"] <= whole / accurate * (1.0 + 1e-9)
    assert assessed["dynamic_factor_spread"] == [spread["K_v"][name] for name in ("median", "p5", "p95")]


def test_counts_and_ranges_are_those_of_the_samples(assessed: dict):
    samples, spread = assessed["by_sample"], assessed["simulated"]["spread"]
    assert all(len(values) == 2 for name, values in samples.items() if name != "limit_values")
    lost = sum(share > 0.0 for share in samples["contact_loss_fraction_max"])
    assert assessed["sample_counts"]["contact_lost"] == lost
    assert sum(speed is not None for speed in samples["contact_loss_speed_from"]) == lost
    assert all(
        most >= at_duty
        for most, at_duty in zip(samples["dynamic_factor_max"], samples["dynamic_factor"], strict=True)
    )
    for name, limit in assessed["limits"].items():
        values = np.array(samples["limit_values"][name])
        exceed = (
            values > limit["limit"]
            if name in ("dynamic_factor", "hertz_pressure")
            else values < limit["limit"]
        )
        assert limit["exceed"] == np.sum(exceed), name
    for name, of_samples in (("K_v", "dynamic_factor"), ("lambda_GF", "specific_film_min"), ("S_B", "S_B")):
        low, high = np.percentile(samples[of_samples], [5.0, 95.0])
        assert (spread[name]["p5"], spread[name]["p95"]) == pytest.approx((low, high)), name
    # of two samples, the one that presses harder has the thinner film and is hotter
    assert np.argmin(samples["limit_values"]["hertz_pressure"]) == np.argmin(
        samples["contact_temperature_max"]
    )


def test_what_is_known_has_no_range(assessed: dict, folder: Path, tmp_path: Path):
    parts = tmp_path / "out" / "assessment-parts"
    shutil.copytree(folder / "out" / "assessment-parts", parts)
    known = {"deviations": "false", "bearings": 1.0, "damping_ratio": [0.05, 0.05], "centre_distance": "0 um"}
    options = [
        word for name, value in known.items() for word in ("--set", f"assessment.unknowns.{name}={value}")
    ]
    found = assess(tmp_path, *options)
    for name, scatter in found["simulated"]["spread"].items():
        assert scatter["p5"] == pytest.approx(scatter["p95"], rel=1e-9), name
        if name in ("K_v", "K_Hbeta", "lambda_GF", "loss", "S_B"):
            value = found["simulated"].get(name, found["margins"]["simulated"].get(name))
            accurate = value["worst"] if isinstance(value, dict) else value
            # the face in slices instead of one piece
            assert scatter["median"] == pytest.approx(accurate, rel=0.02), name
    assert "nothing: all is known" in " ".join(found["assumed"].values())


def test_samples_are_known_where_the_teeth_are_as_warm_as_the_oil(
    assessed: dict, folder: Path, tmp_path: Path
):
    shutil.copytree(folder / "out" / "assessment-parts", tmp_path / "out" / "assessment-parts")
    found = assess(tmp_path, "--set", "temperature.model=oil")
    assert found["simulated"]["spread"]["lambda_GF"]["samples"] == 2
    # the loads are those of the warmer teeth: the same samples
    assert found["by_sample"]["dynamic_factor"] == assessed["by_sample"]["dynamic_factor"]
    assert "bulk_temperature_spread" not in found


def test_every_number_has_a_unit(assessed: dict):
    units = assessed["units"]

    def without(name: str, value: object) -> list[str]:
        if name in units or isinstance(value, str):
            return []
        if isinstance(value, dict):
            return [missing for inner, number in value.items() for missing in without(inner, number)]
        return [name]

    parts = ("duty", "iso", "simulated", "load_factors", "margins", "point_angles", "loss_by_law")
    assert [missing for part in parts for missing in without(part, assessed[part])] == []
    assert (units["c_prime"], units["h_Y"], units["theta_M"], units["K_v"]) == ("N/m2", "m", "degC", "1")
    assert (units["loss"], units["contact_temperature_max"]) == ("W", "K")


def test_points_of_the_path_are_those_of_the_standard():
    bodies = [GearBody(z, 0.2, 1.0, 1.25, 0.25, 0.03, 0.01) for z in (25.0, 60.0)]
    assembly = assemble(involute.FAMILY, Drive(3e-3, math.radians(20.0), *bodies))
    path = path_of(assembly)
    assert isinstance(path, ContactPath)
    assert path.contact_ratio == pytest.approx(float(assembly.contact_ratio))
    distance = point_distances(path)
    np.testing.assert_allclose(
        point_angles(assembly), (distance - distance[POINTS.index("C")]) / path.base_radius[0], atol=1e-12
    )


def test_a_stopped_call_goes_on_and_limits_are_judged(assessed: dict, folder: Path):
    parts = folder / "out" / "assessment-parts"
    before = {file.name: file.stat().st_mtime_ns for file in parts.iterdir()}
    (parts / "efficiency-niemann.h5").unlink()  # as if the call had been stopped before it
    seal = parts / "efficiency-masjedi-khonsari.origin"  # as if other code had computed it
    seal.write_text(seal.read_text().replace(seal.read_text().split()[0], "0" * 64))
    (folder / "out" / "assessment.h5").unlink()
    limits = {"dynamic_factor": 1.001, "hertz_pressure": "9 GPa", "micropitting": 1e-6}
    options = [word for name, value in limits.items() for word in ("--set", f"limits.{name}={value}")]
    again = assess(folder, *options)
    after = {file.name: file.stat().st_mtime_ns for file in parts.iterdir()}
    renewed = {Path(name).stem for name in after if after[name] != before[name]}
    assert renewed == {"efficiency-niemann", "efficiency-masjedi-khonsari"}
    assert again["iso"] == assessed["iso"]
    assert again["simulated"] == assessed["simulated"]
    kept = {name: limit["kept"] for name, limit in again["limits"].items()}
    assert again["limits"]["dynamic_factor"]["p95"] == again["simulated"]["spread"]["K_v"]["p95"]
    assert again["limits"]["dynamic_factor"]["exceed"] == again["limits"]["dynamic_factor"]["samples"] == 2
    assert (kept["dynamic_factor"], kept["hertz_pressure"], kept["micropitting"]) == (False, True, True)
    page = (folder / "out" / "report.html").read_text(encoding="utf-8")
    assert "Limits not kept with accurate teeth: " in page
    assert "With what is not known varied: " in page
    assert "Dynamic factor K_v (2 of 2)" in page
    assert '<tr class="bad"><td>Dynamic factor' in page
    assert "<tr><td>Hertz pressure" in page


def test_a_part_that_was_changed_by_hand_is_refused_and_force_renews_it(assessed: dict, folder: Path):
    parts = folder / "out" / "assessment-parts"
    (folder / "out" / "assessment.h5").unlink()
    with h5py.File(parts / "efficiency-niemann.h5", "r+") as file:
        file["summary"].attrs["power_friction_mean"] = 0.0
    cut = parts / "efficiency-masjedi-khonsari.h5"
    cut.write_bytes(cut.read_bytes()[:5000])
    rows = parts / "loaded-contact-samples.json"
    rows_of_cases = json.loads(rows.read_text(encoding="utf-8"))["quantities"]
    name, values = next((name, row) for name, row in rows_of_cases.items() if None not in row and any(row))
    text = rows.read_text(encoding="utf-8")
    rows.write_text(text.replace(repr(values[0]), repr(100.0 * values[0])), encoding="utf-8")
    assert rows.read_text(encoding="utf-8") != text
    said = invoked("assess", written_template(KIND, folder), *shortened(KIND), "-o", folder / "out", status=2)
    assert len(said.splitlines()) == 1
    assert "was changed since" in said
    assert rows.name in said
    assert "--force" in said
    again = assess(folder, "--force")
    assert again["simulated"] == assessed["simulated"]
    assert json.loads(rows.read_text(encoding="utf-8"))["quantities"][name] == values


def test_a_change_runs_only_what_it_concerns(assessed: dict, folder: Path):
    loaded = folder / "out" / "assessment-parts" / "loaded-contact.h5"
    before = loaded.stat().st_mtime_ns
    warm = assess(folder, "--force", "--set", "operating.oil_temperature=90 degC")
    assert loaded.stat().st_mtime_ns == before
    assert warm["simulated"]["h_Y"]["C"] < assessed["simulated"]["h_Y"]["C"]


@pytest.mark.parametrize(
    ("key", "value", "named"),
    [
        ("assessment.friction_laws", ["masjedi-khonsary"], 'did you mean "masjedi-khonsari"'),
        ("assessment.friction_laws", ["coulomb"], "leave it out"),
        ("assessment.torque_shares", [1.0, 0.5], "increasing"),
        ("assessment.speed_range", [2.0, 1.0], "above the first"),
        ("assessment.samples", -1, "samples"),
        ("assessment.seed", -1, "seed"),
        ("operating.power", "-20 kW", "driving pinion"),
        ("lubricant.viscosity_40", "15 mm**2/s", "viscosity_40"),
        ("drive.quality", 0, "quality"),
    ],
)
def test_what_contradicts_is_refused_with_the_remedy(key: str, value: object, named: str, tmp_path: Path):
    with pytest.raises(InputError, match=named):
        short_case(KIND, tmp_path, **{key.replace(".", "__"): value})


def test_an_oil_without_its_data_sheet_is_refused(tmp_path: Path):
    text = written_template(KIND, tmp_path).read_text(encoding="utf-8")
    begin, end = text.index("[lubricant]"), text.index("[operating]")
    bare = tmp_path / "bare.toml"
    bare.write_text(text[:begin] + text[end:].replace("[operating]", "[operating]", 1), encoding="utf-8")
    with pytest.raises(InputError, match="data sheet"):
        load_scenario(bare, {"lubricant": "liu-ni-2022"})


def test_the_temperature_of_the_teeth_can_be_asked_for_otherwise(tmp_path: Path):
    given = request_of(short_case(KIND, tmp_path, temperature__model="oil").pair)
    absent = request_of(short_case(KIND, tmp_path, assessment__lubrication="spray").pair)
    assert given.tables["temperature"]["model"] == "oil"
    assert absent.tables["temperature"] == {"model": "iso", "lubrication": "spray"}
    assert absent.pinion_speed in absent.speeds
    assert list(absent.speeds) == sorted(absent.speeds)
    with pytest.raises(InputError, match="pinion_oil"):
        short_case(KIND, tmp_path, temperature__model="network")


def test_where_the_radius_vanishes_there_is_no_hertz_contact(tmp_path: Path):
    cycloid = load_scenario("efficiency-cycloidal-23-47")
    assembly = assemble(family(cycloid.family), cycloid.drive)
    start, end = map(float, assembly.roll_limits)
    roll = np.linspace(start, end, 41)
    along = {"roll_angle": roll, "normal_load": np.full(41, 5e3), "hertz_pressure": np.full(41, 0.8e9)}
    figures = {
        "dynamic_factor": 1.2,
        "face_load_factor": 1.0,
        "friction_coefficient_mean": 0.05,
        "bulk_temperature": 360.0,
    }
    local = local_of(short_case(KIND, tmp_path).pair, assembly, along, figures)
    film = local.at_points(local.films.specific_film)
    assert np.isnan(film[POINTS.index("C")])
    assert np.all(np.delete(film, POINTS.index("C")) > 0.0)
    assert local.films.pressure[0] == pytest.approx(0.8e9 * math.sqrt(1.2))
    assert local.films.bulk_temperature == 360.0
    along["normal_load"][:] = 1e9
    with pytest.raises(SimulationError, match="nowhere narrower than"):
        local_of(short_case(KIND, tmp_path).pair, assembly, along, figures)
