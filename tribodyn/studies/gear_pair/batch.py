"""Many cases of a gear pair's dynamics, evaluated together."""

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.studies.gear_pair.case import Case, drivers_of, marching_of
from tribodyn.studies.gear_pair.outputs import MESH
from tribodyn.studies.gear_pair.prepare import PreparedPair, prepare
from tribodyn.studies.gear_pair.report import SWEPT
from tribodyn.studies.gear_pair.summary import mesh_of_run, steady_quantities
from tribodyn.studies.gears.batch import MotionBatch
from tribodyn.studies.gears.batch.kind import Form, SweptKind
from tribodyn.studies.gears.extremes import RunningExtremes
from tribodyn.studies.gears.prepare import at_own_temperature, thermal_quantities
from tribodyn.studies.gears.running import MeshOfRun
from tribodyn.studies.gears.same_table import table_key
from tribodyn.studies.gears.sampled import Sampled
from tribodyn.studies.gears.swept import SweepSettings
from tribodyn.studies.gears.tabulated import Tabulated, tables
from tribodyn.studies.protocol.cost import Driver, Estimate
from tribodyn.studies.sweeping.batch import Batch
from tribodyn.train.structure import TrainLayout

#: Modes without a compliant shaft, and with one; and how many more where the gears move in space.
MODES, MODES_WITH_SHAFT, MODES_IN_SPACE = 5, 6, 6
#: Names of the states of a pair with a motor behind a shaft, as `train.structure.TrainLayout` has them.
STATE_NAMES = (
    *("x_p", "y_p", "lag", "x_g", "y_g", "turn_g", "turn_m"),
    *("vx_p", "vy_p", "slip", "vx_g", "vy_g", "spin_g", "spin_m"),
    *("work_in", "work_out", "work_damping", "work_parametric", "work_friction", "work_sliding"),
)
_OF_MOTOR = ("turn_m", "spin_m")
#: And of helical gears, behind the others.
IN_SPACE_NAMES = tuple(f"{name}_{body}" for body in "pg" for name in ("z", "tilt_x", "tilt_y"))
RATES_IN_SPACE_NAMES = tuple(f"v{name}" for name in IN_SPACE_NAMES)
ALL_NAMES = (*STATE_NAMES, *IN_SPACE_NAMES, *RATES_IN_SPACE_NAMES)


def state_places(layout: TrainLayout) -> list[int]:
    """Places of a pair's states among `ALL_NAMES`; without a shaft those of the motor are NaN."""
    motor, half = layout.bodies > 2, len(STATE_NAMES) // 2 - 3
    names = [*STATE_NAMES]
    if layout.spatial:
        names = [*names[:half], *IN_SPACE_NAMES, *names[half : 2 * half], *RATES_IN_SPACE_NAMES]
        names += STATE_NAMES[2 * half :]
    return [ALL_NAMES.index(name) for name in names if motor or name not in _OF_MOTOR]


class GearPairs(SweptKind):
    """See `gears.batch.evaluate.SweptKind`."""

    swept = SWEPT
    most_states = len(ALL_NAMES)

    def form(self, cases: Sequence[Case]) -> Form:
        """A mode more where a shaft gives way; six and their states more where teeth are helical."""
        shaft = any(case.operating.shaft_stiffness is not None for case in cases)
        modes = MODES_WITH_SHAFT if shaft else MODES
        if any(case.mesh.slices > 1 or float(case.drive.helix_angle) for case in cases):
            return Form(modes + MODES_IN_SPACE, ALL_NAMES)
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

    def frequencies(self, prepared: PreparedPair) -> np.ndarray:
        """Its natural frequencies."""
        return natural_frequencies(prepared.model, [prepared.cycle])

    def places(self, prepared: PreparedPair, settings: SweepSettings) -> list[int]:
        """See `state_places`."""
        return state_places(prepared.model.layout)

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
