"""The wheel carries models and scenarios: what is installed runs from any folder, with no checkout near."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The package unpacked from a freshly built wheel, as an installer would."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    subprocess.run(build, check=True, capture_output=True)
    site = folder / "site"
    with zipfile.ZipFile(next(folder.glob("*.whl"))) as wheel:
        wheel.extractall(site)
    return site


def tribodyn(installed, folder, *arguments):
    environment = {**os.environ, "PYTHONPATH": str(installed)}
    return subprocess.run(
        [sys.executable, "-P", "-m", "tribodyn", *arguments],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.slow
def test_wheel_holds_models_and_scenarios(installed):
    for folder in ("models", "scenarios"):
        inside = {p.relative_to(ROOT / folder) for p in (ROOT / folder).rglob("*") if p.is_file()}
        shipped = installed / "tribodyn" / "data" / folder
        assert inside == {p.relative_to(shipped) for p in shipped.rglob("*") if p.is_file()}


@pytest.mark.slow
def test_the_wheel_says_that_it_is_typed(installed):
    assert (installed / "tribodyn" / "py.typed").is_file()


@pytest.mark.slow
def test_installed_wheel_runs_from_an_empty_folder(installed, tmp_path):
    done = tribodyn(installed, tmp_path, "run", "crc-23-47", "--set", "solver.cycles=2")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "crc-23-47.h5").exists()
    assert (tmp_path / "crc-23-47-overview.png").exists()
    where = tribodyn(installed, tmp_path, "--version")
    assert where.returncode == 0
