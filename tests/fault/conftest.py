from pathlib import Path

import pytest

SCENARIO = """\
title = "a scenario"
kind = "gear-pair"
drive = "liu-ni-involute-23-47"
lubricant = "liu-ni-2022"

[operating]
pinion_speed = "10 rad/s"
gear_torque = "500 N*m"

[mesh]
compliance = "energy"
damping_ratio = 0.05

[friction]
law = "none"

[solver]
cycles = 2
"""


@pytest.fixture
def scenario(tmp_path: Path) -> Path:
    """A sound scenario of the user's own, for mistakes to be put into."""
    path = tmp_path / "mine.toml"
    path.write_text(SCENARIO, encoding="utf-8")
    return path
