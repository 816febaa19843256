"""The reading of a package: its imports wherever they stand, and its circles."""

from pathlib import Path

import pytest

from tools.package_shape import by_file, by_folder, circles, imports

FILES = {
    "__init__.py": "",
    "loose.py": "",
    "low/__init__.py": "",
    "low/data.py": "import numpy as np\n",
    "low/far.py": "def late():\n    from tribodyn.high import top\n    return top\n",
    "high/__init__.py": "",
    "high/top.py": (
        "from typing import TYPE_CHECKING\n"
        "from ..low import data\n"
        "from tribodyn.low.far import late\n"
        "if TYPE_CHECKING:\n    from tribodyn.high.other import Other\n"
    ),
    "high/other.py": "from tribodyn.high import top\nKIND = 'irefc'\n",
}


@pytest.fixture
def package(tmp_path: Path) -> Path:
    for name, text in FILES.items():
        path = tmp_path / "tribodyn" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return tmp_path / "tribodyn"


def test_imports_are_read_wherever_they_stand(package):
    read = {(found.importer, found.imported, found.typing_only) for found in imports(package)}
    assert read == {
        ("tribodyn.low.data", "numpy", False),
        ("tribodyn.low.far", "tribodyn.high.top", False),
        ("tribodyn.high.top", "typing", False),
        ("tribodyn.high.top", "tribodyn.low.data", False),
        ("tribodyn.high.top", "tribodyn.low.far", False),
        ("tribodyn.high.top", "tribodyn.high.other", True),
        ("tribodyn.high.other", "tribodyn.high.top", False),
    }


def test_circles_close_by_late_imports(package):
    assert circles(by_file(package)) == [["tribodyn.high.top", "tribodyn.low.far"]]
    assert circles(by_file(package, typing_too=True)) == [
        ["tribodyn.high.other", "tribodyn.high.top", "tribodyn.low.far"]
    ]
    assert circles(by_folder(package)) == [["high", "low"]]
