"""The bodies of functions: expressions, calls and statements of Python to those of C."""
