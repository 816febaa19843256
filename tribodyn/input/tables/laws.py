"""Tables that name a law and hold its own keys, such as ``[film]`` and ``[friction]`` between the flanks."""

from collections.abc import Iterator
from typing import Any, ClassVar, Self

from pydantic import ValidationError, model_validator
from pydantic_core import InitErrorDetails

from tribodyn.errors import InputError, quoted
from tribodyn.input.quantity import Table, Text, broken
from tribodyn.input.specific_keys import Owner, key_schema, own_key_errors, own_values
from tribodyn.numerics.registry import Registry
from tribodyn.train.links import LINK_LAWS
from tribodyn.train.links.law import LAW as LINEAR_LINK
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import AUTO, FilmData


class LawTable(Table, extra="allow"):
    """A table that holds the own keys of the law it names, which only the law knows."""

    place: ClassVar[str]  # where it stands, for messages
    laws: ClassVar[Registry[Any]]
    automatic: ClassVar[bool] = True  # whether "auto" chooses one
    law: Any  # its name

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
        choice["enum"] = [AUTO, *cls.laws] if cls.automatic else [*cls.laws]
        for name, law in cls.laws.items():
            for key in law.keys:
                schema_of_key = key_schema(key)
                schema_of_key["description"] = f'of law = "{name}": {schema_of_key["description"]}'
                part["properties"].setdefault(key.name, schema_of_key)
        part["additionalProperties"] = False
        return part

    @model_validator(mode="after")
    def known_law_and_keys(self) -> Self:
        """Check the law's name against the registry, and its own keys against the law."""
        errors = law_errors(self)
        if not errors:
            return self
        details = [
            InitErrorDetails(
                type=broken(error.rule, error.remedy),
                loc=tuple(error.key.split(".")[1:]),
                input=self.model_dump().get(error.key.split(".")[1]),
            )
            for error in errors
        ]
        raise ValidationError.from_exception_data(type(self).__name__, details)


class FilmTable(LawTable):
    """Which law gives the film between the flanks, and the law's own keys."""

    place = "film"
    laws = FILM_LAWS
    law: Text | None = None


class FrictionTable(LawTable):
    """Which law acts between the flanks, and the law's own keys."""

    place = "friction"
    laws = FRICTION_LAWS
    law: Text


class LinkTable(LawTable):
    """The law of a torsional link, and the law's own keys."""

    place = "link"
    laws = LINK_LAWS
    automatic = False
    law: Text = "linear"


def broken_link_law(key: str, table: Any) -> Iterator[InputError]:
    """Ask for the stiffness that the law of a link or of a shaft needs."""
    if table.law != LINEAR_LINK.name and not table.stiffness:
        rule = f"missing: law = {quoted(table.law)} needs it"
        yield InputError(f"{key}.stiffness", table.stiffness, rule, 'add stiffness = "1e5 N*m/rad"')


def law_errors(table: LawTable) -> list[InputError]:
    """Return what is wrong with the name of the law and with its own keys."""
    if table.law is None:
        rule = "is a key of a film law, and none is named"
        remedy = f"name it, such as law = {quoted(next(iter(table.laws)))}"
        values = table.own.items()
        return [InputError(f"{table.place}.{key}", quoted(value), rule, remedy) for key, value in values]
    if table.law == AUTO and table.automatic:
        rule, remedy = f'contradicts law = "{AUTO}", which takes none', "name the law whose key it is"
        values = table.own.items()
        return [InputError(f"{table.place}.{key}", quoted(value), rule, remedy) for key, value in values]
    try:
        law = table.laws[table.law]
    except InputError as error:
        return [error]
    errors = own_key_errors(_owner(table, law), table.own)
    return [_explained(error, table, law) for error in errors]


def _owner(table: LawTable, law: Any) -> Owner:
    return Owner(table.place, "law", law.keys, tuple(type(table).model_fields))


def _explained(error: InputError, table: LawTable, law: Any) -> InputError:
    """Say of a missing key that the law needs it, and of another law's key that this one has none."""
    key = error.key.removeprefix(f"{table.place}.")
    keys = {parameter.name: parameter for parameter in law.keys}
    if key not in table.own:
        rule = f'missing: law = "{law.name}" needs it, {keys[key].about}'
        return InputError(error.key, None, rule, error.remedy)
    others = [
        name for name, other in table.laws.items() if any(key == own_key.name for own_key in other.keys)
    ]
    if key not in keys and others:
        rule = f'contradicts law = "{law.name}"; it is a key of law = {", ".join(map(quoted, others))}'
        return InputError(error.key, error.value, rule, f"leave {key} out")
    return error


def film_of(film: FilmTable | None) -> FilmData:
    """Return the choice of film law of a table [film], its values in SI units."""
    if film is None or film.law in (None, AUTO):
        return FilmData(film and film.law)
    return FilmData(film.law, own_values(_owner(film, FILM_LAWS[film.law]), film.own))


def law_values(table: LawTable) -> dict[str, float]:
    """Return the values of the own keys of the law that a table names, in SI units."""
    return {} if table.law == AUTO else own_values(_owner(table, table.laws[table.law]), table.own)
