"""Flanks that are pressed together again and again at the same positions, under other gaps and friction.

What `LoadedFlanks.share` does, with geometry and compliances worked out once.
"""

from functools import cached_property

import numpy as np

from tribodyn.compliance.sharing.load_sharing import (
    ENTRIES,
    LoadedFlanks,
    SharedLoad,
    in_batches,
    press_slices,
)
from tribodyn.compliance.sharing.section import ObliqueFaces
from tribodyn.geometry.corner_contact import PairGeometry
from tribodyn.numerics.elementary import sense
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.shapes import Array, Float


class HeldFlanks:
    """Pairs at the pinion's angles `roll` (position, pair), rad, as `LoadedFlanks.share` takes them."""

    def __init__(self, flanks: LoadedFlanks, roll: Float[Array, "position pair"]) -> None:
        self.flanks, self.roll = flanks, roll
        self.shape = *roll.shape, flanks.slices

    @cached_property
    def faces(self) -> ObliqueFaces:
        """Where the slices touch, without friction; of spur gears all alike, (position, pair, 1)."""
        return self.flanks.contacts(self.roll)

    @cached_property
    def geometry(self) -> PairGeometry:
        """The same as the gaps between flanks take it: of spur gears (position, pair)."""
        return self.flanks.geometry(self.faces)

    @cached_property
    def length(self) -> Float[Array, "position pair slice"]:
        """Length of the line of contact of each slice, m."""
        width = self.flanks.flexible.width / self.flanks.slices
        return np.broadcast_to(width * self.faces.length, self.shape)

    @cached_property
    def gap(self) -> Float[Array, "position pair slice"]:
        """Gap of corners and of flanks as modified, m; pitch errors apart."""
        return np.broadcast_to(self.faces.corner_gap + self.flanks.gap(self.geometry), self.shape)

    @cached_property
    def _compliance(self) -> Float[Array, "position pair slice pair slice"]:
        """Λ of all positions, m/N; in batches, which bound what it takes to work out."""
        return np.concatenate([self.flanks.compliance(self.faces, rows) for rows in in_batches(self.shape)])

    @one_blas_thread()
    def share(
        self,
        gear_torque: float,
        gap: Float[Array, "cycle position pair slice"],
        friction_coefficient: Float[Array, "cycle position pair"],
    ) -> SharedLoad:
        """Share the gear's torque T_g > 0 (N m) in mesh cycles that differ by their gaps and friction.

        The gaps (m) add to `gap`; `friction_coefficient` is μ of the pairs. Arrays of the result have the
        cycles in front. Raises as `press`.
        """
        positions, pairs, slices = self.shape
        most = max(1, ENTRIES // (positions * (pairs * slices) ** 2))
        parts = [
            self._share(gear_torque, gap[first : first + most], friction_coefficient[first : first + most])
            for first in range(0, len(gap), most)
        ]
        return SharedLoad(*(np.concatenate(field) for field in zip(*parts, strict=True)))

    def _share(
        self,
        gear_torque: float,
        gap: Float[Array, "cycle position pair slice"],
        friction_coefficient: Float[Array, "cycle position pair"],
    ) -> SharedLoad:
        """Share it in a few mesh cycles, all positions of which are solved together."""
        flexible, faces = self.flanks.flexible, self.faces
        motion, cycles = faces.geometry.motion, len(gap)
        gear_sense = sense(flexible.assembly.path.gear_pitch_radius)
        side = np.sign(motion.signed_distance) * friction_coefficient[..., None]
        lever = gear_sense * (faces.lever + side * motion.gear_friction_arm)
        rows = (cycles * self.shape[0], *self.shape[1:])

        def every(values: Float[Array, "..."], shape: tuple[int, ...] = self.shape) -> Float[Array, "..."]:
            return np.broadcast_to(values, (cycles, *shape)).reshape(-1, *shape[1:])

        parts = [
            press_slices(
                flexible,
                every(faces.curvature)[part],
                every(self.length)[part],
                every(self._compliance, self._compliance.shape)[part],
                every(faces.arm)[part],
                every(lever)[part],
                every(self.gap + gap)[part],
                np.full(len(range(*part.indices(rows[0]))), float(gear_torque)),
            )
            for part in in_batches(rows)
        ]
        shared = SharedLoad(*(np.concatenate(field) for field in zip(*parts, strict=True)))
        return SharedLoad(*(field.reshape(cycles, -1, *field.shape[1:]) for field in shared))
