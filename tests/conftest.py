"""What all tests share: the shipped drives, prepared once; the order of files; how hypothesis searches."""

import json
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from tests.support.forked_verbs import ForkedVerbs
from tribodyn.studies.gear_pair.prepare import Prepared, prepare
from tribodyn.studies.load import load_scenario

#: Files that take longest, longest first: begun last, one would keep a worker busy after the others are done.
LONGEST = (
    "cross/test_solvers_agree.py",
    "unit/mesh/test_tabulate.py",
    "cross/test_backends.py",
    "cli/test_shipped_scenarios.py",
    "cli/test_docs.py",
    "unit/geometry/test_geometry_gradients.py",
    "cross/test_families.py",
    "cross/test_jax_ensemble.py",
    "property/test_geometry_pair.py",
    "unit/solve/test_ensemble.py",
    "validation/test_jia.py",
    "fault/test_bad_runs.py",
    "fault/test_killed_sweep.py",
    "unit/studies/gear_pair/test_plots.py",
    "cli/test_sweep.py",
)
TESTS = Path(__file__).parent

# The same examples every time: a failure belongs to the change at hand, not to the day. For new ones:
# pytest --hypothesis-profile=search
NO_MATTER = [HealthCheck.too_slow, HealthCheck.filter_too_much]
settings.register_profile("same", derandomize=True, deadline=None, suppress_health_check=NO_MATTER)
settings.register_profile("search", settings.get_profile("same"), derandomize=False, print_blob=True)
settings.load_profile("same")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Sort by file, the longest first; the order within a file stays."""
    place = {TESTS / name: number for number, name in enumerate(LONGEST)}
    items.sort(key=lambda item: place.get(item.path, len(place)))


@lru_cache(maxsize=32)
def _prepared(name: str, overrides: str) -> Prepared:
    return prepare(load_scenario(name, json.loads(overrides)))


@pytest.fixture(scope="session")
def prepared():
    """Prepare a shipped scenario with overrides: prepared("crc-23-47", **{"mesh.damping_ratio": 0.1})."""

    def make(name: str = "crc-23-47", **overrides) -> Prepared:
        return _prepared(name, json.dumps(overrides, sort_keys=True))

    return make


@pytest.fixture(scope="session")
def forked(tmp_path_factory: pytest.TempPathFactory):
    """Run a verb in a process of its own: forked("run", "crc-23-47", folder=tmp_path)."""
    verbs = ForkedVerbs(tmp_path_factory.mktemp("verbs"))
    yield verbs
    verbs.close()


@pytest.fixture
def rng():
    """Random numbers with a fixed seed."""
    return np.random.default_rng(20221)
