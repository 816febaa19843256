"""Many cases of a gear pair's dynamics, evaluated together."""

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.studies.gear_pair.case import Case, drivers_of, marching_of
from tribodyn.studies.gear_pair.outputs import MESH
from tribodyn.studies.gear_pair.prepare import PreparedPair, moves_in_space, prepare
from tribodyn.studies.gear_pair.report import SWEPT
from tribodyn.studies.gear_pair.sensed import listener_of
from tribodyn.studies.gear_pair.summary import mesh_of_run, steady_quantities
from tribodyn.studies.gears.batch import MotionBatch
from tribodyn.studies.gears.batch.kind import Form, Pace, SweptKind
from tribodyn.studies.gears.batch.swept import SweepSettings
from tribodyn.studies.gears.over_time.extremes import RunningExtremes
from tribodyn.studies.gears.over_time.running import MeshOfRun
from tribodyn.studies.gears.over_time.sampled import Sampled
from tribodyn.studies.gears.prepare import at_own_temperature, thermal_quantities
from tribodyn.studies.gears.same_table import table_key
from tribodyn.studies.gears.sensed.listening import Listener
from tribodyn.studies.gears.tabulated import Tabulated, tables
from tribodyn.studies.protocol.cost import Driver, Estimate
from tribodyn.studies.sweeping.batch import Batch
from tribodyn.train.structure import TrainLayout

#: Modes without a compliant shaft, and with one.
MODES, MODES_WITH_SHAFT = 5, 6
#: Names of the states of a pair with a motor behind a shaft, as `train.structure.TrainLayout` has them.
STATE_NAMES = (
    *("x_p", "y_p", "lag", "x_g", "y_g", "turn_g", "turn_m"),
    *("vx_p", "vy_p", "slip", "vx_g", "vy_g", "spin_g", "spin_m"),
    *("work_in", "work_out", "work_damping", "work_parametric", "work_friction", "work_sliding"),
)
_OF_MOTOR = ("turn_m", "spin_m")
#: Modes that pairs have besides which move in space; their states along and about the axes, and the rates.
MODES_IN_SPACE = 6
_IN_SPACE, _RATES_IN_SPACE = (
    tuple(f"{name}_{body}" for body in "pg" for name in names)
    for names in (("z", "tilt_x", "tilt_y"), ("vz", "spin_x", "spin_y"))
)
_RATES, _WORKS = STATE_NAMES.index("vx_p"), STATE_NAMES.index("work_in")
#: And of sweeps in which a pair moves in space.
STATE_NAMES_IN_SPACE = (
    *(*STATE_NAMES[:_RATES], *_IN_SPACE),
    *(*STATE_NAMES[_RATES:_WORKS], *_RATES_IN_SPACE),
    *STATE_NAMES[_WORKS:],
)


def state_places(layout: TrainLayout, names: Sequence[str] = STATE_NAMES) -> list[int]:
    """Places of a pair's states among `names`; those of a motor or of space that it lacks are NaN."""
    lacking = () if layout.bodies > 2 else _OF_MOTOR
    lacking += () if layout.spatial else (*_IN_SPACE, *_RATES_IN_SPACE)
    return [i for i, name in enumerate(names) if name not in lacking]


class GearPairs(SweptKind):
    """See `gears.batch.evaluate.SweptKind`."""

    swept = SWEPT
    most_states = len(STATE_NAMES_IN_SPACE)

    def form(self, cases: Sequence[Case]) -> Form:
        """A mode more where a shaft gives way; more of both where a pair moves in space."""
        shaft = any(case.operating.shaft_stiffness is not None for case in cases)
        modes = MODES_WITH_SHAFT if shaft else MODES
        if any(moves_in_space(case, 2 if case.drive.helix_angle else 1) for case in cases):
            return Form(modes + MODES_IN_SPACE, STATE_NAMES_IN_SPACE)
        return Form(modes, STATE_NAMES)

    def table_key(self, case: Case) -> Hashable:
        """See `same_table`."""
        return table_key(case)

    def tables(self, case: Case) -> Tabulated:
        """Its table."""
        return tables(case)

    def prepare(self, case: Case, tabulated: Tabulated) -> PreparedPair:
        """Prepare it."""
        return prepare(case, tabulated)

    def meshes(self, prepared: PreparedPair) -> list[MeshOfRun]:
        """Its mesh."""
        return [mesh_of_run(prepared)]

    def pace(self, case: Case) -> Pace:
        """That of its pinion."""
        teeth = [abs(float(gear.teeth)) for gear in (case.drive.pinion, case.drive.gear)]
        return Pace(case.operating.pinion_speed, teeth[0], max(teeth))

    def differ(self, case: Case) -> bool:
        """Whether one of its gears has teeth that do."""
        return any(case.teeth)

    def listener(self, prepared: PreparedPair) -> Listener:
        """See `sensed.listener_of`."""
        return listener_of(prepared)

    def frequencies(self, prepared: PreparedPair) -> np.ndarray:
        """Its natural frequencies."""
        return natural_frequencies(prepared.model, [prepared.cycle])

    def places(self, prepared: PreparedPair, settings: SweepSettings) -> list[int]:
        """See `state_places`."""
        return state_places(prepared.model.layout, settings.states)

    def steady_quantities(
        self,
        inside: Sampled,
        work: np.ndarray,
        prepared: PreparedPair,
        samples: int,
        extremes: Sequence[RunningExtremes],
    ) -> tuple[dict[str, Any], dict[str, np.ndarray], Sequence[Mapping[str, Any]]]:
        """Those of its run."""
        window, speed = inside.meshes[MESH], prepared.case.operating.pinion_speed
        found = steady_quantities(window, work, prepared, samples, speed, extremes[MESH])
        found |= extremes[MESH].values()
        found |= thermal_quantities(prepared.thermal, found["power_in_mean"], found["efficiency"])
        return found, {}, [found]

    def warmer(self, case: Case, row: Mapping[str, Any]) -> Case | None:
        """See `gears.prepare.at_own_temperature`."""
        if case.temperature is None:
            return None
        return at_own_temperature(case, float(row["bulk_temperature"]), float(row["power_friction_mean"]))

    def sliding(self, case: Case) -> str:
        """Its `friction.sliding`."""
        return case.friction.sliding

    def drivers(self, case: Case) -> tuple[Driver, ...]:
        """See `case.drivers_of`."""
        return drivers_of(case)

    def marching(self, case: Case, cycles: float) -> list[Estimate]:
        """See `case.marching_of`."""
        return marching_of(case, cycles)


BATCH: Batch = MotionBatch(GearPairs())
