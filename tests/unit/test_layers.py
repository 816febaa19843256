"""Architecture rule 1: arrows point right only."""

import ast
from pathlib import Path

import pytest

import tribodyn

ROOT = Path(tribodyn.__file__).parent
LAYERS = (
    "scenario",
    "geometry",
    "compliance",
    "tribology",
    "dynamics",
    "solve",
    "record",
    "post",
    "drawing",
    "cli",
)
PHYSICS = ("geometry", "compliance", "tribology", "dynamics", "solve", "rolling", "backlash_oscillator")
FORBIDDEN = {
    "geometry": {
        "scenario",
        "compliance",
        "dynamics",
        "solve",
        "record",
        "post",
        "cli",
        "simulate",
        "prepare",
    },
    "compliance": {"scenario", "dynamics", "solve", "record", "post", "cli", "simulate", "prepare"},
    "tribology": {
        "scenario",
        "geometry",
        "compliance",
        "dynamics",
        "solve",
        "record",
        "post",
        "cli",
        "simulate",
        "prepare",
    },
    "dynamics": {
        "scenario",
        "geometry",
        "compliance",
        "solve",
        "record",
        "post",
        "cli",
        "simulate",
        "prepare",
    },
    "solve": {"scenario", "geometry", "compliance", "record", "post", "cli", "simulate", "prepare"},
    "rolling": {
        "scenario",
        "compliance",
        "dynamics",
        "solve",
        "record",
        "post",
        "cli",
        "simulate",
        "simulate_rolling",
        "prepare",
    },
    "backlash_oscillator": {
        "scenario",
        "geometry",
        "compliance",
        "tribology",
        "record",
        "post",
        "cli",
        "simulate",
        "simulate_backlash_oscillator",
        "prepare",
    },
    "record": {
        "scenario",
        "geometry",
        "compliance",
        "dynamics",
        "solve",
        "post",
        "cli",
        "simulate",
        "prepare",
    },
    "post": {
        "scenario",
        "geometry",
        "compliance",
        "dynamics",
        "solve",
        "drawing",
        "cli",
        "simulate",
        "prepare",
    },
    "drawing": {"scenario", "compliance", "dynamics", "solve", "record", "cli", "simulate", "prepare"},
}
OUTSIDE = {"pydantic", "pint", "h5py", "matplotlib", "ezdxf", "typer", "rich"}


def imports(file: Path) -> set[str]:
    """Modules that a file imports at run time, anywhere in it."""
    found = set()
    tree = ast.parse(file.read_text(encoding="utf-8"))
    skipped = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            skipped |= {id(child) for child in ast.walk(node)}
    for node in ast.walk(tree):
        if id(node) in skipped:
            continue
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def files(layer: str) -> list[Path]:
    return sorted((ROOT / layer).rglob("*.py"))


@pytest.mark.parametrize("layer", FORBIDDEN)
def test_imports_point_to_the_left(layer):
    for file in files(layer):
        for name in imports(file):
            parts = name.split(".")
            if parts[0] == "tribodyn" and len(parts) > 1:
                assert parts[1] not in FORBIDDEN[layer], f"{file} imports {name}"


@pytest.mark.parametrize("layer", PHYSICS)
def test_physics_knows_no_file_format_or_picture(layer):
    for file in files(layer):
        for name in imports(file):
            assert name.split(".")[0] not in OUTSIDE, f"{file} imports {name}"


def test_every_layer_is_there():
    for layer in LAYERS:
        assert files(layer), layer


def test_files_are_one_idea():
    """Style: under 300 lines a file."""
    for file in ROOT.rglob("*.py"):
        assert len(file.read_text(encoding="utf-8").splitlines()) <= 340, file
