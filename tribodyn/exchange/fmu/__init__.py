"""Co-simulation units by the Functional Mock-up Interface, 3.0 and 2.0: gearboxes in time for simulators."""
