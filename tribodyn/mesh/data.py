"""What a case says of the mesh of its teeth, in SI units."""

from dataclasses import dataclass
from typing import Literal

from tribodyn.compliance.foundation import Foundation
from tribodyn.geometry.flanks.modification import UNMODIFIED, Modifications
from tribodyn.numerics.curve import Table


@dataclass(frozen=True)
class MeshData:
    """How the teeth in contact deflect, damp, separate and err."""

    #: {"energy", "fem", "constant", "table"} Where the single-pair stiffness comes from.
    compliance: Literal["energy", "fem", "constant", "table"]
    damping_ratio: float  # ζ of the mesh
    #: {"linear", "load-dependent"} Contact part of the energy method's compliance.
    hertz: Literal["linear", "load-dependent"] = "linear"
    #: {"sainsot-velex", "ring"} Compliance of a gear body under its own tooth, with ``compliance =
    #: "energy"``.
    foundation: Foundation = "sainsot-velex"
    foundation_coupling: bool = True  # whether two pairs on one body share its foundation
    stiffness: float | None = None  # single-pair stiffness, N/m, with ``compliance = "constant"``
    #: single-pair stiffness over the pinion's roll angle from the pitch point (rad, N/m), with ``compliance =
    #: "table"``
    table: Table | None = None
    #: {"classical", "energy-consistent"} Whether the torque −∂V/∂φ of the varying stiffness acts on the
    #: bodies.
    formulation: Literal["classical", "energy-consistent"] = "classical"
    contact_width: float = 1e-7  # width in deflection over which contact sets in smoothly, m
    backlash: float | None = None  # normal backlash at the pitch point, m; None: back flanks never touch
    points: int = 65  # nodes of the table per segment of the mesh cycle
    #: (int, float, float); (order of the mesh frequency, amplitude m, phase rad) of cosines in the static
    #: transmission error
    error_harmonics: tuple[tuple[int, float, float], ...] = ()
    error_table: Table | None = None  # static transmission error of a pair over roll angle (rad, m)
    #: what is missing on the flanks, and misalignment; with ``compliance = "fem"``
    modifications: Modifications = UNMODIFIED
    slices: int = 1  # slices along the face, with ``compliance = "fem"``
    slice_coupling: bool = True  # whether slices of one tooth hold each other

    @property
    def at_load(self) -> bool:
        """Whether the compliance is that of finite elements, taken at the operating torque."""
        return self.compliance == "fem"
