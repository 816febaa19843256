"""The figures, one subject a file; `tribodyn.studies.pictures` names them."""
