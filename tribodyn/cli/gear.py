"""`tribodyn gear`: the geometry sheet of a gear pair, and drawings of it."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tribodyn.cli.options import JsonOption, ReplaceOption, SetOption, drives, overrides
from tribodyn.numerics.files.output_files import check_output, make_folder, write_output

if TYPE_CHECKING:
    from tribodyn.geometry.assembly import Assembly
    from tribodyn.studies.drive_file import DriveModel

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn gear liu-ni-crc-23-47\n"
    "  tribodyn gear liu-ni-involute-23-47 --set drive.pinion.profile_shift=0.3\n"
    "  tribodyn gear my-drive.toml -o drawings\n"
    "  tribodyn gear liu-ni-crc-23-47 --as-spline 9\n"
    "  tribodyn gear two-stage-reducer --mesh second\n"
    "\b\nWith -o: the pair as SVG, PNG and DXF; each gear and its rack cutter as DXF;\n"
    "the points of each gear's profile as CSV."
)


def gear(
    model: Annotated[
        str,
        typer.Argument(
            help="A drive or a scenario: the name of a shipped one, or a file.", autocompletion=drives
        ),
    ],
    output: Annotated[Path | None, typer.Option("--output", "-o", help="Folder of the drawings.")] = None,
    settings: SetOption = None,
    points: Annotated[
        int, typer.Option(help="Points along a flank in the drawings.", min=10, max=100_000)
    ] = 100,
    as_spline: Annotated[
        int | None,
        typer.Option(
            help="Fit a free-form path of so many values; write it as a drive, MODEL-spline.toml.",
            metavar="N",
        ),
    ] = None,
    mesh: Annotated[
        str | None, typer.Option(help="Of a train: the mesh whose gears are meant.", metavar="NAME")
    ] = None,
    force: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Print a gear pair's geometry; draw it."""
    from tribodyn.cli.printing import print_files, print_findings, print_json, print_prose
    from tribodyn.gears.check import sheet_tables
    from tribodyn.geometry.families import family
    from tribodyn.geometry.limits.checks import check
    from tribodyn.quantities.quantity import in_si
    from tribodyn.studies.drive_file import load_drive

    loaded = load_drive(model, overrides(settings), mesh)
    written: list[Path] = []
    if as_spline is not None:
        loaded, file = _fitted(loaded, as_spline, output or Path(), force)
        written.append(file)
    with loaded.origins.naming():
        assembly = check(family(loaded.family), loaded.drive)
    sheet = loaded.sheet(assembly)
    files = written + (_draw(loaded, assembly, output, points, force) if output is not None else [])
    if json:
        head = {"model": str(loaded.path), "title": loaded.title, "family": loaded.family}
        print_json({**head, "geometry": in_si(sheet), "files": [str(file) for file in files]})
        return
    print_prose(f"{loaded.path}: {loaded.title}: {loaded.family}")
    print_findings(sheet_tables(sheet))
    print_files("", files)


def _fitted(model: "DriveModel", values: int, folder: Path, force: bool) -> "tuple[DriveModel, Path]":
    """The pair with a free-form path, and the drive file that was written of it."""
    import tomli_w

    from tribodyn.studies.drive_file import as_spline, load_drive

    fitted = as_spline(model, values, "--as-spline")
    if folder != Path():
        make_folder(folder)
    file = folder / f"{model.name}-spline.toml"
    write_output(file, tomli_w.dumps(fitted.table), force=force)
    return load_drive(str(file)), file


def _draw(model: "DriveModel", assembly: "Assembly", folder: Path, points: int, force: bool) -> list[Path]:
    """Write every drawing of a gear pair into a folder; return the files."""
    from tribodyn.drawing.cad import tooth_profile, write_gear, write_pair, write_profile, write_rack
    from tribodyn.drawing.picture import pair_figure
    from tribodyn.geometry.drive import SIDES, body_of
    from tribodyn.post.progress import progress_bar
    from tribodyn.post.style import save

    def file(what: str) -> Path:
        return folder / f"{model.name}-{what}"

    make_folder(folder)
    with_rack = [side for side in SIDES if body_of(assembly.drive, side).cutter_teeth is None]
    own = [f"{side}{what}" for side in SIDES for what in (".dxf", ".csv")]
    own += [f"{side}-rack.dxf" for side in with_rack]
    for what in ("pair.svg", "pair.png", "pair.dxf", *own):
        check_output(file(what), force)
    with progress_bar("drawing") as progress:
        picture = pair_figure(assembly, model.title, points)
        files = [save(picture, file(f"pair.{ending}"), force=force) for ending in ("svg", "png")]
        progress(0.5)
        files.append(write_pair(file("pair.dxf"), assembly, points, force=force))
        for side in SIDES:
            files.append(write_gear(file(f"{side}.dxf"), assembly, side, points, force=force))
            if side in with_rack:
                files.append(write_rack(file(f"{side}-rack.dxf"), assembly, side, points, force=force))
            profile = tooth_profile(assembly, side, points)
            files.append(write_profile(file(f"{side}.csv"), profile, force=force))
        progress(1.0)
    return files
