"""Gears on drawn shafts in a housing by matrices, from files in a folder to what its sensors hear."""

import numpy as np
import pytest
from scipy.signal import lsim

import tribodyn as td
from tests.support.housed_train import SEATS, box, written
from tribodyn.errors import InputError

RATE, MODES_UP_TO = 20e3, 6e3


def _sensor(name: str, kind: str, direction: str) -> dict:
    place = {"at": name, "direction": direction, "rate": f"{RATE} Hz"}
    return {"name": f"{name}-{direction}", "kind": kind} | place


def _below(signal: np.ndarray) -> np.ndarray:
    """Lines of a signal's last two thirds, up to a quarter of the frequency of the modes that are kept."""
    late = signal[len(signal) // 3 :]
    return np.fft.rfft(late * np.hanning(len(late)))[: int(len(late) * 0.25 * MODES_UP_TO / RATE)]


def test_the_housing_moves_as_the_forces_of_its_bearings_drive_it(tmp_path):
    """What sensors hear on top and at a seat is the housing alone under the forces on its bearings."""
    box_alone = box()
    heard = {"top": "y", "B": "x"}
    sensors = [_sensor(name, "housing", direction) for name, direction in heard.items()]
    sensors += [_sensor(name, "force", direction) for name in SEATS for direction in "xyz"]
    housing = {"matrices": "housing.h5", "modes_up_to": f"{MODES_UP_TO} Hz"}
    signals = td.run(written(tmp_path, housing=housing, sensor=sensors)).sensors

    count = box_alone.coordinates
    force = np.zeros((len(signals["top-y"].values), count))
    for bearing, seat in SEATS.items():
        for place, direction in enumerate("xyz"):
            force[:, box_alone.seat(seat) + place] = signals[f"{bearing}-{direction}"].values
    force -= force[0]  # it begins in equilibrium
    mobile = np.linalg.inv(box_alone.mass)
    nothing = np.zeros((count, count))
    system = np.block(
        [[nothing, np.eye(count)], [-mobile @ box_alone.stiffness, -mobile @ box_alone.damping]]
    )
    push = np.vstack([nothing, mobile])
    for name, direction in heard.items():
        row = box_alone.motion_of(name)["xyz".index(direction)]
        seen = np.concatenate([np.zeros(count), row]) @ system
        alone = lsim((system, push, seen[None], (row @ mobile)[None]), force, np.arange(len(force)) / RATE)
        expected, found = (
            _below(signal) for signal in (np.ravel(alone[1]), signals[f"{name}-{direction}"].values)
        )
        assert np.linalg.norm(found - expected) < 0.05 * np.linalg.norm(expected)


@pytest.mark.parametrize(
    ("housing", "words"),
    [
        ({"matrices": "housing.h5", "units": "mm, t, s"}, "the file says"),
        ({"matrices": "absent.h5"}, "absent.h5"),
        ({"matrices": "housing.h5", "held": ["A"]}, "no such seat of the housing|seat of the housing"),
    ],
)
def test_what_the_files_contradict_is_one_line(housing, words, tmp_path):
    with pytest.raises(InputError, match=words) as refused:
        td.scenario(written(tmp_path, housing=housing))
    assert "\n" not in str(refused.value)
