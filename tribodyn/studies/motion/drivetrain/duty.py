"""Speeds and torques of a train as its scenario gives them: each once, at the input or at the output."""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Annotated, Any, Literal, NamedTuple

from pydantic import BeforeValidator, Field

from tribodyn.errors import InputError, quoted
from tribodyn.gears.motion.settings import MOST_HARMONICS, Operating, TorqueHarmonic, harmonics_of
from tribodyn.input import fields, quantity
from tribodyn.input.quantity import NotNegative, Table, Text, csv_file, written
from tribodyn.input.tables.duty import broken_duty_rules
from tribodyn.studies.motion.case import LoadData
from tribodyn.studies.motion.drivetrain.placed_train import TrainKinematics, ends_of
from tribodyn.train.flow import Torques, nominal_torques


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


def _speed_ratio(value: Any) -> Any:
    """A share of the input's speed, as a number or as a fraction in a text: "-1/3"."""
    try:
        ratio = Fraction(value if isinstance(value, str) else repr(value))
    except (ValueError, ZeroDivisionError, TypeError):
        ratio = Fraction(0)
    if not ratio or isinstance(value, bool):
        rule = "not a share of the input's speed other than 0"
        raise quantity.broken(rule, 'write a number or a fraction like "-1/3", negative against its sense')
    return value


SpeedRatio = Annotated[str | float, BeforeValidator(_speed_ratio)]


class LoadTable(Table):
    """What a gear, a shaft or a body drives beside the output: a torque, or a speed that is kept."""

    at: Text
    torque: fields.Torque | None = None
    speed_ratio: SpeedRatio | None = None
    stiffness: fields.TorsionalStiffness | None = None
    damping_ratio: NotNegative | None = None
    inertia: fields.Inertia = written("0 kg*m**2")
    damping: fields.TorsionalDamping = written("0 N*m*s/rad")
    torque_table: Annotated[fields.TorqueCurve, csv_file("time", "torque")] | None = None
    torque_harmonics: tuple[TorqueHarmonic, ...] = Field((), max_length=MOST_HARMONICS)


class TrainOperating(Operating):
    """Where power enters and leaves, at which speed and load, and how the train is driven."""

    input: Annotated[Text | None, BeforeValidator(_one_place)] = None
    output: Text | None = None
    sense: Literal["clockwise", "counter-clockwise"] = "clockwise"


#: What is said of the output alone.
_OF_OUTPUT = ("output_speed", "output_torque", "output_torque_table", "output_torque_harmonics")
#: Share of the largest torque below which a mesh carries nothing but rounding.
_NOTHING = 1e-12


class TrainDuty(NamedTuple):
    """Nominal speed and load of a train; bodies in its order."""

    speed: float  # of the input and of the reference body, rad/s
    loads: tuple[LoadData, ...]
    inertias: tuple[tuple[int, float], ...]  # (body, kg m²) of what the bodies drive
    torques: Torques


def broken_duty(scenario: Any) -> Iterator[InputError]:
    """Go through what is missing or said twice of ends, speed and load."""
    operating: TrainOperating = scenario.operating
    source, output = ends_of(scenario)
    if not source:
        yield InputError(
            "operating.input", None, "missing", 'name a gear, a shaft or a body: input = "pinion"'
        )
    for number, load in enumerate(scenario.load):
        yield from _broken_load(f"load.{number}", load)
    if output is None:
        if all(load.torque is None for load in scenario.load):
            remedy = 'name a gear, a shaft or a body: output = "wheel"; or add a [[load]]'
            yield InputError("operating.output", None, "missing", remedy)
        for name in (*_OF_OUTPUT, "input_torque", "power") if scenario.load else ():
            if getattr(operating, name) and (name != "input_torque" or operating.source == "speed"):
                rule = "is of the output, and there is none"
                yield InputError(f"operating.{name}", None, rule, 'add output = "wheel", or leave it out')
    yield from broken_duty_rules(operating.load, load_needed=output is not None)


def _broken_load(key: str, load: LoadTable) -> Iterator[InputError]:
    """A load has a torque, or a speed that whatever torque keeps."""
    if load.torque is None and load.speed_ratio is None:
        remedy = 'add torque = "100 N*m", or speed_ratio, of which the torque follows'
        yield InputError(f"{key}.torque", None, "missing", remedy)
    of_torque = ("torque", "damping", "torque_table", "torque_harmonics")
    for name in of_torque if load.speed_ratio is not None else ("stiffness", "damping_ratio"):
        if getattr(load, name):
            rule = "contradicts speed_ratio, of which the torque follows"
            if load.speed_ratio is None:
                rule = "is of what keeps a speed, and there is no speed_ratio"
            yield InputError(f"{key}.{name}", None, rule, "leave the one or the other out")


def duty_of(scenario: Any, train: TrainKinematics) -> TrainDuty:
    """Return speed and load of a scenario that breaks no rule.

    Torques balance without losses.
    """
    operating: TrainOperating = scenario.operating
    motion, parts, new = train.motion, train.parts, train.numbers
    _, output = ends_of(scenario)
    at = None if output is None else new[parts.body(output)]
    loads = [
        _load(load, load.torque, new[parts.body(load.at)])
        for load in scenario.load
        if load.torque is not None
    ]
    inertias = [(new[parts.body(load.at)], load.inertia) for load in scenario.load]
    speed = operating.input_speed
    if speed is None and at is not None and operating.output_speed is not None:
        speed = operating.output_speed / abs(float(motion.ratio[at]))
    assert speed is not None, "refused by the rules"
    if at is not None:
        curve = operating.output_torque_table
        loads.insert(
            0,
            LoadData(
                at,
                _output_torque(operating, speed, at, loads, train),
                operating.load_damping,
                curve.in_si() if curve else None,
                harmonics_of(operating.output_torque_harmonics),
            ),
        )
        inertias.insert(0, (at, operating.load_inertia))
    torques = torques_of(train, _against(train, loads))
    least = _NOTHING * max(map(abs, torques.driven))
    driven = tuple(0.0 if abs(torque) <= least else torque for torque in torques.driven)
    return TrainDuty(speed, tuple(loads), tuple(inertias), torques._replace(driven=driven))


def torques_of(train: TrainKinematics, against: Sequence[float]) -> Torques:
    """Torques, N m, that loads on the bodies (against their motion, in the train's order) call for."""
    gears, motion = train.parts.gears, train.motion
    teeth = [(gears[one].table.teeth, gears[two].table.teeth) for one, two in motion.gears]
    return nominal_torques(motion, teeth, train.couplings, against)


def motor_torque(scenario: Any) -> float | None:
    """Torque of the motor that a scenario gives beside the loads, N m; None: it balances them."""
    _, output = ends_of(scenario)
    return scenario.operating.motor_torque if output else scenario.operating.input_torque


def _output_torque(
    operating: TrainOperating, speed: float, at: int, others: list[LoadData], train: TrainKinematics
) -> float:
    if operating.output_torque is not None:
        return operating.output_torque
    put_in = operating.input_torque if operating.power is None else operating.power / speed
    # of the input's torque, which is linear in that of the output
    others_alone = torques_of(train, _against(train, others)).source
    per_torque = torques_of(train, _against(train, [LoadData(at, 1.0)])).source
    return ((put_in or 0.0) - others_alone) / per_torque


def _against(train: TrainKinematics, loads: Sequence[LoadData]) -> list[float]:
    """Torques of loads against the motion of every body, N m."""
    against = [0.0] * len(train.motion.bodies)
    for load in loads:
        against[load.body] += load.torque
    return against


def _load(load: LoadTable, torque: float, body: int) -> LoadData:
    curve = load.torque_table
    return LoadData(
        body,
        torque,
        load.damping,
        curve.in_si() if curve else None,
        harmonics_of(load.torque_harmonics),
    )
