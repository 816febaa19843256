"""The figures, one subject a file; `tribodyn.studies.pages` names them."""
