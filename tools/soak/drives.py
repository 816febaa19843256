"""Random drives of every family, as tables of a scenario."""

from typing import Any

import numpy as np

from tools.soak.draw import Draw, quantity
from tribodyn.geometry.families import FAMILIES as REGISTRY

#: Every one there is.
FAMILIES = tuple(REGISTRY)
#: Families whose drives are given a pressure angle, and its range in degrees.
ANGLES = {"involute": (17.0, 28.0), "crc": (19.0, 27.0), "circular-arc": (15.0, 24.0), "points": (19.0, 25.0)}
STEELS = ("steel-liu-ni-2022", "steel-diez-ibarbia", "steel-jia-2022")


def drive(draw: Draw, family: str) -> dict[str, Any]:
    """Return the table of a drive of a family; most can be made, some cannot."""
    module = draw.decades(3e-4, 2e-2)
    teeth = draw.whole_decades(12, 60), draw.whole_decades(15, 120)
    table: dict[str, Any] = {
        "title": "A random drive",
        "source": "random numbers",
        "family": family,
        "module": quantity(1e3 * module, "mm"),
        "roughness": quantity(draw.decades(0.05, 2.0), "um"),
        "material": _material(draw),
    }
    if draw.chance(0.2):
        table["mean_roughness"] = quantity(draw.decades(0.05, 2.0), "um")
    angle = draw.between(*ANGLES[family]) if family in ANGLES else 0.0
    if angle:
        table["pressure_angle"] = quantity(angle, "deg")
    if shape := _shape(draw, family, module, teeth, angle):
        table["shape"] = shape
    width = draw.between(3.0, 14.0) * module
    for name, count in zip(("pinion", "gear"), teeth, strict=True):
        table[name] = _gear(draw, family, module, count, width)
    return table


def _gear(draw: Draw, family: str, module: float, teeth: int, width: float) -> dict[str, Any]:
    shift = draw.between(-0.3, 0.8) if family == "involute" and draw.chance(0.6) else 0.0
    addendum = draw.between(0.6, 1.0 if family == "s-gear" else 1.2) if draw.chance(0.5) else 1.0
    dedendum = _digits(max(1.25, addendum + draw.between(0.1, 0.35)))
    root = module * (teeth / 2 + shift - dedendum)
    table: dict[str, Any] = {
        "teeth": teeth,
        "face_width": quantity(1e3 * width * draw.between(0.8, 1.0), "mm"),
        "bore_radius": quantity(1e3 * root * draw.between(0.1, 0.97), "mm"),
        "profile_shift": shift,
        "addendum": addendum,
        "dedendum": dedendum,
        "fillet_radius": draw.between(0.0, 0.3),
    }
    if draw.chance(0.1):
        table["mass"] = quantity(draw.between(0.5, 5.0) * 7850 * np.pi * root**2 * width, "kg")
    if draw.chance(0.1):
        table["inertia"] = quantity(draw.between(0.5, 5.0) * 3925 * np.pi * root**4 * width, "kg*m**2")
    if draw.chance(0.1):
        table["material"] = _material(draw)
    return table


def _shape(
    draw: Draw, family: str, module: float, teeth: tuple[int, int], angle: float
) -> dict[str, Any] | None:
    if family == "cycloidal":
        circles = (draw.between(0.15, 0.5) * z * module for z in teeth)
        keys = "approach_circle", "recess_circle"
        return {key: quantity(1e3 * circle, "mm") for key, circle in zip(keys, circles, strict=True)}
    if family == "parabolic":
        return {"k1": draw.between(0.12, 0.45), "k2": draw.between(0.12, 0.45)}
    if family == "circular-arc":
        sign = draw.choice((1.0, 1.0, -1.0))
        diameters = (sign * draw.between(10.0, 90.0) * module for _ in range(2))
        keys = "approach_diameter", "recess_diameter"
        return {key: quantity(1e3 * diameter, "mm") for key, diameter in zip(keys, diameters, strict=True)}
    if family == "s-gear":
        return {"form_factor": draw.between(1.3, 1.9), "exponent": draw.between(1.5, 2.0)}
    if family == "points":
        return {"points": _points(module, np.radians(angle), draw.between(-0.06, 0.06))}
    if family == "spline":
        return _spline(draw, module)
    return None


def _spline(draw: Draw, module: float) -> dict[str, Any]:
    """A trend of α along the path, waves on it, and in some drives a corner at P."""
    count = draw.whole_decades(4, 13)
    middle, trend, wave = draw.between(17.0, 26.0), draw.between(-5.0, 5.0), draw.between(0.0, 0.6)
    angles = [
        middle + trend * place + wave * draw.between(-1.0, 1.0) for place in np.linspace(-1.0, 1.0, count)
    ]
    return {
        "angles": [quantity(angle, "deg") for angle in angles],
        "path_length": quantity(1e3 * module * draw.between(4.0, 8.0), "mm"),
        "corner": quantity(draw.between(-2.0, 2.0) if draw.chance(0.3) else 0.0, "deg"),
    }


def _points(module: float, angle: float, bend: float) -> dict[str, Any]:
    """Points of a smooth path through P: α changes with r by `bend` rad a module, less further out."""
    r = 1e3 * module * np.linspace(-6.0, 6.0, 17)
    alpha = angle + bend * np.tanh(r / (3e3 * module))
    values = {"x": r * np.cos(alpha), "y": r * np.sin(alpha)}
    return {name: {"unit": "mm", "values": [_digits(v, 9) for v in row]} for name, row in values.items()}


def _material(draw: Draw) -> Any:
    if draw.chance(0.8):
        return draw.choice(STEELS)
    return {
        "title": "A random material",
        "source": "random numbers",
        "youngs_modulus": quantity(draw.decades(2.0, 300.0), "GPa"),
        "poisson_ratio": draw.between(0.0, 0.45),
        "density": quantity(draw.decades(900.0, 9000.0), "kg/m**3"),
        "thermal_conductivity": quantity(draw.decades(0.2, 200.0), "W/(m*K)"),
        "specific_heat": quantity(draw.decades(300.0, 2000.0), "J/(kg*K)"),
        "hardness": quantity(draw.decades(0.1, 8.0), "GPa"),
    }


def _digits(value: float, digits: int = 4) -> float:
    return float(f"{value:.{digits}g}")


def size_of(table: dict[str, Any]) -> tuple[float, float, float, float]:
    """Module, pitch radii of pinion and gear, narrower face width, all in m."""
    module = _metres(table["module"])
    radii = (module * table[name]["teeth"] / 2 for name in ("pinion", "gear"))
    width = min(_metres(table[name]["face_width"]) for name in ("pinion", "gear"))
    return module, *radii, width


def _metres(text: str) -> float:
    return 1e-3 * float(text.split()[0])
