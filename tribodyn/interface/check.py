"""What can be said of a scenario before it runs."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from tribodyn.input.sources import find_scenario
from tribodyn.interface.arguments import checked
from tribodyn.interface.scenario import Source, in_python, scenario
from tribodyn.studies import STUDIES


@in_python()
@checked
def check(source: Source, overrides: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Check a scenario and compute what needs no run: the data of ``tribodyn check --json``.

    Parameters
    ----------
    source : str, Path, mapping or case
        As `td.run` takes it.
    overrides : mapping, optional
        Dotted key to value: ``{"operating.gear_torque": "600 N*m"}``.

    Returns
    -------
    dict
        ``scenario``, its file or, of what comes from none, its name; ``title``; by the kind of study
        ``geometry``, ``lubricant``, ``laws``, of an assessment ``iso``, every factor of ISO 6336. All numbers
        are in SI units and angles in rad; a number with a unit is a pair of both.

    Raises
    ------
    InputError
        Anything that is wrong with the scenario, or for which its case cannot be run.
    """
    case = scenario(source, overrides)
    where = str(find_scenario(str(source))) if isinstance(source, (str, Path)) else case.name
    return {"scenario": where, **STUDIES[case.kind].check(case, allow_large=True).data}
