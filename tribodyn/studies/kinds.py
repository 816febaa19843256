"""The kinds of scenario: which tables a file of each kind has."""

from collections.abc import Mapping
from typing import Any

from tribodyn.scenario.quantity import Table
from tribodyn.studies.backlash_oscillator.scenario import BacklashOscillatorScenario
from tribodyn.studies.efficiency.scenario import EfficiencyScenario
from tribodyn.studies.gear_pair.scenario import Scenario
from tribodyn.studies.load_contact.scenario import LoadContactScenario
from tribodyn.studies.rolling.scenario import RollingScenario

KINDS: dict[str, type[Table]] = {
    "gear-pair": Scenario,
    "irefc": RollingScenario,
    "efficiency": EfficiencyScenario,
    "load-contact": LoadContactScenario,
    "backlash-oscillator": BacklashOscillatorScenario,
}


def table_of(data: Mapping[str, Any]) -> type[Table]:
    """Return the table of a scenario file; of a gear pair where the kind is missing or unknown."""
    kind = data.get("kind")
    return KINDS.get(kind, Scenario) if isinstance(kind, str) else Scenario
