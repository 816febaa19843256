"""Random duties of pairs of gears, and every law beside the contact solved along the whole way there."""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from tribodyn.studies.ehl.along_path import prepare, seen_by, solved_at, way
from tribodyn.studies.ehl.judgement import case_for
from tribodyn.studies.ehl.run import by_laws
from tribodyn.studies.protocol.load import load_data

#: A reading of another law, or that law itself, stands for both.
READINGS = ("-as-printed", "-mean-pressure", "-veciana", "-veciana-peak")
OILS = ("iso-vg-32-mineral", "iso-vg-220-mineral", "iso-vg-460-mineral", "iso-vg-68-pao", "iso-vg-320-pao")


def drawn(seed: int) -> Any:
    """An efficiency case whose laws `auto` takes: oil, roughness, teeth, size, load and speed drawn."""
    draw = np.random.default_rng(seed)

    def between(low: float, high: float) -> float:
        return float(math.exp(draw.uniform(math.log(low), math.log(high))))

    teeth, module, ra = int(draw.integers(18, 45)), between(1.5, 8.0), between(0.1, 0.8)
    drive: dict[str, Any] = {"family": "involute", "module": f"{module:.3g} mm", "pressure_angle": "20 deg"}
    drive |= {"material": "18CrNiMo7-6", "mean_roughness": f"{ra:.3g} um"}
    drive |= {"helix_angle": "15 deg"} if draw.random() < 0.25 else {}
    width = {"face_width": f"{10.0 * module:.3g} mm"}
    drive["pinion"] = {"teeth": teeth, **width}
    drive["gear"] = {"teeth": round(teeth * draw.uniform(1.0, 4.0)), **width}
    radius = 0.5e-3 * module * teeth
    # p_H² = w E'/(2π ρ) at the pitch point of about that radius
    pressure, curvature = draw.uniform(0.4e9, 1.6e9), 1.6 / (radius * math.sin(math.radians(20.0)))
    load = 2.0 * math.pi * pressure**2 / (2.26e11 * curvature) * 10e-3 * module
    data = {
        "title": "drawn",
        "kind": "efficiency",
        "drive": drive,
        "lubricant": OILS[seed % len(OILS)],
        "operating": {
            "pinion_speed": f"{between(0.5, 20.0) / radius:.4g} rad/s",
            "pinion_torque": f"{load * radius:.4g} N*m",
            "oil_temperature": f"{draw.uniform(30.0, 110.0):.3g} degC",
        },
        "friction": {"law": "auto"},
    }
    return load_data(data, "drawn").case.pair


def departures(case: Any, positions: int = 8) -> dict[str, dict[str, float]]:
    """How far each law is from the solved contact: |ln| of the film on the mean, of friction of the loss.

    Empty where no contact could be solved.
    """
    study = prepare(replace(case_for(case, positions), step=0.25))
    over = way(study)
    film, friction = np.full((2, positions), np.nan)
    for at, known in enumerate(solved_at(study, over, seen_by(study, over), at) for at in range(positions)):
        if known is not None:
            film[at] = np.interp(0.0, known.solution.place, known.solution.mean_gap)
            friction[at] = abs(known.friction) / over.line_load[at]
    if not np.any(np.isfinite(film * friction)):
        return {}
    heat, laws = over.line_load * np.abs(over.sliding), by_laws(study, over)
    loss = np.nansum(heat * friction)
    lost = {law: np.nansum(heat * (values + 0.0 * friction)) for law, values in laws["friction"].items()}
    losses = {law: value / loss for law, value in lost.items()}
    films = {law: np.exp(np.nanmean(np.log(values / film))) for law, values in laws["film"].items()}
    return {
        what: {law: abs(math.log(ratio)) for law, ratio in found.items() if not law.endswith(READINGS)}
        for what, found in (("film", films), ("friction", losses))
    }


def excess(case: Any, found: dict[str, dict[str, float]], what: str) -> float:
    """By which factor the law that was taken departs more than the nearest."""
    law = str((case.film if what == "film" else case.friction).law or case.friction.law)
    return math.exp(found[what][law] - min(found[what].values()))
