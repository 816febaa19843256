"""What a page offers besides fields: tables to add, remedies to take, lines to go to."""
