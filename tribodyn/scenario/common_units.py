"""Units that scenarios are mostly written in, with their factors to SI as pint has them.

Importing pint takes about as long as everything else that a run reads its scenario with, so it is left to the
units that are not here.
"""

#: Name of the kind of quantity -> unit, spelled as TOML has it -> factor to the kind's SI unit.
COMMON_UNITS: dict[str, dict[str, float]] = {
    "length": {"m": 1.0, "cm": 0.01, "mm": 0.001, "um": 1e-06, "µm": 1e-06, "nm": 1e-09},
    "angular speed": {"rad/s": 1.0, "rpm": 0.10471975511965977},
    "angle": {
        "rad": 1.0,
        "mrad": 0.001,
        "deg": 0.017453292519943295,
        "arcmin": 0.00029088820866572163,
        "arcsec": 4.84813681109536e-06,
    },
    "frequency": {"Hz": 6.283185307179586, "kHz": 6283.185307179586, "rad/s": 1.0},
    "time": {"s": 1.0, "ms": 0.001, "us": 1e-06},
    "power": {"W": 1.0, "kW": 1000.0},
    "torque": {"N*m": 1.0, "Nm": 1.0, "kN*m": 1000.0, "N*mm": 0.001},
    "force": {"N": 1.0, "kN": 1000.0},
    "volume": {"l": 0.001, "m**3": 1.0},
    "volume flow": {"l/min": 0.001 / 60.0, "m**3/s": 1.0},
    "thermal conductance": {"W/K": 1.0},
    "mass": {"kg": 1.0, "g": 0.001},
    "moment of inertia": {"kg*m**2": 1.0, "kg*m^2": 1.0},
    "stiffness": {"N/m": 1.0, "N/mm": 1000.0, "N/um": 1000000.0},
    "torsional stiffness": {"N*m/rad": 1.0, "Nm/rad": 1.0},
    "torsional damping": {"N*m*s/rad": 1.0},
    "pressure": {"Pa": 1.0, "kPa": 1000.0, "MPa": 1000000.0, "GPa": 1000000000.0, "N/mm**2": 1000000.0},
    "density": {"kg/m**3": 1.0, "kg/m^3": 1.0, "g/cm**3": 999.9999999999999},
    "thermal conductivity": {"W/(m*K)": 1.0},
    "specific heat": {"J/(kg*K)": 1.0},
    "kinematic viscosity": {"mm**2/s": 1e-06, "mm^2/s": 1e-06, "mm²/s": 1e-06, "cSt": 1e-06, "m**2/s": 1.0},
    "dynamic viscosity": {"Pa*s": 1.0, "mPa*s": 0.001},
    "pressure-viscosity coefficient": {"1/Pa": 1.0, "1/GPa": 1e-09, "1/MPa": 1e-06},
    "temperature coefficient": {"1/K": 1.0},
}
