"""`tribodyn schema`: what may stand in a scenario file."""

EXAMPLES = "\b\nExample:\n  tribodyn schema > scenario.schema.json"


def schema() -> None:
    """Print the JSON schema of a scenario file."""
    from tribodyn.cli.printing import print_json
    from tribodyn.studies.protocol.load import json_schema

    print_json(json_schema())
