"""Random duties and options of a gear pair's dynamics, as tables of a scenario."""

from typing import Any, NamedTuple

import numpy as np

from tools.soak.draw import Draw, quantity
from tools.soak.drives import size_of
from tribodyn.solve.methods import AUTO, Runs, runs

#: Nominal stress F_t/(b m) that is taken for the rated load, Pa.
RATED = 1e8
FILM_LAWS = ("masjedi-khonsari", "masjedi-khonsari-as-printed", "dowson-higginson", "moes")
FRICTION_LAWS = (
    "masjedi-khonsari",
    "coulomb",
    "none",
    "xu",
    "benedict-kelley",
    "niemann",
    "iso-14179-1",
    "masjedi-khonsari-mean-pressure",
    "masjedi-khonsari-as-printed",
    "masjedi-khonsari-veciana",
    "masjedi-khonsari-veciana-peak",
)
#: Laws whose kernels other tests compile too.
KNOWN_LAWS = FRICTION_LAWS[:3]
FRICTION_WEIGHTS = (4, 4, 2, 1, 1, 1, 1, 1, 1, 1, 1)
METHODS = ("auto", "dopri5", "rodas4", "dop853", "lsoda", "bdf", "radau", "tsit5", "dopri8", "kvaerno5")
METHOD_WEIGHTS = (63, 12, 14, 3, 3, 2, 2, 0.5, 0.25, 0.25)
#: Steps in a mesh cycle after which a run is stopped: by native methods, and by those of SciPy and JAX, whose
#: steps take a millisecond, and in sweeps, which follow their derivatives too.
MOST_STEPS, MOST_SLOW_STEPS = 50_000, 2_000
#: Pinion speed below which explicit methods are slow, rad/s, and those methods.
SLOW, EXPLICIT = 30.0, ("dopri5", "dop853", "tsit5", "dopri8")
COMPLIANCES = ("energy", "constant", "table", "fem")
COMPLIANCE_WEIGHTS = (60, 15, 15, 10)


class Scale(NamedTuple):
    """What a drive's size makes of a duty: rated torque of the gear N m, inertia kg m², width, module m."""

    torque: float
    inertia: float
    width: float
    module: float
    mesh_frequency: float


def scale_of(drive: dict[str, Any], speed: float) -> Scale:
    """Return the scales of a duty at a pinion speed, rad/s."""
    module, pinion, gear, width = size_of(drive)
    inertia = 7850.0 * np.pi / 2 * pinion**4 * width
    frequency = speed * drive["pinion"]["teeth"] / (2 * np.pi)
    return Scale(RATED * width * module * gear, inertia, width, module, frequency)


def gear_pair(draw: Draw, drive: dict[str, Any], known_laws: bool = False) -> dict[str, Any]:
    """Return the scenario of a gear pair's dynamics; known laws: those whose kernels other tests compile."""
    speed = draw.decades(0.01, 3000.0)
    scale = scale_of(drive, speed)
    backlash = draw.chance(0.4)
    compliance = draw.choice(COMPLIANCES, COMPLIANCE_WEIGHTS)
    return {
        "title": "A random duty",
        "kind": "gear-pair",
        "drive": drive,
        "lubricant": lubricant(draw),
        "bearings": _bearings(draw),
        "operating": _operating(draw, scale, speed, backlash),
        "mesh": _mesh(draw, scale, compliance, backlash),
        **_dynamic(draw, laws(draw, known_laws)),
        "solver": _solver(draw, speed, known_laws),
        "output": {"samples_per_cycle": draw.choice((16, 40, 100))},
    }


def lubricant(draw: Draw) -> Any:
    """Return a lubricant: a shipped one, or one of random numbers."""
    if draw.chance(0.6):
        return draw.choice(("liu-ni-2022", "75w90-diez-ibarbia"))
    return {
        "title": "A random lubricant",
        "source": "random numbers",
        "asperity_friction": draw.between(0.03, 0.2),
        "limiting_shear_coefficient": draw.between(0.02, 0.15),
        "inlet_viscosity": quantity(draw.decades(1e-3, 2.0), "Pa*s"),
        "pressure_viscosity": quantity(draw.between(5.0, 35.0), "1/GPa"),
        "viscosity_pressure_index": draw.between(0.3, 0.9),
        "temperature_viscosity": quantity(draw.between(0.0, 0.08), "1/K"),
        "density": quantity(draw.between(750.0, 1050.0), "kg/m**3"),
    }


def torque(draw: Draw, scale: Scale) -> float:
    """Return a torque from 0.003 to five times the rated one, N m."""
    return scale.torque * draw.decades(3e-3, 5.0)


def _operating(draw: Draw, scale: Scale, speed: float, backlash: bool) -> dict[str, Any]:
    load = torque(draw, scale)
    if backlash:
        load *= draw.choice((1.0, 0.0, -1.0), (6, 2, 2))
    table: dict[str, Any] = {"pinion_speed": quantity(speed, "rad/s"), "gear_torque": quantity(load, "N*m")}
    size = max(abs(load), 0.01 * scale.torque)
    if draw.chance(0.15):
        amplitude = quantity(size * draw.decades(0.01, 2.0), "N*m")
        frequency = quantity(scale.mesh_frequency * draw.decades(0.05, 3.0), "Hz")
        table["gear_torque_harmonics"] = [{"amplitude": amplitude, "frequency": frequency}]
    if draw.chance(0.1):
        times = [float(f"{cycle / scale.mesh_frequency:.5g}") for cycle in (0.0, 1.0, 2.0, 4.0)]
        torques = [float(f"{size * draw.between(-0.5, 2.0):.5g}") for _ in times]
        table["gear_torque_table"] = {
            "time": {"unit": "s", "values": times},
            "torque": {"unit": "N*m", "values": torques},
        }
    if draw.chance(0.2):
        table["load_inertia"] = quantity(scale.inertia * draw.decades(0.1, 100.0), "kg*m**2")
    if draw.chance(0.2):
        table["load_damping"] = quantity(size / speed * draw.decades(0.01, 3.0), "N*m*s/rad")
    if draw.chance(0.25):
        table |= _motor(draw, scale, speed, size)
    return table


def _motor(draw: Draw, scale: Scale, speed: float, size: float) -> dict[str, Any]:
    table: dict[str, Any] = {"source": "torque"}
    if draw.chance(0.7):
        table["drive_inertia"] = quantity(scale.inertia * draw.decades(0.1, 1000.0), "kg*m**2")
        if draw.chance(0.5):
            table["shaft_stiffness"] = quantity(size * draw.decades(1.0, 1e4), "N*m/rad")
            if draw.chance(0.5):
                damping = size / scale.mesh_frequency * draw.decades(0.01, 10)
                table["shaft_damping"] = quantity(damping, "N*m*s/rad")
    if draw.chance(0.6):
        table["speed_regulation"] = quantity(size / speed * draw.decades(0.1, 100.0), "N*m*s/rad")
    if draw.chance(0.2):
        table["pinion_torque"] = quantity(size * draw.between(0.1, 2.0), "N*m")
    return table


def _mesh(draw: Draw, scale: Scale, compliance: str, backlash: bool) -> dict[str, Any]:
    per_width = draw.between(3.0, 25.0)  # GPa: N/m per m of face
    table: dict[str, Any] = {
        "damping_ratio": draw.choice((0.0, draw.decades(1e-3, 0.3), 0.05), (1, 6, 3)),
        "compliance": compliance,
        "formulation": draw.choice(("classical", "energy-consistent")),
    }
    if compliance == "constant":
        table["stiffness"] = quantity(1e9 * per_width * scale.width, "N/m")
    if compliance == "table":
        angles = [-60.0, -12.0, -4.0, 0.0, 5.0, 14.0, 60.0]
        values = [float(f"{per_width * scale.width * draw.between(0.6, 1.0):.5g}") for _ in angles]
        table["table"] = _curve(angles, "stiffness", "GN/m", values)
    if compliance == "energy":
        if draw.chance(0.3):
            table["hertz"] = "load-dependent"
        if draw.chance(0.2):
            table["foundation_coupling"] = False
    if compliance == "fem" and draw.chance(0.3):
        table["slices"] = draw.choice((1, 3, 5))
        table["misalignment"] = {"in_plane": quantity(draw.between(-1.0, 1.0), "arcmin")}
        if table["slices"] == 1 and draw.chance(0.8):
            del table["misalignment"]
    if draw.chance(0.4):
        table["contact_width"] = quantity(draw.decades(0.01, 1.0), "um")
    if backlash:
        table["backlash"] = quantity(1e3 * scale.module * draw.decades(0.005, 0.1), "mm")
    if draw.chance(0.4):
        table["points"] = draw.choice((17, 33, 129))
    if draw.chance(0.3):
        table["transmission_error"] = _error(draw)
    return table


def _error(draw: Draw) -> dict[str, Any]:
    if draw.chance(0.3):
        angles = [-60.0, -10.0, -5.0, 5.0, 10.0, 60.0]
        size = draw.decades(0.3, 20.0)
        values = [float(f"{size * share:.4g}") for share in (1.0, 1.0, 0.0, 0.0, 1.0, 1.0)]
        return {"table": _curve(angles, "error", "um", values)}
    return {
        "harmonics": [
            {
                "order": draw.whole(1, 5),
                "amplitude": quantity(draw.decades(0.05, 20.0), "um"),
                "phase": quantity(draw.between(0.0, 360.0), "deg"),
            }
            for _ in range(draw.whole(1, 3))
        ]
    }


def _curve(angles: list[float], name: str, unit: str, values: list[float]) -> dict[str, Any]:
    return {"roll_angle": {"unit": "deg", "values": angles}, name: {"unit": unit, "values": values}}


def laws(draw: Draw, known_laws: bool = False) -> dict[str, Any]:
    """Return the tables of friction and film; every pair of laws needs machine code of its own."""
    law = draw.choice(KNOWN_LAWS) if known_laws else draw.choice(FRICTION_LAWS, FRICTION_WEIGHTS)
    friction: dict[str, Any] = {"law": law}
    if law == "coulomb":
        friction["coefficient"] = draw.choice((0.0, draw.between(0.01, 0.3), 2.0), (1, 8, 1))
    chosen = law == "coulomb" and not known_laws and draw.chance(0.5)
    return {"friction": friction, **({"film": {"law": draw.choice(FILM_LAWS)}} if chosen else {})}


def _dynamic(draw: Draw, tables: dict[str, Any]) -> dict[str, Any]:
    """Add what dynamics need to know of friction."""
    friction = {**tables["friction"], "sliding": draw.choice(("kinematic", "dynamic"))}
    if draw.chance(0.4):
        friction["reversal_width"] = quantity(draw.decades(1.0, 100.0), "um")
    return {**tables, "friction": friction}


def _solver(draw: Draw, speed: float, known_laws: bool) -> dict[str, Any]:
    """Any method; below `SLOW` seldom one that stability makes take a hundred thousand steps a mesh cycle."""
    method = draw.choice(METHODS[:3]) if known_laws else draw.choice(METHODS, METHOD_WEIGHTS)
    if speed < SLOW and method in EXPLICIT and draw.chance(0.9):
        method = "auto"
    native = method == AUTO or runs(method) is Runs.NATIVE
    return {
        "method": method,
        "rtol": draw.choice((1e-6, draw.decades(1e-8, 1e-4))),
        "cycles": draw.choice((1, 2, 4)),
        "max_steps": MOST_STEPS if native else MOST_SLOW_STEPS,
        "initial": draw.choice(("static", "unloaded"), (4, 1)),
    }


def _bearings(draw: Draw) -> Any:
    if draw.chance(0.2):
        return "rigid-1e9"
    table: dict[str, Any] = {"title": "Random bearings", "source": "random numbers"}
    for name in ("pinion", "gear"):
        table[name] = {
            "stiffness_x": quantity(draw.decades(1e6, 1e12), "N/m"),
            "stiffness_y": quantity(draw.decades(1e6, 1e12), "N/m"),
            "damping_ratio": draw.choice((0.0, 0.05, draw.decades(1e-3, 0.3))),
        }
    return table
