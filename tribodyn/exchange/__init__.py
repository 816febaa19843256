"""Formats of other programs, one file a format: what they hold, as they hold it, units included."""
