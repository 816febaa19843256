"""Integration through JAX: diffrax, one case or many."""
