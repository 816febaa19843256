"""Shafts, bearings and stiffness matrices in a scenario."""
