"""What tests of several files need and one process makes for all."""

import fcntl
import os
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Generic, TypeVar

import pytest

T = TypeVar("T")


class OncePerSession(Generic[T]):
    """Things by name, (name) -> thing; `make` is called with the name and a folder of the thing's own."""

    def __init__(
        self, tmp_path_factory: pytest.TempPathFactory, folder: str, make: Callable[[str, Path], T]
    ) -> None:
        own = tmp_path_factory.getbasetemp()
        self.folder = (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / folder
        self.folder.mkdir(exist_ok=True)
        self.make = make

    def __call__(self, name: str) -> T:
        """Make it, or wait for the process that does."""
        kept = self.folder / f"{name}.pickle"
        with (self.folder / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not kept.exists():
                own = self.folder / name
                own.mkdir()
                kept.write_bytes(pickle.dumps(self.make(name, own)))
        return pickle.loads(kept.read_bytes())
