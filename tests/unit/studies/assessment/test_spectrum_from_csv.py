"""Load spectra from CSV files, and Miner sums duty by duty: first classes of ISO 6336-6:2019, annex C."""

from pathlib import Path

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.gears.rating.spectrum import spectrum_tables
from tribodyn.studies.assessment.run import check
from tribodyn.studies.protocol.load import load_scenario

SCENARIO = """
title = "annex C"
kind = "assessment"
drive = { like = "spur-25-51", material = "16MnCr5", quality = 6 }
lubricant = "iso-vg-220-mineral"
duty = "spectrum.csv"

[operating]
pinion_speed = "35.2 rpm"
oil_temperature = "80 degC"
duty = 1

[assessment]
dynamic_factor = 1.05
transverse_load_factor = 1.0
face_load_factor = 1.31
required_life = "20 h"
"""
#: Classes 3 to 9: torque kN m, time s, and the share of the damage as printed; K_Hβ is 1.31.
TORQUE = [25.4, 25.3, 25.3, 25.2, 25.1, 25.0, 24.9]
TIME = [24.0, 14.0, 9.0, 14.0, 28.0, 14.0, 9.0]
PRINTED = [0.0243, 0.0138, 0.00889, 0.0135, 0.0262, 0.0128, 0.0080]


def written(folder: Path, text: str = "", scenario: str = SCENARIO) -> Path:
    # a smaller pair: damage goes with torque^(p/2) of whatever pair on the slope of its line
    rows = [f"{time},{28.0 * torque}" for time, torque in zip(TIME, TORQUE, strict=True)]
    text = text or "\n".join(["# classes 3 to 9", "share [1],pinion_torque [N*m]", *rows])
    (folder / "spectrum.csv").write_text(text + "\n")
    (folder / "pair.toml").write_text(scenario)
    return folder / "pair.toml"


def test_damage_of_every_class_is_as_the_annex_has_it(tmp_path: Path):
    found = check(load_scenario(written(tmp_path)))
    part = found.data["spectrum"]
    assert part["duty_number"] == [1, 2, 3, 4, 5, 6, 7]
    cycles = np.array(TIME) / sum(TIME) * 20.0 * 60.0 * 35.2
    assert part["duty_n"]["pinion"] == pytest.approx(cycles)
    stress, damage = (np.array(part[name]["pinion"]) for name in ("duty_sigma_H", "duty_U_H"))
    assert stress / stress[0] == pytest.approx(np.sqrt(np.array(TORQUE) / TORQUE[0]))
    assert 0.0 < damage[0] < 1e3
    # three digits of both torques, 0.2 % each, to the power of p/2 = 6.6, and of both shares
    assert damage / damage[0] == pytest.approx(np.array(PRINTED) / PRINTED[0], rel=0.034)
    whole = found.data["iso"]["damage_pitting"]["pinion"]
    assert damage.sum() == pytest.approx(whole)
    assert sum(part["duty_U_F"]["gear"]) == pytest.approx(found.data["iso"]["damage_bending"]["gear"])
    pinion, gear = spectrum_tables(part)
    assert (pinion.title, gear.title) == ("Miner's sum of the pinion", "Miner's sum of the gear")
    assert [row[0] for row in pinion.rows] == ["1", "2", "3", "4", "5", "6", "7", "sum"]
    assert pinion.columns[1:5] == ("n", "σ_H (MPa)", "N_H", "U_H")
    endured = float(pinion.rows[0][3])
    assert endured == pytest.approx(cycles[0] / damage[0], rel=1e-3)


def test_a_file_is_the_same_as_its_tables_written_out(tmp_path: Path):
    text = "share [1];power [kW];oil_temperature [degC]\n0.75;20;80\n0.25;10;60\n"
    one = load_scenario(written(tmp_path, text)).pair
    tables = SCENARIO.replace('duty = "spectrum.csv"', "") + "".join(
        f'[[duty]]\nshare = {share}\npower = "{power} kW"\noil_temperature = "{oil} degC"\n'
        for share, power, oil in ((3.0, 20, 80), (1.0, 10, 60))
    )
    other = load_scenario(written(tmp_path, scenario=tables)).pair
    assert one.spectrum == other.spectrum
    changed = load_scenario(written(tmp_path, text), {"duty.1.power": "5 kW"}).pair
    assert changed.spectrum[1][2] == pytest.approx(one.spectrum[1][2] / 2)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("share [1],torque [N*m]\n1,2\n", r'duty.0.torque = "2.0 N\*m": unknown key; did you mean'),
        ("share [1],gear_torque [mm]\n1,2\n", "duty.0.gear_torque .*is not a unit of torque"),
        ("share [1],gear_torque [N*m]\n1,x\n", "duty: line 2: .*is not a number"),
        ("gear_torque [N*m],pinion_speed [rpm]\n1,2\n", "duty.0.share: missing"),
        ("# nothing\n", r"begin it with share \[unit\],output_torque \[unit\]"),
    ],
)
def test_mistakes_name_the_file_and_the_row(tmp_path: Path, text: str, message: str):
    with pytest.raises(InputError, match=message) as error:
        load_scenario(written(tmp_path, text))
    assert "spectrum.csv" in str(error.value)


def test_a_missing_file_says_how_one_begins(tmp_path: Path):
    path = written(tmp_path)
    with pytest.raises(InputError, match=r'duty = "none.csv": no such file.*share \[unit\],output_torque'):
        load_scenario(path, {"duty": "none.csv"})
