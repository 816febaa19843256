"""Typeset equations when the site is built: LaTeX to MathML, which browsers show without a script."""

import re
from pathlib import Path
from typing import Any

import ziamath
from docutils import nodes
from latex2mathml.converter import convert
from sphinx.util.logging import getLogger

#: Folder of STIX Two Math (OFL-1.1), with brackets and roots that stretch; site.css names it.
FONTS = str(Path(ziamath.__file__).parent / "fonts")
#: What latex2mathml writes -> what MathML Core, that of browsers, needs for the usual alignment and spaces.
AS_CORE = (
    (r'columnalign="(\w+)"', r'style="text-align: \1"'),
    (
        r"<m([io])>([A-Za-z]{2,})</m\1>(?!<mo[^>]*>&#x00028;)",
        r'<mo lspace="0.167em" rspace="0.167em">\2</mo>',
    ),
    (r"<m([io])>([A-Za-z]{2,})</m\1>", r'<mo lspace="0.167em" rspace="0">\2</mo>'),
    (r'(&#x00028;</mo>)<mo lspace="0.167em"', r'\1<mo lspace="0"'),
    (r"<mo>(&#x0007C;|&#x0002F;)</mo>", r'<mo stretchy="false" lspace="0" rspace="0">\1</mo>'),
    (
        r"((?:&#x00028;|&#x0003D;|&#x0002C;|&#x0005B;)</mo>)<mo>&#x02212;</mo>",
        r'\1<mo form="prefix">&#x02212;</mo>',
    ),
)


def mathml(latex: str, display: str) -> str:
    """One equation; what cannot be typeset is a warning, and so an error of the build."""
    typeset = convert(re.sub(r"\{(aligned|split)\}", "{align*}", latex), display=display)
    if "\\" in typeset or "<mi>&</mi>" in typeset:
        getLogger(__name__).warning("cannot be typeset: %s", latex)
    for written, core in AS_CORE:
        typeset = re.sub(written, core, typeset)
    return typeset


def inline(translator: Any, node: nodes.Node) -> None:
    """Put an equation into a line of text."""
    translator.body.append(mathml(node.astext(), "inline"))
    raise nodes.SkipNode


def block(translator: Any, node: nodes.Node) -> None:
    """Put an equation on lines of its own."""
    translator.body.append(f'<div class="equation">{mathml(node.astext(), "block")}</div>')
    raise nodes.SkipNode


def setup(app: Any) -> dict[str, bool]:
    """Offer the renderer to Sphinx."""
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
