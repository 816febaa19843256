"""Measured curves beside simulated ones: where they lie, what is moved, what is refused."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

import tribodyn as td
from tests.support.verbs import complaint, invoke, sets
from tribodyn.interface.run import open_run
from tribodyn.record.reader import Record
from tribodyn.studies.measured import Beside, beside, read_measured

ERROR = "transmission_error_rotational"
CYCLES, TEETH = 6, 23


@pytest.fixture(scope="module")
def run(tmp_path_factory) -> Path:
    """A run of six mesh cycles."""
    path = tmp_path_factory.mktemp("run") / "run.h5"
    words = sets(f"solver.cycles={CYCLES}", "output.samples_per_cycle=80")
    invoke("run", "involute-23-47", "--no-plot", "-o", path, *words)
    return path


def curve(run: Path, name: str = ERROR) -> Callable[[np.ndarray], np.ndarray]:
    """A dataset as a function of the phase, mesh cycles from the start of the run."""
    with Record(run) as record:
        angle, values = record["pinion_angle"], record[name]
    phase = (angle - angle[0]) * TEETH / (2 * np.pi)
    return lambda at: np.interp(at, phase, values)


def written(path: Path, head: str, *columns: np.ndarray) -> Path:
    """A file as a test rig writes it."""
    rows = "\n".join(",".join(f"{value:.9g}" for value in row) for row in zip(*columns, strict=True))
    path.write_text(f"# test rig, 12 May\n{head}\n\n{rows}\n", encoding="utf-8")
    return path


def laid(run: Path, file: Path, align: str = "given", name: str = ERROR) -> Beside:
    with Record(run) as record:
        return beside(record, read_measured(file), name, align)


def test_over_the_phase_the_last_mesh_cycles_lie_there(run: Path, tmp_path: Path):
    """One and a half mesh cycles from the start of the last two, in µm."""
    phase = np.linspace(0.0, 1.5, 61)
    file = written(tmp_path / "te.csv", f"mesh_phase [1], {ERROR} [um]", phase, curve(run)(phase + 4) * 1e6)
    found = laid(run, file)
    assert found.difference < 1e-3
    assert found.correlation > 0.9999
    assert found.moved == (0.0, 0.0)
    assert found.x[0] >= 0.0
    assert found.x[-1] <= 1.5
    # what is drawn is the record itself
    np.testing.assert_allclose(found.y, curve(run)(found.x + 4) * 1e6, rtol=1e-6)


def test_the_pinions_angle_and_the_time_are_abscissas_too(run: Path, tmp_path: Path):
    """The angle is moved by whole mesh cycles, the time is not."""
    phase = np.linspace(0.2, 1.2, 41)
    angle = phase * 360 / TEETH
    torque = curve(run, "drive_torque")(phase + 4)
    file = written(tmp_path / "angle.csv", "pinion_angle [deg], drive_torque [N*m]", angle, torque)
    assert laid(run, file, name="drive_torque").difference < 1e-3 * np.ptp(torque)
    with Record(run) as record:
        time, error = record["time"], record[ERROR]
    file = written(tmp_path / "time.csv", f"time [ms], {ERROR} [um]", time[50:90] * 1e3, error[50:90] * 1e6)
    assert laid(run, file).difference < 1e-4
    file = written(tmp_path / "late.csv", f"time [ms], {ERROR} [um]", time[50:90] * 1e6, error[50:90] * 1e6)
    with pytest.raises(td.InputError, match="nothing to compare"):
        laid(run, file)


def test_mean_and_shift_are_found_on_request(run: Path, tmp_path: Path):
    """A rig whose zero is 5 µm above and whose trigger is 0.15 mesh cycles late."""
    phase = np.linspace(0.0, 2.0, 101)
    values = curve(run)(phase + 3 + 0.15) * 1e6 + 5.0
    file = written(tmp_path / "te.csv", f"mesh_phase [1], {ERROR} [um]", phase, values)
    given, mean, fit = (laid(run, file, align) for align in ("given", "mean", "fit"))
    assert given.difference > mean.difference > fit.difference
    assert np.mean(mean.y) - np.mean(given.y) == pytest.approx(mean.moved[1])
    assert fit.moved == pytest.approx((-0.15, 5.0), abs=0.02)
    assert fit.correlation > 0.999


def test_the_figure_and_the_page_show_it(run: Path, tmp_path: Path):
    phase = np.linspace(0.0, 1.0, 41)
    columns = phase, curve(run)(phase + 5) * 1e6, curve(run, "drive_torque")(phase + 5)
    file = written(tmp_path / "rig.csv", f"mesh_phase [1], {ERROR} [um], drive_torque [N*m]", *columns)
    invoke("plot", run, "--measured", file, "--align", "mean", "-o", tmp_path)
    assert (tmp_path / "run-measured.png").stat().st_size > 10_000
    invoke("report", run, "--measured", file, "-o", tmp_path / "run.html")
    page = (tmp_path / "run.html").read_text(encoding="utf-8")
    assert "Measured: the simulation beside it" in page
    result = open_run(run)
    figure = result.plot(measured=file)
    assert isinstance(figure, Figure)
    assert [axes.get_ylabel() for axes in figure.axes] == ["µm", "N m"]
    shown = {line.get_label(): line.get_xydata() for line in figure.axes[0].lines}
    np.testing.assert_allclose(np.asarray(shown["measured: rig"]), np.column_stack(columns[:2]), rtol=1e-8)
    assert "correlation 1.000" in figure.axes[0].get_title(loc="left")
    # the same columns from Python, beside two runs
    given = {"mesh_phase [1]": phase, f"{ERROR} [m]": columns[1] * 1e-6}
    assert len(result.plot("measured", result, measured=given).axes[0].lines) == 3


def test_a_study_over_one_mesh_cycle_repeats(tmp_path: Path):
    """Load contact: measured over two and a half mesh cycles."""
    name = "loaded_transmission_error"
    result = td.run("load-contact-18-36", {"output.positions_per_cycle": 8})
    phase, error = result.data["phase"].values, result.data[name].values
    measured = np.arange(20) / 8
    given = {"mesh_phase [1]": measured, f"{name} [um]": np.interp(measured, phase, error, period=1.0) * 1e6}
    with Record(result.path) as record:
        assert beside(record, read_measured(given), name).difference < 1e-9


HEAD = f"mesh_phase [1],{ERROR} [um]"
ROWS = "0,1\n0.2,2\n0.4,3\n0.6,4\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "line 1: the file is empty"),
        (f"mesh_phase,{ERROR}\n{ROWS}", 'line 1: "mesh_phase" names no column'),
        (f"mesh_phase [1]|{ERROR} [um]\n0|1\n", "line 1"),
        (f"mesh_phase [1]\n{ROWS}", "two columns at least"),
        (f"{HEAD},{ERROR} [um]\n0,1,1\n", "none twice"),
        (f"{HEAD}\n0,1\n0.2\n", "line 3: 1 value under a header of 2"),
        (f"{HEAD}\n0,1\n0.2,abc\n", f'line 3: "abc" is not a number ({ERROR})'),
        (f"{HEAD}\n0,1\n0.2,nan\n0.3,1\n0.4,1\n", "row 2: nan: not a finite number"),
        (f"{HEAD}\n0,1\n0.2,2\n0.1,3\n0.3,4\n", "row 3: 0.1: does not increase"),
        (f"{HEAD}\n0,1\n0.2,2\n", "at least 4"),
        (f"{HEAD.replace('um', 'kg')}\n{ROWS}", '[kg]: "kg" is not a unit'),
        (f"mesh_phase [1],transmission_error [um]\n{ROWS}", f'did you mean "{ERROR}"'),
        (f"torque [N*m],{ERROR} [um]\n{ROWS}", "no such abscissa of this record"),
        (f"mesh_phase [1],normal_load [N]\n{ROWS}", "no such quantity of this record over its axis"),
    ],
)
def test_bad_files_are_refused_in_one_line(run: Path, text: str, said: str, tmp_path: Path):
    file = tmp_path / "bad.csv"
    file.write_text(text, encoding="utf-8")
    message = complaint("plot", run, "--measured", file, "-o", tmp_path)
    assert said in message
    assert "bad.csv" in message


def test_what_has_no_curves_over_a_run_is_refused(run: Path, tmp_path: Path):
    file = tmp_path / "te.csv"
    file.write_text(f"{HEAD}\n{ROWS}", encoding="utf-8")
    assert "draws one figure" in complaint("plot", run, "film", "--measured", file)
    assert "cannot be read" in complaint("plot", run, "--measured", tmp_path / "none.csv")
    with pytest.raises(td.InputError, match="no such way"):
        open_run(run).plot(measured=file, align="best")
    with pytest.raises(td.InputError, match="name \\[unit\\]"):
        open_run(run).plot(measured={"mesh_phase": [0, 1], ERROR: [0, 1]})
