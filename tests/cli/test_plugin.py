"""The example package, installed into an environment of its own: its family, laws and study from TOML.

The environment sees the packages of the running one, and this checkout; what is installed into it is the
example alone, by pip, without a network.
"""

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from tests.support.forked_verbs import ForkedVerbs
from tests.support.verbs import sets
from tribodyn.numerics.files.cache import cache_folder
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.slow

GEARS, EFFICIENCY, SLIDING = "circle-23-47", "efficiency-circle-23-47", "sliding-circle-23-47"
SHORT = ("solver.cycles=2", "output.samples_per_cycle=40", "solver.rtol=1e-8")
#: The same circle as two arcs, which the shipped family has.
AS_ARCS = ("drive.family=circular-arc", 'drive.shape={approach_diameter="300 mm",recess_diameter="-300 mm"}')


class Environment(NamedTuple):
    """An interpreter with the example installed, and where its files are."""

    python: Path
    packages: Path
    scenarios: Path
    cache: Path
    verbs: ForkedVerbs

    def __call__(self, *words: str, folder: Path, status: int = 0):
        """Run a verb in a folder, in a process of its own."""
        ran = self.verbs(*words, folder=folder)
        assert ran.returncode == status, f"{words}: {ran.returncode}\n{ran.stdout}\n{ran.stderr}"
        return ran

    def scenario(self, name: str) -> str:
        """Path of one of the example's scenarios."""
        return str(self.scenarios / f"{name}.toml")


def fresh_environment(folder: Path, source: Path) -> Environment:
    """Make an environment and install a package into it."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder)], check=True)
    python = folder / "bin" / "python"
    show = [str(python), "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]
    packages = Path(subprocess.run(show, check=True, capture_output=True, text=True).stdout.strip())
    seen = [folder for folder in sys.path if folder.endswith("site-packages")]
    (packages / "running.pth").write_text("\n".join(seen), encoding="utf-8")
    options = ("--quiet", "--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check")
    install = [str(python), "-m", "pip", "install", *options, str(source)]
    ran = subprocess.run(install, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    cache = cache_folder() / "plugin"  # of this module's own kernels; later runs find them
    verbs = ForkedVerbs(folder, python, TRIBODYN_CACHE=str(cache))
    return Environment(python, packages, source / "scenarios", cache, verbs)


@pytest.fixture(scope="module")
def plugin(tmp_path_factory) -> Iterator[Environment]:
    """The example as its users install it."""
    folder = tmp_path_factory.mktemp("plugin")
    shutil.copytree(ROOT / "examples" / "plugin", folder / "source")
    made = fresh_environment(folder / "environment", folder / "source")
    yield made
    made.verbs.close()


def run(plugin: Environment, folder: Path, name: str, *given: str, scenario: str = "") -> Path:
    """Run one of the example's scenarios; return the record."""
    where = scenario or plugin.scenario(name)
    plugin("run", where, "-o", f"{name}.h5", "--no-plot", *sets(*given), folder=folder)
    return folder / f"{name}.h5"


def arrays(path: Path) -> dict[str, np.ndarray]:
    with Record(path) as record:
        return {name: record[name] for name in record}


def kernels(cache: Path) -> dict[str, int]:
    """Compiled kernels on disk, and when each was written."""
    return {str(file): file.stat().st_mtime_ns for file in cache.glob("kernels-*/*")}


def test_list_and_schema_name_all_that_it_adds(plugin, tmp_path):
    listed = json.loads(plugin("list", "--json", folder=tmp_path).stdout)
    assert "circular arc" in listed["families"]["circle"]
    assert "entrainment" in listed["laws"]["stribeck"]
    assert "constant-film" in listed["film-laws"]
    assert "specific sliding" in listed["kinds"]["specific-sliding"]
    assert "(specific-sliding)" in listed["plots"]["specific-sliding"]
    schema = json.loads(plugin("schema", folder=tmp_path).stdout)
    tables = schema["$defs"]
    assert "circle" in tables["DriveTable"]["properties"]["family"]["enum"]
    friction = tables["Friction"]["properties"]
    assert "stribeck" in friction["law"]["enum"]
    assert friction["reference_speed"]["examples"] == ['"1 m/s"']
    assert "velocity" in friction["reference_speed"]["description"]
    assert 'of law = "stribeck"' in friction["reference_speed"]["description"]
    assert "thickness" in tables["FilmTable"]["properties"]
    assert schema["discriminator"]["mapping"]["specific-sliding"] == "#/$defs/SlidingScenario"
    assert "positions" in tables["SlidingOutput"]["properties"]


def test_check_of_all_three(plugin, tmp_path):
    for name in (GEARS, EFFICIENCY, SLIDING):
        checked = json.loads(plugin("check", plugin.scenario(name), "--json", folder=tmp_path).stdout)
        assert checked["geometry"]["contact ratio"][0] > 1.6


def test_own_keys_are_held_to_their_units(plugin, tmp_path):
    wrong = plugin(
        "check", plugin.scenario(GEARS), "--set", "friction.reference_speed=2", folder=tmp_path, status=2
    )
    assert "friction.reference_speed" in wrong.stderr
    assert "m/s" in wrong.stderr
    wrong = plugin("check", plugin.scenario(GEARS), "--set", "film.thicknes=1 um", folder=tmp_path, status=2)
    assert 'did you mean "thickness"?' in wrong.stderr


def test_the_family_reduces_to_two_arcs(plugin, tmp_path):
    """Of opposite diameters, for which the shipped family has closed forms where the example integrates."""
    own = run(plugin, tmp_path, "circle", scenario=plugin.scenario(SLIDING))
    theirs = run(plugin, tmp_path, "arcs", *AS_ARCS, scenario=plugin.scenario(SLIDING))
    with Record(own) as circle, Record(theirs) as arcs:
        assert circle.summary["contact_ratio"] == pytest.approx(arcs.summary["contact_ratio"], rel=1e-12)
        for name in arcs:
            np.testing.assert_allclose(circle[name], arcs[name], rtol=1e-10, atol=1e-13, err_msg=name)


def test_a_kernel_is_kept_until_the_source_changes(plugin, tmp_path):
    """A second process compiles nothing; an edit of the law has a kernel of its own, which then runs."""
    cache, steel, factor = plugin.cache, sets(*SHORT, "solver.method=dopri5"), 2.5
    given = ("run", plugin.scenario(GEARS), "-o", "run.h5", "--no-plot", "--force", *steel)
    plugin(*given, folder=tmp_path)
    first, before = kernels(cache), arrays(tmp_path / "run.h5")
    assert first
    plugin(*given, folder=tmp_path)
    assert kernels(cache) == first
    source = plugin.packages / "tribodyn_example" / "stribeck.py"
    text = source.read_text(encoding="utf-8")
    formula = "exp(-contact.entrainment"
    assert text.count(formula) == 1
    try:
        source.write_text(text.replace(formula, f"exp(-{factor!r} * contact.entrainment"), encoding="utf-8")
        plugin(*given, folder=tmp_path)
        after = arrays(tmp_path / "run.h5")
    finally:
        source.write_text(text, encoding="utf-8")
    later = kernels(cache)
    assert {name: later[name] for name in first} == first
    expected = 0.03 + 0.09 * np.exp(-factor * np.abs(after["entrainment_speed"]) / 2.0)
    np.testing.assert_allclose(after["friction_coefficient"], expected, rtol=1e-12)
    assert np.max(after["friction_force"]) < np.max(before["friction_force"])


def test_a_sweep_over_the_laws_own_key_runs_in_the_lanes(plugin, tmp_path):
    """Nine cases side by side, each as if it were alone; friction grows with the key."""
    given = ("--transient", "20", *sets("solver.rtol=1e-8"))
    efficiency = {}
    for name, values in (("sweep", "1:9:1m/s"), ("alone", "5m/s")):
        vary = f"friction.reference_speed={values}"
        plugin("sweep", plugin.scenario(GEARS), "--vary", vary, "-o", f"{name}.h5", *given, folder=tmp_path)
        with SweepRecord(tmp_path / f"{name}.h5") as record:
            assert np.all(record["status"] == DONE)
            for at, value in zip(record["reference_speed"], record["efficiency"], strict=True):
                efficiency[name, round(at)] = value
    swept = [efficiency["sweep", at] for at in range(1, 10)]
    assert np.all(np.diff(swept) < 0.0)
    assert efficiency["alone", 5] == pytest.approx(efficiency["sweep", 5], rel=1e-9)
    plugin("plot", "sweep.h5", "response", folder=tmp_path)
    assert (tmp_path / "sweep-response.png").exists()


def test_the_efficiency_study_takes_family_and_law(plugin, tmp_path):
    """Between the efficiencies of both of the law's ends, which are Coulomb's to the last bit."""
    found = []
    for boundary, fluid in (("0.03", "0.03"), ("0.12", "0.03"), ("0.12", "0.12")):
        given = (f"friction.boundary_coefficient={boundary}", f"friction.fluid_coefficient={fluid}")
        path = run(plugin, tmp_path, EFFICIENCY, *given)
        with Record(path) as record:
            found.append(record.summary["efficiency"])
        path.unlink()
    assert found[0] > found[1] > found[2]
    for mu, of_the_law in (("0.03", found[0]), ("0.12", found[2])):
        text = Path(plugin.scenario(EFFICIENCY)).read_text(encoding="utf-8")
        shipped = re.sub(
            r"(?s)\[friction\].*?(?=\n\[|\Z)", f'[friction]\nlaw = "coulomb"\ncoefficient = {mu}\n', text
        )
        (tmp_path / "coulomb.toml").write_text(shipped, encoding="utf-8")
        path = run(plugin, tmp_path, "coulomb", scenario="coulomb.toml")
        with Record(path) as record:
            assert record.summary["efficiency"] == of_the_law
        path.unlink()


def test_the_study_runs_draws_shows_and_compares(plugin, tmp_path):
    first = run(plugin, tmp_path, SLIDING)
    other = tmp_path / "involute.h5"
    plugin("run", plugin.scenario(SLIDING), "-o", other.name, *sets("drive.family=involute"),
           "--set", "drive.shape={}", folder=tmp_path)  # fmt: skip
    assert (tmp_path / "involute-overview.png").exists()
    shown = plugin("show", first.name, "--full", folder=tmp_path).stdout
    assert "Minimum specific sliding, pinion" in shown
    assert "no load, no vibration" in shown
    plugin("plot", first.name, other.name, "all", folder=tmp_path)
    assert list(tmp_path.glob("*-specific-sliding.png"))
    compared = plugin("compare", first.name, other.name, folder=tmp_path).stdout
    assert "Minimum specific sliding, gear" in compared
    checked = plugin("check", plugin.scenario(SLIDING), "--json", folder=tmp_path)
    sheet = json.loads(checked.stdout)["geometry"]
    with Record(first) as record:
        assert record.axis == "signed_distance"
        assert record.units("sliding_speed") == "m/s"
        for body in ("pinion", "gear"):
            minimum = np.min(record[f"{body}_specific_sliding"])
            assert minimum == record.summary[f"{body}_specific_sliding_min"]
            assert minimum == pytest.approx(sheet[body]["minimum specific sliding"][0], rel=1e-9)


BROKEN = {
    "family": ("circle.py", GEARS),
    "friction law": ("stribeck.py", GEARS),
    "film law": ("constant_film.py", GEARS),
    "study": ("specific_sliding/__init__.py", SLIDING),
    "part of the study": ("specific_sliding/scenario.py", SLIDING),
}


@contextmanager
def broken(plugin: Environment, names: Iterable[str]) -> Iterator[None]:
    """Let modules of the example import what is not there."""
    sources = [plugin.packages / "tribodyn_example" / name for name in names]
    texts = [source.read_text(encoding="utf-8") for source in sources]
    try:
        for source, text in zip(sources, texts, strict=True):
            source.write_text("import no_such_module\n" + text, encoding="utf-8")
        yield
    finally:
        for source, text in zip(sources, texts, strict=True):
            source.write_text(text, encoding="utf-8")


def assert_named(said: str) -> None:
    """A line of stderr names the module that is missing and the package that lacks it."""
    assert "\n" not in said
    assert "No module named 'no_such_module'" in said
    assert "tribodyn-example" in said or "tribodyn_example" in said


@pytest.mark.parametrize("what", BROKEN)
def test_a_module_that_cannot_be_imported_is_one_error(plugin, tmp_path, what):
    name, scenario = BROKEN[what]
    with broken(plugin, [name]):
        used = plugin("check", plugin.scenario(scenario), folder=tmp_path, status=2)
    assert_named(used.stderr.strip())


@pytest.mark.parametrize(
    "what", [pytest.param(("friction law",), marks=pytest.mark.soak), tuple(BROKEN)], ids=["one", "all"]
)
def test_modules_that_cannot_be_imported_are_a_line_each_where_they_would_be_listed(plugin, tmp_path, what):
    with broken(plugin, {BROKEN[part][0] for part in what}):
        listed = plugin("list", "--json", folder=tmp_path)
        schema = plugin("schema", folder=tmp_path)
        plugin("check", "crc-23-47", folder=tmp_path)
        unknown = plugin("check", "crc-23-47", "--set", "friction.law=xuu", folder=tmp_path, status=2)
    lines = [listed.stderr.splitlines(), schema.stderr.splitlines()]
    assert len(lines[0]) == len(set(lines[0])) == min(len(what), 4)  # a study has two modules
    for line in lines[0] + lines[1]:
        assert_named(line)
    assert "masjedi-khonsari" in json.loads(listed.stdout)["laws"]
    assert "GearPairScenario" in json.loads(schema.stdout)["$defs"]
    assert 'did you mean "xu"?' in unknown.stderr
