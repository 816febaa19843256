"""Duals: the laws compiled for numbers that carry their derivatives."""
