"""The figures of Liu & Ni show the numbers that the paper prints."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from tests.support import synthetic_record
from tribodyn.validation.liu_ni_figures import FIGURES
from tribodyn.validation.published import published


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory):
    folder = tmp_path_factory.mktemp("liu-ni")
    for name in ("crc-23-47", "involute-23-47", "crc-23-47-frictionless"):
        synthetic_record.write(folder / f"{name}.h5", per_cycle=60)
    return folder


def levels(drawn: Figure) -> list[float]:
    """Places of the level and upright lines that are dashed like printed numbers."""
    lines = [line for line in drawn.axes[0].lines if line.get_linestyle() == "--"]
    ends = [np.ravel([*line.get_xdata(), *line.get_ydata()]) for line in lines]
    return [float(line[2]) for line in ends if line[2] == line[3]] + [float(line[0]) for line in ends]


@pytest.mark.parametrize(
    ("name", "rows", "factor"),
    [
        ("normal-load", ["load-stcp-6dof", "load-stcp-fem"], 1.0),
        (
            "friction-force",
            [f"friction-pair{pair}-{drive}" for pair in (1, 0) for drive in ("crc", "involute")],
            1.0,
        ),
        ("efficiency", ["efficiency-crc", "efficiency-involute"], 100.0),
        ("spectrum", ["mesh-frequency"], 1e-3),
    ],
)
def test_printed_numbers_are_drawn(records, name: str, rows: list[str], factor: float):
    drawn = levels(FIGURES[name](records))
    for row in rows:
        value = factor * published("liu-ni-2022")[f"liu-ni/{row}"]["published"]
        assert any(at == pytest.approx(value, rel=1e-12) for at in drawn), row


@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_has_a_title(records, name: str):
    assert FIGURES[name](records).axes[0].get_title(loc="left")
