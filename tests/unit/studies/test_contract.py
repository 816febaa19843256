"""What every kind of study offers, on the smallest real case: its template, made short.

Kinds come from the registry: a new one is tested as soon as it is listed.
"""

import json
import re
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
import xarray

import tribodyn as td
from tests.support.short_studies import FINITE_ELEMENTS, short_case, written_template
from tests.support.soak_parameters import all_in_soak
from tests.support.verbs import complaint, invoke
from tribodyn.errors import InputError
from tribodyn.geometry.families import FAMILIES
from tribodyn.input.quantity import Table
from tribodyn.post.figures.drawing import Drawing, SweepDrawing
from tribodyn.post.style import save
from tribodyn.post.verdict import LINES
from tribodyn.quantities.quantity import Quantity
from tribodyn.record.reader import Record
from tribodyn.studies import DEFAULT, STUDIES, study_of
from tribodyn.studies.pages import compare, figure, names, summary_table
from tribodyn.studies.protocol.load import filled, load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.studies.protocol.study import CaseHead, CheckResult, RunResult, Study

KINDS = tuple(STUDIES)
RUNS = [pytest.param(kind, marks=pytest.mark.slow) if kind in FINITE_ELEMENTS else kind for kind in KINDS]
#: What two runs of one case may differ in.
OF_THE_RUN = {"wall_time", "record"}


@pytest.mark.parametrize("kind", KINDS)
def test_every_part_is_there(kind: str):
    study = STUDIES[kind]
    assert isinstance(study, Study)
    assert study.kind == kind
    assert study.about
    assert issubclass(study.table(), Table)
    assert study.table().model_fields["kind"].annotation is not None
    drawings = study.drawings()
    assert "overview" in drawings
    assert len(drawings) > 1
    assert all(isinstance(drawing, Drawing) and drawing.about for drawing in drawings.values())
    reported = [quantity for group in study.reported().values() for quantity in group]
    assert reported
    assert all(isinstance(quantity, Quantity) and quantity.label for quantity in reported)
    assert set(study.compared) <= set(study.reported())
    swept = study.swept()
    assert swept
    assert all(isinstance(known, Quantity) and known.si for known in swept.values())
    assert {quantity.name for quantity in study.sweep_table()} <= set(swept)
    assert all(isinstance(drawing, SweepDrawing) for drawing in study.sweep_drawings().values())


@pytest.mark.parametrize("kind", KINDS)
def test_the_template_is_a_scenario(kind: str, tmp_path: Path):
    """It offers the other kinds and, with gears, every tooth family; what is resolved of it loads again."""
    title = 'my "own" \\ study'
    text = filled(kind, title)
    assert {name for name in KINDS if re.search(rf"^#   {name} ", text, re.MULTILINE)} == {*KINDS} - {kind}
    assert max(map(len, text.splitlines())) <= 120
    if STUDIES[kind].has_gears:
        assert re.search(r"^\[drive\]$", text, re.MULTILINE)
        assert {name for name in FAMILIES if f'family = "{name}"' in text} == set(FAMILIES)
    path, again = tmp_path / "mine.toml", tmp_path / "again.toml"
    path.write_text(text, encoding="utf-8")
    case = load_scenario(path)
    assert isinstance(case, CaseHead)
    assert (case.kind, case.name, case.title) == (kind, "mine", title)
    again.write_text(case.toml, encoding="utf-8")
    assert load_scenario(again).sha256 == case.sha256


@pytest.mark.parametrize("verb", ["check", "run"])
@pytest.mark.parametrize("kind", KINDS)
def test_a_mistake_is_one_line_and_leaves_nothing(kind: str, verb: str, tmp_path: Path, monkeypatch):
    """File, key, value, rule and remedy; exit status 2."""
    monkeypatch.chdir(tmp_path)
    path = written_template(kind, tmp_path)
    path.write_text(f"nonsense = 3\n{path.read_text(encoding='utf-8')}", encoding="utf-8")
    line = complaint(verb, path)
    assert line.startswith(f"{path}: nonsense = 3: unknown key; known keys: title")
    assert [found.name for found in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("kind", RUNS)
def test_a_case_is_checked(kind: str, tmp_path: Path):
    checked = STUDIES[kind].check(short_case(kind, tmp_path))
    assert isinstance(checked, CheckResult)
    assert checked.data
    for table in checked.every:
        assert table.title
        assert table.rows
        assert all(len(row) == len(table.columns) for row in table.rows)


@pytest.mark.parametrize("kind", RUNS)
def test_a_record_describes_itself(kind: str, short_runs):
    """By our reader, h5py and xarray: every dataset has its unit, its long name and its dimensions."""
    result = short_runs(kind)
    assert isinstance(result, RunResult)
    assert (result.status, result.message) == ("complete", "")
    with (
        Record(result.path) as record,
        h5py.File(result.path) as file,
        xarray.open_dataset(result.path, engine="h5netcdf") as data,
    ):
        assert record.kind == record.attrs["kind"] == kind
        assert record.attrs["axis"] == record.axis
        listed = record.attrs["datasets"].split()
        assert listed[0] == record.axis
        assert set(record) <= set(listed)
        assert len(record[record.axis]) == record.samples > 0
        for name in listed:
            assert record.units(name) == file[name].attrs["units"], name
            assert record.long_name(name) == file[name].attrs["long_name"], name
            scales = tuple(str(dim[0].name).strip("/") for dim in file[name].dims if len(dim))
            assert data[name].dims == (scales or (name,) * bool(file[name].shape)), name
        for name in record:
            assert len(record[name]) == record.samples, name
            assert data[name].dims[0] == record.axis
            if record[name].dtype.kind == "f":
                np.testing.assert_array_equal(record[name], file[name][...])  # pyright: ignore[reportIndexIssue]
        assert all("units" in variable.attrs for variable in data.variables.values())


@pytest.mark.parametrize("kind", RUNS)
def test_a_quantity_has_one_value(kind: str, short_runs):
    """In the result of the run, the record's summary, the JSON of `show`, and Python's `open`."""
    study, result = STUDIES[kind], short_runs(kind)
    shown = json.loads(invoke("show", result.path, "--json"))["summary"]
    opened = td.open(result.path)
    reported = {quantity.name for group in study.reported().values() for quantity in group}
    with Record(result.path) as record:
        assert set(record.summary) == {name for name, value in result.summary.items() if value is not None}
        assert len(reported & set(record.summary)) >= 3
        for name in reported & set(record.summary):
            value = result.summary[name]
            for other in (record.summary[name], shown[name], opened.summary[name]):
                assert np.array_equal(value, other), name
        assert study.sentences(record)
        lines = study.verdict(record)
        assert 1 <= len(lines) <= LINES
        for line in lines:  # for a reader who has never seen the program
            assert re.fullmatch(r"[A-Z].*\.", line), line
            assert not re.search(r"\bnan\b|\binf\b|judged|e[+-]\d\d", line), line
        brief, full = (len(summary_table(record, full).renderables) for full in (False, True))
        assert brief < full


@pytest.mark.parametrize(
    "kind",
    all_in_soak(
        [kind for kind in KINDS if kind not in ("gear-pair", "gear-train")],
        lambda kind: kind not in ("design", "assessment", "train-assessment"),
    ),
)
def test_quantities_without_a_record_are_those_of_the_run(kind: str, short_runs, tmp_path: Path):
    study, summary = STUDIES[kind], short_runs(kind).summary
    figures = study.quantities_of(short_case(kind, tmp_path))
    missing = {name for name in study.swept() if summary.get(name) is None}
    assert missing < set(study.swept())
    for name in set(study.swept()) - missing:
        np.testing.assert_allclose(figures[name], summary[name], rtol=1e-12, err_msg=name)
    assert all(figures.get(name) is None for name in missing)


@pytest.mark.parametrize("kind", RUNS)
def test_every_figure_that_is_listed_is_drawn_and_no_other(kind: str, short_runs, tmp_path: Path):
    path = short_runs(kind).path
    listed = json.loads(invoke("list", "plots", path, "--json"))["plots"]
    refused = complaint("plot", path, "no-such")
    with Record(path) as record:
        assert {*names([record]), "overview"} == set(listed)
        for name in listed:
            drawn = figure(name, [record])
            assert drawn.axes
            assert name in refused or name == "overview"
        assert save(drawn, tmp_path / "picture.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("kind", RUNS)
def test_an_interrupted_run_keeps_what_is_done(kind: str, short_runs, tmp_path: Path):
    """No record of the full name; what there is opens and says why it ends; some kinds go on from it."""
    study, case, path = STUDIES[kind], short_case(kind, tmp_path), tmp_path / "mine.h5"

    def interrupt(share: float) -> None:
        if share > 0.0:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(case, path, progress=interrupt)
    partial = tmp_path / "mine.partial.h5"
    assert not path.exists()
    if partial.exists():
        with Record(partial) as record:
            assert (record.status, record.message) == ("failed", "interrupted by the user")
            assert all(len(record[name]) == record.samples for name in record)
    if not study.resumes:
        with pytest.raises(InputError, match="such a run cannot go on") as refused:
            run(case, path, resume=True)
        assert refused.value.key == "--resume"
        return
    again = run(case, path, resume=True)
    assert again.status == "complete"
    whole = short_runs(kind).summary
    for name in (quantity.name for group in study.reported().values() for quantity in group):
        if name not in OF_THE_RUN and isinstance(whole.get(name), float):
            assert again.summary[name] == whole[name], name


def test_a_gear_pair_is_compared_with_its_efficiency(short_runs):
    with (
        Record(short_runs("gear-pair").path) as motion,
        Record(short_runs("efficiency").path) as slow,
    ):
        compared = compare([motion, slow])
        rows = {row.quantity.name: row.values for rows in compared.groups.values() for row in rows}
        for name in ("efficiency", "contact_ratio", "normal_load_max", "friction_coefficient_mean"):
            assert rows[name] == (motion.summary[name], slow.summary[name]), name
        assert compared.conditions["kind"] == ("gear-pair", "efficiency")
        assert "normal-load" in names([motion, slow])
        assert len(figure("normal-load", [motion, slow]).axes) == 1


@pytest.mark.parametrize(
    ("kinds", "message"),
    [
        (("gear-pair", "irefc"), 'kind "irefc" and kind "gear-pair" share no quantities'),
        (("efficiency", "backlash-oscillator"), "share no quantities"),
    ],
)
def test_records_of_other_quantities_are_not_compared(short_runs, kinds: tuple[str, str], message: str):
    with Record(short_runs(kinds[0]).path) as first, Record(short_runs(kinds[1]).path) as second:
        with pytest.raises(InputError, match=message) as error:
            compare([first, second])
        assert error.value.key == "record"
        with pytest.raises(InputError, match="draw them apart"):
            names([first, second])


@pytest.mark.parametrize("named", [None, "nonsense", 3, "efficiency"])
def test_a_study_is_of_the_kind_that_its_scenario_names(named: Any):
    """What else it may be is complained of where the scenario is read."""
    assert KINDS[0] == DEFAULT
    assert study_of({"kind": named}).kind == (named if named in KINDS else DEFAULT)
