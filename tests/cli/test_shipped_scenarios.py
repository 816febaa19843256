"""Every shipped scenario runs as a user would run it, shortened; and what it leaves behind can be used."""

import json
from pathlib import Path

import numpy as np
import pytest

from tests.support.forked_verbs import ForkedVerbs
from tests.support.passed_before import unless_passed
from tests.support.short_studies import shorter
from tests.support.soak_parameters import all_in_soak
from tests.support.verbs import in_a_process, sets
from tribodyn.input.sources import names, shipped
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_scenario


def tribodyn(*arguments: str, folder: Path) -> str:
    ended = in_a_process(*arguments, folder=folder)
    assert ended.returncode == 0, ended.stderr
    assert ended.stderr == ""  # no progress bar where nobody watches
    return ended.stdout


#: Whose picture is drawn: one of every kind, and with reversed loads, many pairs, changing speed.
STUDIES = {"efficiency-crc-23-47", "load-contact-18-36", "irefc", "backlash-oscillator"}
DRAWN = {"crc-23-47", "rattle", "high-contact-ratio", "run-up"} | STUDIES
#: Those of `make test`; the figures of every kind are drawn by `unit/studies/test_contract.py`.
PICTURES = {"crc-23-47", "run-up"}
#: Drives of a paper whose flanks touch at a very small radius where contact ends.
OUTSIDE_THE_MODEL = {"jia-parabolic-17-29"}


SEARCHES = [name for name in names(shipped("scenarios")) if name.startswith("design-")]
#: The cost of a search: a few candidates show that it runs.
FEW = ("design.evaluations=3", "design.sensitivities=false", "design.confirm={}")
#: What three candidates can reach of a search's constraints.
REACHED = {"design-crowning-18-36": ('design.subject_to=["hertz_pressure_max <= 2 GPa"]',)}
#: Searches whose candidates take milliseconds; the others run in soak.
QUICK_SEARCHES = ("design-cycloid-23-47", "design-shift-23-47")
#: Families and studies of which another scenario runs; these run in soak.
ALIKE = {
    "assessment-helical-24-95",
    "crc-23-47-300",
    "drive-cycle-reducer",
    "dtu-10mw-gearbox",
    "dtu-10mw-gearbox-assessment",
    "efficiency-helical-24-95",
    "efficiency-involute-18-36",
    "electric-axle",
    "ehl-crc-23-47",
    "helical-car-27-71",
    "idler-train",
    "industrial-reducer",
    "industrial-reducer-assessment",
    "involute-18-36-tip-relief",
    "involute-23-47",
    "involute-23-47-frictionless",
    "involute-shifted-23-47",
    "irefc-as-published",
    "jia-involute-17-29",
    "jump-involute-23-47",
    "load-contact-misaligned",
    "load-contact-shafts",
    "planetary-thin-ring",
    "ravigneaux",
    "start-from-rest",
    "two-stage-reducer-hunting",
    "wind-turbine-gearbox",
    "wind-turbine-gearbox-assessment",
}


@pytest.mark.parametrize("name", all_in_soak(SEARCHES, QUICK_SEARCHES))
def test_a_search_runs(name: str, tmp_path: Path, forked: ForkedVerbs, request):
    with unless_passed(request, name):
        ended = forked(
            "run", name, *sets(*FEW, *REACHED.get(name, ())), "--json", "--no-plot", folder=tmp_path
        )
        assert ended.returncode == 0, ended.stderr
        result = json.loads(ended.stdout)
        assert (result["status"], result["evaluations"]) == ("complete", 3)
        assert load_scenario(tmp_path / f"{name}-best.toml").kind == load_scenario(name).base["kind"]


@pytest.mark.parametrize(
    ("name", "drawn"),
    all_in_soak(
        [
            (name, drawn)
            for name in names(shipped("scenarios"))
            if name not in SEARCHES
            for drawn in {name in DRAWN, name in PICTURES}
        ],
        lambda case: case[0] not in ALIKE and case[1] is (case[0] in PICTURES),
        names=2,
    ),
)
def test_it_runs(name: str, drawn: bool, tmp_path: Path, forked: ForkedVerbs, request):
    with unless_passed(request, name):
        run_shortened(name, drawn, tmp_path, forked)


def run_shortened(name: str, drawn: bool, tmp_path: Path, forked: ForkedVerbs) -> None:
    words = (name, *sets(*shorter(name, load_scenario(name).kind)), *(() if drawn else ("--no-plot",)))
    ended = forked("run", *words, "--json", folder=tmp_path)
    assert ended.returncode == 0, ended.stderr
    # no progress bar where nobody watches, and no warning but that of a drive outside its model
    said = ended.stderr.splitlines()
    assert len(said) == (name in OUTSIDE_THE_MODEL)
    assert all("warning: outside the model: Hertz pressure" in line for line in said)
    result = json.loads(ended.stdout)
    assert result["status"] == "complete"
    residuals = ("torque_residual", "energy_residual", "residual_max", "wear_balance")
    # an assessment has those of its parts
    balance = next((result["summary"][name] for name in residuals if name in result["summary"]), 0.0)
    assert abs(balance) < 1e-5  # 10 × rtol
    assert len(result["pictures"]) == drawn
    for picture in result["pictures"]:
        assert (tmp_path / picture).read_bytes().startswith(b"\x89PNG")
    with Record(tmp_path / result["record"]) as record:
        assert record.status == "complete"
        assert record.scenario["name"] == name
        loads = ("normal_load", "rms_displacement", "dynamic_factor", "line_load", "power_loss")
        assert np.nanmax(record[next(name for name in loads if name in record)]) > 0


def test_the_story_of_a_newcomer(tmp_path: Path, forked: ForkedVerbs):
    """What writes files in processes of their own, as a user calls it; the others are forked."""
    tribodyn("init", "mine", folder=tmp_path)
    checked = json.loads(forked("check", "mine.toml", "--json", folder=tmp_path).stdout)
    # (√(40.5² − 35.24²) + √(79.5² − 71.89²) − 114 sin 20°)/(3π cos 20°) of 25/51 teeth, module 3 mm
    assert checked["geometry"]["contact ratio"][0] == pytest.approx(1.6849, abs=5e-4)
    said = tribodyn("run", "mine.toml", "--set", "solver.cycles=2", folder=tmp_path)
    assert said.splitlines()[-2:] == ["record   mine.h5", "picture  mine-overview.png"]
    assert "Contact ratio" in forked("show", "mine.h5", folder=tmp_path).stdout
    drawn = json.loads(tribodyn("plot", "mine.h5", "film", "-o", "pictures", "--json", folder=tmp_path))
    assert [Path(picture).name for picture in drawn["pictures"]] == ["mine-film.png"]
    given = ("mine.h5", "film", "--format", "svg", "--cycles", "0", "--against", "time")
    assert forked("plot", *given, folder=tmp_path).returncode == 0
    assert (tmp_path / "mine-film.svg").is_file()
    shown = json.loads(forked("show", "mine.h5", "--json", folder=tmp_path).stdout)
    assert shown["scenario"]["operating"]["gear_torque"] == "550 N*m"


def test_a_records_scenario_runs_again_to_the_same_numbers(tmp_path: Path, forked: ForkedVerbs):
    short = ("--set", "solver.cycles=1", "--no-plot")
    assert forked("run", "crc-23-47-300", *short, "-o", "first.h5", folder=tmp_path).returncode == 0
    with Record(tmp_path / "first.h5") as record:
        (tmp_path / "again.toml").write_text(record.attrs["scenario"], encoding="utf-8")
        first = record["normal_load"]
        digest = record.attrs["scenario_sha256"]
    assert forked("run", "again.toml", "--no-plot", "-o", "again.h5", folder=tmp_path).returncode == 0
    with Record(tmp_path / "again.h5") as record:
        assert record.attrs["scenario_sha256"] == digest
        assert (record["normal_load"] == first).all()
