"""Branches that a sweep continues beyond their ends: recorded, shown, drawn; and where that is refused."""

import json
from pathlib import Path

import numpy as np
import pytest

from tests.support.killed_sweeps import differences
from tests.support.verbs import complaint, invoke
from tribodyn.record.sweep_reader import SweepRecord

SPEEDS = "operating.pinion_speed=440:490:25rad/s"
SWEEP = ("sweep", "jump-involute-23-47", "--vary", SPEEDS, "--direction", "up", "--unstable")
SWEEP += ("--set", "output.samples_per_cycle=20")


@pytest.fixture(scope="module")
def jump(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("unstable") / "jump.h5"
    said = invoke(*SWEEP, "--workers", "2", "-o", path, "--json")
    path.with_suffix(".json").write_text(said, encoding="utf-8")
    return path


def test_the_record_holds_the_branch_from_the_fold_to_the_border(jump: Path):
    with SweepRecord(jump) as record:
        ((case, direction, end),) = np.argwhere(record["end_kind"] > 0)
        at = case, direction, end
        assert case == 2
        assert record.meanings("end_kind")[int(record["end_kind"][at])] == "fold"
        speed = record["unstable_value"][at]
        there = np.isfinite(speed)
        assert record.units("unstable_value") == "rad/s"
        assert speed[0] == pytest.approx(record["end_value"][at], rel=1e-4)
        assert speed[there][-1] == pytest.approx(440.0)
        assert np.all(np.diff(speed[there]) < 0.0)
        assert np.all(record["unstable_multiplier_modulus"][at][there] > 1.0)
        assert np.all(record["unstable_residual"][at][there] <= 1e-7)
        assert record["unstable_period"][at] == 1
        # between the motions on the lower and on the upper branch, the one on it before and after the jump
        rms = record["unstable_transmission_error_rms"][at][there]
        assert np.all(rms > record["transmission_error_rms"][1, 0])
        assert np.all(np.diff(rms) > 0.0)
        section = record["unstable_poincare_error"][at][there]
        assert np.all(np.isfinite(section[:, 0]))
        assert np.all(np.isnan(section[:, 1:]))
        assert np.all(np.isnan(record["unstable_value"][:2]))


def test_it_is_said_and_drawn(jump: Path, tmp_path: Path):
    said = json.loads(jump.with_suffix(".json").read_text(encoding="utf-8"))
    (end,) = said["ends"]
    assert end["unstable"]["period"] == 1
    assert end["unstable"]["from"] == pytest.approx(440.0)
    assert end["unstable"]["multiplier_modulus_max"] > 1.5
    shown = invoke("show", jump)
    assert "beyond, period 1 unstable between 4201.7 rpm and 462" in " ".join(shown.split())
    said = json.loads(invoke("plot", jump, "response", "bifurcation", "-o", tmp_path, "--json"))
    assert all(Path(picture).stat().st_size > 10_000 for picture in said["pictures"])


@pytest.mark.soak
def test_one_worker_gives_the_same_bits_as_two(jump: Path, tmp_path: Path):
    invoke(*SWEEP, "--workers", "1", "-o", tmp_path / "single.h5")
    assert differences(tmp_path / "single.h5", jump) == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("crc-23-47", "--vary", SPEEDS), "continues the branches that --direction follows"),
        (("crc-23-47", "--vary", SPEEDS, "--direction", "up", "--transient", "4"), "steady motions"),
        (
            ("involute-23-47", "--vary", "drive.pinion.profile_shift=0:0.2:0.1", "--direction", "up"),
            "needs a table of the mesh of its own",
        ),
        (("efficiency-crc-23-47", "--vary", "operating.pinion_speed=100:300:100rad/s"), "do not go on"),
    ],
)
def test_where_there_is_no_branch_it_is_refused(words: tuple[str, ...], message: str, tmp_path: Path):
    assert message in complaint("sweep", *words, "--unstable", "-o", tmp_path / "s.h5")
    assert not list(tmp_path.iterdir())
