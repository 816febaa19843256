"""What all records have in common, and what a study says of its own.

`docs/record.md` explains the conventions to the people who read such files.
"""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

from tribodyn.errors import InputError
from tribodyn.numerics.files.sources import computing_digest
from tribodyn.numerics.parameter import Variable

FORMAT = "tribodyn-record"
#: Attributes that every record's root has.
HEAD = ("created", "message", "scenario", "scenario_sha256", "status", "tribodyn_version")
#: Attribute of records that a later call may go on with: digest of the code that computes.
CODE = "code_sha256"
#: Raised when a reader of the previous version would misread the file.
FORMAT_VERSION = 2
#: Rotation of the body that drives the first mesh, which is a pair's pinion: one dataset under both names. A
#: record lists one of them.
ANGLES = {"pinion_angle": "reference_angle", "reference_angle": "pinion_angle"}

#: States of a record. A file that says `partial` is being written, or its process was killed.
PARTIAL, COMPLETE, FAILED = "partial", "complete", "failed"
STATUS_NOTES = {
    PARTIAL: "the run is going on, or was killed: only the first samples_written samples are results",
    COMPLETE: "",
}


def require_head(attributes: Mapping[str, Any]) -> None:
    """Raise KeyError or ValueError where a root's attributes are not those of a record."""
    for name in HEAD:
        if not isinstance(attributes[name], str):
            raise ValueError(f"{name} is no text")
    if attributes["status"] not in (PARTIAL, COMPLETE, FAILED):
        raise ValueError(f"unknown status {attributes['status']}")


def require_same_code(attributes: Mapping[str, Any], path: Path, code: str = "") -> None:
    """Raise InputError where other code computed what an unfinished call left; default: that of this call."""
    if attributes.get(CODE) != (code or computing_digest()):
        rule = "computed by other code (tribodyn, or a package with laws, has changed since)"
        raise InputError("--resume", str(path), rule, "move it away, or --force to begin anew")


TIME = Variable(("time",), "s", "time")
SAMPLES_WRITTEN = Variable((), "1", "number of samples, from the first, that hold results", "<i8", 0)


class Layout(NamedTuple):
    """What the records of a study hold; a record names all of it, so that a reader needs none of this."""

    axis: Variable  # scale of the axis on which a run goes on: time, phase of the mesh, frequency
    samples: Mapping[str, Variable]  # datasets along that axis, by name
    scales: Mapping[str, Variable] = MappingProxyType({})  # of the other axes
    #: datasets along other axes; left out where an axis of theirs has no scale
    others: Mapping[str, Variable] = MappingProxyType({})
    #: name of a group -> its arrays and numbers. Arrays bring their dimensions with them; numbers become
    #: attributes
    groups: Mapping[str, Mapping[str, Variable]] = MappingProxyType({})

    @property
    def axis_name(self) -> str:
        """Name of the axis on which a run goes on."""
        return self.axis.dims[0]

    @property
    def along(self) -> dict[str, Variable]:
        """All datasets along that axis, itself first."""
        return {self.axis_name: self.axis, **self.samples}


def partial_path(path: Path) -> Path:
    """Where the record lies until it is complete."""
    return path.with_name(path.stem + ".partial.h5")
