"""Many cases of the dynamics of gears, evaluated together: steady states, or marches of a given length."""

from collections.abc import Hashable, Sequence
from math import ceil, pi
from typing import Any

import numpy as np

from tribodyn.cases import cost
from tribodyn.cases.cost import Estimate
from tribodyn.errors import InputError
from tribodyn.gears.case import OF_PLANETS
from tribodyn.record.sweep_schema import SweepLayout
from tribodyn.solve.methods import Runs, runs
from tribodyn.solve.orbit.motions import MAX_PERIOD
from tribodyn.solve.orbit.periodic import refuse_time_dependent
from tribodyn.studies.motion.assembly import teeth_differ
from tribodyn.studies.motion.batch.evaluate import at_length, evaluate
from tribodyn.studies.motion.batch.gearboxes import (
    MOST_STATES,
    OF_MESHES,
    keys_of_tables,
    refuse_by_time,
    refuse_steady,
    run_speed_of,
    shape_of,
)
from tribodyn.studies.motion.batch.signals import SignalBatch, SignalSettings
from tribodyn.studies.motion.batch.swept import SweepSettings, layout_of, row_bytes
from tribodyn.studies.motion.case import refuse_long_period
from tribodyn.studies.motion.estimate import cost_keys, marching_of
from tribodyn.studies.motion.heat.settled import prepare_settled
from tribodyn.studies.motion.report import SWEPT
from tribodyn.studies.protocol.batch import Batch, Chunk, SignalRequest

#: Mesh cycles that the search for a steady state may take, and points of the section of a motion that has no
#: period.
MOST_CYCLES, STEADY_POINTS = 2000, 256
#: Mesh cycles until most steady states are found.
STEADY_CYCLES = 60
#: Cycles of the window of a transient: a quarter of its own, at most this many (of gears whose teeth differ a
#: turn of the slowest); points of its section, half.
TRANSIENT_WINDOW, TRANSIENT_POINTS = 16, 256
#: Bytes of states that the cases of a chunk may fill: what bounds the memory of a sweep.
CHUNK_BYTES = 64 * 2**20
MOST_IN_CHUNK = 256
#: A sweep is done in at least this many chunks, so that its progress shows; but in none of fewer cases.
CHUNKS, MINIMUM_IN_CHUNK = 16, 32
#: Common periods of several meshes whose window is kept: motions of longer periods are not sampled.
MOST_SAMPLED = 64


class MotionBatch:
    """See `protocol.batch.Batch`."""

    states = MOST_STATES

    def turn(self, case: Any) -> float:
        """Time of a turn of the reference body at nominal speed, s."""
        return 2.0 * pi / run_speed_of(case).speed

    def layout(self, settings: SweepSettings) -> SweepLayout:
        """What is recorded of every case."""
        swept = [each for each in SWEPT if settings.planetary or each not in OF_PLANETS]
        return layout_of(settings, swept, OF_MESHES)

    def sharing(self, case: Any) -> Hashable:
        """Cases for which this is equal have the same tables."""
        return keys_of_tables(case)

    def settings(self, cases: Sequence[Any], transient: int | None, engine: str) -> SweepSettings:
        """How the cases are brought to their windows."""
        base, boxes = cases[0], cases
        refuse_by_time(base)
        if transient is None:
            # a case whose common period is too long fails by itself
            if not (boxes := [box for box in boxes if box.period <= box.max_period]):
                refuse_long_period(base)
        form = shape_of(boxes)
        samples, common = base.output.samples_per_cycle, form.periods[-1]
        through_jax = engine == "jax" and runs(base.solver.method) is not Runs.JAX
        method = "tsit5" if through_jax else ""
        if transient is None:
            window, points = max(1, min(MAX_PERIOD, MOST_SAMPLED // common)) * common, STEADY_POINTS
            cycles = max(MOST_CYCLES, 20 * common)
        else:
            differ = any(map(teeth_differ, cases))
            widest = max(ceil(run_speed_of(case).slowest) for case in cases) if differ else TRANSIENT_WINDOW
            window = max(1, min(widest, transient // 4))
            window = max(1, window // common) * common if common <= transient else window
            points, cycles = max(window, min(TRANSIENT_POINTS, transient // 2)), transient
            points = max(1, points // common)
        return SweepSettings(
            steady=transient is None,
            cycles=cycles,
            window=window,
            points=points,
            samples=samples,
            modes=form.modes,
            states=form.states,
            method=method,
            common=common,
            periods_differ=len(form.periods) > 1,
            meshes=form.meshes,
            planetary=form.planetary,
        )

    def following(self, settings: SweepSettings, unstable: bool) -> SweepSettings:
        """Steady motions are followed to the ends of their branches, and only these go on beyond them."""
        if unstable and not settings.steady:
            rule = "continues steady motions, which --transient has none of"
            raise InputError("--unstable", None, rule, "omit one")
        return settings._replace(followed=settings.steady, unstable=unstable)

    def size_of_chunk(self, settings: SweepSettings, total: int, width: int) -> int:
        """Cases to be evaluated together, by the room that their windows take."""
        room = settings.window * settings.samples * len(settings.states) * 8
        by_room = max(1, min(MOST_IN_CHUNK, CHUNK_BYTES // room))
        return max(width, min(by_room, max(MINIMUM_IN_CHUNK, total // CHUNKS)))

    def estimate(self, case: Any, settings: SweepSettings, total: int, width: int) -> Estimate:
        """What one of so many cases takes."""
        together = min(total, self.size_of_chunk(settings, total, width))
        cycles = max(STEADY_CYCLES, 4 * settings.common) if settings.steady else settings.cycles
        marched = () if settings.steady else (cost.CostKey("--transient", cycles, STEADY_CYCLES),)
        samples = float(case.output.samples_per_cycle)
        one = cost.total(
            (*cost_keys(case), *marched),
            *marching_of(case, float(cycles)),
            cost.in_memory(3.0 * together * settings.window * samples, len(settings.states) * 8.0),
            cost.in_memory(settings.window * samples, cost.SAMPLE_BYTES),
            cost.Estimate(seconds=cost.MARCHED_SAMPLE * settings.window * samples),
        )
        # sizes without the scales: as many samples may be asked for as no memory holds
        small = self.layout(settings._replace(samples=1, points=1))
        return one._replace(record=row_bytes(small, settings))

    def check(self, case: Any, settings: SweepSettings) -> None:
        """Prepare a case; a steady state needs a load that does not change with time."""
        refuse_by_time(case)
        model = prepare_settled(at_length(case, settings)).model
        if settings.steady:
            refuse_steady(case)
            refuse_time_dependent(model)

    def hearing(self, request: SignalRequest) -> SignalBatch:
        """What gives the signals of the cases' sensors in place of motions."""
        return SignalBatch(request)

    def evaluate(self, chunk: Chunk, settings: Any, workers: int | None) -> dict[str, np.ndarray]:
        """Return a row for every case of a chunk, for all datasets of its layout; by default by all cores."""
        if isinstance(settings, SignalSettings):  # of a worker that was given no more than the settings
            return SignalBatch().evaluate(chunk, settings, workers)
        return evaluate(self.layout(settings), chunk, settings, workers)


BATCH: Batch = MotionBatch()
