"""The mission as an explicit hierarchical state machine: names, table, machine, one behaviour a file."""
