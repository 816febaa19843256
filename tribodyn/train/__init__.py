"""What turns in a drive train, and how: speeds, senses, places and phases of gears that mesh."""
