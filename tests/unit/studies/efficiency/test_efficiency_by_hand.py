"""The efficiency study in plain loops: quadrature, the mesh at a phase, samples, datasets, figures."""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from tests.support.closures import of_case
from tribodyn.studies.efficiency import load_contact as by_contact
from tribodyn.studies.efficiency import run as running
from tribodyn.studies.efficiency.along_path import engage
from tribodyn.studies.efficiency.arrays import record_arrays
from tribodyn.studies.efficiency.dynamic import dynamic_efficiency
from tribodyn.studies.efficiency.load_contact import load_contact
from tribodyn.studies.efficiency.loss_factor import exact, tip_contact_ratios
from tribodyn.studies.efficiency.places import places
from tribodyn.studies.efficiency.quadrature import from_pitch_point, piecewise
from tribodyn.studies.efficiency.run import (
    SPECTRUM,
    Prepared,
    _at_jumps,
    _figures,
    _judged,
    _sampled,
    efficiencies,
    prepare,
    spectrum_figures,
)
from tribodyn.studies.efficiency.sampled import samples
from tribodyn.studies.protocol.load import load_scenario

NAME = "efficiency-involute-18-36"
SHORT = {"output.samples_per_cycle": 23}


@pytest.fixture(scope="module", params=[410.0, -410.0], ids=["pinion", "gear"])
def study(request: pytest.FixtureRequest) -> Prepared:
    law = {"friction.law": "masjedi-khonsari", "operating.gear_torque": f"{request.param} N*m"}
    return prepare(load_scenario(NAME, SHORT | law))


def test_pieces_are_crowded_towards_the_pitch_points():
    """Cusps and jumps are integrated exactly: cube roots of the distance from the nearest pitch point."""
    breaks, pitch = np.array([0.1, 0.3, 0.8, 1.0]), np.array([-0.2, 0.45, 0.55, 1.4])
    nodes, weights = piecewise(breaks, pitch, 5)
    # six pieces, that between the pitch points in two halves
    assert len(nodes) == len(weights) == 30
    assert np.all(np.diff(nodes) > 0.0)
    assert np.all(weights > 0.0)

    def cusp(x: float) -> float:
        if x < 0.3:
            return 7.0 * x**2
        return 5.0 * x**3 if x > 0.8 else 2.0 + min(abs(x - 0.45), abs(x - 0.55)) ** (1.0 / 3.0)

    roots = sum(0.75 * length ** (4.0 / 3.0) for length in (0.15, 0.05, 0.05, 0.25))
    whole = 7.0 * (0.3**3 - 0.1**3) / 3.0 + 2.0 * 0.5 + roots + 5.0 * (1.0 - 0.8**4) / 4.0
    assert sum(w * cusp(float(x)) for x, w in zip(nodes, weights, strict=True)) == pytest.approx(
        whole, rel=1e-12
    )
    near = nodes[np.searchsorted(nodes, 0.45)] - 0.45
    assert 0.0 < near < 0.01 * 0.05
    # of two breaks that are one but for rounding nothing lies between
    doubled, _ = piecewise(np.sort([*breaks, 0.3 + 5e-13]), pitch, 5)
    assert len(doubled) == 30
    # a pitch point at either end
    nodes, weights = piecewise(np.array([0.0, 1.0]), np.array([1.0]), 4)
    assert weights @ (1.0 - nodes) ** (2.0 / 3.0) == pytest.approx(0.6, rel=1e-12)
    nodes, weights = piecewise(np.array([0.0, 1.0]), np.array([0.0]), 4)
    assert weights @ nodes ** (2.0 / 3.0) == pytest.approx(0.6, rel=1e-12)


@pytest.mark.parametrize("end", [0.7, -0.4])
def test_from_the_pitch_point_outwards(end: float):
    nodes, weights = from_pitch_point(end, 6)
    assert np.all(nodes * end > 0.0)
    assert weights.sum() == pytest.approx(abs(end), rel=1e-14)
    assert weights @ np.abs(nodes) ** (4.0 / 3.0) == pytest.approx(
        abs(end) ** (7.0 / 3.0) * 3.0 / 7.0, rel=1e-13
    )


def cycle_of(span: float, pairs: int) -> Any:
    """A table of so many pitches, as far as its samples need it."""
    pitch = 0.3
    return SimpleNamespace(
        roll_start=-0.2, roll_end=-0.2 + span * pitch, pitch_angle=pitch, front_pairs=pairs
    )


@pytest.mark.parametrize(("span", "pairs"), [(1.6, 2), (2.3, 3), (1.02, 2)])
def test_where_the_gear_drives_pairs_go_through_the_table_backwards(span: float, pairs: int):
    """The newest enters at the end of the path; the one that leaves at its beginning was the oldest."""
    count = 40
    over = samples(cycle_of(span, pairs), count, -1.0)
    np.testing.assert_allclose(over.turned, [one / count for one in range(count + 1)], rtol=1e-15)
    assert np.all((over.phase >= 0.0) & (over.phase <= 1.0))
    # pitches from the beginning of the path, by the table's slots
    table = over.phase[:, None] + np.arange(pairs - 1.0, -1.0, -1.0)
    found = over.by_pair(table)
    for turned, row, later in zip(over.turned, found, over.later, strict=True):
        for number, place in enumerate(row):
            expected = span - turned - (pairs - 1 - number)
            # the oldest has left: its place is that of the pair which enters next
            expected += pairs if later and number == 0 else 0.0
            assert place == pytest.approx(expected, abs=2e-9)
    assert found[0, -1] < span
    entering = [place for place in found[-1] if place == pytest.approx(span, abs=1e-8)]
    assert all(place > span for place in entering)
    forward = samples(cycle_of(span, pairs), count, 1.0)
    np.testing.assert_array_equal(forward.phase, forward.turned)
    np.testing.assert_array_equal(forward.by_pair(table), table)
    assert not np.any(forward.later)


def test_the_mesh_at_a_phase_is_that_of_two_involutes(study: Prepared):
    """Radii of curvature along the line of action; compliance by scipy's splines through the table."""
    cycle, path = study.cycle, study.path
    phase = np.array([0.0, 0.013, 0.21, 0.37, 0.52, 0.68, 0.83, 0.997])
    mesh = places(cycle, path, phase)
    angle = float(path.pressure_angle(0.0))
    radii = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    base = [radius * math.cos(angle) for radius in radii]
    pitch = 2.0 * math.pi / 18.0
    for k, at in enumerate(phase):
        segment = max(i for i in range(len(cycle.boundary) - 1) if cycle.boundary[i] <= at)
        for q in range(2):
            roll = float(cycle.roll_start) + pitch * (at + 1 - q)
            inside = cycle.roll_start <= roll < cycle.roll_end
            assert mesh.carrying[k, q] == float(inside) == mesh.cycle.in_contact[k, q]
            assert mesh.roll[k, q] == pytest.approx(roll, abs=1e-14)
            for name, found in (("compliance", mesh.cycle.compliance), ("gap", mesh.cycle.gap)):
                spline = CubicSpline(cycle.phase[segment], getattr(cycle, name)[segment, :, q])
                assert found[k, 0, q] == pytest.approx(float(spline(at)), rel=1e-9, abs=1e-20)
            other = CubicSpline(cycle.phase[segment], cycle.coupling[segment, :, q, 1 - q])
            assert mesh.cycle.coupling[k, 0, q, 1 - q] == pytest.approx(float(other(at)), rel=1e-9)
            if not inside:
                continue
            distance = base[0] * roll
            curved = radii[0] * math.sin(angle) + distance, radii[1] * math.sin(angle) - distance
            assert mesh.cycle.signed_distance[k, 0, q] == pytest.approx(distance, rel=1e-9)
            assert mesh.cycle.pressure_angle[k, 0, q] == pytest.approx(angle, rel=1e-12)
            np.testing.assert_allclose(mesh.normal_arm[:, k, q], base, rtol=1e-12)
            np.testing.assert_allclose(mesh.friction_arm[:, k, q], curved, rtol=1e-9)
            assert mesh.radius[k, q] == pytest.approx(curved[0] * curved[1] / sum(curved), rel=1e-9)
            assert mesh.cycle.pinion_speed[k, 0, q] == pytest.approx(curved[0], rel=1e-9)
            assert mesh.cycle.gear_speed[k, 0, q] == pytest.approx(curved[1] * radii[0] / radii[1], rel=1e-9)
    alone = places(cycle, path, np.linspace(0.0, 0.999, 38), "single-pair")
    np.testing.assert_array_equal(alone.carrying.sum(axis=1), 1.0)
    assert np.max(np.abs(alone.roll[alone.carrying > 0.0])) <= pitch / 2.0 + 1e-12
    np.testing.assert_array_equal(mesh.cycle.side, [1.0, 1.0])


#: Datasets of a pair that are those of the state, where it touches.
OF_STATE = (
    "friction_coefficient",
    "asperity_load_ratio",
    "central_film_thickness",
    "flash_temperature_rise",
    "hertz_pressure",
    "closure_in_range",
    "friction_in_range",
)


def test_datasets_of_a_mesh_cycle_in_plain_loops(study: Prepared):
    """By the record's pairs: the one that entered last is the last, whichever gear drives."""
    over, mesh, state = _sampled(study)
    duty, way = study.duty, study.duty.way
    found = record_arrays(over, mesh, state, duty)
    speed = float(duty.pinion_speed)
    roughness = float(duty.closure.surfaces.roughness)
    radius = float(study.cycle.gear_pitch_radius)
    for k, turned in enumerate(over.turned):
        angle = turned * 2.0 * math.pi / 18.0
        assert found["pinion_angle"][k] == pytest.approx(angle, rel=1e-14)
        assert found["time"][k] == pytest.approx(angle / speed, rel=1e-14)
        # the gear lags by what the teeth deflect
        lag = float(state.deflection[k]) / radius
        np.testing.assert_allclose(
            found["displacement"][k], [0.0, 0.0, 0.0, 0.0, angle, 0.5 * angle - lag], rtol=1e-13
        )
        np.testing.assert_allclose(found["velocity"][k], [0.0, 0.0, 0.0, 0.0, speed, 0.5 * speed], rtol=1e-14)
        assert found["transmission_error_rotational"][k] == state.deflection[k]
        torque_in, torque_out = float(state.pinion_torque[k]), float(state.gear_torque[k])
        assert found["drive_torque"][k] == torque_in
        assert found["power_in"][k] == pytest.approx(torque_in * speed, rel=1e-14)
        assert found["power_out"][k] == pytest.approx(torque_out * 0.5 * speed, rel=1e-14)
        lost = float(state.power_friction[k])
        assert found["power_friction"][k] == lost
        put_in = torque_in * speed if way > 0.0 else -torque_out * 0.5 * speed
        assert found["efficiency"][k] == pytest.approx(1.0 - lost / put_in, rel=1e-13)
        assert found["power_damping"][k] == found["power_parametric"][k] == 0.0
        for slot in range(2):
            # backwards the table counts the other way round, and later it has moved on by one
            own = slot if way > 0.0 or bool(over.later[k]) else 1 - slot
            load = float(state.normal_load[k, own])
            assert found["normal_load"][k, slot] == load
            assert found["friction_force"][k, slot] == state.friction_force[k, own]
            touches = load > 0.0 and mesh.carrying[k, own] > 0.0
            stiffness = 1.0 / float(mesh.cycle.compliance[k, 0, own]) if touches else 0.0
            assert found["mesh_stiffness"][k, slot] == pytest.approx(stiffness, rel=1e-14)
            expected = {name: getattr(state, name)[k, own] for name in OF_STATE} | {
                "film_parameter": state.central_film_thickness[k, own] / roughness,
                "equivalent_radius": state.radius[k, own],
                "entrainment_speed": state.entrainment[k, own],
                "sliding_speed": state.sliding[k, own],
                "pressure_angle": float(study.path.pressure_angle(0.0)),
                "transmission_error": way * state.deflection[k] * math.cos(study.path.pressure_angle(0.0)),
            }
            for name, value in expected.items():
                wanted = float(value) if touches else math.nan
                assert found[name][k, slot] == pytest.approx(wanted, rel=1e-12, nan_ok=True), name


def test_figures_of_a_mesh_cycle_in_plain_loops(study: Prepared, monkeypatch: pytest.MonkeyPatch):
    """Extremes of samples and of both sides of every jump; means over one cycle, the last sample left out."""
    monkeypatch.setattr(running, "efficiencies", lambda of, known: {"known": known})
    over, mesh, state = _sampled(study)
    found = _figures(study, over, mesh, state)
    assert found["known"]["elastic"].efficiency == found["efficiency"]
    phases = [
        min(max(float(one) + off, 1e-9), 1.0 - 1e-9) for one in study.cycle.boundary for off in (-1e-9, 1e-9)
    ]
    beside, jumps = _at_jumps(study)
    np.testing.assert_allclose(beside.phase, phases, rtol=0.0, atol=1e-15)
    loaded = [
        (at, one, k, q)
        for at, one in ((mesh, state), (beside, jumps))
        for k in range(len(one.normal_load))
        for q in range(2)
        if one.normal_load[k, q] > 0.0
    ]
    films = [(float(one.central_film_thickness[k, q]), float(at.roll[k, q])) for at, one, k, q in loaded]
    film, roll = min(films)
    assert found["film_min"] == film
    assert found["film_parameter_min"] == pytest.approx(
        film / study.duty.closure.surfaces.roughness, rel=1e-14
    )
    assert found["film_parameter_min_roll_angle"] == pytest.approx(roll, abs=1e-12)
    for name, dataset in (
        ("normal_load_max", "normal_load"),
        ("hertz_pressure_max", "hertz_pressure"),
        ("flash_temperature_max", "flash_temperature_rise"),
    ):
        assert found[name] == max(float(getattr(one, dataset)[k, q]) for _, one, k, q in loaded)
    count = len(over.turned) - 1
    forces = [0.0, 0.0]
    for k in range(count):
        for slot, force in enumerate(over.by_pair(state.friction_force)[k]):
            forces[slot] += abs(float(force)) / count
    np.testing.assert_allclose(found["friction_force_mean"], forces, rtol=1e-13)
    inside = [float(state.closure_in_range[k, q]) for _, one, k, q in loaded if one is state]
    assert found["closure_in_range_fraction"] == pytest.approx(
        sum(one == 1.0 for one in inside) / len(inside)
    )
    speed = float(study.duty.pinion_speed)
    assert found["mesh_frequency"] == pytest.approx(18.0 * speed / (2.0 * math.pi), rel=1e-14)
    assert found["contact_ratio"] == float(study.cycle.contact_ratio)
    assert found["averaging_cycles"] == 1
    assert abs(found["energy_residual"]) < 1e-12
    assert found["efficiency"] == pytest.approx(
        1.0 - found["power_friction_mean"] / found["power_in_mean"], rel=1e-14
    )
    assert found["driving_gear"] == ("pinion" if study.duty.way > 0.0 else "gear")
    # the gear's torque is given: what it takes or gives is that at half the pinion's speed
    passed = 410.0 * 0.5 * speed + (found["power_friction_mean"] if study.duty.way > 0.0 else 0.0)
    assert found["power_in_mean"] == pytest.approx(passed, rel=1e-9)
    assert not any(inside)  # the film law is used beyond its range in the whole contact
    assert found["trust"] == "laws extrapolated"
    # of a mesh whose pairs deflect by more than a tenth of the module
    soft = mesh._replace(cycle=mesh.cycle._replace(compliance=mesh.cycle.compliance * 1e4))
    most = max(
        float(state.normal_load[k, q] * mesh.cycle.compliance[k, 0, q]) for k in range(count) for q in (0, 1)
    )
    told = _judged(study, soft, state, {"efficiency": 0.9, "flash_temperature_max": 30.0})["trust_reasons"][
        "deflection"
    ]
    assert told["value"] == pytest.approx(1e4 * most / study.case.drive.module, rel=1e-12)


def test_loss_factors_are_of_one_coefficient_alone(study: Prepared):
    """1 − μ H_v, and Höhn's formula where the pitch point lies in single contact."""
    known: Any = {one: SimpleNamespace(efficiency=0.5) for one in ("elastic", "uniform")}
    duty = study.duty
    assert not {"loss_factor", "efficiency_hoehn"} & efficiencies(study, known).keys()
    coulomb = study._replace(duty=duty._replace(closure=of_case(study.case, "coulomb", coefficient=0.07)))
    found = efficiencies(coulomb, known)
    tips = tip_contact_ratios(coulomb.assembly.family, coulomb.case.drive)
    factor = exact(*tips, 18.0, 2.0)
    assert found["loss_factor"] == factor
    assert found["efficiency_loss_factor"] == pytest.approx(1.0 - 0.07 * factor, rel=1e-14)
    assert max(tips) < 1.0 < sum(tips)
    closed = math.pi * 3.0 / 36.0 * (1.0 - sum(tips) + tips[0] ** 2 + tips[1] ** 2)
    assert found["efficiency_hoehn"] == pytest.approx(1.0 - 0.07 * closed, rel=1e-14)
    # one pair alone at constant torque: the same loss but for its square
    assert found["efficiency_torque_ratio"] == pytest.approx(found["efficiency_single_pair"], abs=2e-4)
    assert found["efficiency_uniform"] == 0.5


def test_a_spectrum_is_weighted_by_time(monkeypatch: pytest.MonkeyPatch):
    """Energy put out over energy put in: powers are averaged, efficiencies are not."""
    case: Any = SimpleNamespace(spectrum=((0.2, 3.0), (0.5, 1.0), (0.3, 2.0)))

    def of(duty: float) -> dict[str, float]:
        return {name: 10.0 * duty + place for place, name in enumerate(SPECTRUM)} | {
            "power_in_mean": 100.0 * duty,
            "power_friction_mean": duty**2,
        }

    monkeypatch.setattr(running, "figures", of)
    found = spectrum_figures(case)
    put_in, lost = 0.2 * 300.0 + 0.5 * 100.0 + 0.3 * 200.0, 0.2 * 9.0 + 0.5 * 1.0 + 0.3 * 4.0
    assert found["spectrum_efficiency"] == pytest.approx(
        sum(
            share * 100.0 * duty * (10.0 * duty + SPECTRUM.index("efficiency")) / put_in
            for share, duty in case.spectrum
        ),
        rel=1e-13,
    )
    assert found["spectrum_power_in_mean"] == pytest.approx(put_in, rel=1e-13)
    assert found["spectrum_power_friction_mean"] == pytest.approx(lost, rel=1e-13)
    np.testing.assert_array_equal(found["duty_share"], [0.2, 0.5, 0.3])
    np.testing.assert_array_equal(found["duty_power_in_mean"], [300.0, 100.0, 200.0])
    assert spectrum_figures(SimpleNamespace(spectrum=())) == {}  # pyright: ignore[reportArgumentType]


@pytest.mark.parametrize("torque", [300.0, -300.0])
def test_corner_contact_loses_what_flanks_slide(monkeypatch: pytest.MonkeyPatch, torque: float):
    """Loss is μ F v at every position; what the driving gear puts in is what comes out and what is lost."""
    seen: dict[str, Any] = {}
    load = np.array([[100.0, 250.0], [180.0, 0.0], [60.0, 320.0]])
    sliding = np.array([[-0.01, 0.02], [0.015, -0.03], [-0.005, 0.025]])
    assembly: Any = SimpleNamespace(
        path=SimpleNamespace(
            pressure_angle=lambda at: 0.4 + at, pinion_pitch_radius=0.02, gear_pitch_radius=0.05
        ),
        drive=SimpleNamespace(pinion=SimpleNamespace(teeth=20)),
    )
    flexible: Any = SimpleNamespace(assembly=assembly, width=0.013)
    given: Any = "modified"
    behind = given if torque > 0.0 else "behind"

    def back(modified: Any, angle: float) -> Any:
        assert (modified, angle) == (given, 0.4)
        return behind

    def sharing(one: Any, roll: Any, carried: float, friction: float, gap: Any, *rest: Any) -> Any:
        seen.update(carried=carried, friction=friction, gap=gap, rest=rest)
        return SimpleNamespace(normal_load=load)

    def checked(one: Any, modified: Any, carried: float, slices: int) -> None:
        assert (modified, carried, slices) == (behind, 300.0, 3)

    monkeypatch.setattr(by_contact, "uneven_teeth", lambda modified: ())
    monkeypatch.setattr(by_contact, "back_flanks", back)
    monkeypatch.setattr(by_contact, "check_contact", checked)
    monkeypatch.setattr(by_contact, "reach", lambda *all_of_them: ("limits", all_of_them[1:3]))
    monkeypatch.setattr(by_contact, "extended_rolls", lambda one, limits, count: np.arange(count))
    motion = SimpleNamespace(motion=SimpleNamespace(sliding=sliding))
    monkeypatch.setattr(by_contact, "pair_geometry", lambda one, roll: motion)
    monkeypatch.setattr(by_contact, "face_positions", lambda width, slices: (width, slices))
    monkeypatch.setattr(by_contact, "flank_gap", lambda one, modified, at, face: (modified, face))
    monkeypatch.setattr(by_contact, "share_load", sharing)
    monkeypatch.setattr(by_contact, "effective_contact_ratio", lambda roll, shared, pitch: pitch)
    found = load_contact(flexible, torque, 0.05, 3, given, 3, True)
    way = 1.0 if torque > 0.0 else -1.0
    assert seen == {
        "carried": 300.0, "friction": way * 0.05, "gap": (behind, (0.013, 3)), "rest": (3, True)
    }  # fmt: skip
    loss = (
        sum(0.05 * float(f) * abs(float(v)) for f, v in zip(load.ravel(), sliding.ravel(), strict=True)) / 3.0
    )
    gear = 300.0 * 0.02 / 0.05
    put_in = gear + loss if torque > 0.0 else gear
    assert found.efficiency == pytest.approx(1.0 - loss / put_in, rel=1e-13)
    np.testing.assert_allclose(found.loss, 0.05 * load * np.abs(sliding), rtol=1e-14)
    assert found.contact_ratio == pytest.approx(2.0 * math.pi / 20.0)


def record_of(cycles: int, each: int) -> Any:
    """Works of a run that grow faster and faster."""
    phase = np.arange(cycles * each + 1) / each
    works = {"in": 50.0 * phase**2, "out": 45.0 * phase**2, "friction": 3.0 * phase**2, "damping": phase**2}
    data = {f"work_{name}": values for name, values in works.items()}
    data |= {"time": phase * 0.01, "stored_energy": phase**2}

    class Run:
        scenario = {"output": {"samples_per_cycle": each}}  # noqa: RUF012

        def __getitem__(self, name: str) -> np.ndarray:
            return data[name]

    return Run()


def test_the_efficiency_of_a_run_is_of_its_last_cycles():
    """The last quarter by default; work put out over work put in counts damping too."""
    for cycles, wanted, last in ((12, None, 3), (3, None, 1), (12, 5, 5), (12, 12, 12)):
        found = dynamic_efficiency(record_of(cycles, 7), wanted)
        grown = cycles**2 - (cycles - last) ** 2
        assert found.cycles == last
        assert found.work_in == pytest.approx(50.0 * grown)
        assert found.work_out == pytest.approx(45.0 * grown)
        assert found.work_friction == pytest.approx(3.0 * grown)
        assert found.work_damping == found.stored == pytest.approx(grown)
        assert found.efficiency == pytest.approx(1.0 - 3.0 / 50.0)
        assert found.overall == pytest.approx(0.9)


def test_friction_and_pressure_see_an_uneven_face(study: Prepared):
    """Friction at exp⟨s ln s⟩ of the mean line load, pressure at the maximum; both as if the load were so."""
    mesh = places(study.cycle, study.path, np.array([0.13, 0.41, 0.86]))
    duty = study.duty
    shares = np.array([0.2, 0.5, 1.1, 2.2])
    load = np.where(mesh.carrying > 0.0, [[900.0, 2100.0], [0.0, 3000.0], [700.0, 2500.0]], 0.0)
    given: list[Any] = []

    def engaged(factor: float, slices: np.ndarray) -> Any:
        def share(roll: np.ndarray, torque: float, friction: np.ndarray) -> Any:
            given.append((roll is mesh.roll, torque))
            scaled = factor * load
            return SimpleNamespace(
                normal_load=scaled, deflection=np.full(3, 1e-5), slice_load=scaled[..., None] * slices
            )

        return engage(mesh._replace(flanks=SimpleNamespace(share=share)), duty)  # pyright: ignore[reportArgumentType]

    found = engaged(1.0, shares)
    even = math.exp(sum(s * math.log(s) for s in shares) / 4.0)
    touching = load > 0.0
    for factor, names in (
        (even, ("friction_coefficient",)),
        (2.2, ("hertz_pressure", "central_film_thickness")),
    ):
        other = engaged(factor, np.ones(4))
        for name in names:
            np.testing.assert_allclose(
                getattr(found, name)[touching], getattr(other, name)[touching], rtol=1e-9
            )
    assert np.all(given == np.array([True, 410.0]))
    np.testing.assert_array_equal(found.normal_load, load)
    np.testing.assert_array_equal(found.deflection, duty.way * np.full(3, 1e-5))


def test_contact_ratio_under_load_is_of_one_cycle(study: Prepared, monkeypatch: pytest.MonkeyPatch):
    """Without the last position, which is the first one again; friction against the sliding of its flanks."""
    _, mesh, state = _sampled(study)
    asked: list[Any] = []
    flanks = SimpleNamespace(share=lambda *given: asked.append(given) or "shared")
    monkeypatch.setattr(running, "effective_contact_ratio", lambda *given: given)
    assert running._effective_contact_ratio(mesh, state, study.duty) == {}
    cornered = mesh._replace(flanks=flanks)  # pyright: ignore[reportArgumentType]
    found: Any = running._effective_contact_ratio(cornered, state, study.duty)["contact_ratio_effective"]
    ((roll, torque, friction),) = asked
    assert (torque, found[1]) == (410.0, "shared")
    np.testing.assert_array_equal(roll, mesh.roll[: len(mesh.roll) - 1])
    np.testing.assert_array_equal(found[0], roll)
    np.testing.assert_array_equal(friction, study.duty.way * state.friction_coefficient[: len(roll)])
    assert found[2] == pytest.approx(2.0 * math.pi / 18.0)
