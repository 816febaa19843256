"""Changes of the physics at random: what is changed, what is not, and which tests are run for it."""

import ast
from pathlib import Path

import pytest

from tools import mutants
from tools.mutants import HERE, PACKAGE, changes

SOURCE = '''"""Text with 1 + 1 and äöü."""

def law(x: float = 2.0, y: "int" = 3) -> "Float[Array, 4]":
    """Half of 0.5 is not changed."""
    if not (x < y) and y != 0:  # a comment with a - b
        raise ValueError(f"{x + 1} of {len(str(x)) - 2}")
    return -(x) ** 2 * (y - 1) / 0.0  # ψ − φ
'''


@pytest.fixture
def package(tmp_path: Path) -> Path:
    (tmp_path / "geometry").mkdir()
    (tmp_path / "geometry" / "law.py").write_text(SOURCE, encoding="utf-8")
    return tmp_path


def test_every_change_is_one_other_program(package):
    found = changes(package, ["geometry"])
    made = [change.made(SOURCE.encode()) for change in found]
    trees = [ast.dump(ast.parse(text)) for text in made]
    assert len(set(trees)) == len(trees)
    assert ast.dump(ast.parse(SOURCE)) not in trees
    # 2.0, 3; not, <, and, !=, 0; −, **, 2, *, −, 1, /, 0.0: nothing of annotations, text and messages
    assert len(found) == 15
    assert {change.line for change in found} == {3, 5, 7}
    lines = {change.made(SOURCE.encode()).decode().split("\n")[change.line - 1].strip() for change in found}
    assert "if not (x >= y) and y != 0:  # a comment with a - b" in lines
    assert "if  (x < y) and y != 0:  # a comment with a - b" in lines
    assert "return -(x) ** 2 * (y - 1) / 1.0  # ψ − φ" in lines
    assert "return (x) ** 2 * (y - 1) / 0.0  # ψ − φ" in lines


def test_tests_are_those_that_name_a_module_and_those_that_depend_on_it():
    stages = mutants.tests_of("tribodyn.mesh.quasi_static", HERE / PACKAGE, HERE / "tests")
    near, near_rest, far, far_rest = ({Path(file).name for file in files} for files in stages)
    assert "test_power_flow.py" in near
    assert "test_mesh_cycle.py" in near_rest
    assert "test_equations.py" in far
    assert "test_modes.py" in far_rest
    assert "test_geometry_rack.py" not in far | far_rest


SUITE = """
from pathlib import Path
from tribodyn.geometry.law import law

def test_fails_once():
    mark = Path(__file__).with_name("mark")
    assert mark.exists() or mark.touch()

def test_same():
    assert law(2.0) == 2.0
"""


@pytest.mark.slow
def test_what_fails_by_chance_notices_nothing(tmp_path):
    law, suite = tmp_path / PACKAGE / "geometry" / "law.py", tmp_path / "tests/unit/geometry/test_law.py"
    for file, text in ((law, "def law(x):\n    return x + 0\n"), (suite, SUITE)):
        file.parent.mkdir(parents=True)
        file.write_text(text, encoding="utf-8")
    (tmp_path / PACKAGE / "__init__.py").touch()
    same, another = changes(tmp_path / PACKAGE, ["geometry"])
    test = "tests/unit/geometry/test_law.py::test_"
    tests = mutants.Tests(tmp_path, 60)
    with tests.server:
        assert tests.noticed(same, every=True) == ""
        assert tests.failing == {test + "fails_once"}
        assert tests.noticed(another, every=True) == test + "same"
