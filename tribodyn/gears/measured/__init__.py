"""Measured gears: files of measuring machines to and from the deviations of single teeth."""
