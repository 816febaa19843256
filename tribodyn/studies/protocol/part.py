"""The part that a study plays in an assessment of a drive: what it runs, and what comes out of it.

A study that takes part has a module ``assess`` with ``ROLE``. An assessment goes through the registry, runs
the tasks of every role and puts their answers together; it knows no study by name.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np


class Request(NamedTuple):
    """What an assessment asks of the studies.

    Attributes
    ----------
    tables : tables ``drive``, ``lubricant``, ``bearings``, ``mesh``, ``temperature`` and ``losses`` as a
        scenario has them, the last only where given; ``oil_temperature``, a quantity as text;
        ``damping_ratio``
    pinion_speed, gear_torque : rad/s and N m
    torques : over which the loaded error is asked for, N m, increasing
    speeds : over which steady states are asked for, rad/s, increasing; that of the duty is one of them
    laws : friction laws, the first of them for everything but the spread of the losses
    pitch_deviation : base pitch deviation f_pb − y_α of the drive's tolerance class, m
    samples : samples of the class's deviations whose scatter is asked for, numbered from 1
    """

    title: str
    tables: Mapping[str, Any]
    pinion_speed: float
    gear_torque: float
    torques: Sequence[float]
    speeds: Sequence[float]
    laws: Sequence[str]
    pitch_deviation: float
    samples: int

    def operating(self) -> dict[str, Any]:
        """Table ``operating`` of a scenario at the duty."""
        return {
            "pinion_speed": f"{self.pinion_speed!r} rad/s",
            "gear_torque": f"{self.gear_torque!r} N*m",
            "oil_temperature": self.tables["oil_temperature"],
        }


class Task(NamedTuple):
    """A scenario to be run.

    Attributes
    ----------
    name : of its file
    about : what it finds, in a few words: shown while it runs
    scenario : as a file has it, with its kind
    key, values : what is varied: then only figures are kept, one row per value. None: one run, with its
        record.
    needed : whether the assessment ends where this cannot be run
    """

    name: str
    about: str
    scenario: Mapping[str, Any]
    key: str = ""
    values: Sequence[str] = ()
    needed: bool = True


class TaskResult(NamedTuple):
    """What a task gave.

    Attributes
    ----------
    path : the record of a run, or the file with the rows
    summary : of a run
    rows : figure -> values (n,) over what was varied; NaN where a case failed
    failures : what could not be computed, and why; of a run that is not needed there is no summary then
    """

    path: Path
    summary: Mapping[str, Any] = MappingProxyType({})
    rows: Mapping[str, np.ndarray] = MappingProxyType({})
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
    """What a study found.

    Attributes
    ----------
    figures : numbers by name, SI units, see `docs/assessment.md`
    along : arrays along the path of contact, among them ``roll_angle`` (rad, increasing, 0 at the pitch
        point)
    spread : values (samples,) of figures by name, over the samples of deviations; NaN where one failed
    """

    figures: Mapping[str, Any]
    along: Mapping[str, Any] = MappingProxyType({})
    curves: Sequence[ReportCurve] = ()
    spread: Mapping[str, np.ndarray] = MappingProxyType({})


class Contribution(NamedTuple):
    """The part that a study plays.

    Attributes
    ----------
    order : tasks of lower order run first
    title : heading of its results
    tasks : request -> its tasks
    answer : (Request, results of its tasks by name) -> Findings
    """

    order: int
    title: str
    tasks: Callable[[Request], Sequence[Task]]
    answer: Callable[[Request, Mapping[str, TaskResult]], Findings]
