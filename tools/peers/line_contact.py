"""The lubricated line contact as an engineer would write it on NumPy: dense Newton on a uniform grid.

``python -m tools.peers.line_contact`` solves two contacts with it and with `td.line_contact`, in one run,
and prints films and times. Pressures and rigid displacement are the unknowns, the end of the film is found by
complementarity (min(P, R) = 0), the wedge term is second order, upwind. Newtonian, isothermal, Roelands,
Dowson & Higginson, as `tribodyn.tribology.ehl`.
"""

import math
import time
from typing import Any

import numpy as np

import tribodyn as td

Array = Any

KEYS = "line_load radius entrainment_speed viscosity pressure_viscosity viscosity_pressure_index"
#: As `td.line_contact` takes them.
CONTACTS: tuple[dict[str, Any], ...] = tuple(
    dict(zip(KEYS.split(), values, strict=True), effective_modulus=226.37e9)
    for values in (
        (384.7e3, 8.98025e-3, 0.1355, 0.35, 25e-9, 0.57),
        (200e3, 10e-3, 1.0, 0.04, 22e-9, 0.6),
    )
)
_MOST_STEPS = 100


def solve(
    given: dict[str, float], points: int = 801, start: float = -4.0, end: float = 1.5
) -> dict[str, Any]:
    """Central and minimum film, m, and the steps that Newton's method took."""
    w, radius, modulus = given["line_load"], given["radius"], given["effective_modulus"]
    half = math.sqrt(8.0 * w * radius / (math.pi * modulus))
    hertz = 2.0 * w / (math.pi * half)
    number = 12.0 * given["entrainment_speed"] * given["viscosity"] * radius**2 / (half**3 * hertz)
    index, alpha = given["viscosity_pressure_index"], given["pressure_viscosity"]
    x = np.linspace(start, end, points)
    step = x[1] - x[0]
    away = np.abs(x[:, None] - x[None, :])
    up, down = away + 0.5 * step, away - 0.5 * step
    kernel = up * (np.log(up) - 1.0) - down * (np.log(np.abs(down)) - 1.0)
    bend = -kernel / math.pi
    pressure: Array = np.sqrt(np.maximum(1.0 - x * x, 0.0)) + 1e-3 * np.exp(-((x + 1.0) ** 2)) * (x < 1.0)
    coarse: dict[str, Any] = {**given, "step": 0.5}
    film = td.line_contact(**coarse).central_film_thickness * radius / half**2  # a fair start
    rigid = film - float(np.interp(0.0, x, 0.5 * x * x + bend @ pressure))
    inner = np.arange(2, points - 1)
    steps, thick = 0, x
    while steps < _MOST_STEPS:
        steps += 1
        thick = rigid + 0.5 * x * x + bend @ pressure
        p = hertz * pressure
        density = 1.0 + 0.6e-9 * p / (1.0 + 1.7e-9 * p)
        growth = hertz * 0.6e-9 / (1.0 + 1.7e-9 * p) ** 2
        ratio = 1.0 + p / 1.962e8
        exponent = alpha * 1.962e8 / index * (ratio**index - 1.0)
        slope = hertz * alpha * ratio ** (index - 1.0)
        mobility = density * thick**3 * np.exp(-exponent) / number
        by_film = 3.0 * mobility / thick
        by_pressure = mobility * (growth / density - slope)
        wedge = density * thick

        def difference(rows: Array, below: Array = inner) -> Array:
            return (1.5 * rows[below] - 2.0 * rows[below - 1] + 0.5 * rows[below - 2]) / step

        right = 0.5 * (mobility[inner] + mobility[inner + 1])
        left = 0.5 * (mobility[inner] + mobility[inner - 1])
        jump_right = pressure[inner + 1] - pressure[inner]
        jump_left = pressure[inner] - pressure[inner - 1]
        flow = difference(wedge) - (right * jump_right - left * jump_left) / step**2
        derivative_film = by_film[:, None] * bend
        derivative_film[np.arange(points), np.arange(points)] += by_pressure
        wedge_by = density[:, None] * bend
        wedge_by[np.arange(points), np.arange(points)] += growth * thick
        rows = difference(wedge_by)
        rows -= 0.5 * (derivative_film[inner] + derivative_film[inner + 1]) * jump_right[:, None] / step**2
        rows += 0.5 * (derivative_film[inner] + derivative_film[inner - 1]) * jump_left[:, None] / step**2
        at = np.arange(len(inner))
        rows[at, inner] += (right + left) / step**2
        rows[at, inner + 1] -= right / step**2
        rows[at, inner - 1] -= left / step**2
        # min(P, R) = 0, scaled so that both are of one size
        size = step / np.maximum(right + left, 1.0)
        active = (pressure[inner] > size * flow) | (x[inner] < 0.9)
        matrix = np.eye(points + 1)
        values = np.concatenate([pressure, [step * np.sum(pressure) - math.pi / 2.0]])
        values[inner[active]] = flow[active]
        matrix[inner[active], :points] = rows[active]
        rigid_by = difference(density)
        rigid_by -= (
            0.5 * (by_film[inner] + by_film[inner + 1]) * jump_right
            - 0.5 * (by_film[inner] + by_film[inner - 1]) * jump_left
        ) / step**2
        matrix[inner[active], points] = rigid_by[active]
        matrix[points, :points], matrix[points, points] = step, 0.0
        change = np.linalg.solve(matrix, -values)
        pressure = np.maximum(pressure + change[:-1], np.where(x < 0.9, 0.2 * pressure, 0.0))
        rigid += float(change[-1])
        if np.max(np.abs(change)) < 1e-8:
            break
    unit = half**2 / radius
    return {
        "central": float(np.interp(0.0, x, thick)) * unit,
        "least": float(thick.min()) * unit,
        "steps": steps,
    }


def main() -> None:
    """Print films and times of both."""
    for number, given in enumerate(CONTACTS, start=1):
        for points in (401, 801):
            began = time.perf_counter()
            found = solve(given, points)
            took = time.perf_counter() - began
            print(
                f"contact {number}, NumPy, {points} points: h_c {found['central'] * 1e6:.4f} µm, h_min "
                f"{found['least'] * 1e6:.4f} µm, {found['steps']} steps, {took * 1e3:.0f} ms"
            )
        td.line_contact(**given)
        began = time.perf_counter()
        contact = td.line_contact(**given)
        took = time.perf_counter() - began
        print(
            f"contact {number}, tribodyn: h_c {contact.central_film_thickness * 1e6:.4f} µm, h_min "
            f"{contact.minimum_film_thickness * 1e6:.4f} µm, {took * 1e3:.1f} ms"
        )


if __name__ == "__main__":
    main()
