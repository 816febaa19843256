"""Figures of trains, and what their page lets roll."""
