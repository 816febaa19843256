"""Records as xarray datasets, with units and names as they stand in the record."""

from typing import TYPE_CHECKING, Any

import numpy as np

from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord

if TYPE_CHECKING:
    from xarray import Dataset


def of_run(record: Record) -> "Dataset":
    """All datasets along a record's axis, which is their first dimension, in SI units."""
    from xarray import Dataset  # with pandas half the start of a program that only runs

    variables, coordinates = {}, {}
    for name in record:
        variables[name] = _variable(record, name, record.dims_of(name))
    for name in {dim for variable in variables.values() for dim in variable[0]}:
        if name in record:
            coordinates[name] = _variable(record, name, (name,))
    data = {name: variable for name, variable in variables.items() if name not in coordinates}
    return Dataset(data, coordinates, _named(record))


def of_sweep(record: SweepRecord) -> "Dataset":
    """All figures of a sweep over its parameters, in SI units; NaN where a case is not done."""
    from xarray import Dataset

    names = (*record, *(name for name in ("status", "message") if name not in set(record)))
    variables = {name: _variable(record, name, record.dims_of(name)) for name in names}
    coordinates: dict[str, Any] = {
        parameter.name: (parameter.name, parameter.values, {"units": parameter.units, "key": parameter.key})
        for parameter in record.parameters
    }
    if record.directions:
        coordinates["direction"] = ("direction", np.array(record.directions))
    data = {name: variable for name, variable in variables.items() if name not in coordinates}
    return Dataset(data, coordinates, _named(record))


def _named(record: Record | SweepRecord) -> dict[str, str]:
    return {"title": str(record.scenario.get("title", "")), "status": record.status}


def _variable(record: Record | SweepRecord, name: str, dims: tuple[str, ...]) -> Any:
    named = {"units": record.units(name), "long_name": record.long_name(name)}
    return dims, record[name], {key: value for key, value in named.items() if value}
