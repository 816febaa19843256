"""What is said of a lubricant: numbers in engineers' units, where they are from, and what is extrapolated."""

from dataclasses import replace
from typing import Any

import pytest

from tribodyn.gears.check import oil_data, oil_remarks, oil_table
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.tribology.oil import LubricantData


@pytest.fixture(scope="module")
def sheet() -> LubricantData:
    return load_scenario("efficiency-oil-18-36").lubricant


def test_oil_in_the_mesh_may_be_warmer_than_around_it(sheet: LubricantData):
    cold: Any = replace(sheet, temperature=353.15, supply=None)
    assert oil_data(cold)["oil_temperature"]["value"] == oil_data(cold)["temperature"]["value"] == 353.15
    assert oil_table(cold).title.endswith("at 80 °C")
    warm: Any = replace(cold, temperature=363.15, supply=348.15)
    assert oil_data(warm)["oil_temperature"]["value"] == 348.15
    assert oil_data(warm)["temperature"]["value"] == 363.15
    assert oil_table(warm).title.endswith("at 90 °C, bulk temperature of the teeth")
    given = replace(cold, sheet=None)
    assert oil_remarks(given) == []
    for celsius, said in ((39.0, True), (40.0, False), (100.0, False), (101.0, True)):
        (*remarks,) = oil_remarks(replace(cold, temperature=celsius + 273.15))
        assert bool(remarks) == said
        assert all(f"at {celsius:g} °C" in remark for remark in remarks)
