"""Heat of a whole gearbox: a network of nodes, its balance in steady state and over time, and surfaces."""
