"""The variables of an FMU: what is prescribed, what may be set, what comes out."""

import re
from collections.abc import Sequence
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from tribodyn.exchange.fmu.oil import OilTable
from tribodyn.exchange.format import TORQUE, GearboxInTime
from tribodyn.solve.march.time_outputs import TimeOutput, time_outputs
from tribodyn.solve.tolerances import output_shaft

#: Outputs that do not depend on inputs at the same moment: those of the state alone.
_OF_STATE = (
    "input_angle",
    "input_speed",
    "output_angle",
    "output_speed",
    "stored_energy",
    "transmission_error",
    "normal_load",
)
#: What may be set without a limit.
UNLIMITED = 1e300


class Role(StrEnum):
    """What a variable is, by its name in the C code."""

    TIME = "TIME_OF_MODEL"
    INPUT = "INPUT"
    FIXED = "FIXED_PARAMETER"
    TUNABLE = "TUNABLE_PARAMETER"
    OUTPUT = "OUTPUT"


class FmuVariable(NamedTuple):
    """A variable; its value reference is its place."""

    name: str
    role: Role
    unit: str
    about: str
    start: float = 0.0
    minimum: float = -UNLIMITED
    maximum: float = UNLIMITED
    place: int = -1  # of an output: its place in what the march gives

    @property
    def of_state(self) -> bool:
        """Whether it does not depend on inputs at the same moment."""
        return self.name.rpartition(".")[2] in _OF_STATE


def variables_of(
    gearbox: GearboxInTime, kinds: tuple[str, str], oil: OilTable | None
) -> tuple[FmuVariable, ...]:
    """All variables in the order of their value references; `kinds` of input and output."""
    found = [FmuVariable("time", Role.TIME, "s", "time")]
    operation, prescribed = gearbox.model.operation, []
    one, two = gearbox.ends
    if kinds[0] == TORQUE:
        about = f"torque on the input {one}, in the direction of its nominal rotation"
        torque = float(operation.drive_torque)
        found.append(FmuVariable("input_torque", Role.INPUT, "N.m", about, torque))
        about = f"speed of the input {one} at the start; everything turns with it, the teeth under load"
        found.append(FmuVariable("start_speed", Role.FIXED, "rad/s", about, gearbox.start_speed))
        prescribed.append("input_torque")
    else:
        about = f"speed of the input {one} at the end of a step, changing linearly from that at its start"
        found.append(FmuVariable("input_speed", Role.INPUT, "rad/s", about, gearbox.start_speed))
        prescribed.append("input_speed")
    if kinds[1] == TORQUE:
        about = f"torque of the load on the output {two}, against its nominal rotation"
        found.append(FmuVariable("output_torque", Role.INPUT, "N.m", about, float(operation.output_torque)))
        prescribed.append("output_torque")
    else:
        found += _held_output(gearbox)
    if oil is not None:
        about = "temperature of the oil that enters the meshes"
        limits = oil.temperatures[0], oil.temperatures[-1]
        found.append(FmuVariable("oil_temperature", Role.INPUT, "K", about, oil.nominal, *limits))
    names = _names_of_meshes(gearbox.meshes)
    for place, output in enumerate(time_outputs(gearbox.model)):
        if output.name not in prescribed or output.mesh is not None:
            found.append(_output(output, place, names))
    return tuple(found)


def _held_output(gearbox: GearboxInTime) -> list[FmuVariable]:
    """The shaft whose speed is prescribed, and by what it holds the output."""
    model, shaft = gearbox.model, output_shaft(gearbox.model)
    ratio = np.asarray(model.bodies.ratio)
    start = gearbox.start_speed * float(ratio[model.layout.output] / ratio[model.layout.input])
    about = f"speed of a shaft that holds the output {gearbox.ends[1]} by a spring, at the end of a step"
    return [
        FmuVariable("output_shaft_speed", Role.INPUT, "rad/s", about, start),
        FmuVariable(
            "output_stiffness",
            Role.TUNABLE,
            "N.m/rad",
            "stiffness between output and that shaft",
            float(f"{shaft.stiffness:.4g}"),
            0.0,
        ),
        FmuVariable(
            "output_damping",
            Role.TUNABLE,
            "N.m.s/rad",
            "damping between output and that shaft",
            float(f"{shaft.damping:.4g}"),
            0.0,
        ),
    ]


def _names_of_meshes(names: Sequence[str]) -> list[str]:
    """Names of meshes as parts of names of variables, each once."""
    plain = [re.sub(r"\W+", "_", name) for name in names]
    once = len(set(plain)) == len(plain)
    return plain if once else [f"{name}_{place}" for place, name in enumerate(plain)]


def _output(output: TimeOutput, place: int, meshes: Sequence[str]) -> FmuVariable:
    name, about = output.name, output.about
    if output.mesh is not None:
        name, about = f"{meshes[output.mesh]}.{name}", f"{about}, of the mesh {meshes[output.mesh]}"
    return FmuVariable(name, Role.OUTPUT, output.unit, about, place=place)
