"""Shafts as a page draws them: bent as beams that carry what the run says, and turning in a browser."""

import math
from collections.abc import Iterator

import numpy as np
import pytest

from tests.support.housed_train import written
from tests.support.overhung_train import overhung_train
from tests.support.pages import data_of, needs_browser, shown, unpacked
from tests.support.train_scenarios import case_of_table
from tribodyn.post.page.solid import Solid
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.shaft_lines import deflections
from tribodyn.studies.motion.pictures.deflected_gearbox import deflected_gearbox
from tribodyn.studies.motion.run import run
from tribodyn.studies.pages import write_report
from tribodyn.studies.protocol.load import load_scenario


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Record]:
    """A cycle of an overhung right-handed pinion."""
    path = tmp_path_factory.mktemp("overhung") / "run.h5"
    run(case_of_table(overhung_train()), path)
    with Record(path) as found:
        yield found


@pytest.fixture(scope="module")
def solid(record: Record) -> Solid:
    found = deflected_gearbox(record)
    assert found is not None
    return found


def at(record: Record, shaft: int, place: float) -> int:
    """The station of a shaft so far behind its start, m."""
    number, z = record.geometry["station_shaft"], record.geometry["station_z"]
    own = np.flatnonzero(number == shaft)
    return int(own[np.argmin(np.abs(z[own] - z[own[0]] - place))])


def test_springs_carry_what_the_shaft_moves_there(record: Record):
    moved = deflections(record)
    for bearing, (shaft, place) in enumerate([(0, 0.02), (0, 0.085), (1, 0.015), (1, 0.105)]):
        for axis, name in enumerate("xy"):
            force = 4e8 * moved[:, at(record, shaft, place), axis]
            recorded = record[f"bearing_force_{name}"][:, bearing]
            np.testing.assert_allclose(force, recorded, rtol=1e-6, atol=1e-3)


def test_springs_in_a_housing_carry_what_the_shaft_moves_against_their_seats(tmp_path):
    """Exactly at rest, where it begins; later the modes of the housing, which are no part, give up to 5 %."""
    case = load_scenario(written(tmp_path, solver={"cycles": 1}, output={"samples_per_cycle": 16}))
    run(case, tmp_path / "run.h5")
    with Record(tmp_path / "run.h5") as record:
        shafts, seats = deflections(record), deflections(record, "housing")
        assert np.max(np.abs(seats)) > 1e-7
        for bearing, (shaft, place) in enumerate([(0, 0.0), (0, 0.175), (1, 0.0), (1, 0.175)]):
            for axis, name in enumerate("xy"):
                apart = shafts[:, at(record, shaft, place), axis] - seats[:, bearing, axis]
                recorded = record[f"bearing_force_{name}"][:, bearing]
                assert 3e8 * apart[0] == pytest.approx(recorded[0], rel=1e-6, abs=1e-2)
                np.testing.assert_allclose(3e8 * apart, recorded, atol=0.05 * np.max(np.abs(recorded)))
        found = deflected_gearbox(record)
        assert found is not None
        write_report([record], tmp_path / "page.html")
        np.testing.assert_array_equal(found.carried, seats)


def test_the_free_end_stays_straight(record: Record):
    moved, body = deflections(record)[:, at(record, 0, 0.15)], 0
    x, y, tilt_x, tilt_y = (record[name][:, body] for name in ("x", "y", "tilt_x", "tilt_y"))
    np.testing.assert_allclose(moved[:, 0], x + 0.02 * tilt_y, rtol=1e-9)
    np.testing.assert_allclose(moved[:, 1], y - 0.02 * tilt_x, rtol=1e-9)
    np.testing.assert_allclose(moved[:, 2], record["z"][:, body], rtol=1e-9)


def test_gears_have_the_teeth_and_the_hands_that_were_asked_for(solid: Solid):
    gears = {disc.name: disc for disc in solid.discs}
    assert {name: disc.teeth for name, disc in gears.items()} == {"one": 25, "two": 50}
    # without profile shift: pitch radius m z/(2 cos β)
    for name, sign in (("one", 1.0), ("two", -1.0)):
        radius = 1.5e-3 * gears[name].teeth / math.cos(math.radians(15.0))
        twist = sign * 0.03 * math.tan(math.radians(15.0)) / radius
        assert gears[name].twist == pytest.approx(twist, rel=1e-9)


def test_a_page_has_every_position_and_says_how_much_larger(record: Record, solid: Solid, tmp_path):
    (data,) = data_of(write_report([record], tmp_path / "page.html"))["records"]
    moved = unpacked(data["solid"]["moved"]).reshape(solid.moved.shape)
    np.testing.assert_allclose(moved, solid.moved, rtol=1e-6, atol=1e-12)
    assert data["solid"]["times"] in {digit * 10.0**power for digit in (1, 2, 5) for power in range(6)}


@needs_browser
def test_a_browser_draws_it(record: Record, tmp_path):
    page = write_report([record], tmp_path / "page.html")
    dom = shown(page.resolve().as_uri(), "--virtual-time-budget=4000")
    assert "data-solid=" in dom
    assert "displacements × " in dom
    assert '<section id="solid-section">' in dom
