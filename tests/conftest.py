"""What all tests share: the shipped drives, prepared once; the order of files; how hypothesis searches."""

import gc
import json
import sys
from functools import lru_cache

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from tests.support.durations import Durations, add_options
from tests.support.forked_verbs import ForkedVerbs
from tests.support.relative import approx, assert_allclose
from tests.support.short_studies import ShortRuns
from tests.support.soak_parameters import is_in_soak
from tribodyn.numerics.files.cache import trusted_folder
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

# The same examples every time: a failure belongs to the change at hand, not to the day. For new ones:
# pytest --hypothesis-profile=search
NO_MATTER = [HealthCheck.too_slow, HealthCheck.filter_too_much]
settings.register_profile("same", derandomize=True, deadline=None, suppress_health_check=NO_MATTER)
settings.register_profile("search", settings.get_profile("same"), derandomize=False, print_blob=True)
settings.load_profile("same")

pytest.approx, np.testing.assert_allclose = approx, assert_allclose


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options of the durations."""
    add_options(parser)


def pytest_configure(config: pytest.Config) -> None:
    """Sort the files by measured duration; nothing of what is imported and collected is garbage."""
    gc.disable()
    config.pluginmanager.register(Durations(config), "durations-of-tests")


def pytest_collection_finish() -> None:
    """Spare the garbage collector what is imported; keep what XLA compiles; draw coarse pictures.

    A round over all modules takes a good part of a second, and compilers allocate without end.
    """
    gc.collect()
    gc.freeze()
    gc.enable()
    gc.set_threshold(5_000, 10, 50)
    kept = trusted_folder("xla")
    if "jax" in sys.modules and kept:
        jax = sys.modules["jax"]
        jax.config.update("jax_compilation_cache_dir", str(kept))
        jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.2)
    if "tribodyn.post.style" in sys.modules:  # pixels of a picture take a third of its time
        sys.modules["tribodyn.post.style"].STYLE["savefig.dpi"] = 60


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark what the list of soak names; leave out what is marked so, unless `-m` names it."""
    for item in items:
        if is_in_soak(item.nodeid):
            item.add_marker(pytest.mark.soak)
    if "soak" in (config.getoption("markexpr") or ""):
        return
    config.hook.pytest_deselected(items=[item for item in items if item.get_closest_marker("soak")])
    items[:] = [item for item in items if not item.get_closest_marker("soak")]


@lru_cache(maxsize=32)
def _prepared(name: str, overrides: str) -> PreparedGearbox:
    return prepare(load_scenario(name, json.loads(overrides)))


@pytest.fixture(scope="session")
def prepared():
    """Prepare a shipped scenario with overrides: prepared("crc-23-47", **{"mesh.damping_ratio": 0.1})."""

    def make(name: str = "crc-23-47", **overrides) -> PreparedGearbox:
        return _prepared(name, json.dumps(overrides, sort_keys=True))

    return make


@pytest.fixture(scope="session")
def forked(tmp_path_factory: pytest.TempPathFactory):
    """Run a verb in a process of its own: forked("run", "crc-23-47", folder=tmp_path)."""
    verbs = ForkedVerbs(tmp_path_factory.mktemp("verbs"))
    yield verbs
    verbs.close()


@pytest.fixture(scope="session")
def short_runs(tmp_path_factory: pytest.TempPathFactory) -> ShortRuns:
    """Short run of the template of a kind of study: short_runs("efficiency").summary; see `ShortRuns`."""
    return ShortRuns(tmp_path_factory)


@pytest.fixture
def rng():
    """Random numbers with a fixed seed."""
    return np.random.default_rng(20221)
