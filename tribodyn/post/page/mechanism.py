"""Bodies of a mechanism and the loads between them, as a page moves them with its cursor."""

from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from tribodyn.post.page.data import packed

#: Positions that are kept, evenly over the run, at least, and of all bodies and contacts together.
MOST_FRAMES, MOST_PLACES = 1500, 60_000


class Body(NamedTuple):
    """A body: its outline about its own centre, and where it is."""

    outline: np.ndarray  # (points, 2), m; NaN between closed lines that bound one area
    pose: np.ndarray  # (samples, 3); x and y of the centre, m, and rotation, rad, anticlockwise
    fill: Literal["pinion", "gear", "paper", "ring"]  # colour of the page; a ring is a line of `width`
    width: float = 0.0  # m
    opacity: float = 1.0  # of its area


class Sight(NamedTuple):
    """A part of a mechanism to look at."""

    label: str
    x: float  # middle, m
    y: float
    reach: float  # half of what is seen in height, m
    front: Sequence[int] = ()  # numbers of the bodies that lie in front then
    #: x and y (m) about which it turns with a body, and the number of that body; -1: it stands still
    turns: tuple[float, float, int] = (0.0, 0.0, -1)


class Mechanism(NamedTuple):
    """What a page shows of a mechanism, as a study describes it."""

    title: str  # heading of the section
    bodies: Sequence[Body]  # the one that lies in front comes last
    load: str  # dataset of the loads, by which arrows are as long; a curve for each contact
    contacts: np.ndarray  # (samples, contacts, 3); x, y, m, and direction of the load, rad
    reach: float  # half of what is seen in height, m
    longest: float  # length of the arrow of the largest load, m; shorter where less than `reach` is seen
    sights: Sequence[Sight] = ()  # to choose from; none: all of it


def mechanism_data(mechanism: Mechanism) -> dict[str, Any]:
    """A mechanism as the page reads it."""
    samples = len(mechanism.contacts)
    most = max(MOST_FRAMES, MOST_PLACES // (len(mechanism.bodies) + mechanism.contacts.shape[1]))
    frames = np.unique(np.linspace(0, samples - 1, min(samples, most)).round().astype(int))
    x, y, alpha = np.moveaxis(mechanism.contacts[frames], -1, 0)
    bodies = [
        {
            "outline": packed(body.outline),
            "pose": packed(body.pose[frames]),
            "fill": body.fill,
            "width": body.width,
            "opacity": body.opacity,
        }
        for body in mechanism.bodies
    ]
    return {
        "frames": None if len(frames) == samples else packed(frames, "<u4"),
        "title": mechanism.title,
        "bodies": bodies,
        "pairs": x.shape[1],
        "x": packed(x),
        "y": packed(y),
        "alpha": packed(alpha),
        "reach": mechanism.reach,
        "longest": mechanism.longest,
        "sights": [sight._asdict() for sight in mechanism.sights],
    }
