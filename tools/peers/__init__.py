"""What a user would write instead: the model of `tribodyn.dynamics` on NumPy and in Octave."""
