"""Load contact: how pairs of teeth and slices of the face share the load, with gaps between flanks."""
