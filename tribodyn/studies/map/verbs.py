"""`tribodyn map` and `td.map`: the loss map of any gearbox, and what its runs offer in Python."""

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from tribodyn.studies.protocol.verb import Option, Verb

if TYPE_CHECKING:
    import numpy as np

    from tribodyn.record.loss_map import LossMap
    from tribodyn.studies.protocol.load import Loaded

EXAMPLES = (
    "\b\nValues of an axis, the unit once, at the end:\n"
    "  0:500:50N*m     from, to, step\n"
    "  0:500/11N*m     from, to, number of values\n"
    "  0,50,100N*m     a list\n"
    "\b\nExamples:\n"
    "  tribodyn map map-two-stage-reducer\n"
    "  tribodyn map two-stage-reducer --torque 0:2000/11N*m --speed 0:1800/11rpm --directions both\n"
    "  tribodyn map my-reducer.toml --oil-temperature 20,60,90degC -o losses.h5 --report\n"
    "\b\nA call that was stopped goes on where it was."
)
Axis = str | list[str] | Mapping[str, Any] | None
"""Values as of the command line, a list of quantities, or a table with from, to, points and spacing."""


class Map:
    """A loss map that was worked out; `map` makes one. It is a `Run`, whose data are over the map's axes."""

    path: Path

    @cached_property
    def losses(self) -> "LossMap":
        """Axes, drag torques and statics as arrays, SI."""
        from tribodyn.record.loss_map import loss_map
        from tribodyn.record.reader import Record

        with Record(self.path) as record:
            return loss_map(record)

    def interpolate(self, torque: Any, speed: Any, oil_temperature: Any = None) -> "dict[str, np.ndarray]":
        """What the map says between its points, linear in the drag: arrays of one shape, or numbers.

        Parameters
        ----------
        torque : array_like
            At the output, N m; below 0 the load drives and power flows back.
        speed : array_like
            Of the input, rad/s.
        oil_temperature : array_like, optional
            In K; may be left out where the map has one.

        Returns
        -------
        dict
            ``drag``, power lost over the magnitude of the speed, N m; ``power_loss``, W; ``input_torque``, in
            the direction of the motion, N m; ``efficiency``, whichever way power flows, NaN without torque.

        Raises
        ------
        InputError
            Beyond the map's axes.
        """
        from tribodyn.studies.map.looked_up import looked_up

        return looked_up(self.losses, torque, speed, oil_temperature)


def loss_map(
    source: Any,
    *,
    torque: Annotated[Axis, Option("At the output, see below.", "VALUES", type=str | None)] = None,
    speed: Annotated[Axis, Option("Of the input.", "VALUES", type=str | None)] = None,
    oil_temperature: Annotated[
        Axis, Option("Of the oil around the gears.", "VALUES", type=str | None)
    ] = None,
    directions: Annotated[
        str | None, Option("forward, back (the load drives), or both.", "DIRECTIONS")
    ] = None,
    accuracy: Annotated[
        float | None, Option("Share of the loss that interpolation may miss; 0: no further points.")
    ] = None,
    most_points: Annotated[int | None, Option("Of the grid with further points.", min=1)] = None,
    overrides: Mapping[str, Any] | None = None,
) -> "Loaded":
    """Map the losses of a gearbox over torque, speed and oil temperature.

    Parameters
    ----------
    source : str, Path, mapping or case
        The scenario of a gearbox, or of a map (kind "map"), whose keys these replace.
    torque, speed, oil_temperature : str, list or mapping, optional
        ``"0:500/11N*m"``, ``["0 N*m", "50 N*m"]`` or ``{"from": …, "to": …, "points": …}``; default: up to
        1.2 times the scenario's own, and its oil temperature.
    directions, accuracy, most_points : optional
        As in the table ``[map]``.
    overrides : mapping, optional
        Dotted key to value, of the gearbox.
    output, force, resume, progress, allow_large, client
        As `run`; the workers of `client` (of Dask) evaluate the points.

    Returns
    -------
    Map
        With `interpolate`, and its arrays as `losses`.

    Raises
    ------
    InputError
        Before anything is computed.
    """
    from tribodyn.studies.map.looked_up import axis_of, loaded_map

    axes = {"torque": torque, "speed": speed, "oil_temperature": oil_temperature}
    table = {name: axis_of(name, axis) for name, axis in axes.items() if axis is not None}
    more = {"directions": directions, "accuracy": accuracy, "most_points": most_points}
    table |= {name: value for name, value in more.items() if value is not None}
    return loaded_map(source, table, overrides or {})


RUN_PROPERTIES = Map
VERBS = {"map": Verb(loss_map, EXAMPLES, alias="loss_map")}
