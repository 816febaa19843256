"""From laws to machine code, one case at a time or many in the lanes of vectors."""
