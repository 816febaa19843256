"""Quantities of a case as a differentiable function of some of its numbers: what a search calls.

    function = Differentiable(case, schema, ["efficiency", "contact_ratio"], ["drive.shape.angles.3"])
    values, slopes = function.jacobian(function.at)

One compiled program serves all cases that differ in numbers alone; it is kept in the cache folder.
"""

import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
import tomli_w
from pydantic import BaseModel

from tribodyn.derivatives.numbers import Number, numbers_of
from tribodyn.derivatives.quantities import ALSO, QUANTITIES, Fixed, PairEvaluation, quantity_of
from tribodyn.errors import InputError, near_name, quoted
from tribodyn.geometry.limits.limits import beyond
from tribodyn.input.names import named_in
from tribodyn.input.vary import is_whole
from tribodyn.mesh.by_compliance import in_slices
from tribodyn.mesh.slices.fine import fine_layout
from tribodyn.mesh.slices.helical import most_touching
from tribodyn.mesh.tabulate import pair_slots
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.closure import laws_of

#: XLA takes a fraction of the time to make a program that it hardly optimises; it runs in milliseconds.
_HARDLY_OPTIMISED = {"xla_backend_optimization_level": 0}
#: Tables of a scenario on which no quasi-static quantity depends.
_OF_NO_INFLUENCE = ("title", "name", "output", "solver", "bearings")
#: One quantity by more keys than this is differentiated backwards: in a time that does not depend on their
#: number, by a program that takes longer to make.
FORWARDS = 6
#: Keys by which several quantities are differentiated at once.
_TOGETHER = 8


class Differentiable:
    """Quantities of a case as a function of some of its numbers.

    Parameters
    ----------
    case : of a gear pair, `CaseHead.pair`; its gears need not exist
    schema : of its scenario: ``study_of(table).table()``
    of : names of `QUANTITIES` or `ALSO`; one program evaluates all together
    wrt : dotted keys of `numbers_of`; entries of lists by their index from 0, ``drive.shape.angles.3``

    Raises
    ------
    InputError
        For an unknown quantity or key, and a quantity that this case does not have.

    Attributes
    ----------
    of, wrt : names of the quantities, and keys
    about : what the quantities are
    parts : the case of the pair, and the name, that each quantity is worked out of
    at : the numbers of the case, SI
    units, key_units : SI units of quantities and keys
    """

    def __init__(self, case: Any, schema: type[BaseModel], of: Sequence[str], wrt: Sequence[str]) -> None:
        case, self.of, self.wrt = case.pair, tuple(of), tuple(wrt)
        self._case, self._names = case, tuple(ALSO.get(name, name) for name in of)
        self._quantities = [quantity_of(case, name) for name in of]
        self._numbers = numbers_of(case, schema, self.wrt.__contains__)
        keys = known_keys(self.wrt, self._numbers, schema)
        self.about = tuple(quantity.about for quantity in self._quantities)
        self.parts = tuple((case, name) for name in self.of)
        self.units = tuple(quantity.unit for quantity in self._quantities)
        self.key_units = tuple(self._numbers[key].unit for key in keys)
        self.at = np.array([float(self._numbers[key].value) for key in keys])
        self._all = np.array([float(number.value) for number in self._numbers.values()])
        self._places = np.array([list(self._numbers).index(key) for key in keys])

    def values(self, x: Float[Array, " key"]) -> Float[Array, " value"]:
        """Quantities where the keys have the values x (SI); NaN where there is no such mesh."""
        return self._finite(self._run("values", self._values(x)))[0]

    def jacobian(self, x: Float[Array, " key"]) -> tuple[Float[Array, " value"], Float[Array, "value key"]]:
        """Quantities, and their derivatives by the keys, SI, where the keys have the values x.

        Beyond the limits of existence quantities of the mesh may be NaN; distances from the limits never are.
        """
        values = self._values(x)
        keys = len(self.wrt)
        if len(self.of) == 1 and keys > FORWARDS:
            quantities, slopes = self._run("backwards", values)
            return self._finite((quantities, slopes[None, self._places]))
        # one program for any number of keys: one key at a time, or some together
        together = _TOGETHER if keys > 1 and len(self.of) > 1 else 1
        directions = np.zeros((-(-keys // together) * together, len(values)))
        directions[np.arange(keys), self._places] = 1.0
        parts = [
            self._run("forwards", values, directions[first : first + together])
            for first in range(0, len(directions), together)
        ]
        return self._finite((parts[0][0], np.concatenate([part[1] for part in parts], axis=1)[:, :keys]))

    def gradient(self, x: Float[Array, " key"]) -> tuple[float, Float[Array, " key"]]:
        """The first quantity and its derivatives by the keys, SI."""
        values, slopes = self.jacobian(x)
        return float(values[0]), slopes[0]

    def _values(self, x: Any) -> Float[Array, " number"]:
        values = self._all.copy()
        values[self._places] = x
        return values

    def _run(self, how: str, values: Any, *more: Any) -> Any:
        import jax

        from tribodyn.numerics.files.cache import use_compilation_cache

        use_compilation_cache()
        meshes = any("mesh" in quantity.needs for quantity in self._quantities)
        fixed = fixed_of(_put(self._case, self._numbers, values)) if meshes else Fixed(0, False)
        program = _program(self._structure, self._names, fixed)
        with jax.enable_x64(True):
            return jax.tree.map(np.array, program[how](values, *more))

    @cached_property
    def _structure(self) -> "_Structure":
        laws = laws_of(self._case) if hasattr(self._case, "film") and hasattr(self._case, "friction") else ()
        text = _without(self._case, self._numbers)
        return _Structure(text, tuple(self._numbers), laws, self._case, self._numbers)

    def _finite(self, result: Any) -> Any:
        """Distances that do not exist are a whole module, or one, beyond the limit, and of no slope."""
        values, slopes = result if isinstance(result, tuple) else (result, None)
        for place, quantity in enumerate(self._quantities):
            if quantity.limit and not np.isfinite(values[place]):
                values[place] = beyond(quantity.unit, self._case.drive)
            if quantity.limit and slopes is not None:
                slopes[place] = np.where(np.isfinite(slopes[place]), slopes[place], 0.0)
        return values, slopes


def fixed_of(case: Any) -> Fixed:
    """What the programs of a case's mesh depend on beside its numbers."""
    gears = PairEvaluation(case, Fixed(0, False)).gears
    with np.errstate(all="ignore"):
        ratio = float(gears.contact_ratio)
        pairs = pair_slots(gears) if np.isfinite(ratio) and ratio > 0.0 else 1
        vanishing, layout, parts = bool(float(gears.path.pressure_angle(0.0)) < 1e-9), None, 1
        if gears.drive.helix_angle and np.isfinite(ratio) and ratio > 0.0:
            mesh = in_slices(gears, case.materials, case.mesh, case.operating.gear_torque)
            layout, parts = fine_layout(gears, mesh, case.operating.gear_torque)
            layout = layout._replace(nodes=0, touching=most_touching(gears, layout))  # `mean_nodes`
        return Fixed(pairs, vanishing, layout, parts)


def known_keys(keys: Sequence[str], numbers: Mapping[str, Any], schema: type[BaseModel]) -> tuple[str, ...]:
    """Keys by which quantities are to be differentiated, by the names of the numbers that there are.

    Refuses those by which nothing can be differentiated, and none at all; `schema` is of the scenario.
    """
    there = "; there is: " + ", ".join(numbers)
    if not keys:
        raise InputError("wrt", None, "nothing to differentiate by", "name at least one key" + there)
    found = tuple(named_in(numbers, key) for key in keys)
    for key in found:
        if key in numbers:
            continue
        if is_whole(schema, key):
            rule = "is a whole number, by which nothing can be differentiated"
            raise InputError("wrt", quoted(key), rule, f"vary it: td.sweep(…, {quoted(key + '=…')})")
        rule, near = "no key to differentiate by", near_name(str(key), numbers)
        mean = f'did you mean "{near}"?' if near else "use another"
        raise InputError("wrt", quoted(str(key)), rule, mean + there)
    return found


@dataclass(frozen=True)
class _Structure:
    """A case, equal to all others that differ in their numbers alone."""

    text: str
    keys: tuple[str, ...]  # of its numbers
    laws: tuple[Any, ...]  # of film and friction: "auto" takes them by the numbers
    case: Any = field(compare=False)
    numbers: Mapping[str, Number] = field(compare=False)


def _without(case: Any, numbers: Mapping[str, Number]) -> str:
    """The scenario without the numbers, and without what has no influence."""
    table = tomllib.loads(case.toml)
    for name in _OF_NO_INFLUENCE:
        table.pop(name, None)
    for key in numbers:
        *above, last = key.split(".")
        place: Any = table
        for part in above:
            place = place[int(part)] if isinstance(place, list) else place.get(part, {})
        if isinstance(place, list):
            place[int(last)] = ""
        else:
            place.pop(last, None)
    return tomli_w.dumps(table)


def _put(case: Any, numbers: Mapping[str, Number], values: Any) -> Any:
    for number, value in zip(numbers.values(), values, strict=True):
        case = number.put(case, value)
    return case


@lru_cache(maxsize=8)  # 0.1 to 2 GB each
def _program(structure: _Structure, of: tuple[str, ...], fixed: Fixed) -> dict[str, Callable[..., Any]]:
    """Compiled functions of all numbers of a case, by name."""
    import jax
    import jax.numpy as jnp

    def quantities(values: Any) -> Any:
        at = PairEvaluation(_put(structure.case, structure.numbers, list(values)), fixed)
        return jnp.stack([QUANTITIES[name].function(at) for name in of])

    def forwards(values: Any, directions: Any) -> Any:
        along = jax.vmap(lambda direction: jax.jvp(quantities, (values,), (direction,)), out_axes=(None, 1))
        return along(directions)

    def backwards(values: Any) -> Any:
        value, slopes = jax.value_and_grad(lambda x: quantities(x)[0])(values)
        return value[None], slopes

    functions = {"values": quantities, "forwards": forwards, "backwards": backwards}
    return {how: jax.jit(function, compiler_options=_HARDLY_OPTIMISED) for how, function in functions.items()}
