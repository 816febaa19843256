"""Searches over several scenarios: figures of studies of different kinds, of the same gears."""

import tomllib
from pathlib import Path
from typing import Any

import pytest

import tribodyn as td
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies.design.candidates.candidates import cases_of, chosen
from tribodyn.studies.design.candidates.evaluation import evaluate
from tribodyn.studies.design.page import before_and_after
from tribodyn.studies.design.short_form import loaded_search, parts_of

RELIEF = "drive.pinion.modification.tip_relief"
FREE = [{"key": RELIEF, "from": "0 um", "to": "20 um"}]
BASE = "load-contact-18-36"
SHORT: dict[str, Any] = {"output.positions_per_cycle": 12, f"{RELIEF}_length": "5 mm"}
PARTS = {
    "efficiency": {
        "like": "efficiency-involute-18-36",
        "mesh": {"compliance": "fem"},
        "output": {"samples_per_cycle": 20},
    }
}


def search(**design: Any) -> Any:
    given = {"free": FREE, "minimise": ["peak_to_peak", "efficiency.loss"], "part": PARTS, **design}
    return loaded_search(BASE, given, SHORT).case


def test_figures_of_every_scenario_are_those_of_its_own_run(tmp_path: Path):
    found = td.design(
        BASE,
        FREE,
        [{"quantity": "peak_to_peak", "weight": 0.8}, {"quantity": "efficiency.loss", "weight": 0.2}],
        ["efficiency.contact_ratio >= 1.2"],
        overrides=SHORT,
        output=tmp_path / "a.h5",
        part=PARTS,
        evaluations=4,
        sensitivities=False,
    )
    assert found.status == "complete"
    start, best = (found.summary[f"quantities_{end}"] for end in ("start", "best"))
    contact = td.run(str(tmp_path / "a-best.toml")).summary
    name = "loaded_transmission_error_peak_to_peak"
    assert contact[name] == pytest.approx(best[name], rel=1e-9)
    oiled = td.run(str(tmp_path / "a-best-efficiency.toml")).summary
    assert oiled["power_friction_mean"] == pytest.approx(best["efficiency.power_friction_mean"], rel=1e-9)
    # the drive of the part is that of the scenario, with what the search found
    written = tomllib.loads((tmp_path / "a-best-efficiency.toml").read_text(encoding="utf-8"))
    assert written["drive"]["pinion"]["modification"]["tip_relief"] == found.best[RELIEF]
    assert written["drive"]["pinion"]["modification"]["tip_relief_length"] == "5 mm"
    terms = (best[name] / start[name], best["efficiency.power_friction_mean"])
    loss = terms[1] / start["efficiency.power_friction_mean"]
    assert found.objective == pytest.approx(0.8 * terms[0] + 0.2 * loss, rel=1e-9)
    assert found.objective < found.objective_start == pytest.approx(1.0)
    with Record(tmp_path / "a.h5") as record:
        _, shown = before_and_after(record)
    change = next(
        float(row[-1].removesuffix(" %")) for row in shown.rows if row[0].endswith("error, peak to peak")
    )
    assert change == pytest.approx(100.0 * (terms[0] - 1.0), abs=0.06)


def test_two_objectives_of_two_kinds():
    first, second = search().objectives
    assert first.name == "loaded_transmission_error_peak_to_peak"
    assert second.name == "efficiency.power_friction_mean"


def test_a_part_takes_the_keys_that_it_has():
    """Misalignment is none of the efficiency's; the speed of a duty is that of the part alone."""
    tolerance = {"key": "mesh.misalignment.in_plane", "plus_minus": "1 arcmin", "distribution": "ends"}
    duties = [{"set": {"efficiency.operating.pinion_speed": f"{speed} rpm"}} for speed in (500, 1000)]
    case = search(tolerance=[tolerance], robust={"samples": 2}, duty=duties)
    found = evaluate(case.scenarios, cases_of(case, chosen(case, [0.5])))
    assert not any(isinstance(quantities, str) for quantities in found)
    rows: list[Any] = list(found)
    contact, loss = "face_load_factor", "efficiency.power_friction_mean"
    assert rows[0][loss] < rows[2][loss]
    assert rows[1][loss] == pytest.approx(rows[0][loss], rel=1e-12)
    assert rows[3][loss] == pytest.approx(rows[2][loss], rel=1e-12)
    assert rows[0][contact] > 1.0
    assert rows[0][contact] == pytest.approx(rows[2][contact], rel=1e-12)


@pytest.mark.parametrize(
    ("design", "key", "said"),
    [
        ({"minimise": "eficiency.loss"}, "design.minimise", 'there is no part "eficiency"'),
        ({"minimise": "efficiency.los"}, "design.minimise", 'did you mean "loss"'),
        ({"part": {**PARTS, "mesh": PARTS["efficiency"]}}, "design.part", "has a table [mesh]"),
        ({"part": {"a b": "efficiency-involute-18-36"}}, "design.part", "not a name for a part"),
        ({"part": {"efficiency": "efficiency-involute-18"}}, "design.part.efficiency", "efficiency-involute"),
        ({"part": {"other": "design-shift-23-47"}}, "design.part.other.kind", "a search through a search"),
        ({"duty": [{"set": {"efficiency.operating.pinion_sped": 1}}]}, "design.duty.0.set", "pinion_speed"),
        ({"subject_to": ["efficiency.film_min >= 1 K"]}, "design.subject_to.0", "write the limit in m"),
    ],
)
def test_a_mistake_about_a_part_is_one_clear_line(design: dict[str, Any], key: str, said: str):
    with pytest.raises(InputError) as error:
        search(**design)
    assert error.value.key == key
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_parts_of_the_command_line():
    assert parts_of(["oil=a.toml", "b = c"]) == {"oil": "a.toml", "b": "c"}
    for wrong in (["oil"], ["=a"], ["oil="], ["a=b", "a=c"]):
        with pytest.raises(InputError):
            parts_of(wrong)
