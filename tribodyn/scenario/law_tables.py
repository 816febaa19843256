"""Which friction law a scenario names, and the keys that belong to it."""

from collections.abc import Iterator
from typing import Any

from tribodyn.errors import InputError
from tribodyn.tribology.laws import friction_law


def law_errors(scenario: Any) -> Iterator[InputError]:
    """Go through what is wrong with the laws of a scenario that has a table ``friction``."""
    friction = scenario.friction
    try:
        law = friction_law(friction.law)
    except InputError as error:
        yield error
        return
    if law.coefficient == (friction.coefficient is not None):
        return
    key = "friction.coefficient"
    if law.coefficient:
        rule = f'missing: law = "{friction.law}" needs it'
        yield InputError(key, rule=rule, remedy="add coefficient = 0.05")
        return
    rule = f'contradicts law = "{friction.law}", which needs none'
    yield InputError(key, friction.coefficient, rule, "leave coefficient out")
