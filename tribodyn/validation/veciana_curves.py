"""Data behind figures 1, 5, 6, 8, 9 and 10 of Veciana et al. (2024): arrays by name, units in brackets."""

import math

import numpy as np

from tribodyn.studies.efficiency.torque_ratio import UnitContact
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.surface_state import surface_state
from tribodyn.validation.veciana_study import (
    EFFECTIVE_MODULUS,
    LAWS,
    PINION_TEETH,
    DriveUnderLaw,
    Law,
    closure_of,
    contact_height,
)

#: The paper's choice of d_g1/d_1.
CHOSEN = 0.17

Arrays = dict[str, np.ndarray]

#: (gear ratio, module m) of the panels of figures 5 and 6, and the gear ratios of figure 10.
DRIVES = [(1.0, 2e-3), (2.0, 2e-3), (3.0, 2e-3), (1.0, 2e-3), (1.0, 4e-3), (1.0, 6e-3)]
RATIOS = (1.0, 1.5, 2.0, 2.5, 3.0)


def drive_key(ratio: float, module: float) -> str:
    """Name of a drive in the arrays."""
    return f"i = {ratio:g}, m = {module * 1e3:g} mm"


def coefficients() -> Arrays:
    """Friction coefficient against slide-to-roll ratio at R 5 mm, V_e 5 m/s, p_H 2 GPa (Table 2)."""
    ratio = np.linspace(0.0, 1.0, 401)
    radius, speed, pressure = 5e-3, 5.0, 2.0e9
    load = 2.0 * math.pi * radius * pressure**2 / EFFECTIVE_MODULUS
    slid = ratio * speed
    rolled = speed + slid / 2, speed - slid / 2
    arrays = {"slide-to-roll ratio [1]": ratio}
    for law in LAWS:
        contact = local_contact(load + 0 * slid, 1 / radius + 0 * slid, speed + 0 * slid, slid, *rolled)
        arrays[f"{law} [1]"] = surface_state(contact, closure_of(law)).friction_coefficient
    return arrays


def efficiencies(law: Law) -> Arrays:
    """Efficiency over both generating circles, and the involute's."""
    circle = np.linspace(0.1, 0.4, 31)
    approach, recess = np.meshgrid(circle, circle, indexing="ij")
    arrays = {"circle over d_1 [1]": circle}
    for ratio, module in DRIVES:
        study = DriveUnderLaw(ratio, module, law)
        arrays[f"{drive_key(ratio, module)} [1]"] = study.cycloid(approach, recess)
        arrays[f"involute, {drive_key(ratio, module)} [1]"] = np.array(study.involute())
    return arrays


def heights() -> Arrays:
    """Contact height of the pinion and maximum pressure angle against the generating circles."""
    study = DriveUnderLaw(1.0, 2e-3, "EHL")
    half = math.pi / PINION_TEETH
    ends = np.array([-half, half]), np.array([0.5, 0.5])
    circle = np.linspace(0.1, 0.4, 121)
    return {
        "circle over d_1 [1]": circle,
        "height [m]": np.array([contact_height(study.cycloid_pair(c, rotation=ends)) for c in circle]),
        "involute height [m]": np.array(contact_height(study.involute_pair(ends))),
        "angle [rad]": half / (2.0 * circle),
    }


def conditions() -> Arrays:
    """Contact conditions along the path, i = 1, m = 2 mm, d_g = 0.17 d_1."""
    half = math.pi / PINION_TEETH
    psi = np.linspace(-half, half, 1200)  # an even number: not at the pitch point itself
    rotation = psi, np.full_like(psi, 1.0 / psi.size)
    study = DriveUnderLaw(1.0, 2e-3, "EHL")
    pairs: dict[str, UnitContact] = {
        "involute": study.involute_pair(rotation),
        "cycloid": study.cycloid_pair(CHOSEN, rotation=rotation),
        "cycloid, exact speeds": study.cycloid_pair(CHOSEN, rotation=rotation, exact_speeds=True),
    }
    arrays = {"rotation [rad]": psi}
    for name, pair in pairs.items():
        speeds = study.pinion_speed * pair.pinion_speed, study.pinion_speed * pair.gear_speed
        arrays[f"sum of speeds, {name} [m per s]"] = speeds[0] + speeds[1]
        arrays[f"sliding, {name} [m per s]"] = np.abs(speeds[0] - speeds[1])
        arrays[f"radius, {name} [m]"] = 1.0 / pair.curvature
        for law in LAWS:
            state = DriveUnderLaw(1.0, 2e-3, law).solve(pair)
            arrays[f"load, {law}, {name} [N]"] = state.normal_load
            arrays[f"friction, {law}, {name} [1]"] = state.friction_coefficient
            arrays[f"torque ratio, {law}, {name} [1]"] = state.torque_ratio
    return arrays


def by_module() -> Arrays:
    """Efficiency of both profiles against module, for gear ratios 1 … 3."""
    modules = np.linspace(2e-3, 6e-3, 9)
    arrays = {"module [m]": modules}
    for law in LAWS:
        for ratio in RATIOS:
            studies = [DriveUnderLaw(ratio, float(module), law) for module in modules]
            values = {
                "involute": [study.involute() for study in studies],
                "cycloid": [study.cycloid(CHOSEN) for study in studies],
                "cycloid, exact speeds": [study.cycloid(CHOSEN, exact_speeds=True) for study in studies],
            }
            for name, efficiency in values.items():
                arrays[f"{law}, i = {ratio:g}, {name} [1]"] = np.array(efficiency, dtype=float)
    return arrays
