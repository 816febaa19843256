"""Bearings in time, alone and on drawn shafts of gears."""

from types import SimpleNamespace
from typing import Any

import numpy as np

from tests.support.drawn_shafts import BALL, ROLLER
from tribodyn.numerics.elementary import RuntimeIndices
from tribodyn.train.bearing_forces import IN_TIME, bearing_answer
from tribodyn.train.elastic.in_time import row_in_time
from tribodyn.train.elastic.rolling_bearing import BallRow, RollerRow
from tribodyn.train.structure import BearingNumbers

#: A cage that turns with the reference, once in a turn.
_BODY = SimpleNamespace(ratio=np.ones(1))


def alone(row: BallRow | RollerRow, moved: Any, angle: Any = 0.0) -> Any:
    """What a bearing answers to a displacement while its cage stands at an angle; see `bearing_answer`."""
    made = row_in_time(row)
    forces = IN_TIME._replace(
        number=1,
        places=RuntimeIndices([0, 1, 2, 3, 4, 0, 0, 0, 0, 0]),
        bodies=RuntimeIndices([0]),
        types=RuntimeIndices([made.type]),
        elements=RuntimeIndices([0, len(made.around)]),
        points=RuntimeIndices([0, len(made.point)]),
    )
    numbers = BearingNumbers(
        moves=np.array([[1.0] * 5 + [0.0] * 5]),
        cage=np.ones(1),
        constant=np.array([made.constant]),
        apart=np.array([made.apart]),
        normal=np.array([made.normal]),
        around=made.around,
        point=made.point,
    )
    options: Any = SimpleNamespace(bearings=forces, layout=SimpleNamespace(planar=1))
    model = SimpleNamespace(options=options, bodies=_BODY, links=SimpleNamespace(bearings=numbers))
    return bearing_answer(0, angle, moved, model)


def on_bearings(*bearings: dict[str, Any], force: str = "in-time") -> dict[str, Any]:
    """A straight shaft with its gear in the middle, on bearings at both ends."""
    places = ("15 mm", "105 mm")
    held = [one | {"position": place, "force": force} for one, place in zip(bearings, places, strict=True)]
    section = [{"length": "120 mm", "diameter": "42 mm"}]
    return {"gear_position": "60 mm", "section": section, "bearing": held}


def shafts_of(second: dict[str, Any] = ROLLER, force: str = "in-time") -> dict[str, Any]:
    """Both shafts of a pair on a ball bearing and a second one."""
    return {side: on_bearings(BALL, second, force=force) for side in ("pinion", "gear")}
