"""Measurements of tools/bench, a module a command; and what they share."""
