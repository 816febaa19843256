"""Whatever stands at whatever key, a scenario is read or refused with an `InputError` that names it."""

from datetime import date
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from tools.by_schema.keys import patterns
from tribodyn.errors import InputError, InputErrors
from tribodyn.studies.motion.pair.scenario import Scenario
from tribodyn.studies.protocol.load import load_scenario

KEYS = [*map(".".join, patterns(Scenario)), "nonsense", "mesh.nonsense.more"]
QUANTITY = r"-?[0-9]{1,3}(\.[0-9])? ?(mm|N\*m|rad/s|deg|kg|Pa|1/K|%|m\*\*[0-9]|/)"
SCALARS = st.one_of(
    st.text(st.characters(codec="utf-8"), max_size=8),
    st.integers(),
    st.floats(),
    st.booleans(),
    st.just(date(2022, 4, 1)),
    st.from_regex(QUANTITY, fullmatch=True),
    st.sampled_from(["..", "/", "../../etc", "a.toml", "\0", "a.csv", "none", "coulomb", "torque", "energy"]),
)
NAMES = st.one_of(st.sampled_from(sorted({key.rpartition(".")[2] for key in KEYS})), st.text(max_size=4))
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(NAMES, inner, max_size=3)),
    max_leaves=5,
)


@settings(max_examples=150, deadline=None)
@given(st.dictionaries(st.sampled_from(KEYS), VALUES, min_size=1, max_size=3))
def test_no_value_at_any_key_escapes(overrides: dict[str, Any]):
    for refused in refusals(overrides):
        assert refused.key
        assert refused.rule
        assert refused.file
        assert len(str(refused).splitlines()) == 1


def refusals(overrides: dict[str, Any]) -> tuple[InputError, ...]:
    try:
        load_scenario("crc-23-47", overrides)
    except InputErrors as error:
        return error.errors
    except InputError as error:
        return (error,)
    return ()
