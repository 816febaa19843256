"""The oscillator with backlash, on which the search for steady states is verified: case and sweep."""
