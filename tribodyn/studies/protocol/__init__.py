"""What a study is, and how its cases are loaded, estimated, run and recorded."""
