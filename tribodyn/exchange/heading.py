"""What stands at the beginning of every file that is exported: who made it, of what, how exactly."""

import re
from collections.abc import Iterable

from tribodyn import __version__
from tribodyn.errors import printable
from tribodyn.exchange.format import Deviation, Exported


def heading(
    exported: Exported, comment: str, deviations: Iterable[Deviation] = (), remarks: Iterable[str] = ()
) -> str:
    """Lines of comment; the first one is the mark by which the file may be replaced."""
    lines = [f"written by tribodyn {__version__} from {exported.path.name}"]
    if exported.map is not None:
        lines += [
            f"ratio output/input {exported.map.ratio:.6g}",
            "torque at the output, above 0 it resists the motion, below 0 the load drives",
            "speed of the input; drag: loss as a torque at the input, power loss / |speed|",
            "torque at the input, in the direction of motion: |ratio| * torque + drag",
        ]
        if exported.map.interpolation[0] >= 0.0:
            maximum, mean = (100 * share for share in exported.map.interpolation)
            lines.append(f"interpolation of the map itself: error at most {maximum:.2g} %, mean {mean:.2g} %")
    lines += [*map(str, deviations), *remarks]
    return "".join(f"{comment}{printable(line)}\n" for line in lines)


def without_double_hyphens(text: str) -> str:
    """What may stand in a comment of XML, which two hyphens together would end."""
    return re.sub("-(?=-)", "- ", text)
