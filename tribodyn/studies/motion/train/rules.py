"""Rules that tie several keys of a train's scenario together: whether it is a train that can be made."""

from collections.abc import Iterator
from typing import Any

from tribodyn.errors import InputError, InputErrors, quoted
from tribodyn.gears.damage_rules import broken_damage
from tribodyn.gears.motion.settings import (
    broken_flank_rules,
    broken_mesh_rules,
    broken_output_rules,
    broken_rules_in_time,
    broken_solver_rules,
    broken_source_rules,
)
from tribodyn.gears.scenario import broken_gear_rules
from tribodyn.input.tables.duty import unnamed_duty
from tribodyn.input.tables.gears.drive_data import gives_backlash
from tribodyn.input.tables.laws import broken_link_law
from tribodyn.input.tables.losses import broken_mesh_method
from tribodyn.input.tables.sensors import broken_sensor_rules
from tribodyn.input.tables.shafts import drawn_shafts, listed
from tribodyn.input.tables.temperature import GEARBOX, broken_gearbox_heat
from tribodyn.studies.motion.drivetrain.clutch_rules import broken_clutch
from tribodyn.studies.motion.drivetrain.duty import broken_duty, duty_of
from tribodyn.studies.motion.drivetrain.names import broken_names, broken_sort
from tribodyn.studies.motion.drivetrain.placed_train import (
    TrainKinematics,
    in_terms_of_train,
    place_train,
    resolve_kinematics,
)
from tribodyn.studies.motion.drivetrain.tables import PlanetaryStage
from tribodyn.studies.motion.train.pair_view import (
    broken_train_losses,
    gears_of_train,
    pair_view,
    reference_teeth,
)
from tribodyn.studies.motion.train.scenario import Scenario
from tribodyn.train.planetary import CARRIER


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that the scenario breaks; none: it is consistent."""
    if broken := list(broken_sort(scenario)):
        yield from broken
        return
    broken = [
        *broken_names(scenario),
        *_of_all_gears(scenario),
        *_bearings(scenario),
        *_in_sets(scenario),
        *(e for number, link in enumerate(scenario.link) for e in broken_link_law(f"link.{number}", link)),
        *(e for number, one in enumerate(scenario.clutch) for e in broken_clutch(f"clutch.{number}", one)),
        *broken_source_rules(scenario.operating),
        *broken_duty(scenario),
        *unnamed_duty(scenario),
    ]
    if not isinstance(scenario.mesh, tuple):
        broken += [
            *broken_mesh_rules(scenario.mesh),
            *_stiffness_of_stages(scenario.stage, scenario.mesh.compliance),
        ]
    else:
        broken += _bare_meshes(scenario.mesh)
        if scenario.temperature is not None and scenario.temperature.model == GEARBOX:
            rule = "needs gears with teeth, and those of a bare model have none"
            broken.append(InputError("temperature.model", quoted(GEARBOX), rule, "write [[stage]]"))
    broken += [*broken_solver_rules(scenario.solver), *broken_rules_in_time(scenario)]
    broken += broken_sensor_rules(scenario.sensor, scenario.housing)
    yield from broken
    if not broken:
        yield from _of_train(scenario)


def _of_train(scenario: Scenario) -> Iterator[InputError]:
    """What can be said once names and duty are sound: of the train, then of its pairs, then of room."""
    try:
        train = resolve_kinematics(scenario)
    except InputError as error:
        yield error
        return
    gears = [gear.name for gear in train.parts.gears]
    families = [None] if isinstance(scenario.mesh, tuple) else [stage.family for stage in scenario.stage]
    of_losses = [
        *broken_train_losses(scenario.losses, train, scenario.shaft),
        *broken_mesh_method(scenario.losses, families),
        *broken_gearbox_heat(scenario.temperature, scenario.operating.oil_temperature, gears),
    ]
    if broken := [*_each_mesh_once(train), *_hands(train), *of_losses, *_pairs(scenario, train)]:
        yield from broken
        return
    if scenario.damage and isinstance(scenario.mesh, tuple):
        yield InputError(
            "damage", None, "the meshes of a bare model are given, without teeth", "leave it out"
        )
        return
    try:
        place_train(train)
    except InputErrors as error:
        yield from error.errors
    except InputError as error:
        yield error
    else:
        yield from broken_damage(scenario.damage, gears_of_train(train))


def _each_mesh_once(train: TrainKinematics) -> Iterator[InputError]:
    """Refuse two meshes of one name, and of the same two gears."""
    names: dict[str, str] = {}
    pairs: dict[frozenset[int], str] = {}
    for mesh in train.parts.meshes:
        if (first := pairs.setdefault(frozenset(mesh.gears), mesh.key)) != mesh.key:
            yield InputError(mesh.key, None, f"its gears mesh in {first} already", "write the mesh once")
        elif (first := names.setdefault(mesh.name, mesh.key)) != mesh.key:
            rule = f"names two meshes, that of {first} too"
            yield InputError(f"{mesh.key}.name", quoted(mesh.name), rule, "use another name")


def _hands(train: TrainKinematics) -> Iterator[InputError]:
    """Ask for the hand of a helical gear that meshes with several: no mesh can choose it alone."""
    for number, gear in enumerate(train.parts.gears):
        helical = [mesh for mesh, _ in train.meshes_of(number) if train.drives[mesh].helix_angle]
        if len(helical) > 1 and gear.table.hand is None:
            rule = "missing: the gear meshes with several, and its helix has one hand"
            yield InputError(f"{gear.key}.hand", None, rule, 'add hand = "right"')


def _pairs(scenario: Scenario, train: TrainKinematics) -> Iterator[InputError]:
    """Rules of every mesh as a pair of gears, and of its load; what all meshes share is said once."""
    reported: set[str] = set()
    yield from broken_output_rules(scenario.output, scenario.solver, reference_teeth(train))
    unloaded: set[str] = set()
    duty = duty_of(scenario, train)
    for mesh, torque in enumerate(duty.torques.driven):
        view = pair_view(scenario, train, mesh)
        part = train.parts.meshes[train.motion.meshes[mesh]]
        back = view.mesh.backlash is not None or gives_backlash(view.drive)
        for error in broken_gear_rules(view, every_duty=True, every_tooth=True):
            error = in_terms_of_train(error, train, mesh)
            if str(error) not in reported:
                reported.add(str(error))
                yield error
        if not torque and part.member and any(duty.torques.driven) and scenario.solver.initial == "static":
            yield from _idle(train, mesh)
            return
        for error in broken_flank_rules(part.key, torque, back, view.mesh):
            if error.rule not in unloaded:  # of all stages that are driven backwards the first
                unloaded.add(error.rule)
                yield error


def _idle(train: TrainKinematics, mesh: int) -> Iterator[InputError]:
    """Ask for a load on the member of a planetary stage that nothing drives: its teeth have no place."""
    parts, part = train.parts, train.parts.meshes[train.motion.meshes[mesh]]
    own = parts.sets[part.of_set]
    used = {own.held, train.motion.bodies[train.motion.input]}
    used |= {body for _, ends in parts.couplings() for body in ends}
    first = own.members.get(part.member, own.members[CARRIER])
    idle = next((body for body in (first, *own.members.values()) if body not in used), first)
    name = parts.bodies[idle].name
    rule = f"{name} of the planetary stage {own.table.name} idles: no torque says where its teeth stand"
    remedy = f'add a [[load]] with at = "{name}" and its drag, torque = "1 N*m", or hold it'
    yield InputError("load", None, rule, remedy)


def _of_all_gears(scenario: Scenario) -> Iterator[InputError]:
    """Name what no gear says of itself where it is said for all of them."""
    tables = [*scenario.gear.values()]
    bare = isinstance(scenario.mesh, tuple)
    if scenario.drive is not None:
        return
    if scenario.material is None and (bare or all(gear.material is None for gear in tables)):
        remedy = 'add material = "18CrNiMo7-6", of all gears that name none'
        yield InputError("material", None, "missing", remedy)
    flanks = any(gear.mean_roughness for gear in tables) or any(stage.roughness for stage in scenario.stage)
    if scenario.mean_roughness is None and not flanks:
        remedy = 'add mean_roughness = "0.6 um", Ra of the flanks of all gears that say none'
        yield InputError("mean_roughness", None, "missing", remedy)


def _stiffness_of_stages(stages: Any, compliance: str) -> Iterator[InputError]:
    for number, stage in enumerate(stages):
        for name in ("stiffness", "sun_stiffness", "ring_stiffness"):
            stiffness = getattr(stage, name, None)
            if stiffness is not None and compliance != "constant":
                rule = f'contradicts mesh.compliance = "{compliance}"'
                remedy = 'leave it out, or write compliance = "constant" with a stiffness for other meshes'
                yield InputError(f"stage.{number}.{name}", f"{stiffness:g} N/m", rule, remedy)


def _bearings(scenario: Scenario) -> Iterator[InputError]:
    for name, bearing in scenario.bearings.by_name.items():
        if bearing.matrix is not None and name in ("default", *_of_sets(scenario)) and _of_sets(scenario):
            rule = "couples directions in which bodies of planetary stages do not move"
            remedy = (
                "give these stiffness_x, stiffness_y and damping_ratio, and others matrices by their names"
            )
            yield InputError(f"bearings.{name}.matrix", None, rule, remedy)


def _of_sets(scenario: Scenario) -> set[str]:
    """Names of what is in planetary stages, and of the shafts that join it."""
    stages = [stage for stage in scenario.stage if isinstance(stage, PlanetaryStage)]
    names = {name for stage in stages for name in stage.parts}
    return names | {shaft.name for shaft in listed(scenario.shaft) if names & set(shaft.gears)}


def _in_sets(scenario: Scenario) -> Iterator[InputError]:
    """Refuse to draw shafts of gears of planetary stages."""
    names = _of_sets(scenario)
    for gear, (key, _) in drawn_shafts(scenario.shaft).items():
        if gear in names:
            rule = "is of a planetary stage, whose bodies move in the plane"
            yield InputError(key, None, rule, "give it a stiffness in [bearings]")


def _bare_meshes(meshes: Any) -> Iterator[InputError]:
    for number, mesh in enumerate(meshes):
        key = f"mesh.{number}.stiffness"
        if mesh.stiffness is None and mesh.table is None:
            yield InputError(key, None, "missing", 'add stiffness = "2.8e8 N/m", or a table')
        if mesh.stiffness is not None and mesh.table is not None:
            rule = "contradicts table, which gives it over the roll angle"
            yield InputError(key, f"{mesh.stiffness:g} N/m", rule, "give the one or the other")
