"""The kinds of study: one folder each, and one line of this registry."""

from collections.abc import Mapping
from typing import Any

from tribodyn.numerics.registry import Registry
from tribodyn.studies.protocol.study import Study

STUDIES: Registry[Study] = Registry(
    "kind",
    "kind of scenario",
    {
        "gear-pair": "tribodyn.studies.motion:PAIR",
        "gear-train": "tribodyn.studies.motion:TRAIN",
        "efficiency": "tribodyn.studies.efficiency:STUDY",
        "load-contact": "tribodyn.studies.load_contact:STUDY",
        "wear": "tribodyn.studies.wear:STUDY",
        "ehl": "tribodyn.studies.ehl:STUDY",
        "irefc": "tribodyn.studies.irefc:STUDY",
        "backlash-oscillator": "tribodyn.studies.backlash_oscillator:STUDY",
        "design": "tribodyn.studies.design:STUDY",
        "assessment": "tribodyn.studies.assessment:STUDY",
        "train-assessment": "tribodyn.studies.assessment:OF_SCENARIO",
        "map": "tribodyn.studies.map:STUDY",
        "drive-cycle": "tribodyn.studies.drive_cycle:STUDY",
    },
    "tribodyn.studies",
    Study,
)
DEFAULT = next(iter(STUDIES))


def study_of(data: Mapping[str, Any]) -> Study:
    """Return the study of a scenario's data; the default one where it names none, or none that there is."""
    kind = data.get("kind", DEFAULT)
    study = STUDIES[kind if isinstance(kind, str) and kind in STUDIES else DEFAULT]
    key, other = study.instead
    return STUDIES[other] if key and key in data else study
