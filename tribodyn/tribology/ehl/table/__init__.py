"""Solved contacts over the duty of a mesh, as laws read them."""
