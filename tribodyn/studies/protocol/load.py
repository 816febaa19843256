"""Scenarios of any kind: a commented one to begin with, the case of a file, and the JSON schema."""

import hashlib
import json
import re
import tomllib
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, NamedTuple, Union

import tomli_w
from pydantic import Field, TypeAdapter, ValidationError

from tribodyn.cases.loss_part import GearboxLosses
from tribodyn.errors import InputError, InputErrors, quoted, unknown_name
from tribodyn.geometry.families import FAMILIES, Family
from tribodyn.input.messages import Origins, explain, outside
from tribodyn.input.names import same_key
from tribodyn.input.quantity import LIKE
from tribodyn.input.resolve import OVERRIDES, Resolved, resolve, resolve_table, unresolved_keys
from tribodyn.input.sources import file_name, find_scenario, read_toml
from tribodyn.input.specific_keys import example_of
from tribodyn.input.tables.duty import broken_spectrum_rules, in_force, of_duty, spectrum_of
from tribodyn.studies import DEFAULT, STUDIES, study_of
from tribodyn.studies.protocol.study import CaseHead, Study

#: Column of the comments.
_COMMENT = 38
_CHOSEN = "involute"


def filled(kind: str, title: str) -> str:
    """Return the template of a kind of study with title, other kinds and a drive put in."""
    text = STUDIES[kind].template()
    if "\nDRIVE\n" in text:
        drive = resources.files("tribodyn.studies").joinpath("drive_template.toml")
        text = text.replace("DRIVE\n", drive.read_text(encoding="utf-8"), 1)
    text = text.replace("FAMILIES", _families()).replace("KINDS", _kinds(kind))
    return text.replace('"TITLE"', json.dumps(title, ensure_ascii=False))


def _kinds(kind: str) -> str:
    others = [f"#   {name:22}{study.about}" for name, study in STUDIES.items() if name != kind]
    return "\n".join(
        [f'kind = "{kind}"', "# other kinds, with other tables: tribodyn init NAME --kind", *others]
    )


def _families() -> str:
    chosen = FAMILIES[_CHOSEN]
    lines = [f'family = "{chosen.name}"'.ljust(_COMMENT) + f"# {chosen.about}", "# or one of:"]
    for name, family in FAMILIES.items():
        if name != _CHOSEN:
            lines += [f'# family = "{name}"', f"#   {family.about}", *_own_keys(family)]
    return "\n".join(lines)


def _own_keys(family: Family) -> list[str]:
    """What else changes in [drive] where this family is chosen."""
    lines = [] if family.pressure_angle else ["#   it has no pressure_angle"]
    if family.parameters:
        offered = [key for key in family.parameters if not key.optional or key.example]
        values = ", ".join(f"{key.name} = {example_of(key)}" for key in offered)
        lines.append(f"#   shape = {{ {values} }}")
    return lines


class Loaded(NamedTuple):
    """A case, its study, the file it was read from, and where each of its values stands."""

    case: Any
    study: Study
    path: Path
    origins: Origins

    @property
    def losses(self) -> GearboxLosses:
        """What the study of a gearbox offers; of others the rules have refused it."""
        losses = self.study.losses()
        assert losses is not None, "refused by the rules"
        return losses

    def recorded_in(self, folder: Path) -> "Loaded":
        """The same, for a record in a folder that is named after it; see `record.target`."""
        return self._replace(case=replace(self.case, scenario_file=file_name(self.path, folder)))

    @contextmanager
    def naming(self) -> Iterator[None]:
        """Put the file into the errors that the physics raises inside the block."""
        with self.origins.naming():
            yield


def load_scenario(scenario: str | Path, overrides: Mapping[str, Any] | None = None) -> Any:
    """Read a scenario; return its case.

    Parameters
    ----------
    scenario : path of a scenario file, or the name of a shipped one: "crc-23-47"
    overrides : mapping, optional
        Dotted key to value, ``{"operating.gear_torque": "600 N*m"}``; keys reach through references.

    Raises
    ------
    InputError
        Anything that is wrong with it; `InputErrors`, one per line, where there is more than one mistake.
    """
    return load(scenario, overrides).case


def load(scenario: str | Path, overrides: Mapping[str, Any] | None = None) -> Loaded:
    """Read a scenario as `load_scenario` does, and say where its values stand."""
    path = find_scenario(str(scenario))
    return loaded_from(resolve(path, overrides or {}, table_of), path)


class EveryMesh(NamedTuple):
    """Cases of the meshes of a gearbox by their names; under "" where there is one case."""

    cases: dict[str, Loaded]
    left_out: tuple[str, ...] = ()  # meshes that the kind does not know

    def remarks(self) -> list[str]:
        """What is left out, if anything."""
        rule = "is left out: this kind of study takes no such ring"
        return [f"mesh {mesh} {rule}" for mesh in self.left_out]


def load_every(scenario: str | Path, overrides: Mapping[str, Any] | None = None) -> EveryMesh:
    """Read a scenario as `load` does; a case of every mesh of a gearbox of which it names none."""
    path = find_scenario(str(scenario))
    return every_from(resolve(path, overrides or {}, table_of), path)


def every_from(resolved: Resolved, path: Path) -> EveryMesh:
    """The cases of a scenario's file as `load_every` gives them; `resolved` as of `loaded_from`."""
    data, parts = resolved.data, {}
    if (of_every_mesh := getattr(table_of(data), "of_every_mesh", None)) is not None:
        with suppress(InputError, ValidationError):  # said below
            parts = of_every_mesh(data, path, opened)
    if not parts:
        return EveryMesh({"": loaded_from(resolved, path)})
    found: dict[str, Loaded] = {}
    stem = data.get("name") or _name_of(path.stem)
    for mesh, part in parts.items():
        if part is None:
            continue
        part["name"] = f"{stem}-{_name_of(mesh)}"
        part["title"] = f"{data.get('title', '')}: mesh {mesh}"
        try:
            found[mesh] = loaded_from(resolved._replace(data=part), path)
        except InputError as error:
            raise error.moved(lambda file, mesh=mesh: f"{file}, mesh {mesh}") from None
    return EveryMesh(found, tuple(mesh for mesh, part in parts.items() if part is None))


def _name_of(text: str) -> str:
    """A text as the name of a record."""
    return re.sub(r"[^\w .-]", "-", text).lstrip(" .-")


def opened(path: Path) -> tuple[Study, Callable[[], Any]]:
    """The study of a scenario's file, and what makes its case."""
    resolved = resolve(path, {}, table_of)
    return study_of(resolved.data), lambda: loaded_from(resolved, path).case


def table_of(data: Mapping[str, Any]) -> Any:
    """Return the schema of a scenario's data."""
    return study_of(data).table(data)


def load_data(data: Mapping[str, Any], name: str, overrides: Mapping[str, Any] | None = None) -> Loaded:
    """Load a scenario's data as `load` does those of a file of that name; they are not changed."""
    path, copy = Path(f"{name}.toml"), json.loads(json.dumps(data))
    return loaded_from(resolve_table(copy, path, overrides or {}, table_of), path)


def schema_inside(scenario: Any, around: str) -> Any:
    """Schema of a scenario within one of a kind; None where it is not opened yet, or of that or no kind."""
    if not isinstance(scenario, Mapping) or LIKE in scenario:
        return None
    kind = scenario.get("kind", DEFAULT)
    if not isinstance(kind, str) or kind not in STUDIES or kind == around:
        return None
    return study_of(scenario).table(scenario)


def loaded_from(resolved: Resolved, path: Path) -> Loaded:
    """Return the case of a scenario's file whose references and overrides have been put in; raises as `load`.

    The data of `resolved` may have been changed since; they are not changed here but for a missing name.
    """
    return sound(resolved, path).loaded()


class SoundScenario(NamedTuple):
    """A scenario that has passed schema and rules."""

    data: dict[str, Any]
    study: Study
    scenario: Any  # its tables
    path: Path
    origins: Origins

    def loaded(self) -> Loaded:
        """Its case, for which laws may have to be chosen; raises InputError where that cannot be made."""
        toml = tomli_w.dumps(self.data)
        digest = hashlib.sha256(toml.encode()).hexdigest()
        with self.origins.naming():
            case: CaseHead = self.study.case(in_force(self.scenario), toml, digest)
        return Loaded(case, self.study, self.path, self.origins)


def sound(resolved: Resolved, path: Path) -> SoundScenario:
    """Hold a scenario's file against schema and rules; arguments and errors as of `loaded_from`."""
    data, origins, unresolved = resolved
    origins = origins.over(data)  # the grid of a sweep changes values
    data.setdefault("name", _name_of(path.stem) or "scenario")
    study, kind = study_of(data), data.get("kind")
    model = study.table(data)
    try:
        if (completed := getattr(model, "completed", None)) is not None:
            data = completed(data, path, opened)
        if LIKE in data:
            remedy = "run that by its name with changes: tribodyn run NAME --set KEY=VALUE"
            raise InputError(LIKE, quoted(data[LIKE]), "a scenario takes up no other one", remedy)
        if isinstance(kind, str) and kind not in STUDIES:
            unknown = unknown_name("kind", kind, STUDIES, STUDIES.what)
            raise outside(unknown, kind, remedy=unknown.remedy) or unknown
        if origins.of(("kind",)) == OVERRIDES:
            rule = "the kind of a scenario cannot be set: kinds have other tables"
            remedy = f"write a scenario of that kind: tribodyn init NAME --kind {kind}"
            raise InputError("kind", quoted(kind), rule, remedy, OVERRIDES)
        scenario = model.model_validate(data)
    except InputError as error:
        raise origins.locate(error) from None
    except ValidationError as error:
        # a reference that could not be followed has been complained of already
        unresolved_names = set(map(same_key, unresolved_keys(unresolved)))
        mistakes = [
            mistake for mistake in explain(error, model) if same_key(mistake.key) not in unresolved_names
        ]
        raise _located([*unresolved, *mistakes], origins) from None
    # of a key whose value only its family knows to be a file
    if errors := unresolved or list(broken_rules(study, scenario)):
        raise _located(errors, origins)
    return SoundScenario(data, study, scenario, path, origins)


def loaded_around(
    kind: str,
    source: str | Path | Mapping[str, Any] | CaseHead,
    table: Mapping[str, Any],
    overrides: Mapping[str, Any],
    title: str,
    default: Mapping[str, Any] | None = None,
) -> Loaded:
    """Make the case of a study around a scenario: name, file, tables or a case of either.

    `table` has keys of the table that is named as the kind, in place of those of the source; `overrides`, by
    dotted keys, are of the scenario within; `title` stands before its title,
    and `default` has further keys of the table where the source has none.
    """
    if isinstance(source, CaseHead):
        path, data = Path("scenario"), tomllib.loads(source.toml)
    elif isinstance(source, Mapping):
        path, data = Path("scenario"), dict(source)
    else:
        path = find_scenario(str(source))
        data = read_toml(path)
    if data.get("kind") == kind:
        whole = data | {kind: {**data.get(kind, {}), **table}}
    else:
        name = str(data.get("name", path.stem))
        title = f"{title} {data.get('title', name)}"
        whole = {"title": title, "name": f"{name}-{kind}", "kind": kind, "scenario": data}
        whole[kind] = {**(default or {}), **table}
    prefixes = (f"{kind}.", "scenario.")  # keys of the scenario within, but for those of the study itself
    within = {
        key if key.startswith(prefixes) else f"scenario.{key}": value for key, value in overrides.items()
    }
    return loaded_from(resolve_table(whole, path, within, table_of), path)


def put_chosen(
    data: dict[str, Any], chosen: Mapping[str, tuple[str, str]], but: Collection[str] = ()
) -> None:
    """Put what a scenario left open into its tables, as a case took it, but for keys that are given."""
    for key, (choice, _) in chosen.items():
        table, name = key.split(".")
        if key not in but:
            data[table] = {**data.get(table, {}), name: choice}


def broken_rules(study: Study, scenario: Any) -> Iterator[InputError]:
    """Go through the rules that a scenario breaks, with each duty of its load spectrum."""
    if broken := list(broken_spectrum_rules(scenario)):
        yield from broken
        return
    reported: set[str] = set()
    for number, (_, duty) in enumerate(spectrum_of(scenario), start=1):
        for error in study.broken_rules(duty):
            if str(error) not in reported:
                reported.add(str(error))
                yield of_duty(error, number, scenario)
    if not reported:
        yield from study.broken_rules(in_force(scenario))


def _located(errors: list[InputError], origins: Origins) -> InputError:
    located = [origins.locate(error) for error in errors]
    return InputErrors(located) if len(located) > 1 else located[0]


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of a scenario file of any kind, the registries' names included."""
    tables = tuple(table for _, table in STUDIES.each(lambda study: study.table()))
    kinds: Any = Annotated[Union[tables], Field(discriminator="kind")]  # noqa: UP007
    return {"title": "Scenario", **TypeAdapter(kinds).json_schema()}
