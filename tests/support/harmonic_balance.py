"""Multi-harmonic balance of the oscillator with backlash at constant stiffness: a solver of another kind.

Harmonics 0 … H of x; those of the force by sampling it over a period (alternating frequency and time).
Branches are followed by the amplitude of the first harmonic, which goes on where the frequency turns back.
"""

import numpy as np
from scipy.optimize import root


def restoring(x):
    return np.where(x > 1.0, x - 1.0, np.where(x < -1.0, x + 1.0, 0.0))


class HarmonicBalance:
    def __init__(self, damping, mean_force, error_amplitude, harmonics=12, samples=1024):
        self.damping, self.mean_force, self.error_amplitude = damping, mean_force, error_amplitude
        self.harmonics, self.samples = harmonics, samples

    def residual(self, coefficients, frequency):
        """Of the coefficients (mean, H cosines, H sines)."""
        count, samples = self.harmonics, self.samples
        x_hat = np.append(coefficients[0], coefficients[1 : count + 1] - 1j * coefficients[count + 1 :])
        spectrum = np.zeros(samples // 2 + 1, dtype=complex)
        spectrum[0], spectrum[1 : count + 1] = x_hat[0] * samples, x_hat[1:] * samples / 2.0
        force = np.fft.rfft(restoring(np.fft.irfft(spectrum, samples)))[: count + 1] / samples
        force[1:] *= 2.0
        order = np.arange(count + 1) * frequency
        balance = (-(order**2) + 2j * self.damping * order) * x_hat + force
        balance[0] -= self.mean_force
        balance[1] -= self.error_amplitude * frequency**2
        return np.concatenate([[balance[0].real], balance[1:].real, balance[1:].imag])

    def branch(self, start, amplitudes):
        """Frequencies at which the first harmonic has the amplitudes, from linear motion at `start` on."""
        return self.branch_with_states(start, amplitudes)[0]

    def branch_with_states(self, start, amplitudes):
        """These frequencies, and the states (x, dx/dτ) where the excitation is at its maximum."""
        linear = self.error_amplitude * start**2 / (1.0 - start**2)
        guess = np.zeros(2 * self.harmonics + 1)
        guess[0], guess[1] = 1.0 + self.mean_force, linear
        unknown = np.append(guess, start)
        frequencies, states = [], []
        orders = np.arange(1, self.harmonics + 1)
        for amplitude in amplitudes:

            def equations(u, amplitude=amplitude):
                first = np.hypot(u[1], u[1 + self.harmonics])
                return np.append(self.residual(u[:-1], u[-1]), first - amplitude)

            solution = root(equations, unknown, tol=1e-10)
            assert solution.success, (amplitude, solution.message)
            unknown = solution.x
            frequencies.append(unknown[-1])
            cosines, sines = unknown[1 : self.harmonics + 1], unknown[self.harmonics + 1 : -1]
            states.append([unknown[0] + np.sum(cosines), unknown[-1] * np.sum(orders * sines)])
        return np.array(frequencies), np.array(states)


def turning_points(amplitudes, frequencies):
    """Frequencies where a branch turns back, by parabolas through the three points about them."""
    rise = np.diff(frequencies)
    found = []
    for i in np.flatnonzero(rise[1:] * rise[:-1] < 0.0) + 1:
        a, b, c = np.polyfit(amplitudes[i - 1 : i + 2], frequencies[i - 1 : i + 2], 2)
        found.append(c - b * b / (4.0 * a))
    return found
