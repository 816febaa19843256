"""A run over time of gears in mesh: how it goes on, what is recorded of it, and its extremes."""
