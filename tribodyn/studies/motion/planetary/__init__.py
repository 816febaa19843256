"""Planetary stages of trains: what a scenario says of them, their pins and frames, and their results."""
