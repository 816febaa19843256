"""Teeth in slow rotation under load, by finite elements."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="load-contact",
    about="teeth in slow rotation under load, on finite elements, slice by slice of the face",
    package=__name__,
    quantities="loads, pressures and stresses of teeth over phase and face",
    compared=("Geometry", "Load contact", "Dynamics", "Tribology"),
    has_gears=True,
    resolution="output.positions_per_cycle",
)
