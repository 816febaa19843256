"""The scenario of ``kind = "design"``: its tables, what a search takes, and its short form.

The short form is a search from a scenario and a few options, of the command line and of Python.
"""

import copy
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, create_model

from tribodyn.cases.cost import CostKey, Estimate, record_bytes
from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.input.fields import ScenarioHead, head_of
from tribodyn.input.quantity import Count, Positive, Switch, Table, Text, scenario_file, written
from tribodyn.input.resolve import toml_value
from tribodyn.input.tables.gears.drive_data import with_axes_held
from tribodyn.studies import STUDIES, study_of
from tribodyn.studies.design.candidates.archive import FACTORS, resolutions
from tribodyn.studies.design.candidates.candidates import cases_of, chosen, shapes_gears, start_of
from tribodyn.studies.design.candidates.converged import counts
from tribodyn.studies.design.candidates.evaluation import loaded_source, sound_case
from tribodyn.studies.design.candidates.sources import BASE, NAME, Source, own, sources_of
from tribodyn.studies.design.case import DesignCase, RobustTable, SearchOptions, flat, unit_of
from tribodyn.studies.design.methods import METHODS, method_of
from tribodyn.studies.design.outcome import layout_of, names_of, scales_of
from tribodyn.studies.design.parts import parts_of_design
from tribodyn.studies.protocol.evaluated import evaluated_quantities
from tribodyn.studies.protocol.load import (
    Loaded,
    SoundScenario,
    load_data,
    loaded_around,
    put_chosen,
    schema_inside,
)
from tribodyn.studies.protocol.study import CaseHead

KIND = "design"
#: Values at the start that are said.
_FEW = 5

_Bounds = create_model(
    "FreeBounds",
    __base__=Table,
    __doc__="Bounds of a free key; words that Python has for itself.",
    **{  # pyright: ignore[reportArgumentType, reportCallIssue]
        "from": (Any, Field(None, description="lower bound, with its unit", examples=["0 um"])),
        "to": (Any, Field(None, description="upper bound", examples=["40 um"])),
    },
)


class FreeKey(_Bounds):
    """A key of the scenario that the search may change."""

    key: Any = Field(examples=["drive.pinion.modification.tip_relief"])
    choices: tuple[Any, ...] | None = None


class DesignDuty(Table):
    """One of several duties."""

    weight: Positive = 1.0
    set: dict[str, Any]


class ToleranceTable(Table):
    """A deviation that the designer cannot choose."""

    key: Text = Field(examples=["mesh.misalignment.in_plane"])
    plus_minus: Any = Field(None, examples=["1 arcmin"])
    distribution: Literal["uniform", "normal", "ends"] = "uniform"


class DesignTable(Table):
    """What is free, what is sought, what must hold, and how it is searched."""

    free: tuple[FreeKey, ...] = Field(min_length=0)
    minimise: Any = None
    maximise: Text | None = None
    subject_to: tuple[Text, ...] = Field((), examples=[["contact_ratio >= 1.3"]])
    part: dict[str, Any] | None = None
    duty: tuple[DesignDuty, ...] = ()
    over_duties: Literal["mean", "worst"] = "mean"
    tolerance: tuple[ToleranceTable, ...] = ()
    robust: RobustTable = written({})
    method: Literal["auto", *METHODS] = "auto"  # pyright: ignore[reportInvalidTypeForm]
    evaluations: Annotated[int, Field(strict=True, ge=2, le=1_000_000)] = 200
    starts: Count = 2
    seed: Annotated[int, Field(strict=True, ge=0)] = 0
    points: Annotated[int, Field(strict=True, ge=3, le=1000)] = 7
    accuracy: Annotated[float, Field(strict=True, gt=0, lt=0.5)] = 1e-3
    confirm: dict[str, Any] = Field(default_factory=dict)
    sensitivities: Switch = True


class DesignScenario(ScenarioHead):
    """A scenario file of a search."""

    kind: Literal["design"]
    scenario: Annotated[dict[str, Any], scenario_file()]
    design: DesignTable

    @classmethod
    def begun(cls, sound: SoundScenario) -> tuple[SoundScenario, str]:
        """The scenario that is searched through with its free keys at the start, and what they are there."""
        case = _case(sound.scenario, copy.deepcopy(sound.data), choose=False)
        names, schema = case.scenarios, type(sound.scenario.scenario)
        start = own(BASE, schema, chosen(case, start_of(case)), names)
        duty = own(BASE, schema, case.duties[0].set, names)
        values = [f"{key} = {value}" for key, value in (start | duty).items()]
        more = f" and {len(values) - _FEW} more" if len(values) > _FEW else ""
        under = ", under the first of its duties" if len(case.duties) > 1 else ""
        said = f"Shown is the start of the search{under}: {', '.join(values[:_FEW])}{more}."
        return sound_case(case.base, start | duty), said


Scenario = DesignScenario


def table_for(data: Mapping[str, Any]) -> type[Table]:
    """Return the schema for data whose scenarios, as far as they are opened, are of known kinds."""
    design = data.get("design")
    in_design = design.get("part") if isinstance(design, Mapping) else None
    parts = in_design if isinstance(in_design, Mapping) else {}
    names = [name for name in parts if NAME.fullmatch(name) and not hasattr(Table, name)]
    named = tuple((name, schema_inside(parts[name], KIND)) for name in names)
    return _around(schema_inside(data.get("scenario"), KIND), named)


@lru_cache(maxsize=16)
def _around(base: type[Table] | None, parts: tuple[tuple[str, type[Table] | None], ...]) -> type[Table]:
    changed: dict[str, Any] = {}
    if base is not None:
        changed["scenario"] = (Annotated[base, scenario_file()], ...)
    if parts:
        fields: dict[str, Any] = {
            name: (Annotated[schema or dict[str, Any], scenario_file()], ...) for name, schema in parts
        }
        of_parts: Any = create_model("DesignParts", __base__=Table, __doc__="Further scenarios.", **fields)
        changed["design"] = (_with_fields(DesignTable, part=(of_parts, ...)), ...)
    return _with_fields(DesignScenario, **changed) if changed else DesignScenario


def _with_fields(model: type[Table], **fields: Any) -> Any:
    """A model with some of its fields of other types."""
    return create_model(model.__name__, __base__=model, __doc__=model.__doc__, **fields)


def case_of(scenario: Scenario, toml: str, sha256: str) -> DesignCase:
    """Return the case of a scenario that has passed schema and rules."""
    return _case(scenario, tomllib.loads(toml), toml, sha256)


def _case(
    scenario: Scenario, data: Any, toml: str = "", sha256: str = "", *, choose: bool = True
) -> DesignCase:
    """The case of a scenario with data of its own; `choose` laws that it leaves open."""
    base, table = data["scenario"], scenario.design
    if "drive" in base:
        base |= {"drive": with_axes_held(base["drive"])}
    further = dict(data["design"].get("part") or {})
    for name, part in further.items():  # on the drive of the scenario, where both have one
        if "drive" in part and "drive" in base:
            further[name] = part | {"drive": base["drive"]}
    for searched in (base, *further.values()) if choose else ():  # one law for all candidates
        with suppress(InputError):  # whoever evaluates it says why
            put_chosen(searched, load_data(searched, "scenario").case.chosen())
    fields, _ = parts_of_design(table, sources_of({BASE: base, **further}))
    return DesignCase(
        **head_of(scenario, toml, sha256),
        base=base,
        parts=further,
        **fields,
        over_duties=table.over_duties,
        robust=table.robust,
        search=SearchOptions(**{name: getattr(table, name) for name in SearchOptions._fields}),
        confirm=flat(table.confirm),
        sensitivities=table.sensitivities,
    )


def broken_rules(scenario: Any) -> Iterator[InputError]:
    """Go through the rules that such a scenario breaks, those of the scenarios within it included."""
    parted = scenario.design.part
    if isinstance(parted, dict):
        for name in parted:
            rule, remedy = "not a name for a part", "write letters, digits and hyphens, such as efficiency"
            yield InputError("design.part", quoted(name), rule, remedy)
        return
    parts = {name: getattr(parted, name) for name in type(parted).model_fields} if parted is not None else {}
    sources: dict[str, Source] = {}
    clear = True
    for name, place, source in [
        (BASE, "scenario", scenario.scenario),
        *((name, f"design.part.{name}", part) for name, part in parts.items()),
    ]:
        errors = list(_of_scenario(place, source))
        yield from errors
        clear = clear and not any(error.key == f"{place}.kind" for error in errors)
        if clear:
            sources[name] = Source(study_of({"kind": source.kind}), type(source))
    fields = type(scenario.scenario).model_fields if isinstance(scenario.scenario, Table) else {}
    for name in parts:
        if name in fields:
            rule = f"the scenario has a table [{name}]"
            yield InputError("design.part", quoted(name), rule, "choose another name for the part")
    if clear:
        yield from parts_of_design(scenario.design, sources)[1]


def _of_scenario(place: str, scenario: Any) -> Iterator[InputError]:
    """Rules of a scenario that is to be evaluated."""
    kind = scenario.get("kind") if isinstance(scenario, dict) else scenario.kind
    if not isinstance(scenario, Table):
        if isinstance(kind, str) and kind not in STUDIES:
            yield unknown_name(f"{place}.kind", kind, STUDIES, STUDIES.what)
            return
        rule = "a search through a search" if kind == "design" else "not a scenario"
        yield InputError(f"{place}.kind", quoted(kind), rule, "name a scenario of another kind")
        return
    study = study_of({"kind": kind})
    if not evaluated_quantities(study):
        rule = f"a {kind} study names no quantities that could be sought"
        yield InputError(f"{place}.kind", quoted(kind), rule, "name a scenario of another kind")
        return
    for error in study.broken_rules(scenario):
        yield InputError(f"{place}.{error.key}", error.value, error.rule, error.remedy, error.file)


def estimate(case: DesignCase) -> Estimate:
    """What a run of a case takes: that of its base scenario, so many times, on every resolution."""
    method, _ = method_of(case)
    count, several, seconds = float(case.search.evaluations), [], 0.0
    for factor, candidates in counts(case, method).items():
        more = resolutions(case, factor)
        if factor > 1 and not more:
            break
        cases = cases_of(case, chosen(case, start_of(case)), more)
        for name in case.scenarios:
            loaded = loaded_source(case.scenarios, name, cases[0])
            several.append(loaded.study.estimate(loaded.case))
            # what cases share, such as finite elements, is made anew for gears of another shape
            preparation = several[-1].shared if shapes_gears(case) else 0.0
            seconds += candidates * len(cases) * (several[-1].seconds + preparation)
    largest = max(several, key=lambda estimate: estimate.memory)
    sizes = {name: len(scale) for name, scale in scales_of(case, names_of(case, [])).items()}
    sizes["evaluation"] = len(FACTORS) * case.search.evaluations
    return Estimate(
        largest.memory,
        record_bytes(layout_of(case), sizes),
        seconds,
        (CostKey("design.evaluations", count, 300), *largest.drivers),
        largest.shared,
    )


def entries(free: Mapping[str, Any] | Sequence[Any]) -> list[Any]:
    """Entries of `design.free`, from a mapping of keys to bounds, or from texts as `free_of` reads them.

    Raises InputError for bounds that are none.
    """
    if isinstance(free, Mapping):
        return [{"key": str(key), **_bounds(str(key), bounds)} for key, bounds in free.items()]
    return [free_of(entry) if isinstance(entry, str) else entry for entry in free]


def _bounds(key: str, bounds: Any) -> Mapping[str, Any]:
    if isinstance(bounds, Mapping):
        return bounds
    if isinstance(bounds, list):
        words = [isinstance(end, str) and end.strip()[:1] not in "+-.0123456789" for end in bounds]
        if len(bounds) == 2 and not all(words):
            return {"from": bounds[0], "to": bounds[1]}
        return {"choices": bounds}
    rule = "neither two bounds nor a list of choices"
    raise InputError(key, quoted(bounds), rule, 'give them like ("0 um", "40 um")')


def free_of(option: str) -> dict[str, Any]:
    """Read ``KEY=FROM:TO`` or ``KEY=VALUE,VALUE,…``; a unit may stand once, at the end.

    Raises InputError for what is neither.
    """
    key, equals, text = option.partition("=")
    keys = [part.strip() for part in key.split("+")]
    if not equals or not text.strip() or not all(keys):
        raise _refusal(option)
    named: dict[str, Any] = {"key": keys if len(keys) > 1 else keys[0]}
    if ":" in text:
        low, _, high = text.partition(":")
        unit, low_unit = unit_of(high), unit_of(low)
        if unit is None or low_unit is None:
            raise _refusal(option)
        if unit and not low_unit:
            low = f"{low.strip()} {unit}"
        return {**named, "from": toml_value(low.strip()), "to": toml_value(high.strip())}
    values = [value.strip() for value in text.split(",")]
    if len(values) < 2 or not all(values):
        raise _refusal(option)
    if unit := unit_of(values[-1]):
        values = [f"{value} {unit}" if re.fullmatch(r"[\d.eE+-]+", value) else value for value in values]
    return {**named, "choices": [toml_value(value) for value in values]}


def _refusal(option: str) -> InputError:
    remedy = 'write it like --free drive.pinion.modification.tip_relief="0 um:40 um"'
    return InputError("--free", quoted(option), "neither KEY=FROM:TO nor KEY=VALUE,VALUE,…", remedy)


def parts_of(options: Sequence[str]) -> dict[str, str]:
    """Read several ``NAME=SCENARIO``; raises InputError for what is none."""
    parts: dict[str, str] = {}
    for option in options:
        name, equals, scenario = (part.strip() for part in option.partition("="))
        if not equals or not name or not scenario or name in parts:
            rule = "is given twice" if name in parts else "not NAME=SCENARIO"
            remedy = "write it like --part efficiency=efficiency-involute-18-36"
            raise InputError("--part", quoted(option), rule, remedy)
        parts[name] = scenario
    return parts


def loaded_search(
    source: str | Path | Mapping[str, Any] | CaseHead, design: Mapping[str, Any], overrides: Mapping[str, Any]
) -> Loaded:
    """Make the case of a search through a scenario, or of a search: name, file, tables, or a case.

    `design` are keys of its table `[design]`, in place of those of a search; `overrides`, by dotted keys, are
    of the scenario to search through. Raises InputError for what cannot be searched, and where nothing says
    what is free and what is sought.
    """
    return loaded_around(KIND, source, design, overrides, "Search through", {"free": []})
