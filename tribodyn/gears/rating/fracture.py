"""Tooth flank fracture of a pair of gears, after ISO/TS 6336-4: exposure of the material and safety."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.gears.case import GearCase
from tribodyn.gears.rating.capacity import Capacity
from tribodyn.gears.rating.margins import flanks_of
from tribodyn.gears.rating.standard import Standard, by_point
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData, Side
from tribodyn.geometry.tooth import thickness_half_angle
from tribodyn.standards.case_hardening import flank_fracture
from tribodyn.standards.case_hardening.flank_fracture import HardenedCase
from tribodyn.standards.contact_path import POINTS, curvature_radii, equivalent_radius, point_distances


class Fracture(NamedTuple):
    """Exposures of a pair: of either gear by names, of the worse by points; what is beyond the limits."""

    gears: tuple[dict[str, float], dict[str, float]]
    by_point: dict[str, float]
    remarks: tuple[str, ...]


def hardened(material: MaterialData) -> HardenedCase | None:
    """The hardened case of a material; None where it is not known."""
    if material.treatment != "case-hardened" or material.case_depth is None or material.core_hardness is None:
        return None
    return HardenedCase(material.hardness, material.core_hardness, material.case_depth)


def fracture_of(case: GearCase, assembly: Assembly, standard: Standard) -> Fracture | None:
    """Exposures by the pressures of method B; None of rings and where a gear's case is not known."""
    cases = [hardened(material) for material in case.materials]
    path, modulus = standard.path, flanks_of(case).reduced_modulus
    if path.ratio < 0.0 or None in cases:
        return None
    places, pressure = point_distances(path), np.asarray(standard.films.pressure, dtype=float)
    radius = np.asarray(equivalent_radius(path, places), dtype=float)
    widths = 4.0 * radius * pressure / modulus
    gears, exposures = [], []
    for side, of_gear in zip(SIDES, cases, strict=True):
        assert of_gear is not None
        factor = flank_fracture.material_factor(middle_thickness(assembly, standard, side))
        found = [
            flank_fracture.greatest_exposure(of_gear, p, b, factor)
            for p, b in zip(pressure, widths, strict=True)
        ]
        worst = max(found)
        safety = min(
            flank_fracture.fracture_safety(of_gear, p, b, factor)
            for p, b in zip(pressure, widths, strict=True)
        )
        exposures.append([each.exposure for each in found])
        gears.append(
            {
                "K_material": factor,
                "y_FF": worst.depth,
                "tau_eff": worst.stress,
                "tau_per": worst.strength,
                "A_FF_max": worst.exposure,
                "S_FF": safety,
            }
        )
    beyond = tuple(_beyond(pressure, radius, [of_gear for of_gear in cases if of_gear]))
    return Fracture((gears[0], gears[1]), by_point(np.max(exposures, axis=0), max), beyond)


def with_fracture(capacity: Capacity, fracture: Fracture) -> Capacity:
    """A capacity with flank fracture among the factors of its gears."""
    first, second = (
        gear._replace(factors=gear.factors | named)
        for gear, named in zip(capacity.gears, fracture.gears, strict=True)
    )
    return capacity._replace(gears=(first, second), remarks=capacity.remarks + fracture.remarks)


def middle_thickness(assembly: Assembly, standard: Standard, side: Side) -> float:
    """Transverse thickness of a tooth, m, at the diameter in the middle between those of B and D."""
    path, number = standard.path, SIDES.index(side)
    places = point_distances(path)
    ends = [curvature_radii(path, places[POINTS.index(name)])[number] for name in "BD"]
    radius = float(np.mean(np.hypot(path.base_radius[number], ends)))
    return 2.0 * radius * float(thickness_half_angle(assembly.tooth(side), radius))


def _beyond(pressure: np.ndarray, radius: np.ndarray, cases: Sequence[HardenedCase]) -> Iterator[str]:
    depths = np.array([each.case_depth for each in cases])
    for what, values, (low, high), scale, unit in (
        ("pressure", pressure, flank_fracture.PRESSURES, 1e-6, "N/mm²"),
        ("radius of relative curvature", radius, flank_fracture.RADII, 1e3, "mm"),
        ("hardening depth", depths, flank_fracture.CASE_DEPTHS, 1e3, "mm"),
    ):
        if values.min() < low or values.max() > high:
            found = " to ".join(dict.fromkeys(f"{scale * end:.3g}" for end in (values.min(), values.max())))
            limits = f"{scale * low:g} to {scale * high:g} {unit}"
            yield f"Tooth flank fracture: {what} {found} {unit}, ISO/TS 6336-4 is for {limits}."
    known = flank_fracture.COMPARED_PRESSURES
    greatest = float(pressure.max())
    if not known[0] <= greatest <= known[1]:
        limits = " to ".join(f"{1e-6 * each:.0f}" for each in known)
        yield (
            f"Tooth flank fracture: {1e-6 * greatest:.0f} N/mm² is beyond the pressures that its constants "
            f"were found from, {limits} N/mm²: an extrapolation."
        )


def broken_fracture(
    limit: float | None, materials: Sequence[MaterialData], *, ring: bool = False
) -> Iterator[InputError]:
    """Refuse a required safety against flank fracture of rings, and of materials that lack what it takes."""
    if limit is None:
        return
    key, written = "limits.flank_fracture", f"{limit:g}"
    if ring:
        yield InputError(key, written, "is for external gears, and this pair has a ring", "leave it out")
        return
    for material in materials:
        if hardened(material) is None:
            rule = f"needs case_depth and core_hardness of case-hardened teeth, not {quoted(material.name)}"
            remedy = (
                'add case_depth, usually 0.15 times the normal module, as "0.7 mm", and core_hardness, '
                'usually 320 to 400 HV, as "350 HV", to the material, or leave the limit out'
            )
            yield InputError(key, written, rule, remedy)
            return
