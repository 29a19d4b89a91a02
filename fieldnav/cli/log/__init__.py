"""`fieldnav log`: a file a command, and what they share."""
