"""The part `losses` of a study whose cases are gearboxes: what a gearbox loses at any point of operation.

A study that offers it has a module ``losses`` with ``LOSSES``. Who makes maps, drive cycles or tables of
losses asks the registry for it and knows no study by name.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: The terms of a gearbox's losses by the names that gearbox calculations print (FVA-Workbench, manual, "Power
#: loss"), and what they are.
TERMS = {
    "P_VZP": "meshes under load",
    "P_VZ0": "meshes without load: churning, squeezing, windage",
    "P_VLP": "bearings under load",
    "P_VL0": "bearings without load",
    "P_VD": "seals",
    "P_VPB": "plain bearings",
    "P_VST": "planet carriers in the oil",
    "P_VX": "other: oil pump",
}
Term = Literal["P_VZP", "P_VZ0", "P_VLP", "P_VL0", "P_VD", "P_VPB", "P_VST", "P_VX"]
Sort = Literal["mesh", "gear", "bearing", "seal", "carrier", "pump", "other"]


class LossSource(NamedTuple):
    """One loss of one element by one formula."""

    term: Term
    element: str  # as the scenario names it: a mesh, a gear, "high-speed bearing 1"
    sort: Sort  # of the element: where the heat is made
    method: str  # name of the formula, as a scenario names it


class OperatingPoints(NamedTuple):
    """Points of operation."""

    #: all loads, against the motion, as a multiple of the scenario's own; negative: the loads drive, and
    #: power flows back
    load: Float[Array, " point"]
    #: of the input, rad/s. 0 is the limit from above: at a standstill friction acts against the motion to
    #: come. Negative: all turns the other way, and the other flanks carry; the loads are still against it
    speed: Float[Array, " point"]
    oil_temperature: Float[Array, " point"]  # K
    #: of the teeth of each mesh, K; None: by the scenario's [temperature], or that of the oil
    bulk_temperature: Float[Array, "point mesh"] | None = None


class LossesOver(NamedTuple):
    """Losses of every source at every point."""

    sources: tuple[LossSource, ...]
    #: power lost over the magnitude of the input's speed, N m, at least 0; finite at speed 0
    drag: Float[Array, "point source"]
    #: of every source the limits of its formula that some point exceeds
    exceeded: tuple[tuple[str, ...], ...]
    #: of the meshes in slow rotation, (point, mesh): film_min (m), film_parameter_min,
    #: friction_coefficient_mean, bulk_temperature (K), hertz_pressure_max (Pa), contact_in_range (share).
    #: NaN where there is no load or no speed
    meshes: Mapping[str, Float[Array, "point mesh"]]

    def power(self, speed: Any) -> Float[Array, "point source"]:
        """Power lost, W, at the input's speeds, rad/s."""
        return self.drag * np.abs(np.asarray(speed, dtype=float))[:, None]

    def by_term(self) -> dict[str, Float[Array, " point"]]:
        """Drag torques by term, N m; of all terms, those without a source are 0."""
        return {term: self._sum(lambda source, term=term: source.term == term) for term in TERMS}

    def by_element(self) -> dict[str, Float[Array, " point"]]:
        """Drag torques by element, N m."""
        names = dict.fromkeys(source.element for source in self.sources)
        return {name: self._sum(lambda source, name=name: source.element == name) for name in names}

    def total(self) -> Float[Array, " point"]:
        """Sum of all drag torques, N m."""
        return self.drag.sum(axis=1)

    def _sum(self, chosen: Callable[[LossSource], bool]) -> Float[Array, " point"]:
        return self.drag[:, [chosen(source) for source in self.sources]].sum(axis=1)


class NominalPoint(NamedTuple):
    """The scenario's own point of operation, and what reflects one side of the gearbox to the other."""

    output_torque: float  # all loads reflected to the output, against its motion, N m
    input_torque: float  # that balances the loads without losses, N m
    input_speed: float  # rad/s, > 0
    oil_temperature: float  # K
    ratio: float  # speed of the output over that of the input; negative: they turn opposite ways
    inertia: float  # of everything that turns, reflected to the input, kg m²

    @property
    def output_inertia(self) -> float:
        """The same reflected to the output, kg m²."""
        return self.inertia / self.ratio**2


class Statics(NamedTuple):
    """The gearbox in slow rotation without friction at each load."""

    #: of every mesh, force on the pitch circles over the deflection that it makes, N/m; amplitudes of its
    #: harmonics, the first one in front
    stiffness_mean: Float[Array, "point mesh"]
    stiffness_harmonic: Float[Array, "point mesh harmonic"]
    #: of every mesh, error along the pitch circles, m: mean, and amplitudes of its harmonics
    transmission_error_mean: Float[Array, "point mesh"]
    transmission_error_harmonic: Float[Array, "point mesh harmonic"]
    #: of the harmonics, rad: Σ a_k cos(2π k c + φ_k) over the cycles c that a mesh has passed since the one
    #: begins in which the train stands
    transmission_error_phase: Float[Array, "point mesh harmonic"]
    mesh_order: Float[Array, " mesh"]  # cycles of every mesh per turn of the input
    error_at_output: Float[Array, " mesh"]  # rad at the output per m of a mesh's transmission error
    #: at the output with the input held, N m/rad: of meshes, shafts and couplings that twist
    stiffness_total: Float[Array, " point"]
    backlash: float  # angle at the output with the input held, rad; 0: none is given


class GearboxLosses(NamedTuple):
    """What a study offers whose cases are gearboxes."""

    names: Callable[[Any], Sequence[str]]  # case -> its meshes
    at: Callable[[Any, OperatingPoints], LossesOver]  # at all points together; tables are kept between calls
    nominal: Callable[[Any], NominalPoint]
    statics: Callable[[Any, Any], Statics]  # (case, loads as multiples of the scenario's own) -> statics
