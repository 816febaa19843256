"""Where a mesh stands in its table, and how its two bodies move against each other. For all compilers."""

from tribodyn.dynamics.contact_forces import MeshPlace, Motion
from tribodyn.numerics.elementary import law, maximum, minimum, truncate
from tribodyn.train.schedule import phase_of
from tribodyn.train.structure import shifted, shifting, slip_of, speed_of, turned, turning


@law
def locate(phase, segment, table):
    """`MeshPlace` at a phase of a mesh (0 … 1) inside a segment of its table."""
    start = table.boundary[segment]
    cells = table.channel.shape[1]
    cells_per_cycle = cells / (table.boundary[segment + 1] - start)
    position = minimum(maximum((phase - start) * cells_per_cycle, 0.0), cells - 1e-9)
    cell = truncate(position)
    return MeshPlace(segment, cell, position - cell, cells_per_cycle / table.pitch_angle)


@law
def place_in_mesh(m, phase, interval, model):
    """`MeshPlace` of a mesh at a phase of the reference in an interval of the schedule."""
    schedule = model.schedule
    segment = truncate(schedule.segment[interval, m])
    return locate(phase_of(phase, interval, m, schedule), segment, model.meshes[m].table)


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
    turn = mesh.driver_radius * turned(driver, y, layout) - mesh.driven_radius * turned(driven, y, layout)
    turning_rate = mesh.driver_radius * turning(driver, y, layout)
    turning_rate = turning_rate - mesh.driven_radius * turning(driven, y, layout)
    return Motion(
        turn + mesh.along_x * x + mesh.along_y * z,
        mesh.across_x * x + mesh.across_y * z,
        mesh.along_x * x_rate + mesh.along_y * z_rate,
        turning_rate,
        mesh.across_x * x_rate + mesh.across_y * z_rate,
        speed_of(driver, y, model),
        speed_of(driven, y, model),
        model.bodies.ratio[driver] * (model.operation.nominal_speed + slip_of(y, layout)),
    )
