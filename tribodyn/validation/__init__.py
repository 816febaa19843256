"""Comparison with the numbers and claims of the papers, from records where it takes a run."""

from collections.abc import Callable
from contextlib import ExitStack
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

from tribodyn.errors import InputError, unknown_name
from tribodyn.validation.rows import Row


class Listing(NamedTuple):
    """Where the numbers of a book are from."""

    program: str  # with its version; of a standard's own example the standard
    editions: str  # standards, and of which year, that it computes by
    licence: str  # of the public copy that the numbers were read in
    copy: str  # where that is
    left_out: str = ""  # what of the listing is no row, and why

    def said(self) -> str:
        """All of it in sentences."""
        left_out = f" No rows: {self.left_out}." if self.left_out else ""
        return f"{self.program}: {self.editions}. Read in {self.copy}; licence: {self.licence}.{left_out}"


class Paper(NamedTuple):
    """Where the numbers of a paper are compared."""

    module: str  # that computes its rows
    about: str  # who, where, and what is compared
    choices: str  # under which its rows are computed, the head of its table
    figures: str | None = None  # module that draws its figures
    source: Listing | None = None  # of a book: a listing of another program or of a standard


#: By the name on the command line.
PAPERS = {
    "liu-ni-2022": Paper(
        "tribodyn.validation.papers.liu_ni",
        "Liu & Ni, Mechanics & Industry 23:10 (2022): CRC drive and involute",
        "as published, with kinematic sliding, transmission errors by (6); beside it the default, dynamic "
        "sliding, and other readings",
        "tribodyn.validation.papers.liu_ni_figures",
    ),
    "efremenkov-2024": Paper(
        "tribodyn.validation.papers.efremenkov",
        "Efremenkov et al., Mathematics 12:873 (2024): gear with rolling elements",
        "as published: the paper's own equations with their errors; beside it corrected speeds, with which "
        "the gear loses nearly all its power",
        "tribodyn.validation.papers.efremenkov",
    ),
    "veciana-2024": Paper(
        "tribodyn.validation.papers.veciana",
        "Veciana et al., Machines 12:943 (2024): efficiency of cycloidal gears",
        "with the mixed law as printed (reading A) and the paper's rolling speeds; beside it reading B",
        "tribodyn.validation.papers.veciana_figures",
    ),
    "diez-ibarbia": Paper(
        "tribodyn.validation.papers.diez_ibarbia",
        "Diez-Ibarbia et al.: efficiency of spur gears over the profile shift",
        "with load contact by finite elements; rows without a published number stand beside another "
        "implementation of the equations",
        "tribodyn.validation.papers.diez_ibarbia_figures",
    ),
    "jia-2022": Paper(
        "tribodyn.validation.papers.jia",
        "Jia et al., Mathematics 10:4290 (2022): gears with a parabolic path of contact",
        "with maximum line loads for contact stresses, misalignment in the plane of action, limits with the "
        "paper's sin(beta); beside it Hertz pressures and the actual tips",
        "tribodyn.validation.papers.jia_figures",
    ),
    "helical-report-2017": Paper(
        "tribodyn.validation.books.helical_report_2017",
        "Design report of a helical stage (KISSsoft 2017): ISO 6336 and its parts, row by row",
        "as the report does: load factors from its tolerances, roots with tips in the middle of theirs, "
        "C_ZL = σ_Hlim/4375 + 0.6357 at 1200 N/mm2 too, 0.3333 for 1/3 in Rz10, X_J 1; readings that give "
        "its numbers: F_t/cos β in μ_mC, F_t cos β_b in the mean friction, j_n = j_t cos α_n cos β, "
        "stiffness at the input of c_γβ times d/d_w, J_2 by 145/min, which is left in its file, 8.3 m/s of "
        "the micropitting test at the reference circle; flank fracture at the printed depth, by constants "
        "that were found from its exposures too",
        source=Listing(
            "KISSsoft, release 03/2017 A",
            "ISO 6336:2006, ISO/TR 15144-1:2014, ISO/TR 13989:2000, ISO/DTR 19042-1 (2016), DIN 3960:1987, "
            "ISO 1328-1:1995",
            "none named (academic licence of the program, NTNU)",
            "github.com/gfsReboucas/Drivetrain, @NREL_5MW/stage_03.rtf; more digits of its inputs in "
            "stage_03.Z12, commit 3642f03",
            "inputs; hardening depth by DNV 41.2, pin measures by AGMA 2002, reliability after Bertsche, "
            "sound after Masuda, lives beyond 10^6 h: not computed here",
        ),
    ),
    "stplus-fzg-c": Paper(
        "tribodyn.validation.books.stplus_fzg_c",
        "FZG gears of type C in the listing of STplus 11.1F: geometry, ISO 6336 of 2019, scuffing",
        "as the listing does: K_v K_Hbeta by its pressures, endurance, flanks that are not run in; readings "
        "that give its numbers: density falls by 0.65 kg/(m3 K), the integral temperature with the working "
        "circle's speed and the printed viscosity, flash temperatures without K_v; flank fracture in depths "
        "of b_H/11, by constants that were found from its exposures",
        source=Listing(
            "FVA STplus 11.1F (2025-12-01)",
            "ISO 6336-1, -2, -3:2019, ISO/TS 6336-4:2019, ISO/TS 6336-20 and -21:2017, DIN 3960:1987",
            "MIT",
            "github.com/tkuhn39/semesterthesis, commit edc71655, gearcore/data/stplus/fzg_c/report.sta.txt",
            "inputs; Lewis parabola: not computed here",
        ),
    ),
    "fzg-gears-gearpie": Paper(
        "tribodyn.validation.books.fzg_gears_gearpie",
        "FZG gears in the reports of GEARpie: loss factors, mean friction and losses of five pairs",
        "as the program does: radius of curvature of the transverse section, least lines of contact, loss "
        "factors by sums over a thousand places",
        source=Listing(
            "GEARpie (2025-01-10)",
            "Ohlendorf, Wimmer, Schlenk, Fernandes, Martins & Seabra (2014)",
            "MIT",
            "github.com/cfernandesFEUP/GEARpie, commit cb30c91, REPORT/",
            "calculated there, not measured; stresses and DIN 3990, films by another formula, Matsumoto's "
            "friction: not compared here",
        ),
    ),
    "planetary-losses-2017": Paper(
        "tribodyn.validation.books.planetary_losses_2017",
        "Planetary stages of NREL's 5 MW gearbox (KISSsoft 2017): losses mesh by mesh",
        "with the printed load factors; H_v by its formula also beyond the formula's range",
        source=Listing(
            "KISSsoft, release 03/2017 A",
            "ISO/TR 15144-1:2014, ISO 6336:2006",
            "none named (academic licence of the program, NTNU)",
            "github.com/gfsReboucas/Drivetrain, @NREL_5MW/stage_01.rtf and stage_02.rtf, commit 4a88df3",
            "all but losses and what they follow from",
        ),
    ),
    "iso-tr-6336-30": Paper(
        "tribodyn.validation.books.iso_tr_6336_30",
        "ISO/TR 6336-30, example 1: a helical pair by ISO 6336-1 and -2, and its geometry",
        "with the face load factor as printed, discs without bore",
        source=Listing(
            "ISO/TR 6336-30",
            "2017 (ISO 6336:2006), geometry of 2022",
            "none named; MIT (geometry)",
            "github.com/gfsReboucas/Drivetrain, MATISO_6336.m; github.com/tkuhn39/semesterthesis",
        ),
    ),
    "iso-6336-6-annex-c": Paper(
        "tribodyn.validation.books.iso_6336_6_annex_c",
        "ISO 6336-6, annex C: stresses, cycles and Miner's sum of a load spectrum of 42 classes",
        "with torque and time of every class as printed; face load factors beyond 1.31, Z_R and the stress "
        "of the first class to more digits than theirs, as the table's stresses and cycles ask for",
        source=Listing(
            "ISO 6336-6",
            "2019",
            "none named",
            "github.com/gfsReboucas/Drivetrain, data/table_C2.csv",
            "six classes without load cycles or without load",
        ),
    ),
}


def validate(
    paper: str, progress: Callable[[float], None] | None = None, folder: str | Path | None = None
) -> list[Row]:
    """Run what a paper's rows need and compare; `progress` is called with the share done, 0 … 1.

    The records of the runs are kept in `folder`, in a temporary one if none is given. Raises InputError for
    an unknown paper, SimulationError if one of the runs fails.
    """
    from tempfile import TemporaryDirectory

    _check(paper)
    module = import_module(PAPERS[paper].module)
    with ExitStack() as stack:
        place = folder or stack.enter_context(TemporaryDirectory(prefix="tribodyn-"))
        return module.rows(Path(place), progress or (lambda share: None))


def figures_of(paper: str) -> dict[str, Callable[[Path], Any]]:
    """Figures of a paper that are drawn from our own numbers, by name: drawn from the folder of its records.

    Raises InputError for an unknown paper, and one without figures.
    """
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
    as `figures_of` and `write_output`.
    """
    from tribodyn.post.style import house_style, save

    figures = figures_of(paper)
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
