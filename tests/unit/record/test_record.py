"""Writing a record: what comes back, names and states, refusals."""

import shutil
import sys
from itertools import count
from pathlib import Path
from types import FrameType

import numpy as np
import pytest

from tests.support.record_samples import block, gear_pair_writer, geometry, mesh_cycle
from tribodyn.errors import InputError
from tribodyn.gears.motion.recorded import DOF
from tribodyn.record.reader import Record
from tribodyn.record.writer import RecordWriter

SCENARIO = 'title = "test"\n[operating]\ngear_torque = "500 N*m"\n'
SUMMARY = {
    "efficiency": 0.98,
    "solver": "dopri5",
    "film": {"min": 1e-7, "ok": True},
    "orders": np.array([1.0, 2.0]),
}


def writer(path: Path, samples: int = 30, **kwargs) -> RecordWriter:
    return gear_pair_writer(
        path, samples, outlines=geometry(), scenario_toml=SCENARIO, sha256="ab" * 32, **kwargs
    )


@pytest.fixture
def record_path(tmp_path: Path) -> Path:
    with writer(tmp_path / "run.h5") as record:
        record.write(0, block(0, 20))
        record.write(20, block(20, 30))
        return record.finish(SUMMARY)


def test_head_comes_back(record_path: Path):
    with Record(record_path) as record:
        assert record.scenario["operating"]["gear_torque"] == "500 N*m"
        assert record.attrs["scenario_sha256"] == "ab" * 32
        assert {"tribodyn_version", "created", "numpy_version", "format_version"} <= record.attrs.keys()
        assert record.pairs == (0, 1)
        assert tuple(record["dof"]) == DOF
        assert record.units("normal_load") == "N"
        assert record.long_name("normal_load") == "normal load of the pair"


def test_summary_comes_back_nested(record_path: Path):
    with Record(record_path) as record:
        summary = dict(record.summary)
        np.testing.assert_array_equal(summary.pop("orders"), [1.0, 2.0])
        assert summary == {"efficiency": 0.98, "solver": "dopri5", "film": {"min": 1e-7, "ok": True}}


def test_tables_come_back(record_path: Path):
    with Record(record_path) as record:
        for found, given in ((record.mesh_cycle, mesh_cycle()), (record.geometry, geometry())):
            assert found.keys() == given.keys()
            for name, value in given.items():
                np.testing.assert_array_equal(found[name], value, err_msg=name)


def test_pairs_are_numbered_from_the_newest(tmp_path: Path):
    table = mesh_cycle(sides=[1.0, 1.0, 1.0, -1.0, -1.0])
    with gear_pair_writer(tmp_path / "run.h5", 1, table=table) as record:
        record.write(0, block(0, 1, pairs=5))
        path = record.finish({})
    with Record(path) as record:
        assert record.pairs == (-1, 0, 1, 2, 3)


def test_the_name_appears_only_when_complete(tmp_path: Path):
    with writer(tmp_path / "run.h5") as record:
        record.write(0, block(0, 10))
        assert {file.name for file in tmp_path.iterdir()} == {"run.partial.h5", "run.partial.lock"}
        with Record(tmp_path / "run.partial.h5") as running:
            assert running.status == "partial"
            np.testing.assert_array_equal(running["time"], np.arange(10.0))
            assert np.isnan(running._file["time"][10:]).all()
        record.write(10, block(10, 30))
        record.finish(SUMMARY)
    assert [file.name for file in tmp_path.iterdir()] == ["run.h5"]


@pytest.mark.parametrize("samples", [7, 0])
def test_a_failed_run_is_trimmed_and_says_why(tmp_path: Path, samples: int):
    with writer(tmp_path / "run.h5") as record:
        record.write(0, block(0, samples))
        path = record.fail("stopped at t = 7 s: step too small", {"steps": 12})
    assert [file.name for file in tmp_path.iterdir()] == ["run.partial.h5"]
    with Record(path) as failed:
        assert (failed.status, failed.message) == ("failed", "stopped at t = 7 s: step too small")
        assert failed.summary == {"steps": 12}
        expected = block(0, samples)
        for name in failed:
            assert failed._file[name].shape[0] == failed.samples == samples
            np.testing.assert_array_equal(failed[name], expected[name], err_msg=name)


def test_an_exception_marks_the_record_failed(tmp_path: Path):
    def run() -> None:
        with writer(tmp_path / "run.h5") as record:
            record.write(0, block(0, 7))
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        run()
    with Record(tmp_path / "run.partial.h5") as failed:
        assert (failed.status, failed.samples) == ("failed", 7)
        assert "ZeroDivisionError" in failed.message


def interrupted(at: int, path: Path) -> KeyboardInterrupt | None:
    """Write a record, and interrupt that where the file begins or ends to be, at one line after another."""
    lines = count()

    def trace(frame: FrameType, event: str, _: object) -> object:
        if frame.f_code not in (RecordWriter.__enter__.__code__, RecordWriter.finish.__code__):
            return None if frame.f_code.co_name != "replacing" else trace
        if event == "line" and next(lines) == at:
            raise KeyboardInterrupt
        return trace

    sys.settrace(trace)
    try:
        with writer(path) as record:
            record.write(0, block(0, 30))
            record.finish(SUMMARY)
    except KeyboardInterrupt as error:
        return error
    finally:
        sys.settrace(None)
    return None


def test_an_interruption_says_what_there_is(tmp_path: Path):
    """Nothing is there and nothing is said, or the file that is said is there, and no lock."""
    path, found = tmp_path / "run.h5", set()
    for at in count():
        error = interrupted(at, path)
        if error is None:
            break
        said = " ".join(getattr(error, "__notes__", ())).replace(str(tmp_path / "run"), "")
        found.add((said, *sorted(file.name for file in tmp_path.iterdir())))
        for file in tmp_path.iterdir():
            file.unlink()
    assert found == {
        ("",),
        ("the first 30 of 30 samples: .partial.h5", "run.partial.h5"),
        ("the first 30 of 30 samples: .partial.h5", "run.h5", "run.partial.h5"),  # renamed this moment
        ("the record is complete: .h5", "run.h5"),
    }


def test_out_of_contact_is_marked_in_the_range_flag(tmp_path: Path):
    samples = block(0, 2) | {"closure_in_range": np.array([[1.0, 0.0], [np.nan, 1.0]])}
    with writer(tmp_path / "run.h5", samples=2) as record:
        record.write(0, samples)
        path = record.finish({})
    with Record(path) as found:
        np.testing.assert_array_equal(found["closure_in_range"], [[1, 0], [-1, 1]])


def test_force_replaces_a_record_only_when_the_new_one_is_complete(record_path: Path):
    before = record_path.read_bytes()
    with writer(record_path, samples=5, force=True) as record:
        record.write(0, block(0, 5))
        assert record_path.read_bytes() == before
        record.finish({})
    with Record(record_path) as found:
        assert found.samples == 5


def test_a_refusal_of_the_file_system_is_bad_input(tmp_path: Path):
    with pytest.raises(InputError, match="cannot be written"), writer(tmp_path / ("n" * 300 + ".h5")):
        pass
    assert list(tmp_path.iterdir()) == []


def test_programming_errors_are_not_hidden(tmp_path: Path):
    with writer(tmp_path / "run.h5") as record:
        with pytest.raises(ValueError, match="does not follow"):
            record.write(3, block(3, 5))
        with pytest.raises(ValueError, match="does not follow"):
            record.write(0, block(0, 31))
        with pytest.raises(KeyError, match="nonsense"):
            record.write(0, block(0, 2) | {"nonsense": np.zeros(2)})
        with pytest.raises(ValueError, match="normal_load: shape"):
            record.write(0, block(0, 2) | {"normal_load": np.zeros((2, 3))})
        assert record.written == 0
        with pytest.raises(ValueError, match="0 of 30 samples"):
            record.finish({})


def test_a_record_can_be_copied_and_read_while_it_is_written(tmp_path: Path):
    with writer(tmp_path / "run.h5") as record:
        record.write(0, block(0, 10))
        shutil.copy(record.partial, tmp_path / "copy.h5")
        with Record(record.partial) as running:
            record.write(10, block(10, 20))
            assert running.samples in (10, 20)
        record.fail("enough")
    with Record(tmp_path / "copy.h5") as copy:
        np.testing.assert_array_equal(copy["time"], np.arange(10.0))
