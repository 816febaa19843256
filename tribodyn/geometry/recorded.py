"""The geometry of a gear pair in a record: every curve's dimensions, unit and meaning."""

from tribodyn.numerics.variable import Variable

#: Curves; lengths such as radii are numbers beside them, in m.
GEOMETRY: dict[str, Variable] = {
    "pinion_outline": Variable(
        ("pinion_point", "axis"),
        "m",
        "outline of the pinion about its axis, turned as when a pair touches at the pitch point",
    ),
    "gear_outline": Variable(
        ("gear_point", "axis"),
        "m",
        "outline of the gear about its axis, turned as when a pair touches at the pitch point",
    ),
    "path_of_contact": Variable(
        ("path_point", "axis"), "m", "path of contact, origin at the pitch point, x along the pitch tangent"
    ),
}
