"""Speed and load of a train: ``[operating]`` and ``[[load]]``."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from tribodyn.errors import quoted
from tribodyn.gears.motion.settings import MOST_HARMONICS, Operating, TorqueHarmonic
from tribodyn.input import fields, quantity
from tribodyn.input.quantity import Table, Text, csv_file, written


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

    at: Text
    torque: fields.Torque
    inertia: fields.Inertia = written("0 kg*m**2")
    damping: fields.TorsionalDamping = written("0 N*m*s/rad")
    torque_table: Annotated[fields.TorqueCurve, csv_file("time", "torque")] | None = None
    torque_harmonics: tuple[TorqueHarmonic, ...] = Field((), max_length=MOST_HARMONICS)


class TrainOperating(Operating):
    """Where power enters and leaves, at which speed and load, and how the train is driven."""

    input: Annotated[Text | None, BeforeValidator(_one_place)] = None
    output: Text | None = None
    sense: Literal["clockwise", "counter-clockwise"] = "clockwise"
