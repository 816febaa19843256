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


def _alone(element, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rates and accelerations of a structure under forces over time."""
    count, mobile = element.coordinates, np.linalg.inv(element.mass)
    nothing, whole = np.zeros((count, count)), np.eye(count)
    system = np.block([[nothing, whole], [-mobile @ element.stiffness, -mobile @ element.damping]])
    push = np.vstack([nothing, mobile])
    time = np.arange(len(force)) / RATE
    states = lsim((system, push, np.eye(2 * count), np.zeros((2 * count, count))), force, time)[1]
    return states[:, count:], states @ system[count:].T + force @ mobile.T


def test_the_housing_moves_as_the_forces_of_its_bearings_drive_it(tmp_path):
    """What sensors hear on top and at a seat is the housing alone under the forces on its bearings."""
    box_alone = box()
    heard = {"top": "y", "B": "x"}
    sensors = [_sensor(name, "housing", direction) for name, direction in heard.items()]
    sensors += [_sensor(name, "force", direction) for name in SEATS for direction in "xyz"]
    sensors.append({"name": "loud", "kind": "sound", "rate": f"{RATE} Hz"})
    housing = {"matrices": "housing.h5", "modes_up_to": f"{MODES_UP_TO} Hz", "radiation_efficiency": 0.5}
    run = td.run(written(tmp_path, housing=housing, sensor=sensors))
    signals = run.sensors

    count = box_alone.coordinates
    force = np.zeros((len(signals["top-y"].values), count))
    for bearing, seat in SEATS.items():
        for place, direction in enumerate("xyz"):
            force[:, box_alone.seat(seat) + place] = signals[f"{bearing}-{direction}"].values
    force -= force[0]  # it begins in equilibrium
    rates, accelerations = _alone(box_alone, force)
    for name, direction in heard.items():
        row = box_alone.motion_of(name)["xyz".index(direction)]
        expected, found = (
            _below(signal) for signal in (accelerations @ row, signals[f"{name}-{direction}"].values)
        )
        assert np.linalg.norm(found - expected) < 0.05 * np.linalg.norm(expected)

    lines = np.abs(np.fft.rfft(signals["loud"].values)) ** 2
    spectrum = np.fft.rfft(rates, axis=0)
    radiated = np.einsum("ki,ij,kj->k", spectrum.conj(), box_alone.radiation.area, spectrum).real
    band = slice(1, int(0.25 * MODES_UP_TO / RATE * len(rates)))
    assert 4.0 * np.pi / 413.3 * np.sum(lines[band]) == pytest.approx(
        0.5 * 413.3 * np.sum(radiated[band]), rel=0.1
    )
    numbers = run.summary["sensors"]["loud"]
    assert numbers["sound_power_level"] == pytest.approx(120.0 + 10.0 * np.log10(numbers["sound_power"]))
    lost = np.mean(np.einsum("si,ij,sj->s", rates, box_alone.damping, rates))
    assert numbers["sound_power"] < 0.1 * lost


def test_a_housing_of_no_known_surface_is_not_heard(tmp_path):
    scenario = written(tmp_path, sensor=[{"name": "loud", "kind": "sound", "rate": f"{RATE} Hz"}])
    td.write_matrices(box()._replace(radiation=None), tmp_path / "housing.h5")
    with pytest.raises(InputError, match="needs a housing by matrices with area or radiation") as refused:
        td.run(scenario)
    assert refused.value.key == "sensor.0.kind"


def test_seats_that_are_not_where_the_bearings_are_are_refused(tmp_path):
    """Seats of both shafts the wrong way round, and a housing with another axis along the shafts."""
    table = written(tmp_path)
    turned = {seat: [f"{1e3 * place[axis]} mm" for axis in (2, 1, 0)] for seat, place in _places().items()}
    for change, key, words in (
        ({"housing.seats": ["C", "D", "A", "B"]}, "shaft.1.drawn.bearing.0.seat", "-155.3, 0, 0 mm from the"),
        ({"housing.places": turned}, "shaft.0.drawn.bearing.1.seat", "is 175, 0, 0 mm from the seat A"),
    ):
        with pytest.raises(InputError, match=words) as refused:
            td.scenario(table, change)
        assert refused.value.key == key


def _places() -> dict[str, np.ndarray]:
    return dict(zip(box().seats, box().places, strict=True))


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
