"""Load spectra: each duty is the scenario that says the same by itself."""

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.grid.engines import engine_of
from tribodyn.grid.grid import Grid
from tribodyn.grid.run import run, settings_of
from tribodyn.post.sweep_report import weighted_mean
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.studies.efficiency.run import quantities_of, spectrum_quantities
from tribodyn.studies.protocol.load import load

EFFICIENCY = "efficiency-involute-18-36"
SPECTRUM = [
    {"share": 3.0, "gear_torque": "300 N*m"},
    {"share": 1.0, "power": "20 kW", "gear_speed": "1500 rpm"},
    {"share": 1.0, "pinion_speed": "3000 rpm"},
]


def loaded(name=EFFICIENCY, **changes):
    changes = {key.replace("__", "."): value for key, value in changes.items()}
    return load(name, {"duty": SPECTRUM} | changes).case


def test_a_duty_takes_the_place_of_speed_and_load():
    base = load(EFFICIENCY).case.operating
    operating = [duty.operating for _, duty in loaded().spectrum]
    assert [share for share, _ in loaded().spectrum] == pytest.approx([0.6, 0.2, 0.2])
    assert operating[0].gear_torque == 300.0
    assert operating[0].pinion_speed == base.pinion_speed
    assert operating[1].pinion_speed == pytest.approx(2 * 1500 * 2 * np.pi / 60)
    assert operating[1].gear_torque == pytest.approx(20e3 / (1500 * 2 * np.pi / 60))
    assert operating[2].gear_torque == base.gear_torque
    assert loaded().operating == operating[0]
    second = loaded(operating__duty=2)
    assert second.operating == operating[1]
    assert second.spectrum == ()


def test_the_spectrum_is_the_energy_of_its_duties():
    found = spectrum_quantities(loaded())
    alone = [
        quantities_of(load(EFFICIENCY, {"operating.gear_torque": "300 N*m"}).case),
        quantities_of(loaded(operating__duty=2)),
        quantities_of(load(EFFICIENCY, {"operating.pinion_speed": "3000 rpm"}).case),
    ]
    assert found["duty_efficiency"] == pytest.approx([summary["efficiency"] for summary in alone], rel=1e-12)
    shares = np.array([0.6, 0.2, 0.2])
    put_in = shares @ [summary["power_in_mean"] for summary in alone]
    lost = shares @ [summary["power_friction_mean"] for summary in alone]
    assert found["spectrum_power_friction_mean"] == pytest.approx(lost)
    assert found["spectrum_efficiency"] == pytest.approx(1 - lost / put_in, rel=1e-9)
    assert quantities_of(load(EFFICIENCY).case).keys().isdisjoint(found)


@pytest.mark.parametrize("name", ["involute-18-36", "load-contact-18-36"])
def test_other_studies_run_the_duty_that_is_named(name):
    with pytest.raises(InputError, match=r"add duty = 1, or sweep operating\.duty over"):
        loaded(name)
    case = loaded(name, operating__duty=1)
    assert getattr(case.pair, "operating", case).gear_torque == 300.0


def test_mistakes_name_the_duty():
    wrong = [*SPECTRUM[:2], {"share": 1.0, "power": "1 kW", "gear_torque": "1 N*m"}]
    with pytest.raises(InputError, match=r"duty.2.power: gives the load, as gear_torque does"):
        load(EFFICIENCY, {"duty": wrong})
    with pytest.raises(InputError, match=r"duty.1.gear_torque = 0 N\*m: must not be zero"):
        load(EFFICIENCY, {"duty": [SPECTRUM[0], {"share": 1.0, "gear_torque": "0 N*m"}]})
    with pytest.raises(InputError, match=r"operating.duty = 4: the load spectrum has 3"):
        loaded(operating__duty=4)
    with pytest.raises(InputError, match="there is no load spectrum"):
        load(EFFICIENCY, {"operating.duty": 1})


def test_a_sweep_over_the_duties_has_means_over_time(tmp_path):
    path = tmp_path / "duties.h5"
    grid = Grid(EFFICIENCY, ["operating.duty=1:3:1"], {"duty": SPECTRUM})
    with engine_of("native", 1, None) as engine:
        run(grid, settings_of(grid), engine, path)
    with SweepRecord(path) as record:
        values = record["power_friction_mean"]
        assert weighted_mean(record, "power_friction_mean") == pytest.approx(values @ [0.6, 0.2, 0.2])
