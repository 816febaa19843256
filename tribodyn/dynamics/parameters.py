"""State layout and parameters of the six-degree-of-freedom model.

The independent variable is the phase of the mesh in mesh cycles, i.e. the pinion's actual rotation over its
pitch angle, so that engagement falls on exactly known values whatever the speed does. The state holds
coordinates that stay small: the pinion's rotation is replaced by the time lag it takes, the gear's by the
rotational transmission error. Six more states integrate the works of the energy audit.
"""

from typing import Any, NamedTuple

from tribodyn.tribology.contact import Surfaces
from tribodyn.tribology.friction.none import LAW as NO_FRICTION
from tribodyn.tribology.friction.none import NoParameters
from tribodyn.tribology.law import ActiveLaw, Closure, FilmFunctions, FrictionFunctions

#: Translations of pinion and gear, m: x along the pitch tangent in the direction of motion at the pitch
#: point, y along the line of centres from pinion to gear.
X_P, Y_P, X_G, Y_G = 0, 1, 2, 3
#: Time less nominal time at this phase, s.
LAG = 4
#: Rotational transmission error r_p θ_p − r_g θ_g, m.
XI = 5
#: Twist of the drive shaft, motor less pinion, rad.
TWIST = 6
#: Translational velocities, m/s.
VX_P, VY_P, VX_G, VY_G = 7, 8, 9, 10
#: Pinion speed less nominal speed, rad/s.
SLIP = 11
#: Rate of the rotational transmission error, m/s.
XI_RATE = 12
#: Motor speed less nominal speed, rad/s.
MOTOR_SLIP = 13
#: Works since the start, J: by the drive, on the load, lost to tooth friction, lost to damping, and done by
#: the change of stiffness and geometry with phase; and what friction would take of bodies that only rotate.
WORK_IN, WORK_OUT, WORK_FRICTION, WORK_DAMPING, WORK_PARAMETRIC, WORK_SLIDING = 14, 15, 16, 17, 18, 19
STATES = 20
#: Coordinates of the free bodies, m, and their rates, in the same order.
DISPLACEMENTS = (X_P, Y_P, X_G, Y_G, XI)
VELOCITIES = (VX_P, VY_P, VX_G, VY_G, XI_RATE)
WORKS = (WORK_IN, WORK_OUT, WORK_FRICTION, WORK_DAMPING, WORK_PARAMETRIC, WORK_SLIDING)
#: States that the mechanics depend on; the rest are the audit's.
MECHANICAL = 14

DRIVE_SPEED = 0
DRIVE_TORQUE = 1
DRIVE_SHAFT = 2

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
    sliding: int = SLIDING_DYNAMIC
    formulation: int = CLASSICAL
    drive: int = DRIVE_SPEED
    hertz: int = HERTZ_IN_TABLE
    sweeps: int = 1  # over coupled pairs; 1: they are not coupled
    averaged: int = 0  # 1: radius and entrainment vanish at the pitch point and are averaged over the contact


class Mechanics(NamedTuple):
    """Numbers of the mechanical model, SI; a pytree, so that no number is compiled in."""

    pinion_mass: Any  # kg
    gear_mass: Any
    pinion_inertia: Any  # kg m², with whatever turns rigidly with the body
    gear_inertia: Any
    pinion_stiffness_x: Any  # of shaft and bearing, N/m
    pinion_stiffness_y: Any
    gear_stiffness_x: Any
    gear_stiffness_y: Any
    pinion_damping_x: Any  # of shaft and bearing, N s/m
    pinion_damping_y: Any
    gear_damping_x: Any
    gear_damping_y: Any
    mesh_damping: Any  # 2 ζ √J_e', so that c_i = mesh_damping √k_i; √kg
    contact_width: Any  # approach over which contact force and damping set in, m
    reversal_width: Any  # distance along the path about the pitch point over which friction reverses, m
    nominal_speed: Any  # of the pinion, rad/s
    drive_torque: Any  # of the motor at nominal speed, N m
    speed_regulation: Any  # fall of the motor torque per speed above nominal, N m s/rad
    drive_inertia: Any  # motor side of the shaft, kg m² (with `DRIVE_SHAFT`; else part of pinion_inertia)
    shaft_stiffness: Any  # N m/rad
    shaft_damping: Any  # N m s/rad
    load_torque: Any  # constant part of the torque on the gear, N m
    load_damping: Any  # rise of the load torque per gear speed above nominal, N m s/rad
    load_times: Any  # (T,), this and the next two: knots of a C1 torque over time, added to load_torque
    load_torques: Any
    load_slopes: Any
    load_amplitudes: Any  # (H,), this and the next two: harmonics of the load torque, N m, rad/s, rad
    load_frequencies: Any
    load_phases: Any


class Model(NamedTuple):
    """All that the right-hand side needs: numbers, and last what is switched."""

    table: Any
    mechanics: Mechanics
    surfaces: Surfaces
    #: film, friction: NamedTuple Parameters that the laws in use read; of the types that these define.
    film: Any
    friction: Any
    options: Options

    @property
    def numbers(self) -> tuple[Any, ...]:
        """All but the options, in order: ``Model(*model.numbers, options=model.options)`` is the model."""
        return tuple(self[:-1])

    @property
    def closure(self) -> Closure:
        """Surfaces and laws in use."""
        return Closure(
            self.surfaces,
            ActiveLaw(self.options.film, self.film),
            ActiveLaw(self.options.friction, self.friction),
        )


def frictionless(model: Model) -> Model:
    """Return the model without friction."""
    options = model.options._replace(friction=NO_FRICTION.functions)
    return model._replace(friction=NoParameters(), options=options)
