"""The fluid between the surfaces: viscosity, shear, heat and traction."""
