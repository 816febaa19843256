"""From tooth shape to transmission error, loads, film thickness and efficiency."""

__version__ = "0.1.0"
