"""Names, folders and windows that nobody expects: one message, or a result without what there is not."""

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tribodyn.errors import InputError
from tribodyn.gears.rating.margins import bulk_of
from tribodyn.grid.grid import _put
from tribodyn.input.sources import file_name
from tribodyn.studies.motion.batch.signals import SignalBatch, SignalSettings
from tribodyn.studies.protocol.batch import SignalRequest

TAKEN = ("message", "status", "trust", "case", "line", "start_time", "time_100_Hz", "reference_angle_200_Hz")


@pytest.mark.parametrize("name", ["top", *TAKEN])
def test_a_sensor_is_not_named_as_something_of_the_data_set(name: str):
    """Neither of the two would be kept."""
    rates, units = (100.0, 200.0), ("m/s2", "N")
    settings = SignalSettings(0.1, 1.0, 0, 10, (name, "other"), units, ("a", "b"), rates, ("mesh",), 0)
    batch = SignalBatch(SignalRequest(0.1, 1.0, 0))
    if name == "top":
        assert {"top", "other"} <= set(batch.layout(settings).variables)
        return
    with pytest.raises(InputError, match="give the sensor another name") as error:
        batch.layout(settings)
    assert error.value.value == f'"{name}"'


@pytest.mark.parametrize("key", ["damage.0.depth", "damage.1.depth", "wear.law", "title.length"])
def test_a_key_in_a_table_that_a_case_lacks(key: str):
    with pytest.raises(InputError, match="not all cases have"):
        _put({"damage": [], "title": "a"}, key, "0.1 mm")


def test_friction_that_gives_power_heats_nothing():
    """As over a window shorter than a vibration: to a power of 0.72 it would be complex."""
    path = SimpleNamespace(pinion_pitch_radius=0.03, gear_pitch_radius=0.06)
    gears: Any = SimpleNamespace(path=path, common_width=0.02)
    assert bulk_of(gears, {"power_friction_mean": -5.0}, 353.15) == 353.15
    assert bulk_of(gears, {"power_friction_mean": 5.0}, 353.15) > 353.15


@pytest.mark.skipif(os.name != "posix", reason="names are bytes on POSIX alone")
def test_a_name_that_is_no_text_is_escaped(tmp_path: Path):
    path = tmp_path / os.fsdecode(b"\xff.toml")
    assert file_name(path, tmp_path) == r"\udcff.toml"


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a folder in use cannot be removed")
def test_the_current_folder_has_been_removed(tmp_path: Path):
    verb = f"{sys.executable} -P -m tribodyn run irefc --no-plot"
    command = f"mkdir gone && cd gone && rmdir ../gone && {verb}"
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
    ran = subprocess.run(
        ["sh", "-c", command], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert ran.stderr == "the current folder has been removed: change to another one\n"
    assert ran.returncode == 2
