"""The gear pair's equations as an engineer would write them on NumPy, fast: arrays over the pairs in contact.

For one kind of case only, the one the comparison is made on: prescribed speed, constant load torque,
friction by Masjedi & Khonsari with kinematic or dynamic sliding, a linear contact, pairs that stay in
contact. Ten states: x and y of both gears, the gear's micro-rotation, and their rates. `difference`
compares it with tribodyn's own right-hand side, so that what is timed is the same mathematics.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import SLIDING_DYNAMIC, Model
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.train.layout import displacements, layout_of, velocities
from tribodyn.train.structure import (
    GROUND,
    TURN,
)

Array = Any

#: A pair of gears on two bearings, and the places of the ten states among those of the model.
PAIR = layout_of(2, 2, [(0, 1)], [(0, GROUND), (1, GROUND)], 0, 1)
MOVING = [*displacements(PAIR), *velocities(PAIR)]

#: Channels read, from the first; those that follow say how unevenly a face is loaded, and this one is evenly.
NEEDED = CHANNELS.index("sine") + 1


class NumpyModel:
    """Right-hand side over mesh phase; `segment` says which pairs are in contact."""

    def __init__(self, model: Model):
        (mesh,) = model.meshes
        self.t, self.s, self.c = mesh.table, mesh.surfaces, mesh.friction
        self.gear_radius, self.mesh_damping = float(mesh.driven_radius), float(mesh.damping)
        self.gear_inertia, self.load_torque = float(model.bodies.inertia[1]), float(model.bodies.load[1])
        # of x and y of both gears
        self.masses = np.repeat(model.bodies.mass, 2)
        springs, dampers = model.links.stiffness, model.links.damping
        self.springs, self.dampers = (part[:, :TURN].ravel() for part in (springs, dampers))
        self.boundary = np.asarray(self.t.boundary)
        self.pairs = [np.flatnonzero(row) for row in np.asarray(self.t.in_contact)]
        self.cells = self.t.channel.shape[1]
        self.channel, self.stiffness = [], []
        for segment, pairs in enumerate(self.pairs):
            # (cell, power, channel, pair): one row of coefficients per look-up
            coefficients = self.t.channel[segment][:, pairs, :NEEDED]
            self.channel.append(np.ascontiguousarray(coefficients.transpose(0, 3, 2, 1)))
            block = self.t.stiffness[segment][:, pairs][:, :, pairs]
            self.stiffness.append(np.ascontiguousarray(block.transpose(0, 3, 1, 2)))
        self.w = float(mesh.driver_radius) / self.gear_radius
        self.omega = float(model.operation.nominal_speed)
        self.rate = float(self.t.pitch_angle) / self.omega
        self.dynamic = model.options.sliding == SLIDING_DYNAMIC
        self.reversed_at = self.omega * (1.0 + self.w) * float(model.operation.reversal_width)
        modulus, roughness = self.s.effective_modulus, self.s.roughness
        self.material = self.s.pressure_viscosity * modulus
        self.hardness = self.s.hardness / modulus
        factor = np.exp(mesh.film.log_asperity_factor)
        self.asperity = factor * roughness**6.015 * self.hardness**1.168 * self.material**-2.898
        self.rough = 0.2 * roughness**1.222 * self.hardness**0.223 * self.material**-0.842

    def segment(self, phase: float) -> int:
        """Which pairs are in contact at a phase, 0 … 1."""
        return int(np.searchsorted(self.boundary, phase, side="right")) - 1

    def __call__(self, phase: float, y: Array, segment: int) -> Array:
        """Derivative of the ten states per mesh cycle."""
        t, gear_radius = self.t, self.gear_radius
        start, end = self.boundary[segment], self.boundary[segment + 1]
        place = min(max((phase - start) / (end - start) * self.cells, 0.0), self.cells - 1e-9)
        cell = int(place)
        u = place - cell
        c0, c1, c2, c3 = self.channel[segment][cell]
        cosine, r, radius, speed, compliance, gap, sine = c0 + u * (c1 + u * (c2 + u * c3))
        slope = (c1 + u * (2.0 * c2 + 3.0 * u * c3)) * (self.cells / (end - start) / t.pitch_angle)
        k0, k1, k2, k3 = self.stiffness[segment][cell]
        stiffness = k0 + u * (k1 + u * (k2 + u * k3))

        towards, across = y[0] - y[2] - gear_radius * y[4], y[1] - y[3]
        towards_rate, across_rate = y[5] - y[7] - gear_radius * y[9], y[6] - y[8]
        approach = towards * cosine + across * sine - gap
        moved = (towards * slope[0] + across * slope[6] - slope[5]) * self.omega
        approach_rate = towards_rate * cosine + across_rate * sine + moved
        damping = self.mesh_damping * approach_rate / np.sqrt(compliance)
        normal = np.maximum(np.maximum(stiffness @ approach, 0.0) + damping, 0.0)
        u_p = self.omega * speed
        sliding = self.omega * (1.0 + self.w) * r
        u_g = u_p - sliding
        if self.dynamic:
            sliding = sliding + towards_rate * sine - across_rate * cosine + y[9] * r
        turned = np.clip(sliding / self.reversed_at, -1.0, 1.0)
        tangential = self.friction(normal / t.slice_width, radius, u_p, u_g, np.abs(sliding))
        tangential = tangential * normal * 0.5 * turned * (3.0 - turned * turned)

        force_x = -np.sum(normal * cosine + tangential * sine)
        force_y = np.sum(tangential * cosine - normal * sine)
        moment = np.sum(normal * gear_radius * cosine + tangential * (gear_radius * sine - r))
        forces = np.array([force_x, force_y, -force_x, -force_y])
        forces = forces - self.springs * y[:4] - self.dampers * y[5:9]
        turning = (moment - self.load_torque) / self.gear_inertia
        return self.rate * np.concatenate([y[5:], forces / self.masses, [turning]])

    def friction(self, load: Array, radius: Array, u_p: Array, u_g: Array, sliding: Array) -> Array:
        """Friction coefficient of each pair, Masjedi & Khonsari."""
        s, c = self.s, self.c
        modulus = s.effective_modulus
        load = np.maximum(load, 1.0)
        W = load / (modulus * radius)
        U = s.inlet_viscosity * 0.5 * np.abs(u_p + u_g) / (modulus * radius)
        inner = self.asperity * radius**-6.015 * W**0.485 * U**-3.741
        share = np.minimum(5e-5 * W**-0.408 * U**-0.088 * self.material**0.103 * np.log1p(inner), 1.0)
        film = 2.691 * W**-0.135 * U**0.705 * self.material**0.556 * radius
        film = film * (1.0 + self.rough * radius**-1.222 * W**-0.229 * U**-0.748)
        half = np.sqrt(8.0 * load * radius / (np.pi * modulus))
        pressure = load / (2.0 * half)
        limit = c.limiting_shear_coefficient * pressure * (1.0 - c.limiting_share * share)
        flux = (
            sliding * pressure * (c.asperity_friction * share + c.limiting_shear_coefficient * (1.0 - share))
        )
        conducted = 0.0
        for flank, conductivity, capacity in (
            (u_p, c.pinion_conductivity, c.pinion_heat_capacity),
            (u_g, c.gear_conductivity, c.gear_heat_capacity),
        ):
            peclet = half * np.abs(flank) * capacity / (2.0 * conductivity)
            conducted = conducted + conductivity * np.sqrt(1.0 + peclet)
        rise = 2.0 * half * flux / (np.sqrt(np.pi) * conducted)
        fluid = c.viscosity_pressure_factor * pressure * (1.0 - share)
        exponent = (np.log(s.inlet_viscosity) + 9.67) * (
            (1.0 + 5.1e-9 * fluid) ** c.viscosity_pressure_index - 1.0
        )
        viscosity = s.inlet_viscosity * np.exp(exponent - c.temperature_viscosity * rise)
        newtonian = np.minimum(viscosity * sliding / (limit * film), 600.0)
        return c.asperity_friction * share - limit / pressure * np.expm1(-newtonian)


def numpy_rates(model: Model, phases: Array, states: Array) -> Array:
    """Derivatives of the ten moving states at given phases: (time, 10)."""
    function = NumpyModel(model)
    pairs = zip(phases, states, strict=True)
    return np.array([function(float(phase), state, function.segment(phase)) for phase, state in pairs])


def difference(
    model: Model, phases: Array, states: Array, rates: Callable[[Model, Array, Array], Array] = numpy_rates
) -> float:
    """Maximum difference from tribodyn's right-hand side, over each rate's range at states (time, 10).

    `rates` is another program's right-hand side: model, phases and states to derivatives (time, 10).
    """
    segment_at = NumpyModel(model).segment
    ours = []
    for phase, state in zip(phases, states, strict=True):
        full, found = np.zeros(PAIR.states), {}
        full[MOVING] = state
        derivatives(float(phase), 0.0, segment_at(phase), full, model, contacts_of(model), found)
        ours.append([found[i] for i in MOVING])
    expected = np.array(ours)
    return float(np.max(np.abs(rates(model, phases, states) - expected) / np.ptp(expected, axis=0)))
