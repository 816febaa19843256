"""The table of single teeth of a mesh, as the equations of motion look it up."""

from typing import NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly, half_angles
from tribodyn.geometry.helix import normal_slope, overlap_ratio, pitch_slope, roll_shift
from tribodyn.geometry.path import radius
from tribodyn.mesh.cycle import MeshCycle, cubic
from tribodyn.mesh.slices.helical import slice_layout
from tribodyn.mesh.table import MeshData, back_entry
from tribodyn.mesh.teeth.fields import LEADING, TRAILING, FlankPlaces, OwnTeeth, ToothFields, sound
from tribodyn.mesh.teeth.lookup import CHANNELS, GAP, Teeth, ToothTable
from tribodyn.numerics.shapes import Array, Float

#: Cells of the tables of teeth over the roll of a pair.
CELLS = 128


class PairPlaces(NamedTuple):
    """Places over the roll of a pair in contact on one side, and where the slots of that side stand."""

    driver: FlankPlaces
    driven: FlankPlaces
    #: cells at phase 0, and per mesh cycle
    start: Float[Array, "segment slot"]
    rate: float
    #: numbers of the slots' teeth less those of the teeth that entered last on the driving side
    driver_number: Float[Array, "segment slot"]
    driven_number: Float[Array, "segment slot"]


def places_of(assembly: Assembly, mesh: MeshData, cycle: MeshCycle) -> tuple[PairPlaces, ...]:
    """The places of the driving flanks, and of the back flanks where the table has any.

    Beyond the path of contact, where corners touch, a tooth is what it is at the path's end.
    """
    sides = (1, -1) if np.any(np.asarray(cycle.side) < 0) else (1,)
    return tuple(_side(assembly, mesh, cycle, side) for side in sides)


def flank_places(
    assembly: Assembly, roll: Float[Array, " node"], face: Float[Array, " slice"], side: int = 1
) -> tuple[FlankPlaces, FlankPlaces]:
    """Places of pinion and gear at roll angles (rad) of a pair in its own section, in sections `face` (m).

    Of the driving flanks (`side` 1), or of the back flanks (−1).
    """
    (begin, end), pitch = assembly.roll_limits, float(assembly.pitch_angle)
    distance = np.asarray(assembly.path.signed_distance(np.clip(roll, min(begin, end), max(begin, end))))
    angle = np.asarray(assembly.path.pressure_angle(distance)) * np.ones(len(roll))
    late = np.asarray(roll_shift(assembly, face)) * np.ones(len(face))
    # of the tooth that its driving flank would touch now in mid-face
    rolled = (roll if side > 0 else pitch / 2.0 - roll) + late[:, None]
    psi = half_angles(assembly)
    radii = float(assembly.path.pinion_pitch_radius), float(assembly.path.gear_pitch_radius)
    ratio = radii[0] / radii[1]
    lean = 1.0 / np.sqrt(1.0 + normal_slope(float(pitch_slope(assembly)), angle) ** 2)
    reach = np.asarray(radius(assembly.path, distance))
    # an internal gear turns against the sense of its signed radius
    of_driver = np.sign(radii[0]) * (rolled - psi[0])
    driver = FlankPlaces(roll, distance, reach, angle, lean, face, of_driver)
    # on the back side the driven tooth is one pitch behind that of the driver's number
    of_driven = np.sign(radii[1]) * (psi[1] + ratio * (rolled if side > 0 else rolled - pitch))
    driven = driver._replace(radius=np.asarray(radius(assembly.path_of("gear"), -distance)), turned=of_driven)
    return driver, driven


def _side(assembly: Assembly, mesh: MeshData, cycle: MeshCycle, side: int) -> PairPlaces:
    begin, end = (float(limit) for limit in assembly.roll_limits)
    pitch, slices = float(assembly.pitch_angle), cycle.slices
    # in the table the helix is that of a right-hand pinion
    hand = -1.0 if assembly.drive.helix_angle < 0.0 else 1.0
    face = hand * np.asarray(cycle.face_position)
    late = np.asarray(roll_shift(assembly, face)) / pitch * np.ones(slices)  # mesh cycles
    # of a section, pitches from the beginning of its path of contact
    reach = (begin, end) if assembly.drive.helix_angle else (float(cycle.roll_start), float(cycle.roll_end))
    low, high = ((limit - begin) / pitch for limit in reach)
    nodes = np.linspace(low, high, CELLS + 1)
    per_pitch = CELLS / (high - low)

    first = (float(cycle.roll_start) - begin) / pitch  # of the newest pair in mid-face, at phase 0
    segments = np.asarray(cycle.boundary)
    if side > 0:
        ages = np.arange(cycle.front_pairs - 1.0, -1.0, -1.0)
        at = np.broadcast_to(first + ages, (len(segments) - 1, len(ages)))
        driver_number = driven_number = np.broadcast_to(-ages, at.shape)
    else:
        at, driver_number = _back_pairs(assembly, mesh, cycle)
        # behind a driver's tooth is the driven tooth that the next one pushes
        driven_number = driver_number + 1.0
    start = (at[..., None] - side * late - low) * per_pitch

    driver, driven = flank_places(assembly, begin + pitch * nodes, face, side)
    shape = start.shape[0], start.shape[1] * slices
    numbers = [np.repeat(each, slices, axis=1) for each in (driver_number, driven_number)]
    return PairPlaces(driver, driven, start.reshape(shape), side * per_pitch, *numbers)


def _back_pairs(
    assembly: Assembly, mesh: MeshData, cycle: MeshCycle
) -> tuple[Float[Array, "segment pair"], Float[Array, "segment pair"]]:
    """Pitches since the beginning of the path, in mid-face at phase 0, and numbers of back pairs' drivers.

    As `table.slots`, `helical` and `loaded_slices` lay them out: in the mirrored world, where a pair's roll
    falls. The back flank of a driver's tooth passes the pitch point half a pitch after its driving flank.
    """
    begin, pitch = float(assembly.roll_limits[0]), float(assembly.pitch_angle)
    from_begin = (float(cycle.roll_start) - begin) / pitch
    pairs = (cycle.slots - cycle.front_slots) // cycle.slices
    boundary = np.asarray(cycle.boundary)
    middle = (boundary[:-1] + boundary[1:]) / 2.0
    wrapped = np.zeros(len(middle))
    if cycle.slices > 1 and not mesh.at_load and assembly.drive.helix_angle:
        entry, first = begin, slice_layout(assembly, mesh, cycle.slices, True).back[-1]
        from_begin = float(overlap_ratio(assembly)) / 2.0
    else:
        entry, first = float(cycle.roll_start), pairs - 1
        if not assembly.drive.helix_angle:
            wrapped = np.where(middle > float(back_entry(entry, pitch)), 1.0, 0.0)
    enters = 0.5 - 2.0 * entry / pitch
    number = first - np.arange(float(pairs)) + wrapped[:, None]
    return from_begin + enters % 1.0 + number, number - np.floor(enters)


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
