"""Whether a result lies within what its model assumes; if not, what is outside, how far, where, how long.

One table of rules for all studies (`RULES`). A study hands over those of the quantities that it has, as they
are sampled, to a `Judge`, and puts what that says into its summary. Writers copy it to the root of a record,
and reports take it from there. A result outside the model is complete, but not to be trusted.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

#: Names in a summary, and of attributes of a record: the verdict, and the reasons by name of the rule.
TRUST, REASONS = "trust", "trust_reasons"
#: The verdicts. Without one nothing was judged: a study without such quantities, or a record of 0.1.0.
INSIDE, OUTSIDE = "inside the model", "outside the model"
#: The same as numbers, for the cases of a sweep.
VERDICTS = {OUTSIDE: 0, INSIDE: 1}
NOT_JUDGED = -1


class Rule(NamedTuple):
    """What a model assumes of a quantity.

    Parameters
    ----------
    label : str
        The quantity in words.
    most : float
        Above it a result lies outside the model; SI.
    units : str
    about : str
        Why the limit is where it is.
    least : float
        Below it likewise.
    factor, unit
        From SI to what is shown, and the unit of that.
    """

    label: str
    most: float
    units: str
    about: str
    least: float = -math.inf
    factor: float = 1.0
    unit: str = ""

    def outside(self, values: np.ndarray) -> np.ndarray:
        """Where values are outside; NaN is not."""
        return (values > self.most) | (values < self.least)

    def beyond(self, values: np.ndarray) -> np.ndarray:
        """How far values are beyond the limit that they come nearest to, below 0 inside."""
        return np.maximum(values - self.most, self.least - values)

    def limit(self, value: float) -> float:
        """The limit that a value is beyond."""
        return self.least if value < self.least else self.most

    def shown(self, value: float) -> str:
        """A value as it is read."""
        return f"{value * self.factor:.4g}{' ' if self.unit else ''}{self.unit}"

    def short(self, value: float) -> str:
        """The quantity and the limit that a value is beyond."""
        side = "below" if value < self.least else "above"
        return f"{self.label} {side} {self.shown(self.limit(value))}"


RULES: dict[str, Rule] = {
    "deflection": Rule(
        "deflection of a pair of teeth over the module",
        0.1,
        "1",
        "stiffness and path of contact are those of teeth that keep their form; a tenth of the module is ten "
        "times what gears are designed for, and bends them beyond any yield strength",
        factor=100.0,
        unit="%",
    ),
    "friction_coefficient": Rule(
        "friction coefficient",
        1.0,
        "1",
        "no lubricated contact has more; regressions extrapolated give it",
    ),
    "hertz_pressure": Rule(
        "Hertz pressure",
        4e9,
        "Pa",
        "case-hardened steel yields under its surface at about 3 GPa and shakes down to no more than 4; the "
        "elastic half space says nothing of it",
        factor=1e-9,
        unit="GPa",
    ),
    "efficiency": Rule(
        "efficiency",
        1.0 + 1e-12,
        "1",
        "a share of a power; outside, a force makes power that no source gives",
        least=-1e-12,
        factor=100.0,
        unit="%",
    ),
    "energy_residual": Rule(
        "residual of the energy balance over solver.rtol",
        100.0,
        "1",
        "works are integrated with the motion and close within some ten times the tolerance",
    ),
    "bearing_displacement": Rule(
        "displacement of a gear in its bearings over the tip clearance",
        1.0,
        "1",
        "tips would touch the roots of the mate; the path of contact is that of fixed centres",
        factor=100.0,
        unit="%",
    ),
}


class Excess(NamedTuple):
    """How a result breaks a rule.

    Attributes
    ----------
    value, limit : float
        The value that is furthest outside, and the limit; SI.
    units : str
    share : float or None
        Share of the samples in which the rule is broken; None of a single number.
    places : dict
        Where the value is: time (s), mesh_cycle, pair, ….
    """

    value: float
    limit: float
    units: str
    share: float | None
    places: dict[str, float]


class Judge:
    """Takes quantities of a run as they come, and says at the end what lies outside the model."""

    def __init__(self) -> None:
        self._worst: dict[str, tuple[float, dict[str, float]]] = {}
        self._samples: dict[str, int] = {}
        self._outside: dict[str, int] = {}

    def take(
        self,
        quantities: Mapping[str, Any],
        places: Mapping[str, Any] | None = None,
        pairs: Sequence[int] = (),
        between_samples: bool = False,
    ) -> None:
        """Take a block of values.

        Parameters
        ----------
        quantities : mapping
            Name of a rule -> a number, or values (n,) or (n, pairs, …); NaN where there is nothing to judge.
        places : mapping, optional
            Name -> where the n samples lie (n,).
        pairs : sequence of int
            Numbers of the pairs along the second axis.
        between_samples : bool
            Whether the values are those of extremes between samples, which do not count in any share.
        """
        for name, given in quantities.items():
            rule, values = RULES[name], np.asarray(given, dtype=float)
            if values.size == 0:
                continue
            if values.ndim and not between_samples:
                broken = rule.outside(values).reshape(len(values), -1).any(axis=1)
                self._samples[name] = self._samples.get(name, 0) + len(values)
                self._outside[name] = self._outside.get(name, 0) + int(np.sum(broken))
            beyond = np.where(np.isnan(values), -np.inf, rule.beyond(values))
            at = np.unravel_index(int(np.argmax(beyond)), values.shape)
            value, known = float(values[at]), self._worst.get(name)
            if known is None or not rule.beyond(np.array(value)) <= rule.beyond(np.array(known[0])):
                found = {place: float(where[at[0]]) for place, where in (places or {}).items()}
                if pairs and len(at) > 1:
                    found["pair"] = int(pairs[int(at[1])])
                if known is None or not math.isnan(value):
                    self._worst[name] = value, found

    def excesses(self) -> dict[str, Excess]:
        """What is outside, by name of the rule, in their order."""
        found = {}
        for name, rule in RULES.items():
            value, places = self._worst.get(name, (math.nan, {}))
            if rule.outside(np.array(value)):
                samples = self._samples.get(name)
                share = self._outside[name] / samples if samples else None
                found[name] = Excess(value, rule.limit(value), rule.units, share, places)
        return found

    def figures(self) -> dict[str, Any]:
        """What a summary says: the verdict, and the reasons; nothing where nothing was judged."""
        if not self._worst:
            return {}
        found = self.excesses()
        if not found:
            return {TRUST: INSIDE}
        reasons = {
            name: {key: part for key, part in one._asdict().items() if key != "places"} | one.places
            for name, one in found.items()
        }
        return {TRUST: OUTSIDE, REASONS: reasons}


def verdict(summary: Mapping[str, Any]) -> str:
    """`INSIDE`, `OUTSIDE`, or "" where nothing was judged."""
    said = summary.get(TRUST)
    return said if said in VERDICTS else ""


def number(summary: Mapping[str, Any]) -> int:
    """The verdict as the cases of a sweep have it."""
    return VERDICTS.get(verdict(summary), NOT_JUDGED)


def reasons(summary: Mapping[str, Any]) -> list[str]:
    """Why a result is outside the model: quantity, value, limit, for what share, and where; in words."""
    return [_sentence(rule, known) for rule, known in _broken(summary)]


def brief(summary: Mapping[str, Any]) -> str:
    """The same without values, for the remark on a case of a sweep; "" inside."""
    said = [rule.short(float(known["value"])) for rule, known in _broken(summary)]
    return f"{OUTSIDE}: {', '.join(said)}" if said else ""


def attributes(summary: Mapping[str, Any]) -> dict[str, str]:
    """What the root of a record says: the verdict, and the reasons, one per line."""
    said = verdict(summary)
    return {TRUST: said, REASONS: "\n".join(reasons(summary))} if said else {}


def _broken(summary: Mapping[str, Any]) -> Iterator[tuple[Rule, Mapping[str, Any]]]:
    given = summary.get(REASONS)
    if verdict(summary) != OUTSIDE or not isinstance(given, Mapping):
        return
    for name, known in given.items():
        if name in RULES and isinstance(known, Mapping) and {"value", "limit"} <= set(known):
            yield RULES[name], known


def _sentence(rule: Rule, known: Mapping[str, Any]) -> str:
    value, limit = float(known["value"]), float(known["limit"])
    side = "at least" if value < limit else "at most"
    said = f"{rule.label} {rule.shown(value)}, {side} {rule.shown(limit)}"
    if known.get("share") is not None:
        said += f", outside {_share(float(known['share']))}"
    places = [
        text.format(float(known[name])) if name != "pair" else text.format(int(known[name]))
        for name, text in _PLACES.items()
        if known.get(name) is not None
    ]
    return f"{said}, worst {', '.join(places)}" if places else said


#: How places are said.
_PLACES = {
    "time": "at t = {:.4g} s",
    "mesh_cycle": "mesh cycle {:.4g}",
    "phase": "at phase {:.4g}",
    "pair": "pair {:d}",
}


def _share(share: float) -> str:
    """A share of the samples; none of them where an extreme lies between two."""
    if share <= 0.0:
        return "between samples only"
    return (
        "in all samples" if share >= 1.0 else f"in {min(max(100.0 * share, 0.01), 99.9):.3g} % of the samples"
    )
