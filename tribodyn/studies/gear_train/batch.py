"""Many cases of a train's dynamics, evaluated together."""

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.errors import InputError
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.studies.gear_train.case import TrainCase, refuse_long_period
from tribodyn.studies.gear_train.estimate import drivers_of, marching_of
from tribodyn.studies.gear_train.planetary.frames import rolling_of
from tribodyn.studies.gear_train.planetary.jamming import jams
from tribodyn.studies.gear_train.planetary.results import stage_quantities, worst_stage
from tribodyn.studies.gear_train.prepare import PreparedTrain, prepare, tabulated
from tribodyn.studies.gear_train.report import SWEPT
from tribodyn.studies.gear_train.sensed import listener_of
from tribodyn.studies.gear_train.summary import meshes_of_run, steady_quantities, worst_of
from tribodyn.studies.gear_train.warmth import at_own_temperatures
from tribodyn.studies.gears.batch import MotionBatch
from tribodyn.studies.gears.batch.kind import Form, Pace, SweptKind
from tribodyn.studies.gears.batch.swept import SweepSettings, state_names
from tribodyn.studies.gears.over_time.extremes import RunningExtremes
from tribodyn.studies.gears.over_time.running import MeshOfRun
from tribodyn.studies.gears.over_time.sampled import Sampled
from tribodyn.studies.gears.same_table import table_key
from tribodyn.studies.gears.sensed.listening import Listener
from tribodyn.studies.gears.tabulated import Tabulated
from tribodyn.studies.protocol.cost import Driver, Estimate
from tribodyn.studies.sweeping.batch import Batch
from tribodyn.train.structure import TrainLayout

#: What a sweep keeps of every mesh; the name of the dataset is that of the quantity and `OF_MESH`.
KEPT = (
    *("transmission_error_peak_to_peak", "dynamic_factor", "contact_loss_fraction", "hertz_pressure_max"),
    *("film_parameter_min", "efficiency", "power_friction_mean", "bulk_temperature"),
)
OF_MESH = "_of_mesh"
OF_MESHES = {name + OF_MESH: QUANTITIES[name].variable()._replace(dims=("mesh",)) for name in KEPT}
#: States of a train that bounds the memory of a sweep before it is known.
_MOST_STATES = 64


class Trains(SweptKind):
    """See `gears.batch.kind.SweptKind`."""

    swept = SWEPT
    of_meshes = OF_MESHES
    most_states = _MOST_STATES

    def form(self, cases: Sequence[TrainCase]) -> Form:
        """That of the first case."""
        short = replace(cases[0], max_period=1)  # nothing of it depends on how much is laid out
        prepared = self.prepare(short, self.tables(short))
        layout, meshes = prepared.model.layout, tuple(mesh.name for mesh in cases[0].meshes)
        states = state_names(prepared.names, layout.planar, meshes, layout.spatial)
        return Form(int(layout.half) - 1, states, cases[0].period, meshes)

    def table_key(self, case: TrainCase) -> Hashable:
        """Those of all its meshes."""
        return tuple(table_key(mesh.pair) for mesh in case.meshes)

    def tables(self, case: TrainCase) -> tuple[Tabulated, ...]:
        """Those of all its meshes."""
        return tabulated(case)

    def prepare(self, case: TrainCase, tabulated: tuple[Tabulated, ...]) -> PreparedTrain:
        """Prepare it."""
        return prepare(case, tabulated)

    def refuse(self, case: TrainCase) -> None:
        """Refuse a common period that is too long."""
        refuse_long_period(case)

    def meshes(self, prepared: PreparedTrain) -> list[MeshOfRun]:
        """Its meshes."""
        return meshes_of_run(prepared)

    def pace(self, case: TrainCase) -> Pace:
        """That of the body that drives the first mesh."""
        speed = case.source.speed / float(case.bodies[case.source.body].ratio)
        cycles = abs(float(case.meshes[0].pair.drive.pinion.teeth)) * rolling_of(case)
        slowest = min(float(body.ratio) for body in case.bodies if body.gears and body.ratio)
        return Pace(speed, cycles, cycles / slowest)

    def differ(self, case: TrainCase) -> bool:
        """Whether one of its gears has teeth that do."""
        return any(any(mesh.pair.teeth) for mesh in case.meshes)

    def listener(self, prepared: PreparedTrain) -> Listener:
        """See `sensed.listener_of`."""
        return listener_of(prepared)

    def frequencies(self, prepared: PreparedTrain) -> np.ndarray:
        """Its natural frequencies."""
        return natural_frequencies(prepared.model, [made.cycle for made in prepared.made])

    def places(self, prepared: PreparedTrain, settings: SweepSettings) -> list[int]:
        """All: a sweep is of trains of one structure."""
        layout: TrainLayout = prepared.model.layout
        meshes = [mesh.name for mesh in prepared.case.meshes]
        names = state_names(prepared.names, layout.planar, meshes, layout.spatial)
        if names != settings.states or prepared.case.period != settings.common:
            rule = "the bodies, the meshes or the common period are not those of the first case"
            raise InputError("vary", None, rule, "sweep it apart, or run it alone")
        return list(range(layout.states))

    def steady_quantities(
        self,
        inside: Sampled,
        work: np.ndarray,
        prepared: PreparedTrain,
        samples: int,
        extremes: Sequence[RunningExtremes],
    ) -> tuple[dict[str, Any], dict[str, np.ndarray], Sequence[Mapping[str, Any]]]:
        """Those of its run."""
        meshes = meshes_of_run(prepared)
        whole, each = steady_quantities(inside.meshes, work, prepared, meshes, samples, extremes)
        found = {
            name + OF_MESH: np.array([mesh.get(name, np.nan) for mesh in each], dtype=float) for name in KEPT
        }
        if prepared.case.sets:
            whole |= worst_stage(stage_quantities(prepared, inside.meshes, each))
        return whole | worst_of(each), found, each

    def warmer(self, case: TrainCase, row: Mapping[str, Any]) -> TrainCase | None:
        """The case with every mesh at the temperature of its own loss; None: all are."""
        if case.meshes[0].pair.temperature is None:
            return None
        warm, lost = (row[name + OF_MESH].tolist() for name in ("bulk_temperature", "power_friction_mean"))
        return at_own_temperatures(case, warm, lost)

    def warnings(self, prepared: PreparedTrain) -> list[str]:
        """See `jamming.jams`."""
        return jams(prepared)

    def sliding(self, case: TrainCase) -> str:
        """Its `friction.sliding`."""
        return case.meshes[0].pair.friction.sliding

    def drivers(self, case: TrainCase) -> tuple[Driver, ...]:
        """See `estimate.drivers_of`."""
        return drivers_of(case)

    def marching(self, case: TrainCase, cycles: float) -> list[Estimate]:
        """See `estimate.marching_of`."""
        return marching_of(case, cycles)


BATCH: Batch = MotionBatch(Trains())
