"""What every kind of study offers: its parts, a run of its template, its pictures and its figures."""

from pathlib import Path

import numpy as np
import pytest

from tests.support.short_studies import SHORT, short_case, written_template
from tribodyn.errors import InputError
from tribodyn.numerics.variable import Variable
from tribodyn.post.figures.drawing import Drawing, SweepDrawing
from tribodyn.post.report import Line
from tribodyn.record.reader import open_record
from tribodyn.scenario.quantity import Table
from tribodyn.studies import DEFAULT, STUDIES, study_of
from tribodyn.studies.pages.pictures import compare, figure, names, summary_table
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.study import CaseHead, Checked, RunResult, Study

KINDS = tuple(STUDIES)
#: Their runs take long even when they are short: finite elements.
SLOW = ("load-contact", "design", "assessment")
RUNS = [pytest.param(kind, marks=pytest.mark.slow) if kind in SLOW else kind for kind in KINDS]


def test_every_kind_is_tested():
    assert set(SHORT) == set(KINDS)
    assert DEFAULT == KINDS[0]


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
    assert all(isinstance(one, Drawing) and one.about for one in drawings.values())
    lines = [line for some in study.lines().values() for line in some]
    assert lines
    assert all(isinstance(line, Line) and line.label for line in lines)
    assert set(study.compared) <= set(study.lines())
    swept = study.swept()
    assert swept
    assert all(isinstance(one, Variable) and one.units and one.long_name for one in swept.values())
    assert {line.name for line in study.sweep_lines()} <= set(swept)
    assert all(isinstance(one, SweepDrawing) for one in study.sweep_drawings().values())


@pytest.mark.parametrize("kind", KINDS)
def test_the_template_is_a_scenario(kind: str, tmp_path: Path):
    case = load_scenario(written_template(kind, tmp_path))
    assert isinstance(case, CaseHead)
    assert (case.kind, case.name, case.title) == (kind, kind, f"A study of kind {kind}")
    again = tmp_path / "again.toml"
    again.write_text(case.toml, encoding="utf-8")
    assert load_scenario(again).sha256 == case.sha256


@pytest.mark.parametrize("kind", RUNS)
def test_a_case_is_checked(kind: str, tmp_path: Path):
    checked = STUDIES[kind].check(short_case(kind, tmp_path))
    assert isinstance(checked, Checked)
    assert checked.data
    for table in checked.tables:
        assert table.title
        assert table.rows
        assert all(len(row) == len(table.columns) for row in table.rows)


@pytest.mark.parametrize("kind", RUNS)
def test_a_run_gives_a_record_that_describes_itself(kind: str, short_runs):
    result = short_runs(kind)
    assert isinstance(result, RunResult)
    assert (result.status, result.message) == ("complete", "")
    with open_record(result.path) as record:
        assert record.kind == record.attrs["kind"] == kind
        assert record.attrs["axis"] == record.axis
        listed = record.attrs["datasets"].split()
        assert listed[0] == record.axis
        assert set(record) <= set(listed)
        assert len(record[record.axis]) == record.samples > 0
        for name in listed:
            assert record.units(name), name
            assert record.long_name(name), name
        for name in record:
            assert len(record[name]) == record.samples, name
        assert set(record.summary) == {name for name, one in result.summary.items() if one is not None}


@pytest.mark.parametrize("kind", RUNS)
def test_its_summary_has_its_lines(kind: str, short_runs):
    study = STUDIES[kind]
    with open_record(short_runs(kind).path) as record:
        known = {line.name for lines in study.lines().values() for line in lines}
        assert len(known & set(record.summary)) >= 3
        assert study.sentences(record)
        assert summary_table(record).renderables


@pytest.mark.parametrize("kind", [kind for kind in RUNS if kind != "gear-pair"])
def test_figures_without_a_record_are_those_of_the_run(kind: str, short_runs, tmp_path: Path):
    study, summary = STUDIES[kind], short_runs(kind).summary
    figures = study.figures(short_case(kind, tmp_path))
    missing = {name for name in study.swept() if summary.get(name) is None}
    assert missing < set(study.swept())
    for name in set(study.swept()) - missing:
        np.testing.assert_allclose(figures[name], summary[name], rtol=1e-12, err_msg=name)
    assert all(figures.get(name) is None for name in missing)


def test_a_gear_pair_is_compared_with_its_efficiency(short_runs):
    with (
        open_record(short_runs("gear-pair").path) as motion,
        open_record(short_runs("efficiency").path) as slow,
    ):
        compared = compare([motion, slow])
        rows = {row.line.name: row.values for rows in compared.groups.values() for row in rows}
        for name in ("efficiency", "contact_ratio", "normal_load_max", "friction_coefficient_mean"):
            assert rows[name] == (motion.summary[name], slow.summary[name]), name
        assert compared.conditions["kind"] == ("gear-pair", "efficiency")
        shared = names([motion, slow])
        assert "normal-load" in shared
        assert len(figure("normal-load", [motion, slow]).axes) == 1


@pytest.mark.parametrize(
    ("kinds", "message"),
    [
        (("gear-pair", "irefc"), 'kind "irefc" and kind "gear-pair" share no quantities'),
        (("efficiency", "backlash-oscillator"), "share no quantities"),
    ],
)
def test_records_of_other_quantities_are_not_compared(short_runs, kinds: tuple[str, str], message: str):
    with open_record(short_runs(kinds[0]).path) as one, open_record(short_runs(kinds[1]).path) as other:
        with pytest.raises(InputError, match=message) as error:
            compare([one, other])
        assert error.value.key == "record"
        with pytest.raises(InputError, match="draw them apart"):
            names([one, other])


def test_a_study_is_of_the_kind_that_its_scenario_names():
    assert study_of({}).kind == DEFAULT
    assert study_of({"kind": "efficiency"}).kind == "efficiency"
    # what else it may be is complained of where the scenario is read
    assert study_of({"kind": "nonsense"}).kind == DEFAULT
    assert study_of({"kind": 3}).kind == DEFAULT
