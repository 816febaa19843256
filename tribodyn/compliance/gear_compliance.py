"""What the flanks of one gear give way: the result of its finite elements, without them."""

from typing import Any, NamedTuple

Array = Any

#: Teeth on either side whose compliances are kept: as many pairs as can touch beside the loaded one.
NEIGHBOURS = 2


class GearCompliance(NamedTuple):
    """Compliances of a gear's flanks in plane strain, for unit Young's modulus and width.

    Multiply by 1/(E b) for m/N. M positions along the flank, from the fillet to the tip.

    Attributes
    ----------
    radius : (M,)
        Distance of the positions from the axis, m, increasing.
    inside : (2, M)
        Displacement, along the load, of the points at the depth and at twice the depth below a loaded
        position.
    between : (2 NEIGHBOURS + 1, M, M)
        Displacement at position i of the flank k − NEIGHBOURS pitches towards +y of the tooth's frame, the
        side of the loaded flank, per load at position j; infinite in truth for the tooth itself where i = j.
    depth : float
        Depth below the surface to which `inside` refers, m.
    """

    radius: Array
    inside: Array
    between: Array
    depth: float
