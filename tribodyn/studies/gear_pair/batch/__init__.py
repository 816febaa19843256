"""Many cases of a gear pair's dynamics, evaluated together: steady states, or marches of a given length."""

from collections.abc import Sequence

from tribodyn.errors import InputError
from tribodyn.solve.methods import Runs, runs
from tribodyn.solve.orbit.motions import MAX_PERIOD
from tribodyn.solve.orbit.periodic import refuse_time_dependent
from tribodyn.studies.gear_pair.batch.evaluate import SweepSettings, evaluate, tabulated
from tribodyn.studies.gear_pair.case import MOST_STATES, STEADY_CYCLES, Case, estimate_in_sweep
from tribodyn.studies.gear_pair.prepare import prepare
from tribodyn.studies.gear_pair.report import layout_of, row_bytes
from tribodyn.studies.gears.same_table import table_key
from tribodyn.studies.protocol.cost import Estimate
from tribodyn.studies.sweeping.batch import Batch

#: Mesh cycles that the search for a steady state may take, that its window has (whole periods), and points of
#: the section of a motion that has no period.
MOST_CYCLES, STEADY_WINDOW, STEADY_POINTS = 2000, MAX_PERIOD, 256
#: The same of a transient: a quarter of its cycles, at most this many; points of its section, half of them.
TRANSIENT_WINDOW, TRANSIENT_POINTS = 16, 256
#: Modes without a compliant shaft, and with one.
MODES, MODES_WITH_SHAFT = 5, 6
#: Bytes of states that the cases of a chunk may fill: what bounds the memory of a sweep.
CHUNK_BYTES = 64 * 2**20
MOST_IN_CHUNK = 256
#: A sweep is done in at least this many chunks, so that its progress shows; but in none of fewer cases.
CHUNKS, MINIMUM_IN_CHUNK = 16, 32


class GearPairs:
    """See `sweeping.batch.Batch`."""

    states = MOST_STATES
    layout = staticmethod(layout_of)
    sharing = staticmethod(table_key)
    evaluate = staticmethod(evaluate)

    def settings(self, cases: Sequence[Case], transient: int | None, engine: str) -> SweepSettings:
        """How the cases are brought to their windows."""
        base = cases[0]
        samples = base.output.samples_per_cycle
        shaft = any(case.operating.shaft_stiffness is not None for case in cases)
        modes = MODES_WITH_SHAFT if shaft else MODES
        through_jax = engine == "jax" and runs(base.solver.method) is not Runs.JAX
        method = "tsit5" if through_jax else ""
        if transient is None:
            return SweepSettings(True, MOST_CYCLES, STEADY_WINDOW, STEADY_POINTS, samples, modes, method)
        window = max(1, min(TRANSIENT_WINDOW, transient // 4))
        points = max(window, min(TRANSIENT_POINTS, transient // 2))
        return SweepSettings(False, transient, window, points, samples, modes, method)

    def following(self, settings: SweepSettings, unstable: bool) -> SweepSettings:
        """Steady motions are followed to the ends of their branches, and only these go on beyond them."""
        if unstable and not settings.steady:
            rule = "continues steady motions, which --transient has none of"
            raise InputError("--unstable", None, rule, "omit one")
        return settings._replace(followed=settings.steady, unstable=unstable)

    def size_of_chunk(self, settings: SweepSettings, total: int, width: int) -> int:
        """Cases to be evaluated together, by the room that their windows take."""
        by_room = max(
            1, min(MOST_IN_CHUNK, CHUNK_BYTES // (settings.window * settings.samples * MOST_STATES * 8))
        )
        return max(width, min(by_room, max(MINIMUM_IN_CHUNK, total // CHUNKS)))

    def estimate(self, case: Case, settings: SweepSettings, total: int, width: int) -> Estimate:
        """What one of so many cases takes."""
        together = min(total, self.size_of_chunk(settings, total, width))
        taken = estimate_in_sweep(
            case, STEADY_CYCLES if settings.steady else settings.cycles, settings.window, together
        )
        return taken._replace(record=row_bytes(settings))

    def check(self, case: Case, settings: SweepSettings) -> None:
        """Prepare a case; a steady state needs a load that does not change with time."""
        model = prepare(case, tabulated(case)).model
        if settings.steady:
            refuse_time_dependent(model)


BATCH: Batch = GearPairs()
