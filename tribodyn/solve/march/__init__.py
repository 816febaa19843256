"""The native march through mesh cycles: steps, samples, extremes, derivatives."""
