"""Files of results: the cache, digests of sources, and files that appear whole or not at all."""
