"""Parameters of tests of which `make test` takes some and `make soak` all."""

from collections.abc import Callable, Collection, Iterable
from typing import Any

import pytest


def all_in_soak(
    parameters: Iterable[Any], kept: Callable[[Any], bool] | Collection[Any], names: int = 1
) -> list[Any]:
    """All parameters of a test; those that are not kept are marked soak. Of several names they are tuples."""
    keeps = kept if callable(kept) else kept.__contains__
    return [
        pytest.param(*((one,) if names == 1 else one), marks=() if keeps(one) else pytest.mark.soak)
        for one in parameters
    ]
