"""Files beside records: what tribodyn did not make is not replaced, and nothing is written through a link."""

import os
from pathlib import Path

import pytest

from tests.support.short_studies import ShortRuns
from tests.support.soak_parameters import all_in_soak
from tests.support.verbs import complaint, ended, invoke
from tribodyn.errors import InputError
from tribodyn.numerics.files.output_files import MARKS, check_output, write_output

PRECIOUS = b"precious"


@pytest.fixture(scope="module")
def record(short_runs: ShortRuns) -> Path:
    return short_runs("backlash-oscillator").path


#: Words of a verb, and the files that it then writes in the current folder.
VERBS = {
    "plot": (["plot", "RECORD", "overview"], ["backlash-oscillator-overview.png"]),
    "plot pdf": (["plot", "RECORD", "overview", "--format", "pdf"], ["backlash-oscillator-overview.pdf"]),
    "plot svg": (["plot", "RECORD", "overview", "--format", "svg"], ["backlash-oscillator-overview.svg"]),
    "report": (["report", "RECORD"], ["backlash-oscillator.html"]),
    "gear": (
        ["gear", "liu-ni-involute-23-47", "-o", ".", "--points", "10"],
        [
            *(f"liu-ni-involute-23-47-pair.{ending}" for ending in ("svg", "png", "dxf")),
            *(
                f"liu-ni-involute-23-47-{side}.{ending}"
                for side in ("pinion", "gear")
                for ending in ("dxf", "csv")
            ),
        ],
    ),
}


@pytest.mark.parametrize("verb", all_in_soak(VERBS, ("plot", "report", "gear")))
def test_a_verb_replaces_its_own_files_and_no_others(verb: str, record: Path, tmp_path: Path):
    words = [str(record) if word == "RECORD" else word for word in VERBS[verb][0]]
    for _ in range(2):
        assert ended(*words, folder=tmp_path).stderr == ""
    assert set(VERBS[verb][1]) <= {path.name for path in tmp_path.iterdir()}
    victim = tmp_path / "victim"
    victim.write_bytes(PRECIOUS)
    for name in VERBS[verb][1]:
        file = tmp_path / name
        made = file.read_bytes()
        file.write_bytes(PRECIOUS)
        rule = f"{name}: the file exists, and tribodyn did not make it; choose another name, or --force"
        assert rule in complaint(*words, folder=tmp_path)
        assert file.read_bytes() == PRECIOUS
        file.unlink()
        for target in (victim, tmp_path / "nothing"):
            file.symlink_to(target)
            assert f"{name}: is a link" in complaint(*words, folder=tmp_path)
            file.unlink()
        file.symlink_to(victim)
        if name == VERBS[verb][1][-1]:
            invoke(*words, "--force", folder=tmp_path)
            assert not file.is_symlink()
        else:
            file.unlink()
            file.write_bytes(made)
    assert victim.read_bytes() == PRECIOUS
    assert not (tmp_path / "nothing").exists()
    assert not list(tmp_path.glob(".*"))


@pytest.mark.parametrize("more", [(), ("--report",)])
def test_a_run_refuses_before_it_computes(more: tuple[str, ...], tmp_path: Path):
    victim, name = tmp_path / "victim", "m.html" if more else "m-overview.png"
    victim.write_bytes(PRECIOUS)
    (tmp_path / name).symlink_to(victim)
    words = ["run", "backlash-oscillator", "--set", "frequency.step=0.5", "-o", "m.h5", *more]
    assert f"{name}: is a link" in complaint(*words, folder=tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {"victim", name}
    invoke(*words, "--force", folder=tmp_path)
    assert not (tmp_path / name).is_symlink()
    assert victim.read_bytes() == PRECIOUS


@pytest.mark.parametrize("name", ["report.html", "assessment.json"])
def test_an_assessment_refuses_before_it_computes(name: str, tmp_path: Path):
    invoke("init", "mine", "--kind", "assessment", folder=tmp_path)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / name).write_bytes(PRECIOUS)
    refused = ended("assess", "mine.toml", folder=tmp_path)
    assert refused.exit_code == 2
    assert f"{name}: the file exists, and tribodyn did not make it" in refused.stderr
    assert [path.name for path in (tmp_path / "mine").iterdir()] == [name]


def test_a_scenario_to_be_edited_is_replaced_by_force_only(tmp_path: Path):
    victim = tmp_path / "victim"
    victim.write_bytes(PRECIOUS)
    invoke("init", "mine", folder=tmp_path)
    complaint("init", "mine", folder=tmp_path)
    (tmp_path / "mine.toml").unlink()
    (tmp_path / "mine.toml").symlink_to(victim)
    assert "is a link" in complaint("init", "mine", folder=tmp_path)
    invoke("init", "mine", "--force", folder=tmp_path)
    assert not (tmp_path / "mine.toml").is_symlink()
    assert victim.read_bytes() == PRECIOUS


@pytest.mark.parametrize("force", [False, True])
@pytest.mark.parametrize("kind", ["folder", "pipe"])
def test_what_is_no_file_is_never_replaced(kind: str, force: bool, tmp_path: Path):
    path = tmp_path / "a.png"
    path.mkdir() if kind == "folder" else os.mkfifo(path)
    with pytest.raises(InputError, match="is a folder" if kind == "folder" else "is no file"):
        write_output(path, MARKS[".png"], force=force)
    assert path.exists()


@pytest.mark.parametrize("ending", MARKS)
def test_a_mark_counts_where_its_kind_has_it(ending: str, tmp_path: Path):
    path = tmp_path / f"a{ending}"
    path.write_bytes(MARKS[ending])
    check_output(path)
    for content in (b"", b"tribodyn", b" " * 2000 + MARKS[ending] + b" " * 2000, MARKS[ending][:-2]):
        path.write_bytes(content)
        with pytest.raises(InputError, match="the file exists"):
            check_output(path)
        check_output(path, force=True)


def test_who_may_read_a_file_stays(tmp_path: Path):
    path = write_output(tmp_path / "a.json", MARKS[".json"])
    path.chmod(0o600)
    assert write_output(path, MARKS[".json"]).stat().st_mode & 0o777 == 0o600
