"""Whether a run has settled, what is engagement and what bearings: against other runs, and by hand."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.gears.motion.steady import on_settling, on_settling_of_meshes

SAMPLES = 100
CYCLES = np.arange(10 * SAMPLES) / SAMPLES


def motion(order: float, amplitude: float, decay: float) -> np.ndarray:
    """The mesh's own motion of amplitude 1, and another one that decays by so much per cycle."""
    return np.sin(2.0 * np.pi * CYCLES) + amplitude * np.exp(-decay * CYCLES) * np.cos(
        2.0 * np.pi * order * CYCLES
    )


@pytest.mark.parametrize(
    ("order", "amplitude", "decay", "said"),
    [
        (0.26, 0.5, 0.05, True),
        (0.26, 0.01, 0.05, False),
        (0.5, 0.5, 0.0, False),  # repeats after two cycles
        (1.0, 2.0, 0.3, True),  # of the mesh's own frequency, but it falls
        (3.0, 0.5, 0.0, False),
    ],
)
def test_what_still_changes_is_no_steady_motion(order: float, amplitude: float, decay: float, said: bool):
    assert bool(on_settling([motion(order, amplitude, decay)], SAMPLES)) is said


def test_less_than_two_periods_and_teeth_at_rest_say_nothing():
    assert on_settling([motion(0.26, 0.5, 0.05)], 6 * SAMPLES) == ""
    assert on_settling([np.zeros(400)], SAMPLES) == ""


@pytest.mark.parametrize(
    ("amplitude", "decay", "said"),
    [(0.5, 0.2, "fades over the 10 cycles"), (1.5, 0.0, "solver.cycles = 184, with"), (0.02, 0.2, "")],
)
def test_meshes_that_repeat_together_late_are_judged_by_what_is_of_neither(
    amplitude: float, decay: float, said: str
):
    errors = motion(1.7, amplitude, decay) + 0.7 * np.cos(2.0 * np.pi * 9 / 23 * CYCLES + 1.0)
    remark = on_settling_of_meshes([errors], [1.0, 9 / 23], SAMPLES, 40, 23)
    assert said in remark
    assert bool(remark) is bool(said)


@pytest.mark.parametrize(("cycles", "period", "enough"), [(20, 83, 40), (20, 3, 24), (20, 35, 35)])
def test_few_cycles_of_a_slow_mesh_tell_nothing(cycles: int, period: int, enough: int):
    remark = on_settling_of_meshes(
        [motion(0.26, 0.5, 0.05)[: 5 * SAMPLES]], [1.0, 0.2530], SAMPLES, cycles, period
    )
    assert f"solver.cycles = {enough} are enough" in remark


def test_a_run_that_says_so_is_far_from_the_steady_motion_and_one_that_does_not_is_there():
    """Of a pair at 15 000 rpm: 20 cycles end before the bearings' vibration does."""
    source, free, speed = "spur-25-51", {"friction.law": "none"}, "15000 rpm"
    short, long = (
        td.run(
            source,
            free | {"operating.pinion_speed": speed, "solver.cycles": cycles},
            progress=False,
        ).summary
        for cycles in (20, 400)
    )
    steady = td.sweep(source, {"operating.pinion_speed": [speed]}, free, progress=False)
    swing = steady["transmission_error_peak_to_peak"].item()
    assert "not settled" in short["settling_remark"]
    assert short["transmission_error_peak_to_peak"] > 1.2 * swing
    assert not long.get("settling_remark")
    assert long["transmission_error_peak_to_peak"] == pytest.approx(swing, rel=5e-3)


def test_a_train_whose_meshes_repeat_late_says_whether_it_is_at_the_steady_motion():
    """Of two stages that repeat together after 61 cycles, against a run judged by two such periods."""
    few, short, long, steady = (
        td.run(
            "two-stage-reducer-hunting",
            {"friction.law": "none", "output.samples_per_cycle": 40, "solver.cycles": cycles},
            progress=False,
        ).summary
        for cycles in (20, 61, 122, 488)
    )
    swing = steady["transmission_error_peak_to_peak"]
    assert "cannot be told by the 5 cycles" in few["settling_remark"]
    assert "not settled" in short["settling_remark"]
    assert short["transmission_error_peak_to_peak"] > 1.1 * swing
    assert not long.get("settling_remark")
    assert not steady.get("settling_remark")
    assert long["transmission_error_peak_to_peak"] == pytest.approx(swing, rel=1e-3)


def test_far_below_all_resonances_a_dynamic_factor_is_the_engagement_of_the_energy_method():
    """Teeth whose loaded corners touch before the path of contact begins have none at 60 rpm."""
    energy, elements = (
        td.run(
            "spur-25-51",
            {
                "operating.pinion_speed": "60 rpm",
                "friction.law": "none",
                "mesh.compliance": compliance,
                "solver.cycles": 8,
            },
            progress=False,
        ).summary
        for compliance in ("energy", "fem")
    )
    assert energy["dynamic_factor"] > 1.3
    assert "K_v 1." in energy["engagement_remark"]
    assert elements["dynamic_factor"] < 1.05
    assert not elements.get("engagement_remark")


@pytest.mark.parametrize(("stiffness", "soft"), [(2e7, True), (1e9, False)])
def test_a_transmission_error_that_is_of_bearings_is_told_by_them(stiffness: float, soft: bool):
    """Either gear gives way by F_n/k along the path of contact: 2 F_t/(k cos² α) at the pitch radius."""
    springs = {f"bearings.{side}.stiffness_{axis}": stiffness for side in ("pinion", "gear") for axis in "xy"}
    rest = {"friction.law": "none", "operating.pinion_speed": "60 rpm", "solver.cycles": 8}
    run = td.run("spur-25-51", {name: f"{k:g} N/m" for name, k in springs.items()} | rest, progress=False)
    of_bearings = 2.0 * 550.0 / (0.5 * 51 * 3e-3) / (stiffness * np.cos(np.radians(20.0)) ** 2)
    mean, bent = (run.summary[f"transmission_error_{of}mean"] for of in ("", "normal_"))
    assert mean - bent / np.cos(np.radians(20.0)) == pytest.approx(of_bearings, rel=0.02)
    assert ("bearings are soft" in " ".join(run.verdict)) is soft
