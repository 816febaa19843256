"""Cases on the way from a case to its neighbour."""

import pytest

from tribodyn.studies.motion.batch.steady import prepared_between
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.batch import NeighbourWay


@pytest.mark.parametrize("speed", [400.0, 500.0, 650.0])
def test_a_place_on_the_way_has_its_own_speed(speed, prepared):
    """At the neighbour, between, and beyond the case."""
    at_start, at_target = (
        prepared("crc-23-47", **{"operating.pinion_speed": f"{v} rad/s"}) for v in (400, 600)
    )
    way = NeighbourWay(at_start.case, 400.0, 600.0, 1, (100.0, 700.0))
    prepared_at = prepared_between([at_target], [way], prepare=prepare)
    assert prepared_at(0, 600.0) is at_target
    found = prepared_at(0, speed)
    assert found.case.pair.operating.pinion_speed == pytest.approx(speed)
    assert float(found.model.operation.nominal_speed) == pytest.approx(speed)
