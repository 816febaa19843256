"""Comparison with the numbers and claims of the papers, from records where it takes a run."""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from tribodyn.errors import InputError
from tribodyn.validation.rows import Row

#: Paper's name on the command line -> module that computes its rows.
PAPERS = {
    "liu-ni-2022": "tribodyn.validation.liu_ni",
    "efremenkov-2024": "tribodyn.validation.efremenkov",
    "veciana-2024": "tribodyn.validation.veciana",
    "diez-ibarbia": "tribodyn.validation.diez_ibarbia",
    "jia-2022": "tribodyn.validation.jia",
}


def validate(
    paper: str, progress: Callable[[float], None] | None = None, folder: Path | None = None
) -> list[Row]:
    """Run what a paper's rows need and compare.

    Parameters
    ----------
    paper : str
        One of `PAPERS`.
    progress : callable, optional
        Called with the share done, 0 … 1.
    folder : Path, optional
        Where to keep the records of the runs; a temporary folder if not given.

    Raises
    ------
    InputError
        For an unknown paper.
    SimulationError
        If one of the runs fails.
    """
    if paper not in PAPERS:
        raise InputError("paper", paper, "no such paper", f"one of: {', '.join(PAPERS)}")
    module = import_module(PAPERS[paper])
    if folder is not None:
        return module.rows(Path(folder), progress)
    from tempfile import TemporaryDirectory

    with TemporaryDirectory(prefix="tribodyn-") as temporary:
        return module.rows(Path(temporary), progress)
