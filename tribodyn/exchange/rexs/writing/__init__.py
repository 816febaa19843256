"""From a scenario to a REXS file."""
