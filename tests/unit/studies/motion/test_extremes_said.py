from tribodyn.gears.motion.extremes import on_extremes


def summary(run, last):
    described = {
        part: {name: {"value": value} for name, value in values.items()}
        for part, values in (("run", run), ("last_cycles", last))
    }
    return {"extremes": described, **last}


def test_extremes_of_the_whole_run_are_said_where_they_differ():
    run = {"normal_load_max": 9575.0, "film_min": 3.2e-7, "hertz_pressure_max": 1.4e9}
    last = {"normal_load_max": 9400.0, "film_min": 3.2e-7, "hertz_pressure_max": 1.3e9}
    (said,) = on_extremes(summary(run, last))
    assert said.startswith("Over the whole run: ")
    assert "maximum normal load 9,575 N" in said
    assert "maximum Hertz pressure 1.4 GPa" in said
    assert "film" not in said


def test_nothing_is_said_where_they_agree_or_are_not_known():
    values = {"normal_load_max": 9575.0}
    assert on_extremes(summary(values, {"normal_load_max": 9570.0})) == []
    assert on_extremes(summary(values, {})) == []
    assert on_extremes({"normal_load_max": 9575.0}) == []


def test_a_record_whose_table_is_of_the_whole_run_says_those_of_the_last_cycles():
    run, last = {"normal_load_max": 9575.0}, {"normal_load_max": 9400.0}
    (said,) = on_extremes({**summary(run, last), **run})
    assert said == "Over the last mesh cycles: maximum normal load 9,400 N."
