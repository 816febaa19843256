"""Every kind of study of gears takes every tooth family: checked, and run for a short while."""

import tomllib
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from tests.support.short_studies import COULOMB, SHORT, written_template
from tribodyn.geometry.families import FAMILIES
from tribodyn.input.schema import references
from tribodyn.input.sources import DRIVES, shipped
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

#: What a template says that not every drive can have, and what the drives of the papers do not say.
ALSO: dict[str, dict[str, Any]] = {
    "gear-pair": COULOMB,
    "efficiency": {"friction.law": "masjedi-khonsari"},
    "design": {"design.subject_to": []},
    "assessment": {"drive.quality": 6},
}
#: Kinds that run every family in a second, and those that run one, whose shape has arrays, in seconds.
QUICK, ONE, FAMILY = ("gear-pair", "efficiency"), ("load-contact",), "spline"


@cache
def drive_of(family: str) -> str:
    """The first shipped drive of a family."""
    found = (
        path.stem
        for path in sorted((shipped("models") / DRIVES).glob("*.toml"))
        if tomllib.loads(path.read_text(encoding="utf-8")).get("family") == family
    )
    return next(found)


@cache
def gears_of(kind: str, folder: Path) -> tuple[str, ...]:
    """Keys of a kind's template under which gears stand; those of no family are no gears."""
    written = tomllib.loads(load_scenario(written_template(kind, folder)).toml)
    found = [key for key, mark in references(STUDIES[kind].table(written)).items() if mark.folder == DRIVES]
    return tuple(".".join(key) for key in found if "family" in _at(written, key))


def _at(data: dict[str, Any], key: tuple[str, ...]) -> Any:
    for part in key:
        data = data.get(part, {})
    return data


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("families")


def cases() -> list[Any]:
    """Each kind with each family, the long ones for soak."""
    return [
        pytest.param(kind, family, marks=[] if _soon(kind, family) else pytest.mark.soak)
        for kind in STUDIES
        for family in FAMILIES
    ]


def _soon(kind: str, family: str) -> bool:
    return kind in QUICK or (kind in ONE and family == FAMILY)


@pytest.mark.parametrize(("kind", "family"), cases())
def test_a_kind_takes_a_family(kind: str, family: str, folder: Path):
    keys = gears_of(kind, folder)
    if not keys:
        pytest.skip("a study of something else")
    short = {key: value for key, value in SHORT[kind].items() if not key.startswith(keys)}
    drives = dict.fromkeys(keys, drive_of(family))
    case = load_scenario(written_template(kind, folder), short | drives | ALSO.get(kind, {}))
    assert STUDIES[kind].check(case).tables
    result = run(case, folder / f"{kind}-{family}.h5")
    assert (result.status, result.message) == ("complete", "")


def test_there_are_studies_of_gears(folder: Path):
    kinds = {kind for kind in STUDIES if gears_of(kind, folder)}
    assert {kind for kind, study in STUDIES.items() if study.has_gears} <= kinds
    assert "design" in kinds
