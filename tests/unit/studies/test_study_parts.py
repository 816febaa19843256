"""How a study finds its parts, and what it makes of a package that is broken."""

import sys
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from tribodyn.errors import InputError
from tribodyn.quantities.quantity import Quantity
from tribodyn.studies.protocol import study as studying
from tribodyn.studies.protocol.estimate import LIMITS, Driver, Estimate
from tribodyn.studies.protocol.study import Checked, Study

NAME = "pendulum_of_tests"
SWING = Quantity("swing", "Swing of the bob", "°")


@pytest.fixture
def package(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """A package with one part, `report`, which holds lines and nothing else."""
    made, report = ModuleType(NAME), ModuleType(f"{NAME}.report")
    made.__path__ = []  # pyright: ignore[reportAttributeAccessIssue]
    vars(report)["REPORTED"] = {"Result": (SWING,)}
    monkeypatch.setitem(sys.modules, NAME, made)
    monkeypatch.setitem(sys.modules, f"{NAME}.report", report)
    return made


def study_of(**changed: Any) -> Study:
    return Study("pendulum", "a pendulum", f"{NAME}", "swings", **changed)


def test_what_is_optional_may_be_missing(package: ModuleType):
    """A part, or what it holds; of what is needed the error names kind and package."""
    study = study_of()
    assert list(study.reported()) == ["Result"]
    assert study.swept() == study.short_names() == {}
    assert (study.batch(), study.role(), study.own_page()) == (None, None, None)
    assert (study.panels(), study.top(), study.maps("record"), study.profiles("record")) == ((), (), (), None)  # pyright: ignore[reportArgumentType]
    assert tuple(study.broken_rules("scenario")) == ()
    assert study.estimate("case") == Estimate()
    for asked in (lambda: study.figures("case"), study.drawings, lambda: study.sentences("record")):  # pyright: ignore[reportArgumentType]
        with pytest.raises(InputError, match=NAME):
            asked()


def test_a_part_that_cannot_be_imported_is_not_taken_for_missing(
    package: ModuleType, monkeypatch: pytest.MonkeyPatch
):
    """Another module that it needs is not there; or the part needs what another module lacks."""

    def importing(name: str) -> Any:
        if name == f"{NAME}.batch":
            raise ModuleNotFoundError("No module named 'other'", name="other")
        if name == f"{NAME}.assess":
            raise AttributeError("no such attribute", name="other", obj=None)
        return sys.modules[name] if name in sys.modules else real(name)

    real = studying.import_module
    monkeypatch.setattr(studying, "import_module", importing)
    for asked in (study_of().batch, study_of().role):
        with pytest.raises(InputError, match=NAME):
            asked()
    ours = Study("pendulum", "a pendulum", "tribodyn.no_such_folder", "swings")
    with pytest.raises(ModuleNotFoundError):
        ours.reported()


def test_a_study_in_a_single_module_holds_its_parts_itself(package: ModuleType):
    """But a part of the name of what it holds is a module, and no part."""
    vars(package).update(SWEPT=(SWING,), run=ModuleType("run"))
    study = study_of()
    assert list(study.swept()) == ["swing"]
    assert list(study.sweep_table()) == [SWING]
    vars(package)["figures"] = lambda case: {"efficiency": 1.5, "swing": 2.0}
    vars(package)["table_for"] = lambda data: ("table of", data)
    assert study.table({"a": 1}) == ("table of", {"a": 1})
    assert study.figures("case")["swing"] == 2.0
    assert study.figures("case")["efficiency"] is None
    del package.__path__
    vars(package)["TEMPLATE"] = 'title = "TITLE"'
    assert study.template() == 'title = "TITLE"'
    with pytest.raises(InputError, match=NAME):
        study.run("case")


def test_what_is_large_is_said_and_refused(package: ModuleType):
    """Above the limits unless it is allowed; a run that cannot be resumed says so."""
    taken = [Estimate(memory=LIMITS.memory * 2.0, drivers=(Driver("solver.cycles", 9.0, 1.0),))]
    results: list[Any] = []

    def run(case: Any, output: Any, **how: Any) -> Any:
        results.append(how)
        return SimpleNamespace(summary={"efficiency": 2.0}, _replace=lambda summary: summary)

    vars(package).update(
        check=lambda case: Checked({"a": 1}, (), ["one"]), estimate=lambda case: taken[0], run=run
    )
    study = study_of()
    for asked in (study.check, study.run):
        with pytest.raises(InputError, match="cycles"):
            asked("case")
    found = study.check("case", allow_large=True)
    assert (found.data["a"], found.remarks[0]) == (1, "one")
    assert found.remarks[1].startswith("A run takes about ")
    summary: Any = study.run("case", allow_large=True)
    assert summary["efficiency"] is None
    with pytest.raises(InputError, match="a pendulum"):
        study.run("case", resume=True)
    taken[0] = Estimate(seconds=1e-3)
    assert list(study.check("case").remarks) == ["one"]
    study_of(resumes=True).run("case", resume=True, client="client")
    assert results == [
        {"force": False, "progress": None},
        {"force": False, "progress": None, "resume": True, "client": "client"},
    ]
