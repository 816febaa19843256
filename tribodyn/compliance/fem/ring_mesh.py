"""Structured quadrilaterals over one tooth and its share of the ring: a sector of the full gear.

Half a sector has a layer along its profile, flank, fillet and root circle, whose cells stand square to it,
and three blocks inside the layer that meet under the middle of the fillet: the tooth above, the body under
the tooth and the body under the gap. Each of these is the transfinite (Coons) map of its four edges. The
other half is the mirror image, and the full gear is the sector repeated, node on node.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from tribodyn.geometry.tooth import Tooth, fillet_point, flank_point
from tribodyn.numerics.shapes import Array, Float

#: Cells at level 1: along the flank, along the upper and the lower half of the fillet with the root circle,
#: across the layer, across half the tooth inside it, and from there to the bore.
_FLANK, _FILLET, _ROOT, _LAYER, _ACROSS, _DEPTH = 10, 2, 4, 1, 4, 6
_CURVE_POINTS = 400
# Thickness of the layer, as a share of half the tooth's thickness at the foot, at the root and at the tip.
_LAYER_ROOT, _LAYER_TIP = 0.25, 0.1
# Never more than these shares of half the tip's thickness, and of the rim's.
_TIP_SHARE, _RIM_SHARE = 0.3, 0.2
# Times that the layer's direction is averaged with its neighbours': a corner in the profile is rounded off.
_SMOOTHING = 4
# Ratio of the cells' widths, flank to middle of the tooth, and of their depths, bore to root: the latter at
# least, and per pitch of the body's depth, so that a deep body's first cells are no wider than a tooth needs.
_ACROSS_GRADING = 0.45
_DEPTH_GRADING, _DEPTH_GRADING_PER_PITCH = 4.0, 1.5
# The seam from the fillet to the tooth's axis drops by this share of its length, which gives each of the
# three blocks about a third of the straight angle at their common corner.
_SEAM_DROP = 0.35


class SectorMesh(NamedTuple):
    """Curved cells of nine nodes over half a sector, or one; x along the tooth's axis, loaded flank at +y."""

    nodes: Float[Array, "2 node"]  # m
    #: (9, C), node numbers: corners counter-clockwise, middles of the edges that follow them, centre
    cells: NDArray[np.int64]
    flank: NDArray[np.int64]  # (M,), corner nodes on the flank y > 0, from the fillet to the tip
    #: (2 R + 1,), corner and middle nodes of R edges on the side y > 0, from the middle of the gap along the
    #: root circle and the fillet to the flank's first
    root: NDArray[np.int64]


def half_sector_cells(level: int) -> tuple[int, int, int, int]:
    """Numbers of cells: all, and of those the ones along the flank, the root and the sector's edge."""
    root = _ROOT + _FILLET
    whole = (_FLANK + root) * _LAYER + (_FLANK + _FILLET + _DEPTH) * _ACROSS + _ROOT * _DEPTH
    return whole * level**2, _FLANK * level, root * level, (_LAYER + _DEPTH) * level


def half_sector_mesh(tooth: Tooth, teeth: int, bore_radius: float, level: int) -> SectorMesh:
    """Mesh the half y ≥ 0 of one tooth's sector; `level` multiplies the cells in both directions."""
    return joined(half_blocks(tooth, teeth, bore_radius, level), level)


def joined(blocks: list[Float[Array, "_row _column 2"]], level: int) -> SectorMesh:
    """Join blocks of nodes, of which the first has the profile as its first row."""
    points, cells, numbers = [], [], []
    count = 0
    for block in blocks:
        rows, columns, _ = block.shape
        number = count + np.arange(rows * columns).reshape(rows, columns)
        ring = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)]
        cells.append(
            np.stack([number[i : rows - 2 + i : 2, j : columns - 2 + j : 2].ravel() for i, j in ring])
        )
        points.append(block.reshape(-1, 2))
        numbers.append(number)
        count += rows * columns
    nodes, merged = _merge(np.concatenate(points))
    profile, root = merged[numbers[0][0]], 2 * (_ROOT + _FILLET) * level
    return SectorMesh(
        nodes.T.copy(),
        _counter_clockwise(nodes, merged[np.concatenate(cells, axis=1)]),
        profile[root::2],
        profile[: root + 1],
    )


def half_blocks(
    tooth: Tooth, teeth: int, bore_radius: float, level: int
) -> list[Float[Array, "_row _column 2"]]:
    """Nodes (rows, columns, 2) of the layer, whose first row is the profile, and of the three blocks."""
    boundary = _profile(tooth, teeth, level)
    inner = _below(boundary, tooth, teeth, bore_radius)
    across_layer = np.linspace(0.0, 1.0, 2 * _LAYER * level + 1)[:, None, None]
    layer = boundary + across_layer * (inner - boundary)

    # every second node is the middle of an edge
    across, depth, roots = 2 * _ACROSS * level, 2 * _DEPTH * level, 2 * _ROOT * level
    gap, profile = inner[: roots + 1], inner[roots:]
    towards_axis = graded(across, _ACROSS_GRADING)
    corner = profile[0]
    # over a thin rim it drops less, so as not to meet the bore
    middle_of_rim = (bore_radius + float(signed_polar(corner, teeth)[0])) / 2.0
    seam_end = np.array([max(corner[0] - _SEAM_DROP * corner[1], middle_of_rim), 0.0])
    seam = corner + towards_axis[:, None] * (seam_end - corner)
    tip_angle = float(signed_polar(profile[-1], teeth)[1])
    tip = tooth.tip_radius * _unit(tip_angle * (1 - towards_axis))
    height = _length(profile) / _length(profile)[-1]
    axis = seam_end + height[:, None] * (tip[-1] - seam_end)
    upper = _coons(seam, tip, profile, axis)

    foot = np.pi / teeth * across / (across + roots)
    pitches = (tooth.root_radius - bore_radius) / (2.0 * np.pi / teeth * tooth.root_radius)
    inwards = graded(depth, max(_DEPTH_GRADING, _DEPTH_GRADING_PER_PITCH * pitches))
    edge = gap[0] + inwards[:, None] * (bore_radius * _unit(np.pi / teeth) - gap[0])
    middle = corner + inwards[:, None] * (bore_radius * _unit(foot) - corner)
    centre = seam_end + inwards[:, None] * (np.array([bore_radius, 0.0]) - seam_end)
    under_gap = _coons(gap, bore_radius * _unit(np.linspace(np.pi / teeth, foot, roots + 1)), edge, middle)
    under_tooth = _coons(seam, bore_radius * _unit(foot * (1 - towards_axis)), middle, centre)
    return [layer, upper, under_gap, under_tooth]


def _profile(tooth: Tooth, teeth: int, level: int) -> Float[Array, "column 2"]:
    """Nodes (columns, 2) from the middle of the gap along root circle, fillet and flank to the tip."""
    along = np.linspace(0.0, 1.0, _CURVE_POINTS)
    fillet = np.stack(fillet_point(tooth, np.pi / 2 + along * (tooth.form_angle - np.pi / 2)), axis=-1)
    flank = np.stack(
        flank_point(tooth, tooth.form_distance + along * (tooth.tip_distance - tooth.form_distance)), axis=-1
    )
    first = float(signed_polar(fillet[0], teeth)[1])
    root = tooth.root_radius * _unit(np.linspace(np.pi / teeth, first, _CURVE_POINTS))
    lengths = _length(fillet)
    split = int(np.searchsorted(lengths, 0.5 * lengths[-1]))
    parts = [
        _spread(curve, np.linspace(0, 1, 2 * cells * level + 1))
        for curve, cells in (
            (np.concatenate([root[:-1], fillet[: split + 1]]), _ROOT),
            (fillet[split:], _FILLET),
            (flank, _FLANK),
        )
    ]
    return np.concatenate([parts[0][:-1], parts[1][:-1], parts[2]])


def _below(
    boundary: Float[Array, "column 2"], tooth: Tooth, teeth: int, bore_radius: float
) -> Float[Array, "column 2"]:
    """Inner side (columns, 2) of the layer under the profile's nodes."""
    tip_angle = float(signed_polar(boundary[-1], teeth)[1])
    share = _length(boundary) / _length(boundary)[-1]
    radius, angle = signed_polar(boundary.T, teeth)
    order = np.argsort(radius)
    foot = tooth.form_radius * np.sin(np.interp(tooth.form_radius, radius[order], angle[order]))
    rim = _RIM_SHARE * (tooth.root_radius - bore_radius)
    at_root = min(_LAYER_ROOT * foot, rim)
    at_tip = min(_LAYER_TIP * foot, rim, _TIP_SHARE * tooth.tip_radius * tip_angle)
    thickness = np.interp(share, [0.0, 1.0], [at_root, at_tip])
    tangent = np.gradient(boundary, axis=0)
    inwards = np.stack([tangent[:, 1], -tangent[:, 0]], axis=-1)
    inwards /= np.linalg.norm(inwards, axis=1, keepdims=True)
    # at the gap along the sector's edge, at the tip along the tip circle
    inwards[0] = -_unit(np.pi / teeth)
    along_tip = np.array([np.sin(tip_angle), -np.cos(tip_angle)])
    bent = np.clip(2.0 * share - 1.0, 0.0, 1.0)[:, None]
    inwards = (1.0 - bent) * inwards + bent * along_tip
    for _ in range(_SMOOTHING):
        inwards[1:-1] = (inwards[:-2] + 2.0 * inwards[1:-1] + inwards[2:]) / 4.0
    inwards /= np.linalg.norm(inwards, axis=1, keepdims=True)
    below = boundary + thickness[:, None] * inwards
    below[-1] = tooth.tip_radius * _unit(tip_angle - thickness[-1] / tooth.tip_radius)
    return below


def signed_polar(place: Float[Array, "2 ..."], teeth: int) -> tuple[Float[Array, "..."], Float[Array, "..."]]:
    """Radius (m) and angle (rad) of places in a tooth's frame; radii about an internal gear are negative."""
    sign = np.sign(teeth)
    return sign * np.hypot(*place), np.arctan2(sign * place[1], sign * place[0])


def _coons(
    first: Float[Array, "column 2"],
    last: Float[Array, "column 2"],
    left: Float[Array, "row 2"],
    right: Float[Array, "row 2"],
) -> Float[Array, "row column 2"]:
    """Fill (rows, columns, 2) between the edges first and last row, left and right column."""
    u = _fraction(left, right)[:, None, None]
    v = _fraction(first, last)[None, :, None]
    corners = (
        (1 - u) * (1 - v) * first[0] + (1 - u) * v * first[-1] + u * (1 - v) * last[0] + u * v * last[-1]
    )
    return (1 - u) * first + u * last + (1 - v) * left[:, None] + v * right[:, None] - corners


def _fraction(first: Float[Array, "point 2"], second: Float[Array, "point 2"]) -> Float[Array, " point"]:
    lengths = _length(first), _length(second)
    return (lengths[0] / lengths[0][-1] + lengths[1] / lengths[1][-1]) / 2


def _length(curve: Float[Array, "point 2"]) -> Float[Array, " point"]:
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])


def _spread(curve: Float[Array, "point 2"], at: Float[Array, " at"]) -> Float[Array, "at 2"]:
    """Points of a curve at fractions of its length."""
    length = _length(curve)
    return np.stack([np.interp(at * length[-1], length, curve[:, k]) for k in range(2)], axis=-1)


def graded(cells: int, ratio: float) -> Float[Array, " point"]:
    """Fractions 0 … 1 of cells that grow evenly: from end to end by `ratio` or its inverse, the larger."""
    middle = (np.arange(cells) + 0.5) / cells
    first, last = (ratio, 1.0) if ratio < 1 else (1.0, ratio)
    width = first * (last / first) ** middle
    return np.concatenate([[0.0], np.cumsum(width)]) / width.sum()


def _unit(angle: Float[Array, "*point"] | float) -> Float[Array, "*point 2"]:
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def _merge(points: Float[Array, "point 2"]) -> tuple[Float[Array, "distinct 2"], NDArray[np.int64]]:
    """Join points that coincide: the distinct points, and the number that each point has among them."""
    near = KDTree(points).query_ball_point(points, 1e-9 * float(np.ptp(points, axis=0).max()))
    _, index, inverse = np.unique([min(same) for same in near], return_index=True, return_inverse=True)
    return points[index], inverse


def _counter_clockwise(nodes: Float[Array, "node 2"], cells: NDArray[np.int64]) -> NDArray[np.int64]:
    a, b, c = (nodes[cells[k]] for k in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    return np.where(area > 0, cells, cells[[0, 3, 2, 1, 7, 6, 5, 4, 8]])
