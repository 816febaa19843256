"""Comparison with published numbers, from Python."""

from collections.abc import Callable
from pathlib import Path

from tribodyn import validation
from tribodyn.interface.words import in_python
from tribodyn.validation.rows import Row


@in_python()
def validate(
    paper: str, progress: Callable[[float], None] | None = None, folder: str | Path | None = None
) -> list[Row]:
    """Compare with the numbers of a paper: run what its rows need.

    Parameters
    ----------
    paper : str
        "liu-ni-2022", "diez-ibarbia", "veciana-2024", "efremenkov-2024" or "jia-2022".
    progress : callable, optional
        Called with the share done, 0 … 1.
    folder : path, optional
        Where to keep the records of the runs; a temporary folder if not given.

    Returns
    -------
    list of Row
        With `quantity`, `published` and `computed` value, `tolerance`, `verdict` and `note`; the verdict is
        "pass", "fail" or "reported".

    Raises
    ------
    InputError
        For an unknown paper.
    SimulationError
        If one of the runs fails.
    """
    return validation.validate(paper, progress, folder)
