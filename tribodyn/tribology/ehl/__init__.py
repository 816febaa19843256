"""The lubricated line contact solved: Reynolds' equation, half-space elasticity, rheology and heat."""
