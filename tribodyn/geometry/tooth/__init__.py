"""A tooth as its rack cuts it, and the gear that such teeth make."""
