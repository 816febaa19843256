"""Messages reach a Python program in its own words."""

import ast
import inspect
import re
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.interface.scenario import in_python, python_words

ROOT = Path(inspect.getfile(td)).parent
#: Options of the command line.
FOREIGN = re.compile(r"(?<![\w-])--[a-z]")
#: Folders whose texts never leave the command line, or are handed to a browser.
APART = ("cli", "interface", "data")


def messages() -> list[tuple[str, str]]:
    """Strings outside docstrings that name an option or a verb, those of formatted strings included."""
    found = []
    for path in sorted(ROOT.rglob("*.py")):
        place = path.relative_to(ROOT)
        named = ("post/page/document.py", "studies/protocol/load.py")
        if place.parts[0] in APART or place.as_posix() in named:
            continue
        tree = ast.parse(path.read_text(encoding="utf-8"))
        apart = {
            id(node.value)
            for node in ast.walk(tree)
            if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        }
        apart |= {  # descriptions of keys and pictures, which the command line lists
            id(part)
            for node in ast.walk(tree)
            if isinstance(node, ast.keyword) and node.arg in ("description", "about")
            for part in ast.walk(node.value)
        }
        found += [
            (place.as_posix(), node.value)
            for node in ast.walk(tree)
            if isinstance(node, ast.Constant)
            and isinstance(node.value, str)
            and id(node) not in apart
            and FOREIGN.search(node.value)
        ]
    return found


def test_no_message_keeps_an_option():
    known = messages()
    assert len(known) > 20
    left = [(place, text) for place, text in known if FOREIGN.search(python_words(text))]
    assert left == []


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("add --allow-large", "add allow_large=True"),
        ("add --engine dask", "add engine dask"),
        ("choose another, see --at", "choose another, see at"),
        ("tribodyn 0.1.0 or newer, a -- b, x--y", "tribodyn 0.1.0 or newer, a -- b, x--y"),
    ],
)
def test_words(text, words):
    assert python_words(text) == words


def test_what_users_meet(tmp_path: Path):
    oscillator = {"frequency": [0.5]}
    run = td.run("backlash-oscillator", oscillator)
    kept = run.save(tmp_path / "kept.h5")
    for call, said in (
        (lambda: run.save(kept), "force=True to replace it"),
        (lambda: td.run("backlash-oscillator", oscillator, output=kept), "force=True to replace it"),
        (lambda: td.open(tmp_path / "none.h5"), "name the record of a run"),
        (lambda: td.sweep("backlash-oscillator", {}), "vary operating.pinion_speed="),
        (lambda: td.sweep("backlash-oscillator", {"damping": [0.1]}, transient=3), "^transient = 3: "),
        (lambda: td.run("crc-23-47", {"solver.cycles": 100_000_000}), "or add allow_large=True$"),
        (lambda: td.drive("backlash-oscillator"), "tribodyn run$"),
    ):
        with pytest.raises(td.InputError, match=said) as caught:
            call()
        assert not FOREIGN.search(str(caught.value))


def test_each_of_several_mistakes_is_put_into_words():
    with pytest.raises(td.InputError) as caught, in_python():
        td.scenario("crc-23-47", {"mesh.damping_ratio": "much", "operating.gear_torque": 5})
    assert str(caught.value).count("overrides: ") == 2


def test_everything_public_is_documented():
    """Functions and classes, and what these offer: a docstring of their own, in NumPy's sections."""
    for name in set(td.__all__) - {"__version__"}:
        thing = getattr(td, name)
        text = inspect.getdoc(thing) or ""
        assert text, name
        if inspect.isfunction(thing):
            for section in ("Parameters", "Raises"):
                assert f"{section}\n---" in text, (name, section)
            assert all(parameter in text for parameter in inspect.signature(thing).parameters), name
            continue
        for key, member in vars(thing).items():
            if not key.startswith("_") and (callable(member) or isinstance(member, property)):
                assert inspect.getdoc(member), f"{name}.{key}"
