"""The cycloid gear with intermediate rolling elements and a free cage (IREFC)."""
