"""What a film law and a friction law are, both as a model uses them, and what a case says of them.

A law's functions are pure functions of scalars, marked `numerics.elementary.law`, so that the same lines
run on floats, on arrays, under JAX and in the native kernels, which are compiled for the laws in use. A law
may call other functions only if they are marked in the same way.
"""

from collections import namedtuple
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any, ClassVar, Literal, NamedTuple, Self

from tribodyn.errors import InputError, near_name, quoted
from tribodyn.geometry.drive import MaterialData
from tribodyn.numerics.elementary import LAWS, absolute, law
from tribodyn.numerics.parameter import Parameter
from tribodyn.tribology.contact import (
    Asperities,
    DutyRange,
    NominalConditions,
    Surfaces,
    flash_temperature_rise,
    hertz_half_width,
    without_duty,
)
from tribodyn.tribology.oil import LubricantData

#: Stands for the law nearest to the solved contact whose range holds at the duty, see `choice`.
AUTO = "auto"


class JudgedRange(NamedTuple):
    """What the solved contact says of a law, over oils, surfaces, duties of gears (docs/ehl.md, Ranges)."""

    #: lowest and highest ratio of the law's value to the solved one at which it is called right
    right: tuple[float, float]
    #: that ratio at 5, 50 and 95 % of the sampled contacts inside the judged limits; where there are none,
    #: inside the range of the law's authors
    ratio: tuple[float, float, float]
    #: how many of the law's limits follow from the comparison, the last ones: where these hold, nine of ten
    #: contacts are right; 0: no such limits were found
    limits: int = 0
    #: that ratio of the contacts outside; None: no sampled contact was
    outside: tuple[float, float, float] | None = None

    def in_words(self, limits: tuple[str, ...]) -> str:
        """The range of a law with these limits."""
        if self.limits:
            low, high = self.right
            where = ", ".join(limits[-self.limits :])
            return f"by the solved contact: {where} ({low:g} to {high:g} times it)"
        low, _, high = self.ratio
        return f"no range by the solved contact: {low:.2g} to {high:.2g} times it"


class LawInput(NamedTuple):
    """What a law may make its parameters of, beside the values of its own keys."""

    surfaces: Surfaces
    lubricant: LubricantData
    materials: tuple[MaterialData, MaterialData]  # of pinion and gear
    #: () -> NominalConditions at the pitch point; raises InputError where they have no meaning
    nominal: Callable[[], NominalConditions]
    #: () -> DutyRange of the mesh; raises InputError where there is no mesh
    duty: Callable[[], DutyRange] = without_duty
    asperities: Asperities = Asperities()


class FilmFunctions(NamedTuple):
    """What kernels and models hold of a film law; see `FilmLaw`."""

    film: Callable[..., Any]
    in_range: Callable[..., Any]


class FrictionFunctions(NamedTuple):
    """What kernels and models hold of a friction law; see `FrictionLaw`."""

    coefficient: Callable[..., Any]
    flash_temperature: Callable[..., Any]
    in_range: Callable[..., Any]


class ActiveLaw(NamedTuple):
    """A film or friction law in use: its functions and the parameters that they read."""

    functions: Any
    parameters: Any


class Closure(NamedTuple):
    """What closes the equations at a contact: its surfaces, and film and friction law in use."""

    surfaces: Surfaces
    film: ActiveLaw
    friction: ActiveLaw


@law
def film_at(film, contact, surfaces):
    """Evaluate the film law in use: ln of the smooth film (m), roughness factor, asperity load share.

    What a friction law calls that needs the film; one that does not call it pays nothing for it.
    """
    return film.functions.film(contact, surfaces, film.parameters)


@law
def film_range_not_stated(contact, surfaces, parameters):
    """NaN: the film law states no range of validity."""
    return float("nan") + 0.0 * contact.line_load


@law
def range_not_stated(contact, film, surfaces, parameters):
    """NaN: the friction law states no range of validity."""
    return float("nan") + 0.0 * contact.line_load


@law
def heat_of_friction(contact, film, surfaces, parameters, coefficient):
    """Flash temperature rise, K, of the heat μ |v_s| p that friction makes."""
    half_width = hertz_half_width(contact.line_load, contact.curvature, surfaces.effective_modulus)
    pressure = contact.line_load / (2.0 * half_width)
    heat_flux = coefficient * absolute(contact.sliding) * pressure
    return flash_temperature_rise(heat_flux, half_width, contact.pinion_speed, contact.gear_speed, surfaces)


@cache
def _values_type(names: tuple[str, ...]) -> Any:
    """Type of the parameters of a law that has no other than its own keys; one type for equal names."""
    return namedtuple("Values", names)


def values_of(values: Mapping[str, Any]) -> Any:
    """The parameters of a law that has no other than its own keys."""
    return _values_type(tuple(values))(**values)


@dataclass(frozen=True, eq=False)
class KeyedLaw:
    """What laws have in common that a scenario chooses by name, with keys of their own."""

    table: ClassVar[str]  # the scenario's table that names the law and holds its keys
    name: str  # as scenarios give it
    about: str  # what it is, in a line
    function: Callable[..., Any]  # the law itself; see the kind of law
    #: (given: LawInput, **values of the keys in SI units) -> NamedTuple of floats that the functions read;
    #: default: the values of the keys, by name
    parameters: Callable[..., Any] | None = None
    keys: tuple[Parameter, ...] = ()  # keys of its own in the scenario's table
    #: gives for each of `limits` the share allowed over actual, or actual over the least that is allowed: at
    #: least 1 inside, below 1 outside. A law without `limits` gives one number: 1.0 inside its range of
    #: validity, 0.0 outside, NaN where none is stated.
    in_range: Callable[..., Any] = range_not_stated
    #: the range of validity of the law's authors in words, with its source; "" where none is stated
    range: str = ""
    #: the limits of the range one by one, such as "U ≤ 1e-10", in the order of `in_range`: those of the law's
    #: authors, then those by the solved contact
    limits: tuple[str, ...] = ()
    #: of a law that is tabulated before a run: (parameters) -> share by which 95 % of the values of its table
    #: deviate at most from what they stand for
    table_error: Callable[[Any], float] | None = None
    #: of such a law: (parameters) -> lowest and highest factor on its values that what it estimates makes
    table_band: Callable[[Any], tuple[float, float]] | None = None
    #: what the solved contact says of the law; None: it was not compared
    judged: JudgedRange | None = None

    @property
    def stated(self) -> str:
        """The range in words, of the authors, then by the solved contact; "" where none is stated."""
        judged = self.judged.in_words(self.limits) if self.judged is not None else ""
        return "; ".join(text for text in (self.range, judged) if text)

    @property
    def named_limits(self) -> tuple[str, ...]:
        """The limits; those by the solved contact end with "(judged)"."""
        unjudged = len(self.limits) - (self.judged.limits if self.judged is not None else 0)
        return (*self.limits[:unjudged], *(f"{limit} (judged)" for limit in self.limits[unjudged:]))

    def __post_init__(self) -> None:
        for function in self.functions:
            if not any(function is builtin for builtin in LAWS):
                law(function)

    @property
    def functions(self) -> Any:
        """The functions that kernels and models hold."""
        raise NotImplementedError

    def made(self, inputs: Any, values: dict[str, Any]) -> Any:
        """Make the parameters; keys without a value take their default; `inputs` as `parameters` takes it.

        Raises InputError if a value is unknown or missing, or has no meaning under these conditions.
        """
        defaults = {key.name: key.default for key in self.keys}
        for name, value in values.items():
            if name not in defaults:
                near = near_name(name, defaults)
                remedy = f'did you mean "{near}"?' if near else f"its keys: {', '.join(defaults) or 'none'}"
                raise InputError(
                    f"{self.table}.{name}", quoted(value), f'no key of law "{self.name}"', remedy
                )
        full = defaults | values
        for key in self.keys:
            if full[key.name] is None:
                rule = f'missing: law = "{self.name}" needs it'
                raise InputError(f"{self.table}.{key.name}", None, rule, f"give it: {key.about}")
        if self.parameters is not None:
            return self.parameters(inputs, **full)
        return values_of(full)

    def with_values(self, **values: float) -> Self:
        """Return the law with other values of its keys, in SI units, where none are given."""
        names = [key.name for key in self.keys]
        if unknown := [name for name in values if name not in names]:
            raise TypeError(
                f"law {self.name} has no key {unknown[0]}; its keys: {', '.join(names) or 'none'}"
            )
        keys = tuple(key._replace(default=values.get(key.name, key.default)) for key in self.keys)
        return replace(self, keys=keys)


@dataclass(frozen=True, eq=False)
class FilmLaw(KeyedLaw):
    """A law of film thickness: a plain object, chosen by ``[film] law`` or handed over from Python.

    `function` is (contact: LocalContact, surfaces: Surfaces, parameters) -> (ln of the film of smooth
    surfaces in m, factor by which roughness raises it, share of the load that asperities carry, 0 … 1); a law
    of smooth surfaces returns 1.0 and 0.0 for the last two. `in_range` takes the same arguments.
    """

    table: ClassVar[str] = "film"
    in_range: Callable[..., Any] = film_range_not_stated
    thickness: Literal["central", "minimum"] = "central"  # which thickness of the film it gives

    @property
    def functions(self) -> FilmFunctions:
        """The functions that kernels and models hold."""
        return FilmFunctions(self.function, self.in_range)


@dataclass(frozen=True, eq=False)
class FrictionLaw(KeyedLaw):
    """A law of friction: a plain object, chosen by ``[friction] law`` or handed over from Python.

    `function` is (contact: LocalContact, film: ActiveLaw, surfaces: Surfaces, parameters) -> friction
    coefficient ≥ 0; it evaluates the film, where it needs one, with `film_at`. `in_range` takes the same.
    """

    table: ClassVar[str] = "friction"
    #: (contact, film, surfaces, parameters, coefficient) -> temperature rise, K; default: of the heat that
    #: the coefficient makes
    flash_temperature: Callable[..., Any] = heat_of_friction
    film: str = "masjedi-khonsari"  # name of the film law that goes with it where the scenario names none
    #: whether the coefficient depends on the film; else the film law is the nearest at the duty (`choice`)
    reads_film: bool = True

    @property
    def functions(self) -> FrictionFunctions:
        """The functions that kernels and models hold."""
        return FrictionFunctions(self.function, self.flash_temperature, self.in_range)


@dataclass(frozen=True)
class FilmData:
    """Which film law holds between the flanks."""

    #: its name in `tribodyn.tribology.film.FILM_LAWS`, or the law itself; None: the one that goes with the
    #: friction law
    law: str | FilmLaw | None = None
    #: values of the law's own keys, by name, in SI units
    values: Mapping[str, Any] = field(default_factory=dict)
    chosen: str = ""  # why, where the scenario says "auto"
    #: least, mean, greatest ratio to the contact solved at the duty, where "auto" chose by that
    ratio: tuple[float, float, float] | None = None


@dataclass(frozen=True)
class FrictionData:
    """Which friction law acts between the flanks."""

    law: str | FrictionLaw  # its name in `tribodyn.tribology.friction.FRICTION_LAWS`, or the law itself
    #: values of the law's own keys, by name, in SI units
    values: Mapping[str, Any] = field(default_factory=dict)
    chosen: str = ""  # why, where the scenario says "auto"
    #: least, mean, greatest ratio to the contact solved at the duty, where "auto" chose by that
    ratio: tuple[float, float, float] | None = None
    #: sliding speed from the nominal rotation, or from the bodies as they move, vibration included
    sliding: Literal["kinematic", "dynamic"] = "dynamic"
    #: distance along the path of contact over which friction changes sign at the pitch point, m
    reversal_width: float = 2e-5
    #: speeds along the flanks with the motion of the contact along its path, or angular speed times lever arm
    rolling_speeds: Literal["exact", "lever-arms"] = "exact"

    @property
    def lever_arms(self) -> bool:
        """Whether rolling speeds leave out the motion of the contact along its path."""
        return self.rolling_speeds == "lever-arms"
