"""A map of losses as C: a header and a source that look it up, C99, no library beside."""

from collections.abc import Mapping

from tribodyn.errors import InputError, quoted
from tribodyn.exchange.format import MAP, ExchangeFormat, Exported, Written, deviation
from tribodyn.exchange.heading import heading
from tribodyn.exchange.maps.chosen import identifier, numbers, read_numbers
from tribodyn.record.loss_map import GridValues

_HEADER = """#ifndef {guard}_H
#define {guard}_H

/* Torques in N m, speeds in rad/s, temperatures in K. */

/* loss as a torque at the input: linear between the points, constant beyond the ends */
double {name}_drag(double torque, double speed, double oil_temperature);
/* loss, W */
double {name}_power_loss(double torque, double speed, double oil_temperature);
/* torque at the input in the direction of its motion */
double {name}_torque_at_input(double torque, double speed, double oil_temperature);
/* power out over power in, whichever end drives; 0 or less: it locks itself */
double {name}_efficiency(double torque, double speed, double oil_temperature);

#endif
"""

_SOURCE = """#include "{file}.h"

static const double ratio = {ratio:.17g};
static const double oil_temperatures[{t}] = {oil_temperature};
static const double torques[{m}] = {torque};
static const double speeds[{n}] = {speed};
static const double drags[{t}][{m}][{n}] = {drag};

/* number of the interval that holds a value, and the share of it that lies below the value */
static int interval(const double *axis, int size, double value, double *share)
{{
    int low = 0, high = size - 1;
    *share = 0.0;
    if (size == 1 || value <= axis[0])
        return 0;
    if (value >= axis[high]) {{
        *share = 1.0;
        return high - 1;
    }}
    while (high - low > 1) {{
        int middle = (low + high) / 2;
        if (axis[middle] <= value)
            low = middle;
        else
            high = middle;
    }}
    *share = (value - axis[low]) / (axis[low + 1] - axis[low]);
    return low;
}}

double {name}_drag(double torque, double speed, double oil_temperature)
{{
    double share[3], sum = 0.0;
    int corner, at[3];
    at[0] = interval(oil_temperatures, {t}, oil_temperature, &share[0]);
    at[1] = interval(torques, {m}, torque, &share[1]);
    at[2] = interval(speeds, {n}, speed, &share[2]);
    for (corner = 0; corner < 8; corner++) {{
        double weight = 1.0;
        int axis, place[3];
        for (axis = 0; axis < 3; axis++) {{
            int upper = (corner >> axis) & 1;
            place[axis] = at[axis] + upper;
            weight *= upper ? share[axis] : 1.0 - share[axis];
        }}
        if (weight != 0.0)
            sum += weight * drags[place[0]][place[1]][place[2]];
    }}
    return sum;
}}

double {name}_power_loss(double torque, double speed, double oil_temperature)
{{
    return {name}_drag(torque, speed, oil_temperature) * (speed < 0.0 ? -speed : speed);
}}

double {name}_torque_at_input(double torque, double speed, double oil_temperature)
{{
    return (ratio < 0.0 ? -ratio : ratio) * torque + {name}_drag(torque, speed, oil_temperature);
}}

double {name}_efficiency(double torque, double speed, double oil_temperature)
{{
    double load = (ratio < 0.0 ? -ratio : ratio) * torque;
    double lost = {name}_drag(torque, speed, oil_temperature);
    return load > 0.0 ? load / (load + lost) : 1.0 + lost / load;
}}
"""


def write(exported: Exported, name: str, choices: Mapping[str, float]) -> Written:
    """Source and header; the tables of the source are read back and compared."""
    losses, word = exported.losses, identifier(name)
    if set(name) & set('"\\\n'):
        raise InputError(
            "--output", quoted(name), "C cannot include a file of this name", "choose another name"
        )
    sizes = dict(zip("tmn", losses.total.shape, strict=True))
    axes = {axis: numbers(getattr(losses, axis)) for axis in ("oil_temperature", "torque", "speed")}
    source = _SOURCE.format(
        name=word, file=name, ratio=losses.ratio, drag=numbers(losses.total), **axes, **sizes
    )
    read = GridValues(
        tuple(read_numbers(source, axis) for axis in ("oil_temperatures", "torques", "speeds")),
        read_numbers(source, "drags"),
    )
    found = (deviation("drag at the input", "N m", read(*losses.points), losses.total),)
    top = "/*\n" + heading(exported, " * ", found).replace("*/", "* /") + " */\n"
    header = _HEADER.format(name=word, guard=word.upper())
    return Written({".c": f"{top}{source}", ".h": f"{top}{header}"}, found)


FORMAT = ExchangeFormat(
    "c",
    "header and source in C99 that look the losses up",
    (".c",),
    takes=(MAP,),
    write=write,
)
