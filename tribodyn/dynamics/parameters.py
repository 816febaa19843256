"""Parameters of the equations of motion: numbers of the train and its operation, and what is switched."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.bearing_forces import LINEAR, BearingForces
from tribodyn.train.clutches import Clutches
from tribodyn.train.layout import TrainLayout
from tribodyn.train.links.chain import BY_TABLE
from tribodyn.train.schedule import Schedule
from tribodyn.train.structure import (
    Bodies,
    GearMesh,
    Links,
)
from tribodyn.tribology.film.numbers import FilmNumbers, film_by_number
from tribodyn.tribology.friction.coulomb import NO_FRICTION, NONE
from tribodyn.tribology.law import (
    ActiveLaw,
    Closure,
    FilmFunctions,
    FrictionFunctions,
    film_range_not_stated,
    range_not_stated,
)

#: The reference's speed is prescribed, or a torque acts on the input body.
DRIVE_SPEED = 0
DRIVE_TORQUE = 1

#: What the derivatives are by: the reference's rotation, or time, in which it may stand and turn back.
BY_ROTATION = 0
BY_TIME = 1

CLASSICAL = 0
ENERGY_CONSISTENT = 1

SLIDING_KINEMATIC = 0
SLIDING_DYNAMIC = 1

HERTZ_IN_TABLE = 0
HERTZ_POWER_LAW = 1


class Options(NamedTuple):
    """What is switched: static for JAX; the native kernel is compiled for the laws and reads the integers."""

    #: film, friction: functions of the laws in use
    film: FilmFunctions
    friction: FrictionFunctions
    layout: TrainLayout
    sliding: int = SLIDING_DYNAMIC
    formulation: int = CLASSICAL
    drive: int = DRIVE_SPEED
    hertz: int = HERTZ_IN_TABLE
    sweeps: int = 1  # over coupled pairs; 1: they are not coupled
    links: Any = BY_TABLE  # functions of the laws of the links, see `train.links.chain`
    bearings: BearingForces = LINEAR  # whose forces are evaluated in time
    reads_film: int = 1  # 0: the friction law does not depend on the film, which is recorded only
    averaged: int = 0  # 1: radius and entrainment vanish at the pitch point and are averaged over the contact
    variable: int = BY_ROTATION


class OutputDrive(NamedTuple):
    """A spring and a damper between the output and a shaft beside it whose rotation is prescribed.

    The shaft turns at the output's nominal speed, and more. What it takes is power on the load.
    """

    stiffness: Any = 0.0  # N m/rad
    damping: Any = 0.0  # N m s/rad
    since: Any = 0.0  # time that the next three are of, s
    angle: Any = 0.0  # rotation of the shaft beyond the nominal one, rad
    slip: Any = 0.0  # its speed above the nominal one, rad/s
    acceleration: Any = 0.0  # rad/s²


class Operation(NamedTuple):
    """How the train is driven and loaded, and widths over which the equations are smoothed; SI."""

    nominal_speed: Any  # of the reference, rad/s
    pitch_angle: Any  # rotation of the reference in one reference cycle, rad
    drive_torque: Any  # of the drive at nominal speed, N m
    speed_regulation: Any  # fall of it per speed of the input above nominal, N m s/rad
    contact_width: Any  # approach over which contact force and damping set in, m
    reversal_width: Any  # distance along the path about the pitch point over which friction reverses, m
    load_times: Float[Array, " knot"]  # this and the next two: knots of a C1 torque on the output over time
    load_torques: Float[Array, " knot"]
    load_slopes: Float[Array, " knot"]
    load_amplitudes: Float[Array, " harmonic"]  # this and the next two: its harmonics, N m, rad/s, rad
    load_frequencies: Float[Array, " harmonic"]
    load_phases: Float[Array, " harmonic"]
    clutches: Clutches = Clutches()
    start_slip: Any = 0.0  # of the reference at the start, above its nominal speed, rad/s
    #: this and the next two: knots of a C1 torque of the drive over the speed of its body, added
    motor_speeds: Float[Array, " knot"] = np.zeros(0)
    motor_torques: Float[Array, " knot"] = np.zeros(0)
    motor_slopes: Float[Array, " knot"] = np.zeros(0)
    acceleration: Any = 0.0  # of the reference where its speed is prescribed, rad/s²
    output_torque: Any = 0.0  # constant, on the output against its motion, added to its load, N m
    output_drive: Any = OutputDrive()


class Model(NamedTuple):
    """All that the right-hand side needs: numbers, and last what is switched."""

    meshes: tuple[GearMesh, ...]
    bodies: Bodies
    links: Links
    schedule: Schedule
    operation: Operation
    options: Options

    @property
    def numbers(self) -> tuple[Any, ...]:
        """All but the options, in order: ``Model(*model.numbers, options=model.options)`` is the model."""
        return tuple(self[:-1])

    @property
    def layout(self) -> TrainLayout:
        """What the train consists of."""
        return self.options.layout

    @property
    def pairs(self) -> int:
        """Pair slots of the mesh that has the most."""
        return max(mesh.table.side.shape[0] for mesh in self.meshes)

    def closure(self, mesh: int) -> Closure:
        """Surfaces of a mesh and laws in use."""
        part = self.meshes[mesh]
        return Closure(
            part.surfaces,
            ActiveLaw(self.options.film, part.film),
            ActiveLaw(self.options.friction, part.friction),
        )


def with_shared_code(model: Model) -> Model:
    """Return the model with functions whose machine code most scenarios share; its motion is the same.

    Kernels ask for no ranges of laws; and where friction does not read the film, all film laws by formula
    are one function.
    """
    film, friction = model.options.film, model.options.friction
    if not model.options.reads_film and all(isinstance(mesh.film, FilmNumbers) for mesh in model.meshes):
        film = film._replace(film=film_by_number())
    film = film._replace(in_range=film_range_not_stated)
    friction = friction._replace(in_range=range_not_stated)
    return model._replace(options=model.options._replace(film=film, friction=friction))


def frictionless(model: Model) -> Model:
    """Return the model without friction."""
    options = model.options._replace(friction=NONE.functions, reads_film=0)
    meshes = tuple(mesh._replace(friction=NO_FRICTION) for mesh in model.meshes)
    return model._replace(meshes=meshes, options=options)
