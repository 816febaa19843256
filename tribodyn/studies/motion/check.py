"""What is said of a gearbox without a run: speeds, frequencies, modes, and every mesh as of a pair."""

from collections.abc import Iterator, Sequence
from math import degrees, pi
from typing import Any

import numpy as np

from tribodyn.cases.results import CheckResult, TextTable
from tribodyn.dynamics.modes import Modes, modes
from tribodyn.gears.bearings_in_time import passing_of
from tribodyn.gears.check import check_gears
from tribodyn.gears.plausibility import checks_gears, with_duty
from tribodyn.gears.prepare import PreparedGears
from tribodyn.gears.rating.bearings import (
    bearing_part,
    bearing_remarks,
    bearing_rows,
)
from tribodyn.quantities.catalogue import OF_FACE
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.drivetrain.mesh_groups import together
from tribodyn.studies.motion.frequencies import (
    distinct_meshes,
    mesh_frequencies,
    of_sets,
    passes,
)
from tribodyn.studies.motion.heat.rating import heat_part
from tribodyn.studies.motion.heat.settled import prepare_settled
from tribodyn.studies.motion.losses.breakdown import LOSSES, listed, loss_table
from tribodyn.studies.motion.losses.of_case import losses_at_duty
from tribodyn.studies.motion.planetary.jamming import jams
from tribodyn.studies.motion.planetary.powers import LOCKS, flow_of, power_data, power_table
from tribodyn.studies.motion.planetary.results import kinds_of, planet_pass
from tribodyn.studies.motion.sensors import listener_of
from tribodyn.studies.motion.train.assessable import shafts as shafts_of
from tribodyn.studies.motion.train.face_loads import along_face, of_deflected, proposals
from tribodyn.train.flow import flow

#: Share of a mode's energy below which a body is left out of a table.
LITTLE = 0.005
#: Harmonics of the meshes whose crossing with a mode is said.
HARMONICS = 3


@checks_gears
def check(case: Gearbox) -> CheckResult:
    """Check a case, tabulate its meshes, and say what gearbox it describes."""
    prepared = prepare_settled(case)
    case = prepared.case
    listener_of(prepared)
    spread = of_deflected(prepared)
    mode_set = modes(prepared.model, [one.cycle for one in prepared.tables])
    kinds = kinds_of(prepared, mode_set)
    proposed = proposals(spread, len(case.meshes))
    along = [along_face(spread, m) | proposed[m] for m in range(len(case.meshes))]
    of_meshes = [_of_mesh(prepared, m, along[m]) for m in range(len(case.meshes))]
    of_modes = {
        "natural_frequencies": mode_set.frequency.tolist(),
        "mode_shares": [
            dict(zip(prepared.names, row, strict=True)) for row in np.round(mode_set.share, 6).tolist()
        ],
    }
    tables = [_mode_table(prepared, mode_set, kinds), _campbell_table(prepared, mode_set)]
    shafts, oil = shafts_of(case), case.pair.lubricant
    held = bearing_part(shafts, oil)
    of_heat, heat_tables, heat_details = heat_part(prepared)
    held |= of_heat
    tables[:0] = heat_tables
    if "bearings" in held:
        tables.insert(0, TextTable("Bearings", *bearing_rows(held["bearings"])))
    if passes_in_bearings := _passing_elements(case):
        tables.insert(0, _element_table(passes_in_bearings))
        held["bearing_frequencies"] = passes_in_bearings
    losses, said = losses_at_duty(prepared)
    if losses:
        tables.insert(0, loss_table(losses[LOSSES]))
        held |= listed(losses)
    names = [mesh.name for mesh in case.meshes]
    faces = {name: of.data for name, of in zip(names, of_meshes, strict=True) if OF_FACE[0].name in of.data}
    if faces:
        title = "Loads along the faces, in static equilibrium"
        tables.insert(0, TextTable(title, *bearing_rows(faces, OF_FACE)))
    if not case.named:
        (pair,) = of_meshes
        remarks = (*pair.remarks, *bearing_remarks(shafts, oil), *said)
        return pair._replace(
            data=pair.data | of_modes | held,
            tables=(*pair.tables, *tables),
            remarks=remarks,
            details=(*pair.details, *heat_details),
        )
    train = _train(prepared)
    flow = flow_of(prepared) if case.sets else None
    powers = power_data(prepared, flow)
    of_powers, circling = power_table(prepared, powers)
    locks = [LOCKS] if case.sets and flow is None else []
    of_sets_alone = {
        "planet_pass_frequencies": planet_pass(prepared),
        "set_frequencies": {name: of_set._asdict() for name, of_set in of_sets(prepared).items()},
    }
    data = {
        **train,
        **of_modes,
        **held,
        **({"mode_kinds": list(kinds)} if kinds else {}),
        **(of_sets_alone if case.sets else {}),
        **powers,
        "mesh_frequencies": dict(zip(names, mesh_frequencies(prepared), strict=True)),
        "meshes": {name: checked.data for name, checked in zip(names, of_meshes, strict=True)},
    }
    tables = [*_train_tables(prepared, train), *of_powers, *_set_tables(prepared), *tables]
    details = [*heat_details, *_once(names, [checked.tables for checked in of_meshes])]
    remarks = [
        *circling,
        *_named(names, [checked.remarks for checked in of_meshes]),
        *bearing_remarks(shafts, oil),
        *said,
    ]
    sentences = _named(names, [checked.warnings for checked in of_meshes])
    warnings = tuple(dict.fromkeys((*locks, *jams(prepared), *sentences)))
    return CheckResult(data, tables, remarks, warnings, details)


def _passing_elements(case: Gearbox) -> dict[str, dict[str, float]]:
    """Frequencies of cages and elements of the bearings in time, Hz, by their names."""
    return {
        name: {what: turns * speed / (2.0 * pi) for what, turns in passing._asdict().items()}
        for name, (speed, passing) in passing_of(case.system).items()
    }


def _element_table(frequencies: dict[str, dict[str, float]]) -> TextTable:
    rows = [(name, *(f"{each:.5g}" for each in of.values())) for name, of in frequencies.items()]
    head = ("bearing", "cage", "elements pass outer ring", "inner ring", "element spin")
    return TextTable("Bearings in time: frequencies at nominal speed (Hz)", head, rows)


def _named(names: list[str], remarks: list[Any]) -> Iterator[str]:
    """What is said of the meshes; once where it is said of all."""
    of_line: dict[str, list[str]] = {}
    for name, each in zip(names, remarks, strict=True):
        for line in dict.fromkeys(each):
            of_line.setdefault(line, []).append(name)
    yield from (line for line, of in of_line.items() if len(of) == len(names))
    for line, of in of_line.items():
        if len(of) < len(names):
            yield f"Mesh {together(of)}: {line}"


def _once(names: list[str], tables: Sequence[Sequence[TextTable]]) -> Iterator[TextTable]:
    """The tables of the meshes, equal ones once."""
    distinct: list[tuple[TextTable, list[str]]] = []
    for name, each in zip(names, tables, strict=True):
        for table in each:
            same = next((of for other, of in distinct if other == table), None)
            if same is None:
                distinct.append((table, [name]))
            else:
                same.append(name)
    for table, of in distinct:
        yield table._replace(title=f"{table.title}, mesh {together(of)}")


def _of_mesh(prepared: PreparedGearbox, m: int, along: dict[str, Any]) -> CheckResult:
    pair, tabulated = prepared.warm_pairs[m], prepared.tables[m]
    thermal = prepared.thermal[m]
    gears = PreparedGears(
        pair, tabulated.assembly, tabulated.cycle, thermal, slice_remark=tabulated.slice_remark
    )
    masses = None if prepared.case.named else tabulated.masses
    ends = {prepared.case.meshes[m].driver, prepared.case.meshes[m].driven}
    bearings = [link.bearing for link in prepared.case.links if link.bearing and link.ends[0] in ends]
    checked = check_gears(gears, prepared.model.closure(m), masses)
    checked = checked._replace(data=checked.data | along)
    return with_duty(checked, prepared.case.pairs[m], bearings)


def _speeds(prepared: PreparedGearbox) -> np.ndarray:
    """Nominal speeds of the bodies, rad/s."""
    return np.asarray(prepared.model.bodies.ratio) * prepared.model.operation.nominal_speed


def _train(prepared: PreparedGearbox) -> dict[str, Any]:
    """The train for programs, SI."""
    case, model = prepared.case, prepared.model
    layout, speeds = model.layout, _speeds(prepared)
    bodies = {}
    for b, (name, kinematics) in enumerate(zip(prepared.names, prepared.bodies, strict=True)):
        bodies[name] = {
            "speed": float(speeds[b]),
            "shaft_frequency": float(speeds[b]) / (2.0 * pi),
            "counter_clockwise": kinematics.sense > 0,
            "mass": float(model.bodies.mass[b]) if b < layout.planar else None,
            "inertia": float(model.bodies.inertia[b]),
            "centre": list(map(float, kinematics.centre)),
        }
    torques = flow(model).on_driven
    meshes = {
        mesh.name: {
            "driver": case.gears[mesh.gears[0]].name,
            "driven": case.gears[mesh.gears[1]].name,
            "rate": str(mesh.rate),
            "phase": float(prepared.phases.meshes[m]),
            "azimuth": float(mesh.azimuth),
            "driven_torque": float(torques[m] * model.meshes[m].driven_sense),
        }
        for m, mesh in enumerate(case.meshes)
    }
    ratio = float(speeds[layout.input] / speeds[layout.output])
    return {"train_ratio": ratio, "common_period": case.period, "bodies": bodies, "train_meshes": meshes}


def _train_tables(prepared: PreparedGearbox, train: dict[str, Any]) -> list[TextTable]:
    case = prepared.case
    cycles = "1 cycle" if case.period == 1 else f"{case.period} cycles"
    whole = [
        ("ratio of input to output speed", f"{train['train_ratio']:.6g}"),
        ("common period of the meshes", f"{cycles} of mesh {case.meshes[0].name}"),
        ("repeats every", f"{case.period / mesh_frequencies(prepared)[0] * 1e3:.4g} ms"),
    ]
    bodies = [
        (
            name,
            f"{body['speed'] * 30.0 / pi:.5g}",
            f"{body['shaft_frequency']:.5g}",
            "counter-clockwise" if body["counter_clockwise"] else "clockwise",
            "–" if body["mass"] is None else f"{body['mass']:.4g}",
            f"{body['inertia']:.4g}",
            ", ".join(f"{round(place * 1e3, 9) + 0.0:.5g}" for place in body["centre"]),
        )
        for name, body in train["bodies"].items()
    ]
    meshes = [
        (
            name,
            f"{mesh['driver']} → {mesh['driven']}",
            f"{frequency:.5g}",
            f"{float(tabulated.cycle.contact_ratio):.4g}",
            f"{mesh['driven_torque']:.5g}",
            f"{degrees(mesh['azimuth']):.4g}",
            f"{mesh['phase']:.4f}",
        )
        for (name, mesh), frequency, tabulated in zip(
            train["train_meshes"].items(), mesh_frequencies(prepared), prepared.tables, strict=True
        )
    ]
    return [
        TextTable("Train", ("quantity", "value"), whole),
        TextTable(
            "Bodies", ("body", "rpm", "Hz", "turns", "mass (kg)", "inertia (kg m²)", "centre (mm)"), bodies
        ),
        TextTable(
            "Meshes",
            ("mesh", "drives", "Hz", "contact ratio", "driven torque (N m)", "azimuth (°)", "phase"),
            meshes,
        ),
    ]


def _set_tables(prepared: PreparedGearbox) -> list[TextTable]:
    """How often teeth of planetary sets meet their mates."""
    rows = [
        (name, *(f"{value:.5g}" for value in (of_set.mesh, of_set.planet_pass, *of_set[3:])))
        for name, of_set in of_sets(prepared).items()
    ]
    head = ("stage", "mesh (Hz)", "planets pass ring", "sun tooth", "planet tooth", "ring tooth")
    return [TextTable("Planetary stages: how often a tooth meets a mate", head, rows)] if rows else []


def _mode_table(prepared: PreparedGearbox, mode_set: Modes, kinds: Sequence[str]) -> TextTable:
    """Natural frequencies, kinds of modes where there are planets, and the bodies that move in each."""
    rows = []
    for frequency, share in zip(mode_set.frequency, mode_set.share, strict=True):
        order = np.argsort(-share, kind="stable")
        who = ", ".join(f"{prepared.names[b]} {100.0 * share[b]:.0f} %" for b in order if share[b] > LITTLE)
        rows.append((f"{frequency:.5g}", *kinds[len(rows) : len(rows) + 1], who))
    title = "Natural frequencies, at the mean mesh stiffness, and shares of the kinetic energy"
    return TextTable(title, ("Hz", *(("kind",) if kinds else ()), "bodies"), rows)


def _rpm(speed: float) -> str:
    """A speed with four digits, written out."""
    return f"{float(f'{speed:.4g}'):g}"


def _campbell_table(prepared: PreparedGearbox, modes_of: Modes) -> TextTable:
    """Speeds of the input at which harmonics of the meshes meet the modes."""
    speed = float(_speeds(prepared)[prepared.model.layout.input]) * 30.0 / pi
    meets: dict[str, tuple[float, int]] = {}
    for name, frequency in distinct_meshes(prepared):
        meets |= {
            f"{name} ×{order}" if order > 1 else name: (frequency, order) for order in range(1, HARMONICS + 1)
        }
    meets |= {name: (frequency, 1) for name, frequency in passes(prepared) if frequency}
    rows = [
        (f"{mode:.5g}", *(_rpm(mode / (order * frequency) * speed) for frequency, order in meets.values()))
        for mode in modes_of.frequency
    ]
    title = f"Campbell: input speed (rpm) at which a mesh meets a mode; now {_rpm(speed)}"
    return TextTable(title, ("mode (Hz)", *meets), rows)
