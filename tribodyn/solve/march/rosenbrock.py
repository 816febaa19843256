"""The Rosenbrock pair RODAS4P 4(3) of Steinebach: coefficients, dense output and choice of the step.

Six stages with one matrix, stiffly accurate and L-stable. Of its kind it keeps its order where a stiff
system follows a given motion, as teeth do that are dragged slowly through the mesh. G. Steinebach,
Order-reduction of ROW-methods for DAEs and method of lines applications, preprint 1741, TH Darmstadt (1995);
coefficients as in the code RODAS (its third set) of Hairer & Wanner, Solving Ordinary Differential Equations
II (2nd ed., 1996).

Stage i solves (I/(γh) − J) U_i = f(φ + α_i h, y + Σ a_ij U_j) + Σ c_ij U_j/h + γ_i h ∂f/∂φ, and
y_1 = y + Σ m_j U_j with the last stage as the error.
"""

import numpy as np

from tribodyn.numerics.elementary import law, maximum, minimum

STAGES = 6
GAMMA = 0.25
A = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0],
        [3.0, 0.0, 0.0, 0.0, 0.0],
        [1.831036793486759, 0.4955183967433795, 0.0, 0.0, 0.0],
        [2.304376582692669, -0.05249275245743001, -1.176798761832782, 0.0, 0.0],
        [-7.170454962423024, -4.741636671481785, -16.31002631330971, -1.062004044111401, 0.0],
        [-7.170454962423024, -4.741636671481785, -16.31002631330971, -1.062004044111401, 1.0],
    ]
)
C = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0],
        [-12.0, 0.0, 0.0, 0.0, 0.0],
        [-8.791795173947035, -2.207865586973518, 0.0, 0.0, 0.0],
        [10.81793056857153, 6.780270611428266, 19.5348594464241, 0.0, 0.0],
        [34.19095006749676, 15.49671153725963, 54.7476087596413, 14.16005392148534, 0.0],
        [34.62605830930532, 15.30084976114473, 56.99955578662667, 18.40807009793095, -5.714285714285717],
    ]
)
#: α, where a stage stands in its step, and γ_i, its weight of ∂f/∂φ.
ALPHA = np.array([0.0, 0.75, 0.21, 0.63, 1.0, 1.0])
GAMMAS = np.array([0.25, -0.5, -0.023504, -0.0362, 0.0, 0.0])
#: Weights of the dense output's two higher terms.
D = np.array(
    [
        [25.09876703708589, 11.62013104361867, 28.49148307714626, -5.664021568594133, 0.0],
        [1.638054557396973, -0.7373619806678748, 8.47791821923899, 15.9925314877952, -1.882352941176471],
    ]
)


@law
def growth(error, last_error):
    """Factor on the step after an accepted one: PI control on this error and the last, 0.2 … 6."""
    factor = 0.8 * maximum(error, 1e-10) ** -0.21 * last_error**0.05
    return minimum(6.0, maximum(0.2, factor))


@law
def shrinkage(error):
    """Factor on the step after a rejected one, error > 1."""
    return maximum(0.1, 0.9 * error**-0.25)


@law
def dense_output(theta, before, after, first, second):
    """State at the share `theta` of a step, third order; `first` and `second` are the rows of Σ D U."""
    return (1.0 - theta) * before + theta * (after + (1.0 - theta) * (first + theta * second))
