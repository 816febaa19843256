"""From a scenario's name or path to a `Case`, and the registries that give names in TOML their meaning."""

import hashlib
import math
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, Union

import tomli_w
from pydantic import Field, TypeAdapter, ValidationError

from tribodyn.backlash_oscillator.case import BacklashOscillatorCase
from tribodyn.case import Case
from tribodyn.efficiency.case import EfficiencyCase
from tribodyn.errors import InputError
from tribodyn.load_contact_case import LoadContactCase
from tribodyn.rolling.case import RollingCase
from tribodyn.scenario.backlash_oscillator import BacklashOscillatorScenario, backlash_oscillator_case_of
from tribodyn.scenario.efficiency import EfficiencyScenario, efficiency_case_of
from tribodyn.scenario.kinds import KINDS, table_of
from tribodyn.scenario.load_contact import LoadContactScenario, load_contact_case_of
from tribodyn.scenario.messages import InputErrors, Origins, explain
from tribodyn.scenario.resolve import Resolved, resolve, unresolved_keys
from tribodyn.scenario.rolling import RollingScenario, rolling_case_of
from tribodyn.scenario.rules import OfGears, broken_rules
from tribodyn.scenario.schema import Scenario
from tribodyn.scenario.shape import shape_errors
from tribodyn.scenario.sources import find_scenario, near_name, quoted
from tribodyn.scenario.to_case import case_of
from tribodyn.tribology.friction import BENEDICT_KELLEY, COULOMB, MASJEDI_KHONSARI, NONE, XU
from tribodyn.tribology.mean_friction import MeanConditions, iso_14179_1, niemann

if TYPE_CHECKING:
    from tribodyn.geometry.family import Family


AnyCase = Case | RollingCase | EfficiencyCase | LoadContactCase | BacklashOscillatorCase
"""A case of any kind of scenario."""


class FrictionLaw(NamedTuple):
    """What a friction law's name in TOML stands for.

    Parameters
    ----------
    code : int
        The law's code in `tribodyn.tribology.friction`.
    about : str
        What it is, in a line.
    coefficient : bool
        Whether the scenario gives a friction coefficient.
    asperity_log_factor : float
        Factor inside the logarithm of the asperity load ratio; 4470 in Masjedi & Khonsari (2012).
    limiting_share : float
        1: the limiting shear stress follows the pressure carried by the fluid; 0: the whole mean pressure.
    heat_capacity : bool
        Whether the Péclet numbers contain ρ_s c_p of the solids, as they must to be numbers.
    lubricant_heat : bool
        Whether the density in them is the lubricant's.
    peclet_sliding : float
        1: the speed in them is the sliding speed; 0: each surface's own.
    viscosity_pressure_factor : float
        Pressure in Roelands' law over the mean pressure of the contact.
    mean : callable, optional
        Gives the friction coefficient of the whole mesh, which then is a Coulomb contact.
    """

    code: int
    about: str
    coefficient: bool = False
    asperity_log_factor: float = 4470.0
    limiting_share: float = 1.0
    heat_capacity: bool = True
    lubricant_heat: bool = False
    peclet_sliding: float = 0.0
    viscosity_pressure_factor: float = 1.0
    mean: Callable[[MeanConditions], Any] | None = None


FRICTION_LAWS = {
    "none": FrictionLaw(NONE, "frictionless flanks; the film is still reported"),
    "coulomb": FrictionLaw(COULOMB, "a constant coefficient, friction.coefficient", coefficient=True),
    "masjedi-khonsari": FrictionLaw(
        MASJEDI_KHONSARI, "mixed elastohydrodynamic line contact, Masjedi & Khonsari (2012, 2015)"
    ),
    "masjedi-khonsari-mean-pressure": FrictionLaw(
        MASJEDI_KHONSARI,
        "the same, limiting shear stress from the whole mean pressure instead of the fluid's share",
        limiting_share=0.0,
    ),
    "masjedi-khonsari-as-printed": FrictionLaw(
        MASJEDI_KHONSARI,
        "the same with Liu & Ni's misprints: 447 for 4470, Péclet numbers without ρ c_p",
        asperity_log_factor=447.0,
        heat_capacity=False,
    ),
    "masjedi-khonsari-veciana": FrictionLaw(
        MASJEDI_KHONSARI,
        "the same as Veciana et al. print it: Péclet numbers of sliding speed and lubricant density",
        lubricant_heat=True,
        peclet_sliding=1.0,
    ),
    "masjedi-khonsari-veciana-peak": FrictionLaw(
        MASJEDI_KHONSARI,
        "the reading that meets Veciana's crossover: Roelands' law at the greatest pressure, "
        "each surface's own speed and the lubricant's density in the Péclet numbers",
        lubricant_heat=True,
        viscosity_pressure_factor=4.0 / math.pi,
    ),
    "xu": FrictionLaw(XU, "regression over thermal EHL solutions for oil 75W90, Xu (2005)"),
    "benedict-kelley": FrictionLaw(
        BENEDICT_KELLEY, "disc tests in mixed lubrication, Benedict & Kelley (1961)"
    ),
    "niemann": FrictionLaw(
        COULOMB, "mean coefficient of the mesh by Niemann, as in ISO/TR 14179-2", mean=niemann
    ),
    "iso-14179-1": FrictionLaw(COULOMB, "mean coefficient of the mesh by ISO/TR 14179-1", mean=iso_14179_1),
}

FAMILIES = {
    "involute": "standard or profile-shifted involute; pressure_angle is the rack's",
    "crc": "constant relative curvature (Liu & Ni); pressure_angle is the one at the pitch point",
    "cycloidal": "epi- and hypocycloids; shape.approach_circle, recess_circle: diameters of the generating "
    "circles",
    "parabolic": "parabolic path of contact (Jia et al.); shape.k1 of the recess, k2 of the approach",
    "s-gear": "rack with a power-law flank; shape.form_factor, exponent",
    "points": "a path of contact of your own; pressure_angle at the pitch point, shape.points: CSV with x, y",
    "circular-arc": "path of two circular arcs; pressure_angle at the pitch point, shape.approach_diameter, "
    "recess_diameter",
}

SOLVERS = {
    "auto": "explicit or stiff by an estimate; the record says which and why",
    "dopri5": "Dormand-Prince 5(4), native kernel",
    "tsit5": "Tsitouras 5(4), diffrax",
    "dopri8": "Dormand-Prince 8(7), diffrax",
    "kvaerno5": "Kvaerno 5(4), implicit, diffrax",
    "rodas4": "Rodas4P 4(3), Rosenbrock, native",
    "radau": "Radau IIA 5, implicit, SciPy",
    "bdf": "backward differentiation, implicit, SciPy",
    "lsoda": "Adams/BDF with switching, SciPy",
    "dop853": "Dormand-Prince 8(5,3), SciPy",
}


def friction_law(name: str) -> FrictionLaw:
    """Return what a friction law's name stands for."""
    _known("friction.law", name, FRICTION_LAWS, "friction law")
    return FRICTION_LAWS[name]


def family(name: str) -> "Family":
    """Return the family of paths of contact of that name."""
    _known("drive.family", name, FAMILIES, "family of paths of contact")
    return import_module(f"tribodyn.geometry.{name.replace('-', '_')}").FAMILY


def solver(name: str) -> str:
    """Return the solver's name if there is one of that name."""
    _known("solver.method", name, SOLVERS, "solver")
    return name


def _known(key: str, name: str, registry: Mapping[str, Any], what: str) -> None:
    if name not in registry:
        near = near_name(name, registry)
        mean = f'did you mean "{near}"? ' if near else ""
        raise InputError(key, quoted(name), f"no such {what}", f"{mean}there is: {', '.join(registry)}")


class Loaded(NamedTuple):
    """A case, the file it was read from, and where each of its values stands."""

    case: AnyCase
    path: Path
    origins: Origins

    @contextmanager
    def naming(self) -> Iterator[None]:
        """Put the file into the errors that the physics raises inside the block."""
        with self.origins.naming():
            yield


def load_scenario(scenario: str | Path, overrides: Mapping[str, Any] | None = None) -> AnyCase:
    """Read a scenario.

    Parameters
    ----------
    scenario : str or Path
        Path of a scenario file, or the name of a shipped one: "crc-23-47".
    overrides : mapping, optional
        Dotted key to value, ``{"operating.gear_torque": "600 N*m"}``; keys reach through references.

    Raises
    ------
    InputError
        Anything that is wrong with it; `InputErrors`, one a line, where there is more than one mistake.
    """
    return load(scenario, overrides).case


def load(scenario: str | Path, overrides: Mapping[str, Any] | None = None) -> Loaded:
    """Read a scenario as `load_scenario` does, and say where its values stand."""
    path = find_scenario(str(scenario))
    return loaded_from(resolve(path, overrides or {}), path)


def loaded_from(resolved: Resolved, path: Path) -> Loaded:
    """Return the case of a scenario whose references and overrides have been put in; raises as `load` does.

    Parameters
    ----------
    resolved : Resolved
        Its data may have been changed since; it is not changed here but for a missing name.
    path : Path
        The scenario's file.
    """
    data, origins, unresolved = resolved
    data.setdefault("name", re.sub(r"[^\w .-]", "-", path.stem).lstrip(" .-") or "scenario")
    model, kind = table_of(data), data.get("kind")
    try:
        if isinstance(kind, str):
            _known("kind", kind, KINDS, "kind of scenario")
        table = model.model_validate(data)
    except InputError as error:
        raise origins.locate(error) from None
    except ValidationError as error:
        # a reference that could not be followed has been complained of already
        known = unresolved_keys(unresolved)
        found = [one for one in explain(error, model) if one.key not in known]
        raise _located([*unresolved, *found], origins) from None
    if unresolved:  # of a key whose value only its family knows to be a file
        raise _located(unresolved, origins)
    toml = tomli_w.dumps(data)
    digest = hashlib.sha256(toml.encode()).hexdigest()
    if isinstance(table, RollingScenario):
        return Loaded(rolling_case_of(table, toml, digest), path, origins)
    if isinstance(table, BacklashOscillatorScenario):
        return Loaded(backlash_oscillator_case_of(table, toml, digest), path, origins)
    assert isinstance(table, OfGears)
    errors = broken_rules(table) + _unknown_names(table) + _coefficient(table)
    if table.drive.family in FAMILIES:
        errors += shape_errors(table.drive, family(table.drive.family))
    if errors:
        raise _located(errors, origins)
    return Loaded(_case_of(table, toml, digest), path, origins)


def _case_of(table: OfGears, toml: str, digest: str) -> AnyCase:
    if isinstance(table, EfficiencyScenario):
        return efficiency_case_of(table, toml, digest)
    if isinstance(table, LoadContactScenario):
        return load_contact_case_of(table, toml, digest)
    return case_of(table, toml, digest)


def _located(errors: list[InputError], origins: Origins) -> InputError:
    located = [origins.locate(error) for error in errors]
    return InputErrors(located) if len(located) > 1 else located[0]


def _unknown_names(table: OfGears) -> list[InputError]:
    errors = []
    lookups: list[tuple[Callable[[str], Any], str]] = [(family, table.drive.family)]
    if not isinstance(table, LoadContactScenario):
        lookups.append((friction_law, table.friction.law))
    if isinstance(table, Scenario):
        lookups.append((solver, table.solver.method))
    for lookup, name in lookups:
        try:
            lookup(name)
        except InputError as error:
            errors.append(error)
    return errors


def _coefficient(table: OfGears) -> list[InputError]:
    if isinstance(table, LoadContactScenario):
        return []
    friction = table.friction
    law = FRICTION_LAWS.get(friction.law)
    if law is None or law.coefficient == (friction.coefficient is not None):
        return []
    key = "friction.coefficient"
    if law.coefficient:
        rule = f'missing: law = "{friction.law}" needs it'
        return [InputError(key, rule=rule, remedy="add coefficient = 0.05")]
    rule = f'contradicts law = "{friction.law}", which needs none'
    return [InputError(key, friction.coefficient, rule, "leave coefficient out")]


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of a scenario file, the registries' names included."""
    kinds: Any = Annotated[Union[tuple(KINDS.values())], Field(discriminator="kind")]  # noqa: UP007
    schema = {"title": "Scenario", **TypeAdapter(kinds).json_schema()}
    parts = schema["$defs"]
    for table, key, known in (
        ("DriveTable", "family", FAMILIES),
        ("Friction", "law", FRICTION_LAWS),
        ("EfficiencyFriction", "law", FRICTION_LAWS),
        ("Solver", "method", SOLVERS),
    ):
        parts[table]["properties"][key]["enum"] = list(known)
    return schema
