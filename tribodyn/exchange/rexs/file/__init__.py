"""What a REXS file holds: parts, attributes, units; how it is read from XML, JSON and ZIP."""
