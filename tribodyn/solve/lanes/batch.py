"""Cases packed by the shape of their models into queues, and threads that work through these in lanes.

Of a model numbers and addresses of tables are packed as rows, from which lanes are filled.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.contact_forces import QUANTITIES
from tribodyn.dynamics.extremes import Extremes
from tribodyn.dynamics.parameters import STATES, Model, Options
from tribodyn.kernels.lanes.tables import Field, LaneRecord
from tribodyn.kernels.lanes.vectors import WIDTH
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.integrator import Ensemble, March, nothing_yet, put
from tribodyn.solve.lanes.march import march_lanes
from tribodyn.solve.lanes.queue import CASE, ROWS, LaneBlock, Queue
from tribodyn.solve.march.extreme_search import Search
from tribodyn.solve.march.reversal import stops_of_many
from tribodyn.solve.methods import dopri5
from tribodyn.solve.tolerances import tolerances_of_many

#: Time between two reports of progress, s.
INTERVAL = 0.1
#: The model's named tuples of numbers and tables.
RECORDS = tuple(name for name in Model._fields if name != "options")
#: Tables that models of one shape have in common, value for value: branches may hang on them.
SHARED = ("side", "in_contact")


class ModelShape(NamedTuple):
    """What must be the same in all lanes: the options, and the shape of every field."""

    options: Options
    shapes: tuple[tuple[tuple[int, ...], ...], ...]
    contacts: bytes  # side of every slot, and which are in contact in which segment

    @property
    def pairs(self) -> int:
        """Number of pair slots."""
        return self.shapes[0][2][0]


class Kept(NamedTuple):
    """A table as it came, as contiguous floats, and where these are."""

    given: Any
    array: np.ndarray
    address: int


class Packed(NamedTuple):
    """Models of one shape."""

    shape: ModelShape
    fields: tuple[tuple[Field, ...], ...]  # fields of every record
    numbers: np.ndarray  # (C, F) float64
    addresses: np.ndarray  # (C, T) int64
    lengths: np.ndarray  # (L,) int64
    kept: list[Kept]  # what the addresses point into


def shape_of(model: Model, known: dict[int, tuple[Any, ...]] | None = None) -> ModelShape:
    """What a model must have in common with another to run beside it.

    `known` keeps the shapes of records, for models that have some in common.
    """
    known = {} if known is None else known
    shapes, contacts = [], b""
    for name in RECORDS:
        record = getattr(model, name)
        if id(record) not in known:
            tables = [getattr(record, table) for table in SHARED] if name == "table" else []
            known[id(record)] = (
                tuple(getattr(value, "shape", ()) for value in record),
                b"".join(np.asarray(table, dtype=float).tobytes() for table in tables),
            )
        own_shapes, own_contacts = known[id(record)]
        shapes.append(own_shapes)
        contacts += own_contacts
    return ModelShape(model.options, tuple(shapes), contacts)


def by_shape(models: Sequence[Model]) -> list[np.ndarray]:
    """Places of the models of each shape; a record that many have in common is examined once."""
    known: dict[int, tuple[Any, ...]] = {}
    groups: dict[ModelShape, list[int]] = {}
    for place, model in enumerate(models):
        groups.setdefault(shape_of(model, known), []).append(place)
    return [np.array(places) for places in groups.values()]


def pack(models: Sequence[Model]) -> Packed:
    """Rows of models of one shape; tables stay where they are."""
    shape = shape_of(models[0])
    fields, lengths = _fields(models[0], shape)
    kept: dict[int, Kept] = {}
    rows: dict[int, tuple[Any, list[float], list[int]]] = {}
    numbers, addresses = [], []
    for model in models:
        numbers.append([])
        addresses.append([])
        for name, group in zip(RECORDS, fields, strict=True):
            record = getattr(model, name)
            if id(record) not in rows:
                rows[id(record)] = (record, *_row(record, group, kept))
            numbers[-1] += rows[id(record)][1]
            addresses[-1] += rows[id(record)][2]
    where, shapes = np.array(addresses, dtype=np.int64), np.array(lengths, dtype=np.int64)
    return Packed(shape, fields, np.array(numbers), where, shapes, list(kept.values()))


def _fields(model: Model, shape: ModelShape) -> tuple[tuple[tuple[Field, ...], ...], list[int]]:
    fields, lengths = [], []
    number = address = 0
    for name, shapes in zip(RECORDS, shape.shapes, strict=True):
        group = []
        for field, axes in zip(getattr(model, name)._fields, shapes, strict=True):
            row = address if axes else number
            group.append(Field(field, len(axes), row, len(lengths), field in SHARED))
            number += not axes
            address += bool(axes)
            lengths += axes
        fields.append(tuple(group))
    return tuple(fields), lengths


def _row(record: Any, fields: tuple[Field, ...], kept: dict[int, Kept]) -> tuple[list[float], list[int]]:
    """Numbers and addresses of one record; a table that several records share is kept once."""
    numbers, addresses = [], []
    for value, field in zip(record, fields, strict=True):
        if not field.ndim:
            numbers.append(float(value))
            continue
        if id(value) not in kept:
            array = np.ascontiguousarray(value, dtype=np.float64)
            kept[id(value)] = Kept(value, array, array.ctypes.data)
        addresses.append(kept[id(value)].address)
    return numbers, addresses


def lane_model(packed: Packed) -> tuple[Model, np.ndarray, np.ndarray]:
    """A model over the lanes, and its numbers (F, WIDTH) and addresses (T, WIDTH), all of the first case."""
    numbers, addresses = _over_lanes(packed.numbers[0]), _over_lanes(packed.addresses[0])
    records: list[Any] = [LaneRecord(group, numbers, addresses, packed.lengths) for group in packed.fields]
    return Model(**dict(zip(RECORDS, records, strict=True)), options=packed.shape.options), numbers, addresses


class LaneBatch(NamedTuple):
    """Cases whose models have one shape, in the order of the queue, and their places in the ensemble."""

    places: Int[Array, " case"]
    packed: Packed
    queue: Queue


def in_lanes(
    models: Sequence[Model],
    states: Float[Array, "case state"],
    march: March,
    workers: int,
    progress: Callable[[float], None] | None = None,
) -> Ensemble:
    """Integrate with the explicit method, many cases side by side in the lanes of vectors."""
    batches = [_batch(models, states, march, places) for places in by_shape(models)]
    whole = len(models) * march.cycles
    with ThreadPoolExecutor(workers) as pool:
        try:
            running = {
                pool.submit(_work, batch, march)
                for batch in batches
                for _ in range(min(workers, -(-len(batch.places) // WIDTH)))
            }
            while running:
                done, running = wait(running, timeout=INTERVAL if progress else None)
                for job in done:
                    job.result()
                if progress and whole:
                    progress(sum(int(batch.queue.done[0]) for batch in batches) / whole)
        finally:
            for batch in batches:
                batch.queue.stop[0] = 1
            pool.shutdown(cancel_futures=True)
    result = nothing_yet(states, march.window * march.samples, march.extremes)
    for batch in batches:
        put(result, batch.places, batch.queue.result)
    return result


def _batch(
    models: Sequence[Model], states: Float[Array, "case state"], march: March, places: Int[Array, " case"]
) -> LaneBatch:
    """Cases of one shape, those of low speed first, which take the most steps.

    Lanes side by side then cost about the same.
    """
    speeds = [float(models[case].mechanics.nominal_speed) for case in places]
    places = places[np.argsort(speeds, kind="stable")]
    mine = [models[case] for case in places]
    packed = pack(mine)
    result = nothing_yet(states[places], march.window * march.samples, march.extremes)
    counters = (np.zeros(1, dtype=np.int64) for _ in range(3))
    atol, stops = tolerances_of_many(mine, states[places], march.rtol), stops_of_many(mine)
    return LaneBatch(places, packed, Queue(packed.numbers, packed.addresses, atol, stops, result, *counters))


def _work(batch: LaneBatch, march: March) -> None:
    """Work through a queue, until it is empty, in lanes of this thread's own."""
    model, numbers, addresses = lane_model(batch.packed)
    pairs = batch.packed.shape.pairs
    measures, state, extremes = Search.begun(pairs)
    search = Search(_over_lanes(measures), _over_lanes(state), Extremes(*map(_over_lanes, extremes)))
    y, atol = np.zeros((STATES, WIDTH)), np.zeros((STATES, WIDTH))
    work, rows = np.zeros((QUANTITIES + pairs, pairs, WIDTH)), np.zeros((ROWS, WIDTH))
    rows[CASE] = -1.0
    block = LaneBlock(numbers, addresses, rows, y, atol, _over_lanes(dopri5.buffer()), work, search)
    march_lanes(model, block, batch.queue, march)


def _over_lanes(values: np.ndarray) -> np.ndarray:
    """The values in every lane: with the lanes as last axis."""
    return np.repeat(values[..., None], WIDTH, axis=-1)
