"""A motor's torque over the speed of the body that it turns. For all compilers.

A straight line about the nominal speed, or a monotone C1 curve through points that goes on straight beyond
them: how a motor holds a load that turns it backwards, and brakes above its no-load speed.
"""

from tribodyn.numerics.elementary import law
from tribodyn.numerics.smooth import cubic_rise, cubic_rise_slope, place_between
from tribodyn.train.structure import slip_of_body, speed_of


@law
def torque_at(speed, slip, operation):
    """Torque of the motor, N m, and its slope, N m s/rad, at a speed, `slip` above the nominal one, rad/s."""
    torque = operation.drive_torque - operation.speed_regulation * slip
    slope = 0.0 * slip - operation.speed_regulation
    if operation.motor_speeds.shape[0] > 1:
        i, width, u = place_between(operation.motor_speeds, speed)
        start, end = operation.motor_torques[i], operation.motor_torques[i + 1]
        out, back = operation.motor_slopes[i] * width, operation.motor_slopes[i + 1] * width
        along = cubic_rise_slope(u, end - start, out, back) / width
        beyond = speed - (operation.motor_speeds[i] + u * width)
        torque = torque + start + cubic_rise(u, end - start, out, back) + along * beyond
        slope = slope + along
    return torque, slope


@law
def motor_torque(body, y, model):
    """The same of a motor that turns a body."""
    return torque_at(speed_of(body, y, model), slip_of_body(body, y, model), model.operation)
