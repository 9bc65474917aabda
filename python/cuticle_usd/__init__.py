"""USD files for the command line, by usd-core."""
