"""The train for a page: its gears roll in their true positions, arrows are the loads on the driven gears."""

import numpy as np

from tribodyn.post.page.motion import Body, Mechanism, Sight
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.carried_sets import CarriedSet, carriers, driver_of, sets_of
from tribodyn.studies.motion.drivetrain.gear_positions import (
    GearOutline,
    axes_of,
    contacts,
    gear_outlines,
    gear_poses,
    mesh_reach,
    reaches,
    shifts,
)

#: Arrow of the largest load, as a share of half the height that is seen of one mesh.
_ARROW = 0.6
#: Width over height of what a page shows, and room about it.
_WIDE, _ROOM = 1.5, 1.03
#: Cover of a gear, so that those behind it are seen.
_OPACITY = 0.75
#: Width of the lines of a carrier, as a share of the distance of its planets.
_CARRIER = 0.03
_BETWEEN = np.full((1, 2), np.nan)


def rolling_train(record: Record) -> Mechanism:
    """All gears, the largest behind; contacts without load, mesh after mesh, the newest pair first."""
    gears, stand, sense = gear_outlines(record), gear_poses(record), record.geometry["sense"]
    sets, axes = sets_of(record), axes_of(record, 0)
    frames = {gearset.carrier: number for number, gearset in enumerate(sets)}
    bodies = [_carrier(record, gearset, axes) for gearset in sets]
    of_gear: dict[int, int] = {}
    for gear in gears:
        of_gear[gear.number] = len(bodies)
        fill = "pinion" if sense[gear.body] == sense[0] else "gear"
        bodies.append(Body(_area(gear), stand[gear.number], fill, opacity=_OPACITY))
    where = reaches(record)
    where[:, :2] += shifts(record)
    whole = _sight("the whole train", where)
    sights = [whole]
    for gearset in sets:
        around = _sight(
            f"the set {gearset.name}", where[[gear.number for gear in gears if gear.body in gearset.meshes]]
        )
        sights += [around] if len(set(record.geometry["plane"].tolist())) > 1 else []
        turns = (float(axes[gearset.carrier, 0]), float(axes[gearset.carrier, 1]), frames[gearset.carrier])
        sights.append(around._replace(label=f"{around.label} from its carrier", turns=turns))
    for m, mesh in enumerate(record["mesh"]):
        ends = [of_gear[int(record.geometry[f"{end}_gear"][m])] for end in ("driver", "driven")]
        (x, y), reach = mesh_reach(record, m)
        sights.append(Sight(f"the mesh {mesh}", x, y, reach, ends))
        carrier = int(carriers(record)[driver_of(record, m)])
        if carrier in frames:
            turns = (float(axes[carrier, 0]), float(axes[carrier, 1]), frames[carrier])
            sights[-1] = sights[-1]._replace(turns=turns)
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


def _area(gear: GearOutline) -> np.ndarray:
    """Lines that bound a gear, NaN between them."""
    return np.concatenate([part for line in gear.edges for part in (_BETWEEN, line)][1:])


def _sight(label: str, where: np.ndarray) -> Sight:
    """What shows circles, (n, 3): centre and radius."""
    centres, radii = where[:, :2], where[:, 2:]
    low, high = np.min(centres - radii, axis=0), np.max(centres + radii, axis=0)
    (x, y), (width, height) = (low + high) / 2.0, (high - low) / 2.0
    return Sight(label, float(x), float(y), _ROOM * max(height, width / _WIDE))


def _carrier(record: Record, gearset: CarriedSet, axes: np.ndarray) -> Body:
    """The frame of a set as lines from its axis to its planets."""
    centre = record.geometry["centre"]
    pins = [centre[planet] - centre[gearset.carrier] for planet in gearset.planets]
    outline = np.concatenate([[[0.0, 0.0], pin] for pin in pins])
    turned = record.geometry["carried"][gearset.carrier] * record["reference_angle"]
    pose = np.column_stack([np.broadcast_to(axes[gearset.carrier], (len(turned), 2)), turned])
    return Body(outline, pose, "ring", width=_CARRIER * float(np.hypot(*pins[0])))
