"""The loss of a mesh under load by a standard's formula, over points of operation."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.rating.standard import path_of
from tribodyn.geometry.assembly import Assembly
from tribodyn.numerics.shapes import Array, Float
from tribodyn.standards.contact_path import ContactPath
from tribodyn.standards.mesh_loss.methods import MESH_LOSS_METHODS, LoadedMesh
from tribodyn.tribology.oil import lubricant_around, lubricant_at


class FormulaLoss(NamedTuple):
    """What a formula gives at every point."""

    drag: Float[Array, " point"]  # power lost over the driver's speed, N m
    coefficient: Float[Array, " point"]  # mean friction coefficient; NaN without load
    exceeded: tuple[str, ...]  # limits of the formula that some point exceeds


def loss_by_formula(
    method: str,
    case: LubricatedCase,
    assembly: Assembly,
    torque: Float[Array, " point"],
    speed: Float[Array, " point"],
    temperature: Float[Array, " point"],
) -> FormulaLoss:
    """Loss of involutes by a method of `MESH_LOSS_METHODS`.

    Of the torque on the driven gear, N m, the driver's speed against the carrier, rad/s, and the temperature
    of the oil around the gears, K; signs of torque and speed do not count.
    """
    formula, path = MESH_LOSS_METHODS[method], path_of(assembly)
    torque = np.abs(np.asarray(torque, dtype=float))
    mesh = _loaded(case, path, float(assembly.common_width), torque, np.abs(speed), temperature)
    share = formula.loss_per_power(mesh)
    some = mesh._replace(base_force=np.maximum(mesh.base_force, np.finfo(float).tiny))
    return FormulaLoss(
        share * torque / abs(path.ratio),
        np.where(torque > 0.0, formula.coefficient(some), np.nan),
        formula.exceeded(mesh),
    )


def _loaded(
    case: LubricatedCase, path: ContactPath, width: float, torque: Any, speed: Any, temperature: Any
) -> LoadedMesh:
    oil = lubricant_around(case.lubricant)
    if oil.sheet is not None:
        oil = lubricant_at(oil, temperature)
    return LoadedMesh(
        path,
        width,
        torque / abs(path.base_radius[1]),
        speed * abs(path.pitch_radius[0]),
        oil.inlet_viscosity,
        oil.density,
        oil.pressure_viscosity,
        case.mean_roughness,
        oil.lubricant_factor,
        oil.schlenk_factor,
    )
