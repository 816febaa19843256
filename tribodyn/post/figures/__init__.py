"""The figures, one subject a file; `tribodyn.post.plots` names them."""
