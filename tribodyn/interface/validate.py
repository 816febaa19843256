"""Comparison with what papers published, as an xarray dataset."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from tribodyn.validation import validate as compared

if TYPE_CHECKING:
    from tribodyn.validation.rows import Row


def validate(
    paper: str, *, folder: str | Path | None = None, progress: Callable[[float], None] | None = None
) -> "list[Row]":
    """Compare with the numbers and claims of a paper.

    Parameters
    ----------
    paper : str
        As ``tribodyn validate`` lists them: "liu-ni-2022".
    folder : path, optional
        Where to keep the records of the runs; default: nowhere.
    progress : callable, optional
        Called with the share done, 0 … 1.

    Returns
    -------
    list of Row
        Published and computed value, tolerance, verdict ("pass", "fail", "reported") and a note.

    Raises
    ------
    InputError
        For an unknown paper.
    SimulationError
        If a run fails.
    """
    return compared(paper, progress, None if folder is None else Path(folder))
