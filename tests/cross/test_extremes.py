"""Extremes between samples: of few samples as of very many, whatever the method, alone and in lanes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support.states import recorded
from tribodyn.dynamics.recorded.extremes import LOWEST
from tribodyn.dynamics.recorded.outputs import evaluated_with_extremes
from tribodyn.gears.motion.extremes import RECORDED, RunningExtremes
from tribodyn.record.reader import Record
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import SampledStates, TransientSettings, make_integrator, transient
from tribodyn.studies.motion.batch import BATCH
from tribodyn.studies.protocol.batch import Chunk
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

#: What few samples are to give of very many.
EXACT = 5e-3
#: Extremes that spur pairs have: line loads are those of slices.
OF_SPUR = {name: where for name, where in RECORDED.items() if name != "line_load_max"}
#: Samples of a mesh cycle that miss nothing.
MANY = 20000
RATTLE = ("rattle", {"operating.pinion_speed": "20 rad/s", "mesh.backlash": "0.01 mm"})


def extremes_of_run(prepared, samples, method="dopri5", rtol=1e-6, cycles=2, dense=True):
    model = prepared.model
    seen = RunningExtremes(prepared.cycle)
    settings = TransientSettings(method, rtol, cycles, 10**6, samples, extremes=dense)
    for part in transient(model, static_equilibrium(model), settings):
        if isinstance(part, SampledStates):
            for found in evaluated_with_extremes(part.cycles, part.states, part.extremes, model)[1:]:
                seen.add(found.cycles, found.whole["time"], found.meshes[0])
    return seen


def errors(found, exact):
    """Of all extremes, those of transmission errors as shares of their range."""
    result = {}
    for name, extreme in exact.by_name.items():
        scale = abs(extreme.value)
        if name.startswith("transmission"):
            scale = exact.spread(name.removesuffix("_max").removesuffix("_min"))
        result[name] = abs(found.by_name[name].value - extreme.value) / scale if scale else 0.0
    return result


@pytest.mark.parametrize(
    ("name", "overrides"),
    [
        ("crc-23-47", {}),
        ("crc-23-47-300", {"operating.source": "torque", "mesh.formulation": "energy-consistent"}),
        ("involute-23-47", {"operating.pinion_speed": "100 rad/s", "friction.sliding": "dynamic"}),
        ("cycloidal-23-47", {"operating.pinion_speed": "300 rad/s"}),
        RATTLE,
    ],
)
def test_few_samples_give_the_extremes_of_very_many(name, overrides, prepared):
    case = prepared(name, **overrides)
    exact = extremes_of_run(case, MANY, dense=False)
    found = errors(extremes_of_run(case, 20), exact)
    assert max(found.values()) < EXACT / 10, found
    # the test is worth something: samples alone would not do
    assert max(errors(extremes_of_run(case, 20, dense=False), exact).values()) > EXACT


def test_contact_is_lost_in_the_case_with_backlash(prepared):
    model = prepared(RATTLE[0], **RATTLE[1]).model
    touching = recorded(model, TransientSettings("dopri5", 1e-6, 2, 10**6, 200))["normal_load"] > 0.0
    assert np.any(~np.any(touching, axis=1))
    assert np.any(touching[:, 2:])  # back flanks


@pytest.mark.parametrize("method", ["rodas4", "dop853"])
def test_every_method_finds_them(method, prepared):
    case = prepared("crc-23-47", **{"operating.pinion_speed": "100 rad/s"})
    exact = extremes_of_run(case, 20, rtol=1e-9)
    assert max(errors(extremes_of_run(case, 20, method, 1e-7), exact).values()) < EXACT


def test_an_extreme_is_where_it_is_said_to_be(prepared):
    case = prepared("crc-23-47")
    few, many = extremes_of_run(case, 20), extremes_of_run(case, MANY, dense=False)
    for name, extreme in few.by_name.items():
        assert extreme.pair == many.by_name[name].pair
        assert extreme.mesh_cycle == pytest.approx(many.by_name[name].mesh_cycle, abs=2e-3), name
        assert extreme.time == pytest.approx(extreme.mesh_cycle * 2 * np.pi / (23 * 10.0), rel=1e-9)


def test_lanes_find_what_a_single_run_finds(prepared):
    """Within the tolerance of the integration, in windows of several cycles, and whoever runs beside."""
    speeds = [f"{speed} rad/s" for speed in (10, 60, 200, 333, 500, 700, 900, 1000, 1500)]
    models = [prepared("crc-23-47", **{"operating.pinion_speed": speed}).model for speed in speeds]
    states = np.array([static_equilibrium(model) for model in models])
    marching = {"cycles": 3, "window": 3, "samples": 10, "rtol": 1e-6, "extremes": True}
    batch = march(models, states, **marching)
    for case, model in enumerate(models):
        integrator = make_integrator("dopri5", model, 10, tolerances_from(model, states[case], 1e-6, 10**6))
        integrator.extremes = True
        alone = integrator.integrate(states[case], 0, 3).extremes
        assert alone is not None
        for ours, theirs in zip(batch.extremes, alone, strict=True):
            np.testing.assert_allclose(ours[case], theirs, rtol=1e-6, atol=1e-12)
    fewer = march(models[2:4], states[2:4], **marching)
    for ours, theirs in zip(fewer.extremes, batch.extremes, strict=True):
        np.testing.assert_array_equal(ours, theirs[2:4])
    last = march(models, states, **{**marching, "window": 1}).extremes
    assert np.all(last.cycles[last.measure > LOWEST] >= 2.0)
    # what is known of the cycles before decides where it is worth looking closely
    passes = (last.measure - batch.extremes.measure) / np.maximum(np.abs(batch.extremes.measure), 1e-300)
    assert np.max(passes) < 1e-5
    assert np.max(np.abs(passes[batch.extremes.cycles >= 2.0])) < 1e-5


def test_batches_of_other_methods_find_them_too(prepared):
    models = [
        prepared("crc-23-47", **{"operating.pinion_speed": s}).model for s in ("100 rad/s", "300 rad/s")
    ]
    states = np.array([static_equilibrium(model) for model in models])
    marching = {"cycles": 2, "window": 1, "samples": 10, "rtol": 1e-8, "extremes": True}
    native, scipy = (march(models, states, **marching, method=name) for name in ("dopri5", "dop853"))
    np.testing.assert_allclose(scipy.extremes.measure, native.extremes.measure, rtol=1e-4)


def test_figures_of_steady_states_do_not_depend_on_the_samples():
    cases = [
        load_scenario(
            "crc-23-47", {"operating.pinion_speed": "150 rad/s", "output.samples_per_cycle": samples}
        )
        for samples in (16, 4000)
    ]
    few, many = (
        BATCH.evaluate(
            Chunk(np.arange(1), (case,)),
            BATCH.settings([case], None, "native")._replace(cycles=200, window=4, points=8),
            None,
        )
        for case in cases
    )
    for name in (*OF_SPUR, "transmission_error_peak_to_peak", "dynamic_factor"):
        assert few[name][0] == pytest.approx(many[name][0], rel=EXACT / 10), name


@settings(max_examples=5)
@given(samples=st.integers(8, 90), speed=st.floats(30.0, 900.0), cycles=st.integers(1, 6))
def test_a_summary_is_never_at_odds_with_its_record(samples, speed, cycles, tmp_path_factory):
    overrides = {
        "operating.pinion_speed": f"{speed} rad/s",
        "output.samples_per_cycle": samples,
        "solver.cycles": cycles,
    }
    path = tmp_path_factory.mktemp("record") / "run.h5"
    run(load_scenario("crc-23-47", overrides), path)
    with Record(path) as record:
        summary = record.summary
        described = summary["extremes"]
        window = slice(-samples * summary["averaging_cycles"] - 1, None)
        for name, (recorded, sign) in OF_SPUR.items():
            whole, last = (sign * described[of][name]["value"] for of in ("run", "last_cycles"))
            assert whole >= np.nanmax(sign * record[recorded])
            assert whole >= last == sign * summary[name]
            assert last >= np.nanmax(sign * record[recorded][window])
        error = record["transmission_error_rotational"][window]
        assert summary["transmission_error_peak_to_peak"] >= np.ptp(error)
        newest = record["transmission_error_normal"][window, record.pairs.index(1)]
        assert summary["transmission_error_normal_peak_to_peak"] >= np.ptp(newest)


def test_the_last_sample_may_be_the_extreme_of_a_run_and_of_a_sweep(tmp_path):
    """There a new pair is in contact already; means are over whole cycles, which end before it."""
    samples, cycles = 40, 3
    case = load_scenario(
        RATTLE[0], RATTLE[1] | {"solver.cycles": cycles, "output.samples_per_cycle": samples}
    )
    summary = run(case, tmp_path / "run.h5").summary
    swept = BATCH.evaluate(Chunk(np.arange(1), (case,)), BATCH.settings([case], cycles, "native"), None)
    with Record(tmp_path / "run.h5") as record:
        film = record["central_film_thickness"][-samples - 1 :]
        error = record["transmission_error_rotational"][-samples - 1 : -1]
    assert np.nanmin(film) == np.nanmin(film[-1]) < 0.95 * np.nanmin(film[:-1])
    assert summary["film_min"] == summary["extremes"]["last_cycles"]["film_min"]["value"] == np.nanmin(film)
    assert summary["extremes"]["last_cycles"]["film_min"]["mesh_cycle"] == cycles
    for name in (*OF_SPUR, "dynamic_factor", "efficiency"):
        assert swept[name][0] == pytest.approx(summary[name], rel=1e-4, abs=1e-9), name
    assert swept["transmission_error_mean"][0] == pytest.approx(np.mean(error), rel=1e-4)
    assert swept["transmission_error_rms"][0] == pytest.approx(np.std(error), rel=1e-4)
