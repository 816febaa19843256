"""Formats of other programs, one file a format: what they hold, as they hold it, units included."""

from tribodyn.exchange.format import ExchangeFormat
from tribodyn.numerics.registry import Registry

FORMATS: Registry[ExchangeFormat] = Registry(
    "format",
    "format",
    {"csv": "tribodyn.exchange.csv_map:FORMAT", "rexs": "tribodyn.exchange.rexs.rexs_format:FORMAT"},
    "tribodyn.formats",
    ExchangeFormat,
)
