"""From a REXS file to a scenario."""
