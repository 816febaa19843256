"""The same bits whatever the order, the chunks, the workers, the part of the range and the kills."""

import random
from pathlib import Path

import numpy as np
import pytest

from tests.support.killed_sweeps import ENGINES, MOVING_ERROR, WAYS, differences, killed_until_done, swept
from tribodyn.record.sweep_reader import SweepRecord

pytestmark = pytest.mark.soak

#: A light drive about its resonance with a moving error: 81 speeds whose motions mostly repeat, and 81 over a
#: range in which most are chaotic, so that a last bit that differs anywhere grows.
SPEEDS = "operating.pinion_speed=460:492:0.4rad/s"
WHOLE = "operating.pinion_speed=300:620:4rad/s"
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
@pytest.mark.parametrize("part", ["492:460:-0.4", "480:492:0.4", "488,462", "460:492:8"])
def test_a_part_of_the_range_gives_its_cases(way: str, part: str, alone, tmp_path: Path):
    vary = f"operating.pinion_speed={part}rad/s"
    swept((*WORDS, "--vary", vary, *WAYS[way], "--workers", "2"), tmp_path / "part.h5", 7)
    with SweepRecord(tmp_path / "part.h5") as some, SweepRecord(alone(way)) as every:
        rows = [int(np.argmin(np.abs(every["pinion_speed"] - speed))) for speed in some["pinion_speed"]]
        for name in set(some) & set(every):
            if len(some[name]) == len(rows) and name != "pinion_speed":
                there = every[name][rows]  # texts are as wide as the longest of all cases
                assert some[name].astype(there.dtype).tobytes() == there.tobytes(), name


def test_kills_change_no_bit_where_motions_are_chaotic(tmp_path: Path):
    words = (*WORDS, "--vary", WHOLE)
    swept((*words, "--workers", "1"), tmp_path / "alone.h5", 256)
    kills = killed_until_done((*words, "--workers", "2"), tmp_path / "killed.h5", 4, random.Random(500))
    assert kills >= 2
    assert differences(tmp_path / "killed.h5", tmp_path / "alone.h5") == []
