"""What `check` says of a search: what is free, what is sought, what must hold, by which method."""

from tribodyn.studies.design.candidates.candidates import samples_of
from tribodyn.studies.design.candidates.sources import standing
from tribodyn.studies.design.case import DesignCase, Free
from tribodyn.studies.design.methods import method_of
from tribodyn.studies.protocol.study import CheckResult, TextTable


def check(case: DesignCase) -> CheckResult:
    """Check a case and say what is searched."""
    name, reason = method_of(case)
    starts = [standing(case.scenarios, free.keys[0]) for free in case.free]
    rows = [
        (", ".join(free.keys), "–" if start is None else str(start), bounds(free))
        for free, start in zip(case.free, starts, strict=True)
    ]
    cases = len(case.duties) * len(samples_of(case))
    wanted = [objective.name.removeprefix("-") for objective in case.objectives]
    more = case.objectives[0].name.startswith("-")
    data = {
        "free": {key: bounds(free) for free in case.free for key in free.keys},
        "objective": wanted,
        "subject_to": [constraint.text for constraint in case.constraints],
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
                *(("part", f"{name}: {part.get('title', '')}") for name, part in case.parts.items()),
                *(("subject to", constraint.text) for constraint in case.constraints),
                ("method", f"{name}: {reason}"),
                ("evaluations", f"{case.search.evaluations} at most, {cases} cases each"),
            ),
        ),
    )
    return CheckResult(data, tables)


def bounds(free: Free) -> str:
    """The range of a free key in words."""
    if free.choices:
        return ", ".join(map(str, free.choices))
    return f"{free.low:g} … {free.high:g} {free.unit}".rstrip()
