"""Data sets by sweeps: what is said of the cases, signals beside those of a run, what is refused."""

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
import tomli_w
import xarray

import tribodyn as td
from tests.support.killed_sweeps import differences
from tests.support.verbs import complaint, invoke
from tribodyn.grid.data_set import TEST, TRAIN, data_set_of
from tribodyn.grid.engines import LocalEngine, evaluate
from tribodyn.grid.grid import Grid
from tribodyn.grid.run import run, settings_of
from tribodyn.record.reader import Record
from tribodyn.record.sensors import read_sensed
from tribodyn.record.sweep_schema import DONE
from tribodyn.studies.protocol.batch import Chunk

PAIR = {
    "title": "Sound and damaged gears",
    "kind": "gear-pair",
    "drive": {"like": "diez-ibarbia-18-36", "quality": 5},
    "lubricant": "liu-ni-2022",
    "operating": {"pinion_speed": "1500 rpm", "gear_torque": "200 N*m"},
    "mesh": {"damping_ratio": 0.05, "tooth_sample": 1},
    "friction": {"law": "coulomb", "coefficient": 0.05},
    "film": {"law": "masjedi-khonsari"},
    "damage": [
        {"gear": "pinion", "tooth": 5, "kind": "crack", "depth": "2 mm"},
        {"gear": "gear", "tooth": 7, "kind": "broken-tip", "height": 0.9},
    ],
    "sensor": [
        {"name": "a", "kind": "acceleration", "at": "gear", "direction": "y", "rate": "10 kHz"},
        {"name": "e", "kind": "transmission-error", "rate": "10 kHz"},
    ],
}
NOISY = {
    **PAIR,
    "sensor": [{**PAIR["sensor"][0], "noise": "1 m/s**2"}],
}
SHORT = ("--signals", "0.05s", "--run-in", "1", "--seed", "3")
VARY = (
    *("--vary", "mesh.tooth_sample=1,2,3,4", "--vary", "damage=none,1,2"),
    *("--vary", "operating.gear_torque=100,200N*m"),
)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("set")
    (folder / "pair.toml").write_text(tomli_w.dumps(NOISY), encoding="utf-8")
    words = ["sweep", str(folder / "pair.toml"), *SHORT, *VARY, "-o", str(folder / "set.h5")]
    invoke(*words)
    return folder


@pytest.fixture
def data(made: Path):
    with xarray.open_dataset(made / "set.h5", engine="h5netcdf") as found:
        yield found


def test_every_case_has_its_signal_and_what_made_it(data):
    assert dict(data.sizes) == {"case": 24, "time": 500, "line": 4}
    assert data["a"].dims == ("case", "time")
    assert np.all(np.isfinite(data["a"]))
    assert np.diff(data["time"]) == pytest.approx(1e-4)
    assert {"tooth_sample", "gear_torque", "label", "split", "drive"} <= set(data.coords)
    torques = data["gear_torque"]
    assert torques.attrs["units"] == "N*m"
    assert sorted(set(torques.values.tolist())) == [100.0, 200.0]
    for name, variable in data.variables.items():
        assert {"units", "long_name"} <= set(variable.attrs), name
    assert data.attrs["license"]
    assert data.attrs["sampling_rate"] == 10_000.0


def test_labels_are_the_damage_of_each_case(data):
    label, tooth = data["label"].values, data["damage_tooth"].values
    assert {*label.tolist()} == {"none", "crack", "broken-tip"}
    assert np.all(tooth[label == "crack"] == 5)
    assert np.all(tooth[label == "none"] == 0)
    assert data["damage_size"].values[label == "crack"] == pytest.approx(2e-3)
    assert np.all(data["damage_gear"].values[label == "broken-tip"] == "gear")


def test_the_split_is_by_drive(data):
    sides = [set(data["split"].values[data["drive"].values == drive]) for drive in np.unique(data["drive"])]
    assert len(sides) == 4
    assert all(len(side) == 1 for side in sides)
    assert set.union(*sides) == {TRAIN, TEST}
    assert np.all(data["drive"].values == data["tooth_sample"].values - 1)


def test_lines_are_the_frequencies_of_shafts_and_mesh(data):
    lines = dict(zip(data["line"].values, data["line_frequency"].values[0], strict=True))
    assert lines["pinion"] == pytest.approx(25.0)
    assert lines["mesh"] == pytest.approx(18 * 25.0)
    assert lines["gear"] == pytest.approx(12.5)


def test_starts_and_noise_are_drawn_for_every_case(data):
    start, turn = data["start_time"].values, 1.0 / 25.0
    assert np.all((start >= turn) & (start <= 2.0 * turn + 4e-3))
    assert len(np.unique(np.round(start, 6))) > 20
    assert len(np.unique(data["noise_seed"])) == 24


class StoppedError(Exception):
    pass


class Stopping(LocalEngine):
    """Evaluates five cases of a chunk, and is stopped."""

    def __call__(self, kind: str, chunks: Any, settings: Any):
        for chunk in chunks:
            part = Chunk(chunk.numbers[:5], chunk.cases[:5])
            yield part, evaluate(kind, part, settings)
            raise StoppedError


def test_it_goes_on_to_the_same_bits(made: Path, tmp_path: Path):
    asked = data_set_of("0.05 s", run_in=1.0, seed=3)
    assert asked
    grid = Grid(str(made / "pair.toml"), list(VARY[1::2]), {}).hearing(asked.signals)
    output = tmp_path / "set.h5"
    with pytest.raises(StoppedError):
        run(grid, settings_of(grid), Stopping(), output, data_set=asked)
    with h5py.File(tmp_path / "set.partial.h5") as file:
        assert np.sum(file["status"][...] == DONE) == 5  # pyright: ignore
    run(grid, settings_of(grid), LocalEngine(1), output, resume=True, data_set=asked)
    assert differences(made / "set.h5", output) == []


def test_the_signal_is_that_of_a_run(tmp_path: Path):
    """Of the same case run alone: other samples of the motion, other steps, the same sensor.

    What the motion has above half of its samples in a second folds back: 0.5 % of an acceleration at 10 kHz.
    """
    changes = {"operating.gear_torque": "200 N*m", "damage": [], "mesh.tooth_sample": 2}
    vary = {"mesh.tooth_sample": "2", "damage": "none"}
    swept = td.sweep(PAIR, vary, signals="0.05 s", run_in=1, output=tmp_path / "set.h5", progress=False)
    finer = {"solver.revolutions": 4.0, "output.samples_per_cycle": 240}
    run = td.run(PAIR, changes | finer, output=tmp_path / "run.h5", progress=False)
    with Record(run.path) as record:
        sensed = read_sensed(record)
    for name in ("a", "e"):
        signal = sensed[name]
        first = int(np.argmin(np.abs(signal.time - swept["start_time"].item())))
        assert signal.time[first] == pytest.approx(swept["start_time"].item(), abs=1e-9)
        there = signal.values[first : first + 500]
        assert np.std(swept[name].values[0] - there) < 1e-2 * np.std(there)
        turned = signal.angle[first : first + 500] - signal.angle[first]
        assert swept["reference_angle"].values[0] == pytest.approx(turned, abs=1e-5)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--transient", "4"), "contradicts --signals"),
        (("--engine", "jax"), "native solver"),
        (("--direction", "up"), "contradicts --signals"),
        (("--test", "1.5"), "a share"),
        (("--run-in", "-1"), "turns"),
        (("--signals", "1ms"), "too short"),
        (("--vary", "damage=none,3"), "there are 2 [[damage]]"),
        (("--set", "sensor.0.rate=500Hz"), "mesh frequency"),
    ],
)
def test_what_is_no_data_set_is_refused(made: Path, words: tuple[str, ...], said: str):
    begun = ["sweep", str(made / "pair.toml"), "--signals", "0.05s", "-o", str(made / "x.h5")]
    message = complaint(*begun, *words, "--vary", "mesh.tooth_sample=1,2")
    assert said in message


def test_a_slow_case_between_fast_ones_is_sampled_as_finely(made: Path):
    """The ends of the axis are 1500 and 1600 rpm: what a cycle of 300 rpm needs is five times as much."""
    speeds = {"operating.pinion_speed": "1500,300,1600rpm"}
    how = {"signals": "0.05 s", "run_in": 1, "progress": False}
    several = td.sweep(made / "pair.toml", speeds, {"damage": []}, **how)
    assert several["status"].values.tolist() == [1, 1, 1]
    assert np.all(np.isfinite(several["a"]))


def test_a_set_needs_sensors_and_a_motion():
    vary = ("--vary", "operating.gear_torque=100,200N*m")
    assert "[[sensor]]" in complaint("sweep", "crc-23-47", "--signals", "1s", *vary)
    assert "no sensors" in complaint("sweep", "efficiency-crc-23-47", "--signals", "1s", *vary)
    assert "unit" in complaint("sweep", "crc-23-47", "--signals", "1", *vary)


def test_steady_states_of_teeth_that_differ_are_refused(made: Path):
    message = complaint("sweep", str(made / "pair.toml"), "--vary", "mesh.tooth_sample=1,2")
    assert "--transient 360" in message
    assert "--signals" in message


def test_a_transient_of_teeth_that_differ_does_not_depend_on_the_cycles_of_a_run(made: Path):
    """Numbers of teeth go on as long as it is marched; means are of a turn of the slowest gear."""
    vary = {"mesh.tooth_sample": [1, 2]}
    one, two = (
        td.sweep(made / "pair.toml", vary, {"solver.cycles": cycles}, transient=144, progress=False)
        for cycles in (4, 500)
    )
    assert np.array_equal(one["transmission_error_rms"], two["transmission_error_rms"])
    assert one.sizes["sample"] == 36 * 200


def test_it_is_shown_and_drawn(made: Path, tmp_path: Path):
    shown = invoke("show", str(made / "set.h5"))
    assert "8 none" in shown
    assert "8 crack" in shown
    assert "by drive" in shown
    invoke("plot", str(made / "set.h5"), "-o", str(tmp_path))
    assert list(tmp_path.glob("*signals*"))
    assert "no page" in complaint("report", str(made / "set.h5"), "-o", str(tmp_path / "x.html"))
    opened = td.open(made / "set.h5")
    assert opened.data["label"].dims == ("case",)
    assert "set.h5" in repr(opened)
    assert opened._repr_html_()
