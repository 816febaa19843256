"""Sweeps of studies whose cases are evaluated one by one: figures, pictures, what is refused, going on."""

import json
from functools import cache
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from tests.support.short_studies import SHORT, short_case, written_template
from tests.support.verbs import complaint, invoke, sets
from tribodyn.grid.engines import LocalEngine
from tribodyn.grid.grid import Grid
from tribodyn.grid.run import run, settings_of
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.run import run as run_case

#: Kind -> the varied key, and two of its values.
VARIED = {
    "efficiency": ("operating.gear_torque", ("200 N*m", "300 N*m")),
    "load-contact": ("drive.pinion.modification.tip_relief", ("0 um", "10 um")),
    "wear": ("operating.gear_torque", ("300 N*m", "350 N*m")),
    "ehl": ("operating.gear_torque", ("300 N*m", "350 N*m")),
    "irefc": ("friction.sliding_coefficient", ("0.05", "0.1")),
    "backlash-oscillator": ("damping", ("0.05", "0.1")),
    "design": ("scenario.drive.module", ("3 mm", "3.1 mm")),
    "assessment": ("operating.oil_temperature", ("70 degC", "80 degC")),
    "train-assessment": ("scenario.operating.oil_temperature", ("70 degC", "80 degC")),
    "drive-cycle": ("scenario.temperature.ambient_temperature", ("15 degC", "25 degC")),
    "map": ("scenario.operating.output_torque", ("1700 N*m", "1770 N*m")),
}
#: Kinds whose cases take long.
LONG = ("load-contact", "ehl", "design", "assessment", "train-assessment")
KINDS = [pytest.param(kind, marks=pytest.mark.soak) if kind in LONG else kind for kind in VARIED]


def words_of(kind: str) -> list[str]:
    """``--vary`` and what makes the cases short."""
    key, values = VARIED[kind]
    written = {name: str(value).lower() if value is False else value for name, value in SHORT[kind].items()}
    return ["--vary", f"{key}={','.join(value.replace(' ', '') for value in values)}", *sets(written)]


def grid_of(kind: str, folder: Path) -> Grid:
    return Grid(str(written_template(kind, folder)), [words_of(kind)[1]], SHORT[kind])


def test_every_kind_without_a_batch_is_tested():
    assert set(VARIED) == {kind for kind, study in STUDIES.items() if study.batch() is None}


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory):
    """(kind) -> record of the sweep of its two cases, and what was printed; each is swept once."""

    @cache
    def made(kind: str) -> tuple[Path, str]:
        folder = tmp_path_factory.mktemp(kind)
        path = folder / "sweep.h5"
        return path, invoke("sweep", written_template(kind, folder), *words_of(kind), "-o", path)

    return made


@pytest.mark.parametrize("kind", KINDS)
def test_a_sweep_has_the_figures_of_single_runs(kind: str, swept, tmp_path: Path):
    key, values = VARIED[kind]
    path, _ = swept(kind)
    shown = json.loads(invoke("show", path, "--json"))
    assert shown["cases"] == shown["done"] == 2
    figures = STUDIES[kind].swept()
    with SweepRecord(path) as record:
        assert (record.status, record.kind_of_study) == ("complete", kind)
        assert set(record.quantities) == set(figures)
        assert (record["status"] == DONE).all()
        for name, quantity in figures.items():
            expected = quantity.variable()
            assert (record.units(name), record.long_name(name)) == (expected.units, expected.long_name)
        found = {name: record[name] for name in figures}
    compared = 0
    # a sweep has the laws that its base scenario chooses in all its cases
    laws = {name.replace(".", "__"): law for name, (law, _) in short_case(kind, tmp_path).chosen().items()}
    for i, value in enumerate(values):
        more: dict[str, Any] = laws | {key.replace(".", "__"): value}
        summary = run_case(short_case(kind, tmp_path, **more), tmp_path / f"{i}.h5").summary
        for name in figures:
            if summary.get(name) is None:
                assert np.isnan(found[name][i]), name
                continue
            np.testing.assert_allclose(found[name][i], summary[name], rtol=1e-12, err_msg=name)
            compared += 1
    assert compared > len(figures)
    assert any(found[name][0] != found[name][1] for name in figures)


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_shown_and_drawn(kind: str, swept, tmp_path: Path):
    path, said = swept(kind)
    assert "minimum" in said
    assert "2 done" in said
    lines = [line for line in STUDIES[kind].sweep_table() if line.title in invoke("show", path)]
    assert len(lines) >= 3
    drawn = json.loads(invoke("plot", path, "-o", tmp_path, "--json"))["pictures"]
    assert [Path(picture).name for picture in drawn] == ["sweep-response.png"]
    assert Path(drawn[0]).read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("kind", VARIED)
@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--direction", "up"), "--direction: "),
        (("--transient", "4"), "--transient = 4: "),
        (("--engine", "jax"), "--engine = jax: "),
    ],
)
def test_what_belongs_to_motions_is_refused(kind: str, words: tuple[str, str], said: str, tmp_path: Path):
    path = tmp_path / "sweep.h5"
    line = complaint("sweep", written_template(kind, tmp_path), *words_of(kind), *words, "-o", path)
    assert said in line
    assert STUDIES[kind].about in line
    assert not path.exists()
    assert not (tmp_path / "sweep.partial.h5").exists()


def test_a_stopped_sweep_goes_on_to_the_same_record(tmp_path: Path):
    class Stops(LocalEngine):
        def __call__(self, kind, chunks, settings):
            yield next(iter(super().__call__(kind, chunks, settings)))
            raise KeyboardInterrupt

    kind = "irefc"
    grid = grid_of(kind, tmp_path)
    whole = run(grid, settings_of(grid), LocalEngine(), tmp_path / "whole.h5")
    with pytest.raises(KeyboardInterrupt):
        run(grid, settings_of(grid), Stops(), tmp_path / "stopped.h5")
    with SweepRecord(tmp_path / "stopped.partial.h5") as left:
        assert left.count() == {"cases": 2, "done": 1, "failed": 0, "waiting": 1}
    words = [written_template(kind, tmp_path), *words_of(kind), "-o", tmp_path / "stopped.h5", "--resume"]
    invoke("sweep", *words)
    with SweepRecord(tmp_path / "stopped.h5") as record:
        assert record.summary["cases_done_by_this_call"] == 1
    with h5py.File(whole.path) as a, h5py.File(tmp_path / "stopped.h5") as b:
        assert set(a) == set(b)
        for name in a:
            if isinstance(a[name], h5py.Dataset):
                assert a[name][...].tobytes() == b[name][...].tobytes(), name
