"""Comparison with the numbers and claims of the papers, from records where it takes a run."""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from tribodyn.errors import InputError, unknown_name
from tribodyn.validation.rows import Row

#: Paper's name on the command line -> module that computes its rows.
PAPERS = {
    "liu-ni-2022": "tribodyn.validation.liu_ni",
    "efremenkov-2024": "tribodyn.validation.efremenkov",
    "veciana-2024": "tribodyn.validation.veciana",
    "diez-ibarbia": "tribodyn.validation.diez_ibarbia",
    "jia-2022": "tribodyn.validation.jia",
}
#: Paper's name -> who, where, and what is compared.
ABOUT = {
    "liu-ni-2022": "Liu & Ni, Mechanics & Industry 23:10 (2022): CRC drive and involute",
    "efremenkov-2024": "Efremenkov et al., Mathematics 12:873 (2024): gear with rolling elements",
    "veciana-2024": "Veciana et al., Machines 12:943 (2024): efficiency of cycloidal gears",
    "diez-ibarbia": "Diez-Ibarbia et al.: efficiency of spur gears over the profile shift",
    "jia-2022": "Jia et al., Mathematics 10:4290 (2022): gears with a parabolic path of contact",
}
#: Paper's name -> the choices under which its rows are computed, the head of its table.
CHOICES = {
    "liu-ni-2022": "as published, with kinematic sliding; beside it the default, dynamic sliding",
    "efremenkov-2024": "as published: the paper's own equations with their errors; beside it corrected "
    "speeds, with which the gear loses nearly all its power",
    "veciana-2024": "with the mixed law as printed (reading A) and the paper's rolling speeds; beside it "
    "reading B",
    "diez-ibarbia": "with load contact by finite elements; rows without a published number stand beside "
    "another implementation of the equations",
    "jia-2022": "with maximum line loads for contact stresses, misalignment in the plane of action, limits "
    "with the paper's sin(beta); beside it Hertz pressures and the actual tips",
}
#: Paper's name -> module that draws its figures.
FIGURES = {
    "liu-ni-2022": "tribodyn.validation.liu_ni_figures",
    "veciana-2024": "tribodyn.validation.veciana_figures",
    "diez-ibarbia": "tribodyn.validation.diez_ibarbia_figures",
    "jia-2022": "tribodyn.validation.jia_figures",
}


def validate(
    paper: str, progress: Callable[[float], None] | None = None, folder: str | Path | None = None
) -> list[Row]:
    """Run what a paper's rows need and compare.

    Parameters
    ----------
    paper : one of `PAPERS`
    progress : optional; called with the share done, 0 … 1
    folder : optional; where to keep the records of the runs; a temporary folder if not given

    Returns
    -------
    list of Row
        Published and computed value, tolerance, verdict ("pass", "fail", "direction", "reported"), the same
        under another choice where there is one, and a note.

    Raises
    ------
    InputError
        For an unknown paper.
    SimulationError
        If one of the runs fails.
    """
    _check(paper)
    module = import_module(PAPERS[paper])
    if folder is not None:
        return module.rows(Path(folder), progress)
    from tempfile import TemporaryDirectory

    with TemporaryDirectory(prefix="tribodyn-") as temporary:
        return module.rows(Path(temporary), progress)


def figure_names(paper: str) -> list[str]:
    """Names of the figures of a paper that are drawn from our own numbers.

    Raises InputError for an unknown paper, and one without figures.
    """
    _check(paper)
    if paper not in FIGURES:
        raise InputError(
            "plots",
            f"figures of {paper}",
            "none of them is drawn here",
            f"keep its records with --output and draw these with tribodyn plot, or take one of: "
            f"{', '.join(FIGURES)}",
        )
    return list(import_module(FIGURES[paper]).FIGURES)


def draw(
    paper: str,
    plots: Path,
    records: Path,
    progress: Callable[[float], None] | None = None,
    *,
    force: bool = False,
) -> list[Path]:
    """Draw figures like a paper's from our own numbers.

    Raises InputError as `figure_names` and `write_output`.

    Parameters
    ----------
    paper : one of `FIGURES`
    plots : folder of the pictures, which is there: ``diez-ibarbia-figure-06.png``
    records : folder in which `validate` left the paper's records
    progress : optional; called with the share done, 0 … 1
    force : replace also pictures that are not ours
    """
    from tribodyn.post.style import house_style, save

    names = figure_names(paper)
    module = import_module(FIGURES[paper])
    pictures = []
    for done, name in enumerate(names, start=1):
        with house_style():
            figure = module.FIGURES[name](records)
        pictures.append(save(figure, picture_path(paper, name, plots), force=force))
        if progress:
            progress(done / len(names))
    return pictures


def picture_path(paper: str, name: str, plots: Path) -> Path:
    """Where `draw` writes a figure."""
    return plots / f"{paper}-{name}.png"


def _check(paper: str) -> None:
    if paper not in PAPERS:
        raise unknown_name("paper", paper, PAPERS, "paper")
