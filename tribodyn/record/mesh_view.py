"""One mesh of a record of several, read as the record of a pair is."""

from typing import Any

import numpy as np

from tribodyn.record.reader import Record

#: What only a record of several meshes has.
_OF_SEVERAL = "mesh", "mesh_phase"


class MeshView(Record):
    """A mesh, by its number along the axis of meshes; it shares the open file of its record.

    `pinion_angle` is the nominal rotation of its driver, rad, 0 where a cycle of the mesh begins.
    """

    def __init__(self, record: Record, mesh: int, label: str = "") -> None:
        vars(self).update(vars(record))
        self._mesh, self._phase = mesh, record["mesh_phase"][:, mesh]
        name = record.meshes[mesh]
        self.label = f"{record.label}: {label or name}"
        parts: dict[str, Any] = {part: record.of_mesh(name, part) for part in ("mesh_cycle", "geometry")}
        vars(self).update(parts, groups=tuple(parts), names_meshes=False, meshes=(name,))

    def of_mesh(self, mesh: str, part: str) -> dict[str, Any]:
        """`mesh_cycle` or `geometry`."""
        return getattr(self, part)

    def __getitem__(self, name: str) -> np.ndarray:
        """A dataset of this mesh, without the axis of meshes."""
        if name == "pinion_angle":
            return self._phase * (2 * np.pi / self.mesh_cycle["pinion_teeth"])
        values, dims = super().__getitem__(name), super().dims_of(name)
        return values.take(self._mesh, dims.index("mesh")) if "mesh" in dims else values

    def __contains__(self, name: object) -> bool:
        return name not in _OF_SEVERAL and super().__contains__(name)

    def dims_of(self, name: str) -> tuple[str, ...]:
        """Names of a dataset's dimensions, that of meshes left out."""
        return tuple(dim for dim in super().dims_of(name) if dim != "mesh")


def mesh_views(record: Record) -> dict[str, Record]:
    """A view of every mesh by name; of a record that does not name its meshes the record itself."""
    if not record.names_meshes:
        return {record.meshes[0]: record}
    return {name: MeshView(record, m) for m, name in enumerate(record.meshes)}
