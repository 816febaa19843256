"""The dynamics of a train of gears."""
