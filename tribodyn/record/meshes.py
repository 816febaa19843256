"""Meshes and bodies of a record of gears, in one way whether its meshes have names or not.

A file that names its meshes makes them a dimension of its record, and bodies another. Of a pair of gears,
whose only mesh has no name, the dimension of meshes is left out, and motions stand under degrees of freedom
of pinion and gear.
"""

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np

#: Group of a record of a train that has a group for every mesh; the same in its summary.
MESHES = "meshes"


class MeshesOfRecord:
    """What a record says of its meshes and bodies; whoever inherits it gives the rest of a record."""

    summary: Any

    def __getitem__(self, name: str) -> np.ndarray:
        """Return a dataset."""
        raise NotImplementedError

    def __contains__(self, name: object) -> bool:
        raise NotImplementedError

    def dims_of(self, name: str) -> tuple[str, ...]:
        """Names of a dataset's dimensions."""
        raise NotImplementedError

    def _group(self, name: str) -> dict[str, Any]:
        raise NotImplementedError

    @cached_property
    def names_meshes(self) -> bool:
        """Whether the meshes have names, and are a dimension; else there is one, of the bodies' gears."""
        return "mesh" in self

    @cached_property
    def meshes(self) -> tuple[str, ...]:
        """Names of the meshes; "mesh" where they have none."""
        return tuple(map(str, self["mesh"])) if self.names_meshes else ("mesh",)

    @property
    def mesh_summaries(self) -> dict[str, Mapping[str, Any]]:
        """What the summary has of every mesh, by its name."""
        if not self.names_meshes:
            return {self.meshes[0]: self.summary}
        found = self.summary.get(MESHES)
        return {name: found[name] for name in self.meshes if isinstance(found, Mapping) and name in found}

    def of_mesh(self, mesh: str, part: str) -> dict[str, Any]:
        """`mesh_cycle` or `geometry` of a mesh, by its name."""
        return self._group(f"{MESHES}/{mesh}/{part}" if self.names_meshes else part)

    def over_meshes(self, name: str) -> np.ndarray:
        """A dataset (sample, mesh, …); where it has no dimension of meshes that is one."""
        values = self[name]
        return values if "mesh" in self.dims_of(name) else values[:, None]

    def over_bodies(self, name: str) -> np.ndarray:
        """Motion (sample, body) in a coordinate: x, y, z, angle, tilt_x or tilt_y, or a rate.

        Rates are x_rate, y_rate, z_rate and speed. Where the meshes have no names the bodies are pinion and
        gear, and a motor's values are NaN. KeyError where the record does not hold it.
        """
        if "dof" not in self:
            return self[name]
        coordinate = {"angle": "theta", "speed": "theta"}.get(name, name.removesuffix("_rate"))
        moved = self["displacement" if name in (coordinate, "angle") else "velocity"]
        dof = list(self["dof"])
        values = [moved[:, dof.index(f"{coordinate}_{side}")] for side in "pg"]
        further = len(self["body"]) - len(values) if "body" in self else 0
        return np.stack([*values, *[np.full(len(moved), np.nan)] * further], axis=1)
