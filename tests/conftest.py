"""Fixtures that several test folders share: the shipped drives, prepared once."""

import json
from functools import lru_cache

import numpy as np
import pytest

from tribodyn.prepare import Prepared, prepare
from tribodyn.scenario.load import load_scenario


@lru_cache(maxsize=32)
def _prepared(name: str, overrides: str) -> Prepared:
    return prepare(load_scenario(name, json.loads(overrides)))


@pytest.fixture(scope="session")
def prepared():
    """Prepare a shipped scenario with overrides: prepared("crc-23-47", **{"mesh.damping_ratio": 0.1})."""

    def make(name: str = "crc-23-47", **overrides) -> Prepared:
        return _prepared(name, json.dumps(overrides, sort_keys=True))

    return make


@pytest.fixture
def rng():
    """Random numbers with a fixed seed."""
    return np.random.default_rng(20221)
