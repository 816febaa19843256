"""Cases packed by the shape of their models into queues, and threads that work through these in lanes.

Of a model numbers and addresses of tables are packed as rows, from which lanes are filled.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import Model, Options, with_shared_code
from tribodyn.dynamics.recorded.extremes import Extremes
from tribodyn.kernels.lanes.tables import Extent, Field, LaneRecord, SubRecord
from tribodyn.kernels.lanes.vectors import WIDTH
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.integrator import Ensemble, March, nothing_yet, put
from tribodyn.solve.lanes.march import march_lanes
from tribodyn.solve.lanes.queue import CASE, ROWS, LaneBlock, Queue
from tribodyn.solve.march.extreme_search import Search
from tribodyn.solve.march.reversal import stops_of_many
from tribodyn.solve.methods import dopri5
from tribodyn.solve.right_hand_side import work_array
from tribodyn.solve.tolerances import tolerances_of_many

#: Time between two reports of progress, s.
INTERVAL = 0.1
#: The model's parts of numbers and tables.
RECORDS = tuple(name for name in Model._fields if name != "options")
#: Tables that models of one shape have in common, value for value: branches may hang on them.
SHARED = ("side", "in_contact", "first", "segment", "opens", "driver_tooth", "driven_tooth")
#: Records whose tables are short, and stand among the numbers.
SHORT = ("Bodies", "Links", "Schedule")


class ModelShape(NamedTuple):
    """What must be the same in all lanes: the options, and the shape of every field."""

    options: Options
    shapes: tuple[Any, ...]  # of every part, nested as it is
    contacts: bytes  # all that is `SHARED`


class Kept(NamedTuple):
    """A table as it came, as contiguous floats, and where these are."""

    given: Any
    array: np.ndarray
    address: int


class Packed(NamedTuple):
    """Models of one shape."""

    shape: ModelShape
    fields: tuple[SubRecord, ...]
    numbers: np.ndarray  # (C, F) float64
    addresses: np.ndarray  # (C, T) int64
    lengths: np.ndarray  # (L,) int64
    kept: list[Kept]  # what the addresses point into


Known = dict[int, tuple[Any, ...]]
"""Records examined so far, by their identity, with what was found."""


def shape_of(model: Model, examined: Known | None = None) -> ModelShape:
    """What a model must have in common with another to run beside it.

    `examined` keeps the shapes of records, for models that have some in common.
    """
    examined = {} if examined is None else examined
    parts = [_shape_of(getattr(model, name), examined) for name in RECORDS]
    return ModelShape(model.options, tuple(part[0] for part in parts), b"".join(part[1] for part in parts))


def _shape_of(value: Any, examined: Known) -> tuple[Any, bytes]:
    """Shapes of a record, or of several, and the content of what is `SHARED`."""
    if not isinstance(value, tuple):
        return getattr(value, "shape", ()), b""
    if id(value) not in examined:
        parts = [_shape_of(item, examined) for item in value]
        names = getattr(value, "_fields", ())
        shared = [np.asarray(getattr(value, name), dtype=float).tobytes() for name in names if name in SHARED]
        contents = b"".join(part[1] for part in parts) + b"".join(shared)
        examined[id(value)] = (tuple(part[0] for part in parts), contents, value)
    return examined[id(value)][:2]


def by_shape(models: Sequence[Model]) -> list[np.ndarray]:
    """Places of the models of each shape; a record that many have in common is examined once."""
    examined: Known = {}
    groups: dict[ModelShape, list[int]] = {}
    for place, model in enumerate(models):
        groups.setdefault(shape_of(model, examined), []).append(place)
    return [np.array(places) for places in groups.values()]


def pack(models: Sequence[Model]) -> Packed:
    """Rows of models of one shape; tables stay where they are."""
    shape = shape_of(models[0])
    lengths: list[int] = []
    fields, at = [], Extent(0, 0, 0)
    for name in RECORDS:
        fields.append(_part(name, getattr(models[0], name), at, lengths))
        at = _after(fields[-1])
    kept: dict[int, Kept] = {}
    rows: Known = {}
    numbers, addresses = [], []
    for model in models:
        row = [_row(getattr(model, name), kept, rows) for name in RECORDS]
        numbers.append([number for part in row for number in part[0]])
        addresses.append([address for part in row for address in part[1]])
    where, shapes = np.array(addresses, dtype=np.int64), np.array(lengths, dtype=np.int64)
    return Packed(shape, tuple(fields), np.array(numbers), where, shapes, list(kept.values()))


def _after(part: SubRecord) -> Extent:
    """Where a part ends."""
    items = max(part.items, 1)
    return Extent(*(first + items * each for first, each in zip(part.first, part.size, strict=True)))


def _part(name: str, value: Any, first: Extent, lengths: list[int]) -> SubRecord:
    """The layout of a record, or of several, from a place on; `lengths` receives those of its tables."""
    if not hasattr(value, "_fields"):
        parts = [_part(name, item, first, lengths) for item in value]
        return parts[0]._replace(items=len(value))
    at = Extent(0, 0, 0)
    fields: list[Field | SubRecord] = []
    for field, item, inline in _in_order(value):
        if isinstance(item, tuple):
            part = _part(field, item, at, lengths)
            fields.append(part)
            at = _after(part)
            continue
        axes = np.shape(item)
        row = -1 if inline else at.addresses if axes else at.numbers
        fields.append(Field(field, len(axes), row, at.lengths, field in SHARED, inline))
        lengths += (*axes, at.numbers) if inline else axes
        at = Extent(
            at.numbers + (int(np.prod(axes)) if inline else not axes),
            at.addresses + (bool(axes) and not inline),
            at.lengths + len(axes) + inline,
        )
    return SubRecord(name, tuple(fields), first, at)


def _in_order(value: Any) -> list[tuple[str, Any, bool]]:
    """Fields of a record, or several records; whether they are short tables, which come last."""
    names = getattr(value, "_fields", [""] * len(value))
    short = type(value).__name__ in SHORT
    parts = [
        (name, item, short and not isinstance(item, tuple) and bool(np.ndim(item)) and name not in SHARED)
        for name, item in zip(names, value, strict=True)
    ]
    return sorted(parts, key=itemgetter(2))


def _row(value: Any, kept: dict[int, Kept], examined: Known) -> tuple[list[float], list[int]]:
    """Numbers and addresses of a record, or of several; a table that records share is kept once."""
    if id(value) in examined:
        return examined[id(value)][:2]
    numbers: list[float] = []
    addresses: list[int] = []
    for _, item, inline in _in_order(value):
        if isinstance(item, tuple):
            item_numbers, pointed = _row(item, kept, examined)
            numbers += item_numbers
            addresses += pointed
        elif not np.ndim(item):
            numbers.append(float(item))
        elif inline:
            numbers += np.ravel(item).tolist()
        else:
            if id(item) not in kept:
                array = np.ascontiguousarray(item, dtype=np.float64)
                kept[id(item)] = Kept(item, array, array.ctypes.data)
            addresses.append(kept[id(item)].address)
    examined[id(value)] = (numbers, addresses, value)
    return numbers, addresses


def lane_model(packed: Packed) -> tuple[Model, np.ndarray, np.ndarray]:
    """A model over the lanes, and its numbers (F, WIDTH) and addresses (T, WIDTH), all of the first case."""
    numbers, addresses = _over_lanes(packed.numbers[0]), _over_lanes(packed.addresses[0])
    records: dict[str, Any] = {
        part.name: LaneRecord(part, numbers, addresses, packed.lengths) for part in packed.fields
    }
    return Model(**records, options=packed.shape.options), numbers, addresses


class LaneBatch(NamedTuple):
    """Cases whose models have one shape, in the order of the queue, and their places in the ensemble."""

    places: Int[Array, " case"]
    model: Model  # the first one
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
    models = [with_shared_code(model) for model in models]
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
    result = nothing_yet(models[0].layout, states, march.window * march.samples, march.extremes)
    for batch in batches:
        put(result, batch.places, batch.queue.result)
    return result


def _batch(
    models: Sequence[Model], states: Float[Array, "case state"], march: March, places: Int[Array, " case"]
) -> LaneBatch:
    """Cases of one shape, those of low speed first, which take the most steps.

    Lanes side by side then cost about the same.
    """
    speeds = [float(models[case].operation.nominal_speed) for case in places]
    places = places[np.argsort(speeds, kind="stable")]
    mine = [models[case] for case in places]
    packed = pack(mine)
    result = nothing_yet(mine[0].layout, states[places], march.window * march.samples, march.extremes)
    counters = (np.zeros(1, dtype=np.int64) for _ in range(3))
    atol, stops = tolerances_of_many(mine, states[places], march.rtol), stops_of_many(mine)
    queue = Queue(packed.numbers, packed.addresses, atol, stops, result, *counters)
    return LaneBatch(places, mine[0], packed, queue)


def _work(batch: LaneBatch, march: March) -> None:
    """Work through a queue, until it is empty, in lanes of this thread's own."""
    model, numbers, addresses = lane_model(batch.packed)
    first_model = batch.model
    layout, pairs = first_model.layout, first_model.pairs
    measures, state, extremes = Search.begun(layout, pairs)
    search = Search(_over_lanes(measures), _over_lanes(state), Extremes(*map(_over_lanes, extremes)))
    y, atol = np.zeros((layout.states, WIDTH)), np.zeros((layout.states, WIDTH))
    work, rows = _over_lanes(work_array(first_model)), np.zeros((ROWS, WIDTH))
    rows[CASE] = -1.0
    block = LaneBlock(numbers, addresses, rows, y, atol, _over_lanes(dopri5.buffer(layout)), work, search)
    march_lanes(model, block, batch.queue, march)


def _over_lanes(values: np.ndarray) -> np.ndarray:
    """The values in every lane: with the lanes as last axis."""
    return np.repeat(values[..., None], WIDTH, axis=-1)
