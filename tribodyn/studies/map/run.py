"""From a case of a map to its record."""

from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import h5py
import numpy as np

from tribodyn.cases.loss_part import TERMS, Statics
from tribodyn.cases.results import target, writer
from tribodyn.numerics.processes.work import usable_cores
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.loss_map import efficiency_of
from tribodyn.studies.map.case import (
    ESTIMATES,
    LAYOUT,
    NAMES,
    OF_MESHES,
    STATICS,
    TOTAL_STIFFNESS,
    MapCase,
)
from tribodyn.studies.map.evaluation import KnownPoints, PointStore, discard, evaluate, evaluators
from tribodyn.studies.map.refinement import RefinedGrid, nodes_of, refined
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult, TextTable
from tribodyn.studies.protocol.tasks import folder_of
from tribodyn.tribology.oil import ZERO_CELSIUS

#: Points at which `check` measures how long one takes, beside the first.
TRIED = 24
#: Share that is done as far as anybody knows before the grid is fine enough.
_ALMOST = 0.95


class Mapped(NamedTuple):
    """A map that is worked out."""

    grid: RefinedGrid
    found: KnownPoints  # at the nodes, the last axis changing fastest
    statics: Statics  # over the torques
    evaluated: int  # points, those between the nodes included


def mapped(
    case: MapCase, folder: Path | None = None, progress: Progress | None = None, client: Any = None
) -> Mapped:
    """Work out a map; what `folder` has of it is taken up."""
    expected = case.nodes * (2.0 if case.accuracy else 1.0)

    def report(done: int) -> None:
        if progress:
            progress(min(done / expected, _ALMOST))

    with evaluators(case, case.nodes, client) as workers:
        store = PointStore(case, workers, folder, report)
        grid = refined(case.axes, store.drag, case.accuracy, case.most_points)
        found = store.at(nodes_of(grid.axes))
    loads = grid.axes[0] / (case.nominal.output_torque or 1.0)
    return Mapped(grid, found, case.losses.statics(case.subject.case, loads), len(store))


def run(
    case: MapCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
    resume: bool = False,
    client: Any = None,
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`.

    Points that a call which was stopped had evaluated are taken up, also without `resume`.
    """
    path = target(case, output, force)
    folder, begun = folder_of(path), perf_counter()
    try:
        result = mapped(case, folder, progress, client)
    except KeyboardInterrupt as error:
        error.__notes__ = [f"the points so far: {folder}, the same call goes on"]
        raise
    summary = summary_of(case, result) | {"wall_time": perf_counter() - begun}
    scales = scales_of(case, result)
    oil = scales.pop("oil_temperature")
    datasets = datasets_of(case, result)
    with writer(case, path, LAYOUT, len(oil), scales=scales, force=force) as record:
        record.write(0, {"oil_temperature": oil, **{name: datasets.pop(name) for name in LAYOUT.samples}})
        record.put(0, {"backlash": datasets.pop("backlash")})
        for name, values in datasets.items():
            for row, value in enumerate(values):
                record.put(row, {name: value})
        if progress:
            progress(1.0)
        done = record.finish(summary, beside=partial(_about, case, result))
    discard(folder)
    return RunResult(done, "complete", "", summary)


def quantities_of(case: MapCase) -> dict[str, Any]:
    """Quantities of a case without a record."""
    return summary_of(case, mapped(case))


def scales_of(case: MapCase, result: Mapped) -> dict[str, Any]:
    """Values along all axes."""
    sources = [f"{source.term} {source.element}" for source in result.found.sources]
    return {
        **dict(zip(NAMES, result.grid.axes, strict=True)),
        "source": np.array(sources),
        "mesh": np.array(case.losses.names(case.subject.case)),
        "harmonic": np.arange(1, result.statics.stiffness_harmonic.shape[2] + 1),
        "estimate": np.array(ESTIMATES),
    }


def datasets_of(case: MapCase, result: Mapped) -> dict[str, Any]:
    """Everything that the record holds over its axes, by name."""
    torque, speed, _ = result.grid.axes
    drag = np.stack([_over(result, values) for values in result.found.drag.T])
    total = drag.sum(axis=0)
    statics = result.statics
    through = np.abs(case.nominal.ratio) * torque[:, None]
    sources = result.found.sources
    return {
        "power_loss": total * np.abs(speed),
        "efficiency": efficiency_of(through, total),
        "drag": drag,
        "source_term": [source.term for source in sources],
        "source_element": [source.element for source in sources],
        "source_method": [source.method for source in sources],
        **{
            name: np.stack([_over(result, values) for values in result.found.meshes[name].T])
            for name in OF_MESHES
            if name in result.found.meshes
        },
        **{name: np.moveaxis(np.asarray(getattr(statics, name)), 1, 0) for name in STATICS},
        "transmission_error_output": np.moveaxis(
            statics.transmission_error_harmonic * statics.error_at_output[:, None], 1, 0
        ),
        "mesh_order": statics.mesh_order,
        TOTAL_STIFFNESS: statics.stiffness_total,
        "backlash": statics.backlash,
        "error_estimate": [result.grid.error_max, result.grid.error_mean],
    }


def _over(result: Mapped, values: Float[Array, " point"]) -> Float[Array, "oil torque speed"]:
    """Values of the nodes as the record has them, (oil_temperature, torque, speed)."""
    return np.moveaxis(values.reshape([len(axis) for axis in result.grid.axes]), 2, 0)


def summary_of(case: MapCase, result: Mapped) -> dict[str, Any]:
    """What the summary reports."""
    nominal, (_, speed, _) = case.nominal, result.grid.axes
    arrays = datasets_of(case, result)
    total, efficiency = arrays["drag"].sum(axis=0), arrays["efficiency"]
    own = _own_losses(case)
    drag, through = sum(own.values()), abs(nominal.input_torque)
    standing = total[..., speed == 0.0]
    known = efficiency[np.isfinite(efficiency)]
    summary = {
        "map_points": int(total.size),
        "map_points_evaluated": result.evaluated,
        "map_error_max": result.grid.error_max,
        "map_error_mean": result.grid.error_mean,
        "accuracy": case.accuracy,
        "accuracy_held": bool(result.grid.error_max <= case.accuracy),
        "own_torque": nominal.output_torque,
        "own_speed": nominal.input_speed,
        "own_oil_temperature": nominal.oil_temperature,
        "own_power_loss": drag * nominal.input_speed,
        "own_losses": {term: value * nominal.input_speed for term, value in own.items()},
        "efficiency_own": float(efficiency_of(through, drag)) if through else None,
        "efficiency_max": float(known.max()) if len(known) else None,
        "power_loss_max": float(arrays["power_loss"].max()),
        "stall_drag_max": float(standing.max()) if standing.size else None,
        "backlash_output": float(result.statics.backlash),
        "exceeded": {
            f"{source.term} {source.element}": ", ".join(limits)
            for source, limits in zip(result.found.sources, result.found.exceeded, strict=True)
            if limits
        },
    }
    if chosen := case.subject.case.chosen():
        summary["chosen"] = {key: name for key, (name, _) in chosen.items()}
    return {name: value for name, value in summary.items() if value is not None}


def _own_losses(case: MapCase) -> dict[str, float]:
    """Drag torques by term at the gearbox's own point."""
    nominal = case.nominal
    own = evaluate(case.subject, [(nominal.output_torque, nominal.input_speed, nominal.oil_temperature)])
    terms = dict.fromkeys(TERMS, 0.0)
    for (term, *_), drag in zip(own["sources"], own["drag"][0], strict=True):
        terms[term] += drag
    return terms


def _about(case: MapCase, result: Mapped, file: h5py.File) -> None:
    """Put into the root what a reader of the map needs beside its datasets."""
    nominal = case.nominal
    file.attrs.update(
        {
            "ratio": nominal.ratio,
            "nominal_torque": nominal.output_torque,
            "nominal_speed": nominal.input_speed,
            "inertia_input": nominal.inertia,
            "inertia_output": nominal.output_inertia,
            "interpolation_error_max": result.grid.error_max,
            "interpolation_error_mean": result.grid.error_mean,
        }
    )


def check(case: MapCase) -> CheckResult:
    """Check a case; say what is mapped, over how many points, and how long that takes."""
    nominal = case.nominal
    points = nodes_of(case.axes)
    tried = points[np.unique(np.linspace(0, len(points) - 1, TRIED).astype(int))]
    first = evaluate(case.subject, tried[:1].tolist())  # tables are made
    begun = perf_counter()
    evaluate(case.subject, tried.tolist())
    each = (perf_counter() - begun) / len(tried)
    cores = usable_cores()
    rows = [
        (name.replace("_", " "), f"{len(axis)}", _ends(name, axis))
        for name, axis in zip(NAMES, case.axes, strict=True)
    ]
    refining = f"further ones until interpolation misses by at most {100 * case.accuracy:g} %"
    how = f"{refining}, {case.most_points} at most" if case.accuracy else "no further ones"
    seconds = case.nodes * each / cores
    data = {
        "axes": {name: axis.tolist() for name, axis in zip(NAMES, case.axes, strict=True)},
        "directions": case.directions,
        "points": case.nodes,
        "accuracy": case.accuracy,
        "most_points": case.most_points,
        "sources": [f"{term} {element}: {method}" for term, element, _, method in first["sources"]],
        "ratio": nominal.ratio,
    }
    sources = [(term, element, method) for term, element, _, method in first["sources"]]
    tables = (
        TextTable("Axes", ("axis", "values", "from … to"), rows),
        TextTable(
            "Map",
            ("", ""),
            (
                ("points", f"{case.nodes}; {how}"),
                (
                    "time",
                    f"about {seconds:.2g} s for these, {1e3 * each:.2g} ms a point on each of {cores} cores",
                ),
            ),
        ),
        TextTable("Losses", ("term", "of", "by"), sources),
    )
    return CheckResult(data, tables)


def _ends(name: str, axis: Float[Array, " node"]) -> str:
    """First and last value of an axis in the units in which it is shown."""
    shown = {"torque": ("N m", 1.0, 0.0), "speed": ("rpm", 30.0 / np.pi, 0.0)}.get(
        name, ("°C", 1.0, -ZERO_CELSIUS)
    )
    unit, factor, offset = shown
    first, last = (factor * (float(end) + offset) for end in (axis[0], axis[-1]))
    return f"{first:.5g} … {last:.5g} {unit}" if len(axis) > 1 else f"{first:.5g} {unit}"
