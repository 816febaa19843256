"""Bodies that a page moves touch where they are said to touch, at any position."""

from collections.abc import Iterator

import numpy as np
import pytest

from tests.support.outlines import closed, distance, turned
from tests.support.pages import data_of, unpacked
from tribodyn.geometry.body import geometry_arrays
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.post.page.motion import turning_teeth
from tribodyn.record.reader import Record
from tribodyn.studies import study_of
from tribodyn.studies.irefc.geometry import cam_outline, crown_outline
from tribodyn.studies.pages import write_report
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run


@pytest.fixture(scope="module")
def rolling(tmp_path_factory) -> Iterator[Record]:
    """A turn of the shipped gear with rolling elements."""
    result = run(load_scenario("irefc"), tmp_path_factory.mktemp("irefc") / "irefc.h5")
    with Record(result.path) as record:
        yield record


def test_elements_touch_cam_and_crown(rolling, rng):
    """To 0.1 µm, between outlines so fine that their chords leave 0.02 µm."""
    study = study_of(rolling.scenario)
    found = study.besides("mechanism", rolling)
    assert found is not None
    _, crown, cam, cage, *elements = found.bodies
    radius, count = float(rolling.geometry["element_radius"]), rolling.scenario["drive"]["elements"]
    assert len(elements) == count
    drive = load_scenario("irefc").drive
    fine = (crown, crown_outline(drive, 2000)), (cam, cam_outline(drive, 2000))
    for sample in rng.choice(rolling.samples, 12):
        for (body, outline), number in zip(fine, rng.choice(count, 2), strict=True):
            x, y, angle = body.pose[sample]
            placed = turned(outline, angle) + np.array([x, y])
            centre = elements[number].pose[sample, :2]
            assert distance(centre, closed(placed)) == pytest.approx(radius, abs=1e-7)
        # and the cage carries it along
        first = elements[0].pose[sample, :2] - cage.pose[sample, :2]
        assert np.angle(complex(*first) * np.exp(-1j * cage.pose[sample, 2])) == pytest.approx(0, abs=1e-9)


def test_arrows_lie_where_the_record_has_loads(rolling, rng):
    """The element of a load stands where the record's angle from the eccentric has it."""
    found = study_of(rolling.scenario).besides("mechanism", rolling)
    assert found is not None
    shaft, angle = rolling["input_angle"], rolling["element_angle"]
    cage = found.bodies[3].pose
    for sample in rng.choice(rolling.samples, 12):
        for number in rng.choice(angle.shape[1], 3):
            place = found.bodies[4 + number].pose[sample, :2] - cage[sample, :2]
            expected = np.exp(1j * (shaft[sample] + angle[sample, number]))
            assert complex(*place) / abs(complex(*place)) == pytest.approx(expected, abs=1e-9)


def test_a_page_draws_elements_and_cage(rolling, tmp_path):
    (data,) = data_of(write_report([rolling], tmp_path / "irefc.html"))["records"]
    fills = [body["fill"] for body in data["teeth"]["bodies"]]
    assert fills == ["gear", "paper", "pinion", "ring"] + ["paper"] * rolling.scenario["drive"]["elements"]
    assert data["teeth"]["title"] == "Cam, rolling elements, cage and crown"


@pytest.mark.parametrize("scenario", ["crc-23-47", "involute-18-36"])
def test_contacts_of_gears_that_turn_by_themselves_lie_on_both_flanks(scenario, rng):
    case = load_scenario(scenario)
    shape = geometry_arrays(check(family(case.pair.family), case.pair.drive))
    teeth = turning_teeth(shape, float(case.pair.drive.pinion.teeth))
    pinion, gear = (unpacked(teeth[name]).astype(float).reshape(-1, 2) for name in ("pinion", "gear"))
    roll, (rp, rg) = unpacked(teeth["roll"], "<f8"), teeth["radii"]
    x, y = (unpacked(teeth[name]).astype(float).reshape(-1, teeth["pairs"]) for name in "xy")
    found = 0
    for frame in rng.choice(len(roll), 15):
        places = turned(pinion, -roll[frame]), turned(gear, roll[frame] * rp / rg)
        places[0][:, 1] -= rp
        places[1][:, 1] += rg
        for point in np.stack([x[frame], y[frame]], axis=1)[np.isfinite(x[frame])]:
            found += 1
            assert max(distance(point, closed(place)) for place in places) < 1e-6
    assert found >= 15
