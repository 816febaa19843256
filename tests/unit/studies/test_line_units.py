"""What is shown of a figure is in the unit that stands beside it."""

import math

import pytest

from tribodyn.studies import STUDIES
from tribodyn.studies.gears.shared import MESH_FREQUENCY, NORMAL_LOAD, SINGLE_PAIR

#: Of one in SI.
FACTORS = {
    "": 1.0,
    "%": 100.0,
    "mm": 1e3,
    "µm": 1e6,
    "mm/s": 1e3,
    "N": 1.0,
    "N m": 1.0,
    "N/mm": 1e-3,
    "N/µm": 1e-6,
    "MPa": 1e-6,
    "GPa": 1e-9,
    "W": 1.0,
    "Hz": 1.0,
    "s": 1.0,
    "K": 1.0,
    "°C": 1.0,
    "°": 180.0 / math.pi,
    "rad/s": 1.0,
    "rpm": 30.0 / math.pi,
}
LINES = [
    line
    for _, study in STUDIES.items()
    if study.package.startswith("tribodyn.")
    for lines in study.lines().values()
    for line in lines
]


@pytest.mark.parametrize("unit", sorted({line.unit for line in LINES}))
def test_every_line_is_shown_in_its_unit(unit: str):
    for line in LINES:
        if line.unit == unit:
            assert line.factor == pytest.approx(FACTORS[unit], rel=1e-12), line.name
            assert line.offset == (-273.15 if unit == "°C" and line.offset else 0.0)


def test_lines_that_studies_share():
    shared = {line.name for line in LINES}
    assert {one.name for one in (MESH_FREQUENCY, NORMAL_LOAD, SINGLE_PAIR)} <= shared
