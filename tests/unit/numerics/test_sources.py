"""The sources that a cached result depends on, and files that appear whole."""

import subprocess
import sys
from pathlib import Path

import pytest

from tribodyn.compliance import fem_cache
from tribodyn.kernels.native import store
from tribodyn.numerics import sources
from tribodyn.numerics.cache import replacing

FILES = {
    "__init__.py": "",
    "start.py": (
        "from {name}.direct import a\nfrom {name} import (  # two\n    module,\n    part as other,\n)\n"
    ),
    "direct.py": "def a():\n    import {name}.lazy\n",
    "module.py": "from .relative import b\n",
    "part/__init__.py": "from ..above import c\n",
    "lazy.py": "",
    "relative.py": "",
    "above.py": "",
    "unused.py": "import numpy\n",
    "typed.py": "",
    "checked.py": "",
}
UNUSED = {"unused.py", "typed.py"}


def write_package(folder: Path, name: str) -> None:
    for file, text in FILES.items():
        path = folder / name / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.format(name=name))
    start = folder / name / "start.py"
    typed = f"if TYPE_CHECKING:\n    from {name}.typed import d\n\nfrom {name}.checked import e\n"
    start.write_text(start.read_text() + typed)


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Make a package in which a file may be changed; gives the digest of its module `start`."""
    monkeypatch.syspath_prepend(str(tmp_path))

    def digest(name: str, changed: str | None = None) -> bytes:
        folder = tmp_path / name
        if not folder.is_dir():
            write_package(tmp_path, name)
        if changed:
            path = folder / changed
            path.write_text(path.read_text() + "x = 1\n")
        for function in (sources._file_of, sources._text, sources._imports):
            function.cache_clear()
        return sources.digest_of(f"{name}.start")

    return digest


@pytest.mark.parametrize("file", [file for file in FILES if file not in UNUSED])
def test_changing_any_imported_file_changes_the_digest(package, file):
    before = package("some_package")
    assert package("some_package") == before
    assert package("some_package", file) != before


@pytest.mark.parametrize("file", sorted(UNUSED))
def test_a_file_that_is_not_imported_or_for_a_checker_alone_does_not(package, file):
    assert package("another_package") == package("another_package", file)


@pytest.mark.parametrize(
    ("start", "expected"),
    [
        (
            ["tribodyn.solve.methods.rodas4"],
            ["solve.rosenbrock", "solve.jacobian", "dynamics.equations", "kernels.native.records"],
        ),
        (["tribodyn.solve.lane_march"], ["kernels.lanes.functions", "solve.step_control"]),
        (fem_cache._METHODS, ["compliance.lead_harmonics", "compliance.strips", "compliance.local"]),
    ],
)
def test_what_the_cached_results_come_from(start, expected):
    behind = sources.modules_behind(*start)
    for name in expected:
        assert f"tribodyn.{name}" in behind, name
    assert not any(name.startswith(("tribodyn.cli", "tribodyn.record", "tribodyn.post")) for name in behind)


def test_every_module_that_compiling_a_kernel_loads_is_in_its_digest():
    """The interpreter itself says which: all that is loaded after a kernel was compiled."""
    script = (
        "import sys\n"
        "from tribodyn.solve.methods import rodas4\n"
        "import tribodyn.kernels.native.compiler\n"
        "from tribodyn.numerics.sources import modules_behind\n"
        "behind = modules_behind('tribodyn.solve.methods.rodas4')\n"
        "print(*(m for m in sys.modules if m.split('.')[0] == 'tribodyn' and m not in behind))\n"
    )
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert ended.stdout.split() == []


def test_a_kernel_depends_on_its_own_module_and_on_the_compiler():
    assert store._digest("tribodyn.solve.methods.dopri5") != store._digest("tribodyn.solve.methods.rodas4")


def test_a_file_appears_whole_or_not_at_all(tmp_path):
    file = tmp_path / "folder" / "result"
    with replacing(file) as scratch:
        scratch.write_text("first")
        assert not file.exists()

    def write_half():
        with replacing(file) as scratch:
            scratch.write_text("half")
            raise KeyError

    with pytest.raises(KeyError):
        write_half()
    assert file.read_text() == "first"
    assert list(file.parent.iterdir()) == [file]
