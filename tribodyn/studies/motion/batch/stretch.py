"""Which cycles of a run are listened to, and how finely the motion is sampled in them."""

from collections.abc import Sequence
from math import ceil, floor, pi
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.gears.sensing.listening import BLOCK
from tribodyn.signals.resampling import REACH
from tribodyn.studies.motion.batch.gearboxes import RunSpeed, run_speed_of
from tribodyn.studies.protocol.batch import SignalRequest

#: Samples of the motion for each of a sensor's. What the motion has above half of them folds back; of
#: accelerations at 20 kHz 0.2 % of the signal, 6 % with 1.5 samples.
OVERSAMPLED = 6.0
FEWEST_SAMPLES = 16
#: What filters take before and behind a sample, in their `REACH` over the rate; half as much again to spare.
_AROUND = 3.0
#: Samples of the motion that are held at once of a case, where they are more than a cycle; and those of a
#: cycle at most: 0.7 GB where forces are heard.
SAMPLES_AT_ONCE, MOST_SAMPLES = 2**16, 2**18


class ListenedStretch(NamedTuple):
    """When a case is listened to."""

    first: int  # cycles before
    blocks: int
    start: float  # s, at which its signals begin: the slowest sensor has a sample there
    noise_seed: int


class HeardStretch(NamedTuple):
    """Which cycles of a case are listened to, and how."""

    first: int  # cycles before
    blocks: int
    block: int  # cycles
    samples: int  # of a cycle
    period: float  # of a cycle, s

    @property
    def cycles(self) -> int:
        """Of the whole run."""
        return self.first + self.block * self.blocks


def samples_per_cycle(rates: Sequence[float], paces: Sequence[RunSpeed]) -> int:
    """Samples of a reference cycle that the fastest sensor asks of the slowest case."""
    slowest = min(pace.speed * pace.cycles for pace in paces) / (2.0 * pi)  # reference cycles per second
    return max(FEWEST_SAMPLES, ceil(OVERSAMPLED * max(rates) / slowest))


def stretch_of(case: Any, number: int, request: SignalRequest, rates: Sequence[float]) -> ListenedStretch:
    """When the case of a number is listened to: from the moment drawn for it, as long as signals are."""
    random = np.random.default_rng([request.seed, number])
    pace = run_speed_of(case)
    turn = 2.0 * pi / pace.speed
    reach = _AROUND * REACH / min(rates)
    start = (request.run_in + random.random()) * turn + reach
    start = ceil(start * min(rates)) / min(rates)
    first = floor(request.run_in * pace.cycles)
    cycles = ceil((start + request.duration + reach) / turn * pace.cycles) - first
    return ListenedStretch(first, ceil(cycles / BLOCK), start, int(random.integers(2**31)))


def between(case: Any, earliest: float, last: float) -> HeardStretch:
    """The cycles of a case that hold the signals of its sensors between two times, s."""
    pace, rates = run_speed_of(case), [sensor.rate for sensor in case.sensors]
    frequency = pace.speed * pace.cycles / (2.0 * pi)  # of the reference mesh
    samples = max(samples_per_cycle(rates, [pace]), case.output.samples_per_cycle)
    block = max(1, min(BLOCK, SAMPLES_AT_ONCE // samples))
    reach = _AROUND * REACH / min(rates)
    first = max(0, floor((earliest - reach) * frequency))
    return HeardStretch(
        first, ceil(((last + reach) * frequency - first) / block), block, samples, 1.0 / frequency
    )


def few_enough(stretch: HeardStretch) -> int:
    """Samples of a cycle of a stretch; InputError for a case that is too slow for its sensors."""
    if stretch.samples > MOST_SAMPLES:
        rule = (
            f"a mesh cycle takes {stretch.period:.3g} s, in which the fastest sensor asks for "
            f"{stretch.samples} samples of the motion, at most {MOST_SAMPLES} are held"
        )
        raise InputError("sensor.rate", None, rule, "turn faster, or sample more slowly")
    return stretch.samples
