"""Files beside records on a disk without room: each is whole, as it was, or not there; the first is named.

A limit of the system to the size of files stands for the disk: it takes so many bytes of each and no more.
"""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.record_samples import block, gear_pair_writer, geometry
from tests.support.short_studies import SHORT, ShortRuns
from tests.support.soak_parameters import all_in_soak
from tests.support.verbs import complaint, ended, invoke, sets
from tribodyn.errors import OutputError
from tribodyn.numerics.files.output_files import MARKS, write_output
from tribodyn.record.reader import Record

resource = pytest.importorskip("resource")


@contextmanager
def files_of_at_most(size: int) -> Iterator[None]:
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)


def sizes(folder: Path) -> dict[str, int]:
    return {path.name: path.stat().st_size for path in folder.iterdir()}


VERBS = {
    "plot": ["plot", "RECORD", "overview"],
    "plot as PDF": ["plot", "RECORD", "overview", "--format", "pdf"],
    "plot as SVG": ["plot", "RECORD", "overview", "--format", "svg"],
    "report": ["report", "RECORD"],
    "gear": ["gear", "liu-ni-involute-23-47", "-o", ".", "--points", "10"],
    "gear as spline": ["gear", "liu-ni-involute-23-47", "--as-spline", "9"],
    "init": ["init", "mine"],
    "run": ["run", "backlash-oscillator", "-o", "m.h5", "--report", *sets(SHORT["backlash-oscillator"])],
}


@pytest.mark.parametrize("verb", all_in_soak(VERBS, ("plot", "report", "init", "run")))
def test_no_file_is_cut(verb: str, short_runs: ShortRuns, tmp_path: Path):
    record = str(short_runs("backlash-oscillator").path) if "RECORD" in VERBS[verb] else ""
    words = [record if word == "RECORD" else word for word in VERBS[verb]]
    (tmp_path / "whole").mkdir()
    assert ended(*words, folder=tmp_path / "whole").stderr == ""
    whole = sizes(tmp_path / "whole")
    for size in sorted({bytes_ for name, bytes_ in whole.items() if not name.endswith(".h5")}):
        folder = tmp_path / str(size)
        folder.mkdir()
        with files_of_at_most(size // 2):
            said = complaint(*words, folder=folder, status=3)
        named = Path(said.partition(": cannot be written: File too large")[0]).name
        assert named in whole
        assert whole[named] > size // 2
        left = sizes(folder)
        assert named not in left
        assert not [name for name in left if name.endswith(".tmp")]
        # a date or a duration in a file may be a digit longer
        assert all(abs(bytes_ - whole[name]) < 100 for name, bytes_ in left.items())
        if "m.h5" in left:
            assert said.rstrip().endswith("the record is complete: m.h5")


@pytest.mark.parametrize("ending", MARKS)
def test_what_was_there_stays(ending: str, tmp_path: Path):
    path = write_output(tmp_path / f"a{ending}", MARKS[ending])
    with files_of_at_most(100), pytest.raises(OutputError, match=rf"a{ending}: cannot be written: File too"):
        write_output(path, MARKS[ending] + b"x" * 1000)
    assert path.read_bytes() == MARKS[ending]
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.soak  # without room for compiled kernels they are made anew
def test_a_part_of_an_assessment_is_named(tmp_path: Path):
    invoke("init", "mine", "--kind", "assessment", folder=tmp_path)
    (tmp_path / "mine").mkdir()
    with files_of_at_most(64):
        said = complaint("assess", "mine.toml", folder=tmp_path, status=3)
    assert "mine/assessment-parts/" in said
    assert ": cannot be written: File too large" in said
    assert 64 not in [path.stat().st_size for path in (tmp_path / "mine").rglob("*") if path.is_file()]


def record_and_drawing(folder: Path) -> None:
    head = {"outlines": geometry(), "scenario_toml": "title = 1\n", "sha256": "0"}
    with gear_pair_writer(folder / "run.h5", 9, **head) as writer:
        writer.write(0, block(0, 5))
        write_output(folder / "a.dxf", b"x" * 2_000_000)


def test_what_is_kept_is_said_where_a_file_beside_the_record_finds_no_room(tmp_path: Path):
    said = r"a\.dxf: .*too large; the first 5 of 9 samples: .*run\.partial"
    with files_of_at_most(1_000_000), pytest.raises(OutputError, match=said):
        record_and_drawing(tmp_path)
    with Record(tmp_path / "run.partial.h5") as left:
        assert (left.status, left.samples) == ("failed", 5)
