"""A record, or several, as one HTML page: summary, interactive figures, the teeth rolling through mesh."""
