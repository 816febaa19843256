"""Sweeps: a scenario over a grid of its own keys, case by case into one record."""
