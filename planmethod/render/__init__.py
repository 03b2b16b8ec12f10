"""Drawing: display lists, sheets, output formats."""
