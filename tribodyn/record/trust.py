"""Whether a result lies within what its model assumes; if not, what is outside, how far, where, how long.

One table of rules for all studies (`trust_rules.RULES`). A study hands over those of the quantities that it
has, as they are sampled, to a `Judge`, and puts what that says into its summary. Writers copy it to the root
of a record, and reports take it from there. A result outside the model is complete, but not to be trusted.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.record.trust_rules import RULES, Rule

#: Names in a summary, and of attributes of a record: the verdict, and the reasons by name of the rule.
TRUST, REASONS = "trust", "trust_reasons"
#: The verdicts. Without one nothing was judged: a study without such quantities, or a record of 0.1.0.
#: Extrapolated: inside, but for a law that is nowhere used in its range.
INSIDE, OUTSIDE, EXTRAPOLATED = "inside the model", "outside the model", "laws extrapolated"
#: The same as numbers, for the cases of a sweep.
VERDICTS = {OUTSIDE: 0, INSIDE: 1, EXTRAPOLATED: 2}
NOT_JUDGED = -1


class Excess(NamedTuple):
    """How a result breaks a rule."""

    #: value, limit: the value that is furthest outside, and the limit; SI
    value: float
    limit: float
    units: str
    share: float | None  # share of the samples in which the rule is broken; None of a single number
    places: dict[str, float]  # where the value is: time (s), mesh_cycle, pair, …


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
        quantities : name of a rule -> a number, or values (n,) or (n, pairs, …); NaN where there is nothing
            to judge
        places : name -> where the n samples lie (n,)
        pairs : numbers of the pairs along the second axis
        between_samples : whether the values are those of extremes between samples, which do not count in any
            share
        """
        for name, given in quantities.items():
            rule, values = RULES[name], np.asarray(given, dtype=float)
            if values.size == 0:
                continue
            if values.ndim and not between_samples:
                broken = rule.outside(values)
                outside = int(np.sum(broken.reshape(len(values), -1).any(axis=1))) if broken.any() else 0
                self._samples[name] = self._samples.get(name, 0) + len(values)
                self._outside[name] = self._outside.get(name, 0) + outside
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
            name: {key: part for key, part in excess._asdict().items() if key != "places"} | excess.places
            for name, excess in found.items()
        }
        return {TRUST: EXTRAPOLATED if all(RULES[name].extrapolates for name in found) else OUTSIDE} | {
            REASONS: reasons
        }


def judge_tribology(judge: Judge, figures: Mapping[str, Any]) -> None:
    """Judge films by their minimum, and ranges of laws, of a summary's figures.

    Not by their maximum: where the load vanishes, laws give a film without bound.
    """
    given = {
        "film_thickness": figures.get("film_min"),
        "film_parameter": figures.get("film_parameter_min"),
    }
    for name, law in (("film_law_range", "closure"), ("friction_law_range", "friction")):
        inside = figures.get(f"{law}_in_range_fraction")
        given[name] = None if inside is None else 1.0 - inside
    judge.take({name: value for name, value in given.items() if value is not None})


def heat_of(flash_rise: Any, temperature: float | None) -> dict[str, Any]:
    """Flash temperature rises (K) as a quantity to judge, with the temperature of teeth or oil if known."""
    if temperature is None:
        return {"flash_temperature": flash_rise}
    return {"contact_temperature": temperature + flash_rise}


def verdict(summary: Mapping[str, Any]) -> str:
    """`INSIDE`, `OUTSIDE`, `EXTRAPOLATED`, or "" where nothing was judged."""
    found = summary.get(TRUST)
    return found if found in VERDICTS else ""


def number(summary: Mapping[str, Any]) -> int:
    """The verdict as the cases of a sweep have it."""
    return VERDICTS.get(verdict(summary), NOT_JUDGED)


def reasons(summary: Mapping[str, Any]) -> list[str]:
    """Why a result is not inside the model: quantity, value, limit, for what share, and where; in words."""
    return [_sentence(rule, known) for rule, known in _broken(summary)]


def warnings(summary: Mapping[str, Any]) -> list[str]:
    """What lies outside the model, in words; laws that are extrapolated are no warning."""
    return [
        f"{OUTSIDE}: {_sentence(rule, known)}" for rule, known in _broken(summary) if not rule.extrapolates
    ]


def brief(summary: Mapping[str, Any]) -> str:
    """The same without values, for the remark on a case of a sweep; "" where it is not outside."""
    broken = [rule.short(float(known["value"])) for rule, known in _broken(summary) if not rule.extrapolates]
    return f"{OUTSIDE}: {', '.join(broken)}" if broken else ""


def attributes(summary: Mapping[str, Any]) -> dict[str, str]:
    """What the root of a record says: the verdict, and the reasons, one per line."""
    found = verdict(summary)
    return {TRUST: found, REASONS: "\n".join(reasons(summary))} if found else {}


def _broken(summary: Mapping[str, Any]) -> Iterator[tuple[Rule, Mapping[str, Any]]]:
    given = summary.get(REASONS)
    if verdict(summary) not in (OUTSIDE, EXTRAPOLATED) or not isinstance(given, Mapping):
        return
    for name, rule in RULES.items():
        known = given.get(name)
        if isinstance(known, Mapping) and {"value", "limit"} <= set(known):
            yield rule, known


def _sentence(rule: Rule, known: Mapping[str, Any]) -> str:
    value, limit = float(known["value"]), float(known["limit"])
    side = "at least" if value < limit else "at most"
    sentence = f"{rule.label} {rule.shown(value)}, {side} {rule.shown(limit)}"
    if known.get("share") is not None:
        sentence += f", outside {_share(float(known['share']))}"
    places = [
        text.format(float(known[name])) if name != "pair" else text.format(int(known[name]))
        for name, text in _PLACES.items()
        if known.get(name) is not None
    ]
    return f"{sentence}, worst {', '.join(places)}" if places else sentence


#: How places are written.
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
