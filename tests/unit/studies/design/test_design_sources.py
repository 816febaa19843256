"""Searches over several scenarios: figures of studies of different kinds, of the same gears."""

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

import tribodyn as td
from tribodyn.errors import InputError
from tribodyn.input.resolve import resolve
from tribodyn.input.sources import find_scenario
from tribodyn.record.reader import Record
from tribodyn.studies.design.candidates.candidates import cases_of, chosen
from tribodyn.studies.design.candidates.evaluation import evaluate
from tribodyn.studies.design.candidates.sources import BASE as BASE_NAME
from tribodyn.studies.design.candidates.sources import refused, require_key, sources_of
from tribodyn.studies.design.figures import before_and_after
from tribodyn.studies.design.scenario import loaded_search, parts_of
from tribodyn.studies.protocol.load import table_of

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


def leaves(data: Any, above: tuple[str, ...] = ()) -> list[str]:
    """Dotted keys of everything that is no table and no list of tables."""
    if isinstance(data, dict):
        return [key for name, value in data.items() for key in leaves(value, (*above, name))]
    if isinstance(data, list) and data and isinstance(data[0], dict):
        return [key for place, value in enumerate(data) for key in leaves(value, (*above, str(place)))]
    return [".".join(above)]


@pytest.mark.parametrize(
    "name",
    ["two-stage-reducer", "wind-turbine-gearbox", "sensors-18-36", "assessment-helical-24-95", "irefc"],
)
def test_every_key_of_a_scenario_can_be_named(name: str):
    """Gears by name, stages by place, bearings of a train: what stands in a file is a key of it."""
    data = resolve(find_scenario(name), {}, table_of).data
    sources = sources_of({BASE_NAME: data})
    keys = leaves(data)
    assert len(keys) > 10
    assert [require_key("design.free.0.key", key, sources)[1] for key in keys] == keys


@pytest.mark.parametrize(
    ("key", "meant"),
    [
        ("gear.pinion-1.profil_shift", "gear.pinion-1.profile_shift"),
        ("stage.0.modul", "stage.0.module"),
        ("gear.pinion-1.modification.tip_releif", "gear.pinion-1.modification.tip_relief"),
    ],
)
def test_a_misspelled_key_of_a_train(key: str, meant: str):
    sources = sources_of({BASE_NAME: resolve(find_scenario("two-stage-reducer"), {}, table_of).data})
    with pytest.raises(InputError, match=re.escape(f'did you mean "{meant}"?')):
        require_key("design.free.0.key", key, sources)


def test_a_value_that_a_key_of_a_train_does_not_take():
    sources = sources_of({BASE_NAME: resolve(find_scenario("two-stage-reducer"), {}, table_of).data})
    (source,) = sources.values()
    assert refused("here", "gear.pinion-1.profile_shift", 0.3, source) is None
    error = refused("here", "stage.0.module", "3 N", source)
    assert error is not None
    assert '"N" is not a unit of length' in error.rule
