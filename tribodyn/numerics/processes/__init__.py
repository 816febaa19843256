"""Processes: how they start, their libraries' settings and threads, and how far they are."""
