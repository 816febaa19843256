"""Duals: the laws compiled for numbers that carry their derivatives."""

from tribodyn.numerics.processes.libraries import without_file

without_file("numba")  # which all modules here import
