"""Comparison with the numbers and claims of the papers, from records where it takes a run."""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from tribodyn.errors import InputError, unknown_name
from tribodyn.validation.rows import Row


class Paper(NamedTuple):
    """Where the numbers of a paper are compared."""

    module: str  # that computes its rows
    about: str  # who, where, and what is compared
    choices: str  # under which its rows are computed, the head of its table
    figures: str | None = None  # module that draws its figures


#: By the name on the command line.
PAPERS = {
    "liu-ni-2022": Paper(
        "tribodyn.validation.liu_ni",
        "Liu & Ni, Mechanics & Industry 23:10 (2022): CRC drive and involute",
        "as published, with kinematic sliding; beside it the default, dynamic sliding",
        "tribodyn.validation.liu_ni_figures",
    ),
    "efremenkov-2024": Paper(
        "tribodyn.validation.efremenkov",
        "Efremenkov et al., Mathematics 12:873 (2024): gear with rolling elements",
        "as published: the paper's own equations with their errors; beside it corrected speeds, with which "
        "the gear loses nearly all its power",
    ),
    "veciana-2024": Paper(
        "tribodyn.validation.veciana",
        "Veciana et al., Machines 12:943 (2024): efficiency of cycloidal gears",
        "with the mixed law as printed (reading A) and the paper's rolling speeds; beside it reading B",
        "tribodyn.validation.veciana_figures",
    ),
    "diez-ibarbia": Paper(
        "tribodyn.validation.diez_ibarbia",
        "Diez-Ibarbia et al.: efficiency of spur gears over the profile shift",
        "with load contact by finite elements; rows without a published number stand beside another "
        "implementation of the equations",
        "tribodyn.validation.diez_ibarbia_figures",
    ),
    "jia-2022": Paper(
        "tribodyn.validation.jia",
        "Jia et al., Mathematics 10:4290 (2022): gears with a parabolic path of contact",
        "with maximum line loads for contact stresses, misalignment in the plane of action, limits with the "
        "paper's sin(beta); beside it Hertz pressures and the actual tips",
        "tribodyn.validation.jia_figures",
    ),
    "helical-report-2017": Paper(
        "tribodyn.validation.helical_report",
        "Design report of a helical stage (KISSsoft 2017): ISO 6336 and ISO/TS 6336-22 factor by factor",
        "with the load factors as printed",
    ),
}


def validate(
    paper: str, progress: Callable[[float], None] | None = None, folder: str | Path | None = None
) -> list[Row]:
    """Run what a paper's rows need and compare; `progress` is called with the share done, 0 … 1.

    The records of the runs are kept in `folder`, in a temporary one if none is given. Raises InputError for
    an unknown paper, SimulationError if one of the runs fails.
    """
    _check(paper)
    module = import_module(PAPERS[paper].module)
    if folder is not None:
        return module.rows(Path(folder), progress)
    from tempfile import TemporaryDirectory

    with TemporaryDirectory(prefix="tribodyn-") as temporary:
        return module.rows(Path(temporary), progress)


def figure_names(paper: str) -> list[str]:
    """Names of the figures of a paper that are drawn from our own numbers.

    Raises InputError for an unknown paper, and one without figures.
    """
    return list(_figures(paper))


def _figures(paper: str) -> dict[str, Callable[[Path], Any]]:
    """Name of every figure -> what draws it, given the folder with the records of the paper's runs."""
    _check(paper)
    module = PAPERS[paper].figures
    if module is None:
        raise InputError(
            "plots",
            f"figures of {paper}",
            "none of them is drawn here",
            f"keep its records with --output and draw these with tribodyn plot, or take one of: "
            f"{', '.join(name for name in PAPERS if PAPERS[name].figures)}",
        )
    return import_module(module).FIGURES


def draw(
    paper: str,
    plots: Path,
    records: Path,
    progress: Callable[[float], None] | None = None,
    *,
    force: bool = False,
) -> list[Path]:
    """Draw figures like a paper's from our own numbers into the folder `plots`, which is there.

    From the records that `validate` left; `force` replaces also pictures that are not ours. Raises InputError
    as `figure_names` and `write_output`.
    """
    from tribodyn.post.style import house_style, save

    figures = _figures(paper)
    pictures = []
    for done, (name, draw_figure) in enumerate(figures.items(), start=1):
        with house_style():
            figure = draw_figure(records)
        pictures.append(save(figure, picture_path(paper, name, plots), force=force))
        if progress:
            progress(done / len(figures))
    return pictures


def picture_path(paper: str, name: str, plots: Path) -> Path:
    """Where `draw` writes a figure."""
    return plots / f"{paper}-{name}.png"


def _check(paper: str) -> None:
    if paper not in PAPERS:
        raise unknown_name("paper", paper, PAPERS, "paper")
