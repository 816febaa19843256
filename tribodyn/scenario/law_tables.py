"""The tables ``[film]`` and ``[friction]``: which laws hold between the flanks, and the laws' own keys."""

from typing import Any, ClassVar, Protocol

from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.numerics.registry import Registry
from tribodyn.scenario.own_keys import Owner, key_schema, own_key_errors, own_values
from tribodyn.scenario.quantity import Table, Text
from tribodyn.tribology.data import FilmData
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS


class LawTable(Table, extra="allow"):
    """A table that holds the own keys of the law it names, which only the law knows."""

    laws: ClassVar[Registry[Any]]

    @property
    def own(self) -> dict[str, Any]:
        """What stands in the table beside the keys that it always has."""
        return dict(self.model_extra or {})

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: Any) -> dict[str, Any]:
        """Put the names of the laws, and all their own keys, into the schema."""
        part = handler.resolve_ref_schema(handler(schema))
        names = part["properties"]["law"]
        choice = names["anyOf"][0] if "anyOf" in names else names
        choice["enum"] = list(cls.laws)
        for name, law in cls.laws.items():
            for key in law.keys:
                found = key_schema(key)
                found["description"] = f'of law = "{name}": {found["description"]}'
                part["properties"].setdefault(key.name, found)
        part["additionalProperties"] = False
        return part


class FilmTable(LawTable):
    """Which law gives the film between the flanks, and the law's own keys."""

    laws = FILM_LAWS

    law: Text | None = Field(None, description="default: the one that goes with the friction law")


class FrictionTable(LawTable):
    """Which law acts between the flanks, and the law's own keys."""

    laws = FRICTION_LAWS

    law: Text


class WithLaws(Protocol):
    """A scenario with both tables."""

    @property
    def film(self) -> FilmTable | None: ...  # noqa: D102
    @property
    def friction(self) -> FrictionTable: ...  # noqa: D102


def law_errors(scenario: WithLaws) -> list[InputError]:
    """Return what is wrong with the names of the laws and with their own keys."""
    errors = _errors("friction", scenario.friction, scenario.friction.law, FRICTION_LAWS)
    film = scenario.film
    if film is None:
        return errors
    law = film.law
    if law is None and scenario.friction.law in FRICTION_LAWS and film.own:
        law = FRICTION_LAWS[scenario.friction.law].film
    return errors + (_errors("film", film, law, FILM_LAWS) if law is not None else [])


def film_data(scenario: WithLaws) -> FilmData:
    """Return the choice of film law, its values in SI units."""
    film = scenario.film
    if film is None:
        return FilmData()
    name = film.law or FRICTION_LAWS[scenario.friction.law].film
    return FilmData(film.law, own_values(_owner("film", film, FILM_LAWS[name]), film.own))


def friction_values(table: FrictionTable) -> dict[str, float]:
    """Return the values of the friction law's own keys, in SI units."""
    return own_values(_owner("friction", table, FRICTION_LAWS[table.law]), table.own)


def _owner(table: str, given: LawTable, law: Any) -> Owner:
    return Owner(table, "law", law.keys, tuple(type(given).model_fields))


def _errors(table: str, given: LawTable, name: str, laws: Registry[Any]) -> list[InputError]:
    try:
        law = laws[name]
    except InputError as error:
        return [error]
    return [
        _said(error, table, name, law, laws) for error in own_key_errors(_owner(table, given, law), given.own)
    ]


def _said(error: InputError, table: str, name: str, law: Any, laws: Registry[Any]) -> InputError:
    """Say of a missing key that the law needs it, and of another law's key that this one has none."""
    key = error.key.removeprefix(f"{table}.")
    known = {one.name: one for one in law.keys}
    if error.rule.startswith("missing"):
        return InputError(
            error.key, None, f'missing: law = "{name}" needs it, {known[key].about}', error.remedy
        )
    others = [other for other, one in laws.items() if any(key == own.name for own in one.keys)]
    if key not in known and others:
        rule = f'contradicts law = "{name}", which has no such key; {", ".join(map(quoted, others))} has'
        return InputError(error.key, error.value, rule, f"leave {key} out")
    return error
