"""`tribodyn gear`: the geometry sheet of a gear pair, and drawings of it."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tribodyn.cli.options import JsonOption, ReplaceOption, SetOption, drives, overrides
from tribodyn.errors import InputError, quoted
from tribodyn.numerics.files.output_files import check_output, make_folder, write_output

if TYPE_CHECKING:
    from tribodyn.geometry.assembly import Assembly
    from tribodyn.geometry.drive import Side
    from tribodyn.studies.drive_file import DriveModel

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn gear liu-ni-crc-23-47\n"
    "  tribodyn gear liu-ni-involute-23-47 --set drive.pinion.profile_shift=0.3\n"
    "  tribodyn gear my-drive.toml -o drawings\n"
    "  tribodyn gear liu-ni-crc-23-47 --as-spline 9\n"
    "  tribodyn gear two-stage-reducer --mesh second\n"
    "  tribodyn gear planetary-24-84 --gear planet -o drawings\n"
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
    gear: Annotated[
        str | None, typer.Option(help="One gear by its name, in all its meshes.", metavar="NAME")
    ] = None,
    force: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Print a gear pair's geometry; draw it."""
    if gear is not None:
        for option, value in (("--mesh", mesh), ("--as-spline", as_spline)):
            if value is not None:
                raise InputError("--gear", quoted(gear), f"contradicts {option}", "give one of them")
        _one_gear(model, overrides(settings), gear, output, points, force=force, json=json)
        return
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


def _one_gear(
    model: str,
    settings: dict[str, str],
    name: str,
    output: Path | None,
    points: int,
    *,
    force: bool,
    json: bool,
) -> None:
    """Print the sheet of one gear in its meshes; draw it."""
    from tribodyn.cli.printing import print_files, print_findings, print_json
    from tribodyn.gears.check import gear_table, sheet_of_gear
    from tribodyn.geometry.families import family
    from tribodyn.geometry.limits.checks import check
    from tribodyn.quantities.quantity import in_si
    from tribodyn.studies.drive_file import load_gear

    pairs = load_gear(model, settings, name)
    assemblies = {}
    for mesh, (pair, _) in pairs.items():
        with pair.origins.naming():
            assemblies[mesh] = check(family(pair.family), pair.drive)
    sheets = {mesh: sheet_of_gear(pair.sheet(assemblies[mesh]), side) for mesh, (pair, side) in pairs.items()}
    mesh, (pair, side) = next(iter(pairs.items()))
    files: list[Path] = []
    if output is not None:
        make_folder(output)
        for file in (targets := _gear_files(pair, assemblies[mesh], side, output, name)).values():
            check_output(file, force)
        files = _draw_gear(targets, assemblies[mesh], side, points, force)
    if json:
        geometry = {each: in_si(sheet) for each, sheet in sheets.items()}
        head = {"model": str(pair.path), "gear": name, "family": pair.family}
        print_json({**head, "geometry": geometry, "files": [str(file) for file in files]})
        return
    print_findings([gear_table(name, sheets)])
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
    from tribodyn.drawing.cad import write_pair
    from tribodyn.drawing.picture import pair_figure
    from tribodyn.geometry.drive import SIDES
    from tribodyn.post.progress import progress_bar
    from tribodyn.post.style import save

    def file(what: str) -> Path:
        return folder / f"{model.name}-{what}"

    make_folder(folder)
    gears = {side: _gear_files(model, assembly, side, folder, side) for side in SIDES}
    every = [file for files in gears.values() for file in files.values()]
    for target in (*map(file, ("pair.svg", "pair.png", "pair.dxf")), *every):
        check_output(target, force)
    with progress_bar("drawing") as progress:
        picture = pair_figure(assembly, model.title, points)
        files = [save(picture, file(f"pair.{ending}"), force=force) for ending in ("svg", "png")]
        progress(0.5)
        files.append(write_pair(file("pair.dxf"), assembly, points, force=force))
        for side in SIDES:
            files += _draw_gear(gears[side], assembly, side, points, force)
        progress(1.0)
    return files


def _gear_files(
    model: "DriveModel", assembly: "Assembly", side: "Side", folder: Path, name: str
) -> dict[str, Path]:
    """Files of a gear's drawings: of its outline, of its rack cutter where it has one, of its profile."""
    from tribodyn.geometry.drive import body_of

    endings = {"gear": ".dxf", "rack": "-rack.dxf", "profile": ".csv"}
    if body_of(assembly.drive, side).cutter_teeth is not None:
        del endings["rack"]
    return {what: folder / f"{model.name}-{name}{ending}" for what, ending in endings.items()}


def _draw_gear(
    files: dict[str, Path], assembly: "Assembly", side: "Side", points: int, force: bool
) -> list[Path]:
    """Draw a gear into the files of `_gear_files`."""
    from tribodyn.drawing.cad import tooth_profile, write_gear, write_profile, write_rack

    write_gear(files["gear"], assembly, side, points, force=force)
    if "rack" in files:
        write_rack(files["rack"], assembly, side, points, force=force)
    write_profile(files["profile"], tooth_profile(assembly, side, points), force=force)
    return list(files.values())
