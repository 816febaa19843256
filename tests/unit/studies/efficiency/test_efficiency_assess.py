from tribodyn.cases.assessment_part import Request
from tribodyn.studies.efficiency.assess import tasks


def test_an_assessment_needs_the_first_law_only():
    tables = {"drive": "d", "lubricant": "l", "oil_temperature": "80 degC"}
    laws = ("schlenk", "niemann", "masjedi-khonsari")
    request = Request("pair", tables, 100.0, 96.0, (96.0,), (100.0,), laws, 1e-6, ())
    done = tasks(request)
    assert [task.scenario["friction"]["law"] for task in done] == list(laws)
    assert [task.needed for task in done] == [True, False, False]
