"""REXS, the exchange format of gearboxes (versions 1.0 to 2.0.0): XML, JSON and ZIP, read and written."""
