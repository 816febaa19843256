"""A case of the oscillator with backlash: everything one frequency sweep needs to know, dimensionless."""

from dataclasses import dataclass

from tribodyn.studies.protocol.study import CaseHead


@dataclass(frozen=True)
class BacklashOscillatorCase(CaseHead):
    """A sweep of x'' + 2ζ x' + (1 + ε cos Ωτ) f(x) = F_m + F_e Ω² cos Ωτ, up and down in Ω.

    Lengths are in units of half the backlash, times in those of the linear oscillator's 1/ω_n.

    Parameters
    ----------
    title, name, kind, toml, sha256 : str
        As in `tribodyn.studies.gear_pair.case.Case`; `kind` is "backlash-oscillator".
    damping : float
        ζ.
    mean_force : float
        F_m.
    error_amplitude : float
        F_e, amplitude of the transmission error.
    stiffness_variation : float
        ε, of which no more than 1 makes sense.
    frequencies : tuple of float
        Ω, increasing.
    max_periods : int
        Periods of the excitation marched at each frequency before a motion is called not periodic.
    unstable : bool
        Whether branches are continued beyond the ends of their stable parts.
    """

    damping: float
    mean_force: float
    error_amplitude: float
    stiffness_variation: float
    frequencies: tuple[float, ...]
    max_periods: int = 600
    unstable: bool = False
