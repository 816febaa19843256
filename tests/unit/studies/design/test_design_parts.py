"""What a search's table means, and one clear error for every mistake in it."""

from typing import Any

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.studies.design.candidates.candidates import (
    cases_of,
    chosen,
    number_of,
    share_of,
    start_of,
    value_at,
)
from tribodyn.studies.design.scenario import free_of, loaded_search
from tribodyn.studies.protocol.load import load_scenario

RELIEF = "drive.pinion.modification.tip_relief"
FREE = {"key": RELIEF, "from": "0 um", "to": "40 um"}
SHIFT = {"key": "drive.pinion.profile_shift", "from": -0.2, "to": 0.4}
TEETH = {"key": "drive.pinion.teeth", "from": 17, "to": 20}
BASE = "load-contact-18-36"


def search(**design: Any) -> Any:
    design = {"free": [FREE], "minimise": "peak_to_peak", **design}
    return loaded_search(BASE, {key: value for key, value in design.items() if value is not None}, {}).case


@pytest.mark.parametrize(
    ("design", "key", "said"),
    [
        ({"free": []}, "design.free", "nothing is free"),
        ({"free": [{**FREE, "key": RELIEF + "f"}]}, "design.free.0.key", f'did you mean "{RELIEF}"'),
        ({"free": [{**FREE, "from": "50 um"}]}, "design.free.0", "reversed"),
        ({"free": [{**FREE, "from": "40 um"}]}, "design.free.0", "equal"),
        ({"free": [{**FREE, "to": 40}]}, "design.free.0.to", "without a unit"),
        ({"free": [{**FREE, "to": "40 N"}]}, "design.free.0.to", "length"),
        ({"free": [{"key": RELIEF, "from": "0 um"}]}, "design.free.0.to", "missing"),
        ({"free": [FREE, FREE]}, "design.free.1.key", "free twice"),
        ({"free": [{"key": RELIEF, "choices": ["1 um"]}]}, "design.free.0.choices", "nothing to choose"),
        ({"free": [{"key": "title", "choices": ["a", "b"]}]}, "design.free.0.key", "cannot be free"),
        ({"minimise": "peak_to_peek"}, "design.minimise", 'did you mean "peak_to_peak"'),
        ({"minimise": None}, "design.minimise", "missing"),
        ({"maximise": "contact_ratio"}, "design.minimise", "contradicts maximise"),
        ({"minimise": ["peak_to_peak"] * 2}, "design.minimise", "the same twice"),
        ({"minimise": [{"quantity": "loss", "weight": 0}]}, "design.minimise.0.weight", "not a weight"),
        ({"subject_to": ["contact_ratio"]}, "design.subject_to.0", "not QUANTITY <= LIMIT"),
        ({"subject_to": ["contact_ration > 1"]}, "design.subject_to.0", 'did you mean "contact_ratio"'),
        ({"subject_to": ["hertz_pressure_max <= 1.5"]}, "design.subject_to.0", "unit"),
        ({"subject_to": ["contact_ratio >= 1.5 mm"]}, "design.subject_to.0", "plain number"),
        (
            {"subject_to": ["contact_ratio >= 1.5", "contact_ratio <= 1.4"]},
            "design.subject_to",
            'contradict each other: "contact_ratio >= 1.5" and "contact_ratio <= 1.4"',
        ),
        ({"duty": [{"set": {RELIEF: "3 um"}}]}, "design.duty.0.set", "is free too"),
        (
            {"tolerance": [{"key": "mesh.nothing", "plus_minus": 1.0}]},
            "design.tolerance.0.key",
            "unknown key",
        ),
        ({"free": [{**SHIFT, "to": float("inf")}]}, "design.free.0.to", "not a finite number"),
        ({"free": [{**SHIFT, "from": [1]}]}, "design.free.0.from", "neither a number nor a quantity"),
        ({"free": [{**FREE, "form": "1 um"}]}, "design.free.0.form", 'did you mean "from"'),
        ({"free": [{**FREE, "choices": ["1 um", "2 um"]}]}, "design.free.0", "both choices and from or to"),
        ({"free": [{**TEETH, "from": 17.5}]}, "design.free.0", "not whole numbers"),
        ({"free": [{**TEETH, "key": "drive.family"}]}, "design.free.0.to", "not text"),
        ({"free": [{**TEETH, "key": "drive.pinion"}]}, "design.free.0.to", "not a table"),
        (
            {"free": [{**FREE, "key": [RELIEF, "drive.pinion.teeth"]}]},
            "design.free.0.to",
            "drive.pinion.teeth: not a whole number",
        ),
        (
            {"free": [{"key": "drive.pinion.teeth", "choices": [18, 19, 18]}]},
            "design.free.0.choices.2",
            "is there twice",
        ),
        (
            {"free": [{"key": RELIEF + "_shape", "choices": ["linear", "paraboic"]}]},
            "design.free.0.choices.1",
            'did you mean "parabolic"',
        ),
        ({"minimise": [{"quantity": "loss", "weight": float("nan")}]}, "design.minimise.0.weight", ""),
        ({"minimise": ["peak_to_peak", "contact_ratio", "film_min"]}, "design.minimise", "a front has two"),
        ({"subject_to": ["contact_ratio >= nan"]}, "design.subject_to.0", "not a finite limit"),
        ({"duty": [{"set": {"operating.torque": 1}}]}, "design.duty.0.set", "operating.gear_torque"),
        ({"duty": [{"set": {"operating.gear_torque": 100}}]}, "design.duty.0.set", "without a unit"),
        ({"confirm": {"output.position": 9}}, "design.confirm", "positions_per_cycle"),
        ({"tolerance": [{"key": "drive.family", "plus_minus": 1.0}]}, "design.tolerance.0.key", "not text"),
        ({"method": "cobyla"}, "design.method", 'did you mean "cobyqa"'),
        ({"evaluations": 1}, "design.evaluations", "at least 2"),
    ],
)
def test_a_mistake_is_one_clear_line(design: dict[str, Any], key: str, said: str):
    with pytest.raises(InputError) as error:
        search(**design)
    assert error.value.key == key
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_the_scenario_that_is_searched_through_is_read_as_such():
    with pytest.raises(InputError, match=r"scenario\.operating\.gear_torque = 300") as error:
        loaded_search(BASE, {"free": [FREE], "minimise": "peak_to_peak"}, {"operating.gear_torque": 300})
    assert "unit" in str(error.value)
    with pytest.raises(InputError, match="a search through a search"):
        loaded_search(
            {"title": "x", "kind": "design", "scenario": "design-tip-relief-18-36"},
            {"free": [FREE], "minimise": "objective"},
            {},
        )


def test_a_resolved_search_loads_again_to_itself(tmp_path):
    case = search(duty=[{"set": {"operating.gear_torque": "200 N*m"}}])
    (tmp_path / "again.toml").write_text(case.toml, encoding="utf-8")
    assert load_scenario(tmp_path / "again.toml").sha256 == case.sha256


def test_values_are_written_in_their_unit_and_read_back():
    (free,) = search().free
    assert (free.name, free.units) == ("pinion_tip_relief", "m")
    assert value_at(free, 0.0) == "0.0 um"
    assert value_at(free, 1.0) == "40.0 um"
    for share in (0.1, 1 / 3, 0.77777777):
        written = value_at(free, share)
        assert number_of(free, written) == pytest.approx(share * 40e-6, rel=1e-6)
        assert value_at(free, share_of(free, written)) == written  # what is evaluated is what is written


def test_whole_numbers_and_choices():
    teeth = {"key": "drive.pinion.teeth", "from": 17, "to": 20}
    shape = {"key": "drive.pinion.modification.tip_relief_shape", "choices": ["linear", "parabolic"]}
    whole, words = search(free=[teeth, shape]).free
    assert [value_at(whole, share) for share in (0.0, 1 / 3, 1.0)] == [17, 18, 20]
    assert [value_at(words, share) for share in (0.2, 0.8)] == ["linear", "parabolic"]
    assert number_of(words, "parabolic") == 1.0


def test_it_starts_where_the_scenario_stands():
    length = {"key": RELIEF + "_length", "from": "1 mm", "to": "5 mm"}
    module = {"key": "drive.module", "from": "2 mm", "to": "6 mm"}
    np.testing.assert_allclose(start_of(search(free=[FREE, length, module])), [0.0, 0.5, 0.25])


def test_duties_and_samples_make_the_cases():
    tolerance = {"key": "mesh.misalignment.in_plane", "plus_minus": "1 arcmin", "distribution": "ends"}
    duties = [{"set": {"operating": {"gear_torque": f"{torque} N*m"}}} for torque in (100, 200)]
    case = search(duty=duties, tolerance=[tolerance], robust={"samples": 4})
    cases = cases_of(case, chosen(case, [0.5]))
    assert [overrides["operating.gear_torque"] for overrides in cases] == ["100 N*m"] * 4 + ["200 N*m"] * 4
    angles = [overrides["mesh.misalignment.in_plane"] for overrides in cases[:4]]
    assert sorted(angles) == ["-1.0 arcmin"] * 2 + ["1.0 arcmin"] * 2  # as many at either end
    assert angles == [overrides["mesh.misalignment.in_plane"] for overrides in cases[4:]]
    assert cases == cases_of(case, chosen(case, [0.5]))  # for every candidate the same


@pytest.mark.parametrize(
    ("option", "entry"),
    [
        ("a.b=0 um:40 um", {"key": "a.b", "from": "0 um", "to": "40 um"}),
        ("a.b=0:40um", {"key": "a.b", "from": "0 um", "to": "40um"}),
        ("a.b=-0.2:0.4", {"key": "a.b", "from": -0.2, "to": 0.4}),
        ("a.b=17:25", {"key": "a.b", "from": 17, "to": 25}),
        ("a.b=linear,parabolic", {"key": "a.b", "choices": ["linear", "parabolic"]}),
        ("a.b+a.c=1:2", {"key": ["a.b", "a.c"], "from": 1, "to": 2}),
    ],
)
def test_the_short_form_of_free(option: str, entry: dict[str, Any]):
    assert free_of(option) == entry


@pytest.mark.parametrize("option", ["a.b", "a.b=", "=1:2", "a.b=1", "a.b=1:", "a.b=x:y"])
def test_what_is_no_free_key(option: str):
    with pytest.raises(InputError, match="neither KEY=FROM:TO nor"):
        free_of(option)
