"""The sources that a cached result depends on, and files that appear whole."""

import ast
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import tribodyn
from tribodyn.compliance.fem import cache as fem_cache
from tribodyn.kernels.native import store
from tribodyn.numerics.files import sources
from tribodyn.numerics.files.output_files import replacing
from tribodyn.tribology.ehl import table

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
#: Laws that say that there is none, or that the solved contact begins with.
FIRST_LAWS = ("film.dowson_higginson", "film.moes", "friction.none")


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

    def digest(name: str, changed: str | None = None, addition: str = "x = 1\n") -> bytes:
        folder = tmp_path / name
        if not folder.is_dir():
            write_package(tmp_path, name)
        if changed:
            path = folder / changed
            path.write_text(path.read_text() + addition)
        for function in (sources._file_of, sources._text, sources._imports, sources._digest):
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


FUNCTION = 'def function():\n    {}\n    return """{}"""\n'


def test_words_about_the_code_do_not_and_texts_in_it_do(package, tmp_path):
    package("third_package")
    file = tmp_path / "third_package" / "lazy.py"
    first = package("third_package", "lazy.py", FUNCTION.format('"""Doc."""', "a"))
    assert package("third_package", "lazy.py", "# a comment\n") == first
    file.write_text(FUNCTION.format('r"""More \\" of it."""', "a"))
    assert package("third_package") == first
    file.write_text(FUNCTION.format('"""Doc."""', "b"))
    assert package("third_package") != first


#: What no compiled code, no finite elements and no solved contacts depend on.
ELSEWHERE = ("cli", "drawing", "interface", "post", "record", "scenario", "studies", "sweep", "validation")


def test_no_kept_result_depends_on_pages_verbs_the_version_or_laws_it_does_not_contain():
    """A law in use is told by its own functions; only those that others begin with are imported."""
    root = Path(tribodyn.__file__).parent
    kernels = [file for file in root.rglob("*.py") if "\n@kernel\n" in file.read_text(encoding="utf-8")]
    names = [".".join(file.relative_to(root.parent).with_suffix("").parts) for file in kernels]
    assert len(names) >= 8
    for starts in (*((name, store._COMPILER) for name in names), fem_cache._METHODS, (table.__name__,)):
        behind = sources.modules_behind(*starts)
        assert "tribodyn" not in behind
        others = {name for name in behind if name.split(".")[1] in ELSEWHERE}
        assert others <= set(starts), starts
        laws = {name for name in behind if re.match(r"tribodyn\.tribology\.(film|friction)\.", name)}
        # what films by formula read, and a coefficient, which no friction is zero of, are of several laws
        common = (*FIRST_LAWS, "film.roughening", "film.numbers", "friction.coulomb")
        assert laws <= {f"tribodyn.tribology.{law}" for law in common}, starts


EDITS = """
import sys
import edited.start
from pathlib import Path
from tribodyn.numerics.files.sources import digest_of

Path(edited.start.__file__).write_text("a = 2\\n")
print(edited.start.a, digest_of("edited.start").hex())
"""


def test_what_ran_before_an_edit_is_not_taken_for_the_work_of_the_edited_file(tmp_path: Path):
    """A session that goes on with what it has loaded: its results are of no file that another one finds."""
    (tmp_path / "edited").mkdir()
    (tmp_path / "edited" / "__init__.py").touch()
    (tmp_path / "edited" / "start.py").write_text("a = 1\n")
    found = []
    for _ in range(3):
        # without bytecode, which Python takes for that of a file edited within the same second
        command = [sys.executable, "-B", "-c", EDITS]
        paths = {**os.environ, "PYTHONPATH": f"{tmp_path}:{Path(tribodyn.__file__).parents[1]}"}
        ended = subprocess.run(command, env=paths, capture_output=True, text=True, check=True)
        found.append(tuple(ended.stdout.split()))
    assert [value for value, _ in found] == ["1", "2", "2"]
    assert len({digest for _, digest in found}) == 3


@pytest.fixture(scope="module")
def copied(tmp_path_factory) -> Path:
    """Copy the package's sources."""
    root = tmp_path_factory.mktemp("copy") / "tribodyn"
    shutil.copytree(Path(tribodyn.__file__).parent, root, ignore=shutil.ignore_patterns("__pycache__"))
    return root


def computing_digest(root: Path) -> str:
    """Digest as a process that runs those sources finds it."""
    place = importlib.util.spec_from_file_location(
        "tribodyn.numerics.files.sources", root / "numerics/files/sources.py"
    )
    assert place is not None
    assert place.loader is not None
    module = importlib.util.module_from_spec(place)
    place.loader.exec_module(module)
    return module.computing_digest()


@pytest.mark.parametrize(
    ("file", "old", "new", "same"),
    [
        ("tribology/friction/masjedi_khonsari.py", "= 1.0", "= 3.0", False),
        ("studies/motion/run.py", "import", "import os\nimport", False),
        ("errors.py", "import", "import os\nimport", False),
        ("tribology/friction/coulomb.py", "\n\n\n", "\n# more about it\n\n\n", True),
        ("__init__.py", "0.2.0", "9.9.9", True),
        ("cli/run.py", "import", "import os\nimport", True),
        ("post/style.py", "import", "import os\nimport", True),
    ],
)
def test_what_other_code_computed_is_told_by_its_digest(
    copied: Path, file: str, old: str, new: str, same: bool
):
    before = computing_digest(copied)
    path = copied / file
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    assert (computing_digest(copied) == before) is same
    path.write_text(text, encoding="utf-8")
    assert computing_digest(copied) == before


def test_laws_of_installed_packages_count(copied: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    without = computing_digest(copied)
    about = tmp_path / "laws-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: laws\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[tribodyn.friction_laws]\nmine = laws_from_outside.one:LAW\n")
    package = tmp_path / "laws_from_outside"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "one.py").write_text("from laws_from_outside.helper import f\nLAW = f\n")
    (package / "helper.py").write_text("f = 0.05\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    first = computing_digest(copied)
    assert first != without
    (package / "helper.py").write_text("f = 0.15\n")
    second = computing_digest(copied)
    assert second not in (first, without)
    (package / "measured.csv").write_text("0.15\n")  # what a law reads as it is imported
    with_data = computing_digest(copied)
    assert with_data != second
    (package / "measured.csv").write_text("0.25\n")
    assert computing_digest(copied) not in (with_data, second)


def test_a_source_dated_in_the_future_is_as_it_was_loaded(tmp_path, monkeypatch: pytest.MonkeyPatch):
    """As from an archive of a machine whose clock is ahead: no other digest in every process."""
    (tmp_path / "dated_ahead.py").write_text("x = 1\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    importlib.import_module("dated_ahead")
    now = sources._BEGUN + 0.01  # after this process began
    for time, here in ((sources._BEGUN - 9e6, False), (now, True), (now + 9e9, False)):
        os.utime(tmp_path / "dated_ahead.py", (time, time))
        assert (digest_in_another_process(tmp_path) != digest_again("dated_ahead")) is here


def digest_again(name: str) -> bytes:
    sources._digest.cache_clear()
    return sources.digest_of(name)


def digest_in_another_process(folder: Path) -> bytes:
    script = (
        "import sys; from tribodyn.numerics.files.sources import digest_of; "
        "sys.stdout.buffer.write(digest_of('dated_ahead'))"
    )
    command = [sys.executable, "-c", script]
    environment = {**os.environ, "PYTHONPATH": f"{folder}{os.pathsep}{Path(tribodyn.__file__).parents[1]}"}
    return subprocess.run(command, env=environment, capture_output=True, check=True).stdout


def test_every_module_that_compiling_a_kernel_loads_is_in_its_digest():
    """The interpreter itself says which: all that is loaded after a kernel was compiled."""
    script = (
        "import sys\n"
        "from tribodyn.solve.methods import rodas4\n"
        "import tribodyn.kernels.native.compiler\n"
        "from tribodyn.numerics.files.sources import modules_behind\n"
        "behind = modules_behind('tribodyn.solve.methods.rodas4')\n"
        "new = [m for m in sys.modules if m.startswith('tribodyn.') and m not in behind]\n"
        "print(*(m for m in new if not hasattr(sys.modules[m], '__path__')))\n"
    )
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert ended.stdout.split() == ["tribodyn.numerics.registry"]  # of the laws, as a package lists them


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


def test_own_packages_list_names_and_do_nothing_else_so_that_they_count_only_where_they_are_named():
    kinds = (ast.Import, ast.ImportFrom, ast.Assign, ast.AnnAssign, ast.FunctionDef, ast.ClassDef)
    root = Path(tribodyn.__file__).parent
    for file in sorted(root.glob("*/**/__init__.py")):
        body = ast.parse(file.read_text(encoding="utf-8")).body
        done = [
            node
            for node in body
            if not isinstance(node, kinds)
            and ast.get_docstring(ast.Module([node], [])) is None
            and not ast.unparse(node).startswith("without_file(")  # before the library is imported
        ]
        assert not done, f"{file}:{done[0].lineno}"
