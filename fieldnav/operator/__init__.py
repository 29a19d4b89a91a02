"""The operator's word to a running mission: a socket, keys on its terminal, its questions."""
