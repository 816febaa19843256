"""`tribodyn check`: is the scenario sound, what gears does it describe, how stiff are they."""

from tribodyn.cli.options import JsonOption, LargeOption, ScenarioArgument, SetOption, overrides

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn check involute-18-36\n"
    "  tribodyn check my-drive.toml --set drive.pinion.profile_shift=0.3 --json"
)


def check(
    scenario: ScenarioArgument,
    settings: SetOption = None,
    allow_large: LargeOption = False,
    json: JsonOption = False,
) -> None:
    """Check a scenario; print geometry and stiffness."""
    from tribodyn.cli.printing import print_json, print_prose, print_text_table
    from tribodyn.studies.protocol.load import load

    loaded = load(scenario, overrides(settings))
    with loaded.naming():
        checked = loaded.study.check(loaded.case, allow_large=allow_large)
    if json:
        print_json({"scenario": str(loaded.path), "title": loaded.case.title, **checked.data})
        return
    print_prose(f"{loaded.path}: {loaded.case.title}: sound")
    for table in checked.tables:
        print_text_table(table)
    for remark in checked.remarks:
        print_prose(remark)
