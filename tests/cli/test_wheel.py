"""What is published: the source distribution, and the wheel built from it, for any folder and any index."""

import re
import subprocess
import sys
import zipfile

import pytest

from tests.support.verbs import ROOT, in_a_process
from tools.index_description import long_description


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Folder with the source distribution and the wheel built from it."""
    folder = tmp_path_factory.mktemp("built")
    build = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    subprocess.run(build, check=True, capture_output=True)
    return folder


@pytest.fixture(scope="module")
def installed(built):
    """The package unpacked from the wheel, as an installer would."""
    with zipfile.ZipFile(next(built.glob("*.whl"))) as wheel:
        wheel.extractall(built / "site")
    return built / "site"


@pytest.mark.slow
def test_the_wheel_is_typed_and_holds_models_and_scenarios(installed):
    assert (installed / "tribodyn" / "py.typed").is_file()
    for folder in ("models", "scenarios"):
        inside = {p.relative_to(ROOT / folder) for p in (ROOT / folder).rglob("*") if p.is_file()}
        shipped = installed / "tribodyn" / "data" / folder
        assert inside == {p.relative_to(shipped) for p in shipped.rglob("*") if p.is_file()}


@pytest.mark.slow
def test_installed_wheel_runs_from_an_empty_folder(installed, tmp_path):
    for words in (("run", "crc-23-47", "--set", "solver.cycles=2"), ("--version",)):
        done = in_a_process(*words, folder=tmp_path, PYTHONPATH=str(installed), PYTHONSAFEPATH="1")
        assert done.returncode == 0, done.stderr
    assert (tmp_path / "crc-23-47.h5").exists()
    assert (tmp_path / "crc-23-47-overview.png").exists()


@pytest.mark.slow
def test_a_package_index_shows_both_as_they_are(built):
    pytest.importorskip("twine")
    files = [str(file) for pattern in ("*.whl", "*.tar.gz") for file in built.glob(pattern)]
    check = [sys.executable, "-m", "twine", "check", "--strict", *files]
    done = subprocess.run(check, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert len(files) == done.stdout.count("PASSED") == 2


@pytest.mark.parametrize("repository", ["", "https://example.org/someone/tribodyn"])
def test_the_long_description_has_no_link_into_a_folder_that_an_index_does_not_have(repository):
    text = long_description((ROOT / "README.md").read_text(encoding="utf-8"), repository)
    targets = re.findall(r"\]\(([^)]*)\)", text)
    assert all(target.startswith("https://") for target in targets)
    files = [re.sub(r"^.*?/main/([^#]*).*", r"\1", target) for target in targets if repository in target]
    assert bool(files) == bool(repository)
    assert all((ROOT / file).is_file() for file in files)
