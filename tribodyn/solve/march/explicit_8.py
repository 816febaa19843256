"""The explicit Runge-Kutta triple of Dormand & Prince 8(5,3), for derivatives of a march.

After Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I (2nd ed., 1993), code DOP853. It
takes a third of the evaluations of the pair 5(4) at the tolerances that derivatives of a march need. Between
steps it has no samples.
"""

import numpy as np

from tribodyn.dynamics.equations import derivatives
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import absolute, largest_slope, law, maximum, minimum, plain, sqrt
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.extreme_search import ignore_segment, ignore_step
from tribodyn.solve.march.marching import ERROR, SCRATCH, STATE, Method, scratch_buffer
from tribodyn.train.layout import TrainLayout

STAGES = 12
# fmt: off
#: Nonzero coefficients of the stages, and of the new state in the last row.
_A = (
    {},
    {0: 0.05260015195876773},
    {0: 0.0197250569845379, 1: 0.0591751709536137},
    {0: 0.02958758547680685, 2: 0.08876275643042054},
    {0: 0.2413651341592667, 2: -0.8845494793282861, 3: 0.924834003261792},
    {0: 0.037037037037037035, 3: 0.17082860872947386, 4: 0.12546768756682242},
    {0: 0.037109375, 3: 0.17025221101954405, 4: 0.06021653898045596, 5: -0.017578125},
    {0: 0.03709200011850479, 3: 0.17038392571223998, 4: 0.10726203044637328, 5: -0.015319437748624402,
     6: 0.008273789163814023},
    {0: 0.6241109587160757, 3: -3.3608926294469414, 4: -0.868219346841726, 5: 27.59209969944671,
     6: 20.154067550477894, 7: -43.48988418106996},
    {0: 0.47766253643826434, 3: -2.4881146199716677, 4: -0.590290826836843, 5: 21.230051448181193,
     6: 15.279233632882423, 7: -33.28821096898486, 8: -0.020331201708508627},
    {0: -0.9371424300859873, 3: 5.186372428844064, 4: 1.0914373489967295, 5: -8.149787010746927,
     6: -18.52006565999696, 7: 22.739487099350505, 8: 2.4936055526796523, 9: -3.0467644718982196},
    {0: 2.273310147516538, 3: -10.53449546673725, 4: -2.0008720582248625, 5: -17.9589318631188,
     6: 27.94888452941996, 7: -2.8589982771350235, 8: -8.87285693353063, 9: 12.360567175794303,
     10: 0.6433927460157636},
    {0: 0.054293734116568765, 5: 4.450312892752409, 6: 1.8915178993145003, 7: -5.801203960010585,
     8: 0.3111643669578199, 9: -0.1521609496625161, 10: 0.20136540080403034, 11: 0.04471061572777259},
)
C = np.array([
    0.0, 0.05260015195876773, 0.0789002279381516, 0.1183503419072274, 0.2816496580927726,
    0.3333333333333333, 0.25, 0.3076923076923077, 0.6512820512820513, 0.6, 0.8571428571428571, 1.0, 1.0,
])
_E5 = {
    0: 0.01312004499419488, 5: -1.2251564463762044, 6: -0.4957589496572502, 7: 1.6643771824549864,
    8: -0.35032884874997366, 9: 0.3341791187130175, 10: 0.08192320648511571, 11: -0.022355307863886294,
}
_E3 = {
    0: -0.18980075407240762, 5: 4.450312892752409, 6: 1.8915178993145003, 7: -5.801203960010585,
    8: -0.4226823213237919, 9: -0.1521609496625161, 10: 0.20136540080403034, 11: 0.02265179219836082,
}
# fmt: on


def _dense(*rows):
    return np.array([[row.get(j, 0.0) for j in range(STAGES + 1)] for row in rows])


#: Weights of the stages before each: rows 0 … 11 give the stages, row 12 the new state.
A = _dense(*_A)
#: The second stage that has a weight in each row; the first one always has.
SECOND = np.array([min((j for j in row if j), default=1) for row in _A])
#: Weights of the differences to the embedded methods of fifth and third order.
E5, E3 = _dense(_E5, _E3)
#: Weight of the third-order difference against the fifth-order one.
THIRD = 0.1


@law
def confidence(fifth, third):
    """Factor on the fifth-order difference that makes an estimate of seventh order of it, 0 … 1."""
    size = fifth * fifth + THIRD * THIRD * third * third
    return fifth / sqrt(maximum(size, 1e-300))


@law
def growth(error):
    """Factor on the step after an accepted one, 0.3 … 6."""
    return minimum(6.0, maximum(0.3, 0.9 * maximum(error, 1e-12) ** -0.125))


@law
def shrinkage(error):
    """Factor on the step after a rejected one, error > 1."""
    return maximum(0.3, 0.9 * error**-0.125)


def buffer(layout: TrainLayout) -> Float[Array, "row state"]:
    """Scratch for the kernel: the new state, its error and the stages."""
    return scratch_buffer(STAGES + 1, layout)


@kernel
def attempt(fresh, step, place, y, control, model, work, buffer):
    """See `marching.Method`; the rates at the new state are the next step's first."""
    stage, k, layout = buffer[STATE], buffer[SCRATCH:], model.options.layout
    if fresh:
        for i in range(layout.states):
            stage[i] = y[i]
    for s in range(0 if fresh else 1, STAGES + 1):
        if s > 0:
            for i in range(layout.mechanical):
                total = A[s, 0] * k[0, i]
                for j in range(SECOND[s], s):
                    total = total + A[s, j] * k[j, i]
                stage[i] = y[i] + step * total
        derivatives(place.phase + C[s] * step, place.cycle, place.interval, stage, model, work, k[s])
    for i in range(layout.mechanical):
        fifth, third = E5[0] * k[0, i], E3[0] * k[0, i]
        for j in range(SECOND[STAGES], STAGES):
            fifth = fifth + E5[j] * k[j, i]
            third = third + E3[j] * k[j, i]
        of_fifth = maximum(absolute(plain(fifth)), largest_slope(fifth))
        of_third = maximum(absolute(plain(third)), largest_slope(third))
        buffer[ERROR, i] = step * confidence(of_fifth, of_third) * fifth
    for i in range(layout.mechanical, layout.states):  # works, on which nothing depends: numbers alone
        total, fifth, third = 0.0, 0.0, 0.0
        for j in range(STAGES):
            rate = plain(k[j, i])
            total += A[STAGES, j] * rate
            fifth += E5[j] * rate
            third += E3[j] * rate
        stage[i] = plain(y[i]) + step * total
        buffer[ERROR, i] = step * confidence(absolute(fifth), absolute(third)) * fifth
    return STAGES + 1 if fresh else STAGES


@kernel
def sample(theta, step, y, buffer, out, layout):
    """See `marching.Method`: a chord, as only states at the start of a mesh cycle are asked for."""
    for i in range(layout.states):
        out[i] = y[i] + theta * (buffer[STATE, i] - y[i])


@kernel
def accept(buffer, layout):
    """See `marching.Method`: the last rates are the next step's first."""
    for i in range(layout.states):
        buffer[SCRATCH, i] = buffer[SCRATCH + STAGES, i]
    return False


@kernel
def adapted(step, error, last_error, buffer):
    """See `marching.Method`."""
    return step * (growth(error) if error <= 1.0 else shrinkage(error))


@kernel
def contacts(phase, interval, model, work, buffer):
    """See `marching.Method`: nobody asks."""


METHOD = Method(attempt, sample, accept, adapted, contacts, ignore_segment, ignore_step)
