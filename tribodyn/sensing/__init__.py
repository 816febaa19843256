"""From motion to what a sensor gives: paths to the housing, sampling as it comes, noise and digits."""
