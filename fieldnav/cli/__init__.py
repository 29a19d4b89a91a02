"""The command line: one module a command, the tables they print, and where every error ends."""
