"""The kinds of scenario: which tables a file of each kind has."""

from collections.abc import Mapping
from typing import Any

from tribodyn.scenario.backlash_oscillator import BacklashOscillatorScenario
from tribodyn.scenario.efficiency import EfficiencyScenario
from tribodyn.scenario.load_contact import LoadContactScenario
from tribodyn.scenario.quantity import Table
from tribodyn.scenario.rolling import RollingScenario
from tribodyn.scenario.schema import Scenario

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
