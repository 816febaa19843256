"""What `check` says of film and friction law: their ranges, and where the nominal duty leaves them."""

from typing import Any

import numpy as np

from tribodyn.post.report import exceeded
from tribodyn.studies.protocol.study import Checked, TextTable
from tribodyn.tribology.closure import (
    Lubricated,
    duty_range,
    exceeded_limits,
    law_figures,
    laws_of,
    nominal_line_load,
)
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.law import Closure
from tribodyn.tribology.surface_state import range_shares

#: Name of a law in messages, by what it is a law of.
_NAMES = {"closure_exceeded": "film law", "friction_exceeded": "friction law"}


def with_laws(checked: Checked, case: Lubricated, closure: Closure) -> Checked:
    """Return what `check` says with the laws in use added, under the key `laws`.

    Where the duty has a load and a speed, the limits are those exceeded along the path of contact by a pair
    that carries the whole torque alone, without vibration.
    """
    outside = _exceeded(case, closure)
    rows = [(law.table, law.name, law.stated or "none stated") for law in laws_of(case)]
    said = [one for name, law in _NAMES.items() for one in exceeded(outside, name, law)]
    return checked._replace(
        data={**checked.data, "laws": {**law_figures(case), **outside}},
        tables=(*checked.tables, TextTable("Laws and their ranges", ("", "law", "range"), rows)),
        remarks=(*checked.remarks, *said),
    )


def _exceeded(case: Lubricated, closure: Closure) -> dict[str, Any]:
    if not case.operating.gear_torque or not case.operating.pinion_speed:
        return {}
    duty = duty_range(case)
    entrainment, curvature, ratio = np.array(duty.places).T
    sliding = ratio * entrainment
    speeds = entrainment + 0.5 * sliding, entrainment - 0.5 * sliding
    contact = local_contact(nominal_line_load(duty), curvature, entrainment, sliding, *speeds)
    return exceeded_limits(case, *range_shares(contact, closure))
