"""What is said of a centre distance that is taken within the rounding of its printed digits."""

import tomllib

from tribodyn.scenario.tables.drive_data import RoundedDistance
from tribodyn.studies.protocol.results import CheckResult, TextTable

#: The same for one of many cases: without values, so that equal remarks can be counted.
BRIEF = "the centre distance is taken as that without backlash, within the rounding of the printed digits"


def rounded_in(toml: str) -> RoundedDistance | None:
    """How the centre distance in the text of a scenario is rounded; None: it is meant as written."""
    if "centre_distance" not in toml:  # most have none, and need not be read
        return None
    from tribodyn.scenario.tables.drive_data import rounded_distance_of

    return rounded_distance_of(tomllib.loads(toml).get("drive", {}))


def with_rounding(checked: CheckResult, toml: str) -> CheckResult:
    """What `check` says, with how the centre distance of the scenario is rounded."""
    rounded = rounded_in(toml)
    if rounded is None:
        return checked
    lines = rounded.lines()
    rows = [(name, f"{value:.6g} {unit}") for name, (value, unit) in lines.items()]
    data = checked.data | {"geometry": checked.data["geometry"] | lines}
    table = TextTable("Printed digits", ("quantity", "value"), rows)
    return CheckResult(data, (*checked.tables, table), (*checked.remarks, rounded.remark()))


def remarks_in_brief(toml: str) -> list[str]:
    """What is said of it of a case of a sweep."""
    return [BRIEF] if rounded_in(toml) else []
