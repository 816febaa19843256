"""The meshes of a train as pairs of gears at their duty: what an assessment rates one by one."""

import tomllib
from collections.abc import Mapping
from typing import Any

from tribodyn.cases.assessment_part import MeshAtDuty, Meshing, WholeDrive, shared_names
from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.gears.bearings_in_time import cages_turn
from tribodyn.gears.motion.tooth_loads import ToothLoads, tooth_loads
from tribodyn.gears.rating.bearings import TurningShaft
from tribodyn.geometry.drive import SIDES, Side
from tribodyn.input.names import under_one_name
from tribodyn.input.tables.gears.model_files import DriveTable, Gear
from tribodyn.quantities.catalogue import OF_FACE
from tribodyn.record.reader import Record
from tribodyn.studies.motion.case import Gearbox, TrainMesh
from tribodyn.studies.motion.drivetrain.mesh_groups import alike_of
from tribodyn.studies.motion.heat.settled import in_balance, prepare_settled
from tribodyn.studies.motion.train.face_loads import along_face, of_deflected, proposals
from tribodyn.studies.motion.train.pair_view import stiffness_key
from tribodyn.studies.protocol.load import load_data
from tribodyn.train.planetary import CARRIER


def meshes(case: Gearbox) -> list[MeshAtDuty]:
    """Every mesh with its pair; those of a planetary set with its name."""
    stages = {gearset.members[CARRIER]: gearset.name for gearset in case.sets}
    return [
        MeshAtDuty(
            mesh.name, mesh.pair, alike, stages.get(mesh.carrier, ""), _meshing(case, mesh), _distance(mesh)
        )
        for mesh, alike in zip(case.meshes, alike_of(case), strict=True)
    ]


def _distance(mesh: TrainMesh) -> str:
    """The key of the centre distance of two shafts; "" where none is given, or the mesh is of a set."""
    given = mesh.pair.drive.centre_distance is not None and mesh.carrier < 0
    return f"{mesh.key}.centre_distance" if given and not mesh.key.startswith("mesh.") else ""


def _meshing(case: Gearbox, mesh: TrainMesh) -> tuple[Meshing, Meshing]:
    """How the gears of a mesh are loaded in all of their meshes.

    Teeth that drive are loaded on one flank, those that are driven on the other.
    """
    meshings = []
    for number, role in zip(mesh.gears, SIDES, strict=True):
        roles = [side for _, side in case.gears[number].meshes]
        meshings.append(Meshing(roles.count(role), len(set(roles)) > 1))
    return meshings[0], meshings[1]


def at_torque(case: Gearbox, scenario: Mapping[str, Any]) -> dict[str, Any]:
    """The scenario with its speed given at the input, and with its torque in place of a power."""
    operating = under_one_name(scenario["operating"])
    operating.pop("output_speed", None)
    if operating.pop("power", None) is not None and case.loads:
        operating["output_torque"] = f"{case.loads[0].torque!r} N*m"
    operating["input_speed"] = f"{case.source.speed!r} rad/s"
    return {**scenario, "operating": operating}


#: Mesh cycles of all meshes in a common period above which a steady state takes far longer than a run.
_LONG_PERIOD = 100


def marched(case: Gearbox) -> int:
    """Mesh cycles of a run where meshes or teeth do not repeat, or after so many cycles alone; 0: they do."""
    differ = cages_turn(case.system) or any(any(pair.teeth) for pair in case.pairs)
    longest = min(case.max_period, max(_LONG_PERIOD // len(case.meshes), 1))
    return case.solver.cycles if differ or case.period > longest else 0


#: Tables of a train's scenario that all pairs have alike.
_COMMON = ("mesh", "lubricant", "film", "friction", "temperature")
#: Keys of all gears.
_OF_ALL = ("material", "mean_roughness", "quality", "quality_edition")


def pair_of(case: Gearbox, name: str) -> dict[str, Any]:
    """The pair of gears of a mesh at its duty as a scenario has it; its driver, unless internal, the pinion.

    Without a name that of the only mesh; what the meshes of all planets share names the first of them. Raises
    InputError for a mesh that is not there, or has no teeth.
    """
    names, shared = [mesh.name for mesh in case.meshes], shared_names(meshes(case))
    if not name and len(set(shared)) > 1:
        rule = f"missing: the gearbox has {len(names)} meshes"
        raise InputError("mesh", None, rule, f"name one of them: {', '.join(dict.fromkeys(shared))}")
    if name and name not in (*names, *shared):
        raise unknown_name("mesh", name, dict.fromkeys((*names, *shared)), "mesh")
    mesh = case.meshes[names.index(name) if name in names else shared.index(name or shared[0])]
    table, pair = tomllib.loads(case.toml), mesh.pair
    if mesh.key.startswith("mesh."):
        rule = "is of a bare model, without teeth"
        raise InputError("mesh", quoted(mesh.name), rule, "name a mesh of a [[stage]]")
    operating, tables = table["operating"], pair_tables(case, mesh, table)
    if mesh.key != "drive":
        tables["drive"] |= {"title": f"mesh {mesh.name} of {case.title}", "source": "its scenario"}
    drive = tables["drive"]
    speed, torque = pair.operating.pinion_speed, pair.operating.gear_torque
    if drive["pinion"].get("internal"):  # of a pair the gear is internal: with a negative torque it drives
        tables["drive"] = {
            **drive,
            "pinion": _on_both_flanks(drive["gear"]),
            "gear": _on_both_flanks(drive["pinion"]),
        }
        ratio = drive["pinion"]["teeth"] / drive["gear"]["teeth"]
        speed, torque = speed * ratio, -torque * ratio
    duty = {"pinion_speed": f"{speed!r} rad/s", "gear_torque": f"{torque!r} N*m"}
    duty |= {key: operating[key] for key in ("oil_temperature",) if key in operating}
    if case.heat is not None:  # which a mesh alone does not have: its oil is as warm as its teeth
        settled = in_balance(case).heat
        assert settled is not None
        assert settled.settled is not None
        teeth = settled.settled.gears[case.meshes.index(mesh)]
        duty["oil_temperature"] = f"{0.5 * sum(teeth)!r} K"
        tables.pop("temperature", None)
    return tables | {"operating": duty}


def _on_both_flanks(gear: Mapping[str, Any]) -> dict[str, Any]:
    """A gear's table whose modification is on the back flanks too, which carry where the gear drives."""
    if "modification" not in gear:
        return dict(gear)
    return {**gear, "modification": {**gear["modification"], "both_flanks": True}}


def pair_tables(case: Gearbox, mesh: TrainMesh, table: Mapping[str, Any]) -> dict[str, Any]:
    """Tables of a scenario (`table` the train's) of the pair of gears in a mesh, without its duty."""
    found = {key: table[key] for key in _COMMON if key in table}
    if mesh.key == "drive":
        return found | {"drive": table["drive"]}
    group, place = mesh.key.split(".")
    stage = table[group][int(place)]
    drive = {key: table[key] for key in _OF_ALL if key in table}
    drive |= {key: value for key, value in stage.items() if key in DriveTable.model_fields}
    drive.setdefault("family", "involute")
    for side, number in zip(SIDES, mesh.gears, strict=True):
        gear = table.get("gear", {}).get(case.gears[number].key.removeprefix("gear."), {})
        drive[side] = {name: value for name, value in gear.items() if name in Gear.model_fields}
    if "second_module" in stage and mesh.name.startswith(f"{stage['name']}-ring-"):
        drive["module"] = stage["second_module"]
    distance = mesh.pair.drive.centre_distance
    if "planet" in stage and mesh.pair.drive.helix_angle:
        drive["hand"] = "right" if mesh.pair.drive.helix_angle > 0.0 else "left"
    if (
        "planet" in stage and "centre_distance" not in stage and distance is not None
    ):  # the sun's, at the ring
        drive["centre_distance"] = f"{1e3 * abs(float(distance))!r} mm"
    if group == "stage":
        keys = {"damping_ratio": "damping_ratio", "backlash": "backlash"}
        keys["stiffness"] = stiffness_key(mesh.name, stage["name"] if "planet" in stage else "")
        own = {name: stage[key] for name, key in keys.items() if key in stage}
        found["mesh"] = found.get("mesh", {}) | own
    return found | {"drive": drive}


def meshes_of_gear(case: Gearbox, name: str) -> dict[str, Side]:
    """The meshes of a gear, or of all planets of a set, and what it is in the pair that `pair_of` gives.

    Raises InputError for a gear that is not there.
    """
    names = {gear.key.removeprefix("gear."): gear for gear in reversed(case.gears)}
    names |= {gear.name: gear for gear in case.gears}
    if name not in names:
        raise unknown_name("gear", name, names, "gear")
    shared = shared_names(meshes(case))
    found: dict[str, Side] = {}
    for m, side in names[name].meshes:
        turned = case.gears[case.meshes[m].gears[0]].teeth < 0
        found.setdefault(shared[m], SIDES[turned ^ SIDES.index(side)])
    return found


def duties(case: Gearbox) -> list[tuple[float, Gearbox]]:
    """Every duty of the load spectrum with its share of the time."""
    table = tomllib.loads(case.toml)
    shares = [float(duty["share"]) for duty in table.get("duty", ())]
    return [
        (
            share / sum(shares),
            load_data({**table, "operating": {**table["operating"], "duty": number}}, case.name).case,
        )
        for number, share in enumerate(shares, start=1)
    ]


def shafts(case: Gearbox) -> list[TurningShaft]:
    """The drawn shafts at their speeds."""
    reference = case.source.speed / float(case.bodies[case.source.body].ratio)
    drawn = case.system.shafts if case.system is not None else ()
    named = {shaft.points[0][0]: shaft.name for shaft in drawn}
    return [
        TurningShaft(named.get(body, part.name), held, float(part.ratio) * reference)
        for body, held in case.supports.items()
        if held.bearings and (part := case.bodies[body])
    ]


def faces(case: Gearbox) -> dict[str, dict[str, float]]:
    """Loads along the faces of meshes on drawn shafts, matrices or pins, and what makes them even."""
    spread = of_deflected(prepare_settled(case))
    proposed, found = proposals(spread, len(case.meshes)), dict[str, dict[str, float]]()
    for m, mesh in enumerate(case.meshes):
        of_mesh = along_face(spread, m) | proposed[m]
        if of_mesh:
            found[mesh.name] = {one.name: of_mesh[one.name] for one in OF_FACE if one.name in of_mesh}
    return found


#: Positions of a mesh cycle at which the loads of its teeth are taken.
_POSITIONS = 80


def loads(record: Record, case: Gearbox, name: str) -> ToothLoads | None:
    """Loads of a mesh in the last common period, or its last cycles; None: no whole cycle of it was run."""
    m = [mesh.name for mesh in case.meshes].index(name)
    period = float(case.laid_out * case.meshes[m].rate)
    table = record.of_mesh(name, "mesh_cycle")
    phase, load = record["mesh_phase"][:, m], record["normal_load"][:, m]
    return tooth_loads(phase, load, record.pairs, table, _POSITIONS, period)


WHOLE = WholeDrive(
    meshes,
    at_torque,
    marched,
    lambda case: case.source.speed,
    pair_of,
    meshes_of_gear,
    duties,
    shafts,
    faces,
    loads,
)
