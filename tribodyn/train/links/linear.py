"""A spring and a damper, both linear."""

from tribodyn.numerics.elementary import law
from tribodyn.train.links.law import LinkLaw


@law
def linear(twist, stiffness, parameters):
    """Torque k s, its energy, and all of the damping."""
    return stiffness * twist, 0.5 * stiffness * twist * twist, 1.0


LAW = LinkLaw("linear", "torque and damping linear in twist and its rate", linear)
