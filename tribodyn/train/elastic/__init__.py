"""Shafts, bearings and housing: what gives under the loads of the meshes."""
