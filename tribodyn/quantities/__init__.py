"""The catalogue of reported numbers, each defined once. A quantity is a number, a figure a picture."""
