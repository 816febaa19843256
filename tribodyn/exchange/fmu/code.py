"""The C sources of an FMU: the model as it is translated, and how the variables stand in it."""

import hashlib
from collections.abc import Mapping
from importlib import resources
from string import Template
from typing import NamedTuple

import numpy as np

from tribodyn.exchange.fmu.oil import OilTable, Path
from tribodyn.exchange.fmu.variables import FmuVariable, Role
from tribodyn.exchange.format import SPEED, TORQUE, GearboxInTime
from tribodyn.kernels.c import CEntry, translated
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.integrator import REASONS, Status
from tribodyn.solve.march import by_time
from tribodyn.solve.march.time_outputs import outputs, time_outputs
from tribodyn.solve.right_hand_side import work_array
from tribodyn.train.structure import turn_of

#: Stands for the token in sources of which it is the digest.
_NO_TOKEN = "{00000000-0000-0000-0000-000000000000}"
_INDENT = "    "


class _CTemplate(Template):
    delimiter = "@"


class FmuSources(NamedTuple):
    """C sources by the names of their files, and the text that tells the FMU apart."""

    files: Mapping[str, str]
    compiled: tuple[str, ...]  # those to be compiled; they include the others
    token: str


def advance(until, control, model, y, clock, work, buffer):
    """Move on to a time (s); returns a `Status`."""
    status, _, _ = by_time.advance(until, control, model, y, clock, work, buffer)
    return status


def sources_of(
    gearbox: GearboxInTime,
    kinds: tuple[str, str],
    oil: OilTable | None,
    variables: tuple[FmuVariable, ...],
    version: str,
    name: str,
    title: str,
) -> FmuSources:
    """All sources; `version` of the standard, "3.0" or "2.0", `name` as an identifier of C."""
    model = gearbox.model
    start = next(iter(gearbox.starts.values()))
    control = by_time.time_control(model, start, gearbox.rtol, gearbox.max_steps)
    clock = by_time.begun_clock(model, start, control)
    work, buffer = work_array(model), by_time.time_buffer(model.layout)
    out = np.zeros(len(time_outputs(model)))
    entries = {
        f"{name}_advance": CEntry(advance, (1.0, control, model, start, clock, work, buffer)),
        f"{name}_outputs": CEntry(outputs, (model, start, clock, work, buffer, out)),
    }
    translation = translated(entries, {f"{name}_model": model, f"{name}_control": control}, "model")
    files = {
        "model.h": translation.header,
        "model.c": translation.source,
        **{name: _own(name) for name in ("simulation.h", "instance.c", "functions.c")},
    }
    main = f"fmi{version[0]}.c"
    files[main] = _own(main)
    filled = _simulation(gearbox, kinds, oil, variables, (clock, work, buffer, out), name, title)
    files["simulation.c"] = filled.replace("@token", _NO_TOKEN)
    digest = hashlib.sha256(repr(sorted(files.items())).encode()).hexdigest()
    parts = (digest[:8], digest[8:12], digest[12:16], digest[16:20], digest[20:32])
    token = f"{{{'-'.join(parts)}}}"
    files["simulation.c"] = filled.replace("@token", token)
    return FmuSources(files, (main, "model.c"), token)


def _own(name: str) -> str:
    return resources.files(__package__ or "").joinpath("c", name).read_text(encoding="utf-8")


def _simulation(
    gearbox: GearboxInTime,
    kinds: tuple[str, str],
    oil: OilTable | None,
    variables: tuple[FmuVariable, ...],
    arrays: tuple[Float[Array, " row"], Float[Array, "..."], Float[Array, "row state"], Float[Array, " out"]],
    name: str,
    title: str,
) -> str:
    model = gearbox.model
    clock, work, buffer, out = arrays
    layout, operation, ratio = model.layout, model.operation, np.asarray(model.bodies.ratio)
    places = {variable.place: number for number, variable in enumerate(variables) if variable.place >= 0}
    speeds = sorted(gearbox.starts)
    reasons = [REASONS.get(status, "done") for status in Status]
    values = {
        "name": name,
        "title": title.replace("*/", "* /"),
        "states": layout.states,
        "clock_rows": len(clock),
        "work": _lengths(work),
        "buffer": _lengths(buffer),
        "starts": len(speeds),
        "outputs": len(out),
        "oil_numbers": 0 if oil is None else len(oil.paths),
        "oil_points": 0 if oil is None else len(oil.temperatures),
        "variable_count": len(variables),
        "lag": layout.lag,
        "slip": layout.half + layout.lag,
        "output_turn": turn_of(layout.output, layout),
        "time_row": by_time.TIME,
        "steps_row": by_time.STEPS,
        "references": _references(variables),
        "variables": ",\n".join(_variable(each) for each in variables),
        "token": "@token",
        "tolerance": _number(gearbox.rtol),
        "nominal_time": _number(by_time.nominal_time(model)),
        "nominal_speed": _number(operation.nominal_speed),
        "input_ratio": _number(ratio[layout.input]),
        "output_ratio": _number(ratio[layout.output]),
        "starting_torque": _number(gearbox.output_torque),
        "start_speeds": _numbers(speeds),
        "start_states": ",\n".join(f"{_INDENT}{{ {_numbers(gearbox.starts[speed])} }}" for speed in speeds),
        "start_clock": _numbers(clock),
        "output_variables": ", ".join(str(places.get(place, 0)) for place in range(len(out))),
        "oil_tables": "" if oil is None else _oil_tables(oil),
        "oil_nominal": _number(0.0 if oil is None else oil.nominal),
        "oil_functions": "" if oil is None else _oil_functions(oil),
        "inputs": _inputs(kinds, oil),
        "start_variable": "INPUT_SPEED" if kinds[0] == SPEED else "START_SPEED",
        "start_shaft": _start_shaft() if kinds[1] == SPEED else "",
        "steps": _steps(kinds),
        "reasons": ", ".join(_text(reason) for reason in reasons),
    }
    return _CTemplate(_own("simulation.c")).substitute(values)


def _number(value: object) -> str:
    return repr(float(value))  # pyright: ignore[reportArgumentType]


def _numbers(values: object) -> str:
    return ", ".join(map(_number, np.asarray(values).ravel().tolist()))


def _lengths(array: Float[Array, "..."]) -> str:
    return "".join(f"[{max(length, 1)}]" for length in array.shape)


def _text(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _constant(name: str) -> str:
    return name.upper().replace(".", "_")


def _references(variables: tuple[FmuVariable, ...]) -> str:
    """Value references of what is not an output."""
    named = [(number, each) for number, each in enumerate(variables) if each.role is not Role.OUTPUT]
    return ",\n".join(f"{_INDENT}{_constant(each.name)} = {number}" for number, each in named[1:])


def _variable(variable: FmuVariable) -> str:
    numbers = _numbers([variable.start, variable.minimum, variable.maximum])
    return f"{_INDENT}{{ {_text(variable.name)}, {variable.role.value}, {numbers} }}"


def _inputs(kinds: tuple[str, str], oil: OilTable | None) -> str:
    """Lines that put inputs into the model."""
    lines = []
    if kinds[0] == TORQUE:
        lines.append("one->model.operation.drive_torque = values[INPUT_TORQUE];")
    else:
        lines.append("one->model.operation.acceleration = numbers[ACCELERATION];")
    if kinds[1] == TORQUE:
        lines.append("one->model.operation.output_torque = values[OUTPUT_TORQUE];")
    else:
        shaft = "one->model.operation.output_drive"
        lines += [
            f"{shaft}.stiffness = values[OUTPUT_STIFFNESS];",
            f"{shaft}.damping = values[OUTPUT_DAMPING];",
            f"{shaft}.since = numbers[SHAFT_SINCE];",
            f"{shaft}.angle = numbers[SHAFT_ANGLE];",
            f"{shaft}.slip = numbers[SHAFT_SLIP];",
            f"{shaft}.acceleration = numbers[SHAFT_ACCELERATION];",
        ]
    if oil is not None:
        lines.append("put_oil(one, values[OIL_TEMPERATURE]);")
    return "\n".join(_INDENT + line for line in lines)


def _steps(kinds: tuple[str, str]) -> str:
    """Lines that begin a step: speeds change linearly to what is given for its end."""
    lines = []
    if SPEED in kinds:
        lines += ["double now = simulation_time(numbers), passed = until - now;"]
    if kinds[0] == SPEED:
        lines += [
            "numbers[ACCELERATION] =",
            f"{_INDENT}(values[INPUT_SPEED] / input_ratio - nominal_speed - numbers[SLIP]) / passed;",
        ]
    if kinds[1] == SPEED:
        lines += [
            "double since = now - numbers[SHAFT_SINCE];",
            "numbers[SHAFT_ANGLE] +=",
            f"{_INDENT}since * (numbers[SHAFT_SLIP] + 0.5 * numbers[SHAFT_ACCELERATION] * since);",
            "numbers[SHAFT_SLIP] += numbers[SHAFT_ACCELERATION] * since;",
            "numbers[SHAFT_SINCE] = now;",
            "numbers[SHAFT_ACCELERATION] =",
            f"{_INDENT}(values[OUTPUT_SHAFT_SPEED] - output_ratio * nominal_speed - numbers[SHAFT_SLIP])"
            " / passed;",
        ]
    return "\n".join(_INDENT + line for line in lines)


def _start_shaft() -> str:
    """Lines that put the shaft at the output where it begins: its spring then bears the load at the start."""
    lines = [
        "numbers[SHAFT_SLIP] = values[OUTPUT_SHAFT_SPEED] - output_ratio * nominal_speed;",
        "numbers[SHAFT_ANGLE] = numbers[OUTPUT_TURN] - output_ratio * nominal_speed * numbers[LAG];",
        "if (values[OUTPUT_STIFFNESS] > 0.0)",
        f"{_INDENT}numbers[SHAFT_ANGLE] -= starting_torque / values[OUTPUT_STIFFNESS];",
    ]
    return "\n".join(_INDENT + line for line in lines)


def _place(path: Path) -> str:
    """A number of the model in C."""
    text = "one->model"
    for part in path:
        text += f"[{part}]" if isinstance(part, int) else f".{part}"
    return text


def _oil_tables(oil: OilTable) -> str:
    def rows(values: Float[Array, "number point"]) -> str:
        return ",\n".join(f"{_INDENT}{{ {_numbers(row)} }}" for row in values)

    flags = ", ".join(str(int(each)) for each in oil.logarithmic)
    return f"""
/* Numbers that depend on the temperature of the oil, K: where they are exact, and those; points; whether the
 * values are logarithms; values, and their slopes, 1/K. */
static const double oil_exact_at = {_number(oil.nominal)};
static const double oil_exact[OIL_NUMBERS] = {{ {_numbers(oil.exact)} }};
static const double oil_points[OIL_POINTS] = {{ {_numbers(oil.temperatures)} }};
static const int oil_logarithmic[OIL_NUMBERS] = {{ {flags} }};
static const double oil_values[OIL_NUMBERS][OIL_POINTS] = {{
{rows(oil.values)}
}};
static const double oil_slopes[OIL_NUMBERS][OIL_POINTS] = {{
{rows(oil.slopes)}
}};
"""


def _oil_functions(oil: OilTable) -> str:
    lines = "\n".join(
        f"{_INDENT}{_place(path)} = oil_number({number}, temperature);"
        for number, path in enumerate(oil.paths)
    )
    return f"""
/* A number at a temperature: a cubic between two points. */
static double oil_number(int number, double temperature)
{{
    double width = (oil_points[OIL_POINTS - 1] - oil_points[0]) / (OIL_POINTS - 1), u, v, value;
    int i = (int)((temperature - oil_points[0]) / width);
    const double *at = oil_values[number], *slope = oil_slopes[number];
    if (temperature == oil_exact_at)
        return oil_exact[number];
    if (i > OIL_POINTS - 2)
        i = OIL_POINTS - 2;
    u = (temperature - oil_points[i]) / width;
    v = 1.0 - u;
    value = v * v * ((1.0 + 2.0 * u) * at[i] + u * width * slope[i])
        + u * u * ((1.0 + 2.0 * v) * at[i + 1] - v * width * slope[i + 1]);
    return oil_logarithmic[number] ? exp(value) : value;
}}

static void put_oil(struct simulation *one, double temperature)
{{
    if (temperature == one->oil_temperature)
        return;
    one->oil_temperature = temperature;
{lines}
}}
"""
