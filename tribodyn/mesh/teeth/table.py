"""The table of single teeth of a mesh, as the equations of motion look it up."""

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.mesh.cycle import MeshCycle, cubic
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.teeth.fields import LEADING, TRAILING, FlankPlaces, OwnTeeth, ToothFields, sound
from tribodyn.mesh.teeth.flank_positions import places_of
from tribodyn.mesh.teeth.lookup import CHANNELS, GAP, Teeth, ToothTable
from tribodyn.numerics.shapes import Array, Float

#: Cubics that never overshoot, see `mesh.cycle.slopes`.
_MONOTONE = 2


def teeth_of(
    assembly: Assembly,
    mesh: MeshData,
    cycle: MeshCycle,
    teeth: tuple[OwnTeeth, OwnTeeth],
    counts: tuple[int, int],
) -> Teeth:
    """Tabulate what teeth of driver and driven gear have of their own, of gears with so many teeth."""
    sides = places_of(assembly, mesh, cycle)
    channels = 1 if all(each.of_gap_alone for gear in teeth for each in gear) else CHANNELS
    tables, numbers = [], []
    for end, flanks in enumerate(((LEADING, TRAILING), (TRAILING, LEADING))):
        places = [(side.driver, side.driven)[end] for side in sides]
        number = [(side.driver_number, side.driven_number)[end] for side in sides]
        rows, channel = _rows(teeth[end], places, flanks, counts[end], channels, cycle.slices)
        # a ring of numbers, from the smallest that a slot may have
        lowest = min(int(each.min()) for each in number)
        length = counts[end] - lowest + max(int(each.max()) for each in number)
        ring = (np.arange(length) + lowest) % counts[end]
        tables.append(ToothTable(np.concatenate([row[ring] for row in rows]).astype(float), channel))
        numbers.append(np.concatenate([n - lowest + length * s for s, n in enumerate(number)], axis=1))
    return Teeth(
        *tables,
        start=np.concatenate([side.start for side in sides], axis=1),
        rate=np.concatenate([np.full(side.start.shape[1], side.rate) for side in sides]),
        driver_place=numbers[0],
        driven_place=numbers[1],
    )


def _rows(
    teeth: OwnTeeth,
    places: list[FlankPlaces],
    flanks: tuple[int, int],
    count: int,
    channels: int,
    slices: int,
) -> tuple[list[np.ndarray], Float[Array, "row cell slice channel 4"]]:
    """Row of every tooth on each side, and the rows: teeth that are alike share one."""
    row_of: dict[bytes, int] = {}
    kept, rows = [], []
    for at, flank in zip(places, flanks, strict=False):
        row = np.zeros(count, dtype=int)
        for tooth in range(count):
            fields = sound(at)
            for each in teeth:
                if (more := each.fields(tooth, flank, at)) is not None:
                    fields = fields.beside(more)
            values = _channels(fields, slices)[..., :channels]
            key = values.tobytes()
            if key not in row_of:
                row_of[key] = len(kept)
                kept.append(values)
            row[tooth] = row_of[key]
        rows.append(row)
    return rows, np.ascontiguousarray(cubic(np.stack(kept), _MONOTONE))


def _channels(fields: ToothFields, slices: int) -> Float[Array, "node slice channel"]:
    """Fields as the table's channels; of a slot, which is one of so many slices of the face."""
    columns = [fields.gap, fields.compliance * slices, fields.friction - 1.0]
    assert columns[GAP] is fields.gap
    return np.stack([column.T for column in columns], axis=-1)
