"""Trains: bodies, the links and meshes that join them, and when which pairs of teeth are in contact."""
