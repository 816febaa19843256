"""The laws of links: one per file, and their registry."""

from tribodyn.numerics.registry import Registry
from tribodyn.train.links.law import LinkLaw

LINK_LAWS: Registry[LinkLaw] = Registry(
    "link.law",
    "link law",
    {"linear": "tribodyn.train.links.law:LAW", "play": "tribodyn.train.links.play:LAW"},
    "tribodyn.link_laws",
    LinkLaw,
)
