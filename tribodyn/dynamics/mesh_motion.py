"""Where a mesh stands in its table, and how its two bodies move against each other. For all compilers."""

from tribodyn.dynamics.approach import MeshPlace, Motion
from tribodyn.numerics.elementary import law, maximum, minimum, truncate
from tribodyn.train.schedule import phase_of
from tribodyn.train.structure import (
    ACROSS,
    ALONG_Z,
    AXIAL,
    IN_SPACE,
    LEAN_ACROSS,
    LEAN_ALONG,
    TOWARDS,
    driven_arm,
    driver_arm,
    place_in_space,
    rolling_ratio,
    shifted,
    shifting,
    slip_of,
    speed_of,
    turned,
    turning,
)


@law
def locate(phase, segment, driver_tooth, driven_tooth, table):
    """`MeshPlace` at a phase of a mesh (0 … 1) inside a segment of its table; numbers of the latest teeth."""
    start = table.boundary[segment]
    cells = table.channel.shape[1]
    cells_per_cycle = cells / (table.boundary[segment + 1] - start)
    position = minimum(maximum((phase - start) * cells_per_cycle, 0.0), cells - 1e-9)
    cell = truncate(position)
    return MeshPlace(
        segment, cell, position - cell, cells_per_cycle / table.pitch_angle, phase, driver_tooth, driven_tooth
    )


@law
def latest_teeth(m, interval, model):
    """Numbers of the teeth of a mesh that entered last, driver's and driven gear's; 0 where all are alike."""
    return model.schedule.driver_tooth[interval, m], model.schedule.driven_tooth[interval, m]


@law
def place_in_mesh(m, phase, interval, model):
    """`MeshPlace` of a mesh at a phase of the reference in an interval of the schedule."""
    schedule = model.schedule
    segment = truncate(schedule.segment[interval, m])
    one, two = latest_teeth(m, interval, model)
    return locate(phase_of(phase, interval, m, schedule), segment, one, two, model.meshes[m].table)


@law
def motion_of(m, y, model):
    """`Motion` of the two bodies of a mesh."""
    layout = model.options.layout
    mesh = model.meshes[m]
    driver, driven = layout.driver[m], layout.driven[m]
    x = shifted(driver, 0, y, layout) - shifted(driven, 0, y, layout)
    z = shifted(driver, 1, y, layout) - shifted(driven, 1, y, layout)
    x_rate = shifting(driver, 0, y, layout) - shifting(driven, 0, y, layout)
    z_rate = shifting(driver, 1, y, layout) - shifting(driven, 1, y, layout)
    turn = driver_arm(mesh) * turned(driver, y, layout) - driven_arm(mesh) * turned(driven, y, layout)
    turning_rate = driver_arm(mesh) * turning(driver, y, layout)
    turning_rate = turning_rate - driven_arm(mesh) * turning(driven, y, layout)
    along, along_rate = mesh.along_x * x + mesh.along_y * z, mesh.along_x * x_rate + mesh.along_y * z_rate
    across, across_rate = (
        mesh.across_x * x + mesh.across_y * z,
        mesh.across_x * x_rate + mesh.across_y * z_rate,
    )
    zero = 0.0 * y[0]
    reference = model.operation.nominal_speed + slip_of(y, layout)
    if layout.spatial > 0:
        along = along + tilted(TOWARDS, m, 0, y, model)
        across = across + tilted(ACROSS, m, 0, y, model)
        along_rate = along_rate + tilted(TOWARDS, m, layout.half, y, model)
        across_rate = across_rate + tilted(ACROSS, m, layout.half, y, model)
    if layout.modes > 0:
        along = along + by_rim(TOWARDS, m, 0, y, model)
        across = across + by_rim(ACROSS, m, 0, y, model)
        along_rate = along_rate + by_rim(TOWARDS, m, layout.half, y, model)
        across_rate = across_rate + by_rim(ACROSS, m, layout.half, y, model)
    return Motion(
        turn + along,
        across,
        along_rate,
        turning_rate,
        across_rate,
        mesh.driver_sense * (speed_of(driver, y, model) - mesh.driver_carried * reference),
        mesh.driven_sense * (speed_of(driven, y, model) - mesh.driven_carried * reference),
        rolling_ratio(m, model) * reference,
        tilted(ALONG_Z, m, 0, y, model) if layout.spatial > 0 else zero,
        tilted(LEAN_ALONG, m, 0, y, model) if layout.spatial > 0 else zero,
        tilted(LEAN_ACROSS, m, 0, y, model) if layout.spatial > 0 else zero,
        tilted(ALONG_Z, m, layout.half, y, model) if layout.spatial > 0 else zero,
        tilted(LEAN_ALONG, m, layout.half, y, model) if layout.spatial > 0 else zero,
        tilted(LEAN_ACROSS, m, layout.half, y, model) if layout.spatial > 0 else zero,
    )


@law
def tilted(which, m, first, y, model):
    """One of a mesh's `MOVES` by z and tilts of its bodies, m, rad; `first` is 0, or `half` for the rate."""
    layout, mesh = model.options.layout, model.meshes[m]
    total = 0.0 * y[0]
    for direction in range(AXIAL, IN_SPACE):
        if layout.driver[m] < layout.spatial:
            place = first + place_in_space(layout.driver[m], direction, layout)
            total = total + mesh.moves[0, which, direction] * y[place]
        if layout.driven[m] < layout.spatial:
            place = first + place_in_space(layout.driven[m], direction, layout)
            total = total + mesh.moves[1, which, direction] * y[place]
    return total


@law
def by_rim(which, m, first, y, model):
    """`TOWARDS` or `ACROSS` by the coordinates of a rim, m; `first` is 0, or `half` for the rate."""
    layout, mesh = model.options.layout, model.meshes[m]
    total = 0.0 * y[0]
    for e in range(layout.rim_count[m]):
        total = total + mesh.rim[which, e] * y[first + layout.rim_first[m] + e]
    return total


@law
def on_body(end, direction, along, across, axial, leaning_along, leaning_across, mesh):
    """Force or moment on x, y, z or a tilt (0 … 4) of a mesh's driver or driven body (0, 1).

    Of what acts on the driver as `MOVES` go.
    """
    moves = mesh.moves
    return (
        moves[end, TOWARDS, direction] * along
        + moves[end, ACROSS, direction] * across
        + moves[end, ALONG_Z, direction] * axial
        + moves[end, LEAN_ALONG, direction] * leaning_along
        + moves[end, LEAN_ACROSS, direction] * leaning_across
    )
