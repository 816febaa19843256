"""From what was measured back to numbers of the drive: nothing here is imported before it is asked for."""
