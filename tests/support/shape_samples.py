"""Calls of each folder's main functions, with NumPy and under JAX, for `shape_checks` to look at."""

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import TypeCheckError

from tribodyn.compliance.energy import section_integrals
from tribodyn.compliance.sharing.condensed import condense
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, extended_rolls, flexibility
from tribodyn.drawing.cad import tooth_profile
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.body import gear_polygon, rack_outline
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.families import family
from tribodyn.geometry.path import contact_ratio, distance_at_radius, kinematics
from tribodyn.mesh.cycle import polynomials
from tribodyn.mesh.quasi_static import cycle_mean, quasi_static
from tribodyn.mesh.tabulate import pair_slots, tabulate
from tribodyn.numerics.iteration import chebyshev_basis
from tribodyn.solve.orbit.shooting import shoot
from tribodyn.studies.backlash_oscillator.response import frequency_response, oscillator_at
from tribodyn.studies.protocol.load import load_scenario

jax.config.update("jax_enable_x64", True)


def main() -> None:
    """Call them, and make sure that a wrong shape would have been seen."""
    case = load_scenario("involute-23-47").pair
    teeth = family(case.family)
    assembly = assemble(teeth, case.drive)
    for side in SIDES:
        gear_polygon(assembly, side)
        rack_outline(assembly, side)
        tooth_profile(assembly, side)
    slots = pair_slots(assembly)
    cycle = tabulate(assembly, case.materials, case.mesh, slots)
    polynomials(cycle)
    cycle_mean(cycle, quasi_static(cycle, 500.0).normal_load)

    flexible = flexibility(assembly, case.materials, level=1)
    roll = extended_rolls(assembly, assembly.roll_limits, 5)
    gap = np.zeros((*roll.shape, 3))
    shared = LoadedFlanks(flexible, slices=3, coupled=False).share(roll, 500.0, gap=gap)
    condense(flexible, pair_geometry(assembly, roll), gap, shared, 1.0, coupled=False)

    def traced(module: jax.Array) -> jax.Array:
        changed = assemble(teeth, case.drive._replace(module=module))
        kinematics(changed.path, jnp.zeros(3))
        table = tabulate(changed, case.materials, case.mesh, slots)
        return quasi_static(table, 500.0).deflection

    jax.make_jaxpr(traced)(case.drive.module)
    chebyshev_basis(jnp.zeros((2, 3)), 4)

    oscillator = load_scenario("backlash-oscillator", {"frequency": {"from": 0.7, "to": 0.9, "step": 0.1}})
    frequency_response(oscillator)
    period_map = oscillator_at(oscillator, np.ones(2))

    wrong = {
        "one state for several": lambda: shoot(period_map, np.zeros(2), np.arange(2), 1, 1e-7),
        "a vector for a scalar": lambda: contact_ratio(assembly.path, np.zeros(2), 1.0, 23.0),
        "whole numbers for floats": lambda: distance_at_radius(assembly.path, np.arange(3)),
        "a missing axis": lambda: cycle_mean(cycle, np.zeros(5)),
        "axes that do not fit together": lambda: section_integrals(np.ones(25), np.ones(24), 0.0),
    }
    for what, call in wrong.items():
        try:
            call()
        except TypeCheckError:
            continue
        raise AssertionError(f"{what} passes unseen")


if __name__ == "__main__":
    main()
