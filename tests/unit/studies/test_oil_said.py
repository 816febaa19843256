"""What is said of a lubricant: numbers in engineers' units, where they are from, and what is extrapolated."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from tribodyn.studies.gears import oil
from tribodyn.studies.gears.oil import oil_data, oil_remarks, oil_table
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.tribology.lubricant import LubricantData


@pytest.fixture(scope="module")
def sheet() -> LubricantData:
    return load_scenario("efficiency-oil-18-36").lubricant


def test_the_table_is_in_the_units_of_a_data_sheet(sheet: LubricantData, monkeypatch: pytest.MonkeyPatch):
    values = {
        "inlet_viscosity": SimpleNamespace(value=0.0321, unit="Pa s", origin="from a", spread=None),
        "pressure_viscosity": SimpleNamespace(
            value=1.75e-8, unit="1/Pa", origin="from b", spread=(1.5e-8, 2e-8)
        ),
        "density": SimpleNamespace(value=855.0, unit="kg/m3", origin="from c", spread=None),
        "slope": SimpleNamespace(value=0.62, unit="1", origin="from d", spread=(0.5, 0.75)),
    }
    monkeypatch.setattr(oil, "oil_values", lambda _: values)
    monkeypatch.setattr(oil, "kinematic_viscosity", lambda cold, hot, at: 4.5e-5)
    rows = {name: rest for name, *rest in oil_table(sheet).rows}
    assert rows["inlet_viscosity"] == ["32.1", "mPa s", "from a", ""]
    assert rows["pressure_viscosity"] == ["17.5", "1/GPa", "from b", "15 to 20"]
    assert rows["density"] == ["855", "kg/m3", "from c", ""]
    assert rows["slope"] == ["0.62", "", "from d", "0.5 to 0.75"]
    assert rows["kinematic_viscosity"] == ["45", "mm2/s", "ASTM D341", ""]
    assert not {"type", "oil_temperature", "temperature"} & rows.keys()
    data = oil_data(sheet)
    assert (data["slope"]["spread"], data["slope"]["value"], data["density"]["unit"]) == (
        [0.5, 0.75],
        0.62,
        "kg/m3",
    )
    assert "spread" not in data["density"]


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
        assert all(f"at {celsius:g} °C" in one for one in remarks)
