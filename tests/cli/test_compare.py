"""`tribodyn compare`: runs and records in one table and in shared pictures; what cannot be compared."""

import json
import shutil
from pathlib import Path

import h5py
import pytest

from tests.support.verbs import complaint, invoke, sets
from tribodyn.record.reader import Record
from tribodyn.studies.pages import names

SHORT = sets("solver.cycles=2")
#: Compared as the records' summaries have them.
KEYS = (
    *("contact_ratio", "transmission_error_peak_to_peak", "normal_load_max", "dynamic_factor", "film_min"),
    *("film_parameter_min", "flash_temperature_max", "friction_coefficient_mean", "efficiency"),
    "power_friction_mean",
)


def compared(*arguments: object) -> dict:
    return json.loads(invoke("compare", *arguments, "--json"))


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict, Path]:
    """CRC against involute, as Liu & Ni compare them, kept in a folder."""
    folder = tmp_path_factory.mktemp("comparison")
    return compared("crc-23-47", "involute-23-47", *SHORT, "-o", folder / "new"), folder / "new"


def test_scenarios_are_run_and_their_records_compared(both):
    result, folder = both
    assert [record["label"] for record in result["records"]] == ["crc-23-47", "involute-23-47"]
    quantities = result["quantities"]
    for number, name in enumerate(("crc-23-47", "involute-23-47")):
        with Record(folder / f"{name}.h5") as record:
            for key in KEYS:
                assert quantities[key]["values"][number] == pytest.approx(record.summary[key])
            loss = 1 - record.summary["efficiency"]
            assert quantities["loss_fraction"]["values"][number] == pytest.approx(loss)
    # what Liu & Ni find: less contact ratio, more film, less loss (figures 13 and 16)
    assert quantities["contact_ratio"]["values"] == pytest.approx([1.523, 1.668], abs=1e-3)
    assert quantities["film_min"]["relative_differences"][0] < -0.1
    assert quantities["loss_fraction"]["relative_differences"][0] > 0.05
    assert result["different_conditions"] == {}


def test_records_and_a_picture_of_every_quantity_are_kept(both):
    result, folder = both
    assert result["kept"] == [str(folder / f"{name}.h5") for name in ("crc-23-47", "involute-23-47")]
    with Record(folder / "crc-23-47.h5") as record:
        drawn = names([record])
    assert "transmission-error" in drawn
    assert [Path(path).name for path in result["pictures"]] == [f"compare-{name}.png" for name in drawn]
    for picture in result["pictures"]:
        assert Path(picture).read_bytes().startswith(b"\x89PNG")


def test_without_a_folder_nothing_is_left_behind(both, tmp_path: Path):
    _, folder = both
    shown = invoke("compare", folder / "crc-23-47.h5", "involute-23-47", *SHORT, folder=tmp_path)
    assert "record " not in shown
    assert list(tmp_path.iterdir()) == []
    for label in ("Contact ratio", "Minimum film parameter", "Loss, share of the power in", "pp"):
        assert label in shown
    assert "are the same in all runs" in shown


def test_runs_at_unequal_load_say_so(both):
    _, folder = both
    lighter = sets("operating.gear_torque=300 N*m")
    result = compared(folder / "crc-23-47.h5", "involute-23-47", *SHORT, *lighter)
    assert result["different_conditions"] == {"operating.gear_torque": ["500 N*m", "300 N*m"]}
    assert result["kept"] == result["pictures"] == []


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["crc-23-47"], "there is nothing to compare it with"),
        (["crc-23-47", "involut-23-47"], 'did you mean "involute-23-47"?'),
        (["crc-23-47", "irefc"], "share no quantities to compare"),
        (["crc-23-47", "crc-23-47"], "given twice"),
        (["crc-23-47", "missing.h5"], "no such file"),
    ],
)
def test_what_cannot_be_compared_is_refused_before_anything_runs(words: list[str], said: str):
    assert said in complaint("compare", *words)


def test_records_that_cannot_be_compared(both, tmp_path: Path):
    first = both[1] / "crc-23-47.h5"
    other = shutil.copy(first, tmp_path / "other.h5")
    assert "given twice" in complaint("compare", first, both[1] / ".." / both[1].name / first.name)
    assert "nothing is run" in complaint("compare", first, other, "--set", "solver.cycles=3")
    with h5py.File(other, "r+") as file:
        file.attrs["status"] = "failed"
    assert "run its scenario again" in complaint("compare", first, other)


def test_a_run_beside_the_quasi_static_study_of_its_drive():
    """Both find the same sliding, so nearly the same loss; the study has no dynamics to show."""
    result = compared("crc-23-47", "efficiency-crc-23-47")
    quantities = result["quantities"]
    run, study = quantities["efficiency"]["values"]
    assert study == pytest.approx(run, abs=1e-3)
    assert quantities["dynamic_factor"]["values"][1] is None
    assert quantities["dynamic_factor"]["relative_differences"] == [None]
    assert list(result["different_conditions"]) == ["kind"]
