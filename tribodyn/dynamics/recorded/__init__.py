"""What is recorded of a motion: datasets, their extremes, sums over the face."""
