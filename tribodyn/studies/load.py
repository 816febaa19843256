"""From a scenario's name or path to a `Case`, and the registries that give names in TOML their meaning."""

import hashlib
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, Union

import tomli_w
from pydantic import Field, TypeAdapter, ValidationError

from tribodyn.errors import InputError, InputErrors, require_known
from tribodyn.geometry.families import FAMILIES, family
from tribodyn.scenario.drive_rules import broken_drive_rules
from tribodyn.scenario.law_tables import FilmTable, add_law_schema
from tribodyn.scenario.messages import Origins, explain
from tribodyn.scenario.resolve import Resolved, resolve, unresolved_keys
from tribodyn.scenario.shape import shape_errors
from tribodyn.scenario.sources import find_scenario
from tribodyn.solve.methods import SOLVERS, solver
from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase
from tribodyn.studies.backlash_oscillator.scenario import (
    BacklashOscillatorScenario,
    backlash_oscillator_case_of,
)
from tribodyn.studies.efficiency.case import EfficiencyCase
from tribodyn.studies.efficiency.scenario import (
    EfficiencyFriction,
    EfficiencyScenario,
    broken_efficiency_rules,
    efficiency_case_of,
)
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gear_pair.rules import broken_rules
from tribodyn.studies.gear_pair.scenario import Friction, Scenario, case_of
from tribodyn.studies.kinds import KINDS, table_of
from tribodyn.studies.load_contact.case import LoadContactCase
from tribodyn.studies.load_contact.scenario import (
    LoadContactScenario,
    broken_load_contact_rules,
    load_contact_case_of,
)
from tribodyn.studies.rolling.case import RollingCase
from tribodyn.studies.rolling.scenario import RollingScenario, rolling_case_of
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS

if TYPE_CHECKING:
    pass


AnyCase = Case | RollingCase | EfficiencyCase | LoadContactCase | BacklashOscillatorCase
"""A case of any kind of scenario."""


OfGears = Scenario | EfficiencyScenario | LoadContactScenario


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
            require_known("kind", kind, KINDS, "kind of scenario")
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
    errors = _broken(table) + _unknown_names(table)
    if table.drive.family in FAMILIES:
        errors += shape_errors(table.drive, family(table.drive.family))
    if errors:
        raise _located(errors, origins)
    return Loaded(_case_of(table, toml, digest), path, origins)


def _broken(table: OfGears) -> list[InputError]:
    if isinstance(table, LoadContactScenario):
        return [*broken_drive_rules(table.drive), *broken_load_contact_rules(table)]
    if isinstance(table, EfficiencyScenario):
        return [*broken_drive_rules(table.drive), *broken_efficiency_rules(table)]
    return list(broken_rules(table))


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
    if isinstance(table, Scenario):
        lookups.append((solver, table.solver.method))
    for lookup, name in lookups:
        try:
            lookup(name)
        except InputError as error:
            errors.append(error)
    return errors


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of a scenario file, the registries' names included."""
    kinds: Any = Annotated[Union[tuple(KINDS.values())], Field(discriminator="kind")]  # noqa: UP007
    schema = {"title": "Scenario", **TypeAdapter(kinds).json_schema()}
    parts = schema["$defs"]
    for table, key, known in (
        ("DriveTable", "family", FAMILIES),
        ("Solver", "method", SOLVERS),
    ):
        parts[table]["properties"][key]["enum"] = list(known)
    add_law_schema(parts, FilmTable, FILM_LAWS)
    for friction in (Friction, EfficiencyFriction):
        add_law_schema(parts, friction, FRICTION_LAWS)
    return schema
