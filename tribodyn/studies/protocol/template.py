"""Commented scenarios to begin with: a kind's template with title, other kinds and a drive put in."""

import json
from importlib import resources

from tribodyn.geometry.families import FAMILIES, Family
from tribodyn.scenario.own_keys import example_of
from tribodyn.studies import STUDIES

#: Column of the comments.
_COMMENT = 38
_CHOSEN = "involute"


def filled(kind: str, title: str) -> str:
    """Return the template of a kind of study with everything put in.

    Parameters
    ----------
    kind : as scenarios name it
    title : of the scenario

    Raises
    ------
    InputError
        For an unknown kind.
    """
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
        offered = [one for one in family.parameters if not one.optional or one.example]
        values = ", ".join(f"{one.name} = {example_of(one)}" for one in offered)
        lines.append(f"#   shape = {{ {values} }}")
    return lines
