"""A run that arrives in blocks, summed up: extremes, what the model leaves, both ends, the last cycles."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.recorded.outputs import Sampled
from tribodyn.gears.motion.course import RunCourse
from tribodyn.gears.motion.extremes import RunningExtremes
from tribodyn.gears.motion.recorded import pair_numbers
from tribodyn.geometry.assembly import Assembly, tip_clearance
from tribodyn.geometry.drive import SIDES
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.record.trust import Judge, heat_of
from tribodyn.train.layout import TrainLayout, work_of, works_of_clutches, works_of_meshes
from tribodyn.train.structure import (
    DAMPING,
    FRICTION,
    IN,
    OUT,
    PARAMETRIC,
)


class MeshOfRun(NamedTuple):
    """What the summary of a run needs to know of a mesh."""

    cycle: MeshCycle
    assembly: Assembly
    module: float  # m
    oil_temperature: float | None  # K
    rate: float = 1.0  # its cycles per reference cycle
    phase: float = 0.0  # in its cycle, at the start
    number: int | None = None  # in a train

    def cycles(self, reference: np.ndarray) -> np.ndarray:
        """Its cycles since it began one, of reference cycles since the start."""
        return self.phase + self.rate * reference


class RunStatistics:
    """What the summary needs of a run that arrives in blocks; `window` and `total` are numbers of samples."""

    def __init__(
        self,
        window: int,
        total: int,
        meshes: Sequence[MeshOfRun],
        layout: TrainLayout,
        course: RunCourse | None,
    ):
        self.start, self.stop = total - window, total
        self.written = 0
        self.meshes, self.layout, self.course = meshes, layout, course
        self.extremes = [RunningExtremes(mesh.cycle) for mesh in meshes]
        self.in_window = [RunningExtremes(mesh.cycle) for mesh in meshes]
        self.blocks: list[list[dict[str, np.ndarray]]] = []
        self.ends: list[tuple[np.ndarray, float]] = []
        self.window_start = np.empty(0)
        self.judge = Judge()

    def add(self, states: np.ndarray, block: Sampled, extreme: Sampled) -> None:
        """Take in a part: its states, what is made of them, and of the motion where it is extreme."""
        stored, count = block.whole["stored_energy"], len(block.cycles)
        averages, first = self.averages(count), max(self.start - self.written, 0)
        add_extremes(self.extremes, self.meshes, block, extreme)
        if self.course is not None:
            self.course.add(block)
        judge_run(self.judge, self.meshes, self.layout, block, extreme)
        if not self.ends:
            self.ends.append((states[0], stored[0]))
        self.ends[1:] = [(states[-1], stored[-1])]
        if first < count:
            add_extremes(self.in_window, self.meshes, block.part(slice(first, None)), extreme)
        if averages:
            averaged = slice(first, self.stop - self.written)
            if not self.blocks:
                self.window_start = states[averaged][0]
            self.blocks.append(block.part(averaged).meshes)
        self.written += count

    def averages(self, count: int) -> bool:
        """Whether means are of some of the next samples; the last of a run is a cycle after the first."""
        return self.written < self.stop and self.written + count > self.start

    def of_mesh(self, m: int, complete: bool) -> dict[str, Any]:
        """Extremes of the last cycles of a mesh, of an incomplete run of all."""
        if not self.ends:
            return {}
        shown = self.in_window[m] if complete else self.extremes[m]
        extremes = {"run": self.extremes[m].described(), "last_cycles": self.in_window[m].described()}
        return (
            shown.values()
            | {"extremes": extremes}
            | (self.course.summary(m) if self.course is not None else {})
        )

    def balance(self) -> dict[str, float]:
        """Residual of the energy balance so far."""
        if not self.ends:
            return {}
        (first, stored_first), (last, stored_last) = self.ends
        return {"energy_residual": energy_residual(first, last, stored_last - stored_first, self.layout)}

    def window_work(self) -> np.ndarray:
        """Change of the state, works included, over the last cycles."""
        return self.ends[-1][0] - self.window_start

    def window_of_mesh(self, m: int) -> dict[str, np.ndarray]:
        """Datasets of a mesh over the last cycles, the sample that closes them not included."""
        names = self.blocks[0][m]
        return {name: np.concatenate([block[m][name] for block in self.blocks]) for name in names}


def add_extremes(extremes: Sequence[RunningExtremes], meshes: Sequence[MeshOfRun], *blocks: Sampled) -> None:
    """Take blocks into the extremes of every mesh."""
    for block in blocks:
        for of_mesh, mesh, values in zip(extremes, meshes, block.meshes, strict=True):
            of_mesh.add(mesh.cycles(block.cycles), block.whole["time"], values)


def judge_run(
    judge: Judge, meshes: Sequence[MeshOfRun], layout: TrainLayout, block: Sampled, extreme: Sampled
) -> None:
    """Judge what is made of samples, and of the motion between them where it is extreme."""
    for part, between_samples in ((block, False), (extreme, True)):
        if not len(part.cycles):
            continue
        for m, (mesh, values) in enumerate(zip(meshes, part.meshes, strict=True)):
            ends = [body for body in (layout.driver[m], layout.driven[m]) if body < layout.planar]
            moved = np.zeros(len(part.cycles))
            for body in ends:
                moved = np.maximum(moved, part.whole["moved"][:, body])
            clearance = min(tip_clearance(mesh.assembly, side) for side in SIDES)  # m
            quantities = quantities_of(values, mesh.module, moved / clearance)
            quantities |= heat_of(values["flash_temperature_rise"], mesh.oil_temperature)
            places = {"time": part.whole["time"], "mesh_cycle": mesh.cycles(part.cycles)}
            if mesh.number is not None:
                places["mesh"] = np.full(len(moved), mesh.number)
            judge.take(quantities, places, mesh_pairs(mesh.cycle), between_samples)


def mesh_pairs(cycle: MeshCycle) -> list[int]:
    """Numbers of the pairs of a mesh."""
    return pair_numbers(cycle.front_pairs, np.size(cycle.pair_side))


def quantities_of(
    block: Mapping[str, np.ndarray], module: float, displaced: np.ndarray
) -> dict[str, np.ndarray]:
    """Quantities of a mesh by name of their rule, (n, pairs) or (n,).

    The deflection of a pair is its load over its stiffness, both as recorded; `displaced` is the maximum
    displacement of a gear in its bearings over the tip clearance.
    """
    stiffness = np.where(block["mesh_stiffness"] > 0.0, block["mesh_stiffness"], np.nan)
    return {
        "deflection": block["normal_load"] / stiffness / module,
        "friction_coefficient": block["friction_coefficient"],
        "hertz_pressure": block["hertz_pressure"],
        "bearing_displacement": displaced,
    }


def judge_balance(judge: Judge, summary: Mapping[str, Any], rtol: float) -> None:
    """Judge the residual of the energy balance against the tolerance of the integration."""
    residual = summary.get("energy_residual")
    if residual is not None:
        judge.take({"energy_residual": abs(residual) / rtol})


def energy_residual(first: np.ndarray, last: np.ndarray, stored: float, layout: TrainLayout) -> float:
    """Residual of the energy balance over a run, as a share of the largest of the works in it.

    W_in + W_parametric − W_out − W_friction − W_damping − W_clutches − ΔE from the first to the last state;
    `stored` is ΔE, J. The largest is that of the driving gear where power flows through, and that of what
    takes or feeds the energy of a mesh without load.
    """
    change = last - first
    friction = float(np.sum(change[works_of_meshes(layout, FRICTION)]))
    of_train = [change[work_of(layout, which)] for which in (IN, PARAMETRIC, OUT)]
    lost = change[work_of(layout, DAMPING)] + np.sum(change[works_of_clutches(layout)])
    works = np.array([*of_train, friction, lost])
    missing = works @ [1.0, 1.0, -1.0, -1.0, -1.0] - stored
    return float(missing / max(np.max(np.abs(works)), 1e-300))
