"""Laws of links: play of a shaft beside a linear one, where closed forms are known; energy; lanes."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.dynamics.recorded.outputs import evaluated, mesh_outputs
from tribodyn.numerics.elementary import law
from tribodyn.record.reader import Record
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import initial_state
from tribodyn.solve.orbit.periodic import steady_states
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.train.structure import turned

STIFFNESS = 2e5
SHAFT = {
    "friction.law": "coulomb",
    "friction.coefficient": 0.06,
    "output.samples_per_cycle": 40,
    "solver.cycles": 9,
    "shaft.0.stiffness": f"{STIFFNESS} N*m/rad",
    "shaft.0.damping_ratio": 0.05,
}
#: Of which half is a tooth of the second pinion: everything stands as it would without.
TOOTH = 2.0 * 2.0 * np.pi / 23.0
PLAY = {**SHAFT, "shaft.0.law": "play", "shaft.0.play": f"{TOOTH!r} rad", "shaft.0.contact_share": 1e-5}
#: Play that opens and closes under a light load.
LIGHT = {
    **SHAFT,
    "shaft.0.law": "play",
    "shaft.0.play": "0.02 deg",
    "operating.output_torque": "20 N*m",
    "operating.output_torque_harmonics": [{"amplitude": "60 N*m", "frequency": "300 Hz"}],
    "mesh.backlash": "0.1 mm",
}


def reducer(keys):
    return load_scenario("two-stage-reducer", keys)


def of_shaft(model):
    """Number of the shaft among the links, and its ends."""
    (link,) = np.flatnonzero(np.asarray(model.links.stiffness)[:, 2])
    return link, model.layout.first[link], model.layout.second[link]


def test_play_under_load_is_a_twist_and_nothing_else():
    """Frequencies stay, the shaft is twisted further by half the play, and the motion is the same."""
    linear, loose = (prepare(reducer(keys)) for keys in (SHAFT, PLAY))
    of = [natural_frequencies(each.model, [made.cycle for made in each.tables]) for each in (linear, loose)]
    np.testing.assert_allclose(of[1], of[0], rtol=1e-5)
    twists = []
    for each in (linear, loose):
        y, (_, first, second) = initial_state(each.model, "static"), of_shaft(each.model)
        twists.append(float(turned(first, y, each.model.layout) - turned(second, y, each.model.layout)))
    assert abs(twists[1] - twists[0]) == pytest.approx(0.5 * TOOTH, rel=1e-4)


def test_the_steady_state_is_that_without_play_a_tooth_further():
    """The same loads of the second mesh, and the same multipliers, by the derivative of the law."""
    models = [prepare(reducer(keys)).model for keys in (SHAFT, {**PLAY, "shaft.0.contact_share": 1e-4})]
    found = steady_states(models, samples=40)
    assert {each.kind for each in found} == {"period-1"}
    samples = [
        evaluated(np.arange(len(each.samples)) / 40, each.samples, model)
        for each, model in zip(found, models, strict=True)
    ]
    linear, loose = (mesh_outputs(1, each)["normal_load"] for each in samples)
    np.testing.assert_allclose(loose, linear, atol=1e-5 * np.max(linear))
    linear, loose = (np.sort(np.abs(each.multipliers)) for each in found)
    np.testing.assert_allclose(loose, linear, rtol=1e-5, atol=1e-8)


def test_energy_closes_where_play_opens_and_both_methods_agree(tmp_path):
    found = {}
    for method in ("dopri5", "rodas4"):
        # a sample beside an impact is as far off as its instant, which the tolerance decides
        keys = {**LIGHT, "solver.method": method, "solver.rtol": 1e-10}
        record = run(reducer(keys), tmp_path / f"{method}.h5")
        assert record.status == "complete"
        assert abs(record.summary["energy_residual"]) < 1e-8
        with Record(record.path) as opened:
            found[method] = {name: opened[name] for name in ("angle", "driven_torque")}
    twist = found["dopri5"]["angle"][:, 1] - found["dopri5"]["angle"][:, 2]
    half = 0.5 * np.radians(0.02)
    assert np.max(np.abs(twist)) > half > np.min(np.abs(twist))  # it opens and closes
    for name, values in found["dopri5"].items():
        np.testing.assert_allclose(found["rodas4"][name], values, atol=1e-4 * np.ptp(values))


def test_lanes_do_what_a_run_does():
    model = prepare(reducer(LIGHT)).model
    y = initial_state(model, "static")
    common = {"cycles": 6, "window": 3, "samples": 40, "rtol": 1e-8, "method": "dopri5"}
    many = march([model] * 9, np.array([y] * 9), **common)
    alone = march([model], y[None], **common)
    np.testing.assert_allclose(many.samples[4], alone.samples[0], rtol=1e-6, atol=1e-9)


@law
def hardening(twist, stiffness, parameters):
    """A spring that stiffens with the square of its twist, as in docs/extending.md: one machine code."""
    cubic = 4.0e6 * stiffness
    energy = 0.5 * stiffness * twist**2 + 0.25 * cubic * twist**4
    return stiffness * twist + cubic * twist**3, energy, 1.0


def test_a_function_is_a_law(tmp_path):
    own = td.run("two-stage-reducer", SHAFT, output=tmp_path / "own.h5", links={"middle": hardening})
    linear = td.run("two-stage-reducer", SHAFT, output=tmp_path / "linear.h5")
    assert abs(own.summary["energy_residual"]) < 1e-6
    assert own.summary["mode_frequencies"][0] > linear.summary["mode_frequencies"][0]


@law
def without_energy(twist, stiffness, parameters):
    """Its energy is not that of its torque."""
    return stiffness * twist, stiffness * twist**2, 1.0


@pytest.mark.parametrize(
    ("keys", "links", "said"),
    [
        ({"shaft.0.law": "rubber"}, None, r"shaft\.0\.law = \"rubber\""),
        ({"shaft.0.law": "play"}, None, r"shaft\.0\.play"),
        ({**PLAY, "shaft.0.contact_share": 2.0}, None, r"shaft\.0\.contact_share = 2"),
        ({}, {"middle": without_energy}, "not the derivative of its energy"),
        ({}, {"output": hardening}, "no such"),
    ],
)
def test_mistakes_are_said(keys, links, said, tmp_path):
    with pytest.raises(td.InputError, match=said):
        td.run("two-stage-reducer", {**SHAFT, **keys}, output=tmp_path / "wrong.h5", links=links)
