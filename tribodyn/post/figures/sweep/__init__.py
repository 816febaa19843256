"""Figures of sweeps, one subject a file; the pictures of a study name them."""
