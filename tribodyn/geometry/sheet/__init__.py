"""The geometry of a gear pair as engineers read it: sheet, measured thickness, outlines."""
