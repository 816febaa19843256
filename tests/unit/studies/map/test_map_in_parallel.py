"""A map by several processes, and by a cluster, is that of one; a process that ends is said so."""

from pathlib import Path

import numpy as np
import pytest

from tribodyn.errors import SimulationError
from tribodyn.record.reader import Record
from tribodyn.studies.map.case import MapCase
from tribodyn.studies.map.evaluation import PointStore, evaluators
from tribodyn.studies.map.looked_up import loaded_map
from tribodyn.studies.map.refinement import nodes_of
from tribodyn.studies.protocol.run import run


@pytest.fixture(scope="module")
def case() -> MapCase:
    axes = {"torque": ["100 N*m", "500 N*m"], "speed": ["0 rpm", "1500 rpm"], "accuracy": 0.0}
    return loaded_map("spur-25-51", axes, {"friction.law": "coulomb", "friction.coefficient": 0.05}).case


def test_two_processes_find_what_one_finds(case: MapCase):
    axes = np.linspace(50.0, 500.0, 12), np.linspace(0.0, 150.0, 12), case.axes[2]
    found = []
    for points in (1, 1000):
        with evaluators(case, points, None) as workers:
            assert workers.count <= points
            store = PointStore(case, workers)
            found.append(store.at(nodes_of(axes)))
            assert len(store) == 144
    one, several = found
    np.testing.assert_array_equal(one.drag, several.drag)
    assert one.sources == several.sources
    for name, values in one.meshes.items():
        np.testing.assert_array_equal(values, several.meshes[name])


def test_a_process_that_ends_is_said_so(case: MapCase):
    with evaluators(case, 1000, None) as workers:
        if workers.count < 2:
            pytest.skip("one core: there is no other process")
        points = [(100.0 + i, 10.0, float(case.axes[2][0])) for i in range(40)]
        answers = [workers.submit([point]) for point in points[:20]]
        assert all(answer.result()["drag"] for answer in answers)
        for process in workers.processes:
            process.kill()
            process.wait()
        answers = [workers.submit([point]) for point in points[20:]]
        with pytest.raises(SimulationError, match="a process that evaluates points of the map ended"):
            [answer.result() for answer in answers]


def test_a_cluster_finds_what_this_machine_finds(case: MapCase, tmp_path: Path):
    distributed = pytest.importorskip("distributed")
    run(case, tmp_path / "here.h5")
    with distributed.Client(
        processes=False, n_workers=1, threads_per_worker=1, dashboard_address=None
    ) as client:
        run(case, tmp_path / "there.h5", client=client)
    with Record(tmp_path / "here.h5") as here, Record(tmp_path / "there.h5") as there:
        np.testing.assert_array_equal(here["drag"], there["drag"])
