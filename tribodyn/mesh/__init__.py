"""The mesh cycle: the one bridge from teeth to dynamics."""
