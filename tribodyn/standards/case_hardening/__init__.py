"""What case-hardened teeth stand below their surface."""
