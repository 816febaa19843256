"""Laws as objects: parameters, ranges, a law handed over from Python, and how kernels tell laws apart."""

import importlib.util

import numpy as np
import pytest

from tests.support.closures import LIU_NI, POINT, known, under
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tests.support.states import PAIR
from tribodyn.dynamics.parameters import frictionless
from tribodyn.errors import InputError
from tribodyn.kernels.native import kernel
from tribodyn.kernels.native.arguments import packed
from tribodyn.numerics.elementary import absolute, law
from tribodyn.numerics.parameter import Parameter
from tribodyn.record.reader import Record
from tribodyn.solve.right_hand_side import rhs, work_array
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run as run_study
from tribodyn.tribology.closure import closure, laws_of
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import FilmData, FrictionLaw


@law
def _stribeck(contact, film, surfaces, parameters):
    """Friction that falls with the sliding speed."""
    return parameters.static / (1.0 + absolute(contact.sliding) / parameters.speed)


STRIBECK = FrictionLaw(
    "stribeck",
    "friction that falls with the sliding speed",
    _stribeck,
    keys=(
        Parameter("static", "number", "coefficient at rest", allowed="positive"),
        Parameter("speed", "velocity", "sliding speed that halves it", default=0.5, source="this test"),
    ),
)


def test_a_law_has_the_values_of_its_keys_as_parameters():
    laws = closure(LIU_NI, FILM_LAWS["moes"], STRIBECK, {}, {"static": 0.2})
    state = known(laws, **{**POINT, "sliding": -0.5})
    assert state.friction_coefficient == pytest.approx(0.1)
    slower = closure(LIU_NI, FILM_LAWS["moes"], STRIBECK.with_values(static=0.2, speed=1.5))
    assert known(slower, **{**POINT, "sliding": -0.5}).friction_coefficient == pytest.approx(0.15)
    with pytest.raises(
        InputError, match=r'friction\.sped = 1\.0: no key of law "stribeck"; did you mean "speed"'
    ):
        closure(LIU_NI, FILM_LAWS["moes"], STRIBECK, {}, {"static": 0.2, "sped": 1.0})


def test_film_and_friction_are_chosen_separately():
    case = load_scenario("crc-23-47", {"friction.law": "masjedi-khonsari-as-printed"})
    assert [chosen.name for chosen in laws_of(case.pair)] == ["masjedi-khonsari-as-printed"] * 2
    case = load_scenario("crc-23-47", {"friction.law": "xu"})
    assert [chosen.name for chosen in laws_of(case.pair)] == ["masjedi-khonsari", "xu"]
    case = load_scenario("crc-23-47", {"friction.law": "xu", "film.law": "moes"})
    assert [chosen.name for chosen in laws_of(case.pair)] == ["moes", "xu"]
    assert case.film == FilmData("moes", {})


def test_a_law_handed_over_runs_in_every_compiler(rng):
    case = load_scenario("crc-23-47").under_laws(friction=STRIBECK.with_values(static=0.11))
    assert_right_hand_sides_agree(at_several_conditions(prepare(case).model), rng, 1e-12)


def test_a_run_flags_the_range_of_its_friction_law(tmp_path):
    overrides = {"friction.law": "xu", "operating.gear_torque": "100 N*m"}
    result = run_study(load_scenario("efficiency-crc-23-47", overrides), tmp_path / "run.h5")
    with Record(result.path) as record:
        touching = record["normal_load"] > 0
        pressure = record["hertz_pressure"][touching]
        ratio = np.abs(record["sliding_speed"] / record["entrainment_speed"])[touching]
        inside = (pressure >= 0.5e9) & (pressure <= 2.5e9) & (ratio <= 1.0)
        np.testing.assert_array_equal(record["friction_in_range"][touching], inside)
        assert 0.2 < record.summary["friction_in_range_fraction"] < 0.5
        assert record.summary["friction_in_range_fraction"] == pytest.approx(np.mean(inside))


def test_variants_share_their_machine_code():
    """They differ in numbers alone, which no kernel has compiled in."""
    plain, other = under("masjedi-khonsari"), under("masjedi-khonsari-mean-pressure")
    assert packed(plain).layout == packed(other).layout
    assert packed(plain).words != packed(other).words


def test_without_friction_a_model_has_none(prepared):
    model = frictionless(prepared("crc-23-47").model)
    assert model.options.friction == FRICTION_LAWS["none"].functions
    assert known(model.closure(0), **POINT).friction_coefficient == 0.0


@kernel
def _apply(function, x):
    return function(x)


def _twice(x):
    return 2.0 * x


def _closed(factor):
    def times(x):
        return factor * x

    return times


def test_kernels_take_functions_and_tell_them_apart():
    assert _apply(_twice, 1.5) == 3.0
    # of one name and source, but of another number
    assert [_apply(_closed(factor), 1.5) for factor in (3.0, 5.0)] == [4.5, 7.5]


def _module(tmp_path, name, text):
    file = tmp_path / f"{name}.py"
    file.write_text(text, encoding="utf-8")
    spec = importlib.util.spec_from_file_location("outside_law", file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_changed_source_or_number_is_another_function(tmp_path):
    helper = 'def helper(x):\n    """{}"""\n    return FACTOR * x\n'
    text = "FACTOR = {}\n" + helper + "def function(x):\n    return helper(x){}\n"
    texts = [("2.0", "", ""), ("3.0", "", ""), ("2.0", "", " + 1.0"), ("2.0", "Other words.", "  # same")]
    made = [_module(tmp_path, f"module{i}", text.format(*values)).function for i, values in enumerate(texts)]
    identities = [packed(function).layout.identity for function in made]
    assert len(set(identities)) == 3
    assert identities[0] == identities[3]


def _unmarked(x):
    return 0.1 * x


def _calls_unmarked(x):
    return _unmarked(x)


def test_a_function_that_cannot_be_compiled_says_why():
    with pytest.raises(InputError, match=r"law = _calls_unmarked.*_unmarked.*marked with its `law`"):
        _apply(_calls_unmarked, 1.5)


def _unfinished(contact, film, surfaces, parameters):
    """Fine in Python, so that the trial of the law passes; but no kernel knows `_asdict`."""
    return 0.1 + 0.0 * contact._asdict()["sliding"]


def test_a_law_that_cannot_be_compiled_says_why():
    case = load_scenario("crc-23-47").under_laws(friction=FrictionLaw("unfinished", "", _unfinished))
    model = prepare(case).model
    with pytest.raises(InputError, match=r"law = _unfinished.*_asdict.*marked with its `law`"):
        rhs(0.3, 0.0, 0, np.zeros(PAIR.states), model, work_array(model), np.empty(PAIR.states))
