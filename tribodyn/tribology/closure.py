"""From a case to the film and friction laws of its contacts, and the numbers that they read."""

import math
from dataclasses import replace
from functools import partial
from typing import Any, Protocol, TypeVar

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.geometry.drive import Drive, MaterialData
from tribodyn.geometry.path import kinematics
from tribodyn.numerics.elementary import as_float, is_jax, minimum, sense
from tribodyn.tribology.contact import DUTY_LOADS, Asperities, DutyRange, NominalConditions, Surfaces
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import (
    AUTO,
    ActiveLaw,
    Closure,
    FilmData,
    FilmLaw,
    FrictionData,
    FrictionLaw,
    LawInput,
)
from tribodyn.tribology.oil import LubricantData, lubricant_around
from tribodyn.tribology.surface_state import exceeded
from tribodyn.tribology.trial import try_laws

#: Pressure angle at the pitch point below which Niemann's formula has no meaning: radius and speed vanish.
MINIMUM_ANGLE = math.radians(1.0)
#: Speeds over the nominal ones that a table of contacts spans; beyond them, and beyond its loads, film and
#: friction are those at its end.
_SPEEDS = (0.8, 1.2)
#: Least entrainment and radius over the largest along the path, and least slide-to-roll ratio, of a table.
_LEAST_SHARE, LEAST_SLIDING = 0.1, 0.02
#: Names in a summary of the ratios to the solved contact outside the range of a law.
_OUTSIDE = ("low_outside", "median_outside", "high_outside")


class NominalDuty(Protocol):
    """Nominal speed of the pinion (rad/s) and constant torque on the gear (N m)."""

    @property
    def pinion_speed(self) -> float: ...  # noqa: D102
    @property
    def gear_torque(self) -> float: ...  # noqa: D102


class Lubricated(Protocol):
    """What a case must say of its contacts."""

    @property
    def family(self) -> str: ...  # noqa: D102
    @property
    def drive(self) -> Drive: ...  # noqa: D102
    @property
    def materials(self) -> tuple[MaterialData, MaterialData]: ...  # noqa: D102
    @property
    def roughness(self) -> float: ...  # noqa: D102
    @property
    def mean_roughness(self) -> float: ...  # noqa: D102
    @property
    def asperities(self) -> Asperities: ...  # noqa: D102
    @property
    def lubricant(self) -> LubricantData: ...  # noqa: D102
    @property
    def operating(self) -> NominalDuty: ...  # noqa: D102
    @property
    def film(self) -> FilmData: ...  # noqa: D102
    @property
    def friction(self) -> FrictionData: ...  # noqa: D102


CaseType = TypeVar("CaseType", bound=Lubricated)


def closure_of(case: Lubricated) -> Closure:
    """Return surfaces and laws of a case's contacts.

    Raises InputError if a law is not known, lacks a value, needs a mean over a mesh for which it has no
    meaning, or comes from outside this package and does not work (`trial.try_laws`).
    """
    film, friction = laws_of(case)
    closure = untried_closure_of(case)
    try_laws(film, friction, closure)
    return closure


def untried_closure_of(case: Lubricated) -> Closure:
    """As `closure_of`, of a case whose numbers may be traced, and whose laws have been tried."""
    film, friction = laws_of(case)
    return closure(law_input(case), film, friction, dict(case.film.values), dict(case.friction.values))


def law_input(case: Lubricated) -> LawInput:
    """Return what the laws of a case may make their parameters of."""
    nominal, duty = partial(nominal_conditions, case), partial(duty_range, case)
    return LawInput(surfaces_of(case), case.lubricant, case.materials, nominal, duty, case.asperities)


def closure(
    inputs: LawInput,
    film: FilmLaw,
    friction: FrictionLaw,
    film_values: dict[str, Any] | None = None,
    friction_values: dict[str, Any] | None = None,
) -> Closure:
    """Return surfaces and laws with the parameters that these make of what is given; raises as `made`."""
    return Closure(
        inputs.surfaces,
        ActiveLaw(film.functions, film.made(inputs, film_values or {})),
        ActiveLaw(friction.functions, friction.made(inputs, friction_values or {})),
    )


def is_open(case: Lubricated) -> bool:
    """Whether a law is to be chosen: "auto", or no film law with a friction law that reads no film."""
    friction, film = case.friction.law, case.film.law
    if AUTO in (friction, film):
        return True
    return film is None and isinstance(friction, str) and not FRICTION_LAWS[friction].reads_film


def laws_of(case: Lubricated) -> tuple[FilmLaw, FrictionLaw]:
    """Return the film and the friction law of a case; the film law that goes with it where none is chosen."""
    friction = case.friction.law
    if isinstance(friction, str):
        friction = FRICTION_LAWS[friction]
    film = case.film.law or friction.film
    return FILM_LAWS[film] if isinstance(film, str) else film, friction


def with_laws(
    case: CaseType, film: FilmLaw | str | None = None, friction: FrictionLaw | str | None = None
) -> CaseType:
    """Return the case with another film or friction law, as an object or by name.

    The values that the scenario gives for the keys of a law that is replaced are left out; a new law takes
    the defaults of its keys, or those of `FrictionLaw.with_values`. A film law that was chosen by the duty
    gives way to the one that a new friction law reads.
    """
    changed: dict[str, Any] = {}
    if film is not None:
        changed["film"] = FilmData(film)
    if friction is not None:
        law = FRICTION_LAWS[friction] if isinstance(friction, str) else friction
        if film is None and case.film.chosen and law.reads_film:
            changed["film"] = FilmData()
        changed["friction"] = replace(case.friction, law=friction, values={}, chosen="", ratio=None)
    return replace(case, **changed)  # pyright: ignore[reportArgumentType]  (cases are dataclasses)


def law_quantities(case: Lubricated) -> dict[str, Any]:
    """Names of the laws in use, their ranges and the errors of their tables, for a summary.

    `film_judged` and `friction_judged`: their ratios to the solved contact, where they were compared; with
    `at_duty` those at the contacts of the nominal duty, else those in nine of ten contacts of gears;
    `friction_band_low` and `_high`: factors on friction solved with an estimated viscosity.
    """
    film, friction = laws_of(case)
    chosen = {"film_chosen": case.film.chosen, "friction_chosen": case.friction.chosen}
    errors = {}
    for law in (film, friction):
        if law.table_error is not None:
            active: Any = getattr(untried_closure_of(case), law.table)
            errors[f"{law.table}_table_error"] = law.table_error(active.parameters)
            low, high = law.table_band(active.parameters) if law.table_band else (1.0, 1.0)
            if low < high:
                errors |= {f"{law.table}_band_low": low, f"{law.table}_band_high": high}
    return {
        **law_ratios(case),
        "film_thickness": film.thickness,
        "film_range": film.stated or "none stated",
        "friction_range": friction.stated or "none stated",
        **{name: why for name, why in chosen.items() if why},
        **errors,
    }


def law_ratios(case: Lubricated) -> dict[str, Any]:
    """Names of the laws in use and their ratios to the solved contact, where they were compared."""
    by_law: dict[str, Any] = {}
    for law, data in zip(laws_of(case), (case.film, case.friction), strict=True):
        by_law[f"{law.table}_law"] = law.name
        if data.ratio is not None:
            ratios = dict(zip(("low", "median", "high"), data.ratio, strict=True))
            by_law[f"{law.table}_judged"] = {**ratios, "at_duty": 1.0}
        elif law.judged is not None:
            ratios = dict(zip(("low", "median", "high"), law.judged.ratio, strict=True))
            outside = dict(zip(_OUTSIDE, law.judged.outside or (), strict=False))
            by_law[f"{law.table}_judged"] = {**ratios, **outside, "limits": law.judged.limits}
    return by_law


def exceeded_limits(
    case: Lubricated, closure_shares: Any, friction_shares: Any, loss: Any = None
) -> dict[str, Any]:
    """Which limits of the laws in use are exceeded, for a summary: `closure_exceeded`, `friction_exceeded`.

    The shares are (contacts, limits), see `surface_state.range_shares`, of loaded contacts, `loss` (contact,)
    the power that friction takes there. `film_outside` is the share of the contacts, `friction_outside` that
    of the loss, outside the limits by the solved contact, or its authors' of a law without such.
    """
    exceedances: dict[str, Any] = {}
    parts = (("closure", closure_shares, None), ("friction", friction_shares, loss))
    for law, (name, shares, weight) in zip(laws_of(case), parts, strict=True):
        if limits := exceeded(shares, law.named_limits):
            exceedances[f"{name}_exceeded"] = limits
        if law.limits and shares.shape[-1] == len(law.limits) and len(shares):
            judged = law.judged.limits if law.judged else 0
            outside = np.any(shares[:, -judged:] < 1.0, axis=1)
            weighed = weight if weight is not None and np.any(weight > 0.0) else None
            exceedances[f"{law.table}_outside"] = float(np.average(outside, weights=weighed))
    return exceedances


def surfaces_of(case: Lubricated) -> Surfaces:
    """Return the surfaces and the lubricant of a case, whatever its laws."""
    pinion, gear = case.materials
    compliance = [(1 - m.poisson_ratio**2) / m.youngs_modulus for m in case.materials]
    return Surfaces(
        effective_modulus=2.0 / sum(compliance),
        hardness=minimum(pinion.hardness, gear.hardness),
        roughness=case.roughness,
        mean_roughness=case.mean_roughness,
        inlet_viscosity=case.lubricant.inlet_viscosity,
        pressure_viscosity=case.lubricant.pressure_viscosity,
        pinion_conductivity=pinion.thermal_conductivity,
        gear_conductivity=gear.thermal_conductivity,
        pinion_heat_capacity=pinion.density * pinion.specific_heat,
        gear_heat_capacity=gear.density * gear.specific_heat,
    )


def without_nominal_conditions() -> NominalConditions:
    """Stand for nominal conditions where there is no mesh: raise InputError."""
    raise InputError(
        "friction.law", None, "is a mean over the mesh, and there is none", "use a law of the local contact"
    )


def duty_range(case: Lubricated) -> DutyRange:
    """Loads, speeds and curvatures that the contacts of a case meet at nominal speed and constant torque.

    Raises InputError without a torque: there is no load to tabulate for.
    """
    from tribodyn.geometry.assembly import assemble
    from tribodyn.geometry.families import family

    torque = abs(float(case.operating.gear_torque))
    speed = abs(float(case.operating.pinion_speed))
    if torque == 0.0 or speed == 0.0:
        raise InputError("film.law", '"solved"', "needs a torque and a speed to tabulate for", "give both")
    assembly = assemble(family(case.family), case.drive)
    start, end = assembly.limits
    motion = kinematics(assembly.path, np.linspace(start, end, 81))
    arm = np.min(np.abs(motion.gear_normal_arm))
    load = torque / float(arm) / float(assembly.common_width)
    entrainment = speed * np.abs(motion.entrainment)
    curvature = np.abs(motion.relative_curvature)
    # a cycloid's entrainment and radius vanish at the pitch point
    entrainment = np.maximum(entrainment, _LEAST_SHARE * np.max(entrainment))
    curvature = np.minimum(curvature, np.min(curvature) / _LEAST_SHARE)
    ratio = speed * np.abs(motion.sliding) / entrainment
    return DutyRange(
        (DUTY_LOADS[0] * load, DUTY_LOADS[1] * load),
        (_SPEEDS[0] * float(np.min(entrainment)), _SPEEDS[1] * float(np.max(entrainment))),
        (0.99 * float(np.min(curvature)), 1.01 * float(np.max(curvature))),
        (LEAST_SLIDING, max(1.05 * float(np.max(ratio)), 2.0 * LEAST_SLIDING)),
        tuple((float(u), float(c), float(s)) for u, c, s in zip(entrainment, curvature, ratio, strict=True)),
    )


def nominal_line_load(duty: DutyRange) -> float:
    """Return the load of a pair that carries the whole torque alone, N/m, from the range made for it."""
    return duty.line_load[1] / DUTY_LOADS[1]


def nominal_conditions(case: Lubricated) -> NominalConditions:
    """Conditions at the pitch point at nominal speed and constant torque, for a mean friction coefficient."""
    from tribodyn.geometry.families import family

    path = family(case.family).working_path(case.drive)
    angle, torque = path.pressure_angle(0.0), case.operating.gear_torque
    if (not is_jax(angle) and angle < MINIMUM_ANGLE) or (not is_jax(torque) and np.any(torque == 0.0)):
        law = case.friction.law
        name = quoted(law if isinstance(law, str) else law.name)
        rule = "is a mean over the mesh from radius, speed and load at the pitch point, which vanish here"
        remedy = "use a law of the local contact, such as masjedi-khonsari or xu"
        raise InputError("friction.law", name, rule, remedy)
    oil = lubricant_around(case.lubricant)
    return NominalConditions(
        as_float(abs(torque / path.gear_pitch_radius)),
        as_float(path.pinion_pitch_radius),
        as_float(path.gear_pitch_radius),
        as_float(angle),
        case.operating.pinion_speed * sense(path.pinion_pitch_radius),
        minimum(case.drive.pinion.face_width, case.drive.gear.face_width),
        oil.inlet_viscosity,
        oil.density,
        case.mean_roughness,
        oil.load_exponent,
        oil.lubricant_factor,
        oil.schlenk_factor,
    )
