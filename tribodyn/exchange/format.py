"""What a format of another program is: what it takes and gives, its files, and how it is written and read."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from tribodyn.drawing.shapes import PlacedPart
from tribodyn.dynamics.parameters import Model
from tribodyn.errors import InputError
from tribodyn.exchange.measured_gear import MeasuredGear
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.loss_map import LossMap

#: What can be exported.
MAP, RECORD, SCENARIO = "the record of a map", "the record of a run", "a scenario"

#: What is prescribed at an end of a gearbox that is moved on in time.
TORQUE, SPEED = "torque", "speed"


class GearboxInTime(NamedTuple):
    """A gearbox as a model to be moved on in time; what is prescribed at its ends stands in the operation."""

    model: Model
    starts: Mapping[float, Float[Array, " state"]]  # speed of the input, rad/s -> state at the start
    start_speed: float  # of the input in the scenario, rad/s
    output_torque: float  # of the load on the output at the start, N m
    rtol: float
    max_steps: int  # in a reference cycle of nominal speed
    duration: float  # of the scenario's run, s
    meshes: tuple[str, ...]  # names
    ends: tuple[str, str]  # names of the bodies at input and output
    oil_temperature: float | None  # of the oil that enters the meshes, K; None: not known
    #: temperature of that oil, K -> the model with surfaces and laws there; None: `remarks` say why not
    at_temperature: Callable[[float], Model] | None = None
    remarks: tuple[str, ...] = ()  # what of the scenario is left out


class Exported(NamedTuple):
    """What is exported: as much of it as there is."""

    path: Path
    scenario: Mapping[str, Any]  # resolved: what it refers to is put in
    summary: Mapping[str, Any] | None = None  # of a run, SI
    map: LossMap | None = None
    #: distance of chords from exact surfaces at most, m -> gears and shafts in their places
    parts: Callable[[float], list[PlacedPart]] | None = None
    #: name of a gear and its datum face ("": the first with deviations, the start) -> as it would be measured
    measured: Callable[[str, str], MeasuredGear] | None = None
    #: what is prescribed at input and output, `TORQUE` or `SPEED` -> model
    in_time: Callable[[str, str], GearboxInTime] | None = None

    @property
    def sort(self) -> str:
        """`MAP`, `RECORD` or `SCENARIO`."""
        return MAP if self.map is not None else SCENARIO if self.summary is None else RECORD

    @property
    def losses(self) -> LossMap:
        """The map; InputError where it is none."""
        if self.map is None:
            raise self.refused("holds no map of losses", "name the record of a map")
        return self.map

    def refused(self, rule: str, remedy: str = "") -> InputError:
        """What to say where a format cannot hold it."""
        return InputError("export", str(self.path), rule, remedy)


class Deviation(NamedTuple):
    """How far what was written is from what it was made of, found by reading and evaluating it."""

    of: str  # "drag at the input"
    units: str
    maximum: float
    mean: float
    largest: float  # magnitude of what it is compared with
    over: str = "all points of the map"

    def __str__(self) -> str:
        """In one line."""

        def part(value: float) -> str:
            return f"{value:.3g} {self.units} ({100 * value / self.largest if self.largest else 0:.2g} %)"

        return (
            f"{self.of}: maximum error {part(self.maximum)}, mean {part(self.mean)} "
            f"of at most {self.largest:.3g} {self.units}, over {self.over}"
        )


def deviation(
    of: str,
    units: str,
    written: Any,
    exact: Any,
    over: str = "all points of the map",
    weights: np.ndarray | None = None,
) -> Deviation:
    """How far written values are from exact ones; `weights` are those of the mean."""
    error = np.abs(np.asarray(written) - np.asarray(exact))
    mean = float(np.average(error, weights=weights))
    return Deviation(of, units, float(error.max()), mean, float(np.abs(exact).max()), over)


class Written(NamedTuple):
    """What an export wrote."""

    files: Mapping[str, str | bytes]  # what stands behind the name of the output -> contents; the first leads
    deviations: tuple[Deviation, ...] = ()
    remarks: tuple[str, ...] = ()  # what was chosen, and what could not be taken along


class Imported(NamedTuple):
    """A scenario that was made of a file of another program."""

    toml: str
    remarks: tuple[str, ...] = ()  # what was not used, and what is missing, by component
    details: Mapping[str, Any] = MappingProxyType({})  # the same for programs

    @property
    def scenario(self) -> dict[str, Any]:
        """Its tables."""
        return tomllib.loads(self.toml)


#: Kind of a choice that is no number.
TEXT = "text"


class FormatChoice(NamedTuple):
    """What a format lets its user choose."""

    kind: str  # kind of quantity: "temperature", "angular speed", "torque", "length", "number"; or `TEXT`
    about: str


@dataclass(frozen=True)
class ExchangeFormat:
    """A format of another program; a package offers one by an entry point of the group `tribodyn.formats`.

    `write(exported, name, choices)` gets what is exported, the name of the output without its ending, and
    what was chosen, in SI units; it returns the contents of the files. `read(path)` makes a scenario of a
    file, `measure(path)` a measured gear, and both raise InputError where they cannot.
    """

    name: str
    about: str  # one line
    endings: tuple[str, ...]  # of its files, the one it is written with first: (".csv",)
    takes: tuple[str, ...] = ()  # of `MAP`, `RECORD`, `SCENARIO`, what it can write
    write: Callable[[Exported, str, Mapping[str, Any]], Written] | None = None
    read: Callable[[Path], Imported] | None = None
    measure: Callable[[Path], MeasuredGear] | None = None
    choices: Mapping[str, FormatChoice] = field(default_factory=lambda: MappingProxyType({}))
