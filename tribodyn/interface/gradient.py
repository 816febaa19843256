"""Derivatives of a gear pair's figures by the numbers of its scenario, through JAX."""

import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from html import escape
from typing import Any

import numpy as np
import tomli_w

from tribodyn.errors import InputError, near_name, quoted, unknown_name
from tribodyn.geometry.checks import check
from tribodyn.geometry.families import family
from tribodyn.interface import shown
from tribodyn.interface.numbers import Number, numbers_of
from tribodyn.interface.quantities import QUANTITIES, Fixed, Quantity
from tribodyn.interface.scenario import Source, scenario
from tribodyn.interface.words import in_python
from tribodyn.mesh.tabulate import pair_slots
from tribodyn.studies import study_of
from tribodyn.tribology.closure import closure_of

#: XLA takes a fraction of the time to make a program that it hardly optimises; it runs in milliseconds.
_HARDLY_OPTIMISED = {"xla_backend_optimization_level": 0}
#: Tables of a scenario on which no quasi-static figure depends.
_OF_NO_INFLUENCE = ("title", "name", "output", "solver", "bearings")


@dataclass(frozen=True)
class Gradient:
    """A figure and its derivatives; `gradient` makes one.

    Attributes
    ----------
    of : str
        Name of the figure.
    about, unit : str
        What it is, and its SI unit.
    value : float
        SI.
    gradient : dict
        Key to derivative, SI: the figure's unit over the key's.
    at : dict
        Key to the value that it has in the scenario, SI.
    units : dict
        Key to its SI unit.
    """

    of: str
    about: str
    unit: str
    value: float
    gradient: dict[str, float]
    at: dict[str, float]
    units: dict[str, str]

    def __getitem__(self, key: str) -> float:
        return self.gradient[key]

    @property
    def sensitivity(self) -> dict[str, float]:
        """Key to x/f df/dx: by how many per cent the figure changes where the key's value grows by one.

        0 for a value of 0, which has no per cent.
        """
        return {key: self.at[key] * slope / self.value for key, slope in self.gradient.items()}

    def __repr__(self) -> str:
        slopes = ", ".join(f"d/d {key} = {slope:.6g}" for key, slope in self.gradient.items())
        return f"<tribodyn gradient: {self.of} = {_with_unit(self.value, self.unit)}; {slopes}>"

    def _repr_html_(self) -> str:
        head = "<tr><th>key</th><th>value</th><th>derivative</th><th>change for 1 % more</th></tr>"
        rows = []
        for key, slope in self.gradient.items():
            over = f"{self.unit} per {self.units[key]}" if self.units[key] != "1" else self.unit
            cells = (
                key,
                _with_unit(self.at[key], self.units[key]),
                _with_unit(slope, over),
                f"{self.sensitivity[key]:+.3g} %" if self.at[key] else "–",
            )
            rows.append("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>")
        title = f"{escape(self.about)}: <b>{escape(_with_unit(self.value, self.unit))}</b>"
        return shown.block(f"<p>{title}</p><table>{head}{''.join(rows)}</table>")


def _with_unit(value: float, unit: str) -> str:
    return f"{value:.6g}" if unit == "1" else f"{value:.6g} {unit}"


@in_python()
def gradient(
    source: Source, of: str, wrt: str | Sequence[str], overrides: Mapping[str, Any] | None = None
) -> Gradient:
    """Differentiate a figure of a gear pair by numbers of its scenario, exactly, through JAX.

    Parameters
    ----------
    source, overrides
        As `scenario` takes them; any scenario of a gear pair with the tables that the figure needs.
    of : str
        "contact_ratio", "centre_distance", "pressure_angle", "equivalent_radius", "hertz_pressure",
        "mean_stiffness", "stiffness_swing", "transmission_error_swing", "loss_factor", "efficiency",
        "friction_power". All are quasi-static, of elastic load sharing.
    wrt : str or sequence of str
        Dotted keys of real numbers: geometry (``"drive.module"``, ``"drive.pinion.addendum"``,
        ``"drive.shape.…"``), materials, roughness, lubricant, speed and torque, keys of the laws.

    Returns
    -------
    Gradient
        Value and derivatives in SI units.

    Raises
    ------
    InputError
        For a figure or a key that cannot be differentiated, with those that can; and as `scenario`.

    Notes
    -----
    The first gradient of a figure and a tooth family takes seconds to tens of seconds, in which XLA makes its
    program; that is kept in the cache folder, and the next ones take a fraction of a second. Where the
    set of pairs in contact is about to change, at a whole contact ratio, derivatives are one-sided.
    """
    keys = [wrt] if isinstance(wrt, str) else list(wrt)
    case = scenario(source, overrides)
    quantity, fixed = _checked(case, of)
    numbers = numbers_of(case)
    _check_keys(case, keys, numbers)
    value = float(quantity.function(case, fixed))
    slopes = _slopes(case, of, fixed, numbers, keys)
    return Gradient(
        of,
        quantity.about,
        quantity.unit,
        value,
        dict(zip(keys, slopes, strict=True)),
        {key: float(numbers[key].value) for key in keys},
        {key: numbers[key].unit for key in keys},
    )


def _checked(case: Any, of: str) -> tuple[Quantity, Fixed]:
    """The figure, and what is fixed about the gears; raises InputError where the case does not have it."""
    if of not in QUANTITIES:
        raise unknown_name("of", str(of), QUANTITIES, "figure that can be differentiated")
    quantity = QUANTITIES[of]
    if not study_of({"kind": case.kind}).has_gears:
        raise InputError(
            "kind", quoted(case.kind), "has no gear pair to differentiate", "use another scenario"
        )
    for table in quantity.needs:
        if not hasattr(case, table):
            rule = f"{of} depends on [{table}], which a scenario of this kind does not have"
            raise InputError("kind", quoted(case.kind), rule, "use a scenario that has it")
    if "mesh" in quantity.needs and case.mesh.at_load:
        rule = f"{of} cannot be differentiated with compliances by finite elements"
        remedy = 'use the energy method: overrides={"mesh.compliance": "energy"}'
        raise InputError("mesh.compliance", quoted(case.mesh.compliance), rule, remedy)
    if "operating" in quantity.needs and not case.operating.gear_torque:
        raise InputError("operating.gear_torque", 0, f"{of} is one of loaded teeth", "give a torque")
    gears = check(family(case.family), case.drive)
    vanishing = float(gears.path.pressure_angle(0.0)) < 1e-9
    if vanishing and quantity.at_pitch_point:
        rule = f"{of} has no meaning: curvature is infinite at the pitch point of this family"
        raise InputError("drive.family", quoted(case.family), rule, "differentiate another figure")
    if "friction" in quantity.needs:
        if (temperature := getattr(case, "temperature", None)) is not None:
            rule = f"{of} is differentiated at a temperature that does not move"
            remedy = 'overrides={"temperature.model": "oil"}, and operating.oil_temperature that of the teeth'
            raise InputError("temperature.model", quoted(temperature.model), rule, remedy)
        closure_of(case)  # raises where the laws do not fit
    return quantity, Fixed(pair_slots(gears), vanishing)


def _check_keys(case: Any, keys: Sequence[str], numbers: Mapping[str, Number]) -> None:
    there = "; there is: " + ", ".join(numbers)
    if not keys:
        raise InputError("wrt", None, "nothing to differentiate by", "name at least one key" + there)
    for key in keys:
        if key not in numbers:
            near = near_name(str(key), numbers)
            mean = f'did you mean "{near}"?' if near else "use another"
            raise InputError("wrt", quoted(str(key)), "no key to differentiate by", mean + there)


def _slopes(
    case: Any, of: str, fixed: Fixed, numbers: Mapping[str, Number], keys: Sequence[str]
) -> list[float]:
    """Directional derivatives along each key, by one program for all of them."""
    import jax

    from tribodyn.solve.diffrax_integrator import use_compilation_cache

    use_compilation_cache()
    program = _program(_Structure(_without(case, numbers), case), of, fixed, tuple(numbers))
    at = np.array([float(one.value) for one in numbers.values()])
    along = np.eye(len(at))
    names = list(numbers)
    with jax.enable_x64(True):
        return [float(program(at, along[names.index(key)])) for key in keys]


class _Structure:
    """A case, equal to all others that differ in their numbers alone."""

    def __init__(self, text: str, case: Any) -> None:
        self.text, self.case = text, case

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Structure) and self.text == other.text

    def __hash__(self) -> int:
        return hash(self.text)


def _without(case: Any, numbers: Mapping[str, Number]) -> str:
    """The scenario without the numbers, and without what has no influence."""
    table = tomllib.loads(case.toml)
    for name in _OF_NO_INFLUENCE:
        table.pop(name, None)
    for key in numbers:
        *above, last = key.split(".")
        place: Any = table
        for part in above:
            place = place.get(part, {})
        place.pop(last, None)
    return tomli_w.dumps(table)


@lru_cache(maxsize=32)
def _program(
    structure: _Structure, of: str, fixed: Fixed, keys: tuple[str, ...]
) -> Callable[[np.ndarray, np.ndarray], Any]:
    """(values of all keys, direction) -> derivative of the figure in that direction."""
    import jax

    case, function = structure.case, QUANTITIES[of].function
    numbers = numbers_of(case)

    def figure(values: Any) -> Any:
        traced = case
        for i, key in enumerate(keys):
            traced = numbers[key].put(traced, values[i])
        return function(traced, fixed)

    def along(values: Any, direction: Any) -> Any:
        return jax.jvp(figure, (values,), (direction,))[1]

    return jax.jit(along, compiler_options=_HARDLY_OPTIMISED)
