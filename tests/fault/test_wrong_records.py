"""Records in which one thing is wrong: shown, drawn, reported and compared, or refused in one line."""

import time
import tomllib
from contextlib import suppress
from pathlib import Path

import h5py
import numpy as np
import pytest
import tomli_w
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import tribodyn as td
from tests.support.record_samples import sweep_record
from tests.support.short_studies import ShortRuns
from tests.support.soak_parameters import all_in_soak
from tests.support.verbs import ended
from tests.support.wrong_records import changed, changes, drawn
from tribodyn.errors import InputError
from tribodyn.post.style import house_style
from tribodyn.post.sweep_report import sweep_as_json
from tribodyn.record import soundness
from tribodyn.record.sweep_reader import SweepRecord, open_any
from tribodyn.studies import STUDIES
from tribodyn.studies import pages as of
from tribodyn.studies.pages import compare, report, sweep_report

pytestmark = pytest.mark.filterwarnings("ignore")  # numbers beyond all bounds may be warned of

OLD = Path(__file__).parents[1] / "fixtures" / "records-0.1.0"
SAMPLES = ["gear-pair", "efficiency", "load-contact", "backlash-oscillator", "sweep"]
#: Seconds of the processor that any use of a record may take.
LIMIT = 3.0


def paint(figure: Figure) -> None:
    figure.dpi = 10
    with house_style():
        FigureCanvasAgg(figure).draw()


def shown(path: Path, _: Path) -> None:
    with open_any(path) as record:
        if isinstance(record, SweepRecord):
            assert of.sweep_table(record).renderables
            assert sweep_as_json(record)
        else:
            assert of.summary_table(record, full=True).renderables
            assert of.summary_json(record)
        _ = record.scenario


def in_python(path: Path, _: Path) -> None:
    opened = td.open(path)
    assert repr(opened)
    assert opened.data.load().attrs
    assert opened.plots


def in_pictures(path: Path, _: Path) -> None:
    with open_any(path) as record:
        if isinstance(record, SweepRecord):
            for name in of.sweep_names([record]):
                paint(of.sweep_figure(name, [record]))
            assert sweep_report(record)
        else:
            for name in ("overview", *of.names([record])):
                paint(of.figure(name, [record]))
            assert report([record])
    assert td.open(path)._repr_html_()


def compared(path: Path, good: Path) -> None:
    with open_any(path) as changed, open_any(good) as other:
        if not isinstance(changed, SweepRecord) and not isinstance(other, SweepRecord):
            assert compare([other, changed])


#: Ways to use a record, and of how many changed records in a row the soak tries it on one.
USES = {shown: 1, in_python: 4, compared: 4, in_pictures: 40}


def check(path: Path, good: Path, number: int | None = None) -> None:
    """Use a record, of a series with this number, in each way: it is taken, or refused in one clear line."""
    for use, every in USES.items():
        if (number is None and use in (compared, in_pictures)) or (number or 0) % every:
            continue
        begun = time.process_time()
        said = "key: rule"
        try:
            use(path, good)
        except InputError as error:
            said = str(error) if error.key and error.rule else ""
        assert len(said.splitlines()) == 1
        assert number is not None or time.process_time() - begun < LIMIT


def no_child(monkeypatch: pytest.MonkeyPatch) -> None:
    """Look through files in this process: none of these is harmful to HDF5, and a child costs a fork each."""
    monkeypatch.setattr(soundness, "through_a_child", lambda look, path: look(path))


@pytest.mark.parametrize("name", SAMPLES)
def test_some_changes(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    no_child(monkeypatch)
    for change in drawn(OLD / f"{name}.h5", 3, seed=1):
        check(changed(OLD / f"{name}.h5", tmp_path / "a.h5", change), OLD / f"{name}.h5")


@pytest.mark.soak
@pytest.mark.parametrize("part", range(4))
@pytest.mark.parametrize("name", SAMPLES)
def test_every_change(name: str, part: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    no_child(monkeypatch)
    for number, change in enumerate(changes(OLD / f"{name}.h5")[part::4]):
        check(changed(OLD / f"{name}.h5", tmp_path / "a.h5", change), OLD / f"{name}.h5", number)


@pytest.mark.soak
@pytest.mark.parametrize("kind", list(STUDIES))
def test_changes_of_a_record_of_every_kind(
    kind: str, short_runs: ShortRuns, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    no_child(monkeypatch)
    good = short_runs(kind).path
    for number, change in enumerate(drawn(good, 300, seed=2)):
        check(changed(good, tmp_path / "a.h5", change), good, 4 * number)


def test_a_sweep_goes_on_from_what_is_left_or_refuses_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    no_child(monkeypatch)
    sweep_record(tmp_path / "run.h5", most=1)
    left = tmp_path / "run.partial.h5"
    good = left.rename(tmp_path / "good.h5")
    for number, change in enumerate(drawn(good, 60, seed=3)):
        folder = tmp_path / str(number)
        folder.mkdir()
        changed(good, folder / left.name, change)
        with suppress(InputError):
            sweep_record(folder / "run.h5", resume=True)


def nul(file: h5py.File) -> None:
    file.attrs["scenario"] = np.bytes_(str(file.attrs["scenario"]).encode() + b"\0a")


def drive_of_text(file: h5py.File) -> None:
    data = tomllib.loads(str(file.attrs["scenario"]))
    file.attrs["scenario"] = tomli_w.dumps(data | {"drive": "a", "operating": "b"})


def summary_of_texts(file: h5py.File) -> None:
    for name in file["summary"].attrs:
        file["summary"].attrs[name] = "a"


def two_in_one_place(file: h5py.File) -> None:
    file["summary"].attrs["efficiency_mean/more"] = 1.0
    file["summary"].attrs["efficiency_mean"] = 1.0


PLAIN = [
    lambda file: file.attrs.__setitem__("message", np.arange(3.0)),
    lambda file: file["time"].__setitem__(3, np.nan),
    lambda file: file["time"].__setitem__(-1, 1e308),
]


@pytest.mark.parametrize("change", [nul, drive_of_text, summary_of_texts, two_in_one_place, *PLAIN])
def test_each_verb_says_it_in_one_line(change, tmp_path: Path):
    good, path = OLD / "gear-pair.h5", tmp_path / "a.h5"
    path.write_bytes(good.read_bytes())
    with h5py.File(path, "r+") as file:
        change(file)
    statuses = []
    for words in (["show"], ["show", "--json"], ["plot", "overview"], ["report"], ["compare", str(good)]):
        found = ended(words[0], path, *words[1:], folder=tmp_path)
        assert found.exit_code in (0, 2), found.output
        assert found.exit_code == 0 or len(found.stderr.splitlines()) == 1
        statuses.append(found.exit_code)
    assert change is drive_of_text or 2 in statuses


def test_a_group_of_many_things_is_refused_at_once(tmp_path: Path):
    path = tmp_path / "a.h5"
    path.write_bytes((OLD / "gear-pair.h5").read_bytes())
    with h5py.File(path, "r+") as file:
        group = file.create_group("more")
        for number in range(20_000):
            group.create_group(str(number))
    begun = time.process_time()
    assert soundness.unsound(path) == "a group of 20000 items"
    with pytest.raises(InputError, match="a group of 20000 items"):
        td.open(path)
    assert time.process_time() - begun < LIMIT


@pytest.mark.parametrize("table", all_in_soak(["", "[operating]\n"], ["[operating]\n"]))
def test_a_scenario_of_many_keys_is_refused_at_once(table: str, tmp_path: Path):
    path = tmp_path / "a.toml"
    keys = "".join(f"key{number} = {number}\n" for number in range(300_000))
    path.write_text(f'title = "a"\nkind = "gear-pair"\n{table}{keys}', encoding="utf-8")
    begun = time.process_time()
    with pytest.raises(InputError, match=r"a table of 30000[02] keys, at most 1000 are read"):
        td.scenario(path)
    assert time.process_time() - begun < LIMIT
