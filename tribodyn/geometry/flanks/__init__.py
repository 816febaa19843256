"""What is taken off flanks and tips: modifications, deviations, rounded tips, corner contact."""
