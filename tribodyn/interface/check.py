"""What can be said of a scenario before it runs."""

from collections.abc import Mapping
from typing import Any

from tribodyn.interface.scenario import Source, in_python, scenario
from tribodyn.studies import STUDIES


@in_python()
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
        By the kind of study: ``geometry``, ``lubricant``, ``laws``, of an assessment ``iso``, every factor of
        ISO 6336.

    Raises
    ------
    InputError
        Anything that is wrong with the scenario, or for which its case cannot be run.
    """
    case = scenario(source, overrides)
    return STUDIES[case.kind].check(case, allow_large=True).data
