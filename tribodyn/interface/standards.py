"""Formulas of the standards by name and with units, ``td.standards``: made from `tribodyn.standards`.

``td.standards.pitting.contact_ratio_factor(1.46, 1.42)``. An argument is a number in SI units, a text with a
unit or a quantity of pint; results are in SI units, angles in rad, temperatures in K. Every function's text
has its standard, equation and range, and the units of its arguments.
"""

import collections.abc
import math
from functools import wraps
from importlib import import_module
from inspect import Parameter, cleandoc, isclass, isfunction, signature
from numbers import Real
from types import ModuleType
from typing import Any, Literal, NamedTuple, get_args, get_origin

import numpy as np

from tribodyn.compliance import iso6336
from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.units import Kind, to_si_at
from tribodyn.interface.scenario import in_toml
from tribodyn.standards.agma import RELIABILITY
from tribodyn.standards.micropitting import LUBRICATION_FACTORS
from tribodyn.standards.pitting import UNMODIFIED_FACTOR
from tribodyn.standards.rolling_bearings import CLEANLINESS, EXPONENTS


class _Formulas(NamedTuple):
    """A module of formulas."""

    standard: str
    inputs: str = ""  # structures that its functions take
    internal: str = ""  # functions that take the package's own objects
    module: str = ""  # below `tribodyn.standards`, where it has another name there


_PARTS = {
    "agma": _Formulas("AGMA 2101-D04 (2001-D04) and 908-B89", "AgmaPair"),
    "allowances": _Formulas("DIN 3967 and ISO 286, DIN 3964"),
    "bending": _Formulas("ISO 6336-3:2006 and :2019, method B", "RootSection BendingGear"),
    "contact_path": _Formulas("ISO/TR 15144-1:2014, clauses 8 to 11", "ContactPath"),
    "fatigue": _Formulas("ISO 6336-6:2019", "StressCurve Bin"),
    "flank_fracture": _Formulas(
        "ISO/TS 6336-4:2019, constants by printed exposures",
        "HardenedCase",
        module="case_hardening.flank_fracture",
    ),
    "flank_tolerances": _Formulas("ISO 1328-1:2013 and :1995"),
    "fzg": _Formulas("ISO 14635-1, ISO/TR 15144-1:2014 annex A, ISO/TS 6336-20 and -21:2017"),
    "load_factors": _Formulas("ISO 6336-1:2019", "FlankRunIn DynamicMesh"),
    "loss_factors": _Formulas("ISO/TR 14179-2:2001 (Ohlendorf, Niemann, Höhn), Wimmer"),
    "mesh_friction": _Formulas("ISO/TR 14179-1 and -2:2001; Schlenk; Fernandes", module="mesh_loss.friction"),
    "mesh_loss": _Formulas("ISO/TR 14179-1 and -2:2001", "LoadedMesh", module="mesh_loss.methods"),
    "metals": _Formulas("ISO 6336-5:2016", "Line Metal"),
    "micropitting": _Formulas("ISO/TS 6336-22:2018 (ISO/TR 15144-1:2014)", "Oil Flanks Load"),
    "pitting": _Formulas("ISO 6336-2:2006 and :2019, method B", "PittingMesh"),
    "rainflow": _Formulas("ASTM E1049-85, 5.4.4 and 5.4.5"),
    "rolling_bearings": _Formulas("ISO 281:2007 and ISO/TS 16281:2008"),
    "scuffing": _Formulas("ISO/TS 6336-20 and -21:2017 (ISO/TR 13989:2000)", "ScuffingMesh"),
    "stiffness": _Formulas(
        "ISO 6336-1:2019, clause 9, method B",
        "ReferencePair",
        "pair_of bodies_outside",
    ),
}
#: Kind of quantity -> the arguments that are of it; all others are plain numbers.
_ARGUMENTS = {
    units.LENGTH: (
        "arm ball_diameter before base_diameter base_radii base_radius case_depth centre_distance "
        "contact_length depth depths deviation diameter distance face_width half_width mean_diameter "
        "mean_roughness middle_diameter "
        "misalignment missing_relief module most normal_module notch_radius pinion_diameter pitch_deviation "
        "pitch_diameter pitch_radius profile_deviation radius reference_diameter reduced_radius "
        "reference_radius roller_diameter roughness thickness tip_radius tip_radii tip_relief tolerance "
        "tooth_height transverse_module bending.BendingGear.rim scuffing.flash_approach.length"
    ),
    units.ANGLE_KIND: (
        "base_helix_angle contact_angle helix_angle load_angle normal_pressure_angle pressure_angle "
        "roll working working_angle load_factors.shared_load.limits"
    ),
    units.PRESSURE: (
        "allowable allowable_stress bending_limit contact_limit core_hardness course effective_modulus "
        "hardness high load_intensity low mesh_stiffness pressure reduced_modulus residual single_stiffness "
        "stiffness stress surface_hardness yield_strength youngs_modulus"
    ),
    units.FORCE: (
        "accurate_load axial base_force dynamic_rating loads normal_force radial static_rating "
        "tangential_load load"
    ),
    Kind("line load", "N/m", "300 N/mm"): "line_load",
    units.TORQUE: "pinion_torque",
    units.POWER: "power",
    units.ANGULAR_SPEED: (
        "pinion_speed rolling_bearings.running_time.speed rolling_bearings.reference_viscosity.speed"
    ),
    units.VELOCITY: "pitch_speed speed speed_sum speeds",
    units.TEMPERATURE_KIND: (
        "bulk contact_temperature integral oil_temperature scuffing scuffing_temperature temperatures"
    ),
    units.TEMPERATURE_DIFFERENCE: "mean_flash",
    units.VISCOSITY: "viscosity",
    units.KINEMATIC_VISCOSITY: "kinematic_viscosity viscosity_40",
    units.DENSITY: "density",
    units.PRESSURE_VISCOSITY: "pressure_viscosity",
    Kind("mass per length", "kg/m", "300 kg/m"): "mass reduced_mass",
    units.INERTIA: "inertias",
    Kind("thermal contact coefficient", "W*s**0.5/(m**2*K)", "13800 W*s**0.5/(m**2*K)"): "thermal_contact",
}
#: Arguments that have no unit here although those of the same name have one elsewhere.
_PLAIN = (
    "metals.Line.hardness",
    "micropitting.Load.tip_relief",
    "micropitting.mean_friction.roughness",
    "scuffing.ScuffingMesh.tip_relief",
)
_KINDS = {name: kind for kind, names in _ARGUMENTS.items() for name in names.split()}
#: Texts and numbers that some arguments are chosen from; the factor X_S has such a name and is a number.
_CHOICES: dict[str, tuple[Any, ...]] = {
    "cleanliness": tuple(CLEANLINESS),
    "edition": (2019, 2006),
    "kind": tuple(EXPONENTS),
    "lubrication": tuple(LUBRICATION_FACTORS),
    "reliability": tuple(RELIABILITY),
    "modification": tuple(UNMODIFIED_FACTOR),
}


def _kind(where: str) -> Kind | None:
    """Kind of quantity of an argument, ``part.function.argument``; None of plain numbers."""
    name = where.rsplit(".", 1)[1]
    return None if where in _PLAIN else _KINDS.get(where) or _KINDS.get(name)


def _number(where: str, value: Any) -> float:
    """A number in SI units."""
    kind, value = _kind(where), in_toml(value)
    if isinstance(value, str) and kind is not None:
        return to_si_at(where, value, kind)
    if not isinstance(value, Real) or isinstance(value, bool) or not math.isfinite(float(value)):
        due = f'a number in {kind.si} or a text such as "{kind.example}"' if kind else "a number"
        raise InputError(where, quoted(value), "is no finite number", f"give {due}")
    return float(value)


def _read(where: str, due: Any, value: Any) -> Any:
    """The value of an argument as its function's annotation has it."""
    origin, parts = get_origin(due), get_args(due)
    if due is float:
        return _number(where, value)
    if choices := _CHOICES.get(where.rsplit(".", 1)[1], parts if origin is Literal else ()):
        if value not in choices:
            rule = "is none of " + ", ".join(map(quoted, choices))
            raise InputError(where, quoted(value), rule, f"write {quoted(choices[0])}")
        return value
    if type(None) in parts:
        rest = [part for part in parts if part is not type(None)]
        return None if value is None else _read(where, rest[0] if len(rest) == 1 else Any, value)
    if due is int:
        number = _number(where, value)
        if number != int(number):
            raise InputError(where, quoted(value), "is no whole number", "write one")
        return int(number)
    if origin is collections.abc.Callable:
        if not callable(value):
            raise InputError(
                where, quoted(value), "is no function", "give a function of the temperature in K"
            )
        return value
    if due in (bool, str) or (isclass(due) and issubclass(due, tuple)):
        if not isinstance(value, due):
            name = due.__name__
            raise InputError(
                where,
                quoted(value),
                f"is no {name}",
                f"give one, see help(td.standards.{where.split('.')[0]})",
            )
        return value
    return _several(where, due, value)


def _several(where: str, due: Any, value: Any) -> Any:
    """Values of a pair, a sequence or an array; one number where an array may be one."""
    origin, parts = get_origin(due), get_args(due)
    if not isinstance(value, (list, tuple, np.ndarray)) and np.ndim(getattr(value, "magnitude", 0)) == 0:
        if due is Any:
            return _number(where, value)
        raise InputError(where, quoted(value), "is no list", "give its values in brackets")
    items = in_toml(value) if hasattr(value, "magnitude") else list(value)
    if origin is tuple:
        each = [parts[0]] * len(items) if parts[-1] is ... else list(parts)
        if len(items) != len(each):
            raise InputError(where, quoted(list(items)), f"has not {len(each)} values", "give as many")
        return tuple(_read(where, one, item) for one, item in zip(each, items, strict=True))
    structured = origin is collections.abc.Sequence and parts[0] is not float
    if structured:
        return [_read(where, parts[0], item) for item in items]
    return np.array([_number(where, item) for item in items])


def _is_number(value: Any) -> bool:
    """Whether a result, and all that it holds, is real: no NaN, no root of a negative number."""
    if isinstance(value, (tuple, list)):
        return all(map(_is_number, value))
    if isinstance(value, (complex, float, np.ndarray)):
        return not np.iscomplexobj(value) and not bool(np.any(np.isnan(value)))
    return True


def _with_units(
    part: str, standard: str, function: collections.abc.Callable[..., Any]
) -> collections.abc.Callable[..., Any]:
    """The function, with units of its arguments and one error for what it cannot be called with."""
    accepted, where = signature(function), f"{part}.{function.__name__}"
    units = [
        f"{name} ({kind.si})" if (kind := _kind(f"{where}.{name}")) else name for name in accepted.parameters
    ]

    @wraps(function, assigned=("__name__", "__qualname__"), updated=())
    def call(*values: Any, **keys: Any) -> Any:
        try:
            bound = accepted.bind(*values, **keys)
        except TypeError as error:
            raise InputError(where, None, str(error), f"it takes {', '.join(units)}") from None
        for name, value in bound.arguments.items():
            bound.arguments[name] = _read(f"{where}.{name}", accepted.parameters[name].annotation, value)
        try:
            result = function(*bound.args, **bound.kwargs)
        except (ArithmeticError, LookupError, TypeError, ValueError) as error:
            raise InputError(where, None, f"has no result for these arguments ({error})", "") from None
        if not _is_number(result):
            raise InputError(
                where, None, "has no real result for these arguments", f"see help(td.standards.{where})"
            )
        return result

    call.__doc__ = f"{cleandoc(function.__doc__ or '')}\n\n{standard}. Arguments: {', '.join(units)}."
    call.__module__ = f"td.standards.{part}"
    plain = [one.replace(annotation=Parameter.empty) for one in accepted.parameters.values()]
    call.__signature__ = accepted.replace(parameters=plain)  # pyright: ignore[reportAttributeAccessIssue]
    return call


def _part(name: str) -> ModuleType:
    """All formulas, input structures and tables of a module."""
    about = _PARTS[name]
    source = iso6336 if name == "stiffness" else import_module(f"tribodyn.standards.{about.module or name}")
    module = ModuleType(f"td.standards.{name}", source.__doc__)
    module.__all__ = []  # pyright: ignore[reportAttributeAccessIssue]
    for key, value in vars(source).items():
        if key.startswith("_") or key in about.internal.split():
            continue
        local = getattr(value, "__module__", None) == source.__name__
        if local and (isfunction(value) or key in about.inputs.split()):
            value = _with_units(name, about.standard, value)
        elif not key.isupper():
            continue
        setattr(module, key, value)
        module.__all__.append(key)
    return module


def __getattr__(name: str) -> Any:
    if name not in _PARTS:
        raise AttributeError(f"td.standards has no {name!r}; it has {', '.join(_PARTS)}")
    globals()[name] = _part(name)
    return globals()[name]


def __dir__() -> list[str]:
    return list(_PARTS)
