"""A ring of finite elements, its outside in its fit, taken to what holds it in truth: by the rim's bending.

Between fit and pins only low orders of the rim differ, which do not see the teeth one by one: the difference
is that of two elastic rings (`energy.rim_compliance`) under the loads of the teeth on the root circle.
"""

from typing import Any

import numpy as np

from tribodyn.compliance.energy import loaded_tooth, rim_compliance, tooth_compliance
from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, GearCompliance
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData, Side, body_of
from tribodyn.geometry.path import distance_at_radius


def check_even(assembly: Assembly) -> None:
    """Refuse rims on pins under loads that vary along the teeth: the difference is of even ones."""
    for side in SIDES:
        if body_of(assembly.drive, side).pins:
            rule = "of a rim on pins the load is even along the teeth, and slices or root stress are wanted"
            raise InputError(f"drive.{side}.rim", '"pins"', rule, 'use "fixed" or "free", or leave them out')


def on_pins(
    fitted: GearCompliance, assembly: Assembly, side: Side, material: MaterialData, held: bool = False
) -> GearCompliance:
    """Take an internal gear's compliance, in its fit, to the support that its rim has."""
    loaded, ratio = loaded_tooth(assembly, side, held), material.poisson_ratio
    distance = distance_at_radius(loaded.path, fitted.radius)
    even = tooth_compliance(loaded, material, 1.0, distance if side == "pinion" else -distance)
    strain = ratio / (1.0 - ratio)  # plane strain by plane stress

    def softer(pitches: int) -> Any:
        pinned, fit = (rim_compliance(loaded, strain, -pitches, fitted) for fitted in (False, True))
        return (1.0 - ratio**2) * np.einsum("mi,ij,nj->mn", even.root_load, pinned - fit, even.root_load)

    between = np.stack([softer(pitches) for pitches in range(-NEIGHBOURS, NEIGHBOURS + 1)])
    return fitted._replace(
        inside=fitted.inside + np.diagonal(between[NEIGHBOURS]), between=fitted.between + between
    )
