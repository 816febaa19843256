"""Runs of searches: the record, the best file, what is kept and gone on from, what fails clearly."""

import shutil
import tomllib
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

import tribodyn as td
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies.design.figures import before_and_after
from tribodyn.studies.design.report import sentences
from tribodyn.studies.pages import report

#: A case of it takes milliseconds.
BASE = {
    "title": "an efficiency",
    "kind": "efficiency",
    "drive": "liu-ni-involute-23-47",
    "lubricant": "liu-ni-2022",
    "operating": {"pinion_speed": "10 rad/s", "gear_torque": "500 N*m"},
    "mesh": {"load_sharing": "uniform"},
    "friction": {"law": "coulomb", "coefficient": 0.05},
    "film": {"law": "dowson-higginson"},
    "output": {"samples_per_cycle": 8},
}
FREE = {"drive.pinion.profile_shift": (-0.2, 0.5), "drive.gear.profile_shift": (-0.2, 0.5)}


def search(output: Path, **more: Any) -> td.Design:
    given: dict[str, Any] = {"free": FREE, "minimise": "loss", "evaluations": 10, **more}
    return td.design(BASE, output=output, **given)


@pytest.mark.parametrize(("most", "at_end"), [(1.0, True), (0.9965, False)])
def test_a_best_value_at_an_end_of_its_range_is_named(tmp_path: Path, most: float, at_end: bool):
    """The loss goes as the coefficient: the least is best, but where a constraint forbids it."""
    key = "friction.coefficient"
    found = search(tmp_path / "a.h5", free={key: (0.02, 0.05)}, subject_to=[f"efficiency <= {most}"])
    assert (found.best[key] == pytest.approx(0.02, rel=1e-3)) is at_end
    assert (f"At an end of its range, beyond which may be better: {key}." in found.verdict[1]) is at_end


def test_what_a_search_leaves(tmp_path: Path):
    found = search(tmp_path / "a.h5", subject_to=["contact_ratio >= 1.6"])
    assert found.status == "complete"
    assert found.objective < found.objective_start
    assert set(found.best) == set(FREE)
    searched = found.data.refinement == 1
    assert found.evaluations == int(searched.sum()) <= 10
    counted = found.summary
    assert found.evaluations + counted["evaluations_finer"] == found.data.sizes["evaluation"]
    # both keys are moved to either side, and the start is evaluated on every resolution
    assert counted["evaluations_about"] == 4
    levels = 1 + len({1, *found.data.refinement.values.tolist()} - {1})
    assert counted["evaluations_total"] == found.data.sizes["evaluation"] + 4 + levels
    feasible = (found.data.feasible == 1) & (found.data.refinement == found.data.refinement.max())
    assert found.objective == float(found.data.objective.where(feasible).min())
    # the best file runs as it stands, to the same figure
    again = td.run(str(tmp_path / "a-best.toml"))
    assert again.summary["power_friction_mean"] == pytest.approx(found.objective, rel=1e-12)
    assert again.summary["contact_ratio"] >= 1.6
    assert (tmp_path / "a-best.dxf").stat().st_size > 1000
    # what stands in the record is what the scenario gives with those values
    row = int(found.data.objective.values.argmax())
    values = {key: float(found.data[f"free_{key.split('.')[1]}_profile_shift"][row]) for key in FREE}
    assert td.run(BASE, values).summary["power_friction_mean"] == pytest.approx(
        float(found.data.objective[row]), rel=1e-9
    )


class Counting:
    """A client of Dask that evaluates in this process, at once, and counts what it is given."""

    def __init__(self) -> None:
        self.count = 0

    def scheduler_info(self, **_: Any) -> dict[str, Any]:
        return {"workers": {}}

    def cancel(self, futures: list[Any]) -> None:
        assert not futures

    def submit(self, function: Any, *given: Any, **_: Any) -> "Future[Any]":
        self.count += 1
        done: Future[Any] = Future()
        done.set_result(function(*given))
        return done


def test_an_interrupted_search_keeps_its_best_and_goes_on(tmp_path: Path):
    client = Counting()
    whole = search(tmp_path / "whole.h5", client=client)
    assert client.count >= whole.evaluations + 1  # the start, and about the best what is not known

    def stop(share: float) -> None:
        if share >= 0.08:  # four of the evaluations that are expected, those of the last stage among them
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt) as stopped:
        search(tmp_path / "stopped.h5", progress=stop)
    assert any("the best so far" in note for note in stopped.value.__notes__)
    assert any("--resume goes on" in note for note in stopped.value.__notes__)
    with Record(tmp_path / "stopped.partial.h5") as record:
        assert record.status == "failed"
        assert record.message == "interrupted by the user"
        assert record.samples == 4
        assert record.summary["objective"] == min(record["objective"])
        best = tomllib.loads((tmp_path / "stopped-best.toml").read_text(encoding="utf-8"))
        shift = record.summary["best"]["drive.pinion.profile_shift"]
        assert best["drive"]["pinion"]["profile_shift"] == shift
    with pytest.raises(InputError, match="unfinished"):
        search(tmp_path / "stopped.h5")
    with pytest.raises(InputError, match="another scenario"):
        search(tmp_path / "stopped.h5", resume=True, seed=5)
    shutil.copy(tmp_path / "stopped.partial.h5", tmp_path / "other.partial.h5")
    with h5py.File(tmp_path / "other.partial.h5", "r+") as file:
        file.attrs["code_sha256"] = "0" * 64
    with pytest.raises(InputError, match="computed by other code"):
        search(tmp_path / "other.h5", resume=True)

    rest = Counting()
    gone_on = search(tmp_path / "stopped.h5", resume=True, client=rest)
    assert gone_on.status == "complete"
    assert gone_on.best == whole.best
    assert (gone_on.data.objective.values == whole.data.objective.values).all()
    assert rest.count == client.count - 4 - 1


def test_a_front_without_duties_is_drawn_and_told(tmp_path: Path):
    found = search(tmp_path / "a.h5", minimise=["loss", "hertz_pressure_max"], evaluations=24)
    pictures = ("overview", "teeth", "history", "duties", "free-keys", "sensitivities", "front")
    assert all(found.plot(name).get_axes() for name in pictures)
    with Record(tmp_path / "a.h5") as record:
        said = " ".join(sentences(record))
        text, (_, quantities) = report([record]), before_and_after(record)
    assert "Maximum Hertz pressure" in said
    assert {"Maximum Hertz pressure", "Contact ratio"} <= {row[0] for row in quantities.rows}
    for shown in ("Quantities before and after", "data:image/png;base64,", "drive.pinion.profile_shift"):
        assert shown in text
    order = [text.index(part) for part in ("<h2>Result</h2>", "Teeth: outlines", "<h2>Over the run</h2>")]
    assert order == sorted(order), "what was found stands before the search"
    (outlines, *_) = found.plot("teeth").get_axes()
    start, best = (
        next(line for line in outlines.lines if line.get_label() == label).get_xydata()
        for label in ("start", "gear, best")
    )
    assert not np.allclose(start, best, atol=1e-3), "the found profile shifts move the gear's flanks"


def test_constraints_that_cannot_be_kept_are_named(tmp_path: Path):
    failed = search(tmp_path / "a.h5", subject_to=["contact_ratio >= 3"], evaluations=5)
    assert failed.status == "failed"
    assert failed.message.startswith("no candidate satisfies all constraints; the nearest, ")
    assert "misses contact_ratio >= 3 by" in failed.message
    assert not (tmp_path / "a-best.toml").exists()


def test_a_start_that_cannot_be_made_is_said_and_left(tmp_path: Path):
    interfering = {"drive.pinion.profile_shift": -0.9}
    found = search(tmp_path / "a.h5", overrides=interfering, evaluations=4)
    assert found.status == "complete"
    assert found.objective_start is None
    assert "fillet" in found.summary["start_message"]


def test_nothing_of_the_users_is_replaced(tmp_path: Path):
    (tmp_path / "a-best.toml").write_text("mine", encoding="utf-8")
    with pytest.raises(InputError, match=r"a-best\.toml: the file exists"):
        search(tmp_path / "a.h5")


@pytest.mark.soak
def test_a_cluster_finds_what_this_machine_finds(tmp_path: Path):
    distributed = pytest.importorskip("distributed")
    here = search(tmp_path / "here.h5")
    with distributed.Client(
        processes=False, n_workers=2, threads_per_worker=1, dashboard_address=None
    ) as client:
        there = search(tmp_path / "there.h5", client=client)
    assert there.summary["engine"] == "dask"
    assert there.summary["workers"] == 2
    for name in ("objective_start", "objective", "best", "evaluations"):
        assert getattr(there, name) == getattr(here, name)
    assert there.summary["quantities_best"] == here.summary["quantities_best"]
