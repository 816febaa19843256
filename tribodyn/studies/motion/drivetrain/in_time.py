"""A gearbox as a model to be moved on in time, with torques or speeds of its ends as inputs."""

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from tribodyn.dynamics import parameters
from tribodyn.dynamics.loads import load_torque
from tribodyn.errors import InputError, SimulationError
from tribodyn.exchange.format import SPEED, TORQUE, GearboxInTime
from tribodyn.solve.initial import initial_state
from tribodyn.studies.motion.assembly import PreparedGearbox
from tribodyn.studies.motion.case import Gearbox, SourceData
from tribodyn.studies.motion.heat.settled import prepare_settled
from tribodyn.studies.motion.heat.thermal_iteration import at_tooth_temperatures
from tribodyn.studies.motion.planetary.frames import reference_pitch
from tribodyn.train.motor import torque_at
from tribodyn.tribology.closure import closure_of
from tribodyn.tribology.oil import lubricant_at

#: Fields of an operation without a load and a motor that vary.
_NOTHING: dict[str, Any] = dict.fromkeys(
    (
        *("load_times", "load_torques", "load_slopes"),
        *("load_amplitudes", "load_frequencies", "load_phases"),
        *("motor_speeds", "motor_torques", "motor_slopes"),
    ),
    np.zeros(0),
)


def in_time(case: Gearbox, drive: str, load: str) -> GearboxInTime:
    """A gearbox whose input and output have a torque or a speed as input.

    Loads of the scenario at the output, motor curves and speed regulation are left out, their values at the
    start are those of the inputs. Raises InputError where it cannot be moved on in time.
    """
    _refuse(case)
    # a prescribed rotation needs no motor
    source = case.source if case.source.kind == drive else _driven(case.source, drive)
    solver = replace(case.solver, duration=case.solver.duration or _duration(case))
    prepared = prepare_settled(replace(case, source=source, solver=solver, sensors=()))
    own = prepared.model
    layout, operation = own.layout, own.operation
    if drive == SPEED and layout.input != 0:
        rule = "is not the body that drives the first mesh, and its speed cannot be prescribed"
        raise InputError("operating.input", case.bodies[source.body].name, rule, "choose a torque as input")
    if not case.loads or layout.output == layout.input:
        rule = "there is no load, and an output is due"
        raise InputError("operating.output", None, rule, 'name a gear, a shaft or a body: output = "wheel"')
    nominal = float(own.bodies.ratio[layout.input]) * float(operation.nominal_speed)
    own_start = nominal + float(operation.start_slip) * float(own.bodies.ratio[layout.input])
    start = own_start if drive == TORQUE else nominal
    motor = float(torque_at(start, start - nominal, operation)[0])
    torque = float(own.bodies.load[layout.output]) + float(load_torque(0.0, operation))
    bodies = own.bodies._replace(
        load=_without(own.bodies.load, layout.output),
        load_damping=_without(own.bodies.load_damping, layout.output),
    )
    inputs = operation._replace(
        drive_torque=motor if drive == TORQUE else 0.0,
        speed_regulation=0.0,
        output_torque=torque if load == TORQUE else 0.0,
        **_NOTHING,
    )
    speeds = sorted({0.0, start, nominal}) if drive == TORQUE else [nominal]
    starts = {speed: _state(own, case.solver.initial, speed - nominal) for speed in speeds}
    model, fixed = own._replace(bodies=bodies, operation=inputs), _fixed_oil(case)
    remarks = [*_left_out(case, drive), *(reason for _, reason in starts.values()), fixed]
    return GearboxInTime(
        model=model,
        starts={speed: state for speed, (state, _) in starts.items()},
        start_speed=start,
        output_torque=torque,
        rtol=case.solver.rtol,
        max_steps=case.solver.max_steps,
        duration=solver.duration or 0.0,
        meshes=tuple(mesh.name for mesh in case.meshes) if case.named else ("mesh",),
        ends=(prepared.names[layout.input], prepared.names[layout.output]),
        oil_temperature=_oil_temperature(case),
        at_temperature=None if fixed else partial(_at_temperature, prepared, model),
        remarks=tuple(dict.fromkeys(remark for remark in remarks if remark)),
    )


def _refuse(case: Gearbox) -> None:
    """Refuse what cannot be moved on in time; the rest `prepare` refuses."""
    if case.pair.mesh.formulation != "classical":
        rule = "takes energy from the rotation as pairs enter, of which gears that stand have none"
        raise InputError("mesh.formulation", case.pair.mesh.formulation, rule, 'use "classical"')


def _duration(case: Gearbox) -> float:
    """Duration of the scenario's run over the rotation at nominal speed, s."""
    speed = case.source.speed / float(case.bodies[case.source.body].ratio)
    return case.solver.cycles * reference_pitch(case) / speed


def _driven(source: SourceData, drive: str) -> SourceData:
    """What drives in another way: a motor without inertia, or a prescribed rotation."""
    bare = SourceData(drive, source.body, source.speed, source.torque)
    return bare if drive == TORQUE else replace(bare, torque=0.0)


def _without(torques: Any, body: int) -> np.ndarray:
    """Torques of bodies without that of one."""
    left = np.array(torques, dtype=float)
    left[body] = 0.0
    return left


def _state(model: parameters.Model, kind: str, slip: float) -> tuple[np.ndarray, str]:
    """State at the start, `slip` above nominal speed of the input, rad/s; and why it is an unloaded one."""
    share = float(model.bodies.ratio[model.layout.input])
    begun = model._replace(operation=model.operation._replace(start_slip=slip / share))
    try:
        return initial_state(begun, kind), ""
    except SimulationError as error:
        return initial_state(begun, "unloaded"), f"starts are without load: {error.reason}"


def _oil_temperature(case: Gearbox) -> float | None:
    """Temperature of the oil that enters the meshes, K, if known."""
    oil = case.pair.lubricant
    supply = oil.temperature if oil.supply is None else oil.supply
    return None if supply is None else float(supply)


def _fixed_oil(case: Gearbox) -> str:
    """Why the temperature of the oil cannot be an input; "": it can."""
    if case.pair.lubricant.sheet is None or _oil_temperature(case) is None:
        return "the oil is known at one temperature only, which is no input"
    settled = case.heat is not None or any(
        pair.temperature is not None and pair.temperature.model == "network" for pair in case.pairs
    )
    return "the temperature of the oil follows from the losses, and is no input" if settled else ""


def _at_temperature(
    prepared: PreparedGearbox, model: parameters.Model, temperature: float
) -> parameters.Model:
    """The model with its surfaces and laws where the oil that enters the meshes has a temperature, K."""
    case = prepared.case
    meshes = tuple(
        replace(mesh, pair=replace(mesh.pair, lubricant=lubricant_at(mesh.pair.lubricant, temperature)))
        for mesh in case.meshes
    )
    warm = at_tooth_temperatures(replace(case, meshes=meshes), prepared.tables)
    closures = [closure_of(pair) for pair, _ in warm]
    return model._replace(
        meshes=tuple(
            mesh._replace(
                surfaces=closure.surfaces, film=closure.film.parameters, friction=closure.friction.parameters
            )
            for mesh, closure in zip(model.meshes, closures, strict=True)
        )
    )


def _left_out(case: Gearbox, drive: str) -> list[str]:
    """What of the scenario is not in the model."""
    found = []
    if case.sensors:
        found.append("sensors are left out")
    varying = any(load.table or load.harmonics or load.damping for load in case.loads[:1])
    if varying:
        found.append("the load at the output is an input: its table, harmonics and damping are left out")
    if drive == TORQUE and (case.source.curve or case.source.speed_regulation):
        found.append("the torque at the input is an input: the motor's torque over speed is left out")
    one_sided = [mesh.name for mesh in case.meshes if mesh.pair.mesh.backlash is None]
    if one_sided:
        found.append(
            "without mesh.backlash back flanks never touch: teeth that part under a torque in the other "
            f"direction carry nothing ({', '.join(one_sided)})"
        )
    return found
