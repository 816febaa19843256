"""The verb sweep as its user meets it: records, figures, failed cases, what is refused."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray

from tests.support.verbs import complaint, ended, invoke, sets
from tribodyn.gears.case import OF_PLANETS, TEMPERATURE_SWEPT
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE, FAILED
from tribodyn.studies import STUDIES
from tribodyn.studies.motion.report import SWEPT

SPEEDS = "operating.pinion_speed=100:300:100rad/s"
SHORT = ("--transient", "4", *sets("output.samples_per_cycle=40"))


@pytest.fixture(scope="module")
def grid(tmp_path_factory) -> Path:
    """Three speeds, two torques, both directions; and what the verb said as JSON, beside it."""
    path = tmp_path_factory.mktemp("sweep") / "grid.h5"
    vary = ("--vary", SPEEDS, "--vary", "operating.gear_torque=100,500 N*m")
    said = invoke("sweep", "crc-23-47", *vary, "--direction", "both", *SHORT, "-o", path, "--json")
    path.with_suffix(".json").write_text(said, encoding="utf-8")
    return path


def test_the_record_is_a_dataset_over_the_parameters(grid: Path):
    with xarray.open_dataset(grid, engine="h5netcdf") as data:
        assert dict(data.efficiency.sizes) == {"pinion_speed": 3, "gear_torque": 2, "direction": 2}
        assert data.pinion_speed.values.tolist() == [100.0, 200.0, 300.0]
        assert data.pinion_speed.attrs["units"] == "rad/s"
        assert data.direction.values.tolist() == ["up", "down"]
        assert data.transmission_error_rotational.dims[-1] == "sample"
        assert data.poincare_error.dims[-1] == "cycle"
        assert (data.status == DONE).all()
        assert set(data.solution.values.ravel()) == {"transient"}
        assert data.attrs["status"] == "complete"
        assert not {quantity.name for quantity in OF_PLANETS} & set(data)  # it has none
        for quantity in set(SWEPT) - set(OF_PLANETS):
            name = quantity.name
            # this scenario asks for no temperatures
            assert np.isfinite(data[name]).all() == (quantity not in TEMPERATURE_SWEPT), name
            assert data[name].attrs["units"]
            assert data[name].attrs["long_name"]


def test_json_and_show_say_what_the_record_says(grid: Path):
    said = json.loads(grid.with_suffix(".json").read_text(encoding="utf-8"))
    assert said["cases"] == said["done"] == 12
    assert [parameter["key"] for parameter in said["parameters"]] == [
        "operating.pinion_speed",
        "operating.gear_torque",
    ]
    shown = json.loads(invoke("show", grid, "--json"))
    assert {name: shown[name] for name in said} == said
    with SweepRecord(grid) as record:
        np.testing.assert_array_equal(said["figures"]["dynamic_factor"]["values"], record["dynamic_factor"])
        loudest = record["dynamic_factor"].max()
    printed = invoke("show", grid)
    assert "12 cases (3 of operating.pinion_speed, 2 of operating.gear_torque, up and down)" in printed
    verdict = printed.splitlines()[1:4]
    assert verdict[0].startswith("Vibration is largest at ")
    assert verdict[0].endswith(f"tooth forces of {loudest:.2f} times their mean.")
    assert verdict[2].startswith("The film is thinnest at ")


def test_the_first_case_of_a_direction_is_the_run_of_its_scenario(grid: Path, tmp_path: Path):
    keys = "operating.pinion_speed=300 rad/s", "operating.gear_torque=500 N*m", "output.samples_per_cycle=40"
    invoke("run", "crc-23-47", "--no-plot", "-o", tmp_path / "run.h5", *sets("solver.cycles=4", *keys))
    with Record(tmp_path / "run.h5") as record, SweepRecord(grid) as sweep:
        case = (2, 1, 1)  # 300 rad/s is where "down" begins
        # the same steps but for where blocks end: far inside the solver's tolerance of 1e-6
        for name in ("dynamic_factor", "efficiency", "mesh_frequency", "power_in_mean"):
            assert sweep[name][case] == pytest.approx(record.summary[name], rel=1e-7), name
        np.testing.assert_allclose(
            sweep["transmission_error_rotational"][case],
            record["transmission_error_rotational"][-41:-1],
            rtol=1e-7,
        )


@pytest.mark.parametrize("name", STUDIES["gear-pair"].sweep_drawings())
def test_every_figure_is_drawn(grid: Path, name: str, tmp_path: Path):
    at = ("--at", "pinion_speed=1900rpm", "--at", "direction=down") if name == "poincare" else ()
    said = json.loads(invoke("plot", grid, name, *at, "-o", tmp_path, "--json"))
    assert [Path(picture).name for picture in said["pictures"]] == [f"grid-{name}.png"]
    assert Path(said["pictures"][0]).stat().st_size > 10_000


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("nonsense",), "no such figure of a sweep"),
        (("poincare", "--at", "speed=1"), "not a dimension of the sweep"),
        (("poincare", "--at", "pinion_speed=1mm"), "not a unit of angular speed"),
        (("poincare", "--at", "direction=left"), "no such value"),
    ],
)
def test_bad_wishes_for_figures_are_refused(grid: Path, words: tuple[str, ...], message: str):
    assert message in complaint("plot", grid, *words)


def test_a_case_that_fails_leaves_the_others_alone(tmp_path: Path):
    """A pinion of 23 teeth shifted by 1.5 is pointed."""
    path = tmp_path / "shifts.h5"
    vary = ("--vary", "drive.pinion.profile_shift=0,1.5,0.1")
    said = invoke("sweep", "involute-23-47", *vary, *SHORT, "-o", path)
    assert "2 done, 1 failed" in said
    assert "1 of 3 cases failed." in said
    assert "failed at profile shift 1.5: " in said
    with SweepRecord(path) as record:
        assert record.status == "complete"
        assert record.message == "1 of 3 cases failed"
        assert record["status"].tolist() == [DONE, FAILED, DONE]
        assert "drive.pinion" in record["message"][1]
        assert np.isnan(record["efficiency"][1])
        assert record["efficiency"][0] != record["efficiency"][2]


def test_all_cases_failed(tmp_path: Path):
    path = tmp_path / "steps.h5"
    words = ("sweep", "crc-23-47", "--vary", SPEEDS, *SHORT, *sets("solver.max_steps=2"), "-o", path)
    failed = ended(*words)
    assert failed.exit_code == 3
    assert "all 3 cases failed" in failed.stderr
    assert not path.exists()
    with SweepRecord(tmp_path / "steps.partial.h5") as record:
        assert record.status == "failed"
        assert all("the limit of steps" in message for message in record["message"])


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "nothing is varied"),
        (("--vary", SPEEDS, "--steady", "--transient", "4"), "contradicts --transient"),
        (("--vary", SPEEDS, "--resume", "--force"), "contradicts --force"),
        (("--vary", SPEEDS, "--set", "operating.pinion_speed=5 rpm"), "is varied too"),
        (("--vary", SPEEDS, "--scheduler", "tcp://localhost:1"), "belongs to --engine dask"),
        (("--vary", "friction.law=none,coulomb", "--direction", "up"), "law = "),
        (("--vary", "operating.pinion_speed=1:90000:1rpm", "--vary", "mesh.damping_ratio=0:1/99"), "cases"),
        (("--vary", "operating.pinion_speed=1:9:1rpm", "-o", "no/such/folder.h5"), "does not exist"),
    ],
)
def test_what_cannot_be_swept_is_refused_at_once(words: tuple[str, ...], message: str, tmp_path: Path):
    refused = ended("sweep", "crc-23-47", *words)
    assert refused.exit_code == 2, refused.output
    assert message in refused.stderr


def test_a_load_that_changes_over_time_has_no_steady_state(tmp_path: Path):
    words = ("sweep", "load-step", "--vary", "mesh.damping_ratio=0.04,0.05", "-o", tmp_path / "s.h5")
    assert "operating.gear_torque_table" in complaint(*words)
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_two_motions_at_one_speed(tmp_path: Path):
    """Up the drive stays in contact to its resonance; down it rattles on below: a softening spring's jump."""
    path = tmp_path / "jump.h5"
    vary = "operating.pinion_speed=470:530:20rad/s"
    invoke("sweep", "jump-involute-23-47", "--vary", vary, "--direction", "both", "-o", path)
    with SweepRecord(path) as record:
        assert (record["stable"] == 1).all()
        assert (record["multiplier_max"] < 1).all()
        up, down = np.moveaxis(record["contact_loss_fraction"], -1, 0)
        # 470 rad/s: both; 490 … 530 rad/s: one
        assert up[0] == 0
        assert down[0] > 0.2
        np.testing.assert_allclose(up[1:], down[1:], atol=1e-6)
        energy = record["transmission_error_rms"]
        assert energy[0, 1] > 1.5 * energy[0, 0]
        # the resonance is at the mode that the linearised model has there
        mode = record["mode_frequency"][0, 0, 0]
        assert record["mesh_frequency"][:, 0].min() < mode < record["mesh_frequency"][:, 0].max()


@pytest.fixture(scope="module")
def followed(tmp_path_factory) -> dict[int, Path]:
    """Down the motion of two mesh cycles of a lightly damped drive, in coarse and in fine steps."""
    settings = {
        "friction.law": "none",
        "mesh.damping_ratio": "0.01",
        "operating.gear_torque": "100 N*m",
        "mesh.compliance": "constant",
        "mesh.stiffness": "2.8e8 N/m",
        "output.samples_per_cycle": "40",
    }
    given = sets(settings)
    paths = {}
    for step in (20, 60):
        paths[step] = tmp_path_factory.mktemp("followed") / f"{step}.h5"
        vary = f"operating.pinion_speed=884:1004:{step}rad/s"
        invoke("sweep", "crc-23-47", *given, "--vary", vary, "--direction", "down", "-o", paths[step])
    return paths


def test_a_motion_is_followed_whatever_the_step(followed):
    """The branch of two mesh cycles; marching from a neighbour 4 rad/s away gives 11.46 µm at 884 rad/s."""
    with SweepRecord(followed[20]) as fine, SweepRecord(followed[60]) as coarse:
        assert np.all(fine["period"] == 2)
        assert fine["transmission_error_rms"][0, 0] * 1e6 == pytest.approx(11.46, abs=0.02)
        np.testing.assert_allclose(
            coarse["transmission_error_rms"], fine["transmission_error_rms"][::3], rtol=1e-5
        )
        assert np.all(fine["end_kind"] == 0)
        assert fine.units("end_value") == "rad/s"


def test_ends_of_branches_are_recorded_and_shown(tmp_path: Path):
    path = tmp_path / "tongue.h5"
    words = ["sweep", "involute-23-47", "--vary", "operating.pinion_speed=1006:1014:8rad/s"]
    words += sets("friction.law=none", "mesh.damping_ratio=0.01", "operating.gear_torque=100 N*m")
    invoke(*words, *sets("output.samples_per_cycle=40"), "--direction", "up", "-o", path)
    with SweepRecord(path) as record:
        assert record["period"][:, 0].tolist() == [1, 2]
        assert record.meanings("end_kind")[record["end_kind"][1, 0, 0]] == "period_doubling"
        assert record["end_multiplier_modulus"][1, 0, 0] == pytest.approx(1.0, abs=1e-3)
        assert 1006.0 < record["end_value"][1, 0, 0] < 1014.0
        assert record["end_within"][1, 0, 0] <= 1e-4 * 1014.0
    assert "a branch of period 1 ends at" in invoke("show", path)
    said = json.loads(invoke("show", path, "--json"))
    assert [end["kind"] for end in said["ends"]] == ["period doubling"]
    invoke("plot", path, "response", "bifurcation", "--output", tmp_path / "tongue.png")
