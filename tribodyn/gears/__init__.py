"""What the studies of gear pairs share."""
