"""Examples of pages, and shipped scenarios, that passed with the same sources before: they are not run again.

What they do follows from their text, the files of the package, its models and scenarios, what runs it, the
packages around, the processor and the variables that set up libraries. The cache folder keeps of every test
the digest of these with which it passed last.
"""

import hashlib
import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from importlib.metadata import distributions
from pathlib import Path

import llvmlite.binding as llvm
import pytest

from tribodyn.numerics.files.cache import keep, read_kept

ROOT = Path(__file__).parents[2]
FOLDER = "passed"
LIBRARIES = ("OPENBLAS_", "OMP_", "MKL_", "NPY_", "NUMBA_", "XLA_", "JAX_")


def digest_of(folders: Iterable[str], files: Iterable[Path]) -> str:
    """Digest of files, of all files in folders of the checkout, of Python and of the packages around."""
    every = {path for name in folders for path in (ROOT / name).rglob("*") if path.is_file()} | {*files}
    digest = hashlib.sha256(repr(sorted((one.name, one.version) for one in distributions())).encode())
    digest.update(repr((sys.version, llvm.get_host_cpu_name(), _settings())).encode())
    for path in sorted(path for path in every if path.suffix != ".pyc"):
        digest.update(path.relative_to(ROOT).as_posix().encode() + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def _settings() -> list[tuple[str, str]]:
    """Variables by which BLAS, NumPy, numba and XLA compute otherwise."""
    return sorted(one for one in os.environ.items() if one[0].startswith(LIBRARIES))


@cache
def sources(test: Path) -> str:
    """Digest of all that examples depend on besides their texts."""
    return digest_of(("tribodyn", "models", "scenarios", "tests/support"), [test])


@contextmanager
def unless_passed(request: pytest.FixtureRequest, text: str) -> Iterator[None]:
    """Skip a test whose text passed with the same sources; else note that it did, at the end.

    With `--measure-durations` nothing is skipped.
    """
    name = hashlib.sha256(request.node.nodeid.encode()).hexdigest()[:16]
    now = hashlib.sha256((sources(request.path) + text).encode()).hexdigest().encode()
    if read_kept(FOLDER, name) == now and not request.config.getoption("--measure-durations"):
        pytest.skip("passed before with the same sources")
    yield
    keep(FOLDER, name, now)
