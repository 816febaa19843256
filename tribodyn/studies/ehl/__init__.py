"""The lubricated contact of a pair of teeth solved along its way through the mesh."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="ehl",
    about="film, pressure, temperature and friction of a pair solved along its way through the mesh",
    package=__name__,
    quantities="films, pressures and friction of a pair of teeth over its way through the mesh",
    compared=("Geometry", "Solved contact"),
    has_gears=True,
    resolution="output.positions",
)
