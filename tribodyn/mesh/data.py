"""What a case says of the mesh of its teeth, in SI units."""

from dataclasses import dataclass
from typing import Literal

from tribodyn.compliance.foundation import Foundation
from tribodyn.geometry.flanks.modification import UNMODIFIED, Modifications
from tribodyn.numerics.curve import Table


@dataclass(frozen=True)
class MeshData:
    """How the teeth in contact deflect, damp, separate and err.

    Parameters
    ----------
    compliance : {"energy", "fem", "constant", "table"}
        Where the single-pair stiffness comes from.
    hertz : {"linear", "load-dependent"}
        Contact part of the energy method's compliance.
    foundation : {"sainsot-velex", "ring"}
        Compliance of a gear body under its own tooth, with ``compliance = "energy"``.
    foundation_coupling : whether two pairs on one body share its foundation
    stiffness : single-pair stiffness, N/m, with ``compliance = "constant"``
    table : single-pair stiffness over the pinion's roll angle from the pitch point (rad, N/m), with
        ``compliance = "table"``
    damping_ratio : ζ of the mesh
    formulation : {"classical", "energy-consistent"}
        Whether the torque −∂V/∂φ of the varying stiffness acts on the bodies.
    contact_width : width in deflection over which contact sets in smoothly, m
    backlash : normal backlash at the pitch point, m; None: back flanks never touch
    points : nodes of the table per segment of the mesh cycle
    error_harmonics : (int, float, float); (order of the mesh frequency, amplitude m, phase rad) of cosines in
        the static transmission error
    error_table : static transmission error of a pair over roll angle (rad, m)
    modifications : what is missing on the flanks, and misalignment; with ``compliance = "fem"``
    slices : slices along the face, with ``compliance = "fem"``
    slice_coupling : whether slices of one tooth hold each other
    """

    compliance: Literal["energy", "fem", "constant", "table"]
    damping_ratio: float
    hertz: Literal["linear", "load-dependent"] = "linear"
    foundation: Foundation = "sainsot-velex"
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

    @property
    def at_load(self) -> bool:
        """Whether the compliance is that of finite elements, taken at the operating torque."""
        return self.compliance == "fem"
