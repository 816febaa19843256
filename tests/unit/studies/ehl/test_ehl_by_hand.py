"""The study of the solved contact around its solver: what it asks, and what it makes of known solutions."""

import math
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.path import kinematics
from tribodyn.studies.ehl import along_path, judged, loads, run, squeezed
from tribodyn.studies.ehl.along_path import Prepared, Way, friction_along, over_places, prepare, way
from tribodyn.studies.ehl.case import EhlCase
from tribodyn.studies.protocol.load import load
from tribodyn.tribology.ehl.problem import LineContact

POSITIONS = 6
PLACE = np.linspace(-4.0, 2.0, 25)  # half widths


@pytest.fixture(scope="module")
def study() -> Prepared:
    return prepare(load("ehl-crc-23-47", {"output.positions": POSITIONS}).case)


@pytest.fixture(scope="module")
def over(study: Prepared) -> Way:
    return along_path._way(study, POSITIONS, None)


def solution(load: float, radius: float, speed: float, sliding: float, smooth: bool = False) -> Any:
    """A made-up solution that tells what it was asked for."""
    width = 2e-4 * math.sqrt(load / 1e5)
    gap = 1e-7 * (1.0 + speed) * (2.0 - np.exp(-((PLACE - 0.6) ** 2))) + 1e-3 * radius * 1e-6
    problem = SimpleNamespace(
        half_width=width, line_load=load, moes_load=load * 1e-3, moes_material=radius * 1e3
    )
    solved = SimpleNamespace(
        problem=problem,
        place=PLACE * width,
        mean_gap=gap,
        pressure=1e8 * np.exp(-(PLACE**2)) * load * 1e-5,
        asperity_load_ratio=0.1 + radius,
        imbalance=1e-7 * load,
        central_film_thickness=2e-7 + 1e-7 * speed,
        minimum_film_thickness=1e-7 + 1e-7 * speed,
    )
    stress = 1e6 * np.cos(PLACE / 3.0)
    rise = 40.0 * abs(sliding) * np.exp(-((PLACE - 0.2) ** 2))
    return SimpleNamespace(
        solution=solved,
        friction=-np.sign(sliding) * load * friction_of(speed, sliding),
        temperature=rise,
        shear=SimpleNamespace(stress=stress),
        smooth=smooth,
    )


def friction_of(speed: float, sliding: float) -> float:
    return 0.03 + 0.01 * abs(sliding) / speed


def solver(fails: tuple[float, ...] | None = None) -> Any:
    """Solves by `solution`; not where line load and radius are `fails`: radii alone may be equal."""

    def solved_at(contact: Any, *duty: float, step: float, smooth: bool = False) -> Any:
        assert step == 0.1
        return None if duty[:2] == fails else solution(*duty, smooth=smooth)

    return solved_at


def duties(over: Way) -> list[tuple[float, float, float, float]]:
    rows = zip(over.line_load, over.radius, *over.speeds, strict=True)
    return [(float(w), float(r), float(a + b) / 2.0, float(a - b)) for w, r, a, b in rows]


def test_given_loads_are_those_of_the_way(study: Prepared):
    start, end = float(study.cycle.roll_start), float(study.cycle.roll_end)
    span = end - start
    roll, load = loads.given_loads((np.array([start, 0.0, end]), np.array([-3.0, 4.0, 0.0])), study.cycle)
    assert (list(roll), list(load)) == ([start, 0.0, end], [0.0, 4.0, 0.0])
    for low, high, good in (
        (0.019, -0.019, True),
        (-0.019, 0.019, True),
        (0.021, 0.0, False),
        (-0.021, 0.0, False),
        (0.0, 0.021, False),
        (0.0, -0.021, False),
    ):
        ends = np.array([start + low * span, end + high * span]), np.array([1.0, 0.0])
        if good:
            loads.given_loads(ends, study.cycle)
        else:
            with pytest.raises(InputError, match=f"where a pair touches at {math.degrees(start):.4g}"):
                loads.given_loads(ends, study.cycle)
    with pytest.raises(InputError, match="nowhere above 0"):
        loads.given_loads((np.array([start, end]), np.array([0.0, -1.0])), study.cycle)


def test_the_way_is_divided_evenly_and_its_loads_balance_the_torque(study: Prepared, over: Way):
    cycle, path = study.cycle, study.assembly.path
    span = float(cycle.roll_end - cycle.roll_start)
    expected = [float(cycle.roll_start) + (i + 0.5) * span / POSITIONS for i in range(POSITIONS)]
    np.testing.assert_allclose(over.roll, expected, rtol=1e-12)
    for at, roll in enumerate(expected):
        motion = kinematics(path, path.signed_distance(np.array([roll])))
        assert over.radius[at] == pytest.approx(1.0 / float(motion.relative_curvature[0]))
        assert over.speeds[0][at] == pytest.approx(10.0 * float(motion.pinion_speed[0]))
        assert over.speeds[1][at] == pytest.approx(10.0 * float(motion.gear_speed[0]))
    nodes, line_loads = over.table
    np.testing.assert_allclose(over.line_load, np.interp(expected, nodes, line_loads))
    np.testing.assert_allclose(over.normal_load, over.line_load * float(cycle.face_width))
    # all loads over a way turn the gear through a pitch: mean of load times arm over the pitch is the torque
    arms = kinematics(path, path.signed_distance(nodes)).gear_normal_arm
    turned = np.trapezoid(line_loads * float(cycle.face_width) * np.asarray(arms), nodes)
    assert turned / float(cycle.pitch_angle) == pytest.approx(500.0, rel=2e-3)


def test_friction_is_solved_at_eight_positions_and_shares_in_the_loads(
    study: Prepared, monkeypatch: pytest.MonkeyPatch
):
    seen: list[Any] = []

    def quasi_static(cycle: Any, torque: float, friction: Any) -> Any:
        seen.append((torque, friction))
        return np.array([float(cycle.roll_start), float(cycle.roll_end)]), np.array([3e3, 5e3])

    monkeypatch.setattr(along_path, "quasi_static_loads", quasi_static)
    monkeypatch.setattr(along_path, "solved_at", solver())
    found = way(study)
    free = along_path._way(study, 8, None)
    assert [one[0] for one in seen] == [500.0] * 3
    assert seen[0][1] is None
    np.testing.assert_allclose(seen[1][1][0], free.roll)
    expected = [friction_of(speed, sliding) for _, _, speed, sliding in duties(free)]
    np.testing.assert_allclose(seen[1][1][1], expected, rtol=1e-6)
    assert len(found.roll) == POSITIONS
    signs = [-np.sign(sliding) for *_, sliding in duties(free)]
    np.testing.assert_allclose(friction_along(study, free), np.array(expected) * signs, rtol=1e-6)
    monkeypatch.setattr(along_path, "solved_at", lambda *_, **__: None)
    seen.clear()
    way(study)
    assert [one[1] for one in seen] == [None, None]


def test_datasets_are_those_of_the_solutions(study: Prepared, over: Way, monkeypatch: pytest.MonkeyPatch):
    """One contact is not solved, one carries nothing."""
    load = over.normal_load.copy()
    load[4] = 0.5e-6 * load.max()
    over = over._replace(normal_load=load)
    monkeypatch.setattr(run, "solved_at", solver(fails=duties(over)[1][:2]))
    told: list[float] = []
    arrays = run.solve(study, over, told.append)
    np.testing.assert_allclose(told, [(at + 1) / POSITIONS for at in (0, 1, 2, 3, 5)])
    span = np.linspace(-3.0, 1.5, 161)
    for at, (line_load, radius, speed, sliding) in enumerate(duties(over)):
        assert arrays["entrainment_speed"][at] == pytest.approx(speed)
        assert arrays["sliding_speed"][at] == pytest.approx(sliding)
        assert arrays["equivalent_radius"][at] == pytest.approx(radius)
        hertz = math.sqrt(line_load * 226.37e9 / (2.0 * math.pi * radius))
        assert arrays["hertz_pressure"][at] == pytest.approx(hertz, rel=1e-4)
        phase = (over.roll[at] - over.roll[0]) * 23.0 / (2.0 * math.pi)
        assert arrays["phase"][at] - arrays["phase"][0] == pytest.approx(phase)
        if at in (1, 4):
            assert np.isnan(arrays["central_film_thickness"][at])
            assert np.all(np.isnan(arrays["pressure"][at]))
            assert np.isnan(arrays["central_film_smooth"][at])
            continue
        one = solution(line_load, radius, speed, sliding)
        solved, gap = one.solution, one.solution.mean_gap
        central = float(np.interp(0.0, PLACE, gap))
        expected = {
            "half_width": solved.problem.half_width,
            "central_film_thickness": central,
            "minimum_film_thickness": min(gap),
            "film_parameter": central / study.case.roughness,
            "friction_coefficient": friction_of(speed, sliding),
            "asperity_load_ratio": 0.1 + radius,
            "temperature_rise_max": max(one.temperature),
            "moes_load": 1e-3 * line_load,
            "moes_material": 1e3 * radius,
            "residual": 1e-7 * line_load,
            "central_film_smooth": 2e-7 + 1e-7 * speed,
            "minimum_film_smooth": 1e-7 + 1e-7 * speed,
        }
        for name, value in expected.items():
            assert arrays[name][at] == pytest.approx(value), name
        np.testing.assert_allclose(arrays["pressure"][at], np.interp(span, PLACE, solved.pressure))
        np.testing.assert_allclose(arrays["film_thickness"][at], np.interp(span, PLACE, gap))
        np.testing.assert_allclose(arrays["temperature_rise"][at], np.interp(span, PLACE, one.temperature))
        np.testing.assert_allclose(arrays["shear_stress"][at], np.interp(span, PLACE, one.shear.stress))
    first = float(np.asarray(study.cycle.roll_start))
    assert arrays["phase"][0] == pytest.approx((over.roll[0] - first) * 23.0 / (2.0 * math.pi))


def test_beyond_a_grid_there_is_no_pressure():
    found = SimpleNamespace(place=np.array([-2e-4, 0.0, 1e-4]), problem=SimpleNamespace(half_width=1e-4))
    values = over_places(found, np.array([1.0, 3.0, 2.0]), -7.0)  # pyright: ignore[reportArgumentType]
    places = np.linspace(-3.0, 1.5, 161)
    assert np.all(values[places < -2.0] == -7.0)
    assert np.all(values[places > 1.0] == -7.0)
    inner = (places >= -2.0) & (places <= 0.0)
    np.testing.assert_allclose(values[inner], 3.0 + places[inner])


def test_traction_is_that_of_the_highest_load(study: Prepared, over: Way, monkeypatch: pytest.MonkeyPatch):
    seen: list[tuple[float, ...]] = []

    def solved_at(contact: Any, *duty: Any, step: float) -> Any:
        seen.append(duty)
        return None if len(seen) == 2 else solution(*duty)

    monkeypatch.setattr(run, "solved_at", solved_at)
    curve = run._traction(study, over)
    load, radius, speed, _ = max(duties(over))
    for ratio, duty, value in zip(run.TRACTION, seen, curve, strict=True):
        assert duty == pytest.approx((load, radius, speed, ratio * speed))
        if duty is not seen[1]:
            assert value == pytest.approx(0.03 + 0.01 * ratio)
    assert math.isnan(curve[1])
    assert list(run.TRACTION) == [0.001, 0.003, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8]


def test_figures_are_means_and_extremes(study: Prepared, over: Way, monkeypatch: pytest.MonkeyPatch):
    """Friction weighted by what it loses; laws beside what they stand for."""
    monkeypatch.setattr(run, "solved_at", solver(fails=duties(over)[1][:2]))
    arrays = run.solve(study, over, lambda _: None)
    rng = np.random.default_rng(2)
    film, friction = rng.uniform(1e-7, 4e-7, POSITIONS), rng.uniform(0.02, 0.09, POSITIONS)
    monkeypatch.setattr(run, "meant_by", lambda *_: "minimum_film_smooth")
    found = run._figures(study, over, arrays, {"film": {"one": film}, "friction": {"two": friction}})
    solved = [at for at in range(POSITIONS) if at != 1]
    ways = duties(over)
    ratios = sorted(film[at] / (1e-7 + 1e-7 * ways[at][2]) for at in solved)
    assert found["film_over_solved"]["one"] == pytest.approx(ratios[2])
    lost = [over.normal_load[at] * abs(ways[at][3]) for at in solved]
    own = [friction_of(*ways[at][2:]) for at in solved]
    mean = sum(a * b for a, b in zip(lost, own, strict=True)) / sum(lost)
    by_law = sum(a * friction[at] for a, at in zip(lost, solved, strict=True)) / sum(lost)
    assert found["friction_coefficient_mean"] == pytest.approx(mean)
    assert found["friction_over_solved"]["two"] == pytest.approx(by_law / mean)
    assert (found["positions_solved"], found["positions"]) == (5, POSITIONS)
    for figure, name, worst in (
        ("central_film_min", "central_film_thickness", min),
        ("minimum_film_min", "minimum_film_thickness", min),
        ("film_parameter_min", "film_parameter", min),
        ("asperity_load_ratio_max", "asperity_load_ratio", max),
        ("temperature_rise_max", "temperature_rise_max", max),
        ("hertz_pressure_max", "hertz_pressure", max),
        ("residual_max", "residual", max),
        ("normal_load_max", "normal_load", max),
    ):
        assert found[figure] == worst(arrays[name][at] for at in solved), figure
    assert found["pressure_max"] == max(max(arrays["pressure"][at]) for at in solved)
    nothing = arrays | {"central_film_thickness": np.full(POSITIONS, np.nan)}
    assert run._figures(study, over, nothing, {})["positions_solved"] == 0


def test_departures_with_squeeze(study: Prepared):
    gone = np.nan
    arrays = {
        "transient_central_film_thickness": np.array([1.1, gone, 2.4, 2.7]),
        "central_film_thickness": np.array([1.0, 1.0, 3.0, 3.0]),
        "transient_minimum_film_thickness": np.array([0.9, gone, 1.2, 0.7]),
        "minimum_film_thickness": np.array([1.0, 1.0, 1.0, 1.0]),
        "transient_friction_coefficient": np.array([0.05, gone, 0.06, 0.04]),
        "friction_coefficient": np.array([0.04, 0.01, 0.05, 0.06]),
        "normal_load": np.array([2.0, 9.0, 3.0, 4.0]),
        "sliding_speed": np.array([-3.0, 9.0, 1.0, 0.5]),
        "restarts": np.array(2),
    }
    found = run.squeeze_figures(study.case, arrays)
    assert (found["transient_positions_solved"], found["transient_restarts"]) == (3, 2)
    assert found["central_film_departure_max"] == pytest.approx(0.2)
    assert found["central_film_departure_mean"] == pytest.approx((0.1 + 0.2 + 0.1) / 3.0)
    assert found["minimum_film_departure_max"] == pytest.approx(0.3)
    assert found["minimum_film_departure_mean"] == pytest.approx((0.1 + 0.2 + 0.3) / 3.0)
    assert found["transient_minimum_film_min"] == 0.7
    own, steady = (6 * 0.05 + 3 * 0.06 + 2 * 0.04) / 11.0, (6 * 0.04 + 3 * 0.05 + 2 * 0.06) / 11.0
    assert found["transient_friction_coefficient_mean"] == pytest.approx(own)
    assert found["friction_departure_mean"] == pytest.approx(own / steady - 1.0)
    arrays["transient_central_film_thickness"][:] = gone
    assert len(run.squeeze_figures(study.case, arrays)) == 2


def test_the_oil_is_drawn_through_half_a_contact(study: Prepared, over: Way):
    found = along_path.jump_width(study, 3e5, over.radius, over.speeds)
    half = math.sqrt(8.0 * 3e5 * float(np.median(over.radius)) / (math.pi * 226.37e9))
    speeds = [abs(speed) for _, _, speed, _ in duties(over)]
    assert found == pytest.approx(10.0 * half / float(np.median(speeds)), rel=1e-4)


def test_a_step_becomes_two_parabolas():
    """Averaged twice over half the width: once differentiable, over the whole width."""
    width, at = 0.02, 0.11
    fine, values = along_path._spread(np.array([0.0, at, at, 0.3]), np.array([2.0, 2.0, 5.0, 5.0]), width)
    assert (fine[0], fine[-1]) == (0.0, 0.3)
    away = np.clip((fine - at) / width, -0.5, 0.5)
    share = np.where(away < 0.0, 2.0 * (0.5 + away) ** 2, 1.0 - 2.0 * (0.5 - away) ** 2)
    assert values.shape == fine.shape
    np.testing.assert_allclose(values, 2.0 + 3.0 * share, atol=0.1)
    assert np.trapezoid(values, fine) == pytest.approx(2.0 * at + 5.0 * (0.3 - at), rel=2e-3)


def test_a_map_has_a_row_per_load_and_a_column_per_speed(study: Prepared, monkeypatch: pytest.MonkeyPatch):
    told: list[float] = []

    def compared(case: EhlCase, progress: Any) -> list[judged.Judged]:
        progress(1.0)
        torque, speed = case.operating.gear_torque, case.operating.pinion_speed
        seen.append(case.positions)
        median = torque / 500.0 + 10.0 * speed / 10.0
        return [
            judged.Judged("film", name, 0, times * median, 0, 0, 0, 0) for name, times in (("a", 1), ("b", 3))
        ]

    seen: list[int] = []
    monkeypatch.setattr(judged, "_compared", compared)
    found = judged.judged(study.case, (0.5, 2.0), (0.25, 1.0, 4.0), told.append)
    assert found[0].median == pytest.approx(11.0)
    np.testing.assert_allclose(found[0].map, [[3.0, 10.5, 40.5], [4.5, 12.0, 42.0]])
    np.testing.assert_allclose(found[1].map, 3.0 * np.array(found[0].map))
    assert seen == [POSITIONS] + [5] * 6
    share = 6.0 / (6.0 + 5.0 * 6.0)
    np.testing.assert_allclose(told, [share + (1.0 - share) * part / 6.0 for part in range(7)])
    assert judged.judged(study.case)[0].map == ()


def test_laws_beside_solutions(study: Prepared, over: Way, monkeypatch: pytest.MonkeyPatch):
    """Right within a tenth for films, within a quarter for friction; what was not solved does not count."""
    over = over._replace(roll=over.roll[:5])
    film, friction = np.array([1.0, 2.0, 3.0, 4.0, 5.0]), np.array([0.5, 0.6, 0.7, 0.8, 0.9])
    ratios = np.array([0.91, 1.09, 1.12, np.nan, 0.88])
    wide = np.array([0.76, 1.24, 1.26, np.nan, 0.7])
    nothing = np.full(5, np.nan)
    arrays = {
        "central_film_smooth": film / ratios,
        "friction_coefficient": friction / wide,
        "minimum_film_thickness": nothing,
    }
    stands = {"moes": "central_film_smooth", "dowson-higginson": "minimum_film_thickness"}
    monkeypatch.setattr(judged, "prepare", lambda _: study)
    monkeypatch.setattr(judged, "way", lambda _: over)
    monkeypatch.setattr(judged, "solve", lambda *_: arrays)
    monkeypatch.setattr(
        judged,
        "by_laws",
        lambda *_: {"film": dict.fromkeys(stands, film), "friction": {"niemann": friction}},
    )
    monkeypatch.setattr(judged, "meant_by", lambda _study, _over, law: stands[law])
    monkeypatch.setattr(judged, "seen_by", lambda *_: None)
    monkeypatch.setattr(judged, "_inside", lambda *_: (0.75, 0.5))
    moes, none, niemann = judged._compared(study.case, lambda _: None)
    assert (moes.minimum, moes.median, moes.maximum) == pytest.approx((0.88, 1.0, 1.12))
    assert (niemann.minimum, niemann.median, niemann.maximum) == pytest.approx((0.7, 1.0, 1.26))
    assert (moes.right, niemann.right, none.right) == (0.5, 0.5, 0.0)
    assert (moes.in_range, moes.in_judged_range) == (0.75, 0.5)
    assert math.isnan(none.median)
    assert (moes.against, niemann.against, none.against) == ("central, smooth", "friction", "minimum, rough")


def test_shares_of_the_way_inside_ranges(study: Prepared, monkeypatch: pytest.MonkeyPatch):
    """A share of at least 1 is inside; the judged limits are the last ones; one row may stand for all."""
    film = np.array([[1.2, 1.0, 3.0], [0.99, 2.0, 1.1], [5.0, 1.5, 0.9], [1.0, 1.0, 1.0]])
    friction = np.array([[2.0, 1.0]])
    monkeypatch.setattr(judged, "untried_closure_of", lambda case: (case.film.law, case.friction.law))
    monkeypatch.setattr(
        judged, "range_shares", lambda _contact, closure: (asked.append(closure), film, friction)[1:]
    )
    asked: list[Any] = []
    seen: Any = SimpleNamespace(contact=None, radius=np.zeros(4))

    def inside(table: str, limits: int | None) -> tuple[float, float]:
        known = None if limits is None else SimpleNamespace(limits=limits)
        law: Any = SimpleNamespace(name="own", table=table, judged=known)
        return judged._inside(study, seen, law)

    assert inside("film", 2) == (0.5, 0.75)
    assert inside("film", 1) == (0.5, 0.75)
    assert inside("film", 3) == (0.5, 0.5)
    assert inside("friction", 1) == (1.0, 1.0)
    assert asked[0] == ("own", "none")
    assert asked[-1] == (None, "own")
    whole, part = inside("film", None)
    assert whole == 0.5
    assert math.isnan(part)
    film[:] = np.nan
    assert np.all(np.isnan(inside("film", 0)))


def test_laws_that_are_right_everywhere_are_named():
    found = [
        judged.Judged(what, law, 0, 0, 0, 0, 0, right)
        for what, law, right in (
            ("film", "a", 1.0),
            ("film", "b", 0.9),
            ("film", "c", 1.0),
            ("friction", "d", 0.5),
        )
    ]
    assert judged.sentence(found) == (
        "Within 10 % of the solved film at every position: a, c; "
        "within 25 % of the solved friction at every position: none."
    )


def stretch_of(times: Any, speeds: Any, widths: Any) -> squeezed.Stretch:
    steady: Any = [
        SimpleNamespace(
            problem=SimpleNamespace(
                entrainment_speed=speed, half_width=width, radius=2.0 + time, sliding_speed=5.0 - 3.0 * time
            )
        )
        for time, speed, width in zip(times, speeds, widths, strict=True)
    ]
    return squeezed.Stretch(np.array(times), steady, np.zeros(0), np.zeros(0), None, ())  # pyright: ignore[reportArgumentType]


def test_steps_are_short_beside_the_contact():
    """The oil moves by a tenth of the half width at most, from one position to the next in equal steps."""
    speeds, widths = (0.3, 0.5, 0.7, 0.01), (1.0, 0.8, 1.1, 0.9)
    stretch = stretch_of((0.5, 1.6, 1.75, 4.0), speeds, widths)
    for begin in (0, 1):
        times, marks = squeezed._times(stretch, begin)
        assert times[0] == stretch.times[begin]
        assert list(marks.values()) == list(range(begin + 1, 4))
        for number, at in marks.items():
            assert times[number] == pytest.approx(stretch.times[at])
        ends = [0, *marks]
        for first, last, at in zip(ends[:-1], ends[1:], marks.values(), strict=True):
            steps = np.diff(times[first : last + 1])
            np.testing.assert_allclose(steps, steps[0])
            drawn = steps[0] * speeds[at] / widths[at]
            assert drawn <= 0.1 + 1e-12
            assert last - first == 1 or drawn * (last - first) / (last - first - 1) > 0.1
        assert ends[-1] == len(times) - 1


def test_between_positions_everything_changes_steadily():
    times = (0.0, 1.0, 3.0, 4.0)
    speeds = [1.0 + 2.0 * time for time in times]
    stretch = stretch_of(times, speeds, (1.0,) * 4)
    problem = LineContact(1.0, 1.0, 1.0, *(None,) * 4)  # pyright: ignore[reportArgumentType]
    for one in stretch.steady:
        known = one.problem
        kept: Any = one
        kept.problem = problem._replace(
            radius=known.radius, entrainment_speed=known.entrainment_speed, sliding_speed=known.sliding_speed
        )
    closures = np.array([[[1.0, 2.0]], [[3.0, 1.0]], [[9.0, 5.0]], [[7.0, 6.0]]])
    load = np.array([-1.0, 2.0, 5.0]), np.array([4.0, 10.0, 1.0])
    instants = squeezed._Instants(stretch._replace(closures=np.repeat(closures, 3, axis=1), loads=load))
    for time, expected in ((0.25, [1.5, 1.75]), (2.5, [7.5, 4.0]), (4.0, [7.0, 6.0]), (0.0, [1.0, 2.0])):
        found = instants(time)
        assert found.problem.radius == pytest.approx(2.0 + time)
        assert found.problem.entrainment_speed == pytest.approx(1.0 + 2.0 * time)
        assert found.problem.sliding_speed == pytest.approx(5.0 - 3.0 * time)
        line = 4.0 + 2.0 * (time + 1.0) if time < 2.0 else 10.0 - 3.0 * (time - 2.0)
        assert found.problem.line_load == pytest.approx(line)
        assert found.closure is not None
        for row in found.closure:
            np.testing.assert_allclose(row, expected)


def test_runs_of_loaded_positions():
    rng = np.random.default_rng(8)
    for _ in range(20):
        good = list(rng.uniform(size=9) > 0.4)
        expected, first = [], None
        for at, one in enumerate([*good, False]):
            if one and first is None:
                first = at
            elif not one and first is not None:
                if at - first > 1:
                    expected.append((first, at - 1))
                first = None
        assert squeezed._runs(good) == expected


def test_the_film_is_carried_from_position_to_position(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(squeezed, "_begun", lambda _stretch, _at: "start")
    monkeypatch.setattr(squeezed, "_times", lambda *_: (None, {2: 2, 5: 3}))
    monkeypatch.setattr(squeezed, "_Instants", lambda _: None)
    monkeypatch.setattr(squeezed, "march", lambda *_: (f"after {number}" for number in range(1, 6)))
    nothing: Any = None
    assert list(squeezed._carried(nothing, 1)) == [(1, "start"), (2, "after 2"), (3, "after 5")]


def test_behind_what_cannot_be_reached_the_film_begins_anew(monkeypatch: pytest.MonkeyPatch):
    """Of six positions from number 3 on, the fourth is lost: two beginnings."""
    ways = {0: [0, 1, 2], 3: [], 4: [4, 5]}
    monkeypatch.setattr(squeezed, "_carried", lambda _, at: ((n, f"s{n}") for n in ways[at]))
    put: list[Any] = []
    monkeypatch.setattr(
        squeezed, "_put", lambda _arrays, at, one, _contact, rise: put.append((at, one, rise))
    )
    stretch: Any = SimpleNamespace(times=np.zeros(6), rises=list("abcdef"))
    arrays = {"transient_central_film_thickness": np.zeros(10)}
    told: list[float] = []
    nothing: Any = None
    assert squeezed._through(stretch, nothing, arrays, 3, told.append) == 2
    assert put == [(3 + n, f"s{n}", "abcdef"[n]) for n in (0, 1, 2, 4, 5)]
    np.testing.assert_allclose(told, [0.4, 0.5, 0.6, 0.8, 0.9])


def test_what_is_written_of_an_instant(monkeypatch: pytest.MonkeyPatch):
    one = solution(2e5, 8e-3, 0.4, 0.3)
    seen: list[Any] = []
    monkeypatch.setattr(squeezed, "friction_of", lambda *rest: seen.append(rest) or -7e3)
    contact: Any = SimpleNamespace(rheology="r", thermal="t")
    arrays = {f"transient_{name}": np.full(3, np.nan) for name in squeezed._SCALARS}
    arrays |= {f"transient_{name}": np.full((3, 161), np.nan) for name in squeezed._PROFILES}
    rise = np.arange(6.0).reshape(3, 2)
    squeezed._put(arrays, 1, one.solution, contact, rise)
    assert arrays["transient_friction_coefficient"][1] == pytest.approx(7e3 / 2e5)
    assert arrays["transient_minimum_film_thickness"][1] == min(one.solution.mean_gap)
    assert arrays["transient_central_film_thickness"][1] == pytest.approx(
        np.interp(0.0, PLACE, one.solution.mean_gap)
    )
    assert arrays["transient_pressure"][1].max() == pytest.approx(2e8, rel=1e-2)
    assert np.all(np.isnan(arrays["transient_pressure"][[0, 2]]))
    np.testing.assert_array_equal(seen[0][3], rise.T)


def test_beginnings_within_the_way_are_counted(study: Prepared, over: Way, monkeypatch: pytest.MonkeyPatch):
    seen: list[Any] = []
    monkeypatch.setattr(
        squeezed, "_stretch", lambda chosen, _over, at, _case: seen.append((chosen, list(at)))
    )
    monkeypatch.setattr(squeezed, "_through", lambda *rest: seen.append(rest[3]) or 2)
    steady: Any = [1, 2, None, 4, None, None]
    nothing: Any = None
    none = squeezed.squeezed(over, study.case, nothing, [None] * 6, lambda _: None)
    assert (int(none["restarts"]), seen) == (0, [])
    found = squeezed.squeezed(over, study.case, nothing, steady, lambda _: None)
    assert (seen, int(found["restarts"])) == ([([1, 2], [0, 1]), 0], 1)
    seen.clear()
    found = squeezed.squeezed(over, study.case, nothing, [1, 2, None, 4, 5, 6], lambda _: None)  # pyright: ignore[reportArgumentType]
    assert seen == [([1, 2], [0, 1]), 0, ([4, 5, 6], [3, 4, 5]), 3]
    assert int(found["restarts"]) == 3


def test_shear_and_heat_of_steady_contacts_lie_on_one_grid(
    study: Prepared, over: Way, monkeypatch: pytest.MonkeyPatch
):
    grid = SimpleNamespace(node=np.linspace(-1.0, 1.0, 5))
    monkeypatch.setattr(squeezed, "grid_of", lambda *rest: asked.append(rest) or grid)
    asked: list[Any] = []
    node = np.linspace(-1.0, 1.0, 3)
    steady: Any = [
        SimpleNamespace(
            problem=f"problem {n}",
            node=node,
            closure=[n + 2.0 * node, n * node],
            rise=np.stack([node, n - node], axis=1),
        )
        for n in (1, 2)
    ]
    case = replace(study.case, step=0.3)
    found = squeezed._stretch(steady, over, np.array([2, 3]), case)
    assert asked == [("problem 1", 0.3, "problem 2")]
    np.testing.assert_allclose(found.times, over.roll[2:4] / 10.0)
    np.testing.assert_allclose(found.loads[0], over.table[0] / 10.0)
    np.testing.assert_allclose(found.loads[1], over.table[1])
    for n, closure, rise in zip((1, 2), found.closures, found.rises, strict=True):
        np.testing.assert_allclose(closure, [n + 2.0 * grid.node, n * grid.node])
        np.testing.assert_allclose(rise, [grid.node, n - grid.node])


class Simulated:
    """A record of a gear pair over time, of three driving slots and one of back flanks."""

    axis, groups = "time", ("mesh_cycle",)
    mesh_cycle = {"contact_ratio": 2.3, "roll_start": -0.4, "pinion_teeth": 20.0}  # noqa: RUF012

    def __init__(self, samples: int) -> None:
        self.data = {
            "pair": np.array([-1, 0, 1, 2]),
            "normal_load": np.arange(4.0 * samples).reshape(samples, 4),
        }
        self.data["normal_load"][3, 2] = np.nan

    def __enter__(self) -> "Simulated":
        return self

    def __exit__(self, *_: object) -> None: ...

    def __contains__(self, name: str) -> bool:
        return name in self.data

    def __getitem__(self, name: str) -> np.ndarray:
        return self.data[name]


def test_the_last_pair_is_followed_from_slot_to_slot(monkeypatch: pytest.MonkeyPatch):
    """It is number 1 over the cycle that it enters in, then 0, then −1; nothing where it does not touch."""
    record, asked = Simulated(30), []

    def window(of: Any, cycles: int) -> Any:
        asked.append(cycles)
        phase = np.arange(13) / 4.0
        return SimpleNamespace(phase=phase[: last + 1], part=slice(5, 18))

    last = 12
    monkeypatch.setattr(loads, "open_record", lambda path: record)
    monkeypatch.setattr(loads, "last_cycles", window)
    found = loads.loads_of_record(Path("run.h5"), "contact.loads")
    assert asked == [3]
    roll, load = (found[name]["values"] for name in ("roll_angle", "normal_load"))
    assert (found["roll_angle"]["unit"], found["normal_load"]["unit"]) == ("rad", "N")
    # phases 0 … 2.25 of the pair's way of 2.3 pitches
    assert len(roll) == len(load) == 10
    for number in range(10):
        assert roll[number] == pytest.approx(-0.4 + 2.0 * math.pi / 20.0 * number / 4.0)
        slot = 2 - number // 4
        assert load[number] == record.data["normal_load"][5 + number, slot]
    record.data["normal_load"][6, 2] = np.nan
    assert loads.loads_of_record(Path("run.h5"), "contact.loads")["normal_load"]["values"][1] == 0.0
    last = 8
    with pytest.raises(InputError, match="ends before a pair has passed"):
        loads.loads_of_record(Path("run.h5"), "contact.loads")
    for name, value in (("axis", "phase"), ("groups", ()), ("data", {"pair": record.data["pair"]})):
        other = Simulated(30)
        setattr(other, name, value)
        monkeypatch.setattr(loads, "open_record", lambda path, other=other: other)
        with pytest.raises(InputError, match="holds no loads of pairs over time"):
            loads.loads_of_record(Path("run.h5"), "contact.loads")


@pytest.mark.parametrize("solved", [0, 3])
def test_a_record_without_any_solution_has_failed(
    study: Prepared, over: Way, monkeypatch: pytest.MonkeyPatch, solved: int
):
    """The others hold every dataset of the layout, laws side by side, and a row per slide-to-roll ratio."""
    written: list[Any] = []
    count = len(over.roll)
    laws = {
        "film": {"one": np.full(count, 1.0), "two": np.full(count, 2.0)},
        "friction": {"three": np.full(count, 3.0)},
    }

    class Writer:
        def write(self, at: int, values: dict[str, Any]) -> None:
            written.append((at, values))

        def put(self, row: int, values: dict[str, Any]) -> None:
            written.append((row, values))

        def fail(self, message: str, summary: Any) -> str:
            written.append(message)
            return "path"

        def finish(self, summary: Any) -> str:
            written.append("finished")
            return "path"

    @contextmanager
    def writer(case: Any, path: Any, layout: Any, samples: int, scales: Any, **given: Any) -> Any:
        written.append((samples, scales, given["force"]))
        yield Writer()

    names = {*run.layout_of(False).samples, "phase"}
    arrays = {name: np.zeros(count) for name in names}
    monkeypatch.setattr(run, "target", lambda *_: "path")
    monkeypatch.setattr(run, "prepare", lambda _: study)
    monkeypatch.setattr(run, "way", lambda _: over)
    monkeypatch.setattr(run, "by_laws", lambda *_: laws)
    monkeypatch.setattr(run, "solve", lambda *_: arrays)
    monkeypatch.setattr(run, "_figures", lambda *_: {"positions_solved": solved})
    monkeypatch.setattr(run, "_traction", lambda *_: iter([0.01, 0.02]))
    monkeypatch.setattr(run, "writer", writer)
    made = run.run(study.case, force=True)
    (samples, scales, force), *rest = written
    assert (samples, force) == (study.case.positions, True)
    assert (list(scales["film_law"]), list(scales["friction_law"])) == (["one", "two"], ["three"])
    np.testing.assert_array_equal(scales["slide_to_roll"], run.TRACTION)
    if not solved:
        assert (made.status, rest) == ("failed", [made.message])
        return
    (at, values), first, second, last = rest
    assert (at, set(values), last) == (0, names, "finished")
    np.testing.assert_array_equal(values["film_by_law"], np.tile([1.0, 2.0], (count, 1)))
    np.testing.assert_array_equal(values["friction_by_law"], np.full((count, 1), 3.0))
    assert (first, second) == ((0, {"traction": 0.01}), (1, {"traction": 0.02}))
    assert made.status == "complete"


def test_every_law_is_evaluated_along_the_way(study: Prepared, over: Way, monkeypatch: pytest.MonkeyPatch):
    """But the solved one and none; not those that want values of their own; a number holds everywhere."""

    def seen(of: Any, along: Any, film: str | None, friction: str) -> Any:
        if friction == "coulomb":
            raise InputError("friction.coefficient", rule="missing")
        value = -0.05 if friction == "xu" else 0.01 * np.arange(len(over.roll))
        surface = SimpleNamespace(central_film_thickness=f"film by {film}", friction_coefficient=value)
        return SimpleNamespace(surface=surface)

    monkeypatch.setattr(along_path, "seen_by", seen)
    found = along_path.by_laws(study, over)
    assert {"solved", "none", "coulomb"}.isdisjoint({*found["film"], *found["friction"]})
    np.testing.assert_array_equal(found["friction"]["xu"], np.full(len(over.roll), 0.05))
    np.testing.assert_allclose(found["friction"]["schlenk"], 0.01 * np.arange(len(over.roll)))
    assert {name: str(film) for name, film in found["film"].items()} == {
        name: f"film by {name}" for name in found["film"]
    }
    assert len(found["film"]) > 2


@pytest.mark.parametrize("squeeze", [False, True])
def test_progress_is_shared_with_squeeze(
    study: Prepared, over: Way, monkeypatch: pytest.MonkeyPatch, squeeze: bool
):
    """It never falls, and ends at the whole."""
    told: list[float] = []

    def with_squeeze(way: Any, case: Any, contact: Any, steady: Any, progress: Any) -> dict[str, Any]:
        for share in (0.25, 1.0):
            progress(share)
        return {"restarts": 0}

    monkeypatch.setattr(run, "solved_at", solver())
    monkeypatch.setattr(run, "kept", lambda found: found)
    monkeypatch.setattr(run, "squeezed", with_squeeze)
    found = run.solve(study._replace(case=replace(study.case, transient=squeeze)), over, told.append)
    assert told == sorted(told)
    assert told[-1] == pytest.approx(1.0)
    assert 0.0 < told[0] < told[-1]
    assert ("restarts" in found) == squeeze
