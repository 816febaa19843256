"""The record of a run: an HDF5 file that is also netCDF-4. `schema` alone knows its layout."""
