"""Where Jia et al. find the largest stresses on a pair's way through the mesh, and where ours are."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

#: Share of the way from the pitch point to the last contact within which a place is near either of them.
NEAR = 0.25


class Passage(NamedTuple):
    """What one pair of teeth goes through, over increasing pinion angle (point,), maximum over the face."""

    roll: np.ndarray  # pinion angle from the pitch point, rad
    line_load: np.ndarray  # N/m
    pressure: np.ndarray  # maximum Hertz pressure, Pa
    #: compression, tension: maximum root stress of both gears, Pa, as amounts
    compression: np.ndarray
    tension: np.ndarray

    def place(self, name: str) -> float:
        """Where a quantity is largest: from the pitch point, 0, to the last contact, 1; < 0 before it."""
        return float(self.roll[int(np.argmax(getattr(self, name)))] / self.roll[self.line_load > 0.0][-1])


def positions(
    involute: Passage, parabolic: Passage, relieved: Sequence[Passage]
) -> dict[str, tuple[bool, str]]:
    """Claims of §4.2.2 and §4.2.3 about unmodified gears and about parabolic ones with relief."""
    stresses = ("line_load", "compression", "tension")
    middle = [involute.place(name) for name in stresses]
    contact = [passage.place("line_load") for passage in relieved]
    exits = {name: [one.place(name) for one in (parabolic, *relieved)] for name in stresses[1:]}
    prefix = "jia/claim-"

    def text_of(places: Sequence[float]) -> str:
        return ", ".join(f"{place:+.2f}" for place in places) + " of the way from P to the last contact"

    return {
        f"{prefix}involute-largest-near-the-middle": (
            all(abs(place) <= NEAR for place in middle),
            f"line load, compression, tension at {text_of(middle)}",
        ),
        f"{prefix}contact-largest-near-the-pitch-circle": (
            all(abs(place) <= NEAR for place in contact),
            f"line load of the relieved gears at {text_of(contact)}",
        ),
        **{
            f"{prefix}{name}-largest-before-the-exit": (
                all(place >= 1.0 - NEAR for place in places),
                f"unmodified, then relieved at {text_of(places)}",
            )
            for name, places in exits.items()
        },
    }
