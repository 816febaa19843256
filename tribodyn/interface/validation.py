"""Comparison with published numbers, from Python."""

from pathlib import Path

from tribodyn import validation
from tribodyn.interface.scenario import public
from tribodyn.post.progress import Report, progress_of
from tribodyn.validation.rows import SHOWN, Row, counted


class PaperComparison(list[Row]):
    """Rows of a comparison with a paper; a notebook shows them as a table.

    Attributes
    ----------
    choices : str
        The choices under which the rows are computed.
    """

    choices: str = ""

    def _repr_html_(self) -> str:
        from tribodyn.interface import shown
        from tribodyn.studies.protocol.study import TextTable

        rows = [[row.written(name) for name in SHOWN] for row in self]
        return shown.block(shown.tables([TextTable(f"{self.choices}. {counted(self)}", SHOWN, rows)]))


@public
def validate(
    paper: str, progress: Report | bool | None = None, folder: str | Path | None = None
) -> PaperComparison:
    """Compare with the numbers of a paper: run what its rows need.

    Parameters
    ----------
    paper : str
        "liu-ni-2022", "diez-ibarbia", "veciana-2024", "efremenkov-2024" or "jia-2022"; of listings
        "helical-report-2017", "stplus-fzg-c", "fzg-gears-gearpie", "planetary-losses-2017",
        "iso-tr-6336-30" or "iso-6336-6-annex-c".
    progress : callable or bool, optional
        As of `run`.
    folder : path, optional
        Where to keep the records of the runs; a temporary folder if not given.

    Returns
    -------
    list of Row
        Shown as a table in a notebook; each with `quantity`, `published` and `computed` value, `tolerance`,
        `verdict`, `otherwise` (the same under other choices) and `note`; the verdict is "pass",
        "fail", "direction" (no more than the direction is compared) or "reported".

    Raises
    ------
    InputError
        For an unknown paper.
    SimulationError
        If one of the runs fails.
    """
    with progress_of(progress, f"validate {paper}") as report:
        compared = PaperComparison(validation.validate(paper, report, folder))
    compared.choices = validation.PAPERS[paper].choices
    return compared
