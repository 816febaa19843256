"""What `check` says of a search: what is free, what is sought, what must hold, by which method."""

from tribodyn.studies.design.candidates.candidates import samples_of
from tribodyn.studies.design.candidates.sources import standing
from tribodyn.studies.design.case import DesignCase, Free
from tribodyn.studies.design.methods import method_of
from tribodyn.studies.protocol.study import Checked, TextTable


def check(case: DesignCase) -> Checked:
    """Check a case and say what is searched."""
    name, reason = method_of(case)
    rows = [
        (", ".join(one.keys), _shown(standing(case.scenarios, one.keys[0])), bounds(one)) for one in case.free
    ]
    cases = len(case.duties) * len(samples_of(case))
    wanted = [one.name.removeprefix("-") for one in case.objectives]
    more = case.objectives[0].name.startswith("-")
    data = {
        "free": {key: bounds(one) for one in case.free for key in one.keys},
        "objective": wanted,
        "subject_to": [one.text for one in case.constraints],
        "method": name,
        "cases_per_evaluation": cases,
    }
    tables = (
        TextTable("Free keys", ("key", "start", "range"), rows),
        TextTable(
            "Search",
            ("", ""),
            (
                ("maximise" if more else "minimise", " and ".join(wanted)),
                *(("part", f"{name}: {one.get('title', '')}") for name, one in case.parts.items()),
                *(("subject to", one.text) for one in case.constraints),
                ("method", f"{name}: {reason}"),
                ("evaluations", f"{case.search.evaluations} at most, {cases} cases each"),
            ),
        ),
    )
    return Checked(data, tables)


def bounds(one: Free) -> str:
    """The range of a free key in words."""
    if one.choices:
        return ", ".join(map(str, one.choices))
    return f"{one.low:g} … {one.high:g} {one.unit}".rstrip()


def _shown(value: object) -> str:
    return "–" if value is None else str(value)
