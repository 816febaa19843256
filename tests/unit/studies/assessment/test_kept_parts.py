"""Candidates of a search over assessments: runs that no free key changes are made once."""

import tomllib
from pathlib import Path

from tests.support.planet_sets import ASSESSED_SET
from tribodyn.studies.design.candidates.evaluation import evaluate
from tribodyn.studies.protocol.evaluated import kept_in

SCENARIO = tomllib.loads(ASSESSED_SET)
SHORT = {"scenario.solver.cycles": 2, "assessment.speeds": 1, "assessment.samples": 0}
OTHER_DUTY, LONGER = {"assessment.application_factor": 1.5}, {"scenario.solver.cycles": 3}


def test_runs_that_a_key_does_not_change_stay_and_the_numbers_are_those_of_a_new_case(tmp_path: Path):
    def run_times() -> dict[str, int]:
        return {str(path): path.stat().st_mtime_ns for path in tmp_path.rglob("*.h5")}

    def quantities(overrides: dict[str, object]) -> dict[str, float]:
        (found,) = evaluate({"": SCENARIO}, [SHORT | overrides])
        assert not isinstance(found, str), found
        return {name: value for name, value in found.items() if name != "wall_time"}

    with kept_in(tmp_path):
        quantities({})
        first = run_times()
        assert first
        kept = quantities(OTHER_DUTY)
        assert run_times() == first
        quantities(LONGER)
        again = {name for name, time in run_times().items() if first[name] != time}
        assert {Path(name).stem for name in again} == {"duty"}  # not those of the teeth alone
    assert kept == quantities(OTHER_DUTY)
