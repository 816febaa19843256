"""Helical teeth: the energy method against finite elements, whole and piece by piece."""

import numpy as np
import pytest

from tests.support.faces_in_slices import STEEL
from tests.support.helical import PAIR, WIDTH, elastic
from tests.support.soak_parameters import all_in_soak
from tribodyn.compliance.fem.gear_compliance import without_neighbours
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.loaded_contact import roll_through
from tribodyn.mesh.by_compliance import mesh_cycle_of
from tribodyn.mesh.quasi_static import cycle_mean, quasi_static
from tribodyn.mesh.slices.helical import slice_layout, tabulate_slices
from tribodyn.mesh.table import MeshData

SLICES = 15
PAIRS = {
    "10 deg": ((24, 36), 10.0, 36e-3),
    "20 deg": (PAIR, 20.0, WIDTH),
    "ISO/TR 6336-30, 1": ((17, 103), 15.8, 100e-3, 8e-3, (0.145, 0.0), 1.4),
}


def torque_of(pair, width):
    return 300e3 * width * float(pair.drive.module) * float(pair.drive.gear.teeth) / 2.0


@pytest.mark.parametrize("name", all_in_soak(PAIRS, ("20 deg",)))
def test_mean_mesh_stiffness(name):
    """Within 5 %: slices that hold each other, and pairs that share the bodies, in both."""
    flexible = elastic(*PAIRS[name])
    pair, torque = flexible.assembly, torque_of(flexible.assembly, flexible.width)
    elements = np.mean(roll_through(LoadedFlanks(flexible, slices=SLICES), torque, 24).mesh_stiffness)
    cycle = mesh_cycle_of(pair, (STEEL, STEEL), MeshData("energy", 0.05, slices=SLICES), torque)
    energy = float(cycle_mean(cycle, quasi_static(cycle, torque).mesh_stiffness))
    assert energy == pytest.approx(elements, rel=0.05)


@pytest.mark.parametrize("name", all_in_soak(PAIRS, ("20 deg",)))
def test_mean_mesh_stiffness_of_slices_and_pairs_apart(name):
    """Within 5 %; secants, for the energy method's contact is linear.

    The elements have contact of the corners besides. What they alone know is left out: that slices hold each
    other (stiffer, by 10 % at 20°), and that pairs share the bodies (softer, by a quarter for narrow bores).
    """
    flexible = elastic(*PAIRS[name])
    pair, torque = flexible.assembly, torque_of(flexible.assembly, flexible.width)
    gear_radius = float(pair.path.gear_pitch_radius)
    gears = tuple(without_neighbours(gear) for gear in flexible.gears)
    apart = LoadedFlanks(flexible._replace(gears=gears), slices=SLICES, coupled=False)
    elements = np.mean(torque / gear_radius / roll_through(apart, torque, 24).deflection)
    mesh = MeshData("energy", 0.05)
    cycle = tabulate_slices(pair, (STEEL, STEEL), mesh, slice_layout(pair, mesh, SLICES))
    energy = float(cycle_mean(cycle, quasi_static(cycle, torque).mesh_stiffness))
    assert energy == pytest.approx(elements, rel=0.05)
