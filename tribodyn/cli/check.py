"""`tribodyn check`: is the scenario sound, what gears does it describe, how stiff are they."""

import math
from typing import TYPE_CHECKING, Annotated, Any

import typer

from tribodyn.cli.overrides import SetOption, overrides

if TYPE_CHECKING:
    from tribodyn.mesh.cycle import MeshCycle
    from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase
    from tribodyn.studies.efficiency.case import EfficiencyCase
    from tribodyn.studies.gear_pair.case import Case
    from tribodyn.studies.load import Loaded
    from tribodyn.studies.load_contact.case import LoadContactCase
    from tribodyn.studies.rolling.case import RollingCase

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn check involute-18-36\n"
    "  tribodyn check my-drive.toml --set drive.pinion.profile_shift=0.3 --json"
)


def check(
    scenario: Annotated[str, typer.Argument(help="A scenario file, or the name of a shipped scenario.")],
    settings: SetOption = None,
    json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Check a scenario; print geometry and stiffness."""
    from tribodyn.cli.printing import print_json, print_table
    from tribodyn.cli.sheet import print_sheet
    from tribodyn.geometry.assembly import assemble
    from tribodyn.geometry.families import family
    from tribodyn.geometry.sheet import geometry_sheet
    from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase
    from tribodyn.studies.efficiency.case import EfficiencyCase
    from tribodyn.studies.efficiency.run import prepare as prepare_efficiency
    from tribodyn.studies.gear_pair.prepare import prepare
    from tribodyn.studies.load import load
    from tribodyn.studies.load_contact.case import LoadContactCase
    from tribodyn.studies.rolling.case import RollingCase

    loaded = load(scenario, overrides(settings))
    case = loaded.case
    if isinstance(case, RollingCase):
        _check_rolling(loaded, case, json)
        return
    if isinstance(case, BacklashOscillatorCase):
        _check_oscillator(loaded, case, json)
        return
    with loaded.naming():
        masses = None
        if isinstance(case, LoadContactCase):
            stiffness = _of_load_contact(case)
        elif isinstance(case, EfficiencyCase):
            stiffness = _of_cycle(case, prepare_efficiency(case).cycle)
        else:
            model = prepare(case)
            masses = model.masses
            stiffness = _of_cycle(case, model.cycle)
        sheet = geometry_sheet(assemble(family(case.family), case.drive), masses)
    if json:
        print_json(
            {"scenario": str(loaded.path), "title": case.title, "geometry": sheet, "stiffness": stiffness}
        )
        return
    typer.echo(f"{loaded.path}: {case.title}: sound")
    print_sheet(sheet)
    print_table(
        f"Stiffness of a single pair at the pitch point, at {stiffness['line_load'] * 1e-3:.0f} N/mm",
        ("by", "N/(mm um)", "N/m"),
        [
            (name, f"{value['per_width'] * 1e-9:.2f}", f"{value['stiffness']:.4g}")
            for name, value in stiffness["by"].items()
        ],
    )


def _check_rolling(loaded: "Loaded", case: "RollingCase", json: bool) -> None:
    from tribodyn.cli.printing import print_json, print_table
    from tribodyn.cli.sheet import written
    from tribodyn.studies.rolling.run import prepare
    from tribodyn.studies.rolling.sheet import geometry_sheet

    with loaded.naming():
        prepare(case)
    sheet = geometry_sheet(case.drive)
    if json:
        print_json({"scenario": str(loaded.path), "title": case.title, "mode": case.mode, "geometry": sheet})
        return
    typer.echo(f"{loaded.path}: {case.title}: sound")
    rows = [("mode", case.mode), *((name, written(*value)) for name, value in sheet.items())]
    print_table("Gear with rolling elements", ("quantity", "value"), rows)


def _check_oscillator(loaded: "Loaded", case: "BacklashOscillatorCase", json: bool) -> None:
    from tribodyn.cli.printing import print_json, print_table
    from tribodyn.studies.backlash_oscillator.linear import linear_figures

    figures = linear_figures(case)
    if json:
        print_json({"scenario": str(loaded.path), "title": case.title, "linear": figures})
        return
    typer.echo(f"{loaded.path}: {case.title}: sound")
    rows = [(name, "none" if value is None else f"{value:.6g}") for name, value in figures.items()]
    print_table("What linear theory says, while contact lasts", ("quantity", "value"), rows)


def _of_cycle(case: "Case | EfficiencyCase", cycle: "MeshCycle") -> dict[str, Any]:
    from tribodyn.mesh.stiffness import single_pair

    pair = single_pair(cycle, case.operating.gear_torque)
    return _stiffness(case, pair.normal_load, f'compliance = "{case.mesh.compliance}"', pair.stiffness)


def _of_load_contact(case: "LoadContactCase") -> dict[str, Any]:
    from tribodyn.geometry.families import family
    from tribodyn.studies.load_contact.run import prepare, single_pair_stiffness

    study = prepare(case)
    arm = float(family(case.family).working_path(case.drive).gear_pitch_radius)
    load = case.gear_torque / (arm * math.cos(_pressure_angle(case)))
    return _stiffness(case, load, "finite elements", single_pair_stiffness(study))


def _pressure_angle(case: "Case | EfficiencyCase | LoadContactCase") -> float:
    from tribodyn.geometry.families import family

    return float(family(case.family).working_path(case.drive).pressure_angle(0.0))


def _stiffness(
    case: "Case | EfficiencyCase | LoadContactCase", load: float, name: str, found: float
) -> dict[str, Any]:
    """Return the line load (N/m), and by method the single-pair stiffness at P: N/m, and per width in Pa.

    `found` is ours in N/m, by the method `name`, under the normal load `load` in N.
    """
    from tribodyn.compliance.iso6336 import single_pair_stiffness as iso6336
    from tribodyn.geometry.families import family

    pinion, gear = case.drive.pinion, case.drive.gear
    width = min(pinion.face_width, gear.face_width)
    per_width = {name: found / width}
    if family(case.family).involute:
        iso = iso6336(pinion.teeth, gear.teeth, pinion.profile_shift, gear.profile_shift)
        per_width["ISO 6336 c', which contains the measured correction 0.8"] = iso.single_pair
        per_width["ISO 6336 c'_th, theory"] = iso.theoretical
    by = {name: {"per_width": value, "stiffness": value * width} for name, value in per_width.items()}
    return {"line_load": load / width, "by": by}
