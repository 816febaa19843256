"""The keys of a scenario of ``kind = "backlash-oscillator"``: plain numbers, nothing has a dimension."""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, Discriminator, Field, Tag, create_model

from tribodyn.input.fields import ScenarioHead, head_of
from tribodyn.input.quantity import NotNegative, Positive, Table, broken, written
from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase

#: Maximum number of frequencies of one sweep.
MOST_FREQUENCIES = 100_000

_Range = create_model(
    "FrequencyRange",
    __base__=Table,
    __doc__="Frequencies from one to another, both included; keys that Python would take for its own words.",
    **{  # pyright: ignore[reportArgumentType, reportCallIssue]
        "from": (Positive, Field(description="first", examples=[0.2])),
        "to": (Positive, Field(description="last, greater than the first", examples=[1.6])),
        "step": (Positive, Field(description="between neighbours", examples=[0.005])),
    },
)


class FrequencyRange(_Range):
    """Frequencies from one to another, evenly."""

    def model_post_init(self, _: Any) -> None:
        """Refuse ranges that are empty or endless."""
        first, last, step = (getattr(self, name) for name in ("from", "to", "step"))
        if last <= first:
            raise broken(f"the range ends at {last:g} and starts at {first:g}", "let to be greater than from")
        if step > last - first:
            raise broken(f"the step {step:g} is longer than the range", "use a smaller step")
        if (last - first) / step > MOST_FREQUENCIES:
            raise broken(f"more than {MOST_FREQUENCIES} frequencies", "use a larger step")

    def values(self) -> tuple[float, ...]:
        """Return the frequencies; the last one is `to` itself."""
        first, last, step = (getattr(self, name) for name in ("from", "to", "step"))
        steps = int((last - first) / step * (1.0 + 1e-12))
        values = first + step * np.arange(steps + 1)
        if last - values[-1] > 1e-9 * step:
            values = np.append(values, last)
        return tuple(float(value) for value in values)


def _increasing(values: tuple[float, ...]) -> tuple[float, ...]:
    if not values:
        raise broken("an empty list", "write at least one frequency")
    if np.any(np.diff(values) <= 0.0):
        raise broken("does not increase", "sort the list; it is followed up and down anyway")
    return values


Frequencies = Annotated[
    Annotated[FrequencyRange, Tag("(range)")]
    | Annotated[tuple[Positive, ...], AfterValidator(_increasing), Tag("(list)")],
    Discriminator(lambda value: "(range)" if isinstance(value, dict | FrequencyRange) else "(list)"),
]
"""A list of frequencies, or a table with from, to and step."""


class OscillatorSolver(Table):
    """The search for steady states."""

    max_periods: Annotated[int, Field(strict=True, ge=24)] = 600
    unstable: bool = False


class BacklashOscillatorScenario(ScenarioHead):
    """A scenario file of the oscillator with backlash; lengths in half backlashes, times in 1/ω_n."""

    kind: Literal["backlash-oscillator"]
    damping: NotNegative = Field(examples=[0.05])
    mean_force: NotNegative = Field(examples=[0.1])
    error_amplitude: NotNegative = Field(examples=[0.05])
    stiffness_variation: Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, le=1)] = 0.0
    frequency: Frequencies = Field(examples=[[0.7, 0.8]])
    solver: OscillatorSolver = written({})


Scenario = BacklashOscillatorScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> BacklashOscillatorCase:
    """Return the case of a scenario that has passed the schema."""
    frequency = scenario.frequency
    return BacklashOscillatorCase(
        **head_of(scenario, toml, sha256),
        damping=scenario.damping,
        mean_force=scenario.mean_force,
        error_amplitude=scenario.error_amplitude,
        stiffness_variation=scenario.stiffness_variation,
        frequencies=frequency.values() if isinstance(frequency, FrequencyRange) else tuple(frequency),
        max_periods=scenario.solver.max_periods,
        unstable=scenario.solver.unstable,
    )
