"""Losses that do not depend on the load: churning, windage, bearings, one published formula per function."""
