"""Line contacts for tests: by Moes' numbers, and two with films by another program."""

import math

from tribodyn.tribology.ehl.fluid import Fluid
from tribodyn.tribology.ehl.problem import LineContact

#: E' of steel on steel, 2/E' = Σ(1 − ν²)/E, Pa.
MODULUS = 226.37e9
#: Contacts, and central and minimum film in m by a dense finite difference solver at its grid limit.
REFERENCES = (
    (LineContact(384.7e3, 8.98025e-3, 0.1355, Fluid(0.35, 25e-9, 0.57), MODULUS), 0.3184e-6, 0.2820e-6),
    (LineContact(200e3, 10e-3, 1.0, Fluid(0.04, 22e-9, 0.6), MODULUS), 0.2983e-6, 0.2589e-6),
)


def by_moes(load, material, pressure=0.5e9, index=1.0, compressible=False):
    """A contact of Moes' M and L at a Hertz pressure; Barus' law and an incompressible fluid by default."""
    radius, viscosity = 0.01, 0.05
    loaded = 2.0 * math.pi * (pressure / MODULUS) ** 2
    sum_speed = (loaded / load) ** 2
    fluid = Fluid(viscosity, material / MODULUS / sum_speed**0.25, index, compressible)
    speed = 0.5 * sum_speed * MODULUS * radius / viscosity
    return LineContact(loaded * MODULUS * radius, radius, speed, fluid, MODULUS)
