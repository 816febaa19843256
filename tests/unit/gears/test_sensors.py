"""Sensors on runs: against what the same run records, in files and on a page; bad ones are refused."""

import json
import tomllib
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from tests.support.pages import needs_browser, shown
from tests.support.verbs import complaint, invoke
from tribodyn import signals
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.record.sensors import Sensed, read_sensed
from tribodyn.studies.pages import names, study_of_record, write_report
from tribodyn.studies.protocol.load import load_data, load_scenario
from tribodyn.studies.protocol.run import run

RATE, REVOLUTIONS = "20 kHz", 5
MODE = {
    "frequency": "1.2 kHz",
    "damping_ratio": 0.03,
    "mass": "30 kg",
    "shape": {"pinion": [0.2, 0.8], "gear": [0.1, -0.5]},
    "points": {"top": 1.0},
}


def sensor(name: str, kind: str, **own: Any) -> dict[str, Any]:
    return {"name": name, "kind": kind, "rate": RATE, **own}


PAIR = {
    "title": "Sensors on a pair",
    "kind": "gear-pair",
    "drive": "diez-ibarbia-18-36",
    "lubricant": "75w90-diez-ibarbia",
    "operating": {"pinion_speed": "1500 rpm", "gear_torque": "100 N*m"},
    "mesh": {"damping_ratio": 0.05},
    "friction": {"law": "niemann"},
    "solver": {"revolutions": REVOLUTIONS},
    "output": {"samples_per_cycle": 200, "window": "all"},
    "housing": {"mode": [MODE]},
    "sensor": [
        sensor("error", "transmission-error"),
        sensor("pinion", "encoder", at="pinion"),
        sensor("gear", "encoder", at="gear"),
        sensor("moved", "acceleration", at="gear", direction="y"),
        sensor("held", "force", at="pinion", direction="y"),
        sensor("driven", "torque", at="drive"),
        sensor("loaded", "torque", at="output"),
        sensor("top", "housing", snr=30.0, seed=2),
    ],
}


def written(folder: Path, scenario: dict[str, Any], name: str) -> Path:
    return run(load_data(scenario, name).case, folder / f"{name}.h5").path


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(tmp_path_factory.mktemp("pair"), PAIR, "pair")


@pytest.fixture(scope="module")
def sensed(pair: Path) -> Sensed:
    with Record(pair) as record:
        return read_sensed(record)


def recorded(pair: Path, name: str, column: str | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Times and values of a dataset as `signals.resampled` takes them at the sensors' rate."""
    with Record(pair) as record:
        values = record[name] if column is None else record[name][:, list(record["dof"]).index(column)]
        return signals.resampled(record["time"], values, 20e3)


def test_a_record_has_every_sensor_with_unit_and_meaning(sensed: Sensed, pair: Path):
    assert [signal.name for signal in sensed.signals] == [table["name"] for table in PAIR["sensor"]]
    assert {signal.units for signal in sensed.signals} == {"m", "rad", "m/s2", "N", "N*m"}
    assert all(np.allclose(np.diff(signal.time), 5e-5) for signal in sensed.signals)
    assert sensed["top"].made["seed"] == 2
    assert sensed.reference == "pinion"
    xarray = pytest.importorskip("xarray")
    with xarray.open_dataset(pair, group="sensors/at_20000_Hz", engine="h5netcdf") as data:
        np.testing.assert_array_equal(data["top"].values, sensed["top"].values)
        assert data["top"].attrs["units"] == "m/s2"


def test_what_is_recorded_and_what_is_sensed_are_the_same_motion(sensed: Sensed, pair: Path):
    at, error = recorded(pair, "transmission_error_rotational")
    np.testing.assert_allclose(sensed["error"].time, at)
    np.testing.assert_allclose(sensed["error"].values, error, atol=1e-4 * np.ptp(error))
    at, torque = recorded(pair, "drive_torque")
    np.testing.assert_allclose(sensed["driven"].values, torque, rtol=1e-4)
    np.testing.assert_allclose(sensed["loaded"].values, 100.0)


def test_two_encoders_give_the_transmission_error(sensed: Sensed, pair: Path):
    """r_1 θ_1 − r_2 θ_2, with the pinion's rotation prescribed: its own error is none."""
    with Record(pair) as record:
        first, second = (record.geometry[f"{side}_pitch_radius"] for side in ("pinion", "gear"))
    assert np.max(np.abs(sensed["pinion"].values)) < 1e-12
    found = first * sensed["pinion"].values - second * sensed["gear"].values
    np.testing.assert_allclose(found, sensed["error"].values, atol=1e-12)


def test_an_acceleration_is_the_slope_of_the_recorded_velocity(sensed: Sensed, pair: Path):
    """Below 0.3 of the rate, where differences of the sensor's own samples still have the slope."""
    _, velocity = recorded(pair, "velocity", "y_g")
    moved = sensed["moved"].values
    spectrum, rate = np.fft.rfft(velocity * np.hanning(len(velocity))), 20e3
    frequency = np.fft.rfftfreq(len(velocity), 1.0 / rate)
    slope = np.abs(2.0 * np.pi * frequency * spectrum)
    found = np.abs(np.fft.rfft(moved * np.hanning(len(moved))))
    lines = np.flatnonzero((slope > 0.02 * slope.max()) & (frequency < 0.4 * rate))
    assert len(lines) > 5
    np.testing.assert_allclose(found[lines], slope[lines], rtol=0.02)
    assert abs(np.mean(moved)) < 1e-3 * np.max(np.abs(moved))


def test_a_force_on_a_bearing_carries_the_load(sensed: Sensed):
    """Mean radial force F_t tan α_w over the mesh, of a pair without friction to speak of."""
    torque, radius, angle = 100.0, 0.5 * 36 * 3e-3, np.radians(20.0)
    with_friction = abs(np.mean(sensed["held"].values))
    assert with_friction == pytest.approx(torque / radius * np.tan(angle), rel=0.1)


def test_lines_and_numbers_are_those_of_the_mesh(sensed: Sensed, pair: Path):
    error = sensed["error"]
    found = signals.order_spectrum(error.values, error.turns)
    with Record(pair) as record:
        harmonics = np.asarray(record.summary["transmission_error_harmonics"])
        numbers = record.summary["sensors"]["error"]
    for k, amplitude in enumerate(harmonics[:3], start=1):
        assert found.at(18.0 * k) == pytest.approx(amplitude, rel=0.01)
    assert numbers["rms"] == pytest.approx(signals.rms(error.values))
    assert numbers["shafts"]["pinion"]["turns"] == REVOLUTIONS - 2  # those that are whole
    assert numbers["shafts"]["pinion"]["sideband_energy_ratio"] < 0.01  # all teeth are alike
    assert "fm4" not in numbers["shafts"]["pinion"]  # nothing is left of a perfect mesh


def test_sensors_of_what_is_given_and_constant_are_named(sensed: Sensed, pair: Path):
    """The pinion turns at a constant speed, and the load is constant."""
    constant = {name for name in ("pinion", "loaded", "driven", "gear") if np.ptp(sensed[name].values) < 1e-9}
    with Record(pair) as record:
        (said,) = [line for line in study_of_record(record).sentences(record) if "nothing" in line]
    assert constant == {"pinion", "loaded"}
    assert said == "loaded, pinion hear nothing: what is measured there is given, and constant."


def test_a_run_that_keeps_few_samples_has_the_same_signals(pair: Path, sensed: Sensed, tmp_path: Path):
    short = PAIR | {"output": {"samples_per_cycle": 200, "window": [4.0, 5.0]}}
    with Record(written(tmp_path, short, "short")) as record:
        few = read_sensed(record)
    assert (tmp_path / "short.h5").stat().st_size < 0.5 * pair.stat().st_size
    for one, other in zip(few.signals, sensed.signals, strict=True):
        np.testing.assert_array_equal(one.values, other.values)


def test_a_pinion_that_runs_out_shows_once_per_turn(tmp_path: Path):
    """An eccentricity e is e sin(θ + α_w) along the normal, so e/cos α_w in the gears' rotations."""
    eccentric = PAIR | {
        "drive": {"like": "diez-ibarbia-18-36", "pinion": {"eccentricity": "20 um"}},
        "sensor": [sensor("error", "transmission-error"), sensor("top", "housing")],
        "output": {"samples_per_cycle": 100},
        "solver": {"revolutions": 12},
    }
    with Record(written(tmp_path, eccentric, "eccentric")) as record:
        error = read_sensed(record)["error"]
    found = signals.order_spectrum(error.values, error.turns, taper="flat-top")
    assert found.at(1.0, 0) == pytest.approx(20e-6 / np.cos(np.radians(20.0)), rel=0.08)
    assert found.at(2.0, 0) < 0.01 * found.at(1.0, 0)


def cracked(folder: Path, tooth: int | None) -> np.ndarray:
    """Difference signal of the pinion, of an accelerometer with noise, where one of its teeth is cracked."""
    scenario = tomllib.loads(load_scenario("crack-18-36", {"solver.revolutions": 12}).toml)
    scenario["sensor"] = [sensor("moved", "acceleration", at="pinion", snr=20.0) | {"rate": "15 kHz"}]
    if tooth is None:
        scenario.pop("damage")
    else:
        scenario["damage"][0]["tooth"] = tooth
    with Record(written(folder, scenario, f"tooth-{tooth}")) as record:
        moved = read_sensed(record)["moved"]
    return signals.difference(signals.synchronous_average(moved.values, moved.turns, 1500).values, [18])


def test_a_cracked_tooth_shows_once_per_revolution_where_it_is(tmp_path: Path):
    """Nearly all that is left is at the place of that tooth; of sound teeth only noise is left."""
    sound, fifth, eleventh = (cracked(tmp_path, tooth) for tooth in (None, 5, 11))
    assert signals.fm4(sound) == pytest.approx(3.0, abs=0.5)
    for found in (fifth, eleventh):
        assert signals.fm4(found) > 10.0
        peak = int(np.argmax(np.abs(found)))
        near = np.roll(found, len(found) // 2 - peak)[len(found) // 2 - 160 : len(found) // 2 + 160]
        assert np.sum(near**2) > 0.75 * np.sum(found**2)
    apart = (np.argmax(np.abs(eleventh)) - np.argmax(np.abs(fifth))) / len(fifth) * 18.0
    assert apart == pytest.approx(6.0, abs=0.1)


def test_orders_follow_a_shaft_that_speeds_up(tmp_path: Path):
    """While the speed rises by a fifth, lines stay at whole orders of the mesh; over frequency they smear."""
    scenario = tomllib.loads(load_scenario("run-up", {"solver.cycles": 200}).toml)
    scenario["sensor"] = [sensor("moved", "acceleration", at="pinion") | {"rate": "4 kHz"}]
    with Record(written(tmp_path, scenario, "run-up")) as record:
        moved = read_sensed(record)["moved"]
    speed = np.gradient(moved.turns, moved.time)
    assert speed[-1] > 1.2 * speed[0]
    found = signals.order_spectrum(moved.values, moved.turns)
    for k in (1, 3):  # the second passes a resonance, where half a turn of phase splits its line
        around = np.abs(found.frequencies - 23.0 * k) < 1.0
        line = found.frequencies[around][np.argmax(found.amplitudes[around])]
        assert line == pytest.approx(23.0 * k, abs=1.5 * found.step)
    smeared = signals.spectrum(moved.values, moved.rate)
    mesh = 23.0 * np.array([speed[0], speed[-1]])
    between = (smeared.frequencies > mesh[0]) & (smeared.frequencies < mesh[1])
    assert found.at(23.0) > 1.5 * np.max(smeared.amplitudes[between])


def test_planets_that_pass_modulate_what_a_ring_hears(tmp_path: Path):
    """Lines at the mesh ± planets passing; without weights (a sum of all planets' forces) there are none."""
    overrides = {"solver.cycles": 100, "output.samples_per_cycle": 40}
    tables = [
        sensor("hann", "ring", angle="0 deg", rate="8 kHz"),
        sensor("force", "ring", window="hamming", rate="8 kHz"),
    ]
    base = load_scenario("planetary-24-84", overrides)
    case = load_data(tomllib.loads(base.toml) | {"sensor": tables}, "planets").case
    with Record(run(case, tmp_path / "planets.h5").path) as record:
        known = read_sensed(record)
    lines = {line.sort: line.order for line in known.lines}
    assert lines["mesh"] / lines["pass"] == pytest.approx(28.0)  # 84 teeth of the ring, three planets
    heard = known["hann"]
    found = signals.order_spectrum(heard.values, heard.turns)
    beside = [found.at(3.0 * lines["mesh"] + n * lines["pass"], 2) for n in (-1, 0, 1)]
    assert min(beside) > 20.0 * np.median(found.amplitudes)
    # 1/2 + 1/2 cos: sidebands of half the amplitude, the forces of the planets as they are
    assert beside[0] / beside[1] == pytest.approx(0.5, rel=0.15)


def test_files_are_written_and_replaced(pair: Path, sensed: Sensed, tmp_path: Path):
    said = json.loads(invoke("signals", pair, "top", "error", "--wav", "-o", tmp_path / "out", "--json"))
    assert [Path(file).name for file in said["files"]] == [
        f"pair-{name}{end}" for name in ("top", "error") for end in (".csv", ".wav")
    ]
    columns = np.loadtxt(tmp_path / "out" / "pair-top.csv", delimiter=",", comments="#", skiprows=2)
    np.testing.assert_allclose(columns[:, 2], sensed["top"].values, rtol=1e-8)
    values, rate = signals.read_wav((tmp_path / "out" / "pair-top.wav").read_bytes())
    assert rate == 20000
    scale = 0.9 / np.max(np.abs(sensed["top"].values))
    np.testing.assert_allclose(values, scale * sensed["top"].values, atol=2e-5)
    invoke("signals", pair, "top", "-o", tmp_path / "out")  # those of ours are replaced
    (tmp_path / "out" / "pair-top.csv").write_text("mine")
    assert "did not make it" in complaint("signals", pair, "top", "-o", tmp_path / "out")


def test_a_signal_is_heard(pair: Path, tmp_path: Path):
    invoke("listen", pair, "-o", tmp_path / "error.wav", "--rate", "48000", "--seconds", "2")
    samples, rate = signals.read_wav((tmp_path / "error.wav").read_bytes())
    assert (rate, len(samples) >= 2 * rate) == (48000, True)
    assert 0.98 * 0.9 < np.max(np.abs(samples)) <= 0.9  # fades and places between samples lower the peak
    assert "no such sensor" in complaint("listen", pair, "nothing")
    assert "44100 or 48000" in complaint("listen", pair, "--rate", "8000")


def test_pictures_and_page_have_what_was_sensed(pair: Path, tmp_path: Path):
    with Record(pair) as record:
        drawn = {"signals", "order-spectrum", "spectrogram", "synchronous-average", "envelope"}
        assert drawn <= set(names([record]))
        page = write_report([record], tmp_path / "pair.html").read_text(encoding="utf-8")
    assert page.count("<audio controls") == 4
    assert "media-src data:" in page
    assert "Largest lines, orders per turn of pinion" in page
    assert ">2 × mesh<" in page


def test_a_record_whose_signal_is_no_number_is_said_to_be_damaged(pair: Path, tmp_path: Path):
    damaged = tmp_path / "damaged.h5"
    damaged.write_bytes(pair.read_bytes())
    with h5py.File(damaged, "r+") as file:
        file["sensors/at_20000_Hz/top"][7] = np.inf  # pyright: ignore
    with Record(damaged) as record, pytest.raises(InputError, match="damaged: top is not a finite number"):
        read_sensed(record)


def test_sensors_of_any_kinds_and_filters_are_read_back_as_they_were_written(tmp_path: Path):
    """Of one rate or several; each the same as if it were the only one."""
    kinds = [
        sensor("a", "force", at="pinion"),
        sensor("b", "force", at="pinion", filter="none", snr=20.0),
        sensor("c", "acceleration", at="gear", filter="none", rate="5 kHz", noise="1 m/s**2"),
        sensor("d", "acceleration", at="gear", rate="5 kHz", bits=8, full_scale="20 m/s**2"),
        sensor("e", "encoder", at="gear", bits=32, full_scale="1e-3 rad"),
        sensor("lines", "torque", at="output", full_scale="1 N*m"),
        sensor("f", "housing", filter="none", rate="5 kHz"),
    ]
    short = PAIR | {"solver": {"revolutions": 1}, "output": {"samples_per_cycle": 100, "window": "all"}}
    with Record(written(tmp_path, short | {"sensor": kinds}, "all")) as record:
        together = read_sensed(record)
        assert "signals" in names([record])
    assert [signal.name for signal in together.signals] == [one["name"] for one in kinds]
    assert {len(signal.time) for signal in together.signals[:2]} == {771, 801}  # the filter's reach
    for one, signal in zip(kinds, together.signals, strict=True):
        with Record(written(tmp_path, short | {"sensor": [one]}, f"only-{one['name']}")) as record:
            (alone,) = read_sensed(record).signals
        for name in ("time", "angle", "values"):
            expected = getattr(alone, name)
            largest = np.max(np.abs(expected))
            np.testing.assert_allclose(getattr(signal, name), expected, rtol=0.0, atol=1e-9 * largest)


@needs_browser
def test_a_browser_takes_the_page(pair: Path, tmp_path: Path):
    with Record(pair) as record:
        path = write_report([record], tmp_path / "pair.html")
    assert "data:audio/wav" in shown(path.as_uri())


@pytest.mark.parametrize(
    ("own", "key", "said"),
    [
        ({"rate": "800 Hz"}, "sensor.0.rate", "half of it is below the mesh frequency, 450 Hz"),
        ({"rate": "1 MHz"}, "output.samples_per_cycle", "use at least 2223"),
        ({"at": "pinon"}, "sensor.0.at", 'did you mean "pinion"'),
        ({"at": None}, "sensor.0.at", "name one of pinion, gear"),
        ({"direction": "z"}, "sensor.0.direction", "moves in x and y alone"),
        ({"noise": "3 N"}, "sensor.0.noise", "not a unit of acceleration"),
        ({"noise": "1 m/s**2", "snr": 3.0}, "sensor.0.snr", "contradicts noise"),
        ({"bits": 12}, "sensor.0.full_scale", "missing"),
        ({"bits": 12, "full_scale": "0 m/s**2"}, "sensor.0.full_scale", "leaves nothing"),
        ({"snr": -20000.0}, "sensor.0.snr", "must be at least -300"),
        ({"name": "time"}, "sensor.0.name", "a dataset beside the signals"),
        ({"kind": "ring"}, "sensor.0.kind", "there is none"),
    ],
)
def test_a_sensor_that_cannot_be_is_one_message(own: dict[str, Any], key: str, said: str):
    table = {"name": "a", "kind": "acceleration", "at": "pinion", "rate": RATE} | own
    scenario = PAIR | {"sensor": [{name: value for name, value in table.items() if value is not None}]}

    def checked() -> None:
        loaded = load_data(scenario, "bad")
        loaded.study.check(loaded.case)

    with pytest.raises(InputError) as found:
        checked()
    assert found.value.key == key
    assert said in str(found.value)
    assert "\n" not in str(found.value)


def test_a_housing_without_the_bearing_that_moves_it_is_refused():
    housing = {"mode": [MODE | {"shape": {"wheel": [1.0, 1.0]}}]}
    loaded = load_data(PAIR | {"housing": housing}, "bad")
    with pytest.raises(InputError, match=r"housing\.mode\.0\.shape\.wheel"):
        loaded.study.check(loaded.case)
