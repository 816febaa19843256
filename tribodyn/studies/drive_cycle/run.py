"""From a case of a drive cycle to its record: losses, temperatures and energies over time."""

from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.cases.heat_part import AMBIENT, settle
from tribodyn.cases.loss_part import TERMS
from tribodyn.cases.results import target, writer
from tribodyn.errors import SimulationError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.drive_cycle.case import LAYOUT, OF_MESHES, DriveCycleCase
from tribodyn.studies.drive_cycle.march import CycleHistory, march
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult, TextTable
from tribodyn.tribology.oil import ZERO_CELSIUS


def run(
    case: DriveCycleCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`."""
    path, begun = target(case, output, force), perf_counter()
    history = march(case, progress)
    arrays, sources = arrays_of(case, history), history.losses.sources
    summary = summary_of(case, history) | {"wall_time": perf_counter() - begun}
    heat = case.heat.network
    scales = {
        "term": np.array(list(TERMS)),
        "source": np.array([f"{source.term} {source.element}" for source in sources]),
        "node": np.array(heat.nodes),
        "mesh": np.array(case.losses.names(case.subject.case)),
    }
    with writer(case, path, LAYOUT, len(case.rows.time), scales=scales, force=force) as record:
        record.write(0, {"time": case.rows.time, **arrays})
        for row, source in enumerate(sources):
            names = {"source_term": source.term, "source_element": source.element}
            record.put(row, names | {"source_method": source.method})
        for row, capacity in enumerate(heat.capacities.values()):
            record.put(row, {"node_capacity": capacity})
        return RunResult(record.finish(summary), "complete", "", summary)


def quantities_of(case: DriveCycleCase) -> dict[str, Any]:
    """Quantities of a case without a record."""
    return summary_of(case, march(case))


def arrays_of(case: DriveCycleCase, history: CycleHistory) -> dict[str, Any]:
    """Datasets of the record over time."""
    rows, nominal, heat = case.rows, case.nominal, history.heat
    loss = history.power.sum(axis=1)
    out = rows.load * nominal.output_torque * np.abs(rows.speed * nominal.ratio)
    by_term = {term: np.zeros(len(loss)) for term in TERMS}
    for column, source in enumerate(history.losses.sources):
        by_term[source.term] = by_term[source.term] + history.power[:, column]
    network = case.heat.network
    flows = [
        network.flows(at[None], abs(speed))[0] @ network.leaving()
        for at, speed in zip(heat.temperatures, rows.speed.tolist(), strict=True)
    ]
    shares = case.heat.entering(history.losses.sources, case.losses.names(case.subject.case))
    direct = history.power @ shares[:, len(network.nodes) :]
    energy_out = _energy_out(rows.time, rows.load * nominal.output_torque, rows.speed * nominal.ratio)
    moving = rows.speed[:, None] != 0.0  # at rest there is no film
    of_meshes = {
        name: np.where(moving, history.losses.meshes[name], np.nan)
        for name in OF_MESHES
        if name in history.losses.meshes
    }
    return {
        "input_speed": rows.speed,
        "load": rows.load,
        "power_in": out + loss,
        "power_out": out,
        "power_loss": loss,
        "heat_given_off": np.sum(flows, axis=1) + direct.sum(axis=1),
        "term_power": np.stack(list(by_term.values()), axis=1),
        "source_power": history.power,
        "oil_temperature": history.oil,
        "node_temperature": heat.temperatures,
        "bulk_temperature": history.bulk,
        **of_meshes,
        "energy_in": energy_out + heat.made,
        "energy_out": energy_out,
        "energy_lost": heat.made,
        "heat_stored": heat.stored,
        "heat_gone": heat.given_off.sum(axis=1),
    }


def _energy_out(
    time: Float[Array, " row"], torque: Float[Array, " row"], speed: Float[Array, " row"]
) -> Float[Array, " row"]:
    """Integral of torque times the magnitude of the speed, both linear between the rows."""
    step, speed = np.diff(time), np.abs(speed)
    one = torque[:-1] * (2.0 * speed[:-1] + speed[1:])
    two = torque[1:] * (speed[:-1] + 2.0 * speed[1:])
    return np.concatenate([[0.0], np.cumsum(step * (one + two) / 6.0)])


def _energy_of_sources(time: Float[Array, " row"], history: CycleHistory) -> list[float]:
    """Energy lost by source, J: by the trapezoidal rule, in every interval scaled to what was integrated."""
    lost = 0.5 * np.diff(time)[:, None] * (history.power[1:] + history.power[:-1])
    total = lost.sum(axis=1)
    scale = np.divide(np.diff(history.heat.made), total, out=np.ones_like(total), where=total > 0.0)
    return (lost * scale[:, None]).sum(axis=0).tolist()


def summary_of(case: DriveCycleCase, history: CycleHistory) -> dict[str, Any]:
    """What the summary reports."""
    arrays, rows = arrays_of(case, history), case.rows
    energy = {name: float(arrays[name][-1]) for name in ("energy_in", "energy_out", "energy_lost")}
    nodes, temperatures = case.heat.network.nodes, history.heat.temperatures
    by_term = dict.fromkeys(TERMS, 0.0)
    for source, lost in zip(history.losses.sources, _energy_of_sources(rows.time, history), strict=True):
        by_term[source.term] += lost
    loaded = "film_min" in arrays and np.isfinite(arrays["film_min"]).any()
    driven = energy["energy_out"] > 0.0
    summary: dict[str, Any] = {
        "cycle_duration": float(rows.time[-1]),
        **{f"cycle_{name}": value for name, value in energy.items()},
        "cycle_efficiency": energy["energy_out"] / energy["energy_in"] if driven else None,
        "cycle_loss_mean": energy["energy_lost"] / float(rows.time[-1]),
        "cycle_loss_max": float(arrays["power_loss"].max()),
        "cycle_heat_stored": float(arrays["heat_stored"][-1]),
        "cycle_heat_gone": float(arrays["heat_gone"][-1]),
        "cycle_oil_temperature_max": float(history.oil.max()),
        "cycle_oil_temperature_end": float(history.oil[-1]),
        "cycle_bulk_temperature_max": float(history.bulk.max()),
        "cycle_hottest_part": nodes[int(temperatures.max(axis=0).argmax())],
        "film_min": float(np.nanmin(arrays["film_min"])) if loaded else None,
        "film_parameter_min": float(np.nanmin(arrays["film_parameter_min"])) if loaded else None,
        "cycle_heat_balance": history.heat.balance,
        "cycle_loss_error": history.error,
        "energy_by_term": by_term,
        "temperature_max": dict(zip(nodes, temperatures.max(axis=0).tolist(), strict=True)),
        "temperature_end": dict(zip(nodes, temperatures[-1].tolist(), strict=True)),
        "exceeded": {
            f"{source.term} {source.element}": ", ".join(limits)
            for source, limits in zip(history.losses.sources, history.losses.exceeded, strict=True)
            if limits
        },
    }
    return {name: value for name, value in summary.items() if value is not None}


def check(case: DriveCycleCase) -> CheckResult:
    """Check a case; say what the gearbox stores and gives off, and where a steady duty would lead."""
    heat, nominal, rows = case.heat, case.nominal, case.rows
    names, network = case.losses.names(case.subject.case), heat.network
    slowest = None
    try:
        settled = settle(
            heat, lambda points: case.losses.at(case.subject.case, points), names, 1.0, nominal.input_speed
        )
        temperatures = settled.temperatures(heat)
        lost: float | None = settled.steady.heat
    except SimulationError:
        temperatures, lost = dict(network.held), None
    warm = np.array([temperatures.get(name, network.held[AMBIENT] + 40.0) for name in network.nodes])
    slowest = _slowest(case, warm)
    node_rows = [
        (
            name,
            f"{network.capacities[name]:.4g}" if name in network.capacities else "–",
            f"{temperatures[name] - ZERO_CELSIUS:.1f}" if name in temperatures else "–",
        )
        for name in (*network.nodes, *network.held)
    ]
    flows = network.flows(warm[None], nominal.input_speed)[0]
    place = dict(zip(network.nodes, warm.tolist(), strict=True)) | dict(network.held)
    path_rows = []
    for path, flow in zip(network.paths, flows.tolist(), strict=True):
        apart = place[path.one] - place[path.two]
        conductance = flow / apart if apart else float("nan")
        path_rows.append((path.one, path.two, f"{conductance:.3g}", f"{flow:.4g}", path.what))
    columns = ("one", "two", "conductance", "heat", "by")
    data = {
        "rows": len(rows.time),
        "duration": float(rows.time[-1]),
        "time_constant": slowest,
        "steady_temperatures": temperatures,
        "steady_loss": lost,
        "capacities": dict(network.capacities),
        "paths": [dict(zip(columns, row, strict=True)) for row in path_rows],
    }
    duty = (
        ("rows", f"{len(rows.time)}"),
        ("duration", f"{rows.time[-1]:.5g} s"),
        ("speed of the input", _ends(rows.speed * 30.0 / np.pi, "rpm")),
        ("loads, of the scenario's own", _ends(rows.load, "")),
        ("slowest time constant of the parts", f"{slowest:.4g} s"),
        ("loss in steady state at the scenario's own duty", f"{lost:.5g} W" if lost is not None else "none"),
    )
    tables = (
        TextTable("Cycle", ("", ""), duty),
        TextTable("Parts", ("part", "J/K", "steady at the own duty (°C)"), node_rows),
    )
    paths = TextTable("Paths of heat, at the own duty", ("from", "to", "W/K", "W", "by"), path_rows)
    return CheckResult(data, tables, details=(paths,))


def _slowest(case: DriveCycleCase, warm: Float[Array, " node"]) -> float:
    """The slowest time constant of the network about these temperatures at the own speed, s."""
    network, step = case.heat.network, 1e-3
    moved = warm + np.vstack([np.eye(len(warm)), -np.eye(len(warm))]) * step
    entering = network.flows(moved, case.nominal.input_speed) @ network.incidence()
    slopes = (entering[: len(warm)] - entering[len(warm) :]).T / (2.0 * step)
    rates = np.linalg.eigvals(slopes / np.array(list(network.capacities.values()))[:, None]).real
    return float(-1.0 / rates.max())


def _ends(values: Float[Array, " row"], unit: str) -> str:
    return f"{values.min():.5g} … {values.max():.5g} {unit}".rstrip()
