"""Records with known contents for the tests of writer, reader and plots."""

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from rich.console import Console

from tribodyn.gears.motion.recorded import DOF, LAYOUT, SAMPLES, scales_of
from tribodyn.mesh.record_arrays import from_arrays
from tribodyn.numerics.parameter import Variable
from tribodyn.record.layout import Head
from tribodyn.record.sweep_schema import DONE, SweepLayout, VariedKey
from tribodyn.record.sweep_writer import SweepHead, SweepWriter
from tribodyn.record.writer import RecordWriter


def mesh_cycle(contact_ratio: float = 1.5, nodes: int = 9, sides: Sequence[float] = (1.0, 1.0)):
    """A mesh cycle of pairs on given sides (driving flanks +1), whose numbers are easy to recognise."""
    boundary = np.array([0.0, contact_ratio - 1, 1.0])
    phase = np.concatenate([np.linspace(*ends, nodes) for ends in ((0.0, boundary[1]), (boundary[1], 1.0))])
    rows = np.arange(2 * nodes, dtype=float)
    names = "pressure_angle signed_distance equivalent_radius pinion_speed gear_speed compliance gap"
    table = {
        name: rows[:, None] + factor * np.arange(1.0, len(sides) + 1.0)
        for factor, name in enumerate(names.split())
    }
    contact = np.ones((2 * nodes, len(sides)))
    contact[nodes:, 0] = 0.0
    return {
        "boundary": boundary,
        "in_contact": contact,
        "side": np.array(sides),
        "phase": phase,
        **table,
        "coupling": np.zeros((2 * nodes, len(sides), len(sides))),
        "hertz_coefficient": 0.0,
        "pinion_pitch_radius": 0.0345,
        "gear_pitch_radius": 0.0705,
        "pinion_teeth": 23.0,
        "face_width": 0.02,
        "contact_ratio": contact_ratio,
        "pitch_point_phase": 0.8,
        "roll_start": -0.2,
        "roll_end": 0.2,
        "pitch_point_length": 0.0,
        "pitch_point_rate": 0.0,
    }


def geometry() -> dict[str, Any]:
    """Outlines of a few points."""
    return {
        "pinion_outline": np.arange(10.0).reshape(5, 2),
        "gear_outline": np.arange(14.0).reshape(7, 2),
        "path_of_contact": np.arange(6.0).reshape(3, 2),
        "pinion_tip_radius": 0.0375,
    }


def gear_pair_writer(
    path: Path,
    samples: int,
    *,
    table: Mapping[str, Any] | None = None,
    outlines: Mapping[str, Any] = MappingProxyType({}),
    scenario_toml: str = "",
    sha256: str = "",
    force: bool = False,
) -> RecordWriter:
    """The writer of a gear pair's record; its mesh cycle is that of `mesh_cycle` where none is given."""
    table = mesh_cycle() if table is None else table
    groups = {"mesh_cycle": table, "geometry": outlines}
    head = Head(
        "gear-pair", LAYOUT, scenario_toml, sha256, datetime.now(UTC), groups, scales_of(from_arrays(table))
    )
    return RecordWriter(path, head, samples, force=force)


def printed(table: Any) -> str:
    """What the terminal shows of a table."""
    console = Console(width=200, no_color=True)
    with console.capture() as capture:
        console.print(table)
    return capture.get()


def block(start: int, stop: int, pairs: int = 2) -> dict[str, np.ndarray]:
    """Samples `start` … `stop`, each value that depends on its dataset, sample and column."""
    index = np.arange(start, stop, dtype=float)
    size = {"pair": pairs, "dof": len(DOF)}
    values: dict[str, np.ndarray] = {"time": index}
    for number, (name, variable) in enumerate(SAMPLES.items()):
        columns = [size[dim] for dim in variable.dims[1:]]
        values[name] = index.reshape(-1, *[1] * len(columns)) * 100 + number
        if columns:
            values[name] = values[name] + np.arange(columns[0]) / 10
    for name, variable in SAMPLES.items():
        if variable.flags:
            values[name] = values[name].astype(int) % 2 == 0
    values["efficiency"] = 1.0 / (1.0 + values["efficiency"])  # a share, which others are not
    return values


#: A sweep over three speeds with one quantity.
SWEEP_HEAD = SweepHead(
    "title = 1\n",
    "0",
    (VariedKey("speed", "operating.pinion_speed", "rad/s", [1.0, 2.0, 3.0]),),
    "x = 1\n",
    (),
    SweepLayout({"quantity": Variable((), "1", "a quantity")}),
)


def sweep_record(path: Path, resume: bool = False, most: int = 3) -> None:
    """Write the record of a sweep, or go on with it; with fewer cases than all it has no end."""
    with SweepWriter(path, SWEEP_HEAD, resume=resume) as writer:
        for case in np.flatnonzero(writer.status == 0)[:most]:
            rows = SWEEP_HEAD.layout.empty_rows(1)
            rows["quantity"][:], rows["status"][:], rows["message"][0] = case, DONE, "ä"
            writer.write(np.array([case]), rows)
        if most == 3:
            writer.finish({})
