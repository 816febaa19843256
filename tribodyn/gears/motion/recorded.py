"""What is recorded of a gear pair over time: every dataset's dimensions, unit and meaning."""

from typing import Any

import numpy as np

from tribodyn.gears.motion.course import REVOLUTION, of_revolutions
from tribodyn.geometry.body import GEOMETRY
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.record_arrays import described
from tribodyn.numerics.parameter import Variable, datasets_of
from tribodyn.record.schema import TIME, Layout

DOF = ("x_p", "y_p", "x_g", "y_g", "theta_p", "theta_g")
#: And of gears that move in space.
DOF_IN_SPACE = (*DOF, "z_p", "tilt_x_p", "tilt_y_p", "z_g", "tilt_x_g", "tilt_y_g")

PAIR = Variable(
    ("pair",), "1", "pair of teeth: 1 entered last, 0 the one before it; numbers above 1 are back flanks"
)
DOF_SCALE = Variable(
    ("dof",),
    "1",
    "degree of freedom; p pinion, g gear; x along the pitch tangent, y along the centres, z along the axes",
)
SLICE = Variable(("slice",), "m", "middle of a slice, from the middle of the face")

_DATASETS = datasets_of(__package__)
#: What a run records over time. `time` itself is the dimension scale of the first axis.
SAMPLES = _DATASETS["samples"]
#: What is recorded beside that of pairs that are cut into slices.
OF_SLICES = _DATASETS["of_slices"]


def samples_of(slices: int, *, in_space: bool = False) -> dict[str, Variable]:
    """What a run records over time of pairs with so many slices; `in_space`: where one moves in space too."""
    if slices == 1 and not in_space:
        return SAMPLES
    coordinates = "x, y, z in m, theta (rotation) and tilt_x, tilt_y in rad; names in dof"
    moved = Variable(("time", "dof"), "m or rad", f"generalised coordinates: {coordinates}")
    return SAMPLES | {"displacement": moved} | (OF_SLICES if slices > 1 else {})


def pair_numbers(front_pairs: int, pairs: int) -> list[int]:
    """Numbers of the pair slots: the driving flanks end with 1, the back flanks go on from 2."""
    return [slot + 2 - front_pairs for slot in range(pairs)]


def scales_of(cycle: MeshCycle, *, in_space: bool = False) -> dict[str, Any]:
    """Values along the axes of pairs and degrees of freedom, and of slices if there are any.

    Gears in slices move in space, and others do where `in_space` says so.
    """
    side = np.asarray(cycle.pair_side)
    pairs = np.array(pair_numbers(int(np.sum(side > 0)), side.size))
    if cycle.slices == 1:
        return {"pair": pairs, "dof": np.array(DOF_IN_SPACE if in_space else DOF)}
    return {"pair": pairs, "dof": np.array(DOF_IN_SPACE), "slice": np.asarray(cycle.face_position)}


def gears_layout(slices: int, *, in_space: bool = False) -> Layout:
    """Of records over time of pairs with so many slices; see `recorded.samples_of`."""
    scales = {"pair": PAIR, "dof": DOF_SCALE, "revolution": REVOLUTION}
    scales |= {"slice": SLICE} if slices > 1 else {}
    return Layout(
        TIME,
        samples_of(slices, in_space=in_space),
        scales,
        others=of_revolutions(of_train=False),
        groups={"mesh_cycle": described(slices), "geometry": GEOMETRY},
    )


#: Of records over time of spur gears.
LAYOUT = gears_layout(1)
