"""Architecture rules 1 and 2: arrows point one way, physics stands alone, a kind of study is one folder."""

import ast
import json
import re
import subprocess
import tomllib
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

import tribodyn
from tests.support.durations import files_of_tests
from tests.support.soak_parameters import in_soak
from tools.package_shape import ROOT_FILES, by_file, by_folder, circles, folder, imports, lines, modules
from tribodyn.studies import STUDIES

ROOT = Path(tribodyn.__file__).parent
TESTS = Path(__file__).parents[1]

#: Folder -> those it may import, besides itself and `errors`; each stands below the ones that import it.
MAY_IMPORT: dict[str, set[str]] = {}
MAY_IMPORT["numerics"] = set()
MAY_IMPORT["geometry"] = {"numerics"}
MAY_IMPORT["tribology"] = {"numerics", "geometry"}
MAY_IMPORT["compliance"] = {"numerics", "geometry", "tribology"}
MAY_IMPORT["mesh"] = {"numerics", "geometry", "compliance", "tribology"}
MAY_IMPORT["train"] = {"numerics", "tribology"}
MAY_IMPORT["dynamics"] = {"numerics", "tribology", "mesh", "train"}
MAY_IMPORT["kernels"] = {"numerics"}
MAY_IMPORT["solve"] = {"numerics", "tribology", "mesh", "train", "dynamics", "kernels"}
MAY_IMPORT["standards"] = {"numerics"}
MAY_IMPORT["signals"] = {"numerics"}
MAY_IMPORT["sensing"] = {"numerics", "train", "dynamics", "signals"}
PHYSICS = tuple(MAY_IMPORT)
MAY_IMPORT["quantities"] = {"numerics"}
MAY_IMPORT["record"] = {"numerics", "signals", "quantities"}
MAY_IMPORT["post"] = {"numerics", "signals", "quantities", "record"}
MAY_IMPORT["drawing"] = {"numerics", "geometry", "post"}
MAY_IMPORT["exchange"] = {"numerics", "train", "dynamics", "kernels", "solve", "record", "drawing"}
MAY_IMPORT["input"] = {
    "exchange",
    "train",
    "numerics",
    "geometry",
    "tribology",
    "mesh",
    "dynamics",
    "solve",
    "standards",
    "sensing",
}
MAY_IMPORT["derivatives"] = {
    "numerics",
    "geometry",
    "tribology",
    "compliance",
    "mesh",
    "solve",
    "quantities",
    "input",
}
MAY_IMPORT["cases"] = {"numerics", "tribology", "solve", "quantities", "record"}
MAY_IMPORT["gears"] = set(MAY_IMPORT) - {"derivatives"}
MAY_IMPORT["studies"] = set(MAY_IMPORT) - {"studies"}
MAY_IMPORT["grid"] = set(MAY_IMPORT) - {"grid"}
MAY_IMPORT["identification"] = set(MAY_IMPORT) - {"identification"}
MAY_IMPORT["validation"] = set(MAY_IMPORT) - {"validation"}
MAY_IMPORT["app"] = set(MAY_IMPORT) - {"app"}
MAY_IMPORT["interface"] = set(MAY_IMPORT) - {"interface"}
MAY_IMPORT["cli"] = set(MAY_IMPORT) - {"cli", "interface"}

#: File formats, input and pictures, which physics knows nothing of.
BORDERS = {"pydantic", "pint", "h5py", "matplotlib", "ezdxf", "typer", "rich", "tomllib", "tomli_w"}
#: Kind of study, as scenarios name it -> its folder, from the registry.
KINDS = {
    kind: STUDIES[kind].package.rpartition(".")[2]
    for kind in STUDIES
    if STUDIES[kind].package.startswith("tribodyn.")
}
#: Kinds whose names are also words of their own: these strings say nothing.
WORDS = {"efficiency", "design", "ehl", "wear", "map"}
#: Style: a file is one idea; lines.
LONGEST_FILE = 340
#: Modules of a folder beside its subfolders; of the command line a verb each.
FULLEST_FOLDER = 15

FILES = modules(ROOT)


def wrong_arrows(source: str, *, typing_only: bool) -> list[str]:
    """Imports of a folder that point to where it must not look, as ``module:line imports module``."""
    allowed = MAY_IMPORT[source] | {source, "errors", ""}
    return [
        f"{arrow.importer}:{arrow.line} imports {arrow.imported}"
        for arrow in imports(ROOT)
        if folder(arrow.importer) == source
        and arrow.imported.split(".")[0] == ROOT.name
        and folder(arrow.imported) not in allowed
        and arrow.typing_only is typing_only
    ]


@cache
def nodes(path: Path) -> list[ast.AST]:
    """All nodes of a file's tree, which takes longer to make than to look through."""
    return list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))


@cache
def strings(path: Path) -> set[str]:
    """String constants of a file, those in docstrings not taken apart."""
    return {
        node.value for node in nodes(path) if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }


def test_every_folder_has_its_place():
    folders = {path.name for path in ROOT.iterdir() if (path / "__init__.py").is_file()}
    assert folders == set(MAY_IMPORT)


def test_the_root_holds_the_interface_and_the_errors_alone():
    assert {path.name for path in ROOT.iterdir() if path.is_file()} <= ROOT_FILES


@pytest.mark.parametrize("typing_only", [False, True])
@pytest.mark.parametrize("source", MAY_IMPORT)
def test_a_folder_imports_what_stands_before_it(source, typing_only: bool):
    """Imports within functions included, and those for type checkers."""
    found = wrong_arrows(source, typing_only=typing_only)
    assert not found, "\n".join(found)


def test_errors_import_nothing_of_the_package():
    assert [
        arrow for arrow in imports(ROOT) if folder(arrow.importer) == "errors" and arrow.imported in FILES
    ] == []


def test_drawing_takes_of_the_pictures_of_results_their_style_and_the_gears_alone():
    taken = {
        arrow.imported
        for arrow in imports(ROOT)
        if folder(arrow.importer) == "drawing" and folder(arrow.imported) == "post"
    }
    assert taken <= {"tribodyn.post.style", "tribodyn.post.figures.gears_in_mesh"}


def test_the_page_to_design_on_is_opened_by_its_verb_and_from_python_alone():
    """What it needs is an extra: nothing else may import it, and those two only when they are called."""
    users = [arrow for arrow in imports(ROOT) if folder(arrow.imported) == "app" != folder(arrow.importer)]
    assert {arrow.importer for arrow in users} <= {"tribodyn.cli.page", "tribodyn.interface.explore"}


def test_the_core_of_the_page_knows_no_library_of_pages():
    found = [
        f"{arrow.importer}:{arrow.line} imports {arrow.imported}"
        for arrow in imports(ROOT)
        if arrow.importer.startswith("tribodyn.app.core")
        and (arrow.imported.split(".")[0] == "nicegui" or arrow.imported.startswith("tribodyn.app"))
        and not arrow.imported.startswith("tribodyn.app.core")
    ]
    assert found == []


def test_no_circle_by_file():
    found = [", ".join(ring) for ring in circles(by_file(ROOT))]
    assert not found, "\n".join(found)


def test_no_circle_by_file_for_type_checkers():
    found = [", ".join(ring) for ring in circles(by_file(ROOT, typing_too=True))]
    assert not found, "\n".join(found)


def test_no_circle_by_folder():
    found = [", ".join(ring) for ring in circles(by_folder(ROOT))]
    assert not found, "\n".join(found)


@pytest.mark.parametrize("source", PHYSICS)
def test_physics_knows_no_file_format_or_picture(source):
    found = [
        f"{arrow.importer}:{arrow.line} imports {arrow.imported}"
        for arrow in imports(ROOT)
        if folder(arrow.importer) == source and arrow.imported.split(".")[0] in BORDERS
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize("study", KINDS.values())
def test_a_study_imports_no_other(study):
    others = tuple(f"tribodyn.studies.{other}" for other in KINDS.values() if other != study)
    found = [
        f"{arrow.importer}:{arrow.line} imports {arrow.imported}"
        for arrow in imports(ROOT)
        if f"{arrow.importer}.".startswith(f"tribodyn.studies.{study}.")
        and f"{arrow.imported}.".startswith(tuple(f"{other}." for other in others))
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize("kind", KINDS)
def test_a_kind_is_named_in_its_folder_alone(kind):
    """And in the registry, and where published numbers are compared."""
    home = KINDS[kind]
    classes = home.title().replace("_", "")
    named = re.compile(rf"\b{classes}(Case|Scenario)\b")
    found = []
    for name, path in FILES.items():
        at_home = f"{name}.".startswith(f"tribodyn.studies.{home}.") or name == "tribodyn.studies"
        if at_home or folder(name) == "validation":
            continue
        if named.search(path.read_text(encoding="utf-8")) or (kind not in WORDS and kind in strings(path)):
            found.append(name)
    assert not found, "\n".join(found)


def test_modules_named_by_a_string_lie_beside_who_names_them():
    """A registry stands beside what it lists: no arrow hides in a string."""
    found = [
        f"{name} names {module}"
        for name, path in FILES.items()
        for module in strings(path) & set(FILES)
        if folder(module) not in (folder(name), "") and folder(name) != ""
    ]
    assert not found, "\n".join(found)


def test_a_file_is_one_idea():
    assert {name: lines(path) for name, path in FILES.items() if lines(path) > LONGEST_FILE} == {}


def test_a_folder_holds_no_more_modules_than_a_reader_overlooks():
    folders = Counter(
        path.parent.relative_to(ROOT).as_posix() for path in FILES.values() if path.name != "__init__.py"
    )
    crowded = {name: count for name, count in folders.items() if count > FULLEST_FOLDER}
    assert crowded.keys() <= {"cli"}


def test_a_class_name_means_one_class():
    classes = [
        node.name
        for path in FILES.values()
        for node in nodes(path)
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    ]
    assert [name for name, count in Counter(classes).items() if count > 1] == []


def test_no_function_takes_more_than_nine_positional_arguments():
    long = []
    for path in ROOT.rglob("*.py"):
        for node in nodes(path):
            if isinstance(node, ast.FunctionDef) and len(node.args.posonlyargs + node.args.args) > 9:
                long.append(f"{path.relative_to(ROOT)}: {node.name}")
    assert long == []


def test_unit_tests_mirror_the_package():
    tested = [path.relative_to(TESTS / "unit") for path in (TESTS / "unit").rglob("*") if path.is_dir()]
    assert [str(path) for path in tested if path.name != "__pycache__" and not (ROOT / path).is_dir()] == []


def test_tests_share_through_support_alone():
    """No test imports from another, also in the programs that tests write."""
    shared = re.compile(
        r"(?:from|import)\s+tests\.(?!support\b)|from\s+tests\s+import\s+(?!support\b)|from\s+\."
    )
    found = [
        path.relative_to(TESTS).as_posix()
        for path in TESTS.rglob("*.py")
        if any(shared.match(line.strip()) for line in path.read_text(encoding="utf-8").splitlines())
    ]
    assert not found, "\n".join(found)


def test_every_file_of_tests_is_in_the_order():
    """`pytest FILE --measure-durations` adds a new one, and takes out what is gone."""
    listed = json.loads((TESTS / "durations.json").read_text(encoding="utf-8"))["files"]
    assert sorted(listed) == files_of_tests()


def test_the_list_of_soak_names_tests_that_there_are():
    for name in sorted(in_soak()):
        file, _, test = name.partition("[")[0].partition("::")
        assert f"\ndef {test}(" in (TESTS / file).read_text(encoding="utf-8"), name


def test_nothing_lies_at_the_top_that_no_distribution_holds():
    """No stray record, picture or pickle: what lies there is part of a source distribution."""
    top = ROOT.parent
    kept = subprocess.run(["git", "ls-files"], cwd=top, capture_output=True, text=True, check=False)
    if kept.returncode != 0 or not (top / ".git").exists():
        pytest.skip("no repository")
    project = tomllib.loads((top / "pyproject.toml").read_text(encoding="utf-8"))
    distributed = {
        name.strip("/") for name in project["tool"]["hatch"]["build"]["targets"]["sdist"]["include"]
    }
    found = {line.partition("/")[0] for line in kept.stdout.splitlines()}
    assert found - distributed - {"pyproject.toml", ".gitignore", ".ci"} == set()


def test_one_module_starts_processes():
    """Every other one goes through `numerics.processes.child`, which isolates them; Dask's cluster too."""
    programs = {"subprocess", "multiprocessing", "pty", "_posixsubprocess", "_winapi", "popen2", "webbrowser"}
    calls = re.compile(
        r"\bos\.(?:fork\w*|exec\w+|spawn\w+|posix_spawn\w*|system|popen|startfile)\b"
        r"|\b(?:ProcessPoolExecutor|create_subprocess_\w+|Nanny|SSHCluster)\b"
    )
    found = []
    for name, path in FILES.items():
        if name == "tribodyn.numerics.processes.child":
            continue
        text = path.read_text(encoding="utf-8")
        found += [f"{name}: {call}" for call in calls.findall(text)]
        if "LocalCluster(" in text:
            found += [name] * (text.count("isolated_environment()") != text.count("LocalCluster("))
    found += [
        f"{arrow.importer}:{arrow.line} imports {arrow.imported}"
        for arrow in imports(ROOT)
        if arrow.imported.split(".")[0] in programs
        and not arrow.typing_only
        and arrow.importer != "tribodyn.numerics.processes.child"
    ]
    assert not found, "\n".join(found)
