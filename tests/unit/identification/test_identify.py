"""td.identify: an estimate from a short record and from arrays, and what is refused."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.record.reader import Record
from tribodyn.record.sensors import read_sensed

PAIR = {
    "title": "A pinion that runs out",
    "kind": "gear-pair",
    "drive": "diez-ibarbia-18-36",
    "lubricant": "liu-ni-2022",
    "operating": {"pinion_speed": "1500 rpm", "gear_torque": "200 N*m"},
    "mesh": {"damping_ratio": 0.05},
    "friction": {"law": "coulomb", "coefficient": 0.05},
    "film": {"law": "masjedi-khonsari"},
    "solver": {"revolutions": 3},
    "sensor": [
        {"name": "e", "kind": "transmission-error", "rate": "5 kHz", "noise": "0.2 um"},
        {
            "name": "a",
            "kind": "acceleration",
            "at": "gear",
            "direction": "y",
            "rate": "5 kHz",
            "noise": "2 m/s**2",
        },
    ],
}
KEY = "drive.pinion.eccentricity"
RANGE = {KEY: ("0 um", "30 um")}
QUIET = {"run_in": 1.5, "progress": False}


@pytest.fixture(scope="module")
def rig(tmp_path_factory: pytest.TempPathFactory):
    path = tmp_path_factory.mktemp("rig") / "rig.h5"
    td.run(PAIR, {KEY: "8 um"}, output=path, progress=False)
    with Record(path) as record:
        return path, read_sensed(record)


@pytest.fixture(scope="module")
def identified(rig):
    return td.identify(PAIR, rig[0], RANGE, **QUIET)


def test_a_record_gives_the_eccentricity_that_it_was_made_with(identified):
    found = identified
    low, high = found.intervals[KEY]
    assert low <= 8e-6 <= high or abs(found[KEY] - 8e-6) < high - low
    assert high - low < 0.5e-6
    assert found.noise["e"] == pytest.approx(0.2e-6, rel=0.2)
    assert found.noise["a"] == pytest.approx(2.0, rel=0.3)
    assert min(found.whiteness.values()) > 1e-3
    assert not found.remarks
    assert found.scenario.pair.teeth != td.scenario(PAIR).pair.teeth
    assert KEY in repr(found)
    assert KEY in found._repr_html_()


def test_arrays_and_records_give_the_same(rig, identified):
    _, sensed = rig
    arrays = {name: sensed[name].values for name in ("e", "a")}
    found = td.identify(PAIR, arrays, RANGE, start=f"{float(sensed['e'].time[0])!r} s", **QUIET)
    assert found[KEY] == pytest.approx(identified[KEY], rel=1e-3)


def test_a_model_that_lacks_something_is_said(rig):
    """Damping alone cannot make up for a run-out."""
    alone = {"sensor": PAIR["sensor"][:1]}
    found = td.identify(PAIR, rig[0], {"mesh.damping_ratio": (0.01, 0.2)}, alone, **QUIET)
    assert "no noise" in " ".join(found.remarks)
    assert found.whiteness["e"] < 1e-3


def test_an_estimate_at_the_end_of_its_range_has_no_interval(rig):
    """The pinion runs out by 8 µm; up to 6 µm are allowed."""
    alone = {"sensor": PAIR["sensor"][:1]}
    found = td.identify(PAIR, rig[0], {KEY: ("0 um", "6 um")}, alone, **QUIET)
    assert found[KEY] == pytest.approx(6e-6, rel=1e-3)
    assert np.all(np.isnan(found.intervals[KEY]))
    for text in (repr(found), found._repr_html_()):
        assert "no interval" in text
        assert "widen it" in text


@pytest.mark.parametrize(
    ("measured", "unknowns", "more", "said"),
    [
        ({"e": np.zeros(100)}, {}, {}, "nothing is sought"),
        ({"e": np.zeros(100)}, {KEY: 3}, {}, "its range"),
        ({"e": np.zeros(100)}, {KEY: ("30 um", "0 um")}, {}, "the range is empty"),
        ({"e": np.zeros(100)}, {KEY: ("0 N", "30 N")}, {}, "drive.pinion.eccentricity"),
        ({"e": np.zeros(400)}, {"mesh.damping": (0.0, 1.0)}, {}, "mesh.damping"),
        ({"e": np.zeros(400)}, {"drive": (0.0, 1.0)}, {}, "drive"),
        ({"x": np.zeros(100)}, RANGE, {}, "measured"),
        ({}, RANGE, {}, "measured"),
        ({"e": np.zeros((10, 10))}, RANGE, {}, "shape"),
        ({"e": np.full(100, np.nan)}, RANGE, {}, "without value"),
        ({"e": np.zeros(100)}, RANGE, {"start": "0.1 ms"}, "no moment"),
        ({"e": np.zeros(20)}, RANGE, {"run_in": 3}, "no sample is left"),
        ({"e": np.zeros(302)}, RANGE, {"run_in": 1.5}, "2 samples for 1 unknowns"),
        (3.0, RANGE, {}, "the path of a record"),
        ({"e": np.zeros(400)}, RANGE, {"method": "guess"}, "no such method"),
        ({"e": np.zeros(400)}, RANGE, {"run_in": -1}, "is no number of turns"),
        ({"e": np.zeros(400)}, RANGE, {"run_in": float("nan")}, "is no number of turns"),
        ({"e": np.zeros(400)}, RANGE, {"run_in": "1"}, "is no number of turns"),
        ({"e": np.zeros(400)}, RANGE, {"seed": -1}, "no whole number"),
        ({"e": np.zeros(400)}, RANGE, {"run_in": 0.0}, "leave out more turns"),
        ({"e": [10**400] * 400}, RANGE, {}, "no array of real numbers"),
        ({"e": np.zeros(400, dtype=complex)}, RANGE, {}, "no array of real numbers"),
        ({"e": np.zeros(400, dtype="M8[s]")}, RANGE, {}, "no array of real numbers"),
        ({"e": np.zeros(400)}, {(): (0.0, 1.0)}, {}, "is no key"),
        ({"e": np.zeros(400)}, {3: (0.0, 1.0)}, {}, "is no key"),
        ({"e": np.zeros(400)}, {KEY: {1: 2, 3: 4}}, {}, "its range"),
        ({"e": np.zeros(400)}, {"mesh.damping_ratio": (0, 10**400)}, {}, "only numbers"),
        (
            {"e": np.zeros(400)},
            {"operating.pinion_speed": ("0 rpm", "10 rpm")},
            {},
            "near its lower end a mesh cycle takes 16.7 s",  # 60 s over 18 teeth and 0.2 rpm
        ),
        ({"e": np.zeros(400)}, RANGE | {(KEY,): ("0 um", "3 um")}, {}, "is sought twice"),
    ],
)
def test_bad_input_is_one_message(measured, unknowns, more, said: str):
    with pytest.raises(td.InputError) as error:
        td.identify(PAIR, measured, unknowns, **(QUIET | more))
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_a_rate_below_the_mesh_frequency_is_refused():
    slow = {"sensor": [{"name": "e", "kind": "transmission-error", "rate": "500 Hz"}]}
    with pytest.raises(td.InputError, match="mesh frequency"):
        td.identify(PAIR, {"e": np.zeros(400)}, RANGE, slow, **QUIET)


def test_a_scenario_without_sensors_is_refused():
    with pytest.raises(td.InputError, match="sensor"):
        td.identify("crc-23-47", {"e": np.zeros(400)}, RANGE)
    with pytest.raises(td.InputError, match="no sensors"):
        td.identify("efficiency-crc-23-47", {"e": np.zeros(400)}, RANGE)
