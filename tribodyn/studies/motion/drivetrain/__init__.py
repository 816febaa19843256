"""A train as its scenario describes it: tables, names, places of axes, teeth, duty."""
