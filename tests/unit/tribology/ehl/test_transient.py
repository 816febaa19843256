"""The transient line contact: order in time, slow limit, a load step, mass, squeezing of rigid cylinders."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.support.line_contacts import REFERENCES, by_moes
from tribodyn.errors import SimulationError
from tribodyn.tribology.ehl import transient
from tribodyn.tribology.ehl.fluid import log_viscosity, relative_density
from tribodyn.tribology.ehl.reynolds import Snapshot
from tribodyn.tribology.ehl.rough import Roughness
from tribodyn.tribology.ehl.steady import grid_of, solve_steady
from tribodyn.tribology.ehl.transient import Instant, march

SMOOTH = REFERENCES[1][0]
ROUGH = SMOOTH._replace(roughness=Roughness(3e-7))
NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)
FLUID = SMOOTH.fluid
#: Time in which the oil is drawn through half a contact.
TRANSIT = SMOOTH.half_width / SMOOTH.entrainment_speed


def swaying(problem, period):
    """Load, radius and speed swing out and back over a period, smoothly from rest."""

    def at(time):
        swing = math.sin(math.pi * time / period) ** 2
        return Instant(
            problem._replace(
                line_load=problem.line_load * (1.0 - 0.4 * swing),
                radius=problem.radius * (1.0 + 0.2 * swing),
                entrainment_speed=problem.entrainment_speed * (1.0 + 0.3 * swing),
            )
        )

    return at


def marched(at, end, steps, resolution=0.25):
    """Solutions at the end of each of equal steps, the steady one at the beginning first."""
    problem = at(0.0).problem
    grid = grid_of(problem, resolution, at(0.5 * end).problem, at(end).problem)
    start = solve_steady(problem, grid=grid)
    return [start, *march(at, np.linspace(0.0, end, steps + 1), start)]


@pytest.mark.parametrize("problem", [SMOOTH, ROUGH], ids=["smooth", "rough"])
def test_order_in_time(problem):
    at = swaying(problem, 8.0 * TRANSIT)
    ends = [marched(at, 5.0 * TRANSIT, steps, 0.4)[-1] for steps in (20, 40, 80)]
    for name in ("central_film_thickness", "minimum_film_thickness"):
        films = [getattr(known, name) for known in ends]
        assert math.log2((films[1] - films[0]) / (films[2] - films[1])) >= 1.9


def at_face(node, value, i):
    """Value half way between nodes i and i + 1, of the parabola with node i − 1."""
    if i == 0:
        return 0.5 * (value[0] + value[1])
    x = 0.5 * (node[i] + node[i + 1])
    return np.polyval(np.polyfit(node[i - 1 : i + 2] - x, value[i - 1 : i + 2], 2), 0.0)


def rate(times, values):
    """Derivative at the last of the times of the polynomial through all."""
    scale = times[-1] - times[0]
    return (
        np.polyder(np.poly1d(np.polyfit((np.array(times) - times[-1]) / scale, values, len(times) - 1)))(0.0)
        / scale
    )


@pytest.mark.parametrize("problem", [SMOOTH, ROUGH], ids=["smooth", "rough"])
def test_mass_and_load_of_every_instant_in_plain_loops(problem):
    """SI: d/dt of the mass between a face and the end = flow through the face − outflow, nodes that move.

    Unequal steps; the derivative is that of the parabola through the last three instants, of the line of two.
    """
    period = 8.0 * TRANSIT
    at, times = swaying(problem, period), np.array([0.0, 0.3, 0.75, 1.6, 2.0]) * TRANSIT
    grid = grid_of(problem, 0.4, at(2.0 * TRANSIT).problem)
    start = solve_steady(problem, grid=grid)
    found = [start, *march(at, times, start)]
    assert len(found) == 5
    last, xi = grid.end, grid.node
    masses, places = [], []
    for known in found:
        b = known.problem.half_width
        density = relative_density(known.fluid_pressure, FLUID)[0]
        length = [0.5 * (xi[1] - xi[0]), *(0.5 * (xi[j + 1] - xi[j - 1]) for j in range(1, last))]
        length.append(0.5 * (xi[last] - xi[last - 1]))
        masses.append([density[j] * known.mean_gap[j] * length[j] * b for j in range(last + 1)])
        faces = [0.5 * (xi[i] + xi[i + 1]) for i in range(last)] + [xi[last]]
        places.append([b * (known.state.end + face) for face in faces])
    masses, places = np.array(masses), np.array(places)
    for k in range(1, 5):
        now, known, which = at(times[k]).problem, found[k], slice(max(k - 2, 0), k + 1)
        assert known.problem == now
        # the ends of the whole deformation: gap of the parabola and pressures that carry the load
        assert np.trapezoid(known.pressure, known.place) == pytest.approx(now.line_load, rel=1e-9)
        grown = [rate(times[which], masses[which, j]) for j in range(last + 1)]
        moves = [rate(times[which], places[which, i]) for i in range(last + 1)]
        u, h, p = now.entrainment_speed, known.mean_gap[: last + 1], known.fluid_pressure[: last + 1]
        ln_eta, density = log_viscosity(p, FLUID)[0], relative_density(p, FLUID)[0]
        out = known.flow_film_thickness * (u - moves[last])
        for i in range(last):
            thick, dense = at_face(xi, h, i), at_face(xi, density, i)
            low, high = ln_eta[i], ln_eta[i + 1]
            inverse = math.exp(-low) if low == high else (math.exp(-low) - math.exp(-high)) / (high - low)
            slope = (p[i + 1] - p[i]) / (known.place[i + 1] - known.place[i])
            factor = 1.0 - (0.9 * math.exp(-0.56 * thick / 3e-7) if problem is ROUGH else 0.0)
            pushed = dense * factor * thick**3 / (12.0 * FLUID.viscosity) * inverse * slope
            through = dense * thick * (u - moves[i]) - pushed
            assert sum(grown[i + 1 :]) == pytest.approx(through - out, abs=2e-8 * u * h[0])
        assert known.imbalance <= 1e-10
        assert known.steps <= 6


class Instants:
    """Instants without films: those whose step is too long fail."""

    def __init__(self, monkeypatch, longest):
        self.tried, self.longest = [], longest
        monkeypatch.setattr(transient, "_stepped", self.stepped)
        monkeypatch.setattr(transient, "_snapshot", lambda solution, time: Snapshot(time, None, None))

    def stepped(self, instant_at, time, before, known):
        assert len(before) == len(known) <= 2
        step = time - before[-1].time
        self.tried.append((time, step <= self.longest))
        return time if step <= self.longest else None

    def march(self, times):
        start: Any = times[0]
        return list(march(lambda _: Instant(SMOOTH), times, start))


def test_the_steady_contact_is_the_slow_limit():
    """The departure falls with the rate of change."""
    departures = []
    for period in (200.0, 400.0, 800.0):
        at = swaying(SMOOTH, period * TRANSIT)
        found = marched(at, 0.3 * period * TRANSIT, 24)[-1]
        steady = solve_steady(found.problem, grid=found.grid)
        departures.append(found.central_film_thickness / steady.central_film_thickness - 1.0)
    assert -0.01 < departures[0] < 0.0
    assert departures[0] / departures[1] == pytest.approx(2.0, rel=0.05)
    assert departures[1] / departures[2] == pytest.approx(2.0, rel=0.05)


def test_nothing_happens_to_a_steady_contact():
    solutions = marched(lambda _time: Instant(SMOOTH), 3.0 * TRANSIT, 5)
    for solution in solutions[1:]:
        assert solution.central_film_thickness == pytest.approx(solutions[0].central_film_thickness, rel=1e-9)


@pytest.mark.parametrize("factor", [0.8, 1.3])
def test_a_load_step_decays_as_smaller_steps_say(factor):
    """The thinnest film feels the step when the oil of the new inlet has come to it, and then is steady.

    The load changes within half a transit of the oil through half a contact.
    """

    def at(time):
        share = min(2.0 * time / TRANSIT, 1.0)
        return Instant(SMOOTH._replace(line_load=SMOOTH.line_load * (1.0 + (factor - 1.0) * share)))

    runs = [marched(at, 6.0 * TRANSIT, steps, 0.4) for steps in (60, 120, 240)]
    steady = solve_steady(at(TRANSIT).problem, grid=runs[0][0].grid).minimum_film_thickness
    films = [np.array([solution.minimum_film_thickness for solution in run]) for run in runs]
    departures = [
        film[:: len(film) // 60] / (film[0] - steady) - steady / (film[0] - steady) for film in films
    ]
    coarse, fine = np.sqrt(np.mean(np.diff(departures, axis=0) ** 2, axis=1))
    assert fine < coarse / 1.7
    assert fine < 0.15
    for departure in departures:
        assert np.max(np.abs(departure[15:30])) > 1.5
        assert np.max(np.abs(departure[40:])) < 0.25
        assert abs(departure[-1]) < 0.05


def rigid_approach(gap, problem):
    """−dh_0/dt of rigid isoviscous cylinders at h_0: p' = 12 η [u (x² − e²)/2R − V (x − e)]/h³, e the end.

    V and e follow from p = 0 at both ends and the load.
    """
    speed, radius = problem.entrainment_speed, problem.radius
    unit = math.sqrt(2.0 * radius * gap)

    def moments(end, approach):
        """∫ p' dx and −∫ x p' dx, with x = √(2 R h_0) tan φ."""
        half = 0.5 * (math.atan(end) + 0.5 * math.pi)
        angle = math.atan(end) + half * (NODES - 1.0)
        x = np.tan(angle)
        drawn = speed * unit**2 * (x * x - end * end) / (2.0 * radius) - approach * unit * (x - end)
        slope = 12.0 * problem.fluid.viscosity * drawn * np.cos(angle) ** 4 / gap**3 * unit * half
        return WEIGHTS @ slope, -WEIGHTS @ (x * slope) * unit

    def missing(approach):
        end = brentq(lambda e: moments(e, approach)[0], -1.0, 50.0)
        return moments(end, approach)[1] / problem.line_load - 1.0

    scale = speed * unit / radius
    return float(brentq(missing, -0.5 * scale, 2.0 * scale))  # pyright: ignore[reportArgumentType]


def test_rigid_cylinders_squeeze_the_oil_as_their_closed_form():
    """At M = 0.05 nothing bends; the load doubles within the time that the oil needs through the gap."""
    problem = by_moes(0.05, 0.0)
    gap = 2.449 / 0.05 * problem.line_load / problem.effective_modulus / 0.05
    unit = math.sqrt(2.0 * problem.radius * gap)
    end = 2.0 * unit / problem.entrainment_speed

    def at(time):
        return Instant(
            problem._replace(line_load=problem.line_load * (1.0 + math.sin(0.5 * math.pi * time / end) ** 2))
        )

    solutions = marched(at, end, 40, 0.1)
    bent = solutions[0].central_film_thickness
    times = np.linspace(0.0, end, 11)
    gap = brentq(lambda depth: rigid_approach(depth, problem), 0.5 * bent, 1.5 * bent)
    assert gap == pytest.approx(bent, rel=5e-3)
    for now, step in zip(times[:-1], np.diff(times), strict=True):  # Heun
        first = -rigid_approach(gap, at(now).problem)
        gap += 0.5 * step * (first - rigid_approach(gap + step * first, at(now + step).problem))
    assert solutions[-1].central_film_thickness == pytest.approx(gap, rel=5e-3)
    steady = solve_steady(at(end).problem).central_film_thickness
    assert solutions[-1].central_film_thickness > 1.05 * steady


def test_a_contact_that_cannot_be_reached_stops():
    """A load that rises a hundredfold at once."""

    def at(time):
        return Instant(SMOOTH._replace(line_load=(100.0 if time > 0.0 else 1.0) * SMOOTH.line_load))

    with pytest.raises(SimulationError, match="start again from a steady contact"):
        marched(at, 1e-4 * TRANSIT, 1)
