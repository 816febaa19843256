"""A map of losses as comma-separated values: a row for every point, and the statics in a second file."""

import csv
import io
from collections.abc import Mapping

import numpy as np

from tribodyn.exchange.format import MAP, ExchangeFormat, Exported, Written, deviation
from tribodyn.exchange.heading import heading
from tribodyn.record.loss_map import LossMap

_POINT = ("oil_temperature [K]", "torque [N*m]", "speed [rad/s]")
_TOTAL = ("torque_at_input [N*m]", "power_loss [W]", "efficiency [1]")


def write(exported: Exported, name: str, choices: Mapping[str, float]) -> Written:
    """Rows of the map, read back and compared."""
    losses = exported.losses
    speeds = np.abs(losses.points[2])
    columns = [*losses.points, losses.torque_at_input(), losses.total * speeds, losses.efficiency()]
    table = _text(
        [*_POINT, *_TOTAL, *(f"{source.replace(',', ';')} [N*m]" for source in losses.sources)],
        [column.ravel() for column in (*columns, *losses.drag)],
    )
    read = np.array([[float(cell or "nan") for cell in row] for row in csv.reader(table.splitlines()[1:])])
    drag = read[:, len(columns) :].sum(axis=1).reshape(losses.total.shape)
    found = (
        deviation("drag at the input", "N m", drag, losses.total),
        deviation("power loss", "W", read[:, 4].reshape(speeds.shape), losses.total * speeds),
    )
    files = {".csv": heading(exported, "# ", found) + table}
    if losses.stiffness.size or losses.error_amplitude.size:
        files["-statics.csv"] = heading(exported, "# ") + _statics(losses)
    return Written(files, found)


def _statics(losses: LossMap) -> str:
    heads, columns = ["torque [N*m]"], [losses.torque]
    if losses.stiffness.size:
        heads.append("stiffness_at_output [N*m/rad]")
        columns.append(losses.stiffness)
    parts = {"amplitude": losses.error_amplitude, "phase": losses.error_phase}
    for number, mesh in enumerate(losses.meshes):
        for part, values in parts.items():
            for harmonic in range(values.shape[2] if len(values) else 0):
                of = f"transmission_error {mesh.replace(',', ';')} harmonic {harmonic + 1}"
                heads.append(f"{of} {part} [rad]")
                columns.append(values[number, :, harmonic])
    return _text(heads, columns)


def _text(heads: list[str], columns: list[np.ndarray]) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(heads)
    for row in zip(*columns, strict=True):
        writer.writerow("" if np.isnan(value) else f"{value:.10g}" for value in row)
    return stream.getvalue()


FORMAT = ExchangeFormat(
    "csv",
    "map of losses: a row for every point with the drag of every source; statics in a second file",
    (".csv",),
    takes=(MAP,),
    write=write,
)
