"""Bodies of gears and shafts for CAD and viewers."""
