"""Load contact studies through the command line: run, show, plot, compare, check; and how they fail."""

import json
from pathlib import Path

import numpy as np
import pytest

from tests.support.verbs import complaint, invoke, sets
from tribodyn.errors import SimulationError
from tribodyn.record.reader import Record
from tribodyn.studies.load_contact import run as simulate_load_contact

PLAIN, RELIEVED = "load-contact-18-36", "harris-18-36-tip-relief"
SHORT = sets("output.positions_per_cycle=30")
TORQUES = sets('operating.gear_torques=["200 N*m", "318.3 N*m", "440 N*m"]')


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The plain pair and the one with tip relief, run; the pictures of the first are all drawn."""
    folder = tmp_path_factory.mktemp("studies")
    paths = {name: folder / f"{name}.h5" for name in (PLAIN, RELIEVED)}
    invoke("run", PLAIN, *SHORT, "-o", paths[PLAIN], "--plot")
    invoke("run", RELIEVED, *SHORT, *TORQUES, "-o", paths[RELIEVED])
    return paths


def test_the_record_carries_the_load(both: dict[str, Path]):
    with Record(both[PLAIN]) as record:
        summary = record.summary
        assert record.samples == 30
        assert np.max(np.abs(record["torque_residual"])) < 1e-10
        # a pair alone carries T_g/(r_g cos 20°); the line load is even
        alone = 318.3 / (0.054 * np.cos(np.radians(20)))
        assert summary["normal_load_max"] == pytest.approx(alone, rel=1e-9)
        assert summary["line_load_max"] == pytest.approx(alone / 0.0267, rel=1e-9)
        assert summary["face_load_factor"] == pytest.approx(1.0, abs=1e-9)
        even = np.where(record["normal_load"] > 0.0, 1.0, np.nan)
        np.testing.assert_allclose(record["face_load_factor"], even, atol=1e-9)
        # a separate prototype counts 1.733 grid positions at this torque, ± 0.02
        assert summary["contact_ratio_effective"] == pytest.approx(1.733, abs=0.02)
        # unmodified flanks have no error without load
        assert np.max(np.abs(record["unloaded_transmission_error"])) < 1e-12
        assert record["root_tension"].max() > 0 > record["root_compression"].min()
        # the single pair's Hertz pressure at the pitch point: radii r sin 20° of both gears
        curvature = 1 / (0.027 * np.sin(np.radians(20))) + 1 / (0.054 * np.sin(np.radians(20)))
        modulus = 207e9 / (2 * (1 - 0.3**2))
        position, pair = np.unravel_index(np.argmin(np.abs(record["roll_angle"])), (30, len(record.pairs)))
        assert record["hertz_pressure"][position, pair, 0] == pytest.approx(
            np.sqrt(record["line_load"][position, pair, 0] * modulus * curvature / np.pi), rel=0.01
        )


def test_relief_of_twice_the_swing_is_least_at_its_torque(both: dict[str, Path]):
    """S. L. Harris: a long relief as deep as twice what two pairs deflect less than one."""
    with Record(both[PLAIN]) as plain, Record(both[RELIEVED]) as relieved:
        swing = np.ptp(plain["loaded_transmission_error"])
        assert 12.4e-6 == pytest.approx(2 * swing, rel=0.02)
        spread = relieved["map_peak_to_peak"]
        assert np.argmin(spread) == 1
        assert spread[1] < 0.25 * swing
        assert spread[1] == np.ptp(relieved["loaded_transmission_error"])
        assert relieved.summary["least_peak_to_peak_torque"] == 318.3


def test_studies_are_compared_with_what_is_modified(both: dict[str, Path]):
    compared = json.loads(invoke("compare", *both.values(), "--json"))
    quantities = compared["quantities"]
    spread = quantities["loaded_transmission_error_peak_to_peak"]["values"]
    assert spread[1] < 0.25 * spread[0]
    different = compared["different_conditions"]
    assert different["drive.pinion.modification.tip_relief"] == ["0 um", "12.4 um"]


@pytest.mark.parametrize("fails_at", [0, 2])
def test_a_torque_that_fails_keeps_what_was_before_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, fails_at: int
):
    """Of the recorded torque and three of a map."""
    calls = []

    def failing(really):
        def call(*arguments, **named):
            calls.append(arguments)
            if len(calls) == fails_at + 1:
                raise SimulationError("the load contact model does not settle")
            return really(*arguments, **named)

        return call

    for name in ("roll_through", "loaded_error"):
        monkeypatch.setattr(simulate_load_contact, name, failing(getattr(simulate_load_contact, name)))
    line = complaint("run", PLAIN, *SHORT, *TORQUES, "-o", tmp_path / "study.h5", status=3)
    assert "does not settle" in line
    assert "study.partial.h5" in line
    with Record(tmp_path / "study.partial.h5") as record:
        assert record.status == "failed"
        assert record.samples == (30 if fails_at else 0)
        if fails_at:
            assert "operating.gear_torques.1 = 318.3 N*m" in line
            assert np.all(record["normal_load"] >= 0)
            assert np.isfinite(record["map_peak_to_peak"]).tolist() == [True, False, False]
