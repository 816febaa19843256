"""The lubricant in a scenario, and how it thickens under pressure."""
