"""The heat of a gearbox: temperatures of its meshes, and of all of its parts."""
