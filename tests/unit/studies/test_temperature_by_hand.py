"""Heat, temperatures and losses of a case from numbers that can be followed by hand."""

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.studies.gears import temperature
from tribodyn.studies.gears.temperature import Thermal, contact_figures, thermal_figures, thermal_state
from tribodyn.tribology.bulk_temperature import Heat, Temperatures
from tribodyn.tribology.oil import TEMPERATURE_RANGE


def loss(power: float, *exceeded: str) -> Any:
    return SimpleNamespace(power=power, exceeded=exceeded)


@pytest.mark.parametrize("housing", [True, False])
@pytest.mark.parametrize(
    "names", [(), ("churning",), ("windage", "bearings"), ("churning", "windage", "bearings")]
)
def test_heat_arises_in_teeth_oil_and_bearings(names: tuple[str, ...], housing: bool):
    """Half of friction in either gear; bearings heat the housing, or without one the oil."""
    powers = {"churning": 30.0, "windage": 7.0, "bearings": 11.0}
    found = temperature._heat(100.0, {name: loss(powers[name]) for name in names}, housing)
    in_oil = sum(powers[name] for name in names if name != "bearings")
    bearings = 11.0 if "bearings" in names else 0.0
    assert tuple(found[:2]) == (50.0, 50.0)
    assert found[2] == pytest.approx(in_oil if housing else in_oil + bearings)
    assert found[3] == pytest.approx(bearings if housing else 0.0)
    assert found.total == pytest.approx(100.0 + in_oil + bearings)


def asked_with(**changed: Any) -> Any:
    given = {
        "model": "iso",
        "lubrication": "spray",
        "tip_relief_factor": 1.1,
        "mesh_loss": None,
        "pinion_oil": 20.0,
        "gear_oil": 40.0,
        "oil_flow": 3e-5,
        "oil_housing": 15.0,
        "housing_ambient": 9.0,
        "ambient_temperature": 295.0,
    }
    return SimpleNamespace(**given | changed)


def case_with(**changed: Any) -> Any:
    width = {"pinion": SimpleNamespace(face_width=0.03), "gear": SimpleNamespace(face_width=0.025)}
    lubricant = SimpleNamespace(temperature=350.0, density=850.0, sheet=SimpleNamespace(density_15=880.0))
    return SimpleNamespace(**{"drive": SimpleNamespace(**width), "lubricant": lubricant} | changed)


ASSEMBLY: Any = SimpleNamespace(path=SimpleNamespace(pinion_pitch_radius=0.03, gear_pitch_radius=0.07))


def test_the_estimate_of_the_standard():
    """θ_oil + 7400 (P/(a b))^0.72 X_S/(1.2 X_Ca), kW and mm, over the narrower face."""
    found, given_off = temperature._temperatures(
        case_with(), ASSEMBLY, asked_with(), Heat(50.0, 50.0, 0.0, 0.0), 100.0, 350.0
    )
    expected = 350.0 + 7400.0 * (0.1 / (100.0 * 25.0)) ** 0.72 * 1.2 / 1.1 / 1.2
    assert (found.pinion, found.gear) == (
        pytest.approx(expected, rel=1e-12),
        pytest.approx(expected, rel=1e-12),
    )
    assert (found.oil, found.housing, given_off) == (350.0, 350.0, None)


def test_the_network_is_that_of_the_table(monkeypatch: pytest.MonkeyPatch):
    """Flow of oil in W/K: volume, density and specific heat at the supply."""
    seen: list[Any] = []
    monkeypatch.setattr(temperature, "specific_heat", lambda density, at: density * 2.0 + at)
    monkeypatch.setattr(temperature, "network_temperatures", lambda *given: seen.append(given) or "found")
    monkeypatch.setattr(temperature, "heat_given_off", lambda network, found, supplied: (found, supplied))
    heat = Heat(50.0, 50.0, 3.0, 4.0)
    found = temperature._temperatures(case_with(), ASSEMBLY, asked_with(model="network"), heat, 100.0, 350.0)
    assert found == ("found", ("found", 350.0))
    ((network, taken, supplied),) = seen
    assert (taken, supplied) == (heat, 350.0)
    assert tuple(network) == (20.0, 40.0, pytest.approx(3e-5 * 850.0 * (1760.0 + 350.0)), 15.0, 9.0, 295.0)


def thermal(losses: dict[str, Any], given_off: float | None = None) -> Thermal:
    found = Temperatures(361.0, 363.0, 352.0, 331.0)
    return Thermal("oil", 100.0, losses, found, Heat(50.0, 50.0, 3.0, 4.0), given_off)  # pyright: ignore[reportArgumentType]


def test_figures_of_losses_and_temperatures():
    losses = {"churning": loss(30.0), "bearings": loss(10.0, "speed", "load")}
    found = thermal_figures(thermal(losses, 55.0), 2000.0, 0.97)
    assert (found["bulk_temperature_pinion"], found["bulk_temperature_gear"]) == (361.0, 363.0)
    assert (found["oil_temperature"], found["housing_temperature"]) == (352.0, 331.0)
    assert (found["heat_given_off"], found["heat_generated"]) == (55.0, 107.0)
    assert (found["power_churning"], found["power_bearings"], found["power_load_independent"]) == (
        30.0,
        10.0,
        40.0,
    )
    assert found["efficiency_with_losses"] == pytest.approx(0.97 * 2000.0 / 2040.0)
    assert found["losses_outside"] == "bearings: speed; bearings: load"
    plain = thermal_figures(thermal({}), 2000.0, 0.97)
    assert not {"housing_temperature", "power_load_independent", "losses_outside"} & plain.keys()
    assert "losses_outside" not in thermal_figures(thermal({"churning": loss(30.0)}), 2000.0, 0.97)
    assert thermal_figures(None, 2000.0, 0.97) == {}


def test_the_hottest_contact():
    oil: Any = SimpleNamespace(temperature=350.0)
    unknown: Any = SimpleNamespace(temperature=None)
    figures = {"flash_temperature_max": 45.0}
    assert contact_figures(oil, figures) == {"contact_temperature_max": 395.0}
    assert contact_figures(oil, figures | {"bulk_temperature": 370.0}) == {"contact_temperature_max": 415.0}
    assert contact_figures(unknown, figures) == {}


@dataclass
class Asking:
    """A case as far as its temperature reads it."""

    temperature: Any
    losses: Any
    lubricant: Any


@dataclass
class Oil:
    """An oil at a temperature."""

    temperature: float
    supply: float = 0.0


def test_loss_oil_and_temperature_settle_together(monkeypatch: pytest.MonkeyPatch):
    """Friction at the bulk temperature, losses in the oil around the gears; both ends are checked."""
    steps: list[Any] = []

    def fixed_point(step: Any, start: Any, limits: Any) -> Any:
        assert start == (350.0, 350.0)
        steps.append(step(start))
        steps.append(step((360.0, 355.0)))
        return steps[-1]

    def idle(case: Any, assembly: Any, oil: Oil) -> dict[str, Any]:
        return {"churning": loss(oil.temperature)}

    def temperatures(case: Any, assembly: Any, asked: Any, heat: Heat, lost: float, supplied: float) -> Any:
        assert supplied == 350.0
        return Temperatures(lost, lost + 2.0, heat.total / 3.0, 0.0), 7.0

    monkeypatch.setattr(temperature, "fixed_point", fixed_point)
    monkeypatch.setattr(temperature, "lubricant_at", lambda oil, at: Oil(at))
    monkeypatch.setattr(temperature, "idle_losses", idle)
    monkeypatch.setattr(temperature, "_temperatures", temperatures)
    monkeypatch.setattr(temperature, "_refuse_unknown", lambda one, asked: None)

    def lost(case: Asking) -> float:
        return case.lubricant.temperature + case.lubricant.supply / 10.0

    asked = asked_with(housing_ambient=0.0)
    found = thermal_state(Asking(asked, "losses", Oil(350.0)), ASSEMBLY, lost)
    assert found is not None
    assert (found.lubricant, found.mesh_loss) == (Oil(360.0, 355.0), 360.0 + 35.5)
    assert found.losses["churning"].power == 355.0
    assert found.heat.total == pytest.approx(395.5 + 355.0)
    assert found.given_off == 7.0
    assert steps[1] == (found.temperatures.bulk, found.temperatures.oil)  # pyright: ignore[reportOptionalMemberAccess]
    known = thermal_state(Asking(asked_with(mesh_loss=80.0), None, Oil(350.0)), ASSEMBLY, lost)
    assert known is not None
    assert known.mesh_loss == 80.0
    cold = thermal_state(Asking(None, "losses", Oil(345.0)), ASSEMBLY, lost)
    assert cold is not None
    assert (cold.temperatures, cold.mesh_loss, cold.losses["churning"].power) == (None, 345.0, 345.0)
    assert thermal_state(Asking(None, None, Oil(345.0)), ASSEMBLY, lost) is None


def test_oil_is_known_between_two_temperatures():
    low, high = TEMPERATURE_RANGE
    for inside in (low, high, 350.0):
        temperature._refuse_unknown(inside, asked_with())
    with pytest.raises(InputError, match="let more heat off"):
        temperature._refuse_unknown(high + 1.0, asked_with())
    with pytest.raises(InputError, match="ambient_temperature"):
        temperature._refuse_unknown(low - 1.0, asked_with())
    assert np.isfinite(low)
