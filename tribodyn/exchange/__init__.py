"""Formats of other programs, one file a format: what they hold, as they hold it, units included."""

from tribodyn.exchange.format import ExchangeFormat
from tribodyn.numerics.registry import Registry

FORMATS: Registry[ExchangeFormat] = Registry(
    "format",
    "format",
    {
        "csv": "tribodyn.exchange.maps.csv_table:FORMAT",
        "mat": "tribodyn.exchange.maps.mat:FORMAT",
        "modelica": "tribodyn.exchange.maps.modelica:FORMAT",
        "mujoco": "tribodyn.exchange.maps.mujoco:FORMAT",
        "drake": "tribodyn.exchange.maps.drake:FORMAT",
        "openfast": "tribodyn.exchange.maps.openfast:FORMAT",
        "python": "tribodyn.exchange.maps.python:FORMAT",
        "c": "tribodyn.exchange.maps.c:FORMAT",
        "step": "tribodyn.exchange.cad.step:FORMAT",
        "gltf": "tribodyn.exchange.cad.gltf:FORMAT",
        "fmu": "tribodyn.exchange.fmu.fmu_format:FORMAT",
        "rexs": "tribodyn.exchange.rexs.rexs_format:FORMAT",
        "gde": "tribodyn.exchange.gde.gde_format:FORMAT",
        "gear-csv": "tribodyn.gears.measured.machine_tables:FORMAT",
    },
    "tribodyn.formats",
    ExchangeFormat,
)
