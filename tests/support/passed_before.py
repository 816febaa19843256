"""Examples of pages that passed with the same sources before: they are not run again.

What an example does follows from its text, the files of the package, its models and scenarios, what runs it,
and the packages around. The cache folder keeps of every test the digest of these with which it passed last.
"""

import hashlib
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from importlib.metadata import distributions
from pathlib import Path

import pytest

from tribodyn.numerics.files.cache import keep, read_kept

ROOT = Path(__file__).parents[2]
FOLDER = "passed"


@cache
def sources(test: Path) -> bytes:
    """Digest of all that examples depend on besides their texts."""
    folders = ("tribodyn", "models", "scenarios", "tests/support")
    files = [path for name in folders for path in (ROOT / name).rglob("*") if path.is_file()]
    digest = hashlib.sha256(repr(sorted((one.name, one.version) for one in distributions())).encode())
    digest.update(sys.version.encode())
    for path in sorted(path for path in [*files, test] if path.suffix != ".pyc"):
        digest.update(path.relative_to(ROOT).as_posix().encode() + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest().encode()


@contextmanager
def unless_passed(request: pytest.FixtureRequest, text: str) -> Iterator[None]:
    """Skip a test whose text passed with the same sources; else note that it did, at the end.

    With `--measure-durations` nothing is skipped.
    """
    name = hashlib.sha256(request.node.nodeid.encode()).hexdigest()[:16]
    now = hashlib.sha256(sources(request.path) + text.encode()).hexdigest().encode()
    if read_kept(FOLDER, name) == now and not request.config.getoption("--measure-durations"):
        pytest.skip("passed before with the same sources")
    yield
    keep(FOLDER, name, now)
