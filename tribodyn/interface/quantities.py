"""Figures of a gear pair as functions of its case, whose numbers may be traced: what can be differentiated.

They are quasi-static: of the teeth alone, or of the mesh in slow rotation under the gear's torque.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.path import kinematics
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.friction_loss import engaged, friction_loss, mean_efficiency
from tribodyn.mesh.quasi_static import QuasiStatic, cycle_mean, quasi_static
from tribodyn.mesh.tabulate import tabulate
from tribodyn.numerics.elementary import absolute, cos, minimum, namespace
from tribodyn.tribology.closure import surfaces_of, untried_closure_of
from tribodyn.tribology.contact import hertz_pressure


class Fixed(NamedTuple):
    """What does not change with the numbers.

    Parameters
    ----------
    pairs : int
        Pairs in contact at most.
    vanishing : bool
        Whether radius and rolling speeds are zero at the pitch point.
    """

    pairs: int
    vanishing: bool


class Quantity(NamedTuple):
    """A figure.

    Parameters
    ----------
    about : str
        What it is.
    unit : str
        SI.
    function : callable
        (case, Fixed) -> its value.
    needs : tuple of str
        What the case must have beside its gears: "mesh", "operating", "friction".
    at_pitch_point : bool
        Whether it is a figure of the contact at the pitch point, which must then be a contact.
    """

    about: str
    unit: str
    function: Callable[[Any, Fixed], Any]
    needs: tuple[str, ...] = ()
    at_pitch_point: bool = False


def _gears(case: Any) -> Assembly:
    return assemble(family(case.family), case.drive)


def _cycle(case: Any, fixed: Fixed) -> MeshCycle:
    return tabulate(_gears(case), case.materials, case.mesh, fixed.pairs)


def _loaded(case: Any, fixed: Fixed) -> tuple[MeshCycle, QuasiStatic]:
    cycle = _cycle(case, fixed)
    return cycle, quasi_static(cycle, absolute(case.operating.gear_torque))


def _contact_ratio(case: Any, _: Fixed) -> Any:
    return _gears(case).contact_ratio


def _centre_distance(case: Any, _: Fixed) -> Any:
    path = _gears(case).path
    return path.pinion_pitch_radius + path.gear_pitch_radius


def _pressure_angle(case: Any, _: Fixed) -> Any:
    return _gears(case).path.pressure_angle(0.0)


def _equivalent_radius(case: Any, _: Fixed) -> Any:
    return 1.0 / kinematics(_gears(case).path, 0.0).relative_curvature


def _hertz_pressure(case: Any, fixed: Fixed) -> Any:
    path = _gears(case).path
    load = absolute(case.operating.gear_torque) / path.gear_pitch_radius / cos(path.pressure_angle(0.0))
    width = minimum(case.drive.pinion.face_width, case.drive.gear.face_width)
    curvature = kinematics(path, 0.0).relative_curvature
    return hertz_pressure(load / width, curvature, surfaces_of(case).effective_modulus)


def _mean_stiffness(case: Any, fixed: Fixed) -> Any:
    cycle, state = _loaded(case, fixed)
    return cycle_mean(cycle, state.mesh_stiffness)


def _swing(values: Any) -> Any:
    # by its place: where a program computes values twice, none may equal the maximum to the last digit
    flat = values.ravel()
    return flat[namespace(flat).argmax(flat)] - flat[namespace(flat).argmin(flat)]


def _stiffness_swing(case: Any, fixed: Fixed) -> Any:
    return _swing(_loaded(case, fixed)[1].mesh_stiffness)


def _transmission_error_swing(case: Any, fixed: Fixed) -> Any:
    return _swing(_loaded(case, fixed)[1].deflection)


def _loss_factor(case: Any, fixed: Fixed) -> Any:
    cycle, state = _loaded(case, fixed)
    torque = absolute(case.operating.gear_torque) * cycle.pinion_pitch_radius / cycle.gear_pitch_radius
    return friction_loss(cycle, state.normal_load, 1.0) / torque


def _engaged(case: Any, fixed: Fixed) -> tuple[MeshCycle, Any]:
    gears, operating = _gears(case), case.operating
    # friction turns where a pair passes the pitch point: a segment of the table begins there
    gears = Assembly(gears.family._replace(corner=True), gears.drive)
    cycle = tabulate(gears, case.materials, case.mesh, fixed.pairs)
    closure = untried_closure_of(case)
    found = engaged(cycle, operating.gear_torque, operating.pinion_speed, closure, fixed.vanishing)
    return cycle, found


def _efficiency(case: Any, fixed: Fixed) -> Any:
    cycle, (load, coefficient) = _engaged(case, fixed)
    return mean_efficiency(cycle, case.operating.gear_torque, coefficient, load)


def _friction_power(case: Any, fixed: Fixed) -> Any:
    cycle, (load, coefficient) = _engaged(case, fixed)
    return friction_loss(cycle, load, coefficient) * case.operating.pinion_speed


_LOADED = ("mesh", "operating")
_RUBBING = ("mesh", "operating", "friction")
QUANTITIES: dict[str, Quantity] = {
    "contact_ratio": Quantity("transverse contact ratio", "1", _contact_ratio),
    "centre_distance": Quantity("working centre distance", "m", _centre_distance),
    "pressure_angle": Quantity("working pressure angle at the pitch point", "rad", _pressure_angle),
    "equivalent_radius": Quantity(
        "equivalent radius of curvature at the pitch point", "m", _equivalent_radius, at_pitch_point=True
    ),
    "hertz_pressure": Quantity(
        "maximum Hertz pressure of one pair at the pitch point",
        "Pa",
        _hertz_pressure,
        ("operating",),
        at_pitch_point=True,
    ),
    "mean_stiffness": Quantity("mesh stiffness, mean over a mesh cycle", "N/m", _mean_stiffness, _LOADED),
    "stiffness_swing": Quantity("mesh stiffness, peak to peak", "N/m", _stiffness_swing, _LOADED),
    "transmission_error_swing": Quantity(
        "quasi-static transmission error r_p θ_p − r_g θ_g, peak to peak",
        "m",
        _transmission_error_swing,
        _LOADED,
    ),
    "loss_factor": Quantity(
        "loss factor H_v: loss over power, per friction coefficient", "1", _loss_factor, _LOADED
    ),
    "efficiency": Quantity("quasi-static efficiency, elastic load sharing", "1", _efficiency, _RUBBING),
    "friction_power": Quantity("quasi-static friction loss", "W", _friction_power, _RUBBING),
}
