"""The train for a page: its gears roll in their true positions, arrows are the loads on the driven gears."""

import numpy as np

from tribodyn.post.page.mechanism import Body, Mechanism, Sight
from tribodyn.record.reader import Record
from tribodyn.studies.gear_train.described.places import contacts, gear_outlines, mesh_reach, poses

#: Arrow of the largest load, as a share of half the height that is seen of one mesh.
_ARROW = 0.6
#: Width over height of what a page shows, and room about it.
_WIDE, _ROOM = 1.5, 1.03
#: Cover of a gear, so that those behind it are seen.
_OPACITY = 0.75


def mechanism(record: Record) -> Mechanism:
    """All gears, the largest behind; contacts without load, mesh after mesh, the newest pair first."""
    gears, stand, sense = gear_outlines(record), poses(record), record.geometry["sense"]
    bodies: list[Body] = []
    of_gear: dict[int, list[int]] = {}
    for gear in gears:
        fill = "pinion" if sense[gear.body] == sense[0] else "gear"
        parts = [Body(gear.outline, stand[gear.body], fill, opacity=_OPACITY)]
        if gear.bore_radius > 0.0:
            parts.append(Body(gear.bore_radius * _CIRCLE, stand[gear.body], "paper"))
        of_gear[gear.number] = list(range(len(bodies), len(bodies) + len(parts)))
        bodies += parts
    centres = np.array([record.geometry["centre"][gear.body] for gear in gears])
    tips = np.array([[gear.tip_radius] for gear in gears])
    low, high = np.min(centres - tips, axis=0), np.max(centres + tips, axis=0)
    x, y = (low + high) / 2.0
    width, height = (high - low) / 2.0
    whole = Sight("the whole train", float(x), float(y), _ROOM * max(height, width / _WIDE))
    sights = [whole]
    for m, mesh in enumerate(record["mesh"]):
        (x, y), reach = mesh_reach(record, m)
        ends = (int(record.geometry[f"{end}_gear"][m]) for end in ("driver", "driven"))
        sights.append(Sight(f"the mesh {mesh}", x, y, reach, [n for gear in ends for n in of_gear[gear]]))
    carried = np.any(np.isfinite(record["normal_load"]), axis=0)[:, ::-1]
    places = contacts(record)[:, :, ::-1][:, carried]
    return Mechanism(
        "The train in its true positions",
        bodies,
        "normal_load",
        places,
        whole.reach,
        _ARROW * whole.reach,
        sights,
    )


_TURN = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)
_CIRCLE = np.stack([np.cos(_TURN), np.sin(_TURN)], axis=-1)
