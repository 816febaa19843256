"""Pictures like those of the papers, from our own numbers: one module per paper, imported only to draw.

Each has `FIGURES`: name of the picture -> function that draws it, given the folder with the records of the
paper's runs (empty where it needs none).
"""
