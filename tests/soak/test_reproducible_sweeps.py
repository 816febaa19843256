"""The same bits whatever the order, the chunks, the workers, the part of the range and the kills."""

import random
from pathlib import Path

import numpy as np
import pytest

from tests.support.killed_sweeps import ENGINES, MOVING_ERROR, WAYS, differences, killed_until_done, swept
from tribodyn.record.sweep_reader import SweepRecord

pytestmark = pytest.mark.soak

#: What is swept beside a light drive about its resonance with a moving error: 81 speeds.
SPEEDS = "operating.pinion_speed=300:620:4rad/s"
WORDS = ("jump-involute-23-47", "--set", MOVING_ERROR, "--set", "output.samples_per_cycle=64")


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory):
    """(way) -> record of a sweep that nothing stopped, all cases in one chunk."""
    folder, made = tmp_path_factory.mktemp("alone"), {}

    def record(way: str) -> Path:
        if way not in made:
            made[way] = folder / f"{way}.h5"
            swept((*WORDS, "--vary", SPEEDS, *WAYS[way], "--workers", "1"), made[way], 256)
        return made[way]

    return record


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("way", WAYS)
def test_kills_change_no_bit(way: str, engine: str, alone, tmp_path: Path):
    words = (*WORDS, "--vary", SPEEDS, *WAYS[way], *ENGINES[engine])
    draw = random.Random(f"{way} {engine}")
    kills = killed_until_done(words, tmp_path / "killed.h5", draw.randint(1, 5), draw)
    print(f"{way}, {engine}: {kills} kills")
    assert kills >= 2
    assert differences(tmp_path / "killed.h5", alone(way)) == []


@pytest.mark.parametrize("way", ["steady", "transient"])
@pytest.mark.parametrize("part", ["620:300:-4", "460:540:4", "500:500/2", "300:620:20"])
def test_a_part_of_the_range_gives_its_cases(way: str, part: str, alone, tmp_path: Path):
    part = "500,300" if part == "500:500/2" else part
    vary = f"operating.pinion_speed={part}rad/s"
    swept((*WORDS, "--vary", vary, *WAYS[way], "--workers", "2"), tmp_path / "part.h5", 7)
    with SweepRecord(tmp_path / "part.h5") as some, SweepRecord(alone(way)) as every:
        rows = [int(np.argmin(np.abs(every["pinion_speed"] - speed))) for speed in some["pinion_speed"]]
        for name in set(some) & set(every):
            if len(some[name]) == len(rows) and name != "pinion_speed":
                assert some[name].tobytes() == every[name][rows].tobytes(), name


def test_the_motion_at_500_rad_s(alone):
    """A start that belongs to another speed leads to the other motion, of six times the size."""
    with SweepRecord(alone("steady")) as record:
        at = int(np.argmin(np.abs(record["pinion_speed"] - 500.0)))
        assert record["transmission_error_peak_to_peak"][at] == pytest.approx(12.1e-6, rel=0.01)
