"""A scenario of ``kind = "backlash-oscillator"``: its case, record, cost and keys, all plain numbers."""

import math
from dataclasses import dataclass
from functools import partial
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, Discriminator, Field, Tag, create_model

from tribodyn.cases.cost import CostKey, Estimate, forced_periods, recorded, total
from tribodyn.input.fields import ScenarioHead, head_of
from tribodyn.input.quantity import NotNegative, Positive, Table, broken, written
from tribodyn.numerics.parameter import Variable, flag
from tribodyn.record.schema import Layout
from tribodyn.studies.protocol import branches
from tribodyn.studies.protocol.study import CaseHead


@dataclass(frozen=True)
class BacklashOscillatorCase(CaseHead):
    """A sweep of x'' + 2ζ x' + (1 + ε cos Ωτ) f(x) = F_m + F_e Ω² cos Ωτ, up and down in Ω.

    Lengths are in units of half the backlash, times in those of the linear oscillator's 1/ω_n.
    """

    damping: float  # ζ
    mean_force: float  # F_m
    error_amplitude: float  # F_e, amplitude of the transmission error
    stiffness_variation: float  # ε, of which no more than 1 makes sense
    frequencies: tuple[float, ...]  # Ω, increasing
    #: periods of the excitation marched at each frequency before a motion is called not periodic
    max_periods: int = 600
    unstable: bool = False  # whether branches are continued beyond the ends of their stable parts


_POINT = ("frequency", "direction")
_point = partial(Variable, _POINT, "1")
_MULTIPLIER = ("frequency", "direction", "multiplier")

FREQUENCY = Variable(
    ("frequency",), "1", "frequency of the excitation over the natural frequency of the oscillator in contact"
)
DIRECTION = Variable(("direction",), "1", "sense in which the frequency was followed")
MULTIPLIER = Variable(("multiplier",), "1", "number of the Floquet multiplier, largest modulus first")
UNSTABLE_MOTION = Variable(
    ("unstable",), "1", "number of the unstable motion, those of a branch in its order"
)

SAMPLES: dict[str, Variable] = {
    "rms_displacement": _point("root mean square of the displacement about its mean, in half backlashes"),
    "peak_to_peak_displacement": _point("peak to peak of displacement, in half backlashes"),
    "mean_displacement": _point("mean displacement, in half backlashes"),
    "contact_loss_fraction": _point("share of the time without contact"),
    "back_contact_fraction": _point("share of the time in contact on the back side"),
    "period": _point("periods of the excitation in one of the motion; 0: not periodic"),
    "stable": _point(
        "1: the motion is periodic and stable; 0: it is not periodic, and its figures are over 100 periods "
        "of the excitation; NaN: it grew without bound"
    ),
    "multiplier_modulus": Variable(
        _MULTIPLIER,
        "1",
        "modulus of the Floquet multipliers over one period of the motion; NaN where it is not periodic",
    ),
    "multiplier_angle": Variable(_MULTIPLIER, "rad", "angle of the Floquet multipliers"),
    "motion": flag(
        _POINT,
        "kind of motion: 0 grown without bound, 1 periodic, 2 not periodic, undecided which, "
        "3 quasi-periodic, 4 chaotic, 5 of a longer period than is sought",
        "unbounded periodic not_periodic quasi_periodic chaotic longer_period",
        0,
    ),
    "residual": _point("maximum change of displacement and velocity over one period"),
    "section_displacement": _point("displacement at the maximum excitation, in half backlashes"),
    "section_velocity": _point("velocity there, in half backlashes times natural frequency"),
}

_END = ("end",)
_end = partial(Variable, _END, "1")
ENDS: dict[str, Variable] = {
    "end_kind": branches.kind_variable("how the branch ends that is left there"),
    "end_frequency": _end("frequency at which a branch ends"),
    "end_within": _end("distance between the frequencies that locate the end"),
    "end_direction": flag(_END, "sense in which the frequency was followed: 0 up, 1 down", "up down", 0),
    **branches.COMMON,
}

_MOTION = ("unstable",)
_motion = partial(Variable, _MOTION, "1")
UNSTABLE: dict[str, Variable] = {
    "unstable_end": _motion("number of the end beyond which the branch goes on", "<i4", 0),
    "unstable_frequency": _motion("frequency of the excitation of an unstable motion"),
    "unstable_period": _motion("periods of the excitation in one of the motion", "<i4", 0),
    "unstable_rms_displacement": _motion(
        "root mean square of its displacement about the mean, in half backlashes"
    ),
    "unstable_peak_to_peak_displacement": _motion("peak to peak of its displacement, in half backlashes"),
    "unstable_contact_loss_fraction": _motion("share of the time without contact"),
    "unstable_multiplier_modulus": _motion("maximum modulus of its Floquet multipliers, above 1"),
    "unstable_multiplier_angle": Variable(_MOTION, "rad", "angle of that multiplier"),
    "unstable_residual": _motion("change of displacement and velocity over one period"),
    "unstable_section_displacement": _motion(
        "its displacement at the maximum excitation, in half backlashes"
    ),
    "unstable_section_velocity": _motion("velocity there"),
    "end_unstable_finish": branches.kind_variable(
        "how the branch beyond stops being unstable; none: it leaves the range, or is lost"
    ),
    "end_unstable_finish_frequency": _end("frequency at which it stops being unstable"),
}

LAYOUT = Layout(
    FREQUENCY,
    SAMPLES,
    {"direction": DIRECTION, "multiplier": MULTIPLIER, "end": branches.END},
    ENDS,
    groups={"mesh_cycle": {}, "geometry": {}},
)
#: Of a case that asks for unstable motions.
LAYOUT_WITH_UNSTABLE = LAYOUT._replace(
    scales={**LAYOUT.scales, "unstable": UNSTABLE_MOTION}, others={**ENDS, **UNSTABLE}
)


#: Periods that a motion takes that settles; the least damping that is looked at.
SETTLED, LEAST_DAMPING = 30.0, 1e-6


def estimate(case: BacklashOscillatorCase) -> Estimate:
    """What a run of a case takes."""
    count = len(case.frequencies)
    settling = min(float(case.max_periods), SETTLED / max(case.damping, LEAST_DAMPING))
    longest = sum(2.0 * math.pi / frequency for frequency in case.frequencies)
    drivers = (
        CostKey("frequency", count, 400),
        CostKey("solver.max_periods", case.max_periods, 600),
        CostKey("frequency", longest / count, 10.0, "leave out the lowest"),
    )
    record = recorded(LAYOUT, {"frequency": count, "direction": 2, "multiplier": 2}, copies=4.0)
    return total(drivers, record, forced_periods(2.0 * settling * count, 2.0 * settling * longest))


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
