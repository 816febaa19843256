"""A case of a map: the gearbox, the axes, and what is recorded over them."""

from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from tribodyn.cases.cost import CostKey, Estimate, in_memory, recorded, total
from tribodyn.cases.loss_part import GearboxLosses, NominalPoint
from tribodyn.errors import InputError
from tribodyn.numerics.parameter import Variable
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.schema import Layout
from tribodyn.studies.protocol.load import Loaded
from tribodyn.studies.protocol.study import CaseHead

#: Axes in the order of the points of a case.
TORQUE, SPEED, OIL_TEMPERATURE = NAMES = ("torque", "speed", "oil_temperature")
#: Multiples of the scenario's own torque and speed, where a file gives no axis.
_OF_NOMINAL = np.linspace(0.0, 1.2, 13)
#: Which way power flows.
FORWARD, BACK, BOTH = DIRECTIONS = ("forward", "back", "both")

_OIL = Variable((OIL_TEMPERATURE,), "K", "temperature of the oil around the gears")
_SCALES = {
    TORQUE: Variable(
        (TORQUE,), "N*m", "torque of the loads at the output, above 0 against the motion, below 0 with it"
    ),
    SPEED: Variable((SPEED,), "rad/s", "speed of the input; below 0 it turns the other way"),
    "source": Variable(("source",), "1", "loss: its term, its element"),
    "mesh": Variable(("mesh",), "1", "mesh of two gears"),
    "harmonic": Variable(("harmonic",), "1", "number of the harmonic of the mesh, from 1"),
}
_OVER = (OIL_TEMPERATURE, TORQUE, SPEED)
_point = partial(Variable, _OVER)
_mesh = partial(Variable, ("mesh", *_OVER))
_text = partial(Variable, ("source",), "1", dtype="S96", fill=b"")
_SAMPLES = {
    "power_loss": _point("W", "power lost, all sources"),
    "efficiency": _point(
        "1", "power out over power in, whichever way it flows, at a standstill the limit; NaN where none does"
    ),
}
#: Of the meshes, as `cases.loss_part.LossesOver.meshes` has them.
OF_MESHES = {
    "film_min": _mesh("m", "minimum of the film over mesh cycle and face"),
    "film_parameter_min": _mesh("1", "minimum of the film over the roughness"),
    "friction_coefficient_mean": _mesh("1", "friction coefficient, mean weighted with load times sliding"),
    "bulk_temperature": _mesh("K", "bulk temperature of the teeth"),
    "hertz_pressure_max": _mesh("Pa", "maximum of the Hertz pressure over mesh cycle and face"),
    "film_in_range": _mesh("1", "share of the contact inside the range of the film law"),
    "friction_in_range": _mesh("1", "share of the contact inside the range of the friction law"),
}
_static = partial(Variable, ("mesh", TORQUE))
_harmonics = partial(Variable, ("mesh", TORQUE, "harmonic"))
#: In slow rotation without friction; `cases.loss_part.Statics` has those of the meshes by the same names.
STATICS = {
    "stiffness_mean": _static(
        "N/m", "mean stiffness of the mesh, force over deflection on the pitch circles"
    ),
    "stiffness_harmonic": _harmonics("N/m", "amplitude of a harmonic of the stiffness of the mesh"),
    "transmission_error_mean": _static("m", "mean transmission error along the pitch circles"),
    "transmission_error_harmonic": _harmonics("m", "amplitude of a harmonic of the transmission error"),
    "transmission_error_phase": _harmonics(
        "rad", "phase of the harmonic: a cos(2π k c + φ) over the cycles c of the mesh"
    ),
}
TOTAL_STIFFNESS = "stiffness_total"
_OTHERS = {
    "drag": Variable(("source", *_OVER), "N*m", "power lost over the magnitude of the input's speed"),
    "source_term": _text(long_name="term of the losses that the source belongs to"),
    "source_element": _text(long_name="element that loses, as the scenario names it"),
    "source_method": _text(long_name="formula, as a scenario names it"),
    **OF_MESHES,
    **STATICS,
    "transmission_error_output": _harmonics(
        "rad", "the harmonic's amplitude as an angle at the output with the input held"
    ),
    "mesh_order": Variable(("mesh",), "1", "cycles of the mesh in a turn of the input"),
    TOTAL_STIFFNESS: Variable((TORQUE,), "N*m/rad", "stiffness at the output with the input held"),
    "backlash": Variable((), "rad", "backlash as an angle at the output with the input held"),
    "error_estimate": Variable(
        ("estimate",), "1", "share of the drag by which interpolation misses it at points in between"
    ),
}
ESTIMATES = ("maximum", "mean")
LAYOUT = Layout(
    _OIL, _SAMPLES, {**_SCALES, "estimate": Variable(("estimate",), "1", "which figure of it")}, _OTHERS
)

Axis = Float[Array, " node"]


@dataclass(frozen=True, kw_only=True)
class MapCase(CaseHead):
    """One map, complete."""

    subject: Loaded  # the gearbox
    #: torque, speed, oil temperature as the file gives them, SI, increasing; None: not given
    asked: tuple[tuple[float, ...] | None, ...]
    directions: str  # one of `DIRECTIONS`
    accuracy: float  # share of the drag that interpolation may miss; 0: the axes stay as they are
    most_points: int  # of the grid with further nodes

    @property
    def losses(self) -> GearboxLosses:
        """What the study of the gearbox offers."""
        return self.subject.losses

    @cached_property
    def nominal(self) -> NominalPoint:
        """The gearbox at its own point of operation; an oil without a temperature has the one asked for."""
        nominal, temperatures = self.losses.nominal(self.subject.case), self.asked[2]
        if np.isnan(nominal.oil_temperature) and temperatures is not None:
            return nominal._replace(oil_temperature=temperatures[0])
        return nominal

    @cached_property
    def axes(self) -> tuple[Axis, Axis, Axis]:
        """Torque, speed and oil temperature, before any node is added.

        Raises InputError where torques are asked for of a gearbox without a load.
        """
        of_nominal = (
            _OF_NOMINAL * abs(self.nominal.output_torque),
            _OF_NOMINAL * self.nominal.input_speed,
            np.array([self.nominal.oil_temperature]),
        )
        torque, speed, oil = (
            default if given is None else np.array(given)
            for given, default in zip(self.asked, of_nominal, strict=True)
        )
        if not self.nominal.output_torque and np.any(torque):
            rule = "the loads of a map are in proportion to those of its gearbox, and that has none"
            raise InputError(
                "map.torque", f"{torque[-1]:g} N*m", rule, "give it a load, or leave map.torque out"
            )
        return _directed(torque, self.directions), _with_zero(speed), oil

    @property
    def nodes(self) -> int:
        """How many points the axes have before any is added."""
        return int(np.prod([len(axis) for axis in self.axes]))


def _directed(torque: Axis, directions: str) -> Axis:
    """Torques of the directions of power: below 0 it flows back. Friction turns at 0, which is a node."""
    mirrored = -torque[::-1]
    if directions == BOTH and torque[0] >= 0.0:
        torque = np.concatenate([mirrored, torque])
    elif directions == BACK and torque[-1] > 0.0:
        torque = mirrored
    return _with_zero(torque)


def _with_zero(axis: Axis) -> Axis:
    """The values, and 0 between two of different signs; once each, without a negative 0."""
    within = [0.0] if axis[0] < 0.0 < axis[-1] else []
    return np.unique(np.concatenate([axis, within]) + 0.0)


#: Core seconds of a mesh at a point, bytes of a point while it is worked out; points that refining takes
#: beside the nodes.
MESH_SECONDS, POINT_BYTES, BESIDE = 4e-4, 4e3, 1.25
#: Numbers of sources and harmonics that an estimate counts with.
_SIZES = {"source": 24, "harmonic": 10, "estimate": 2}


def estimate(case: MapCase) -> Estimate:
    """What a run of a case takes."""
    most = max(case.nodes, case.most_points) if case.accuracy else case.nodes
    meshes = len(case.losses.names(case.subject.case))
    sizes = {name: len(axis) for name, axis in zip(NAMES, case.axes, strict=True)} | _SIZES
    sizes["mesh"] = meshes
    return total(
        (
            CostKey("map.most_points", most, 20_000),
            *(CostKey(f"map.{name}", len(axis), 40) for name, axis in zip(NAMES, case.axes, strict=True)),
        ),
        recorded(LAYOUT, sizes, copies=2.0),
        in_memory(BESIDE * most, POINT_BYTES),
        Estimate(seconds=case.nodes * (BESIDE if case.accuracy else 1.0) * meshes * MESH_SECONDS),
    )
