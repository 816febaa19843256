"""A train whose teeth part and stay apart while its last cycles pass: a whole record, and what is said."""

import math

import pytest

from tests.support.short_studies import short_case
from tribodyn.gears.prepare import contact_quantities
from tribodyn.record.reader import MESHES, Record
from tribodyn.studies.motion.report import verdict
from tribodyn.studies.motion.run import run


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    """The load swings by a hundred times its mean and pulls the teeth apart at once."""
    folder = tmp_path_factory.mktemp("apart")
    swinging = [{"amplitude": "2000 N*m", "frequency": "20 Hz", "phase": "90 deg"}]
    changes = {"operating__output_torque": "20 N*m", "operating__output_torque_harmonics": swinging}
    case = short_case("gear-train", folder, **changes)
    result = run(case, folder / "apart.h5")
    assert result.status == "complete", result.message
    with Record(folder / "apart.h5") as opened:
        yield opened


def test_the_record_is_complete_without_what_teeth_in_contact_have(record):
    assert record.status == "complete"
    for mesh in record.summary[MESHES].values():
        assert mesh["contact_loss_fraction"] == 1.0
        assert mesh["normal_load_max"] == 0.0
        assert math.isnan(mesh["friction_coefficient_mean"])
        assert "contact_temperature_max" not in mesh


def test_the_verdict_says_that_the_teeth_are_apart(record):
    assert any("apart for all of the time" in line for line in verdict(record))
    assert not any(math.nan in (value,) for value in record.summary.get("worst_mesh", {}).values())


def test_without_contact_there_is_no_contact_temperature(record):
    oil = short_case("gear-train", record.path.parent).meshes[0].pair.lubricant
    assert contact_quantities(oil, {}) == {}
    warm = contact_quantities(oil, {"flash_temperature_max": 10.0, "bulk_temperature": 350.0})
    assert warm == {"contact_temperature_max": 360.0}
