"""Results of two programs compared bit by bit: tools/compare."""
