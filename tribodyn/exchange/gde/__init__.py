"""GDE, gear data exchange (VDI/VDE 2610): measured gears as XML, read and written."""
