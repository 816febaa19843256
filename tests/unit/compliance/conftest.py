"""What several tests of the compliance take long to prepare."""

import pytest

from tests.support.faces_in_slices import DRIVE, STEEL
from tribodyn.compliance.sharing.load_sharing import flexibility
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.studies.protocol.load import load_scenario


@pytest.fixture(scope="module")
def pair():
    return flexibility(assemble(FAMILY, DRIVE), (STEEL, STEEL), lead=True)


@pytest.fixture(scope="module")
def case():
    return load_scenario("involute-18-36-fem").pair
