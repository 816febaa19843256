"""What the evaluation of many gearboxes together needs of each: tables, states, meshes, pace, quantities."""

from collections.abc import Hashable, Mapping, Sequence
from fractions import Fraction
from math import ceil
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.recorded.outputs import Sampled
from tribodyn.errors import InputError
from tribodyn.gears.bearings_in_time import cages_turn
from tribodyn.gears.motion.extremes import RunningExtremes
from tribodyn.gears.tabulated import table_key
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.record.sweep_schema import OF_MESH as OF_MESH
from tribodyn.studies.motion.assembly import PreparedGearbox, teeth_differ
from tribodyn.studies.motion.batch.swept import SweepSettings, state_names
from tribodyn.studies.motion.case import Gearbox, refuse_long_period
from tribodyn.studies.motion.heat.thermal_iteration import at_own_temperatures
from tribodyn.studies.motion.planetary.frames import rolling_of
from tribodyn.studies.motion.planetary.results import meshes_of_set, stage_quantities, worst_stage
from tribodyn.studies.motion.prepare import coordinates_of_no_body, structure_of
from tribodyn.studies.motion.summary import concluded, meshes_of_run, steady_quantities

#: What a sweep keeps of every mesh; the name of the dataset is that of the quantity and `OF_MESH`.
KEPT = (
    *("transmission_error_peak_to_peak", "dynamic_factor", "contact_loss_fraction", "hertz_pressure_max"),
    *("film_parameter_min", "friction_coefficient_mean", "transmission_error_mean", "mesh_frequency"),
    *("efficiency", "power_friction_mean", "bulk_temperature", "mesh_load_factor"),
)
OF_MESHES = {name + OF_MESH: QUANTITIES[name].variable()._replace(dims=("mesh",)) for name in KEPT}
#: States that bound the memory of a sweep before its cases are known.
MOST_STATES = 64


class RunSpeed(NamedTuple):
    """How fast a case goes."""

    speed: float  # of the reference body, rad/s
    cycles: float  # of the reference mesh in a turn of it
    slowest: float  # and in a turn of the gear that turns slowest


class SweepShape(NamedTuple):
    """What the cases of a sweep have in common."""

    modes: int  # at most
    states: tuple[str, ...]  # names of all
    periods: tuple[int, ...] = (1,)  # mesh cycles after which all meshes are at their phases again, of each
    meshes: tuple[str, ...] = ()  # names of all, where files name them
    planetary: bool = False  # whether one has planetary stages


def shape_of(cases: Sequence[Gearbox]) -> SweepShape:
    """States, modes, common periods and meshes of all cases, of the one with most states first."""
    boxes = sorted(cases, key=lambda box: -len(states_of(box)[0]))
    states = tuple(dict.fromkeys(name for box in boxes for name in states_of(box)[0]))
    meshes = tuple(dict.fromkeys(mesh.name for box in boxes for mesh in box.meshes if box.named))
    periods = tuple(sorted({box.period for box in boxes}))
    modes = max(states_of(box)[1] for box in boxes)
    return SweepShape(modes, states, periods, meshes, any(box.sets for box in boxes))


def states_of(case: Gearbox) -> tuple[tuple[str, ...], int]:
    """Names of the states, and the number of modes."""
    names, planar, spatial = structure_of(case)
    meshes = [mesh.name for mesh in case.meshes]
    if not case.named:
        names, meshes = [name[0] for name in names], [""]
    further = coordinates_of_no_body(case)
    every = state_names(names, planar, meshes, spatial, further)
    return every, 2 * planar + len(names) + 3 * spatial + further - 1


def keys_of_tables(case: Gearbox) -> Hashable:
    """Everything that the tables of a case depend on."""
    return tuple(map(table_key, case.pairs))


def refuse_by_time(case: Gearbox) -> None:
    """Raise InputError for a case that is run by time: batches go by the rotation."""
    if case.in_time:
        rule = "is of a run by time, and cases beside each other go by the rotation"
        remedy = "give solver.cycles in its place, or run the scenarios one by one"
        raise InputError("solver.duration", f"{case.solver.duration:g} s", rule, remedy)


def refuse_steady(case: Gearbox) -> None:
    """Raise InputError for a case that has no steady state that could be sought."""
    if teeth_differ(case):
        turn = ceil(run_speed_of(case).slowest)
        rule = "teeth of a gear differ: no steady state repeats with the mesh, and none is sought"
        remedy = f"march: --transient {10 * turn} ({turn} mesh cycles are a turn of the slowest gear), or "
        remedy += "keep what sensors hear: --signals 1s"
        raise InputError("--steady", None, rule, remedy)
    if cages_turn(case.system):
        rule = 'a bearing has force = "in-time": its cage turns at no rate of the meshes, nothing repeats'
        remedy = "march: --transient 100, or keep what sensors hear: --signals 1s; or leave force out"
        raise InputError("--steady", None, rule, remedy)
    refuse_long_period(case)


def run_speed_of(case: Gearbox) -> RunSpeed:
    """How fast a case goes."""
    speed = case.source.speed / float(case.bodies[case.source.body].ratio)
    teeth = Fraction(abs(case.gears[case.meshes[0].gears[0]].teeth))
    slowest = min(body.ratio for body in case.bodies if body.gears and body.ratio)
    rolling = rolling_of(case)
    return RunSpeed(speed, float(teeth) * rolling, float(teeth / slowest) * rolling)


def places_of(prepared: PreparedGearbox, settings: SweepSettings) -> list[int]:
    """Places of a case's states among those of the sweep; InputError where they do not fit."""
    names, _ = states_of(prepared.case)
    if new := set(names).difference(settings.states):
        rule = (
            f"has states that none of the cases has by which the sweep was laid out: {', '.join(sorted(new))}"
        )
        raise InputError("vary", None, rule, "sweep it apart, or run it alone")
    return [settings.states.index(name) for name in names]


def mesh_places(case: Gearbox, settings: SweepSettings) -> list[int]:
    """Places of a case's meshes among those of the sweep."""
    return [settings.meshes.index(mesh.name) for mesh in case.meshes]


def quantities_over(
    inside: Sampled,
    work: np.ndarray,
    prepared: PreparedGearbox,
    samples: int,
    extremes: Sequence[RunningExtremes],
) -> tuple[dict[str, Any], dict[str, np.ndarray], Sequence[Mapping[str, Any]]]:
    """Quantities over a window: of the case, of each mesh for `OF_MESHES`, and of each mesh to judge."""
    whole, each = steady_quantities(inside.meshes, work, prepared, meshes_of_run(prepared), samples, extremes)
    stages = stage_quantities(prepared, inside.meshes, each) if prepared.case.sets else {}
    of_meshes = {}
    if prepared.case.named:
        for gearset in prepared.case.sets:
            for m in meshes_of_set(prepared.case, gearset):
                each[m]["mesh_load_factor"] = stages[gearset.name]["mesh_load_factor"]
        of_meshes = {
            name + OF_MESH: np.array([mesh.get(name, np.nan) for mesh in each], dtype=float) for name in KEPT
        }
    if stages:
        whole |= worst_stage(stages)
    return concluded(prepared, whole, each), of_meshes, each


def warmer(case: Gearbox, row: Mapping[str, Any], settings: SweepSettings) -> Gearbox | None:
    """The case with every mesh at the temperature of its own loss, `row` of a sweep; None: all are."""
    if case.meshes[0].pair.temperature is None:
        return None
    names = ("bulk_temperature", "power_friction_mean")
    warm, lost = (
        row[name + OF_MESH][mesh_places(case, settings)].tolist() if case.named else [float(row[name])]
        for name in names
    )
    return at_own_temperatures(case, warm, lost)
