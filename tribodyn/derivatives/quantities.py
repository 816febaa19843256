"""Quantities of a gear pair as functions of its case, whose numbers may be traced, to be differentiated.

They are quasi-static: of the teeth alone, or of the mesh in slow rotation under the gear's torque, of elastic
load sharing.
"""

from collections.abc import Callable
from functools import cached_property
from typing import Any, NamedTuple

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.drive import Drive
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import curvature_share, line_stretch, normal_slope, pitch_slope
from tribodyn.geometry.limits.limits import distances
from tribodyn.geometry.modification import UNMODIFIED
from tribodyn.geometry.path import kinematics
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.equilibrium import Contacts, Equilibrium, contacts, elastic, equilibrium
from tribodyn.mesh.quasi_static import (
    QuasiStatic,
    by_pairs,
    cycle_mean,
    friction_loss,
    mean_efficiency,
    quasi_static,
)
from tribodyn.mesh.slices.fine import tabulate_fine
from tribodyn.mesh.slices.helical import SliceLayout, between_nodes, mean_nodes
from tribodyn.mesh.tabulate import tabulate
from tribodyn.numerics.elementary import absolute, cos, namespace, smallest, sqrt
from tribodyn.quantities.catalogue import GROUPS
from tribodyn.tribology.closure import surfaces_of, untried_closure_of
from tribodyn.tribology.contact import hertz_pressure
from tribodyn.tribology.surface_state import SurfaceState


class Fixed(NamedTuple):
    """What does not change with the numbers."""

    pairs: int  # pairs in contact at most
    vanishing: bool  # whether radius and rolling speeds are zero at the pitch point
    layout: SliceLayout | None = None  # of helical gears: of the fine slices
    parts: int = 1  # fine slices of each slice


class PairEvaluation:
    """A case with gears, its numbers maybe traced; each step to its quantities is made once, when needed."""

    def __init__(self, case: Any, fixed: Fixed) -> None:
        self.case, self.fixed = case, fixed

    @cached_property
    def gears(self) -> Assembly:
        """The pair put together."""
        return assemble(family(self.case.family), self.case.drive)

    @cached_property
    def limits(self) -> dict[str, Any]:
        """Distances from the limits of existence."""
        return distances(self.gears)

    @cached_property
    def cycle(self) -> MeshCycle:
        """Table of the mesh."""
        return self._table(self.gears)

    @cached_property
    def weight(self) -> Any:
        """Weights of the nodes of the table in means, of helical gears."""
        layout = self.fixed.layout
        return None if layout is None else mean_nodes(self.gears, layout.slices).weight

    @cached_property
    def state(self) -> QuasiStatic:
        """Loads and deflection without friction."""
        torque = self.cycle.gear_sense * absolute(self.case.operating.gear_torque)
        return quasi_static(self.cycle, torque)

    @cached_property
    def rubbing_cycle(self) -> MeshCycle:
        """Table with a segment wherever a pair passes the pitch point: there friction turns."""
        gears = self.gears
        if gears.family.corner or self.fixed.layout is not None:  # slices have one segment
            return self.cycle
        return self._table(Assembly(gears.family._replace(corner=True), gears.drive))

    @cached_property
    def rubbing(self) -> Equilibrium:
        """Loads and friction together."""
        return self._rubbing[0]

    @cached_property
    def surface(self) -> SurfaceState:
        """Film, pressure and temperature of all contacts."""
        return self._rubbing[1].under(self.rubbing.normal_load).surface

    @cached_property
    def _rubbing(self) -> tuple[Equilibrium, Contacts]:
        operating, cycle = self.case.operating, self.rubbing_cycle
        closure = untried_closure_of(self.case)
        torque, speed = operating.gear_torque, operating.pinion_speed
        arms = self.case.friction.lever_arms
        seen = contacts(cycle, torque, speed, closure, self.fixed.vanishing, arms)
        return equilibrium(seen, elastic(cycle, operating.gear_torque)), seen

    def _table(self, gears: Assembly) -> MeshCycle:
        case, layout = self.case, self.fixed.layout
        if layout is None:
            return tabulate(gears, case.materials, case.mesh, self.fixed.pairs)
        phase = mean_nodes(gears, layout.slices).phase
        torque = case.operating.gear_torque
        return tabulate_fine(gears, case.materials, case.mesh, layout, self.fixed.parts, torque, phase)


class Differentiated(NamedTuple):
    """A quantity."""

    about: str  # what it is
    unit: str  # SI
    function: Callable[[PairEvaluation], Any]  # evaluation -> its value
    needs: tuple[str, ...] = ()  # what the case must have beside its gears: "mesh", "operating", "friction"
    #: whether it is a quantity of the contact at the pitch point, which must then be a contact
    at_pitch_point: bool = False
    limit: bool = False  # whether it is a distance from a limit of existence, positive where gears exist


def _equivalent_radius(at: PairEvaluation) -> Any:
    """Across the line of contact."""
    path = at.gears.path
    return 1.0 / kinematics(path, 0.0).relative_curvature / curvature_share(pitch_slope(at.gears), path, 0.0)


def _hertz_pressure(at: PairEvaluation) -> Any:
    """Of a line of contact over the whole face."""
    path, case, slope = at.gears.path, at.case, pitch_slope(at.gears)
    angle = path.pressure_angle(0.0)
    across = absolute(case.operating.gear_torque / path.gear_pitch_radius) / cos(angle)
    load = across * sqrt(1.0 + normal_slope(slope, angle) ** 2)
    length = at.gears.common_width * line_stretch(slope, path, 0.0)
    return hertz_pressure(load / length, 1.0 / _equivalent_radius(at), surfaces_of(case).effective_modulus)


def _swing(at: PairEvaluation, values: Any) -> Any:
    layout = at.fixed.layout
    values = values if layout is None else between_nodes(values[0], layout.slices)
    return -smallest(-values) - smallest(values)


def _loss_factor(at: PairEvaluation) -> Any:
    cycle = at.cycle
    torque = absolute(at.case.operating.gear_torque) * cycle.speed_ratio
    return friction_loss(cycle, at.state.normal_load, 1.0, at.weight) / torque


def _efficiency(at: PairEvaluation) -> Any:
    torque, films = at.case.operating.gear_torque, at.rubbing
    return mean_efficiency(at.rubbing_cycle, torque, films.friction_coefficient, films.normal_load, at.weight)


def _friction_power(at: PairEvaluation) -> Any:
    films = at.rubbing
    loss = friction_loss(at.rubbing_cycle, films.normal_load, films.friction_coefficient, at.weight)
    return loss * absolute(at.case.operating.pinion_speed)


def _largest(name: str, sign: float = 1.0) -> Callable[[PairEvaluation], Any]:
    """Maximum, or for sign −1 minimum, of a part of the surface state over the loaded contacts."""

    def function(at: PairEvaluation) -> Any:
        load = at.rubbing.normal_load
        xp = namespace(load)
        return -sign * smallest(xp.where(load > 0, -sign * getattr(at.surface, name), 1e300))

    return function


_film_min = _largest("central_film_thickness", -1.0)
_LOADED = ("mesh", "operating")
_RUBBING = ("mesh", "operating", "friction")
#: Names that they have in the summary of a run, where it holds the same of quasi-static contact.
ALSO = {
    "mesh_stiffness_mean": "mean_stiffness",
    "mesh_stiffness_peak_to_peak": "stiffness_swing",
    "loaded_transmission_error_peak_to_peak": "transmission_error_swing",
    "transmission_error_rotational_peak_to_peak": "transmission_error_swing",
    "power_friction_mean": "friction_power",
    "efficiency_elastic": "efficiency",
}
QUANTITIES: dict[str, Differentiated] = {
    "contact_ratio": Differentiated("transverse contact ratio", "1", lambda at: at.gears.contact_ratio),
    "centre_distance": Differentiated(
        "working centre distance",
        "m",
        lambda at: absolute(at.gears.path.pinion_pitch_radius + at.gears.path.gear_pitch_radius),
    ),
    "pressure_angle": Differentiated(
        "working pressure angle at the pitch point", "rad", lambda at: at.gears.path.pressure_angle(0.0)
    ),
    "equivalent_radius": Differentiated(
        "equivalent radius of curvature at the pitch point",
        "m",
        _equivalent_radius,
        at_pitch_point=True,
    ),
    "hertz_pressure": Differentiated(
        "maximum Hertz pressure of one pair at the pitch point",
        "Pa",
        _hertz_pressure,
        ("operating",),
        at_pitch_point=True,
    ),
    "mean_stiffness": Differentiated(
        "mesh stiffness, mean over a mesh cycle",
        "N/m",
        lambda at: cycle_mean(at.cycle, at.state.mesh_stiffness, at.weight),
        _LOADED,
    ),
    "stiffness_swing": Differentiated(
        "mesh stiffness, peak to peak", "N/m", lambda at: _swing(at, at.state.mesh_stiffness), _LOADED
    ),
    "transmission_error_swing": Differentiated(
        "quasi-static transmission error r_p θ_p − r_g θ_g, peak to peak",
        "m",
        lambda at: _swing(at, at.state.deflection),
        _LOADED,
    ),
    "loss_factor": Differentiated(
        "loss factor H_v: loss over power, per friction coefficient", "1", _loss_factor, _LOADED
    ),
    "efficiency": Differentiated("quasi-static efficiency, elastic load sharing", "1", _efficiency, _RUBBING),
    "friction_power": Differentiated("quasi-static friction loss", "W", _friction_power, _RUBBING),
    "normal_load_max": Differentiated(
        "maximum normal load of a pair",
        "N",
        lambda at: -smallest(-by_pairs(at.rubbing.normal_load, at.rubbing_cycle.slices)),
        _RUBBING,
    ),
    "hertz_pressure_max": Differentiated(
        "maximum Hertz pressure over a mesh cycle", "Pa", _largest("hertz_pressure"), _RUBBING
    ),
    "film_min": Differentiated("minimum film thickness over a mesh cycle", "m", _film_min, _RUBBING),
    "film_parameter_min": Differentiated(
        "minimum film parameter λ", "1", lambda at: _film_min(at) / at.case.roughness, _RUBBING
    ),
    "flash_temperature_max": Differentiated(
        "maximum flash temperature rise", "K", _largest("flash_temperature_rise"), _RUBBING
    ),
} | {
    limit.name: Differentiated(
        limit.definition.rstrip("."), limit.si, lambda at, name=limit.name: at.limits[name], limit=True
    )
    for limit in GROUPS["limits"]
}


def quantity_of(case: Any, name: str) -> Differentiated:
    """The quantity of that name; raises InputError where there is none, or the case lacks what it depends on.

    Whether the gears can be made is not looked at.
    """
    name = ALSO.get(name, name)
    if name not in QUANTITIES:
        raise unknown_name("of", name, QUANTITIES, "quantity that can be differentiated")
    quantity = QUANTITIES[name]
    if not isinstance(getattr(case, "drive", None), Drive):
        raise InputError(
            "kind", quoted(case.kind), "has no gear pair to differentiate", "use another scenario"
        )
    for table in quantity.needs:
        if not hasattr(case, table):
            rule = f"{name} depends on [{table}], which a scenario of this kind does not have"
            raise InputError("kind", quoted(case.kind), rule, "use a scenario that has it")
    if "mesh" in quantity.needs and case.mesh.at_load:
        rule = f"{name} cannot be differentiated with compliances by finite elements"
        remedy = 'use the energy method: overrides={"mesh.compliance": "energy"}'
        raise InputError("mesh.compliance", quoted(case.mesh.compliance), rule, remedy)
    rims = [body.pins for body in (case.drive.pinion, case.drive.gear)]
    if "mesh" in quantity.needs and case.mesh.compliance == "energy" and any(rims):
        rule = f"{name} cannot be differentiated with a rim on pins"
        raise InputError("drive.gear.rim", '"pins"', rule, 'use rim = "fixed" or "free"')
    if "mesh" in quantity.needs and case.drive.helix_angle and case.mesh.modifications != UNMODIFIED:
        rule = f"{name} of helical gears with modified or misaligned flanks cannot be differentiated"
        raise InputError("drive.helix_angle", None, rule, "use td.sweep, or leave the modifications out")
    if "operating" in quantity.needs and not case.operating.gear_torque:
        raise InputError("operating.gear_torque", 0, f"{name} is one of loaded teeth", "give a torque")
    temperature = getattr(case, "temperature", None)
    if "friction" in quantity.needs and temperature is not None:
        rule = f"{name} is differentiated at a temperature that does not move"
        remedy = 'overrides={"temperature.model": "oil"}, and operating.oil_temperature that of the teeth'
        raise InputError("temperature.model", quoted(temperature.model), rule, remedy)
    return quantity
