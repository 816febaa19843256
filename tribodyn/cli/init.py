"""`tribodyn init`: a commented scenario to begin with."""

from pathlib import Path
from typing import Annotated

import typer

EXAMPLES = "\b\nExample:\n  tribodyn init my-drive\n  tribodyn run my-drive.toml"


def init(
    name: Annotated[str, typer.Argument(help="Name of the scenario; NAME.toml is written in this folder.")],
    force: Annotated[bool, typer.Option("--force", help="Replace a file of that name.")] = False,
) -> None:
    """Write a commented scenario to run and to edit."""
    from tribodyn.cli.printing import quoted_path
    from tribodyn.errors import InputError

    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    if not path.parent.is_dir():
        raise InputError("name", f'"{path}"', "the folder does not exist", f"create {path.parent} first")
    try:
        with path.open("w" if force else "x", encoding="utf-8") as file:
            file.write(TEMPLATE.replace("TITLE", path.stem.replace('"', "'")))
    except FileExistsError:
        raise InputError("name", f'"{path}"', "the file exists", "choose another name, or --force") from None
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError(
            "name", f'"{path}"', f"cannot be written: {reason}", "choose another place"
        ) from None
    typer.echo(f"{path}\nrun it with: tribodyn run {quoted_path(path)}")


TEMPLATE = """\
# A scenario: what is done with a drive. `tribodyn schema` prints every key that may stand here;
# `tribodyn list` the names that may be used. A quantity is a string with its unit.
title = "TITLE"
kind = "gear-pair"

# Names of shipped models, paths to TOML files of your own, or the tables written out here.
drive = "liu-ni-crc-23-47"
lubricant = "liu-ni-2022"
bearings = "rigid-1e9"

[operating]
pinion_speed = "10 rad/s"             # or "100 rpm"
gear_torque = "500 N*m"
# gear_torque_harmonics = [{ amplitude = "50 N*m", frequency = "30 Hz", phase = "0 deg" }]
# gear_torque_table = "load.csv"      # columns: time [s],torque [N*m]; added to gear_torque
# source = "torque"                   # a motor instead of a prescribed speed, with
# drive_inertia = "0.02 kg*m**2"
# speed_regulation = "10 N*m*s/rad"   # how fast its torque falls with speed

[mesh]
compliance = "energy"                 # or "constant" with stiffness = "2.8e8 N/m", or "table"
damping_ratio = 0.05
# hertz = "load-dependent"
# backlash = "0.05 mm"                # normal backlash; without it back flanks never touch

# [mesh.transmission_error]           # of each pair of teeth, positive where material is missing
# harmonics = [{ order = 1, amplitude = "2 um", phase = "0 deg" }]

[friction]
law = "masjedi-khonsari"              # tribodyn list laws

[solver]
method = "auto"                       # tribodyn list solvers
rtol = 1e-6
cycles = 20                           # mesh cycles

[output]
samples_per_cycle = 200
"""
