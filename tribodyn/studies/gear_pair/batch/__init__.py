"""Many cases of a gear pair's dynamics, evaluated together."""
