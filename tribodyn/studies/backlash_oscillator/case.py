"""A case of the oscillator with backlash: everything one frequency sweep needs to know, dimensionless."""

from dataclasses import dataclass

from tribodyn.studies.protocol.study import CaseHead


@dataclass(frozen=True)
class BacklashOscillatorCase(CaseHead):
    """A sweep of x'' + 2ζ x' + (1 + ε cos Ωτ) f(x) = F_m + F_e Ω² cos Ωτ, up and down in Ω.

    Lengths are in units of half the backlash, times in those of the linear oscillator's 1/ω_n.

    Parameters
    ----------
    title, name, kind, toml, sha256 : as in `tribodyn.studies.gear_pair.case.Case`; `kind` is
        "backlash-oscillator"
    damping : ζ
    mean_force : F_m
    error_amplitude : F_e, amplitude of the transmission error
    stiffness_variation : ε, of which no more than 1 makes sense
    frequencies : Ω, increasing
    max_periods : periods of the excitation marched at each frequency before a motion is called not periodic
    unstable : whether branches are continued beyond the ends of their stable parts
    """

    damping: float
    mean_force: float
    error_amplitude: float
    stiffness_variation: float
    frequencies: tuple[float, ...]
    max_periods: int = 600
    unstable: bool = False
