"""Load capacity of a pair of gears beside its simulation: by standards, margins, limits, how it is shown."""
