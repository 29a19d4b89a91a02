"""`python -m fieldnav`."""

from fieldnav.cli.app import main

main()
