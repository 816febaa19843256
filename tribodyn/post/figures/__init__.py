"""The figures, one subject a file; `tribodyn.studies.pages.pictures` names them."""
