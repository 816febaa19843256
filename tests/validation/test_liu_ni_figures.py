"""The figures of Liu & Ni show the numbers that the paper prints."""

import shutil

import numpy as np
import pytest
from matplotlib.figure import Figure

from tests.support.involute_run import involute_run
from tribodyn.record.reader import Record
from tribodyn.validation.papers.liu_ni_figures import FIGURES, MODELS, WITH_FRICTION, quasi_static_load
from tribodyn.validation.published import published


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory):
    folder = tmp_path_factory.mktemp("liu-ni")
    path = involute_run(folder / "run.h5")
    for name in {*MODELS.values(), *WITH_FRICTION.values()}:
        shutil.copy(path, folder / f"{name}.h5")
    return folder


def levels(drawn: Figure) -> list[float]:
    """Places of the level and upright lines that are dashed like printed numbers."""
    lines = [line for axes in drawn.axes for line in axes.lines if line.get_linestyle() == "--"]
    ends = [np.ravel([*line.get_xdata(), *line.get_ydata()]) for line in lines]
    return [float(line[2]) for line in ends if line[2] == line[3]] + [float(line[0]) for line in ends]


@pytest.mark.parametrize(
    ("name", "rows", "factor"),
    [
        ("figure-9", ["load-stcp-6dof", "load-stcp-mbd", "load-stcp-fem"], 1.0),
        ("figure-10", ["mesh-frequency", "mesh-harmonics"], 1.0),
        (
            "figure-12",
            [f"friction-pair{pair}-{drive}" for pair in (1, 0) for drive in ("crc", "involute")],
            1.0,
        ),
        ("figure-16", ["efficiency-crc", "efficiency-involute"], 100.0),
    ],
)
def test_printed_numbers_are_drawn(records, name: str, rows: list[str], factor: float):
    drawn = levels(FIGURES[name](records))
    for row in rows:
        for value in np.ravel(published("liu-ni-2022")[f"liu-ni/{row}"]["published"]):
            assert any(at == pytest.approx(factor * value, rel=1e-12) for at in drawn), row


def test_quasi_static_loads_of_figure_9_balance_the_torque(records):
    """Alone a pair carries T/(r_g cos α), both together the same, wherever they stand."""
    with Record(records / f"{MODELS['6 DOF']}.h5") as record:
        place, load = quasi_static_load(record, 500.0)
        ratio = float(record.mesh_cycle["contact_ratio"])
        last = float(record.mesh_cycle["roll_end"]) / (2.0 * np.pi / 23)
    whole = 500.0 / (0.0705 * np.cos(np.radians(20.0)))
    alone = (place > last - 0.99) & (place < last - ratio + 0.99)
    assert load[alone] == pytest.approx(whole, rel=1e-9)
    inside = np.isfinite(load)
    for at in (last - ratio + 0.1, last - ratio + 0.5):
        both = np.interp([at, at + 1.0], place[inside], load[inside])
        assert both.sum() == pytest.approx(whole, rel=1e-3)


@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_has_a_title(records, name: str):
    assert FIGURES[name](records).axes[0].get_title(loc="left")
