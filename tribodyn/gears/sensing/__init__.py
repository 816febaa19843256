"""Sensors of gears over time: what they are on, what they give while a run goes on, and its numbers."""
