"""Many cases side by side in the lanes of vector registers."""
