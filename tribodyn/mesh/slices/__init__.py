"""The mesh cycle of pairs in slices along the face."""
