"""Results outside their model are complete and marked: in the record, and in all that is shown of it."""

import json
import re
from pathlib import Path

import h5py
import numpy as np
import pytest

import tribodyn
from tests.support.record_samples import block, gear_pair_writer, geometry, printed
from tests.support.verbs import ended, invoke
from tribodyn.cli.printing import plain
from tribodyn.errors import SimulationError
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE, SweepLayout, VariedKey
from tribodyn.record.sweep_writer import SweepHead, SweepWriter
from tribodyn.record.trust import (
    EXTRAPOLATED,
    INSIDE,
    OUTSIDE,
    RULES,
    Judge,
    attributes,
    brief,
    heat_of,
    judge_tribology,
    number,
    reasons,
    verdict,
)
from tribodyn.record.withheld_efficiency import remarked, remarks, warned, warnings
from tribodyn.studies.pages import summary_json, summary_table, sweep_table
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

DOCS = Path(__file__).parents[3] / "docs"


def judged(**quantities):
    judge = Judge()
    judge.take(quantities)
    return judge.summary()


@pytest.mark.parametrize("name", RULES)
def test_every_limit_is_a_limit(name):
    """A little below it the result is inside, a little above outside, with value, limit and unit."""
    rule = RULES[name]
    assert judged(**{name: rule.most * (1 - 1e-6)}) == {"trust": INSIDE}
    assert judged(**{name: np.full(5, rule.most)}) == {"trust": INSIDE}
    figures = judged(**{name: rule.most * 1.01})
    assert figures["trust"] == (EXTRAPOLATED if rule.extrapolates else OUTSIDE)
    reason = figures["trust_reasons"][name]
    assert (reason["value"], reason["limit"], reason["units"]) == (rule.most * 1.01, rule.most, rule.units)
    assert reason["share"] is None
    (said,) = reasons(figures)
    assert said.startswith(rule.label)
    assert "at most" in said
    assert (rule.label in brief(figures)) is not rule.extrapolates
    assert any(said in warning for warning in warnings(figures)) is not rule.extrapolates


def test_an_efficiency_below_zero_and_one_above_one():
    assert judged(efficiency=[0.0, 1.0, 0.5, np.nan]) == {"trust": INSIDE}
    below = judged(efficiency=-0.2)
    assert "at least" in reasons(below)[0]
    assert "below" in brief(below)
    assert "efficiency 106 %, at most 100 %" in reasons(judged(efficiency=1.06))[0]


def test_share_and_place_of_the_worst_value():
    """Shares count samples in which any pair is outside; values between samples count in none."""
    judge = Judge()
    pressure = np.full((10, 2), 1e9)
    pressure[3, 1], pressure[4, 0], pressure[7, 1] = 5e9, 4.5e9, np.nan
    cycles = np.linspace(0.0, 0.9, 10)
    judge.take({"hertz_pressure": pressure}, {"mesh_cycle": cycles, "time": 2 * cycles}, [0, 1])
    judge.take({"hertz_pressure": pressure * 0.5}, {"mesh_cycle": 1 + cycles, "time": 2 + 2 * cycles}, [0, 1])
    reason = judge.summary()["trust_reasons"]["hertz_pressure"]
    assert reason["share"] == pytest.approx(2 / 20)
    assert (reason["value"], reason["pair"]) == (5e9, 1)
    assert (reason["mesh_cycle"], reason["time"]) == pytest.approx((0.3, 0.6))
    judge.take({"hertz_pressure": [[6e9, 0.0]]}, {"mesh_cycle": [5.25]}, [0, 1], between_samples=True)
    figures = judge.summary()
    again = figures["trust_reasons"]["hertz_pressure"]
    assert again["share"] == reason["share"]
    assert (again["value"], again["pair"], again["mesh_cycle"]) == (6e9, 0, 5.25)
    (said,) = reasons(figures)
    assert said == (
        "Hertz pressure 6 GPa, at most 4 GPa, outside in 10 % of the samples, worst mesh cycle 5.25, pair 0"
    )
    alone = Judge()
    alone.take({"hertz_pressure": pressure * 0.5})
    alone.take({"hertz_pressure": [[6e9, 0.0]]}, between_samples=True)
    assert reasons(alone.summary()) == ["Hertz pressure 6 GPa, at most 4 GPa, outside between samples only"]


def test_nothing_is_outside_where_nothing_is_known():
    assert judged() == {}
    assert judged(friction_coefficient=np.full((3, 2), np.nan))["trust"] == INSIDE
    assert judged(hertz_pressure=np.inf)["trust"] == OUTSIDE
    assert (verdict({}), number({}), attributes({}), warnings({})) == ("", -1, {}, [])
    assert (number({"trust": INSIDE}), number({"trust": OUTSIDE})) == (1, 0)
    # a record from a stranger
    for odd in (
        {"trust": "x"},
        {"trust": OUTSIDE},
        {"trust": OUTSIDE, "trust_reasons": {"x": 1, "efficiency": {}}},
    ):
        assert reasons(odd) == []


@pytest.fixture
def outside():
    """Figures of a run with two reasons."""
    figures = judged(deflection=np.array([[0.01, 0.2], [0.05, 0.3]]), efficiency=1.0597)
    return figures | {"efficiency": 1.0597, "mesh_frequency": 3.0}


def test_the_record_says_so(tmp_path, outside):
    with gear_pair_writer(tmp_path / "run.h5", 9, outlines=geometry()) as writer:
        writer.write(0, block(0, 9))
        writer.finish(outside)
    with h5py.File(tmp_path / "run.h5") as file:
        assert file.attrs["status"] == "complete"
        assert file.attrs["trust"] == OUTSIDE
        assert "deflection" in str(file.attrs["trust_reasons"])
        assert file["summary"].attrs["trust_reasons/deflection/value"] == 0.3
        assert file["summary"].attrs["trust_reasons/deflection/share"] == 1.0
    with Record(tmp_path / "run.h5") as record:
        assert record.trust == OUTSIDE
        text = printed(summary_table(record, full=True))
        found = json.loads(json.dumps(plain(summary_json(record)), allow_nan=False))
    assert text.splitlines()[1].startswith(OUTSIDE.capitalize())
    assert (
        "Warning: outside the model: deflection of a pair of teeth over the module 30 %, at most 10 %" in text
    )
    assert "outside the model: efficiency 106 %, at most 100 %" in text
    assert found["trust"] == OUTSIDE
    assert len(found["trust_reasons"]) == 2
    assert found["summary"]["trust_reasons"]["efficiency"]["value"] == 1.0597


def test_a_sweep_says_it_case_by_case(tmp_path, outside):
    scale = VariedKey("speed", "operating.pinion_speed", "rad/s", (1.0, 2.0, 3.0))
    layout = SweepLayout({"efficiency": QUANTITIES["efficiency"].variable()})
    head = SweepHead('kind = "efficiency"', "0", (scale,), "", (), layout)
    with SweepWriter(tmp_path / "sweep.h5", head) as writer:
        rows = layout.empty_rows(3)
        rows["trust"][:] = 1, 0, 0
        for i, deflection in ((1, 0.3), (2, 0.4)):
            said = remarks(judged(deflection=deflection))
            rows["message"][i] = remarked(*map(warned, said))
        rows["status"][:] = DONE
        writer.write(np.arange(3), rows)
        writer.finish({})
    with SweepRecord(tmp_path / "sweep.h5") as record:
        assert record["trust"].tolist() == [1, 0, 0]
        assert record.meanings("trust")[0] == "outside_the_model"
        text = printed(sweep_table(record))
    assert (
        "Warning: 2 of 3 cases: outside the model: deflection of a pair of teeth over the module above 10 %"
        in text
    )


def test_an_absurd_load_is_loud(tmp_path):
    """500 kN m on a drive for 500 N m: complete, exit status 0, every reason on the terminal and in JSON."""
    words = ["involute-23-47", "--set", "operating.gear_torque=500 kN*m", "--set", "solver.cycles=2"]
    output = tmp_path / "much.h5"
    done = ended("run", *words, "--no-plot", "--json", "--output", output)
    assert done.exit_code == 0
    found = json.loads(done.stdout)
    assert (found["status"], found["trust"]) == ("complete", OUTSIDE)
    named = found["summary"]["trust_reasons"]
    assert {"deflection", "hertz_pressure", "bearing_displacement"} <= set(named)
    assert named["deflection"]["value"] > 0.5
    for reason in found["trust_reasons"]:
        extrapolated = reason.startswith("share of the contact")
        assert (f"warning: {OUTSIDE}: {reason}" in done.stderr) is not extrapolated
    assert invoke("show", output).splitlines()[1].startswith(OUTSIDE.capitalize())
    usual = run(load_scenario("involute-23-47", {"solver.cycles": 2}), tmp_path / "usual.h5")
    assert (usual.trust, usual.reasons) == (INSIDE, [])


def test_extrapolated_laws_are_no_excess():
    """Beside a rule of the model they are a reason more; alone, a verdict of their own."""
    alone = judged(film_law_range=1.0, hertz_pressure=1e9)
    assert (verdict(alone), number(alone), warnings(alone)) == (EXTRAPOLATED, 2, [])
    assert reasons(alone) == [
        "share of the contact in which the film law is outside its range 100 %, at most 99 %"
    ]
    both = judged(film_law_range=1.0, hertz_pressure=5e9)
    assert (verdict(both), len(reasons(both)), len(warnings(both))) == (OUTSIDE, 2, 1)


def test_films_are_judged_by_their_minimum_and_ranges_where_laws_have_one():
    figures = {
        "film_min": 134e-6,
        "film_parameter_min": 189.0,
        "closure_in_range_fraction": 0.0,
        "friction_in_range_fraction": None,
    }
    judge = Judge()
    judge_tribology(judge, figures)
    assert set(judge.summary()["trust_reasons"]) == {"film_thickness", "film_parameter", "film_law_range"}
    judge = Judge()
    judge_tribology(judge, {"film_min": 1e-6, "friction_in_range_fraction": 0.02})
    assert judge.summary() == {"trust": INSIDE}
    judge = Judge()
    judge_tribology(judge, {})
    assert judge.summary() == {}


def test_heat_is_judged_above_the_temperature_that_is_known():
    assert judged(**heat_of(600.0, None))["trust"] == OUTSIDE
    assert judged(**heat_of(450.0, 353.0))["trust"] == OUTSIDE
    assert judged(**heat_of(450.0, 263.0)) == judged(**heat_of(450.0, None)) == {"trust": INSIDE}


#: A gear of the soak's draws, in an oil of 4 Pa·s.
COLD = {
    "lubricant": {
        "type": "ester",
        "viscosity_40": "150 mm**2/s",
        "viscosity_100": "15.27 mm**2/s",
        "density_15": "0.88 g/cm**3",
    },
    "operating.oil_temperature": "-10 degC",
}


@pytest.mark.parametrize("name", ["efficiency-involute-18-36", "involute-18-36"])
def test_films_and_temperatures_beyond_any_use(name):
    """Ten times the speed at −10 °C, and half of the load as friction."""
    fast = {"operating.pinion_speed": "15000 rpm", "friction": {"law": "coulomb", "coefficient": 0.5}}
    found = tribodyn.run(name, COLD | fast | ({} if name.startswith("efficiency") else {"solver.cycles": 2}))
    assert found.trust == OUTSIDE
    named = found.summary["trust_reasons"]
    assert {"contact_temperature", "film_thickness", "film_law_range"} <= set(named)
    assert named["contact_temperature"]["value"] == pytest.approx(found.summary["contact_temperature_max"])
    assert named["film_thickness"]["value"] == found.summary["film_min"]
    assert any(reason.startswith("minimum film thickness") for reason in found.reasons)
    assert f"complete, {OUTSIDE}: " in repr(found)
    shown = found._repr_html_()
    assert all(text in shown for text in ("How far to trust it", OUTSIDE, found.reasons[0]))


def test_friction_that_locks_the_mesh_is_said():
    """Xu's exp(S) runs away at Ra 1.6 µm: no load balances the torque, and no temperature is sought."""
    rough = {
        "operating.oil_temperature": "60 degC",
        "friction": {"law": "xu"},
        "drive.roughness": "3 um",
        "drive.mean_roughness": "1.6 um",
        "temperature": {"model": "iso", "lubrication": "dip"},
    }
    with pytest.raises(SimulationError, match=r"friction locks the mesh .* coefficients up to \d"):
        tribodyn.run("involute-18-36", COLD | rough)


def test_the_page_lists_the_rules_as_they_are():
    text = (DOCS / "trust.md").read_text(encoding="utf-8")
    rows = dict(re.findall(r"^\| `(\w+)` \| [^|]+ \| ([^|]+) \|", text, re.MULTILINE))
    assert list(rows) == list(RULES)
    for name, rule in RULES.items():
        assert rule.shown(rule.most) in rows[name], name
        assert rule.label in text.replace("\n", " "), name
