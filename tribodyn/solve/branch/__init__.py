"""Steady motions followed along a parameter: their branches, folds and ends."""
