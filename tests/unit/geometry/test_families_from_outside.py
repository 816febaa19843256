"""A tooth family that another package offers is used by its name like our own."""

import importlib.metadata

import pytest

from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import FAMILIES, family, involute
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.material import MaterialData
from tribodyn.mesh.by_compliance import mesh_cycle_of
from tribodyn.mesh.data import MeshData
from tribodyn.studies.gear_pair.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

STEEL = MaterialData("steel", 206e9, 0.3, 7850.0, 46.0, 470.0, 6e9)
OUTSIDE = involute.FAMILY._replace(name="mine", about="from outside", involute=False)
BODIES = [GearBody(teeth, 0.0, 1.0, 1.25, 0.25, 0.02, bore) for teeth, bore in ((23.0, 0.015), (47.0, 0.025))]
DRIVE = Drive(0.003, 0.35, *BODIES)


class Entry:
    name, value, dist = "mine", "somewhere:FAMILY", None

    def load(self):
        return OUTSIDE


@pytest.fixture
def offered(monkeypatch):
    """Offer the family as an installed package would, to a registry that has not looked yet."""
    found = importlib.metadata.entry_points

    def entry_points(**wanted):
        return [Entry()] if wanted == {"group": "tribodyn.families"} else found(**wanted)

    monkeypatch.setattr(importlib.metadata, "entry_points", entry_points)
    FAMILIES.__dict__.pop("_outside", None)
    yield
    FAMILIES.__dict__.pop("_outside", None)
    FAMILIES._loaded.pop("mine", None)


@pytest.mark.usefixtures("offered")
def test_it_is_listed_and_tabulated():
    assert "mine" in set(FAMILIES)
    ours, theirs = (
        mesh_cycle_of(check(family(name), DRIVE), (STEEL, STEEL), MeshData("energy", 0.05), 100.0)
        for name in ("involute", "mine")
    )
    assert (theirs.compliance == ours.compliance).all()


@pytest.mark.usefixtures("offered")
def test_a_scenario_names_it():
    case = load_scenario("involute-23-47", {"drive.family": "mine"})
    assert case.family == "mine"
    assert prepare(case).cycle.contact_ratio > 1
