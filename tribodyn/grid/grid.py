"""The grid of a sweep: from a place on the axes to a case."""

import copy
import itertools
import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

from tribodyn.errors import InputError, InputErrors, quoted
from tribodyn.input.names import key_in, same_key
from tribodyn.input.resolve import OVERRIDES, Resolved, resolve
from tribodyn.input.sources import find_scenario, read_toml
from tribodyn.input.vary import NO_TABLE, VARY, Axis, axes_of, in_si, is_whole
from tribodyn.studies import study_of
from tribodyn.studies.protocol.batch import Batch, SignalRequest
from tribodyn.studies.protocol.evaluated import OneByOne
from tribodyn.studies.protocol.load import loaded_from, put_chosen, table_of

#: Cases that are looked at for their structure: of several varied keys together, else of each by itself.
MOST_STRUCTURES = 64


class Grid:
    """A scenario's file, or the name of a shipped one, and the axes along which it is varied.

    `vary` are ``KEY=VALUES``, see `scenario.vary`; `overrides` are for all cases. Raises InputError if the
    scenario, an axis, or a value at the end of an axis cannot be used.
    """

    def __init__(self, scenario: str, vary: list[str], overrides: Mapping[str, Any]) -> None:
        self.path = find_scenario(scenario)
        self.overrides = dict(overrides)
        written = read_toml(self.path)
        self.study = study_of(written | ({"kind": overrides["kind"]} if "kind" in overrides else {}))
        self.axes: Sequence[Axis] = axes_of(vary, self.study.table())
        for axis in self.axes:
            if same_key(axis.key) in map(same_key, self.overrides):
                raise InputError("--set", axis.key, f"is varied too, with {VARY}", "give it once")
        # texts may name files, which have to be read before anything inside them is set
        self._texts = [i for i, axis in enumerate(self.axes) if not axis.numeric]
        self._resolved = lru_cache(maxsize=16)(self._resolve)
        self.batch: Batch = self.study.batch() or OneByOne(self.study)
        self._check()
        self.base = self.case((0,) * len(self.axes))

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values along each axis."""
        return tuple(len(axis.values) for axis in self.axes)

    @property
    def name(self) -> str:
        """Name of the scenario, which names the record."""
        return self.base.name

    def hearing(self, request: SignalRequest) -> "Grid":
        """The same, whose cases give the signals of their sensors; InputError where they have none."""
        grid = copy.copy(self)
        grid.batch = self.batch.hearing(request)
        return grid

    def data(self, place: Sequence[int]) -> dict[str, Any]:
        """The scenario's tables at a place of the grid."""
        return self._at(place)[0]

    def _at(self, place: Sequence[int]) -> tuple[dict[str, Any], Resolved]:
        kept = self._resolved(tuple(place[i] for i in self._texts))
        data = copy.deepcopy(kept.data)
        for axis, index in zip(self.axes, place, strict=True):
            if axis.numeric:
                _put(data, axis.key, axis.written[index])
            elif axis.picks:
                data[axis.key] = _picked(data, axis, axis.written[index])
        return data, kept

    def case(self, place: Sequence[int]) -> Any:
        """Return the case at a place of the grid; InputError where its values contradict each other."""
        data, kept = self._at(place)
        varied = [axis.key for axis in self.axes]
        put_chosen(data, self.chosen, [*varied, "film.law"] if "friction.law" in varied else varied)
        try:
            case = loaded_from(Resolved(data, kept.origins, kept.errors), self.path).case
        except InputError as error:
            raise self._as_varied(error) from None
        return case

    @cached_property
    def chosen(self) -> dict[str, tuple[str, str]]:
        """What the scenario without its axes leaves open; nothing where it is no case without them."""
        try:
            return loaded_from(resolve(self.path, self.overrides, table_of), self.path).case.chosen()
        except InputError:
            return {}

    def with_values(self, values: Sequence[float]) -> "Grid":
        """The same with other values of the first axis, SI, those it has among them and its ends the same."""
        axis = self.axes[0]
        texts = dict(zip(axis.values, axis.written, strict=True))
        written = tuple(texts[value] if value in texts else in_si(value, axis.units) for value in values)
        finer = copy.copy(self)
        finer.axes = (axis._replace(values=tuple(values), written=written), *self.axes[1:])
        return finer

    def changes_what_is_shared(self, axis: int) -> bool:
        """Whether cases at the ends of an axis share less than cases elsewhere on it."""
        place = [0] * len(self.axes)
        last = place.copy()
        last[axis] = len(self.axes[axis].values) - 1
        return self.batch.sharing(self.case(place)) != self.batch.sharing(self.case(last))

    def _resolve(self, chosen: tuple[int, ...]) -> Resolved:
        texts = {
            self.axes[i].key: self.axes[i].written[index]
            for i, index in zip(self._texts, chosen, strict=True)
            if not self.axes[i].picks
        }
        # numbers too, so that the tables that they stand in are there
        numbers = {axis.key: axis.written[0] for axis in self.axes if axis.numeric}
        try:
            return resolve(self.path, self.overrides | texts | numbers, table_of)
        except InputError as error:
            raise self._as_varied(error) from None

    def _check(self) -> None:
        """Read the ends of every numeric axis and every text: what is in between is as good as they are."""
        for i, axis in enumerate(self.axes):
            places = (0, len(axis.values) - 1) if axis.numeric else range(len(axis.values))
            for index in places:
                place = [0] * len(self.axes)
                place[i] = index
                self.case(place)

    def _as_varied(self, error: InputError) -> InputError:
        """Name `--vary` as the origin of what an axis put into the scenario."""
        if isinstance(error, InputErrors):
            return InputErrors([self._as_varied(each) for each in error.errors])
        varied = same_key(error.key) in [same_key(axis.key) for axis in self.axes]
        if error.file not in ("", OVERRIDES) or not varied:
            return error
        return InputError(error.key, error.value, error.rule, error.remedy, VARY)

    def structures(self) -> list[Any]:
        """Cases that may differ in structure: at the ends, and at varied texts, tables and whole numbers."""
        found = self.ends()
        if not self.batch.states:
            return found
        shown = [range(1)] * len(self.axes)
        for i, axis in enumerate(self.axes):
            if not axis.numeric or (is_whole(self.study.table(), axis.key) and not axis.drawn):
                shown[i] = range(len(axis.values))
        if math.prod(map(len, shown)) > MOST_STRUCTURES:
            few = [range(0, len(every), -(-len(every) // MOST_STRUCTURES)) for every in shown]
            places = [
                tuple(index if i == axis else 0 for i in range(len(shown)))
                for axis, every in enumerate(few)
                for index in every
            ]
        else:
            places = list(itertools.product(*shown))
        for place in places[1:]:
            with suppress(InputError):  # such a case fails by itself
                found.append(self.case(place))
        return found

    def ends(self) -> list[Any]:
        """Cases at the first and the last values of all axes."""
        return [self.case(place) for place in ((0,) * len(self.shape), tuple(n - 1 for n in self.shape))]


def _put(data: dict[str, Any], key: str, value: Any) -> None:
    place: Any = data
    *above, last = key_in(data, key)
    try:
        for part in above:
            place = place[part if isinstance(place, list) else str(part)]
        place[last if isinstance(place, list) else str(last)] = value
    except (IndexError, KeyError, TypeError):
        rule = "stands in a table that not all cases have"
        remedy = "vary it in a sweep of its own, where no other key picks tables"
        raise InputError(key, quoted(value), rule, remedy, VARY) from None


def _picked(data: Mapping[str, Any], axis: Axis, value: str) -> list[Any]:
    """Of a list of tables the one of a number, or none."""
    tables = data.get(axis.key, [])
    if value == NO_TABLE:
        return []
    numbers = [str(number) for number in range(1, len(tables) + 1)]
    if value not in numbers:
        rule = f"there {'is' if len(tables) == 1 else 'are'} {len(tables) or 'no'} [[{axis.key}]]"
        raise InputError(axis.key, quoted(value), rule, f"number them from 1, or write {NO_TABLE}", VARY)
    return [tables[numbers.index(value)]]


def default_output(grid: Grid) -> Path:
    """Return the record's name: the scenario's, and what is varied."""
    return Path(f"{grid.name}-{'-'.join(axis.name for axis in grid.axes)}.h5")
