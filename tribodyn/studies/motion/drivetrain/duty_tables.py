"""Speed and load of a train: ``[operating]``, ``[[duty]]`` and ``[[load]]``."""

from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field

from tribodyn.errors import quoted
from tribodyn.gears.motion.settings import MOST_HARMONICS, TorqueHarmonic
from tribodyn.input import fields, quantity
from tribodyn.input.quantity import Positive, Table, Text, Weighed, csv_file, written
from tribodyn.input.tables.duty import MOST_DUTIES, Power, Speed


def _one_place(value: Any) -> Any:
    """Refuse several inputs, or what is no name."""
    if isinstance(value, (list, tuple)) and len(value) != 1:
        raise quantity.broken(
            "a train has one input", "name one gear, shaft or body; others may be a [[load]]"
        )
    if value is not None and not isinstance(value, str):
        raise quantity.broken(
            "not the name of a gear, a shaft or a body", f"write it like {quoted('pinion')}"
        )
    return value


class LoadTable(Table):
    """What a gear, a shaft or a body drives beside the output."""

    at: Text = Field(description="gear, shaft or body")
    torque: fields.Torque = Field(description="against its motion; negative where it drives")
    inertia: fields.Inertia = written("0 kg*m**2")
    damping: fields.TorsionalDamping = written(
        "0 N*m*s/rad", description="torque that grows with speed above nominal"
    )
    torque_table: Annotated[fields.TorqueCurve, csv_file("time", "torque")] | None = Field(
        None, description="over time, added"
    )
    torque_harmonics: tuple[TorqueHarmonic, ...] = Field((), max_length=MOST_HARMONICS, description="added")


class TrainDutyTable(Table):
    """Speed and load of a train, each given once: at the input or at the output, the load also as power."""

    input_speed: Speed | None = Field(None, description="of the input")
    output_speed: Speed | None = Field(None, description="of the output, in place of the input's")
    output_torque: fields.Torque | None = Field(
        None, description="against the output's motion; negative where it drives"
    )
    input_torque: fields.Torque | None = Field(None, description="on the input, in place of the output's")
    power: Power | None = Field(None, description="put in, in place of a torque")


class TrainSpectrumDuty(TrainDutyTable):
    """One duty of a load spectrum; what it does not give is that of [operating]."""

    share: Positive = Field(description="of the time; shares count by their sum")
    oil_temperature: fields.Temperature | None = Field(None, description="in place of that of [operating]")

    #: what gives its speed, and its load
    speeds: ClassVar[tuple[str, ...]] = ("input_speed", "output_speed")
    loads: ClassVar[tuple[str, ...]] = ("output_torque", "input_torque", "power")


class TrainOperating(TrainDutyTable):
    """Where power enters and leaves, at which speed and load, and how the train is driven."""

    input: Annotated[Text | None, BeforeValidator(_one_place)] = Field(
        None, description='gear, shaft or body at which power enters; with [drive]: default "pinion"'
    )
    output: Text | None = Field(
        None, description='at which it leaves; several: [[load]]; with [drive]: default "gear"'
    )
    sense: Literal["clockwise", "counter-clockwise"] = Field(
        "clockwise", description="of the input's rotation, seen from +z"
    )
    duty: Annotated[int, Field(strict=True, ge=1, le=MOST_DUTIES), Weighed("duty", "share")] | None = Field(
        None, description="number of the duty of a load spectrum that is run, from 1"
    )
    oil_temperature: fields.Temperature | None = Field(
        None, description="where the oil enters the meshes; for a lubricant given by its data sheet"
    )
    source: Literal["speed", "torque"] = Field(
        "speed", description="speed: the input's rotation is prescribed; torque: a motor with inertia"
    )
    output_torque_table: Annotated[fields.TorqueCurve, csv_file("time", "torque")] | None = Field(
        None, description="over time, added to the output's torque"
    )
    output_torque_harmonics: tuple[TorqueHarmonic, ...] = Field(
        (), max_length=MOST_HARMONICS, description="added to the output's torque"
    )
    load_inertia: fields.Inertia = written("0 kg*m**2", description="of what the output drives")
    load_damping: fields.TorsionalDamping = written(
        "0 N*m*s/rad", description="output torque that grows with speed above nominal"
    )
    drive_inertia: fields.Inertia = written("0 kg*m**2", description="of the motor")
    shaft_stiffness: fields.TorsionalStiffness | None = Field(
        None, description="between motor and input; default: rigid"
    )
    shaft_damping: fields.TorsionalDamping = written("0 N*m*s/rad")
    speed_regulation: fields.TorsionalDamping = written(
        "0 N*m*s/rad", description="the motor's torque falls by this with speed above nominal"
    )

    @property
    def motor_torque(self) -> float | None:
        """Torque of the motor, given beside the load; None: it balances the load without losses."""
        beside = self.output_torque is not None or self.power is not None
        return self.input_torque if beside else None
