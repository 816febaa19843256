"""Runs of wear studies: going on, what lies beside the record, worn flanks in other studies."""

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tribodyn as td
from tests.support.worn_pairs import COEFFICIENT, DRY, OILED
from tribodyn.cases.results import writer
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import load_data
from tribodyn.studies.protocol.run import run
from tribodyn.studies.wear.case import layout_of
from tribodyn.studies.wear.run import _beside, _code_of, prepare

ROWS = {"output.every": 5e5, "output.positions_per_cycle": 20}
EACH = {
    **DRY,
    "drive": {"like": DRY["drive"], "gear": {"modification": {"pitch_errors": ["2 um", *["0 um"] * 35]}}},
}


def case_of(table: dict[str, Any], revolutions: float, **more: Any):
    keys = {name.replace("__", "."): value for name, value in more.items()}
    return load_data(table, "worn", ROWS | {"wear.revolutions": revolutions} | keys).case


@pytest.mark.parametrize(
    ("table", "more"),
    [
        (DRY, {}),
        (OILED, {"wear__law": "priest-taylor"}),
        (EACH, {"wear__teeth": "each"}),
    ],
)
def test_a_run_that_goes_on_is_one_long_run(table, more, tmp_path: Path):
    """To the last digit, where the rows of the shorter one are among those of the longer."""
    whole = run(case_of(table, 2e6, **more), tmp_path / "whole.h5")
    path = tmp_path / "worn.h5"
    run(case_of(table, 1e6, **more), path)
    again = run(case_of(table, 2e6, **more), path, resume=True)
    assert again.status == "complete"
    with Record(whole.path) as expected, Record(path) as found:
        assert list(found) == list(expected)
        for name in expected:
            np.testing.assert_array_equal(found[name], expected[name], err_msg=name)
        assert found.scenario["wear"]["revolutions"] == 2e6


@pytest.mark.parametrize("revolutions", [1e6, 5e5], ids=["all rows", "fewer"])
def test_a_run_that_has_all_its_rows_is_concluded(revolutions: float, tmp_path: Path):
    """As after a full disk at its end, or with an end that falls on a row: as a run that began anew."""
    whole = run(case_of(OILED, revolutions), tmp_path / "whole.h5")
    path = tmp_path / "worn.h5"
    run(case_of(OILED, 1e6), path).path.rename(tmp_path / "worn.partial.h5")
    for profile in tmp_path.glob("worn-*.csv"):
        profile.unlink()
    again = run(case_of(OILED, revolutions), path, resume=True)
    assert again.status == "complete"
    with Record(whole.path) as expected, Record(path) as found:
        assert found.attrs.keys() == expected.attrs.keys()
        for name in expected:
            np.testing.assert_array_equal(found[name], expected[name], err_msg=name)
        varying = {"wall_time": 0.0, "files": {}}
        np.testing.assert_equal(found.summary | varying, expected.summary | varying)


def _law(coefficient: float, numbers: "np.ndarray | None" = None):
    """A law of one name, whose coefficient lies outside its code."""

    def law(contact, parameters):
        more = 0.0 if numbers is None else numbers[0]
        return (coefficient + more) * (1.0 + 0.0 * contact.hertz_pressure)

    return law


def test_it_goes_on_under_the_same_law_alone(tmp_path: Path):
    """A law from Python is known by its code and what that refers to; arrays could have changed."""
    path = tmp_path / "worn.h5"
    run(case_of(DRY, 1e6), path, wear=_law(1e-17))
    before = path.read_bytes()
    with pytest.raises(InputError, match="computed by other code"):
        run(case_of(DRY, 2e6), path, wear=_law(2e-17), resume=True)
    assert path.read_bytes() == before
    assert run(case_of(DRY, 2e6), path, wear=_law(1e-17), resume=True).status == "complete"
    run(case_of(DRY, 1e6), path, wear=_law(1e-17, np.zeros(1)), force=True)
    with pytest.raises(InputError, match="depends on data") as error:
        run(case_of(DRY, 2e6), path, wear=_law(1e-17, np.ones(1)), resume=True)
    assert error.value.key == "--resume"


def test_it_goes_on_from_its_own_scenario_alone(tmp_path: Path):
    path = tmp_path / "worn.h5"
    run(case_of(DRY, 1e6), path)
    before = path.read_bytes()
    for other in ({"operating__gear_torque": "300 N*m"}, {"wear__coefficient": "1e-18 m**2/N"}):
        with pytest.raises(InputError, match="made from another scenario") as error:
            run(case_of(DRY, 2e6, **other), path, resume=True)
        assert error.value.key == "--resume"
    with pytest.raises(InputError, match="reaches 1e\\+06 revolutions already") as error:
        run(case_of(DRY, 1e6), path, resume=True)
    assert error.value.key == "wear.revolutions"
    assert path.read_bytes() == before


def test_a_study_without_a_record_to_go_on_from_begins(tmp_path: Path):
    assert run(case_of(DRY, 1e6), tmp_path / "worn.h5", resume=True).status == "complete"


def test_a_run_that_was_stopped_before_its_first_row_begins(tmp_path: Path):
    case, path = case_of(DRY, 1e6), tmp_path / "worn.h5"
    how = {"code": _code_of(case), **_beside(prepare(case))}
    with pytest.raises(KeyboardInterrupt), writer(case, path, layout_of(case), 3, **how):
        raise KeyboardInterrupt
    assert (tmp_path / "worn.partial.h5").exists()
    assert run(case, path, resume=True).status == "complete"


def test_helical_teeth_are_checked_at_their_normal_load():
    """T/(r_b cos β_b) over the face."""
    drive = {"like": DRY["drive"], "helix_angle": "20 deg"}
    case = case_of({**DRY, "drive": drive}, 1e6)
    gears, width = case.drive, float(min(case.drive.pinion.face_width, case.drive.gear.face_width))
    base_radius = gears.module * gears.gear.teeth / 2.0 * math.cos(gears.pressure_angle)  # all transverse
    base_helix = math.atan(math.tan(gears.helix_angle) * math.cos(gears.pressure_angle))
    load = case.operating.gear_torque / (base_radius * math.cos(base_helix))
    stiffness = STUDIES["wear"].check(case).data["stiffness"]
    assert stiffness["line_load"] == pytest.approx(load / width, rel=1e-9)


@pytest.mark.parametrize("shown", ["load-contact", "gear-pair", "efficiency"])
def test_worn_profiles_are_read_by_other_studies(shown: str, tmp_path: Path, monkeypatch):
    """A load contact study with them has the error that the wear study ends with."""
    monkeypatch.chdir(tmp_path)
    result = run(case_of(DRY, 2e6, output__positions_per_cycle=120), tmp_path / "worn.h5")
    errors = {
        f"drive.{body}.modification.profile_error": str(tmp_path / f"worn-{body}.csv")
        for body in ("pinion", "gear")
    }
    base: dict[str, Any] = {
        "title": "Worn flanks",
        "kind": shown,
        "drive": DRY["drive"],
        "operating": DRY["operating"],
    }
    match shown:
        case "load-contact":
            ended = td.run(base, {**errors, "output.positions_per_cycle": 120}, output="other.h5")
            name = "loaded_transmission_error_peak_to_peak"
            assert ended.summary[name] == pytest.approx(result.summary[name], rel=5e-3)
            unworn = result.summary[f"{name}_unworn"]
            assert abs(result.summary[name] - unworn) > 0.05 * unworn
        case "efficiency":
            more = {"lubricant": "iso-vg-220-mineral", "friction": {"law": "coulomb", "coefficient": 0.05}}
            base |= more | {"mesh": {"compliance": "fem"}}
            oil = {"operating.oil_temperature": "80 degC", "output.samples_per_cycle": 60}
            ended = td.run(base, {**errors, **oil}, output="other.h5")
            assert 0.99 < ended.summary["efficiency"] < 1.0
        case _:
            ended = td.run("involute-18-36-fem", {**errors, "solver.cycles": 2}, output="other.h5")
            assert ended.status == "complete"
            unworn = td.run("involute-18-36-fem", {"solver.cycles": 2}, output="unworn.h5")
            name = "transmission_error_peak_to_peak"
            assert abs(ended.summary[name] / unworn.summary[name] - 1.0) > 0.01


def test_worn_profiles_lie_beside_the_record(tmp_path: Path):
    """Depth of either gear over the roll angle; replaced by a run, but no file of somebody else."""
    path = tmp_path / "worn.h5"
    result = run(case_of(DRY, 1e6, mesh__slices=3, mesh__misalignment__in_plane="1 arcmin"), path)
    assert list(result.summary["files"]) == ["pinion", "gear"]
    with Record(path) as record:
        for place, name in enumerate(("pinion", "gear")):
            lines = (tmp_path / f"worn-{name}.csv").read_text(encoding="utf-8").splitlines()
            assert lines[0].startswith("# written by tribodyn")
            table = np.array([[float(cell) for cell in row] for row in csv.reader(lines[2:])])
            np.testing.assert_allclose(np.radians(table[:, 0]), record["roll"], rtol=1e-12)
            mean = record["worn_depth"][-1, place].mean(axis=-1)
            np.testing.assert_allclose(1e-6 * table[:, 1], mean, rtol=1e-12)
    run(case_of(DRY, 1e6), path, force=True)
    (tmp_path / "mine-pinion.csv").write_text("roll_angle [deg],error [um]\n0,0\n", encoding="utf-8")
    with pytest.raises(InputError, match="tribodyn did not make it"):
        run(case_of(DRY, 1e6), tmp_path / "mine.h5")
    assert not (tmp_path / "mine.h5").exists()


def test_a_flank_that_is_worn_away_ends_the_run(tmp_path: Path):
    """What was worn before is kept, and the reason said."""
    result = run(case_of(DRY, 1e9, output__every=1e8), tmp_path / "worn.h5")
    assert result.status == "failed"
    assert "more than a tenth of the module" in result.message
    with Record(result.path) as record:
        assert record.samples >= 2
        assert record.summary["pinion_worn_depth_max"] > 1e-5


def test_a_record_says_what_it_holds(tmp_path: Path):
    oiled = run(case_of(OILED, 1e6), tmp_path / "oiled.h5")
    each = run(case_of(EACH, 1e6, wear__teeth="each"), tmp_path / "each.h5")
    with Record(oiled.path) as record:
        assert record.axis == "revolutions"
        np.testing.assert_allclose(record["revolutions"], [0.0, 5e5, 1e6])
        np.testing.assert_allclose(record["time"], record["revolutions"] / 2.5, rtol=1e-12)  # 150 rpm
        assert record["worn_depth"].shape == (3, 2, len(record["roll"]), 1)
        assert "pinion_tooth_depth" not in record
        volume = record["worn_volume"][-1]
        np.testing.assert_allclose(record["worn_mass"][-1], volume * 7850.0, rtol=0.02)
        # debris is what the mass grows by
        grown = np.diff(record["worn_mass"].sum(axis=1)) / np.diff(record["time"])
        mean = (record["debris_rate"][1:] + record["debris_rate"][:-1]) / 2.0
        np.testing.assert_allclose(mean, grown, rtol=5e-3)
        assert np.nanmin(record["central_film_thickness"]) >= record["film_min"].min()
    with Record(each.path) as record:
        assert record["pinion_tooth_depth"].shape[1:2] == (18,)
        mean = record["gear_tooth_depth"].mean(axis=1)
        np.testing.assert_allclose(record["worn_depth"][:, 1], mean, rtol=1e-12)
        assert record["loaded_transmission_error"].shape[1] == 36
        assert "film_min" not in record


@pytest.mark.parametrize("positions", [12, 40])
def test_what_corners_slide_is_what_the_loss_has_beyond_the_volume(positions: int, tmp_path: Path):
    """With one k and one μ a flank would lose k P/μ, were the corners of tips to wear too."""
    table = DRY | {"friction": {"law": "coulomb", "coefficient": 0.05}}
    case = case_of(table, 1.0, output__positions_per_cycle=positions)
    with Record(run(case, tmp_path / "worn.h5").path) as record:
        volume = float(record["worn_volume"][-1, 0]) / float(record["time"][-1])
        slid, share = record.summary["power_friction_mean"] / 0.05, record.summary["corner_sliding_share"]
    assert share == pytest.approx(1.0 - volume / (COEFFICIENT * slid), abs=1e-6)
    assert share == pytest.approx(0.078, abs=0.008)  # that of many positions
