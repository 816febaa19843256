"""Shipped scenarios to begin with, by what a designer wants to see."""

from typing import NamedTuple


class Example(NamedTuple):
    """A task, the scenario that shows it, and what to try there."""

    task: str
    scenario: str
    hint: str
    field: str = ""  # where the form opens


EXAMPLES = (
    Example(
        "Quiet pair",
        "involute-18-36-tip-relief",
        "Drag the tip relief of pinion and gear: the transmission error has a minimum near this torque.",
        "drive.pinion.modification.tip_relief",
    ),
    Example(
        "Hot film",
        "spur-25-51",
        "Raise the oil temperature: film and λ fall, friction and loss change.",
        "operating.oil_temperature",
    ),
    Example(
        "Planetary load sharing",
        "planetary-24-84",
        "Move one pin by its tangential error: the planets share the load otherwise.",
        "stage.0.tangential_pin_errors",
    ),
    Example(
        "Cracked tooth",
        "crack-18-36",
        "Change the depth of the crack: the stiffness falls while that tooth is in mesh.",
        "damage.0.depth",
    ),
)
FIRST = EXAMPLES[0].scenario
