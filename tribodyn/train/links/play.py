"""A coupling or spline with play: free within it, linear beyond.

Where flanks of the coupling touch, torque and damping set in over a width w about the end of the play, as
(x + w/2)²/(2w), x the twist beyond that end: the torque is C1, and from x = w/2 on that of a spring which
begins to act at the end of the play. Nothing is located: within the width integrators see a
torque whose slope changes by the whole stiffness, and shorten their steps.
"""

from typing import Any, NamedTuple

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import law, maximum, minimum, where
from tribodyn.numerics.parameter import Parameter
from tribodyn.train.links.law import LinkLaw


class Play(NamedTuple):
    """Values of the keys, see `LAW`."""

    play: Any
    contact_share: Any


def checked(_inputs: Any, **values: Any) -> Play:
    """Make the parameters; raises InputError where contact would set in before the play is half used."""
    if values["contact_share"] > 1.0:
        key, rule = "link.contact_share", "contact sets in over no more than the whole play"
        raise InputError(key, values["contact_share"], rule, "give at most 1, such as 0.01")
    return Play(**values)


@law
def with_play(twist, stiffness, parameters):
    """Torque of a spring that acts beyond half the play to either side, its energy, and damping with it."""
    width = parameters.contact_share * parameters.play
    beyond = maximum(where(twist < 0.0, -twist, twist) - 0.5 * (parameters.play - width), 0.0)
    inside = minimum(beyond, width)
    share = inside / width
    further = beyond - inside
    torque = stiffness * (0.5 * share * inside + further)
    energy = stiffness * (share * inside * inside / 6.0 + 0.5 * (width + further) * further)
    return where(twist < 0.0, -torque, torque), energy, share


LAW = LinkLaw(
    "play",
    "no torque and no damping within play, linear beyond: a coupling or spline with backlash",
    with_play,
    checked,
    keys=(
        Parameter("play", "angle", "by which one end turns freely against the other", example='"0.2 deg"'),
        Parameter(
            "contact_share",
            "number",
            "share of the play over which contact sets in, at most 1",
            default=1e-3,
            source="tests/cross/test_link_motion.py: a rattling coupling is within 1e-4 of sharp contact",
            allowed="positive",
        ),
    ),
)
