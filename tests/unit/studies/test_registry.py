"""The registry of studies: kinds that nobody offers, and kinds that other packages offer."""

import importlib.metadata
import shutil
import subprocess
import sys
from importlib.metadata import EntryPoint, EntryPoints
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.support.record_samples import block, gear_pair_writer
from tests.support.verbs import complaint, invoke
from tribodyn.errors import InputError
from tribodyn.numerics.files.sources import computing_digest
from tribodyn.record.reader import Record
from tribodyn.studies import STUDIES
from tribodyn.studies.pages import names, study_of_record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

#: A study in a single module: its parts are attributes of it.
MODULE = '''
"""The period of a pendulum of small swing."""

import math
from dataclasses import dataclass
from typing import Literal

from matplotlib.figure import Figure

from tribodyn.numerics.parameter import Variable
from tribodyn.post.figures.drawing import Drawing
from tribodyn.quantities.quantity import Quantity
from tribodyn.record.schema import TIME, Layout
from tribodyn.input.quantity import Table, Text
from tribodyn.cases.results import target, writer
from tribodyn.studies.protocol.study import CaseHead, CheckResult, RunResult, Study, TextTable

TEMPLATE = 'title = "TITLE"\\nkind = "pendulum"\\nlength = 1.0\\n'
STUDY = Study("pendulum", "a pendulum of small swing", __name__, "the angle of a pendulum over time")


class Scenario(Table):
    title: Text
    name: Text
    kind: Literal["pendulum"]
    length: float


@dataclass(frozen=True)
class Case(CaseHead):
    length: float

    @property
    def period(self):
        return 2.0 * math.pi * math.sqrt(self.length / 9.81)


def case_of(scenario, toml, sha256):
    return Case(scenario.title, scenario.name, "pendulum", toml, sha256, scenario.length)


def check(case):
    table = TextTable("Pendulum", ("quantity", "value"), [("period", "s")])
    return CheckResult({"period": case.period}, [table])


def quantities_of(case):
    return {"period": case.period}


def run(case, output, *, force, progress):
    path = target(case, output, force)
    layout = Layout(TIME, {"angle": Variable(("time",), "rad", "angle of the pendulum")})
    with writer(case, path, layout, 3, force=force) as record:
        times = [part * case.period for part in (0.0, 0.25, 0.5)]
        record.write(0, {"time": times, "angle": [0.1, 0.0, -0.1]})
        summary = quantities_of(case)
        return RunResult(record.finish(summary), "complete", "", summary)


def _drawn(records, view):
    drawn = Figure()
    drawn.subplots().plot(records[0]["time"], records[0]["angle"])
    return drawn


DRAWINGS = {"overview": Drawing("angle", _drawn), "angle": Drawing("angle over time", _drawn)}
PERIOD = Quantity("period", "Period of the pendulum", "s")
REPORTED, SWEPT = {"Motion": (PERIOD,)}, (PERIOD,)


def sentences(record):
    return ["The swing is small."]
'''
SCENARIO = 'title = "A metre"\nkind = "pendulum"\nlength = 1.0\n'


@pytest.fixture
def offered(monkeypatch: pytest.MonkeyPatch):
    """(name=place, …): entry points of studies that an installed package offers, for the time of a test."""

    def offer(**places: str) -> None:
        def entry_points(**chosen: str) -> EntryPoints:
            offers = [EntryPoint(name, place, STUDIES.group) for name, place in places.items()]
            return EntryPoints(offers).select(**chosen)

        monkeypatch.setattr(importlib.metadata, "entry_points", entry_points)
        STUDIES.__dict__.pop("_outside", None)
        computing_digest.cache_clear()  # it is of what is installed

    kept = dict(STUDIES._loaded)
    yield offer
    monkeypatch.undo()
    computing_digest.cache_clear()
    STUDIES.__dict__.pop("_outside", None)
    STUDIES._loaded.clear()
    STUDIES._loaded.update(kept)


@pytest.fixture
def pendulum(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, offered) -> Path:
    """A scenario of a kind that a module outside this package offers."""
    (tmp_path / "swinging.py").write_text(MODULE, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setitem(sys.modules, "swinging", None)
    del sys.modules["swinging"]  # so that it is forgotten at the end
    offered(pendulum="swinging:STUDY")
    path = tmp_path / "metre.toml"
    path.write_text(SCENARIO, encoding="utf-8")
    return path


def test_no_kind_loads_matplotlib_to_report():
    reporting = (
        "import sys\n"
        "from tribodyn.studies import STUDIES\n"
        "assert all(STUDIES[kind].reported() for kind in STUDIES)\n"
        "assert 'matplotlib' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", reporting], check=True, timeout=300)


def test_an_unknown_kind_in_a_scenario_is_one_error(tmp_path: Path):
    path = tmp_path / "mine.toml"
    path.write_text('title = "mine"\nkind = "eficiency"\n', encoding="utf-8")
    with pytest.raises(InputError, match='did you mean "efficiency"') as error:
        load_scenario(path)
    assert (error.value.key, error.value.file) == ("kind", str(path))
    line = complaint("run", path)
    assert f'{path}: kind = "eficiency": ' in line
    assert 'did you mean "efficiency"' in line


def test_an_unknown_kind_to_begin_with_is_one_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    line = complaint("init", "mine", "--kind", "nonsense")
    assert 'kind = "nonsense"' in line
    assert all(kind in line for kind in STUDIES)
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def orphan(tmp_path: Path) -> Path:
    """A sound record of a kind that nothing that is installed knows."""
    with gear_pair_writer(tmp_path / "orphan.h5", 3) as record:
        record.write(0, block(0, 3))
        path = record.finish({"efficiency": 0.98})
    with h5py.File(path, "r+") as file:
        file.attrs["kind"] = "nonsense"
    return path


def test_a_record_of_an_unknown_kind_can_be_read_but_not_drawn(orphan: Path, tmp_path: Path):
    with Record(orphan) as record:
        assert record.kind == "nonsense"
        np.testing.assert_array_equal(record["normal_load"], block(0, 3)["normal_load"])
        with pytest.raises(InputError, match='of kind "nonsense", which nothing that is installed knows'):
            study_of_record(record)
    other = tmp_path / "other.h5"
    shutil.copy(orphan, other)
    for words in (("show", orphan), ("plot", orphan, "-o", tmp_path), ("compare", orphan, other)):
        assert f'record = {orphan}: a study of kind "nonsense"' in complaint(*words)


def test_a_study_of_another_package_is_listed_checked_and_run(pendulum: Path, tmp_path: Path):
    assert list(STUDIES)[-1] == "pendulum"
    assert "a pendulum of small swing" in invoke("list", "kinds")
    assert "angle over time" in invoke("list", "plots")
    assert '"pendulum"' in invoke("schema")
    assert '"period": 2.006' in invoke("check", pendulum, "--json")
    path = tmp_path / "metre.h5"
    shown = invoke("run", pendulum, "-o", path)
    assert "Period" in shown
    assert "The swing is small." in invoke("show", path, "--full")
    with Record(path) as record:
        assert (record.kind, record.axis, list(record)) == ("pendulum", "time", ["time", "angle"])
        assert names([record]) == ("angle",)
    invoke("plot", path, "angle", "-o", tmp_path)
    assert (tmp_path / "metre-angle.png").exists()


def test_a_study_of_another_package_is_begun_and_swept(pendulum: Path, tmp_path: Path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    invoke("init", "mine", "--kind", "pendulum")
    result = run(load_scenario("mine.toml"), "mine.h5")
    assert result.summary["period"] == pytest.approx(2.00607, abs=1e-5)
    invoke("sweep", "mine.toml", "--vary", "length=1,4", "-o", "lengths.h5")
    with h5py.File("lengths.h5") as file:
        np.testing.assert_allclose(file["period"][1] / file["period"][0], 2.0)


def test_a_kind_of_this_package_cannot_be_taken(offered):
    offered(efficiency="nowhere:STUDY")
    assert list(STUDIES).count("efficiency") == 1
    assert STUDIES["efficiency"].package == "tribodyn.studies.efficiency"


def test_a_broken_package_is_one_error_that_names_it(offered, tmp_path: Path):
    offered(pendulum="nowhere_to_be_seen:STUDY")
    with pytest.raises(InputError, match="nowhere_to_be_seen:STUDY that offers it cannot be loaded") as error:
        STUDIES["pendulum"]
    assert error.value.key == "kind"
    assert "uninstall nowhere_to_be_seen:STUDY" in str(error.value)
    path = tmp_path / "metre.toml"
    path.write_text(SCENARIO, encoding="utf-8")
    assert "nowhere_to_be_seen" in complaint("run", path)
    assert "nowhere_to_be_seen" in complaint("init", "mine", "--kind", "pendulum")
