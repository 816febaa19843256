"""Asperities of two flanks by Greenwood & Tripp's two constants: given, or typical of the flanks' finish.

Height σ of the rms roughness, radius β and number per area n enter as σβn and σ/β. No drawing gives them, and
friction of a mixed contact follows them: of one pair 0.008 to 0.045 (docs/ehl.md).
"""

from typing import Literal, NamedTuple, get_args

FinishName = Literal["ground", "superfinished", "hobbed"]
FINISHES: tuple[FinishName, ...] = get_args(FinishName)


class Asperities(NamedTuple):
    """Greenwood & Tripp's constants of both surfaces as one."""

    density: float = 0.05  # σβn: 0.03 to 0.05 of ground steel (Greenwood & Tripp 1970)
    slope: float = 0.01  # σ/β


#: Finish -> constants and their source. Ground is what no finish counts as.
BY_FINISH: dict[FinishName, tuple[Asperities, str]] = {
    "ground": (
        Asperities(),
        "σβn: Greenwood & Tripp (1970), 0.03 to 0.05 of ground steel; σ/β: assumption, σ 0.5 µm and β 50 µm",
    ),
    "superfinished": (
        Asperities(0.03, 0.001),
        "assumption: the lowest σβn of ground steel; tops flattened, σ 0.1 µm and β 100 µm",
    ),
    "hobbed": (
        Asperities(0.05, 0.03),
        "assumption: σβn of ground steel; feed marks and burrs, σ 3 µm and β 100 µm",
    ),
}


def asperities_of(finish: FinishName | None, density: float | None, slope: float | None) -> Asperities:
    """Return the constants that are given, else those of the finish, else those of ground flanks."""
    typical, _ = BY_FINISH[finish or "ground"]
    return Asperities(
        typical.density if density is None else density, typical.slope if slope is None else slope
    )
