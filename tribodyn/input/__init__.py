"""From TOML, written in engineers' units, to a `Case` in SI."""
