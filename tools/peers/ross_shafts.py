"""ROSS beside the two shafts of `tests/support/geared_shafts.py`: natural frequencies at rest and turning.

::

    python -m tools.peers.ross_shafts

ROSS (Timbó et al. 2020, doi:10.21105/joss.02120; ``pip install ross-rotordynamics "plotly<6"``) is a program
for rotors. It gets lengths and diameters of shaft elements, masses and moments of inertia of discs, springs,
and the stiffness of the mesh of its `MultiRotor`; matrices and frequencies are its own.
"""

from typing import Any

import numpy as np

from tests.support.geared_shafts import (
    DENSITY,
    GEAR,
    MESH_STIFFNESS,
    PINION,
    PRESSURE_ANGLE,
    SHEAR,
    YOUNG,
    GearedShaft,
    frequencies,
)

#: Of the pinion, rad/s.
SPEEDS = 0.0, 600.0
MODES = 12


def ross_frequencies(speed: float) -> np.ndarray:
    """The lowest frequencies, Hz, without rotation as a whole."""
    import ross  # pyright: ignore[reportMissingImports]

    steel = ross.Material(name="steel_of_both", rho=DENSITY, E=YOUNG, G_s=SHEAR)
    rotors = [_rotor(ross, steel, shaft) for shaft in (PINION, GEAR)]
    gears = PINION.discs[0].node, GEAR.discs[0].node
    both = ross.MultiRotor(*rotors, coupled_nodes=gears, gear_mesh_stiffness=MESH_STIFFNESS)
    found = np.sort(both.run_modal(speed, num_modes=4 * MODES).wd) / (2.0 * np.pi)
    return found[found > 1.0][:MODES]


def _rotor(ross: Any, steel: Any, shaft: GearedShaft) -> Any:
    pieces = [
        ross.ShaftElement(L=length, idl=bore, odl=outer, material=steel)
        for length, outer, bore in shaft.pieces
    ]
    gear, *discs = shaft.discs
    carried = [
        ross.GearElement(
            n=gear.node,
            m=gear.mass,
            Id=gear.transverse,
            Ip=gear.polar,
            n_teeth=shaft.teeth,
            pitch_diameter=2.0 * shaft.pitch_radius,
            pr_angle=PRESSURE_ANGLE,
        )
    ]
    carried += [
        ross.DiskElement(n=disc.node, m=disc.mass, Id=disc.transverse, Ip=disc.polar) for disc in discs
    ]
    springs = [ross.BearingElement(n=node, kxx=x, kyy=y, kzz=z, cxx=0.0) for node, x, y, z in shaft.springs]
    return ross.Rotor(pieces, carried, springs)


def main() -> None:
    for speed in SPEEDS:
        ours, theirs = frequencies(speed)[:MODES], ross_frequencies(speed)
        print(f"pinion at {speed:g} rad/s: tribodyn Hz, ROSS Hz, difference")
        for one, other in zip(ours, theirs, strict=True):
            print(f"{one:12.4f}{other:12.4f}{one / other - 1.0:10.1e}")


if __name__ == "__main__":
    main()
