"""Bodies of any pair of gears are closed, whatever is taken off their flanks."""

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support.binary_gltf import volume_within
from tests.support.random_drives import drives
from tribodyn.drawing.shapes import parts_of_pair
from tribodyn.drawing.surface import surface_of
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.modification import FlankModification, LeadRelief, Modifications, Relief


@settings(max_examples=15)
@given(drive=drives(), tip=st.floats(0.0, 0.03), crowning=st.floats(-0.01, 0.01), both=st.booleans())
def test_surfaces_are_closed_with_modified_flanks(drive, tip, crowning, both):
    """Amounts in modules, over a third of the path."""
    assembly = assemble(*drive)
    module, reach = float(assembly.drive.module), float(assembly.r_end - assembly.r_start) / 3.0
    lead = LeadRelief(crowning=crowning * module)
    flank = FlankModification(tip=Relief(tip * module, reach), lead=lead, both_flanks=both)
    for part in parts_of_pair(assembly, 5e-3 * module, Modifications(flank, flank)):
        surface = surface_of(part.shape)
        assert volume_within(surface.point, surface.triangle) > 0.0
