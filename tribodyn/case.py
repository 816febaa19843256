"""A case: everything one simulation needs to know, in SI units, with every reference resolved.

The scenario layer makes a `Case` from TOML and `tribodyn.simulate` consumes it. Plain frozen dataclasses, so
that the physics never meets pydantic or pint. Pairs are ordered (pinion, gear) throughout.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from tribodyn.geometry.modification import UNMODIFIED, Modifications

if TYPE_CHECKING:
    from tribodyn.geometry.drive import Drive

Table = tuple[NDArray[np.float64], NDArray[np.float64]]
"""A function given by points: (abscissae, strictly increasing; ordinates), both in SI units."""


@dataclass(frozen=True)
class MaterialData:
    """What a gear is made of.

    Parameters
    ----------
    name : str
        Name of the material's file, or its title.
    youngs_modulus : float
        E, Pa.
    poisson_ratio : float
        ν, 0 ≤ ν < 0.5.
    density : float
        ρ of the solid, kg/m³.
    thermal_conductivity : float
        K, W/(m K).
    specific_heat : float
        c_p, J/(kg K).
    hardness : float
        Vickers hardness as a pressure, Pa.
    """

    name: str
    youngs_modulus: float
    poisson_ratio: float
    density: float
    thermal_conductivity: float
    specific_heat: float
    hardness: float


@dataclass(frozen=True)
class BodyMass:
    """Mass (kg) and polar moment of inertia (kg m²) of a gear; None: computed from outline, bore, width."""

    mass: float | None = None
    inertia: float | None = None


@dataclass(frozen=True)
class LubricantData:
    """What the mixed-EHL friction law needs to know of the lubricant and of its asperities.

    Parameters
    ----------
    asperity_friction : float
        f_c, friction coefficient of the asperities.
    limiting_shear_coefficient : float
        Λ_lim, limiting shear stress over pressure.
    inlet_viscosity : float
        η0, dynamic viscosity at inlet temperature and ambient pressure, Pa s.
    pressure_viscosity : float
        α_PV, 1/Pa.
    viscosity_pressure_index : float
        z of Roelands' law.
    temperature_viscosity : float
        K_T, 1/K.
    density : float
        kg/m³; used by ISO/TR 14179-1 and by Veciana's variant of the Péclet number.
    load_exponent : float
        d of Niemann's lubricant factor X_L = w^−d; 0.0651 of mineral oil 75W90 (Diez-Ibarbia et al.).
    """

    asperity_friction: float
    limiting_shear_coefficient: float
    inlet_viscosity: float
    pressure_viscosity: float
    viscosity_pressure_index: float
    temperature_viscosity: float
    density: float
    load_exponent: float = 0.0651


@dataclass(frozen=True)
class BearingData:
    """Shaft and bearing of one gear: stiffness (N/m) and damping ratio of each axis (x: pitch tangent)."""

    stiffness_x: float
    stiffness_y: float
    damping_ratio_x: float
    damping_ratio_y: float


@dataclass(frozen=True)
class OperatingData:
    """How the drive is driven and loaded.

    Parameters
    ----------
    source : {"speed", "torque"}
        Prescribed pinion speed, or a torque source with inertia.
    pinion_speed : float
        Nominal speed ω_p, rad/s; with a torque source also the speed at the start.
    gear_torque : float
        T_g, the constant part of the load, N m.
    pinion_torque : float or None
        Torque of the source at nominal speed, N m; None: balances `gear_torque` without losses.
    drive_inertia : float
        Inertia of the source, kg m².
    shaft_stiffness : float or None
        Torsional stiffness of the shaft between source and pinion, N m/rad; None: rigid.
    shaft_damping : float
        Its damping, N m s/rad.
    speed_regulation : float
        The source's torque falls by this per rad/s above `pinion_speed`, N m s/rad.
    torque_table : Table or None
        Torque over time (s, N m) added to `gear_torque`; held constant before its first and after its last
        point.
    torque_harmonics : tuple of (float, float, float)
        (amplitude N m, angular frequency rad/s, phase rad) of cosines added to the load.
    load_inertia : float
        Inertia of the load, kg m², on the gear's shaft.
    load_damping : float
        Load torque that grows with speed above nominal gear speed, N m s/rad.
    """

    source: Literal["speed", "torque"]
    pinion_speed: float
    gear_torque: float
    pinion_torque: float | None = None
    drive_inertia: float = 0.0
    shaft_stiffness: float | None = None
    shaft_damping: float = 0.0
    speed_regulation: float = 0.0
    torque_table: Table | None = None
    torque_harmonics: tuple[tuple[float, float, float], ...] = ()
    load_inertia: float = 0.0
    load_damping: float = 0.0


@dataclass(frozen=True)
class MeshData:
    """How the teeth in contact give way, damp, separate and err.

    Parameters
    ----------
    compliance : {"energy", "fem", "constant", "table"}
        Where the single-pair stiffness comes from.
    hertz : {"linear", "load-dependent"}
        Contact part of the energy method's compliance.
    foundation_coupling : bool
        Whether two pairs on one body share its foundation.
    stiffness : float or None
        Single-pair stiffness, N/m, with ``compliance = "constant"``.
    table : Table or None
        Single-pair stiffness over the pinion's roll angle from the pitch point (rad, N/m), with
        ``compliance = "table"``.
    damping_ratio : float
        ζ of the mesh.
    formulation : {"classical", "energy-consistent"}
        Whether the torque −∂V/∂φ of the varying stiffness acts on the bodies.
    contact_width : float
        Width in deflection over which contact sets in smoothly, m.
    backlash : float or None
        Normal backlash, m; None: back flanks never touch.
    points : int
        Nodes of the table per segment of the mesh cycle.
    error_harmonics : tuple of (int, float, float)
        (order of the mesh frequency, amplitude m, phase rad) of cosines in the static transmission error.
    error_table : Table or None
        Static transmission error of a pair over roll angle (rad, m).
    modifications : Modifications
        What is missing on the flanks, and misalignment; with ``compliance = "fem"``.
    slices : int
        Slices along the face, with ``compliance = "fem"``.
    slice_coupling : bool
        Whether slices of one tooth hold each other.
    """

    compliance: Literal["energy", "fem", "constant", "table"]
    damping_ratio: float
    hertz: Literal["linear", "load-dependent"] = "linear"
    foundation_coupling: bool = True
    stiffness: float | None = None
    table: Table | None = None
    formulation: Literal["classical", "energy-consistent"] = "classical"
    contact_width: float = 1e-7
    backlash: float | None = None
    points: int = 65
    error_harmonics: tuple[tuple[int, float, float], ...] = ()
    error_table: Table | None = None
    modifications: Modifications = UNMODIFIED
    slices: int = 1
    slice_coupling: bool = True


@dataclass(frozen=True)
class FrictionData:
    """Which friction law acts between the flanks.

    Parameters
    ----------
    law : str
        Its name in scenario files; `tribodyn.scenario.load.friction_law` maps it to the law's code.
    coefficient : float or None
        μ of Coulomb's law.
    sliding : {"kinematic", "dynamic"}
        Sliding speed from the nominal rotation, or from the vibrating bodies.
    reversal_width : float
        Distance along the path of contact over which friction changes sign at the pitch point, m.
    """

    law: str
    coefficient: float | None = None
    sliding: Literal["kinematic", "dynamic"] = "kinematic"
    reversal_width: float = 2e-5


@dataclass(frozen=True)
class SolverData:
    """Method, relative tolerance, mesh cycles to run, steps allowed per cycle, and where the run starts."""

    method: str = "auto"
    rtol: float = 1e-6
    cycles: int = 20
    max_steps: int = 1_000_000
    initial: Literal["static", "unloaded"] = "static"


@dataclass(frozen=True)
class OutputData:
    """What is recorded."""

    samples_per_cycle: int = 200


@dataclass(frozen=True)
class Case:
    """One simulation, complete.

    Parameters
    ----------
    title : str
        What it shows.
    name : str
        Stem of the scenario's file; names the record.
    kind : str
        "gear-pair".
    toml : str
        The scenario as TOML with everything written out (references replaced by their content, units kept,
        overrides applied); loading it gives this case again.
    sha256 : str
        Digest of `toml`.
    family : str
        Name of the path-of-contact family.
    drive : Drive
        Geometry of both gears.
    materials : (MaterialData, MaterialData)
        Of pinion and gear.
    masses : (BodyMass, BodyMass)
        Of pinion and gear.
    roughness : float
        Composite rms roughness σ of the flanks, m.
    mean_roughness : float
        Arithmetic mean roughness Ra of the flanks, m.
    lubricant, bearings, operating, mesh, friction, solver, output
        See the classes.
    """

    title: str
    name: str
    kind: str
    toml: str
    sha256: str
    family: str
    drive: "Drive"
    materials: tuple[MaterialData, MaterialData]
    masses: tuple[BodyMass, BodyMass]
    roughness: float
    mean_roughness: float
    lubricant: LubricantData
    bearings: tuple[BearingData, BearingData]
    operating: OperatingData
    mesh: MeshData
    friction: FrictionData
    solver: SolverData
    output: OutputData
