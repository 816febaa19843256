"""Loads of a pair along its way: from a record, from a table, refused ones; a way that is interrupted."""

from pathlib import Path

import numpy as np
import pytest

import tribodyn as td
from tribodyn.record.reader import Record
from tribodyn.studies.ehl.along_path import prepare, seen_by, solved_at, way
from tribodyn.studies.ehl.scenario import loads_of_record
from tribodyn.studies.ehl.squeezed import squeezed, steady_of
from tribodyn.studies.protocol.load import load

RECORDS = Path(__file__).parents[3] / "fixtures" / "records-0.1.0"


def test_a_pair_carries_over_its_way_what_all_pairs_carry_over_a_cycle():
    """In a periodic mesh; the record has ten samples per cycle."""
    found = loads_of_record(RECORDS / "gear-pair.h5", "contact.loads")
    roll, carried = (np.array(found[name]["values"]) for name in ("roll_angle", "normal_load"))
    with Record(RECORDS / "gear-pair.h5") as record:
        pitch = 2.0 * np.pi / record.mesh_cycle["pinion_teeth"]
        assert roll[0] == pytest.approx(record.mesh_cycle["roll_start"])
        every = np.sum(record["normal_load"][-10:], axis=1)
    assert np.trapezoid(carried, roll) == pytest.approx(np.mean(every) * pitch, rel=0.1)


@pytest.mark.parametrize(
    ("name", "rule"),
    [
        ("load-contact.h5", "no loads of pairs over time"),
        ("efficiency.h5", "before a pair has passed"),
        ("gear-pair.h5", "where a pair touches at"),
        ("none.h5", "or a record"),
    ],
)
def test_loads_of_another_kind(name, rule):
    with pytest.raises(td.InputError, match=rule):
        td.run("ehl-crc-23-47", {"contact.loads": str(RECORDS / name)})


def test_loads_of_a_table(tmp_path):
    """Linear between the points; a value below 0 counts as 0."""
    table = tmp_path / "loads.csv"
    table.write_text("roll_angle [deg],normal_load [kN]\n-11.7,-2\n0,6\n12.1,6\n")
    study = prepare(load("ehl-crc-23-47", {"contact.loads": str(table), "output.positions": 6}).case)
    over = way(study)
    expected = np.interp(np.degrees(over.roll), [-11.7, 0.0, 12.1], [0.0, 6e3, 6e3])
    np.testing.assert_allclose(over.normal_load, expected, rtol=1e-9)


def test_what_presses_nowhere_or_is_no_record(tmp_path):
    (tmp_path / "loads.csv").write_text("roll_angle [deg],normal_load [kN]\n-11.7,-2\n0,0\n12.1,-1\n")
    (tmp_path / "loads.h5").write_text("nothing")
    for name, rule in (("loads.csv", "no contact to solve"), ("loads.h5", "not an HDF5 file")):
        with pytest.raises(td.InputError, match=rule) as caught:
            td.run("ehl-crc-23-47", {"contact.loads": str(tmp_path / name)})
        assert caught.value.key == "contact.loads"


def test_the_step_is_that_of_the_grid():
    """Half the nodes, and a film within 0.3 %; the record's contacts are solved with the case's."""
    found = {}
    for step in (0.1, 0.2):
        study = prepare(load("ehl-crc-23-47", {"output.positions": 4, "contact.step": step}).case)
        assert study.case.step == step
        over = way(study)
        seen = seen_by(study, over)
        found[step] = solved_at(study, over, seen, 1).solution
    assert 1.7 < len(found[0.1].place) / len(found[0.2].place) < 2.2
    films = [solution.central_film_thickness for solution in found.values()]
    assert 0.0 < abs(films[1] / films[0] - 1.0) < 3e-3


def test_the_film_begins_anew_behind_a_loss_of_contact():
    """Where the pair carries nothing there is no film; behind it the first one is steady."""
    study = prepare(
        load("ehl-crc-23-47", {"output.positions": 8, "contact.transient": True, "contact.step": 0.2}).case
    )
    over = way(study)
    seen = seen_by(study, over)
    solved = {at: solved_at(study, over, seen, at) for at in (1, 2, 5, 6, 7)}
    steady = [steady_of(known) if (known := solved.get(at)) else None for at in range(8)]
    found = squeezed(over, study.case, steady, lambda _share: None)
    film = found["transient_central_film_thickness"]
    assert list(np.isfinite(film)) == [known is not None for known in steady]
    assert found["restarts"] == 1
    for first in (1, 5):
        known = solved[first]
        assert known is not None
        central = np.interp(0.0, known.solution.place, known.solution.mean_gap)
        assert film[first] == pytest.approx(central, rel=2e-3)
