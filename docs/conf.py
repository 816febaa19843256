"""The documentation site: `make docs` builds it with Sphinx from the pages of this folder."""

import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parent))

import mathml

import tribodyn
import tribodyn.signals

#: What the site's sidebar shows: heading -> pages. A test holds every page of this folder against it.
CONTENTS = {
    "Start here": ["start", "gallery", "trust"],
    "Tutorials": [
        "notebooks/first-run",
        "notebooks/compare-tooth-forms",
        "notebooks/sweep-and-resonance",
        "notebooks/load-contact-and-relief",
        "notebooks/your-own-law",
        "notebooks/rating-by-hand",
        "notebooks/reducer-from-data-sheet",
        "notebooks/find-a-crack",
    ],
    "How to": [
        "how-to/own-gears",
        "how-to/relief",
        "how-to/speeds",
        "how-to/own-law",
        "how-to/housing",
        "how-to/measured",
        "how-to/scripts",
        "data-sets",
        "identify",
        "assessment",
        "compare",
        "report",
        "export",
        "app",
        "cad",
        "rexs",
        "measured-flanks",
        "fmu",
        "extending",
    ],
    "Reference": [
        "scenario",
        "command-line",
        "python",
        "api",
        "record",
        "summary",
        "figures",
        "gear-sheet",
        "glossary",
    ],
    "Explanation": [
        "theory",
        "trains",
        "helical",
        "shafts",
        "laws",
        "physics",
        "standards",
        "families",
        "mesh-stiffness",
        "load-contact",
        "wear",
        "quality",
        "efficiency",
        "map",
        "drive-cycle",
        "oil",
        "losses",
        "ehl",
        "solvers",
        "teeth",
        "damage",
        "periodic",
        "sweep",
        "design",
        "signals",
        "backlash-oscillator",
        "rolling-elements",
        "performance",
    ],
    "Comparison and measurements": ["validation", "measurements", "soak", "fuzz"],
    "For developers": ["development", "licences"],
}

project, author = "tribodyn", "the authors of tribodyn"
version = release = tribodyn.__version__
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "mathml"]
html_math_renderer = "mathml"  # docs/mathml.py: no script, and nothing from another host
html_theme = "furo"
html_title = "tribodyn"
html_static_path = ["_static", mathml.FONTS]
html_css_files = ["site.css"]
# the reference calls public names as users do, td.NAME
sys.modules["td"] = tribodyn
sys.modules["td.signals"] = tribodyn.signals
sys.modules["td.standards"] = tribodyn.standards
for part in dir(tribodyn.standards):
    sys.modules[f"td.standards.{part}"] = getattr(tribodyn.standards, part)
exclude_patterns = ["_build"]

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 6
myst_links_external_new_tab = True
# blocks that are no complete file of their language are shown as they are; "path" as a type is no attribute
suppress_warnings = ["misc.highlighting_failure", "ref.python"]

# tutorials are run when the site is built, and again only where they have changed
nb_execution_mode = "cache"
nb_execution_timeout = 600
nb_execution_raise_on_error = True
nb_merge_streams = True

autodoc_typehints = "description"
autodoc_member_order = "bysource"
napoleon_numpy_docstring = True
napoleon_use_rtype = False


def with_contents(_app: object, name: str, source: list[str]) -> None:
    """Put the table of contents below the first page, which GitHub shows without it."""
    if name != "index":
        return
    for heading, pages in CONTENTS.items():
        names = "\n".join(pages)
        source[0] += f"\n```{{toctree}}\n:caption: {heading}\n:hidden:\n\n{names}\n```\n"


def as_sphinx_reads(_app: object, _name: str, source: list[str]) -> None:
    """Take off what is for tests and for GitHub: words after a fence's language, links to pages elsewhere."""
    source[0] = re.sub(r"^```(toml|csv|python) \S+$", r"```\1", source[0], flags=re.MULTILINE)
    source[0] = re.sub(r"\[([^\]]*)\]\((?:\.\./)+(?:README|examples/\S*|CHANGELOG)\.md\)", r"\1", source[0])


def setup(app: object) -> None:
    """Connect both to the reading of pages."""
    app.connect("source-read", with_contents)  # type: ignore[attr-defined]
    app.connect("source-read", as_sphinx_reads)  # type: ignore[attr-defined]
