"""What the page of an assessment consists of."""
