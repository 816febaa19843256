"""The part that a study plays in an assessment of a drive: what it runs, and what comes out of it.

A study that takes part has a module ``assess`` with ``ROLE``. An assessment goes through the registry, runs
the tasks of every role and puts their answers together; it knows no study by name.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, NamedTuple

import numpy as np

#: Share of the time without contact that counts.
CONTACT_LOST = 1e-6


class Request(NamedTuple):
    """What an assessment asks of the studies."""

    title: str
    #: tables ``drive``, ``lubricant``, ``bearings``, ``shaft``, ``mesh``, ``temperature`` and ``losses`` as a
    #: scenario has them, ``shaft`` and the last only where given; ``film`` that goes with the first friction
    #: law, where it is not the law's own; ``oil_temperature``, a quantity as text; ``damping_ratio``. For
    #: roles of the `GEARBOX` a scenario of it at the duty
    tables: Mapping[str, Any]
    #: pinion_speed, gear_torque: rad/s and N m; of a `GEARBOX` the speed of its input, and 0
    pinion_speed: float
    gear_torque: float
    torques: Sequence[float]  # over which the loaded error is asked for, N m, increasing
    #: over which steady states are asked for, rad/s, increasing; that of the duty is one of them
    speeds: Sequence[float]
    laws: Sequence[str]  # friction laws, the first of them for everything but the spread of the losses
    pitch_deviation: float  # base pitch deviation f_pb − y_α of the drive's tolerance class, m; 0: none
    #: samples of what is not known, whose scatter is asked for: keys of a scenario with these tables and the
    #: values that take the place of theirs. Those of `of_teeth` concern the gears, the others their motion
    samples: Sequence[Mapping[str, Any]]
    #: torques of the other duties of a load spectrum, N m, whose loads along the face are asked for
    spectrum_torques: Sequence[float] = ()
    #: mesh cycles that are marched in place of steady states where none repeats; 0: they do
    marched: int = 0

    def operating(self) -> dict[str, Any]:
        """Table ``operating`` of a scenario at the duty."""
        return {
            "pinion_speed": f"{self.pinion_speed!r} rad/s",
            "gear_torque": f"{self.gear_torque!r} N*m",
            "oil_temperature": self.tables["oil_temperature"],
        }

    def supports(self) -> dict[str, Any]:
        """Tables by which shafts tilt the gears, where there are any, for studies of the teeth alone."""
        tables = {"shaft": self.tables["shaft"]} if "shaft" in self.tables else {}
        bearings = self.tables.get("bearings", {})
        if any("matrix" in side for side in bearings.values() if isinstance(side, Mapping)):
            tables["bearings"] = bearings
        return tables


def of_teeth(sample: Mapping[str, Any]) -> dict[str, Any]:
    """Keys of a sample that concern the gears, not how they are borne and damped."""
    return {key: value for key, value in sample.items() if key in OF_TEETH}


#: Keys of `of_teeth`.
OF_TEETH = ("drive.centre_distance", "mesh.deviation_sample")


class Task(NamedTuple):
    """A scenario to be run."""

    name: str  # of its file
    about: str  # what it finds, in a few words: shown while it runs
    scenario: Mapping[str, Any]  # as a file has it, with its kind
    #: values by dotted key that each of several cases has in place of the scenario's: then only quantities
    #: are kept, one row per case. None: one run, with its record.
    cases: Sequence[Mapping[str, Any]] = ()
    #: a case -> further values of it, a mapping for each case that is evaluated with it
    further: Callable[[Any], Sequence[Mapping[str, Any]]] | None = None
    arrays: Sequence[str] = ()  # names of arrays that are kept of every case beside the study's quantities
    needed: bool = True  # whether the assessment ends where this cannot be run
    marched: int = 0  # mesh cycles that the cases are marched in place of their steady states; 0: those


class TaskResult(NamedTuple):
    """What a task gave."""

    path: Path  # the record of a run, or the file with the rows
    summary: Mapping[str, Any] = MappingProxyType({})  # of a run
    #: quantity -> values (n,) over the cases, arrays (n, …); NaN where a case failed
    rows: Mapping[str, np.ndarray] = MappingProxyType({})
    cases: Sequence[Mapping[str, Any]] = ()  # those of the rows, the further ones included
    #: what could not be computed, and why; of a run that is not needed there is no summary then
    failures: Sequence[str] = ()


class ReportCurve(NamedTuple):
    """A picture for the report: named lines over an axis, in the units that the labels say."""

    title: str
    x_label: str
    y_label: str
    x: Any
    lines: Mapping[str, Any]
    mark: float | None = None


class Findings(NamedTuple):
    """What a study found."""

    quantities: Mapping[str, Any]  # numbers by name, SI units, see `docs/assessment.md`
    #: arrays along the path of contact, among them ``roll_angle`` (rad, increasing, 0 at the pitch point);
    #: ``line_load`` is (place, slice)
    along: Mapping[str, Any] = MappingProxyType({})
    curves: Sequence[ReportCurve] = ()
    #: values (samples,) of quantities by name over the samples, and (samples, places) of arrays along the
    #: path of contact by the names of `along`; NaN where one failed
    spread: Mapping[str, np.ndarray] = MappingProxyType({})
    #: loads of all pairs in steady motion at the duty, the pair that entered first in front: ``roll_angle``
    #: (position, pair), rad, and ``normal_load`` (cycle, position, pair), N
    motion: Mapping[str, Any] = MappingProxyType({})
    #: values (speed,) and of meshes (speed, mesh) by name over the ``speed``, rad/s
    over_speed: Mapping[str, np.ndarray] = MappingProxyType({})


#: What a role is asked of: the teeth of a mesh, a pair of gears, or a gearbox of several meshes.
TEETH, PAIR, GEARBOX = "teeth", "pair", "gearbox"


class Contribution(NamedTuple):
    """The part that a study plays."""

    order: int  # tasks of lower order run first
    title: str  # heading of its results
    tasks: Callable[[Request], Sequence[Task]]  # request -> its tasks
    #: (Request, results of its tasks by name) -> Findings
    answer: Callable[[Request, Mapping[str, TaskResult]], Findings]
    #: `TEETH`: an assessment of a pair asks it, and one of a train of every mesh; of the others one of both
    of: Literal["teeth", "pair", "gearbox"] = PAIR
    #: request -> quantities of the load along the face in static equilibrium on shafts; None: it knows none
    face: Callable[[Request], Mapping[str, Any]] | None = None


class Meshing(NamedTuple):
    """How a gear's teeth are loaded."""

    per_turn: int = 1  # how often a flank is loaded in a turn
    reversed: bool = False  # whether both flanks are: of an idler, a planet


class MeshAtDuty(NamedTuple):
    """A mesh of a train as a pair of gears."""

    name: str  # in the summaries of runs
    pair: Any  # its case: gears, oil, speed of the driver, torque of the driven gear
    alike: str = ""  # what it shares with the meshes of a set's other planets; "": none
    stage: str = ""  # planetary stage that it belongs to; "": none
    meshing: tuple[Meshing, Meshing] = (Meshing(), Meshing())  # of driver and driven gear
    distance: str = ""  # key of the centre distance of its two shafts, where the scenario gives it


def shared_names(meshes: Sequence[MeshAtDuty]) -> list[str]:
    """The name of every mesh; of those that differ by their planet alone what they share."""
    names = {mesh.name for mesh in meshes}
    return [mesh.alike if mesh.alike and mesh.alike not in names else mesh.name for mesh in meshes]


class WholeDrive(NamedTuple):
    """What an assessment needs of a study whose cases have several meshes."""

    meshes: Callable[[Any], Sequence[MeshAtDuty]]  # of a case
    #: (case, scenario as a file has it) -> the scenario whose input speed may vary, torques the same
    at_torque: Callable[[Any, Mapping[str, Any]], dict[str, Any]]
    #: case -> mesh cycles that are marched where no steady state repeats; 0: there is one
    marched: Callable[[Any], int]
    speed: Callable[[Any], float]  # of the input of a case, rad/s
    #: (case, name of a mesh, of those of all planets, or "": the only one) -> the scenario of its pair of
    #: gears at its duty, as a file has it; raises InputError with the key "mesh" where there is no such mesh
    pair: Callable[[Any, str], dict[str, Any]]
    #: (case, name of a gear, or of all planets) -> its meshes by `shared_names`, and what it is in their
    #: pairs, "pinion" or "gear"; raises InputError with the key "gear" where there is no such gear
    gear: Callable[[Any, str], Mapping[str, Any]]
    #: case -> shares of the time, their sum 1, and cases of the duties of its load spectrum; empty: none
    duties: Callable[[Any], Sequence[tuple[float, Any]]]
    shafts: Callable[[Any], Sequence[Any]]  # case -> its drawn shafts, see `gears.rating.bearings`
    #: case -> quantities of the loads along the faces in static equilibrium of all, of meshes by name
    faces: Callable[[Any], Mapping[str, Mapping[str, Any]]]
    #: (record of a run, case, name of a mesh) -> `gears.motion.tooth_loads.ToothLoads` at its end
    loads: Callable[[Any, Any, str], Any]
