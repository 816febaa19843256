"""What every key of a scenario means, from keys.toml."""

import tomllib
from functools import cache
from importlib import resources


def meaning(table: type, key: str) -> str:
    """The meaning of a key of a table, or of a table from which it is made; "" where it is not known."""
    known = meanings()
    return next(
        (known[each.__name__][key] for each in table.__mro__ if key in known.get(each.__name__, {})), ""
    )


@cache
def meanings() -> dict[str, dict[str, str]]:
    """All meanings, by table and key."""
    return tomllib.loads(resources.files(__package__ or "").joinpath("keys.toml").read_text(encoding="utf-8"))
